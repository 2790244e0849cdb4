"""Rings as elastic bodies on their seats.

compliance   - what the balls' forces move at each other's places
elastic_ring - an elastic ring: section, material, seat
seat_places  - reactions of a seat that presses a ring at places only
"""

"""Rings as elastic bodies on their seats.

compliance   - movement of a groove at one ball by the force of another, supports of seats
elastic_ring - an elastic ring: section, material, seat
"""

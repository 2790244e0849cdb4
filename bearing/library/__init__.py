"""Bearings, materials and lubricants by name, with sources.

bearings   - bearings by name, as the keys of a case file's [bearing] table
lubricants - lubricants by name: viscosity, pressure-viscosity coefficient, density
names      - names of catalogue and libraries, matched without regard to case, spaces and hyphens
"""

"""Bearings, materials and lubricants by name, with sources.

bearings         - bearings by name, as the keys of a case file's [bearing] table
catalogue        - entries by rule: boundary dimensions, ratings, clearance classes
designation      - designations of bearings: series, bore, contact angle, suffixes
greases          - greases by name: base oil, and their film over that of it by age
lubricants       - lubricants by name: viscosity, pressure-viscosity coefficient, density
names            - names of libraries, matched without regard to case, spaces and hyphens
oil_sets         - constants of oils under pressure: volume, viscosity, heat, shear
plugins          - oils of other distributions
tolerances       - seats by name: k5, H7, and the tolerance classes of bearings
typical_geometry - internal geometry that follows from boundary dimensions alone
"""

"""Bearings, materials and lubricants by name, with sources.

bearings    - bearings by name, as the keys of a case file's [bearing] table; tolerances
catalogue   - entries by rule: boundary dimensions, ratings, clearance classes
designation - designations of bearings: series, bore, contact angle, suffixes
lubricants  - oils and greases by name: viscosity, pressure-viscosity, density
media       - water, liquefied gases, refrigerants: their properties by CoolProp
plugins     - names and data files of libraries, oils of other distributions
"""

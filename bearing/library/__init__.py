"""Bearings, materials and lubricants by name, with sources.

bearings    - bearings by name, as the keys of a case file's [bearing] table
catalogue   - entries by rule: boundary dimensions, ratings, clearance classes
designation - designations of bearings: series, bore, contact angle, suffixes
lubricants  - lubricants by name: viscosity, pressure-viscosity coefficient, density
plugins     - oils of other distributions
"""

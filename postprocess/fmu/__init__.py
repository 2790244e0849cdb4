"""Tables of batches as functional mock-up units.

table  - grid of a batch, splines through it, their error
export - the unit: description, sources in C, binary
"""

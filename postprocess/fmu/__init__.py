"""Tables of batches as functional mock-up units.

export - grid of a batch, splines through it, the unit: description, sources in C, binary
"""

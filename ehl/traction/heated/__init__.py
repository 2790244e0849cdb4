"""Shear of films that sliding heats.

film      - a film solved with heat as lines of nodes, and its forces for many motions
nahme     - Couette flow heated by itself: how it thins the oil, as a table for the kernels
_kernels  - the equations of the heat of sliding, and compiled sums along the lines
"""

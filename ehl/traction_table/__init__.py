"""Traction tables: films, sampling, storage, interpolation.

_many_kernels - sliding forces at thousands of motions, compiled
build         - films over load and speed, sheared over motions until a check is passed; stiffness
                and damping
compression   - values of a table
film          - the film that a table shears, in patches for thousands of motions, and what it
                takes from it
full_solves   - full solves beside a table: what its films leave out
splines       - uniform cubic B-splines through values on a grid
storage       - traction tables on disk
table         - a contact's traction over load, entrainment speed, sliding and spin
temperature   - traction tables over the temperature of the oil at the inlet
"""

"""Traction tables: films, sampling, storage, interpolation.

_many_kernels       - sliding forces at thousands of motions, compiled
build               - films over load and speed, sheared over motions until a check is passed
compression         - values of a table
film                - the film that a table shears, and what it takes from it at a load and a speed
full_solves         - full solves beside a table: what its films leave out
responses           - stiffness and damping of all films of a table, from those solved at some
splines             - uniform cubic B-splines through values on a grid
storage             - traction tables on disk
table               - a contact's traction over load, entrainment speed, sliding and spin
temperature         - traction tables over the temperature of the oil at the inlet
values              - values of a table at its nodes, some interpolated between films
vectorised_traction - patches of a film, whose sliding is taken at few places, for sums at
                      thousands of motions
"""

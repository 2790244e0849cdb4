"""Films that part balls and races: how a load follows from the distance of the bodies through film
and elastic body.

_kernels - a ball on a race over the film of a traction table, compiled
laws     - the lubricated contact in NumPy: film, load, stiffness, damping
"""

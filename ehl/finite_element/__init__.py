"""Independent finite-element solution of the lubricated contact.

linear_solvers - linear systems: sparse direct factors, algebraic multigrid
reynolds       - Reynolds' equation in weak form on bilinear quadrilaterals
solver         - one lubricated contact by finite elements and Newton's method
"""

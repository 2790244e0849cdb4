"""Independent finite-element solution of the lubricated contact.

linear_solvers - linear systems: GMRES with sparse direct factors of the near field
reynolds       - Reynolds' equation in weak form on bilinear quadrilaterals
solver         - one lubricated contact by finite elements and Newton's method
"""

"""Independent finite-element solution of the lubricated contact.

levels         - meshes of a contact, each twice as fine as the one before
mesh           - bilinear functions on rectangle meshes graded by halving
newton         - Newton's method on one mesh: pressures, H0 and the load together
oil_laws       - density and viscosity with their derivatives by the pressure
reynolds       - Reynolds' equation in weak form on bilinear quadrilaterals
solver         - one lubricated contact by finite elements and Newton's method
start          - what Newton's method starts from
"""

"""Independent finite-element solution of the lubricated contact.

edges          - edges of a rectangle mesh, and matrices between edges and nodes
levels         - meshes of a contact, each twice as fine as the one before
mesh           - lines of rectangle meshes, graded by halving
newton         - Newton's method on one mesh: pressures, H0 and the load together
oil_laws       - density, viscosity and reduced pressure over the pressure
reynolds       - Reynolds' equation in weak form, by the reduced pressure
solver         - one lubricated contact by finite elements and Newton's method
start          - what Newton's method starts from
"""

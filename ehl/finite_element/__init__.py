"""Independent finite-element solution of the lubricated contact.

newton   - Newton's method on one mesh: pressures, H0 and the load together
reynolds - Reynolds' equation in weak form, by the reduced pressure
solver   - one lubricated contact by finite elements and Newton's method
"""

"""Independent finite-element solution of the lubricated contact.

reynolds - Reynolds' equation in weak form, by the reduced pressure
solver   - one lubricated contact by finite elements and Newton's method
"""

"""Shear of films with heat: what rolling warms is in the film, what sliding adds is found while it is sheared."""

"""Shear of films heated by sliding."""

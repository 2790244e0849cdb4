"""Closed-form references: Hertz contact and stress, film formulas, thermal reduction."""

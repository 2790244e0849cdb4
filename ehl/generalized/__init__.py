"""Generalized Reynolds equation of Yang and Wen (1990), with heat."""

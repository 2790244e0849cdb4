"""Quasi-static equilibrium of rings and balls."""

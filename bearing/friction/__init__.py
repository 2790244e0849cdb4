"""Friction of balls on races: laws, balance of the balls, traction equilibrium."""

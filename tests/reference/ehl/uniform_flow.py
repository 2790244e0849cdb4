"""A flow model whose factors are uniform; all 1 is the Newtonian oil of uniform temperature."""

import numpy as np

from oilfilm.ehl.multigrid.levels import FlowFactors


class UniformFlow:
    """Poiseuille factor and velocity over those of the Newtonian oil, the same everywhere."""

    def __init__(self, poiseuille=1.0, speed=1.0, symmetric=True):
        self.poiseuille, self.speed, self.symmetric, self.calls = poiseuille, speed, symmetric, 0
        self.accelerated = True

    def factors(self, contact, grid, P, H, last):
        """Of a grid, and no state."""
        self.calls += 1
        ones = np.ones_like(P)
        return FlowFactors(poiseuille=self.poiseuille * ones, couette_x=self.speed * ones), None

    def change(self, state):
        """None: what is uniform stays."""
        return 0.0

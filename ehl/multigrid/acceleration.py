"""Nonlinear Krylov acceleration of the multigrid cycle, for cycles that converge slowly or
oscillate.

The cycle is a fixed-point map x -> g(x) of x = (P, H0). Anderson (1965) takes the combination of
the last cycles whose residual g(x) - x would be the smallest if the map were linear (Walker and
Ni, 2011): GMRES on the linearised equations with the cycle as preconditioner, without derivatives.
"""

from dataclasses import dataclass, field

import numpy as np

from ..arrays import Array

DEPTH = 6  # cycles in the combination
CONDITION = 1e-8  # relative singular value below which a direction is dropped


@dataclass(slots=True, kw_only=True)
class Acceleration:
    """Iterates of the last cycles [-]."""

    starts: list[Array] = field(default_factory=list)  # x
    ends: list[Array] = field(default_factory=list)  # g(x)
    weight: float = 1.0  # of the approach, which moves the film of every node

    def next(self, before: tuple[Array, float], after: tuple[Array, float]) -> tuple[Array, float]:
        """Combine the last cycles to the iterate that starts the next one, Walker and Ni (2011).

        Parameters
        ----------
        before : tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 before the last cycle [-]
        after : tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 after it [-]

        Returns
        -------
        tuple[Array, float]
            pressure, shape (ny, nx), and approach H0 to start the next cycle from [-]
        """
        if not self.ends:
            self.weight = float(np.sqrt(np.count_nonzero(after[0]) + 1.0))
        weight = self.weight
        # 1. iterates and residuals of the last cycles
        self.starts = [*self.starts, _vector(before, weight)][-DEPTH:]
        self.ends = [*self.ends, _vector(after, weight)][-DEPTH:]
        residuals = [g - x for x, g in zip(self.starts, self.ends, strict=True)]
        if len(residuals) < 2:
            return after
        # 2. combination with the smallest residual, Walker and Ni (2011), unconstrained form
        steps = np.stack([r - residuals[-1] for r in residuals[:-1]], axis=1)
        factors = np.linalg.lstsq(steps, -residuals[-1], rcond=CONDITION)[0]
        # 3. the same combination of the ends
        differences = np.stack([g - self.ends[-1] for g in self.ends[:-1]], axis=1)
        result = self.ends[-1] + differences @ factors
        return np.maximum(result[:-1].reshape(after[0].shape), 0.0), float(result[-1] / weight)


def _vector(state: tuple[Array, float], weight: float) -> Array:
    return np.append(state[0].ravel(), weight * state[1])

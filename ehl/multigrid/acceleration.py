"""Nonlinear Krylov acceleration of the multigrid cycle, for contacts whose cycles creep or swing.

The cycle is a fixed-point map x -> g(x) of x = (P, H0). From the last cycles the combination is
taken whose residual g(x) - x would be the smallest if the map were linear (Anderson, 1965; Walker
and Ni, 2011): GMRES on the linearised equations with the cycle as preconditioner, without ever
forming a derivative.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

DEPTH = 6  # cycles remembered
CONDITION = 1e-8  # relative singular value below which a direction counts as spent


@dataclass(slots=True, kw_only=True)
class Acceleration:
    """The last cycles: what they were given and what they made of it [-]."""

    given: list[Array] = field(default_factory=list)
    found: list[Array] = field(default_factory=list)
    weight: float = 1.0  # of the approach, which moves the film of every node

    def mixed(
        self, before: tuple[Array, float], after: tuple[Array, float]
    ) -> tuple[Array, float]:
        """Pressure, shape (ny, nx), and approach to start the next cycle from [-].

        Parameters
        ----------
        before, after : tuple of ndarray and float
            Pressure and approach before and after the last cycle [-].
        """
        if not self.found:
            self.weight = float(np.sqrt(np.count_nonzero(after[0]) + 1.0))
        weight = self.weight
        self.given = [*self.given, _vector(before, weight)][-DEPTH:]
        self.found = [*self.found, _vector(after, weight)][-DEPTH:]
        residuals = [g - x for x, g in zip(self.given, self.found, strict=True)]
        if len(residuals) < 2:
            return after
        steps = np.stack([r - residuals[-1] for r in residuals[:-1]], axis=1)
        shares = np.linalg.lstsq(steps, -residuals[-1], rcond=CONDITION)[0]
        ends = np.stack([g - self.found[-1] for g in self.found[:-1]], axis=1)
        result = self.found[-1] + ends @ shares
        return np.maximum(result[:-1].reshape(after[0].shape), 0.0), float(result[-1] / weight)


def _vector(state: tuple[Array, float], weight: float) -> Array:
    return np.append(state[0].ravel(), weight * state[1])

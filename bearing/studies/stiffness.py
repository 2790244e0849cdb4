"""Tangent stiffness of a bearing over speed.

The stiffness is that of the equilibrium at each speed: contact angles, ball loads and gyroscopic
friction change with it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array, Bearing
from ..operation import Model, Operation
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from ..rows import SINGLE, Row


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessOverSpeed:
    """Stiffness and place of the inner ring over its speed; NaN where there is no equilibrium.

    Attributes
    ----------
    speeds : ndarray, shape (n,)
        Of the inner ring [rad/s].
    matrices : ndarray, shape (n, 5, 5)
        d(load)/d(displacement) in the order x, y, z, tilt y, tilt z [N/m], [N/rad], [N m/rad].
    displacements : ndarray, shape (n, 5)
        [m], [rad].
    messages : tuple of str
        Of the speeds without an equilibrium.
    """

    speeds: Array
    matrices: Array
    displacements: Array
    messages: tuple[str, ...]

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Whether there is an equilibrium, shape (n,) [-]."""
        return np.asarray(np.isfinite(self.matrices).all(axis=(1, 2)))


def stiffness_over_speed(
    bearing: Bearing,
    operation: Operation,
    speeds: Sequence[float],
    model: Model | None = None,
    rows: Sequence[Row] = SINGLE,
    solve: Callable[..., QuasistaticSolution] = solve_quasistatic,
) -> StiffnessOverSpeed:
    """Stiffness at several speeds of the inner ring, all else as in the operation.

    `operation`: loads [N] or displacements [m]; its inner speed is replaced; `speeds` [rad/s];
    `solve`: finds the equilibrium; called as `solve_quasistatic`.
    """
    matrices = np.full((len(speeds), 5, 5), np.nan)
    places = np.full((len(speeds), 5), np.nan)
    near: QuasistaticSolution | None = None
    messages = []
    for index, speed in enumerate(speeds):
        at_speed = replace(operation, inner_speed=float(speed))
        found = solve(bearing, at_speed, model, initial_guess=near, rows=rows)
        if found.converged:
            matrices[index] = found.stiffness
            near = found
            places[index] = [*found.displacement, *found.tilt]
        else:
            messages.append(f"{speed * 30.0 / np.pi:.6g} r/min: {found.message}")
    return StiffnessOverSpeed(
        speeds=np.asarray(speeds, dtype=np.float64),
        matrices=matrices,
        displacements=places,
        messages=tuple(messages),
    )

"""Stiffness of a bearing over speed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import RPM

from ..geometry import SINGLE, Bearing, Row
from ..operation import Operation, QuasistaticModel
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessOverSpeed:
    """Stiffness and displacement of the inner ring over its speed; NaN without an equilibrium."""

    speeds: Array  # of the inner ring [rad/s], shape (n,)
    # d(load)/d(displacement) in the order x, y, z, tilt y, tilt z, shape (n, 5, 5)
    matrices: Array  # [N/m], [N/rad], [N m/rad]
    displacements: Array  # [m], [rad], shape (n, 5)
    messages: tuple[str, ...]  # of the speeds without an equilibrium

    @property
    def converged(self) -> NDArray[np.bool_]:
        """True for the speeds with an equilibrium, shape (n,) [-]."""
        return np.asarray(np.isfinite(self.matrices).all(axis=(1, 2)))


def stiffness_over_speed(
    bearing: Bearing,
    operation: Operation,
    speeds: Sequence[float],
    model: QuasistaticModel | None = None,
    rows: Sequence[Row] = SINGLE,
    solve: Callable[..., QuasistaticSolution] = solve_quasistatic,
) -> StiffnessOverSpeed:
    """Stiffness at several speeds of the inner ring, all else as in the operation.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        loads; its inner speed is replaced
    speeds : Sequence[float]
        speeds of the inner ring, shape (n,) [rad/s]
    model : QuasistaticModel | None, optional
        assumptions of the equilibrium
    rows : Sequence[Row], default SINGLE
        rows of balls on the inner ring
    solve : Callable[..., QuasistaticSolution], default solve_quasistatic
        called as `solve_quasistatic`

    Returns
    -------
    StiffnessOverSpeed
        stiffness and displacement over speed, NaN without an equilibrium
    """
    matrices = np.full((len(speeds), 5, 5), np.nan)
    displacements = np.full((len(speeds), 5), np.nan)
    last: QuasistaticSolution | None = None
    messages = []
    for index, speed in enumerate(speeds):
        at_speed = replace(operation, inner_speed=float(speed))
        solution = solve(bearing, at_speed, model, initial_guess=last, rows=rows)
        if solution.converged:
            matrices[index] = solution.stiffness
            displacements[index] = [*solution.displacement, *solution.tilt]
            last = solution
        else:
            messages.append(f"{speed / RPM:.6g} r/min: {solution.message}")
    return StiffnessOverSpeed(
        speeds=np.asarray(speeds, dtype=np.float64),
        matrices=matrices,
        displacements=displacements,
        messages=tuple(messages),
    )

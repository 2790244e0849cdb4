"""Tangent stiffness of a bearing over speed, and as a bearing element of the rotor code ROSS.

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

# ROSS' x, y, z (z along the shaft) in ours
ROSS_AXES = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])


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

    Parameters
    ----------
    bearing : Bearing
    operation : Operation
        Loads [N] or displacements [m]; its inner speed is replaced.
    speeds : sequence of float
        [rad/s].
    model : Model, optional
    rows : sequence of Row, optional
    solve : callable, optional
        Finds the equilibrium; called as `solve_quasistatic`.

    Returns
    -------
    StiffnessOverSpeed
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


def ross_table(study: StiffnessOverSpeed, damping: float = 0.0) -> dict[str, Array]:
    """Keyword arguments of ROSS' BearingElement over speed, but for its node n.

    ROSS has z along the shaft; its x and y are our -z and y (a turn of the frame, right-handed in
    both). Its element has the 2 x 2 block of the lateral directions and the axial stiffness; tilt
    and what couples axial to lateral are left out: the block is the stiffness with x and the tilts
    held.

    Parameters
    ----------
    study : StiffnessOverSpeed
        Speeds without an equilibrium are left out.
    damping : float
        Viscous, in x, y and z alike, which the equilibrium does not know [N s/m].

    Returns
    -------
    dict of ndarray, shape (n,)
        frequency [rad/s]; kxx, kxy, kyx, kyy, kzz [N/m]; cxx, cxy, cyx, cyy, czz [N s/m].
    """
    if not damping >= 0.0:
        raise ValueError(f"damping must not be negative, got {damping!r} N s/m")
    kept = study.converged
    turned = ROSS_AXES @ study.matrices[kept][:, :3, :3] @ ROSS_AXES.T
    size = int(kept.sum())
    stiffness = {"kxx": (0, 0), "kxy": (0, 1), "kyx": (1, 0), "kyy": (1, 1), "kzz": (2, 2)}
    table = {"frequency": study.speeds[kept]}
    table |= {name: turned[:, i, j] for name, (i, j) in stiffness.items()}
    return table | {
        name.replace("k", "c"): np.full(size, damping if i == j else 0.0)
        for name, (i, j) in stiffness.items()
    }

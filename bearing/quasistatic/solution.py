"""Result of the quasi-static equilibrium of a bearing."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..geometry import Array, Bearing
from ..operation import Model, Operation
from ..rows import Row


@dataclass(frozen=True, slots=True, kw_only=True)
class QuasistaticSolution:
    """Equilibrium of a bearing; arrays have one entry a ball, row by row.

    Attributes
    ----------
    bearing, operation, model : Bearing, Operation, Model
        What was solved.
    displacement, tilt : ndarray, shape (3,) and (2,)
        Of the inner ring, from facing, concentric grooves [m], [rad].
    ring_force, ring_moment : ndarray, shape (3,) and (2,)
        External force (x, y, z) [N] and moment (y, z) [N m] that hold the inner ring.
    stiffness : ndarray, shape (5, 5)
        Change of that load with (x, y, z, tilt y, tilt z) [N/m], [N/rad], [N m/rad].
    azimuth : ndarray
        [rad].
    inner_load, outer_load : ndarray
        Contact loads [N].
    inner_contact_angle, outer_contact_angle : ndarray
        [rad]; where the inner contact is unloaded, the direction towards the inner groove's
        centre.
    ball_axial, ball_radial : ndarray
        Position of the ball centres along the axis and from it [m]; a single row counts from the
        middle of its outer groove, rows count from the point about which moments count.
    centrifugal_force : ndarray
        [N].
    gyroscopic_moment : ndarray
        [N m].
    orbit_speed, spin_speed : ndarray
        Of the ball centre about the axis, and of the ball about its own in the frame of the orbit
        [rad/s].
    attitude : ndarray
        Angle beta of the spin axis [rad].
    pivot_speed : ndarray
        Of the ball about the tangent of its orbit, by which it gives way to the gyroscopic couple
        [rad/s].
    inner_friction, outer_friction : ndarray
        Of the races on the ball across the rolling direction, positive as those that hold a
        positive gyroscopic couple [N].
    inner_drive : ndarray
        Friction of the ball on the inner ring along the tangent of the orbit; not asked for under
        a hypothesis [N].
    cage_driven : ndarray of bool
        In traction equilibrium: loaded at the inner race, which cannot drive it, so that the cage
        does.
    cage_speed : float
        Mean orbit speed of the balls loaded at the inner race, of all balls where there are none
        [rad/s].
    residual : float
        Largest residual of ring (over the largest load) and of balls (over their forces) [-].
    iterations : int
    converged : bool
    message : str
    rows : tuple of Row
    row_load : ndarray, shape (rows, 5)
        What each row holds of the external load [N], [N m].
    """

    bearing: Bearing
    operation: Operation
    model: Model
    displacement: Array
    tilt: Array
    ring_force: Array
    ring_moment: Array
    stiffness: Array
    azimuth: Array
    inner_load: Array
    outer_load: Array
    inner_contact_angle: Array
    outer_contact_angle: Array
    ball_axial: Array
    ball_radial: Array
    centrifugal_force: Array
    gyroscopic_moment: Array
    orbit_speed: Array
    spin_speed: Array
    attitude: Array
    pivot_speed: Array
    inner_friction: Array
    outer_friction: Array
    inner_drive: Array
    cage_driven: NDArray[np.bool_]
    cage_speed: float
    residual: float
    iterations: int
    converged: bool
    message: str
    rows: tuple[Row, ...]
    row_load: Array

    @property
    def row_of_ball(self) -> NDArray[np.int64]:
        """Number of each ball's row, from 0, shape (N,) [-]."""
        return np.repeat(np.arange(len(self.rows)), self.bearing.balls)

    def row(self, index: int) -> "QuasistaticSolution":
        """One row alone, index from 0: its balls, what it holds of the load, its own cage speed
        [rad/s].
        """
        part = slice(index * self.bearing.balls, (index + 1) * self.bearing.balls)
        arrays = {name: getattr(self, name)[part] for name in BALL_ARRAYS}
        return replace(
            self,
            **arrays,
            rows=(self.rows[index],),
            row_load=self.row_load[index : index + 1],
            ring_force=self.row_load[index, :3],
            ring_moment=self.row_load[index, 3:],
            cage_speed=_cage_speed(arrays["orbit_speed"], arrays["inner_load"]),
        )


BALL_ARRAYS = (
    "azimuth",
    "inner_load",
    "outer_load",
    "inner_contact_angle",
    "outer_contact_angle",
    "ball_axial",
    "ball_radial",
    "centrifugal_force",
    "gyroscopic_moment",
    "orbit_speed",
    "spin_speed",
    "attitude",
    "pivot_speed",
    "inner_friction",
    "outer_friction",
    "inner_drive",
    "cage_driven",
)


def _cage_speed(orbit: Array, inner_load: Array) -> float:
    """Mean orbit speed of the balls loaded at the inner race, of all balls where there are none
    [rad/s].
    """
    loaded = inner_load > 0.0
    return float(np.mean(orbit[loaded] if loaded.any() else orbit))

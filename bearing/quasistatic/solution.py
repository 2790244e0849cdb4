"""Result of the quasi-static equilibrium of a bearing, and the characteristic frequencies of its
motion.
"""

from dataclasses import dataclass, replace
from math import cos, pi
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si, notebook_html

from ..geometry import Bearing, Row
from ..operation import Operation, QuasistaticModel

Values = TypeVar("Values", float, NDArray[np.float64])


@dataclass(frozen=True, slots=True, kw_only=True)
class QuasistaticSolution:
    """Equilibrium of a bearing; arrays have one entry a ball, row by row."""

    bearing: Bearing
    operation: Operation
    model: QuasistaticModel
    # inner ring, from facing, concentric grooves
    displacement: Array  # (3,) [m]
    tilt: Array  # (2,) [rad]
    # external load that holds the inner ring
    ring_force: Array  # (3,) [N]
    ring_moment: Array  # (2,) about y and z [N m]
    # (5, 5) change of that load with (x, y, z, tilt y, tilt z) [N/m], [N/rad], [N m/rad]
    stiffness: Array
    azimuth: Array  # [rad]
    inner_load: Array  # [N]
    outer_load: Array  # [N]
    # for an unloaded inner contact, the direction towards the inner groove's centre
    inner_contact_angle: Array  # [rad]
    outer_contact_angle: Array  # [rad]
    # position of the ball centres: a single row counts from the middle of its outer groove, rows
    # from the point about which moments count
    ball_axial: Array  # along the axis [m]
    ball_radial: Array  # from the axis [m]
    centrifugal_force: Array  # [N]
    gyroscopic_moment: Array  # [N m]
    orbit_speed: Array  # of the ball centre about the axis [rad/s]
    spin_speed: Array  # of the ball about its own axis in the frame of the orbit [rad/s]
    attitude: Array  # angle beta of the spin axis [rad]
    pivot_speed: (
        Array  # of the ball about the tangent of its orbit, by the gyroscopic couple [rad/s]
    )
    # movement of the groove's centre at the ball, of rings that are elastic bodies, beyond Hertz'
    # approach; zero for the others
    inner_ring_axial: Array  # [m]
    inner_ring_radial: Array  # [m]
    outer_ring_axial: Array  # [m]
    outer_ring_radial: Array  # [m]
    # force of the races on the ball across the rolling direction, positive as those that balance a
    # positive gyroscopic couple
    inner_friction: Array  # [N]
    outer_friction: Array  # [N]
    # force of the ball on the inner ring along the tangent of the orbit; zero under a hypothesis
    inner_drive: Array  # [N]
    # in traction equilibrium: loaded at the inner race, which cannot drive it, so the cage does
    cage_driven: NDArray[np.bool_]
    # mean orbit speed of the balls loaded at the inner race, of all where there are none [rad/s]
    cage_speed: float
    residual: float  # of ring (over the largest load) and balls (over their forces), largest [-]
    iterations: int
    converged: bool
    message: str
    rows: tuple[Row, ...]
    row_load: Array  # (rows, 5) what each row holds of the external load [N], [N m]

    @property
    def row_of_ball(self) -> NDArray[np.int64]:
        """Number of each ball's row, from 0, shape (N,) [-]."""
        return np.repeat(np.arange(len(self.rows)), self.bearing.balls)

    def row(self, index: int) -> "QuasistaticSolution":
        """One row alone, with its balls, its fraction of the load and its own cage speed.

        Parameters
        ----------
        index : int
            number of the row, from 0 [-]

        Returns
        -------
        QuasistaticSolution
            solution of this row
        """
        balls = slice(index * self.bearing.balls, (index + 1) * self.bearing.balls)
        arrays = {name: getattr(self, name)[balls] for name in BALL_ARRAYS}
        return replace(
            self,
            **arrays,
            rows=(self.rows[index],),
            row_load=self.row_load[index : index + 1],
            ring_force=self.row_load[index, :3],
            ring_moment=self.row_load[index, 3:],
            cage_speed=_cage_speed(arrays["orbit_speed"], arrays["inner_load"]),
        )

    def _repr_html_(self) -> str:
        """Ring and balls, for a notebook."""
        names = ("azimuth", "inner_load", "outer_load", "inner_contact_angle")
        keys = ("azimuth_deg", "inner_load_N", "outer_load_N", "inner_angle_deg")
        columns: dict[str, Any] = {"ball": [str(k + 1) for k in range(self.azimuth.size)]}
        columns |= {key: getattr(self, name) for key, name in zip(keys, names, strict=True)}
        columns |= {"outer_angle_deg": self.outer_contact_angle, "spin_rpm": self.spin_speed}
        x, y, z = (from_si("shift_um", self.displacement)).tolist()
        facts = {
            "displacement": f"x {x:.4g}, y {y:.4g}, z {z:.4g} µm",
            "axial_stiffness_N_um": self.stiffness[0, 0],
            "radial_stiffness_N_um": self.stiffness[1, 1],
            "cage_speed_rpm": self.cage_speed,
            "balls loaded": f"{int((self.inner_load > 0.0).sum())} of {self.azimuth.size}",
            "residual": f"{self.residual:.1e} after {self.iterations} iterations",
            "converged": f"{self.converged}" + ("" if self.converged else f": {self.message}"),
        }
        return notebook_html("Equilibrium of the bearing", facts, columns)


BALL_ARRAYS = tuple(
    (
        "azimuth inner_load outer_load inner_contact_angle outer_contact_angle ball_axial "
        "ball_radial centrifugal_force gyroscopic_moment orbit_speed spin_speed attitude "
        "inner_ring_axial inner_ring_radial outer_ring_axial outer_ring_radial pivot_speed "
        "inner_friction outer_friction inner_drive cage_driven"
    ).split()
)


def _cage_speed(orbit: Array, inner_load: Array) -> float:
    """Mean orbit speed of the balls loaded at the inner race, of all balls where there are none
    [rad/s].
    """
    loaded = inner_load > 0.0
    return float(np.mean(orbit[loaded] if loaded.any() else orbit))


@dataclass(frozen=True, slots=True, kw_only=True)
class Frequencies:
    """Frequencies of cage, ball passage and ball spin, never negative."""

    cage: float  # rotation of the cage [Hz]
    ball_pass_outer: float  # balls that pass a point of the outer ring [Hz]
    ball_pass_inner: float  # and of the inner ring [Hz]
    ball_spin: float  # rotation of a ball about its own axis in the frame of the cage [Hz]


def bearing_frequencies(solution: QuasistaticSolution) -> Frequencies:
    """Frequencies from the cage speed and the mean spin of the loaded balls.

    At the operating contact angles; Harris and Kotzalas (Essential Concepts).

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Frequencies
        frequencies [Hz]

    Examples
    --------
    >>> from oilfilm.bearing import Operation, bearing_frequencies, load_bearing, solve_quasistatic
    >>> operation = Operation(inner_speed=300.0, force=(0.0, 1000.0, 0.0))
    >>> solution = solve_quasistatic(load_bearing("6208"), operation)
    >>> f"{bearing_frequencies(solution).ball_pass_outer:.1f} Hz"
    '171.9 Hz'
    """
    operation = solution.operation
    loaded = solution.inner_load > 0.0
    spin = float(np.mean(solution.spin_speed[loaded] if loaded.any() else solution.spin_speed))
    cage = solution.cage_speed
    balls = solution.bearing.balls
    return Frequencies(
        cage=abs(cage) / (2.0 * pi),
        ball_pass_outer=balls * abs(cage - operation.outer_speed) / (2.0 * pi),
        ball_pass_inner=balls * abs(operation.inner_speed - cage) / (2.0 * pi),
        ball_spin=abs(spin) / (2.0 * pi),
    )


def kinematic_cage_speed(bearing: Bearing, inner: float, outer: float, angle: float) -> float:
    """Speed of the cage without sliding, `cage_speed_without_slip`.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    inner, outer : float
        speeds of the rings [rad/s] or [Hz]
    angle : float
        contact angle [rad]

    Returns
    -------
    float
        speed of the cage, in the unit of the rings' speeds [rad/s] or [Hz]
    """
    gamma = bearing.ball_diameter / bearing.pitch_diameter * cos(angle)
    return cage_speed_without_slip(gamma, inner, outer)


def cage_speed_without_slip(gamma: Values, inner: Values, outer: Values) -> Values:
    """Cage speed (1 - g) inner/2 + (1 + g) outer/2, Harris and Kotzalas (Essential Concepts).

    Parameters
    ----------
    gamma : Values
        g = (D/d_m) cos(contact angle) [-]
    inner, outer : Values
        speeds of the rings [rad/s] or [Hz]

    Returns
    -------
    Values
        speed of the cage, in the unit of the rings' speeds [rad/s] or [Hz]
    """
    return 0.5 * ((1.0 - gamma) * inner + (1.0 + gamma) * outer)


def ball_spin_without_slip(
    diameter_ratio: float, gamma: Values, inner: Values, outer: Values
) -> Values:
    """Spin |inner - outer| (d_m/D) (1 - g^2)/2 of a ball in the frame of the cage.

    About its own axis; Harris and Kotzalas (Essential Concepts).

    Parameters
    ----------
    diameter_ratio : float
        D/d_m [-]
    gamma : Values
        g = (D/d_m) cos(contact angle) [-]
    inner, outer : Values
        speeds of the rings [rad/s] or [Hz]

    Returns
    -------
    Values
        speed of the spin, in the unit of the rings' speeds [rad/s] or [Hz]
    """
    return 0.5 * abs(inner - outer) / diameter_ratio * (1.0 - gamma**2)


def kinematic_frequencies(
    bearing: Bearing, operation: Operation, contact_angle: float
) -> Frequencies:
    """Frequencies of rolling at a nominal contact angle, independent of the loads, as in
    catalogues.

    Harris and Kotzalas (Essential Concepts). Cage: `kinematic_cage_speed`; ball:
    `ball_spin_without_slip`. `bearing_frequencies` differs from them as the contact angles do in
    operation.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    operation : Operation
        speeds of the rings
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    Frequencies
        frequencies [Hz]
    """
    inner = operation.inner_speed / (2.0 * pi)
    outer = operation.outer_speed / (2.0 * pi)
    cage = kinematic_cage_speed(bearing, inner, outer, contact_angle)
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    return Frequencies(
        cage=abs(cage),
        ball_pass_outer=bearing.balls * abs(cage - outer),
        ball_pass_inner=bearing.balls * abs(inner - cage),
        ball_spin=ball_spin_without_slip(ratio, ratio * cos(contact_angle), inner, outer),
    )

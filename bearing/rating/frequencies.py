"""Characteristic frequencies of a bearing from its solved motion."""

from dataclasses import dataclass
from math import cos, pi
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..geometry import Bearing
from ..operation import Operation
from ..quasistatic.solution import QuasistaticSolution

Values = TypeVar("Values", float, NDArray[np.float64])


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

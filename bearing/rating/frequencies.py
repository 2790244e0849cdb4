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
    """Frequencies [Hz] from the cage speed and the mean spin of the loaded balls, at the operating
    contact angles; Harris and Kotzalas (Essential Concepts).
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
    """Speed of the cage without sliding, all speeds in [rad/s] or [Hz], from those of the rings
    and the contact angle [rad]; `cage_speed_without_slip`.
    """
    gamma = bearing.ball_diameter / bearing.pitch_diameter * cos(angle)
    return cage_speed_without_slip(gamma, inner, outer)


def cage_speed_without_slip(gamma: Values, inner: Values, outer: Values) -> Values:
    """(1 - g) inner/2 + (1 + g) outer/2, g = (D/d_m) cos a, from the speeds of the rings, in their
    unit; Harris and Kotzalas (Essential Concepts).
    """
    return 0.5 * ((1.0 - gamma) * inner + (1.0 + gamma) * outer)


def ball_spin_without_slip(
    diameter_ratio: float, gamma: Values, inner: Values, outer: Values
) -> Values:
    """|inner - outer| (d_m/D) (1 - g^2)/2, of a ball about its own axis in the frame of the cage,
    from D/d_m [-], g = (D/d_m) cos a [-] and the speeds of the rings, in their unit; Harris and
    Kotzalas (Essential Concepts).
    """
    return 0.5 * abs(inner - outer) / diameter_ratio * (1.0 - gamma**2)


def kinematic_frequencies(
    bearing: Bearing, operation: Operation, contact_angle: float
) -> Frequencies:
    """Frequencies [Hz] of rolling at a nominal contact angle [rad], whatever the loads, as in
    catalogues; Harris and Kotzalas (Essential Concepts).

    Cage: `kinematic_cage_speed`; ball: `ball_spin_without_slip`. `bearing_frequencies` differs
    from them as the contact angles do in operation.
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

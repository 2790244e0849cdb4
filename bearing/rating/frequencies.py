"""Characteristic frequencies of a bearing from its solved motion."""

from dataclasses import dataclass
from math import cos, pi

import numpy as np

from ..geometry import Bearing
from ..operation import Operation
from ..quasistatic.solution import QuasistaticSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class Frequencies:
    """Frequencies of cage, ball passage and ball spin, never negative."""

    cage: float  # rotation of the cage [Hz]
    ball_pass_outer: float  # balls that pass a point of the outer ring [Hz]
    ball_pass_inner: float  # and of the inner ring [Hz]
    ball_spin: float  # rotation of a ball about its own axis in the frame of the cage [Hz]


def bearing_frequencies(solution: QuasistaticSolution) -> Frequencies:
    """Frequencies at the operating contact angles, Harris and Kotzalas (Essential Concepts).

    `solution`: speeds in [rad/s].

    In [Hz], from the cage speed and the mean spin of the loaded balls.
    """
    operation = solution.operation
    balls = solution.bearing.balls
    loaded = solution.inner_load > 0.0
    spin = float(np.mean(solution.spin_speed[loaded] if loaded.any() else solution.spin_speed))
    cage = solution.cage_speed
    return Frequencies(
        cage=abs(cage) / (2.0 * pi),
        ball_pass_outer=balls * abs(cage - operation.outer_speed) / (2.0 * pi),
        ball_pass_inner=balls * abs(operation.inner_speed - cage) / (2.0 * pi),
        ball_spin=abs(spin) / (2.0 * pi),
    )


def kinematic_frequencies(
    bearing: Bearing, operation: Operation, contact_angle: float
) -> Frequencies:
    """Frequencies of rolling at a nominal contact angle, whatever the loads; Harris and Kotzalas
    (Essential Concepts).

    With g = (D/d_m) cos(alpha): cage [n_i (1 - g) + n_o (1 + g)]/2, ball |n_i - n_o| (d_m/D) (1 -
    g^2)/2. These are the values of catalogues; `bearing_frequencies` differs from them as the
    contact angles do in operation.

    `operation`: speeds of the rings in [rad/s]; `contact_angle`: nominal [rad].
    """
    inner, outer = operation.inner_speed / (2.0 * pi), operation.outer_speed / (2.0 * pi)
    gamma = bearing.ball_diameter / bearing.pitch_diameter * cos(contact_angle)
    cage = 0.5 * (inner * (1.0 - gamma) + outer * (1.0 + gamma))
    return Frequencies(
        cage=abs(cage),
        ball_pass_outer=bearing.balls * abs(cage - outer),
        ball_pass_inner=bearing.balls * abs(inner - cage),
        ball_spin=0.5
        * abs(inner - outer)
        * bearing.pitch_diameter
        / bearing.ball_diameter
        * (1.0 - gamma**2),
    )

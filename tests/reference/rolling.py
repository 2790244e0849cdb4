"""Rolling and spin of a ball on a race by the scalar formulas of the handbook."""

from __future__ import annotations

import numpy as np

from oilfilm.bearing.geometry import Race
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution


def rolling_and_spin(solution: QuasistaticSolution, index: int, race: Race) -> tuple[float, float, float]:
    """Motion of ball against race at a contact (Harris and Kotzalas, re-derived).

    Parameters
    ----------
    solution : QuasistaticSolution
    index : int
        Of the ball, from 0.
    race : Race

    Returns
    -------
    speed : float
        Surface speed of the race at the contact's centre in the frame of the orbit, along +e_t
        [m/s]; under a hypothesis that of the ball as well.
    rolling : float
        Relative angular speed about the transverse direction, magnitude [rad/s].
    spin : float
        Angular speed of the ball relative to the race about the normal into the race [rad/s].
    """
    bearing, operation = solution.bearing, solution.operation
    inner = race is Race.INNER
    angle = float((solution.inner_contact_angle if inner else solution.outer_contact_angle)[index])
    side = -1.0 if inner else 1.0  # the outer contact is farther from the axis than the ball
    relative = (operation.inner_speed if inner else operation.outer_speed) - float(solution.orbit_speed[index])
    radius = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter * np.cos(angle))
    ball = float(solution.spin_speed[index])
    lag = float(solution.attitude[index]) - angle
    spin = side * (ball * np.sin(lag) - relative * np.sin(angle)) + 0.0  # no negative zero
    rolling = abs(ball * np.cos(lag) + relative * np.cos(angle))
    return float(relative * radius), float(rolling), float(spin)

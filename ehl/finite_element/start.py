"""Initial state of Newton's method: pressure and film of another solution, or Hertz."""

from collections.abc import Callable
from math import cos, sin

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ..arrays import Array
from ..scaling import ScaledContact
from ..solution import ContactSolution
from .newton import Level

Start = Callable[[Array, Array], tuple[Array, Array]]  # pressure and film at X, Y [-]

SMALLEST_FILM = 0.05  # of the film guess, where the start has none


def hertz_start(contact: ScaledContact) -> Start:
    """Initial state by Hertz: his pressure, and a film of the guessed thickness in the ellipse.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """

    def start(x: Array, y: Array) -> tuple[Array, Array]:
        P = contact.dry_pressure(x, y)
        across = y / contact.half_extent_y
        outside = np.maximum(0.0, np.hypot(x / contact.half_extent_x, across) - 1.0)
        return P, contact.film_guess + contact.gap(x, y) * np.minimum(1.0, outside) ** 1.5

    return start


def start_from_level(level: Level) -> Start:
    """Initial state from the solution on another mesh in the same frame, bilinear between its
    nodes.

    Parameters
    ----------
    level : Level
        the other mesh and its state

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """
    P, H = (_bilinear(level.X, level.Y, f.reshape(level.shape)) for f in (level.P, level.H))
    return lambda x, y: (P(x, y), H(x, y))


def start_from_solution(contact: ScaledContact, solution: ContactSolution) -> Start:
    """Initial state from a solution whose frame may be rotated, bilinear between its nodes.

    The pressure outside its box is zero.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    solution : ContactSolution
        another solution of the same contact

    Returns
    -------
    Start
        function of X and Y; it returns P and H [-]
    """
    turn = contact.frame_angle - solution.frame_angle
    c, s = cos(turn), sin(turn)
    P, H = (_bilinear(solution.X, solution.Y, f) for f in (solution.P, solution.H))
    least = SMALLEST_FILM * contact.film_guess
    ends = [(line[0], line[-1]) for line in (solution.X, solution.Y)]

    def start(x: Array, y: Array) -> tuple[Array, Array]:
        x, y = c * x - s * y, s * x + c * y
        outside = (x < ends[0][0]) | (x > ends[0][1]) | (y < ends[1][0]) | (y > ends[1][1])
        return np.where(outside, 0.0, np.maximum(P(x, y), 0.0)), np.maximum(H(x, y), least)

    return start


def _bilinear(X: Array, Y: Array, values: Array) -> Callable[[Array, Array], Array]:
    """Bilinear between nodes, continued outside."""
    inside = RegularGridInterpolator((X, Y), values, bounds_error=False, fill_value=None)
    return lambda x, y: np.asarray(inside(np.stack((x, y), axis=-1)))

"""Conductance of heat from a film into two bodies."""

from math import gamma, pi

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ..arrays import Array
from ._kernels import marched_sums
from .heat import SolidThermal, history_weights

# B(1/2, 5/4), from the integral of sqrt(w) across an ellipse [-]
BETA = gamma(0.5) * gamma(1.25) / gamma(1.75)


def spot_conductance(
    along: float, across: float, first: SolidThermal, second: SolidThermal
) -> float:
    """Conductance of an isothermal elliptic spot between two half-spaces at rest.

    Parameters
    ----------
    along : float
        semi-axis along rolling [m]
    across : float
        semi-axis across [m]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    float
        conductance [W/K]
    """
    short, long = sorted((along, across))
    resistance = 1.0 / first.conductivity + 1.0 / second.conductivity
    integral = float(scipy.special.ellipk(1.0 - (short / long) ** 2))
    return 2.0 * pi * long / (resistance * integral)


def moving_speed(
    speed: float, semi_axes: tuple[float, float], first: SolidThermal, second: SolidThermal
) -> float:
    """Speed with a contribution of bodies at rest: at rest the contact conducts like a spot.

    Parameters
    ----------
    speed : float
        of rolling [m/s]
    semi_axes : tuple[float, float]
        along rolling and across it [m]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    float
        effective speed [m/s]
    """
    along, across = semi_axes
    spot = spot_conductance(along, across, first, second)
    per_root = spot / (2.0 * _joint(first, second) * across * BETA)
    return abs(speed) + 0.5 * pi / along * per_root**2


def marched_conductance(
    speed: float, x: Array, y: Array, film: Array, first: SolidThermal, second: SolidThermal
) -> float:
    """Conductance G of a contact whose film varies.

    Parameters
    ----------
    speed : float
        effective speed by `moving_speed` [m/s]
    x : Array
        evenly spaced nodes along rolling, shape (nx,) [m]
    y : Array
        evenly spaced nodes across, shape (ny,) [m]
    film : Array
        H, shape (nx, ny), zero outside the contact [W/(m^2 K)]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    float
        G [W/K]
    """
    step = float(x[1] - x[0])
    rates = np.full(y.size, history_rate(speed, step, first, second))
    return float(marched_flux(film, rates).sum() * step * (y[1] - y[0]))


def history_rate(
    speed: ArrayLike, step: ArrayLike, first: SolidThermal, second: SolidThermal
) -> Array:
    """Factor on H and the sum of the history on lines along rolling.

    Parameters
    ----------
    speed : ArrayLike
        effective speed by `moving_speed`, any shape [m/s]
    step : ArrayLike
        distance of the nodes, a shape that broadcasts with `speed` [m]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    Array
        factor, the common shape [m^2 K/W]
    """
    return np.sqrt(step) / (np.sqrt(pi * np.asarray(speed)) * _joint(first, second))


def marched_flux(film: Array, rates: Array) -> Array:
    """Sum of q over the nodes of lines along rolling.

    Parameters
    ----------
    film : Array
        H, shape (nx, n), zero outside the contact [W/(m^2 K)]
    rates : Array
        `history_rate` of each line, shape (n,) [m^2 K/W]

    Returns
    -------
    Array
        sum for a unit difference of temperature, shape (n,) [W/(m^2 K)]
    """
    film = np.ascontiguousarray(film)
    sums = np.empty(film.shape[1])
    weights = history_weights(film.shape[0], 1.0)
    marched_sums(film, rates, weights, np.empty_like(film), sums)
    return sums


def _joint(first: SolidThermal, second: SolidThermal) -> float:
    """e_1 e_2/(e_1 + e_2) [W s^0.5/(m^2 K)]."""
    e = first.effusivity, second.effusivity
    return e[0] * e[1] / (e[0] + e[1])

r"""Bodies as half-spaces: their temperature as they move past the heat that they take up, and the
heat that a rolling contact conducts from one to the other.

A body that moves at u past a heat flux q(x) into its surface takes, where u is fast against its
diffusivity over the contact's length, the temperature (Carslaw and Jaeger, 1959)

    T(x) = T_b + 1/(sqrt(pi u) e) int_(-inf)^x q(x') dx'/sqrt(x - x'),

e = sqrt(k rho c) its effusivity; upstream is where it comes from. The slower it moves the less
that holds: the formula has u + (4/pi) 2 kappa/a for u, which gives the largest temperature
of a uniformly heated circle of radius a at rest, q a/k, as well as at speed (as Tian and Kennedy,
1994, interpolate). Heat that spreads at right angles to the motion is neglected otherwise.

Between the bodies each strip of the surfaces meets the other body for the time t = w(y)/u, w its
length along rolling and u the rolling speed, through a film of the conductance H = k_f/h per area.
Two half-spaces of effusivities e_1, e_2 that are brought together at t = 0 through H exchange, per
area and kelvin,

.. math:: E(t) = \frac{H}{\beta^2} \left[ e^{\beta^2 t} \mathrm{erfc}(\beta \sqrt t) - 1
          + 2 \beta \sqrt{t/\pi} \right], \qquad \beta = H (1/e_1 + 1/e_2)

(one-dimensional conduction, Carslaw and Jaeger, 1959, section 2.9 for one body), so that a contact
of semi-axes b along rolling and a across it conducts

.. math:: G = u \int_{-a}^{a} E(w(y)/u)\, dy, \qquad w = 2 b \sqrt{1 - y^2/a^2}

It holds where the heat does not get far during the passage, u b/(2 kappa) >> 1. At slower motion u
has a contribution of bodies at rest added that makes G of a contact at rest without a film the
conductance of an isothermal spot, 1/G = (1/k_1 + 1/k_2) K(m)/(2 pi a), m = 1 - b^2/a^2.

Over a film whose H varies, each line is marched along rolling,

.. math:: q(x) = H(x) \left[ 1 - \frac{1/e_1 + 1/e_2}{\sqrt{\pi u}}
          \int_{-\infty}^{x} \frac{q(x')\, dx'}{\sqrt{x - x'}} \right]
"""

from dataclasses import dataclass
from math import gamma, pi, sqrt

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ..arrays import Array
from ..options import require_positive
from ._kernels import marched_sums

SERIES_BELOW = 1.0e-2  # of beta sqrt(t), where the closed form cancels [-]
LINES = 32  # of Gauss and Legendre across the ellipse [-]; 64 change G by 1e-9
# B(1/2, 5/4), from the integral of sqrt(w) across an ellipse [-]
BETA = gamma(0.5) * gamma(1.25) / gamma(1.75)


@dataclass(frozen=True, slots=True, kw_only=True)
class SolidThermal:
    """Thermal properties of a body and its temperature away from the contact, SI."""

    conductivity: float  # k [W/(m K)]
    density: float  # rho [kg/m^3]
    specific_heat: float  # c [J/(kg K)]
    temperature: float | None = None  # T_b, away from the contact [K]; None: that of the oil

    def __post_init__(self) -> None:
        require_positive(self, "conductivity", "density", "specific_heat")
        if self.temperature is not None:
            require_positive(self, "temperature")

    @property
    def effusivity(self) -> float:
        """sqrt(k rho c) [W s^0.5/(m^2 K)]."""
        return sqrt(self.conductivity * self.density * self.specific_heat)

    @property
    def diffusivity(self) -> float:
        """Kappa = k/(rho c) [m^2/s]."""
        return self.conductivity / (self.density * self.specific_heat)


def response_factor(speed: Array, solid: SolidThermal, radius: float) -> Array:
    """Temperature response 1/(sqrt(pi u) e) of a moving half-space.

    Parameters
    ----------
    speed : Array
        u of the surface, to which a contribution of a body at rest is added, any shape [m/s]
    solid : SolidThermal
        properties of the body
    radius : float
        half the length of the heated area along the speed [m]

    Returns
    -------
    Array
        factor, shape of `speed` [K m^1.5/W]
    """
    moving = np.abs(speed) + 8.0 / pi * solid.diffusivity / radius
    return 1.0 / (np.sqrt(pi * moving) * solid.effusivity)


def history_weights(count: int, mesh: float) -> Array:
    """Weights w_d of int q dx'/sqrt(x - x') = sum of w_d q(x - d mesh), q linear between nodes.

    Product integration: w_0 = (4/3) sqrt(mesh), w_d = (4/3) sqrt(mesh) [(d + 1)^1.5 - 2 d^1.5 + (d
    - 1)^1.5].

    Parameters
    ----------
    count : int
        number of weights
    mesh : float
        distance of the nodes [m]

    Returns
    -------
    Array
        w_d, shape (count,) [m^0.5]
    """
    d = np.arange(count, dtype=np.float64)
    weights = (d + 1.0) ** 1.5 - 2.0 * d**1.5 + np.abs(d - 1.0) ** 1.5
    weights[0] = 1.0
    return 4.0 / 3.0 * np.sqrt(mesh) * weights


def exchanged_heat(time: ArrayLike, film: float, first: float, second: float) -> Array:
    """Heat E(t) that two half-spaces exchange through a film, per area and kelvin.

    Parameters
    ----------
    time : ArrayLike
        of the contact, any shape [s]
    film : float
        conductance H of the film [W/(m^2 K)]
    first : float
        effusivity of the first body [W s^0.5/(m^2 K)]
    second : float
        effusivity of the second body [W s^0.5/(m^2 K)]

    Returns
    -------
    Array
        E, shape of `time` [J/(m^2 K)]
    """
    joint = first * second / (first + second)
    root = np.sqrt(np.asarray(time, dtype=np.float64))
    z = film / joint * root
    small = np.minimum(z, SERIES_BELOW)
    # z^2 - 4 z^3/(3 sqrt(pi)) + z^4/2 - 8 z^5/(15 sqrt(pi)) of the bracket
    cubic = 4.0 / (3.0 * np.sqrt(pi)) - 0.5 * small + 8.0 / (15.0 * np.sqrt(pi)) * small**2
    series = small**2 * (1.0 - small * cubic)
    closed = scipy.special.erfcx(z) - 1.0 + 2.0 * z / np.sqrt(pi)
    return np.asarray(joint**2 / film * np.where(z < SERIES_BELOW, series, closed))


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


def film_conductance(
    speed: float,
    semi_axes: tuple[float, float],
    film: float,
    first: SolidThermal,
    second: SolidThermal,
) -> float:
    """Conductance G of a contact with an even film.

    Parameters
    ----------
    speed : float
        of rolling [m/s]
    semi_axes : tuple[float, float]
        along rolling and across it [m]
    film : float
        H = k_f/h [W/(m^2 K)]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    float
        G [W/K]
    """
    along, across = semi_axes
    u = moving_speed(speed, semi_axes, first, second)
    nodes, weights = np.polynomial.legendre.leggauss(LINES)
    angle = 0.5 * pi * nodes  # y = a sin(angle)
    length = 2.0 * along * np.cos(angle)
    exchanged = exchanged_heat(length / u, film, first.effusivity, second.effusivity)
    dy = across * np.cos(angle) * 0.5 * pi * weights
    return float(u * (exchanged @ dy))


def bare_conductance(
    speed: float, semi_axes: tuple[float, float], first: SolidThermal, second: SolidThermal
) -> float:
    """Conductance G without a film, 2 e sqrt(2 b u/pi) a B(1/2, 5/4) with e = e_1 e_2/(e_1 + e_2).

    Parameters
    ----------
    speed : float
        of rolling [m/s]
    semi_axes : tuple[float, float]
        b along rolling and a across it [m]
    first : SolidThermal
        first body
    second : SolidThermal
        second body

    Returns
    -------
    float
        G [W/K]
    """
    along, across = semi_axes
    joint = _joint(first, second)
    return float(2.0 * joint * np.sqrt(2.0 * along * abs(speed) / pi) * across * BETA)


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

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
Each line is marched along rolling, by one-dimensional conduction in both bodies,

.. math:: q(x) = H(x) \left[ 1 - \frac{1/e_1 + 1/e_2}{\sqrt{\pi u}}
          \int_{-\infty}^{x} \frac{q(x')\, dx'}{\sqrt{x - x'}} \right]

It holds where the heat does not get far during the passage, u b/(2 kappa) >> 1. At slower motion u
has a contribution of bodies at rest added that makes G of a contact at rest without a film the
conductance of an isothermal spot, 1/G = (1/k_1 + 1/k_2) K(m)/(2 pi a), m = 1 - b^2/a^2.
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from ..arrays import Array
from ..options import require_positive


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

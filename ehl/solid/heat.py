"""Bodies as half-spaces that move past the heat they take up.

A body that moves at u past a heat flux q(x) into its surface takes, where u is fast against its
diffusivity over the contact's length, the temperature (Carslaw and Jaeger, 1959)

    T(x) = T_b + 1/(sqrt(pi u) e) int_(-inf)^x q(x') dx'/sqrt(x - x'),

e = sqrt(k rho c) its effusivity; upstream is where it comes from. The slower it moves the less
that holds: the formula has u + (4/pi) 2 kappa/a for u, which gives the largest temperature
of a uniformly heated circle of radius a at rest, q a/k, as well as at speed (as Tian and Kennedy,
1994, interpolate). Heat that spreads at right angles to the motion is neglected otherwise.
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from ..arrays import Array
from ..ranges import require_positive


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

"""Bodies as half-spaces that move past the heat they take up.

A body that moves at u past a heat flux q(x) into its surface takes, where u is fast against its
diffusivity over the contact's length, the temperature (Carslaw and Jaeger, 1959)

    T(x) = T_b + 1/(sqrt(pi u) e) int_(-inf)^x q(x') dx'/sqrt(x - x'),

e = sqrt(k rho c) its effusivity; upstream is where it comes from. The slower it moves the less
that holds: the formula has u + (4/pi) 2 kappa/a in place of u, which gives the largest temperature
of a uniformly heated circle of radius a at rest, q a/k, as well as at speed (as Tian and Kennedy,
1994, interpolate). Heat that spreads at right angles to the motion is left out otherwise.
"""

from dataclasses import dataclass
from math import isfinite, pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SolidThermal:
    """Thermal properties of a body and its temperature away from the contact, SI.

    Attributes
    ----------
    conductivity : float
        k [W/(m K)].
    density : float
        rho [kg/m^3].
    specific_heat : float
        c [J/(kg K)].
    temperature : float or None
        T_b, away from the contact [K]; None: that of the oil.
    """

    conductivity: float
    density: float
    specific_heat: float
    temperature: float | None = None

    def __post_init__(self) -> None:
        for field in ("conductivity", "density", "specific_heat"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if self.temperature is not None and not (
            isfinite(self.temperature) and self.temperature > 0.0
        ):
            raise ValueError(f"temperature must be positive and finite, got {self.temperature!r}")

    @property
    def effusivity(self) -> float:
        """sqrt(k rho c) [W s^0.5/(m^2 K)]."""
        return sqrt(self.conductivity * self.density * self.specific_heat)

    @property
    def diffusivity(self) -> float:
        """Kappa = k/(rho c) [m^2/s]."""
        return self.conductivity / (self.density * self.specific_heat)


def response_factor(speed: Array, solid: SolidThermal, radius: float) -> Array:
    """1/(sqrt(pi u) e), u the speed with the share of a body at rest [K m^1.5/W].

    Parameters
    ----------
    speed : ndarray
        Of the surface along the heat's line [m/s].
    solid : SolidThermal
    radius : float
        Half length of the heated area along it [m].
    """
    moving = np.abs(speed) + 8.0 / pi * solid.diffusivity / radius
    return 1.0 / (np.sqrt(pi * moving) * solid.effusivity)


def history_weights(count: int, mesh: float) -> Array:
    """Weights w_d of int q dx'/sqrt(x - x') = sum of w_d q(x - d mesh), q linear between nodes
    [m^0.5].

    Product integration: w_0 = (4/3) sqrt(mesh), w_d = (4/3) sqrt(mesh) [(d + 1)^1.5 - 2 d^1.5 + (d
    - 1)^1.5].

    Parameters
    ----------
    count : int
        Number of weights.
    mesh : float
        Distance of nodes [m].
    """
    d = np.arange(count, dtype=np.float64)
    weights = (d + 1.0) ** 1.5 - 2.0 * d**1.5 + np.abs(d - 1.0) ** 1.5
    weights[0] = 1.0
    return 4.0 / 3.0 * np.sqrt(mesh) * weights

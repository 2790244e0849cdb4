"""Conductivity and heat capacity of an oil under pressure and temperature, over those at ambient
pressure and the temperature of operation.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..ranges import require_finite, require_positive
from . import _kernels
from .free_volume import TaitVolume, relative_volume


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedHeat:
    """Constants of conductivity and heat capacity after Larsson and Andersson (2000).

    k = k_0 [1 + c_1 p/(1 + c_2 p)], rho c = (rho
    c)_0 [1 + a_1 p/(1 + a_2 p)] [1 + b (T - T_R)], b = b_0 (1 + b_1 p + b_2 p^2). Beyond the
    largest pressure and temperature of their data the values stay.
    """

    conductivity_1: float  # c_1 [1/Pa]
    conductivity_2: float  # c_2 [1/Pa]
    capacity_1: float  # a_1 [1/Pa]
    capacity_2: float  # a_2 [1/Pa]
    temperature_0: float  # b_0 [1/K]
    temperature_1: float  # b_1 [1/Pa]
    temperature_2: float  # b_2 [1/Pa^2]
    reference_temperature: float  # T_R [K]
    largest_pressure: float  # [Pa]
    largest_temperature: float  # [K]

    def __post_init__(self) -> None:
        require_positive(self, "conductivity_1", "conductivity_2", "capacity_1", "capacity_2")
        require_positive(self, "reference_temperature", "largest_pressure", "largest_temperature")
        require_finite(self, "temperature_0", "temperature_1", "temperature_2")


@dataclass(frozen=True, slots=True, kw_only=True)
class VolumeHeat:
    """Constants of conductivity and heat capacity after Habchi and Bair.

    k = B + C K^-s, K = (V/V_R) [1 - A (T/T_R) (V/V_R)^q], and
    rho c = C_0 + m (T/T_R) (V/V_R)^-4, with the volume of the oil's Tait law.
    """

    conductivity_base: float  # B [W/(m K)]
    conductivity_scale: float  # C [W/(m K)]
    conductivity_exponent: float  # s [-]
    scaling_factor: float  # A [-]
    scaling_exponent: float  # q [-]
    capacity_base: float  # C_0 [J/(m^3 K)]
    capacity_scale: float  # m [J/(m^3 K)]

    def __post_init__(self) -> None:
        require_positive(self, "conductivity_base", "conductivity_scale", "capacity_base")


CAPACITY_POWER = -4.0  # of the volume in rho c, Habchi and Bair [-]


def volume_heat(
    p: ArrayLike, temperature: ArrayLike, tait: TaitVolume, law: VolumeHeat
) -> tuple[Array, Array]:
    """Conductivity and heat capacity rho c of an oil by its volume, Habchi and Bair.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        a shape that broadcasts with `p` [K]
    tait : TaitVolume
        constants of the volume
    law : VolumeHeat
        constants of conductivity and capacity

    Returns
    -------
    conductivity
        k, the common shape [W/(m K)]
    capacity
        rho c, the common shape [J/(m^3 K)]
    """
    volume = relative_volume(p, temperature, tait)
    warm = np.asarray(temperature) / tait.reference_temperature
    k = _kernels.volume_conductivity(
        volume,
        warm,
        law.conductivity_base,
        law.conductivity_scale,
        law.conductivity_exponent,
        law.scaling_factor,
        law.scaling_exponent,
    )
    base, scale = law.capacity_base, law.capacity_scale
    capacity = _kernels.volume_capacity(volume, warm, base, scale, CAPACITY_POWER)
    return np.asarray(k), np.asarray(capacity)

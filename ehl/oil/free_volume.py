"""Oils by their volume: Tait's equation of state, Doolittle's free volume, Yasutomi's glass
temperature. The constants belong to one oil and come with a source: none has a default.
"""

from dataclasses import astuple, dataclass
from enum import Enum
from math import log

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..options import require_finite, require_positive
from . import _laws


@dataclass(frozen=True, slots=True, kw_only=True)
class TaitVolume:
    """Tait's equation of state, form of Dymond and Malhotra (1988), as in Bair (2007)."""

    bulk_modulus: float  # K_0, isothermal, at ambient pressure and the reference temperature [Pa]
    bulk_modulus_derivative: float  # K_0' = dK/dp at ambient pressure [-]
    reference_temperature: float  # T_R [K]
    bulk_modulus_temperature: float = 0.0  # b of K_0(T) = K_0 exp[-b (T - T_R)] [1/K]
    expansion: float = 0.0  # a of V_0(T) = V_R [1 + a (T - T_R)] at ambient pressure [1/K]

    def __post_init__(self) -> None:
        require_positive(self, "bulk_modulus", "bulk_modulus_derivative", "reference_temperature")
        require_finite(self, "bulk_modulus_temperature", "expansion")


@dataclass(frozen=True, slots=True, kw_only=True)
class DoolittleFreeVolume:
    """Constants of Doolittle's (1951) viscosity by free volume; the volume is Tait's."""

    factor: float  # B [-]
    # R, occupied over total volume at ambient pressure and Tait's reference temperature [-]
    occupied_share: float
    # e of V_occ(T) = V_occ [1 + e (T - T_R)] [1/K]; None: the constants hold at the temperature of
    # operation, and only the coefficient of viscosity and temperature of the oil varies it
    occupied_expansion: float | None = None

    def __post_init__(self) -> None:
        require_positive(self, "factor")
        if self.occupied_expansion is not None:
            require_finite(self, "occupied_expansion")
        r = self.occupied_share
        if not 0.0 < r < 1.0:
            raise ValueError(f"occupied_share must lie between 0 and 1, got {r!r}")


class ExpansivityForm(Enum):
    """Relative expansivity of the free volume against pressure, F(p) of Yasutomi's law."""

    LOGARITHMIC = "logarithmic"  # 1 - B1 ln(1 + B2 p), Yasutomi, Bair and Winer (1984)
    POWER = "power"  # (1 + b1 p)^b2, the improved law of Bair, Mary, Bouscharain and Vergne (2013)


@dataclass(frozen=True, slots=True, kw_only=True)
class YasutomiGlass:
    """Constants of Yasutomi's viscosity by the distance from the glass temperature T_g(p)."""

    glass_temperature: float  # T_g0, at ambient pressure [K]
    glass_rise: float  # A1 of T_g(p) = T_g0 + A1 ln(1 + A2 p) [K]
    glass_pressure_coefficient: float  # A2 [1/Pa]
    expansivity_1: float  # B1 [-] of the logarithmic, b1 [1/Pa] of the power form
    expansivity_2: float  # B2 [1/Pa], b2 [-]
    slope: float  # C1 [-]
    width: float  # C2 [K]
    form: ExpansivityForm = ExpansivityForm.POWER

    def __post_init__(self) -> None:
        require_positive(self, "glass_temperature", "glass_pressure_coefficient", "slope", "width")
        require_finite(self, "glass_rise", "expansivity_1", "expansivity_2")


def relative_volume(p: ArrayLike, temperature: ArrayLike, tait: TaitVolume) -> Array:
    """Relative volume V/V_R = [1 + a (T - T_R)] {1 - ln[1 + p (1 + K_0')/K_0(T)]/(1 + K_0')},
    Tait.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        a shape that broadcasts with `p` [K]
    tait : TaitVolume
        constants of the oil

    Returns
    -------
    Array
        V/V_R, the common shape [-]
    """
    pressure = np.asarray(p, dtype=np.float64)
    t = np.asarray(temperature, dtype=np.float64)
    volume: Array = _laws.relative_volume(pressure, t, *astuple(tait))
    return volume


def log_viscosity_yasutomi(p: ArrayLike, temperature: ArrayLike, glass: YasutomiGlass) -> Array:
    """ln(eta/eta_g) = -ln(10) C1 D F/(C2 + D F), D = T - T_g(p), Yasutomi, Bair and Winer (1984).

    Below the glass temperature, where the law ends, the viscosity is that of the glass.

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        a shape that broadcasts with `p` [K]
    glass : YasutomiGlass
        constants of the oil

    Returns
    -------
    Array
        ln of the viscosity over that of the glass, the common shape [-]
    """
    pressure = np.asarray(p, dtype=np.float64)
    constants = yasutomi_constants(glass)
    t = np.asarray(temperature, dtype=np.float64)
    ratio: Array = _laws.log_yasutomi(pressure, t, *constants)
    return ratio


def yasutomi_constants(glass: YasutomiGlass) -> tuple[float, ...]:
    """Constants of Yasutomi's law in the order of the kernel's arguments.

    Parameters
    ----------
    glass : YasutomiGlass
        constants of the oil

    Returns
    -------
    tuple[float, ...]
        T_g0 [K], A1 [K], A2 [1/Pa], both of the expansivity, ln(10) C1 [-], C2 [K], 1 for the
        logarithmic form
    """
    return (
        glass.glass_temperature,
        glass.glass_rise,
        glass.glass_pressure_coefficient,
        glass.expansivity_1,
        glass.expansivity_2,
        log(10.0) * glass.slope,
        glass.width,
        float(glass.form is ExpansivityForm.LOGARITHMIC),
    )


def pressure_viscosity_doolittle(
    tait: TaitVolume, doolittle: DoolittleFreeVolume, temperature: float
) -> float:
    """d(ln eta)/dp at p = 0 after Doolittle: B R O (V_0/V_R)/{K_0(T) [V_0/V_R - R O]^2}.

    Parameters
    ----------
    tait : TaitVolume
        constants of the volume
    doolittle : DoolittleFreeVolume
        constants of the viscosity
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    expansion = doolittle.occupied_expansion
    above = 0.0 if expansion is None else temperature - tait.reference_temperature
    occupied = 1.0 + (expansion or 0.0) * above
    volume = 1.0 + tait.expansion * above
    modulus = tait.bulk_modulus * float(np.exp(-tait.bulk_modulus_temperature * above))
    r = doolittle.occupied_share
    return doolittle.factor * r * occupied * volume / (modulus * (volume - r * occupied) ** 2)


def pressure_viscosity_yasutomi(glass: YasutomiGlass, temperature: float) -> float:
    """d(ln eta)/dp at p = 0 after Yasutomi: ln(10) C1 C2 [A1 A2 - D F'(0)]/(C2 + D)^2, D = T -
    T_g0.

    Parameters
    ----------
    glass : YasutomiGlass
        constants of the oil
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    distance = temperature - glass.glass_temperature
    sign = -1.0 if glass.form is ExpansivityForm.LOGARITHMIC else 1.0
    change = sign * glass.expansivity_1 * glass.expansivity_2
    closer = glass.glass_rise * glass.glass_pressure_coefficient - distance * change
    return log(10.0) * glass.slope * glass.width * closer / (glass.width + distance) ** 2

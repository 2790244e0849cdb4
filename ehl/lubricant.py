"""Lubricant: density and viscosity as functions of pressure, isothermal."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from math import isfinite, log

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROELANDS_PRESSURE = 1.96e8  # p_r [Pa], Roelands (1966)
ROELANDS_LOG_OFFSET = 9.67  # ln(eta_0 / eta_inf) = ln(eta_0) + 9.67, eta_0 in Pa s, Roelands (1966)
DOWSON_HIGGINSON_NUMERATOR = 0.6e-9  # [1/Pa], Dowson and Higginson (1966)
DOWSON_HIGGINSON_DENOMINATOR = 1.7e-9  # [1/Pa], Dowson and Higginson (1966)


class ViscosityLaw(Enum):
    """Pressure dependence of the viscosity."""

    ROELANDS = "roelands"
    BARUS = "barus"
    ISOVISCOUS = "isoviscous"


class DensityLaw(Enum):
    """Pressure dependence of the density."""

    DOWSON_HIGGINSON = "dowson-higginson"
    INCOMPRESSIBLE = "incompressible"


@dataclass(frozen=True, slots=True, kw_only=True)
class Lubricant:
    """Oil properties at the temperature of operation, SI.

    Attributes
    ----------
    viscosity : float
        Dynamic viscosity at ambient pressure, eta_0 [Pa s].
    pressure_viscosity : float
        d(ln eta)/dp at ambient pressure [1/Pa].
    density : float
        Density at ambient pressure [kg/m^3].
    viscosity_law, density_law : ViscosityLaw, DensityLaw
    roelands_z : float or None
        Roelands' exponent z [-]; None takes it from Roelands' identity.
    roelands_pressure : float
        Roelands' reference pressure p_r [Pa].
    name : str
    """

    viscosity: float
    pressure_viscosity: float
    density: float = 870.0
    viscosity_law: ViscosityLaw = ViscosityLaw.ROELANDS
    density_law: DensityLaw = DensityLaw.DOWSON_HIGGINSON
    roelands_z: float | None = None
    roelands_pressure: float = ROELANDS_PRESSURE
    name: str = ""

    def __post_init__(self) -> None:
        for field in ("viscosity", "density", "roelands_pressure"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if not (isfinite(self.pressure_viscosity) and self.pressure_viscosity >= 0.0):
            raise ValueError(f"pressure_viscosity must be zero or positive and finite, got {self.pressure_viscosity!r}")
        if self.viscosity_law is ViscosityLaw.ROELANDS and not 0.0 < self.exponent <= 2.0:
            raise ValueError(f"roelands_z must lie in (0, 2], got {self.exponent!r}")

    @property
    def exponent(self) -> float:
        """Roelands' z [-]: as given, or z = alpha p_r / (ln eta_0 + 9.67), Roelands (1966)."""
        if self.roelands_z is not None:
            return self.roelands_z
        return self.pressure_viscosity * self.roelands_pressure / (log(self.viscosity) + ROELANDS_LOG_OFFSET)


def viscosity_roelands(p: Array, lubricant: Lubricant) -> Array:
    """Dynamic viscosity, eta = eta_0 exp{(alpha p_r/z)[(1 + p/p_r)^z - 1]}, Roelands (1966).

    Parameters
    ----------
    p : ndarray
        Pressure [Pa].
    lubricant : Lubricant

    Returns
    -------
    ndarray, shape of `p`
        Dynamic viscosity [Pa s].
    """
    z, p_r = lubricant.exponent, lubricant.roelands_pressure
    return lubricant.viscosity * np.exp(lubricant.pressure_viscosity * p_r / z * ((1.0 + p / p_r) ** z - 1.0))


def viscosity_barus(p: Array, lubricant: Lubricant) -> Array:
    """Dynamic viscosity, eta = eta_0 exp(alpha p), Barus (1893); arguments as `viscosity_roelands` ([Pa] to [Pa s])."""
    return lubricant.viscosity * np.exp(lubricant.pressure_viscosity * p)


def viscosity(p: Array, lubricant: Lubricant) -> Array:
    """Dynamic viscosity [Pa s] at pressure `p` [Pa] after the lubricant's own law."""
    if lubricant.viscosity_law is ViscosityLaw.ROELANDS:
        return viscosity_roelands(p, lubricant)
    if lubricant.viscosity_law is ViscosityLaw.BARUS:
        return viscosity_barus(p, lubricant)
    return np.full_like(np.asarray(p, dtype=np.float64), lubricant.viscosity)


def density(p: Array, lubricant: Lubricant) -> Array:
    """Density [kg/m^3] at pressure `p` [Pa]: rho_0 [1 + 0.6 p/(1 + 1.7 p)], p in GPa, Dowson and Higginson (1966)."""
    if lubricant.density_law is DensityLaw.INCOMPRESSIBLE:
        return np.full_like(np.asarray(p, dtype=np.float64), lubricant.density)
    ratio = 1.0 + DOWSON_HIGGINSON_NUMERATOR * p / (1.0 + DOWSON_HIGGINSON_DENOMINATOR * p)
    return lubricant.density * ratio

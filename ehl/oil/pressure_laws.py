"""Viscosity under pressure by a modulus that grows with it, and by thermodynamic scaling. The
constants belong to one oil and come with a source: none has a default.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..ranges import require_finite, require_positive
from . import _kernels
from .free_volume import TaitVolume, relative_volume


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureModulus:
    """Constants of ln(eta/eta_0) = p/[a_1 + a_2 T + (b_1 + b_2 T) p], the modulus equation of
    German gear research, as Arana et al. (2019) and Wingertszahn (2023) print it; T in [K].
    """

    a1: float  # [Pa]
    a2: float  # [Pa/K]
    b1: float  # [-]
    b2: float  # [1/K]
    # T_v of Vogel's law for eta_0, -d(ln eta_0)/dT ~ (T - T_v)^-2, below the temperature of
    # operation [K]; None: exp[-beta (T - T_0)]
    vogel_temperature: float | None = None

    def __post_init__(self) -> None:
        require_finite(self, "a1", "a2", "b1", "b2")
        if self.vogel_temperature is not None:
            require_positive(self, "vogel_temperature")


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaledVolume:
    """Constants of thermodynamic scaling, eta = eta_inf exp[B phi_inf/(phi - phi_inf)], phi =
    (T/T_R) (V/V_R)^g, Bair (2019), with Tait's volume; Habchi's form.
    """

    factor: float  # B [-]
    limit: float  # phi_inf [-]
    exponent: float  # g [-]

    def __post_init__(self) -> None:
        require_positive(self, "factor", "limit", "exponent")


def log_viscosity_scaled(
    p: ArrayLike, temperature: ArrayLike, tait: TaitVolume, law: ScaledVolume
) -> Array:
    """ln(eta/eta_inf) = B phi_inf/(phi - phi_inf), phi = (T/T_R) (V/V_R)^g, Bair (2019).

    Parameters
    ----------
    p : ArrayLike
        pressure, any shape [Pa]
    temperature : ArrayLike
        T, a shape that broadcasts with `p` [K]
    tait : TaitVolume
        constants of the volume
    law : ScaledVolume
        constants of the viscosity

    Returns
    -------
    Array
        ln(eta/eta_inf), the common shape [-]; infinite where phi reaches phi_inf, the glass
    """
    t = np.asarray(temperature, dtype=np.float64)
    volume = relative_volume(p, t, tait)
    warm = t / tait.reference_temperature
    with np.errstate(divide="ignore"):
        ratio = _kernels.log_scaled(volume, warm, law.factor, law.limit, law.exponent)
    return np.asarray(ratio)


def pressure_viscosity_modulus(law: PressureModulus, temperature: float) -> float:
    """d(ln eta)/dp at p = 0, 1/(a_1 + a_2 T).

    Parameters
    ----------
    law : PressureModulus
        constants of the oil
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    return 1.0 / (law.a1 + law.a2 * temperature)


def pressure_viscosity_scaled(tait: TaitVolume, law: ScaledVolume, temperature: float) -> float:
    """d(ln eta)/dp at p = 0, B phi_inf g phi/[(phi - phi_inf)^2 K_0(T)].

    Parameters
    ----------
    tait : TaitVolume
        constants of the volume
    law : ScaledVolume
        constants of the viscosity
    temperature : float
        T [K]

    Returns
    -------
    float
        pressure-viscosity coefficient [1/Pa]
    """
    above = temperature - tait.reference_temperature
    modulus = tait.bulk_modulus * float(np.exp(-tait.bulk_modulus_temperature * above))
    volume = float(relative_volume(0.0, temperature, tait))
    phi = temperature / tait.reference_temperature * volume**law.exponent
    return law.factor * law.limit * law.exponent * phi / ((phi - law.limit) ** 2 * modulus)

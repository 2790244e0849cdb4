"""Generalised Newtonian laws: the stress vector is parallel to the shear-rate vector, its
magnitude follows a law.

The magnitude is a base law (Newton; Ree and Eyring; Carreau and Yasuda), and, if the rheology has
a limiting stress tau_L, never reaches that. With the Newtonian base it is the law of Bair and
Winer (1979), rate = -(tau_L/eta) ln(1 - tau/tau_L),

    tau = tau_L [1 - exp(-tau_base/tau_L)].

Oils with another base follow it up to the limit: tau = min(tau_base, tau_L), Arana et al. (2019)
for Eyring's. The corner is rounded:

    tau = tau_base/[1 + (tau_base/tau_L)^m]^(1/m),    m = 32,

which is below the smaller of both by 2.2 % where they are equal, by 0.1 % where they differ by
a tenth. m is a choice of ours, not of an oil.

Eyring's stress is a constant, or tau_0 = 2 Lambda_0/alpha(p, T) at the mean pressure of a contact
and the temperature of its oil, alpha = ln(eta/eta_0)/p, as Arana et al. (2019) have it after Bair
and Winer; `contact_rheology` puts its number in. `FilmState` holds temperature and fluidity of a
film that was solved with shear or heat.
"""

from dataclasses import dataclass, replace
from enum import Enum
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..options import require_finite, require_positive
from . import _laws
from ._laws import LARGEST_ARGUMENT
from .lubricant import Lubricant, log_viscosity_ratio, secant_pressure_viscosity

SMALLEST_ARGUMENT = 1e-6  # of sinh(b)/b, which is 1 from there on to round-off


class ShearLaw(Enum):
    """Base law of the stress magnitude."""

    NEWTONIAN = "newtonian"
    REE_EYRING = "ree-eyring"
    CARREAU_YASUDA = "carreau-yasuda"


LAW_CODES = {law: getattr(_laws, law.name) for law in ShearLaw}


@dataclass(frozen=True, slots=True, kw_only=True)
class Rheology:
    """Shear behaviour of an oil; only the constants of its law are used."""

    law: ShearLaw = ShearLaw.NEWTONIAN
    # tau_0 of rate = (tau_0/eta) sinh(tau/tau_0), Eyring (1936) [Pa]
    eyring_stress: float = inf
    # Lambda_0 of tau_0 = 2 Lambda_0/alpha(p, T) at a contact's mean pressure, Arana et al. (2019),
    # in place of a constant [-]; None: the constant
    eyring_coefficient: float | None = None
    # G of eta* = eta [1 + (eta rate/G)^a]^((n - 1)/a), Carreau (1972), Yasuda (1979) [Pa]
    carreau_modulus: float = inf
    carreau_exponent: float = 1.0  # n, slope of ln(tau) against ln(rate) at high rates [-]
    yasuda_exponent: float = 2.0  # a, breadth of the transition; 2 is Carreau's law [-]
    # Lambda of the limiting stress tau_L = tau_L0 + Lambda p/[1 + s (T - T_r)] [-]; None: no limit
    limiting_coefficient: float | None = None
    limiting_stress: float = 0.0  # tau_L0 [Pa]; zero is Bair and Winer's tau_L = Lambda p
    # s [1/K]; Dyson's law as printed by Zhou and Hoeprich (1991), tau_L = 0.25 [1.2 p/(2.52 +
    # 0.024 t) - 1e8 Pa] with t in degrees Celsius, is Lambda = 0.3/2.52, s = 0.024/2.52 /K,
    # T_r = 273.15 K, tau_L0 = -25 MPa
    limiting_temperature_slope: float = 0.0
    reference_temperature: float = 313.15  # T_r [K]
    # smallest tau_L: the linear law vanishes with the pressure, which an oil does not; a magnitude
    # from memory (unverified), above the stresses of an inlet [Pa]
    limiting_minimum: float = 5e6

    def __post_init__(self) -> None:
        if self.law is ShearLaw.REE_EYRING:
            by_pressure = self.eyring_coefficient is not None
            require_positive(self, "eyring_coefficient" if by_pressure else "eyring_stress")
            if by_pressure and self.eyring_stress != inf:
                raise ValueError("eyring_stress and eyring_coefficient: one of them")
        if self.law is ShearLaw.CARREAU_YASUDA:
            require_positive(self, "carreau_modulus", "yasuda_exponent")
            n = self.carreau_exponent
            if not 0.0 < n <= 1.0:
                raise ValueError(f"carreau_exponent must lie in (0, 1], got {n!r}")
        if self.limiting_coefficient is not None:
            require_positive(self, "limiting_coefficient")
            require_positive(self, "limiting_minimum", "reference_temperature")
            require_finite(self, "limiting_stress", "limiting_temperature_slope")

    @property
    def newtonian(self) -> bool:
        """The stress is eta times the rate at any rate."""
        return self.law is ShearLaw.NEWTONIAN and self.limiting_coefficient is None

    @property
    def of_contact(self) -> bool:
        """All stresses are constants: none depends on the mean pressure of a contact."""
        return self.law is not ShearLaw.REE_EYRING or self.eyring_coefficient is None

    @property
    def unlimited(self) -> "Rheology":
        """The base law, without a limiting stress."""
        return replace(self, limiting_coefficient=None)


def contact_rheology(rheology: Rheology, oil: Lubricant, mean_pressure: float) -> Rheology:
    """The rheology with Eyring's stress 2 Lambda_0/alpha at the mean pressure of a contact.

    The film may be hotter: alpha is that of the oil that flows in.

    Parameters
    ----------
    rheology : Rheology
        shear law of the oil
    oil : Lubricant
        the lubricant, at its temperature of operation
    mean_pressure : float
        load over the Hertz area [Pa]

    Returns
    -------
    Rheology
        the rheology with a constant Eyring stress

    Raises
    ------
    ValueError
        if the viscosity of the oil does not rise with the pressure
    """
    if rheology.of_contact:
        return rheology
    stress = float(eyring_stresses(rheology, oil, np.array([mean_pressure]))[0])
    return replace(rheology, eyring_stress=stress, eyring_coefficient=None)


def eyring_stresses(rheology: Rheology, oil: Lubricant, mean_pressure: Array) -> Array:
    """Eyring stresses of contacts at their mean pressures, see `contact_rheology`.

    Parameters
    ----------
    rheology : Rheology
        shear law of the oil
    oil : Lubricant
        the lubricant, at its temperature of operation
    mean_pressure : Array
        load over the Hertz area, shape (contacts,) [Pa]

    Returns
    -------
    Array
        tau_0, shape (contacts,) [Pa]

    Raises
    ------
    ValueError
        if the viscosity of the oil does not rise with the pressure
    """
    if rheology.eyring_coefficient is None:
        return np.full_like(mean_pressure, rheology.eyring_stress)
    alpha = secant_pressure_viscosity(mean_pressure, oil)
    if not (alpha > 0.0).all():
        raise ValueError("eyring_coefficient needs an oil whose viscosity rises with the pressure")
    return 2.0 * rheology.eyring_coefficient / alpha


def _require_constant_stress(rheology: Rheology) -> None:
    if not rheology.of_contact:
        raise ValueError("eyring_coefficient: the rheology of a contact is `contact_rheology`")


class KernelRheology(NamedTuple):
    """A rheology as plain numbers, to be unpacked into the arguments of compiled kernels."""

    law: int  # code of the base law
    stress: float  # tau_0 or G [Pa]
    exponent: float  # n [-]
    breadth: float  # a [-]
    limit_coefficient: float  # infinite where there is no limiting stress [-]
    limit_stress: float  # [Pa]
    limit_slope: float  # [1/K]
    limit_temperature: float  # [K]
    limit_minimum: float  # [Pa]


def kernel_rheology(rheology: Rheology) -> KernelRheology:
    """Numbers of a rheology for compiled kernels; the only conversion of a law to a code.

    Parameters
    ----------
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    KernelRheology
        numbers in the order of the kernels' arguments

    Raises
    ------
    ValueError
        if the Eyring stress depends on the mean pressure of a contact
    """
    _require_constant_stress(rheology)
    eyring = rheology.law is ShearLaw.REE_EYRING
    return KernelRheology(
        LAW_CODES[rheology.law],
        rheology.eyring_stress if eyring else rheology.carreau_modulus,
        rheology.carreau_exponent,
        rheology.yasuda_exponent,
        *_limit_numbers(rheology),
    )


def _limit_numbers(rheology: Rheology) -> tuple[float, float, float, float, float]:
    """Numbers of the limiting stress, the last five of `KernelRheology`."""
    coefficient = rheology.limiting_coefficient
    return (
        inf if coefficient is None else coefficient,
        rheology.limiting_stress,
        rheology.limiting_temperature_slope,
        rheology.reference_temperature,
        rheology.limiting_minimum,
    )


def divide_stresses(rheology: Rheology, divisor: float) -> Rheology:
    """The law with all stresses divided by a number: more Newtonian.

    Parameters
    ----------
    rheology : Rheology
        shear law of the oil
    divisor : float
        in (0, 1] [-]

    Returns
    -------
    Rheology
        the more Newtonian law
    """
    if divisor == 1.0:
        return rheology
    _require_constant_stress(rheology)
    coefficient = rheology.limiting_coefficient
    return replace(
        rheology,
        eyring_stress=rheology.eyring_stress / divisor,
        carreau_modulus=rheology.carreau_modulus / divisor,
        limiting_coefficient=None if coefficient is None else coefficient / divisor,
        limiting_stress=rheology.limiting_stress / divisor,
        limiting_minimum=rheology.limiting_minimum / divisor,
    )


def limiting_stress(
    pressure: ArrayLike, rheology: Rheology, temperature: ArrayLike | None = None
) -> Array:
    """Limiting shear stress tau_L = tau_L0 + Lambda p/[1 + s (T - T_r)], at least
    `limiting_minimum`.

    Parameters
    ----------
    pressure : ArrayLike
        p, any shape [Pa]
    rheology : Rheology
        shear law of the oil
    temperature : ArrayLike | None, optional
        T, a shape that broadcasts with `pressure` [K]; None: the reference temperature

    Returns
    -------
    Array
        tau_L, the common shape [Pa]; infinite if there is no limit
    """
    p = np.asarray(pressure, dtype=np.float64)
    numbers = _limit_numbers(rheology)
    now = rheology.reference_temperature if temperature is None else np.asarray(temperature)
    with np.errstate(divide="ignore", invalid="ignore"):
        limit: Array = _laws.limiting_stress(p, now, *numbers)
    return limit


def thinning_by_gradient(rise: Array, rheology: Rheology) -> Array:
    """Fluidity of a film with a pressure gradient over that without, sinh(B)/B; Ree-Eyring only.

    B = h p_x/(2 tau_0), for any sliding along the gradient: Conry, Wang and Cusano (1987). The
    direction of the sliding is neglected. Other laws have no factor that holds for
    any sliding: 1.

    Parameters
    ----------
    rise : Array
        h p_x, rise of the stress from wall to wall, any shape [Pa]
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    Array
        factor, shape of `rise` [-]
    """
    if rheology.law is not ShearLaw.REE_EYRING:
        return np.ones_like(rise)
    _require_constant_stress(rheology)
    b = np.clip(0.5 * np.abs(rise) / rheology.eyring_stress, SMALLEST_ARGUMENT, LARGEST_ARGUMENT)
    return np.asarray(np.sinh(b) / b, dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmState:
    """State of the oil in a film, on the grid of its contact; arrays of shape (nx, ny)."""

    temperature: Array | None  # mean over the film [K]; None: solved without heat
    # ln of the mean fluidity over that of the unsheared oil at the mean temperature, by the
    # profile of the temperature and by the stress of the pressure gradient [-]
    log_fluidity: Array

    def thinned(self, step: int) -> "FilmState":
        """The state at every `step`-th node of the grid.

        Parameters
        ----------
        step : int
            distance of the nodes that stay

        Returns
        -------
        FilmState
            the state on fewer nodes
        """
        t = self.temperature
        return FilmState(
            temperature=None if t is None else t[::step, ::step],
            log_fluidity=self.log_fluidity[::step, ::step],
        )


def log_mean_fluidity(
    temperature: Array, weights: Array, pressure: Array, oil: Lubricant
) -> tuple[Array, Array]:
    """Mean temperature across a film, and ln of the mean fluidity over the fluidity at that mean.

    Parameters
    ----------
    temperature : Array
        at the nodes across the film, shape (nx, ny, n) [K]
    weights : Array
        of the integral across the film, shape (n,) [-]
    pressure : Array
        shape (nx, ny) [Pa]
    oil : Lubricant
        the lubricant

    Returns
    -------
    mean
        mean temperature, shape (nx, ny) [K]
    log_fluidity
        shape (nx, ny) [-]
    """
    mean = temperature @ weights
    thinner = log_viscosity_ratio(pressure, oil, mean)[..., None]
    thinner = thinner - log_viscosity_ratio(pressure[..., None], oil, temperature)
    return mean, np.log(np.exp(thinner) @ weights)


def log_gradient_thinning(
    x: Array, y: Array, pressure: Array, film: Array, rheology: Rheology
) -> Array:
    """ln of `rheology.thinning_by_gradient` over a contact.

    Parameters
    ----------
    x : Array
        nodes along x, shape (nx,) [m]
    y : Array
        nodes along y, shape (ny,) [m]
    pressure : Array
        shape (nx, ny) [Pa]
    film : Array
        thickness, shape (nx, ny) [m]
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    Array
        shape (nx, ny) [-]
    """
    slopes = np.gradient(pressure, x, axis=0), np.gradient(pressure, y, axis=1)
    return np.log(thinning_by_gradient(np.maximum(film, 0.0) * np.hypot(*slopes), rheology))

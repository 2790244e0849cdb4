"""The oil of the atlas that stands for another one: Roelands' law that thickens alike at the
inlet, and what another density changes.

The film is made where the oil is still thin. With w(p) = eta_0/eta, Grubin's reduced pressure ends
at the first of the moments

    q_1 = integral of w dp,   q_2 = integral of p w dp,   from 0 to infinity,

1/alpha* of Blok (1963); the second says over which pressures it grows. Of Roelands' law with p_r
196 MPa, q_2/q_1^2 and q_1 give z and alpha. Density enters where the film is made and where it is
carried: ln(Hc A) goes with ln rho(p_i) - ln rho(p_h), p_i some 1.5/alpha*.
"""

from dataclasses import replace
from functools import cache, lru_cache
from typing import NamedTuple

import numpy as np
import scipy

from ..arrays import Array
from ..conditions import ContactConditions, MoesConditions
from ..oil._laws import roelands_rise
from ..oil.lubricant import (
    ROELANDS_PRESSURE,
    DensityLaw,
    Lubricant,
    ViscosityLaw,
    density,
    log_viscosity_ratio,
)
from .table import heavy_weight

NODES = 96  # of the moments; half as many move alpha and z of library oils by less than 1e-5
MOST_PRESSURE = (
    60.0  # of the moments, over 1/alpha: what thickens less than e^-12 fold there is none
)
Z_LIMITS = (0.05, 1.9)  # between which z is sought


# effect on the six functions: how far each follows ln rho(p_h), and p_i over the first moment;
# those of films fitted to other contacts, others to eight incompressible ones (`film_atlas.md`)
DENSITY = ((1.03, 1.46), (0.19, 0.63), (-0.03, 0.0), (0.22, 0.0), (0.2, 0.0), (0.16, 0.0))
# likewise of isoviscous oils, whose density the table does not have: eight contacts, A 6 to 109
ISOVISCOUS_DENSITY = (0.33, -0.25, 0.0, 0.25, 0.24, 0.21)
# interval of A over which density begins to count so: in lighter contacts it moves the step of the
# film
DENSITY_SEAM = (5.0, 7.0)
# and ln of the density over that of Dowson and Higginson at p_h beyond which these are refused [-]
LIGHT_DENSITY = 0.02
# errors of the six functions that hold nineteen of twenty contacts with oils of other laws, in
# light and in heavy contacts, also of a density after Tait; of oils that cannot be compressed, and
# of isoviscous ones that can
OTHER_LAW_ERROR = np.array(
    [[0.02, 0.012, 0.028, 0.014, 0.01, 0.006], [0.01, 0.023, 0.014, 0.014, 0.013, 0.01]]
)
INCOMPRESSIBLE_ERROR = np.array([0.013, 0.021, 0.055, 0.033, 0.028, 0.022])
ISOVISCOUS_ERROR = np.array([0.026, 0.065, 0.004, 0.022, 0.016, 0.016])


class InletOil(NamedTuple):
    """Roelands' law for the inlet, and the moment that it shares."""

    pressure_viscosity: float  # alpha [1/Pa]
    exponent: float  # z [-]
    moment: float  # q_1, 1/alpha* [Pa]


@lru_cache(maxsize=256)
def inlet_oil(oil: Lubricant) -> InletOil:
    """Fit Roelands' law with p_r 196 MPa to the two moments of a piezoviscous oil.

    Parameters
    ----------
    oil : Lubricant
        lubricant of any law

    Returns
    -------
    InletOil
        Roelands' law with the same moments

    Raises
    ------
    ValueError
        if no z between 0.05 and 1.9 has them
    """
    first, second = _moments(oil)
    if _roelands(oil):
        return InletOil(oil.pressure_viscosity, oil.exponent, first)

    def excess(z: float) -> float:
        return _roelands_moments(_alpha(z, first), z)[1] / second - 1.0

    z = float(scipy.optimize.brentq(excess, *Z_LIMITS, xtol=1e-6))
    return InletOil(_alpha(z, first), z, first)


def with_inlet_oil(
    conditions: ContactConditions | MoesConditions,
) -> ContactConditions | MoesConditions:
    """Replace the oil of a contact by the Roelands oil with the same inlet.

    Its density stays, and so does an isoviscous oil, which has L = 0.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        flooded contact

    Returns
    -------
    ContactConditions | MoesConditions
        the contact with that oil
    """
    oil = conditions.lubricant
    if not oil.piezoviscous or _roelands(oil):
        return conditions
    inlet = inlet_oil(oil)
    roelands = replace(
        oil,
        viscosity_law=ViscosityLaw.ROELANDS,
        pressure_viscosity=inlet.pressure_viscosity,
        roelands_z=inlet.exponent,
        roelands_pressure=ROELANDS_PRESSURE,
    )
    if isinstance(conditions, ContactConditions):
        return replace(conditions, lubricant=roelands)
    fraction = inlet.pressure_viscosity / oil.pressure_viscosity
    thick = conditions.lubricant_parameter * fraction
    return replace(conditions, lubricant=roelands, lubricant_parameter=thick)


def density_correction(oil: Lubricant, hertz_pressure: float, load: float) -> Array:
    """Evaluate the change of the six functions by the density of an oil.

    The reference is an oil after Dowson and Higginson, or an isoviscous, incompressible one.

    Parameters
    ----------
    oil : Lubricant
        lubricant
    hertz_pressure : float
        Hertz pressure [Pa]
    load : float
        A of the contact [-]

    Returns
    -------
    Array
        changes, of the moments relative to T/C, shape (6,) [-]
    """
    if oil.piezoviscous and oil.density_law is DensityLaw.DOWSON_HIGGINSON:
        return np.zeros(len(DENSITY))
    heavy = float(heavy_weight(np.log(load), DENSITY_SEAM)[0])
    if not oil.piezoviscous:
        return -heavy * np.array(ISOVISCOUS_DENSITY) * _log_density(oil, hertz_pressure)
    first = inlet_oil(oil).moment
    there = density_excess(oil, hertz_pressure)
    added = [density_excess(oil, at * first) - fraction * there for fraction, at in DENSITY]
    return heavy * np.array(added)


def density_excess(oil: Lubricant, pressure: float) -> float:
    """Evaluate ln of an oil's density over that of Dowson and Higginson, both over the ambient
    one.

    Parameters
    ----------
    oil : Lubricant
        lubricant
    pressure : float
        pressure [Pa]

    Returns
    -------
    float
        logarithm of the ratio [-]
    """
    if oil.density_law is DensityLaw.DOWSON_HIGGINSON:
        return 0.0
    other = replace(oil, density_law=DensityLaw.DOWSON_HIGGINSON)
    return _log_density(oil, pressure) - _log_density(other, pressure)


def _log_density(oil: Lubricant, pressure: float) -> float:
    """ln(rho/rho_0) [-]."""
    return float(np.log(density(pressure, oil) / oil.density))


def law_error(oil: Lubricant, heavy: bool) -> Array:
    """Estimate the errors of the six functions where the table has none for such an oil.

    Parameters
    ----------
    oil : Lubricant
        lubricant
    heavy : bool
        whether the contact is heavy

    Returns
    -------
    Array
        errors, shape (6,) [-]
    """
    compressible = oil.density_law is not DensityLaw.INCOMPRESSIBLE
    if not oil.piezoviscous:
        return ISOVISCOUS_ERROR if compressible else np.zeros(len(DENSITY))
    if oil.density_law is DensityLaw.DOWSON_HIGGINSON and _roelands(oil):
        return np.zeros(len(DENSITY))
    if not compressible:
        return INCOMPRESSIBLE_ERROR
    return np.asarray(OTHER_LAW_ERROR[int(heavy)])


def _roelands(oil: Lubricant) -> bool:
    """Tell whether an oil is one of Roelands' as the table has them."""
    is_roelands = oil.viscosity_law is ViscosityLaw.ROELANDS
    return is_roelands and oil.roelands_pressure == ROELANDS_PRESSURE


def _alpha(z: float, first: float) -> float:
    """Evaluate alpha of Roelands' law with that first moment [1/Pa]."""

    def excess(log_alpha: float) -> float:
        return _roelands_moments(float(np.exp(log_alpha)), z)[0] / first - 1.0

    near = -float(np.log(first))
    return float(np.exp(scipy.optimize.brentq(excess, near - 2.0, near + 2.0, xtol=1e-7)))


def _roelands_moments(alpha: float, z: float) -> tuple[float, float]:
    """Both moments of Roelands' law, in [Pa] and [Pa^2]."""
    pressure, weights = _quadrature(1.0 / alpha)
    rise = roelands_rise(pressure / ROELANDS_PRESSURE, z) - 1.0
    thinner = np.exp(-alpha * ROELANDS_PRESSURE / z * rise) * weights
    return float(thinner.sum()), float(pressure @ thinner)


def _moments(oil: Lubricant) -> tuple[float, float]:
    """Both moments of an oil's own law, in [Pa] and [Pa^2]."""
    pressure, weights = _quadrature(1.0 / oil.pressure_viscosity)
    thinner = np.exp(-log_viscosity_ratio(pressure, oil)) * weights
    return float(thinner.sum()), float(pressure @ thinner)


def _quadrature(scale: float) -> tuple[Array, Array]:
    """Pressures up to `MOST_PRESSURE` scales, and weights of Gauss' rule in p/(p + scale), in the
    unit of the scale.
    """
    fraction, weights = _rule()
    return scale * fraction / (1.0 - fraction), scale * weights / (1.0 - fraction) ** 2


@cache
def _rule() -> tuple[Array, Array]:
    """Nodes and weights in p/(p + scale) [-]."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    half = 0.5 * MOST_PRESSURE / (MOST_PRESSURE + 1.0)
    return half * (1.0 + x), half * w

"""A lubricant as the array of numbers that `ehl.oil._kernels` takes; law codes."""

from math import log

import numpy as np
from numpy.typing import NDArray

from .free_volume import ExpansivityForm, log_viscosity_doolittle, log_viscosity_yasutomi
from .lubricant import DensityLaw, Lubricant, ViscosityLaw

Array = NDArray[np.float64]

VISCOSITY_CODES = {
    ViscosityLaw.ISOVISCOUS: 0,
    ViscosityLaw.BARUS: 1,
    ViscosityLaw.ROELANDS: 2,
    ViscosityLaw.TAIT_DOOLITTLE: 3,
    ViscosityLaw.YASUTOMI: 4,
}
DENSITY_CODES = {DensityLaw.INCOMPRESSIBLE: 0, DensityLaw.DOWSON_HIGGINSON: 1, DensityLaw.TAIT: 2}
# where the constants of each begin; as in `_kernels`
VISCOSITY_START = 7
TAIT_START = 16
SIZE = 21


def oil_numbers(lubricant: Lubricant) -> Array:
    """Constants of a lubricant for the kernels, shape (21,) [SI].

    Codes of the two laws; eta_0, rho_0, T_0, beta, thermal expansion; constants of the viscosity
    law; those of Tait. The temperature is taken as 298.15 K where none is given: it is a name
    then, as nothing varies with it.
    """
    oil = lubricant
    heat = lubricant.thermal
    numbers = np.zeros(SIZE)
    numbers[:5] = (
        VISCOSITY_CODES[oil.viscosity_law],
        DENSITY_CODES[oil.density_law],
        oil.viscosity,
        oil.density,
        298.15 if oil.temperature is None else oil.temperature,
    )
    if oil.viscosity_law is ViscosityLaw.ROELANDS and oil.pressure_viscosity == 0.0:
        numbers[0] = VISCOSITY_CODES[ViscosityLaw.ISOVISCOUS]
    if heat is not None:
        numbers[5:7] = heat.viscosity_temperature, heat.expansion
    constants = _viscosity_constants(oil)
    numbers[VISCOSITY_START : VISCOSITY_START + len(constants)] = constants
    if oil.tait is not None:
        t = oil.tait
        numbers[TAIT_START:] = (
            t.bulk_modulus,
            t.bulk_modulus_derivative,
            t.reference_temperature,
            t.bulk_modulus_temperature,
            t.expansion,
        )
    return numbers


def _viscosity_constants(oil: Lubricant) -> tuple[float, ...]:
    """Constants of the viscosity law in the order the kernel reads them."""
    if oil.viscosity_law is ViscosityLaw.BARUS:
        return (oil.pressure_viscosity,)
    if oil.viscosity_law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0:
        return (
            oil.pressure_viscosity * oil.roelands_pressure / oil.exponent,
            oil.roelands_pressure,
            oil.exponent,
        )
    at = 0.0 if oil.temperature is None else oil.temperature
    if (
        oil.viscosity_law is ViscosityLaw.TAIT_DOOLITTLE
        and oil.doolittle is not None
        and oil.tait is not None
    ):
        d = oil.doolittle
        start = float(log_viscosity_doolittle(0.0, at, oil.tait, d))
        own = d.occupied_expansion is not None
        return d.factor, d.occupied_share, d.occupied_expansion or 0.0, float(own), start
    if oil.viscosity_law is ViscosityLaw.YASUTOMI and oil.yasutomi is not None:
        y = oil.yasutomi
        start = float(log_viscosity_yasutomi(0.0, at, y))
        return (
            y.glass_temperature,
            y.glass_rise,
            y.glass_pressure_coefficient,
            y.expansivity_1,
            y.expansivity_2,
            log(10.0) * y.slope,
            y.width,
            float(y.form is ExpansivityForm.LOGARITHMIC),
            start,
        )
    return ()

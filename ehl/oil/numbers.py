"""A lubricant as the array of numbers that `ehl.oil._kernels` takes."""

from dataclasses import astuple
from math import log

import numpy as np

from ..arrays import Array
from . import _kernels
from .free_volume import ExpansivityForm, log_viscosity_doolittle, log_viscosity_yasutomi
from .heat_properties import FittedHeat, VolumeHeat, volume_heat
from .lubricant import DensityLaw, Lubricant, ViscosityLaw
from .pressure_laws import log_viscosity_scaled

VISCOSITY_CODES = {
    ViscosityLaw.ISOVISCOUS: _kernels.ISOVISCOUS,
    ViscosityLaw.BARUS: _kernels.BARUS,
    ViscosityLaw.ROELANDS: _kernels.ROELANDS,
    ViscosityLaw.TAIT_DOOLITTLE: _kernels.TAIT_DOOLITTLE,
    ViscosityLaw.YASUTOMI: _kernels.YASUTOMI,
    ViscosityLaw.MODULUS: _kernels.MODULUS,
    ViscosityLaw.SCALED: _kernels.SCALED,
}
DENSITY_CODES = {
    DensityLaw.INCOMPRESSIBLE: _kernels.INCOMPRESSIBLE,
    DensityLaw.DOWSON_HIGGINSON: _kernels.DOWSON_HIGGINSON,
    DensityLaw.TAIT: _kernels.TAIT,
}
SIZE = 33


def oil_numbers(lubricant: Lubricant) -> Array:
    """Constants of a lubricant for the kernels, shape (33,) [SI].

    Codes of the two laws; eta_0, rho_0, T_0, beta, thermal expansion; constants of the viscosity
    law; those of Tait; of the heat under pressure. The temperature is taken as 298.15 K where none
    is given: it is a name then, as nothing varies with it.
    """
    oil = lubricant
    temperature = 298.15 if oil.temperature is None else oil.temperature
    codes = (VISCOSITY_CODES[oil.viscosity_law], DENSITY_CODES[oil.density_law])
    numbers = np.zeros(SIZE)
    numbers[:5] = (*codes, oil.viscosity, oil.density, temperature)
    if oil.viscosity_law is ViscosityLaw.ROELANDS and oil.pressure_viscosity == 0.0:
        numbers[0] = _kernels.ISOVISCOUS
    if oil.thermal is not None:
        numbers[5:7] = oil.thermal.viscosity_temperature, oil.thermal.expansion
    constants = _viscosity_constants(oil)
    numbers[_kernels.V : _kernels.V + len(constants)] = constants
    if oil.tait is not None:
        numbers[_kernels.T : _kernels.H] = astuple(oil.tait)
    heat = _heat_constants(oil, temperature)
    numbers[_kernels.H : _kernels.H + len(heat)] = heat
    return numbers


def _viscosity_constants(oil: Lubricant) -> tuple[float, ...]:
    """Constants of the viscosity law in the order the kernel reads them."""
    law = oil.viscosity_law
    at = oil.temperature or 0.0
    if law is ViscosityLaw.BARUS:
        return (oil.pressure_viscosity,)
    if law is ViscosityLaw.ROELANDS and oil.pressure_viscosity > 0.0:
        slope = oil.pressure_viscosity * oil.roelands_pressure / oil.exponent
        return slope, oil.roelands_pressure, oil.exponent
    if law is ViscosityLaw.TAIT_DOOLITTLE and oil.doolittle and oil.tait:
        d = oil.doolittle
        start = float(log_viscosity_doolittle(0.0, at, oil.tait, d))
        own = d.occupied_expansion is not None
        return d.factor, d.occupied_share, d.occupied_expansion or 0.0, float(own), start
    if law is ViscosityLaw.YASUTOMI and oil.yasutomi:
        y = oil.yasutomi
        start = float(log_viscosity_yasutomi(0.0, at, y))
        glass = (y.glass_temperature, y.glass_rise, y.glass_pressure_coefficient)
        logarithmic = float(y.form is ExpansivityForm.LOGARITHMIC)
        expansivity = (y.expansivity_1, y.expansivity_2)
        return (*glass, *expansivity, log(10.0) * y.slope, y.width, logarithmic, start)
    if law is ViscosityLaw.MODULUS and oil.modulus:
        m = oil.modulus
        return m.a1, m.a2, m.b1, m.b2, m.vogel_temperature or 0.0
    if law is ViscosityLaw.SCALED and oil.scaled and oil.tait:
        v = oil.scaled
        return v.factor, v.limit, v.exponent, float(log_viscosity_scaled(0.0, at, oil.tait, v))
    return ()


def _heat_constants(oil: Lubricant, temperature: float) -> tuple[float, ...]:
    """Kind and constants of the law of the heat under pressure, with its values at ambient
    pressure and the temperature of operation [K], as the kernels read them.
    """
    law = None if oil.thermal is None else oil.thermal.under_pressure
    if isinstance(law, FittedHeat):
        start = min(temperature, law.largest_temperature)
        ambient = 1.0 + law.temperature_0 * (start - law.reference_temperature)
        return (float(_kernels.FITTED_HEAT), *astuple(law), ambient)
    if isinstance(law, VolumeHeat) and oil.tait is not None:
        k, capacity = volume_heat(0.0, temperature, oil.tait, law)
        return (float(_kernels.VOLUME_HEAT), *astuple(law), float(k), float(capacity))
    return ()

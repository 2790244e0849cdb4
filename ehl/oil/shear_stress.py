"""Shear stress of an oil in NumPy, by the kernels of its laws."""

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from . import _kernels
from .rheology import LAW_CODES, Rheology, ShearLaw, kernel_rheology, limiting_stress


def shear_stress(
    rate: ArrayLike,
    viscosity: ArrayLike,
    pressure: ArrayLike,
    rheology: Rheology,
    temperature: ArrayLike | None = None,
) -> Array:
    """Shear stress at a shear rate; odd in the rate.

    Pressure and temperature enter the limiting stress only.

    Parameters
    ----------
    rate : ArrayLike
        shear rate, any shape [1/s]
    viscosity : ArrayLike
        low-shear viscosity at pressure and temperature [Pa s]
    pressure : ArrayLike
        [Pa]
    rheology : Rheology
        shear law of the oil
    temperature : ArrayLike | None, optional
        [K]; None: the reference temperature

    Returns
    -------
    Array
        tau, the common shape [Pa]

    Raises
    ------
    ValueError
        if the Eyring stress depends on the mean pressure of a contact
    """
    numbers = kernel_rheology(rheology)
    limit = limiting_stress(pressure, rheology, temperature)
    rates, viscosities, limits = _broadcast(np.abs(rate), viscosity, limit)
    stress = np.empty(rates.shape)
    flat = rates.ravel(), viscosities.ravel(), limits.ravel()
    _kernels.shear_stresses(*flat, *numbers[:4], stress.reshape(-1))
    return np.copysign(stress, rate)


def limited(stress: ArrayLike, limit: ArrayLike, law: ShearLaw) -> Array:
    """Magnitude of a base law's stress under a limiting one.

    Parameters
    ----------
    stress : ArrayLike
        of the base law, positive, any shape [Pa]
    limit : ArrayLike
        limiting stress, positive or infinite, a shape that broadcasts with `stress` [Pa]
    law : ShearLaw
        the base law

    Returns
    -------
    Array
        stress, the common shape [Pa]
    """
    stresses, limits = _broadcast(stress, limit)
    result = np.empty(stresses.shape)
    flat = stresses.ravel(), limits.ravel()
    _kernels.limited_stresses(*flat, LAW_CODES[law], result.reshape(-1))
    return result


def shear_stress_vector(
    rates: tuple[ArrayLike, ArrayLike],
    viscosity: ArrayLike,
    pressure: ArrayLike,
    rheology: Rheology,
    temperature: ArrayLike | None = None,
) -> tuple[Array, Array]:
    """Shear stress vector parallel to the shear-rate vector.

    Parameters
    ----------
    rates : tuple[ArrayLike, ArrayLike]
        components (rate_x, rate_y) of one shape [1/s]
    viscosity : ArrayLike
        low-shear viscosity at pressure and temperature [Pa s]
    pressure : ArrayLike
        [Pa]
    rheology : Rheology
        shear law of the oil
    temperature : ArrayLike | None, optional
        [K]; None: the reference temperature

    Returns
    -------
    along_x
        tau_x, the common shape [Pa]
    along_y
        tau_y, the common shape [Pa]
    """
    x, y = (np.asarray(rate, dtype=np.float64) for rate in rates)
    rate = np.hypot(x, y)
    stress = shear_stress(rate, viscosity, pressure, rheology, temperature)
    effective = np.where(rate != 0.0, stress / np.where(rate != 0.0, rate, 1.0), viscosity)
    return effective * x, effective * y


def _broadcast(*values: ArrayLike) -> tuple[Array, ...]:
    """Arrays of the common shape of numbers and arrays."""
    return np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in values))

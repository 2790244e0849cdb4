"""Shear rheology of the oil: stress against shear rate at a given viscosity, pressure and temperature."""

from __future__ import annotations

from .laws import (
    KernelRheology,
    Rheology,
    ShearLaw,
    eased,
    effective_viscosity,
    kernel_rheology,
    limiting_stress,
    shear_rate,
    shear_rate_vector,
    shear_stress,
    shear_stress_vector,
    thinning_by_gradient,
)

__all__ = [
    "KernelRheology",
    "Rheology",
    "ShearLaw",
    "eased",
    "effective_viscosity",
    "kernel_rheology",
    "limiting_stress",
    "shear_rate",
    "shear_rate_vector",
    "shear_stress",
    "shear_stress_vector",
    "thinning_by_gradient",
]

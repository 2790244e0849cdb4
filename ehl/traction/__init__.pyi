from .friction_coefficients import FourConstants, RampedCoulomb
from .law import TractionForces, TractionLaw
from .linear_response import NormalResponse, ResponseValue, normal_response
from .shear import (
    Cavitation,
    ContactShape,
    EllipseLaw,
    ShearFields,
    TractionResult,
    integrate_traction,
    shear_fields,
)

__all__ = [
    "Cavitation",
    "ContactShape",
    "EllipseLaw",
    "FourConstants",
    "NormalResponse",
    "RampedCoulomb",
    "ResponseValue",
    "ShearFields",
    "TractionForces",
    "TractionLaw",
    "TractionResult",
    "integrate_traction",
    "normal_response",
    "shear_fields",
]

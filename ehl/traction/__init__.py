"""Traction of a lubricated contact: sliding inside the ellipse, shear on both surfaces, forces and moments."""

from __future__ import annotations

from .kinematics import ContactKinematics, contact_kinematics
from .shear import Cavitation, ShearFields, TractionResult, integrate_traction, shear_fields

__all__ = [
    "Cavitation",
    "ContactKinematics",
    "ShearFields",
    "TractionResult",
    "contact_kinematics",
    "integrate_traction",
    "shear_fields",
]

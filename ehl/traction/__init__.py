"""Traction of a lubricated contact: sliding inside the ellipse, shear on both surfaces, forces, moments, tables."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from .kinematics import ContactKinematics, contact_kinematics
from .shear import Cavitation, ShearFields, TractionResult, integrate_traction, shear_fields

if TYPE_CHECKING:
    from .laws import ContactShape, CoulombLaw, FourConstantLaw, FrictionLaw, TractionForces, four_constants
    from .response import NormalResponse, normal_response
    from .sampling import TableOptions, build_table
    from .storage import inputs_digest, load_table, save_table
    from .table import TableContact, TableError, TableRange, TractionTable
    from .temperature import TemperatureTable, build_temperature_table

_LAZY = {  # these need SciPy or numba
    "laws": ("ContactShape", "CoulombLaw", "FourConstantLaw", "FrictionLaw", "TractionForces", "four_constants"),
    "response": ("NormalResponse", "normal_response"),
    "sampling": ("TableOptions", "build_table"),
    "storage": ("inputs_digest", "load_table", "save_table"),
    "table": ("TableContact", "TableError", "TableRange", "TractionTable"),
    "temperature": ("TemperatureTable", "build_temperature_table"),
}

__all__ = [
    "Cavitation",
    "ContactKinematics",
    "ContactShape",
    "CoulombLaw",
    "FourConstantLaw",
    "FrictionLaw",
    "NormalResponse",
    "ShearFields",
    "TableContact",
    "TableError",
    "TableOptions",
    "TableRange",
    "TemperatureTable",
    "TractionForces",
    "TractionResult",
    "TractionTable",
    "build_table",
    "build_temperature_table",
    "contact_kinematics",
    "four_constants",
    "inputs_digest",
    "integrate_traction",
    "load_table",
    "normal_response",
    "save_table",
    "shear_fields",
]


def __getattr__(name: str) -> object:
    """Import what needs SciPy or numba when it is first asked for."""
    for module, names in _LAZY.items():
        if name in names:
            return getattr(import_module(f".{module}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

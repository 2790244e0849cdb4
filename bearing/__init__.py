"""Ball bearings: geometry, materials, quasi-static equilibrium, and the lubricated contacts it yields."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from .catalogue import list_bearings, load_catalogue_entry
from .geometry import Bearing, Race, clearance_to_contact_angle, contact_angle_to_clearance, reduced_radii
from .lubricant_library import library_lubricant, list_lubricants
from .material import Material, MaterialKind, list_materials, load_material, reduced_modulus
from .operation import BallKinematics, Curvature, Model, Operation, RatingInput

if TYPE_CHECKING:
    from .clearance import ClearanceBudget, Fit, Warming, clearance_budget
    from .contacts import BearingContact, contact_conditions
    from .frequencies import Frequencies, bearing_frequencies, kinematic_frequencies
    from .life import LifeRating, bearing_life
    from .preload import Arrangement, duplex, preload_offset, preloaded_row
    from .quasistatic import QuasistaticSolution, solve_quasistatic
    from .rows import Row
    from .slip import SlipStudy, critical_curves, minimum_preload, slip_factors, slip_surface
    from .stiffness import StiffnessOverSpeed, ross_table, stiffness_over_speed
    from .stresses import ContactStress, Truncation, contact_stress

__all__ = [
    "Arrangement",
    "BallKinematics",
    "Bearing",
    "BearingContact",
    "ClearanceBudget",
    "ContactStress",
    "Curvature",
    "Fit",
    "Frequencies",
    "LifeRating",
    "Material",
    "MaterialKind",
    "Model",
    "Operation",
    "QuasistaticSolution",
    "Race",
    "RatingInput",
    "Row",
    "SlipStudy",
    "StiffnessOverSpeed",
    "Truncation",
    "Warming",
    "bearing_frequencies",
    "bearing_life",
    "clearance_budget",
    "clearance_to_contact_angle",
    "contact_angle_to_clearance",
    "contact_conditions",
    "contact_stress",
    "critical_curves",
    "duplex",
    "kinematic_frequencies",
    "library_lubricant",
    "list_bearings",
    "list_lubricants",
    "list_materials",
    "load_catalogue_entry",
    "load_material",
    "minimum_preload",
    "preload_offset",
    "preloaded_row",
    "reduced_modulus",
    "reduced_radii",
    "ross_table",
    "slip_factors",
    "slip_surface",
    "solve_quasistatic",
    "stiffness_over_speed",
]

_LAZY = {  # these need SciPy, which takes longer to import than a command line may take to answer
    "BearingContact": "contacts",
    "ClearanceBudget": "clearance",
    "Fit": "clearance",
    "Warming": "clearance",
    "clearance_budget": "clearance",
    "contact_conditions": "contacts",
    "StiffnessOverSpeed": "stiffness",
    "ross_table": "stiffness",
    "stiffness_over_speed": "stiffness",
    "ContactStress": "stresses",
    "Truncation": "stresses",
    "contact_stress": "stresses",
    "Frequencies": "frequencies",
    "bearing_frequencies": "frequencies",
    "kinematic_frequencies": "frequencies",
    "LifeRating": "life",
    "bearing_life": "life",
    "Arrangement": "preload",
    "duplex": "preload",
    "preload_offset": "preload",
    "preloaded_row": "preload",
    "QuasistaticSolution": "quasistatic",
    "Row": "rows",
    "solve_quasistatic": "quasistatic",
    "SlipStudy": "slip",
    "critical_curves": "slip",
    "minimum_preload": "slip",
    "slip_factors": "slip",
    "slip_surface": "slip",
}


def __getattr__(name: str) -> object:
    """Import what needs SciPy when it is first asked for."""
    if name in _LAZY:
        return getattr(import_module(f".{_LAZY[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

from .contacts.contact import BearingContact
from .contacts.contacts import contact_conditions
from .contacts.stress import ContactStress, Truncation, contact_stress
from .dynamics.simulation import simulate
from .films.film import ContactFilm
from .films.operating_film import contact_films
from .fits.clearance import ClearanceBudget, Fit, TemperatureRise, clearance_budget
from .friction.contact_friction import BallTraction
from .friction.equilibrium import solve_traction_equilibrium
from .geometry import (
    Bearing,
    BearingType,
    Race,
    Row,
    clearance_to_contact_angle,
    contact_angle_to_clearance,
    load_bearing,
    reduced_radii,
)
from .library.bearings import list_bearings, load_catalogue_entry
from .library.catalogue import typical_geometry
from .library.lubricants import Grease, list_greases, list_lubricants, load_grease, load_lubricant
from .material import Material, MaterialKind, list_materials, load_material, reduced_modulus
from .operation import BallKinematics, Curvature, Operation, QuasistaticModel, RatingInput
from .quasistatic.solution import (
    Frequencies,
    QuasistaticSolution,
    bearing_frequencies,
    kinematic_frequencies,
)
from .quasistatic.solver import solve_quasistatic
from .rating.geometry_estimate import CatalogueData, estimate_bearing, estimate_geometry
from .rating.life import LifeRating, bearing_life
from .studies.preload import Arrangement, duplex, preload_offset, preloaded_row
from .studies.slip import SlipStudy, critical_curves, minimum_preload, slip_factors, slip_surface
from .studies.stiffness import StiffnessOverSpeed, stiffness_over_speed
from .torque.breakdown import TorqueBreakdown, friction_torque

__all__ = [
    "Arrangement",
    "BallKinematics",
    "BallTraction",
    "Bearing",
    "BearingContact",
    "BearingType",
    "CatalogueData",
    "ClearanceBudget",
    "ContactFilm",
    "ContactStress",
    "Curvature",
    "Fit",
    "Frequencies",
    "Grease",
    "LifeRating",
    "Material",
    "MaterialKind",
    "Operation",
    "QuasistaticModel",
    "QuasistaticSolution",
    "Race",
    "RatingInput",
    "Row",
    "SlipStudy",
    "StiffnessOverSpeed",
    "TemperatureRise",
    "TorqueBreakdown",
    "Truncation",
    "bearing_frequencies",
    "bearing_life",
    "clearance_budget",
    "clearance_to_contact_angle",
    "contact_angle_to_clearance",
    "contact_conditions",
    "contact_films",
    "contact_stress",
    "critical_curves",
    "duplex",
    "estimate_bearing",
    "estimate_geometry",
    "friction_torque",
    "kinematic_frequencies",
    "list_bearings",
    "list_greases",
    "list_lubricants",
    "list_materials",
    "load_bearing",
    "load_catalogue_entry",
    "load_grease",
    "load_lubricant",
    "load_material",
    "minimum_preload",
    "preload_offset",
    "preloaded_row",
    "reduced_modulus",
    "reduced_radii",
    "simulate",
    "slip_factors",
    "slip_surface",
    "solve_quasistatic",
    "solve_traction_equilibrium",
    "stiffness_over_speed",
    "typical_geometry",
]

"""From the units of case files to SI, once: tables of `schema` to the dataclasses of `ehl` and
`bearing`.
"""

from .bearing import bearing, operating_bearing, rating
from .contact import contact, contact_defaults, solver_options
from .dynamics import dynamics_plan
from .friction import film_physics, friction, rheology
from .heating import heating
from .lubricant import lubricant, lubricant_keys, temperature
from .materials import material_table, materials, ring_materials, seat_materials
from .operation import model, operation, slip_plan
from .rows import rows
from .traction import ball_traction

__all__ = [
    "ball_traction",
    "bearing",
    "contact",
    "contact_defaults",
    "dynamics_plan",
    "film_physics",
    "friction",
    "heating",
    "lubricant",
    "lubricant_keys",
    "material_table",
    "materials",
    "model",
    "operating_bearing",
    "operation",
    "rating",
    "rheology",
    "ring_materials",
    "rows",
    "seat_materials",
    "slip_plan",
    "solver_options",
    "temperature",
]

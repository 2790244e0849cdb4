"""All checks of a case file, by its kind."""

from collections.abc import Iterator

from ..format.problems import Problem
from .bearing import (
    ball_count,
    bearing_materials,
    boundary,
    clearance,
    grooves,
    required_geometry,
    seats,
    shoulders,
    skf_series,
)
from .contact import coating, contact_groups
from .dynamics import dynamics
from .friction import friction
from .lubricant import lubricant
from .operation import film_maps, loads, tilt
from .rows import rows
from .values import Names, Values, known


def bearing_problems(values: Values, names: Names) -> Iterator[Problem]:
    """Every conflict within a bearing case."""
    for check in (
        required_geometry,
        grooves,
        ball_count,
        clearance,
        boundary,
        shoulders,
        seats,
        skf_series,
        loads,
        tilt,
        film_maps,
        rows,
        dynamics,
    ):
        yield from check(values)
    yield from bearing_materials(values, names)
    for key in ("shaft_material", "housing_material"):
        yield from known(("fit", key), values.get("fit", key), names.materials)
    yield from lubricant(values, names)
    yield from friction(values)


def contact_problems(values: Values, names: Names) -> Iterator[Problem]:
    """Every conflict within a single-contact case."""
    yield from contact_groups(values)
    yield from coating(values)
    for key in ("material_1", "material_2", "substrate_material"):
        yield from known(("contact", key), values.get("contact", key), names.materials)
    yield from lubricant(values, names)
    yield from friction(values)

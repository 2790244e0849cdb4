"""Model of a time simulation of a case: ring, cage, contact laws, friction, schedule."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from oilfilm.bearing.dynamics.assembly import race_stiffnesses
from oilfilm.bearing.dynamics.bodies import cage_body, ring_body
from oilfilm.bearing.dynamics.choices import Guidance, LoadType, NormalLaw, RaceStiffness
from oilfilm.bearing.dynamics.friction import RaceFriction
from oilfilm.bearing.dynamics.inputs import CageBody, DynamicsModel, DynamicsOptions, NormalContact
from oilfilm.bearing.dynamics.model import (
    CAGE_MATERIAL,
    ball_drag,
    cage_of_dimensions,
    prescribed_schedule,
    rotating_load,
    viscosity_over_time,
    with_race_friction,
)
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, LawTraction
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.library.lubricants import dynamic_viscosity
from oilfilm.ehl.traction.friction_coefficients import COEFFICIENTS, RampedCoulomb
from oilfilm.ehl.traction.law import TractionLaw
from oilfilm.ehl.units import from_si

from ..format.case import Case, oil_of_file
from ..format.dynamics import DynamicsTable, end_time, sample_interval, simulated_friction
from ..format.fields import FREE_WORD
from ..format.library import materials
from ..format.lubricant import oil_data
from ..format.traction import coefficient_source, read_race_tables
from .films import Progress
from .traction_table import run_table


def build_model(case: Case, tables: Path | None, notify: Progress) -> DynamicsModel:
    """Model of the simulation: options, ring, cage, contact laws, friction, schedule.

    Parameters
    ----------
    case : Case
        The bearing, with a table [dynamics].
    tables : Path | None
        File of traction tables; None: that of the case, or new ones.
    notify : Progress
        Called with steps done, steps in all, and a text, while tables are built.

    Returns
    -------
    DynamicsModel
        The model, SI.

    Raises
    ------
    ValueError
        If the case cannot be simulated.
    """
    table = case.file.dynamics
    assert table is not None  # checked before
    si = table.si()
    notes: dict[str, str] = {}
    bearing = case.bearing
    operation = case.operation
    unbalance = (si["unbalance"], si["unbalance_phase"])
    load = (si["rotating_load"], si["rotating_load_speed"], si["rotating_load_phase"])
    model = DynamicsModel(
        options=_options(case, table),
        ring=ring_body(bearing, si["ring_mass"], si["ring_damping"], unbalance),
        friction=RaceFriction(),
        cage=_cage(case, notes),
        normal=NormalContact(
            law=NormalLaw(table.contact_law),
            restitution=table.restitution,
            impact_floor=si["impact_speed_floor"],
            **race_stiffnesses(bearing, RaceStiffness(table.race_stiffness)),
        ),
        schedule=prescribed_schedule(
            operation,
            inner_speed=si["speed_table"],
            outer_speed=si["outer_speed_table"],
            force=si["load_table"],
            moment=si["moment_table"],
            displacement=_displacements(si["displacement_table"]),
            tilt=_displacements(si["tilt_table"]),
            viscosity=_viscosities(case, si["temperature_table"], notes),
        ),
        rotating=rotating_load(operation, *load),
        film_viscosity=case.lubricant.viscosity if table.cage_film else 0.0,
        friction_ramp=si["cage_friction_ramp"],
        ball_friction=table.ball_on_ball_friction,
        oil=case.lubricant,
        notes=notes,
    )
    if table.friction in COEFFICIENTS:
        notes["friction"] = (
            f"friction by {table.friction} of [friction], whatever oil and temperature; "
            'friction = "table" takes it from solved films of the oil'
        )
    if table.ball_drag_N and not model.options.drag:
        notes["drag"] = "nothing turns, and ball_drag_N has no speed to count at: no drag"
    return _with_friction(case, table, model, tables, notify)


def _displacements(table: tuple[Any, ...] | None) -> list[list[float]] | None:
    """Rows of a table of displacements; zero where the load decides."""
    if table is None:
        return None
    return [[0.0 if entry == FREE_WORD else entry for entry in row] for row in table]


def _viscosities(
    case: Case, table: tuple[Any, ...] | None, notes: dict[str, str]
) -> list[tuple[float, float]] | None:
    """Viscosity of the oil in pockets and lands over that of the case, by its temperature."""
    if table is None:
        return None
    data = oil_data(oil_of_file(case.file))
    assert data is not None  # checked before
    rows = viscosity_over_time(table, partial(dynamic_viscosity, data), case.lubricant.viscosity)
    ends = [case.lubricant.viscosity * pick(row[1] for row in rows) for pick in (min, max)]
    low, high = (from_si("viscosity_mPa_s", value) for value in ends)
    notes["temperature"] = (
        f"the oil in pockets and lands has {low:.3g} to {high:.3g} mPa s over time; friction of "
        "balls on races, drag and clearances do not follow the temperature"
    )
    return rows


def _options(case: Case, table: DynamicsTable) -> DynamicsOptions:
    si = table.si()
    drag = (si["ball_drag"], si["mixture_density"], table.drag_coefficient)
    return table.build(
        DynamicsOptions,
        end_time=end_time(table),
        until_steady=table.end_time is not None,
        sample_interval=sample_interval(table, case.operation.shaft_speed),
        equations=None if table.equations == "by load" else LoadType(table.equations),
        drag=ball_drag(case.bearing, case.operation, *drag),
    )


def _cage(case: Case, notes: dict[str, str]) -> CageBody | None:
    if case.file.dynamics is not None and not case.file.dynamics.cage:
        return None
    name = case.file.bearing.cage_material
    if name is None:
        notes["cage"] = f"cage material not given: {CAGE_MATERIAL}"
    material = materials(case.file.materials, [name or CAGE_MATERIAL])[name or CAGE_MATERIAL]
    table = case.file.cage
    if table is None:
        return cage_body(case.bearing, material)
    dimensions = table.si()
    guidance = Guidance(dimensions.pop("guided_by"))
    return cage_of_dimensions(case.bearing, case.operation, material, dimensions, guidance)


def _with_friction(
    case: Case, table: DynamicsTable, model: DynamicsModel, tables: Path | None, notify: Progress
) -> DynamicsModel:
    """The model with the friction of balls on races that [dynamics] names."""
    if table.friction == "none":
        return model
    if table.friction == "table":
        return replace(model, friction=_tables(case, tables, notify))
    constants = simulated_friction(case.file.friction)
    law = coefficient_source(table.friction, constants)
    if law is None:
        none = table.friction_dead_band_m_s
        full = table.friction_full_m_s
        mu = constants["coefficient"]
        law = CoefficientTraction(RampedCoulomb(friction=mu, slide_none=none, slide_full=full))
    at_centre = table.friction_on == "centre"
    return with_race_friction(model, case.bearing, case.operation, law, at_centre=at_centre)


def _tables(case: Case, path: Path | None, notify: Progress) -> RaceFriction:
    """Traction tables of both races: of a file, that of the case, or built."""
    source = None if case.traction is None else case.traction.source
    laws: Mapping[Race, TractionLaw]
    if path is None and isinstance(source, LawTraction):
        laws = source.laws
    elif path is None:
        laws = run_table(case, progress=notify).tables
    else:
        assert case.rheology is not None  # of every bearing case
        oil = (case.lubricant, case.rheology)
        laws = read_race_tables(path, case.bearing, *oil, case.films.solids)
    return RaceFriction(inner=laws[Race.INNER], outer=laws[Race.OUTER])

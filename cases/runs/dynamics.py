"""Run the time simulation of a case: model from the case file, history streamed to disk, restart
if interrupted.
"""

import json
from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter
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
from oilfilm.bearing.dynamics.reduction import MIRRORED
from oilfilm.bearing.dynamics.simulation import Simulation, load_restart, simulation
from oilfilm.bearing.dynamics.statistics import (
    SimulationStatistics,
    other_start,
    running_statistics,
    simulated_statistics,
)
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.library.lubricants import dynamic_viscosity
from oilfilm.ehl.traction.friction_coefficients import COEFFICIENTS, RampedCoulomb
from oilfilm.ehl.units import from_si
from oilfilm.postprocess.dynamics.history import HistoryWriter
from oilfilm.postprocess.dynamics.results import DynamicsResults

from ..format.case import Case, oil_of_file
from ..format.dynamics import DynamicsTable, end_time, sample_interval, simulated_friction
from ..format.fields import FREE_WORD
from ..format.library import materials
from ..format.lubricant import oil_data
from ..format.rules import CaseError
from ..format.shipped import table_path
from ..format.traction import coefficient_source, read_race_tables
from ..version import version
from .films import Progress
from .interrupt import finish_first, interruptible
from .traction_table import run_table

DIMENSIONS = (
    "ball_diameter pitch_diameter inner_groove_radius outer_groove_radius diametral_clearance "
    "first_ball_azimuth bore outside_diameter width"
).split()
OTHER_STARTS = 2  # in all, where states may differ
MILLISECONDS = 1000.0  # the progress counts in these


class Interrupted(KeyboardInterrupt):
    """A simulation stopped on the way, with what it has so far."""

    def __init__(self, results: DynamicsResults, simulation: Simulation) -> None:
        super().__init__()
        self.results = results
        self.simulation = simulation


def run_dynamics(
    case: Case,
    name: str,
    history: Path,
    restart: Path | None = None,
    tables: Path | None = None,
    progress: Progress | None = None,
) -> DynamicsResults:
    """Simulate a case; the history is streamed to a file.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.
    history : Path
        File of the history.
    restart : Path | None, optional
        File of an interrupted simulation of the same case to continue from.
    tables : Path | None, optional
        Traction tables from `oilfilm table`, instead of new ones.
    progress : Progress | None, optional
        Called with milliseconds done, milliseconds in all, and the time left.

    Returns
    -------
    DynamicsResults
        The simulation and its statistics.

    Raises
    ------
    CaseError
        If the case has no [dynamics], or cannot be simulated.
    Interrupted
        With what there is so far, on Ctrl-C.
    """
    notify = progress or (lambda done, total, state: None)
    table = _table(case, name)
    if tables is not None and table.friction != "table":
        raise CaseError(
            f'{name}: traction tables are for dynamics.friction = "table", found '
            f'"{table.friction}"'
        )
    try:
        model = build_model(case, tables, notify)
        run = simulation(case.bearing, case.operation, model)
        if restart is not None:
            load_restart(run, restart, case_key(case))
            run.messages.append(
                f"dynamics: continued at t = {run.state.time:.6g} s; loads of the summary "
                "from there"
            )
    except ValueError as problem:
        raise CaseError(f"{name}: {problem}") from problem
    return _with_other_starts(case, _stream(case, run, history, notify))


def _table(case: Case, name: str) -> DynamicsTable:
    if case.file.dynamics is None:
        raise CaseError(
            f"{name}: has no table [dynamics]; it needs end_time_s, or end_time = 'steady', see "
            "docs/reference/cases.md"
        )
    other = [key for key in ("form", "support") if getattr(case.file, key) is not None]
    if other:
        names = " and ".join(f"[{key}]" for key in other)
        raise CaseError(f"{name}: {names}: not taken by this simulation; 'oilfilm vibration' does")
    if case.rows is not None and len(case.rows) > 1:
        raise CaseError(f"{name}: [[rows]]: a simulation takes one row of balls")
    return case.file.dynamics


def case_key(case: Case) -> str:
    """The case as run in one line, by which a restart file identifies it.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    str
        JSON of its document.
    """
    return json.dumps(case.document, sort_keys=True)


def _teller(run: Simulation, notify: Progress) -> Callable[[], None]:
    """A function that reports the progress of a simulation and the time left."""
    began = perf_counter()
    end = run.model.options.end_time
    first = run.state.time

    def tell() -> None:
        time = run.state.time
        if time > first:
            left = (perf_counter() - began) * (end - time) / (time - first)
            state = f"simulated ms, {left:.3g} s left"
            notify(round(time * MILLISECONDS), round(end * MILLISECONDS), state)

    return tell


def _stream(case: Case, run: Simulation, history: Path, notify: Progress) -> DynamicsResults:
    """Step, write, count; on Ctrl-C what there is so far goes up with `Interrupted`."""
    began = perf_counter()
    running = running_statistics(run)
    before = run.state
    attributes = _attributes(case)

    def results() -> DynamicsResults:
        return DynamicsResults(
            version=version(),
            case=case.document,
            simulation=run,
            running=running,
            history=history,
            messages=(*case.warnings, *_assumed(run.model), *run.messages),
            timing={"simulation": run.wall, "total": perf_counter() - began},
        )

    tell = _teller(run, notify)
    with HistoryWriter(history, case.bearing.balls, attributes) as writer:
        try:
            pieces = run.pieces()
            while True:
                before = deepcopy(run.state)
                record = interruptible(partial(next, pieces, None), tell)
                if record is None:
                    break
                # state, history and statistics stay in step
                with finish_first("the samples under way"):
                    before = run.state
                    writer.add(record)
                    running.add(record, run.start_energy)
                tell()
                if run.model.options.until_steady and running.settled():
                    break
        except KeyboardInterrupt:
            # the thread that was given up still moves the state it has
            run = replace(run, state=before)
            raise Interrupted(results(), run) from None
    return results()


def _with_other_starts(case: Case, results: DynamicsResults) -> DynamicsResults:
    """The results with the ends of the other starts that the case asks for."""
    assert case.file.dynamics is not None  # checked before
    run = results.simulation
    count = (case.file.dynamics.starts or usual_starts(run)) if run.converged else 1
    others: list[SimulationStatistics | None] = []
    try:
        for k in range(1, count):
            others.append(
                interruptible(partial(simulated_statistics, other_start(run, k / count)))
            )
    except KeyboardInterrupt:
        raise Interrupted(replace(results, others=tuple(others)), run) from None
    return replace(results, others=tuple(others))


def usual_starts(run: Simulation) -> int:
    """Starts where the case names none: two where pockets decide, a load across the axis leaving
    each ball a place of its own; one under an axial load.

    Parameters
    ----------
    run : Simulation
        Simulation at its end.

    Returns
    -------
    int
        Number of starts [-].
    """
    across = run.point.kind in MIRRORED and run.model.cage is not None
    return OTHER_STARTS if across else 1


def _attributes(case: Case) -> dict[str, str | float]:
    """Attributes of the history: its case, and the dimensions a picture of it needs [m], [rad]."""
    given = {"oilfilm": version(), "case": case_key(case), "title": case.title}
    dimensions = {name: getattr(case.bearing, name) for name in DIMENSIONS}
    return given | {name: float(v) for name, v in dimensions.items() if v is not None}


def _assumed(model: DynamicsModel) -> tuple[str, ...]:
    names = [*model.ring.assumed, *(() if model.cage is None else model.cage.assumed)]
    notes = [f"dynamics: {text}" for text in model.notes.values()]
    return (
        (*notes, f"dynamics: estimated, not given: {', '.join(names)}") if names else tuple(notes)
    )


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
    given = case.file.friction
    if path is None and given.traction == "table" and given.traction_table is not None:
        path = table_path(given.traction_table)
    if path is None:
        tables = run_table(case, progress=notify).tables
    else:
        assert case.rheology is not None  # of every bearing case
        oil = (case.lubricant, case.rheology)
        tables = read_race_tables(path, case.bearing, *oil, case.films.solids)
    return RaceFriction(inner=tables[Race.INNER], outer=tables[Race.OUTER])

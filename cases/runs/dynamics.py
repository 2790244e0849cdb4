"""Run the time simulation of a case: model from the case file, history streamed to disk, restart
if interrupted.
"""

import json
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from bearing.dynamics.bodies import cage_body, ring_body
from bearing.dynamics.friction import RaceFriction, coulomb_friction, four_constant_friction
from bearing.dynamics.initial import starting_point
from bearing.dynamics.inputs import (
    CageBody,
    DynamicsModel,
    DynamicsOptions,
    LoadType,
    NormalLaw,
    RaceStiffness,
    Schedule,
    Start,
)
from bearing.dynamics.laws import drag_of_force, drag_of_mixture, normal_contact
from bearing.dynamics.statistics import RunningStatistics
from bearing.dynamics.restart import load_restart
from bearing.dynamics.simulation import Simulation, simulation
from bearing.geometry import Race
from bearing.library.names import matching_name
from bearing.material import Material, list_materials, load_material
from ehl.traction.laws import four_constants
from postprocess.dynamics.history import HistoryWriter
from postprocess.dynamics.results import DynamicsResults

from ..dynamics_plan import DynamicsPlan
from ..format.case import Case
from ..format.problems import CaseError
from ..version import version
from .films import Progress
from .interrupt import finish_first
from .race_tables import read_race_tables
from .traction_table import run_table

CAGE_MATERIAL = "pa66"  # where a case names none
DIMENSIONS = (
    "ball_diameter",
    "pitch_diameter",
    "inner_groove_radius",
    "outer_groove_radius",
    "diametral_clearance",
    "first_ball_azimuth",
    "bore",
    "outside_diameter",
    "width",
)
MILLISECONDS = 1000.0  # the progress counts in these


class Interrupted(KeyboardInterrupt):
    """A simulation stopped on the way, with what it has so far."""

    def __init__(self, results: DynamicsResults, simulation: Simulation) -> None:
        super().__init__()
        self.results, self.simulation = results, simulation


def run_dynamics(
    case: Case,
    name: str,
    history: Path,
    restart: Path | None = None,
    tables: Path | None = None,
    progress: Progress | None = None,
) -> DynamicsResults:
    """Simulate a case.

    Parameters
    ----------
    name : str
        Of the case, for messages.
    history : Path
        File the history is streamed to.
    restart : Path, optional
        File of an interrupted simulation of the same case to go on from.
    tables : Path, optional
        Traction tables from `oilfilm table`, instead of new ones.
    progress : callable, optional
        Called with milliseconds done, milliseconds in all, and the time still to go.

    Raises
    ------
    CaseError
        If the case has no [dynamics], or cannot be simulated.
    Interrupted
        With what there is so far, on Ctrl-C.
    """
    notify = progress or (lambda done, total, state: None)
    plan = _plan(case, name)
    if tables is not None and plan.friction != "table":
        raise CaseError(
            [
                f'{name}: traction tables are for dynamics.friction = "table", found '
                f'"{plan.friction}"'
            ]
        )
    try:
        model = build_model(case, plan, tables, notify)
        made = simulation(case.bearing, case.operation, model)
        if restart is not None:
            load_restart(made, restart, case_key(case))
            made.messages.append(
                f"dynamics: gone on at t = {made.state.time:.6g} s; loads of the summary "
                "from there"
            )
    except ValueError as problem:
        raise CaseError([f"{name}: {problem}"]) from problem
    return _stream(case, made, history, notify)


def _plan(case: Case, name: str) -> DynamicsPlan:
    if case.dynamics is None:
        raise CaseError(
            [f"{name}: has no table [dynamics]; it needs end_time_s, see docs/reference/cases.md"]
        )
    if case.rows is not None and len(case.rows) > 1:
        raise CaseError([f"{name}: [[rows]]: a simulation takes one row of balls"])
    return case.dynamics


def case_key(case: Case) -> str:
    """The case as run in one line, by which a restart file knows it."""
    return json.dumps(case.document, sort_keys=True)


def _stream(case: Case, made: Simulation, history: Path, notify: Progress) -> DynamicsResults:
    """Step, write, count; on Ctrl-C what there is so far goes up with `Interrupted`."""
    began = perf_counter()
    running = RunningStatistics(case.bearing.balls)
    end = made.model.options.end_time
    first = made.state.time
    attributes = _attributes(case)

    def results() -> DynamicsResults:
        return DynamicsResults(
            version=version(),
            case=case.document,
            simulation=made,
            running=running,
            history=history,
            messages=(*case.warnings, *_assumed(made.model), *made.messages),
            timing={"simulation": made.wall, "total": perf_counter() - began},
        )

    with HistoryWriter(history, case.bearing.balls, attributes) as writer:
        try:
            pieces = made.pieces()
            while True:
                # state, history and statistics stay in step
                with finish_first("the samples under way"):
                    record = next(pieces, None)
                    if record is not None:
                        writer.add(record)
                        running.add(record, made.start_energy)
                if record is None:
                    break
                share = (made.state.time - first) / (end - first)
                left = (perf_counter() - began) * (1.0 - share) / share
                done = round(made.state.time * MILLISECONDS)
                notify(done, round(end * MILLISECONDS), f"simulated ms, {left:.0f} s left")
        except KeyboardInterrupt:
            raise Interrupted(results(), made) from None
    return results()


def _attributes(case: Case) -> dict[str, str | float]:
    """Of the history: what it is of, and the dimensions a picture of it needs [m], [rad]."""
    attributes: dict[str, str | float] = {
        "oilfilm": version(),
        "case": case_key(case),
        "title": case.title,
    }
    for name in DIMENSIONS:
        value = getattr(case.bearing, name)
        if value is not None:
            attributes[name] = float(value)
    return attributes


def _assumed(model: DynamicsModel) -> tuple[str, ...]:
    names = [*model.ring.assumed, *(() if model.cage is None else model.cage.assumed)]
    notes = [f"dynamics: {text}" for text in model.notes.values()]
    return (
        (*notes, f"dynamics: estimated, not given: {', '.join(names)}") if names else tuple(notes)
    )


def build_model(
    case: Case, plan: DynamicsPlan, tables: Path | None, notify: Progress
) -> DynamicsModel:
    """Model of the simulation from a case: options, ring, cage, contact laws, friction, schedule
    [SI].
    """
    notes: dict[str, str] = {}
    model = DynamicsModel(
        options=_options(case, plan),
        ring=ring_body(case.bearing, plan.ring_mass, plan.ring_damping, plan.unbalance),
        friction=RaceFriction(),
        cage=_cage(case, plan, notes),
        normal=normal_contact(
            case.bearing,
            NormalLaw(plan.contact_law),
            plan.restitution,
            plan.impact_floor,
            RaceStiffness(plan.race_stiffness),
        ),
        schedule=Schedule.from_tables(case.operation, plan.speed_table, plan.load_table),
        film_viscosity=case.lubricant.viscosity if plan.cage_film else 0.0,
        friction_ramp=plan.friction_ramp,
        notes=notes,
    )
    return replace(model, friction=_friction(case, plan, model, (tables, notify)))


def _options(case: Case, plan: DynamicsPlan) -> DynamicsOptions:
    drag = 0.0
    if plan.mixture_density is not None:
        drag = drag_of_mixture(
            plan.mixture_density, case.bearing.ball_diameter, plan.drag_coefficient
        )
    elif plan.ball_drag:
        drag = drag_of_force(case.bearing, case.operation, plan.ball_drag)
    return DynamicsOptions(
        end_time=plan.end_time,
        sample_interval=plan.sample_interval,
        start=Start(plan.start),
        equations=None if plan.equations == "by load" else LoadType(plan.equations),
        tolerance=plan.tolerance,
        gravity=plan.gravity,
        drag=drag,
    )


def _cage(case: Case, plan: DynamicsPlan, notes: dict[str, str]) -> CageBody:
    name = plan.cage_material
    known = name is not None and (
        name in plan.materials or matching_name(name, list_materials()) is not None
    )
    material: Material
    if known and name is not None:
        material = plan.materials[name] if name in plan.materials else load_material(name)
    else:
        material = load_material(CAGE_MATERIAL)
        notes["cage"] = (
            f"cage material {'not given' if name is None else repr(name) + ' unknown'}: "
            f"{CAGE_MATERIAL}"
        )
    return cage_body(case.bearing, material, **plan.cage)


def _friction(
    case: Case, plan: DynamicsPlan, model: DynamicsModel, source: tuple[Path | None, Progress]
) -> RaceFriction:
    if plan.friction == "none":
        return RaceFriction()
    angles = starting_point(case.bearing, case.operation, model).angles
    if plan.friction == "coulomb":
        mu, low, high = plan.coulomb
        return coulomb_friction(case.bearing, angles, mu, (low, high), at_centre=plan.at_centre)
    if plan.friction == "four constants":
        constants = four_constants(*plan.four_constants)
        return four_constant_friction(case.bearing, angles, constants, at_centre=plan.at_centre)
    return _tables(case, *source)


def _tables(case: Case, path: Path | None, notify: Progress) -> RaceFriction:
    """Traction tables of both races, read or made."""
    if path is None:
        found = run_table(case, progress=notify).tables
    else:
        assert case.rheology is not None  # of every bearing case
        found = read_race_tables(
            path, case.bearing, case.lubricant, case.rheology, case.films.solids
        )
    return RaceFriction(inner=found[Race.INNER], outer=found[Race.OUTER])

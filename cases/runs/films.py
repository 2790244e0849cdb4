"""Films of the contacts of a bearing, equal ones solved once in parallel; strength of rings."""

from collections.abc import Callable, Sequence
from concurrent.futures import Future, as_completed
from dataclasses import fields, replace
from math import degrees, isclose
from typing import NamedTuple

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.motion import ContactTraction
from oilfilm.bearing.contacts.stress import SurfaceTension, surface_tensions
from oilfilm.bearing.films.film import ContactFilm
from oilfilm.bearing.films.operating_film import on_tracks
from oilfilm.bearing.films.unsolved_films import (
    CELLS_BY_POINTS,
    CELLS_BY_TOLERANCE,
    formula_films,
    resolvable,
    too_thick,
)
from oilfilm.bearing.fits.ring_strength import Strength, ring_strengths, strength_map
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.supply.inlet_oil import OilAtInlets, Supply
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.ehl import ContactConditions, ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.atlas.field_maps import field_maps
from oilfilm.ehl.multigrid.threads import cores, film_threads
from oilfilm.ehl.oil.lubricant import InletLayer

from ..format.case import Case
from ..format.contact import FilmModel, FilmSource
from ..format.fields import rounded
from ..format.film_model import FilmPhysics
from ..format.rows import ball_at

SolveOne = Callable[[ContactConditions, SolverOptions], ContactSolution]
# with the film model of the case, too
Solve = Callable[[ContactConditions, SolverOptions, FilmPhysics], ContactSolution]
Progress = Callable[[int, int, str], None]  # done, in all, what is being done

LARGE_CONTACT = 513  # points from which several threads solve one contact faster than one does [-]
EQUALITY_RTOL = 1e-9  # relative difference below which two contacts count as one [-]
# compared absolutely, too
MAY_BE_ZERO = ("entrainment_angle", "slide_roll_ratio", "lateral_slide_ratio", "spin", "mean_spin")


def wanted_contacts(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[list[ContactConditions | None], tuple[str, ...]]:
    """Contacts to solve.

    Parameters
    ----------
    case : Case
        The bearing.
    state : QuasistaticSolution
        Its equilibrium.
    contacts : Sequence[BearingContact]
        Its contacts.

    Returns
    -------
    conditions
        Conditions of each contact; None for those without a solve.
    messages
        A message if there is no equilibrium.
    """
    if not state.converged:
        return [None] * len(contacts), ("no film was computed, since there is no equilibrium",)
    chosen = _chosen_balls(case, contacts)
    # the gap decides the film of a ball that only films load: it is not solved
    floating = {c.ball for c in contacts if c.gap is not None and not state.inner_load[c.ball - 1]}
    wanted = [c.conditions if c.ball in chosen - floating else None for c in contacts]
    if case.inlet_layer is not None:
        layers = inlet_layers(case.inlet_layer, state, contacts)
        pairs = zip(wanted, layers, strict=True)
        wanted = [own and replace(own, inlet_layer=layer) for own, layer in pairs]
    return wanted, ()


class FilmPlan(NamedTuple):
    """Sources of the films of contacts; None for the others."""

    wanted: list[ContactConditions | None]  # that are solved
    # contacts that the mesh does not resolve, at the lowest speed at which it does
    bases: list[ContactConditions | None]
    atlas: list[ContactFilm | None]  # of the film atlas, with their fields


def film_plan(
    case: Case, contacts: Sequence[BearingContact], wanted: Sequence[ContactConditions | None]
) -> FilmPlan:
    """Split contacts into those of the film atlas, those that are solved, and those that the mesh
    does not resolve.

    Behind layers all contacts are solved.

    Parameters
    ----------
    case : Case
        The bearing.
    contacts : Sequence[BearingContact]
        Its contacts.
    wanted : Sequence[ContactConditions | None]
        Conditions of each contact that is asked for; None for the others.

    Returns
    -------
    FilmPlan
        Films of the atlas, contacts that are solved, and contacts at the lowest resolved speed.
    """
    options = case.solver
    by_tolerance = options.wanted_tolerance is not None
    cells = CELLS_BY_TOLERANCE if by_tolerance else CELLS_BY_POINTS
    atlas = _of_atlas(case, contacts, wanted)
    none = case.film_source is FilmSource.ATLAS
    solved: list[ContactConditions | None] = []
    bases: list[ContactConditions | None] = []
    for own, known in zip(wanted, atlas, strict=True):
        base = None
        if known is not None or none:
            solved.append(None)
        elif own is not None and own.inlet_layer is None:
            fine = None if too_thick(own) else resolvable(own, options.max_points, cells)
            base = None if fine is own else fine
            solved.append(own if fine is own else None)
        else:
            solved.append(own)
        bases.append(base)
    return FilmPlan(solved, bases, atlas)


def _of_atlas(
    case: Case, contacts: Sequence[BearingContact], wanted: Sequence[ContactConditions | None]
) -> list[ContactFilm | None]:
    """Films of the atlas with their fields, one for equal contacts, those of formulas where none
    is to be solved; None where a contact is solved.
    """
    films: list[ContactFilm | None] = [None] * len(contacts)
    solved = case.film_source is FilmSource.SOLVED or case.inlet_layer is not None
    if solved or case.films.model is not FilmModel.NEWTONIAN:
        return films
    groups = _groups(wanted)
    if case.film_source is FilmSource.AUTO:
        asked = [n for n, own in enumerate(wanted) if own is not None]
        heaviest = {
            max((n for n in asked if contacts[n].race is race), key=lambda n: contacts[n].load)
            for race in {contacts[n].race for n in asked}
        }
        groups = [members for members in groups if not heaviest.intersection(members)]
    chosen = [contacts[members[0]] for members in groups]
    fields = field_maps([own for members in groups if (own := wanted[members[0]]) is not None])
    for members, film, field in zip(groups, formula_films(chosen), fields, strict=True):
        conditions = wanted[members[0]]
        if film is None or conditions is None or too_thick(conditions):
            continue
        if field is not None or case.film_source is FilmSource.ATLAS:
            shared = replace(film, field=field)
            for n in members:
                films[n] = shared
    return films


def inlet_layers(
    given: InletLayer | Supply, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> list[InletLayer | None]:
    """Layer of oil at the inlet of each contact.

    A flow has the layer of its steady state by the flooded films of formulas.

    Parameters
    ----------
    given : InletLayer | Supply
        The layer, or the flow.
    state : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : Sequence[BearingContact]
        Its contacts.

    Returns
    -------
    list[InletLayer | None]
        The layers [m]; None without lubrication, or without a flooded film.
    """
    if isinstance(given, InletLayer):
        return [given] * len(contacts)
    oil = on_tracks(OilAtInlets(oil=given, balls=state.bearing.balls), contacts)
    layers: list[InletLayer | None] = []
    for contact in contacts:
        own = contact.conditions
        layer = 0.0
        if own is not None and own.lubricant.piezoviscous:
            layer = oil.layer_of(contact).thickness
        # equal contacts have equal layers, to rounding of their loads
        layers.append(InletLayer(thickness=(rounded(layer),)) if layer > 0.0 else None)
    return layers


def _chosen_balls(case: Case, contacts: Sequence[BearingContact]) -> set[int]:
    """Balls whose contacts `film_maps` selects; loaded: the inner race carries load."""
    if case.film_maps == "none":
        return set()
    if case.film_maps == "all":
        return {c.ball for c in contacts}
    if case.film_maps == "loaded":
        return {c.ball for c in contacts if c.race.value == "inner" and c.load > 0.0}
    wanted = [degrees(azimuth) for azimuth in case.film_maps if not isinstance(azimuth, str)]
    return {
        c.ball
        for c in contacts
        if any(ball_at(at, (degrees(c.azimuth),)) is not None for at in wanted)
    }


def oil_at_inlets(case: Case) -> OilAtInlets | None:
    """Oil that the contacts of a case get.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    OilAtInlets | None
        The oil; None: ample.
    """
    friction = case.friction or FrictionInput()
    return friction.oil_at_inlets(case.inlet, case.bearing.balls)


def equal_contacts(first: ContactConditions, second: ContactConditions) -> bool:
    """Tell whether two contacts with the same oil are equal to `EQUALITY_RTOL`.

    Parameters
    ----------
    first, second : ContactConditions
        The contacts.

    Returns
    -------
    bool
        True if they are.
    """
    for field in fields(first):
        a, b = getattr(first, field.name), getattr(second, field.name)
        if isinstance(a, float) and isinstance(b, float):
            absolute = EQUALITY_RTOL if field.name in MAY_BE_ZERO else 0.0
            if not isclose(a, b, rel_tol=EQUALITY_RTOL, abs_tol=absolute):
                return False
        elif a != b:
            return False
    return True


def _groups(conditions: Sequence[ContactConditions | None]) -> list[list[int]]:
    """Indices of equal contacts, one list each."""
    groups: list[tuple[ContactConditions, list[int]]] = []
    for index, contact in enumerate(conditions):
        if contact is None:
            continue
        for known, members in groups:
            if equal_contacts(known, contact):
                members.append(index)
                break
        else:
            groups.append((contact, [index]))
    return [members for _, members in groups]


def shared_options(options: SolverOptions, threads: int) -> SolverOptions:
    """The options with several threads for one contact, if it is large enough to gain by them.

    Parameters
    ----------
    options : SolverOptions
        Grid of the solver.
    threads : int
        Threads for a contact [-].

    Returns
    -------
    SolverOptions
        The options.
    """
    shared = threads > 1 and options.max_points >= LARGE_CONTACT
    return replace(options, threads=threads) if shared else options


def film_solver(solve: Solve | None, films: FilmPhysics) -> SolveOne | None:
    """The solver of one film by the film model of a case.

    Parameters
    ----------
    solve : Solve | None
        Solver that takes the place of the film model's own.
    films : FilmPhysics
        Film model.

    Returns
    -------
    SolveOne | None
        The solver; None: `oilfilm.ehl.solve_contact`.
    """
    if solve is not None:
        return lambda conditions, options: solve(conditions, options, films)
    return None if films.model is FilmModel.NEWTONIAN else films.solve


def solve_contacts(
    conditions: Sequence[ContactConditions | None],
    options: SolverOptions,
    workers: int | None,
    notify: Progress,
    solve: SolveOne | None,
) -> tuple[tuple[ContactSolution | None, ...], bool]:
    """Films of the distinct contacts, several at a time.

    Only if they are large, and fewer than half the workers, does each have several threads.

    Parameters
    ----------
    conditions : Sequence[ContactConditions | None]
        Conditions of each contact; None for those without a solve.
    options : SolverOptions
        Grid of the solver.
    workers : int | None
        Contacts solved at a time [-]; None: as many as there are cores.
    notify : Progress
        Called with films done, films in all, and a text.
    solve : SolveOne | None
        Solver of one film; None: `oilfilm.ehl.solve_contact`.

    Returns
    -------
    films
        The films.
    interrupted
        True after Ctrl-C, with the finished films.
    """
    solutions: list[ContactSolution | None] = [None] * len(conditions)
    groups = _groups(conditions)
    if not groups:
        return tuple(solutions), False
    workers = workers or cores()
    options = shared_options(options, workers // len(groups))
    notify(0, len(groups), "films")
    try:
        with film_threads(min(workers, len(groups))) as pool:
            jobs: dict[Future[ContactSolution], list[int]] = {}
            for members in groups:
                first = conditions[members[0]]
                assert first is not None  # only contacts with conditions are grouped
                jobs[pool.submit(solve or solve_contact, first, options)] = members
            for done, job in enumerate(as_completed(jobs), 1):
                for index in jobs[job]:
                    solutions[index] = job.result()
                notify(done, len(groups), "films")
    except KeyboardInterrupt:
        return tuple(solutions), True
    return tuple(solutions), False


def case_strength(case: Case) -> Strength:
    """Hoop tension of the rings; of a brittle inner ring on a shaft also over temperature and
    speed.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    Strength
        Tensions and strengths.
    """
    rings = ring_strengths(case.bearing, case.operation, case.clearance)
    seats = case.seats
    brittle = case.bearing.inner_ring_material.bending_strength is not None
    if seats.fit is None or not brittle:
        return Strength(rings=rings)
    inner = strength_map(case.bearing, case.operation, seats.fit, seats.rise, seats.reference)
    return Strength(rings=rings, inner_map=inner)


def contact_tensions(
    case: Case,
    solutions: Sequence[ContactSolution | None],
    tractions: Sequence[ContactTraction | None],
) -> tuple[SurfaceTension | None, ...]:
    """Tension in the surfaces of the contacts that have films and a brittle body.

    Parameters
    ----------
    case : Case
        The bearing.
    solutions : Sequence[ContactSolution | None]
        Solved films of the contacts.
    tractions : Sequence[ContactTraction | None]
        Shear of the contacts.

    Returns
    -------
    tuple[SurfaceTension | None, ...]
        The tensions; None without film or brittle body.
    """
    if case.rheology is None:
        return ()
    rings = ring_strengths(case.bearing, case.operation, case.clearance)
    hoop = Strength(rings=rings).groove_tension()
    temperature = case.operation.temperature
    return surface_tensions(case.bearing, solutions, tractions, case.rheology, hoop, temperature)

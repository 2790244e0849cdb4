"""Run a case: equilibrium of the bearing, then the film of every distinct contact."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import fields, replace
from math import degrees, isclose
from time import perf_counter
from typing import TYPE_CHECKING

from .case import Case, ContactCase
from .checks import ball_at
from .film_model import FilmModel
from .heating import self_heated
from .traction_films import traction_messages, with_workers
from .version import version

if TYPE_CHECKING:
    from bearing.contacts import BearingContact
    from bearing.operation import Model
    from bearing.quasistatic import QuasistaticSolution
    from bearing.torque.breakdown import TorqueBreakdown
    from bearing.torque.shear_torque import SolvedShear
    from bearing.traction_forces import ContactTraction
    from ehl import ContactConditions, ContactSolution, SolverOptions
    from ehl.traction import TractionResult
    from postprocess.results import BearingResults, ContactResults

LARGE_CONTACT = 513  # points from which several threads solve one contact faster than one does [-]
Solve = Callable[["ContactConditions", "SolverOptions"], "ContactSolution"]
Progress = Callable[[int, int, str], None]  # contacts done, contacts in all, what is being done
EQUAL = 1e-9  # relative difference below which two contacts count as one [-]
FINITE_ELEMENT_MESSAGES = ("finite elements: points are those of the graded mesh, cycles are Newton steps, no FFT",)
# compared absolutely, too
MAY_BE_ZERO = ("entrainment_angle", "slide_roll_ratio", "lateral_slide_ratio", "spin", "mean_spin")


class Interrupted(Exception):  # noqa: N818
    """The user stopped the run; `results` holds the finished parts, or is None."""

    def __init__(self, results: BearingResults | None) -> None:
        self.results = results
        super().__init__("interrupted")


def cores() -> int:
    """Cores this process may use [-]."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_case(
    case: Case, workers: int | None = None, progress: Progress | None = None, solve: Solve | None = None
) -> BearingResults:
    """Solve the bearing and the film of its contacts.

    Parameters
    ----------
    case : Case
    workers : int, optional
        Contacts solved at a time [-]; as many as there are cores if left out.
    progress : callable, optional
        Called with the contacts done, the contacts in all, and a word on the state.
    solve : callable, optional
        Takes the place of `ehl.solve_contact`: a batch looks up what it has solved before.

    Returns
    -------
    BearingResults

    Raises
    ------
    Interrupted
        On Ctrl-C, with the results of the finished contacts.
    """
    from bearing.contacts import contact_conditions
    from bearing.frequencies import bearing_frequencies
    from bearing.life import bearing_life
    from postprocess.results import BearingResults

    notify = progress or (lambda done, total, state: None)
    notify(0, 1, "equilibrium of the bearing")
    start = perf_counter()
    state = _equilibrium(case, with_workers(case.model, workers, notify, solve))
    contacts = contact_conditions(state, case.lubricant)
    timing = {"quasistatic": perf_counter() - start}
    wanted, messages = wanted_contacts(case, state, contacts)
    start = perf_counter()
    solver = solve if case.films.model is FilmModel.NEWTONIAN else case.films.solve
    solutions, interrupted = solve_contacts(wanted, case.solver, workers, notify, solver)
    timing |= {"contacts": perf_counter() - start, "total": sum(timing.values()) + perf_counter() - start}
    if interrupted:
        messages = (*messages, "interrupted: the films that were not finished are null")
    tractions, torque = _friction(case, state, contacts, solutions, timing)
    results = BearingResults(
        version=version(),
        case=case.document,
        quasistatic=state,
        lubricant=case.lubricant,
        contacts=contacts,
        solutions=solutions,
        frequencies=bearing_frequencies(state),
        messages=(*case.warnings, *case.films.messages, *traction_messages(state, contacts), *messages),
        interrupted=interrupted,
        timing=timing,
        life=None if case.rating is None else bearing_life(state, case.lubricant, case.rating),
        clearance=case.clearance,
        tractions=tractions,
        torque=torque,
        heating=self_heated(case) if state.converged else None,
    )
    if interrupted:
        raise Interrupted(results if any(solution is not None for solution in solutions) else None)
    return results


def _equilibrium(case: Case, model: Model) -> QuasistaticSolution:
    """Loads, angles and motion of the balls; on Ctrl-C, while films are solved for the traction, `Interrupted`."""
    from bearing.quasistatic import solve_quasistatic
    from bearing.rows import SINGLE

    try:
        return solve_quasistatic(case.bearing, case.operation, model, rows=case.rows or SINGLE)
    except KeyboardInterrupt:
        raise Interrupted(None) from None


def _friction(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None],
    timing: dict[str, float],
) -> tuple[tuple[ContactTraction | None, ...], TorqueBreakdown | None]:
    """Shear of the contacts, with the balls in traction equilibrium where that was found, and the friction torque."""
    start = perf_counter()
    torque = _torque(case, state, contacts, solutions)
    tractions = _tractions(case, state, contacts, solutions)
    if torque is not None and torque.shear is not None:
        known = {(t.contact.ball, t.contact.race): t for t in torque.shear.tractions}
        tractions = tuple(t and known.get((t.contact.ball, t.contact.race), t) for t in tractions)
    timing |= {"torque": perf_counter() - start, "total": timing["total"] + perf_counter() - start}
    return tractions, torque


def _tractions(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None],
) -> tuple[ContactTraction | None, ...]:
    """Shear of every contact that has a film, at the motion of the equilibrium."""
    from bearing.traction_forces import contact_traction

    rheology = case.rheology

    def traction(contact: BearingContact, film: ContactSolution | None) -> ContactTraction | None:
        if film is None or rheology is None or not film.converged:
            return None
        return contact_traction(state, contact, film, rheology)

    return tuple(traction(contact, film) for contact, film in zip(contacts, solutions, strict=True))


def _torque(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None],
) -> TorqueBreakdown | None:
    """Friction torque by every model; the integrated one needs a friction law, or the films of all contacts."""
    from bearing.torque.breakdown import torque_breakdown

    if case.friction is None or not state.converged:
        return None
    shear = None
    if state.operation.inner_speed != state.operation.outer_speed:
        shear = _law_shear(state, contacts) or _film_shear(case, state, contacts, solutions)
    return torque_breakdown(state, contacts, case.lubricant, case.friction, shear=shear, solutions=solutions)


def _law_shear(state: QuasistaticSolution, contacts: Sequence[BearingContact]) -> SolvedShear | None:
    """Torque by the friction law that the case names; None where it takes that of its films."""
    from bearing.torque.tabulated import law_torque
    from bearing.torque.traction_source import FilmTraction

    traction = state.model.traction
    if traction is None or isinstance(traction.source, FilmTraction):
        return None
    law = traction.source.prepare(state, contacts).law(state, contacts)
    return law_torque(state, contacts, law, traction.resistance)


def _film_shear(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None],
) -> SolvedShear | None:
    """Torque by the shear of the films; None unless those of all lubricated contacts converged."""
    from bearing.torque.integrated import Asperities, solved_shear
    from bearing.torque.resistance import FREE

    solved = [film is not None and film.converged for film in solutions]
    complete = all(film for film, contact in zip(solved, contacts, strict=True) if contact.loaded) and any(solved)
    if not complete or case.rheology is None or case.friction is None:
        return None
    asperities, rough = None, case.friction.roughness
    if rough is not None:
        asperities = Asperities(inner_roughness=rough[0], outer_roughness=rough[1], boundary=case.friction.boundary)
    resistance = FREE if state.model.traction is None else state.model.traction.resistance
    return solved_shear(state, contacts, solutions, case.rheology, asperities, resistance)


def run_contact(case: ContactCase, *, finite_element: bool = False, workers: int = 1) -> ContactResults:
    """Solve a single contact, by multigrid or by finite elements; times in the result are in [s].

    A large contact is shared by as many threads as there are `workers` [-].
    """
    from postprocess.results import ContactResults

    messages = (*case.warnings, *case.films.messages)
    if finite_element:
        from ehl.finite_element import solve_contact_finite_element as solve_contact

        messages = (*messages, *FINITE_ELEMENT_MESSAGES)
        if case.solver.tolerance is not None:
            messages = (*messages, "ehl.tolerance: not used by finite elements, the film is solved on ehl.points")
    else:
        solve_contact = _contact_solver(case)
    start = perf_counter()
    solution = solve_contact(case.conditions, _shared(case.solver, workers))
    traction = _contact_traction(case, solution)
    return ContactResults(
        version=version(),
        case=case.document,
        solution=solution,
        messages=messages,
        timing={"total": perf_counter() - start},
        traction=traction,
    )


def _contact_solver(case: ContactCase) -> Callable[..., ContactSolution]:
    if case.films.model is FilmModel.NEWTONIAN:
        from ehl import solve_contact

        return solve_contact
    return case.films.solve


def _contact_traction(case: ContactCase, solution: ContactSolution) -> TractionResult | None:
    """Shear of a single contact with lengths, None where the film did not converge."""
    from ehl import ContactConditions
    from ehl.traction import contact_kinematics, integrate_traction

    if not isinstance(case.conditions, ContactConditions) or case.rheology is None or not solution.converged:
        return None
    motion = contact_kinematics(case.conditions, grid_angle=solution.frame_angle)
    return integrate_traction(solution, motion, case.rheology, temperature=case.temperature)


def wanted_contacts(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[list[ContactConditions | None], tuple[str, ...]]:
    """Conditions of the contacts to solve, None for the others, and a message if there is no equilibrium.

    Parameters
    ----------
    case : Case
    state : QuasistaticSolution
    contacts : sequence of BearingContact
        Inner race then outer, ball by ball.

    Returns
    -------
    list of ContactConditions or None, tuple of str
    """
    conditions = [contact.conditions for contact in contacts]
    if not state.converged:
        return [None] * len(contacts), ("no film was computed, since there is no equilibrium",)
    if case.film_maps == "all":
        return conditions, ()
    chosen = _chosen_balls(case, contacts)
    return [conditions[i] if contact.ball in chosen else None for i, contact in enumerate(contacts)], ()


def _chosen_balls(case: Case, contacts: Sequence[BearingContact]) -> set[int]:
    """Numbers of the balls whose contacts `film_maps` asks for; loaded means that the inner race carries load."""
    if case.film_maps == "none":
        return set()
    if case.film_maps == "loaded":
        return {c.ball for c in contacts if c.race.value == "inner" and c.load > 0.0}
    wanted = [degrees(azimuth) for azimuth in case.film_maps if not isinstance(azimuth, str)]
    return {c.ball for c in contacts if any(ball_at(at, (degrees(c.azimuth),)) is not None for at in wanted)}


def equal_contacts(first: ContactConditions, second: ContactConditions) -> bool:
    """Whether two contacts are one to `EQUAL` relative [-]; the oil must be the same."""
    for field in fields(first):
        a, b = getattr(first, field.name), getattr(second, field.name)
        if isinstance(a, float) and isinstance(b, float):
            if not isclose(a, b, rel_tol=EQUAL, abs_tol=EQUAL if field.name in MAY_BE_ZERO else 0.0):
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


def _shared(options: SolverOptions, threads: int) -> SolverOptions:
    """The options with so many threads a contact, if it is large enough to gain by them."""
    return replace(options, threads=threads) if threads > 1 and options.points >= LARGE_CONTACT else options


def solve_contacts(
    conditions: Sequence[ContactConditions | None],
    options: SolverOptions,
    workers: int | None,
    notify: Progress,
    solve: Solve | None,
) -> tuple[tuple[ContactSolution | None, ...], bool]:
    """Films of the distinct contacts, several at a time: the kernels release the interpreter's lock.

    Only if they are large, and fewer than half the workers, does each get several threads.
    """
    solutions: list[ContactSolution | None] = [None] * len(conditions)
    groups = _groups(conditions)
    if not groups:
        return tuple(solutions), False
    from ehl import solve_contact

    solver, workers = solve or solve_contact, workers or cores()
    options = _shared(options, workers // len(groups))
    notify(0, len(groups), "films")
    pool = ThreadPoolExecutor(max_workers=min(workers, len(groups)))
    try:
        jobs: dict[Future[ContactSolution], list[int]] = {}
        for members in groups:
            first = conditions[members[0]]
            assert first is not None  # only contacts with conditions are grouped
            jobs[pool.submit(solver, first, options)] = members
        for done, job in enumerate(as_completed(jobs), 1):
            for index in jobs[job]:
                solutions[index] = job.result()
            notify(done, len(groups), "films")
    except KeyboardInterrupt:
        return tuple(solutions), True
    finally:
        pool.shutdown(wait=True, cancel_futures=True)
    return tuple(solutions), False

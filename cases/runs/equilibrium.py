"""Equilibrium of a case: under a hypothesis on the balls, or in traction equilibrium.

Traction equilibrium takes its friction from the films of the run, on a coarser grid.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from math import isclose
from typing import Any

import numpy as np

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.motion import ContactTraction, bearing_kinematics, contact_traction
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.equilibrium import solve_traction_equilibrium
from oilfilm.bearing.friction.friction_sources import FilmTraction, LawTraction
from oilfilm.bearing.friction.tables import SAME_RADIUS
from oilfilm.bearing.geometry import SINGLE, Bearing, Row
from oilfilm.bearing.operation import BallKinematics, Operation, QuasistaticModel
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.ehl import ContactConditions, ContactSolution
from oilfilm.ehl.messages import OUTSIDE_TABLE, Caution
from oilfilm.ehl.traction_table.table import TractionTable

from ..format.case import Case
from ..format.film_model import CaseFilms
from .films import Progress, Solve, film_solver, solve_contacts

MOST_STORED = 1000  # equilibria, some 10 kB each
ANY_TEMPERATURE = 293.15  # of all operations that have one equilibrium [K]


@dataclass(frozen=True, kw_only=True)
class PooledFilms:
    """Solves the films of many contacts side by side, equal ones once."""

    case: CaseFilms
    # likewise in `run_case`
    workers: int | None = None
    progress: Progress | None = None
    solve: Solve | None = None

    def __call__(
        self, conditions: Sequence[ContactConditions | None]
    ) -> Sequence[ContactSolution | None]:
        """Films [m] of the contacts that have conditions; KeyboardInterrupt on Ctrl-C."""
        solver = film_solver(self.solve, self.case.films)
        notify = self.progress or (lambda done, total, state: None)
        solutions, interrupted = solve_contacts(
            conditions, self.case.options, self.workers, notify, solver
        )
        if interrupted:
            raise KeyboardInterrupt
        return solutions


def with_workers(
    traction: BallTraction,
    workers: int | None = None,
    progress: Progress | None = None,
    solve: Solve | None = None,
) -> BallTraction:
    """The friction, with its films solved by several workers.

    Parameters
    ----------
    traction : BallTraction
        Friction of balls on races.
    workers : int | None, optional
        Contacts solved at a time [-]; None: as many as there are cores.
    progress : Progress | None, optional
        Called with films done, films in all, and a text.
    solve : Solve | None, optional
        Solver of one film in place of the film model's own.

    Returns
    -------
    BallTraction
        The friction.
    """
    if not isinstance(traction.source, FilmTraction):
        return traction
    source = traction.source
    if not isinstance(source.solve, CaseFilms):
        return traction

    def notify(done: int, total: int, state: str) -> None:
        if progress is not None:
            progress(done, total, f"{state} for the traction")

    pooled = PooledFilms(case=source.solve, workers=workers, progress=notify, solve=solve)
    return replace(traction, source=replace(source, solve=pooled))


def traction_messages(
    traction: BallTraction | None, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[str, ...]:
    """Messages on the source of the friction of balls on races, and on contacts outside a table.

    Parameters
    ----------
    traction : BallTraction | None
        The friction, where there is one.
    state : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : Sequence[BearingContact]
        Its contacts.

    Returns
    -------
    tuple[str, ...]
        The messages.
    """
    if traction is None:
        return ()
    origin = f"friction of balls on races: {traction.source.description}"
    if state.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        origin = f"balls in traction equilibrium; {origin}"
        origin += f"; {state.message}" if state.converged else ""
    return (origin, *_outside(traction, state, contacts))


def _outside(
    traction: BallTraction, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[str, ...]:
    """A message if a table's range does not hold a contact at its motion."""
    source = traction.source
    if not isinstance(source, LawTraction):
        return ()
    places = {}
    for contact in contacts:
        if contact.conditions is not None:
            k = bearing_kinematics(state, contact)
            u = contact.conditions.entrainment_speed
            law = source.laws[contact.race]
            outside = law.forces(contact.load, u, k.sliding_x, k.sliding_y, k.spin).outside
            radius = contact.conditions.radius_x
            if isinstance(law, TractionTable) and not isclose(
                radius, law.contact.radius_x, rel_tol=SAME_RADIUS
            ):
                outside = (*outside, "rolling radius")
            if outside:
                places[f"{contact.race.value} race of ball {contact.ball}"] = ", ".join(outside)
    if not places:
        return ()
    first = next(iter(places))
    where = f"{len(places)} of {len(contacts)} contacts, first the {first} ({places[first]})"
    counted = "the nearest place counts, in proportion to the load"
    return (Caution(f"{OUTSIDE_TABLE} at {where}; {counted}"),)


def contact_tractions(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None],
    balanced: Sequence[ContactTraction],
) -> tuple[ContactTraction | None, ...]:
    """Shear of every contact that has a film: as balanced, or at the motion of the equilibrium.

    Parameters
    ----------
    case : Case
        The bearing.
    state : QuasistaticSolution
        Its equilibrium.
    contacts : Sequence[BearingContact]
        Its contacts.
    solutions : Sequence[ContactSolution | None]
        Solved films of the contacts.
    balanced : Sequence[ContactTraction]
        Shear of the contacts whose balls are balanced.

    Returns
    -------
    tuple[ContactTraction | None, ...]
        The shear; None without a film.
    """
    rheology = case.rheology
    if rheology is None:
        return (None,) * len(contacts)
    known = {(t.contact.ball, t.contact.race): t for t in balanced}
    return tuple(
        known.get((c.ball, c.race)) or contact_traction(state, c, film, rheology)
        if film and film.converged
        else None
        for c, film in zip(contacts, solutions, strict=True)
    )


def equilibrium_solver(case: Case) -> Callable[..., QuasistaticSolution]:
    """The solver for the ball kinematics of a case.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    Callable[..., QuasistaticSolution]
        Function with the parameters of `solve_quasistatic`.

    Raises
    ------
    ValueError
        If traction equilibrium has no friction of ball on race.
    """
    if case.model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return solve_quasistatic
    if case.traction is None:
        raise ValueError("traction equilibrium needs the friction of ball on race, found none")
    return partial(solve_traction_equilibrium, traction=with_workers(case.traction))


def without_traction_equilibrium(model: QuasistaticModel) -> QuasistaticModel:
    """Half and half in place of traction equilibrium: loads hardly depend on it.

    Parameters
    ----------
    model : QuasistaticModel
        Assumptions of the bearing model.

    Returns
    -------
    QuasistaticModel
        The assumptions with a hypothesis on the balls.
    """
    if model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return model
    return replace(model, ball_kinematics=BallKinematics.HALF_AND_HALF)


class Equilibria:
    """Equilibria under a hypothesis on the balls, each solved once for all cases that have it.

    Temperature has no effect on them but through the bearing's clearance, nor have oil and
    surfaces: points of a batch that differ in these have one.
    """

    def __init__(self) -> None:
        self._solved: dict[tuple[Any, ...], QuasistaticSolution] = {}

    def of(
        self, bearing: Bearing, operation: Operation, model: QuasistaticModel, rows: Sequence[Row]
    ) -> QuasistaticSolution:
        """The equilibrium under a hypothesis on the balls, solved once for equal inputs.

        Parameters
        ----------
        bearing : Bearing
            The bearing.
        operation : Operation
            Speeds and loads.
        model : QuasistaticModel
            Assumptions of the bearing model.
        rows : Sequence[Row]
            Rows of balls.

        Returns
        -------
        QuasistaticSolution
            Loads, angles and motion of the balls.
        """
        mechanical = replace(operation, temperature=ANY_TEMPERATURE)
        key = (bearing, mechanical, model, tuple(rows))
        if key not in self._solved:
            if len(self._solved) >= MOST_STORED:
                del self._solved[next(iter(self._solved))]
            self._solved[key] = solve_quasistatic(bearing, mechanical, model, rows=tuple(rows))
        solved = self._solved[key]
        return replace(solved, operation=operation, **_own_arrays(solved))


def case_equilibrium(case: Case, equilibria: Equilibria | None = None) -> QuasistaticSolution:
    """Loads, angles and motion of the balls of a case.

    Parameters
    ----------
    case : Case
        A bearing case.
    equilibria : Equilibria, optional
        Those that are solved already; takes up that of the case.

    Returns
    -------
    QuasistaticSolution
        Nothing else refers to its arrays.
    """
    rows = case.rows or SINGLE
    if case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        return equilibrium_solver(case)(case.bearing, case.operation, case.model, rows=rows)
    solved = equilibria or Equilibria()
    return solved.of(case.bearing, case.operation, case.model, rows)


def _own_arrays(solution: QuasistaticSolution) -> dict[str, Any]:
    """Copies of the arrays, so that nobody changes what others share."""
    content = ((field.name, getattr(solution, field.name)) for field in fields(solution))
    return {name: value.copy() for name, value in content if isinstance(value, np.ndarray)}

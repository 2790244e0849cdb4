"""Equilibrium of a case: under a hypothesis on the balls, or in traction equilibrium."""

from collections.abc import Callable
from dataclasses import fields, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from bearing.friction.equilibrium import solve_traction_equilibrium
from bearing.geometry import Bearing
from bearing.operation import BallKinematics, Operation, QuasistaticModel
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.quasistatic.solver import solve_quasistatic
from bearing.rows import SINGLE, Row

from ..format.case import Case
from .traction_films import with_workers

MOST_KEPT = 1000  # equilibria of a process, some 10 kB each
ANY_TEMPERATURE = 293.15  # of all operations that have one equilibrium [K]


def equilibrium_solver(case: Case) -> Callable[..., QuasistaticSolution]:
    """The solver that the ball kinematics of a case asks for; called as `solve_quasistatic`."""
    if case.model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return solve_quasistatic
    if case.traction is None:
        raise ValueError("traction equilibrium needs the friction of ball on race, found none")
    return partial(solve_traction_equilibrium, traction=with_workers(case.traction))


def without_traction_equilibrium(model: QuasistaticModel) -> QuasistaticModel:
    """Half and half in place of traction equilibrium: loads hardly depend on it."""
    if model.ball_kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        return model
    return replace(model, ball_kinematics=BallKinematics.HALF_AND_HALF)


def case_equilibrium(case: Case) -> QuasistaticSolution:
    """Loads, angles and motion of the balls of a case.

    Cases with one equilibrium, as points of a batch that differ in oil or surfaces, have it solved
    once by each process.
    """
    rows = case.rows or SINGLE
    if case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        return equilibrium_solver(case)(case.bearing, case.operation, case.model, rows=rows)
    mechanical = replace(case.operation, temperature=ANY_TEMPERATURE)
    known = _equilibrium(case.bearing, mechanical, case.model, tuple(rows))
    return replace(known, operation=case.operation, **_own_arrays(known))


@lru_cache(maxsize=MOST_KEPT)
def _equilibrium(
    bearing: Bearing, operation: Operation, model: QuasistaticModel, rows: tuple[Row, ...]
) -> QuasistaticSolution:
    """The equilibrium under a hypothesis on the balls, on which temperature has no effect but
    through the bearing's clearance.
    """
    return solve_quasistatic(bearing, operation, model, rows=rows)


def _own_arrays(solution: QuasistaticSolution) -> dict[str, Any]:
    """Copies of the arrays, so that nobody changes what others share."""
    content = ((field.name, getattr(solution, field.name)) for field in fields(solution))
    return {name: value.copy() for name, value in content if isinstance(value, np.ndarray)}

"""Equilibrium of a case: under a hypothesis on the balls, or in traction equilibrium."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from bearing.friction.equilibrium import solve_traction_equilibrium
from bearing.operation import BallKinematics, QuasistaticModel
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.quasistatic.solver import solve_quasistatic
from bearing.rows import SINGLE

from ..format.case import Case
from .traction_films import with_workers


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
    """Loads, angles and motion of the balls of a case."""
    solve = equilibrium_solver(case)
    return solve(case.bearing, case.operation, case.model, rows=case.rows or SINGLE)

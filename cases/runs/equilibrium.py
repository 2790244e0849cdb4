"""Equilibrium of a case: under a hypothesis on the balls, or in traction equilibrium."""

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from bearing.friction.equilibrium import solve_traction_equilibrium
from bearing.geometry import SINGLE, Bearing, Row
from bearing.operation import BallKinematics, Operation, QuasistaticModel
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.quasistatic.solver import solve_quasistatic

from ..format.case import Case
from .traction_films import with_workers

MOST_STORED = 1000  # equilibria, some 10 kB each
ANY_TEMPERATURE = 293.15  # of all operations that have one equilibrium [K]


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

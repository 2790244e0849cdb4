"""Cycles on one level until its film is at rest, each undone and repeated with more damping where
it diverges.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf

import numpy as np

from ..arrays import Array
from .acceleration import Acceleration
from .cycle import cycle, refresh_factors, relative_residual, update_film
from .history import CONVERGED, LevelHistory, start_history
from .levels import Multigrid

MORE_CYCLES = 3  # times those allowed, on a finest level that is nearing its solution then
LEVEL_CYCLES = 3  # cycles on levels that the mesh does not resolve
# pressure P above which the iteration has diverged: the spike of a Barus oil at L 20 passes 5
PRESSURE_LIMIT = 40.0
# growth of the residual in one cycle above which it has, too, if the equations no longer hold
GROWTH_LIMIT = 10.0
# on a level, before the cycles are accelerated; those that swing are from the second on
PLAIN_CYCLES = 5
DIVERGED = (inf, inf)  # in place of residual and mass imbalance after a cycle
# between two evaluations of a flow model, which costs several: 12 contacts with heat took 18 s of
# processor with one, 14 with two. The continuation has one: with two an Eyring film of 17 m/s on
# 257 points, which rolls, stayed at a residual of 5e-4
FLOW_CYCLES = 2
HALVINGS = 3  # of the damping on one level before it counts as diverged


@dataclass(slots=True, kw_only=True)
class Progress:
    """Work and fallbacks of a contact so far, over all attempts and the pilot solve [-]."""

    fallbacks: list[str] = field(default_factory=list)  # in the order in which they were taken
    deflected_nodes: int = 0  # nodes times deflection FFTs


def iterate_level(
    state: Multigrid,
    index: int,
    most: int,
    progress: Progress,
    below: LevelHistory | None,
    strictness: float = 1.0,
) -> LevelHistory | None:
    """Cycle on a level until its film is at rest.

    At most `LEVEL_CYCLES` cycles where the mesh is too coarse for the film. On the finest level of
    a Newtonian isothermal film the cycles end when the residual stalls, and go on up to
    `MORE_CYCLES` times as often while it falls.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    most : int
        largest number of cycles [-]
    progress : Progress
        work and fallbacks so far, changed in place
    below : LevelHistory | None
        history of the next coarser level; None: there is none
    strictness : float, default 1.0
        factor on the limits that end the cycles, see `SolverOptions` [-]

    Returns
    -------
    LevelHistory | None
        history of the cycles; None if they diverged
    """
    level = state.levels[index]
    history = start_history(state, index, strictness)
    acceleration = Acceleration()
    before = (level.P.copy(), state.approach)
    finest = index == len(state.levels) - 1
    longest = MORE_CYCLES * most if finest and state.flow_model is None else most
    for equations in guarded_cycles(state, index, longest, progress):
        if equations == DIVERGED:
            return None
        history.record(state, index, equations)
        cycles = len(history.residual)
        if history.finished(below) or (
            cycles >= LEVEL_CYCLES and not finest and not history.resolved
        ):
            break
        if finest and state.flow_model is None and history.stalled:
            break
        if cycles >= most and not history.approaching_solution:
            break
        state.oscillates |= history.oscillates
        if (state.oscillates or cycles > PLAIN_CYCLES) and cycles != most:
            if (
                history.residual_grew and not state.oscillates
            ):  # a combination that does harm is forgotten
                acceleration = Acceleration()
            mixed, state.approach = acceleration.next(before, (level.P, state.approach))
            level.P = mixed if level.film_content is None else np.where(level.P > 0.0, mixed, 0.0)
            update_film(state, index)
        before = (level.P.copy(), state.approach)
    return history


def guarded_cycles(
    state: Multigrid, index: int, count: int, progress: Progress
) -> Iterator[tuple[float, float]]:
    """Run cycles on a level; one that diverges is undone and repeated with half the damping.

    If three halvings do not help, the last item is `DIVERGED`.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    count : int
        number of cycles [-]
    progress : Progress
        work and fallbacks so far, changed in place

    Yields
    ------
    Iterator[tuple[float, float]]
        residual and imbalance of `relative_residual` after each cycle [-]
    """
    last = inf
    halvings = 0
    cycles = 0
    while cycles < count:
        before = snapshot(state, index)
        equations = guarded_cycle(state, index, last, FLOW_CYCLES)
        if equations == DIVERGED:
            restore(state, index, before)
            if halvings == HALVINGS:
                yield DIVERGED
                return
            halvings += 1
            state.damping = state.damping.halved()
            progress.fallbacks.append("cycle undone, damping halved")
            continue
        last = equations[0]
        cycles += 1
        yield equations


Snapshot = tuple[Array, float, float, float]


def snapshot(state: Multigrid, index: int) -> Snapshot:
    """Copy the fields of a level that a cycle changes, for `restore`.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    Snapshot
        pressure, shape (ny, nx), approach, exterior load and load of the level [-]
    """
    level = state.levels[index]
    return level.P.copy(), state.approach, state.exterior, level.load


def restore(state: Multigrid, index: int, before: Snapshot) -> None:
    """Undo the cycles on a level since a snapshot, which may be used once.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    before : Snapshot
        pressure, shape (ny, nx), approach, exterior load and load of the level [-]
    """
    level = state.levels[index]
    level.P, state.approach, state.exterior, level.load = before
    update_film(state, index)


def guarded_cycle(
    state: Multigrid, index: int, last: float = inf, flow_cycles: int = 1
) -> tuple[float, float]:
    """Run one cycle on a level, several with a flow model, and judge it by the residual.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    last : float, default inf
        residual before the cycle [-]
    flow_cycles : int, default 1
        cycles between two evaluations of a flow model [-]

    Returns
    -------
    tuple[float, float]
        residual and imbalance of `relative_residual`, or `DIVERGED` [-]
    """
    with np.errstate(all="ignore"):  # a cycle that diverges may overflow
        refresh_factors(state, index)
        for _ in range(1 if state.flow_model is None else flow_cycles):
            cycle(state, index)
        equations = relative_residual(state, index)
    limit = max(GROWTH_LIMIT * last, CONVERGED[0])
    diverged = not np.isfinite(equations[0]) or equations[0] > limit
    if diverged or not 0.0 < state.levels[index].P.max() <= PRESSURE_LIMIT:
        return DIVERGED
    return equations

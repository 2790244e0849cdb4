"""From the Newtonian film of uniform temperature to that of an oil that thins and warms, in steps.

Frozen coefficients of an oil whose viscosity falls a millionfold under shear make the cycles run
away from a pressure that is not nearly the right one, while the same cycles converge from one that
is. The film of the Newtonian oil is found first, and the share of rheology and heat (see
`GeneralizedFlow`) raised from there on the finest grid, in steps that are halved, with the
damping, where a cycle runs away. At the full share the cycles are accelerated once the
temperatures are at rest.

Where the pressure falls steeply at the outlet decompression cools the oil by tens of kelvins
within a few nodes, and the pressure answers to the viscosity there: followed at once, the
temperatures of single columns jump from cycle to cycle and never come to rest. A share of the way
in each cycle settles them.

Where the stress at the outlet is tens of times that at which the oil thins, the pressure there
swings or runs away all the same; a factor that is carried along with the pressure (see
`GeneralizedFlow`) settles that.
"""

from dataclasses import replace
from math import inf

import numpy as np

from ..conditions import ContactConditions
from ..multigrid.acceleration import Acceleration
from ..multigrid.cycle import Multigrid, start_level, update_film
from ..multigrid.far_field import exterior_load
from ..multigrid.full_multigrid import (
    ATTEMPTS,
    PLAIN_CYCLES,
    DivergedError,
    Outcome,
    contact_multigrid,
    film_values,
    guarded_cycle,
    kept_level,
    put_back,
)
from ..options import SolverOptions
from ..scaling import scale_contact
from ..solution import ContactSolution, FilmValue
from ..solver import solve_contact, verdict, whole_box
from .flow import GeneralizedFlow

# among the fallbacks of a record
NAME = "continued from the Newtonian film"
CARRIED = "thinning carried along with the pressure"
SLOWER = "rheology and heat raised in smaller steps"
FIRST_SHARE = 0.1
STEP_GROWTH = 2.0  # of the share from step to step
STEP_CYCLES = 4  # at each share below the full one, and the first ones at that
CARRIED_STEP = 0.1  # of the share, at most, where the factor is carried along
CARRIED_CYCLES = 15  # at each share, at most, until the flow is at rest, there
SMALLEST_STEP = 0.01  # of the share, below which the continuation gives up
HALVINGS = 2  # of the damping, at most
PATIENCE = 3  # times the cycles of the options at the full share
# change of the logarithm of the Poiseuille factor in the last turn, weighted with the pressure's
# flow
SETTLED = 0.03
FOLLOWING = 0.3  # of the temperature found, felt in the next cycle: see `GeneralizedFlow`
RESTING = 1.0  # largest change of a temperature in a turn [K], below which cycles are accelerated
FILMS = ("film_central_dimensionless", "film_minimum_dimensionless")


def continued(
    conditions: ContactConditions,
    options: SolverOptions,
    flow: GeneralizedFlow,
    plain: ContactSolution | None = None,
) -> ContactSolution:
    """The contact reached from its Newtonian film; not converged if that did not, or if no step
    succeeded.

    Film values keep the extrapolation and the error bar of the Newtonian film, in proportion.

    Parameters
    ----------
    conditions : ContactConditions
    options : SolverOptions
        Mesh, box and number of cycles, without a tolerance.
    flow : GeneralizedFlow
        The oil; its fields are those of the last turn afterwards.
    plain : ContactSolution, optional
        The Newtonian film, if it is known.
    """
    plain = plain or solve_contact(conditions, options)
    taken = (*plain.record.fallbacks, NAME, *([CARRIED] if flow.carried else []))
    record = replace(plain.record, fallbacks=taken)
    plain = replace(plain, record=record)
    if not plain.converged:
        return replace(plain, message=f"the Newtonian film is {plain.message}")
    outcome = Outcome(state=_state(plain, options, flow))
    slower: list[str] = []
    flow.forget()
    flow.single, flow.following = False, FOLLOWING
    try:
        _raise_share(outcome.state, flow, slower)
        _finish(outcome, flow, PATIENCE * options.max_cycles)
    except DivergedError:
        outcome.films = []
    reached, flow.share, flow.following = flow.share, 1.0, 1.0
    return _solution(
        replace(plain, record=replace(record, fallbacks=(*record.fallbacks, *slower))),
        outcome,
        reached,
    )


def _state(plain: ContactSolution, options: SolverOptions, flow: GeneralizedFlow) -> Multigrid:
    """Levels on the grid of a solution and with its damping, its pressure and approach on the
    finest.
    """
    assert isinstance(plain.conditions, ContactConditions)
    ways = [scale_contact(plain.conditions, along_entrainment=turned) for turned in (False, True)]
    contact = min(ways, key=lambda way: abs(way.frame_angle - plain.frame_angle))
    contact = replace(contact, film_guess=plain.film_central_dimensionless.finest)
    taken = [attempt for attempt in ATTEMPTS if attempt.name in plain.record.fallbacks]
    attempt = max(taken, key=lambda a: plain.record.fallbacks.index(a.name), default=ATTEMPTS[0])
    state = contact_multigrid(contact, plain.domain, options, attempt, flow)
    state.approach = plain.approach_dimensionless
    level = state.levels[-1]
    index = len(state.levels) - 1
    start_level(state, index, np.ascontiguousarray(plain.P.T[-level.grid.ny :]))
    if state.far_field is not None:
        state.exterior = exterior_load(state.far_field, level.grid, level.H)
        level.load = contact.load - state.exterior
    return state


def _raise_share(state: Multigrid, flow: GeneralizedFlow, slower: list[str]) -> None:
    """Raise the share to 1 [-], the first cycles there included; `slower` gets an entry for each
    step halved.

    Raises
    ------
    DivergedError
        If the smallest step runs away.
    """
    reached = 0.0
    wanted = FIRST_SHARE
    index = len(state.levels) - 1
    while reached < 1.0:
        flow.share = wanted
        kept = kept_level(state, index)
        found = flow.kept()
        if _stepped(state, flow):
            reached = wanted
            wanted = min(STEP_GROWTH * wanted, 1.0)
            if flow.carried:
                wanted = min(wanted, reached + CARRIED_STEP)
            continue
        put_back(state, index, kept)
        flow.restore(found)
        wanted = 0.5 * (reached + wanted)
        slower.append(SLOWER)
        if len(slower) <= HALVINGS:
            state.damping = state.damping.halved()
        if wanted - reached < SMALLEST_STEP:
            flow.share = reached
            raise DivergedError


def _stepped(state: Multigrid, flow: GeneralizedFlow) -> bool:
    """Cycle at a share; False if a cycle ran away. A carried factor comes to rest before the next
    share [-].
    """
    for done in range(1, (CARRIED_CYCLES if flow.carried else STEP_CYCLES) + 1):
        if not np.isfinite(guarded_cycle(state, len(state.levels) - 1)):
            return False
        if done >= STEP_CYCLES and flow.change <= SETTLED:
            break
    return True


def _finish(outcome: Outcome, flow: GeneralizedFlow, cycles: int) -> None:
    """Cycle at the full share until film, load and flow stand still, accelerated.

    Raises
    ------
    DivergedError
        If a cycle runs away.
    """
    state = outcome.state
    index = len(state.levels) - 1
    level = state.levels[-1]
    residual = inf
    acceleration = Acceleration()
    outcome.film.append(film_values(level.grid, level.H))
    for _ in range(cycles):
        given = (level.P.copy(), state.approach)
        residual = guarded_cycle(state, index, residual)
        if not np.isfinite(residual):
            raise DivergedError
        outcome.note(residual)
        outcome.films = [outcome.film[-1]]
        if outcome.converged() and flow.change <= SETTLED:
            return
        rest = flow.heat is None or flow.heat.change < RESTING
        if rest and len(outcome.changes) > PLAIN_CYCLES:
            level.P, state.approach = acceleration.mixed(given, (level.P, state.approach))
            update_film(state, index)


def _solution(plain: ContactSolution, outcome: Outcome, reached: float) -> ContactSolution:
    """Fields and film values of the finest grid; the plain solution's, flagged, if the full share
    was not reached.
    """
    if not outcome.films:
        told = f"not converged: ran away from the Newtonian film at {reached:.0%} of rheology and heat; try more points"
        return replace(plain, converged=False, message=told)
    _, P, H = whole_box(outcome.state)
    deflected = outcome.state.deflected_nodes() / outcome.state.levels[-1].P.size
    central, minimum = (
        _in_proportion(getattr(plain, name), outcome, kind) for kind, name in enumerate(FILMS)
    )
    record = replace(
        plain.record,
        residual=tuple(outcome.residual),
        force_error=tuple(outcome.load),
        film_change=tuple(outcome.changes),
        cycles=len(outcome.changes),
        fft_equivalents=plain.record.fft_equivalents + deflected,
    )
    resolved, message = verdict(outcome)
    return replace(
        plain,
        P=P,
        H=H,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=outcome.state.approach,
        resolved=resolved,
        converged=outcome.converged(),
        message=message,
        record=record,
    )


def _in_proportion(plain: FilmValue, outcome: Outcome, kind: int) -> FilmValue:
    """Central (0) or minimum (1) film, its extrapolation that of the Newtonian film in proportion
    [-].
    """
    finest = outcome.films[-1][kind]
    ratio = finest / plain.finest
    noise = outcome.remaining_error() * abs(finest)
    return FilmValue(
        value=ratio * plain.value,
        uncertainty=abs(ratio) * plain.uncertainty + noise,
        finest=finest,
    )

"""From the Newtonian film of uniform temperature to that of an oil that thins and heats up.

With an oil whose viscosity falls a millionfold under shear, cycles with frozen coefficients
diverge from a pressure that is far from the solution and converge from one that is close to it.

1. Solve the Newtonian film.
2. On the finest grid, raise the fraction of rheology and heat (`flow.Continuation`) from zero
   to one; a step whose cycles diverge is undone and halved, and so is the damping, twice at most.
3. At the full fraction, accelerate the cycles once the temperatures have settled.

Where the pressure falls steeply at the outlet, decompression cools the oil by tens of kelvins
within a few nodes, and the pressure responds to the viscosity there. Temperatures of single
columns then oscillate from cycle to cycle; relaxation settles them. Where the stress at the outlet
is tens of times the one at which the oil thins, a Poiseuille factor that follows the pressure (see
`flow`) is needed as well.
"""

from dataclasses import replace
from math import inf

import numpy as np

from ..multigrid.acceleration import Acceleration
from ..multigrid.cycle import start_level, update_exterior, update_film
from ..multigrid.full_multigrid import ATTEMPTS, Attempt, AttemptResult, contact_multigrid
from ..multigrid.history import CENTRAL, MINIMUM, start_history
from ..multigrid.levels import Multigrid
from ..multigrid.settling import DIVERGED, PLAIN_CYCLES, guarded_cycle, restore, snapshot
from ..multigrid.verdict import resolution_message, with_status
from ..options import SolverOptions
from ..scaling import scale_contact
from ..solution import ContactSolution, FilmValue
from ..solver import solve_contact, unfold_symmetry, with_history
from .flow import Continuation, FlowState, GeneralizedFlow

# entries among the fallbacks of a record
CONTINUED = "continued from the Newtonian film"
FOLLOWED_PRESSURE = "thinning updated with the pressure"
SMALLER_STEP = "rheology and heat raised in smaller steps"
# Beside each number the cycles that half and double of it add to 24, 26 and 46, measured on 65
# points for Eyring films of 5 MPa at 2.3 GPa, without and with heat, and at 3.6 GPa with a factor
# that follows the pressure. All converge, central films to 0.1 %; "none" are bounds not reached.
FIRST_FRACTION = 0.1  # of rheology and heat; +4, -5
STEP_GROWTH = 2.0  # of the fraction from step to step; +4 to +12 (1.4), 0 to -8
STEP_CYCLES = 4  # at each fraction below the full one, and the first ones at that; -22, +44
# largest step of the fraction where the factor follows the pressure; +32, -20
FOLLOWING_STEP = 0.1
FOLLOWING_CYCLES = 15  # most cycles at each fraction until the flow has settled, there; none
SMALLEST_STEP = 0.01  # of the fraction, below which the continuation gives up; none
HALVINGS = 2  # of the damping, at most; none
CYCLES_FACTOR = 3  # on the cycles of the options, at the full fraction; none
# change of the logarithm of the Poiseuille factor in a cycle, weighted with the pressure's flow,
# up to which the flow counts as settled; none
FLOW_TOLERANCE = 0.03
TEMPERATURE_RELAXATION = 0.3  # +8, -4 with heat
# fraction of the change from the Newtonian film in the error bar: effect of the mesh on shear and
# heat. On 129 points it was 0.03 at most where the bar in proportion alone missed (100 N at 20
# m/s: 3.8 %)
CHANGE_FRACTION = 0.05
# largest change in a cycle [K] at which cycles are accelerated; none
REST_TEMPERATURE_CHANGE = 1.0


def solve_by_continuation(
    flow: GeneralizedFlow, options: SolverOptions, newtonian: ContactSolution | None = None
) -> tuple[ContactSolution, FlowState | None]:
    """Solve a contact with shear and heat from its Newtonian film.

    It has not converged if the Newtonian film did not or if no step succeeded. Film values keep
    the extrapolation and the error bar of the Newtonian film, in proportion; the bar includes a
    fraction of what shear and heat take.

    Parameters
    ----------
    flow : GeneralizedFlow
        flow model at its full fraction
    options : SolverOptions
        options of the solver, without a tolerance
    newtonian : ContactSolution | None, optional
        Newtonian solution of the contact; None: it is solved first

    Returns
    -------
    solution
        contact with shear and heat
    state
        flow of the last cycle; None without one
    """
    # 1. Newtonian film
    plain = newtonian or solve_contact(flow.conditions, options)
    follows = flow.continuation.follow_pressure
    fallbacks = (*plain.record.fallbacks, CONTINUED, *([FOLLOWED_PRESSURE] if follows else []))
    if not plain.converged:
        message = f"the Newtonian film is {plain.message}"
        return with_fallbacks(replace(plain, message=message), fallbacks), None
    # 2. fraction of rheology and heat
    start, attempt = _start(plain, options, flow)
    state, fraction, halvings = _raise_fraction(start, flow)
    fallbacks += halvings * (SMALLER_STEP,)
    # 3. cycles at the full fraction
    result = AttemptResult(state=state, attempt=attempt)
    if fraction == 1.0:
        _finish(result, CYCLES_FACTOR * options.max_cycles)
    if result.levels:
        solution = _solution(plain, result)
    else:
        where = f"from the Newtonian film at {fraction:.0%} of rheology and heat"
        message = f"not converged: diverged {where}; try more points"
        solution = replace(plain, converged=False, message=message)
    return with_fallbacks(solution, fallbacks), last_flow(flow, state, solution)


def with_fallbacks(solution: ContactSolution, fallbacks: tuple[str, ...]) -> ContactSolution:
    """Replace the fallbacks in the record of a solution.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    fallbacks : tuple[str, ...]
        names of the fallbacks

    Returns
    -------
    ContactSolution
        solution with this record
    """
    return replace(solution, record=replace(solution.record, fallbacks=fallbacks))


def last_flow(
    flow: GeneralizedFlow, state: Multigrid, solution: ContactSolution
) -> FlowState | None:
    """Give the flow of the last cycle on the finest grid; where the solution converged, with heat
    and stress at rest.

    Parameters
    ----------
    flow : GeneralizedFlow
        flow model
    state : Multigrid
        levels of the contact
    solution : ContactSolution
        solution of these levels

    Returns
    -------
    FlowState | None
        flow; None without one
    """
    level = state.levels[-1]
    last: FlowState | None = level.flow_state
    if last is None or not solution.converged:
        return last
    return flow.with_converged_heat(state.contact, level.grid, level.P, level.H, last)


def _start(
    plain: ContactSolution, options: SolverOptions, flow: GeneralizedFlow
) -> tuple[Multigrid, Attempt]:
    """Levels on the grid of a solution: its damping, pressure and approach; the attempt that these
    settings are of.
    """
    scaled = [scale_contact(flow.conditions, along_entrainment=turned) for turned in (False, True)]
    contact = min(scaled, key=lambda frame: abs(frame.frame_angle - plain.frame_angle))
    contact = replace(contact, film_guess=plain.film_central_dimensionless.finest)
    attempt = next(attempt for attempt in ATTEMPTS if attempt.name == plain.record.attempt)
    state = contact_multigrid(contact, plain.domain, options, attempt, flow)
    state.approach = plain.approach_dimensionless.finest
    level = state.levels[-1]
    pressure = np.ascontiguousarray(plain.P.T[-level.grid.ny :])
    start_level(state, len(state.levels) - 1, pressure)
    update_exterior(state, len(state.levels) - 1)
    return state, attempt


def _raise_fraction(state: Multigrid, flow: GeneralizedFlow) -> tuple[Multigrid, float, int]:
    """Raise the fraction to 1 [-], the first cycles there included. Give the levels with the flow
    of the last step, the fraction reached, below 1 if even the smallest step diverged, and the
    number of steps halved.
    """
    follows = flow.continuation.follow_pressure
    damped = Continuation(relaxation=TEMPERATURE_RELAXATION, follow_pressure=follows)
    largest = FOLLOWING_STEP if follows else 1.0
    reached = 0.0
    fraction = FIRST_FRACTION
    halvings = 0
    index = len(state.levels) - 1
    while reached < 1.0:
        before = snapshot(state, index)
        flow_before = state.levels[index].flow_state
        at_fraction = replace(flow, continuation=replace(damped, fraction=fraction))
        step = replace(state, flow_model=at_fraction)
        if _cycles_to_rest(step, FOLLOWING_CYCLES if follows else STEP_CYCLES):
            state = step
            reached = fraction
            fraction = min(STEP_GROWTH * fraction, 1.0, reached + largest)
            continue
        restore(state, index, before)
        state.levels[index].flow_state = flow_before
        fraction = 0.5 * (reached + fraction)
        halvings += 1
        if halvings <= HALVINGS:
            state = replace(state, damping=state.damping.halved())
        if fraction - reached < SMALLEST_STEP:
            break
    return state, reached, halvings


def _cycles_to_rest(state: Multigrid, cycles: int) -> bool:
    """Cycle at a fraction until the flow has settled; False if a cycle diverged."""
    level = state.levels[-1]
    for count in range(1, cycles + 1):
        if guarded_cycle(state, len(state.levels) - 1) == DIVERGED:
            return False
        if count >= STEP_CYCLES and level.flow_state.change <= FLOW_TOLERANCE:
            break
    return True


def _finish(result: AttemptResult, cycles: int) -> None:
    """Accelerated cycles at the full fraction to convergence; no history if one diverges."""
    state = result.state
    index = len(state.levels) - 1
    level = state.levels[index]
    residual = inf
    acceleration = Acceleration()
    history = start_history(state, index)
    for _ in range(cycles):
        before = (level.P.copy(), state.approach)
        equations = guarded_cycle(state, index, residual)
        if equations == DIVERGED:
            return
        history.record(state, index, equations)
        residual = equations[0]
        flow: FlowState = level.flow_state
        if history.finished(None) and flow.change <= FLOW_TOLERANCE:
            break
        at_rest = flow.heat is None or flow.heat.change < REST_TEMPERATURE_CHANGE
        if at_rest and PLAIN_CYCLES < len(history.residual) < cycles:
            level.P, state.approach = acceleration.next(before, (level.P, state.approach))
            update_film(state, index)
    result.levels = [history]


def _solution(plain: ContactSolution, result: AttemptResult) -> ContactSolution:
    """Fields and film values of the finest grid."""
    _, P, H = unfold_symmetry(result.state)
    deflected = result.state.deflected_nodes() / result.state.levels[-1].P.size
    record = replace(
        with_history(plain.record, result),
        fft_equivalents=plain.record.fft_equivalents + deflected,
    )
    central = _in_proportion(plain.film_central_dimensionless, result, CENTRAL)
    minimum = _in_proportion(plain.film_minimum_dimensionless, result, MINIMUM)
    resolved, message = resolution_message(result)
    solution = replace(
        plain,
        P=P,
        H=H,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=_shifted_approach(plain, result),
        resolved=resolved,
        converged=result.converged,
        message=message,
        record=record,
    )
    return with_status(solution)


def _shifted_approach(plain: ContactSolution, result: AttemptResult) -> FilmValue:
    """H0, extrapolated by the step of the Newtonian one."""
    history = result.levels[-1]
    before = plain.approach_dimensionless
    return FilmValue(
        value=before.value + history.approach[-1] - before.finest,
        uncertainty=before.uncertainty + history.approach_noise,
        finest=history.approach[-1],
    )


def _in_proportion(plain: FilmValue, result: AttemptResult, kind: int) -> FilmValue:
    """Central (0) or minimum (1) film, extrapolated in proportion to the Newtonian one [-]."""
    history = result.levels[-1]
    finest = history.film[-1][kind]
    ratio = finest / plain.finest
    uncertainty = abs(ratio) * plain.uncertainty + history.noise(kind) * abs(finest)
    uncertainty += CHANGE_FRACTION * abs(1.0 - ratio) * plain.finest
    return FilmValue(value=ratio * plain.value, uncertainty=uncertainty, finest=finest)

"""Contacts whose oil thins under shear and heats up, by a generalized Reynolds equation.

With an oil whose viscosity falls a millionfold under shear, cycles with frozen coefficients
diverge from a pressure that is far from the solution and converge from one that is close to it.
Hence:

1. Solve the Newtonian film.
2. On the finest grid, raise the fraction of rheology and heat (`flow.Continuation`) from zero
   to one; a step whose cycles diverge is undone and halved, and so is the damping, twice at most.
3. At the full fraction, accelerate the cycles once the temperatures have settled.

Films with heat take another way, with this one as its fallback. The isothermal film is solved to
its tolerance, on as many points as that takes. Heat is added on the same grids, on 257 points and
on the level below where both resolve the film, from the isothermal pressure and what heat changed
of it below. The ratio of both films of a level converges much faster than either film; it is the
isothermal film's factor. That film is the atlas's where this agrees and knows it better.

Where the pressure falls steeply at the outlet, decompression cools the oil by tens of kelvins
within a few nodes, and the pressure responds to the viscosity there. Temperatures of single
columns then oscillate from cycle to cycle; relaxation settles them. Where the stress at the outlet
is tens of times the one at which the oil thins, a Poiseuille factor that follows the pressure (see
`flow`) is needed as well.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import hypot, inf
from time import perf_counter

import numpy as np

from ..arrays import Array
from ..atlas.films import NotInAtlasError, atlas_films
from ..closed_form.film import film_reduction_gupta, thermal_loading
from ..closed_form.hertz import MEAN_PRESSURE_RATIO, hertz_contact
from ..conditions import ContactConditions
from ..grid import inject, interpolate_cubic, unfolded
from ..multigrid.cycle import start_level, update_exterior, update_film
from ..multigrid.film_values import (
    ORDER_STEP,
    resolution_message,
    tolerance_reached,
    with_status,
    with_tolerance_status,
)
from ..multigrid.full_multigrid import (
    ATTEMPTS,
    COARSE_LEVEL_CYCLES,
    DIVERGED,
    FLOW_STRICTNESS,
    PLAIN_CYCLES,
    Acceleration,
    Attempt,
    AttemptResult,
    Progress,
    contact_multigrid,
    guarded_cycle,
    iterate_level,
    restore,
    snapshot,
)
from ..multigrid.history import CENTRAL, MINIMUM, LevelHistory, start_history
from ..multigrid.levels import Multigrid
from ..oil.assumed_heat import with_heat
from ..oil.rheology import (
    FilmState,
    Rheology,
    contact_rheology,
    log_gradient_thinning,
    log_mean_fluidity,
)
from ..options import GENERALIZED_POINTS, SolverOptions
from ..scaling import scale_contact
from ..solid.heat import SolidThermal
from ..solution import ContactSolution, FilmValue
from ..solver import solve_attempts, solve_contact, solve_levels, unfold_symmetry, with_history
from .film_heat import FilmHeat, film_section
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

# Error bar of the ratio of a film with heat and the isothermal one, by 111 contacts on 129, 257
# and 513 points (tools/heat). Central film: over the step of two levels and over what heat takes,
# and over that where there is no second level. Minimum film: over what heat takes, at most
# `LARGEST_RATIO_ERROR`, and over the correction by `MESH_POWER`; 95 to 98 % lie within
RATIO_STEP = 0.25
RATIO_LOSS = 0.01
RATIO_ALONE = (0.1, 0.35)
LARGEST_RATIO_ERROR = 0.015
# A mesh errs more on the thinner film: relative error of the minimum film with heat over that of
# the isothermal one, which is known, is the ratio to the power -1.5 (1 and 2 fit worse)
MESH_POWER = 1.5
CORRECTION_ERROR = 0.3
# ratio below which a level is too coarse for the correction, and the bar is the whole change
LEAST_RATIO = 0.1
# cycles at the end of which the minimum film may turn: in thick oils (L above 26) it wanders by
# some per cent where the central one is at rest, relaxed or not
TURNING_CYCLES = 5
HEATED_BELOW = 2  # levels with heat below the finest one, where they resolve the film
COLD_SHARE = 0.7  # of a tolerance, for the isothermal film: as much is left for the ratio

# fraction of the columns that may stay unsolved or over the limiting stress, measured: they lie at
# the edge of the cavity, where hardly anything flows
UNSOLVED_FRACTION = 0.005
# error bar of the film by twelve nodes across it: a fraction, and one times the fourth power of
# what heat takes by Gupta's formula. 38 films are -0.05 % to 0.41 times that power thicker than on
# 36 nodes, on which up to a fifth as much is left
SECTION_FRACTION = 5e-4
SECTION_ERROR = 0.55
# error bar of the film for each kelvin by which the heat of a film at rest still changes: where
# the eddy ahead of two contacts changed by 14 K their films were 0.2 to 0.4 % off [1/K]
UNCONVERGED_HEAT_ERROR = 3e-4


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


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralizedSolution:
    """One contact with its oil's rheology and heat; fields on the grid of `contact`."""

    contact: ContactSolution  # `converged` and `message` include shear and heat
    rheology: Rheology  # shear law of the oil
    nodes: Array  # z/h across the film, from body 1 to body 2, shape (n,) [-]
    # in the middle of the film along x and y, shape (2, nx, ny) [Pa]; None: Newtonian, isothermal
    mid_stress: Array | None = None
    # temperature of the oil at the nodes, walls included, shape (nx, ny, n) [K]; None: solved
    # without heat
    temperature: Array | None = None
    heat_flux: Array | None = None  # into body 1 and body 2, shape (2, nx, ny) [W/m^2]
    dissipation: Array | None = None  # heat of shear over the film, shape (nx, ny) [W/m^2]
    # change of the logarithm of the Poiseuille factor in the last cycle, weighted with the
    # pressure's flow [-]
    change: float = 0.0
    heat_change: float = 0.0  # largest change of a temperature in the last sweeps of the heat [K]
    unsolved_columns: int = 0  # in the last cycle [-]
    over_limit_columns: int = 0  # in which h/2 grad p exceeded the limiting stress [-]

    @property
    def mean_temperature(self) -> Array | None:
        """Mean temperature of the oil over the film thickness, shape (nx, ny) [K]."""
        if self.temperature is None:
            return None
        return np.asarray(np.trapezoid(self.temperature, self.nodes, axis=-1))


def solve_generalized(
    conditions: ContactConditions,
    rheology: Rheology,
    *,
    solids: tuple[SolidThermal, SolidThermal] | None = None,
    oil_temperature: float | None = None,
    options: SolverOptions | None = None,
) -> GeneralizedSolution:
    """Solve pressure, film, shear stress and temperature of a steady flooded contact, Yang and Wen
    (1990).

    Newtonian and of uniform temperature it is that of `solve_contact`; otherwise it is solved on
    257 points where the options have neither points nor a tolerance, with heat the isothermal film
    that its films are relative to to the default tolerance. Shear and heat are two
    multigrid cycles behind pressure and film. The time of the record covers all methods that were
    tried; its FFTs are those of the last one, with those of the Newtonian film that it started
    from.

    Parameters
    ----------
    conditions : ContactConditions
        flooded contact with its sliding
    rheology : Rheology
        shear law of the oil
    solids : tuple[SolidThermal, SolidThermal] | None, optional
        thermal properties of body 1 and body 2, those of the oil are assumed where it has none;
        None: uniform temperature
    oil_temperature : float | None, optional
        temperature of the oil that flows in; None: that of the lubricant's operation [K]
    options : SolverOptions | None, optional
        options of the solver; None: its defaults

    Returns
    -------
    GeneralizedSolution
        contact, stress and temperature

    Raises
    ------
    ValueError
        if the lubricant lacks a temperature that heat needs, or conditions have an inlet film
    """
    options = options or SolverOptions()
    if rheology.newtonian and solids is None:
        contact = solve_contact(conditions, options)
        nodes = film_section().nodes
        return GeneralizedSolution(contact=contact, rheology=rheology, nodes=nodes)
    if conditions.inlet_layer is not None:
        raise ValueError("inlet_layer: films with shear or heat are solved flooded only")
    if solids is None and options.points is None and options.tolerance is None:
        options = replace(options, points=GENERALIZED_POINTS)
    hertz = hertz_contact(
        conditions.load, conditions.radius_x, conditions.radius_y, conditions.reduced_modulus
    )
    rheology = contact_rheology(
        rheology, conditions.lubricant, MEAN_PRESSURE_RATIO * hertz.pressure
    )
    heat = None
    if solids is not None:
        conditions = replace(conditions, lubricant=with_heat(conditions.lubricant))
        heat = FilmHeat(conditions=conditions, solids=solids, oil_temperature=oil_temperature)
    flow = GeneralizedFlow(conditions=conditions, rheology=rheology, heat=heat)
    start = perf_counter()
    solve = _first_converged if heat is None else _relative_to_isothermal
    contact, state = solve(flow, options)
    if heat is not None:
        change = 0.0 if state is None or state.heat is None else state.heat.change
        contact = _with_heat_error(contact, hertz.pressure, change, options.tolerance)
    contact = replace(contact, record=replace(contact.record, wall_time=perf_counter() - start))
    solution = GeneralizedSolution(contact=contact, rheology=rheology, nodes=flow.section.nodes)
    return _with_oil_state(solution if state is None else _with_fields(solution, state))


def _with_heat_error(
    contact: ContactSolution, hertz_pressure: float, change: float, tolerance: float | None
) -> ContactSolution:
    """The solution whose error bars hold what the differences across the film do, and the change
    of temperature [K] that is left.
    """
    conditions = contact.conditions
    assert isinstance(conditions, ContactConditions)
    pressure_ratio = hertz_pressure / conditions.reduced_modulus
    loading = thermal_loading(conditions)
    left = film_reduction_gupta(pressure_ratio, loading, conditions.slide_roll_ratio)
    error = (
        SECTION_FRACTION
        + SECTION_ERROR * (1.0 - max(left, 0.0)) ** 4
        + UNCONVERGED_HEAT_ERROR * change
    )
    central, minimum = (
        replace(film, uncertainty=film.uncertainty + error * abs(film.finest))
        for film in (contact.film_central_dimensionless, contact.film_minimum_dimensionless)
    )
    wider = with_status(
        replace(contact, film_central_dimensionless=central, film_minimum_dimensionless=minimum)
    )
    if tolerance is None or not tolerance_reached(contact, tolerance):  # which its message says
        return wider
    return with_tolerance_status(
        wider, tolerance, f"{film_section().nodes.size} nodes across the film"
    )


def _first_converged(
    flow: GeneralizedFlow, options: SolverOptions
) -> tuple[ContactSolution, FlowState | None]:
    """The solution of the first method that converges, else of the last, and the flow of its last
    cycle; the record names the methods. With a tolerance the first method alone, with all
    attempts.
    """
    # 1. full multigrid from a Hertz pressure, its first attempt alone
    alone = options.tolerance is None
    contact, state = _full_multigrid(flow, options, ATTEMPTS[:1] if alone else ATTEMPTS)
    if contact.converged or not alone:
        return contact, state
    # 2. continuation from the Newtonian film, the factor frozen, then following the pressure
    newtonian = solve_contact(flow.conditions, options)
    fallbacks = newtonian.record.fallbacks
    # a Newtonian oil has no thinning to update
    thins = newtonian.converged and not flow.rheology.newtonian
    for follows in (False, True) if thins else (False,):
        with_continuation = replace(flow, continuation=Continuation(follow_pressure=follows))
        contact, state = _checked(*solve_by_continuation(with_continuation, options, newtonian))
        fallbacks = (*fallbacks, *contact.record.fallbacks[len(newtonian.record.fallbacks) :])
        if contact.converged:
            return with_fallbacks(contact, fallbacks), state
    # 3. full multigrid with its other attempts
    contact, state = _full_multigrid(flow, options, ATTEMPTS[1:])
    return with_fallbacks(contact, (*fallbacks, *contact.record.fallbacks)), state


def _relative_to_isothermal(
    flow: GeneralizedFlow, options: SolverOptions
) -> tuple[ContactSolution, FlowState | None]:
    """A film with heat by its ratio to the isothermal one, on finer levels until a tolerance is
    reached, and the flow of its last cycle.
    """
    tolerance = options.tolerance
    cold_options = options
    if tolerance is not None:
        cold_options = replace(options, tolerance=max(COLD_SHARE * tolerance, 1e-5))
    points = min(GENERALIZED_POINTS, options.max_points)
    while True:
        cold, levels = solve_levels(flow.conditions, cold_options, fewest=points)
        if not cold.converged:
            return replace(cold, message=f"the isothermal film is {cold.message}"), None
        contact, state = _heated(flow, options, _with_atlas(cold), levels, points)
        reached = tolerance is None or tolerance_reached(contact, tolerance)
        if reached or not contact.converged or points >= options.max_points:
            break
        points = 2 * points - 1
    if tolerance is not None:
        contact = with_tolerance_status(contact, tolerance, f"{points} points with heat")
    return contact, state


def _heated(
    flow: GeneralizedFlow,
    options: SolverOptions,
    cold: ContactSolution,
    levels: AttemptResult,
    points: int,
) -> tuple[ContactSolution, FlowState | None]:
    """A film with heat on the first level with these points at least that resolves the isothermal
    one, and the flow of its last cycle.
    """
    finest = len(levels.state.levels) - 1
    known = {finest - n: history for n, history in enumerate(reversed(levels.levels))}
    grids = [level.grid for level in levels.state.levels]
    resolved = [n for n in known if grids[n].nx >= points and known[n].resolved]
    index = min(resolved, default=finest)
    mesh = replace(options, points=grids[index].nx, tolerance=None)
    # 1. from the isothermal pressure, and what heat changed on the level below
    state = contact_multigrid(levels.state.contact, cold.domain, mesh, levels.attempt, flow)
    result = AttemptResult(state=state, attempt=levels.attempt)
    pressure = levels.state.levels[-1].P
    if grids[-1].symmetric:
        pressure = unfolded(pressure)
    for _ in range(finest - index):
        pressure = inject(pressure)
    pressure = pressure[-state.levels[-1].grid.ny :]
    pairs: list[tuple[LevelHistory, LevelHistory]] = []
    changed: tuple[Array, float, LevelHistory] | None = None
    for at in range(max(index - HEATED_BELOW, 0), index + 1):
        if at not in known or (at < index and not known[at].resolved):
            continue
        start = pressure[:: 2 ** (index - at), :: 2 ** (index - at)]
        pair, changed = _heated_level(state, at, (start, known[at]), changed, options)
        pairs = [*pairs[-1:], pair] if pair is not None and pair[0].converged() else []
    result.levels = [hot for hot, _ in pairs]
    if pairs:
        contact = _in_ratio(cold, result, pairs)
        contact, flow_state = _checked(contact, last_flow(flow, state, contact))
        if contact.converged:
            return contact, flow_state
    # 2. continuation from the isothermal film of these points
    plain = cold if index == finest else solve_contact(flow.conditions, mesh)
    for follows in (False,) if flow.rheology.newtonian else (False, True):
        still = replace(flow, continuation=Continuation(follow_pressure=follows))
        contact, flow_state = _checked(*solve_by_continuation(still, mesh, plain))
        if contact.converged:
            break
    ratios = []
    for kind, (film, one) in enumerate(zip(_films(contact), _films(plain), strict=True)):
        ratio, bar = _alone(film.finest / one.finest, kind, one.value / one.finest)
        left = film.uncertainty - abs(ratio) * one.uncertainty  # by cycles and mesh
        ratios.append((ratio, bar + max(left, 0.0) / one.finest))
    return _with_films(contact, cold, ratios), flow_state


def _start_at(state: Multigrid, index: int, pressure: Array, approach: float) -> None:
    """Start a level from a pressure, shape (ny, nx), and an approach [-]."""
    state.approach = approach
    start_level(state, index, np.ascontiguousarray(pressure))
    update_exterior(state, index)


def _heated_level(
    state: Multigrid,
    index: int,
    cold: tuple[Array, LevelHistory],
    changed: tuple[Array, float, LevelHistory] | None,
    options: SolverOptions,
) -> tuple[tuple[LevelHistory, LevelHistory] | None, tuple[Array, float, LevelHistory] | None]:
    """Solve a level with heat, from a pressure without heat and what heat `changed` of pressure
    and approach on the level below, with its history; below the finest first without heat, from
    that pressure.

    Its histories with heat and without, and what heat changed on it; None where cycles diverged.
    """
    pressure, without = cold
    approach = without.approach[-1]
    model = state.flow_model
    damping = state.damping
    finest = index == len(state.levels) - 1
    if not finest:
        state.flow_model = None
        _start_at(state, index, pressure, approach)
        solved = iterate_level(state, index, COARSE_LEVEL_CYCLES, Progress(), None)
        state.flow_model, state.damping = model, damping
        if solved is None:
            return None, None
        without = solved
        pressure = state.levels[index].P.copy()
        approach = state.approach
    start = pressure
    shift = 0.0
    below = None
    if changed is not None:
        start = pressure + interpolate_cubic(changed[0], state.levels[index - 1].grid.symmetric)
        shift, below = changed[1:]
    _start_at(state, index, start, approach + shift)
    most = options.max_cycles if finest else COARSE_LEVEL_CYCLES
    strictness = 1.0 if finest else FLOW_STRICTNESS
    hot = iterate_level(state, index, most, Progress(), below, strictness)
    state.damping = damping
    if hot is None:
        return None, None
    change = (state.levels[index].P - pressure, state.approach - approach, hot)
    return (hot, without), change


def _films(contact: ContactSolution) -> tuple[FilmValue, FilmValue]:
    """Central and minimum film."""
    return contact.film_central_dimensionless, contact.film_minimum_dimensionless


def _with_atlas(cold: ContactSolution) -> ContactSolution:
    """An isothermal solution with films of the atlas where these agree with its own and have
    narrower error bars.
    """
    try:
        films = atlas_films(cold.conditions)
    except NotInAtlasError:
        return cold
    unit = cold.film_scale or 1.0
    values = []
    for own, other in zip(_films(cold), (films.central, films.minimum), strict=True):
        value, bar = other.value / unit, other.uncertainty / unit
        better = bar < own.uncertainty and abs(value - own.value) <= bar + own.uncertainty
        values.append(replace(own, value=value, uncertainty=bar) if better else own)
    return replace(
        cold,
        film_central_dimensionless=values[CENTRAL],
        film_minimum_dimensionless=values[MINIMUM],
    )


def _ratio(
    pairs: Sequence[tuple[LevelHistory, LevelHistory]], kind: int, cold: float
) -> tuple[float, float]:
    """Ratio of the films with heat and without, `cold` at its limit, and its error bar [-]; of
    central films extrapolated from two levels where there are.
    """
    ratios = [hot.film[-1][kind] / one.film[-1][kind] for hot, one in pairs]
    noises = [hot.noise(kind) + _turns(hot, kind) for hot, _ in pairs]
    if len(pairs) < 2 or kind == MINIMUM:
        value, bar = _alone(ratios[-1], kind, cold / pairs[-1][1].film[-1][kind])
        return value, bar + noises[-1] * value
    step = ratios[-1] - ratios[-2]
    value = ratios[-1] + step / ORDER_STEP
    bar = RATIO_STEP * abs(step) + RATIO_LOSS * abs(1.0 - value)
    return value, bar + (4.0 * noises[-1] + noises[-2]) / 3.0 * value


def _turns(history: LevelHistory, kind: int) -> float:
    """Range of a film over the last cycles that do not move it one way, over the film [-]."""
    films = [film[kind] for film in history.film[2:][-TURNING_CYCLES:]]
    steps = [after - before for before, after in pairwise(films)]
    turns = bool(steps) and min(steps) < 0.0 < max(steps)
    return (max(films) - min(films)) / films[-1] if turns else 0.0


def _alone(ratio: float, kind: int, rise: float) -> tuple[float, float]:
    """Ratio of one level with its error bar [-], with the isothermal film's limit over that of the
    level.
    """
    if kind == CENTRAL:
        return ratio, RATIO_ALONE[kind] * abs(1.0 - ratio)
    if not (rise > 0.0 and ratio > LEAST_RATIO):
        return ratio, abs(1.0 - ratio)
    value = ratio * rise ** (ratio**-MESH_POWER - 1.0)
    error = min(RATIO_ALONE[kind] * abs(1.0 - value), LARGEST_RATIO_ERROR)
    return value, error + CORRECTION_ERROR * abs(value - ratio)


def _in_ratio(
    cold: ContactSolution,
    result: AttemptResult,
    pairs: Sequence[tuple[LevelHistory, LevelHistory]],
) -> ContactSolution:
    """Fields of the level with heat, films in a ratio to the isothermal ones."""
    level = result.state.levels[-1]
    Y, P, H = unfold_symmetry(result.state)
    work = cold.record.fft_equivalents * cold.P.size + result.state.deflected_nodes()
    record = replace(with_history(cold.record, result), fft_equivalents=work / level.P.size)
    history, without = pairs[-1]
    central, minimum = (
        FilmValue(value=film.value, uncertainty=film.uncertainty, finest=history.film[-1][kind])
        for kind, film in enumerate(_films(cold))
    )
    before = cold.approach_dimensionless
    approach = FilmValue(
        value=before.value + history.approach[-1] - without.approach[-1],
        uncertainty=before.uncertainty + history.approach_noise,
        finest=history.approach[-1],
    )
    heated = replace(
        cold,
        X=level.grid.X,
        Y=Y,
        P=P,
        H=H,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=approach,
        record=record,
    )
    ratios = [_ratio(pairs, kind, film.value) for kind, film in enumerate(_films(cold))]
    return _with_films(heated, cold, ratios)


def _with_films(
    contact: ContactSolution, cold: ContactSolution, ratios: Sequence[tuple[float, float]]
) -> ContactSolution:
    """A solution with the isothermal films times their ratios."""
    films = [
        FilmValue(
            value=ratio * film.value,
            uncertainty=hypot(ratio * film.uncertainty, bar * film.value),
            finest=own.finest,
        )
        for film, own, (ratio, bar) in zip(_films(cold), _films(contact), ratios, strict=True)
    ]
    contact = replace(
        contact,
        film_central_dimensionless=films[CENTRAL],
        film_minimum_dimensionless=films[MINIMUM],
    )
    return with_status(contact)


def _full_multigrid(
    flow: GeneralizedFlow, options: SolverOptions, attempts: tuple[Attempt, ...]
) -> tuple[ContactSolution, FlowState | None]:
    """Full multigrid from a Hertz pressure, and the flow of its last cycle."""
    contact, levels = solve_attempts(flow.conditions, options, flow, attempts)
    return _checked(contact, last_flow(flow, levels, contact))


def _with_fields(solution: GeneralizedSolution, state: FlowState) -> GeneralizedSolution:
    """The solution with stress and heat over the whole box."""
    ny = solution.contact.P.shape[1]
    along, across = state.mid_stress
    solution = replace(
        solution,
        change=state.change,
        unsolved_columns=state.unsolved_columns,
        over_limit_columns=state.over_limit_columns,
        mid_stress=np.stack((_whole(along, ny), _whole(across, ny, sign=-1.0))),
    )
    heat = state.heat
    if heat is None:
        return solution
    temperature = _whole(np.moveaxis(heat.temperature, -1, 0), ny)
    return replace(
        solution,
        heat_change=heat.change,
        temperature=np.moveaxis(temperature, 0, -1),
        heat_flux=_whole(heat.flux, ny),
        dissipation=_whole(heat.dissipation, ny),
    )


def _with_oil_state(solution: GeneralizedSolution) -> GeneralizedSolution:
    """The solution with the state of its oil, where the contact has dimensions."""
    contact = solution.contact
    p = contact.pressure
    if contact.x is None or contact.y is None or contact.film is None:
        return solution
    thinner = log_gradient_thinning(contact.x, contact.y, p, contact.film, solution.rheology)
    mean = None
    if solution.temperature is not None:
        weights = film_section(solution.nodes.size).weights
        oil = contact.conditions.lubricant
        mean, profile = log_mean_fluidity(solution.temperature, weights, p, oil)
        thinner = profile + thinner
    state = FilmState(temperature=mean, log_fluidity=thinner)
    return replace(solution, contact=replace(contact, state=state))


def _checked(
    contact: ContactSolution, state: FlowState | None
) -> tuple[ContactSolution, FlowState | None]:
    """The solution, converged only if shear and heat have converged too and the limiting stress is
    exceeded almost nowhere.
    """
    if state is None:
        return contact, state
    few = UNSOLVED_FRACTION * contact.P.size
    over = f"limiting stress is below h/2 grad p at {state.over_limit_columns} columns"
    if not contact.converged:
        if state.over_limit_columns:
            contact = replace(contact, message=f"{contact.message}; the {over} of the last cycle")
        return contact, state
    if state.over_limit_columns > few:
        reason = f"the {over}, where no oil of that law flows steadily"
    elif not state.change <= FLOW_TOLERANCE:
        changed = f"shear and heat changed the flow by {state.change:.1e} in the last cycle"
        reason = f"{changed}; try more cycles"
    elif state.unsolved_columns > few:
        columns = f"{state.unsolved_columns} columns of film without a solution of shear and heat"
        reason = f"{columns}; try more cycles"
    else:
        return contact, state
    return replace(contact, converged=False, message=f"not converged: {reason}"), state


def _whole(values: Array, ny: int, sign: float = 1.0) -> Array:
    """Fields of shape (..., rows, nx) of a grid as (..., nx, ny) over the whole box."""
    if values.shape[-2] != ny:
        values = unfolded(values, -2, sign)
    return np.ascontiguousarray(np.swapaxes(values, -1, -2))

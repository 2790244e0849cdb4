"""Full approximation scheme for the lubricated contact: levels, relaxation, cycles.

After Venner and Lubrecht, Multilevel Methods in Lubrication (2000), chapters 3 to 6. On every
level

    Reynolds   d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho u H) - d_Y(rho v H) = f,  P >= 0,
    complementary film       H = H0 + s + c_def * double integral of P/r load       integral of P =
    g

f = 0, s = S X^2/2 + T Y^2/2 + C X Y and g = the load on the level being solved; below it they
carry the coarse-grid correction, and the integral is over the change of P since it was injected. P
and H are injected, residuals fully weighted, corrections interpolated bilinearly.
"""

from collections.abc import Callable
from functools import partial
from math import inf

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid, full_weighting, inject, interpolate_cubic, interpolate_linear
from ..oil import _kernels as oil_kernels
from ..oil import _laws
from ..oil.lubricant import log_viscosity_ratio, oil_numbers
from ..scaling import ScaledContact
from ..solid.deformation import deflect
from . import _reynolds_kernels
from .far_field import edge_pressure, exterior_load
from .levels import Damping, Level, Multigrid, TimeStep
from .starved import (
    Fields,
    flux_operator,
    march_all_film_content,
    march_film_content,
    oil_imbalance,
    restrict_flux,
)

COARSEST_SWEEPS = 10
SWEEPS = (2, 1)  # on every other level before and after the coarser ones
# levels above the coarsest, and finest levels, that visit the next lower one once a cycle instead
# of twice: near the coarsest calls cost more than arithmetic, near the finest a second visit costs
# more deflections than it saves
SINGLE_VISITS = (2, 2)


def start_level(state: Multigrid, index: int, pressure: Array) -> None:
    """Make a level the one being solved, from an initial guess of the pressure.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    pressure : Array
        initial guess, shape (ny, nx) [-]
    """
    level = state.levels[index]
    level.P = np.maximum(pressure, 0.0)
    level.f = np.zeros_like(level.P)
    level.s = level.gap
    level.start = None
    level.load = required_load(state) - state.exterior
    if state.far_field is None:
        _zero_edge(level.P, level.grid)
    update_film(state, index)


def update_film(state: Multigrid, index: int) -> None:
    """Set H = H0 + s + deflection on a level.

    On the level being solved an open edge takes its pressure from the new film. Below it s holds
    the film injected from above, and only the change of pressure is deflected.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    """
    level = state.levels[index]
    pressure = level.P if level.start is None else level.P - level.start
    level.H = deflect(level.kernel, pressure, state.threads.number_for(pressure.size))
    level.H += level.s
    level.H += state.approach
    state.deflections[index] = state.deflections.get(index, 0) + 1
    edge = state.edge_field(level) if level.s is level.gap else None
    if edge is not None:
        inlet_film_thickness = (
            None if level.film_content is None else level.film_content.inlet_film_thickness
        )
        edge_pressure(edge, level.H, level.P, inlet_film_thickness)


def refresh_factors(state: Multigrid, index: int) -> None:
    """Evaluate the flow model on a level, and inject its factors into the coarser levels.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    """
    if state.flow_model is None:
        return
    level = state.levels[index]
    last = level.flow_state
    if last is None and index and state.levels[index - 1].flow_state is not None:
        last = state.flow_model.refined(state.levels[index - 1].flow_state)
    factors, level.flow_state = state.flow_model.factors(
        state.contact, level.grid, level.P, level.H, last
    )
    level.factors = factors
    for coarser in reversed(state.levels[:index]):
        factors = factors.coarsened()
        coarser.factors = factors


def flow(state: Multigrid, level: Level) -> None:
    """Set flow coefficient, and density times velocity, of a level from its pressure and film.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, with flow model and step in time
    level : Level
        level whose flow is set in place
    """
    factors = level.factors
    _oil(state, level)
    if state.time_step is not None:
        _store(state.time_step, level)
    if factors.couette_y is not None:
        np.multiply(level.flow_x, factors.couette_y, out=level.flow_y)
        np.multiply(level.slope_x, factors.couette_y, out=level.slope_y)
    if factors.couette_x is not None:
        level.flow_x *= factors.couette_x
        level.slope_x *= factors.couette_x
    if factors.poiseuille is not None:
        level.eps *= factors.poiseuille


def _store(step: TimeStep, level: Level) -> None:
    """Set the storage of the nodes over a step from density and its slope in place of the flow,
    and the flow that the step leaves.
    """
    if not level.storage.size:
        level.storage = np.zeros((2, *level.P.shape))
    for stored, density in zip(level.storage, (level.flow_x, level.slope_x), strict=True):
        np.multiply(density, step.rate, out=stored)
        density *= step.couette


def _oil(state: Multigrid, level: Level) -> None:
    """eps, and rho and its slope in place of the flow, of a Newtonian isothermal oil; of one that
    thins, eps as much less as its factors follow the pressure.
    """
    c = state.contact
    if c.oil is None:
        viscosity = (c.viscosity_slope, c.viscosity_pressure, c.viscosity_exponent)
        density = (c.density_numerator, c.density_denominator)
        law = partial(_reynolds_kernels.flow_properties, level.P, level.H, *viscosity, *density)
    else:
        numbers = oil_numbers(c.oil)
        law = partial(oil_kernels.flow_properties, level.P, level.H, c.hertz_pressure, numbers)
    lines = partial(law, *level.factors.follows, c.speed, level.eps, level.flow_x, level.slope_x)
    state.threads.run(lines, range(level.grid.ny), level.P.size)


def log_viscosity(contact: ScaledContact, P: Array) -> Array:
    """Evaluate ln(eta/eta_0) at a pressure.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact
    P : Array
        pressure over Hertz' pressure, any shape [-]

    Returns
    -------
    Array
        logarithm of the viscosity ratio, shape of `P` [-]
    """
    c = contact
    if c.oil is not None:
        return log_viscosity_ratio(np.maximum(P, 0.0) * c.hertz_pressure, c.oil)
    ratio = c.viscosity_pressure * np.maximum(P, 0.0)
    return c.viscosity_slope * (_laws.roelands_rise(ratio, c.viscosity_exponent) - 1.0)


def relax(state: Multigrid, index: int) -> None:
    """Relax a level by one line sweep, even lines before odd ones, and update its film.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    """
    level = state.levels[index]
    grid = level.grid
    flow(state, level)
    lines = _line_sweep(level, state.damping)
    first = 0 if grid.symmetric else 1
    for colour in (first, first + 1):
        if level.film_content is not None:
            march_film_content(level.film_content, _fields(level), grid, state.threads, colour)
        state.threads.run(lines, range(colour, grid.ny - 1, 2), level.P.size)
    mesh = (grid.hx, grid.hy)
    changes = partial(
        _reynolds_kernels.spread_changes,
        level.P,
        level.node_types,
        level.scratch,
        *mesh,
        state.damping.jacobi,
    )
    state.threads.run(changes, range(first, grid.ny - 1), level.P.size)
    update_film(state, index)


def _line_sweep(level: Level, damping: Damping) -> Callable[[int, int], None]:
    """Relaxation of every second line of a range, the changes left to `spread_changes`."""
    grid = level.grid
    lateral = level.factors.couette_y is not None
    across = (level.flow_y, level.slope_y) if lateral else (None, None)
    stored = level.storage.size > 0
    reversing = True if stored or level.factors.couette_x is not None else None
    content = level.film_content
    layer: tuple[Array | None, NDArray[np.int8] | None, Array | None] = (None, None, None)
    if content is not None:
        layer = (content.residual, content.empty, content.fraction_along)
    return partial(
        _reynolds_kernels.relax_lines,
        level.P,
        level.H,
        level.eps,
        level.flow_x,
        level.slope_x,
        *across,
        reversing,
        level.f,
        level.storage if stored else None,
        level.kernel.near,
        grid.hx,
        grid.hy,
        grid.symmetric,
        *layer,
        damping.gauss_seidel,
        damping.switch * max(1.0, grid.hy / grid.hx) ** 1.5,
        level.node_types,
        level.scratch,
    )


def _flow_across(level: Level) -> Array | None:
    """Density times the velocity across the lines; None where nothing flows there."""
    return None if level.factors.couette_y is None else level.flow_y


def reynolds_operator(level: Level) -> Array:
    """Evaluate L(P) of a level whose flow is up to date.

    Parameters
    ----------
    level : Level
        level with pressure, film and flow

    Returns
    -------
    Array
        L(P), shape (ny, nx), in the scratch array of the level [-]
    """
    grid = level.grid
    couette = (level.flow_x, _flow_across(level))
    _reynolds_kernels.reynolds_operator(
        level.P, level.H, level.eps, *couette, grid.hx, grid.hy, grid.symmetric, level.scratch
    )
    if level.storage.size:
        level.scratch -= level.storage[0] * level.H
        _zero_edge(level.scratch, grid)
    return level.scratch


def reynolds_residual(state: Multigrid, index: int) -> Array:
    """Evaluate the residual f - L(P) of Reynolds' equation.

    It is zero on the edge and at cavitated nodes that obey L(P) <= f, or whose oil does not fill
    the gap.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    Array
        residual, shape (ny, nx) [-]
    """
    level = state.levels[index]
    flow(state, level)
    if level.film_content is not None:
        march_all_film_content(level.film_content, _fields(level), level.grid, state.threads)
        residual = np.where(level.film_content.empty, 0.0, level.film_content.residual)
        _zero_edge(residual, level.grid)
        return residual
    residual = level.f - reynolds_operator(level)
    _zero_edge(residual, level.grid)
    residual[(level.P <= 0.0) & (residual >= 0.0)] = 0.0
    return residual


def relative_residual(state: Multigrid, index: int) -> tuple[float, float]:
    """Relate the residual of a level to its flow.

    Sums over the fluid nodes are taken over the sum of |div(rho u H)| there; behind an inlet
    film the imbalance is taken over the oil that enters.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    residual
        sum of |f - L(P)| over that of the flow [-]
    imbalance
        oil that appears or is lost, signed [-]
    """
    level = state.levels[index]
    residual = reynolds_residual(state, index)
    couette = (level.flow_x, _flow_across(level))
    size, balance, divergence = _reynolds_kernels.residual_sums(
        level.P, level.H, residual, *couette, level.grid.hx, level.grid.hy
    )
    if not divergence > 0.0:
        return inf, inf
    if level.film_content is not None:
        return size / divergence, oil_imbalance(level.film_content, residual, level.grid)
    return size / divergence, balance / divergence


def load_error(state: Multigrid, index: int) -> float:
    """Evaluate (integral of P - load)/load of the contact.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    float
        relative error of the load balance [-]
    """
    level = state.levels[index]
    return (level.grid.integral(level.P) - level.load) / state.contact.load


def cycle(state: Multigrid, index: int) -> None:
    """Run one cycle from a level down, Venner and Lubrecht (2000), chapters 3 and 6.

    The coarsest level also moves H0 towards the load balance. W between the levels of
    `SINGLE_VISITS`, V above and below; V alone where cycles oscillate: thick films near the edge
    of the box press there the more the thinner they are, which the coarser levels do not know,
    and two visits overshoot twice as far.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level, 0 the coarsest [-]
    """
    if index == 0:
        _solve_coarsest(state)
    else:
        # 1. sweeps before
        for _ in range(SWEEPS[0]):
            relax(state, index)
        # 2. coarse-grid problem of the full approximation scheme, Brandt (1977)
        start = _restrict(state, index)
        approach = state.approach
        # 3. its solution by cycles of the levels below
        lowest, highest = SINGLE_VISITS
        twice = lowest < index < len(state.levels) - highest and not state.oscillates
        for _ in range(2 if twice else 1):
            cycle(state, index - 1)
        # 4. correction of pressure and film
        _correct(state, index, start, approach)
        # 5. sweeps after
        for _ in range(SWEEPS[1]):
            relax(state, index)
    if state.levels[index].s is state.levels[index].gap:
        update_exterior(state, index)


def _solve_coarsest(state: Multigrid) -> None:
    level = state.levels[0]
    stiffness = 1.0 + 2.0 * max(state.contact.film_guess, 0.0)  # a thick film responds softly
    for _ in range(COARSEST_SWEEPS):
        relax(state, 0)
        softness = state.damping.approach * stiffness
        step = softness * load_error(state, 0)
        if state.time_step is not None:  # bodies of a mass, which their own inertia holds back
            resistance = state.time_step.inertia / state.contact.load
            step -= softness * resistance * (state.approach - state.time_step.free)
            step /= 1.0 + softness * resistance
        step = min(max(step, -0.1 * stiffness), 0.1 * stiffness)
        state.approach += step
        level.H += step


def _restrict(state: Multigrid, index: int) -> Array:
    """Set up the coarse-grid problem; returns the injected pressure."""
    fine = state.levels[index]
    coarse = state.levels[index - 1]
    residual = reynolds_residual(state, index)
    start = inject(fine.P)
    coarse.P = start.copy()
    coarse.start = start
    coarse.H = inject(fine.H)
    coarse.s = coarse.H - state.approach
    coarse.load = coarse.grid.integral(start) + fine.load - fine.grid.integral(fine.P)
    flow(state, coarse)
    if fine.film_content is not None and coarse.film_content is not None:
        restrict_flux(fine.film_content, coarse.film_content, _fields(coarse), coarse.grid)
        operator = flux_operator(coarse.film_content, _fields(coarse), coarse.grid, coarse.scratch)
    else:
        operator = reynolds_operator(coarse)
    coarse.f = operator + full_weighting(residual, coarse.grid.symmetric)
    return start


def _correct(state: Multigrid, index: int, start: Array, approach: float) -> None:
    """P += correction where P > 0; the film by interpolation until the next sweep.

    Where oil flows along the lines alone and fills the gap, nodes beside an empty coarse one are
    left to the sweeps: corrections there moved the edge of the cavity back and forth for ever, 9
    cycles instead of 3 at M 20, L 10 on 1025 points. Oblique contacts need them to move it far.
    """
    fine = state.levels[index]
    coarse = state.levels[index - 1]
    fraction = state.damping.correction
    correction = interpolate_linear(coarse.P - start)
    if fine.factors.couette_y is None and fine.film_content is None:
        empty = (coarse.P <= 0.0) | (start <= 0.0)
        correction[interpolate_linear(empty.astype(np.float64)) > 0.0] = 0.0
    fine.P = np.where(fine.P > 0.0, np.maximum(fine.P + fraction * correction, 0.0), 0.0)
    deflection = coarse.H - coarse.s - state.approach
    fine.H += fraction * interpolate_cubic(deflection, fine.grid.symmetric)
    fine.H += state.approach - approach


def update_exterior(state: Multigrid, index: int) -> None:
    """Set the load outside an open box by the film of a level, and the load that the box carries.

    A closed box carries the whole load.

    Parameters
    ----------
    state : Multigrid
        levels of the contact, changed in place
    index : int
        number of the level being solved [-]
    """
    if state.far_field is None:
        return
    level = state.levels[index]
    central = inlet_film_at_centre(state)
    state.exterior = exterior_load(state.far_field, level.grid, level.H, central)
    level.load = required_load(state) - state.exterior


def required_load(state: Multigrid) -> float:
    """Give the integral of P that the contact carries at the time of the step, without inertia.

    Parameters
    ----------
    state : Multigrid
        levels of the contact

    Returns
    -------
    float
        load [-]
    """
    return state.contact.load if state.time_step is None else state.time_step.load


def inlet_film_at_centre(state: Multigrid) -> float:
    """Give the inlet film thickness on the line y = 0.

    Parameters
    ----------
    state : Multigrid
        levels of the contact

    Returns
    -------
    float
        inlet film thickness; infinite in a flooded contact [-]
    """
    inlet_film_thickness = state.contact.inlet_layer
    return inf if inlet_film_thickness is None else inlet_film_thickness.central


def _fields(level: Level) -> Fields:
    """Gather the fields that the flux of a level follows from."""
    flow_y = level.flow_y if level.factors.couette_y is not None else level.flow_x
    return Fields(
        P=level.P, H=level.H, eps=level.eps, flow_x=level.flow_x, flow_y=flow_y, f=level.f
    )


def _zero_edge(values: Array, grid: Grid) -> None:
    values[:, 0] = values[:, -1] = values[-1] = 0.0
    if not grid.symmetric:
        values[0] = 0.0

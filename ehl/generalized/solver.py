"""Contacts whose oil thins under shear and heats up, by a generalized Reynolds equation."""

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from ..arrays import Array
from ..closed_form.film import film_reduction_gupta, thermal_loading
from ..closed_form.hertz import MEAN_PRESSURE_RATIO, hertz_contact
from ..conditions import ContactConditions
from ..grid import unfolded
from ..multigrid.full_multigrid import ATTEMPTS, Attempt
from ..multigrid.verdict import tolerance_reached, with_status, with_tolerance_status
from ..oil.film_state import FilmState, log_gradient_thinning, log_mean_fluidity
from ..oil.rheology import Rheology, contact_rheology
from ..options import GENERALIZED_POINTS, SolverOptions
from ..solid.heat import SolidThermal
from ..solution import ContactSolution
from ..solver import solve_attempts, solve_contact
from .continuation import FLOW_TOLERANCE, last_flow, solve_by_continuation, with_fallbacks
from .film_heat import FilmHeat
from .flow import Continuation, FlowState, GeneralizedFlow
from .section import film_section

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
    257 points where the options have neither points nor a tolerance. Shear and heat are two
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
        thermal properties of body 1 and body 2; None: uniform temperature
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
        if the lubricant lacks a temperature or thermal properties that heat needs, or conditions
        have an inlet film
    """
    options = options or SolverOptions()
    if rheology.newtonian and solids is None:
        contact = solve_contact(conditions, options)
        nodes = film_section().nodes
        return GeneralizedSolution(contact=contact, rheology=rheology, nodes=nodes)
    if conditions.inlet_layer is not None:
        raise ValueError("inlet_layer: films with shear or heat are solved flooded only")
    if options.points is None and options.tolerance is None:
        options = replace(options, points=GENERALIZED_POINTS)
    hertz = hertz_contact(
        conditions.load, conditions.radius_x, conditions.radius_y, conditions.reduced_modulus
    )
    rheology = contact_rheology(
        rheology, conditions.lubricant, MEAN_PRESSURE_RATIO * hertz.pressure
    )
    heat = None
    if solids is not None:
        heat = FilmHeat(conditions=conditions, solids=solids, oil_temperature=oil_temperature)
    flow = GeneralizedFlow(conditions=conditions, rheology=rheology, heat=heat)
    start = perf_counter()
    contact, state = _first_converged(flow, options)
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
    over = f"the limiting stress is below h/2 grad p at {state.over_limit_columns} columns"
    if not contact.converged:
        if state.over_limit_columns:
            contact = replace(contact, message=f"{contact.message}; {over} of the last cycle")
        return contact, state
    if state.over_limit_columns > few:
        reason = f"{over}, where no oil of that law flows steadily"
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

"""Contacts with an oil that thins under shear and warms: the contact solver with a generalized
Reynolds equation.
"""

from contextlib import suppress
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from ..conditions import ContactConditions
from ..oil.film_state import FilmState, log_gradient_thinning, log_mean_fluidity
from ..oil.rheology import Rheology
from ..options import SolverOptions
from ..solid.heat import SolidThermal
from ..solution import ContactSolution
from ..solver import solve_contact
from .continuation import SETTLED, continued
from .film_heat import FilmHeat
from .flow import BeganAnewError, GeneralizedFlow
from .section import film_section

Array = NDArray[np.float64]

# share of the columns that may be without a solution: they lie where hardly anything flows
MISSED = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralizedSolution:
    """One contact with its oil's rheology and heat; fields on the grid of `contact`, shape (nx,
    ny) or as told.

    Attributes
    ----------
    contact : ContactSolution
        Pressure and film; `converged` and `message` include shear and heat.
    rheology : Rheology
    nodes : ndarray, shape (n,)
        Places z/h across the film, from body 1 to body 2 [-].
    mid_stress : ndarray, shape (2, nx, ny), or None
        Stress in the middle of the film along x and y [Pa]; None: Newtonian and of uniform
        temperature.
    temperature : ndarray, shape (nx, ny, n), or None
        Of the oil at the nodes, walls included [K]; None: solved without heat.
    heat_flux : ndarray, shape (2, nx, ny), or None
        Into body 1 and body 2 [W/m^2].
    dissipation : ndarray, shape (nx, ny), or None
        Heat of shear over the film [W/m^2].
    change : float
        Change of the logarithm of the Poiseuille factor in the last turn, weighted with the
        pressure's own flow [-].
    missed : int
        Columns of the last turn without a solution [-].
    beyond : int
        Columns of the last turn in which h/2 grad p exceeded the limiting stress [-].
    """

    contact: ContactSolution
    rheology: Rheology
    nodes: Array
    mid_stress: Array | None = None
    temperature: Array | None = None
    heat_flux: Array | None = None
    dissipation: Array | None = None
    change: float = 0.0
    missed: int = 0
    beyond: int = 0

    @property
    def mean_temperature(self) -> Array | None:
        """Of the oil over the film thickness, shape (nx, ny) [K]."""
        if self.temperature is None:
            return None
        z, t = self.nodes, self.temperature
        return np.asarray(np.trapezoid(t, z, axis=-1), dtype=np.float64)


def solve_generalized(
    conditions: ContactConditions,
    rheology: Rheology,
    *,
    solids: tuple[SolidThermal, SolidThermal] | None = None,
    oil_temperature: float | None = None,
    options: SolverOptions | None = None,
) -> GeneralizedSolution:
    """Pressure, film, shear stress and temperature of a steady flooded contact, Yang and Wen
    (1990).

    Parameters
    ----------
    conditions : ContactConditions
        With heat, its lubricant has a temperature and thermal properties.
    rheology : Rheology
    solids : tuple of SolidThermal, optional
        Body 1 and body 2; None: uniform temperature. Newtonian and uniform is `solve_contact`
        itself.
    oil_temperature : float, optional
        Of the oil that flows in [K]; None: the lubricant's temperature of operation.
    options : SolverOptions, optional

    Returns
    -------
    GeneralizedSolution
        Fields of the last turn of shear and heat, one multigrid cycle behind pressure and film.
        The time of its record is that of all ways that were tried; its FFTs are those of the last
        one, with the Newtonian film it began from.

    Raises
    ------
    ValueError
        If properties that are needed are missing; the message names them.
    """
    heat = (
        None
        if solids is None
        else FilmHeat(conditions=conditions, solids=solids, oil_temperature=oil_temperature)
    )
    flow = GeneralizedFlow(conditions=conditions, rheology=rheology, heat=heat)
    if rheology.newtonian and heat is None:
        return GeneralizedSolution(
            contact=solve_contact(conditions, options), rheology=rheology, nodes=flow.section.nodes
        )
    began = perf_counter()
    contact = _reached(conditions, options or SolverOptions(), flow)
    contact = replace(contact, record=replace(contact.record, wall_time=perf_counter() - began))
    nx, ny = contact.P.shape
    shape = next((s for s in ((ny, nx), (ny // 2 + 1, nx)) if s in flow.stresses), None)
    solution = GeneralizedSolution(
        contact=contact,
        rheology=rheology,
        nodes=flow.section.nodes,
        change=flow.change,
        missed=_missed(flow),
        beyond=flow.beyond,
    )
    if shape is None:
        return _with_state(solution)
    solution = replace(solution, mid_stress=_whole(flow.stresses[shape], ny, (1.0, -1.0)))
    if heat is None:
        return _with_state(solution)
    state = heat.states[shape]
    warm = replace(
        solution,
        temperature=np.moveaxis(_whole(np.moveaxis(state.temperature, -1, 0), ny), 0, -1),
        heat_flux=_whole(state.flux, ny),
        dissipation=_whole(state.dissipation, ny),
    )
    return _with_state(warm)


def _reached(
    conditions: ContactConditions, options: SolverOptions, flow: GeneralizedFlow
) -> ContactSolution:
    """The solution of the first way that converges; that of the last way if none does, told in the
    record.

    The cycles from a Hertz pressure on, once; then the continuation from the Newtonian film, and
    that again with the thinning carried along; then the fallbacks of the Newtonian solver one
    after the other. With a tolerance only the cycles from a Hertz pressure, with the fallbacks.
    """
    flow.single = options.tolerance is None
    with suppress(BeganAnewError):
        contact = _judged(solve_contact(conditions, options, flow), flow)
        if contact.converged or not flow.single:
            return contact
    plain = solve_contact(conditions, options)
    fallbacks = plain.record.fallbacks
    for flow.carried in (False, True) if plain.converged else (False,):
        contact = _judged(continued(conditions, options, flow, plain), flow)
        fallbacks = (*fallbacks, *contact.record.fallbacks[len(plain.record.fallbacks) :])
        if contact.converged:
            return replace(contact, record=replace(contact.record, fallbacks=fallbacks))
    flow.forget()
    flow.single = flow.carried = False
    contact = _judged(solve_contact(conditions, options, flow), flow)
    return replace(
        contact, record=replace(contact.record, fallbacks=(*fallbacks, *contact.record.fallbacks))
    )


def _with_state(solution: GeneralizedSolution) -> GeneralizedSolution:
    """The solution whose contact, if it has dimensions, knows the state of its oil."""
    contact = solution.contact
    if contact.x is None or contact.y is None or contact.film is None:
        return solution
    thinner = log_gradient_thinning(
        contact.x, contact.y, contact.pressure, contact.film, solution.rheology
    )
    mean = None
    if solution.temperature is not None:
        weights = film_section(solution.nodes.size).weights
        mean, profile = log_mean_fluidity(
            solution.temperature, weights, contact.pressure, contact.conditions.lubricant
        )
        thinner = profile + thinner
    return replace(
        solution, contact=replace(contact, state=FilmState(temperature=mean, log_fluidity=thinner))
    )


def _missed(flow: GeneralizedFlow) -> int:
    return flow.missed + (0 if flow.heat is None else flow.heat.missed)


def _judged(contact: ContactSolution, flow: GeneralizedFlow) -> ContactSolution:
    """The solution with what shear and heat say about its convergence, a limiting stress that was
    exceeded included.
    """
    below = f"the limiting stress is below h/2 grad p at {flow.beyond} columns"
    if not contact.converged:
        return (
            replace(contact, message=f"{contact.message}; {below} of the last cycle")
            if flow.beyond
            else contact
        )
    if flow.beyond > MISSED * contact.P.size:
        said = f"{below}, where no oil of that law flows steadily"
    elif not flow.change <= SETTLED:
        said = f"shear and heat changed the flow by {flow.change:.1e} in the last cycle; try more cycles"
    elif _missed(flow) > MISSED * contact.P.size:
        said = f"{_missed(flow)} columns of film without a solution of shear and heat; try more cycles"
    else:
        return contact
    return replace(contact, converged=False, message=f"not converged: {said}")


def _whole(values: Array, ny: int, signs: tuple[float, ...] = ()) -> Array:
    """Fields of shape (..., rows, nx) of a grid as (..., nx, ny), the lower half mirrored where it
    was left out.
    """
    if values.shape[-2] != ny:
        mirror = values[..., :0:-1, :]
        if signs:
            mirror = mirror * np.array(signs)[:, None, None]
        values = np.concatenate((mirror, values), axis=-2)
    return np.ascontiguousarray(np.swapaxes(values, -1, -2))

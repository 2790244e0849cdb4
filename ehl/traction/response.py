r"""Stiffness and squeeze damping of a lubricated contact along its normal.

With h_0 the constant of the film equation (minus the approach), the load is F(h_0) when the bodies
stand still and, to first order in its rate, F(h_0) + F' dh_0/dt when they move: stiffness k =
-dF/dh_0, damping c = -F'. Both come from the solver: a little more load gives k and the change of
the film with h_0; the squeeze term of Reynolds' equation,

.. math:: \frac{\partial(\rho h)}{\partial t} = \frac{\partial(\rho h)}{\partial h_0}\Big|_{steady}
    \dot h_0,

in which the film follows the approach as slowly as in a row of steady states (the approximation:
an approach slow against the time a/u_m that oil takes through the contact), then gives another h_0
under the same load, and c.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..multigrid.cycle import cycle, start_level
from ..multigrid.full_multigrid import ATTEMPTS, CAUTIOUS, Attempt, contact_multigrid
from ..multigrid.levels import Damping, Multigrid
from ..oil.lubricant import Lubricant, density
from ..options import SolverOptions
from ..scaling import scale_contact
from ..solution import ContactSolution

# relative; the film's change is then a hundred times the error of the iteration
LOAD_STEP = 0.02
SQUEEZE_STEP = 0.02  # dH_0/dT over the central film, T in a/u_m; small against 1
CYCLES = 8  # of each step, from the neighbouring solution
DAMPINGS = (  # one after the other; the second with twice the cycles
    Attempt(name="plain", damping=Damping()),
    Attempt(name="damped", damping=CAUTIOUS),
)
# across, of the solver's attempts, nearest to the plain one first
MESHES = tuple(sorted({attempt.mesh_y for attempt in ATTEMPTS}, key=lambda mesh: abs(mesh - 1.0)))
CHANGE = 0.03  # of H_0 in the last cycle over its whole step: above it the step is not converged


@dataclass(frozen=True, slots=True, kw_only=True)
class NormalResponse:
    """Stiffness and squeeze damping of a contact in the direction of its normal."""

    stiffness: float  # -dF/dh_0 [N/m]
    damping: float  # -dF/d(dh_0/dt) [N s/m]
    converged: bool


def normal_response(solution: ContactSolution) -> NormalResponse:
    """Stiffness [N/m] and damping [N s/m] of a solved contact in a box of the solver's choice, of
    dimensional conditions, Newtonian and isothermal; not numbers and not converged on a grid that
    is none of the solver's.
    """
    for damped, attempt in enumerate(DAMPINGS):
        with np.errstate(all="ignore"):  # where the iteration diverges, `converged` is false
            response = _response(solution, attempt, CYCLES << damped)
        if response.converged:
            break
    return response


def _response(solution: ContactSolution, attempt: Attempt, cycles: int) -> NormalResponse:
    conditions = solution.conditions
    scale = solution.film_scale
    a = solution.semi_axis_x
    if not isinstance(conditions, ContactConditions) or scale is None or a is None:
        raise ValueError("solution: stiffness and damping need dimensional conditions")
    state = _levels(solution, attempt)
    if state is None:
        return NormalResponse(stiffness=np.nan, damping=np.nan, converged=False)
    level = state.levels[-1]
    oil = conditions.lubricant
    # 1. the solution itself, iterated on this grid
    _relax(state, cycles)
    start = state.approach
    pressure = level.P.copy()
    content = _content(state, oil)
    # 2. a little more load: stiffness, and how the oil in the film follows h_0
    heavier = replace(
        state, contact=replace(state.contact, load=(1.0 + LOAD_STEP) * state.contact.load)
    )
    steady = _relax(heavier, cycles)
    softer = heavier.approach - start
    follow = (_content(heavier, oil) - content) / softer
    # 3. the same load with bodies that approach: damping
    state.exterior = heavier.exterior
    start_level(state, len(state.levels) - 1, pressure)
    rate = SQUEEZE_STEP * solution.film_central_dimensionless.value
    level.f = rate * follow
    steady = _relax(state, cycles) and steady
    stiffness = -LOAD_STEP * conditions.load / (softer * scale)
    damping = -stiffness * (state.approach - start) / (rate * conditions.entrainment_speed / a)
    return NormalResponse(
        stiffness=float(stiffness),
        damping=float(damping),
        converged=bool(steady and stiffness > 0.0 and damping > 0.0 and np.isfinite(damping)),
    )


def _levels(solution: ContactSolution, attempt: Attempt) -> Multigrid | None:
    """Levels with a solution on the finest; None if no mesh of the solver is its."""
    guess = solution.film_central_dimensionless.value
    contact = replace(scale_contact(solution.conditions), film_guess=guess)
    options = SolverOptions(points=solution.X.size)
    for mesh in MESHES:
        state = contact_multigrid(contact, solution.domain, options, replace(attempt, mesh_y=mesh))
        level = state.levels[-1]
        pressure = solution.P.T
        if level.grid.symmetric:
            pressure = pressure[pressure.shape[0] // 2 :]
        if pressure.shape == level.P.shape:
            state.approach = solution.approach_dimensionless
            start_level(state, len(state.levels) - 1, pressure)
            return state
    return None


def _relax(state: Multigrid, cycles: int) -> bool:
    """Cycle on the finest level; whether the last cycle changed H_0 little against all of them."""
    begin = last = state.approach
    for _ in range(cycles):
        last = state.approach
        cycle(state, len(state.levels) - 1)
    return abs(state.approach - last) <= CHANGE * abs(state.approach - begin)


def _content(state: Multigrid, oil: Lubricant) -> Array:
    """rho H over the density at ambient pressure, on the finest level [-]."""
    level = state.levels[-1]
    ratio: Array = density(level.P * state.contact.hertz_pressure, oil) / oil.density
    return ratio * level.H

"""Oil that appears or is lost in a film between its inlet and lines across the rolling."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl import ContactConditions, SolverOptions
from oilfilm.ehl.generalized.flow import GeneralizedFlow
from oilfilm.ehl.multigrid import cycle
from oilfilm.ehl.multigrid.full_multigrid import ATTEMPTS, guarded_cycle
from oilfilm.ehl.multigrid.history import central_film
from oilfilm.ehl.multigrid.levels import Level, Multigrid
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solver import solve_attempts

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class MassDrift:
    """Oil gained upstream of X, over the flow rho u H of the centre through the width of the Hertz
    ellipse; shape (nx,) [-].
    """

    X: Array
    solver: Array  # by the solver's equations: what the cycles have left of them
    averaged: Array  # by flows averaged between nodes: with the error of the mesh

    def at(self, X: float) -> float:
        """By averaged flows, up to the line X [-]."""
        return float(self.averaged[np.searchsorted(self.X, X)])


def solve_film(conditions: ContactConditions, rheology: Rheology, points: int) -> Multigrid:
    """Levels of a contact at the end of the first attempt's cycles."""
    flow = GeneralizedFlow(conditions=conditions, rheology=rheology)
    return solve_attempts(conditions, SolverOptions(points=points), flow, ATTEMPTS[:1])[1]


def cycle_on(state: Multigrid, count: int) -> None:
    """Further cycles on the finest level, with new factors before each."""
    for _ in range(count):
        guarded_cycle(state, len(state.levels) - 1)


def film_centre(state: Multigrid) -> float:
    """Central film on the finest grid, units a^2/Rx [-]."""
    level = state.levels[-1]
    return central_film(level.grid, level.H)


def reversed_nodes(state: Multigrid) -> int:
    """Nodes under pressure whose Couette flow runs against the entrainment: there the differences
    upstream of neighbours do not cancel in the sum over a line.
    """
    level = state.levels[-1]
    cycle.flow(state, level)
    return int(np.count_nonzero((level.flow_x < 0.0) & (level.P > 0.0)))


def mass_drift(state: Multigrid) -> MassDrift:
    """Of the finest level, with the factors of its last cycle."""
    level = state.levels[-1]
    contact = state.contact
    solver = cycle.reynolds_residual(state, len(state.levels) - 1).copy()
    width = 2.0 * contact.half_extent_y
    line = 0 if level.grid.symmetric else level.grid.ny // 2
    middle = int(np.argmin(np.abs(level.grid.X)))
    through = float(level.flow_x[line, middle] * level.H[line, middle]) * width
    return MassDrift(
        X=level.grid.X,
        solver=_gained(level, solver) / through,
        averaged=_gained(level, -_averaged_divergence(level)) / through,
    )


def _gained(level: Level, source: Array) -> Array:
    """Integral of a source over the nodes under pressure up to each line, shape (nx,) [-]."""
    grid = level.grid
    inside = np.zeros_like(level.P)
    inside[0 if grid.symmetric else 1 : -1, 1:-1] = 2.0 if grid.symmetric else 1.0
    if grid.symmetric:
        inside[0, 1:-1] = 1.0
    lines = (source * inside * (level.P > 0.0)).sum(axis=0)
    return np.cumsum(lines) * grid.hx * grid.hy


def _averaged_divergence(level: Level) -> Array:
    """Of the mass flow, its Couette part averaged between nodes as the flow coefficient is, second
    order; shape (ny, nx), zero on the edge [-].
    """
    grid = level.grid
    along = level.flow_x * level.H
    flux_x = _mean(along.T).T - _mean(level.eps.T).T * np.diff(level.P, axis=1) / grid.hx
    flux_y = -_mean(level.eps) * np.diff(level.P, axis=0) / grid.hy
    if level.factors.couette_y is not None:
        flux_y += _mean(level.flow_y * level.H)
    divergence = np.zeros_like(level.P)
    divergence[:, 1:-1] = np.diff(flux_x, axis=1) / grid.hx
    divergence[1:-1] += np.diff(flux_y, axis=0) / grid.hy
    if grid.symmetric:
        divergence[0] += 2.0 * flux_y[0] / grid.hy
    return divergence


def _mean(values: Array) -> Array:
    """Between neighbours along the first axis."""
    return np.asarray(0.5 * (values[1:] + values[:-1]), dtype=np.float64)

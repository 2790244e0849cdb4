"""Derivative of the discrete equations of a level at its pressure and approach.

The equations of the multigrid are, with the film H = H0 + gap + K P of the pressure at all nodes,

    interior   L(P) = d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho u H) - d_Y(rho v H) = 0
    edge       P - k/H^2 = 0, k the strength of the far field; P = 0 on a closed box
    load       integral of P + exterior load of H = load.

L is bilinear in (eps, P) and linear in rho H, so that its derivative needs no kernel of its own:
with the stencils of L itself

    L' d = L(d; eps, 0) + L(P; eps_P d + eps_H D, D + (rho'/rho) H d),    D = K d + dH0,

the arguments pressure; flow coefficient, film. Differentiated exactly are the stencils, K (by FFT)
and the powers of H; the slope of ln(eta) is a central difference of the oil's own law.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid
from ..solid.deformation import deflect
from . import _reynolds_kernels
from .cycle import flow, inlet_film_at_centre, log_viscosity, reynolds_operator, reynolds_residual
from .far_field import edge_pressure, exterior_load
from .levels import FlowFactors, Level, Multigrid
from .starved import StarvedFlux, flux_change, starved_flux

Integers = NDArray[np.intp]

# steps of P in the slope of ln(eta), and of H in that of the exterior load: central differences of
# smooth functions, exact to some 1e-9
SLOPE_STEP = 1e-5
FILM_STEP = 1e-5
# weights of the near field by the distance in nodes across and along the lines
TAPER = (1.0, 0.5)

Entry = tuple[Integers | int, Integers | int, Array]  # steps across and along, value at each node


@dataclass(frozen=True, slots=True, kw_only=True)
class Linearisation:
    """Equations of a level and what their derivative needs, arrays of shape (ny, nx); all [-]."""

    grid: Grid  # of the level
    near: Array  # deflection by the distance in lines and columns
    P: Array  # pressure, shape (ny, nx)
    eps: Array  # flow coefficient
    eps_by_pressure: Array  # its derivative by P
    eps_by_film: Array  # its derivative by H
    couette: tuple[Array, Array | None]  # rho u, rho v; None where nothing flows along y
    content_by_pressure: Array  # (rho'/rho) H
    density: Array  # rho, over that at ambient pressure
    H: Array  # film, shape (ny, nx)
    edge: NDArray[np.bool_]  # True on the edge of the box
    edge_by_film: Array  # derivative of the edge pressure, zero inside
    residual: Array  # L(P) inside, k/H^2 - P on the edge
    load_error: float  # load - exterior load - integral of P
    load_by_film: float  # derivative of the exterior load by the film that it is taken from
    starved: StarvedFlux | None = None  # behind a layer of oil; None: flooded

    @property
    def mesh(self) -> tuple[float, float, bool]:
        """hx, hy [-], and whether the grid is that of the upper half."""
        return self.grid.hx, self.grid.hy, self.grid.symmetric


def linearise(state: Multigrid, index: int) -> Linearisation:
    """Linearise the equations of a level at its pressure and approach, for one deflection.

    The film of the level is updated, the pressure on its edge is not.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]

    Returns
    -------
    Linearisation
        derivative of the discrete equations [-]
    """
    level = state.levels[index]
    level.H = deflected(state, index, level.P) + level.s + state.approach
    # 1. oil
    ratio, density, viscosity = _oil_slopes(state, level)
    flow(state, level)
    # 2. edge and load
    edge = edge_nodes(level.grid)
    target, load, load_by_film = _open_edge(state, level)
    # 3. equations
    starved = None
    if level.film_content is None:
        operator = reynolds_operator(level)
    else:
        operator = -reynolds_residual(state, index)
        starved = starved_flux(level.film_content, level.flow_x, level.H, ratio)
    return Linearisation(
        grid=level.grid,
        near=level.kernel.near,
        P=level.P.copy(),
        eps=level.eps.copy(),
        eps_by_pressure=level.eps * (density - viscosity),
        eps_by_film=_over_film(3.0 * level.eps, level.H),
        couette=(
            level.flow_x.copy(),
            None if level.factors.couette_y is None else level.flow_y.copy(),
        ),
        content_by_pressure=density * level.H,
        density=ratio,
        H=level.H.copy(),
        edge=edge,
        edge_by_film=_over_film(-2.0 * target, level.H),
        residual=np.where(edge, target - level.P, operator),
        load_error=load - level.grid.integral(level.P),
        load_by_film=load_by_film,
        starved=starved,
    )


def deflected(state: Multigrid, index: int, pressure: Array) -> Array:
    """Evaluate the deflection of a pressure on a level; it counts as work of the level.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]
    pressure : Array
        shape (ny, nx) [-]

    Returns
    -------
    Array
        deflection, shape (ny, nx) [-]
    """
    state.deflections[index] = state.deflections.get(index, 0) + 1
    return deflect(state.levels[index].kernel, pressure, state.threads.number_for(pressure.size))


def edge_nodes(grid: Grid) -> NDArray[np.bool_]:
    """Mark the edge of the box.

    Parameters
    ----------
    grid : Grid
        grid of the level

    Returns
    -------
    NDArray[np.bool_]
        True on the edge, shape (ny, nx)
    """
    edge = np.zeros((grid.ny, grid.nx), dtype=np.bool_)
    edge[:, [0, -1]] = True
    edge[-1] = True
    edge[0] |= not grid.symmetric
    return edge


def load_row(state: Multigrid, index: int, load_by_film: float) -> Array:
    """Differentiate the load, inside the box and outside, by the pressure of each node.

    The exterior load is taken from the film at the inlet edge of the line y = 0: a row of K. On a
    half grid K is not symmetric; its transpose is D K D^-1, D half on the line of symmetry.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]
    load_by_film : float
        derivative of the exterior load by that film [-]

    Returns
    -------
    Array
        derivative, shape (ny, nx) [-]
    """
    grid = state.levels[index].grid
    along = np.full(grid.nx, grid.hx)
    across = np.full(grid.ny, grid.hy)
    along[[0, -1]] *= 0.5
    across[[0, -1]] *= 0.5
    row = (2.0 if grid.symmetric else 1.0) * across[:, None] * along
    if load_by_film == 0.0:
        return row
    unit = np.zeros_like(row)
    unit[origin_line(grid), 0] = 2.0 if grid.symmetric else 1.0
    deflection = deflected(state, index, unit)
    if grid.symmetric:
        deflection[0] *= 0.5
    return row + load_by_film * deflection


def origin_line(grid: Grid) -> int:
    """Number the line y = 0.

    Parameters
    ----------
    grid : Grid
        grid of the level

    Returns
    -------
    int
        number of the line [-]
    """
    return 0 if grid.symmetric else grid.ny // 2


def _over_film(values: Array, H: Array) -> Array:
    """Values over the film, zero where the bodies overlap."""
    return np.divide(values, H, out=np.zeros_like(H), where=H > 0.0)


def _oil_slopes(state: Multigrid, level: Level) -> tuple[Array, Array, Array]:
    """rho, and d(ln rho)/dP and d(ln eta)/dP as they act on the flow; zero where P = 0."""
    wet = level.P > 0.0
    # density without the velocities, which may vanish
    flow(state, replace(level, factors=FlowFactors()))
    ratio = level.flow_x.copy()
    density = np.where(wet, level.slope_x / level.flow_x, 0.0)
    below = np.maximum(level.P - SLOPE_STEP, 0.0)
    above = np.maximum(level.P, 0.0) + SLOPE_STEP
    rise = log_viscosity(state.contact, above) - log_viscosity(state.contact, below)
    viscosity = np.where(wet, rise / (above - below), 0.0)
    if level.factors.thinning is not None:  # the part that a thinned oil leaves out
        viscosity = viscosity * (1.0 - level.factors.thinning)
    return ratio, density, viscosity


def _open_edge(state: Multigrid, level: Level) -> tuple[Array, float, float]:
    """Pressure that the edge asks for, load of the box, and the slope of the exterior load."""
    target = np.zeros_like(level.P)
    edge = state.edge_field(level)
    if edge is None:
        return target, state.contact.load, 0.0
    inlet_film_thickness = (
        None if level.film_content is None else level.film_content.inlet_film_thickness
    )
    edge_pressure(edge, level.H, target, inlet_film_thickness)
    central = inlet_film_at_centre(state)
    exterior, more, less = (
        exterior_load(edge.field, level.grid, level.H * (1.0 + step), central)
        for step in (0.0, FILM_STEP, -FILM_STEP)
    )
    film = float(level.H[origin_line(level.grid), 0])
    return target, state.contact.load - exterior, (more - less) / (2.0 * FILM_STEP * film)


def product(lin: Linearisation, change: Array, film: Array) -> Array:
    """Apply the derivative of L inside, and of P - k/H^2 on the edge.

    Parameters
    ----------
    lin : Linearisation
        linearised equations
    change : Array
        change of the pressure, shape (ny, nx), real [-]
    film : Array
        change of the film that belongs to it, shape (ny, nx), real [-]

    Returns
    -------
    Array
        change of the equations, shape (ny, nx) [-]
    """
    content = film + lin.content_by_pressure * change
    if lin.starved is None:
        rows = poiseuille_change(lin, change, film, content)
    else:
        gained = poiseuille_change(lin, change, film)
        rows = flux_change(lin.starved, lin.grid, gained, lin.density * content).rows
    return np.where(lin.edge, change - lin.edge_by_film * film, rows)


def poiseuille_change(
    lin: Linearisation, change: Array, film: Array, content: Array | None = None
) -> Array:
    """Apply the derivative of the Poiseuille term inside.

    Parameters
    ----------
    lin : Linearisation
        linearised equations
    change : Array
        change of the pressure, shape (ny, nx), real [-]
    film : Array
        change of the film, shape (ny, nx), real [-]
    content : Array | None, optional
        change of rho H whose flow is subtracted, shape (ny, nx); None: none [-]

    Returns
    -------
    Array
        change of the term, shape (ny, nx) [-]
    """
    by_pressure = np.zeros_like(change)
    by_flow = np.zeros_like(change)
    still = np.zeros_like(change)
    eps = lin.eps_by_pressure * change + lin.eps_by_film * film
    standing = (still, None)
    couette = standing if content is None else lin.couette
    carried = still if content is None else content
    _reynolds_kernels.reynolds_operator(change, still, lin.eps, *standing, *lin.mesh, by_pressure)
    _reynolds_kernels.reynolds_operator(lin.P, carried, eps, *couette, *lin.mesh, by_flow)
    return by_pressure + by_flow


def near_field(lin: Linearisation) -> "scipy.sparse.csr_matrix":
    """Assemble the derivative with the deflection of a node and its eight neighbours only,
    tapered.

    The transform of the triangular taper is positive, and so is that of the tapered kernel; cut
    off instead, it vanishes for waves across stretched cells. GMRES iterations to 1e-2, cut off
    and tapered, 129 points: 4 and 4 at M 20, L 10; 7 and 7 at M 1000, L 10; 17 and 7 in a wide
    ellipse (cells 1 : 4.3); more than 60 and 11 with an entrainment at 72 degrees to its axis.
    Twice the reach along x saves one or two of them and takes 1.3 times as long to factor.

    Parameters
    ----------
    lin : Linearisation
        linearised equations

    Returns
    -------
    sparse.csr_matrix
        sparse matrix of the nodes j nx + i, shape (ny nx, ny nx) [-]
    """
    nodes = _nodes(lin.grid, inside=True)
    poiseuille, by_eps = _poiseuille_matrices(lin, nodes)
    wedge = _wedge_matrix(lin, nodes)
    edge = lin.edge.ravel()
    by_pressure = (
        poiseuille
        + by_eps @ scipy.sparse.diags(lin.eps_by_pressure.ravel())
        - wedge @ scipy.sparse.diags(lin.content_by_pressure.ravel())
        + scipy.sparse.diags(edge.astype(np.float64))
    )
    by_film = by_eps @ scipy.sparse.diags(lin.eps_by_film.ravel())
    by_film = by_film - wedge - scipy.sparse.diags(lin.edge_by_film.ravel())
    return (by_pressure + by_film @ _near_kernel(lin)).tocsr()


@dataclass(frozen=True, slots=True)
class _Nodes:
    """Nodes of a grid that have a row of their own in a sparse matrix."""

    grid: Grid
    j: Integers
    i: Integers

    def beside(
        self, across: Integers | int, along: Integers | int
    ) -> tuple[Integers, Integers, NDArray[np.bool_]]:
        """Line and column of the neighbours so many steps away, and whether they are nodes; below
        a line of symmetry stand mirror images.
        """
        j = self.j + across
        i = self.i + along
        if self.grid.symmetric:
            j = np.abs(j)
        known = (j >= 0) & (j < self.grid.ny) & (i >= 0) & (i < self.grid.nx)
        return np.where(known, j, 0), np.where(known, i, 0), known

    def matrix(self, entries: list[Entry]) -> "scipy.sparse.csr_matrix":
        """Matrix over all nodes, numbered j nx + i, of stencil entries."""
        nx = self.grid.nx
        rows, columns, values = [], [], []
        for across, along, value in entries:
            j, i, known = self.beside(across, along)
            rows.append((self.j * nx + self.i)[known])
            columns.append((j * nx + i)[known])
            values.append(value[known])
        positions = (np.concatenate(rows), np.concatenate(columns))
        size = self.grid.ny * nx
        return scipy.sparse.csr_matrix((np.concatenate(values), positions), (size, size))


def _nodes(grid: Grid, *, inside: bool) -> _Nodes:
    """Select the nodes inside the box, or all."""
    return _Nodes(grid, *np.nonzero(~edge_nodes(grid) | (not inside)))


def _poiseuille_matrices(
    lin: Linearisation, nodes: _Nodes
) -> "tuple[scipy.sparse.csr_matrix, scipy.sparse.csr_matrix]":
    """Derivatives of d_X(eps d_X P) + d_Y(eps d_Y P) by P and by eps."""
    along, across = 0.5 / lin.grid.hx**2, 0.5 / lin.grid.hy**2
    here = (nodes.j, nodes.i)
    fills = _filling(lin, nodes)
    centre = np.zeros((2, len(nodes.j)))
    by_pressure: list[Entry] = []
    by_eps: list[Entry] = []
    for step in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        weight = along if step[1] else across
        j, i, _ = nodes.beside(*step)
        flow = weight * (lin.eps[here] + lin.eps[j, i])
        slope = weight * (lin.P[j, i] - lin.P[here])
        if step == (0, -1):  # what flows back over a meniscus comes again with the flux
            flow, slope = np.where(fills, 0.0, flow), np.where(fills, 0.0, slope)
        by_pressure.append((*step, flow))
        by_eps.append((*step, slope))
        centre += -flow, slope
    by_pressure.append((0, 0, centre[0]))
    by_eps.append((0, 0, centre[1]))
    return nodes.matrix(by_pressure), nodes.matrix(by_eps)


def _wedge_matrix(lin: Linearisation, nodes: _Nodes) -> "scipy.sparse.csr_matrix":
    """Derivative of d_X(flow_x H) + d_Y(flow_y H) by H: (3, -4, 1)/2 upstream, central where that
    leaves the grid. Behind an empty node what enters does not depend on H.
    """
    flow_x, flow_y = lin.couette
    entries = _upstream(nodes, flow_x, (0, 1), lin.grid.hx, _filling(lin, nodes))
    if flow_y is not None:
        full = np.zeros(len(nodes.j), dtype=np.bool_)
        entries += _upstream(nodes, flow_y, (1, 0), lin.grid.hy, full)
    return nodes.matrix(entries)


def _filling(lin: Linearisation, nodes: _Nodes) -> NDArray[np.bool_]:
    """Nodes behind an empty one."""
    if lin.starved is None:
        return np.zeros(len(nodes.j), dtype=np.bool_)
    return np.asarray(lin.starved.empty[nodes.j, np.maximum(nodes.i - 1, 0)])


def _upstream(
    nodes: _Nodes, flow: Array, step: tuple[int, int], mesh: float, filling: NDArray[np.bool_]
) -> list[Entry]:
    up = np.where(flow[nodes.j, nodes.i] >= 0.0, -1, 1)
    room = nodes.beside(2 * up * step[0], 2 * up * step[1])[2]
    entries: list[Entry] = []
    for distance, weight, behind in ((0, 1.5, 1.5), (1, -2.0, -0.5), (2, 0.5, 0.0)):
        place = (distance * up * step[0], distance * up * step[1])
        j, i, _ = nodes.beside(*place)
        weights = np.where(filling, behind, weight)
        entries.append((*place, np.where(room, -up * weights / mesh * flow[j, i], 0.0)))
    for side in (-1, 1):
        j, i, _ = nodes.beside(side * step[0], side * step[1])
        central = np.where(room, 0.0, side * 0.5 / mesh * flow[j, i])
        entries.append((side * step[0], side * step[1], central))
    return entries


def _near_kernel(lin: Linearisation) -> "scipy.sparse.csr_matrix":
    """Tapered deflection of a node and its eight neighbours."""
    nodes = _nodes(lin.grid, inside=False)
    ones = np.ones(len(nodes.j))
    return nodes.matrix(
        [
            (j, i, TAPER[abs(j)] * TAPER[abs(i)] * lin.near[abs(j), abs(i)] * ones)
            for j in (-1, 0, 1)
            for i in (-1, 0, 1)
        ]
    )

"""Conservation of mass where the oil does not fill the gap, its derivative, and the lines of a
grid: threads that share them, transfers between a grid and the one of doubled mesh size.

With q = rho u H, the flow of the full gap, every node passes on F through its outgoing face, at
i + 1/2 for u > 0:

    full        F_i = G_i = (3 q_i - q_{i-1})/2
    not full    F_i = F_{i-1} + h_x (Pois_i - f_i),   P_i = 0,   F_i <= G_i
    balance     Pois_i - (F_i - F_{i-1})/h_x = f_i                  at every node
    inlet       F_0 = min(u H_oil(Y), (q_0 + q_1)/2)

P >= 0, F <= G, P (G - F) = 0: the complementarity of Jakobsson, Floberg and Olsson with Elrod's
(1981) filled share theta = F/G, which belongs to the face and is never stored. Where the gap is
full F_i - F_{i-1} is the difference (3, -4, 1)/2 of `_reynolds_kernels`; where a node fills or
ruptures both branches have the same F, so that the flux is a continuous function of the pressure.
Along a line all F follow from P, H and f in one pass downstream. With flow across the lines a node
that is not full has two outgoing faces: its oil leaves in the ratio of the velocities, that of a
nearly full one in the ratio of the full gaps.

The march along the lines, differentiated at a solution with its empty nodes, with C' the change of
the oil that a node holds in a movement as exp(i omega T), and f' a source:

    full        F_i' = (3 q_i' - q_{i-1}')/2,       q' = u C',  C' = (rho H)'
    not full    F_i' = F_{i-1}' + h_x (Pois_i' - f_i' - i omega C_i'),   P_i' = 0,  C_i' = F_i'/u,
                at a meniscus less half of (rho H)_i'
    row         Pois_i' - (F_i' - F_{i-1}')/h_x - f_i' - i omega C_i'    at full nodes
    inlet       F_0' = 0 behind the layer; (q_0' + q_1')/2 where the gap is the narrower

Oil that does not fill the gap rides with the surfaces at their mean speed. A meniscus that moves
by s needs no term of its own: at a distance d before the first full node, i + 1, the last empty
one holds what it gains and what fills up to that node, h_x F_i'/u = (rho H - F/u) s + d (rho H)'.
What lies behind i + 1/2 belongs to node i + 1 and is taken off; kept, it makes damping converge
with the mesh, not with its square.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid, inject
from ..oil.lubricant import InletLayer
from . import _starved_kernels
from .threads import Threads

Numbers = NDArray[Any]  # real or complex


@dataclass(slots=True, kw_only=True)
class FilmContent:
    """Oil that the nodes of one grid pass on; arrays of shape (ny, nx) unless said, all [-]."""

    inlet_film_thickness: Array  # (ny,) H_oil
    along: Array  # F through the outgoing faces along the lines
    across: Array  # and across them; empty if nothing flows there
    fraction_along: Array  # of what leaves a node that is not full along its line; empty likewise
    residual: Array  # f - L(P) as of full nodes
    empty: NDArray[np.int8]  # one where the gap is not full


@dataclass(frozen=True, slots=True, kw_only=True)
class Fields:
    """Fields that the flux of a grid follows from, arrays of shape (ny, nx) [-]."""

    P: Array  # pressure
    H: Array  # film
    eps: Array  # flow coefficient
    flow_x: Array  # rho u
    flow_y: Array  # rho v; empty if nothing flows across the lines
    f: Array  # right side of Reynolds' equation


def make_film_content(inlet_film_thickness: InletLayer, grid: Grid, lateral: bool) -> FilmContent:
    """Allocate the oil content of a grid behind an inlet film.

    Parameters
    ----------
    inlet_film_thickness : InletLayer
        thickness of the inlet film over y
    grid : Grid
        grid of the level
    lateral : bool
        whether oil flows across the lines

    Returns
    -------
    FilmContent
        content of an empty grid [-]
    """
    shape = (grid.ny, grid.nx)
    crossing = shape if lateral else (0, 0)
    return FilmContent(
        inlet_film_thickness=inlet_film_thickness.at(grid.Y),
        along=np.zeros(shape),
        across=np.zeros(crossing),
        fraction_along=np.zeros(crossing),
        residual=np.zeros(shape),
        empty=np.zeros(shape, dtype=np.int8),
    )


def march_film_content(
    film_content: FilmContent, fields: Fields, grid: Grid, threads: Threads, first: int
) -> None:
    """March flux, residual and empty nodes downstream on every second line.

    All lines are marched where the oil flows across them.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid, changed in place [-]
    fields : Fields
        fields that the flux follows from [-]
    grid : Grid
        grid of the level
    threads : Threads
        threads that share the lines
    first : int
        first of the lines [-]
    """
    common = (fields.P, fields.H, fields.eps)
    mesh = (film_content.inlet_film_thickness, grid.hx, grid.hy)
    if film_content.across.size:
        _starved_kernels.march_columns(
            *common,
            fields.flow_x,
            fields.flow_y,
            fields.f,
            *mesh,
            film_content.along,
            film_content.across,
            film_content.fraction_along,
            film_content.residual,
            film_content.empty,
        )
        return
    lines = partial(
        _starved_kernels.march_lines,
        *common,
        fields.flow_x,
        fields.f,
        *mesh,
        film_content.along,
        film_content.residual,
        film_content.empty,
    )
    threads.run(lines, range(first, grid.ny - 1, 2), fields.P.size)


def march_all_film_content(
    film_content: FilmContent, fields: Fields, grid: Grid, threads: Threads
) -> None:
    """March flux, residual and empty nodes downstream on all lines.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid, changed in place [-]
    fields : Fields
        fields that the flux follows from [-]
    grid : Grid
        grid of the level
    threads : Threads
        threads that share the lines
    """
    first = 0 if grid.symmetric else 1
    march_film_content(film_content, fields, grid, threads, first)
    if not film_content.across.size:
        march_film_content(film_content, fields, grid, threads, first + 1)


def restrict_flux(fine: FilmContent, coarse: FilmContent, fields: Fields, grid: Grid) -> None:
    """Restrict the flux to the coarser grid.

    It is injected; where there is pressure it is that of a full gap, elsewhere at most that.

    Parameters
    ----------
    fine : FilmContent
        oil content of the finer grid [-]
    coarse : FilmContent
        oil content of the coarser grid, changed in place [-]
    fields : Fields
        fields of the coarser grid [-]
    grid : Grid
        coarser grid
    """
    coarse.along = inject(fine.along)
    lateral = bool(fine.across.size)
    if lateral:
        coarse.across = inject(fine.across)
    _starved_kernels.set_flux(
        fields.P,
        fields.H,
        fields.flow_x,
        fields.flow_y,
        lateral,
        grid.hx,
        grid.hy,
        coarse.inlet_film_thickness,
        coarse.along,
        coarse.across,
    )


def flux_operator(film_content: FilmContent, fields: Fields, grid: Grid, out: Array) -> Array:
    """Evaluate L(P) by the flux of a grid.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid [-]
    fields : Fields
        fields of the grid [-]
    grid : Grid
        grid of the level
    out : Array
        array to write to, shape (ny, nx) [-]

    Returns
    -------
    Array
        L(P), shape (ny, nx): `out` [-]
    """
    _starved_kernels.flux_operator(
        fields.P,
        fields.eps,
        fields.flow_y,
        bool(film_content.across.size),
        grid.hx,
        grid.hy,
        grid.symmetric,
        film_content.along,
        film_content.across,
        out,
    )
    return out


def inlet_flow(film_content: FilmContent, grid: Grid) -> float:
    """Sum the oil that enters the box with the inlet film per unit of time.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid [-]
    grid : Grid
        grid of the level

    Returns
    -------
    float
        flow [-]
    """
    weights = np.ones(grid.ny)
    weights[-1] = 0.0
    weights[0] = 0.5 if grid.symmetric else 0.0
    inflow = float(weights @ film_content.along[:, 0]) * grid.hy
    if film_content.across.size:
        edges = np.where(film_content.across[0] > 0.0, film_content.across[0], 0.0)
        edges = edges + np.where(film_content.across[-1] > 0.0, film_content.across[-1], 0.0)
        inflow += float(edges.sum()) * grid.hx
    return (2.0 if grid.symmetric else 1.0) * inflow


def oil_imbalance(film_content: FilmContent, residual: Array, grid: Grid) -> float:
    """Sum the oil that the nodes of a grid gain or lose, over that which enters the box.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid [-]
    residual : Array
        residual of the balance, shape (ny, nx) [-]
    grid : Grid
        grid of the level

    Returns
    -------
    float
        relative imbalance, signed [-]
    """
    entering = inlet_flow(film_content, grid)
    lost = grid.integral(residual)
    return lost / entering if entering > 0.0 else np.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvedFlux:
    """Derivative of the flux where oil does not fill the gap, arrays of shape (ny, nx) unless
    said; all [-].
    """

    empty: NDArray[np.bool_]  # True where the gap is not full
    gap_enters: NDArray[np.bool_]  # (ny,) lines that the gap at the inlet lets in less than layer
    speed: Array  # u


@dataclass(frozen=True, slots=True, kw_only=True)
class FluxChange:
    """Change of the flux of a grid, arrays of shape (ny, nx) [-]."""

    rows: Numbers  # of the equations of full nodes, zero elsewhere
    content: Numbers  # C'


def starved_flux(film_content: FilmContent, flow: Array, H: Array, density: Array) -> StarvedFlux:
    """Differentiate the flux of a level after its march.

    Parameters
    ----------
    film_content : FilmContent
        oil content of the grid [-]
    flow : Array
        rho u, shape (ny, nx) [-]
    H : Array
        film, shape (ny, nx) [-]
    density : Array
        density over that at ambient pressure, shape (ny, nx) [-]

    Returns
    -------
    StarvedFlux
        derivative of the flux [-]
    """
    content = flow * H
    entering = 0.5 * (content[:, 0] + content[:, 1])
    return StarvedFlux(
        empty=film_content.empty > 0,
        gap_enters=entering < flow[:, 0] * film_content.inlet_film_thickness,
        speed=flow / density,
    )


def flux_change(
    flux: StarvedFlux, grid: Grid, gained: Numbers, content: Numbers, turn: complex = 0.0
) -> FluxChange:
    """Evaluate the change of equations and oil by those of the Poiseuille term and of rho H.

    Parameters
    ----------
    flux : StarvedFlux
        derivative of the flux
    grid : Grid
        grid of the level
    gained : Numbers
        change of the Poiseuille term less f, shape (ny, nx) [-]
    content : Numbers
        change of rho H, shape (ny, nx) [-]
    turn : complex, default 0.0
        i omega [-]

    Returns
    -------
    FluxChange
        change of the equations and of the oil [-]
    """
    kind = np.result_type(gained, content, type(turn))
    transport = (flux.speed * content).astype(kind)
    along, held, rows = np.zeros((3, *transport.shape), dtype=kind)
    along[:, 0] = np.where(flux.gap_enters, 0.5 * (transport[:, 0] + transport[:, 1]), 0.0)
    _starved_kernels.march_change(
        gained.astype(kind),
        transport,
        flux.speed,
        flux.empty,
        kind.type(turn),
        grid.hx,
        0 if grid.symmetric else 1,
        along,
        held,
        rows,
    )
    return FluxChange(rows=rows, content=held)

"""Derivative of the flux behind a layer of oil, at a solution with its empty nodes.

The march of `starved` along the lines, differentiated, with C' the change of the oil that a node
holds in a movement as exp(i omega T), and f' a source:

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
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid
from .kernels import _starved_kernels
from .starved import FilmContent

Numbers = NDArray[Any]  # real or complex


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

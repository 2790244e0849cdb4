"""Reynolds' equation in NumPy: the readable twin of the compiled kernels, and what tests hold them against.

Arrays have the shape (ny, nx), lines along x contiguous; on a symmetric grid row 0 is y = 0 and its southern neighbour
is the mirror image of row 1.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .scaling import ScaledContact

Array = NDArray[np.float64]


def flow_properties(P: Array, H: Array, contact: ScaledContact) -> tuple[Array, Array, Array]:
    """Flow coefficient eps = rho H^3/(eta lambda), density rho and d(rho)/dP, all [-].

    Parameters
    ----------
    P, H : ndarray, shape (ny, nx)
        Pressure and film [-]; a negative film carries no flow.
    contact : ScaledContact
    """
    c = contact
    pressure = np.maximum(P, 0.0)
    viscosity = np.exp(c.viscosity_slope * ((1.0 + c.viscosity_pressure * pressure) ** c.viscosity_exponent - 1.0))
    rho = 1.0 + c.density_numerator * pressure / (1.0 + c.density_denominator * pressure)
    rho_slope = c.density_numerator / (1.0 + c.density_denominator * pressure) ** 2
    return rho * np.maximum(H, 0.0) ** 3 / (viscosity * c.speed), rho, rho_slope


def poiseuille(P: Array, eps: Array, hx: float, hy: float, symmetric: bool) -> Array:
    """d_X(eps d_X P) + d_Y(eps d_Y P) at interior nodes, conservative five-point stencil, O(hx^2 + hy^2) [-].

    Parameters
    ----------
    P, eps : ndarray, shape (ny, nx)
    hx, hy : float
        Mesh sizes [-].
    symmetric : bool
        Whether row 0 is a line of symmetry rather than an edge.
    """
    P, eps = with_mirror(P, symmetric), with_mirror(eps, symmetric)
    east = 0.5 * (eps[1:-1, 1:] + eps[1:-1, :-1]) * np.diff(P[1:-1], axis=1) / hx
    north = 0.5 * (eps[1:, 1:-1] + eps[:-1, 1:-1]) * np.diff(P[:, 1:-1], axis=0) / hy
    return np.diff(east, axis=1) / hx + np.diff(north, axis=0) / hy


def wedge(rho: Array, H: Array, hx: float, symmetric: bool) -> Array:
    """d_X(rho H) at interior nodes: second order upstream, (3, -4, 1)/2; central in the first column [-]."""
    flow = with_mirror(rho * H, symmetric)[1:-1]
    upstream = 1.5 * flow[:, 2:-1] - 2.0 * flow[:, 1:-2] + 0.5 * flow[:, :-3]
    first = 0.5 * (flow[:, 2:3] - flow[:, 0:1])
    return np.concatenate((first, upstream), axis=1) / hx


def reynolds_operator(P: Array, H: Array, eps: Array, rho: Array, mesh: tuple[float, float], symmetric: bool) -> Array:
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(rho H), shape (ny, nx), zero on the edge; `mesh` is (hx, hy) [-]."""
    out = np.zeros_like(P)
    rows = slice(0, -1) if symmetric else slice(1, -1)
    out[rows, 1:-1] = poiseuille(P, eps, mesh[0], mesh[1], symmetric) - wedge(rho, H, mesh[0], symmetric)
    return out


def with_mirror(values: Array, symmetric: bool) -> Array:
    """Add the mirror image of row 1 below row 0 of a symmetric grid [same unit]."""
    return np.concatenate((values[1:2], values)) if symmetric else values

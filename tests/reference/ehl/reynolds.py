"""Reynolds' equation in NumPy, the reference for the compiled kernels of `oilfilm.ehl.multigrid`.

Arrays have the shape (ny, nx), lines along x contiguous; on a symmetric grid row 0 is y = 0 and
its southern neighbour is the mirror image of row 1.
"""

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.scaling import ScaledContact

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
    """d_X(eps d_X P) + d_Y(eps d_Y P) at interior nodes, conservative five-point stencil, O(hx^2 +
    hy^2) [-].

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


def wedge(flow: Array, H: Array, hx: float, symmetric: bool) -> Array:
    """d_X(flow H) at interior nodes: second order upstream, (3, -4, 1)/2; central where that
    leaves the grid [-].

    Parameters
    ----------
    flow : ndarray, shape (ny, nx)
        Density times velocity along X [-]; upstream is where it comes from.
    H : ndarray, shape (ny, nx)
    hx : float
    symmetric : bool
    """
    q = with_mirror(flow * H, symmetric)[1:-1]
    slope = 0.5 * (q[:, 2:] - q[:, :-2])
    upstream, downstream = slope.copy(), slope.copy()
    upstream[:, 1:] = 1.5 * q[:, 2:-1] - 2.0 * q[:, 1:-2] + 0.5 * q[:, :-3]
    downstream[:, :-1] = -1.5 * q[:, 1:-2] + 2.0 * q[:, 2:-1] - 0.5 * q[:, 3:]
    return np.where(with_mirror(flow, symmetric)[1:-1, 1:-1] >= 0.0, upstream, downstream) / hx


def lateral_wedge(flow: Array, H: Array, hy: float) -> Array:
    """d_Y(flow H) at interior nodes of a full grid, flow along Y: as `wedge` [-]."""
    return wedge(flow.T, H.T, hy, False).T


def reynolds_operator(
    P: Array, H: Array, eps: Array, flow: tuple[Array, Array | None], mesh: tuple[float, float], symmetric: bool
) -> Array:
    """d_X(eps d_X P) + d_Y(eps d_Y P) - d_X(flow_x H) - d_Y(flow_y H), shape (ny, nx), zero on the
    edge [-].

    Parameters
    ----------
    P, H, eps : ndarray, shape (ny, nx)
    flow : tuple of ndarray
        Density times velocity along X and along Y; None for the latter: nowhere any.
    mesh : tuple of float
        hx, hy.
    symmetric : bool
    """
    out = np.zeros_like(P)
    rows = slice(0, -1) if symmetric else slice(1, -1)
    out[rows, 1:-1] = poiseuille(P, eps, mesh[0], mesh[1], symmetric) - wedge(flow[0], H, mesh[0], symmetric)
    if flow[1] is not None:
        out[rows, 1:-1] -= lateral_wedge(flow[1], H, mesh[1])
    return out


def with_mirror(values: Array, symmetric: bool) -> Array:
    """Add the mirror image of row 1 below row 0 of a symmetric grid [same unit]."""
    return np.concatenate((values[1:2], values)) if symmetric else values

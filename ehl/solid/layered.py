r"""Compliance of a contact one body of which is coated: that of a half space of the coating, 1/r,
and a smooth correction from axisymmetric finite elements.

The displacement under a point load is that of a half space of the coating, Boussinesq's (1885)
u_B, and a smooth rest w

.. math:: \int C(z) \varepsilon(w) : \varepsilon(v)\, r\,dr\,dz
          = -\int_{z > t} (C_s - C_c)\, \varepsilon(u_B) : \varepsilon(v)\, r\,dr\,dz

that has no singularity, since the source lies in the substrate only. Far away w is the difference
of Boussinesq's solutions for substrate and coating, which is set on the outer edge.
"""

from collections.abc import Callable
from functools import lru_cache
from math import ceil
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray
from skfem import (
    Basis,
    BilinearForm,
    ElementQuad2,
    ElementVector,
    LinearForm,
    MeshQuad,
    asm,
    condense,
    solve,
)
from skfem.helpers import ddot, grad, sym_grad

from ..arrays import Array
from ..scaling import ScaledCoating

REACH = 150.0  # outer edge in thicknesses
FINEST = 0.08  # cell at the load in thicknesses
GROWTH = 1.14  # and the growth of cells away from it
LAYER_CELLS = 10  # across the coating

# cells around the load in which the correction of a thin coating is averaged over the cell
NEIGHBOURS = 6
MAX_POINTS = 12  # of such a cell in each direction


def correction(ratio: float, poisson: tuple[float, float]) -> tuple[Array, Array]:
    """Correction c(r/t) of the surface displacement (1 - nu_c^2)/(pi E_c) [1/r + c(r/t)/t].

    Parameters
    ----------
    ratio : float
        Young's modulus of the substrate over that of the coating [-]
    poisson : tuple[float, float]
        Poisson's ratios of coating and substrate [-]

    Returns
    -------
    distance
        r/t, shape (n,) [-]
    correction
        c, shape (n,) [-]
    """
    mesh = _mesh()
    basis = Basis(mesh, ElementVector(ElementQuad2()), intorder=5)
    below = np.nonzero(mesh.p[1][mesh.t].mean(axis=0) > 1.0)[0]
    matrix = asm(_stiffness, basis, young=_by_cell(mesh, 1.0, ratio), nu=_by_cell(mesh, *poisson))
    substrate = Basis(mesh, ElementVector(ElementQuad2()), intorder=5, elements=below)
    nodes = np.where(basis.doflocs[1] >= 1.0 - 1e-9, _boussinesq(basis, 1.0, poisson[0]), 0.0)
    field = substrate.interpolate(nodes)
    load = -asm(_source, substrate, field=field, ratio=ratio, nu_c=poisson[0], nu_s=poisson[1])
    edge = basis.get_dofs(lambda x: np.maximum(x[0], x[1]) > REACH * (1 - 1e-9)).all()
    axis = basis.get_dofs(lambda x: x[0] < 1e-12).all("u^1")
    far = _boussinesq(basis, ratio, poisson[1]) - _boussinesq(basis, 1.0, poisson[0])
    prescribed = np.where(np.isin(np.arange(basis.N), edge), far, 0.0)
    prescribed[axis] = 0.0
    w = solve(*condense(matrix, load, x=prescribed, D=np.union1d(edge, axis)))
    surface = basis.get_dofs(lambda x: x[1] < 1e-12).all("u^2")
    surface = surface[np.argsort(basis.doflocs[0][surface])]
    return basis.doflocs[0][surface], w[surface] * np.pi / (1.0 - poisson[0] ** 2)


def layered_mesh() -> tuple[Array, NDArray[np.int64], NDArray[np.bool_]]:
    """Nodes (r, z) in thicknesses, shape (n, 2), corners of the cells, shape (m, 4), and whether a
    cell lies in the coating [-].
    """
    mesh = _mesh()
    return mesh.p.T, mesh.t.T.astype(np.int64), _by_cell(mesh, 1.0, 0.0)[:, 0] > 0.5


def _mesh() -> MeshQuad:
    r = _graded(0.0, FINEST, REACH)
    coating = np.linspace(0.0, 1.0, LAYER_CELLS + 1)
    substrate = _graded(1.0, 1.0 / LAYER_CELLS, REACH)
    return MeshQuad.init_tensor(r, np.concatenate((coating, substrate[1:])))


def _graded(start: float, first: float, end: float) -> Array:
    """Lines from `start` to `end` with cells growing from `first`."""
    count = int(np.ceil(np.log1p((end - start) * (GROWTH - 1.0) / first) / np.log(GROWTH)))
    lines = np.concatenate(([0.0], np.cumsum(first * GROWTH ** np.arange(count))))
    return start + lines * (end - start) / lines[-1]


def _by_cell(mesh: MeshQuad, coating: float, substrate: float) -> Array:
    """A property of each cell, shape (cells, 1)."""
    return np.where(mesh.p[1][mesh.t].mean(axis=0) > 1.0, substrate, coating)[:, None]


def _contraction(u: Any, v: Any, r: Any, young: Any, nu: Any) -> Any:
    """C eps(u) : eps(v) with the hoop strain u_r/r, isotropic."""
    mu = young / (2.0 * (1.0 + nu))
    lame = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    hoop_u, hoop_v = u[0] / r, v[0] / r
    trace_u = grad(u)[0, 0] + grad(u)[1, 1] + hoop_u
    trace_v = grad(v)[0, 0] + grad(v)[1, 1] + hoop_v
    return 2.0 * mu * (ddot(sym_grad(u), sym_grad(v)) + hoop_u * hoop_v) + lame * trace_u * trace_v


@BilinearForm
def _stiffness(u, v, w):  # type: ignore[no-untyped-def]
    return _contraction(u, v, w.x[0], w.young, w.nu) * w.x[0]


@LinearForm
def _source(v, w):  # type: ignore[no-untyped-def]
    r = w.x[0]
    substrate = _contraction(w["field"], v, r, w.ratio, w.nu_s)
    return (substrate - _contraction(w["field"], v, r, 1.0, w.nu_c)) * r


def _boussinesq(basis: Basis, young: float, nu: float) -> Array:
    """Displacement of the nodes under a unit load on a half space, Boussinesq (1885)."""
    r, z = basis.doflocs
    distance = np.maximum(np.hypot(r, z), 1e-12)
    scale = (1.0 + nu) / (2.0 * np.pi * young)
    radial = scale * (r * z / distance**3 - (1.0 - 2.0 * nu) * r / (distance * (distance + z)))
    axial = scale * (z**2 / distance**3 + 2.0 * (1.0 - nu) / distance)
    is_axial = np.isin(np.arange(basis.N), basis.get_dofs(elements=True).all("u^2"))
    return np.where(is_axial, axial, radial)


def point_compliance(coating: ScaledCoating, r: Array) -> Array:
    """Correction f c(r/t)/t of a coating to the compliance 1/r of a unit point load.

    Parameters
    ----------
    coating : ScaledCoating
        of one body
    r : Array
        distance, any shape [-]

    Returns
    -------
    Array
        correction, shape of `r` [-]
    """
    spline, reach, far = _table(coating.ratio, coating.poisson)
    s = np.asarray(r, dtype=np.float64) / coating.thickness
    c = np.where(s < reach, spline(np.arcsinh(np.minimum(s, reach))), far / np.maximum(s, reach))
    return np.asarray(coating.fraction / coating.thickness * c)


@lru_cache(maxsize=16)
def _table(
    ratio: float, poisson: tuple[float, float]
) -> tuple[Callable[[Array], Array], float, float]:
    """c over asinh(r/t), the distance up to which it holds, and c r/t beyond."""
    r, c = correction(ratio, poisson)
    inside = r < 0.3 * r[-1]
    far = (1.0 - poisson[1] ** 2) / (1.0 - poisson[0] ** 2) / ratio - 1.0
    spline = scipy.interpolate.CubicSpline(np.arcsinh(r[inside]), c[inside])
    return spline, float(r[inside][-1]), far


def patch_compliance(coating: ScaledCoating, x: Array, y: Array, hx: float, hy: float) -> Array:
    """Integral of the correction over patches around (x, y).

    Midpoint rule, in the cells around the load with as many points as a thin coating needs.

    Parameters
    ----------
    coating : ScaledCoating
        of one body
    x : Array
        middles along x, shape (nx,) [-]
    y : Array
        middles along y, shape (ny,) [-]
    hx : float
        side of the patches along x [-]
    hy : float
        side of the patches along y [-]

    Returns
    -------
    Array
        shape (ny, nx) [-]
    """
    result = hx * hy * point_compliance(coating, np.hypot(x[None, :], y[:, None]))
    points = min(ceil(4.0 * max(hx, hy) / coating.thickness), MAX_POINTS)
    if points > 1:
        near_x, near_y = x[:NEIGHBOURS], y[:NEIGHBOURS]
        offsets = (np.arange(points) + 0.5) / points - 0.5
        u = near_x[None, :, None, None] + hx * offsets[:, None]
        v = near_y[:, None, None, None] + hy * offsets[None, :]
        mean = point_compliance(coating, np.hypot(u, v)).mean(axis=(2, 3))
        result[:NEIGHBOURS, :NEIGHBOURS] = hx * hy * mean
    return result

r"""Reynolds' equation in weak form on bilinear quadrilaterals, stabilised along the stream.

.. math:: R(\varphi) = \int -\varepsilon \nabla P \cdot \nabla\varphi + \rho H\,\varphi_X
          - \delta\,[(\rho H)_X - \nabla\varepsilon \cdot \nabla P]\,\varphi_X

for every hat function, the strong form tested with phi + delta phi_X (Brooks and Hughes, 1982).
Under pressure epsilon vanishes and leaves (rho H)_X = 0, whose Galerkin form does not see a
saw-tooth in X; delta, half a cell there and nothing where epsilon is large, makes it see one, and
its bracket vanishes with the residual, so that the order stays.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from skfem import Basis, BilinearForm, ElementQuad1, LinearForm, MeshQuad

from ..arrays import Array
from ..oil.lubricant import roelands_rise
from ..scaling import ScaledContact

QUADRATURE = 4  # polynomial order that is integrated exactly
SMALL_PECLET = 1e-3  # cell Peclet number below which its series is used


@dataclass(frozen=True, slots=True)
class FilmSpace:
    """Bilinear functions on a rectangle mesh; nodes numbered i ny + j."""

    basis: Basis
    order: NDArray[np.int_]  # library's number of each node
    length_x: Array  # of each cell, shape (cells, 1) [-]


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Values at the quadrature points, (cells, points), gradients (2, cells, points) [-]."""

    P_grad: Array
    H: Array
    H_grad: Array
    rho: tuple[Array, Array, Array]  # rho and its derivatives by P
    eps: Array
    eps_P: Array
    eps_H: Array
    eps_PP: Array
    eps_PH: Array
    eps_HH: Array
    delta: Array


def film_space(x: Array, y: Array) -> FilmSpace:
    """Space on the mesh with lines `x` and `y`, shapes (nx,), (ny,) [-]."""
    mesh = MeshQuad.init_tensor(x, y)
    basis = Basis(mesh, ElementQuad1(), intorder=QUADRATURE)
    i, j = (np.searchsorted(line, basis.doflocs[k] - 1e-12) for k, line in enumerate((x, y)))
    number = i * len(y) + j
    order = np.empty(len(number), dtype=np.int_)
    order[number] = np.arange(len(number))
    corners = mesh.p[0][mesh.t]
    return FilmSpace(basis, order, (corners.max(axis=0) - corners.min(axis=0))[:, None])


def integral_weights(space: FilmSpace) -> Array:
    """Integral of each hat function, shape (nodes,) [-]."""
    return LinearForm(lambda v, w: v).assemble(space.basis)[space.order]


def interpolate(space: FilmSpace, values: Array) -> tuple[Array, Array]:
    """Values and gradients at the quadrature points of nodal values [same unit]."""
    scattered = np.empty_like(values)
    scattered[space.order] = values
    field = space.basis.interpolate(scattered)
    return np.asarray(field), np.asarray(field.grad)


def coefficients(space: FilmSpace, contact: ScaledContact, P: Array, H: Array) -> Coefficients:
    """Density, flow coefficient, their derivatives and the stabilisation length.

    delta = hx/2 (coth Pe - 1/Pe), Pe = beta hx/(2 eps), where beta = H rho' + 2 c hx rho is the
    speed at which the wedge term moves the shortest wave: the deflection answers a wave of number
    k with 2 pi c/k (k = pi/hx). Pressure P >= 0 and film H > 0 have the shape (nodes,) [-].
    """
    (p, p_grad), (h, h_grad) = interpolate(space, P), interpolate(space, H)
    c = contact
    p = np.maximum(p, 0.0)
    z, q = c.viscosity_exponent, c.viscosity_pressure
    base = 1.0 + q * p
    slope = c.viscosity_slope * z * q * base ** (z - 1.0)  # d(ln eta)/dP
    curvature = slope * (z - 1.0) * q / base
    n, d = c.density_numerator, c.density_denominator
    rho = (1.0 + n * p / (1.0 + d * p), n / (1.0 + d * p) ** 2, -2.0 * n * d / (1.0 + d * p) ** 3)
    rise = roelands_rise(q * p, z)
    eps = rho[0] * h**3 * np.exp(-c.viscosity_slope * (rise - 1.0)) / c.speed
    a = rho[1] / rho[0] - slope  # d(ln eps)/dP
    a_P = rho[2] / rho[0] - (rho[1] / rho[0]) ** 2 - curvature
    hx = space.length_x
    peclet = (2.0 * c.deformation * hx * rho[0] + h * rho[1]) * hx / (2.0 * eps)
    large = np.maximum(peclet, SMALL_PECLET)
    upwind = np.where(peclet > SMALL_PECLET, 1.0 / np.tanh(large) - 1.0 / large, peclet / 3.0)
    return Coefficients(
        P_grad=p_grad,
        H=h,
        H_grad=h_grad,
        rho=rho,
        eps=eps,
        eps_P=a * eps,
        eps_H=3.0 * eps / h,
        eps_PP=eps * (a * a + a_P),
        eps_PH=3.0 * a * eps / h,
        eps_HH=6.0 * eps / h**2,
        delta=0.5 * hx * upwind,
    )


def reynolds_residual(space: FilmSpace, k: Coefficients) -> Array:
    """R of every hat function, shape (nodes,) [-]."""
    strong = (
        k.rho[1] * k.P_grad[0] * k.H
        + k.rho[0] * k.H_grad[0]
        - k.eps_P * _dot(k.P_grad, k.P_grad)
        - k.eps_H * _dot(k.H_grad, k.P_grad)
    )
    flux = k.rho[0] * k.H - k.delta * strong
    form = LinearForm(lambda v, w: -k.eps * _dot(k.P_grad, v.grad) + flux * v.grad[0])
    return form.assemble(space.basis)[space.order]


def pressure_derivative(space: FilmSpace, k: Coefficients) -> sparse.csr_matrix:
    """dR/dP at a fixed film and a fixed delta, shape (nodes, nodes) [-]."""
    rho_P, rho_PP = k.rho[1], k.rho[2]
    P2, HP = _dot(k.P_grad, k.P_grad), _dot(k.H_grad, k.P_grad)

    def form(u, v, w):  # type: ignore[no-untyped-def]
        strong = (
            (rho_PP * k.P_grad[0] * k.H + rho_P * k.H_grad[0] - k.eps_PP * P2 - k.eps_PH * HP) * u
            + rho_P * k.H * u.grad[0]
            - 2.0 * k.eps_P * _dot(k.P_grad, u.grad)
            - k.eps_H * _dot(k.H_grad, u.grad)
        )
        poiseuille = k.eps_P * u * _dot(k.P_grad, v.grad) + k.eps * _dot(u.grad, v.grad)
        return -poiseuille + (rho_P * k.H * u - k.delta * strong) * v.grad[0]

    return _assemble(space, form)


def film_derivative(space: FilmSpace, k: Coefficients) -> sparse.csr_matrix:
    """dR/dH at a fixed pressure and a fixed delta, shape (nodes, nodes) [-]."""
    P2, HP = _dot(k.P_grad, k.P_grad), _dot(k.H_grad, k.P_grad)

    def form(u, v, w):  # type: ignore[no-untyped-def]
        strong = (
            (k.rho[1] * k.P_grad[0] - k.eps_PH * P2 - k.eps_HH * HP) * u
            + k.rho[0] * u.grad[0]
            - k.eps_H * _dot(u.grad, k.P_grad)
        )
        couette = (k.rho[0] * u - k.delta * strong) * v.grad[0]
        return -k.eps_H * u * _dot(k.P_grad, v.grad) + couette

    return _assemble(space, form)


def _dot(a: Array, b: Array) -> Array:
    return a[0] * b[0] + a[1] * b[1]


def _assemble(space: FilmSpace, form: object) -> sparse.csr_matrix:
    matrix = BilinearForm(form).assemble(space.basis).tocsr()
    return matrix[space.order][:, space.order].tocsr()

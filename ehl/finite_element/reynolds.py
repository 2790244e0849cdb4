r"""Reynolds' equation in weak form on bilinear quadrilaterals, stabilised along the stream.

.. math:: R(\varphi) = \int F \cdot \nabla\varphi, \quad F = -\varepsilon \nabla P + \rho H\,U
          - \tau\,[U \cdot \nabla(\rho H) - \nabla\varepsilon \cdot \nabla P]\,U

for every hat function, U = (u, v) the entrainment, which turns about the normal: u = u_0 - Omega
Y, v = v_0 + Omega X. The strong form is tested with phi + tau U grad phi (Brooks and Hughes,
1982). Under pressure epsilon vanishes and leaves div(rho H U) = 0, whose Galerkin form does not
see a saw-tooth along the stream; tau |U|, half a cell there and nothing where epsilon is large,
makes it see one, and its bracket vanishes with the residual, so that the order stays.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Array
from ..scaling import ScaledContact
from .mesh import FilmSpace, interpolate, scatter
from .oil_laws import oil_laws

SMALL_PECLET = 1e-3  # cell Peclet number below which its series is used
SMALLEST_SPEED = 1e-9  # of the entrainment, over u_m, where it turns about a point [-]

Vector = tuple[Array, Array]


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Values at the quadrature points, (cells, points), vectors as pairs of them [-]."""

    P_grad: Vector
    H: Array
    H_grad: Vector
    U: Vector
    rho: tuple[Array, Array, Array]  # rho and its derivatives by P
    eps: Array
    eps_P: Array
    eps_H: Array
    eps_PP: Array
    eps_PH: Array
    eps_HH: Array
    tau: Array


@dataclass(frozen=True, slots=True)
class Linear:
    """A flux that is linear in a function f and its gradient: value f + gradient grad f [-]."""

    value: Vector
    gradient: tuple[Vector, Vector]  # rows: components of the flux


def coefficients(space: FilmSpace, contact: ScaledContact, P: Array, H: Array) -> Coefficients:
    """Density, flow coefficient, their derivatives and the stabilisation time.

    tau |U| = l/2 (coth Pe - 1/Pe), Pe = beta l/(2 eps), l = |U|/(|u|/hx + |v|/hy) the cell along
    the stream, where beta = |U| (H rho' + 2 c l rho) is the speed at which the wedge term moves
    the shortest wave: the deflection answers a wave of number k with 2 pi c/k (k = pi/l).
    Pressure P >= 0 and film H > 0 have the shape (nodes,) [-].
    """
    (p, p_grad), (h, h_grad) = interpolate(space, P), interpolate(space, H)
    rho, log_eta = oil_laws(contact)(np.maximum(p, 0.0))
    eps = rho[0] * h**3 * np.exp(-log_eta[0]) / contact.speed
    a = rho[1] / rho[0] - log_eta[1]  # d(ln eps)/dP
    a_P = rho[2] / rho[0] - (rho[1] / rho[0]) ** 2 - log_eta[2]
    x, y = space.position
    U = (contact.velocity_x - contact.rotation * y, contact.velocity_y + contact.rotation * x)
    speed = np.maximum(np.hypot(*U), SMALLEST_SPEED)
    hx, hy = space.length
    length = speed / np.maximum(np.abs(U[0]) / hx + np.abs(U[1]) / hy, SMALLEST_SPEED / hx)
    wave = speed * (2.0 * contact.deformation * length * rho[0] + h * rho[1])
    return Coefficients(
        P_grad=p_grad,
        H=h,
        H_grad=h_grad,
        U=U,
        rho=rho,
        eps=eps,
        eps_P=a * eps,
        eps_H=3.0 * eps / h,
        eps_PP=eps * (a * a + a_P),
        eps_PH=3.0 * a * eps / h,
        eps_HH=6.0 * eps / h**2,
        tau=0.5 * length / speed * _upwind(0.5 * wave * length / eps),
    )


def _upwind(peclet: Array) -> Array:
    """coth Pe - 1/Pe [-]."""
    large = np.maximum(peclet, SMALL_PECLET)
    return np.where(peclet > SMALL_PECLET, 1.0 / np.tanh(large) - 1.0 / large, peclet / 3.0)


def reynolds_residual(space: FilmSpace, k: Coefficients) -> Array:
    """R of every hat function, shape (nodes,) [-]."""
    couette = k.rho[0] * k.H - k.tau * _strong(k)
    x, y = (couette * u - k.eps * p for u, p in zip(k.U, k.P_grad, strict=True))
    return _tested(space, (x, y))


def _strong(k: Coefficients) -> Array:
    """U grad(rho H) - grad(eps) grad(P) at the quadrature points [-]."""
    return (
        k.rho[1] * k.H * _dot(k.U, k.P_grad)
        + k.rho[0] * _dot(k.U, k.H_grad)
        - k.eps_P * _dot(k.P_grad, k.P_grad)
        - k.eps_H * _dot(k.H_grad, k.P_grad)
    )


def couette_flow(space: FilmSpace, k: Coefficients) -> Array:
    """Integral of rho H U grad phi for every hat function, shape (nodes,) [-]."""
    return _tested(space, (k.rho[0] * k.H * k.U[0], k.rho[0] * k.H * k.U[1]))


def pressure_derivative(space: FilmSpace, k: Coefficients) -> sparse.csr_matrix:
    """dR/dP at a fixed film and a fixed tau, shape (nodes, nodes) [-]."""
    rho_P, rho_PP = k.rho[1:]
    strong = (
        rho_PP * k.H * _dot(k.U, k.P_grad)
        + rho_P * _dot(k.U, k.H_grad)
        - k.eps_PP * _dot(k.P_grad, k.P_grad)
        - k.eps_PH * _dot(k.H_grad, k.P_grad)
    )
    strong_grad = tuple(
        rho_P * k.H * u - 2.0 * k.eps_P * p - k.eps_H * h
        for u, p, h in zip(k.U, k.P_grad, k.H_grad, strict=True)
    )
    couette = rho_P * k.H - k.tau * strong
    value = tuple(couette * u - k.eps_P * p for u, p in zip(k.U, k.P_grad, strict=True))
    gradient = [[-k.tau * u * s for s in strong_grad] for u in k.U]
    gradient[0][0] = gradient[0][0] - k.eps
    gradient[1][1] = gradient[1][1] - k.eps
    return _assemble(space, value, gradient)


def film_derivative(space: FilmSpace, k: Coefficients) -> sparse.csr_matrix:
    """dR/dH at a fixed pressure and a fixed tau, shape (nodes, nodes) [-]."""
    rho, rho_P = k.rho[:2]
    strong = (
        rho_P * _dot(k.U, k.P_grad)
        - k.eps_PH * _dot(k.P_grad, k.P_grad)
        - k.eps_HH * _dot(k.H_grad, k.P_grad)
    )
    strong_grad = tuple(rho * u - k.eps_H * p for u, p in zip(k.U, k.P_grad, strict=True))
    couette = rho - k.tau * strong
    value = tuple(couette * u - k.eps_H * p for u, p in zip(k.U, k.P_grad, strict=True))
    gradient = [[-k.tau * u * s for s in strong_grad] for u in k.U]
    return _assemble(space, value, gradient)


def _dot(a: Vector, b: Vector) -> Array:
    return a[0] * b[0] + a[1] * b[1]


def _tested(space: FilmSpace, flux: Vector) -> Array:
    """Integral of flux times grad phi for every hat function, shape (nodes,)."""
    hx, hy = space.length
    dx, dy = space.slope
    along = (flux[0] * space.weight) @ dx * hy
    return scatter(space, along + (flux[1] * space.weight) @ dy * hx)


def _assemble(
    space: FilmSpace, value: tuple[Array, ...], gradient: list[list[Array]]
) -> sparse.csr_matrix:
    """Matrix of the flux value f + gradient grad f, tested with grad phi: row phi, column f."""
    sides = space.length
    area = sides[0] * sides[1]
    entries = np.zeros((len(space.corners), 16))
    for test in (0, 1):
        tested = space.slope[test]
        scale = space.weight * area / sides[test]
        entries += (scale * value[test]) @ _pairs(tested, space.value)
        for trial in (0, 1):
            moment = scale / sides[trial] * gradient[test][trial]
            entries += moment @ _pairs(tested, space.slope[trial])
    row = np.repeat(space.corners, 4, axis=1).ravel()
    column = np.tile(space.corners, (1, 4)).ravel()
    size = space.shape[0] * space.shape[1]
    return sparse.csr_matrix((entries.ravel(), (row, column)), shape=(size, size))


def _pairs(tests: Array, trials: Array) -> Array:
    """Products of four tests and four trial functions, shape (points, 16)."""
    return (tests[:, :, None] * trials[:, None, :]).reshape(len(tests), 16)

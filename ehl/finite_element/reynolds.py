r"""Reynolds' equation in weak form, its Poiseuille flow by the reduced pressure.

.. math:: R(\varphi) = \int F \cdot \nabla\varphi, \quad F = -\frac{H^3}{\lambda} \nabla Q + q\,U
          - \tau\,(1 - \Pi)[U \cdot \nabla q]\,U, \quad q = \rho H, \quad
          Q = \int_0^P \frac{\rho}{\eta}\,dP

for every hat function, U = (u, v) the entrainment, which turns about the normal: u = u_0 - Omega
Y, v = v_0 + Omega X. Q, the reduced pressure of Grubin (1949) with any law of viscosity and
density, is linear along an edge: where eta rises by orders of magnitude from node to node, Q is
smooth. So is q, which makes the wedge term a constant matrix. Its Galerkin form does not see a
saw-tooth along the stream; the last term does, tau |U| half an edge and Pi the projection on the
nodes: orthogonal subscales, Codina (2000). A smooth q passes it but for the third order, so that
tau needs to follow neither pressure nor film, and Newton's matrix is exact. Integrals are exact
along the edges and by the trapezoidal rule across, so that the cavitation boundary of a line does
not enter the equations of the next. Nodes of the rectangle mesh have the numbers i ny + j.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.interpolate import make_interp_spline

from ..arrays import Array
from ..oil import _laws
from ..oil.lubricant import Lubricant, density, log_viscosity_ratio
from ..scaling import ScaledContact

# pressure over p_h up to which laws without closed form are tabulated, beyond which they stay; 200
# or 800 samples change the films by less than 1e-6
LARGEST_PRESSURE = 4.0
SAMPLES = 401
# samples of the reduced pressure, which bends within 1/alpha: a tenth of that at alpha p_h = 200
REDUCED_SAMPLES = 8001

# rho/rho_0, its derivative by P, and ln(eta/eta_0) [-]
Laws = tuple[Array, Array, Array]
OilLaws = Callable[[Array], Laws]  # of P

# share of the diffusion of first order that stands for that of the third in the preconditioner
NEAR_DIFFUSION = 0.75


@dataclass(frozen=True, slots=True)
class Edges:
    """All edges of one direction, from `tail` to `head`; matrices between edges and nodes.

    With linear functions along an edge and the trapezoidal rule across, the integral of F times
    grad phi is `balance` @ F, F the component of the flux along the edges.
    """

    tail: NDArray[np.int_]  # shape (edges,)
    head: NDArray[np.int_]
    length: Array  # shape (edges,) [-]
    balance: sparse.csr_matrix  # shape (nodes, edges): + width at the head, - width at the tail
    slope: sparse.csr_matrix  # shape (edges, nodes): differences over the length
    mean: sparse.csr_matrix  # shape (edges, nodes)
    # shape (nodes, edges): mean of the edges before and behind a node by their lengths, which is
    # the projection of their slopes with lumped mass
    projection: sparse.csr_matrix


def edges(x: Array, y: Array) -> tuple[Edges, Edges]:
    """Edges along x and along y of a rectangle mesh.

    Parameters
    ----------
    x : Array
        lines of nodes along x, shape (nx,) [-]
    y : Array
        lines of nodes along y, shape (ny,) [-]

    Returns
    -------
    along_x
        edges along x
    along_y
        edges along y
    """
    number = np.arange(len(x) * len(y)).reshape(len(x), len(y))
    return _edges(number, x, y), _edges(number.T, y, x)


def dual_lengths(lines: Array) -> Array:
    """Integral of the hat function of each line.

    Parameters
    ----------
    lines : Array
        positions of the lines, shape (lines,) [-]

    Returns
    -------
    Array
        integrals, shape (lines,) [-]
    """
    return np.convolve(np.diff(lines), (0.5, 0.5))


def _edges(number: NDArray[np.int_], along: Array, across: Array) -> Edges:
    """Edges along the first axis of the nodes' numbers."""
    shape = (len(along) - 1, len(across))
    tail = number[:-1].ravel()
    head = number[1:].ravel()
    length = np.broadcast_to(np.diff(along)[:, None], shape).ravel()
    width = np.broadcast_to(dual_lengths(across), shape).ravel()
    ends = (head, tail)
    nearby = at_ends(ends, (length, length), number.size).T
    inverse = sparse.diags(1.0 / np.asarray(nearby.sum(axis=1)).ravel())
    half = np.full(len(tail), 0.5)
    return Edges(
        tail=tail,
        head=head,
        length=length,
        balance=at_ends(ends, (width, -width), number.size).T.tocsr(),
        slope=at_ends(ends, (1.0 / length, -1.0 / length), number.size),
        mean=at_ends(ends, (half, half), number.size),
        projection=(inverse @ nearby).tocsr(),
    )


def at_ends(
    ends: tuple[NDArray[np.int_], NDArray[np.int_]], values: tuple[Array, Array], nodes: int
) -> sparse.csr_matrix:
    """Matrix with a value at each of both ends of every edge.

    Parameters
    ----------
    ends : tuple[NDArray[np.int_], NDArray[np.int_]]
        numbers of the nodes at both ends, shape (edges,) each
    values : tuple[Array, Array]
        values at both ends, shape (edges,) each [any unit]
    nodes : int
        number of nodes

    Returns
    -------
    sparse.csr_matrix
        matrix, shape (edges, nodes) [unit of `values`]
    """
    edge = np.arange(len(ends[0]))
    entries = (np.concatenate(values), (np.concatenate((edge, edge)), np.concatenate(ends)))
    return sparse.csr_matrix(entries, shape=(len(edge), nodes))


def oil_laws(contact: ScaledContact) -> OilLaws:
    """Density and viscosity as functions of the pressure P = p/p_h >= 0.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    OilLaws
        function of P; it returns rho/rho_0, its derivative by P and ln(eta/eta_0) [-]
    """
    if contact.oil is None:
        return lambda P: _closed_forms(contact, P)
    return tabulated_laws(contact.oil, contact.hertz_pressure)


def _closed_forms(contact: ScaledContact, P: Array) -> Laws:
    """1 + d1 P/(1 + d2 P), Dowson and Higginson (1966); s [(1 + q P)^z - 1], Roelands (1966),
    Barus z = 1, isoviscous s = 0.
    """
    constants = contact.density_numerator, contact.density_denominator
    rho = _laws.dowson_higginson(P, *constants)
    rho_P = _laws.dowson_higginson_slope(P, *constants)
    rise = _laws.roelands_rise(contact.viscosity_pressure * P, contact.viscosity_exponent)
    return rho, rho_P, contact.viscosity_slope * (rise - 1.0)


@lru_cache(maxsize=16)
def tabulated_laws(oil: Lubricant, hertz_pressure: float) -> OilLaws:
    """The laws of any oil, interpolated by splines of order 5 with continuous curvature.

    Parameters
    ----------
    oil : Lubricant
        the lubricant
    hertz_pressure : float
        p_h [Pa]

    Returns
    -------
    OilLaws
        function of P; it returns rho/rho_0, its derivative by P and ln(eta/eta_0) [-]
    """
    P = np.linspace(0.0, LARGEST_PRESSURE, SAMPLES)
    pressure = hertz_pressure * P
    rho = make_interp_spline(P, density(pressure, oil) / density(0.0, oil), k=5)
    rho_P = rho.derivative()
    log_eta = make_interp_spline(P, log_viscosity_ratio(pressure, oil), k=5)

    def laws(P: Array) -> Laws:
        at = np.minimum(P, LARGEST_PRESSURE)
        return rho(at), rho_P(at), log_eta(at)

    return laws


@lru_cache(maxsize=16)
def reduced_pressure(contact: ScaledContact) -> Callable[[Array], Array]:
    """Integral of rho/eta over the pressure P >= 0, both over ambient values: spline of order 5.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    Callable[[Array], Array]
        function of P, Q of P [-]
    """
    P = np.linspace(0.0, LARGEST_PRESSURE, REDUCED_SAMPLES)
    rho, _, log_eta = oil_laws(contact)(P)
    spline = make_interp_spline(P, rho * np.exp(-log_eta), k=5)
    integral = spline.antiderivative()
    last = float(spline(LARGEST_PRESSURE))

    def reduced(P: Array) -> Array:
        inside = np.minimum(P, LARGEST_PRESSURE)
        return np.asarray(integral(inside) + last * (P - inside))

    return reduced


@dataclass(frozen=True, slots=True)
class Flow:
    """Matrices of the equation that depend on mesh and entrainment alone."""

    edges: tuple[Edges, Edges]
    wedge: sparse.csr_matrix  # of q, shape (nodes, nodes)
    near_wedge: sparse.csr_matrix  # the same with neighbours only, for the preconditioner


@dataclass(frozen=True, slots=True)
class Coefficients:
    """Reduced pressure, q = rho H and their derivatives at the nodes, shape (nodes,) [-]."""

    H: Array
    Q: Array
    Q_P: Array
    q: Array
    q_P: Array
    q_H: Array
    speed: float  # lambda


def flow_on(x: Array, y: Array, contact: ScaledContact) -> Flow:
    """Edges and wedge of a rectangle mesh.

    Parameters
    ----------
    x : Array
        lines of nodes along x, shape (nx,) [-]
    y : Array
        lines of nodes along y, shape (ny,) [-]
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    Flow
        matrices that depend on mesh and entrainment alone
    """
    both = edges(x, y)
    X, Y = (values.ravel() for values in np.meshgrid(x, y, indexing="ij"))
    speeds = (
        contact.velocity_x - contact.rotation * Y[both[0].tail],
        contact.velocity_y + contact.rotation * X[both[1].tail],
    )
    wedge, near = _wedge(both[0], speeds[0])
    if contact.lateral:
        across, near_across = _wedge(both[1], speeds[1])
        wedge, near = wedge + across, near + near_across
    return Flow(edges=both, wedge=wedge.tocsr(), near_wedge=near.tocsr())


def _wedge(k: Edges, speed: Array) -> tuple[sparse.csr_matrix, sparse.csr_matrix]:
    """Wedge term along one direction and its near form, for a speed along each edge [-]."""
    galerkin = k.balance @ sparse.diags(speed) @ k.mean
    diffusion = k.balance @ sparse.diags(0.5 * np.abs(speed) * k.length)
    subscales = k.slope - k.mean @ k.projection @ k.slope
    return galerkin - diffusion @ subscales, galerkin - NEAR_DIFFUSION * diffusion @ k.slope


def coefficients(contact: ScaledContact, P: Array, H: Array) -> Coefficients:
    """Reduced pressure and q = rho H with their derivatives at the nodes.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    P : Array
        pressure, shape (nodes,) [-]; negative values count as zero
    H : Array
        film, positive, shape (nodes,) [-]

    Returns
    -------
    Coefficients
        coefficients of the equation
    """
    P = np.maximum(P, 0.0)
    rho, rho_P, log_eta = oil_laws(contact)(P)
    return Coefficients(
        H=H,
        Q=reduced_pressure(contact)(P),
        Q_P=rho * np.exp(-log_eta),
        q=rho * H,
        q_P=rho_P * H,
        q_H=rho,
        speed=contact.speed,
    )


def reynolds_residual(flow: Flow, k: Coefficients) -> Array:
    """Residual R of every hat function.

    Parameters
    ----------
    flow : Flow
        matrices of the mesh
    k : Coefficients
        coefficients at the nodes

    Returns
    -------
    Array
        R, shape (nodes,) [-]
    """
    poiseuille = sum(e.balance @ (_conductance(e, k) * (e.slope @ k.Q)) for e in flow.edges)
    return np.asarray(flow.wedge @ k.q - poiseuille)


def poiseuille_by_pressure(flow: Flow, k: Coefficients) -> sparse.csr_matrix:
    """Derivative of the Poiseuille term by the pressure.

    Parameters
    ----------
    flow : Flow
        matrices of the mesh
    k : Coefficients
        coefficients at the nodes

    Returns
    -------
    sparse.csr_matrix
        matrix, shape (nodes, nodes) [-]
    """
    term = sum(e.balance @ sparse.diags(_conductance(e, k)) @ e.slope for e in flow.edges)
    return (-term @ sparse.diags(k.Q_P)).tocsr()


def poiseuille_by_film(flow: Flow, k: Coefficients) -> sparse.csr_matrix:
    """Derivative of the Poiseuille term by the film.

    Parameters
    ----------
    flow : Flow
        matrices of the mesh
    k : Coefficients
        coefficients at the nodes

    Returns
    -------
    sparse.csr_matrix
        matrix, shape (nodes, nodes) [-]
    """
    return -sum(e.balance @ _conductance_by_film(e, k) for e in flow.edges).tocsr()


def _conductance(e: Edges, k: Coefficients) -> Array:
    """Mean of H^3/lambda along each edge, H linear [-]."""
    head, tail = k.H[e.head], k.H[e.tail]
    return (head + tail) * (head**2 + tail**2) / (4.0 * k.speed)


def _conductance_by_film(e: Edges, k: Coefficients) -> sparse.csr_matrix:
    """Its derivative by the film times the slope of Q, shape (edges, nodes) [-]."""
    head, tail = k.H[e.head], k.H[e.tail]
    slope = (e.slope @ k.Q) / (4.0 * k.speed)
    by_head = 3.0 * head**2 + 2.0 * head * tail + tail**2
    by_tail = 3.0 * tail**2 + 2.0 * head * tail + head**2
    return at_ends((e.head, e.tail), (slope * by_head, slope * by_tail), len(k.H))

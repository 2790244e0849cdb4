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
not enter the equations of the next.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Array
from ..scaling import ScaledContact
from .edges import Edges, at_ends, edges
from .oil_laws import oil_laws, reduced_pressure

# of the diffusion of the first order that stands for that of the third in the preconditioner
NEAR_DIFFUSION = 0.75


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

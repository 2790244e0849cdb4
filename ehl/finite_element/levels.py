"""Meshes of a contact, each twice as fine as the one before, and what is set up once on each."""

import numpy as np

from ..arrays import Array
from ..grid import unfolded
from ..multigrid.bordered import nested_dissection
from ..multigrid.far_field import far_field
from ..scaling import ScaledContact
from ..solid.compliance import Lattice, compliance, near_field
from .edges import dual_lengths
from .mesh import graded_lines, refined
from .newton import Level
from .reynolds import flow_on
from .start import Start

CELLS_Y = 7 / 16  # across half the contact, per cell along it
# lines of nodes along and across whose compliance enters the preconditioner; with (3, 2) the inner
# race of a 6208 takes 80 % more time on 257 points, with (3, 1) 20 %
REACH = (3, 0)
# Cells along x in Hertz half extents, up to a factor. Twice FINEST, half INSIDE or an outlet from
# 0.35 change the films of the 6208's inner race on 65 lines by less than 0.1 %
FINEST = 0.1  # over the length of the inlet
INSIDE = 1 / 16  # largest inside the contact
OUTLET = (0.0, 1.2)  # ends of the finest region, through which the exit constriction runs
# across the half contact: over the length of the inlet, largest inside, ends of the finest region.
# The minimum film of M 2000, L 0 on 257 lines is within 4 % so, 8.7 % off with even cells of 1/40
SIDE_FINEST = 0.05
SIDE_INSIDE = 1 / 20
SIDE = (0.75, 1.0)
GROWTH = 0.12  # of the cells before and inside the contact, over the distance from the finest
OUTER_GROWTH = 0.25  # of those behind and at the side of it


def lattices(
    contact: ScaledContact, domain: tuple[float, float, float], cells: int, levels: int
) -> list[Lattice]:
    """Meshes from coarsest to finest, each with half the cells of the next.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    domain : tuple[float, float, float]
        x_in, x_out, y_half in Hertz half extents [-]
    cells : int
        approximate number of cells along x on the finest mesh
    levels : int
        number of meshes

    Returns
    -------
    list[Lattice]
        the meshes, the finest last
    """
    x_in, x_out, y_half = domain
    coarsest = cells // 2 ** (levels - 1)
    inlet = inlet_length(contact)
    i = graded_lines((x_in, x_out), coarsest, lambda s: cell_along(s, inlet))
    j = graded_lines(
        (0.0, y_half), max(2, round(CELLS_Y * coarsest)), lambda s: cell_across(s, inlet)
    )
    meshes = []
    for _ in range(levels):
        x = (x_in + (x_out - x_in) * i / i[-1]) * contact.half_extent_x
        y = y_half * j / j[-1] * contact.half_extent_y
        if contact.symmetric:
            meshes.append(Lattice(x, y, i, j, symmetric=True))
        else:
            both = j[-1] + np.concatenate((-j[:0:-1], j))
            meshes.append(Lattice(x, unfolded(y, sign=-1.0), i, both, symmetric=False))
        i, j = refined(i), refined(j)
    return meshes


def inlet_length(contact: ScaledContact) -> float:
    """Length over which the gap before the Hertz contact reaches the film, (Hc/(S A^2))^(2/3).

    The gap grows with the power 3/2 of the distance.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact

    Returns
    -------
    float
        length in half extents of the Hertz ellipse [-]
    """
    height = contact.curvature_x * contact.half_extent_x**2
    return float((contact.film_guess / height) ** (2 / 3))


def cell_along(s: Array, inlet: float) -> Array:
    """Cell along x up to a factor: finest at the end of the inlet and at the outlet.

    Parameters
    ----------
    s : Array
        positions in half extents of the Hertz ellipse, any shape [-]
    inlet : float
        length of the inlet, likewise [-]

    Returns
    -------
    Array
        cell size, shape of `s` [-]
    """
    finest = min(FINEST * inlet, INSIDE)
    before = np.maximum(0.0, -1.0 - inlet - s)
    after = np.maximum(0.0, s - OUTLET[1])
    between = np.maximum(0.0, np.minimum(s + 1.0 - inlet, OUTLET[0] - s))
    inside = np.minimum(INSIDE, finest + GROWTH * between)
    return np.asarray(inside + GROWTH * before + OUTER_GROWTH * after)


def cell_across(s: Array, inlet: float) -> Array:
    """Cell across the half contact up to a factor: finest at the side, where the film is thinnest.

    Parameters
    ----------
    s : Array
        positions in half extents of the Hertz ellipse, any shape [-]
    inlet : float
        length of the inlet, likewise [-]

    Returns
    -------
    Array
        cell size, shape of `s` [-]
    """
    finest = min(SIDE_FINEST * inlet, SIDE_INSIDE / 2.0)
    inside = np.maximum(0.0, SIDE[0] - s)
    outside = np.maximum(0.0, s - SIDE[1])
    size = np.minimum(SIDE_INSIDE, finest + GROWTH * inside)
    return np.asarray(size + OUTER_GROWTH * outside)


def level_on(contact: ScaledContact, mesh: Lattice, is_open: bool, start: Start) -> Level:
    """One mesh with everything that does not change in the iteration.

    Parameters
    ----------
    contact : ScaledContact
        the dimensionless contact
    mesh : Lattice
        lines of the mesh
    is_open : bool
        the pressure on the edge of the box is that of the flow outside
    start : Start
        initial pressure and film

    Returns
    -------
    Level
        mesh, operators and initial state
    """
    X, Y = mesh.x, mesh.y
    areas = np.outer(dual_lengths(X), dual_lengths(Y)).ravel()
    x, y = (values.ravel() for values in np.meshgrid(X, Y, indexing="ij"))
    side = y == Y[-1] if contact.symmetric else (y == Y[0]) | (y == Y[-1])
    gap = contact.gap(x, y)
    operator = compliance(mesh, contact.deformation, contact.coating)
    P, H = start(x, y)
    level = Level(
        contact=contact,
        X=X,
        Y=Y,
        flow=flow_on(X, Y, contact),
        compliance=operator,
        near_compliance=near_field(mesh, REACH, contact.deformation, contact.coating),
        elimination=nested_dissection((len(X), len(Y)), (REACH[0] + 1, REACH[1] + 1)),
        gap=gap,
        areas=areas,
        weights=(2.0 if contact.symmetric else 1.0) * areas,
        edge=(x == X[0]) | (x == X[-1]) | side,
        far=far_field(contact) if is_open else None,
        P=P,
        H=H,
    )
    level.approach = float((H - gap - operator @ P)[level.origin])
    return level

r"""Stiffness and damping at all nodes of load and speed of a table, from responses at some.

Where a film turns from rolling in oil to a flat contact, both change by up to half from one node
to the next. But they do so at a load that grows with the speed: over

.. math:: x = 5\,[1 - (W/W_0)^{-1/5}], \qquad W = Q\,u^{-2/3},

W_0 the smallest one, nodes of other speeds stand between those of one, and what is left over
ln(u) is smooth. Responses are solved wherever a film turns, and else at nodes that are far apart
over both; their logarithms, of the stiffness that over Hertz', are interpolated by cubes of
distances (Duchon, 1977).
"""

from collections.abc import Sequence
from math import exp

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RBFInterpolator

from ..arrays import Array
from ..atlas.films import atlas_load
from ..scaling import scale_contact
from ..traction.linear_response import dry_stiffness
from .film import FilmSample
from .table import TableContact

# chosen on the inner race of `6208_with_heat` (76 nodes), tried on its outer one
LOAD_BY_SPEED = 2.0 / 3.0  # power of the speed with which the load of the turn grows
SHARPEST = 0.2  # power of W in x: loads where a film turns are the lightest of most tables
# scales of ln(speed) against x, for the choice of nodes and for the interpolation
CHOICE_SCALE = 0.31
SPEED_SCALE = 0.16
MAX_DISTANCE = 0.2  # distance to the nearest node that is solved, at most
MIN_RESPONSES = 6  # responses to interpolate from
# A = a^2/(Rx^2 sqrt(2 U)) between which films turn: there nodes are not far enough from each other
TRANSITION_LOADS = (1.4, 6.0)
SMALL_TABLE = 24  # nodes of a table so small that all have their own

Place = tuple[float, float]  # ln(load), ln(speed)
Mask = NDArray[np.bool_]


def response_nodes(
    contact: TableContact, places: Sequence[Place], known: Sequence[bool]
) -> list[bool]:
    """Choose the nodes of a table whose response is solved.

    Those that have one, those of films that turn and of extreme loads and speeds, then always the
    node that is farthest from these, until none is far from all; all of few.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    places : Sequence[Place]
        ln(load) and ln(speed) of the nodes
    known : Sequence[bool]
        whether a node has its response

    Returns
    -------
    list[bool]
        whether a node's response is wanted
    """
    if len(places) <= SMALL_TABLE:
        return [True] * len(places)
    points = _coordinates(places, CHOICE_SCALE)
    chosen = np.array(known) | _corners(places) | _in_transition(contact, places)
    while True:
        distances = np.linalg.norm(points[:, None] - points[chosen], axis=-1).min(axis=1)
        farthest = int(np.argmax(distances))
        if distances[farthest] <= MAX_DISTANCE and np.count_nonzero(chosen) > MIN_RESPONSES:
            return [bool(one) for one in chosen]
        chosen[farthest] = True


def log_responses(
    contact: TableContact, films: Sequence[Sequence[FilmSample]]
) -> tuple[Array, int]:
    """Interpolate the logarithms of stiffness and damping to all nodes of load and speed.

    Where a response did not converge, or nodes between have no converged one near them, those of
    neighbouring loads count.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    films : Sequence[Sequence[FilmSample]]
        films over load and speed

    Returns
    -------
    logarithms
        of stiffness [N/m] and damping [N s/m], shape (nQ, nU, 2)
    gaps
        number of nodes with the response of neighbouring loads [-]

    Raises
    ------
    ValueError
        if no response converged at one of the speeds
    """
    rows = [film for row in films for film in row]
    positions = [film.place for film in rows]
    asked = np.array([film.response is not None for film in rows])
    values = np.full((len(rows), 2), np.nan)
    for value, film in zip(values, rows, strict=True):
        if film.response is not None and film.response.converged:
            value[:] = np.log([film.response.stiffness.value, film.response.damping.value])
    unit = [dry_stiffness(contact.conditions(film.load, film.speed)) for film in rows]
    values[:, 0] -= np.log(unit)
    _interpolate(values, asked, _coordinates(positions, SPEED_SCALE))
    values[:, 0] += np.log(unit)
    gaps = int(np.count_nonzero(np.isnan(values[:, 0])))
    return _filled(values.reshape(len(films), -1, 2)), gaps


def _interpolate(values: Array, asked: Mask, points: Array) -> None:
    """Set values, shape (n, 2), where no response was asked for, except where the nearest one that
    was has none.
    """
    solved = np.isfinite(values[:, 0])
    if np.count_nonzero(solved) < MIN_RESPONSES or asked.all():
        return
    distances = np.linalg.norm(points[:, None] - points[asked], axis=-1)
    nearest = np.flatnonzero(asked)[np.argmin(distances, axis=1)]
    wanted = ~asked & solved[nearest]
    if wanted.any():
        between = RBFInterpolator(points[solved], values[solved], kernel="cubic", degree=1)
        values[wanted] = between(points[wanted])


def _coordinates(places: Sequence[Place], scale: float) -> Array:
    """x and scaled ln(speed) of places, shape (n, 2) [-]."""
    log_load, log_speed = np.array(places).T
    load = log_load - LOAD_BY_SPEED * log_speed
    x = (1.0 - np.exp(-SHARPEST * (load - load.min()))) / SHARPEST
    return np.stack([x, scale * log_speed], axis=1)


def _in_transition(contact: TableContact, places: Sequence[Place]) -> Mask:
    """At which places a film turns."""
    low, high = TRANSITION_LOADS
    loads = [atlas_load(scale_contact(contact.conditions(exp(q), exp(u)))) for q, u in places]
    return np.array([low < load < high for load in loads])


def _corners(places: Sequence[Place]) -> Mask:
    """Which places have an extreme load and an extreme speed."""
    values = np.array(places)
    extreme = (values == values.min(axis=0)) | (values == values.max(axis=0))
    return np.asarray(extreme.all(axis=1))


def _filled(values: Array) -> Array:
    """Values with gaps along the first axis interpolated, constant beyond the ends."""
    nodes = np.arange(values.shape[0])
    for line in values.reshape(nodes.size, -1).T:
        known = np.isfinite(line)
        if not known.any():
            fault = "at one of the speeds no film has a stiffness and damping"
            raise ValueError(f"load: {fault}; take another range")
        line[:] = np.interp(nodes, nodes[known], line[known])
    return values

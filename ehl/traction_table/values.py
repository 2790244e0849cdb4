"""Values of a table at its nodes: forces and moments of films over their largest, at motions on
its axes.

Where loads are close, films of every second one are sheared at all motions, those between at every
second node of each axis of motions only. There they tell by what the values differ from cubics
through those of the full rows, and this difference, small and smooth, is interpolated over the
motions by splines: its error is the product of those of both.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array, lagrange_weights
from ..multigrid.threads import film_threads
from .film import FilmSample, relative_forces
from .splines import SMALLEST, along_axis, spline_matrix, spline_weights
from .table import (
    COORDINATE_TERMS,
    TableContact,
    TableRange,
    from_vertex,
    motion_at,
    spinning_scales,
    vertex_slide,
)

# ln(load) between full rows at most: over a range of 26 to 1, 0.5 with 19 loads, films between
# them added 0.1 % of kappa_max Q to the largest error, over 2.2 to 1 nothing
FULL_STEP = 0.4
MOTIONS = (2, 3, 4)  # axes of values over load, speed, slide_x, slide_y, spin
NEAREST = 4  # full rows that a row between is interpolated from
Float32Array = NDArray[np.float32]

_NONE = np.empty((0, 0, 0, 0, 0, 4), np.float32)


def grid_values(
    contact: TableContact,
    limits: TableRange,
    films: Sequence[Sequence[FilmSample]],
    nodes: Sequence[Array],
    workers: int,
) -> tuple[Float32Array, Array]:
    """Shear films over load and speed at the nodes of slide_x, slide_y and spin.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    films : Sequence[Sequence[FilmSample]]
        films over load and speed
    nodes : Sequence[Array]
        coordinates of slide_x, slide_y and spin, each of shape (n,) [-]
    workers : int
        number of threads [-]

    Returns
    -------
    values
        forces and moments over the largest of each film, shape (nQ, nU, nX, nY, nS, 4) [-]
    largest
        largest force [N] and moments about n and y [N m], shape (nQ, nU, 3)
    """
    count = len(films)
    full = _full_rows([row[0].place[0] for row in films])
    between = [row for row in range(count) if row not in full]
    steps = [2 if one.size % 2 and one.size > 2 * SMALLEST else 1 for one in nodes]
    every = [(film, nodes) for row in full for film in films[row]]
    fewer = [one[::step] for one, step in zip(nodes, steps, strict=True)]
    few = [(film, fewer) for row in between for film in films[row]]
    with film_threads(workers) as pool:
        blocks = list(pool.map(lambda pair: _values(contact, limits, *pair), every + few))
    speeds = len(films[0])
    values = np.empty((count, speeds, *blocks[0].shape), np.float32)
    largest = np.empty((count, speeds, 3))
    coarse = _rows(blocks[len(every) :], speeds)
    known = _rows(blocks[: len(every)], speeds)
    largest[full] = _largest(known)
    values[full] = known / largest[full][..., None, None, None, [0, 0, 1, 2]].astype(np.float32)
    if between:
        chosen = (slice(None), slice(None), *(slice(None, None, step) for step in steps))
        weights = _row_weights(full, between)
        # largest of all motions over that of few changes slowly
        more = np.log(largest[full] / _largest(known[chosen]))
        largest[between] = _largest(coarse) * np.exp(np.tensordot(weights, more, axes=1))
        unit = largest[between][..., None, None, None, [0, 0, 1, 2]].astype(np.float32)
        straight = along_axis(weights, values[full], 0)
        values[between] = straight + _refined(coarse / unit - straight[chosen], nodes, steps)
    return values, largest


def _every_second(count: int) -> list[int]:
    """Every second of so many rows, and the last; all where less than four would be left."""
    rows = sorted({*range(0, count, 2), count - 1})
    return rows if len(rows) >= NEAREST else list(range(count))


def _full_rows(log_loads: list[float]) -> list[int]:
    """Rows whose films are sheared at all motions: every second where loads are close."""
    rows = _every_second(len(log_loads))
    apart = np.diff([log_loads[row] for row in rows])
    return rows if apart.max() <= FULL_STEP else list(range(len(log_loads)))


def _rows(blocks: list[Float32Array], speeds: int) -> Float32Array:
    """Blocks of films, one for each load and speed, as one array."""
    return np.array(blocks, np.float32).reshape(-1, speeds, *blocks[0].shape) if blocks else _NONE


def _row_weights(full: list[int], between: list[int]) -> Array:
    """Weights of the full rows in those between, by cubics, shape (between, full) [-]."""
    rows = np.array(full)
    weights = np.zeros((len(between), rows.size))
    for k, row in enumerate(between):
        first = int(np.clip(np.searchsorted(rows, row) - 2, 0, rows.size - NEAREST))
        near = slice(first, first + NEAREST)
        weights[k, near] = lagrange_weights(rows[near].astype(np.float64), float(row))
    return weights


def _refined(values: Float32Array, nodes: Sequence[Array], steps: Sequence[int]) -> Float32Array:
    """Values at all nodes of the motions by splines through those at few."""
    for axis, (one, step) in enumerate(zip(nodes, steps, strict=True)):
        if step > 1:
            few = len(one[::step])
            positions = np.zeros((one.size, few + 2))
            for k in range(one.size):
                first, weights = spline_weights(k / step, few)
                positions[k, first : first + 4] = weights
            values = along_axis(positions @ spline_matrix(few), values, MOTIONS[axis])
    return values


def _largest(raw: Float32Array) -> Array:
    """Largest force and moments about n, y of each film, shape (nQ, nU, 3) [N], [N m]."""
    squares = raw[..., 0] * raw[..., 0] + raw[..., 1] * raw[..., 1]
    force = np.sqrt(squares.max(axis=MOTIONS))
    moments = [
        np.maximum(raw[..., k].max(axis=MOTIONS), -raw[..., k].min(axis=MOTIONS)) for k in (2, 3)
    ]
    largest = np.stack([force, *moments], axis=-1).astype(np.float64)
    return np.maximum(largest, np.finfo(np.float32).tiny)


def _values(
    contact: TableContact, limits: TableRange, film: FilmSample, nodes: Sequence[Array]
) -> Float32Array:
    """Forces and moments of a film at the motions, shape (nX, nY, nS, 4) [N], [N m]."""
    x, y, n = nodes
    # spin first: neighbours in the row of motions slide alike
    motions = table_motions(contact, limits, film, (x[:, None], y, n[:, None, None]))
    forces = relative_forces(contact, film.film, film.speed, motions, vectorised=True)
    return np.moveaxis(forces.astype(np.float32).reshape(n.size, x.size, y.size, 4), 0, 2)


def table_motions(
    contact: TableContact, limits: TableRange, film: FilmSample, places: Sequence[Array] | Array
) -> list[Array]:
    """Convert coordinates on a table's axes to motions.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    film : FilmSample
        film with its scales
    places : Sequence[Array] | Array
        coordinates of slide_x, slide_y and spin, arrays of shapes that fit [-]

    Returns
    -------
    list[Array]
        slide_x/u, slide_y/u and spin R_x/u, flat, each of shape (n,) [-]
    """
    x, y, n = places
    bounds = limits.motions
    spin = motion_at(n, film.scales[2], bounds[2], COORDINATE_TERMS[2])
    scale_x, scale_y = spinning_scales(film.scales[:2], spin, contact, film.load)
    top = motion_at(x, scale_x, bounds[0], COORDINATE_TERMS[0])
    slide_x = from_vertex(top, vertex_slide(spin, contact, film.load), bounds[0])
    slide_y = motion_at(y, scale_y, bounds[1], COORDINATE_TERMS[1])
    return [part.ravel() for part in np.broadcast_arrays(slide_x, slide_y, spin)]

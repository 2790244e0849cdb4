r"""Build a traction table: films over load and speed, shear over the motions, more of both until a
check is passed.

The check solves films at loads and speeds between the nodes, random ones and those where the
splines are most in doubt, and evaluates the shear at random motions there: its error counts
everything that the table does. At some of them stiffness and damping are checked, too. Where the
error is too large, the axis whose nodes are worst predicted by their neighbours gets more of them.
Films are kept when the nodes along load or speed are doubled. `atlas_sampler` takes films of the
film atlas in place of solved ones.

Values of a table at its nodes: forces and moments of films over their largest, at motions on
its axes.

Where loads are close, films of every second one are sheared at all motions, those between at every
second node of each axis of motions only. There they tell by what the values differ from cubics
through those of the full rows, and this difference, small and smooth, is interpolated over the
motions by splines: its error is the product of those of both.

Stiffness and damping at all nodes of load and speed of a table, from responses at some.

Where a film turns from rolling in oil to a flat contact, both change by up to half from one node
to the next. But they do so at a load that grows with the speed: over

.. math:: x = 5\,[1 - (W/W_0)^{-1/5}], \qquad W = Q\,u^{-2/3},

W_0 the smallest one, nodes of other speeds stand between those of one, and what is left over
ln(u) is smooth. Responses are solved wherever a film turns, and else at nodes that are far apart
over both; their logarithms, of the stiffness that over Hertz', are interpolated by cubes of
distances (Duchon, 1977).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from math import ceil, exp, log, nan

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array, lagrange_weights
from ..atlas.fields import ContactFields, contact_fields, require_fields
from ..atlas.films import NotInAtlasError, atlas_films, atlas_load
from ..closed_form.hertz import MEAN_PRESSURE_RATIO
from ..conditions import ContactConditions
from ..multigrid.threads import film_threads
from ..oil.rheology import ShearLaw, contact_rheology
from ..scaling import scale_contact
from ..traction._kernels import LARGEST_FORCE, LARGEST_SPIN, LOAD_POWER, STANDING
from ..traction.film_quadrature import FilmQuadrature, zone_quadrature
from ..traction.linear_response import NormalResponse, ResponseValue, dry_stiffness
from .compression import mirrored, stored_values
from .film import FilmSample, TableFilm, film_sample, motion_scales, relative_forces
from .splines import (
    SMALLEST,
    along_axis,
    leave_one_out_error,
    spline_coefficients,
    spline_matrix,
    spline_weights,
)
from .table import (
    COORDINATE_TERMS,
    TableContact,
    TableError,
    TableRange,
    TractionTable,
    from_vertex,
    latin_hypercube,
    load_coordinate,
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
        between = scipy.interpolate.RBFInterpolator(
            points[solved], values[solved], kernel="cubic", degree=1
        )
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


# error of stiffness or damping that a table's message tells: their own error bars are 2 to 5 % [-]
RESPONSE_TOLERANCE = 0.05
# smallest motions of `spin_free_motions`: slide over the entrainment, spin over that over R_x; at
# smaller ones traction goes with the motion
SMALLEST_SLIDE = 1e-7
SMALLEST_SPIN = 1e-5
# `standstill_motions`: slow body's speed over half the entrainment, across the slide over it
SLOW = (1e-3, 0.25)
SMALLEST_ACROSS = 1e-4

# nodes of load, speed, slide_x, slide_y (its half above zero) and spin, of films without and with
# heat, whose tractions bend more over the load and near a slide-roll ratio of 2
START = (12, 4, 55, 15, 35)
HEATED_START = (19, 4, 59, 17, 37)
SCALE_DEGREES = (3, 2)  # of the scales over load and speed, chosen by trial [-]
# degrees of the units of forces and moments: their largest bend where the motion that has it
# changes
UNIT_DEGREES = (5, 2)
GROWTH = 1.4  # of the nodes of a motion
NARROW_LOADS = 6  # fewest nodes of a narrow range of loads
NARROW_STEP = 0.2  # ln(load) between them
Progress = Callable[[int, int, str], None]  # done, in all, what
# film of a contact at a place (ln load, ln speed) of a range, of so many points along x, with
# stiffness and damping or without
FilmSampler = Callable[[TableContact, TableRange, Place, int, bool], FilmSample]

LAYER = "flooded_layer_um: the atlas has rolling moments of thicker layers"


def check_points(
    limits: TableRange, films: int, responses: int, seed: int
) -> list[tuple[Place, bool]]:
    """Draw films at random for the check of a table.

    Parameters
    ----------
    limits : TableRange
        range of the table
    films : int
        number of films [-]
    responses : int
        number of films, the first ones, with stiffness and damping [-]
    seed : int
        seed of the draw

    Returns
    -------
    list[tuple[Place, bool]]
        ln(load) and ln(speed) of each film, and whether its response is solved
    """
    ends = np.array([[log(end) for end in ends] for ends in (limits.load, limits.speed)])
    positions = latin_hypercube(ends, films, np.random.default_rng(seed)).T
    return [((float(q), float(u)), k < responses) for k, (q, u) in enumerate(positions)]


def adaptive_check_points(table: TractionTable) -> list[Place]:
    """Choose positions between the nodes where the error of the splines is likely largest.

    Fourth differences over the load, to which the error of a cubic spline goes, are largest there:
    of the force and of the spin moment, at the slow and at the fast half of the speeds, between
    the last two nodes there; equal positions count once.

    Parameters
    ----------
    table : TractionTable
        table to check

    Returns
    -------
    list[Place]
        ln(load) and ln(speed) of each position
    """
    loads, speeds = table.axes[:2]
    # 1. rows of the splines' coefficients, by the largest over the motions
    some = (slice(None), slice(1, -1), *(slice(None, None, 2),) * 3)
    bend = np.abs(np.diff(table.values[*some, :3].astype(np.float32), 4, axis=0)).max(
        axis=(2, 3, 4)
    )
    units = table.scalars[:, 1:-1, [LARGEST_FORCE, LARGEST_FORCE, LARGEST_SPIN]]
    more = np.abs(np.diff(units, 4, axis=0))
    at_nodes = np.pad(bend + more, ((1, 1), (0, 0), (0, 0)))
    between = at_nodes[:-1] + at_nodes[1:]
    kinds = (between[..., :2].max(axis=-1), between[..., 2])
    # 2. half-way between the nodes
    count = int(speeds[2])
    half = count // 2
    result = []
    for kind in kinds:
        for half_differences, at in ((kind[:, :half], 0.5), (kind[:, half:], count - 1.5)):
            row = int(np.argmax(half_differences.max(axis=1)))
            coordinate = loads[0] + (row + 0.5) / loads[1]
            result.append(
                (float(log(-coordinate) / LOAD_POWER), float(speeds[0] + at / speeds[1]))
            )
    return list(dict.fromkeys(result))


def table_error(
    table: TractionTable,
    contact: TableContact,
    films: Sequence[FilmSample],
    motions: int,
    seed: int,
) -> TableError:
    """Measure the error of a table at films of a contact.

    Each film is sheared at motions drawn evenly in the table's coordinates, as many
    `spin_free_motions`, and as many `standstill_motions`.

    Parameters
    ----------
    table : TractionTable
        table to check
    contact : TableContact
        contact of the films
    films : Sequence[FilmSample]
        films of the check
    motions : int
        motions of each kind at each film [-]
    seed : int
        seed of the draw

    Returns
    -------
    TableError
        errors of the table
    """
    rng, others, slow = (np.random.default_rng(seed + k) for k in (1, 2, 3))
    errors = []
    for film in films:
        positions = rng.uniform(-1.0, 1.0, (3, motions))
        drawn = (
            table_motions(contact, table.range, film, positions),
            spin_free_motions(contact, table.range, film.load, others, motions),
            standstill_motions(table.range, slow, motions),
        )
        errors.append(_errors(contact, table, film, drawn))
    even, straight, standing = np.moveaxis(np.array(errors), 1, 0)
    every = even.reshape(-1, 3)
    responses = _response_errors(table, films)
    return TableError(
        largest=float(max(every[:, 0].max(), standing[..., 0].max())),
        quantile=float(np.quantile(every[:, 0], 0.95)),
        rms=float(np.sqrt(np.mean(every[:, 0] ** 2))),
        largest_spin=float(max(every[:, 1].max(), straight[..., 1].max())),
        largest_rolling=float(every[:, 2].max()),
        largest_straight=float(straight[..., 0].max()),
        largest_stiffness=float(responses[:, 0].max()) if len(responses) else np.nan,
        largest_damping=float(responses[:, 1].max()) if len(responses) else np.nan,
        responses=len(responses),
        films=len(films),
        motions=motions,
        tolerance=table.error.tolerance,
    )


def spin_free_motions(
    contact: TableContact, limits: TableRange, load: float, rng: np.random.Generator, count: int
) -> list[Array]:
    """Draw motions of rolling without spin and with little, where traction changes most sharply.

    Slides are even in their logarithm, along from the vertex on, across, or both, of each sign;
    every third has a spin, every twelfth a spin alone, the first of these the largest.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    load : float
        load of the film [N]
    rng : np.random.Generator
        generator of random numbers
    count : int
        number of motions [-]

    Returns
    -------
    list[Array]
        slide_x/u, slide_y/u and spin R_x/u, each of shape (count,) [-]
    """
    ends = np.log([[SMALLEST_SLIDE] * 2 + [SMALLEST_SPIN], limits.motions])
    drawn = np.exp(ends[0] + (ends[1] - ends[0]) * rng.random((count, 3)))
    drawn *= rng.choice([-1.0, 1.0], (count, 3))
    order = np.arange(count)
    drawn[order % 4 == 0, 0] = 0.0
    drawn[order % 4 == 1, 1] = 0.0
    drawn[order % 3 != 0, 2] = 0.0
    drawn[0, 2] = limits.spin
    top, slide_y, spin = drawn.T
    slide_x = from_vertex(top, vertex_slide(spin, contact, load), limits.slide_x)
    slide_x[order % 12 == 0] = slide_y[order % 12 == 0] = 0.0
    return [slide_x, slide_y, spin]


def standstill_motions(limits: TableRange, rng: np.random.Generator, count: int) -> list[Array]:
    """Draw motions at which one body nearly stands still, where heat bends the traction.

    The bend is the narrower the faster the contact: slow speeds are even in their logarithm, every
    eighth is zero; two of three have a slide across, every second has spin.

    Parameters
    ----------
    limits : TableRange
        range of the table
    rng : np.random.Generator
        generator of random numbers
    count : int
        number of motions [-]

    Returns
    -------
    list[Array]
        slide_x/u, slide_y/u and spin R_x/u, each of shape (count,) [-]
    """
    order = np.arange(count)
    gap = np.exp(rng.uniform(log(SLOW[0]), log(SLOW[1]), count))
    gap[order % 8 == 0] = 0.0
    across = np.exp(rng.uniform(log(SMALLEST_ACROSS), log(limits.slide_y), count))
    across[order % 3 == 0] = 0.0
    signs = rng.choice([-1.0, 1.0], (2, count))
    spin = rng.uniform(-limits.spin, limits.spin, count)
    spin[order % 2 == 0] = 0.0
    reach = min(limits.slide_x, STANDING)
    return [signs[0] * reach * (1.0 - gap / STANDING), signs[1] * across, spin]


def _errors(
    contact: TableContact, table: TractionTable, film: FilmSample, kinds: Sequence[Sequence[Array]]
) -> Array:
    """Measure the errors of force and moments about n, y at a film's motions of each kind. They
    are over the film's largest at all of these, shape (kinds, n, 3), as in `TableError` [-].
    """
    moved = [np.concatenate(parts) for parts in zip(*kinds, strict=True)]
    expected = relative_forces(contact, film.film, film.speed, moved)
    sizes = _sizes(expected)
    expected[:, 0] -= 0.5 * contact.curvature_difference * film.moment
    expected[:, 3] -= film.moment
    slide_x, slide_y, spin = (part * film.speed for part in moved)
    positions = np.stack([slide_x, slide_y, spin / contact.radius_x], axis=1)
    lookups = [table.forces(film.load, film.speed, *place)[:4] for place in positions]
    unit = sizes.max(axis=0) + np.array([0.0, 0.0, film.moment])
    errors = _sizes(np.array(lookups) - expected) / unit
    return np.asarray(errors.reshape(len(kinds), -1, 3))


def _sizes(forces: Array) -> Array:
    """Give the size of forces (n, 4): force and moments about n, y, shape (n, 3) [N], [N m]."""
    force = np.hypot(forces[:, 0], forces[:, 1])
    return np.stack([force, np.abs(forces[:, 2]), np.abs(forces[:, 3])], axis=1)


def _response_errors(table: TractionTable, films: Sequence[FilmSample]) -> Array:
    """Relative errors of stiffness and damping at films that have them, shape (n, 2) [-]."""
    errors = []
    for film in films:
        if film.response is None or not film.response.converged:
            continue
        result = table.forces(film.load, film.speed, 0.0, 0.0, 0.0)
        solved = film.response.stiffness.value, film.response.damping.value
        errors.append(np.abs(np.array([result.stiffness, result.damping]) / solved - 1.0))
    return np.array(errors).reshape(-1, 2)


def response_message(checks: Sequence[FilmSample], error: TableError) -> str:
    """Report the error of stiffness and damping between the films, with their own error bars.

    Parameters
    ----------
    checks : Sequence[FilmSample]
        films of the check
    error : TableError
        errors of the table

    Returns
    -------
    str
        message; empty where the error is small
    """
    stiffness, damping = error.largest_stiffness, error.largest_damping
    if not max(stiffness, damping) > RESPONSE_TOLERANCE:
        return ""
    solved = [film.response for film in checks if film.response and film.response.converged]
    bars = np.max(
        [[v.uncertainty / v.value for v in (one.stiffness, one.damping)] for one in solved], axis=0
    )
    off = (
        f"; between its films stiffness is off by up to {stiffness:.1%}, damping by {damping:.1%}"
    )
    return f"{off} (error bars of those solved there: up to {bars[0]:.1%} and {bars[1]:.1%})"


@dataclass(frozen=True, slots=True, kw_only=True)
class TableOptions:
    """How a table is sampled."""

    points: int = 257  # of the films along x, 2^k + 1
    tolerance: float = 0.01  # of the force over kappa_max Q at every point of the check [-]
    check_films: int = 8  # random ones
    check_doubtful: bool = True  # and those where the splines over the load bend most
    check_motions: int = 400  # random ones, at each film of the check
    check_responses: int = 3  # films of the check that stiffness and damping are solved at, too
    rounds: int = 4  # refinements at most
    workers: int = 1  # films solved at a time
    seed: int = 52163  # of the random places of the check
    # solves the film of a place, as `film_sample`; a store of films takes its place
    sample: FilmSampler = film_sample
    # nodes of load, speed, slide_x, slide_y (its half above zero) and spin to begin with, 4 at
    # least; None: `START` or, with heat, `HEATED_START`
    nodes: tuple[int, int, int, int, int] | None = None
    narrow: bool = False  # fewer of load to begin with where its range is narrow


@dataclass(slots=True, kw_only=True)
class _Study:
    """Films and numbers of nodes while a table grows."""

    contact: TableContact
    range: TableRange
    options: TableOptions
    progress: Progress
    counts: list[int]
    films: dict[tuple[float, float], FilmSample] = field(default_factory=dict)
    checks: list[FilmSample] = field(default_factory=list)  # random ones
    doubtful: list[FilmSample] = field(default_factory=list)  # of the last table


def build_traction_table(
    contact: TableContact,
    limits: TableRange,
    options: TableOptions | None = None,
    progress: Progress | None = None,
) -> TractionTable:
    """Build a traction table: solve films and evaluate their shear until the check is within the
    tolerance.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of loads, speeds and motions
    options : TableOptions | None, optional
        nodes, tolerance and rounds; None: the defaults
    progress : Progress | None, optional
        called with films done, films wanted so far, and the kind of step

    Returns
    -------
    TractionTable
        table with its error in the check

    Raises
    ------
    ValueError
        if a film cannot be used; the message names load and speed

    Notes
    -----
    Building takes minutes: it solves some hundred contacts.

    Examples
    --------
    A coarse table of films from the atlas, for a look at its use; leave out the options.

    >>> from oilfilm.ehl import Lubricant
    >>> from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
    >>> from oilfilm.ehl.traction_table.build import atlas_sampler
    >>> from oilfilm.ehl.traction_table.film import film_sample
    >>> contact = TableContact(
    ...     radius_x=0.01,
    ...     radius_y=0.02,
    ...     reduced_modulus=226e9,
    ...     lubricant=Lubricant(viscosity=0.04, pressure_viscosity=18e-9),
    ...     rheology=Rheology(
    ...         law=ShearLaw.REE_EYRING, eyring_stress=5e6, limiting_coefficient=0.05
    ...     ),
    ...     temperature=313.15,
    ... )
    >>> limits = TableRange(load=(40.0, 80.0), speed=(1.0, 2.0), slide_x=0.5)
    >>> options = TableOptions(
    ...     sample=atlas_sampler(film_sample),
    ...     nodes=(4, 4, 9, 5, 5),
    ...     rounds=1,
    ...     check_films=1,
    ...     check_doubtful=False,
    ...     check_motions=10,
    ...     check_responses=1,
    ... )
    >>> table = build_traction_table(contact, limits, options)
    >>> f"{table.forces(60.0, 1.5, 0.05, 0.0, 0.0).force_x:.1f} N"
    '-0.9 N'
    """
    study = _study(contact, limits, options or TableOptions(), progress)
    for _ in range(study.options.rounds):
        table, raw = _table(study)
        if table.error.reached:
            break
        # more nodes on the axis whose values are worst predicted by their neighbours
        forces = mirrored(raw)[..., :2]
        axis = int(np.argmax([leave_one_out_error(forces, axis) for axis in range(5)]))
        n = study.counts[axis]
        study.counts[axis] = 2 * n - 1 if axis < 2 else int(np.ceil(GROWTH * n))
    return table


def check_table(table: TractionTable, contact: TableContact, options: TableOptions) -> TableError:
    """Measure the error of a table at films and motions between its nodes.

    Parameters
    ----------
    table : TractionTable
        table to check
    contact : TableContact
        contact whose films are solved for the check
    options : TableOptions
        films, motions and tolerance of the check

    Returns
    -------
    TableError
        errors of forces [-] and moments [-]
    """
    return _error(_study(contact, table.range, options, None), table)


def _error(study: _Study, table: TractionTable) -> TableError:
    """Evaluate the error of a table at the films of the check, and at those of the adaptive
    points.
    """
    options = study.options
    drawn = options.check_motions, options.seed
    if options.check_doubtful:
        study.doubtful = _solve(study, [(place, False) for place in adaptive_check_points(table)])
    error = table_error(table, study.contact, study.checks + study.doubtful, *drawn)
    return replace(error, tolerance=options.tolerance)


def _study(
    contact: TableContact, limits: TableRange, options: TableOptions, progress: Progress | None
) -> _Study:
    """With the films of the check, at random places between the nodes."""
    nodes = options.nodes or (START if contact.solids is None else HEATED_START)
    study = _Study(
        contact=contact,
        range=limits,
        options=options,
        progress=progress or (lambda done, total, state: None),
        counts=[_first_loads(nodes[0], options.narrow, limits), *nodes[1:]],
    )
    wanted = check_points(limits, options.check_films, options.check_responses, options.seed)
    study.checks = _solve(study, wanted)
    return study


def _first_loads(most: int, narrow: bool, limits: TableRange) -> int:
    """Nodes of load to begin with."""
    if not narrow:
        return most
    steps = ceil(log(limits.load[1] / limits.load[0]) / NARROW_STEP)
    return min(most, max(NARROW_LOADS, 1 + steps))


def _solve(study: _Study, wanted: list[tuple[Place, bool]]) -> list[FilmSample]:
    """Films at places, with stiffness and damping or without, several at a time: the kernels
    release the interpreter's lock.
    """
    films: list[FilmSample] = []
    before = len(study.films) + len(study.checks)

    def solve(place: tuple[Place, bool]) -> FilmSample:
        points = study.options.points
        return study.options.sample(study.contact, study.range, place[0], points, place[1])

    with film_threads(study.options.workers) as pool:
        for film in pool.map(solve, wanted):
            films.append(film)
            study.progress(before + len(films), before + len(wanted), "films")
    return films


def _axes(study: _Study) -> Array:
    """Start, nodes per unit, nodes of the five axes."""
    limits = study.range
    first = np.array([load_coordinate(limits.load[0]), log(limits.speed[0]), -1.0, 0.0, -1.0])
    last = np.array([load_coordinate(limits.load[1]), log(limits.speed[1]), 1.0, 1.0, 1.0])
    nodes = np.array(study.counts, dtype=np.float64)
    return np.stack([first, (nodes - 1.0) / (last - first), nodes], axis=1)


def _axis_nodes(axis: Array) -> Array:
    """Places of an axis's nodes, shape (n,) [-]."""
    return axis[0] + np.arange(int(axis[2])) / axis[1]


def _axis_loads(axis: Array) -> Array:
    """Loads at the nodes of their axis, shape (n,) [N]."""
    return np.asarray((-_axis_nodes(axis)) ** (1.0 / LOAD_POWER))


def _grid_films(study: _Study, axes: Array) -> list[list[FilmSample]]:
    """The films of all nodes of load and speed; those not known yet are solved."""
    loads = np.log(_axis_loads(axes[0]))
    rows = [[(float(q), float(u)) for u in _axis_nodes(axes[1])] for q in loads]
    keys = {place: (round(place[0], 9), round(place[1], 9)) for row in rows for place in row}
    known = [study.films.get(key) for key in keys.values()]
    response = response_nodes(
        study.contact,
        list(keys),
        [film is not None and film.response is not None for film in known],
    )
    missing = [
        (place, wanted)
        for place, film, wanted in zip(keys, known, response, strict=True)
        if film is None or (wanted and film.response is None)
    ]
    for film in _solve(study, missing):
        study.films[keys[film.place]] = film
    return [[study.films[keys[place]] for place in row] for row in rows]


def _with_smooth_scales(films: list[list[FilmSample]], axes: Array) -> list[list[FilmSample]]:
    """Films with scales of the motions that change slowly over load and speed: polynomials of
    `SCALE_DEGREES` in both coordinates through their logarithms, by least squares.

    Where a film turns from rolling in oil to a flat contact its own scale falls a hundredfold, and
    so would move all else along its axis.
    """
    known = np.log([[film.scales for film in row] for row in films])
    scales = np.exp(_smooth(known, axes, SCALE_DEGREES))
    return [
        [
            replace(film, scales=tuple(film_scales))
            for film, film_scales in zip(row, rows, strict=True)
        ]
        for row, rows in zip(films, scales.tolist(), strict=True)
    ]


def _smooth(known: Array, axes: Array, degrees: tuple[int, int]) -> Array:
    """Numbers of films over load and speed, shape (nQ, nU, k), by polynomials of these degrees
    through them, by least squares [same unit].
    """
    loads, speeds = (np.linspace(-1.0, 1.0, int(axis[2])) for axis in axes[:2])
    terms = np.polynomial.legendre.legvander2d(
        np.repeat(loads, speeds.size), np.tile(speeds, loads.size), degrees
    )
    flat = known.reshape(len(terms), -1)
    return np.asarray((terms @ np.linalg.lstsq(terms, flat, rcond=None)[0]).reshape(known.shape))


def _table(study: _Study) -> tuple[TractionTable, NDArray[np.float32]]:
    """The table of the present nodes with its error, and its values at the nodes."""
    # 1. forces and moments of all films at all motions
    axes = _axes(study)
    films = _with_smooth_scales(_grid_films(study, axes), axes)
    study.progress(len(study.films), len(study.films), "shear")
    nodes = [_axis_nodes(axis) for axis in axes[2:]]
    raw, largest = grid_values(study.contact, study.range, films, nodes, study.options.workers)
    units = np.exp(_smooth(np.log(largest), axes, UNIT_DEGREES))
    raw *= (largest / units)[..., None, None, None, [0, 0, 1, 2]].astype(np.float32)
    # 2. splines: values over their largest, logarithms of what depends on load and speed alone
    responses, filled = log_responses(study.contact, films)
    scalars = [_scalars(films), responses, np.log(units)]
    table = TractionTable(
        contact=study.contact,
        range=study.range,
        points=study.options.points,
        axes=axes,
        scalars=spline_coefficients(np.concatenate(scalars, axis=-1), (0, 1)),
        values=stored_values(raw),  # rounded as in a file
        kappa_max=float((largest[..., 0] / _axis_loads(axes[0])[:, None]).max()),
        error=_unchecked(study.options.tolerance),
        films=len(study.films) + len(study.checks),
        converged=False,
        message="",
    )
    # 3. check
    error = _error(study, table)
    table = replace(table, error=error, films=table.films + len(study.doubtful))
    return _with_message(study, table, filled), raw


def _unchecked(tolerance: float) -> TableError:
    """The error of a table before its check: none is known to be reached."""
    unknown = np.inf
    return TableError(
        largest=unknown,
        quantile=unknown,
        rms=unknown,
        largest_spin=unknown,
        largest_rolling=unknown,
        films=0,
        motions=0,
        tolerance=tolerance,
    )


def _with_message(study: _Study, table: TractionTable, filled: int) -> TractionTable:
    """Set whether the table converged, and the message on it; at how many nodes the response is
    filled in.
    """
    films = [*study.films.values(), *study.checks, *study.doubtful]
    bad = sum(not film.film.converged for film in films)
    error = table.error
    faults = []
    if not error.reached:
        faults.append(f"error {error.largest:.2%} of kappa_max Q, above {error.tolerance:.2%}")
    if bad:
        faults.append(f"{bad} of {len(films)} films did not converge")
    message = "; ".join(faults) or "converged"
    if error.largest_straight > error.tolerance:
        near = f"{error.largest_straight:.2%} of kappa_max Q, above {error.tolerance:.2%}"
        message += f"; near rolling without spin errors up to {near}"
    message += _of_atlas(films)
    if error.largest_spin > error.tolerance:
        message += f"; moments of spin are off by up to {error.largest_spin:.2%} of their largest"
    message += response_message(study.checks, error)
    if filled:
        few = f"{filled} of {int(table.axes[0, 2] * table.axes[1, 2])} films"
        message += f"; stiffness and damping of {few} are those of neighbouring loads"
    return replace(table, converged=not faults, message=message)


def _of_atlas(films: Sequence[FilmSample]) -> str:
    """How many films are the atlas's, and why others are not; nothing where it was not asked."""
    reasons = [film.solved_because for film in films if film.solved_because is not None]
    solved = [reason for reason in reasons if reason]
    if not reasons:
        return ""
    text = f"; {len(reasons) - len(solved)} of {len(films)} films by the film atlas"
    return text + f", others solved: {solved[0]}" if solved else text


def _scalars(films: list[list[FilmSample]]) -> Array:
    """Logarithms of scales, film, hydrodynamic moment, shape (nQ, nU, 5)."""
    known = [[(*film.scales, film.film.central, film.moment) for film in row] for row in films]
    if np.min(known) <= 0.0:
        first = films[0][0]
        place = f"{first.load:.4g} N and {first.speed:.4g} m/s"
        raise ValueError(f"no rolling moment in some film from {place} on: take another range")
    return np.log(known)


def atlas_sampler(solve: FilmSampler) -> FilmSampler:
    """Make a sampler of films by the atlas.

    Tables that the atlas does not cover whole are sampled by `solve`, so that neighbouring films
    have the same origin.

    Parameters
    ----------
    solve : FilmSampler
        sampler that solves films

    Returns
    -------
    FilmSampler
        sampler of films
    """
    asked: list[tuple[TableContact, TableRange, str]] = []  # the last, and why it is solved

    def reason(contact: TableContact, limits: TableRange) -> str:
        if not asked or asked[-1][0] is not contact or asked[-1][1] is not limits:
            asked.append((contact, limits, _not_covered(contact, limits)))
        return asked[-1][2]

    def sample(
        contact: TableContact,
        limits: TableRange,
        place: tuple[float, float],
        points: int,
        response: bool = True,
    ) -> FilmSample:
        why = reason(contact, limits)
        try:
            if not why:
                return atlas_sample(contact, limits, place)
        except NotInAtlasError as error:
            why = error.reason
        return replace(solve(contact, limits, place, points, response), solved_because=why)

    return sample


def atlas_sample(
    contact: TableContact, limits: TableRange, place: tuple[float, float]
) -> FilmSample:
    """Evaluate the film at a load and a speed from the atlas.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    place : tuple[float, float]
        ln(load) and ln(speed), in [N] and [m/s]

    Returns
    -------
    FilmSample
        film with its scales, moment and response

    Raises
    ------
    NotInAtlasError
        if the atlas does not cover it
    """
    load, speed = (exp(value) for value in place)
    _require_law(contact)
    conditions = contact.conditions(load, speed)
    fields = contact_fields(conditions)
    films = atlas_films(conditions)
    if films.rolling_moment is None:
        raise NotInAtlasError(LAYER)
    film = TableFilm(
        quadrature=_quadrature(contact, conditions, fields),
        central=films.central.value,
        converged=True,
    )
    stiffness = ResponseValue(value=films.stiffness.value, uncertainty=films.stiffness.uncertainty)
    response = NormalResponse(
        stiffness=stiffness,
        damping=ResponseValue(value=fields.damping, uncertainty=nan),
        converged=True,
        resolved=True,
        message="converged",
    )
    return FilmSample(
        place=place,
        film=film,
        scales=motion_scales(contact, limits, film, speed),
        moment=films.rolling_moment.value,
        response=response,
        solved_because="",
    )


def _require_law(contact: TableContact) -> None:
    """NotInAtlasError unless films are isothermal and sheared as those judged."""
    if contact.solids is not None:
        raise NotInAtlasError("film_model: the atlas has isothermal films")
    law = contact.rheology
    if law.law is not ShearLaw.REE_EYRING or law.limiting_coefficient is None:
        raise NotInAtlasError(
            "rheology: the atlas has films sheared after Eyring up to a limiting stress"
        )


def _not_covered(contact: TableContact, limits: TableRange) -> str:
    """Explain why the atlas does not have all films of a table; empty where it has."""
    try:
        _require_law(contact)
        for load, speed in product(limits.load, limits.speed):
            conditions = contact.conditions(load, speed)
            require_fields(conditions)
            if atlas_films(conditions).rolling_moment is None:
                raise NotInAtlasError(LAYER)
    except NotInAtlasError as error:
        return error.reason
    return ""


def _quadrature(
    contact: TableContact, conditions: ContactConditions, fields: ContactFields
) -> FilmQuadrature:
    """Nodes of fields as `film_quadrature` has them."""
    scaled = scale_contact(conditions)
    assert scaled.semi_axis_x is not None
    mean = MEAN_PRESSURE_RATIO * scaled.hertz_pressure
    rheology = contact_rheology(contact.rheology, contact.lubricant, mean)
    width = scaled.semi_axis_x * scaled.semi_axis_ratio
    parts = (fields.zone, fields.cells)
    return zone_quadrature(width, parts, contact.lubricant, rheology, contact.temperature)

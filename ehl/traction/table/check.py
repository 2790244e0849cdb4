"""Check of a table by films at loads and speeds between its nodes. Random ones and those where its
splines bend most are sheared at random motions; some have stiffness and damping.
"""

from collections.abc import Sequence
from math import log

import numpy as np

from ...arrays import Array
from .._kernels import LARGEST_FORCE, LARGEST_SPIN, LOAD_POWER, STANDING
from .coordinates import from_vertex, vertex_slide
from .film import FilmSample, relative_forces
from .responses import Place
from .table import TableContact, TableError, TableRange, TractionTable, latin_hypercube
from .values import table_motions

# error of stiffness or damping that a table's message tells: their own error bars are 2 to 5 % [-]
RESPONSE_TOLERANCE = 0.05
# smallest motions of `spin_free_motions`: slide over the entrainment, spin over that over R_x; at
# smaller ones traction goes with the motion
SMALLEST_SLIDE = 1e-7
SMALLEST_SPIN = 1e-5
# `standstill_motions`: slow body's speed over half the entrainment, across the slide over it
SLOW = (1e-3, 0.25)
SMALLEST_ACROSS = 1e-4


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

"""Build a traction table: films over load and speed, shear over the motions, more of both until a
check is passed.

The check solves films at loads and speeds between the nodes and evaluates the shear at random
motions there: its error counts everything that the table does. Where it is too large, the axis
whose nodes are worst predicted by their neighbours gets more of them. Films are kept when the
nodes along load or speed are doubled.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import ceil, log

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...multigrid.threads import film_threads
from .._kernels import LOAD_POWER
from .coordinates import from_vertex, vertex_slide
from .film import FilmSample, film_sample, relative_forces
from .packing import mirrored, stored_values
from .responses import Place, log_responses, wanted_responses
from .splines import left_out_error, spline_coefficients
from .table import TableContact, TableError, TableRange, TractionTable, latin_hypercube, load_place
from .values import grid_values, table_motions

# nodes of load, speed, slide_x, slide_y (its half above zero) and spin, of films without and with
# heat, whose tractions bend more over the load and near a slide-roll ratio of 2
START = (12, 4, 55, 15, 35)
HEATED_START = (19, 4, 59, 17, 37)
SCALE_DEGREES = (3, 2)  # of the scales over load and speed, chosen by trial [-]
GROWTH = 1.4  # of the nodes of a motion
NARROW_LOADS = 6  # fewest nodes of a narrow range of loads
NARROW_STEP = 0.2  # ln(load) between them
# error of stiffness or damping that a table's message tells: their own error bars are 2 to 5 % [-]
RESPONSE_TOLERANCE = 0.05

# smallest motions of `straight_motions`: slide over the entrainment, spin over that over R_x; at
# smaller ones traction goes with the motion
SMALLEST_SLIDE = 1e-7
SMALLEST_SPIN = 1e-5
Progress = Callable[[int, int, str], None]  # done, in all, what
# film of a contact at a place (ln load, ln speed) of a range, of so many points along x, with
# stiffness and damping or without
FilmSampler = Callable[[TableContact, TableRange, Place, int, bool], FilmSample]


@dataclass(frozen=True, slots=True, kw_only=True)
class TableOptions:
    """How a table is sampled."""

    points: int = 257  # of the films along x, 2^k + 1
    tolerance: float = 0.01  # of the force over kappa_max Q at every point of the check [-]
    check_films: int = 8
    check_motions: int = 60  # random ones, at each film of the check
    check_responses: int = 3  # films of the check that stiffness and damping are solved at, too
    rounds: int = 4  # refinements at most
    workers: int = 1  # films solved at a time
    seed: int = 52163  # of the random places of the check
    # solves the film of a place, as `film_sample`; a store of films takes its place
    sample: FilmSampler = film_sample
    # of load, speed, slide_x, slide_y (its half above zero) and spin to begin with, 4 at least;
    # None: `START` or, with heat, `HEATED_START`
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
    checks: list[FilmSample] = field(default_factory=list)


def build_table(
    contact: TableContact,
    limits: TableRange,
    options: TableOptions | None = None,
    progress: Progress | None = None,
) -> TractionTable:
    """Solve films and evaluate their shear until the table reaches its tolerance, its `error` in
    the check; ValueError where a film cannot be used, naming load and speed. progress: called with
    films done, films wanted so far, and the kind of step.
    """
    study = _study(contact, limits, options or TableOptions(), progress)
    for _ in range(study.options.rounds):
        table, raw = _table(study)
        if table.error.reached:
            break
        # more nodes on the axis whose values are worst predicted by their neighbours
        forces = mirrored(raw)[..., :2]
        axis = int(np.argmax([left_out_error(forces, axis) for axis in range(5)]))
        n = study.counts[axis]
        study.counts[axis] = 2 * n - 1 if axis < 2 else int(np.ceil(GROWTH * n))
    return table


def check_table(table: TractionTable, contact: TableContact, options: TableOptions) -> TableError:
    """Error of a table at films and motions not in it, by contact; forces [N], moments [N m]."""
    return _checked(_study(contact, table.range, options, None), table)


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
    ends = np.array([[log(end) for end in ends] for ends in (limits.load, limits.speed)])
    places = latin_hypercube(ends, options.check_films, np.random.default_rng(options.seed)).T
    measured = options.check_responses
    wanted = [((float(q), float(u)), k < measured) for k, (q, u) in enumerate(places)]
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
    first = np.array([load_place(limits.load[0]), log(limits.speed[0]), -1.0, 0.0, -1.0])
    last = np.array([load_place(limits.load[1]), log(limits.speed[1]), 1.0, 1.0, 1.0])
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
    response = wanted_responses(
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
    loads, speeds = (np.linspace(-1.0, 1.0, int(axis[2])) for axis in axes[:2])
    terms = np.polynomial.legendre.legvander2d(
        np.repeat(loads, speeds.size), np.tile(speeds, loads.size), SCALE_DEGREES
    )
    known = np.log([film.scales for row in films for film in row])
    fitted = np.exp(terms @ np.linalg.lstsq(terms, known, rcond=None)[0])
    scales = fitted.reshape(loads.size, speeds.size, 3)
    return [
        [replace(film, scales=tuple(own)) for film, own in zip(row, rows, strict=True)]
        for row, rows in zip(films, scales.tolist(), strict=True)
    ]


def _table(study: _Study) -> tuple[TractionTable, NDArray[np.float32]]:
    """The table of the present nodes with its error, and its values at the nodes."""
    # 1. forces and moments of all films at all motions
    axes = _axes(study)
    films = _with_smooth_scales(_grid_films(study, axes), axes)
    study.progress(len(study.films), len(study.films), "shear")
    nodes = [_axis_nodes(axis) for axis in axes[2:]]
    raw, largest = grid_values(study.contact, study.range, films, nodes, study.options.workers)
    # 2. splines: values over their largest, logarithms of what depends on load and speed alone
    responses, filled = log_responses(study.contact, films)
    scalars = [_scalars(films), responses, np.log(largest)]
    unchecked = TableError(
        largest=np.inf,
        quantile=np.inf,
        rms=np.inf,
        largest_spin=np.inf,
        largest_rolling=np.inf,
        films=0,
        motions=0,
        tolerance=study.options.tolerance,
    )
    table = TractionTable(
        contact=study.contact,
        range=study.range,
        points=study.options.points,
        axes=axes,
        scalars=spline_coefficients(np.concatenate(scalars, axis=-1), (0, 1)),
        values=stored_values(raw),  # rounded as in a file
        kappa_max=float((largest[..., 0] / _axis_loads(axes[0])[:, None]).max()),
        error=unchecked,
        films=len(study.films) + len(study.checks),
        converged=False,
        message="",
    )
    # 3. check
    return _with_message(study, replace(table, error=_checked(study, table)), filled), raw


def _with_message(study: _Study, table: TractionTable, filled: int) -> TractionTable:
    """Whether it converged, and what did not; at how many nodes the response is filled in."""
    films = [*study.films.values(), *study.checks]
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
    message += of_responses(study.checks, error)
    if filled:
        few = f"{filled} of {int(table.axes[0, 2] * table.axes[1, 2])} films"
        message += f"; stiffness and damping of {few} are those of neighbouring loads"
    return replace(table, converged=not faults, message=message)


def of_responses(checks: Sequence[FilmSample], error: TableError) -> str:
    """By how much stiffness and damping are off between the films, beside their own error bars;
    nothing where that is little.
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


def straight_motions(
    contact: TableContact, limits: TableRange, load: float, rng: np.random.Generator, count: int
) -> list[Array]:
    """Motions over u, u and u/R_x of rolling without spin and with little, where traction turns
    most sharply: slides even in their logarithm, along from the vertex on, across, or both, each
    sign; every third with a spin, every twelfth a spin alone, flat [-].
    """
    ends = np.log([[SMALLEST_SLIDE] * 2 + [SMALLEST_SPIN], limits.motions])
    drawn = np.exp(ends[0] + (ends[1] - ends[0]) * rng.random((count, 3)))
    drawn *= rng.choice([-1.0, 1.0], (count, 3))
    order = np.arange(count)
    drawn[order % 4 == 0, 0] = 0.0
    drawn[order % 4 == 1, 1] = 0.0
    drawn[order % 3 != 0, 2] = 0.0
    top, slide_y, spin = drawn.T
    slide_x = from_vertex(top, vertex_slide(spin, contact, load), limits.slide_x)
    slide_x[order % 12 == 0] = slide_y[order % 12 == 0] = 0.0
    return [slide_x, slide_y, spin]


def _errors(
    study: _Study, table: TractionTable, film: FilmSample, motions: Sequence[Array]
) -> Array:
    """Errors of force and moments about n, y at a film's motions, shape (n, 3), as `TableError`
    measures them [-].
    """
    contact = study.contact
    expected = relative_forces(contact, film.film, film.speed, list(motions))
    expected[:, 0] -= 0.5 * contact.curvature_difference * film.moment
    expected[:, 3] -= film.moment
    slide_x, slide_y, spin = (part * film.speed for part in motions)
    places = np.stack([slide_x, slide_y, spin / contact.radius_x], axis=1)
    lookups = [table.forces(film.load, film.speed, *place)[:4] for place in places]
    off = np.array(lookups) - expected
    parts = (np.hypot(off[:, 0], off[:, 1]), np.abs(off[:, 2]), np.abs(off[:, 3]))
    unit = table.largest(film.load, film.speed) + np.array([0.0, 0.0, film.moment])
    return np.asarray(np.stack(parts, axis=1) / unit)


def _response_errors(table: TractionTable, films: Sequence[FilmSample]) -> Array:
    """Relative errors of stiffness and damping at films that have them, shape (n, 2) [-]."""
    errors = []
    for film in films:
        if film.response is None or not film.response.converged:
            continue
        found = table.forces(film.load, film.speed, 0.0, 0.0, 0.0)
        solved = film.response.stiffness.value, film.response.damping.value
        errors.append(np.abs(np.array([found.stiffness, found.damping]) / solved - 1.0))
    return np.array(errors).reshape(-1, 2)


def _checked(study: _Study, table: TractionTable) -> TableError:
    """Error at the films of the check, for motions drawn evenly in the table's coordinates, and
    for `straight_motions`.
    """
    rng, others = (np.random.default_rng(study.options.seed + k) for k in (1, 2))
    n = study.options.check_motions
    errors = []
    straight = []
    spun = []
    for film in study.checks:
        places = rng.uniform(-1.0, 1.0, (3, n))
        even = table_motions(study.contact, study.range, film, places)
        errors.append(_errors(study, table, film, even))
        rolling = straight_motions(study.contact, study.range, film.load, others, n)
        force, spin, _ = _errors(study, table, film, rolling).max(axis=0)
        straight.append(force)
        spun.append(spin)
    every = np.concatenate(errors)
    responses = _response_errors(table, study.checks)
    return TableError(
        largest=float(every[:, 0].max()),
        quantile=float(np.quantile(every[:, 0], 0.95)),
        rms=float(np.sqrt(np.mean(every[:, 0] ** 2))),
        largest_spin=float(max(every[:, 1].max(), *spun)),
        largest_rolling=float(every[:, 2].max()),
        largest_straight=float(max(straight)),
        largest_stiffness=float(responses[:, 0].max()) if len(responses) else np.nan,
        largest_damping=float(responses[:, 1].max()) if len(responses) else np.nan,
        responses=len(responses),
        films=len(study.checks),
        motions=n,
        tolerance=study.options.tolerance,
    )

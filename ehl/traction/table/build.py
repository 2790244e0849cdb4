"""Build a traction table: films over load and speed, shear over the motions, more of both until a
check is passed.

The check solves films at loads and speeds between the nodes and evaluates the shear at random
motions there: its error counts everything that the table does. Where it is too large, the axis
whose nodes are worst predicted by their neighbours gets more of them. Films are kept when the
nodes along load or speed are doubled.
"""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from math import exp, log

import numpy as np
from numpy.typing import NDArray

from ...options import SolverOptions
from ...solution import ContactSolution
from ...solver import solve_contact
from ..response import normal_response
from .film import TableFilm, table_film
from .splines import left_out_error, spline_coefficients
from .table import (
    LOAD_POWER,
    MIRROR,
    TableContact,
    TableError,
    TableRange,
    TractionTable,
    load_place,
    mirrored_seam,
    motion_of,
    spinning_scale,
    vertex_slide,
)

Array = NDArray[np.float64]

# nodes of load, speed, slide_x, slide_y (its half above zero) and spin
START = (12, 4, 41, 15, 27)
GROWTH = 1.4  # of the nodes of a motion
# of the motion where the traction has risen by half, along, across and of spin
SCALE_SHARE = (0.02, 0.04, 1.6)
# motions over the largest ones, where that slide is looked for
SCALE_SAMPLES = np.geomspace(1e-7, 1.0, 57)
RESPONSE_POINTS = 129  # of the films that stiffness and damping are taken from

ERRORS = ("largest", "quantile", "rms", "largest_spin", "largest_rolling")
Progress = Callable[[int, int, str], None]  # done, in all, what


@dataclass(frozen=True, slots=True, kw_only=True)
class TableOptions:
    """How a table is sampled.

    Attributes
    ----------
    points : int
        Of the films along x, 2^k + 1.
    tolerance : float
        Error of the force over kappa_max Q that every point of the check must keep [-].
    check_films, check_motions : int
        Films of the check, and random motions at each.
    rounds : int
        Refinements at most.
    workers : int
        Films solved at a time.
    seed : int
        Of the random places of the check.
    nodes : tuple of int
        Of load, speed, slide_x, slide_y (its half above zero) and spin to begin with, at least 4
        each.
    """

    points: int = 257
    tolerance: float = 0.01
    check_films: int = 8
    check_motions: int = 60
    rounds: int = 4
    workers: int = 1
    seed: int = 52163
    nodes: tuple[int, int, int, int, int] = START


@dataclass(frozen=True, slots=True, kw_only=True)
class _Film:
    """One solved film, ready to shear; place (ln load, ln speed)."""

    place: tuple[float, float]
    sheared: TableFilm
    scales: tuple[float, float, float]  # of slide_x/u, slide_y/u, spin R_x/u [-]
    film: float  # [m]
    moment: float  # hydrodynamic, positive [N m]
    stiffness: float | None  # [N/m]; None where the solver found no answer
    damping: float | None  # [N s/m]
    converged: bool


@dataclass(slots=True, kw_only=True)
class _Study:
    """What is known while a table grows."""

    contact: TableContact
    range: TableRange
    options: TableOptions
    progress: Progress
    counts: list[int]
    films: dict[tuple[float, float], _Film] = field(default_factory=dict)
    checks: list[_Film] = field(default_factory=list)


def build_table(
    contact: TableContact,
    limits: TableRange,
    options: TableOptions | None = None,
    progress: Progress | None = None,
) -> TractionTable:
    """Solve films and evaluate their shear until the table is as good as asked for.

    Parameters
    ----------
    contact : TableContact
    limits : TableRange
        Loads [N], speeds [m/s], motions [-].
    options : TableOptions, optional
    progress : callable, optional
        Called with films done, films wanted so far, and a word.

    Returns
    -------
    TractionTable
        Its `error` is that of the check; `converged` tells whether all films did and the tolerance
        is reached.

    Raises
    ------
    ValueError
        If a film has no usable answer: the message names load and speed.
    """
    options = options or TableOptions()
    study = _Study(
        contact=contact,
        range=limits,
        options=options,
        progress=progress or _quiet,
        counts=list(options.nodes),
    )
    _solve_checks(study)
    for _ in range(options.rounds):
        table, raw = _table(study)
        if table.error.reached:
            break
        _refine(study, raw)
    return table


def check_table(table: TractionTable, contact: TableContact, options: TableOptions) -> TableError:
    """Error of a table at films and motions not in it, for a contact at its temperature; forces
    [N], moments [N m].
    """
    study = _Study(
        contact=contact,
        range=table.range,
        options=options,
        progress=_quiet,
        counts=list(options.nodes),
    )
    _solve_checks(study)
    return _checked(study, table)


def _quiet(done: int, total: int, state: str) -> None:
    """Nobody is told."""


def _solve_checks(study: _Study) -> None:
    """Films between the nodes: a random place in each of as many cells of a Latin hypercube."""
    rng = np.random.default_rng(study.options.seed)
    n = study.options.check_films
    load, speed = (tuple(map(log, ends)) for ends in (study.range.load, study.range.speed))
    shares = (np.stack([rng.permutation(n), rng.permutation(n)]) + rng.random((2, n))) / n
    q, u = load[0] + (load[1] - load[0]) * shares[0], speed[0] + (speed[1] - speed[0]) * shares[1]
    places = [(float(one), float(other)) for one, other in zip(q, u, strict=True)]
    study.checks = _solve(study, places)


def _solve(study: _Study, places: Iterable[tuple[float, float]]) -> list[_Film]:
    """Films at places, several at a time: the kernels release the interpreter's lock."""
    wanted = list(places)
    films = []
    total = len(study.films) + len(study.checks) + len(wanted)
    with ThreadPoolExecutor(max_workers=max(1, study.options.workers)) as pool:
        for film in pool.map(lambda place: _film(study, place), wanted):
            films.append(film)
            study.progress(total - len(wanted) + len(films), total, "films")
    return films


def _film(study: _Study, place: tuple[float, float]) -> _Film:
    """Solve a film, its nodes, its scales and its answer to an approach."""
    contact = study.contact
    load = exp(place[0])
    speed = exp(place[1])
    points = study.options.points
    film = table_film(
        contact, load, speed, study.range.slide_x * speed, SolverOptions(points=points)
    )
    solution = film.solution
    assert solution.x is not None and solution.y is not None  # `table_film`

    def cold(count: int) -> ContactSolution:
        if contact.solids is None and count == points:
            return solution
        return solve_contact(contact.conditions(load, speed), SolverOptions(points=count))

    response = normal_response(cold(min(points, RESPONSE_POINTS)))
    if not response.converged and points > RESPONSE_POINTS:
        response = normal_response(cold(points))
    moment = -np.trapezoid(
        np.trapezoid(solution.pressure * solution.x[:, None], solution.y, axis=1), solution.x
    )
    return _Film(
        place=place,
        sheared=film,
        scales=_scales(study, film, speed),
        film=film.central,
        moment=float(moment),
        stiffness=response.stiffness if response.converged else None,
        damping=response.damping if response.converged else None,
        converged=solution.converged,
    )


def _scales(study: _Study, film: TableFilm, speed: float) -> tuple[float, float, float]:
    """Motions, over u or u/R_x, at a share of those where traction or spin moment has risen by
    half.
    """
    none = np.zeros(SCALE_SAMPLES.size)
    found = []
    for axis, (limit, share) in enumerate(zip(_bounds(study), SCALE_SHARE, strict=True)):
        motion = limit * SCALE_SAMPLES
        parts = [motion if axis == k else none for k in range(3)]
        values = _evaluate(study.contact, film, speed, parts)[:, axis]
        start = _evaluate(study.contact, film, speed, [none[:1]] * 3)[0, axis]
        rise = np.abs(values - start) / np.abs(values - start).max()
        k = max(int(np.argmax(rise >= 0.5)), 1)
        between = (0.5 - rise[k - 1]) / (rise[k] - rise[k - 1])
        found.append(share * float(motion[k - 1] + between * (motion[k] - motion[k - 1])))
    return found[0], found[1], found[2]


def _evaluate(contact: TableContact, film: TableFilm, speed: float, motion: list[Array]) -> Array:
    """F_x, F_y, M_n, M_y by sliding, shape (n, 4) [N], [N m], at motions over u, u and u/R_x [-]."""
    slide_x, slide_y = motion[0] * speed, motion[1] * speed
    rolling = speed / contact.radius_x - 0.5 * contact.curvature_difference * slide_x
    slide = (slide_x, slide_y, motion[2] * speed / contact.radius_x)
    return film.forces(slide, rolling, 0.5 / contact.curvature_radius)


def _axes(study: _Study) -> Array:
    """Start, nodes per unit, nodes of the five axes."""
    limits, counts = study.range, study.counts
    first = np.array([load_place(limits.load[0]), log(limits.speed[0]), -1.0, 0.0, -1.0])
    last = np.array([load_place(limits.load[1]), log(limits.speed[1]), 1.0, 1.0, 1.0])
    nodes = np.array(counts, dtype=np.float64)
    return np.stack([first, (nodes - 1.0) / (last - first), nodes], axis=1)


def axis_nodes(axis: Array) -> Array:
    """Places of an axis's nodes, shape (n,) [-]."""
    return axis[0] + np.arange(int(axis[2])) / axis[1]


def axis_loads(axis: Array) -> Array:
    """Loads at the nodes of their axis, shape (n,) [N]."""
    loads: Array = (-axis_nodes(axis)) ** (1.0 / LOAD_POWER)
    return loads


def _grid_films(study: _Study, axes: Array) -> list[list[_Film]]:
    """The films of all nodes of load and speed; those not known yet are solved."""
    loads = np.log(axis_loads(axes[0]))
    rows = [[(float(q), float(u)) for u in axis_nodes(axes[1])] for q in loads]
    keys = {place: (round(place[0], 9), round(place[1], 9)) for row in rows for place in row}
    missing = [place for place, key in keys.items() if key not in study.films]
    for film in _solve(study, missing):
        study.films[keys[film.place]] = film
    return [[study.films[keys[place]] for place in row] for row in rows]


def _table(study: _Study) -> tuple[TractionTable, Array]:
    """The table of the present nodes with its error, and its values at the nodes."""
    axes = _axes(study)
    films = _grid_films(study, axes)
    flat = [film for row in films for film in row]
    study.progress(len(study.films), len(study.films), "shear")
    with ThreadPoolExecutor(max_workers=max(1, study.options.workers)) as pool:
        blocks = list(pool.map(lambda film: _values(study, film, axes), flat))
    raw = np.array(blocks).reshape(len(films), len(films[0]), *blocks[0].shape)
    largest = _largest(raw)
    scalars = np.concatenate([_scalars(films), np.log(largest)], axis=-1)
    raw = raw / largest[..., None, None, None, [0, 0, 1, 2]]
    table = TractionTable(
        contact=study.contact,
        range=study.range,
        points=study.options.points,
        axes=axes,
        scalars=spline_coefficients(scalars, (0, 1)),
        # what a file holds of them
        values=mirrored_seam(_coefficients(raw).astype(np.float32).astype(np.float64)),
        kappa_max=float((largest[..., 0] / axis_loads(axes[0])[:, None]).max()),
        error=TableError(
            **dict.fromkeys(ERRORS, np.inf), films=0, motions=0, tolerance=study.options.tolerance
        ),
        films=len(study.films) + len(study.checks),
        converged=False,
        message="",
    )
    return _judged(study, replace(table, error=_checked(study, table))), raw


def _largest(raw: Array) -> Array:
    """Largest force, moment about n and about y of each film, shape (nQ, nU, 3), at least tiny
    [N], [N m].
    """
    motions = (2, 3, 4)
    parts = (np.hypot(raw[..., 0], raw[..., 1]), np.abs(raw[..., 2]), np.abs(raw[..., 3]))
    return np.maximum(
        np.stack([part.max(axis=motions) for part in parts], axis=-1), np.finfo(np.float64).tiny
    )


def _judged(study: _Study, table: TractionTable) -> TractionTable:
    films = [*study.films.values(), *study.checks]
    bad = sum(not film.converged for film in films)
    filled = sum(film.damping is None for film in study.films.values())
    parts = []
    if not table.error.reached:
        parts.append(
            f"error {table.error.largest:.2%} of kappa_max Q, above {table.error.tolerance:.2%}"
        )
    if bad:
        parts.append(f"{bad} of {len(films)} films did not converge")
    message = "; ".join(parts) or "converged"
    if filled:
        message += f"; stiffness and damping of {filled} of {len(films)} films are those of neighbouring loads"
    return replace(table, converged=not parts, message=message)


def _scalars(films: list[list[_Film]]) -> Array:
    """Logarithms of scales, film, hydrodynamic moment, stiffness, damping, shape (nQ, nU, 7)."""
    scalars = np.array([[(*film.scales, film.film, film.moment) for film in row] for row in films])
    answers = np.array(
        [[(film.stiffness, film.damping) for film in row] for row in films], dtype=np.float64
    )
    if scalars.min() <= 0.0:
        load, speed = (exp(part) for part in films[0][0].place)
        raise ValueError(
            f"no rolling moment in some film from {load:.4g} N and {speed:.4g} m/s on: take another range"
        )
    return np.concatenate([np.log(scalars), _filled(np.log(answers))], axis=-1)


def _filled(values: Array) -> Array:
    """Values [same unit] whose gaps along the first axis are filled in linearly, beyond the ends
    with the last one.
    """
    nodes = np.arange(values.shape[0])
    for column in np.ndindex(values.shape[1:]):
        line = values[(slice(None), *column)]
        known = np.isfinite(line)
        if not known.any():
            raise ValueError(
                "load: at one of the speeds no film has a stiffness and damping; take another range"
            )
        values[(slice(None), *column)] = np.interp(nodes, nodes[known], line[known])
    return values


def _values(study: _Study, film: _Film, axes: Array) -> Array:
    """Forces and moments of one film at the nodes of the motions, shape (nX, nY, nS, 4) [N], [N
    m].
    """
    places = np.meshgrid(*(axis_nodes(axis) for axis in axes[2:]), indexing="ij")
    forces = _evaluate(
        study.contact, film.sheared, exp(film.place[1]), _motions(study, film, places)
    )
    return forces.reshape(*places[0].shape, 4)


def _motions(study: _Study, film: _Film, places: Sequence[Array] | Array) -> list[Array]:
    """Motions over u, u and u/R_x at places on a table's axes, flat [-]."""
    (x, y, n), (bound_x, bound_y, bound_n) = (part.ravel() for part in places), _bounds(study)
    contact = study.contact
    load = exp(film.place[0])
    spin = motion_of(n, film.scales[2], bound_n)
    slide_x = motion_of(x, spinning_scale(film.scales[0], spin, contact, load), bound_x)
    return [
        slide_x - vertex_slide(spin, contact, load),
        motion_of(y, film.scales[1], bound_y),
        spin,
    ]


def _bounds(study: _Study) -> tuple[float, float, float]:
    return study.range.slide_x, study.range.slide_y, study.range.spin


def _coefficients(raw: Array) -> Array:
    """Spline coefficients of values; along slide_y with their mirror image, of which the half
    above zero is kept.
    """
    whole = spline_coefficients(_mirrored(raw), (0, 1, 2, 3, 4))
    return np.ascontiguousarray(whole[:, :, :, raw.shape[3] - 1 :])


def _mirrored(raw: Array) -> Array:
    """Values with their mirror image at slide_y below zero: F_y and M_n change sign with slide_y
    and spin [-].
    """
    return np.concatenate([raw[:, :, :, :0:-1, ::-1] * np.array(MIRROR), raw], axis=3)


def _checked(study: _Study, table: TractionTable) -> TableError:
    """Error at the films of the check, for motions drawn evenly in the table's coordinates."""
    rng = np.random.default_rng(study.options.seed + 1)
    n = study.options.check_motions
    contact = study.contact
    errors = []
    for film in study.checks:
        load, speed = exp(film.place[0]), exp(film.place[1])
        motion = _motions(study, film, rng.uniform(-1.0, 1.0, (3, n)))
        wanted = _evaluate(contact, film.sheared, speed, motion)
        wanted[:, 0] -= 0.5 * contact.curvature_difference * film.moment
        wanted[:, 3] -= film.moment
        parts = np.stack(
            [motion[0] * speed, motion[1] * speed, motion[2] * speed / contact.radius_x], axis=1
        )
        off = np.array([table.forces(load, speed, *part)[:4] for part in parts]) - wanted
        unit = table.largest(load, speed) + np.array([0.0, 0.0, film.moment])
        errors.append(
            np.stack(
                [np.hypot(off[:, 0], off[:, 1]), np.abs(off[:, 2]), np.abs(off[:, 3])], axis=1
            )
            / unit
        )
    every = np.concatenate(errors)
    return TableError(
        largest=float(every[:, 0].max()),
        quantile=float(np.quantile(every[:, 0], 0.95)),
        rms=float(np.sqrt(np.mean(every[:, 0] ** 2))),
        largest_spin=float(every[:, 1].max()),
        largest_rolling=float(every[:, 2].max()),
        films=len(study.checks),
        motions=n,
        tolerance=study.options.tolerance,
    )


def _refine(study: _Study, raw: Array) -> None:
    """More nodes on the axis whose values are worst predicted by their neighbours."""
    mirrored = _mirrored(raw)[..., :2]
    errors = [left_out_error(mirrored, axis) for axis in range(5)]
    axis = int(np.argmax(errors))
    n = study.counts[axis]
    study.counts[axis] = 2 * n - 1 if axis < 2 else int(np.ceil(GROWTH * n))

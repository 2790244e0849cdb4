"""Build a traction table: films over load and speed, shear over the motions, more of both until a
check is passed.

The check solves films at loads and speeds between the nodes, random ones and those where the
splines are most in doubt, and evaluates the shear at random motions there: its error counts
everything that the table does. Where it is too large, the axis
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
from .check import adaptive_check_points, check_points, response_message, table_error
from .film import FilmSample, film_sample
from .packing import mirrored, stored_values
from .responses import Place, log_responses, response_nodes
from .splines import leave_one_out_error, spline_coefficients
from .table import TableContact, TableError, TableRange, TractionTable, load_coordinate
from .values import grid_values

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


def build_table(
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

    >>> from ehl import Lubricant
    >>> from ehl.oil.rheology import Rheology, ShearLaw
    >>> from ehl.traction.table.atlas_film import atlas_sampler
    >>> from ehl.traction.table.film import film_sample
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
    >>> table = build_table(contact, limits, options)
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

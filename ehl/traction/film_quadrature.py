"""Quadrature over a solved film, and its sliding forces for many motions.

Where the pressure is high: lines across the contact and Gauss-Legendre points along each, their
fields interpolated onto more strips, close together in the middle. Elsewhere: blocks of the grid.

Across a strip of width w the sliding along x changes by c = w ds_x/dy, and under a stress tau that
hardly changes with it, as those near their limit, the means of the traction's parts are

    tau s_x/m,   tau s_y g/m,   m = (|s|_1 + |s|_2)/2,   g = artanh(z)/z,   z = c/(2 m),

m that of the sliding at both sides, exactly; tau is taken at m. So a strip in which the sliding
changes its sign passes from one direction to the other steadily. For g stands the second
convergent of its continued fraction, (15 - 4 z^2)/(15 - 9 z^2), finite where g is not, at z = 1.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array
from ..oil.lubricant import Lubricant
from ..oil.rheology import Rheology, kernel_rheology, limiting_stress
from ..solution import ContactSolution
from . import _kernels
from ._spline_kernels import COLUMNS
from .shear import (
    Cavitation,
    bounded_viscosity,
    dimensional_conditions,
    dimensional_grid,
    sheared_width,
    solution_rheology,
    with_outlet,
)

HIGH_PRESSURE = 0.02  # of the largest pressure: what lies above it gets lines
LINES = 64  # along x there, of a film that is stored
# strips over which the shear is summed, of a line, and the width of the middle ones over the mean:
# there the sliding of rolling without spin changes most slowly; 96 of 64 lines
STRIPS_OF_LINE = 1.5
MIDDLE = 0.3
# panels of a line: start and end from edge to edge, points; the spike is in the last
PANELS = ((0.0, 0.75, 10), (0.75, 1.0, 14))
SMALLEST_FILM = 1e-12  # [m] below the size of any molecule: bound of films that did not converge
BLOCKS = 26  # of the grid's nodes along x and y, each of which becomes one node elsewhere


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmQuadrature:
    """Nodes of a film: place, area, film, viscosity, limiting stress.

    The rows of `nodes` are x, y [m], area times sheared width [m^2], film [m], viscosity [Pa s],
    limiting stress [Pa], and a twelfth of the squared size along x and y [m^2]. The first stand on
    strips, along each from one edge to the other.
    """

    nodes: Array  # shape (8, n)
    half_width: float  # transverse semi-axis, beyond which curvature slip does not grow [m]
    rheology: Rheology  # shear law with the stresses of the contact
    strips: int = 0  # strips of `line_quadrature` each, which the first nodes stand on

    def parts(self) -> tuple[Array, Array]:
        """Nodes of the strips, shape (8, strips, n), and all others, shape (8, m)."""
        each = line_quadrature()[0].size
        first, others = np.split(self.nodes, [self.strips * each], axis=1)
        return first.reshape(first.shape[0], self.strips, each), others


def film_quadrature(
    solution: ContactSolution, rheology: Rheology, *, temperature: float | None = None
) -> FilmQuadrature:
    """Build the nodes of a film of dimensional conditions for its shear.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    rheology : Rheology
        shear law of the oil
    temperature : float | None, optional
        temperature of the film, for the limiting stress; None: that of the rheology [K]

    Returns
    -------
    FilmQuadrature
        nodes of the film

    Raises
    ------
    ValueError
        if the conditions have no dimensions
    """
    rheology = solution_rheology(solution, rheology)
    fields = hertz_zone(solution).fields, low_pressure_blocks(with_outlet(solution))
    oil = dimensional_conditions(solution).lubricant
    return zone_quadrature(transverse_axis(solution), fields, oil, rheology, temperature)


def transverse_axis(solution: ContactSolution) -> float:
    """Give the transverse semi-axis of Hertz' ellipse.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    float
        semi-axis across the entrainment [m]
    """
    return float(solution.semi_axis_x or 0.0) * solution.semi_axis_ratio


def zone_quadrature(
    half_width: float,
    fields: tuple[Array, Array],
    oil: Lubricant,
    rheology: Rheology,
    temperature: float | None,
) -> FilmQuadrature:
    """Build the nodes of a film from the fields of its zones of high and of low pressure.

    Parameters
    ----------
    half_width : float
        transverse semi-axis of the ellipse [m]
    fields : tuple[Array, Array]
        `HertzZone.fields`, shape (7, lines, n), and nodes of low pressure, shape (7, m)
    oil : Lubricant
        lubricant
    rheology : Rheology
        shear law of the oil, with the stresses of the contact
    temperature : float | None
        temperature of the film, for the limiting stress [K]

    Returns
    -------
    FilmQuadrature
        nodes of the film
    """
    strips = strip_fields(fields[0])
    every = np.concatenate([strips.reshape(7, -1), fields[1]], axis=1)
    nodes = node_rows(every, bounded_viscosity(every[4], oil), rheology, temperature)
    return FilmQuadrature(
        nodes=nodes, half_width=half_width, rheology=rheology, strips=strips.shape[1]
    )


def node_rows(
    fields: Array, viscosity: Array, rheology: Rheology, temperature: Array | float | None
) -> Array:
    """Convert rows of `HertzZone.fields` to those of `FilmQuadrature.nodes`.

    Parameters
    ----------
    fields : Array
        rows of `HertzZone.fields`, shape (7, n)
    viscosity : Array
        dynamic viscosity at the nodes, shape (n,) [Pa s]
    rheology : Rheology
        shear law of the oil, with the stresses of the contact
    temperature : Array | float | None
        temperature of the nodes, for the limiting stress [K]

    Returns
    -------
    Array
        rows of `FilmQuadrature.nodes`, shape (8, n)
    """
    x, y, area, gap, pressure, width, breadth = fields
    film = np.maximum(gap, SMALLEST_FILM)
    limit = np.broadcast_to(limiting_stress(pressure, rheology, temperature), x.shape)
    return np.stack([x, y, area, film, viscosity, limit, width**2 / 12.0, breadth**2 / 12.0])


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzZone:
    """Nodes where the pressure is high, on lines along x.

    The rows of `fields` are x, y [m], area [m^2], film [m], pressure [Pa], size along x and y [m].
    """

    fields: Array  # shape (7, lines, n)
    gradient: Array  # of the pressure along x and y, shape (2, lines, n) [Pa/m]
    span: Array  # length of each line from edge to edge, shape (lines,) [m]
    shares: Array  # places of the nodes from edge to edge, shape (n,) [-]


def hertz_zone(solution: ContactSolution) -> HertzZone:
    """Place lines across the zone of high pressure, and Gauss-Legendre points of `PANELS` along
    each.

    Parameters
    ----------
    solution : ContactSolution
        solved contact of dimensional conditions

    Returns
    -------
    HertzZone
        nodes with film and pressure, from edge to edge
    """
    # 1. splines of film and pressure over the part of the grid where the pressure is high
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    edge_pressure = HIGH_PRESSURE * p.max()
    high = p > edge_pressure
    window = tuple(_index_window(high.any(axis=1 - axis)) for axis in (0, 1))
    x, y = x[window[0]], y[window[1]]
    film = scipy.interpolate.RectBivariateSpline(x, y, h[window])
    pressure = scipy.interpolate.RectBivariateSpline(x, y, p[window])
    # 2. lines across, and the edges of each
    ends = _crossings(y, p[window].max(axis=0) - edge_pressure)
    width = (ends[1] - ends[0]) / LINES
    rows = ends[0] + (np.arange(LINES) + 0.5) * width
    edges = np.array([_crossings(x, line) for line in (pressure(x, rows) - edge_pressure).T])
    # 3. nodes along each
    shares, weights = line_quadrature()
    span = (edges[:, 1] - edges[:, 0])[:, None]
    along = edges[:, :1] + span * shares
    across = np.broadcast_to(rows[:, None], along.shape)
    size = span * weights
    place = (along, across)
    p = np.maximum(pressure(*place, grid=False), 0.0)
    fields = (*place, size * width, film(*place, grid=False), p, size, np.full_like(along, width))
    slopes = (pressure(*place, dx=1, grid=False), pressure(*place, dy=1, grid=False))
    return HertzZone(
        fields=np.stack(fields), gradient=np.stack(slopes), span=span[:, 0], shares=shares
    )


def strip_fields(fields: Array) -> Array:
    """Interpolate the fields of lines to strips.

    Parameters
    ----------
    fields : Array
        rows of `HertzZone.fields` on lines, shape (7, lines, n)

    Returns
    -------
    Array
        the rows on strips, shape (7, strips, n)
    """
    x, y, _, film, pressure, size, width = fields
    y, width = strip_positions(y, width)
    x, film, pressure, size = (on_strips(values) for values in (x, film, pressure, size))
    return np.stack([x, y, size * width, film, np.maximum(pressure, 0.0), size, width])


def strip_positions(y: Array, width: Array) -> tuple[Array, Array]:
    """Place strips over the same nodes as lines.

    Parameters
    ----------
    y : Array
        middles of the lines, shape (lines, n) [m]
    width : Array
        widths of the lines, shape (lines, n) [m]

    Returns
    -------
    middles
        middles of the strips, shape (strips, n) [m]
    widths
        widths of the strips, shape (strips, n) [m]
    """
    edges = _strip_edges(y.shape[0])
    half = 0.5 * y.shape[0] * width[:1]
    middle = 0.5 * (y[:1] + y[-1:])
    positions = middle + half * (0.5 * (edges[1:] + edges[:-1]))[:, None]
    width = half * np.diff(edges)[:, None]
    return positions, np.broadcast_to(width, positions.shape)


def on_strips(values: Array) -> Array:
    """Interpolate values of lines to the middles of strips, by cubic splines.

    Parameters
    ----------
    values : Array
        values of the lines, shape (lines, ...) [any unit]

    Returns
    -------
    Array
        values of the strips, shape (strips, ...) [same unit]
    """
    return np.tensordot(_strip_weights(values.shape[0]), values, axes=1)


@cache
def _strip_edges(lines: int) -> Array:
    """Place the edges of the strips of lines over [-1, 1], shape (strips + 1,): cubic in their
    number [-].
    """
    even = np.linspace(-1.0, 1.0, round(STRIPS_OF_LINE * lines) + 1)
    return np.asarray(even * (MIDDLE + (1.0 - MIDDLE) * even**2))


@cache
def _strip_weights(lines: int) -> Array:
    """Interpolate equidistant lines to the middles of their strips, shape (strips, lines) [-]."""
    edges = _strip_edges(lines)
    positions = (np.arange(lines) + 0.5) * (2.0 / lines) - 1.0
    wanted = np.clip(0.5 * (edges[1:] + edges[:-1]), positions[0], positions[-1])
    return np.asarray(scipy.interpolate.CubicSpline(positions, np.eye(lines))(wanted))


@cache
def line_quadrature() -> tuple[Array, Array]:
    """Places of a line's nodes from edge to edge and their weights, each of shape (n,) [-]."""
    positions: list[float] = []
    weights: list[float] = []
    for low, high, count in PANELS:
        nodes, panel_weights = np.polynomial.legendre.leggauss(count)
        positions.extend(low + 0.5 * (high - low) * (nodes + 1.0))
        weights.extend(0.5 * (high - low) * panel_weights)
    return np.array(positions), np.array(weights)


def _index_window(chosen: NDArray[np.bool_]) -> slice:
    """From a few nodes before the first chosen one to a few after the last."""
    indices = np.flatnonzero(chosen)
    return slice(max(int(indices[0]) - 3, 0), int(indices[-1]) + 4)


def _crossings(places: Array, values: Array) -> tuple[float, float]:
    """First and last zero of values interpolated linearly; the ends where there is none."""
    positive = np.flatnonzero(values > 0.0)
    if positive.size == 0:
        return float(places[values.argmax()]), float(places[values.argmax()])
    ends = []
    for inside, outside in ((positive[0], positive[0] - 1), (positive[-1], positive[-1] + 1)):
        end = float(places[inside])
        if 0 <= outside < places.size:
            drop = values[inside] - values[outside]
            end += float((places[outside] - places[inside]) * values[inside] / drop)
        ends.append(end)
    return ends[0], ends[1]


def low_pressure_blocks(solution: ContactSolution, *further: Array) -> Array:
    """Collect nodes of low pressure in blocks of the grid.

    Blocks shear a Newtonian oil as all their nodes do under linear sliding: film A/sum(A/h);
    position, pressure and further fields weighted by A/h. Blocks of a grid that is symmetric are
    so, too: else sliding along had a moment about n.

    Parameters
    ----------
    solution : ContactSolution
        solved contact of dimensional conditions
    *further : Array
        further fields, each of shape (nx, ny) [any unit]

    Returns
    -------
    Array
        rows as `HertzZone.fields`, and one for each further field, shape (7 + k, n)
    """
    x, y, h = dimensional_grid(solution)
    p = solution.pressure
    low = p <= HIGH_PRESSURE * p.max()
    size_x = np.gradient(x)[:, None]
    size_y = np.gradient(y)[None, :]
    area = size_x * size_y * sheared_width(h, p, Cavitation.STRIATED) * low
    along, across = _blocks(x.size), _blocks(y.size)
    block = np.add.outer(along * (across[-1] + 1), across).ravel()

    def total(values: Array) -> Array:
        sums: Array = np.bincount(block, values.ravel()).astype(np.float64)
        return sums

    by_film = area / np.maximum(h, SMALLEST_FILM)
    used = total(area) > 0.0
    sheared = total(area)[used]
    weight = total(by_film)[used]
    every = (x[:, None], y[None, :], p, *further)
    means = [total(by_film * field)[used] / weight for field in every]
    sizes = [np.full(weight.size, float(size.sum()) / BLOCKS) for size in (size_x, size_y)]
    return np.stack([*means[:2], sheared, sheared / weight, means[2], *sizes, *means[3:]])


def _blocks(nodes: int) -> NDArray[np.int_]:
    """Number of the block of each node of an axis, the same from either end, shape (n,)."""
    from_middle = np.arange(nodes) - 0.5 * (nodes - 1)
    number = np.rint(from_middle * (BLOCKS / nodes)).astype(int)
    return np.asarray(number - number[0])


def sliding_forces(
    film: FilmQuadrature, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """Sum the forces and moments of sliding on body 1 for many motions.

    Parameters
    ----------
    film : FilmQuadrature
        nodes of the film
    slide : tuple[Array, Array, Array]
        slide_x and slide_y [m/s], and spin [rad/s], each of shape (n,)
    rolling : Array
        relative rolling speed, shape (n,) [rad/s]
    curvature : float
        1/(2R) of the loaded surface across the entrainment [1/m]

    Returns
    -------
    Array
        F_x, F_y [N], M_n and M_y [N m], shape (n, 4)
    """
    out = np.zeros((slide[0].size, COLUMNS))
    law = kernel_rheology(film.rheology)[:4]
    surface = (curvature, film.half_width)
    _kernels.sliding_sums_many(film.nodes, law, (*slide, rolling), surface, out)
    return out

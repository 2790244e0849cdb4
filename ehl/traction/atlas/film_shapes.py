"""Pressure and film of many contacts at few places, for their friction without a solve.

The vector of `fields` is linear in the amplitudes of its modes until its pressure is made to carry
the load, so modes interpolated once to fewer lines and places give fields there directly.

A contact outside the range of the fields has those of the nearest place inside it, over its own
Hertz pressure, semi-axes and central film: so friction goes on without a step, and what it is
worth there is judged by solved films (`docs/theory/film_atlas.md`).

Contacts lighter than those are nearly rigid, and alike: pressure and film over the central one
h_c are functions of x/sqrt(R_x h_c) and y/sqrt(R_x h_c), the pressure in proportion to the load
over R_x h_c. So theirs are stretched by s = sqrt(H_c/H_c'), H in a^2/R_x, ' of the nearest place.
"""

from collections.abc import Sequence
from functools import cache
from math import pi, prod
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from ...arrays import Array, lagrange_weights
from ...conditions import ContactConditions
from ..film_quadrature import HIGH_PRESSURE, LINES, PANELS, line_quadrature
from .fields import CELL_ROWS, CELLS, FILE, HALF, LIGHT_FILE, amplitudes, field_table, layout
from .films import oil_numbers
from .oils import inlet_oil
from .table import heavy_weight

HALF_LINES = 12  # on one side of the middle, all of one width
PLACES = 14  # of Gauss' rule from edge to edge of each line
# ranges of A, L, D, alpha [1/Pa] and z of the solved contacts
BOX = ((2.8, 160.0), (1.0, 30.0), (0.01, 1.0), (1e-8, 3e-8), (0.4, 0.8))
PLACE = len(BOX) + 1  # numbers of a place [-]
SEAM = (11.0, 15.0)  # of A, between which the table of light contacts goes over into the other


class FilmShapes(NamedTuple):
    """Fields of n contacts: nodes of high pressure (5, n, m), and those around them, (5, n, k).

    The rows are x over the semi-axis along rolling, y over that across, area over both, pressure
    over Hertz', and film over the central one, of those around over a^2/Rx.
    """

    zone: Array  # nodes of high pressure, shape (5, n, m)
    around: Array  # nodes around them, shape (5, n, k)


class _Parts(NamedTuple):
    """Components of vectors (k, ...), on lines of one half."""

    half_width: Array  # (k,)
    first: Array  # (k, lines)
    span: Array
    pressure: Array  # (k, lines, places)
    film: Array  # ln(H A)
    central: Array  # (k, places) of the middle line: ln(H A)
    middle: Array  # (k, 2) its first edge and its span
    cells: Array  # (k, 7, cells)
    load: Array  # (k,)
    shear: Array


# shapes of the components of one vector
SHAPES = (
    *((), (HALF_LINES,), (HALF_LINES,)),
    *((HALF_LINES, PLACES), (HALF_LINES, PLACES), (PLACES,), (2,)),
    *((CELL_ROWS, CELLS), (), ()),
)
SIZES = tuple(prod(shape) for shape in SHAPES)


def shape_coordinates(contacts: Sequence[ContactConditions], semi_axes: Array) -> Array:
    """Locate contacts of one oil in the table of shapes.

    Parameters
    ----------
    contacts : Sequence[ContactConditions]
        contacts of one oil
    semi_axes : Array
        Hertz' semi-axes along rolling, shape (n,) [m]

    Returns
    -------
    Array
        ln A, sqrt L, ln D [-], alpha [1/Pa], z [-], and whether they are lighter, shape (n, 6)
    """
    oil = contacts[0].lubricant
    alpha, z = oil_numbers(oil)
    counted = 0.0
    if oil.piezoviscous:
        alpha, z, _ = inlet_oil(oil)
        counted = alpha
    moduli, along, across, speeds = np.array([
        (c.reduced_modulus, c.radius_x, c.radius_y, c.entrainment_speed) for c in contacts
    ]).T  # fmt: skip
    twice = 2.0 * oil.viscosity * speeds / (moduli * along)
    groups = (semi_axes**2 / (along**2 * np.sqrt(twice)), counted * moduli * twice**0.25)
    values = (*groups, along / across, np.full_like(along, alpha), np.full_like(along, z))
    load, thick, ratio, *rest = (
        np.clip(value, *limits) for value, limits in zip(values, BOX, strict=True)
    )
    light = (groups[0] < load).astype(np.float64)
    return np.stack([np.log(load), np.sqrt(thick), np.log(ratio), *rest, light], axis=1)


def film_shapes(places: Array, central: Array) -> FilmShapes:
    """Evaluate pressure and film of contacts at few nodes.

    Parameters
    ----------
    places : Array
        columns of `shape_coordinates`, shape (n, 6)
    central : Array
        central films over a^2/Rx, shape (n,) [-]

    Returns
    -------
    FilmShapes
        fields of the contacts
    """
    heavy = heavy_weight(places[:, 0], SEAM)[0]
    vectors = np.zeros((len(places), sum(SIZES)))
    for path, fraction in ((LIGHT_FILE, 1.0 - heavy), (FILE, heavy)):
        some = fraction > 0.0
        if some.any():
            vectors[some] += fraction[some, None] * _vectors(path, places[some])
    components = _split(vectors)
    load = np.exp(places[:, 0])
    # s^2
    wider = np.where(
        places[:, PLACE - 1] > 0.0, central * load * np.exp(-_central(components)), 1.0
    )
    zone = _stretched(_zone(components), wider)
    around = _stretched(_around(components, load), wider)
    around[4] *= wider[:, None]
    return FilmShapes(zone=_mirrored(zone), around=_mirrored(around))


def _stretched(half: Array, wider: Array) -> Array:
    """Nodes (5, n, m) farther out, by the square root of a factor (n,), with as much load [-]."""
    farther = np.sqrt(wider)
    half *= np.stack([farther, farther, wider, 1.0 / wider, np.ones_like(wider)])[..., None]
    return half


def _vectors(path: Path, places: Array) -> Array:
    """By one table."""
    known = _few_modes(path)
    weights = amplitudes(places[:, :3], places[:, 3], places[:, 4], field_table(path))
    return np.asarray(known[0] + weights @ known[1:])


def _zone(components: _Parts) -> Array:
    """Nodes of high pressure of one half, shape (5, n, m)."""
    fractions, weights = _gauss()
    width = components.half_width / HALF_LINES
    x = components.first[..., None] + components.span[..., None] * fractions
    lines = np.arange(HALF_LINES) + 0.5
    y = np.broadcast_to((width[:, None] * lines)[..., None], x.shape)
    area = components.span[..., None] * weights * width[:, None, None]
    # pressure that carries the load, whose share in the zone is known
    carried = 2.0 * (area * components.pressure).sum(axis=(1, 2)) / (2.0 * pi / 3.0)
    pressure = np.maximum(components.pressure, 0.0) * (components.load / carried)[:, None, None]
    film = np.exp(components.film - _central(components)[:, None, None])
    return np.stack([x, y, area, pressure, film]).reshape(5, x.shape[0], -1)


def _central(components: _Parts) -> Array:
    """ln(H A) at the middle of contacts, shape (n,)."""
    fractions = _gauss()[0]
    centre = np.clip(
        -components.middle[:, 0] / components.middle[:, 1], fractions[0], fractions[-1]
    )
    weights = lagrange_weights(np.broadcast_to(fractions, (centre.size, fractions.size)), centre)
    return np.asarray((weights * components.central).sum(axis=1))


def _around(components: _Parts, load: Array) -> Array:
    """Cells around of one half, shape (5, n, k), each as two nodes as far apart as the oil of the
    cell is spread; those without oil have no area.
    """
    area, by_film, pressure, along, across, spread_x, spread_y = components.cells.swapaxes(0, 1)
    sheared = np.minimum(area, by_film) > 0.0
    whole = np.where(sheared, by_film, 0.0).sum(axis=1)
    film = np.where(sheared, area / np.where(sheared, by_film, 1.0), 1.0)
    # half of a cell's area, on one side of the middle, and in one of its nodes
    size = np.where(sheared, 0.25 * area, 0.0) * (np.exp(components.shear) / whole)[:, None]
    p = np.clip(pressure, 0.0, HIGH_PRESSURE)
    x, y = np.sqrt(np.maximum(spread_x, 0.0)), np.sqrt(np.maximum(spread_y, 0.0))
    rest = (size, p, film / load[:, None])
    nodes = [np.stack([along + s * x, across + s * y, *rest]) for s in (-1.0, 1.0)]
    return np.concatenate(nodes, axis=2)


def _mirrored(half: Array) -> Array:
    """Nodes on both sides of the middle."""
    other = half.copy()
    other[1] = -other[1]
    return np.concatenate([half, other], axis=2)


@cache
def _gauss() -> tuple[Array, Array]:
    """Places on a line from edge to edge and their weights [-]."""
    nodes, weights = np.polynomial.legendre.leggauss(PLACES)
    return 0.5 * (nodes + 1.0), 0.5 * weights


@cache
def _few_modes(path: Path) -> Array:
    """Mean and modes of the vector at the few places, one beside the other, shape (1 + k, m)."""
    known = field_table(path)
    vectors = np.concatenate([known.mean[None], known.modes])
    parts = layout()
    lines = _line_weights()
    along = _along_weights()

    def on_lines(part: slice) -> Array:
        return vectors[:, part] @ lines.T

    def at_places(part: slice) -> Array:
        known = vectors[:, part].reshape(len(vectors), HALF, -1)
        return np.einsum("ij,kjn,mn->kim", lines, known, along, optimize=True)

    first, pressure, film = on_lines(parts.first), at_places(parts.pressure), at_places(parts.film)
    span = on_lines(parts.last) - first
    few = _Parts(
        half_width=vectors[:, parts.half_width],
        first=first[:, 1:],
        span=span[:, 1:],
        pressure=pressure[:, 1:],
        film=film[:, 1:],
        central=film[:, 0],
        middle=np.stack([first[:, 0], span[:, 0]], axis=1),
        cells=vectors[:, parts.cells],
        load=vectors[:, parts.load],
        shear=vectors[:, parts.shear],
    )
    return np.concatenate([part.reshape(len(vectors), -1) for part in few], axis=1)


def _split(vectors: Array) -> _Parts:
    """Parts of vectors as `_few_modes` puts them together."""
    parts = np.split(vectors, np.cumsum(SIZES)[:-1], axis=1)
    shaped = (part.reshape(-1, *shape) for part, shape in zip(parts, SHAPES, strict=True))
    return _Parts(*shaped)


def _line_weights() -> Array:
    """Interpolate the lines of the table's half to the middle and to the few lines, by cubic
    splines over both halves, shape (1 + HALF_LINES, HALF) [-].
    """
    positions = (np.arange(LINES) + 0.5) * (2.0 / LINES) - 1.0
    wanted = np.concatenate([[0.0], (np.arange(HALF_LINES) + 0.5) / HALF_LINES])
    whole = scipy.interpolate.CubicSpline(positions, np.eye(LINES))(
        np.minimum(wanted, positions[-1])
    )
    return np.asarray(whole[:, HALF:] + whole[:, :HALF][:, ::-1])


def _along_weights() -> Array:
    """Interpolate the table's nodes to the few of a line, by the polynomials of its panels, shape
    (PLACES, n) [-].
    """
    table_nodes, wanted = line_quadrature()[0], _gauss()[0]
    weights = np.zeros((wanted.size, table_nodes.size))
    start = 0
    for low, high, count in PANELS:
        inside = (low <= wanted) & (wanted < high)
        panel = table_nodes[start : start + count]
        panels = np.broadcast_to(panel, (int(inside.sum()), count))
        weights[inside, start : start + count] = lagrange_weights(panels, wanted[inside])
        start += count
    return weights

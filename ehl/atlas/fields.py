"""Pressure and film over the ellipse of flooded contacts from a table of solved ones, for traction
without a solve: of one contact at all nodes, of many at few places.

Tabulated are the nodes that a traction table shears (`film_quadrature`): 64 lines, the edges of
the zone of high pressure on each, pressure and film at 24 places from edge to edge, so that the
spike stands at nearly the same place of its line in every contact; and what lies around that zone,
in 45 cells of elliptical rings and sectors. All of it over Hertz' pressure and semi-axes and, of
films, a^2/Rx/A, is one vector of solved contacts, of which the first principal modes stay. Their
amplitudes are Gaussian processes in (ln A, sqrt L, ln D), A as in `table`, with Matern's kernel of
5/2, plus sqrt L times terms of the oil, whose coefficients are such processes, too. At last the
pressure is scaled so that it carries the load. Fitted by `tools/atlas/fields.py`.

The vector is linear in the amplitudes of its modes until its pressure is made to carry the load,
so modes interpolated once to fewer lines and places give the fields of many contacts there
directly (`film_shapes`).

A contact outside the range of the fields has those of the nearest place inside it, over its own
Hertz pressure, semi-axes and central film: so friction goes on without a step, and what it is
worth there is judged by solved films (`docs/theory/film_atlas.md`).

Contacts lighter than those are nearly rigid, and alike: pressure and film over the central one
h_c are functions of x/sqrt(R_x h_c) and y/sqrt(R_x h_c), the pressure in proportion to the load
over R_x h_c. So theirs are stretched by s = sqrt(H_c/H_c'), H in a^2/R_x, ' of the nearest place.
"""

from collections.abc import Sequence
from functools import cache
from math import exp, log, pi, prod, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy

from ..arrays import Array, lagrange_weights, radial, trend_terms
from ..conditions import ContactConditions
from ..data_files import read_arrays
from ..oil.lubricant import DensityLaw, Lubricant, ViscosityLaw
from ..scaling import scale_contact
from ..traction.film_quadrature import HIGH_PRESSURE, LINES, PANELS, line_quadrature
from .films import NotInAtlasError, atlas_load, oil_numbers, require_covered, require_range, skewed
from .oils import inlet_oil
from .table import heavy_weight, oil_features

FILE = Path(__file__).parent / "fields.npz"
LIGHT_FILE = Path(__file__).parent / "fields_light.npz"  # of light contacts, for friction alone
# ranges of A, L, D, Roelands' z [-] and alpha [1/Pa] between which tables were validated; draws
# aimed at the regions outside the labels' L and D, and at large L below a least A, were off by up
# to 3 %
RANGE = {
    "A = a^2/(Rx^2 sqrt(2U))": (15.0, 160.0),
    "L": (3.0, 30.0),
    "Rx/Ry": (0.02, 1.0),
    "roelands_z": (0.4, 0.8),
    "pressure_viscosity": (1e-8, 3e-8),
}
LARGE_L = 20.0  # beyond which A reaches from `MIN_A_AT_LARGE_L` on
MIN_A_AT_LARGE_L = 27.0
HALF = LINES // 2  # lines on one side of the middle
# radii of the rings of cells, over the ellipse's, and sectors of half a turn
RINGS = (0.0, 1.12, 1.25, 1.5, 2.2, np.inf)
SECTORS = 9
CELLS = (len(RINGS) - 1) * SECTORS
# rows of a cell: area, area over film, and means with the latter as weight: pressure, place,
# spread
CELL_ROWS = 7
# prior deviations of the amplitudes over theirs: radial functions, trend, terms of the oil
DEVIATION = 0.3
TREND = 5.0
OIL = 0.1
# centre of positions in the oil's terms
CENTRE = np.array([2.5, 2.5, -2.5])
SPREAD = np.array([1.2, 1.5, 1.5])

HALF_LINES = 12  # on one side of the middle, all of one width
PLACES = 14  # of Gauss' rule from edge to edge of each line
# ranges of A, L, D, alpha [1/Pa] and z of the solved contacts
BOX = ((2.8, 160.0), (1.0, 30.0), (0.01, 1.0), (1e-8, 3e-8), (0.4, 0.8))
PLACE = len(BOX) + 1  # numbers of a place [-]
SEAM = (11.0, 15.0)  # of A, between which the table of light contacts goes over into the other

# shapes of the components of one vector
SHAPES = (
    *((), (HALF_LINES,), (HALF_LINES,)),
    *((HALF_LINES, PLACES), (HALF_LINES, PLACES), (PLACES,), (2,)),
    *((CELL_ROWS, CELLS), (), ()),
)
SIZES = tuple(prod(shape) for shape in SHAPES)


class FieldTable(NamedTuple):
    """Contents of the file [-]."""

    places: Array  # (n, 3) ln A, sqrt L, ln D of the contacts
    oils: Array  # (n, 5) their `oil_features`
    scales: Array  # (3,) of the radial functions
    mean: Array  # (m,) vector
    modes: Array  # (k, m)
    trend: Array  # (10, k)
    weights: Array  # (n, k)


class ContactFields(NamedTuple):
    """A contact's fields [-]."""

    zone: Array  # (7, lines, nodes) as `HertzZone.fields`, SI
    cells: Array  # (7, n) likewise, of low pressure: `low_pressure_blocks`
    damping: float  # -dF/d(dh_0/dt) of slow movement [N s/m]


class Layout(NamedTuple):
    """Parts of a vector."""

    half_width: slice  # of the zone across
    first: slice  # edge of each line on the side of the inlet
    last: slice  # edge on the side of the outlet
    pressure: slice  # over Hertz' pressure
    film: slice  # ln(H A)
    cells: slice  # rows of the cells of low pressure
    load: slice  # share of the load that the zone carries
    damping: slice  # ln(c u_m/(p_h a Rx))
    shear: slice  # ln of the area over film of all cells together


def layout() -> Layout:
    """Parts of a vector."""
    nodes = HALF * line_quadrature()[0].size
    sizes = (1, HALF, HALF, nodes, nodes, CELL_ROWS * CELLS, 1, 1, 1)
    ends = np.cumsum((0, *sizes))
    return Layout(*(slice(int(a), int(b)) for a, b in zip(ends[:-1], ends[1:], strict=True)))


@cache
def field_table(path: Path = FILE) -> FieldTable:
    """Read a table of fields, once.

    Parameters
    ----------
    path : Path, default FILE
        file of the table

    Returns
    -------
    FieldTable
        the table
    """
    file = read_arrays(path)
    return FieldTable(**{name: file[name].astype(float) for name in FieldTable._fields})


def kernel(x: Array, oils: Array, y: Array, others: Array, scales: Array) -> Array:
    """Evaluate the covariance of amplitudes between contacts, without the trend.

    Parameters
    ----------
    x : Array
        positions of the first contacts, shape (m, 3) [-]
    oils : Array
        `oil_features` of the first, shape (m, 5) [-]
    y : Array
        positions of the second contacts, shape (n, 3) [-]
    others : Array
        `oil_features` of the second, shape (n, 5) [-]
    scales : Array
        scales of the radial functions, shape (3,) [-]

    Returns
    -------
    Array
        covariance, shape (m, n) [-]
    """
    radial_terms = radial(x, y, scales)
    with_linear_terms = 1.0 + ((x - CENTRE) / SPREAD) @ ((y - CENTRE) / SPREAD).T
    return DEVIATION**2 * radial_terms + OIL**2 * (oils @ others.T) * (
        with_linear_terms + radial_terms
    )


def amplitudes(x: Array, alpha: Array, z: Array, tabulated: FieldTable) -> Array:
    """Evaluate the amplitudes of the modes.

    Parameters
    ----------
    x : Array
        positions of contacts, shape (m, 3) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]
    tabulated : FieldTable
        table of fields

    Returns
    -------
    Array
        amplitudes, shape (m, k) [-]
    """
    covariance = kernel(
        x, oil_features(x, alpha, z), tabulated.places, tabulated.oils, tabulated.scales
    )
    return np.asarray(trend_terms(x) @ tabulated.trend + covariance @ tabulated.weights)


def field_vectors(x: Array, alpha: Array, z: Array, tabulated: FieldTable | None = None) -> Array:
    """Evaluate vectors of `layout`, the pressure scaled to carry the load, the cells to the shear
    of all.

    Parameters
    ----------
    x : Array
        positions of contacts, shape (m, 3) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]
    tabulated : FieldTable | None, optional
        table of fields; None: that of the package

    Returns
    -------
    Array
        vectors, shape (m, length) [-]
    """
    tabulated = tabulated or field_table()
    result = tabulated.mean + amplitudes(x, alpha, z, tabulated) @ tabulated.modes
    parts = layout()
    for vector in result:
        vector[parts.pressure] *= vector[parts.load] / carried_load_fraction(vector)
        rows = vector[parts.cells].reshape(CELL_ROWS, CELLS)[:2]
        rows *= np.exp(vector[parts.shear]) / sheared_area(vector)
    return np.asarray(result)


def carried_load_fraction(vector: Array) -> float:
    """Sum the fraction of the load that the zone's pressure carries.

    Parameters
    ----------
    vector : Array
        vector of `layout`, shape (length,) [-]

    Returns
    -------
    float
        fraction [-]
    """
    parts = layout()
    _, weights = line_quadrature()
    span = (vector[parts.last] - vector[parts.first])[:, None]
    p = vector[parts.pressure].reshape(HALF, -1)
    width = 2.0 * float(vector[parts.half_width][0]) / LINES
    return float(2.0 * width * (span * weights * p).sum() / (2.0 * pi / 3.0))


def sheared_area(vector: Array) -> float:
    """Sum area over film of all cells in which oil shears.

    Parameters
    ----------
    vector : Array
        vector of `layout`, shape (length,) [-]

    Returns
    -------
    float
        area over film [-]
    """
    area, by_film = vector[layout().cells].reshape(CELL_ROWS, CELLS)[:2]
    return float(by_film[np.minimum(area, by_film) > 0.0].sum())


def contact_fields(conditions: ContactConditions) -> ContactFields:
    """Evaluate pressure and film of a flooded contact for its shear.

    Parameters
    ----------
    conditions : ContactConditions
        flooded contact

    Returns
    -------
    ContactFields
        fields of the contact

    Raises
    ------
    NotInAtlasError
        if tables were not validated by such contacts
    """
    require_fields(conditions)
    contact = scale_contact(conditions)
    load = atlas_load(contact)
    oil = conditions.lubricant
    place = np.array([[log(load), sqrt(contact.moes_lubricant), log(contact.radius_ratio)]])
    vector = field_vectors(place, np.array([oil.pressure_viscosity]), np.array([oil.exponent]))[0]
    return fields_of_vector(vector, conditions)


def require_fields(conditions: ContactConditions) -> None:
    """Check that tables were validated by such contacts.

    Parameters
    ----------
    conditions : ContactConditions
        flooded contact

    Raises
    ------
    NotInAtlasError
        if they were not
    """
    contact = scale_contact(conditions)
    load = atlas_load(contact)
    require_covered(conditions, contact, load)
    oil = conditions.lubricant
    if not _validated_oil(oil):
        raise NotInAtlasError(
            "viscosity_law, roelands_pressure_MPa, density_law: the atlas has fields of oils "
            "after Roelands with p_r 196 MPa and the density of Dowson and Higginson"
        )
    if skewed(conditions.entrainment_angle) or contact.turning > 0.0:
        raise NotInAtlasError(
            "mean_spin_rad_s: the atlas has fields of contacts with entrainment along x "
            "without spin"
        )
    values = (load, contact.moes_lubricant, contact.radius_ratio)
    require_range((*values, oil.exponent, oil.pressure_viscosity), RANGE)
    if contact.moes_lubricant > LARGE_L and load < MIN_A_AT_LARGE_L:
        raise NotInAtlasError(
            f"A = {load:.3g} must lie above {MIN_A_AT_LARGE_L:g} where L lies above {LARGE_L:g}"
        )


def _validated_oil(oil: Lubricant) -> bool:
    """Tell whether the oil is of the kind of the solved ones."""
    usual = Lubricant(viscosity=oil.viscosity, pressure_viscosity=oil.pressure_viscosity)
    return (
        oil.viscosity_law is ViscosityLaw.ROELANDS
        and oil.density_law is DensityLaw.DOWSON_HIGGINSON
        and oil.roelands_pressure == usual.roelands_pressure
    )


def fields_of_vector(vector: Array, conditions: ContactConditions) -> ContactFields:
    """Unfold a vector of `layout` to the fields on both sides of the middle.

    Parameters
    ----------
    vector : Array
        vector of `layout`, shape (length,) [-]
    conditions : ContactConditions
        flooded contact

    Returns
    -------
    ContactFields
        fields of the contact
    """
    contact = scale_contact(conditions)
    assert contact.semi_axis_x is not None and contact.film_scale is not None
    load = atlas_load(contact)
    parts = layout()
    fractions, weights = line_quadrature()
    a = contact.semi_axis_x
    film_unit = contact.film_scale / load
    b = a * contact.semi_axis_ratio
    # 1. the zone of high pressure
    width = float(vector[parts.half_width][0]) * b / HALF
    span = (vector[parts.last] - vector[parts.first])[:, None] * a
    x = vector[parts.first][:, None] * a + span * fractions
    y = np.broadcast_to(width * (np.arange(HALF) + 0.5)[:, None], x.shape)
    size = span * weights
    film = np.exp(vector[parts.film]).reshape(x.shape) * film_unit
    p = np.maximum(vector[parts.pressure], 0.0).reshape(x.shape) * contact.hertz_pressure
    half = np.stack([x, y, size * width, film, p, size, np.full_like(x, width)])
    # 2. the cells around it: a twelfth of the squared size is the spread
    own = vector[parts.cells].reshape(CELL_ROWS, CELLS)
    area, by_film, pressure, along, across, spread_x, spread_y = own[:, own[:2].min(axis=0) > 0.0]
    sizes = (np.sqrt(12.0 * np.maximum(s, 0.0)) for s in (spread_x, spread_y))
    p = np.clip(pressure, 0.0, HIGH_PRESSURE) * contact.hertz_pressure
    rows = (0.5 * area * a * b, area / by_film * film_unit, p)
    cells = np.stack(
        [along * a, across * b, *rows, *(s * u for s, u in zip(sizes, (a, b), strict=True))]
    )
    damping = exp(float(vector[parts.damping][0]))
    unit = contact.hertz_pressure * a * conditions.radius_x / conditions.entrainment_speed
    return ContactFields(zone=_mirrored(half), cells=_mirrored(cells), damping=damping * unit)


def _mirrored(half: Array) -> Array:
    """Nodes on both sides of the middle."""
    other = half.copy()
    other[1] = -other[1]
    return np.concatenate([other[:, ::-1], half], axis=1)


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
    own = _zone(components)
    # a film thinner than the lightest of the table: up to Hertz' pressure
    wider = np.maximum(wider, np.minimum(own[3].max(axis=1), 1.0))
    zone = _stretched(own, wider)
    around = _stretched(_around(components, load), wider)
    around[4] *= wider[:, None]
    return FilmShapes(zone=_mirrored_shapes(zone), around=_mirrored_shapes(around))


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


def _mirrored_shapes(half: Array) -> Array:
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

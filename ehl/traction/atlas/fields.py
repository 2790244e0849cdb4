"""Pressure and film over the ellipse of a flooded contact from a table of solved ones, for
traction without a solve.

What is tabulated are the nodes that a traction table shears (`film_quadrature`): 64 lines, the
edges of the zone of high pressure on each, pressure and film at 24 places from edge to edge, so
that the spike stands at nearly the same place of its line in every contact; and what lies around
that zone, in 45 cells of elliptical rings and sectors. All of it over Hertz' pressure and
semi-axes and, of films, a^2/Rx/A, is one vector of solved contacts, of which the first principal
modes stay.
Their amplitudes are Gaussian processes in (ln A, sqrt L, ln D), A as in `table`, with Matern's
kernel of 5/2, plus sqrt L times terms of the oil, whose coefficients are such processes, too. At
last the pressure is scaled so that it carries the load. Fitted by `tools/atlas/fields.py`.
"""

from functools import cache
from math import exp, log, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...arrays import Array
from ...conditions import ContactConditions
from ...oil.lubricant import DensityLaw, Lubricant, ViscosityLaw
from ...scaling import scale_contact
from ..film_quadrature import HIGH_PRESSURE, LINES, line_quadrature
from .films import NotInAtlasError, atlas_load, require_covered, require_range, skewed
from .table import oil_features, radial, trend_terms

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
    with np.load(path) as file:
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

"""Pressure and gap of flooded contacts on a grid by the tables of fields, for pictures and files.

Where the pressure is high, both are those on the lines of `fields`, interpolated from edge to
edge, the film as much thicker or thinner as makes the central one that of the atlas. Around that
zone the gap is that of the film equation,

    H = H_0 + S X^2/2 + T Y^2/2 + c_def * double integral of P/r,

with the approach H_0 of the atlas; what it misses of the tabulated gap at the edge of the zone
dies out over `REACH`. The oil ahead of the zone carries the load that the zone does not; its
pressure falls with the square of the gap.

Contacts lighter than the tables are nearly rigid. On each line along x stands the pressure of a
rigid cylinder at the film of that line (Reynolds), all lines together carry the load, and the gap
is that of the film equation with the central film of the atlas. Against films solved on 257
points; see `docs/theory/film_atlas.md`.
"""

from collections.abc import Sequence
from math import ceil, cos, pi

import numpy as np
import scipy
from numpy.typing import NDArray

from ..arrays import Array
from ..conditions import ContactConditions
from ..grid import Grid, grid_hierarchy, unfolded
from ..multigrid.full_multigrid import ORIGIN_CELLS, choose_domain
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solid.deformation import deflect, deflection_kernel
from ..solution import ContactSolution, ConvergenceRecord, FilmValue
from ..traction.film_quadrature import HIGH_PRESSURE, LINES, line_quadrature
from .fields import BOX, FILE, HALF, LIGHT_FILE, SEAM, field_table, field_vectors, layout
from .films import AtlasFilms, AtlasValue, atlas_films_of_contacts, atlas_load, oil_numbers, skewed
from .oils import with_inlet_oil
from .table import heavy_weight

POINTS = 257  # of a map along x [-]
LEVELS = 3  # meshes that its grid can be halved to [-]
REACH = 0.5  # over which a difference of gaps dies out, in semi-axes along x [-]
THINNEST = 1e-3  # bound of the gap ahead, over the central film [-]
EXIT = 0.443554  # g_c, where the pressure of a rigid cylinder ends with no slope [rad]
OF_ATLAS = "pressure and gap of the film atlas"
NO_RECORD = ConvergenceRecord(
    residual=(),
    force_error=(),
    film_change=(),
    cycles=0,
    fft_equivalents=0.0,
    fallbacks=(),
    wall_time=0.0,
)
MIDDLES = (np.arange(LINES) + 0.5) * (2.0 / LINES) - 1.0  # of the lines, over the half-width [-]


def field_maps(contacts: Sequence[ContactConditions]) -> list[ContactSolution | None]:
    """Evaluate pressure and gap of contacts on grids, in some ten milliseconds each.

    Parameters
    ----------
    contacts : Sequence[ContactConditions]
        flooded contacts

    Returns
    -------
    list[ContactSolution | None]
        fields with the films of the atlas and their error bars; None of contacts that films or
        fields of the atlas do not cover

    Examples
    --------
    >>> from oilfilm.ehl import ContactConditions, Lubricant
    >>> contact = ContactConditions(
    ...     load=60.0,
    ...     radius_x=0.01,
    ...     radius_y=0.02,
    ...     reduced_modulus=226e9,
    ...     entrainment_speed=1.5,
    ...     lubricant=Lubricant(viscosity=0.04, pressure_viscosity=18e-9),
    ... )
    >>> (field,) = field_maps([contact])
    >>> f"{1e9 * field.film[field.X == 0.0, field.Y == 0.0][0]:.0f} nm in the middle"
    '318 nm in the middle'
    """
    maps: list[ContactSolution | None] = [None] * len(contacts)
    films = {
        n: own
        for n, own in enumerate(atlas_films_of_contacts(contacts))
        if isinstance(own, AtlasFilms) and not skewed(contacts[n].entrainment_angle)
    }
    places = np.array([_place(contacts[n]) for n in films]).reshape(-1, len(BOX))
    nearest = np.clip(places, *np.array(BOX).T)
    for n, place, near, vector in zip(films, places, nearest, _vectors(nearest), strict=True):
        maps[n] = _map(contacts[n], films[n], vector, lighter=place[0] < near[0])
    return maps


def _place(conditions: ContactConditions) -> tuple[float, ...]:
    """Numbers of `BOX`, of a piezoviscous oil that stands for the contact's."""
    standing = with_inlet_oil(conditions)
    contact = scale_contact(standing)
    oil = oil_numbers(standing.lubricant)
    groups = (contact.moes_lubricant, contact.radius_ratio)
    return atlas_load(contact), *groups, *oil


def _vectors(places: Array) -> Array:
    """Vectors of `layout` of contacts at rows of A, L, D, alpha [1/Pa] and z, (n, length)."""
    load, thick, ratio, alpha, z = places.T
    x = np.stack([np.log(load), np.sqrt(thick), np.log(ratio)], axis=1)
    heavy = heavy_weight(x[:, 0], SEAM)[0]
    vectors = np.zeros((len(x), layout().shear.stop))
    for path, weight in ((LIGHT_FILE, 1.0 - heavy), (FILE, heavy)):
        some = weight > 0.0
        if some.any():
            own = field_vectors(x[some], alpha[some], z[some], field_table(path))
            vectors[some] += weight[some, None] * own
    return vectors


def _map(
    conditions: ContactConditions, films: AtlasFilms, vector: Array, *, lighter: bool
) -> ContactSolution:
    """The fields of one contact by the vector of the nearest one that the tables have."""
    contact = scale_contact(conditions)
    assert contact.film_scale is not None  # with lengths
    unit = contact.film_scale
    central, minimum, approach = (
        _over(value, unit) for value in (films.central, films.minimum, films.approach)
    )
    grid = _grid(contact)
    if lighter:
        pressure, gap = _light_fields(contact, grid, central.value)
    else:
        pressure, gap = _fields(contact, grid, vector, (central.value, approach.value))
    X = grid.X
    Y = unfolded(grid.Y, sign=-1.0)
    return ContactSolution(
        conditions=conditions,
        options=SolverOptions(points=POINTS),
        X=X,
        Y=Y,
        P=np.ascontiguousarray(unfolded(pressure).T),
        H=np.ascontiguousarray(unfolded(gap).T),
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=approach,
        **contact.of_solution,
        domain=(float(X[0]), float(X[-1]), float(Y[-1]) / contact.semi_axis_ratio),
        resolved=True,
        converged=True,
        message=OF_ATLAS,
        record=NO_RECORD,
    )


def _over(value: AtlasValue, unit: float) -> FilmValue:
    """A film of the atlas [m] over a unit [m]."""
    film = value.value / unit
    return FilmValue(value=film, uncertainty=value.uncertainty / unit, finest=film)


def _grid(contact: ScaledContact) -> Grid:
    """Grid of one half of the box that the solver chooses, the origin one of its nodes."""
    x_in, x_out, y_half = choose_domain(contact)
    outlet = ceil(x_out / (x_out - x_in) * ORIGIN_CELLS - 1e-9)
    box = (x_in, outlet * -x_in / (ORIGIN_CELLS - outlet), y_half * contact.semi_axis_ratio)
    return grid_hierarchy(POINTS, box, contact.semi_axis_ratio, LEVELS, True)[-1]


def _fields(
    contact: ScaledContact, grid: Grid, vector: Array, films: tuple[float, float]
) -> tuple[Array, Array]:
    """Pressure and gap at the nodes of a half, of shape (ny, nx), by central film and approach."""
    central, approach = films
    carried = float(vector[layout().load][0])
    # 1. pressure and film of the zone of high pressure
    inside, zone, film = _zone(contact, grid, vector)
    pressure = zone * (carried * contact.load / grid.integral(zone))
    distance, nearest = scipy.ndimage.distance_transform_edt(
        ~inside, sampling=(grid.hy, grid.hx), return_indices=True
    )
    edge = tuple(nearest)
    # 2. the rest of the load ahead of it
    kernel = deflection_kernel(grid, contact.deformation, contact.coating)
    bodies = approach + contact.gap(grid.X[None, :], grid.Y[:, None])
    gap = np.maximum(bodies + deflect(kernel, pressure), THINNEST * central)
    ahead = ~inside & (grid.X[nearest[1]] < 0.0)
    tail = np.where(ahead, np.minimum((gap[edge] / gap) ** 2, 1.0), 0.0)
    rest = max(1.0 - carried, 0.0) * contact.load / grid.integral(tail)
    pressure += np.minimum(rest * tail, pressure[edge])
    # 3. gap: of the film equation, in the zone as tabulated
    gap = bodies + deflect(kernel, pressure)
    missed = np.zeros_like(gap)
    middle = int(abs(grid.X).argmin())
    missed[inside] = film[inside] * (central / film[0, middle]) - gap[inside]
    gap += missed[edge] * np.exp(-distance / REACH)
    return pressure, np.maximum(gap, THINNEST * central)


def _light_fields(contact: ScaledContact, grid: Grid, central: float) -> tuple[Array, Array]:
    """Pressure and gap of a contact that is nearly rigid, of shape (ny, nx)."""
    X = grid.X[None, :]
    Y = grid.Y[:, None]
    line = central + contact.gap(np.zeros(1), Y)
    angle = np.arctan(X / np.sqrt(2.0 * line / contact.curvature_x))
    pressure = _line_pressure(angle) / line**1.5
    pressure *= contact.load / grid.integral(pressure)
    kernel = deflection_kernel(grid, contact.deformation, contact.coating)
    gap = contact.gap(X, Y) + deflect(kernel, pressure)
    return pressure, gap + (central - gap[0, int(abs(grid.X).argmin())])


def _line_pressure(angle: Array) -> Array:
    """Pressure of a rigid cylinder, the integral of cos^2 t - cos^4 t/cos^2 g_c from -pi/2 to g,
    tan g = x/sqrt(2 R h_0), zero from g_c on [-].
    """
    turn = angle + 0.5 * pi
    double = 0.25 * np.sin(2.0 * angle)
    fourth = 0.375 * turn + double + np.sin(4.0 * angle) / 32.0
    pressure = 0.5 * turn + double - fourth / cos(EXIT) ** 2
    return np.where(angle < EXIT, np.maximum(pressure, 0.0), 0.0)


def _zone(
    contact: ScaledContact, grid: Grid, vector: Array
) -> tuple[NDArray[np.bool_], Array, Array]:
    """Nodes in the zone of high pressure, pressure and film there, zero elsewhere."""
    parts = layout()
    shares = line_quadrature()[0]
    across = grid.Y / (float(vector[parts.half_width][0]) * contact.semi_axis_ratio)
    first, last = (
        _over_lines(vector[part], across)[:, None] for part in (parts.first, parts.last)
    )
    along = (grid.X[None, :] - first) / (last - first)
    inside = (across <= 1.0)[:, None] & (along >= 0.0) & (along <= 1.0)
    places = (np.broadcast_to(across[:, None], along.shape)[inside], along[inside])
    known = vector[parts.pressure].reshape(HALF, -1)
    known = np.pad(known, ((0, 0), (1, 1)), constant_values=HIGH_PRESSURE * known.max())
    pressure, film = np.zeros(along.shape), np.zeros(along.shape)
    pressure[inside] = np.maximum(_between(np.r_[0.0, shares, 1.0], known, places), 0.0)
    logarithm = vector[parts.film].reshape(HALF, -1)
    film[inside] = np.exp(_between(shares, logarithm, places))
    return inside, pressure, film


def _over_lines(values: Array, across: Array) -> Array:
    """Values of the lines of one half at places across, over the half-width."""
    whole = np.concatenate([values[::-1], values])
    return np.asarray(
        scipy.interpolate.CubicSpline(MIDDLES, whole)(np.minimum(across, MIDDLES[-1]))
    )


def _between(shares: Array, values: Array, places: tuple[Array, Array]) -> Array:
    """Values of lines, shape (HALF, n) at shares of each, at places across and along."""
    spline = scipy.interpolate.RectBivariateSpline(
        MIDDLES, shares, np.concatenate([values[::-1], values])
    )
    across, along = places
    clipped = np.clip(along, shares[0], shares[-1])
    return np.asarray(spline(np.minimum(across, MIDDLES[-1]), clipped, grid=False))

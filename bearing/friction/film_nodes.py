"""Nodes of sheared films as compiled friction takes them: of solved films and of others, equal
films once.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array, unique_rows
from oilfilm.ehl.atlas.fields import PLACE, film_shapes, shape_coordinates
from oilfilm.ehl.closed_form.hertz import MEAN_PRESSURE_RATIO
from oilfilm.ehl.conditions import curvature_height
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.oil.rheology import (
    KernelRheology,
    Rheology,
    contact_rheology,
    eyring_stresses,
    kernel_rheology,
    limiting_stress,
)
from oilfilm.ehl.traction.shear import (
    Cavitation,
    bounded_viscosity,
    dimensional_grid,
    film_temperature,
    film_viscosity,
    sheared_width,
    solution_rheology,
    trapezoidal_weights,
    with_outlet,
)

from ..contacts.contact import BearingContact
from ..contacts.motion import TRACTION_POINTS
from ..contacts.shape import groove_curvature_radius
from ..films.film import ContactFilm, Films, first_same
from ..geometry import Bearing
from ..quasistatic.solution import QuasistaticSolution
from ._kernels import thin_sums
from .contact_friction import TINY

ROWS = 7  # area, 1 over the gap, viscosity, limiting stress, x, y and height of the surface
THIN = 11  # numbers of `_kernels.thin_sums`
STRESS = KernelRheology._fields.index("stress")


class FilmNodes(NamedTuple):
    """Films of contacts as `_kernels.film_frictions` takes them."""

    nodes: Array  # (7, m)
    parts: NDArray[np.int64]  # (films, 3)
    thin: Array  # (films, 11)
    laws: Array  # (films, 4)
    own: NDArray[np.int64]  # (contacts,) film of each contact; the first one has no nodes


class FilmBlock(NamedTuple):
    """Nodes of films of equal size (7, films, n), those of oil at ambient pressure behind the
    others.
    """

    nodes: Array
    pressed: int  # nodes of each under pressure [-]
    laws: Array  # (films, 4)


class FilmOnSurface(NamedTuple):
    """A film with the surface that it runs on."""

    film: ContactFilm
    curvature: float  # 1/(2 R) of the loaded surface across rolling [1/m]
    width: float  # half of what is curved like that [m]


def film_nodes(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    states: Sequence[Films],
    rheology: Rheology,
) -> list[FilmNodes]:
    """Nodes that shear in the films of contacts, in one or several states of these.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    states : sequence of sequences of ContactFilm or None
        Films of the contacts in each state; an empty state has no films.
    rheology : Rheology
        Of the oil.

    Returns
    -------
    list of FilmNodes
        One a state, in [m], [Pa], [Pa s]; each has the nodes of all states.
    """
    temperature = solution.operation.temperature
    sheared = [
        None if film is None else _sheared(solution.bearing, contact, film)
        for state in states
        for contact, film in zip(contacts, state, strict=False)
    ]
    own = np.zeros(len(sheared), dtype=np.int64)
    blocks = [FilmBlock(np.empty((ROWS, 1, 0)), 0, np.zeros((1, 4)))]
    # 1. solved films, one by one
    fields = first_same([None if one is None else one.film.sheared_field for one in sheared])
    existing: dict[tuple[int, float, float | None, float], int] = {}
    others: dict[int, FilmOnSurface] = {}
    for number, one in enumerate(sheared):
        if one is None:
            continue
        if one.film.sheared_field is None:
            others[number] = one
            continue
        key = (fields[number], *one.film.values, one.curvature)
        if key not in existing:
            existing[key] = len(blocks)
            blocks.append(_solved_nodes(one, rheology, temperature))
        own[number] = existing[key]
    # 2. others, all at once
    if others:
        like, block = unsolved_nodes(list(others.values()), rheology, temperature)
        own[list(others)] = len(blocks) + like
        blocks.append(block)
    ends = np.cumsum([len(state) for state in states])
    joined = joined_nodes(blocks, own)
    return [joined._replace(own=part) for part in np.split(own, ends[:-1])]


def joined_nodes(blocks: Sequence[FilmBlock], film_numbers: NDArray[np.int64]) -> FilmNodes:
    """Films of blocks one after the other.

    Parameters
    ----------
    blocks : sequence of FilmBlock
        Films of equal size each.
    film_numbers : ndarray, shape (contacts,)
        Film of each contact, counted through all blocks [-].

    Returns
    -------
    FilmNodes
        In [m], [Pa], [Pa s].
    """
    counts = [block.nodes.shape[1] for block in blocks]
    sizes = np.repeat([block.nodes.shape[2] for block in blocks], counts)
    pressed = np.repeat([block.pressed for block in blocks], counts)
    ends = np.cumsum(sizes)
    thin = np.empty((len(sizes), THIN))
    behind = (film for b in blocks for film in b.nodes[..., b.pressed :].swapaxes(0, 1))
    for film, sums in zip(behind, thin, strict=True):
        thin_sums(film, sums)
    whole = [block.nodes.reshape(ROWS, -1) for block in blocks if block.nodes.size]
    return FilmNodes(
        nodes=whole[0] if len(whole) == 1 else np.concatenate([blocks[0].nodes[:, 0], *whole], 1),
        parts=np.stack([ends - sizes, ends - sizes + pressed, ends], axis=1).astype(np.int64),
        thin=thin,
        laws=np.concatenate([block.laws for block in blocks]),
        own=film_numbers,
    )


def _sheared(bearing: Bearing, contact: BearingContact, film: ContactFilm) -> FilmOnSurface:
    radius = groove_curvature_radius(bearing, contact.race)
    width = np.inf if contact.hertz is None else contact.hertz.semi_axis_y
    return FilmOnSurface(film, 0.5 / radius, width)


def _law(rheology: Rheology) -> Array:
    """The first four numbers of a rheology for kernels."""
    return np.array(kernel_rheology(rheology)[:4], dtype=np.float64)


def _laws(rheology: Rheology, oil: Lubricant, mean_pressure: Array) -> Array:
    """The same of contacts of one oil at their mean pressures [Pa], shape (contacts, 4)."""
    first = contact_rheology(rheology, oil, float(mean_pressure[0]))
    laws = np.tile(_law(first), (mean_pressure.size, 1))
    if not rheology.of_contact:
        laws[:, STRESS] = eyring_stresses(rheology, oil, mean_pressure)
    return laws


def _solved_nodes(
    sheared: FilmOnSurface, rheology: Rheology, temperature: float | None
) -> FilmBlock:
    """Nodes of a solved film; sums of `integrate_traction`."""
    solved = sheared.film.operating_field
    assert solved is not None
    rheology = solution_rheology(solved, rheology)
    film = with_outlet(solved.thinned(TRACTION_POINTS))
    film_x, film_y, thickness = dimensional_grid(film)
    x, y = np.broadcast_arrays(film_x[:, None], film_y[None, :])
    width = sheared_width(thickness, film.pressure, Cavitation.STRIATED)
    area = trapezoidal_weights(film_x, film_y) * width
    inlet = film_temperature(film, temperature)
    chosen = width > 0.0
    local = inlet[chosen] if isinstance(inlet, np.ndarray) else inlet
    limit = limiting_stress(film.pressure[chosen], rheology, local)
    opening = 1.0 / np.maximum(thickness[chosen], TINY)
    y = y[chosen]
    rows = (area[chosen], opening, film_viscosity(film)[chosen], limit)
    surface = curvature_height(sheared.curvature, sheared.width, y)
    nodes = np.stack([*rows, x[chosen], y, surface])
    full = film.pressure[chosen] > 0.0
    nodes = np.concatenate([nodes[:, full], nodes[:, ~full]], axis=1)
    return FilmBlock(nodes[:, None], int(full.sum()), _law(rheology)[None])


def unsolved_nodes(
    films: Sequence[FilmOnSurface], rheology: Rheology, temperature: float | None
) -> tuple[NDArray[np.int64], FilmBlock]:
    """Nodes of films of atlas and formulas, of one oil.

    Parameters
    ----------
    films : sequence of FilmOnSurface
        Films without a field, one at least.
    rheology : Rheology
        Of the oil.
    temperature : float or None
        Of the oil [K]; None: that of its properties.

    Returns
    -------
    like : ndarray, shape (films,)
        Which of the films that differ each one is [-].
    block : FilmBlock
        The films that differ.
    """
    unsolved = [one.film for one in films]
    numbers, shares = _shape_numbers(unsolved)
    surfaces = [(one.curvature, one.width) for one in films]
    places = np.concatenate([numbers, surfaces], axis=1)
    kind, like = _alike(places)
    shapes = _shapes(places[kind], unsolved[0].conditions.lubricant, rheology, temperature)
    # the same shapes with other gaps, of operating and flooded films
    gaps = np.stack([[film.central.value for film in unsolved], shares], axis=1)
    chosen, kinds = _alike(np.column_stack([like, gaps]))
    return kinds, _with_gaps(shapes, like[chosen], gaps[chosen])


def _alike(places: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """`alike` of rows in any units."""
    scale = np.abs(places).max(axis=0)
    return unique_rows(places / np.where(scale > 0.0, scale, 1.0))


def _shape_numbers(films: Sequence[ContactFilm]) -> tuple[Array, Array]:
    """Place of each film in the atlas, semi-axes [m], Hertz' pressure [Pa], radius, central film
    [m], shape (n, PLACE + 5); and the share of its shape's gap that the film is, shape (n,) [-].

    The shape is that of the flooded film. Of contacts lighter than the atlas, whose oil spreads as
    far as the root of the film, it is that of the film itself.
    """
    sizes = np.array([film.size for film in films])
    places = shape_coordinates([film.conditions for film in films], sizes[:, 0])
    light = places[:, -1] > 0.0
    radii = [film.conditions.radius_x for film in films]
    own = [film.central.value for film in films]
    central = np.where(light, own, [film.flooded_central for film in films])
    shares = np.where(light, 1.0, [film.gap_fraction for film in films])
    return np.column_stack([places, sizes, radii, central]), shares


def _shapes(
    places: Array, oil: Lubricant, rheology: Rheology, temperature: float | None
) -> FilmBlock:
    """Films of gaps of one in the contact, around it [m], of numbers as `_shape_numbers` with
    curvature and width of the surface.
    """
    a, b, largest, radius, central, curvature, width = places[:, PLACE:].T[..., None]
    zone, around = film_shapes(places[:, :PLACE], (central * radius / (a * a))[:, 0])
    film = np.concatenate([zone[4], a * a / radius * around[4]], axis=1)
    x, y, area, p = np.concatenate([zone[:4], around[:4]], axis=2)
    y = b * y
    # oil at the pressures that there are
    pressure = largest * p
    viscosity = bounded_viscosity(pressure, oil)
    limit = limiting_stress(pressure, rheology, temperature)
    surface = curvature_height(curvature, width, y)
    rows = (a * b * area, 1.0 / film, viscosity, limit, a * x, y, surface)
    laws = _laws(rheology, oil, MEAN_PRESSURE_RATIO * largest[:, 0])
    return FilmBlock(np.stack(rows), zone.shape[2], laws)


def _with_gaps(shapes: FilmBlock, chosen: NDArray[np.int64], gaps: Array) -> FilmBlock:
    """Chosen shapes with gaps in the contact [m], and shares of the flooded ones that they are
    [-]: oil that leaves the contact fills strips as wide.
    """
    nodes = shapes.nodes[:, chosen]
    gap, share = gaps.T[..., None]
    nodes[1, :, : shapes.pressed] /= gap
    behind = nodes[:, :, shapes.pressed :]
    behind[0] *= np.where(behind[4] > 0.0, share, 1.0)
    return FilmBlock(nodes, shapes.pressed, shapes.laws[chosen])

"""How the contacts of a bearing conduct heat through their films."""

from collections.abc import Sequence

import numpy as np

from ehl.arrays import unique_rows
from ehl.closed_form.hertz import HertzContact
from ehl.oil.lubricant import Lubricant, heat_properties
from ehl.solid.film_conductance import (
    history_rate,
    marched_conductance,
    marched_flux,
    moving_speed,
)
from ehl.solid.heat import SolidThermal
from ehl.solution import ContactSolution
from ehl.traction.shear import dimensional_conditions, dimensional_grid

from ..contacts.contact import BearingContact
from ..friction.unsolved_film import CONTACT_PRESSURE, UnsolvedFilm, hertz_pressures
from ..geometry import Array, Bearing, Race
from .friction_heat import solid_thermal

POINTS = 129  # of a solved film along rolling, at most, that a contact is marched on [-]
# conductivity of oil at 1 GPa over that at ambient pressure where the oil has no law of its own:
# up to twice, as mineral oils and polyalphaolefins (Larsson and Andersson, 2000) [-]
PRESSED = 2.0

Ends = tuple[float, float, float]  # value, low and high end [W/K]
# with the relative error of its thickness
KnownFilm = tuple[ContactSolution | UnsolvedFilm, float]


def contact_conductances(
    bearing: Bearing,
    contacts: Sequence[BearingContact],
    films: Sequence[KnownFilm | None],
    temperature: float,
    *,
    ends: bool = True,
) -> Array:
    """Of all contacts, value, low and high end, shape (3, balls, 2) [W/K]; zero where there is no
    film.

    films: of the contacts with the relative error of their thickness [-]; temperature: of the oil
    [K]; ends: whether both are wanted, else they are the value for flat films.
    """
    ball = solid_thermal(bearing.ball_material)
    rings = {
        Race.INNER: (ball, solid_thermal(bearing.inner_ring_material)),
        Race.OUTER: (ball, solid_thermal(bearing.outer_ring_material)),
    }
    rows = np.zeros((len(contacts), 3))
    found: dict[tuple[int, Race], Ends] = {}
    flat: dict[Race, list[int]] = {race: [] for race in rings}
    for number, (contact, film) in enumerate(zip(contacts, films, strict=True)):
        if film is None or contact.hertz is None:
            continue
        if isinstance(film[0], UnsolvedFilm):
            flat[contact.race].append(number)
            continue
        key = (id(film[0]), contact.race)
        if key not in found:
            pair = rings[contact.race]
            found[key] = _of_solved(contact.hertz, film[0], film[1], pair, temperature)
        rows[number] = found[key]
    for race, numbers in flat.items():
        if numbers:
            some = [films[n] for n in numbers]
            known = [film for film in some if film]
            rows[numbers] = _of_flat(known, rings[race], temperature, 3 if ends else 1)
    return rows.T.reshape(3, -1, 2)


def _oil_ends(oil: Lubricant, pressure: Array, temperature: float) -> tuple[Array, Array, Array]:
    """Conductivity of the oil at pressures [Pa]: value, as at ambient pressure, and as pressed
    [W/(m K)].
    """
    pressed = heat_properties(pressure, oil, temperature)[0]
    still = oil.thermal.conductivity if oil.thermal else 0.0
    law = oil.thermal is not None and oil.thermal.under_pressure is not None
    return pressed, np.full_like(pressed, still), pressed if law else PRESSED * pressed


def _of_solved(
    hertz: HertzContact,
    solution: ContactSolution,
    error: float,
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
) -> Ends:
    """Value, low and high end of one contact [W/K]: the film of its solution, its error, and oil
    that conducts as at ambient pressure or as pressed.
    """
    solution = solution.thinned(POINTS)
    x, y, gap = dimensional_grid(solution)
    conditions = dimensional_conditions(solution)
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    speed = moving_speed(conditions.entrainment_speed, axes, *pair)
    inside = solution.P > CONTACT_PRESSURE
    oil = _oil_ends(conditions.lubricant, solution.pressure, temperature)
    value, low, high = (
        marched_conductance(
            speed, x, y, np.where(inside, k / (np.maximum(gap, 1e-12) * scale), 0.0), *pair
        )
        for k, scale in zip(oil, _scales(error), strict=True)
    )
    return value, low, high


def _scales(error: float) -> Ends:
    """Of the film by its relative error, value and both ends of the conductance [-]."""
    return 1.0, 1.0 + error, 1.0 / (1.0 + error)


def _of_flat(
    films: Sequence[KnownFilm],
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
    count_ends: int,
) -> Array:
    """As `_of_solved`, of flat films of one race and one oil at once, equal ones once, shape
    (films, 3), or (films, 1) without ends.
    """
    flat = [film for film, _ in films if isinstance(film, UnsolvedFilm)]
    numbers = [
        (*film.size, film.gap, film.conditions.entrainment_speed, *_scales(error))
        for film, (_, error) in zip(flat, films, strict=True)
    ]
    places = np.array(numbers)
    first, like = unique_rows(places / np.abs(places).max(axis=0))
    chosen = places[first]
    axes = [(along, across) for along, across, *_ in chosen.tolist()]
    speed = [
        moving_speed(u, pair_of, *pair)
        for u, pair_of in zip(chosen[:, 4].tolist(), axes, strict=True)
    ]
    # 1. half of the lines along rolling, the others are their images
    P, count = hertz_pressures()
    step = 2.0 / (P.shape[0] - 1) * chosen[:, :2]
    largest, gap = chosen[:, 2, None, None], chosen[:, 3, None, None]
    oil = _oil_ends(flat[0].conditions.lubricant, largest * P, temperature)[:count_ends]
    scales = chosen[:, 5 : 5 + count_ends].T[:, :, None, None]
    # 2. all of them marched together: nodes along x, then ends, contacts and lines
    film = np.where(P > CONTACT_PRESSURE, np.stack(oil) / (np.maximum(gap, 1e-12) * scales), 0.0)
    lines = np.moveaxis(film, 2, 0).reshape(P.shape[0], -1)
    rates = np.repeat(history_rate(np.array(speed), step[:, 0], *pair), P.shape[1])
    marched = marched_flux(lines, np.tile(rates, count_ends))
    flux = marched.reshape(count_ends, len(first), -1) @ count
    return np.asarray((flux * step.prod(axis=1)).T[like])

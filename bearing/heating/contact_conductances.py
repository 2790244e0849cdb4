"""How the contacts of a bearing conduct heat through their films."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from ehl.arrays import Array, unique_rows
from ehl.closed_form.hertz import HertzContact
from ehl.oil.lubricant import Lubricant, heat_properties
from ehl.solid.heat import (
    SolidThermal,
    history_rate,
    marched_conductance,
    marched_flux,
    moving_speed,
)
from ehl.traction.shear import dimensional_conditions, dimensional_grid

from ..contacts.contact import BearingContact
from ..films.film import CONTACT_PRESSURE, ContactFilm, Films, first_same
from ..geometry import Bearing, Race
from .friction_heat import solid_thermal

POINTS = 129  # of a solved film along rolling, at most, that a contact is marched on [-]
# conductivity of oil at 1 GPa over that at ambient pressure where the oil has no law of its own:
# up to twice, as mineral oils and polyalphaolefins (Larsson and Andersson, 2000) [-]
PRESSED = 2.0

ELLIPSE_POINTS = 33  # along and across the ellipse [-]; 129 conduct 0.9 % more in a 6306

Ends = tuple[float, float, float]  # value, low and high end [W/K]


def contact_conductances(
    bearing: Bearing,
    contacts: Sequence[BearingContact],
    films: Films,
    temperature: float,
    *,
    ends: bool = True,
) -> Array:
    """Conductances of heat through the films of all contacts.

    Parameters
    ----------
    bearing : Bearing
        Its materials have heat properties.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Operating films of the contacts.
    temperature : float
        Of the oil [K].
    ends : bool
        Whether both ends are wanted; else they are the value of films without a field.

    Returns
    -------
    ndarray, shape (3, balls, 2)
        Value, low and high end [W/K]; zero where there is no film.
    """
    ball = solid_thermal(bearing.ball_material)
    rings = {
        Race.INNER: (ball, solid_thermal(bearing.inner_ring_material)),
        Race.OUTER: (ball, solid_thermal(bearing.outer_ring_material)),
    }
    rows = np.zeros((len(contacts), 3))
    existing: dict[tuple[int, float, Race], Ends] = {}
    fields = first_same([None if film is None else film.field for film in films])
    flat: dict[Race, list[int]] = {race: [] for race in rings}
    for number, (contact, film) in enumerate(zip(contacts, films, strict=True)):
        if film is None or contact.hertz is None:
            continue
        if film.field is None:
            flat[contact.race].append(number)
            continue
        key = (fields[number], film.gap_fraction, contact.race)
        if key not in existing:
            existing[key] = _of_solved(contact.hertz, film, rings[contact.race], temperature)
        rows[number] = existing[key]
    for race, numbers in flat.items():
        if numbers:
            chosen = [film for n in numbers if (film := films[n]) is not None]
            rows[numbers] = _of_flat(chosen, rings[race], temperature, 3 if ends else 1)
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
    film: ContactFilm,
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
) -> Ends:
    """Value, low and high end of one contact [W/K]: the film of its solution, its error, and oil
    that conducts as at ambient pressure or as pressed.
    """
    field = film.operating_field
    assert field is not None
    solution = field.thinned(POINTS)
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
        for k, scale in zip(oil, _scales(film.central.relative_error), strict=True)
    )
    return value, low, high


def _scales(error: float) -> Ends:
    """Of the film by its relative error, value and both ends of the conductance [-]."""
    return 1.0, 1.0 + error, 1.0 / (1.0 + error)


def _of_flat(
    films: Sequence[ContactFilm],
    pair: tuple[SolidThermal, SolidThermal],
    temperature: float,
    count_ends: int,
) -> Array:
    """As `_of_solved`, of flat films of one race and one oil at once, equal ones once, shape
    (films, 3), or (films, 1) without ends.
    """
    numbers = [
        (
            *(*film.size, film.gap, film.conditions.entrainment_speed),
            *_scales(film.central.relative_error),
        )
        for film in films
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
    P, count = _hertz_pressures()
    step = 2.0 / (P.shape[0] - 1) * chosen[:, :2]
    largest, gap = chosen[:, 2, None, None], chosen[:, 3, None, None]
    oil = _oil_ends(films[0].conditions.lubricant, largest * P, temperature)[:count_ends]
    scales = chosen[:, 5 : 5 + count_ends].T[:, :, None, None]
    # 2. all of them marched together: nodes along x, then ends, contacts and lines
    film = np.where(P > CONTACT_PRESSURE, np.stack(oil) / (np.maximum(gap, 1e-12) * scales), 0.0)
    lines = np.moveaxis(film, 2, 0).reshape(P.shape[0], -1)
    rates = np.repeat(history_rate(np.array(speed), step[:, 0], *pair), P.shape[1])
    marched = marched_flux(lines, np.tile(rates, count_ends))
    flux = marched.reshape(count_ends, len(first), -1) @ count
    return np.asarray((flux * step.prod(axis=1)).T[like])


@cache
def _hertz_pressures() -> tuple[Array, Array]:
    """Pressure over Hertz' on `ELLIPSE_POINTS` = n lines over the ellipse along rolling, of them
    those with y >= 0, shape (n, n // 2 + 1), and how many each of these stands for [-].
    """
    steps = ELLIPSE_POINTS // 2
    places = np.arange(-steps, steps + 1)
    left = np.maximum(steps**2 - places[:, None] ** 2 - places[steps:] ** 2, 0)
    count = np.full(left.shape[1], 2.0)
    count[0] = 1.0
    return np.sqrt(left) / steps, count

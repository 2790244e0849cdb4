"""Film and rolling moment of a contact whose film is not solved: film atlas, and formulas.

They are those of the film atlas where it covers the contact. Under less or more load than it
covers, or for larger L, they are formulas times the ratio of atlas to formulas at the nearest
contact that it covers, so that there is no step; for other oils and ellipses the formulas alone:
the central film of Chittenden et al. (1985), or, in light contacts that they were not made for,
that of Nijenbanning, Venner and Moes (1994) as corrected here, minimum over central film after
Hamrock and Dowson (1977), the moment as `formula_moment` has it.

The formulas alone, against solved films of 6208, 6306, 7012 AC, 6205, 6312 and 61808 (129 points,
M 50 to 10 000): central films within 12 % but one (18 %), minimum films within 20 %.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ehl.closed_form.film import (
    MAX_FILM_OVER_RADIUS,
    film_chittenden_central,
    film_hamrock_dowson_central,
    film_hamrock_dowson_minimum,
    film_nijenbanning_central,
)
from ehl.conditions import ContactConditions
from ehl.traction.atlas.films import AtlasFilms, NotInAtlasError, atlas_films_of, skewed
from ehl.traction.atlas.nearest import nearest_covered

from .formula_moment import flooded_moment

# of Nijenbanning's formula, fitted to what was solved in wide ellipses from M = 1 to 6 (R_x/R_y
# 0.02 to 0.1: 0.823 to 0.846) [-]
LIGHT_CONTACT = 0.83
DIGITS = 10  # of conditions and axes in which contacts are alike
FORMULA_ERROR = 0.2  # of the central film of the formulas alone [-], see above
# of formulas scaled to the atlas, per unit of ln A, ln L and z beyond its range [-]
BEYOND_ERROR = 0.1


class FilmNumbers(NamedTuple):
    """Of a flooded, isothermal contact whose film is not solved."""

    central: float  # [m]
    ratio: float | None  # minimum over central film [-]; None: not known
    moment: float  # that resists rolling [N m]
    error: float  # of the central film [-]
    minimum_error: float  # of the minimum film [-]
    atlas: bool  # whether they are those of the film atlas


def film_numbers(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """Film and moment of the atlas, or of formulas scaled to it at the nearest load that it
    covers, or of formulas; `axes`: Hertz', across and along rolling [m].

    Sliding does not count, nor on which side the entrainment turns: balls on both sides of a load
    have theirs once.
    """
    return _film_numbers(*_alike(conditions, axes))


def film_numbers_of(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[FilmNumbers]:
    """As `film_numbers`, of the conditions and axes [m] of many contacts at once."""
    kinds = _kinds(contacts)
    first = dict(zip(reversed(kinds), reversed(contacts), strict=True))
    distinct = list(dict.fromkeys(kinds))
    numbers = _numbers([_alike(*first[kind]) for kind in distinct])
    found = dict(zip(distinct, numbers, strict=True))
    return [found[kind] for kind in kinds]


def _kinds(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[tuple[Any, ...]]:
    """What contacts have in common that are alike: numbers to `DIGITS`, the rest the very same."""
    numbers = np.array(
        [
            (c.load, c.radius_x, c.radius_y, c.entrainment_speed, abs(c.rotation), *axes)
            for c, axes in contacts
        ]
    ).reshape(-1, 7)
    places = DIGITS - 1 - np.floor(np.log10(np.where(numbers > 0.0, numbers, 1.0)))
    rows = np.stack([np.rint(numbers * 10.0**places), places], axis=1)
    return [
        (
            *(row.tobytes(), c.reduced_modulus, c.entrainment_angle, c.ball_radius),
            *(id(c.lubricant), id(c.coating), id(c.inlet_layer)),
        )
        for row, (c, _) in zip(rows, contacts, strict=True)
    ]


def _alike(
    conditions: ContactConditions, axes: tuple[float, float]
) -> tuple[ContactConditions, tuple[float, float]]:
    """Conditions and axes to `DIGITS`, without what does not count."""
    lengths = (conditions.load, conditions.radius_x, conditions.radius_y)
    load, radius_x, radius_y, speed, turning = map(
        _rounded, (*lengths, conditions.entrainment_speed, abs(conditions.rotation))
    )
    alike = replace(
        conditions,
        load=load,
        radius_x=radius_x,
        radius_y=radius_y,
        entrainment_speed=speed,
        slide_roll_ratio=0.0,
        lateral_slide_ratio=0.0,
        spin=0.0,
        mean_spin=turning,
    )
    return alike, (_rounded(axes[0]), _rounded(axes[1]))


def _rounded(value: float) -> float:
    """To `DIGITS`."""
    return float(f"{value:.{DIGITS}g}")


@lru_cache(maxsize=256)
def _film_numbers(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """The same of conditions that are alike."""
    return _numbers([(conditions, axes)])[0]


def _numbers(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[FilmNumbers]:
    """The same of many contacts that differ: of the atlas, or as far beyond it as it is."""
    known = atlas_films_of([conditions for conditions, _ in contacts])
    return [
        _beyond_atlas(*contact)
        if isinstance(films, NotInAtlasError) or skewed(contact[0].entrainment_angle)
        else _of_atlas(films, *contact)
        for contact, films in zip(contacts, known, strict=True)
    ]


def _of_atlas(
    known: AtlasFilms, conditions: ContactConditions, axes: tuple[float, float]
) -> FilmNumbers:
    """Of a contact that the atlas covers, with the moment of the formulas where it has none."""
    found = _as_numbers(known, 0.0)
    if known.rolling_moment is not None:
        return found
    return found._replace(moment=_by_formulas(conditions, axes).moment)


def _as_numbers(known: AtlasFilms, distance: float) -> FilmNumbers:
    """Films of the atlas that count at a distance in ln A, ln L and z [-]."""
    beyond = BEYOND_ERROR * distance
    errors = [one.uncertainty / one.value + beyond for one in (known.central, known.minimum)]
    return FilmNumbers(
        central=known.central.value,
        ratio=known.minimum.value / known.central.value,
        moment=0.0 if known.rolling_moment is None else known.rolling_moment.value,
        error=min(errors[0], FORMULA_ERROR),
        minimum_error=min(errors[1], FORMULA_ERROR),
        atlas=not distance,
    )


def _beyond_atlas(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """Of a contact that the atlas does not cover, by its nearest one that it does."""
    own = _by_formulas(conditions, axes)
    near, distance = nearest_covered(conditions)
    if near is None or not distance:  # its film is too thick
        return own
    (known,) = atlas_films_of([near])
    if isinstance(known, NotInAtlasError):
        return own
    stretch = (near.load / conditions.load) ** (1.0 / 3.0)
    there = _by_formulas(near, (stretch * axes[0], stretch * axes[1]))
    return _beyond(_as_numbers(known, distance), own, there)


def _beyond(known: FilmNumbers, own: FilmNumbers, there: FilmNumbers) -> FilmNumbers:
    """Those of the atlas at the nearest contact times what the formulas change from there."""
    ratio = known.ratio
    if ratio is not None and own.ratio is not None and there.ratio is not None:
        ratio *= own.ratio / there.ratio
    moment = own.moment
    if known.moment:
        moment *= known.moment / there.moment
    central = known.central * own.central / there.central
    return known._replace(central=central, ratio=ratio, moment=moment)


def _by_formulas(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """Those of the formulas alone."""
    central = formula_central(conditions)
    counted = min(central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    return FilmNumbers(
        central=central,
        ratio=_minimum_ratio(conditions),
        moment=flooded_moment(conditions, *axes, counted),
        error=FORMULA_ERROR,
        minimum_error=FORMULA_ERROR,
        atlas=False,
    )


def formula_central(conditions: ContactConditions) -> float:
    """Central film of the formulas [m]: the thicker one, each is far too thin beyond its range."""
    light = LIGHT_CONTACT * film_nijenbanning_central(conditions)
    if not conditions.lubricant.piezoviscous:
        return light
    return max(light, film_chittenden_central(conditions))


def _minimum_ratio(conditions: ContactConditions) -> float | None:
    """Minimum over central film of the formulas [-]; None without pressure-viscosity."""
    if not conditions.lubricant.piezoviscous:
        return None
    return film_hamrock_dowson_minimum(conditions) / film_hamrock_dowson_central(conditions)

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

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

from ehl.closed_form.film import (
    MAX_FILM_OVER_RADIUS,
    film_chittenden_central,
    film_hamrock_dowson_central,
    film_hamrock_dowson_minimum,
    film_nijenbanning_central,
)
from ehl.conditions import ContactConditions
from ehl.traction.atlas.films import NotInAtlasError, atlas_films, nearest_covered

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
    return _film_numbers(alike, (_rounded(axes[0]), _rounded(axes[1])))


def _rounded(value: float) -> float:
    """To `DIGITS`."""
    return float(f"{value:.{DIGITS}g}")


@lru_cache(maxsize=256)
def _film_numbers(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """The same of conditions that are alike."""
    near, distance = nearest_covered(conditions)
    if near is None:
        return _by_formulas(conditions, axes)
    try:
        known = atlas_films(near)
    except NotInAtlasError:  # its film is too thick
        return _by_formulas(conditions, axes)
    beyond = BEYOND_ERROR * distance
    errors = [one.uncertainty / one.value + beyond for one in (known.central, known.minimum)]
    found = FilmNumbers(
        central=known.central.value,
        ratio=known.minimum.value / known.central.value,
        moment=0.0 if known.rolling_moment is None else known.rolling_moment.value,
        error=min(errors[0], FORMULA_ERROR),
        minimum_error=min(errors[1], FORMULA_ERROR),
        atlas=not distance,
    )
    if not distance and known.rolling_moment is not None:
        return found
    own = _by_formulas(conditions, axes)
    if not distance:
        return found._replace(moment=own.moment)
    stretch = (near.load / conditions.load) ** (1.0 / 3.0)
    there = _by_formulas(near, (stretch * axes[0], stretch * axes[1]))
    return _beyond(found, own, there)


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

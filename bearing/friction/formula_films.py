"""Films for the friction of contacts whose film is not solved.

The pressure is Hertz', the film flat. Its thickness, and the moment that resists rolling, are
those of the film atlas where it covers the contact. Under less or more load than it covers, or for
larger L, they are formulas times the ratio of atlas to formulas at the nearest contact that it
covers, so that there is no step; for other oils and ellipses the formulas alone: the central film
of Chittenden et al. (1985), or, in light contacts that they were not made for, that of
Nijenbanning, Venner and Moes (1994) as corrected here, minimum over central film after Hamrock and
Dowson (1977), the moment as `formula_moment` has it. Where the same contact was solved at another
speed or with another oil, film and moment are those of that solution times the ratio of these
numbers here and there.

The formulas alone, against solved films of 6208, 6306, 7012 AC, 6205, 6312 and 61808 (129 points,
M 50 to 10 000): central films within 12 % but one (18 %), minimum films within 20 %.
"""

from dataclasses import dataclass, replace
from math import log
from typing import Any, NamedTuple

import numpy as np

from ehl.closed_form.film import (
    film_chittenden_central,
    film_hamrock_dowson_central,
    film_hamrock_dowson_minimum,
    film_nijenbanning_central,
)
from ehl.conditions import ContactConditions
from ehl.options import SolverOptions
from ehl.scaling import ScaledContact, scale_contact
from ehl.solution import ContactSolution, ConvergenceRecord, FilmValue
from ehl.traction.atlas.films import atlas_films, nearest_covered
from ehl.traction.rolling_moment import rolling_moment

from ..contacts.contact import BearingContact
from ..geometry import Array
from .formula_moment import flooded_moment

POINTS = 33  # along and across the ellipse [-]; 65 change the torque of a 6208 by 0.1 %
# of R_x, the thickest film that counts: beyond, no elastohydrodynamic formula holds [-]
THICKEST_FILM = 0.02
# of Hertz' pressure, from which on a node counts to the contact, whose gap goes with the film;
# ahead of it the gap is that of the bodies [-]
CONTACT_PRESSURE = 0.01
# of Nijenbanning's formula, fitted to what was solved in wide ellipses from M = 1 to 6 (0.785 to
# 0.791) [-]
LIGHT_CONTACT = 0.785
FORMULA_ERROR = 0.2  # of the central film of the formulas alone [-], see above
# of a scaled film, per unit of the logarithm of the speed [-]: from 3000 to 40 r/min the solved
# films of a 6208 fall by 0.05 of that more slowly or faster than the formula
WAY_ERROR = 0.05
# of formulas scaled to the atlas, per unit of ln A and ln L beyond its range [-]
BEYOND_ERROR = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulaFilm:
    """A film that was not solved, in the form of one that was."""

    film: ContactSolution
    central: float  # [m]
    minimum: float | None  # [m]; None: no formula for an oil without pressure-viscosity
    moment: float  # that resists rolling, flooded and isothermal [N m]
    # of the central film: of the formula, or of the solved film and of the way to it [m]
    uncertainty: float
    minimum_uncertainty: float | None  # [m]
    scaled: bool  # to a solved film of the same contact
    atlas: bool = False  # whether film and moment are those of the film atlas

    @property
    def error(self) -> float:
        """Of the central film over it [-]."""
        return self.uncertainty / self.central


def formula_film(
    contact: BearingContact, base: ContactSolution | None = None
) -> FormulaFilm | None:
    """Film of a contact by formulas, None where it carries no load or entrains no oil.

    base: a solved, flooded film of the contact at another speed [m/s] or with another oil, which
    the formulas are scaled to.
    """
    conditions = contact.conditions
    hertz = contact.hertz
    if conditions is None or hertz is None:
        return None
    axes = (hertz.semi_axis_y, hertz.semi_axis_x)
    limit = THICKEST_FILM * conditions.radius_x
    own = film_numbers(conditions, axes)
    central = own.central
    ratio = own.ratio
    moment = own.moment
    error = own.error
    least = own.minimum_error
    if base is not None and isinstance(base.conditions, ContactConditions):
        there = base.conditions
        other = film_numbers(there, axes)
        solved = _known(base.film_minimum) / _known(base.film_central)
        central *= _known(base.film_central) / other.central
        ratio = solved if ratio is None or other.ratio is None else ratio * solved / other.ratio
        moment *= rolling_moment(base).value / other.moment
        way = log(there.entrainment_speed / conditions.entrainment_speed)
        error = base.film_central_dimensionless.relative_uncertainty + WAY_ERROR * abs(way)
        least = error
    elif central > limit:
        moment = flooded_moment(conditions, *axes, limit)
    central = min(central, limit)
    minimum = None if ratio is None else min(ratio, 1.0) * central
    return FormulaFilm(
        film=_flat(conditions, central, minimum)
        if base is None
        else _scaled(base, conditions, central, minimum),
        central=central,
        minimum=minimum,
        moment=moment,
        uncertainty=error * central,
        minimum_uncertainty=None if minimum is None else least * minimum,
        scaled=base is not None,
        atlas=own.atlas and base is None,
    )


def _known(film: float | None) -> float:
    """A film of a solution that converged [m]."""
    assert film is not None
    return film


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
    """
    own = _by_formulas(conditions, axes)
    near, distance = nearest_covered(conditions)
    if near is None:
        return own
    known = atlas_films(near)
    there = own
    if distance:
        stretch = (near.load / conditions.load) ** (1.0 / 3.0)
        there = _by_formulas(near, (stretch * axes[0], stretch * axes[1]))
    central = known.central.value * own.central / there.central
    ratio = known.minimum.value / known.central.value
    if own.ratio is not None and there.ratio is not None:
        ratio *= own.ratio / there.ratio
    moment = own.moment
    if known.rolling_moment is not None:
        moment *= known.rolling_moment.value / there.moment
    beyond = BEYOND_ERROR * distance
    errors = [one.uncertainty / one.value + beyond for one in (known.central, known.minimum)]
    return FilmNumbers(
        central=central,
        ratio=ratio,
        moment=moment,
        error=min(errors[0], FORMULA_ERROR),
        minimum_error=min(errors[1], FORMULA_ERROR),
        atlas=not distance,
    )


def _by_formulas(conditions: ContactConditions, axes: tuple[float, float]) -> FilmNumbers:
    """Those of the formulas alone."""
    central = formula_central(conditions)
    counted = min(central, THICKEST_FILM * conditions.radius_x)
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
    if conditions.lubricant.pressure_viscosity <= 0.0:
        return light
    return max(light, film_chittenden_central(conditions))


def _minimum_ratio(conditions: ContactConditions) -> float | None:
    """Minimum over central film of the formulas [-]; None without pressure-viscosity."""
    if conditions.lubricant.pressure_viscosity <= 0.0:
        return None
    return film_hamrock_dowson_minimum(conditions) / film_hamrock_dowson_central(conditions)


def _flat(conditions: ContactConditions, central: float, minimum: float | None) -> ContactSolution:
    """Hertz' pressure and a flat film [m] over the ellipse."""
    contact = scale_contact(conditions)
    X = np.linspace(-contact.half_extent_x, contact.half_extent_x, POINTS)
    Y = np.linspace(-contact.half_extent_y, contact.half_extent_y, POINTS)
    pressure = contact.dry_pressure(X[:, None], Y[None, :])
    film = np.full_like(pressure, central / _scale(contact))
    none = ConvergenceRecord(
        residual=(),
        force_error=(),
        film_change=(),
        cycles=0,
        fft_equivalents=0.0,
        fallbacks=(),
        wall_time=0.0,
    )
    return ContactSolution(
        conditions=conditions,
        options=SolverOptions(),
        X=X,
        Y=Y,
        P=pressure,
        H=film,
        approach_dimensionless=0.0,
        semi_axis_ratio=contact.semi_axis_ratio,
        frame_angle=contact.frame_angle,
        domain=(float(X[0]), float(X[-1]), float(Y[-1])),
        resolved=False,
        converged=True,
        message="film of a formula",
        record=none,
        **_values(contact, central, minimum),
    )


def _values(contact: ScaledContact, central: float, minimum: float | None) -> dict[str, Any]:
    """Numbers of a solution of a film [m], under Hertz' pressure."""
    scale = _scale(contact)
    least = central if minimum is None else minimum
    return {
        "film_central_dimensionless": _value(central / scale),
        "film_minimum_dimensionless": _value(least / scale),
        "moes_load": contact.moes_load,
        "moes_lubricant": contact.moes_lubricant,
        "semi_axis_x": contact.semi_axis_x,
        "hertz_pressure": contact.hertz_pressure,
        "film_scale": scale,
    }


def _value(film: float) -> FilmValue:
    return FilmValue(value=film, uncertainty=0.0, finest=film)


def _scale(contact: ScaledContact) -> float:
    """a^2/Rx of a contact with dimensions [m]."""
    assert contact.film_scale is not None
    return contact.film_scale


def _scaled(
    base: ContactSolution, conditions: ContactConditions, central: float, minimum: float | None
) -> ContactSolution:
    """A solved film with another thickness [m] in the contact, under other conditions."""
    contact = scale_contact(conditions)
    assert base.film_scale is not None
    ratio = central / _known(base.film_central)
    gap: Array = base.H * base.film_scale / _scale(contact)
    return replace(
        base,
        conditions=conditions,
        H=np.where(base.P > CONTACT_PRESSURE, ratio * gap, gap),
        message="film of a formula, scaled to a solved one",
        **_values(contact, central, minimum),
    )


def with_gap(film: ContactSolution, share: float) -> ContactSolution:
    """A film whose gap in the contact is a share of what it was [-]."""
    if share == 1.0:
        return film
    inside = film.P > CONTACT_PRESSURE
    return replace(film, H=np.where(inside, share * film.H, film.H))

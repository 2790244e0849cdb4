"""Films for the friction of contacts whose film is not solved.

Pressure and shape are those of the film atlas. Thickness, and the moment that resists rolling, are
those of atlas and formulas (`contacts.film_numbers`). Where the same contact was solved at another
speed or with another oil, film and moment are those of that solution times the ratio of these
numbers here and there.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

import numpy as np

from ehl.closed_form.film import MAX_FILM_OVER_RADIUS
from ehl.closed_form.hertz import HertzContact
from ehl.conditions import ContactConditions
from ehl.scaling import scale_contact
from ehl.solution import ContactSolution
from ehl.traction.rolling_moment import rolling_moment

from ..contacts.contact import BearingContact
from ..contacts.film_heat import film_heat, solved_with_heat
from ..contacts.film_numbers import FilmNumbers, film_numbers, film_numbers_of
from ..geometry import Array
from .unsolved_film import CONTACT_PRESSURE, UnsolvedFilm, film_scale, film_values, hertz_size

# of a scaled film, per unit of the logarithm of the speed [-]: from 3000 to 40 r/min the solved
# films of a 6208 fall by 0.05 of that more slowly or faster than the formula
WAY_ERROR = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulaFilm:
    """An isothermal film that was not solved, in the form of one that was."""

    film: ContactSolution | UnsolvedFilm
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


def formula_films(contacts: Sequence[BearingContact | None]) -> list[FormulaFilm | None]:
    """Films of contacts by formulas, None where there is none, or it carries no load or entrains
    no oil.
    """
    found: list[FormulaFilm | None] = [None] * len(contacts)
    pairs = {
        n: pair
        for n, own in enumerate(contacts)
        if own is not None and (pair := _pair(own)) is not None
    }
    numbers = film_numbers_of([(conditions, _axes(hertz)) for conditions, hertz in pairs.values()])
    for (n, pair), own in zip(pairs.items(), numbers, strict=True):
        found[n] = _unsolved(*pair, own)
    return found


def formula_film(
    contact: BearingContact, base: ContactSolution | None = None
) -> FormulaFilm | None:
    """Film of a contact by formulas, None where it carries no load or entrains no oil.

    base: a solved, flooded film of the contact at another speed [m/s] or with another oil, which
    the formulas are scaled to.
    """
    pair = _pair(contact)
    if pair is None:
        return None
    conditions, hertz = pair
    own = film_numbers(conditions, _axes(hertz))
    if base is None or not isinstance(base.conditions, ContactConditions):
        return _unsolved(conditions, hertz, own)
    known = (conditions, _axes(hertz))
    return _scaled_film(contact, known, own, base, base.conditions)


def _pair(contact: BearingContact) -> tuple[ContactConditions, HertzContact] | None:
    """Conditions and the dry contact, where there are both."""
    if contact.conditions is None or contact.hertz is None:
        return None
    return contact.conditions, contact.hertz


def _axes(hertz: HertzContact) -> tuple[float, float]:
    """Hertz' semi-axes across and along rolling [m]."""
    return hertz.semi_axis_y, hertz.semi_axis_x


def _unsolved(conditions: ContactConditions, hertz: HertzContact, own: FilmNumbers) -> FormulaFilm:
    """A film by these numbers."""
    central = min(own.central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    minimum = None if own.ratio is None else min(own.ratio, 1.0) * central
    return FormulaFilm(
        film=UnsolvedFilm(
            conditions=conditions,
            central=central,
            minimum=minimum,
            size=hertz_size(conditions, hertz),
        ),
        central=central,
        minimum=minimum,
        moment=own.moment,
        uncertainty=own.error * central,
        minimum_uncertainty=None if minimum is None else own.minimum_error * minimum,
        scaled=False,
        atlas=own.atlas,
    )


def _scaled_film(
    contact: BearingContact,
    pair: tuple[ContactConditions, tuple[float, float]],
    own: FilmNumbers,
    base: ContactSolution,
    there: ContactConditions,
) -> FormulaFilm:
    """A film solved under other conditions, scaled by these numbers."""
    conditions, axes = pair
    other = film_numbers(there, axes)
    solved = _known(base.film_minimum) / _known(base.film_central)
    central = own.central * _known(base.film_central) / other.central
    if solved_with_heat(base):
        central /= film_heat(replace(contact, conditions=there)).value
    central = min(central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    ratio = solved
    if own.ratio is not None and other.ratio is not None:
        ratio = own.ratio * solved / other.ratio
    minimum = min(ratio, 1.0) * central
    way = log(there.entrainment_speed / conditions.entrainment_speed)
    error = base.film_central_dimensionless.relative_uncertainty + WAY_ERROR * abs(way)
    return FormulaFilm(
        film=_scaled(base, conditions, central, minimum),
        central=central,
        minimum=minimum,
        moment=own.moment * rolling_moment(base).value / other.moment,
        uncertainty=error * central,
        minimum_uncertainty=error * minimum,
        scaled=True,
    )


def _known(film: float | None) -> float:
    """A film of a solution that converged [m]."""
    assert film is not None
    return film


def _scaled(
    base: ContactSolution, conditions: ContactConditions, central: float, minimum: float | None
) -> ContactSolution:
    """A solved film with another thickness [m] in the contact, under other conditions."""
    contact = scale_contact(conditions)
    assert base.film_scale is not None
    ratio = central / _known(base.film_central)
    gap: Array = base.H * base.film_scale / film_scale(contact)
    return replace(
        base,
        conditions=conditions,
        H=np.where(base.P > CONTACT_PRESSURE, ratio * gap, gap),
        message="film of a formula, scaled to a solved one",
        **film_values(contact, central, minimum),
    )

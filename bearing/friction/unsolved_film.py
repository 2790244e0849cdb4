"""A film that is not solved: its thickness over Hertz' ellipse.

Its friction takes pressure and film of the film atlas (`film_nodes`), the heat through it Hertz'
pressure and a flat film, which are the same for all contacts in units of the semi-axes.
"""

from dataclasses import dataclass, replace
from functools import cache
from math import hypot, inf
from typing import Any

import numpy as np

from ehl.closed_form.hertz import HertzContact, ellipse_ratio, hertz_coefficients, hertz_deflection
from ehl.closed_form.inlet_heat import HeatShare
from ehl.conditions import ContactConditions
from ehl.scaling import ScaledContact
from ehl.solution import ContactSolution, FilmValue

from ..geometry import Array

POINTS = 33  # along and across the ellipse [-]; 129 conduct 0.9 % more in a 6306
# of Hertz' pressure, from which on a node counts to the contact, whose gap goes with the film;
# ahead of it the gap is that of the bodies [-]
CONTACT_PRESSURE = 0.01


@dataclass(frozen=True, kw_only=True)
class UnsolvedFilm:
    """Of one contact with entrainment along a principal direction."""

    conditions: ContactConditions
    central: float  # [m]
    minimum: float | None  # [m]; None: not known
    # semi-axes along and across rolling [m], Hertz' pressure [Pa], of the conditions: `hertz_size`
    size: tuple[float, float, float]
    share: float = 1.0  # of the gap in the contact that a supply leaves [-]

    @property
    def gap(self) -> float:
        """In the contact [m]; around it the gap is `central`."""
        return self.share * self.central


def hertz_size(
    conditions: ContactConditions, dry: HertzContact | None = None
) -> tuple[float, float, float]:
    """Semi-axes along and across rolling [m], Hertz' pressure [Pa] of conditions; those of the dry
    contact where it has the same load and radii.
    """
    c = conditions
    if dry is not None and (c.load, c.radius_x, c.radius_y, c.reduced_modulus) == (
        *(dry.load, dry.radius_x, dry.radius_y, dry.reduced_modulus),
    ):
        return dry.semi_axis_x, dry.semi_axis_y, dry.pressure
    ratio = c.radius_x / c.radius_y
    f, g, _ = hertz_coefficients(ratio)
    load = (c.load / (c.reduced_modulus * c.radius_x**2)) ** (1.0 / 3.0)
    along = f * load * c.radius_x
    return along, ellipse_ratio(ratio) * along, g * load * c.reduced_modulus


def film_values(contact: ScaledContact, central: float, minimum: float | None) -> dict[str, Any]:
    """Numbers of a solution of a film [m], under Hertz' pressure."""
    scale = film_scale(contact)
    least = central if minimum is None else minimum
    ratio = contact.semi_axis_ratio
    approach = central / scale - contact.deformation * contact.load * hertz_deflection(
        0.0, 0.0, ratio
    )
    return {
        "approach_dimensionless": FilmValue(value=approach, uncertainty=inf, finest=approach),
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


def film_scale(contact: ScaledContact) -> float:
    """a^2/Rx of a contact with dimensions [m]."""
    assert contact.film_scale is not None
    return contact.film_scale


def with_gap(film: ContactSolution | UnsolvedFilm, share: float) -> ContactSolution | UnsolvedFilm:
    """A film whose gap in the contact is a share of what it was [-]."""
    if share == 1.0:
        return film
    if isinstance(film, UnsolvedFilm):
        return replace(film, share=share * film.share)
    inside = film.P > CONTACT_PRESSURE
    return replace(film, H=np.where(inside, share * film.H, film.H))


def heated_solution(film: ContactSolution, share: HeatShare) -> ContactSolution:
    """A solved film with what the heat of its inlet leaves of it [-], the range in its error
    bars.
    """
    if share.value == 1.0:
        return film
    thin = with_gap(film, share.value)
    assert isinstance(thin, ContactSolution)
    return replace(
        thin,
        film_central_dimensionless=_heated(film.film_central_dimensionless, share),
        film_minimum_dimensionless=_heated(film.film_minimum_dimensionless, share),
    )


def _heated(film: FilmValue, share: HeatShare) -> FilmValue:
    return FilmValue(
        value=share.value * film.value,
        uncertainty=hypot(share.value * film.uncertainty, share.uncertainty * film.value),
        finest=share.value * film.finest,
    )


@cache
def hertz_pressures() -> tuple[Array, Array]:
    """Pressure over Hertz' on `POINTS` lines over the ellipse along rolling, of them those with y
    >= 0, shape (POINTS, POINTS // 2 + 1), and how many each of these stands for [-].
    """
    steps = POINTS // 2
    places = np.arange(-steps, steps + 1)
    left = np.maximum(steps**2 - places[:, None] ** 2 - places[steps:] ** 2, 0)
    count = np.full(left.shape[1], 2.0)
    count[0] = 1.0
    return np.sqrt(left) / steps, count

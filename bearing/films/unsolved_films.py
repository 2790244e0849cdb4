"""Films and rolling moments of the film atlas and of formulas, for contacts whose film is not
solved.

They are those of the film atlas where it covers the contact. Under less or more load than it
covers, or for larger L, they are formulas times the ratio of atlas to formulas at the nearest
contact that it covers, so that there is no step; for other oils and ellipses the formulas alone:
the central film of Chittenden et al. (1985), or, in light contacts that they were not made for,
that of Nijenbanning, Venner and Moes (1994) as corrected here, minimum over central film after
Hamrock and Dowson (1977), the moment as follows. Where the same contact was solved at another
speed or with another oil, film and moment are those of that solution times the ratio of these
values here and there.

The formulas alone, against solved films of 6208, 6306, 7012 AC, 6205, 6312 and 61808 (129 points,
M 50 to 10 000): central films within 12 % but one (18 %), minimum films within 20 %.

Moment that resists rolling in a flooded, isothermal contact: a light contact hardly changes the
gap of the bodies, h_0 + x^2/(2 Rx) + y^2/(2 Ry); there Kapitza's (1955) pressure -K x/h^2, K = 12
eta_0 u/(3 + 2 Rx/Ry), is the solution. Its moment up to the meniscus, where the gap is as wide as
the layer that floods the contact, goes to zero as the film goes to that layer. Under heavy loads
Biboulet and Houpert's (2010) formula holds, which knows no layer and does not vanish with the
contact. Both together, with M_0 = 24 pi eta_0 u Rx^2/((3 + 2 Rx/Ry) sqrt(Rx/Ry)),

    M = M_Kapitza + M_0 f(M_Biboulet/M_0),   f(e) = (z + sqrt(z^2 + w^2))/2,   z = s e - t,

f fitted to the film atlas (`SLOPE`, `START`, `WIDTH`).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf, log
from typing import Any, NamedTuple

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.atlas.films import (
    AtlasFilms,
    NotInAtlasError,
    atlas_films_of_contacts,
    nearest_covered,
    skewed,
)
from oilfilm.ehl.closed_form.film import (
    MAX_FILM_OVER_RADIUS,
    film_chittenden_central,
    film_hamrock_dowson_central,
    film_hamrock_dowson_minimum,
    film_nijenbanning_central,
)
from oilfilm.ehl.closed_form.hertz import (
    HertzContact,
    ellipse_ratio,
    hertz_coefficients,
    hertz_deflection,
)
from oilfilm.ehl.closed_form.thermal_reduction import inlet_groups, thermal_reductions
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.scaling import ScaledContact, scale_contact
from oilfilm.ehl.solution import ContactSolution, FilmValue
from oilfilm.ehl.traction.rolling_moment import rolling_moment

from ..contacts.contact import BearingContact
from .film import (
    CONTACT_PRESSURE,
    ContactFilm,
    EllipseSize,
    FilmOrigin,
    FilmThickness,
    first_same,
    solved_with_heat,
)
from .moment import flooded_moment

# factor of Nijenbanning's formula, fitted to solved films of wide ellipses, M = 1 to 6 (R_x/R_y
# 0.02 to 0.1: 0.823 to 0.846) [-]
LIGHT_CONTACT = 0.83
DIGITS = 10  # of conditions and axes in which contacts are alike
FORMULA_ERROR = 0.2  # of the central film of the formulas alone [-], see above
# error of formulas scaled to the atlas, per unit of ln A, ln L and z beyond its range [-]
BEYOND_ERROR = 0.1

# error of a scaled film per unit of the logarithm of the speed [-]: from 3000 to 40 r/min solved
# films of a 6208 fall by 0.05 of that more slowly or faster than the formula
WAY_ERROR = 0.05
# Inlets are about H^(2/3) semi-axes long, H the film in units of a^2/Rx. Cells that they have at
# least: where an error bar is asked for, and on a mesh that is given. A 6208 at 2000 N solves on
# 1025 nodes down to 7.3 (40 r/min); with 1.8 the film of a 6312 was off by 38 %.
CELLS_BY_TOLERANCE = 8.0
CELLS_BY_POINTS = 1.5
BOX = 5.0  # length of a box of such a film, about [semi-axes]
SEARCH = 60  # halvings of the logarithm of the speed
FASTEST = 1.0e9  # factor that is searched [-]
THICKEST = 0.017  # film over R_x above which none is solved: with the formula's error, 2 % [-]


class FormulaValues(NamedTuple):
    """Film and moment of a flooded, isothermal contact whose film is not solved."""

    central: float  # [m]
    ratio: float | None  # minimum over central film [-]; None: not known
    moment: float  # that resists rolling [N m]
    error: float  # of the central film [-]
    minimum_error: float  # of the minimum film [-]
    atlas: bool  # whether they are those of the film atlas


def formula_values(conditions: ContactConditions, axes: tuple[float, float]) -> FormulaValues:
    """Film and moment of the atlas, or of formulas scaled to it at the nearest load that it
    covers, or of formulas.

    Sliding does not count, nor on which side the entrainment turns: balls on both sides of a load
    have theirs once.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    axes : tuple of float
        Hertz' semi-axes across and along rolling [m].

    Returns
    -------
    FormulaValues
        Flooded and isothermal.
    """
    return _numbers([_alike(conditions, axes)])[0]


def formula_values_of(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[FormulaValues]:
    """Values of many contacts at once, as `formula_values`.

    Parameters
    ----------
    contacts : sequence of (ContactConditions, tuple of float)
        Conditions, and Hertz' semi-axes across and along rolling [m].

    Returns
    -------
    list of FormulaValues
        In the order of the contacts.
    """
    kinds = kinds_of_contacts(contacts)
    first = dict(zip(reversed(kinds), reversed(contacts), strict=True))
    distinct = list(dict.fromkeys(kinds))
    numbers = _numbers([_alike(*first[kind]) for kind in distinct])
    found = dict(zip(distinct, numbers, strict=True))
    return [found[kind] for kind in kinds]


def kinds_of_contacts(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[tuple[Any, ...]]:
    """Keys that equal contacts share: numbers to `DIGITS`, the rest the very same objects.

    Parameters
    ----------
    contacts : sequence of (ContactConditions, tuple of float)
        Conditions, and Hertz' semi-axes across and along rolling [m].

    Returns
    -------
    list of tuple
        In the order of the contacts.
    """
    numbers = np.array(
        [
            (c.load, c.radius_x, c.radius_y, c.entrainment_speed, abs(c.rotation), *axes)
            for c, axes in contacts
        ]
    ).reshape(-1, 7)
    places = DIGITS - 1 - np.floor(np.log10(np.where(numbers > 0.0, numbers, 1.0)))
    rows = np.stack([np.rint(numbers * 10.0**places), places], axis=1)
    same = [
        first_same([getattr(c, name) for c, _ in contacts])
        for name in ("lubricant", "coating", "inlet_layer")
    ]
    return [
        (row.tobytes(), c.reduced_modulus, c.entrainment_angle, c.ball_radius, *objects)
        for row, (c, _), *objects in zip(rows, contacts, *same, strict=True)
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


def _numbers(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> list[FormulaValues]:
    """The same of many contacts that differ: of the atlas, or as far beyond it as it is."""
    known = atlas_films_of_contacts([conditions for conditions, _ in contacts])
    values = [
        None
        if isinstance(films, NotInAtlasError) or skewed(contact[0].entrainment_angle)
        else _of_atlas(films, *contact)
        for contact, films in zip(contacts, known, strict=True)
    ]
    outside = [contact for contact, one in zip(contacts, values, strict=True) if one is None]
    beyond = _beyond_atlas(outside)
    return [next(beyond) if one is None else one for one in values]


def _of_atlas(
    atlas: AtlasFilms, conditions: ContactConditions, axes: tuple[float, float]
) -> FormulaValues:
    """Values of a contact that the atlas covers, the moment by formulas where it has none."""
    found = _as_numbers(atlas, 0.0)
    if atlas.rolling_moment is not None:
        return found
    return found._replace(moment=_by_formulas(conditions, axes).moment)


def _as_numbers(atlas: AtlasFilms, distance: float) -> FormulaValues:
    """Films of the atlas that count at a distance in ln A, ln L and z [-]."""
    beyond = BEYOND_ERROR * distance
    errors = [one.uncertainty / one.value + beyond for one in (atlas.central, atlas.minimum)]
    return FormulaValues(
        central=atlas.central.value,
        ratio=atlas.minimum.value / atlas.central.value,
        moment=0.0 if atlas.rolling_moment is None else atlas.rolling_moment.value,
        error=min(errors[0], FORMULA_ERROR),
        minimum_error=min(errors[1], FORMULA_ERROR),
        atlas=not distance,
    )


def _beyond_atlas(
    contacts: Sequence[tuple[ContactConditions, tuple[float, float]]],
) -> Iterator[FormulaValues]:
    """Values of contacts that the atlas does not cover, by the nearest ones that it does; by
    formulas where there is none, or its film is too thick.
    """
    nearest = [nearest_covered(conditions) for conditions, _ in contacts]
    films = iter(atlas_films_of_contacts([near for near, way in nearest if near and way]))
    for (conditions, axes), (near, way) in zip(contacts, nearest, strict=True):
        own = _by_formulas(conditions, axes)
        known = next(films) if near and way else None
        if near is None or known is None or isinstance(known, NotInAtlasError):
            yield own
            continue
        stretch = (near.load / conditions.load) ** (1.0 / 3.0)
        there = _by_formulas(near, (stretch * axes[0], stretch * axes[1]))
        yield _beyond(_as_numbers(known, way), own, there)


def _by_formulas(conditions: ContactConditions, axes: tuple[float, float]) -> FormulaValues:
    """Values of the formulas alone."""
    central = formula_central(conditions)
    counted = min(central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    return FormulaValues(
        central=central,
        ratio=_minimum_ratio(conditions),
        moment=flooded_moment(conditions, *axes, counted),
        error=FORMULA_ERROR,
        minimum_error=FORMULA_ERROR,
        atlas=False,
    )


def formula_central(conditions: ContactConditions) -> float:
    """Central film of the formulas: the thicker one, each is far too thin beyond its range.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.

    Returns
    -------
    float
        Flooded and isothermal [m].
    """
    light = LIGHT_CONTACT * film_nijenbanning_central(conditions)
    if not conditions.lubricant.piezoviscous:
        return light
    return max(light, film_chittenden_central(conditions))


def _minimum_ratio(conditions: ContactConditions) -> float | None:
    """Minimum over central film of the formulas [-]; None without pressure-viscosity."""
    if not conditions.lubricant.piezoviscous:
        return None
    return film_hamrock_dowson_minimum(conditions) / film_hamrock_dowson_central(conditions)


def formula_films(contacts: Sequence[BearingContact | None]) -> list[ContactFilm | None]:
    """Films of contacts by the film atlas or formulas.

    Parameters
    ----------
    contacts : sequence of BearingContact or None
        None where no film is wanted.

    Returns
    -------
    list of ContactFilm or None
        None where there is no contact, or it carries no load or entrains no oil.
    """
    films: list[ContactFilm | None] = [None] * len(contacts)
    pairs = {
        n: pair
        for n, contact in enumerate(contacts)
        if contact is not None and (pair := _pair(contact)) is not None
    }
    values = formula_values_of([(given, _axes(hertz)) for given, hertz in pairs.values()])
    for (n, (conditions, hertz)), one in zip(pairs.items(), values, strict=True):
        films[n] = _unsolved(conditions, hertz, one)
    return films


def formula_film(
    contact: BearingContact, base: ContactSolution | None = None
) -> ContactFilm | None:
    """Film of a contact by the film atlas or formulas, or by formulas scaled to a solved film.

    Parameters
    ----------
    contact : BearingContact
        Contact of a bearing.
    base : ContactSolution, optional
        A solved, flooded film of the contact at another speed or with another oil, which the
        formulas are scaled to.

    Returns
    -------
    ContactFilm or None
        None where the contact carries no load or entrains no oil.
    """
    pair = _pair(contact)
    if pair is None:
        return None
    conditions, hertz = pair
    values = formula_values(conditions, _axes(hertz))
    if base is None or not isinstance(base.conditions, ContactConditions):
        return _unsolved(conditions, hertz, values)
    there = base.conditions
    return _scaled_film(conditions, hertz, values, base, there, contact.effusivities)


def atlas_film(contact: BearingContact, films: AtlasFilms | None) -> ContactFilm | None:
    """Film of a contact by its films of the atlas.

    Parameters
    ----------
    contact : BearingContact
        Contact of a bearing.
    films : AtlasFilms or None
        Its films of the atlas [m].

    Returns
    -------
    ContactFilm or None
        None without films, or where the contact carries no load or entrains no oil.
    """
    pair = _pair(contact)
    if films is None or pair is None:
        return None
    central, minimum = films.central, films.minimum
    return ContactFilm(
        conditions=pair[0],
        size=hertz_size(*pair),
        origin=FilmOrigin.ATLAS,
        central=FilmThickness(central.value, central.uncertainty),
        minimum=FilmThickness(minimum.value, minimum.uncertainty),
        isothermal_central=central.value,
        isothermal_minimum=minimum.value,
        flooded_central=central.value,
        flooded_minimum=minimum.value,
        flooded_moment=0.0 if films.rolling_moment is None else films.rolling_moment.value,
    )


def plain_film(conditions: ContactConditions, central: float) -> ContactFilm:
    """Film of one central thickness with the pressure and shape of the film atlas.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    central : float
        Central film [m].

    Returns
    -------
    ContactFilm
        Without minimum film, rolling moment and error.
    """
    return ContactFilm(
        conditions=conditions,
        size=hertz_size(conditions),
        origin=FilmOrigin.FORMULA,
        central=FilmThickness(central),
        flooded_central=central,
    )


def _pair(contact: BearingContact) -> tuple[ContactConditions, HertzContact] | None:
    """Conditions and the dry contact, where there are both."""
    if contact.conditions is None or contact.hertz is None:
        return None
    return contact.conditions, contact.hertz


def _axes(hertz: HertzContact) -> tuple[float, float]:
    """Hertz' semi-axes across and along rolling [m]."""
    return hertz.semi_axis_y, hertz.semi_axis_x


def _unsolved(
    conditions: ContactConditions, hertz: HertzContact, values: FormulaValues
) -> ContactFilm:
    """A film by these values."""
    central = min(values.central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    minimum = thickness = None
    if values.ratio is not None:
        minimum = min(values.ratio, 1.0) * central
        thickness = FilmThickness(minimum, values.minimum_error * minimum)
    return ContactFilm(
        conditions=conditions,
        size=hertz_size(conditions, hertz),
        origin=FilmOrigin.ATLAS if values.atlas else FilmOrigin.FORMULA,
        central=FilmThickness(central, values.error * central),
        minimum=thickness,
        isothermal_central=central,
        isothermal_minimum=minimum,
        flooded_central=central,
        flooded_minimum=minimum,
        flooded_moment=values.moment,
    )


def _scaled_film(
    conditions: ContactConditions,
    hertz: HertzContact,
    values: FormulaValues,
    base: ContactSolution,
    there: ContactConditions,
    effusivities: tuple[float, float],
) -> ContactFilm:
    """A film solved under other conditions, scaled by these values."""
    other = formula_values(there, _axes(hertz))
    solved = _converged(base.film_minimum) / _converged(base.film_central)
    central = values.central * _converged(base.film_central) / other.central
    if solved_with_heat(base):
        groups = inlet_groups(there, other.central, hertz.semi_axis_x, effusivities)
        (heat,) = thermal_reductions(groups[None], [heat_of(there.lubricant).ranges])
        central /= heat.central.value
        solved *= heat.central.value / heat.minimum.value
    central = min(central, MAX_FILM_OVER_RADIUS * conditions.radius_x)
    ratio = solved
    if values.ratio is not None and other.ratio is not None:
        ratio = values.ratio * solved / other.ratio
    minimum = min(ratio, 1.0) * central
    way = log(there.entrainment_speed / conditions.entrainment_speed)
    error = base.film_central_dimensionless.relative_uncertainty + WAY_ERROR * abs(way)
    return ContactFilm(
        conditions=conditions,
        size=hertz_size(conditions, hertz),
        origin=FilmOrigin.FORMULA,
        field=_scaled(base, conditions, central, minimum),
        central=FilmThickness(central, error * central),
        minimum=FilmThickness(minimum, error * minimum),
        isothermal_central=central,
        isothermal_minimum=minimum,
        flooded_central=central,
        flooded_minimum=minimum,
        flooded_moment=values.moment * rolling_moment(base).value / other.moment,
    )


def _converged(film: float | None) -> float:
    """A film of a solution that converged [m]."""
    assert film is not None
    return film


def _scaled(
    base: ContactSolution, conditions: ContactConditions, central: float, minimum: float
) -> ContactSolution:
    """A solved film with another thickness [m] in the contact, under other conditions."""
    contact = scale_contact(conditions)
    assert base.film_scale is not None
    ratio = central / _converged(base.film_central)
    gap: Array = base.H * base.film_scale / film_scale(contact)
    return replace(
        base,
        conditions=conditions,
        H=np.where(base.P > CONTACT_PRESSURE, ratio * gap, gap),
        message="film of a formula, scaled to a solved one",
        **_solution_values(contact, central, minimum),
    )


def hertz_size(conditions: ContactConditions, dry: HertzContact | None = None) -> EllipseSize:
    """Hertz' ellipse of conditions.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    dry : HertzContact, optional
        Taken where it has the load and radii of the conditions.

    Returns
    -------
    EllipseSize
        Semi-axes [m] and Hertz' pressure [Pa].
    """
    c = conditions
    if dry is not None and (c.load, c.radius_x, c.radius_y, c.reduced_modulus) == (
        *(dry.load, dry.radius_x, dry.radius_y, dry.reduced_modulus),
    ):
        return EllipseSize(dry.semi_axis_x, dry.semi_axis_y, dry.pressure)
    ratio = c.radius_x / c.radius_y
    f, g, _ = hertz_coefficients(ratio)
    load = (c.load / (c.reduced_modulus * c.radius_x**2)) ** (1.0 / 3.0)
    along = f * load * c.radius_x
    return EllipseSize(along, ellipse_ratio(ratio) * along, g * load * c.reduced_modulus)


def _solution_values(contact: ScaledContact, central: float, minimum: float) -> dict[str, Any]:
    """Numbers of a solution of a film [m], under Hertz' pressure."""
    scale = film_scale(contact)
    ratio = contact.semi_axis_ratio
    approach = central / scale - contact.deformation * contact.load * hertz_deflection(
        0.0, 0.0, ratio
    )
    return {
        "approach_dimensionless": FilmValue(value=approach, uncertainty=inf, finest=approach),
        "film_central_dimensionless": _exact(central / scale),
        "film_minimum_dimensionless": _exact(minimum / scale),
        "moes_load": contact.moes_load,
        "moes_lubricant": contact.moes_lubricant,
        "semi_axis_x": contact.semi_axis_x,
        "hertz_pressure": contact.hertz_pressure,
        "film_scale": scale,
    }


def _exact(film: float) -> FilmValue:
    return FilmValue(value=film, uncertainty=0.0, finest=film)


def film_scale(contact: ScaledContact) -> float:
    """Unit of the films of a contact with dimensions.

    Parameters
    ----------
    contact : ScaledContact
        With lengths.

    Returns
    -------
    float
        a^2/Rx [m].
    """
    assert contact.film_scale is not None
    return contact.film_scale


def too_thick(conditions: ContactConditions) -> bool:
    """Check whether no film is given, the contact being too light for its speed.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.

    Returns
    -------
    bool
        True where the film exceeds `THICKEST` of R_x by formula.
    """
    return formula_central(conditions) > THICKEST * conditions.radius_x


def resolvable(conditions: ContactConditions, points: int, cells: float) -> ContactConditions:
    """The contact at the lowest speed, from its own on, at which a mesh resolves its film.

    Parameters
    ----------
    conditions : ContactConditions
        Of the contact.
    points : int
        Nodes along x [-].
    cells : float
        Over the length of the inlet, at least [-].

    Returns
    -------
    ContactConditions
        The same object where the mesh resolves its film.
    """
    needed = (cells * BOX / (points - 1)) ** 1.5

    def fine(factor: float) -> bool:
        at = replace(conditions, entrainment_speed=factor * conditions.entrainment_speed)
        scale = scale_contact(at).film_scale
        assert scale is not None  # with dimensions
        return formula_central(at) / scale >= needed

    if fine(1.0):
        return conditions
    low = 1.0
    high = FASTEST
    for _ in range(SEARCH):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if fine(middle) else (middle, high)
    return replace(conditions, entrainment_speed=high * conditions.entrainment_speed)


def _beyond(atlas: FormulaValues, here: FormulaValues, there: FormulaValues) -> FormulaValues:
    """Values of the atlas at the nearest contact times the change of the formulas from there."""
    ratio = atlas.ratio
    if ratio is not None and here.ratio is not None and there.ratio is not None:
        ratio *= here.ratio / there.ratio
    moment = here.moment
    if atlas.moment:
        moment *= atlas.moment / there.moment
    central = atlas.central * here.central / there.central
    return atlas._replace(central=central, ratio=ratio, moment=moment)


def film_lag(contact: ContactConditions, hertz: HertzContact) -> float:
    r"""Movement of the film of a rolling ball per rate of load at slow movement, an estimate.

    The film follows the load after the time the oil takes through the contact: with h ~ Q^-n and
    the delay T = 5 a/u, the approach w(Q) - h(Q) + T h' dQ/dt has the damping

    .. math:: c = n T \frac{h k^2}{Q} = \frac{h a k^2}{3 u Q}, \qquad k = dQ/dw.

    Solved responses (`ehl.traction.linear_response`) of races with Ry/Rx of 10 to 45 under 40 to
    2000 N have 0.97 to 1.1 of it, of a circle 0.6. At the balls' own vibration, 10 kHz and more,
    films damp 0.1 to 0.6 of it.

    Parameters
    ----------
    contact : ContactConditions
        Load, speed, oil.
    hertz : HertzContact
        Its ellipse.

    Returns
    -------
    float
        c/k^2 [m s/N].
    """
    film = film_nijenbanning_central(contact)
    speed = abs(contact.entrainment_speed)
    return film * hertz.semi_axis_x / (3.0 * speed * contact.load)

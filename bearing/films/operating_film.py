"""Films as the bearing runs: what oil supply, heat of the inlet and asperities leave of them.

A film is computed flooded or behind a layer, isothermal or with heat. What is not in it comes as a
fraction of its part of the friction: inlet shear heating and starvation on the gap that shears and
on the rolling moment, asperities on the load that the oil carries.
"""

from collections.abc import Hashable, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from oilfilm.ehl.closed_form.film import film_error_nijenbanning
from oilfilm.ehl.closed_form.thermal_reduction import (
    NO_HEAT,
    InletHeat,
    ThermalReduction,
    inlet_groups,
    thermal_reductions,
)
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.solution import ContactSolution
from oilfilm.ehl.traction.rolling_moment import rolling_moment

from ..contacts.contact import BearingContact
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import OilAtInlets, ReplenishedInlet
from ..supply.supply import inlet_layer, shares_behind
from .asperities import Asperities
from .film import (
    FLOODED,
    ContactFilm,
    FilmOrigin,
    Films,
    FilmThickness,
    SupplyFractions,
    first_same,
    solved_with_heat,
)
from .heavy_moment import elastic_moment
from .unsolved_films import formula_films, formula_values, hertz_size, kinds_of_contacts


def on_tracks(
    supply: OilAtInlets, contacts: Sequence[BearingContact], films: Films | None = None
) -> OilAtInlets:
    """The oil with one layer for each race: that of its heaviest contact, by the flooded film of
    the film atlas or formulas, which all balls of the track find.

    Parameters
    ----------
    supply : OilAtInlets
        The oil.
    contacts : sequence of BearingContact
        All contacts of a bearing.
    films : sequence of ContactFilm or None, optional
        Their films as computed, of which those of the film atlas and formulas are taken.

    Returns
    -------
    OilAtInlets
        The same where the layers are known.
    """
    if supply.layers is not None:
        return supply
    loaded = sorted(
        (n for n, one in enumerate(contacts) if one.loaded), key=lambda n: contacts[n].load
    )
    heaviest = {(contacts[n].row, contacts[n].race): n for n in loaded}
    known = films or [None] * len(contacts)
    free = [film if film and film.field is None else None for film in known]
    at = list(heaviest.values())
    flooded = with_formulas([contacts[n] for n in at], [free[n] for n in at])
    layers = {
        place: inlet_layer(contacts[n], film.flooded_central, supply.oil, supply.balls)
        for (place, n), film in zip(heaviest.items(), flooded, strict=True)
        if film is not None
    }
    return replace(supply, layers=layers)


def film_heats(contacts: Sequence[BearingContact], films: Films) -> list[InletHeat]:
    """Fractions of flooded, isothermal films that the heat of their inlets leaves.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing.
    films : sequence of ContactFilm or None
        Their films as computed.

    Returns
    -------
    list of InletHeat
        Fractions and ranges [-]; that of a film that was solved with heat, 1 where there is none.
    """
    heats = [NO_HEAT if film is None else film.heat for film in films]
    numbers = [n for n, film in enumerate(films) if film and not film.solved_with_heat]
    if not numbers:
        return heats
    groups = [
        inlet_groups(
            film.conditions, film.flooded_central, film.size.semi_axis_x, contact.effusivities
        )
        for contact, film in zip(contacts, films, strict=True)
        if film and not film.solved_with_heat
    ]
    ranges = [heat_of(film.conditions.lubricant).ranges for n in numbers if (film := films[n])]
    for number, heat in zip(numbers, thermal_reductions(np.array(groups), ranges), strict=True):
        heats[number] = heat
    return heats


def solved_films(
    contacts: Sequence[BearingContact], solutions: Sequence[ContactSolution | None]
) -> tuple[ContactFilm | None, ...]:
    """Films of contacts as they were solved.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing.
    solutions : sequence of ContactSolution or None
        Of the contacts; equal contacts may share an object.

    Returns
    -------
    tuple of ContactFilm or None
        None where nothing was solved, or the solution did not converge.
    """
    films: list[ContactFilm | None] = []
    moments: dict[int, tuple[float, float]] = {}
    for contact, solution, first in zip(contacts, solutions, first_same(solutions), strict=True):
        if solution is None or not solution.converged or contact.conditions is None:
            films.append(None)
            continue
        if first not in moments:
            moments[first] = _moments(solution)
        films.append(_solved(contact, solution, *moments[first]))
    return tuple(films)


def _moments(solution: ContactSolution) -> tuple[float, float]:
    """Flooded rolling moment [N m], and the fraction of it that a layer leaves [-]."""
    if solution.supply is None:
        return rolling_moment(solution).value, 1.0
    flooded = rolling_moment(solution.supply.flooded).value
    return flooded, rolling_moment(solution).value / flooded


def _solved(
    contact: BearingContact, solution: ContactSolution, moment: float, fraction: float
) -> ContactFilm:
    """One of `solved_films` by its flooded moment [N m] and what is left of it [-]."""
    assert contact.conditions is not None
    flooded = solution if solution.supply is None else solution.supply.flooded
    central, minimum = _thicknesses(solution)
    film = ContactFilm(
        conditions=contact.conditions,
        size=hertz_size(contact.conditions, contact.hertz),
        origin=FilmOrigin.SOLVED,
        field=solution,
        central=central,
        minimum=minimum,
        isothermal_central=central.value,
        isothermal_minimum=minimum.value,
        flooded_central=_length(flooded.film_central),
        flooded_minimum=_length(flooded.film_minimum),
        flooded_moment=moment,
        rolling_fraction=fraction,
        supply=_layer_fractions(solution),
    )
    return _with_isothermal(film, contact) if solved_with_heat(solution) else film


def _thicknesses(solution: ContactSolution) -> tuple[FilmThickness, FilmThickness]:
    """Central and minimum film of a solution."""
    s = solution
    return (
        FilmThickness(_length(s.film_central), _length(s.film_central_uncertainty)),
        FilmThickness(_length(s.film_minimum), _length(s.film_minimum_uncertainty)),
    )


def _length(film: float | None) -> float:
    """A film of a solution with lengths that converged [m]."""
    assert film is not None
    return film


def _layer_fractions(solution: ContactSolution) -> SupplyFractions:
    """Fractions of the flooded film that the layer leaves which a film was solved behind."""
    layer = solution.supply
    if layer is None:
        return FLOODED
    return SupplyFractions(
        central=solution.film_central_dimensionless.value / layer.flooded_central.value,
        minimum=solution.film_minimum_dimensionless.value / layer.flooded_minimum.value,
        rolling_moment=layer.rolling_moment_ratio,
        inside=layer.law is None or layer.law.inside,
    )


def _with_isothermal(film: ContactFilm, contact: BearingContact) -> ContactFilm:
    """A film that was solved with heat, with the isothermal one of the film atlas or formulas."""
    if contact.hertz is None:
        return replace(film, isothermal_central=None, isothermal_minimum=None)
    values = formula_values(
        film.conditions, (contact.hertz.semi_axis_y, contact.hertz.semi_axis_x)
    )
    fraction = film.central.value / values.central
    assert film.field is not None
    bar = film.field.film_central_dimensionless.relative_uncertainty
    central = ThermalReduction(fraction, fraction * bar)
    if values.ratio is None or film.minimum is None:
        heat = InletHeat(central, central)
        return replace(film, isothermal_central=values.central, isothermal_minimum=None, heat=heat)
    isothermal = min(values.ratio, 1.0) * values.central
    fraction = film.minimum.value / isothermal
    minimum = ThermalReduction(fraction, fraction * film.minimum.relative_error)
    return replace(
        film,
        isothermal_central=values.central,
        isothermal_minimum=isothermal,
        heat=InletHeat(central, minimum),
    )


def with_formulas(
    contacts: Sequence[BearingContact], films: Films
) -> tuple[ContactFilm | None, ...]:
    """Films of contacts, those of the film atlas or of formulas where there is none.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing.
    films : sequence of ContactFilm or None
        Films of the contacts, as computed.

    Returns
    -------
    tuple of ContactFilm or None
        None where a contact carries no load or entrains no oil.
    """
    missing = [
        contact if film is None else None for contact, film in zip(contacts, films, strict=True)
    ]
    return tuple(
        film or formula for film, formula in zip(films, formula_films(missing), strict=True)
    )


def operating_films(
    contacts: Sequence[BearingContact],
    films: Films,
    *,
    supply: OilAtInlets | None = None,
    asperities: Asperities | None = None,
    hysteresis: float = 0.0,
) -> tuple[ContactFilm | None, ...]:
    """Films of contacts as the bearing runs.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing.
    films : sequence of ContactFilm or None
        Films of the contacts as computed.
    supply : OilAtInlets, optional
        Oil that flooded films get, and those solved behind the layers of another supply, by the
        law of starvation; None: films as they are.
    asperities : Asperities, optional
        Which carry part of the load where the films are thin; None: full films.
    hysteresis : float
        Share of the elastic energy that the contacts lose in rolling, beta_a [-].

    Returns
    -------
    tuple of ContactFilm or None
        None where there is no film.
    """
    supply = supply and on_tracks(supply, contacts, films)
    kinds = _kinds(contacts, films)
    first = {kind: n for n, kind in reversed(list(enumerate(kinds)))}
    distinct = [n for n, kind in enumerate(kinds) if films[n] is not None and first[kind] == n]
    computed = [film for n in distinct if (film := films[n]) is not None]
    given = [contacts[n] for n in distinct]
    heats = film_heats(given, computed)
    if supply is not None:
        computed = _at_supply(computed, given, supply)
    alike = {
        kinds[n]: _operating(film, contacts[n], heat, supply, asperities)
        for n, film, heat in zip(distinct, computed, heats, strict=True)
    }
    # equal balls of a load zone differ in their spins and round-off alone
    return tuple(
        film
        and replace(
            alike[kind],
            conditions=film.conditions,
            size=film.size,
            elastic_moment=elastic_moment(contact, hysteresis),
        )
        for contact, film, kind in zip(contacts, films, kinds, strict=True)
    )


def _kinds(contacts: Sequence[BearingContact], films: Films) -> list[Hashable]:
    """Keys that contacts on equal films share; None where there is none."""
    known = [
        (film.conditions, (film.size.semi_axis_y, film.size.semi_axis_x))
        for film in films
        if film is not None
    ]
    equal = iter(kinds_of_contacts(known))
    fields = first_same([None if film is None else film.field for film in films])
    return [
        film
        and (
            next(equal),
            *(contact.race, contact.row, contact.gap, contact.effusivities),
            *(field, film.origin, film.central.value),
        )
        for contact, film, field in zip(contacts, films, fields, strict=True)
    ]


def contact_films(
    contacts: Sequence[BearingContact],
    solutions: Sequence[ContactSolution | None] | None = None,
    *,
    supply: OilAtInlets | None = None,
    asperities: Asperities | None = None,
) -> tuple[ContactFilm | None, ...]:
    """Operating films of the contacts of a bearing: oil supply, heat of the inlet and asperities
    included.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing, from `contact_conditions`.
    solutions : sequence of ContactSolution or None, optional
        Solved contacts, from `solve_contact`; the film atlas or a formula where there is none.
    supply : OilAtInlets, optional
        Oil that the contacts get; None: flooded.
    asperities : Asperities, optional
        Which carry part of the load where the films are thin; None: full films.

    Returns
    -------
    tuple of ContactFilm or None
        None where a contact carries no load or entrains no oil.

    Examples
    --------
    >>> import oilfilm
    >>> operation = oilfilm.Operation(inner_speed=300.0, force=(0.0, 3000.0, 0.0))
    >>> state = oilfilm.solve_quasistatic(oilfilm.load_bearing("6208"), operation)
    >>> oil = oilfilm.load_lubricant("iso vg 68", operation.temperature)
    >>> contacts = oilfilm.contact_conditions(state, oil)
    >>> films = oilfilm.contact_films(contacts)
    >>> thinnest = min((film for film in films if film), key=lambda film: film.central.value)
    >>> f"{thinnest.central.value * 1e6:.2f} um by {thinnest.origin.value}"
    '0.64 um by atlas'
    """
    computed = solved_films(contacts, solutions or (None,) * len(contacts))
    return operating_films(
        contacts, with_formulas(contacts, computed), supply=supply, asperities=asperities
    )


def _operating(
    film: ContactFilm,
    contact: BearingContact,
    heat: InletHeat,
    supply: OilAtInlets | None,
    asperities: Asperities | None,
) -> ContactFilm:
    """One of `operating_films`, with the oil at its inlet."""
    # 1. heat of the inlet
    central = film.central
    minimum = film.minimum
    rolling = film.rolling_fraction
    if not film.solved_with_heat:
        inlet = film.rolling_fraction
        if supply is not None and isinstance(supply.oil, ReplenishedInlet):
            # the moment that is missing is that far ahead of where the film is heated
            inlet = film.supply.central
        heat = heat.at(inlet)
        rolling *= heat.moment.value
        central = _heated(central, heat.central)
        if minimum is not None:
            least = minimum.value
            minimum = _heated(minimum, heat.minimum)
            if minimum.value > central.value:
                minimum = minimum._replace(value=central.value)
                heat = heat._replace(minimum=heat.minimum._replace(value=central.value / least))
    # 2. pressure-viscosity coefficient
    error = film_error_nijenbanning(film.conditions)
    central = central._replace(pressure_viscosity=error * central.value)
    minimum = minimum and minimum._replace(pressure_viscosity=error * minimum.value)
    film = replace(film, central=central, minimum=minimum, heat=heat, rolling_fraction=rolling)
    # 3. asperities
    return film if asperities is None else with_asperities(film, contact, asperities)


def with_asperities(
    film: ContactFilm, contact: BearingContact, asperities: Asperities
) -> ContactFilm:
    """A film whose load asperities carry part of.

    Parameters
    ----------
    film : ContactFilm
        With supply and heat.
    contact : BearingContact
        Its contact.
    asperities : Asperities
        Roughness, and the law by which asperities carry load.

    Returns
    -------
    ContactFilm
        The film with the shares of the load [-].
    """
    return replace(
        film,
        asperity_load=asperities.load_fraction(contact, film.central.value),
        flooded_asperity_load=asperities.load_fraction(contact, film.flooded_central),
        boundary_friction=asperities.boundary,
        roughness=asperities.roughness(contact.race),
    )


def _heated(film: FilmThickness, heat: ThermalReduction) -> FilmThickness:
    """A film with the heat of its inlet."""
    return FilmThickness(
        value=heat.value * film.value,
        computed=heat.value * film.computed,
        heat=heat.law * film.value,
        supply=heat.value * film.supply,
        oil=heat.oil * film.value,
    )


def _at_supply(
    films: Sequence[ContactFilm], contacts: Sequence[BearingContact], supply: OilAtInlets
) -> list[ContactFilm]:
    """Films that a supply leaves of flooded ones, or of those behind a layer of another supply, by
    what the flooded films of these were.
    """
    found = list(films)
    some = [
        n
        for n, film in enumerate(films)
        if not film.with_inlet_film_by_law
        or not (supply.as_solved or not film.supply.rolling_moment > 0.0)
    ]
    layers = [supply.layer_of(contacts[n]) for n in some]
    flooded = [films[n].flooded_central for n in some]
    given = [contacts[n] for n in some]
    shares, inside = shares_behind(given, flooded, np.array(layers).reshape(-1, 2))
    for n, layer, own, known in zip(some, layers, shares.tolist(), inside.tolist(), strict=True):
        left, most = (SupplyFractions(film, least, moment, known) for film, least, moment in own)
        if left == FLOODED and films[n].with_inlet_film_by_law:
            found[n] = _without_layer(films[n])
            continue
        # a gap decides its film
        more = layer.most > layer.thickness and contacts[n].gap is None
        found[n] = _behind(films[n], left, most if more else None)
    return found


def _behind(film: ContactFilm, left: SupplyFractions, most: SupplyFractions | None) -> ContactFilm:
    """A film with these fractions of its flooded one in place of its own; and the most that the
    oil may leave.
    """
    before = film.supply
    fractions = (left.central / before.central, left.minimum / before.minimum)
    central = _scaled(film.central, fractions[0] * film.central.value)
    minimum = None
    if film.minimum is not None:
        minimum = _scaled(film.minimum, min(fractions[1] * film.minimum.value, central.value))
    isothermal = film.isothermal_central and fractions[0] * film.isothermal_central
    smallest = film.isothermal_minimum and fractions[1] * film.isothermal_minimum
    if isothermal and smallest:
        smallest = min(smallest, isothermal)
    if most is not None:
        central = _to_most(central, most.central / left.central)
        minimum = minimum and _to_most(minimum, most.minimum / left.minimum)
    return replace(
        film,
        central=central,
        minimum=minimum,
        isothermal_central=isothermal,
        isothermal_minimum=smallest,
        supply=left,
        rolling_fraction=left.rolling_moment / before.rolling_moment * film.rolling_fraction,
    )


def _scaled(film: FilmThickness, value: float) -> FilmThickness:
    """A film of another thickness [m] with the relative error of its own."""
    ratio = value / film.value if film.value > 0.0 else 0.0
    return FilmThickness(value, *(ratio * part for part in film[1:]))


def _to_most(film: FilmThickness, ratio: float) -> FilmThickness:
    """A film that more oil at the inlet may bring to so many times its thickness."""
    return film._replace(supply=max(ratio - 1.0, 0.0) * film.value)


def _without_layer(film: ContactFilm) -> ContactFilm:
    """The flooded film of one that was solved behind a layer."""
    flooded = film.flooded_field
    assert flooded is not None
    central, minimum = _thicknesses(flooded)
    return replace(
        film,
        field=flooded,
        central=central,
        minimum=minimum,
        isothermal_central=central.value,
        isothermal_minimum=minimum.value,
        supply=FLOODED,
        rolling_fraction=1.0,
    )


def flooded_films(films: Films) -> tuple[ContactFilm | None, ...]:
    """Films of contacts without the layers that they were solved behind.

    Parameters
    ----------
    films : sequence of ContactFilm or None
        As computed.

    Returns
    -------
    tuple of ContactFilm or None
        Flooded films, in the same boxes.
    """
    return tuple(
        _without_layer(film) if film is not None and film.with_inlet_film_by_law else film
        for film in films
    )


def supplied_films(
    contacts: Sequence[BearingContact],
    films: Films,
    supply: OilAtInlets | None,
    asperities: Asperities | None = None,
) -> tuple[ContactFilm | None, ...]:
    """Films of contacts at a supply of oil, as results report them.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of a bearing.
    films : sequence of ContactFilm or None
        As computed; where there is none, those of the film atlas or of formulas.
    supply : OilAtInlets or None
        Oil at the inlets; None: as much as the films were computed with.
    asperities : Asperities, optional
        Give the roughness, and with it the lambda ratio.

    Returns
    -------
    tuple of ContactFilm or None
        None where no oil is entrained or no flooded film is known: no formula has the minimum film
        of an oil without pressure-viscosity.
    """
    known = with_formulas(contacts, [None if film and film.scaled else film for film in films])
    known = tuple(
        film
        if film is not None
        and (film.origin is FilmOrigin.SOLVED or film.conditions.lubricant.piezoviscous)
        else None
        for film in known
    )
    return operating_films(contacts, known, supply=supply, asperities=asperities)


def of_driven_balls(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], films: Films
) -> list[ContactFilm]:
    """Films of the balls that both races load.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Of the contacts.

    Returns
    -------
    list of ContactFilm
        Those that there are.
    """
    pairs = zip(films, contacts, strict=True)
    load = solution.inner_load
    return [film for film, contact in pairs if film is not None and load[contact.ball - 1] > 0.0]


def mean_fraction(films: Sequence[ContactFilm]) -> float:
    """Mean fraction of the flooded central film that a supply leaves.

    Parameters
    ----------
    films : sequence of ContactFilm
        At the supply.

    Returns
    -------
    float
        Fraction [-]; 1 of none.
    """
    return float(np.mean([film.supply.central for film in films])) if films else 1.0


def least_lambda(films: Sequence[ContactFilm]) -> float:
    """Smallest lambda ratio of films.

    Parameters
    ----------
    films : sequence of ContactFilm
        Operating films.

    Returns
    -------
    float
        Ratio [-]; infinite of none.
    """
    return min((film.lambda_ratio for film in films), default=inf)

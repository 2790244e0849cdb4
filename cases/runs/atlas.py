"""Films of a bearing by the film atlas, without a film solve."""

from collections.abc import Sequence
from dataclasses import replace
from time import perf_counter

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.contacts.finite_bodies import finite_bodies, with_finite_bodies
from oilfilm.bearing.films.between_races import equilibrium_with_films
from oilfilm.bearing.films.film import ContactFilm, FilmOrigin, Films
from oilfilm.bearing.films.operating_film import operating_films
from oilfilm.bearing.films.unsolved_films import atlas_film, formula_films, too_thick
from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.ehl import ContactConditions, atlas_films
from oilfilm.ehl.atlas.films import NotInAtlasError
from oilfilm.ehl.units import from_si
from oilfilm.postprocess.bearing.atlas import AtlasBearingResults, BearingAtlasRecord

from ..format.case import Case
from ..format.contact import FilmSource
from .atlas_contact import require_newtonian
from .equilibrium import without_traction_equilibrium
from .films import oil_at_inlets, wanted_contacts

HALF_AND_HALF = (
    "loads of half and half in place of traction equilibrium, which takes its friction from films"
)
TOO_LIGHT = "too light a contact for its speed: by formula the film is beyond 2 % of R_x"
FILLS_GAP = "between two films, in a gap of {:.3g} um: by atlas or formula"
NO_EQUILIBRIUM = "there is no equilibrium"


def run_atlas_bearing(case: Case, name: str) -> AtlasBearingResults:
    """Films of all contacts of a bearing by the film atlas, whatever `film_maps` asks for.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in messages.

    Returns
    -------
    AtlasBearingResults
        Films at the quasi-static loads; none where the atlas does not cover a contact.

    Raises
    ------
    CaseError
        If the films of the case have heat or shear thinning.
    """
    solver = f"use 'oilfilm run {name}'"
    require_newtonian(case, name, solver)
    start = perf_counter()
    case = replace(case, film_maps="all")
    model = without_traction_equilibrium(case.model)
    state = solve_quasistatic(case.bearing, case.operation, model, rows=case.rows or SINGLE)
    contacts = contact_conditions(state, case.lubricant)
    _, contacts = equilibrium_with_films(state, contacts, case.lubricant, oil_at_inlets(case))
    if case.file.ehl.finite_bodies and state.converged:
        contacts = with_finite_bodies(contacts, finite_bodies(case.bearing, contacts))
    wanted, messages = wanted_contacts(case, state, contacts)
    if model is not case.model:
        messages += (HALF_AND_HALF,)
    pairs = zip(contacts, wanted, strict=True)
    records = [_record(contact, own, solver) for contact, own in pairs]
    # films behind layers have their supply
    supply = oil_at_inlets(case) if case.inlet_layer is None else None
    films = operating_films(contacts, [_film(record) for record in records], supply=supply)
    pairs_of_films = zip(records, films, strict=True)
    return AtlasBearingResults(
        case=case.document,
        records=tuple(replace(record, operating=film) for record, film in pairs_of_films),
        converged=state.converged,
        messages=(*case.warnings, *messages),
        timing={"total": perf_counter() - start},
    )


def fill_from_atlas(
    contacts: Sequence[BearingContact],
    wanted: Sequence[ContactConditions | None],
    films: Films,
    source: FilmSource,
) -> tuple[ContactFilm | None, ...]:
    """Films with those of the atlas at contacts that were not to be solved, and beyond it with
    those of formulas where none is to be solved.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        Contacts of the bearing.
    wanted : Sequence[ContactConditions | None]
        Conditions of the contacts that are solved.
    films : Films
        Films of formulas in place of solved ones.
    source : FilmSource
        Of the films that the case asks for.

    Returns
    -------
    tuple[ContactFilm | None, ...]
        Films of formulas and of the atlas; None elsewhere.
    """
    kinds = [FilmOrigin.ATLAS] + [FilmOrigin.FORMULA] * (source is FilmSource.ATLAS)

    def free(contact: BearingContact) -> bool:
        given = contact.conditions
        return given is not None and (contact.gap is not None or not too_thick(given))

    places = [
        contact if own is None and film is None and free(contact) else None
        for contact, own, film in zip(contacts, wanted, films, strict=True)
    ]
    of_atlas = [
        film if film and (contact.gap is not None or film.origin in kinds) else None
        for contact, film in zip(contacts, formula_films(places), strict=True)
    ]
    return tuple(film or own for film, own in zip(films, of_atlas, strict=True))


def _record(
    contact: BearingContact, wanted: ContactConditions | None, advice: str
) -> BearingAtlasRecord:
    """A contact with its films, or the reason why it has none, with `advice` where the atlas does
    not cover it.
    """
    films = None
    reason = contact.note
    if contact.gap is not None:
        reason = FILLS_GAP.format(from_si("film_um", contact.gap))
    elif wanted is None and contact.conditions is not None:
        reason = NO_EQUILIBRIUM  # all balls were asked for
    elif wanted is not None and wanted.inlet_layer is None and too_thick(wanted):
        reason = TOO_LIGHT
    elif wanted is not None:
        try:
            films = atlas_films(wanted)
        except NotInAtlasError as refusal:
            reason = f"{refusal.reason}; {advice}"
    return BearingAtlasRecord(contact=contact, conditions=wanted, films=films, reason=reason)


def _film(record: BearingAtlasRecord) -> ContactFilm | None:
    """Film of the atlas, of a light ball between two films also by formula."""
    if record.contact.gap is not None:
        return formula_films([record.contact])[0]
    return atlas_film(record.contact, record.in_lengths)

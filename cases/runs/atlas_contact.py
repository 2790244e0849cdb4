"""Films of a single contact by the film atlas, without a film solve."""

from time import perf_counter

from oilfilm.ehl import atlas_films
from oilfilm.ehl.atlas.films import NotInAtlasError
from oilfilm.postprocess.contact.atlas import AtlasContactResults, AtlasRecord

from ..format.case import Case, ContactCase
from ..format.contact import FilmModel
from ..format.rules import CaseError


def run_atlas_contact(case: ContactCase, name: str) -> AtlasContactResults:
    """Films of a single contact by the film atlas.

    Parameters
    ----------
    case : ContactCase
        The contact.
    name : str
        Name of the case in messages.

    Returns
    -------
    AtlasContactResults
        The films.

    Raises
    ------
    CaseError
        If the atlas does not cover the contact.
    """
    solver = f"use 'oilfilm contact {name}'"
    require_newtonian(case, name, solver)
    start = perf_counter()
    try:
        films = atlas_films(case.conditions)
    except NotInAtlasError as refusal:
        raise CaseError(f"{name}: {refusal.reason}; {solver}") from None
    return AtlasContactResults(
        case=case.document,
        record=AtlasRecord(conditions=case.conditions, films=films),
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )


def require_newtonian(case: Case | ContactCase, name: str, solver: str) -> None:
    """Check that a case asks for films that the atlas has.

    Parameters
    ----------
    case : Case | ContactCase
        The case.
    name : str
        Its name in messages.
    solver : str
        Advice on what to use in place of the atlas.

    Raises
    ------
    CaseError
        If it asks for films with heat or shear thinning.
    """
    model = case.films.model
    if model is not FilmModel.NEWTONIAN:
        raise CaseError(
            f'{name}: [ehl] film_model = "{model.value}": the film atlas has isothermal films of '
            f"a Newtonian oil; {solver}"
        )

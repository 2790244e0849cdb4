"""Films of a bearing with the heat of their inlets, the isothermal ones beside."""

from collections.abc import Iterator, Sequence

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.films.film import ContactFilm, Films, FilmThickness, solved_with_heat
from oilfilm.bearing.films.operating import film_heat
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.closed_form.film import LARGEST_LOADING
from oilfilm.ehl.units import from_si

from ..quantities import quantities

NO_FILM = "no film was computed"
HEAT_QUANTITIES = (
    *quantities(
        "operating.",
        NO_FILM,
        ("isothermal_film_central_um", "central film without heat", "isothermal_central"),
        ("isothermal_film_minimum_um", "minimum film without heat", "isothermal_minimum"),
    ),
    *quantities(
        "operating.heat.",
        NO_FILM,
        ("inlet_heat_share", "share of the isothermal film that inlet heat leaves", "value"),
        ("inlet_heat_share_low", "low end of its range", "low"),
        ("inlet_heat_share_high", "high end of its range", "high"),
    ),
)


def film_values(film: ContactFilm | None) -> dict[str, float | None]:
    """Central and minimum film of a contact by their keys, with their error bars.

    Parameters
    ----------
    film : ContactFilm or None
        Operating film.

    Returns
    -------
    dict
        Films, error bars with the range of the heat, and without [um]; None without a film.
    """
    values: dict[str, float | None] = {}
    for name in ("central", "minimum"):
        one: FilmThickness | None = None if film is None else getattr(film, name)
        values[f"film_{name}_um"] = from_si("film_um", one and one.value)
        values[f"film_{name}_uncertainty_um"] = from_si("film_um", one and one.error)
        values[f"film_{name}_mesh_uncertainty_um"] = from_si("film_um", one and one.computed)
    return values


def isothermal_note(
    contacts: Sequence[BearingContact], films: Sequence[ContactSolution | None]
) -> str:
    """Note for pictures of films as they were solved: that they are isothermal, and what heat
    leaves of them.

    Parameters
    ----------
    contacts : sequence of BearingContact
        Contacts of the picture.
    films : sequence of ContactSolution or None
        Their films as solved.

    Returns
    -------
    str
        Empty where the films were solved with heat.
    """
    left = [
        film_heat(contact).at(1.0 if film.supply is None else film.supply.rolling_moment_ratio)
        for contact, film in zip(contacts, films, strict=True)
        if film is not None and film.converged and not solved_with_heat(film)
    ]
    return (
        f"; isothermal films, heat of the inlets leaves {_ends([heat.value for heat in left])}"
        if left
        else ""
    )


def _ends(values: Sequence[float]) -> str:
    """Least and largest value, once where they are alike."""
    return " to ".join(dict.fromkeys(f"{value:.2g}" for value in (min(values), max(values))))


def heat_messages(films: Films) -> Iterator[str]:
    """Messages on what the heat of the inlets leaves of films that were not solved with it.

    Parameters
    ----------
    films : sequence of ContactFilm or None
        Operating films, without those that were solved with heat.

    Yields
    ------
    str
        A message.
    """
    shares = [film.heat for film in films if film is not None]
    if not shares:
        return
    ends = _ends([share.value for share in shares])
    widest = max(share.uncertainty / share.value for share in shares)
    oil = ", with the heat properties of a mineral oil (assumed)" if shares[0].assumed else ""
    yield (
        f"contacts: the heat of their inlets leaves {ends} of the isothermal films "
        f"(isothermal_film_..., maps and flooded_film_... too), by a formula fitted to films "
        f"solved with heat{oil}, its spread, up to {100.0 * widest:.2g} %, in their error bars; "
        '[ehl] film_model = "thermal" solves them with it'
    )
    if any(share.beyond for share in shares):
        yield (
            "contacts: the heat of the inlets lies beyond the range of its formula (thermal "
            f"loading parameter above {LARGEST_LOADING:g}): films, lambda, kappa and life by them "
            "are guesses"
        )

"""Films of a bearing with the heat of their inlets, the isothermal ones beside."""

from collections.abc import Iterator, Sequence
from math import hypot
from typing import Any, NamedTuple

from bearing.contacts.contact import BearingContact
from bearing.contacts.film_heat import film_heat, heat_beside, solved_with_heat
from bearing.contacts.film_numbers import film_numbers
from bearing.friction.formula_films import FormulaFilm
from ehl import AtlasFilms, ContactSolution
from ehl.closed_form.inlet_heat import LARGEST_LOADING, HeatShare
from ehl.units import from_si

from ..quantities import quantities

Film = ContactSolution | FormulaFilm | None
# a film, its error bar, and that without the range of the heat [m]
Bar = tuple[float, float, float] | None

NO_FILM = "no film was computed"
HEAT_QUANTITIES = (
    *quantities(
        "heated.",
        NO_FILM,
        ("isothermal_film_central_um", "central film without heat", "isothermal_central"),
        ("isothermal_film_minimum_um", "minimum film without heat", "isothermal_minimum"),
    ),
    *quantities(
        "heated.heat.",
        NO_FILM,
        ("inlet_heat_share", "share of the isothermal film that inlet heat leaves", "value"),
        ("inlet_heat_share_low", "low end of its range", "low"),
        ("inlet_heat_share_high", "high end of its range", "high"),
    ),
)


class HeatedFilms(NamedTuple):
    """Films of a contact with the heat of the inlet, and without; None where there are none."""

    central: Bar = None  # with heat
    minimum: Bar = None
    isothermal_central: float | None = None  # [m]
    isothermal_minimum: float | None = None  # [m]
    heat: HeatShare | None = None  # of the isothermal film that heat leaves [-]

    @property
    def keys(self) -> dict[str, Any]:
        """The films by their keys [um]: error bars with the range of the heat, and without."""
        found: dict[str, Any] = {}
        for name in ("central", "minimum"):
            value, error, mesh = getattr(self, name) or (None, None, None)
            found[f"film_{name}_um"] = from_si("film_um", value)
            found[f"film_{name}_uncertainty_um"] = from_si("film_um", error)
            found[f"film_{name}_mesh_uncertainty_um"] = from_si("film_um", mesh)
        return found


NO_FILMS = HeatedFilms()


def heated_films(contact: BearingContact, film: Film) -> HeatedFilms:
    """Films of a contact with heat [m]; none where it did not converge.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    film : Film
        Film of the contact, or None.

    Returns
    -------
    HeatedFilms
        The films.
    """
    left = _heat_left(contact, film)
    return HeatedFilms(*_bars(film, left), *_isothermal_films(contact, film), left)


def heated_atlas_films(contact: BearingContact, films: AtlasFilms | None) -> HeatedFilms:
    """Films of the atlas [m] with heat.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    films : AtlasFilms | None
        Films of the atlas, or None.

    Returns
    -------
    HeatedFilms
        The films.
    """
    if films is None:
        return NO_FILMS
    left = film_heat(contact)
    central, minimum = films.central, films.minimum
    bars = [_bar(one.value, one.uncertainty, left) for one in (central, minimum)]
    return HeatedFilms(bars[0], bars[1], central.value, minimum.value, left)


def film_bars(contact: BearingContact, film: Film) -> tuple[Bar, Bar]:
    """Central and minimum film of a contact with heat and their error bars [m]; None without a
    film.

    Parameters
    ----------
    contact : BearingContact
        Contact of a ball and a race.
    film : Film
        Film of the contact, or None.

    Returns
    -------
    value
        Central film and its bars.
    value
        Minimum film and its bars.
    """
    return _bars(film, _heat_left(contact, film))


def _bars(film: Film, left: HeatShare | None) -> tuple[Bar, Bar]:
    """The same by what heat leaves of the isothermal film [-]."""
    if film is None:
        return None, None
    if isinstance(film, FormulaFilm):
        minimum = _bar(film.minimum, film.minimum_uncertainty, left)
        return _bar(film.central, film.uncertainty, left), minimum
    if solved_with_heat(film):
        left = None
    return (
        _bar(film.film_central, film.film_central_uncertainty, left),
        _bar(film.film_minimum, film.film_minimum_uncertainty, left),
    )


def _heat_left(contact: BearingContact, film: Film) -> HeatShare | None:
    """Part of the isothermal film of a contact that heat leaves [-]; None without a film."""
    if film is None:
        return None
    if isinstance(film, FormulaFilm):
        return film_heat(contact)
    if not film.converged:
        return None
    if not solved_with_heat(film):
        return heat_beside(contact, film)
    bar = film.film_central_dimensionless.relative_uncertainty
    central, _ = _isothermal_films(contact, film)
    share = (film.film_central or 0.0) / central if central else 1.0
    return HeatShare(share, share * (1.0 - bar), share * (1.0 + bar))


def _isothermal_films(contact: BearingContact, film: Film) -> tuple[float | None, float | None]:
    """Central and minimum film without heat [m], of one that was solved with heat by the film
    atlas or formulas; None where there is none.
    """
    if film is None:
        return None, None
    if isinstance(film, FormulaFilm):
        return film.central, film.minimum
    if not film.converged:
        return None, None
    if not solved_with_heat(film):
        return film.film_central, film.film_minimum
    if contact.conditions is None or contact.hertz is None:
        return None, None
    hertz = contact.hertz
    known = film_numbers(contact.conditions, (hertz.semi_axis_y, hertz.semi_axis_x))
    return known.central, None if known.ratio is None else min(known.ratio, 1.0) * known.central


def _bar(value: float | None, error: float | None, left: HeatShare | None = None) -> Bar:
    """A film with what heat leaves of it, and its error bars [m]."""
    if value is None or error is None:
        return None
    if left is None:
        return value, error, error
    mesh = left.value * error
    return left.value * value, hypot(mesh, left.uncertainty * value), mesh


def isothermal_note(contacts: Sequence[BearingContact], films: Sequence[Film]) -> str:
    """Remark for pictures of isothermal films: the part of them that heat leaves.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        Contacts of the bearing.
    films : Sequence[Film]
        Their solved films.

    Returns
    -------
    str
        The words; empty where films were solved with heat.
    """
    pairs = zip(contacts, films, strict=True)
    left = [
        heat_beside(contact, film).value
        for contact, film in pairs
        if isinstance(film, ContactSolution) and film.converged and not solved_with_heat(film)
    ]
    return f"; isothermal films, heat of the inlets leaves {_ends(left)}" if left else ""


def _ends(values: Sequence[float]) -> str:
    """Least and largest value, once where they are alike."""
    return " to ".join(dict.fromkeys(f"{value:.2g}" for value in (min(values), max(values))))


def heat_messages(films: Sequence[HeatedFilms]) -> Iterator[str]:
    """Part of the films that the heat of their inlets leaves.

    Parameters
    ----------
    films : Sequence[HeatedFilms]
        Films with heat, and without.

    Yields
    ------
    Iterator[str]
        A message.
    """
    shares = [film.heat for film in films if film.heat is not None]
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

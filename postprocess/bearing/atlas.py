"""Films of the film atlas of all contacts of a bearing, as summary and in the terminal."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from rich.console import Group
from rich.text import Text

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.films.film import ContactFilm
from oilfilm.ehl.units import value_with_error

from ..contact.atlas import SOURCE, THIN_LAYER, AtlasRecord, atlas_values
from ..files import plain_document
from ..quantities import NOTHING, Results, number, number_table, titled, values_of
from .contact_quantities import CONTACT_QUANTITY, HEAT_QUANTITIES, film_values, heat_messages
from .results import balls_text

DRY = (
    *("ball", "row", "azimuth_deg", "race", "loaded", "load_N", "contact_angle_deg"),
    *("semi_axis_rolling_mm", "semi_axis_transverse_mm", "hertz_pressure_GPa"),
    "entrainment_speed_m_s",
)
OPERATING = (
    "films: of the film atlas, as the bearing runs, with the heat of the inlet and the oil that "
    "comes back to the tracks; nothing is solved"
)
HEADERS = ("ball", "race", "load N", "p_h GPa", "h_c µm", "h_min µm", "k N/µm")


@dataclass(frozen=True, kw_only=True)
class BearingAtlasRecord(AtlasRecord):
    """One contact of a bearing with its films of the atlas."""

    contact: BearingContact
    operating: ContactFilm | None = None  # None without a film

    @property
    def loaded(self) -> bool:
        """True if it carries a load."""
        return self.contact.load > 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AtlasBearingResults(Results):
    """Contacts of a bearing and their films by the atlas."""

    records: tuple[BearingAtlasRecord, ...]
    converged: bool  # the equilibrium

    @property
    def refusals(self) -> dict[tuple[str, str], list[str]]:
        """Balls of loaded contacts without films, by race and reason."""
        result: dict[tuple[str, str], list[str]] = {}
        for record in self.records:
            if record.loaded and record.operating is None:
                place = (record.contact.race.value, record.reason)
                result.setdefault(place, []).append(str(record.contact.ball))
        return result


def atlas_bearing_summary(results: AtlasBearingResults) -> dict[str, Any]:
    """The document of a bearing: films of each contact, null with the reason in its note.

    Parameters
    ----------
    results : AtlasBearingResults
        Contacts of a bearing with their films of the atlas.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    document = {
        "source": SOURCE,
        "contacts": [_values(record) for record in results.records],
        "timing_s": dict(results.timing),
    }
    return plain_document(results.head(results.converged, _messages(results)) | document)


def _values(record: BearingAtlasRecord) -> dict[str, Any]:
    dry = values_of(record, [CONTACT_QUANTITY[key] for key in DRY])
    films = {} if record.operating is None else film_values(record.operating)
    beside = values_of(record, HEAT_QUANTITIES)
    return {**dry, **atlas_values(record), **films, **beside, "note": record.reason}


def _messages(results: AtlasBearingResults) -> Iterator[str]:
    """Describe the films, and name reasons for null."""
    yield OPERATING
    yield from heat_messages([record.operating for record in results.records])
    if any(not record.loaded for record in results.records):
        yield "contacts: all but the load null where loaded is false"
    for (race, reason), balls in results.refusals.items():
        yield f"{race} race, {balls_text(balls)}: film null, {reason}"
    thin = [r for r in results.records if r.films is not None and r.films.rolling_moment is None]
    if thin:
        balls = list(dict.fromkeys(str(record.contact.ball) for record in thin))
        yield f"{balls_text(balls)}: rolling_moment_... null, {THIN_LAYER}"


def atlas_bearing_table(results: AtlasBearingResults) -> Group:
    """A line for each loaded contact, units in the head; below it why films are missing.

    Parameters
    ----------
    results : AtlasBearingResults
        Contacts of a bearing with their films of the atlas.

    Returns
    -------
    Group
        The table.
    """
    rows = []
    for record in results.records:
        if record.loaded:
            values = _values(record)
            films = [_film(values, name) for name in ("central", "minimum")]
            dry = [number(values["load_N"], ".1f"), number(values["hertz_pressure_GPa"], ".3f")]
            stiffness = number(values["stiffness_N_um"])
            rows.append([str(values["ball"]), values["race"], *dry, *films, stiffness])
    lacks = [
        Text(f"{race} race, {balls_text(balls)}: no film, {reason}")
        for (race, reason), balls in results.refusals.items()
    ]
    return titled(results.title, number_table(HEADERS, rows, left=("race",)), *lacks)


def _film(values: dict[str, Any], name: str) -> str:
    """A film and its bar [um]."""
    film = values[f"film_{name}_um"]
    bar = values[f"film_{name}_uncertainty_um"]
    return NOTHING if film is None else value_with_error(film, bar, most=4)

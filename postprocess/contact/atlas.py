"""Films of the film atlas of a single contact, as summary and in the terminal."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from rich.console import Group

from oilfilm.ehl import AtlasFilms, AtlasValue, ContactConditions, MoesConditions
from oilfilm.ehl.atlas.films import skewed
from oilfilm.ehl.scaling import ScaledContact, scale_contact
from oilfilm.ehl.units import from_si, value_with_error

from ..files import plain_document
from ..quantities import Results, facts_table, quantities, titled, values_of

SOURCE = "atlas"
MODEL = "films: of the film atlas, flooded, isothermal, of a Newtonian oil; nothing is solved"
NO_LENGTHS = "film_..._um, rolling_moment_..., stiffness_...: null, Moes' groups have no lengths"
THIN_LAYER = "the flooded layer ends too near the contact for the atlas"
AT_AN_ANGLE = "the atlas has no moment of entrainment at an angle"
NOT_COVERED = "the atlas does not cover the contact"
NO_VALUE = f"{NOT_COVERED}, or it has no lengths"
ATLAS_QUANTITIES = (
    *quantities(
        ("film_central_um", "central film", "central.value"),
        ("film_central_uncertainty_um", "central film uncertainty", "central.uncertainty"),
        ("film_minimum_um", "minimum film", "minimum.value"),
        ("film_minimum_uncertainty_um", "minimum film uncertainty", "minimum.uncertainty"),
        ("rolling_moment_N_mm", "rolling moment", "rolling_moment.value"),
        (
            "rolling_moment_uncertainty_N_mm",
            "rolling moment uncertainty",
            "rolling_moment.uncertainty",
        ),
        ("stiffness_N_um", "stiffness", "stiffness.value"),
        ("stiffness_uncertainty_N_um", "stiffness uncertainty", "stiffness.uncertainty"),
        source="in_lengths.",
        null=NO_VALUE,
    ),
)
DIMENSIONLESS = {"film_central": "central", "film_minimum": "minimum", "approach": "approach"}


@dataclass(frozen=True, kw_only=True)
class AtlasRecord:
    """A contact with its films of the atlas; None where there are none, for the reason given."""

    conditions: ContactConditions | MoesConditions | None
    films: AtlasFilms | None
    reason: str = ""

    @cached_property
    def scaled(self) -> ScaledContact | None:
        """Its dimensionless form; None without conditions."""
        return None if self.conditions is None else scale_contact(self.conditions)

    @property
    def in_lengths(self) -> AtlasFilms | None:
        """The films in SI; None of Moes' groups."""
        return self.films if isinstance(self.conditions, ContactConditions) else None

    def in_groups(self, name: str) -> AtlasValue | None:
        """A film in units of a^2/Rx [-].

        Parameters
        ----------
        name : str
            "central", "minimum" or "approach".

        Returns
        -------
        AtlasValue | None
            Value with its error bar; None without films.
        """
        if self.films is None or self.scaled is None:
            return None
        scale = self.scaled.film_scale or 1.0
        result: AtlasValue = getattr(self.films, name)
        return AtlasValue(result.value / scale, result.uncertainty / scale)


def atlas_values(record: AtlasRecord) -> dict[str, Any]:
    """Groups [-], films and bars of one contact, in the units of the keys; null without films.

    Parameters
    ----------
    record : AtlasRecord
        Contact with its film.

    Returns
    -------
    dict[str, Any]
        Values by key; null without films.
    """
    scaled = record.scaled
    values: dict[str, Any] = {
        "moes_M": None if scaled is None else scaled.moes_load,
        "moes_L": None if scaled is None else scaled.moes_lubricant,
        "radius_ratio": None if scaled is None else scaled.radius_ratio,
        **values_of(record, ATLAS_QUANTITIES),
    }
    for key, name in DIMENSIONLESS.items():
        result = record.in_groups(name)
        values[f"{key}_dimensionless"] = None if result is None else result.value
        values[f"{key}_uncertainty_dimensionless"] = None if result is None else result.uncertainty
    return values | {"inside": None if record.conditions is None else record.films is not None}


@dataclass(frozen=True, slots=True, kw_only=True)
class AtlasContactResults(Results):
    """One contact and its films by the atlas, all values known."""

    record: AtlasRecord


def atlas_contact_summary(results: AtlasContactResults) -> dict[str, Any]:
    """The document of a contact, the keys of a solved one.

    Parameters
    ----------
    results : AtlasContactResults
        Contact with its films of the atlas.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    record = results.record
    given = record.conditions if isinstance(record.conditions, ContactConditions) else None
    pressure = None if record.scaled is None else record.scaled.hertz_pressure
    document = {
        "source": SOURCE,
        "load_N": None if given is None else given.load,
        "hertz_pressure_GPa": from_si("hertz_pressure_GPa", pressure or None),
        **atlas_values(record),
        "timing_s": dict(results.timing),
    }
    return plain_document(results.head(True, _messages(record, pressure)) | document)


def _messages(record: AtlasRecord, pressure: float | None) -> Iterator[str]:
    """Describe the films, and name reasons for null; p_h in [Pa]."""
    yield MODEL
    if record.in_lengths is None:
        yield f"load_N, {NO_LENGTHS}"
    elif record.in_lengths.rolling_moment is None:
        angle = 0.0 if record.conditions is None else record.conditions.entrainment_angle
        yield f"rolling_moment_...: null, {AT_AN_ANGLE if skewed(angle) else THIN_LAYER}"
    if not pressure:
        yield "hertz_pressure_GPa: null, without piezoviscosity the scale of pressure is open"


def atlas_contact_table(results: AtlasContactResults) -> Group:
    """Groups, films, moment and stiffness with their bars, units beside the numbers.

    Parameters
    ----------
    results : AtlasContactResults
        Contact with its films of the atlas.

    Returns
    -------
    Group
        The table.
    """
    values = atlas_values(results.record)
    rows = {"M, L": f"{values['moes_M']:.4g}, {values['moes_L']:.4g}"}
    for name in ("central", "minimum"):
        text = f"{_with_bar(values, f'film_{name}', 'dimensionless')} a²/Rx"
        if values[f"film_{name}_um"] is not None:
            text += f" = {_with_bar(values, f'film_{name}', 'um')} µm"
        rows[f"{name} film"] = text
    rows["approach"] = f"{_with_bar(values, 'approach', 'dimensionless')} a²/Rx"
    if values["rolling_moment_N_mm"] is not None:
        rows["rolling moment"] = f"{_with_bar(values, 'rolling_moment', 'N_mm')} N mm"
    if values["stiffness_N_um"] is not None:
        rows["stiffness"] = f"{_with_bar(values, 'stiffness', 'N_um')} N/µm"
    rows["source"] = "film atlas, nothing was solved"
    return titled(results.title, facts_table(rows))


def _with_bar(values: dict[str, Any], name: str, unit: str) -> str:
    """A value and its bar, in the unit of their keys."""
    return value_with_error(values[f"{name}_{unit}"], values[f"{name}_uncertainty_{unit}"])

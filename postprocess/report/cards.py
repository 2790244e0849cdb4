"""The numbers of a bearing or a contact that are looked at first."""

from operator import itemgetter
from typing import Any

from markupsafe import Markup

from bearing.library.bearings import estimated_fields
from ehl.units import from_si, unit_symbol

from ..batch.main_results import MAIN_QUANTITY, thinnest_film
from ..results import STIFFNESS_HEADLINES
from ..text import in_figures
from . import html

Card = tuple[str, str, str]  # name, value and unit
REVOLUTIONS = "basic_reference_rating_Mrev"
LIVES = (  # blocks and titles of the lives that have a card, where there are any
    ("life", "basic_reference_rating_h", "rating life L10h"),
    ("life", "modified_reference_rating_h", "modified rating life L10mh"),
    ("duty_cycle", "basic_reference_rating_h", "L10h of the duty cycle"),
    ("duty_cycle", "modified_reference_rating_h", "L10mh of the duty cycle"),
)


def cards(summary: dict[str, Any]) -> Markup:
    """Main numbers side by side, and below them a remark on estimates.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Markup
        Markup.
    """
    contacts = [contact for contact in summary.get("contacts") or () if contact.get("loaded")]
    is_bearing = "contacts" in summary
    entries = _film_card(contacts) if is_bearing else _single_film_card(summary)
    entries += _pressure_card(contacts if is_bearing else [summary])
    if contacts:
        inner = sum(contact["race"] == "inner" for contact in contacts)
        entries.append(("balls loaded", f"{inner} of {len(summary.get('balls') or ())}", ""))
    numbers = [(title, (summary.get(block) or {}).get(key), key) for block, key, title in LIVES]
    life = summary.get("life") or {}
    if life.get(LIVES[0][1]) is None:  # nothing turns, or an older version
        numbers.append(("rating life L10", life.get(REVOLUTIONS), REVOLUTIONS))
    torque = summary.get("torque_N_mm") or {}
    numbers.insert(0, ("friction torque", torque.get("total"), "torque_N_mm"))
    for key in ("cage_speed_rpm", "load_N"):
        numbers.append((MAIN_QUANTITY[key].title, summary.get(key), key))
    if (slip := summary.get("cage_slip_ratio")) is not None:
        entries.append(("slip of the cage", html.number(100.0 * slip, 3), "%"))
    numbers += _operating_numbers(summary) if is_bearing else []
    for title, value, key in numbers:
        if value is not None:
            hours = key.endswith("_h")  # of life, as people read it
            shown = in_figures(value, 3) if hours else html.number(value, 4)
            entries.append((title, shown, unit_symbol(key)))
    estimated = is_bearing and _rests_on_estimates(summary["case"])
    return html.render("bearing", "cards", entries, estimated)


def _operating_numbers(summary: dict[str, Any]) -> list[tuple[str, float | None, str]]:
    """Temperature of the films and stiffness of the ring, where the ring is free to move."""
    operation = summary["case"].get("operation") or {}
    numbers = [("temperature of the films", operation.get("temperature_C"), "temperature_C")]
    stiffness = ((summary.get("ring") or {}).get("stiffness") or {}).get("matrix")
    if stiffness is None:
        return numbers
    for title, place in STIFFNESS_HEADLINES.items():
        value = stiffness[place][place]
        if value is not None:
            numbers.append((title, from_si("stiffness_N_um", value), "stiffness_N_um"))
    return numbers


def _rests_on_estimates(case: dict[str, Any]) -> bool:
    """True if the catalogue or the case itself calls a value of the bearing an estimate."""
    own = any(str(key).startswith("bearing.") for key in case.get("assumed") or ())
    return own or bool(estimated_keys(case))


def estimated_keys(case: dict[str, Any]) -> frozenset[str]:
    """Dotted keys of the case whose values are estimates of the catalogue.

    Parameters
    ----------
    case : dict[str, Any]
        Case as run, plain JSON.

    Returns
    -------
    frozenset[str]
        Dotted keys.
    """
    values = case.get("bearing")
    if not isinstance(values, dict):
        return frozenset()
    fields = estimated_fields(str(values.get("name", "")), values)
    return frozenset(f"bearing.{field}" for field in fields)


def _place(contact: dict[str, Any]) -> str:
    """Ball and race of a contact of a bearing in words; nothing of a single one."""
    return f", ball {contact['ball']}, {contact['race']} race" if "ball" in contact else ""


def _film_card(contacts: list[dict[str, Any]]) -> list[Card]:
    """The thinnest film of the loaded contacts; a dash where the film of one did not converge."""
    failed = [contact for contact in contacts if contact.get("converged") is False]
    if failed:
        return [(f"minimum film, not converged{_place(failed[0])}", html.NOTHING, "")]
    thinnest = thinnest_film(contacts)
    if thinnest is None:  # no film was asked for
        return []
    value = html.with_error(thinnest, "film_minimum_um")
    return [(f"minimum film{_place(thinnest)}", value, "µm")]


def _single_film_card(summary: dict[str, Any]) -> list[Card]:
    """The minimum film of a single contact; dimensionless of one in Moes' groups."""
    for key, unit in (("film_minimum_um", "µm"), ("film_minimum_dimensionless", "a²/Rx")):
        if summary.get(key) is not None:
            return [("minimum film", html.with_error(summary, key), unit)]
    return []


def _pressure_card(contacts: list[dict[str, Any]]) -> list[Card]:
    key = "hertz_pressure_GPa"
    pressed = [contact for contact in contacts if contact.get(key) is not None]
    if not pressed:
        return []
    most = max(pressed, key=itemgetter(key))
    title = f"largest Hertz pressure{_place(most)}"
    return [(title, html.number(most[key], 4), unit_symbol(key))]

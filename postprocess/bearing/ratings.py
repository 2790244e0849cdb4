"""Rating life and clearance in the summary and in the terminal's table."""

from collections.abc import Iterable, Iterator
from typing import Any

from bearing.library.bearings import named_designation
from bearing.rating.film_life import ContactKappa, FilmLife, film_life
from bearing.rating.life import (
    LARGEST_A_ISO,
    LARGEST_KAPPA,
    SMALLEST_KAPPA,
    relubrication_interval,
)
from ehl.units import from_si, to_si

from ..quantities import values_of
from ..text import in_figures
from .contacts import contact_records
from .duty_cycle import hours
from .quantities import CLEARANCE, FILM_LIFE, LIFE_RATING, LOAD_RATING
from .results import BearingResults

AT_ITS_LIMIT = 1.0 - 1e-9  # of a_ISO, within round-off [-]
RELUBRICATION = "relubrication_interval_h"


def life_block(results: BearingResults) -> dict[str, Any]:
    """Rating life, loads and the factors that led to it; None where it does not apply.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    life = results.life
    loads = () if life is None else LOAD_RATING
    films = values_of(life_by_films(results), FILM_LIFE)
    interval = {RELUBRICATION: from_si(RELUBRICATION, relubrication_time(results))}
    return values_of(life, (*LIFE_RATING, *loads)) | films | interval


def relubrication_time(results: BearingResults) -> float | None:
    """Time after which grease is to be renewed [s]; None without grease or bore.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    float | None
        Interval [s].
    """
    bore = results.quasistatic.bearing.bore
    grease = (results.case.get("friction") or {}).get("lubrication") == "grease"
    if not grease or bore is None:
        return None
    operation = results.quasistatic.operation
    return relubrication_interval(bore, operation.shaft_speed, operation.temperature)


def _sealed(results: BearingResults) -> bool:
    """True if seals or shields on both sides keep the first grease in, and any other out."""
    designation = named_designation(results.quasistatic.bearing.name or "")
    seals = (results.case.get("friction") or {}).get("sealed")
    return bool(seals) or (designation is not None and designation.greased)


def life_by_films(results: BearingResults) -> FilmLife | None:
    """Life from the solved films in place of the viscosity; None without films or roughness.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    FilmLife | None
        The life.
    """
    life = results.life
    solved = any(film is not None for film in results.solutions)
    if life is None or life.viscosity_ratio is None or not (solved and "surface" in results.case):
        return None
    records = contact_records(results)
    ends = [_kappa([record.kappa_at(end) for record in records]) for end in (0.0, -1.0, 1.0)]
    result = film_life(results.quasistatic, life, *ends)
    return None if result.smallest_kappa is None else result


def _kappa(values: list[float | None]) -> ContactKappa:
    """kappa by race from that of all contacts, ball by ball and inner race first."""
    return ContactKappa(inner=values[0::2], outer=values[1::2])


def clearance_block(results: BearingResults) -> dict[str, float | None]:
    """Clearance, its changes, pressures of the seats; without a budget the operating one alone.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, float | None]
        Values by key.
    """
    values = values_of(results.clearance, CLEARANCE)
    if results.clearance is None:
        clearance = results.quasistatic.bearing.diametral_clearance
        values["operating_um"] = from_si("clearance_um", clearance)
    return values


def rating_messages(results: BearingResults) -> Iterator[str]:
    """Name the values of the blocks `life` and `clearance` that are null, with the reason.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    life = results.life
    yield from ("life: null, no rating was asked for",) if life is None else life.messages
    if relubrication_time(results) is None:
        yield (
            f"life.{RELUBRICATION}: null without grease (friction.lubrication), bore_mm and "
            "rotation, and beyond the speeds of its formula"
        )
    else:
        yield (
            f"life.{RELUBRICATION}: rule for lithium grease, a horizontal shaft and clean "
            "surroundings, with the temperature of the oil; the grease maker's data go before it"
        )
    if results.clearance is None:
        yield (
            "clearance: taken as the operating one, the case gives neither [fit] nor "
            "[temperatures]; the rest null"
        )
    else:
        yield from results.clearance.messages
        yield from _cage_messages(results)
    if life is None or life.viscosity_ratio is None:
        return
    films = life_by_films(results)
    if films is None:
        yield (
            "life: kappa_film and what follows from it null, they need a resolved film and "
            "[surface] roughness"
        )
    else:
        if films.note:
            yield f"life: modified rating with the film of each contact null, {films.note}"
        exponent = results.case["surface"]["kappa_exponent"]
        yield (
            f"life: kappa_film is the smallest lambda_ratio to the power {exponent:g}, a rule "
            "that is unverified; kappa of each contact likewise"
        )


def _cage_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason why the change of the cage's clearances is null."""
    cage = None if results.clearance is None else results.clearance.cage
    if cage is None:
        yield (
            "clearance: cage_pocket_change_um, cage_land_change_um null, the case gives no "
            "temperatures.cage_C"
        )
    elif cage.land is None:
        yield (
            "clearance: cage_land_change_um null, no ring guides the cage, or no "
            "cage.land_diameter_mm is given"
        )
    elif cage.land < 0.0:
        given = (results.case.get("cage") or {}).get("land_clearance_um")
        if given is not None and to_si("land_clearance_um", given) + cage.land <= 0.0:
            yield (
                "clearance: at its temperature the cage has no clearance left on its land, "
                f"{given:g} um less {-from_si('cage_land_change_um', cage.land):.3g} um"
            )


def rating_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: clearance, rating life, static safety, viscosity ratio.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    budget = results.clearance
    life = results.life
    rows = {}
    if budget is not None:
        lengths = (budget.initial, budget.mounted, budget.operating)
        values = [round(from_si("clearance_um", length), 1) + 0.0 for length in lengths]  # no -0.0
        rows["clearance"] = "{:.1f} µm delivered, {:.1f} mounted, {:.1f} operating".format(*values)
    if life is None:
        return rows
    available = values_of(life, (*LIFE_RATING, *LOAD_RATING))
    revolutions = available["basic_reference_rating_Mrev"]
    basic = available["basic_reference_rating_h"]
    kappa = available["kappa"]
    if revolutions is None:
        rows["rating life"] = _why_none(life.messages)
    if revolutions is not None and basic is not None:
        rows["rating life"] = _life_text(available)
    if (interval := relubrication_time(results)) is not None:
        time = hours(from_si(RELUBRICATION, interval))
        rows |= (
            {"grease for life": time} if _sealed(results) else {"relubrication": f"every {time}"}
        )
    if available["static_safety_factor"] is not None:
        rows["static safety"] = f"S_0 {available['static_safety_factor']:.3g}"
        if available["static_safety"] is not None:
            rows["static safety"] += f", by pressure {available['static_safety']:.3g}"
    if kappa is not None:
        rows["viscosity ratio"] = f"κ {kappa:.3g}"
        films = life_by_films(results)
        if films is not None:
            rows["viscosity ratio"] += (
                f" from the viscosity, {films.smallest_kappa:.3g} from the thinnest film"
            )
            rows |= film_row(values_of(films, FILM_LIFE))
    return rows


def _life_text(available: dict[str, Any]) -> str:
    """Basic life with its revolutions, and the modified one with its factor."""
    turns = in_figures(available["basic_reference_rating_Mrev"], 4)
    text = f"L10h {hours(available['basic_reference_rating_h'])} ({turns} million revolutions)"
    if available["modified_reference_rating_h"] is None:
        return text
    modified = hours(available["modified_reference_rating_h"])
    limit = ", its limit" if available["a_iso"] >= AT_ITS_LIMIT * LARGEST_A_ISO else ""
    return f"{text}, modified L10mh {modified} (a_ISO {available['a_iso']:.3g}{limit})"


def _why_none(messages: Iterable[str]) -> str:
    """Say "none", with the reason in the messages on the life."""
    start = "life: null, "
    reasons = [message.removeprefix(start) for message in messages if message.startswith(start)]
    return ": ".join(["none", *reasons[:1]])


def film_row(available: dict[str, Any]) -> dict[str, str]:
    """Line of the terminal's table on the life with the film of each contact.

    Parameters
    ----------
    available : dict[str, Any]
        Values of `FILM_LIFE` by key.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    thinnest = available["kappa_film"]
    if thinnest is not None and thinnest < SMALLEST_KAPPA:
        below = f"below {SMALLEST_KAPPA:g}, the least of ISO 281"
        return {"life by the films": f"none: κ of the thinnest film {thinnest:.2g} is {below}"}
    ends = [
        available[f"modified_reference_rating_contacts_{end}h"] for end in ("", "low_", "high_")
    ]
    if ends[0] is None:
        return {}
    text = f"L10mh {hours(ends[0])}"
    if ends[1] is None or ends[2] is None:
        return {"life by the films": text}
    low, high = hours(ends[1]), hours(ends[2])
    band = f"{low} to {high}" if low != high else _no_band(available)
    return {"life by the films": f"{text} ({band})"}


def _no_band(available: dict[str, Any]) -> str:
    """Reason why the error bars of the films do not change the life."""
    if available["a_iso_contacts"] >= AT_ITS_LIMIT * LARGEST_A_ISO:
        return f"a_ISO at its limit of {LARGEST_A_ISO:g}"
    if available["kappa_film"] >= LARGEST_KAPPA:
        return f"every film counts as κ {LARGEST_KAPPA:g}, the limit of ISO 281"
    return "the error bars of the films do not move it"

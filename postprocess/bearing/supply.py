"""The blocks `supply` and `decay` of the summary: starved films, which numbers are flooded ones,
films after the supply stops.
"""

from collections.abc import Iterator
from math import isfinite
from typing import Any

from bearing.films.film import ContactFilm, FilmOrigin, Films
from bearing.films.operating import of_driven_balls

from ..netcdf.groups import Group, Variables
from ..quantities import values_of
from .quantities import DECAY, DECAY_COURSE, GROOVE_OIL, SUPPLY, SUPPLY_BAND
from .results import BearingResults

FLOOD_MARGIN = 1.0e-3  # of the flooded film: with less missing a contact is reported flooded [-]


def supply_block(results: BearingResults) -> dict[str, Any]:
    """Starved films of the balls that both races load, and the torque at the supply.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, Any]
        by their keys, None where the supply is flooded
    """
    torque = results.torque
    films = _driven(results)
    starved = None if torque is None else torque.starved
    beside = results.supply_torque
    ratios = [film.lambda_ratio for film in films if isfinite(film.lambda_ratio)]
    values = (
        sum(film.supply.central for film in films) / len(films) if films else None,
        min((film.supply.central for film in films), default=None),
        min(ratios, default=None),
        None if starved is None else starved.oil_fraction,
        None if beside is None else beside.scarce,
        None if beside is None else beside.flooded,
    )
    pairs = zip(SUPPLY, values, strict=True)
    block = {own.key: own.in_unit(value) for own, value in pairs}
    band = values_of(results.supply_band, SUPPLY_BAND)
    finite = {
        key: value if value is None or isfinite(value) else None for key, value in band.items()
    }
    on_paper = values_of(results.groove_oil, GROOVE_OIL)
    return {"kind": supply_kind(results)} | block | finite | on_paper


def supply_kind(results: BearingResults) -> str:
    """Kind of supply that the case gives.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    str
        "inlet film", "flow", else "flooded"
    """
    if "inlet_film_um" in results.case.get("lubricant", ()):
        return "inlet film"
    return "flow" if "supply_mL_min" in results.case.get("friction", ()) else "flooded"


def supply_messages(results: BearingResults) -> Iterator[str]:
    """Name the starved numbers, and the reason for null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    kind = supply_kind(results)
    torque = results.torque
    if kind == "flooded":
        yield "supply: flooded; its numbers and the starved films of contacts are null"
        return
    if torque is None or not torque.films:
        yield (
            "supply: null, and the starved films of contacts, since there is no equilibrium or "
            "nothing turns"
        )
        return
    films = [film for film in torque.films if film is not None]
    yield from _outside_message(torque.films, results)
    yield from _groove_message(results)
    if torque.behind_layers:
        yield from _layer_messages(results)
        return
    yield from _unsolved_message(results)
    if torque.starved is not None and torque.starved.oil_fraction >= 1.0:
        yield (
            "supply: the flow would fill the cavity within supply_residence_s, it counts as full; "
            "drag and starved torque are an upper bound, not a prediction"
        )
    yield (
        f"supply: {kind}; starved are starved_film_... of the contacts (flooded films "
        f"{_origin(films)}), supply, the torque model starved{_total_text(results)}; film_..., "
        "lambda_ratio, maps and the other torque models are flooded"
    )
    if len(films) < len(torque.films):
        yield "contacts.starved_film_...: null where no flooded film is known"
    if not any(isfinite(film.lambda_ratio) for film in films):
        yield "contacts.starved_lambda_ratio: null, and supply.lambda_least, there is no roughness"
    yield from _band_messages(results)
    if torque.starved is None:
        yield "supply.oil_fraction: null as the model starved"
    if results.supply_torque is None or results.supply_torque.scarce is None:
        yield "supply.torque_N_mm, ..._low_, ..._high_, flooded_...: null without torque of films"
    if films and all(film.supply.central > 1.0 - FLOOD_MARGIN for film in films):
        yield f"supply: ample, every contact keeps its flooded film to {FLOOD_MARGIN:.1%}"


def _groove_message(results: BearingResults) -> Iterator[str]:
    """Limits of the balance on paper, or the reason why there is none."""
    oil = results.groove_oil
    if oil is None:
        yield "supply.groove_...: null, no flow with supply_groove_s"
    elif oil.best_flow is None:
        yield "supply.groove_best_flow_mL_min: null, there is no roughness"
    else:
        yield (
            "supply.groove_...: a balance of oil on paper, whose free number is "
            "supply_track_share times supply_groove_s; that six roughnesses mark least friction "
            "is assumed"
        )


def _unsolved_message(results: BearingResults) -> Iterator[str]:
    """Warn if no film was solved behind its layer although the case asks for it."""
    ehl = results.case.get("ehl", {})
    if ehl.get("starvation") == "solved" and ehl.get("film_maps") == "none":
        yield (
            'supply: [ehl] starvation = "solved" solves no film here, since film_maps is "none"; '
            "what follows is the law of starvation over films of the film atlas and of formulas"
        )


def _band_messages(results: BearingResults) -> Iterator[str]:
    """Explain the band, or the reason why there is none."""
    band = results.supply_band
    if band is None:
        yield "supply: ..._low and ..._high null, the supply is no flow"
        return
    low = band.low
    high = band.high
    yield (
        f"supply: a band, {low.film_share:.3g} to {high.film_share:.3g} of the flooded films for "
        f"{low.track_share:g} to {high.track_share:g} of the flow on the tracks, which is not "
        "known; all else is at supply_track_share. supply_loss, the share lost between two "
        "balls, is as little known: the smaller it is, the thicker the layer"
    )


def _layer_messages(results: BearingResults) -> Iterator[str]:
    """Which numbers are starved where films stand behind layers."""
    behind = [
        (f"ball {contact.ball} {contact.race.value}", film.supply)
        for contact, film in zip(results.contacts, results.solutions, strict=True)
        if film is not None and film.supply is not None
    ]
    by_law = any(supply.law is not None for _, supply in behind)
    how = "by the law of starvation" if by_law else "solved"
    yield (
        f"supply: {supply_kind(results)}, films {how} behind {_whose_layer(results)}: film_..., "
        "lambda_ratio, maps and the integrated torque are starved, flooded_film_... the flooded "
        "films; the torque model starved is of first order, all others are flooded"
    )
    if supply_kind(results) == "flow":
        yield from _band_messages(results)
    if by_law:
        yield (
            "contacts.meniscus_position: null, the law of starvation knows none; its films stand "
            "in the flooded pressure, of whose rolling moment rolling_moment_ratio is left"
        )
        return
    ahead = [name for name, supply in behind if supply.meniscus is None]
    if ahead:
        yield f"contacts.meniscus_position: null, the layer floods the box ({', '.join(ahead)})"


def _outside_message(films: Films, results: BearingResults) -> Iterator[str]:
    """Contacts that the law of starvation was not solved for."""
    names = [
        f"ball {contact.ball} {contact.race.value}"
        for contact, film in zip(results.contacts, films, strict=True)
        if film is not None and not film.supply.inside
    ]
    if names:
        yield (
            "supply: outside the contacts that the law of starvation was solved for, with the "
            f"shares of the nearest ones ({', '.join(names)})"
        )


def _whose_layer(results: BearingResults) -> str:
    if supply_kind(results) == "flow":
        return "the layer that each contact finds in the steady state (by films without a solve)"
    return "it"


def _origin(films: list[ContactFilm]) -> str:
    solved = sum(film.origin is FilmOrigin.SOLVED for film in films)
    if solved == len(films):
        return "solved"
    return f"solved for {solved}, else formulas" if solved else "of formulas"


def _total_text(results: BearingResults) -> str:
    if results.case.get("lubricant", {}).get("supply") == "flooded":
        return " (lubricant.supply keeps the total flooded)"
    if results.torque is not None and results.torque.chosen == "integrated":
        return " and the total, whose films and rolling moments are those at the supply"
    return ""


def decay_block(results: BearingResults) -> dict[str, Any]:
    """Contact, times and film at the end after the supply stops.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, Any]
        by their keys, None where it was not asked for
    """
    decay = results.decay
    contact = None if decay is None else decay.contact
    place = {
        "ball": None if contact is None else contact.ball,
        "race": None if contact is None else contact.race.value,
    }
    return place | values_of(decay, DECAY)


def decay_messages(results: BearingResults) -> Iterator[str]:
    """Explain the block `decay`, or the reason why it is null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    decay = results.decay
    if decay is None:
        asked = "supply_decay_s" in results.case.get("friction", ())
        why = "there is no film to begin with" if asked else "the case gives no supply_decay_s"
        yield f"decay: null, {why}"
        return
    end = float(decay.time[-1])
    yield (
        f"decay: ball {decay.contact.ball} {decay.contact.race.value}, {end:.4g} s after the "
        "supply stops; no oil returns from beside the tracks, on which real bearings depend; "
        "films without the heat of inlets"
    )
    if decay.loss > 0.0:
        yield (
            f"decay: {decay.loss:.3g} of a layer is lost between two balls (supply_loss); without "
            f"it the closed forms leave {float(decay.joined[-1] / decay.film[0]):.2g} of the film"
        )
    if decay.half_time is None:
        yield "decay.half_time_s: null, more than half is left at the end"
    if decay.contact_time is None:
        why = "the film is thicker all the time" if decay.roughness else "there is no roughness"
        yield f"decay.contact_time_s: null, {why}"


def decay_group(results: BearingResults) -> Group | None:
    """The course of the film after the supply stops as a netCDF group.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    Group | None
        SI; None without one
    """
    decay = results.decay
    if decay is None:
        return None
    variables: Variables = {
        own.source: (
            ("time",),
            getattr(decay, own.source),
            own.si_attributes | {"long_name": own.title},
        )
        for own in DECAY_COURSE
    }
    place = {"ball": decay.contact.ball, "race": decay.contact.race.value}
    return Group(variables=variables, attributes=place)


def supply_rows(results: BearingResults) -> dict[str, str]:
    """The supply for the terminal.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, str]
        texts by their titles
    """
    films = _driven(results)
    if not films:
        return {}
    mean = sum(film.supply.central for film in films) / len(films)
    least = min(film.lambda_ratio for film in films)
    text = f"{supply_kind(results)}: loaded films {100.0 * mean:.3g} % of flooded"
    band = results.supply_band
    if band is not None:
        text += f" ({100.0 * band.low.film_share:.3g} to {100.0 * band.high.film_share:.3g} %)"
    return {"oil supply": text + (f", smallest λ {least:.3g}" if isfinite(least) else "")}


def _driven(results: BearingResults) -> list[ContactFilm]:
    """Films of the balls that both races load; none where the oil is not scarce."""
    torque = results.torque
    if torque is None or not torque.films:
        return []
    return of_driven_balls(results.quasistatic, results.contacts, torque.films)

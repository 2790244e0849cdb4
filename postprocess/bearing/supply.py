"""The block `supply` of the summary: starved films, and which numbers are flooded ones."""

from collections.abc import Iterator
from math import isfinite
from typing import Any

from bearing.supply.starved_films import StarvedFilm, of_driven_balls
from bearing.torque.breakdown import TorqueBreakdown

from .quantities import SUPPLY
from .results import BearingResults

FLOOD_MARGIN = 1.0e-3  # of the flooded film: with less missing a contact is reported flooded [-]


def supply_block(results: BearingResults) -> dict[str, Any]:
    """Starved films of the balls that both races load, and the torque at the supply [N mm].

    None where the supply is flooded.
    """
    torque = results.torque
    films = _driven(results)
    starved = None if torque is None else torque.starved
    ratios = [film.lambda_ratio for film in films if isfinite(film.lambda_ratio)]
    values = (
        sum(film.share for film in films) / len(films) if films else None,
        min((film.share for film in films), default=None),
        min(ratios, default=None),
        None if starved is None else starved.oil_fraction,
        None if starved is None else starved.total,
        None if starved is None else starved.flooded,
    )
    pairs = zip(SUPPLY, values, strict=True)
    return {"kind": supply_kind(results)} | {own.key: own.in_unit(value) for own, value in pairs}


def supply_kind(results: BearingResults) -> str:
    """How the case gives the supply: "inlet film", "flow", else "flooded"."""
    if "inlet_film_um" in results.case.get("lubricant", ()):
        return "inlet film"
    return "flow" if "supply_mL_min" in results.case.get("friction", ()) else "flooded"


def supply_messages(results: BearingResults) -> Iterator[str]:
    """Which numbers are starved, and why they are null."""
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
    if torque.behind_layers:
        yield from _layer_messages(results)
        return
    yield (
        f"supply: {kind}; starved are starved_film_... of the contacts (flooded films "
        f"{_origin(films)}), supply, and the torque model starved{_total_text(torque)}; film_..., "
        "lambda_ratio, maps and the other torque models are flooded"
    )
    if len(films) < len(torque.films):
        yield "contacts.starved_film_...: null where no flooded film is known"
    if not any(isfinite(film.lambda_ratio) for film in films):
        yield "contacts.starved_lambda_ratio: null, and supply.lambda_least, there is no roughness"
    if torque.starved is None:
        yield "supply: torque and oil_fraction null as the model starved"
    if films and all(film.share > 1.0 - FLOOD_MARGIN for film in films):
        yield f"supply: ample, every contact keeps its flooded film to {FLOOD_MARGIN:.1%}"


def _layer_messages(results: BearingResults) -> Iterator[str]:
    """Which numbers are starved where films were solved behind layers."""
    yield (
        "supply: inlet film, films solved behind it: film_..., lambda_ratio, maps and the "
        "integrated torque are starved, flooded_film_... the flooded films; the torque model "
        "starved is of first order, all others are flooded"
    )
    ahead = [
        f"ball {contact.ball} {contact.race.value}"
        for contact, film in zip(results.contacts, results.solutions, strict=True)
        if film is not None and film.supply is not None and film.supply.meniscus is None
    ]
    if ahead:
        yield f"contacts.meniscus_position: null, the layer floods the box ({', '.join(ahead)})"


def _origin(films: list[StarvedFilm]) -> str:
    solved = sum(film.solved for film in films)
    if solved == len(films):
        return "solved"
    return f"solved for {solved}, else formulas" if solved else "of formulas"


def _total_text(torque: TorqueBreakdown) -> str:
    if torque.chosen == "starved":
        return ", which is the total"
    if not torque.for_supply:
        return " (lubricant.supply keeps the total flooded)"
    return " (null, so the total is flooded)"


def supply_rows(results: BearingResults) -> dict[str, str]:
    """The supply for the terminal."""
    films = _driven(results)
    if not films:
        return {}
    mean = sum(film.share for film in films) / len(films)
    least = min(film.lambda_ratio for film in films)
    text = f"{supply_kind(results)}: loaded films {100.0 * mean:.3g} % of flooded"
    return {"oil supply": text + (f", smallest λ {least:.3g}" if isfinite(least) else "")}


def _driven(results: BearingResults) -> list[StarvedFilm]:
    """Films of the balls that both races load; none where the oil is not scarce."""
    torque = results.torque
    if torque is None or not torque.films:
        return []
    return of_driven_balls(results.quasistatic, results.contacts, torque.films)

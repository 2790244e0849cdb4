"""What a summary says of the oil supply: films that are starved, and which numbers are flooded
ones.
"""

from collections.abc import Iterator
from math import cos, hypot, isfinite, sin
from typing import Any

from bearing.supply.starved_films import StarvedFilm, of_driven_balls
from bearing.supply.supply import compression, starvation_exponent, starved_share
from bearing.torque.breakdown import TorqueBreakdown
from ehl import ContactConditions
from ehl.units import MICROMETRE, NEWTON_MILLIMETRE

from ..results import BearingResults, ContactResults

KEYS = (
    "film_share",
    "film_share_least",
    "lambda_least",
    "oil_fraction",
    "torque_N_mm",
    "flooded_torque_N_mm",
)
OF_CONTACT = (
    "starved_film_share",
    "starved_film_central_um",
    "starved_film_minimum_um",
    "starved_lambda_ratio",
)
# below the flooded film by less than this share a contact is told as flooded [-]
FLOOD_MARGIN = 1.0e-3


def supply_block(results: BearingResults) -> dict[str, Any]:
    """Starved films of the balls that both races load, and the torque at the supply [N mm]; None
    where flooded.
    """
    torque = results.torque
    films = _driven(results)
    starved = None if torque is None else torque.starved
    ratios = [film.lambda_ratio for film in films if isfinite(film.lambda_ratio)]
    values = {
        "film_share": sum(film.share for film in films) / len(films) if films else None,
        "film_share_least": min((film.share for film in films), default=None),
        "lambda_least": min(ratios, default=None),
        "oil_fraction": None if starved is None else starved.oil_fraction,
        "torque_N_mm": None if starved is None else starved.total / NEWTON_MILLIMETRE,
        "flooded_torque_N_mm": None if starved is None else starved.flooded / NEWTON_MILLIMETRE,
    }
    return {"kind": supply_kind(results), **values}


def supply_kind(results: BearingResults) -> str:
    """How the case tells the supply: "inlet film", "flow", else "flooded"."""
    if "inlet_film_um" in results.case.get("lubricant", ()):
        return "inlet film"
    return "flow" if "supply_mL_min" in results.case.get("friction", ()) else "flooded"


def starved_values(results: BearingResults, index: int) -> dict[str, float | None]:
    """Share of the flooded film [-], the films left [um] and their lambda ratio of one contact;
    None where flooded.
    """
    torque = results.torque
    film = torque.films[index] if torque is not None and torque.films else None
    if film is None:
        return dict.fromkeys(OF_CONTACT)
    ratio = film.lambda_ratio if isfinite(film.lambda_ratio) else None
    return dict(
        zip(
            OF_CONTACT,
            (film.share, film.central / MICROMETRE, film.minimum / MICROMETRE, ratio),
            strict=True,
        )
    )


def supply_messages(results: BearingResults) -> Iterator[str]:
    """Which numbers are starved, and why they are null."""
    kind = supply_kind(results)
    torque = results.torque
    if kind == "flooded":
        yield "supply: flooded; its numbers and the starved films of contacts are null"
        return
    if torque is None or not torque.films:
        yield "supply: null, and the starved films of contacts, since there is no equilibrium or nothing turns"
        return
    films = [film for film in torque.films if film is not None]
    solved = sum(film.solved for film in films)
    whose = (
        "solved"
        if solved == len(films)
        else "of formulas"
        if not solved
        else f"solved for {solved}, else formulas"
    )
    yield (
        f"supply: {kind}; starved are starved_film_... of the contacts (flooded films {whose}), supply, and the torque "
        f"model starved{_total_words(torque)}; film_..., lambda_ratio, maps and the other torque models are flooded"
    )
    if len(films) < len(torque.films):
        yield "contacts.starved_film_...: null where no flooded film is known"
    if not any(isfinite(film.lambda_ratio) for film in films):
        yield "contacts.starved_lambda_ratio: null, and supply.lambda_least, there is no roughness"
    if torque.starved is None:
        yield "supply: torque and oil_fraction null as the model starved"
    if films and all(film.share > 1.0 - FLOOD_MARGIN for film in films):
        yield f"supply: ample, every contact keeps its flooded film to {FLOOD_MARGIN:.1%}"


def contact_starved_values(results: ContactResults) -> dict[str, float | None]:
    """Share of the flooded film [-] and the films left [um] of a single contact; None without an
    inlet film.
    """
    solution = results.solution
    layer = results.case.get("lubricant", {}).get("inlet_film_um")
    central, minimum = solution.film_central, solution.film_minimum
    if layer is None or central is None or minimum is None or not solution.converged:
        return dict.fromkeys(OF_CONTACT[:3])
    given = solution.conditions
    assert isinstance(given, ContactConditions)  # the film has a length
    along, across = cos(given.entrainment_angle), sin(given.entrainment_angle)
    ratio = hypot(across, solution.semi_axis_ratio * along) / hypot(
        along, solution.semi_axis_ratio * across
    )
    packed = compression(solution.hertz_pressure, given.lubricant) * central
    share = starved_share(layer * MICROMETRE / packed, starvation_exponent(ratio))
    return dict(
        zip(
            OF_CONTACT[:3],
            (share, share * central / MICROMETRE, share * minimum / MICROMETRE),
            strict=True,
        )
    )


def contact_supply_messages(results: ContactResults) -> Iterator[str]:
    """Which numbers of a single contact are starved, or why none is."""
    if "inlet_film_um" not in results.case.get("lubricant", ()):
        yield "starved_film_...: null, the supply is flooded"
    elif results.solution.converged:
        yield "supply: inlet film; starved are starved_film_... alone, all else is that of the flooded film"
    else:
        yield "starved_film_...: null, the flooded film did not converge"


def supply_rows(results: BearingResults) -> dict[str, str]:
    """The supply for the terminal."""
    films = _driven(results)
    if not films:
        return {}
    mean = sum(film.share for film in films) / len(films)
    least = min(film.lambda_ratio for film in films)
    words = f"{supply_kind(results)}: loaded films {100.0 * mean:.3g} % of flooded"
    return {"oil supply": words + (f", smallest λ {least:.3g}" if isfinite(least) else "")}


def _total_words(torque: TorqueBreakdown) -> str:
    if torque.chosen == "starved":
        return ", which is the total"
    return (
        " (lubricant.supply keeps the total flooded)"
        if not torque.for_supply
        else " (null, so the total is flooded)"
    )


def _driven(results: BearingResults) -> list[StarvedFilm]:
    """Films of the balls that both races load; none where the oil is not scarce."""
    torque = results.torque
    if torque is None or not torque.films:
        return []
    return of_driven_balls(results.quasistatic, results.contacts, torque.films)

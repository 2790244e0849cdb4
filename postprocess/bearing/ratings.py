"""Rating life and clearance in the summary and in the terminal's table."""

from collections.abc import Iterator
from typing import Any

from bearing.rating.life import SMALLEST_KAPPA, life_factor
from ehl.units import from_si, to_si

from ..quantities import values_of
from .contacts import lambda_ratio
from .duty_cycle import hours_text
from .quantities import CLEARANCE, FILM_LIFE, LIFE_RATING, LOAD_RATING
from .results import BearingResults


def life_block(results: BearingResults) -> dict[str, Any]:
    """Rating life, loads and the factors that led to it; None where it does not apply."""
    life = results.life
    loads = () if life is None else LOAD_RATING
    return values_of(life, (*LIFE_RATING, *loads)) | film_life(results)


def least_lambda(results: BearingResults) -> float | None:
    """Smallest lambda ratio of converged, resolved films [-]; None without films or roughness."""
    surface = results.case.get("surface")
    ratios = [
        lambda_ratio(contact, solution.film_minimum, surface)
        for contact, solution in zip(results.contacts, results.solutions, strict=True)
        if solution is not None and solution.converged and solution.resolved
    ]
    return min((ratio for ratio in ratios if ratio is not None), default=None)


def film_life(results: BearingResults) -> dict[str, float | None]:
    """kappa, a_ISO and modified life from the solved films in place of the viscosity, or None."""
    life = results.life
    least = least_lambda(results)
    if life is None or life.viscosity_ratio is None or least is None:
        return dict.fromkeys(FILM_LIFE)
    kappa = least ** results.case["surface"]["kappa_exponent"]
    values = dict.fromkeys(FILM_LIFE) | {"kappa_film": kappa}
    cleanliness = life.rating.contamination_factor
    limit = life.fatigue_load_limit
    if cleanliness is None or limit is None or life.basic_life is None or kappa < SMALLEST_KAPPA:
        return values
    assert life.equivalent_load is not None  # where there is a life
    factor = life_factor(kappa, cleanliness * limit / life.equivalent_load)
    modified = from_si("life_Mrev", factor * life.basic_life)
    return values | {"a_iso_film": factor, "modified_reference_rating_film_Mrev": modified}


def clearance_block(results: BearingResults) -> dict[str, float | None]:
    """Clearance, its changes, pressures of the seats; without a budget the operating one alone."""
    values = values_of(results.clearance, CLEARANCE)
    if results.clearance is None:
        clearance = results.quasistatic.bearing.diametral_clearance
        values["operating_um"] = from_si("clearance_um", clearance)
    return values


def rating_messages(results: BearingResults) -> Iterator[str]:
    """What the two blocks leave out, and why."""
    life = results.life
    yield from ("life: null, no rating was asked for",) if life is None else life.messages
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
    if least_lambda(results) is None:
        yield (
            "life: kappa_film and what follows from it null, they need a resolved film and "
            "[surface] roughness"
        )
    else:
        exponent = results.case["surface"]["kappa_exponent"]
        yield (
            f"life: kappa_film is the smallest lambda_ratio to the power {exponent:g}, a rule "
            "that is unverified"
        )


def _cage_messages(results: BearingResults) -> Iterator[str]:
    """Why the change of the cage's clearances is null."""
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
                "clearance: at its temperature the cage has none left on its land, "
                f"{given:g} um and cage_land_change_um"
            )


def rating_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: clearance where it was computed, life where there is one."""
    budget = results.clearance
    life = results.life
    rows = {}
    if budget is not None:
        lengths = (budget.initial, budget.mounted, budget.operating)
        values = [from_si("clearance_um", length) for length in lengths]
        rows["clearance"] = "{:.1f} µm delivered, {:.1f} mounted, {:.1f} operating".format(*values)
    if life is None:
        return rows
    known = values_of(life, (*LIFE_RATING, *LOAD_RATING))
    revolutions = known["basic_reference_rating_Mrev"]
    hours = known["basic_reference_rating_h"]
    kappa = known["kappa"]
    if revolutions is not None and hours is not None:
        rows["rating life"] = hours_text(hours, known["modified_reference_rating_h"])
        rows["rating life"] += f" ({revolutions:.4g} million revolutions"
        if known["a_iso"] is not None:
            rows["rating life"] += f", a_ISO {known['a_iso']:.3g}"
        rows["rating life"] += ")"
    if known["static_safety_factor"] is not None:
        rows["static safety"] = f"S_0 {known['static_safety_factor']:.3g}"
        if known["static_safety"] is not None:
            rows["static safety"] += f", by pressure {known['static_safety']:.3g}"
    if kappa is not None:
        rows["viscosity ratio"] = f"κ {kappa:.3g}"
        film = film_life(results)["kappa_film"]
        if film is not None:
            rows["viscosity ratio"] += (
                f" from the viscosity, {film:.3g} from the film (λ {least_lambda(results):.3g})"
            )
    return rows

"""Rating life and clearance in the summary and in the terminal's table."""

from collections.abc import Iterator
from math import degrees
from typing import Any

from bearing.rating.life import SMALLEST_KAPPA, life_factor

from ..contact.messages import lambda_ratio
from ..results import BearingResults

# in SI
MICROMETRE = 1e-6
KILONEWTON = 1e3
MEGAPASCAL = 1e6
MILLION = 1e6
LIFE_KEYS = ("basic_reference_rating_Mrev", "modified_reference_rating_Mrev", "a_iso", "kappa")
FILM_KEYS = ("kappa_film", "a_iso_film", "modified_reference_rating_film_Mrev")
LENGTHS = (
    "initial",
    "mounted",
    "operating",
    "inner_fit",
    "outer_fit",
    "thermal",
    "centrifugal",
    "inner_interference",
    "outer_interference",
)
CAGE_KEYS = ("cage_pocket_change_um", "cage_land_change_um")
PRESSURES = ("inner_pressure", "outer_pressure")


def life_block(results: BearingResults) -> dict[str, Any]:
    """Rating life [10^6 revolutions], loads [N] and [kN], the factors that led to it; None where
    it does not apply.
    """
    life = results.life
    if life is None:
        return dict.fromkeys((*LIFE_KEYS, *FILM_KEYS))
    return {
        "basic_reference_rating_Mrev": _in(life.basic_life, MILLION),
        "modified_reference_rating_Mrev": _in(life.modified_life, MILLION),
        "a_iso": life.life_factor,
        "kappa": life.viscosity_ratio,
        "basic_dynamic_rating_kN": _in(life.dynamic_rating, KILONEWTON),
        "dynamic_equivalent_load_N": life.equivalent_load,
        "fatigue_load_limit_N": life.fatigue_load_limit,
        "contamination_factor": life.rating.contamination_factor,
        "nominal_contact_angle_deg": degrees(life.rating.nominal_contact_angle),
        "static_safety": life.static_safety,
        "basic_static_rating_kN": _in(life.static_rating, KILONEWTON),
        "static_equivalent_load_N": life.static_load,
        "static_safety_factor": life.static_safety_factor,
        **film_life(results),
    }


def least_lambda(results: BearingResults) -> float | None:
    """Smallest lambda ratio of the films that converged and are resolved [-]; None without films
    or roughness.
    """
    surface = results.case.get("surface")
    found = []
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None and solution.converged and solution.resolved:
            ratio = lambda_ratio(contact, solution, surface)
            found += [] if ratio is None else [ratio]
    return min(found, default=None)


def film_life(results: BearingResults) -> dict[str, float | None]:
    """kappa, a_ISO and modified life from the solved films instead of the viscosity; None where
    they do not apply.
    """
    life = results.life
    found = dict.fromkeys(FILM_KEYS)
    least = least_lambda(results)
    if life is None or life.viscosity_ratio is None or least is None:
        return found
    kappa = least ** results.case["surface"]["kappa_exponent"]
    found["kappa_film"] = kappa
    cleanliness = life.rating.contamination_factor
    limit = life.fatigue_load_limit
    if cleanliness is None or limit is None or life.basic_life is None or kappa < SMALLEST_KAPPA:
        return found
    assert life.equivalent_load is not None  # where there is a life
    factor = life_factor(kappa, cleanliness * limit / life.equivalent_load)
    return found | {
        "a_iso_film": factor,
        "modified_reference_rating_film_Mrev": factor * life.basic_life / MILLION,
    }


def clearance_block(results: BearingResults) -> dict[str, float | None]:
    """Diametral clearance as delivered, mounted and operating, and its changes [um]; pressures of
    the seats [MPa].
    """
    budget = results.clearance
    keys = (*(f"{name}_um" for name in LENGTHS), *(f"{name}_MPa" for name in PRESSURES))
    cage: dict[str, float | None] = dict.fromkeys(CAGE_KEYS)
    if budget is None:
        clearance = results.quasistatic.bearing.diametral_clearance / MICROMETRE
        return dict.fromkeys(keys) | {"operating_um": clearance} | cage
    if budget.cage is not None:
        cage = dict(
            zip(
                CAGE_KEYS,
                (_in(budget.cage.pocket, MICROMETRE), _in(budget.cage.land, MICROMETRE)),
                strict=True,
            )
        )
    units = (MICROMETRE,) * len(LENGTHS) + (MEGAPASCAL,) * len(PRESSURES)
    names = (*LENGTHS, *PRESSURES)
    return {
        key: getattr(budget, name) / unit
        for key, name, unit in zip(keys, names, units, strict=True)
    } | cage


def rating_messages(results: BearingResults) -> Iterator[str]:
    """What the two blocks leave out, and why."""
    yield from (
        ("life: null, no rating was asked for",) if results.life is None else results.life.messages
    )
    if results.clearance is None:
        yield "clearance: taken as the operating one, the case gives neither [fit] nor [temperatures]; the rest null"
    else:
        yield from results.clearance.messages
        yield from _cage_messages(results)
    if results.life is not None and results.life.viscosity_ratio is not None:
        if least_lambda(results) is None:
            yield "life: kappa_film and what follows from it null, they need a resolved film and [surface] roughness"
        else:
            exponent = results.case["surface"]["kappa_exponent"]
            yield f"life: kappa_film is the smallest lambda_ratio to the power {exponent:g}, a rule that is unverified"


def _cage_messages(results: BearingResults) -> Iterator[str]:
    """Why the change of the cage's clearances is null."""
    cage = None if results.clearance is None else results.clearance.cage
    if cage is None:
        yield "clearance: cage_pocket_change_um, cage_land_change_um null, the case gives no temperatures.cage_C"
    elif cage.land is None:
        yield "clearance: cage_land_change_um null, no ring guides the cage, or no cage.land_diameter_mm is given"
    elif cage.land < 0.0:
        given = (results.case.get("cage") or {}).get("land_clearance_um")
        if given is not None and given * MICROMETRE + cage.land <= 0.0:
            yield f"clearance: the warm cage has none left on its land, {given:g} um and cage_land_change_um"


def rating_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: clearance where it was computed, life where there is one."""
    rows = {}
    budget = results.clearance
    life = results.life
    if budget is not None:
        values = (
            value / MICROMETRE for value in (budget.initial, budget.mounted, budget.operating)
        )
        rows["clearance"] = "{:.1f} µm delivered, {:.1f} mounted, {:.1f} operating".format(*values)
    if life is not None and life.basic_life is not None:
        rows["rating life"] = f"{life.basic_life / MILLION:.4g} million revolutions"
        if life.modified_life is not None:
            rows["rating life"] += (
                f", modified {life.modified_life / MILLION:.4g} (a_ISO {life.life_factor:.3g})"
            )
    if life is not None and life.static_safety_factor is not None:
        rows["static safety"] = f"S_0 {life.static_safety_factor:.3g}"
        if life.static_safety is not None:
            rows["static safety"] += f", by pressure {life.static_safety:.3g}"
    if life is not None and life.viscosity_ratio is not None:
        rows["viscosity ratio"] = f"κ {life.viscosity_ratio:.3g}"
        film = film_life(results)["kappa_film"]
        if film is not None:
            rows["viscosity ratio"] += (
                f" from the viscosity, {film:.3g} from the film (λ {least_lambda(results):.3g})"
            )
    return rows


def _in(value: float | None, unit: float) -> float | None:
    return None if value is None else value / unit

"""Rating life and clearance in the summary and in the terminal's table."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .results import BearingResults

MICROMETRE, KILONEWTON, MEGAPASCAL, MILLION = 1e-6, 1e3, 1e6, 1e6  # in SI
LIFE_KEYS = ("basic_reference_rating_Mrev", "modified_reference_rating_Mrev", "a_iso", "kappa")
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
PRESSURES = ("inner_pressure", "outer_pressure")


def life_block(results: BearingResults) -> dict[str, Any]:
    """Rating life [10^6 revolutions], loads [N] and [kN], the factors that led to it; None where it does not apply."""
    life = results.life
    if life is None:
        return dict.fromkeys(LIFE_KEYS)
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
    }


def clearance_block(results: BearingResults) -> dict[str, float | None]:
    """Diametral clearance as delivered, mounted and operating, and its changes [um]; pressures of the seats [MPa]."""
    budget = results.clearance
    keys = (*(f"{name}_um" for name in LENGTHS), *(f"{name}_MPa" for name in PRESSURES))
    if budget is None:
        clearance = results.quasistatic.bearing.diametral_clearance / MICROMETRE
        return dict.fromkeys(keys) | {"operating_um": clearance}
    units = (MICROMETRE,) * len(LENGTHS) + (MEGAPASCAL,) * len(PRESSURES)
    names = (*LENGTHS, *PRESSURES)
    return {key: getattr(budget, name) / unit for key, name, unit in zip(keys, names, units, strict=True)}


def rating_messages(results: BearingResults) -> Iterator[str]:
    """What the two blocks leave out, and why."""
    yield from ("life: null, no rating was asked for",) if results.life is None else results.life.messages
    if results.clearance is None:
        yield "clearance: taken as the operating one, the case gives neither [fit] nor [temperatures]; the rest null"
    else:
        yield from results.clearance.messages


def rating_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: clearance where it was computed, life where there is one."""
    rows, budget, life = {}, results.clearance, results.life
    if budget is not None:
        values = (value / MICROMETRE for value in (budget.initial, budget.mounted, budget.operating))
        rows["clearance"] = "{:.1f} µm delivered, {:.1f} mounted, {:.1f} operating".format(*values)
    if life is not None and life.basic_life is not None:
        rows["rating life"] = f"{life.basic_life / MILLION:.4g} million revolutions"
        if life.modified_life is not None:
            rows["rating life"] += f", modified {life.modified_life / MILLION:.4g} (a_ISO {life.life_factor:.3g})"
    if life is not None and life.viscosity_ratio is not None:
        rows["viscosity ratio"] = f"κ {life.viscosity_ratio:.3g}"
    return rows


def _in(value: float | None, unit: float) -> float | None:
    return None if value is None else value / unit

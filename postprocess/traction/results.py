"""Traction tables of a case: their file, summary and plots."""

from dataclasses import asdict, dataclass, field
from math import isfinite
from typing import Any

from bearing.friction.race_tables import Tables, TemperatureTables
from ehl.traction.table.full_solves import FullSolve


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResults:
    """Tables of both races and the case they belong to; times in [s]."""

    version: str
    case: dict[str, Any]
    tables: Tables
    over_temperature: TemperatureTables | None = None
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)


def traction_summary(results: TractionResults) -> dict[str, Any]:
    """Summary of the tables: ranges, error, largest coefficients; units in the keys."""
    races = {}
    for race, table in results.tables.items():
        limits = table.range
        error = asdict(table.error)
        races[race.value] = {
            "converged": table.converged,
            "message": table.message,
            "load_N": list(limits.load),
            "entrainment_speed_m_s": list(limits.speed),
            "slide_roll_ratio": limits.slide_x,
            "lateral_slide_ratio": limits.slide_y,
            "spin_roll_ratio": limits.spin,
            "films": table.films,
            "points": table.points,
            "nodes": [int(count) for count in table.axes[:, 2]],
            "largest_coefficient": table.kappa_max,
            "error": {key: value for key, value in error.items() if key != "tolerance"},
            "tolerance": table.error.tolerance,
        }
        if results.over_temperature is not None:
            found = results.over_temperature[race]
            races[race.value] |= {
                "temperatures_K": list(found.temperatures),
                "largest_error_between": [between.largest for between in found.errors],
            }
        races[race.value]["full_solves"] = [_beside(one) for one in table.full_solves] or None
    told = [
        f"{race.value} race: {t.message}"
        for race, t in results.tables.items()
        if t.message != "converged"
    ]
    told += _open_solves(results)
    everything = (results.over_temperature or results.tables).values()
    converged = all(table.converged for table in everything)
    beside = [one.converged for table in results.tables.values() for one in table.full_solves]
    prefix = (
        []
        if converged
        else ["not converged: a traction table misses its tolerance or a film did not converge"]
    )
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": converged and all(beside),
        "messages": [*prefix, *results.messages, *told],
        "tables": races,
        "timing_s": results.timing,
    }


def _beside(one: FullSolve) -> dict[str, Any]:
    """The table's film and a full solve at one place; units in the keys."""
    numbers = {
        "load_N": one.load,
        "entrainment_speed_m_s": one.speed,
        "slide_roll_ratio": one.slide_ratio,
        "coefficient_by_table_film": one.by_film,
        "coefficient_in_full": one.in_full,
        "film_ratio": one.film_ratio,
    }
    return {key: value if isfinite(value) else None for key, value in numbers.items()} | {
        "converged": one.converged
    }


def _open_solves(results: TractionResults) -> list[str]:
    """Which full solves beside the tables did not converge."""
    return [
        f"{race.value} race: the full solve at {one.load:.4g} N, {one.speed:.3g} m/s, slide-roll ratio "
        f"{one.slide_ratio:.4f} did not converge: its coefficient tells nothing of the table"
        for race, table in results.tables.items()
        for one in table.full_solves
        if not one.converged
    ]

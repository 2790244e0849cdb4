"""Traction tables of a case: their file, summary, terminal table and plots."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bearing.traction_tables import Tables, save_race_tables

if TYPE_CHECKING:
    from rich.console import Group


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResults:
    """Tables of both races and the case they belong to; times in [s]."""

    version: str
    case: dict[str, Any]
    tables: Tables
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)


def traction_summary(results: TractionResults) -> dict[str, Any]:
    """Summary of the tables: ranges, error, largest coefficients; units in the keys."""
    races = {}
    for race, table in results.tables.items():
        limits, error = table.range, asdict(table.error)
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
    told = [f"{race.value} race: {t.message}" for race, t in results.tables.items() if t.message != "converged"]
    converged = all(table.converged for table in results.tables.values())
    prefix = [] if converged else ["not converged: a traction table misses its tolerance or a film did not converge"]
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": converged,
        "messages": [*prefix, *results.messages, *told],
        "tables": races,
        "timing_s": results.timing,
    }


def traction_table(results: TractionResults) -> Group:
    """What a run prints: range and error of each race's table."""
    from rich.console import Group
    from rich.table import Table

    found = Table(title=str(results.case.get("title", "")), title_justify="left")
    for name in ("race", "load [N]", "speed [m/s]", "films", "largest µ", "error 95 %", "largest"):
        found.add_column(name, justify="left" if name == "race" else "right")
    for race, table in results.tables.items():
        low, high = table.range.load
        slow, fast = table.range.speed
        found.add_row(
            race.value,
            f"{low:.3g} to {high:.4g}",
            f"{slow:.3g} to {fast:.3g}",
            str(table.films),
            f"{table.kappa_max:.4f}",
            f"{table.error.quantile:.2%}",
            f"{table.error.largest:.2%}",
        )
    return Group(found, *(f"  {message}" for message in traction_summary(results)["messages"]))


def write_traction(results: TractionResults, path: Path) -> None:
    """Write the tables to a file, and beside it its plots, `<name>_curves.png` and `<name>_map.png`."""
    from .plots_traction import write_traction_plots

    save_race_tables(results.tables, path)
    write_traction_plots(results, path)

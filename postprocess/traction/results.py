"""Traction tables of a case: results and summary."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from oilfilm.bearing.friction.tables import Tables, TemperatureTables
from oilfilm.ehl.traction_table.table import FullSolve, TractionTable

from ..files import plain
from ..quantities import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class TractionResults(Results):
    """Tables of both races and the case they belong to."""

    tables: Tables
    over_temperature: TemperatureTables | None = None


def traction_summary(results: TractionResults) -> dict[str, Any]:
    """Summary of the tables: ranges, error, largest coefficients; units in the keys.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    races = {}
    for race, table in results.tables.items():
        block = _table_block(table)
        if results.over_temperature is not None:
            series = results.over_temperature[race]
            block |= {
                "temperatures_K": list(series.temperatures),
                "largest_error_between": [between.largest for between in series.errors],
            }
        full = [full_solve_entry(solve) for solve in table.full_solves]
        races[race.value] = block | {"full_solves": full or None}
    tables = (results.over_temperature or results.tables).values()
    converged = all(table.converged for table in tables)
    full_converged = [s.converged for table in results.tables.values() for s in table.full_solves]
    reason = "a traction table misses its tolerance or a film did not converge"
    failure = [] if converged else [f"not converged: {reason}"]
    head = results.head(converged and all(full_converged), [*failure, *_messages(results)])
    return head | {"tables": races, "timing_s": results.timing}


def _table_block(table: TractionTable) -> dict[str, Any]:
    error = asdict(table.error)
    return {
        "converged": table.converged,
        "message": table.message,
        "load_N": list(table.range.load),
        "entrainment_speed_m_s": list(table.range.speed),
        "slide_roll_ratio": table.range.slide_x,
        "lateral_slide_ratio": table.range.slide_y,
        "spin_roll_ratio": table.range.spin,
        "films": table.films,
        "points": table.points,
        "nodes": [int(count) for count in table.axes[:, 2]],
        "largest_coefficient": table.kappa_max,
        "error": {key: value for key, value in error.items() if key != "tolerance"},
        "tolerance": table.error.tolerance,
    }


def full_solve_entry(solve: FullSolve) -> dict[str, Any]:
    """The table's film and a full solve at one place; units in the keys.

    Parameters
    ----------
    solve : FullSolve
        Coefficients by the table's film and in full.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    numbers = {
        "load_N": solve.load,
        "entrainment_speed_m_s": solve.speed,
        "slide_roll_ratio": solve.slide_ratio,
        "coefficient_by_table_film": solve.by_film,
        "coefficient_in_full": solve.in_full,
        "film_ratio": solve.film_ratio,
    }
    return dict(plain(numbers)) | {"converged": solve.converged}


def _messages(results: TractionResults) -> Iterator[str]:
    """Tables that did not converge, and full solves beside them that did not."""
    for race, table in results.tables.items():
        if table.message != "converged":
            yield f"{race.value} race: {table.message}"
    for race, table in results.tables.items():
        for solve in table.full_solves:
            if not solve.converged:
                yield (
                    f"{race.value} race: the full solve at {solve.load:.4g} N, "
                    f"{solve.speed:.3g} m/s, slide-roll ratio {solve.slide_ratio:.4f} did not "
                    "converge: its coefficient says nothing about the table"
                )

"""Summary of a batch, every number of its points as columns, and its table."""

from collections.abc import Iterator
from typing import Any

from rich.console import Group
from rich.table import Table

from oilfilm.ehl.units import unit_symbol, without_unit

from ..quantities import NOTHING, in_figures, number, number_table, titled
from .indices import MORRIS, SOBOL, bands, design_documents, sensitivities
from .packed_columns import Columns, InMemory, columns_of
from .results import (
    BATCH_COLUMNS,
    LIVES,
    MAIN_QUANTITY,
    BatchPoint,
    BatchResults,
    Counts,
    main_results,
    scalar_numbers,
)
from .store import FAILED, LOST

# state of a point: name in the summary and in the table, attribute
STATE = {"point": "number", "block": "block", "status": "status", "converged": "converged"}
COUNTS = ("points", "done", "failed", "lost", "missing", "converged")
MOST_NAMED = 10  # points listed in a message
OUTSIDE = "outside loads or speeds of the tables"  # of a point's messages
MOST_ROWS = 40  # of the terminal's table; the files have all
WIDTH = 80
MOST_INDICES = 3  # results whose indices fit beside the keys
CELL = 10  # characters of a column of results


def batch_summary(results: BatchResults, columns: Columns | None = None) -> dict[str, Any]:
    """The document of a batch: each point with its keys and main results, or its message.

    Of a batch too large to list, `points` is null.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    columns : Columns | None, optional
        Numbers of all points; computed from `results` if None.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    columns = columns or columns_of(InMemory(results))
    counts = results.counts or counts_of(results)
    whole = results.counts is None
    points = [_entry(results, point) for point in results.points] if whole else None
    return {
        "oilfilm": results.version,
        "kind": "batch",
        "title": results.title,
        "case": results.case,
        "sweep": results.sweep,
        "assumed": list(results.assumed),
        "converged": results.converged,
        "messages": [*results.messages, *(_messages(results) if whole else _counted(counts))],
        "keys": list(results.keys),
        "points": points,
        "counts": {name: getattr(counts, name) for name in COUNTS},
        "sensitivity": sensitivities(results),
        "bands": bands(columns),
        **design_documents(columns, results.designs),
        "resumed": counts.resumed,
        "failed": counts.failed + counts.lost + counts.missing,
        "timing_s": results.timing,
    }


def _entry(results: BatchResults, point: BatchPoint) -> dict[str, Any]:
    """A point in the list of the summary."""
    return {name: getattr(point, attribute) for name, attribute in STATE.items()} | {
        "keys": point.values,
        "resumed": point.resumed,
        "message": point.message or None,
        **main_results(point.summary),
        "key": point.key,
        "file": f"points/{point.key}.json" if results.with_json else None,
    }


def counts_of(results: BatchResults) -> Counts:
    """How the points of results in memory ended.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    Counts
        Numbers of points by their end.
    """
    points = results.points
    done = sum(point.summary is not None for point in points)
    failed, lost = (sum(point.status == own for point in points) for own in (FAILED, LOST))
    return Counts(
        points=len(points),
        done=done,
        failed=failed,
        lost=lost,
        missing=len(points) - done - failed - lost,
        converged=sum(point.converged for point in points),
        resumed=sum(point.resumed for point in points),
    )


def _counted(counts: Counts) -> Iterator[str]:
    """Messages of a batch whose points are too many to be listed."""
    yield f"points: null, {counts.points} points are listed in the other files only"
    off = counts.done - counts.converged
    if off:
        yield f"{off} of {counts.points} points not converged; column converged of the table"
    for message, count in counts.reasons[:MOST_NAMED]:
        yield f"{count} points without a result, as: {message}"


def _messages(results: BatchResults) -> Iterator[str]:
    """Points without a result, and points of which something did not converge."""
    for point in results.points:
        if point.summary is None:
            yield f"point {point.number} ({point.label}): {point.status}: {point.message}"
        elif not point.converged:
            reasons = [
                f": {message}"
                for message in point.summary.get("messages", ())
                if "not converged" in message or message.startswith("equilibrium")
            ]
            yield f"point {point.number} ({point.label}): not converged{''.join(reasons[:1])}"
    outside = [str(point.number) for point in results.points if _is_outside(point)]
    if outside:
        named = ", ".join(outside[:MOST_NAMED]) + (" ..." if len(outside) > MOST_NAMED else "")
        where = "where the nearest place counts"
        yield f"{len(outside)} points with contacts {OUTSIDE}, {where}: {named}"


def _is_outside(point: BatchPoint) -> bool:
    """True if contacts of a point lie outside its traction tables."""
    return any(OUTSIDE in message for message in (point.summary or {}).get("messages", ()))


def point_numbers(point: BatchPoint) -> dict[str, Any]:
    """Every single number of a point by the name that it has in the table of the batch.

    Parameters
    ----------
    point : BatchPoint
        Point of a batch.

    Returns
    -------
    dict[str, Any]
        Numbers by name.
    """
    return scalar_numbers(point.summary or {}) | main_results(point.summary)


def batch_table(results: BatchResults, columns: Columns | None = None) -> Group:
    """The points of a batch, the ends of many, with the results that fit beside the keys.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    columns : Columns | None, optional
        Numbers of all points; computed from `results` if None.

    Returns
    -------
    Group
        The table.
    """
    columns = columns or columns_of(InMemory(results))
    if results.counts is not None:
        text = f"{results.counts.points} points, {results.counts.converged} converged"
        return titled(results.title, text, *_uncertainties(results, columns))
    main = [main_results(point.summary) for point in results.points]
    given = {key: [point.values.get(key) for point in results.points] for key in results.keys}
    keys = [key for key, varied in given.items() if len({*map(str, varied)}) > 1]
    shown = [name for name in BATCH_COLUMNS if any(row.get(name) is not None for row in main)]
    free = WIDTH - 10 - sum(max(9, len(_name(key))) + 1 for key in keys)
    shown = shown[-max(1, free // CELL) :]
    headers = ["#", *(f"{_name(key)}\n{_unit(key)}" for key in keys)]
    headers += [f"{MAIN_QUANTITY[name].symbol}\n{_unit(name)}" for name in shown]
    rows = []
    for point, row in zip(results.points, main, strict=True):
        cells = [number(point.values.get(key), ".5g") for key in keys]
        cells += [_result(row.get(name), name) for name in shown]
        rows.append([str(point.number), *cells, _flag(point)])
    half = MOST_ROWS // 2
    if len(rows) > MOST_ROWS:
        rows = [*rows[:half], ["..."], *rows[-half:]]
    style: dict[str, Any] = {"padding": (0, 1, 0, 0), "collapse_padding": True}
    table = number_table([*headers, ""], rows, [""], **style)
    for column in table.columns[1 : 1 + len(keys)]:
        column.no_wrap = False
        column.overflow = "fold"
    flags = {_flag(point) for point in results.points}
    meanings = {"!": "! not converged", "x": "x failed, see the messages"}
    notes = [text for flag, text in meanings.items() if flag in flags]
    return titled(results.title, table, *notes, *_uncertainties(results, columns))


def _uncertainties(results: BatchResults, columns: Columns) -> list[Table]:
    """Sensitivities to each key, and bands over sampled keys, of a few main results, if any."""
    tables = []
    changes = sensitivities(results)
    names = [
        name for name in BATCH_COLUMNS if any(name in change["results"] for change in changes)
    ]
    if changes:
        rows = [
            [change["key"], *(_sensitivity(change["results"].get(name)) for name in names)]
            for change in changes
        ]
        headers = ["key", *(MAIN_QUANTITY[name].symbol for name in names)]
        title = "d ln(result)/d ln(key); ~: within the error bars"
        tables.append(number_table(headers, rows, ["key"], title=title))
        tables[-1].columns[0].no_wrap = False
    spread = {name: band for name, band in bands(columns).items() if name in BATCH_COLUMNS}
    if spread:
        rows = [
            [
                f"{MAIN_QUANTITY[name].symbol} {_unit(name)}",
                *(_result(band[quantile], name, 4) for quantile in ("q05", "q50", "q95")),
            ]
            for name, band in spread.items()
        ]
        headers = ["", "5 %", "median", "95 %"]
        count = min(band["points"] for band in spread.values())
        title = f"over {count} sampled points"
        tables.append(number_table(headers, rows, [""], title=title))
    return [*tables, *_indices(design_documents(columns, results.designs))]


def _indices(documents: dict[str, Any]) -> Iterator[Table]:
    """Which key matters, for a few main results: by Sobol indices, by Morris' effects."""
    kinds = {
        SOBOL: ("total", "Sobol indices, total, and first ones in brackets"),
        MORRIS: ("mean_magnitude", "mean magnitude of Morris' effects over the range of the key"),
    }
    for kind, (value, title) in kinds.items():
        result = (documents[kind] or {}).get("results", {})
        shown = {n: r for n, r in result.items() if n in BATCH_COLUMNS and isinstance(r, dict)}
        names = list(shown)[-MOST_INDICES:]
        if not names:
            continue
        rows = []
        for key in (key for key in shown[names[0]] if key != "trajectories"):
            cells = [number(shown[name][key][value], ".3g") for name in names]
            if kind == SOBOL:
                firsts = (f" ({number(shown[name][key]['first'], '.2f')})" for name in names)
                cells = [cell + first for cell, first in zip(cells, firsts, strict=True)]
            rows.append([key, *cells])
        units = ["" if kind == SOBOL else f"\n{_unit(name)}" for name in names]
        heads = [
            MAIN_QUANTITY[name].symbol + unit for name, unit in zip(names, units, strict=True)
        ]
        yield number_table(["key", *heads], rows, ["key"], title=title)


def _sensitivity(cell: dict[str, Any] | None) -> str:
    if cell is None:
        return NOTHING
    return ("~" if cell["resolved"] is False else "") + f"{cell['sensitivity']:+.3f}"


def _result(value: Any, name: str, figures: int = 5) -> str:
    """A result to some figures, hours of life without a power of ten."""
    if name in LIVES and value is not None:
        return in_figures(value, 4)
    return number(value, f".{figures}g")


def _name(key: str) -> str:
    return without_unit(key.rpartition(".")[2])


def _unit(key: str) -> str:
    return unit_symbol(key.rpartition(".")[2])


def _flag(point: BatchPoint) -> str:
    return "x" if point.summary is None else "" if point.converged else "!"

"""Summary of a batch, every number of its points as columns, and its table.

Effect of the varied keys: Sobol indices, Morris' elementary effects, sensitivities, bands.

Sensitivities are finite differences of [sensitivity] points, bands those of hypercubes.
"""

import warnings
from collections.abc import Iterator, Sequence
from math import hypot
from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.messages import OUTSIDE_TABLE
from oilfilm.ehl.units import unit_symbol, without_unit

from ..quantities import NOTHING, in_figures, number, number_table, titled
from .packed_columns import Columns, InMemory, columns_of
from .results import (
    BATCH_COLUMNS,
    LIVES,
    MAIN_QUANTITY,
    BatchPoint,
    BatchResults,
    Counts,
    Design,
    main_results,
    point_error,
    scalar_numbers,
)
from .store import DONE, FAILED, LOST

CONFIDENCE = 0.95  # of intervals
RESAMPLES = 999  # of a bootstrap
SEED = 91_730_264  # of its random numbers
SOBOL = "sobol_indices"
MORRIS = "morris"
QUANTILES = (0.05, 0.5, 0.95)
SAMPLED = ("latin_hypercube", "sample")  # blocks of points drawn at random
MIN_POINTS = 5  # sampled points that bands need


def main_values(columns: Columns) -> tuple[list[str], Array, list[str]]:
    """Names and values of the main results, and the blocks of the points.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.

    Returns
    -------
    value
        Names of the main results.
    value
        Values, shape (points, results), NaN where a point did not converge.
    value
        Block of each point.
    """
    names = [n for n in columns.names if n in columns.layouts.main and "_uncertainty_" not in n]
    places = [columns.names.index(name) for name in names]
    parts = [np.empty((0, len(names)))]
    blocks: list[str] = []
    for rows, values, _ in columns.chunks():
        part = values[:, places]
        part[[not row.converged for row in rows]] = np.nan
        parts.append(part)
        blocks += [row.block for row in rows]
    return names, np.concatenate(parts), blocks


def sobol_indices(values: Array, keys: int, samples: int) -> tuple[Any, Any, Any]:
    """First and total Sobol indices of one result, and their intervals by bootstrap.

    Saltelli et al. (2010), table 2: first indices by (b), total ones by (f), of Jansen.

    Parameters
    ----------
    values : Array
        Results at the points of Saltelli's design, shape (samples (keys + 2),): A, B, A with one
        column from B after the other.
    keys : int
        Varied keys [-].
    samples : int
        Rows of A [-].

    Returns
    -------
    first
        First indices, shape (keys,) [-].
    total
        Total indices, shape (keys,) [-].
    intervals
        Ends of the intervals of 95 % of both, shape (2, keys, 2) [-].
    """
    from scipy.stats import DegenerateDataWarning
    from scipy.stats import sobol_indices as of_scipy

    parts = values.reshape(keys + 2, 1, samples)
    parts = parts - values[: 2 * samples].mean()
    functions: Any = {"f_A": parts[0], "f_B": parts[1], "f_AB": parts[2:]}
    # resamples without any spread give no interval, which is null then
    with np.errstate(divide="ignore", invalid="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore", DegenerateDataWarning)
        result = of_scipy(func=functions, n=samples)
        bars = result.bootstrap(confidence_level=CONFIDENCE, n_resamples=RESAMPLES)
    ends = [bar.confidence_interval for bar in (bars.first_order, bars.total_order)]
    intervals = np.array([np.column_stack([end.low.ravel(), end.high.ravel()]) for end in ends])
    return result.first_order.ravel(), result.total_order.ravel(), intervals


def finite_or_none(value: float) -> float | None:
    """A finite number; None of another one.

    Parameters
    ----------
    value : float
        Number in any unit.

    Returns
    -------
    float | None
        The number, or None.
    """
    return float(value) if np.isfinite(value) else None


def sobol_document(names: list[str], values: Array, design: Design) -> dict[str, Any]:
    """Sobol indices of the keys, under each main result that varies.

    For each key `first` and `total` index [-] with the ends of their intervals of 95 %; a reason
    in place of them where points have no result.

    Parameters
    ----------
    names : list[str]
        Names of the main results.
    values : Array
        Main results of all points of the batch, shape (points, results).
    design : Design
        Block of points that belong together.

    Returns
    -------
    dict[str, Any]
        `samples`, `points` and `results`.
    """
    count = design.samples * (len(design.keys) + 2)
    block = values[design.start : design.start + count]
    document: dict[str, Any] = {"samples": design.samples, "points": count, "results": {}}
    for name, column in zip(names, block.T, strict=True):
        missing = int(np.isnan(column).sum())
        if missing == count or np.nanmax(column) == np.nanmin(column):
            continue
        if missing:
            document["results"][name] = f"null, {missing} of {count} points have no result"
            continue
        first, total, intervals = sobol_indices(column, len(design.keys), design.samples)
        document["results"][name] = {
            key: {
                "first": float(first[k]),
                "first_low": finite_or_none(intervals[0, k, 0]),
                "first_high": finite_or_none(intervals[0, k, 1]),
                "total": float(total[k]),
                "total_low": finite_or_none(intervals[1, k, 0]),
                "total_high": finite_or_none(intervals[1, k, 1]),
            }
            for k, key in enumerate(design.keys)
        }
    return document


def elementary_effects(values: Array, places: Array) -> tuple[Array, Array]:
    """Elementary effects of one result, Morris (1991): change over the step of the key that moved.

    Parameters
    ----------
    values : ndarray, shape (trajectories, keys + 1)
        Results along the trajectories; NaN where there is none.
    places : ndarray, shape (trajectories, keys + 1, keys)
        Keys along them [-], on any scale in which they are compared.

    Returns
    -------
    effects, steps : ndarray, shape (trajectories, keys)
        Change of the result over that of the key, NaN where it is not known; the
        signed steps of the keys.
    """
    moved = np.diff(places, axis=1)
    key = np.argmax(np.abs(moved), axis=2)
    steps = np.take_along_axis(moved, key[:, :, None], axis=2)[:, :, 0]
    change = np.diff(values, axis=1)
    effects = np.full(change.shape, np.nan)
    sizes = np.full(change.shape, np.nan)
    rows = np.arange(len(values))[:, None]
    effects[rows, key] = change
    sizes[rows, key] = steps
    return effects / sizes, sizes


def morris_document(
    names: list[str], values: Array, design: Design, places: Array
) -> dict[str, Any]:
    """Elementary effects of the keys, under each main result, after Morris.

    For each key the mean of its effects `mean`, of their magnitudes `mean_magnitude` with the ends
    of its interval of 95 %, and their `standard_deviation`, in the unit of the result for the
    whole range of the key; `trajectories` that are complete.

    Parameters
    ----------
    names : list[str]
        Names of the main results.
    values : Array
        Main results of all points of the batch, shape (points, results).
    design : Design
        Block of points that belong together.
    places : Array
        Keys over their ranges, shape (points, keys) [-].

    Returns
    -------
    dict[str, Any]
        `trajectories`, `points` and `results`.
    """
    keys = len(design.keys)
    shape = (design.samples, keys + 1)
    count = design.samples * (keys + 1)
    block = values[design.start : design.start + count]
    rng = np.random.default_rng(SEED)
    document: dict[str, Any] = {"trajectories": design.samples, "points": count, "results": {}}
    for name, column in zip(names, block.T, strict=True):
        effects, _ = elementary_effects(column.reshape(shape), places.reshape(*shape, keys))
        effects = effects[~np.isnan(effects).any(axis=1)]
        if len(effects) < 2 or not effects.any():
            continue
        chosen = rng.integers(len(effects), size=(RESAMPLES, len(effects)))
        spread = np.abs(effects)[chosen].mean(axis=1)
        low, high = np.quantile(spread, (0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE), axis=0)
        rows = {
            key: {
                "mean": float(effects[:, k].mean()),
                "mean_magnitude": float(np.abs(effects[:, k]).mean()),
                "mean_magnitude_low": float(low[k]),
                "mean_magnitude_high": float(high[k]),
                "standard_deviation": float(effects[:, k].std(ddof=1)),
            }
            for k, key in enumerate(design.keys)
        }
        document["results"][name] = {"trajectories": len(effects), **rows}
    return document


def design_documents(columns: Columns, designs: Sequence[Design]) -> dict[str, Any]:
    """Results of the designs of a batch: Sobol indices and Morris' effects.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.
    designs : Sequence[Design]
        Designs of the batch.

    Returns
    -------
    dict[str, Any]
        Documents under `sobol_indices` and `morris`; null without such a design.
    """
    document: dict[str, Any] = {SOBOL: None, MORRIS: None}
    if not any(design.block in document for design in designs):
        return document
    names, values, _ = main_values(columns)
    for design in designs:
        if design.block == SOBOL:
            document[SOBOL] = sobol_document(names, values, design)
        elif design.block == MORRIS:
            places = _places(columns, design)
            document[MORRIS] = morris_document(names, values, design, places)
    return document


def _places(columns: Columns, design: Design) -> Array:
    """Keys of the points of a design over their ranges [-], shape (points, keys)."""
    stop = design.start + design.samples * (len(design.keys) + 1)
    given = []
    for rows in columns.source.chunks():
        for row in rows:
            if design.start < row.number <= stop:
                given.append([row.values[key] for key in design.keys])
    low, high = np.array(design.ranges).T
    return (np.array(given, dtype=float) - low) / (high - low)


def sensitivities(results: BatchResults) -> list[dict[str, Any]]:
    """Logarithmic sensitivities d ln(result)/d ln(key), central differences, O(step^2).

    For every key that [sensitivity] varied: `key`, its `value` in the case, the relative `step`
    [-], and under `results` for every main result its `value`, the `sensitivity` [-] and whether
    it is `resolved`: whether the change is larger than the error bars of the two films, None for
    results without one. Empty without such points.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    list[dict[str, Any]]
        A row for each key.
    """
    block = [point for point in results.points if point.block == "sensitivity"]
    points = [point for point in block if point.summary is not None]
    # the first of the block is the case itself
    if not points or any(points[0].values[key] != block[0].values[key] for key in results.keys):
        return []
    base = points[0]
    rows = []
    reference = main_results(base.summary)
    for key in results.keys:
        pair = [point for point in points[1:] if point.values[key] != base.values[key]]
        if len(pair) == 2:
            low, high = sorted(pair, key=lambda point: point.values[key])
            value = base.values[key]
            step = 0.5 * abs((high.values[key] - low.values[key]) / value)
            changes = _results(reference, low, high, step * (1.0 if value > 0.0 else -1.0))
            rows.append({"key": key, "value": value, "step": step, "results": changes})
    return rows


def _results(
    reference: dict[str, Any], low: BatchPoint, high: BatchPoint, step: float
) -> dict[str, dict[str, Any]]:
    below, above = main_results(low.summary), main_results(high.summary)
    rows = {}
    for name, value in reference.items():
        available = value and below.get(name) is not None and above.get(name) is not None
        if not available or "_uncertainty_" in name:
            continue
        change = above[name] - below[name]
        head, _, unit = name.rpartition("_")
        first, second = (point_error(row, head, unit) for row in (below, above))
        resolved = None
        if first is not None and second is not None:
            resolved = change == 0.0 or abs(change) > hypot(first, second)
        sensitivity = change / (2.0 * step * value)
        rows[name] = {"value": value, "sensitivity": sensitivity, "resolved": resolved}
    return rows


def bands(columns: Columns) -> dict[str, dict[str, Any]]:
    """Spread of the main results over the sampled points that converged.

    For every one `points` [-], and in its unit `mean`, `standard_deviation` and the quantiles
    `q05`, `q50`, `q95`, each with the ends of its interval of 95 % (`q05_low`, `q05_high`), null
    where so few points do not bound it; empty with fewer than five points.

    Parameters
    ----------
    columns : Columns
        Numbers of all points as columns.

    Returns
    -------
    dict[str, dict[str, Any]]
        Spread by main result.
    """
    names, values, blocks = main_values(columns)
    sampled = values[np.isin(blocks, SAMPLED)]
    spread: dict[str, dict[str, Any]] = {}
    for name, column in zip(names, sampled.T, strict=True):
        available = column[~np.isnan(column)]
        if available.size >= MIN_POINTS:
            spread[name] = {
                "points": int(available.size),
                "mean": float(np.mean(available)),
                "standard_deviation": float(np.std(available, ddof=1)),
                **_quantiles(available),
            }
    return spread


def _quantiles(values: Array) -> dict[str, float | None]:
    """Quantiles with their intervals by order statistics (Conover 1999, sec. 3.2), which are those
    of independent points; of a hypercube or a Sobol sequence they are rather too wide.
    """
    from scipy.stats import quantile_test

    result: dict[str, float | None] = {}
    for share, value in zip(QUANTILES, np.quantile(values, QUANTILES), strict=True):
        name = f"q{round(100 * share):02d}"
        ends: Any = quantile_test(values, p=share).confidence_interval(0.95)
        result[name] = float(value)
        result |= {
            f"{name}_low": finite_or_none(ends.low),
            f"{name}_high": finite_or_none(ends.high),
        }
    return result


# state of a point: name in the summary and in the table, attribute
STATE = {"point": "number", "block": "block", "status": "status", "converged": "converged"}
COUNTS = ("points", "done", "failed", "lost", "missing", "converged")
MOST_NAMED = 10  # points listed in a message
WITHOUT_RESULT = "points without a result"  # in a message of a batch with too many to be listed
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
        yield f"{count} {WITHOUT_RESULT}, as: {message}"


def _messages(results: BatchResults) -> Iterator[str]:
    """Points without a result, and points of which something did not converge."""
    for point in results.points:
        if point.summary is None:
            yield f"point {point.number} ({point.label}): {point.status}: {point.message}"
        elif not point.converged:
            reasons = [
                f": {message}"
                for message in point.summary.get("messages", ())
                if "not converged" in message
                or message.startswith(("equilibrium", "check failed"))
            ]
            yield f"point {point.number} ({point.label}): not converged{''.join(reasons[:1])}"
    outside = [str(point.number) for point in results.points if _is_outside(point)]
    if outside:
        named = ", ".join(outside[:MOST_NAMED]) + (" ..." if len(outside) > MOST_NAMED else "")
        where = "where the nearest place counts"
        yield f"{len(outside)} points with contacts outside their tables, {where}: {named}"


def _is_outside(point: BatchPoint) -> bool:
    """True if contacts of a point lie outside its traction tables."""
    messages = (point.summary or {}).get("messages", ())
    return any(message.startswith(OUTSIDE_TABLE) for message in messages)


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


def batch_table(document: dict[str, Any]) -> Group:
    """The points of a batch, the ends of many, with the results that fit beside the keys.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the batch.

    Returns
    -------
    Group
        The table.
    """
    points = document["points"]
    if points is None:
        counts = document["counts"]
        text = f"{counts['points']} points, {counts['converged']} converged"
        return titled(document["title"], text, *_uncertainties(document))
    given = {key: {str(point["keys"].get(key)) for point in points} for key in document["keys"]}
    keys = [key for key, varied in given.items() if len(varied) > 1]
    shown = [n for n in BATCH_COLUMNS if any(point.get(n) is not None for point in points)]
    free = WIDTH - 10 - sum(max(9, len(_name(key))) + 1 for key in keys)
    shown = shown[-max(1, free // CELL) :]
    headers = ["#", *(f"{_name(key)}\n{_unit(key)}" for key in keys)]
    headers += [f"{MAIN_QUANTITY[name].symbol}\n{_unit(name)}" for name in shown]
    rows = []
    for point in points:
        cells = [number(point["keys"].get(key), ".5g") for key in keys]
        cells += [_result(point.get(name), name) for name in shown]
        rows.append([str(point["point"]), *cells, _flag(point)])
    half = MOST_ROWS // 2
    if len(rows) > MOST_ROWS:
        rows = [*rows[:half], ["..."], *rows[-half:]]
    style: dict[str, Any] = {"padding": (0, 1, 0, 0), "collapse_padding": True}
    table = number_table([*headers, ""], rows, [""], **style)
    for column in table.columns[1 : 1 + len(keys)]:
        column.no_wrap = False
        column.overflow = "fold"
    flags = {_flag(point) for point in points}
    meanings = {"!": "! not converged", "x": "x failed, see the messages"}
    notes = [text for flag, text in meanings.items() if flag in flags]
    return titled(document["title"], table, *notes, *_uncertainties(document))


def _uncertainties(document: dict[str, Any]) -> list[Table]:
    """Sensitivities to each key, and bands over sampled keys, of a few main results, if any."""
    tables = []
    changes = document["sensitivity"]
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
    spread = {n: band for n, band in document["bands"].items() if n in BATCH_COLUMNS}
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
    return [*tables, *_indices(document)]


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


def _flag(point: dict[str, Any]) -> str:
    return "x" if point["status"] != DONE else "" if point["converged"] else "!"

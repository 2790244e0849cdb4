"""Effect of the varied keys: Sobol indices, Morris' elementary effects, sensitivities, bands.

Sensitivities are finite differences of [sensitivity] points, bands those of hypercubes.
"""

import warnings
from collections.abc import Sequence
from math import hypot
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array

from .packed_columns import Columns
from .results import BatchPoint, BatchResults, Design, main_results, point_error

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

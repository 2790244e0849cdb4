"""Effect of uncertain input: finite differences of [sensitivity] points, bands of hypercubes."""

from math import hypot
from typing import Any

import numpy as np

from ehl.arrays import Array

from .columns import Columns
from .indices import finite_or_none, main_values
from .main_results import main_results, point_error
from .results import BatchPoint, BatchResults

QUANTILES = (0.05, 0.5, 0.95)
SAMPLED = ("latin_hypercube", "sample")  # blocks of points drawn at random
MIN_POINTS = 5  # sampled points that bands need


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

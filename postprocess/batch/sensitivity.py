"""What uncertain input does to results: finite differences of [sensitivity] points, bands of
hypercubes.
"""

from math import hypot
from typing import Any

import numpy as np

from ..main_results import main_results
from .points import BatchPoint, BatchResults

QUANTILES = (0.05, 0.5, 0.95)
FEWEST = 5  # sampled points from which bands are told
NOT_TOLD = ("_uncertainty_",)


def sensitivities(results: BatchResults) -> list[dict[str, Any]]:
    """Logarithmic sensitivities d ln(result)/d ln(key) by central differences, O(step^2), about
    the case.

    Parameters
    ----------
    results : BatchResults

    Returns
    -------
    list of dict
        For every key that [sensitivity] varied: `key`, its `value` in the case, the relative
        `step` [-], and under `results` for every main result its `value`, the `sensitivity` [-]
        and whether it is `resolved`: whether the change is larger than the error bars of the two
        films, None for results without one. Empty without such points.
    """
    points = [
        point
        for point in results.points
        if point.block == "sensitivity" and point.summary is not None
    ]
    if not points or any(
        points[0].values[k] != results.points[_first(results)].values[k] for k in results.keys
    ):
        return []
    base = points[0]
    found = []
    reference = main_results(base.summary)
    for key in results.keys:
        pair = [point for point in points[1:] if point.values[key] != base.values[key]]
        if len(pair) == 2:
            low, high = sorted(pair, key=lambda point: point.values[key])
            value = base.values[key]
            step = 0.5 * abs((high.values[key] - low.values[key]) / value)
            rows = _results(reference, low, high, step * (1.0 if value > 0.0 else -1.0))
            found.append({"key": key, "value": value, "step": step, "results": rows})
    return found


def _first(results: BatchResults) -> int:
    """Index of the point that is the case itself: the first of the block."""
    return next(i for i, point in enumerate(results.points) if point.block == "sensitivity")


def _results(
    reference: dict[str, Any], low: BatchPoint, high: BatchPoint, step: float
) -> dict[str, dict[str, Any]]:
    below, above = main_results(low.summary), main_results(high.summary)
    rows = {}
    for name, value in reference.items():
        if (
            not value
            or below.get(name) is None
            or above.get(name) is None
            or any(word in name for word in NOT_TOLD)
        ):
            continue
        change = above[name] - below[name]
        head, _, unit = name.rpartition("_")
        first, second = (row.get(f"{head}_uncertainty_{unit}") for row in (below, above))
        resolved = (
            None
            if first is None or second is None
            else change == 0.0 or abs(change) > hypot(first, second)
        )
        rows[name] = {
            "value": value,
            "sensitivity": change / (2.0 * step * value),
            "resolved": resolved,
        }
    return rows


def bands(results: BatchResults) -> dict[str, dict[str, float]]:
    """Quantiles of the main results over the points of [latin_hypercube]: 5 %, median and 95 %.

    Parameters
    ----------
    results : BatchResults

    Returns
    -------
    dict
        For every main result `points` [-], and in its unit `mean`, `standard_deviation` and the
        quantiles `q05`, `q50`, `q95`; empty with fewer than five points.
    """
    rows = [
        main_results(p.summary)
        for p in results.points
        if p.block == "latin_hypercube" and p.converged
    ]
    found = {}
    for name in dict.fromkeys(name for row in rows for name in row):
        values = [row[name] for row in rows if row.get(name) is not None]
        if len(values) >= FEWEST and not any(word in name for word in NOT_TOLD):
            low, middle, high = np.quantile(values, QUANTILES)
            found[name] = {
                "points": len(values),
                "mean": float(np.mean(values)),
                "standard_deviation": float(np.std(values, ddof=1)),
                "q05": float(low),
                "q50": float(middle),
                "q95": float(high),
            }
    return found

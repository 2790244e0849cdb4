"""Numbers of a batch over a full grid of its keys, as tensor products of cubic splines."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from scipy.interpolate import make_interp_spline

from oilfilm.ehl.arrays import Array

from ..batch.results import BatchPoint, BatchResults, main_results
from ..quantities import is_number

DEGREE = 3  # of the splines; less where an axis has fewer points [-]
MOST_INPUTS = 4
WIDE = 2.0  # largest over least positive value, from which its logarithm is interpolated
STIFFNESS = ("x_N_m", "y_N_m", "z_N_m", "rotation_y_N_m_rad", "rotation_z_N_m_rad")


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """A varied key: its name without the table, its values in ascending order, its spline.

    `logarithmic`: whether the spline is over the logarithm of the values.
    """

    name: str
    values: Array
    logarithmic: bool
    degree: int
    knots: Array

    @property
    def places(self) -> Array:
        """Abscissae of the spline: the values or their logarithms."""
        return np.log(self.values) if self.logarithmic else self.values


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Outputs over a full grid of inputs.

    `coefficients`: of the splines, shape (n_1, ..., n_d, outputs), units as in the names.
    `logarithmic`: of each output, whether the splines are of its logarithm.
    `errors`: of each output, the largest miss of a grid point by splines through the other points
    of its line, over all axes with an inner point; relative for logarithmic outputs, else in their
    unit; None without an inner point.
    """

    axes: tuple[Axis, ...]
    outputs: tuple[str, ...]
    values: Array
    coefficients: Array
    logarithmic: tuple[bool, ...]
    errors: tuple[float | None, ...]


def table_of(results: BatchResults) -> Table:
    """Splines through the numbers that every point of a batch has.

    Parameters
    ----------
    results : BatchResults
        A batch whose points are a full grid of keys with numbers.

    Returns
    -------
    Table
        The table.

    Raises
    ------
    ValueError
        If the points are no full grid, or one of them did not converge.
    """
    points = results.points
    keys = [key for key in results.keys if len({str(p.values.get(key)) for p in points}) > 1]
    wordy = [key for key in keys if not all(is_number(p.values.get(key)) for p in points)]
    if not keys or wordy or len(keys) > MOST_INPUTS:
        raise ValueError(
            f"a table needs 1 to {MOST_INPUTS} keys that vary in numbers; the batch varies "
            f"{', '.join(wordy or keys) or 'none'}"
        )
    places = [sorted({float(p.values[key]) for p in points}) for key in keys]
    grid = {tuple(float(p.values[key]) for key in keys): p for p in points}
    nodes = list(product(*places))
    missing = [node for node in nodes if node not in grid or not grid[node].converged]
    if missing:
        first = ", ".join(f"{key} = {x:g}" for key, x in zip(keys, missing[0], strict=True))
        raise ValueError(
            f"a table needs all points of its grid; {len(missing)} of {len(nodes)} points are "
            f"missing or did not converge, the first at {first}"
        )
    rows = [dict(_numbers(grid[node])) for node in nodes]
    names = tuple(name for name in rows[0] if all(name in row for row in rows))
    shape = (*(len(values) for values in places), len(names))
    values = np.array([[row[name] for name in names] for row in rows]).reshape(shape)
    axes = tuple(_axis(key, np.array(x)) for key, x in zip(keys, places, strict=True))
    logarithmic = np.array([_is_wide(column) for column in values.reshape(-1, len(names)).T])
    smooth = values.copy()
    smooth[..., logarithmic] = np.log(values[..., logarithmic])
    coefficients = smooth
    for axis, one in enumerate(axes):
        coefficients = make_interp_spline(one.places, coefficients, one.degree, axis=axis).c
        coefficients = np.moveaxis(coefficients, 0, axis)
    return Table(
        axes=axes,
        outputs=names,
        values=values,
        coefficients=coefficients,
        logarithmic=tuple(bool(entry) for entry in logarithmic),
        errors=_errors(axes, smooth, logarithmic),
    )


def _axis(key: str, values: Array) -> Axis:
    logarithmic = _is_wide(values)
    degree = min(DEGREE, values.size - 1)
    places = np.log(values) if logarithmic else values
    knots = make_interp_spline(places, places, degree).t
    name = key.rpartition(".")[2]
    return Axis(name=name, values=values, logarithmic=logarithmic, degree=degree, knots=knots)


def _is_wide(values: Array) -> bool:
    """Tell whether logarithms are interpolated: loads, speeds and films are power laws."""
    return bool(values.min() > 0.0 and values.max() > WIDE * values.min())


def _numbers(point: BatchPoint) -> Iterator[tuple[str, float]]:
    """Main results of a point, with temperature and stiffness, by key."""
    summary: dict[str, Any] = point.summary or {}
    heating = summary.get("self_heating") or {}
    matrix = ((summary.get("ring") or {}).get("stiffness") or {}).get("matrix")
    found = {
        **main_results(summary),
        "temperature_C": heating.get("temperature_C"),
        "heat_W": (summary.get("power_balance") or {}).get("heat_W"),
    }
    if matrix:
        found |= {f"stiffness_{name}": matrix[k][k] for k, name in enumerate(STIFFNESS)}
    for name, value in found.items():
        if is_number(value):
            yield name, float(value)


def _errors(axes: tuple[Axis, ...], values: Array, logarithmic: Array) -> tuple[float | None, ...]:
    """Largest misses of grid points by splines without them; of logarithms, relative ones."""
    misses = [
        np.abs(_without(one.places, np.moveaxis(values, axis, 0), k))
        for axis, one in enumerate(axes)
        for k in range(1, one.values.size - 1)
    ]
    if not misses:
        return (None,) * values.shape[-1]
    largest = np.max([m.reshape(-1, values.shape[-1]).max(axis=0) for m in misses], axis=0)
    return tuple(np.where(logarithmic, np.expm1(largest), largest).tolist())


def _without(x: Array, values: Array, k: int) -> Array:
    """Difference of a spline through the other points at point k."""
    rest = np.delete(x, k)
    spline = make_interp_spline(rest, np.delete(values, k, axis=0), min(DEGREE, rest.size - 1))
    return np.asarray(spline(x[k]) - values[k])

"""Measured numbers beside computed ones: residuals and table."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Group
from rich.text import Text

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import unit_symbol, without_unit

from ..files import plain_document
from ..quantities import number, number_table

MOST_ROWS = 30  # in the terminal


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredComparison:
    """Measured quantities and the model in the same states, in the units of the keys."""

    file: str
    source: str  # of the computed numbers
    states: Mapping[str, Array]  # where they were measured
    measured: Mapping[str, Array]  # nan where nothing was measured
    computed: Mapping[str, Array]  # nan where the model gives nothing
    messages: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """The model gives a number wherever one was measured."""
        return all(
            np.isfinite(self.computed[key][np.isfinite(values)]).all()
            for key, values in self.measured.items()
        )

    def residuals(self) -> dict[str, dict[str, Any]]:
        """Computed less measured, by quantity: mean, root of the mean square, largest, and the
        ratio of the sums.
        """
        found: dict[str, dict[str, Any]] = {}
        for key, measured in self.measured.items():
            both = np.isfinite(measured) & np.isfinite(self.computed[key])
            if not both.any():
                found[key] = dict.fromkeys(("mean", "rms", "largest", "ratio"), None)
            else:
                left = self.computed[key][both] - measured[both]
                total = float(measured[both].sum())
                ratio = float(self.computed[key][both].sum()) / total if total else None
                found[key] = {
                    "mean": float(left.mean()),
                    "rms": float(np.sqrt(np.mean(left**2))),
                    "largest": float(left[np.argmax(abs(left))]),
                    "ratio": None if key == "temperature_C" else ratio,
                }
            found[key]["points"] = int(both.sum())
        return found

    @property
    def largest_relative(self) -> float:
        """Largest rms residual of a quantity over the rms of what is measured [-]."""
        found = [0.0]
        for key, one in self.residuals().items():
            size = float(np.sqrt(np.nanmean(self.measured[key] ** 2)))
            if one["rms"] is not None and size > 0.0:
                found.append(one["rms"] / size)
        return max(found)

    def rows(self) -> list[dict[str, Any]]:
        """State, measured and computed values and residuals, row by row."""
        found = []
        for index in range(next(iter(self.measured.values())).size):
            row: dict[str, Any] = {key: values[index] for key, values in self.states.items()}
            for key, values in self.measured.items():
                pair = {"measured": values[index], "computed": self.computed[key][index]}
                row[key] = pair | {"residual": pair["computed"] - pair["measured"]}
            found.append(row)
        return found

    def document(self) -> dict[str, Any]:
        """The comparison as plain JSON types, null for what is not there."""
        document = {
            "kind": "measured",
            "file": self.file,
            "source": self.source,
            "converged": self.converged,
            "residuals": self.residuals(),
            "rows": self.rows(),
            "messages": list(self.messages),
        }
        found: dict[str, Any] = plain_document(_without_nan(document))
        return found


def _without_nan(value: Any) -> Any:
    """A document with None for what is no number."""
    if isinstance(value, dict):
        return {key: _without_nan(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_without_nan(part) for part in value]
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value


def measured_table(comparison: MeasuredComparison) -> Group:
    """Rows of measured and computed values, and their residuals, for a terminal.

    Parameters
    ----------
    comparison : MeasuredComparison
        The comparison.

    Returns
    -------
    Group
        The tables.
    """
    document = comparison.document()
    states = list(comparison.states)
    keys = list(comparison.measured)
    heads = [_head(key) for key in states]
    heads += [f"{_head(key)}\n{word}" for key in keys for word in ("measured", "computed")]
    rows = [
        [
            *(number(row[key], ".5g") for key in states),
            *(number(row[key][word], ".4g") for key in keys for word in ("measured", "computed")),
        ]
        for row in document["rows"]
    ]
    parts: list[Any] = [
        Text(f"measured: {comparison.file}"),
        Text(f"computed: {comparison.source}"),
        number_table(heads, rows[:MOST_ROWS], []),
    ]
    if len(rows) > MOST_ROWS:
        parts.append(Text(f"the first {MOST_ROWS} of {len(rows)} rows; all with --json"))
    parts += [Text(line) for line in residual_lines(document["residuals"])]
    return Group(*parts)


def residual_lines(residuals: Mapping[str, Any]) -> list[str]:
    """Residuals in words, a line for each quantity.

    Parameters
    ----------
    residuals : Mapping[str, Any]
        As `MeasuredComparison.residuals` gives them.

    Returns
    -------
    list[str]
        The lines.
    """
    lines = []
    for key, found in residuals.items():
        if found["mean"] is None:
            lines.append(f"{_title(key)}: nothing computed")
            continue
        ratio = "" if found["ratio"] is None else f", ratio of the sums {found['ratio']:.3g}"
        lines.append(
            f"{_title(key)}: computed less measured {found['mean']:+.3g} in the mean, rms "
            f"{found['rms']:.3g}, largest {found['largest']:+.3g}{ratio} ({found['points']} points"
            ")"
        )
    return lines


def _head(key: str) -> str:
    """Words and unit of a key, each on a line, so that narrow terminals have them whole."""
    return "\n".join([*without_unit(key).split(), unit_symbol(key)])


def _title(key: str) -> str:
    return f"{without_unit(key)} {unit_symbol(key)}".strip()

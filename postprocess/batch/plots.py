"""Figures of a batch: film, pressure and torque over one or two of the varied keys."""

from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehl.solution import Array
from ehl.units import unit_of, without_unit

from ..bearing.plots_torque import LABELS
from ..main_results import main_results
from ..plot_style import INK, PAGE_WIDTH, RC, REFERENCE, save
from .results import BatchPoint, BatchResults
from .summary import scalar_numbers

BATCH_PLOT = "over_keys.png"
QUANTITIES = {
    "film_minimum_um": "minimum film",
    "film_minimum_dimensionless": "minimum film",
    "torque_N_mm": "torque",
    "hertz_pressure_maximum_GPa": "largest Hertz pressure",
    "hertz_pressure_GPa": "Hertz pressure",
    "cage_speed_ratio": "cage over kinematic speed",
    "slip_factor_minimum": "smallest slip factor",
    "minimum_preload_N": "minimum preload",
    "inner_largest_coefficient": "largest coefficient, inner race",
    "outer_largest_coefficient": "largest coefficient, outer race",
}
MODELS = "torque_N_mm.models."
PARTS = {
    "total": "sum",
    "ME": "$M_E$ hysteresis",
    "MD": "$M_D$ differential sliding",
    "MS": "$M_S$ spin",
    "MC": "$M_C$ cage",
    "ML": "$M_L$ oil",
}  # of a model, where the name of the number is no word
LINES = ("#1b1f24", "#b23a3a", "#4c78a8", "#d67b1f", "#5a8f5a", "#8c6bb1", "#79b7c9", "#a65e7d")
STYLES = ("-", "--", "-.", ":")
MARKERS = "osD^vP*X"
MOST_PANELS = 3  # the second: of one quantity
MOST_TOGETHER = 4  # side by side
WORD_WIDTH = 16  # characters of a tick label
MOST_LINES = 8  # of a family; more values are told by colour
MOST_INSIDE = 4  # lines of a family named inside the panel; more are beside it


@dataclass(frozen=True, slots=True, kw_only=True)
class Varied:
    """A key that varies: its label, its number at every point, and the words that these stand for
    if it has words.
    """

    label: str
    values: tuple[float | None, ...]
    words: tuple[str, ...] = ()

    def text(self, value: float) -> str:
        """A value in words."""
        return self.words[int(value)] if self.words else f"{value:g}"


def varied_keys(results: BatchResults) -> list[Varied]:
    """Keys with at least two different numbers, the one with most of them first; all keys of words
    as one, last.
    """
    numbers, wordy = [], []
    for key in results.keys:
        values = [point.values.get(key) for point in results.points]
        different = {str(value) for value in values if value is not None}
        if len(different) > 1 and all(value is None or _is_number(value) for value in values):
            numbers.append((len(different), Varied(label=axis_label(key), values=tuple(values))))
        elif len(different) > 1:
            wordy.append(key)
    found = [varied for _, varied in sorted(numbers, key=lambda item: -item[0])]
    found = found[:1] + [varied for varied in found[1:] if not _goes_along(found[0], varied)]
    return found + ([_words(results, wordy)] if wordy else [])


def _one_family(keys: list[Varied]) -> list[Varied]:
    """The keys after the first as one, if several and with no more combinations than lines fit a
    panel.
    """
    rows = list(zip(*(key.values for key in keys[1:]), strict=True))
    if (
        len(keys) < 3
        or any(value is None for row in rows for value in row)
        or len(set(rows)) > MOST_LINES
    ):
        return keys
    known = sorted(set(rows))
    words = tuple(
        " / ".join(key.text(v) for key, v in zip(keys[1:], row, strict=True)) for row in known
    )
    values = tuple(float(known.index(row)) for row in rows)
    return [
        keys[0],
        Varied(label=" / ".join(key.label for key in keys[1:]), values=values, words=words),
    ]


def _goes_along(first: Varied, other: Varied) -> bool:
    """Whether another key rises or falls strictly with the first one, as the sizes of a bearing
    do.
    """
    pairs = sorted(
        {
            (a, b)
            for a, b in zip(first.values, other.values, strict=True)
            if a is not None and b is not None
        }
    )
    if len(pairs) < MOST_PANELS or len({a for a, _ in pairs}) < len(pairs):
        return False
    steps = np.diff([b for _, b in pairs])
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _numbers(point: BatchPoint) -> dict[str, Any]:
    """Every single number of a point by the name that it has in the table of the batch."""
    return scalar_numbers(point.summary or {}) | main_results(point.summary)


def _words(results: BatchResults, keys: list[str]) -> Varied:
    """Keys of words as one, numbered in the order in which their combinations appear."""
    texts = [" / ".join(str(point.values.get(key)) for key in keys) for point in results.points]
    words = tuple(dict.fromkeys(texts))
    values = tuple(float(words.index(text)) for text in texts)
    return Varied(label=" / ".join(map(axis_label, keys)), values=values, words=words)


def write_batch_plots(results: BatchResults, directory: Path) -> tuple[str, ...]:
    """Draw the figure of a batch into its folder `plots`; what could not be drawn, and why."""
    keys, shown = varied_keys(results), quantities(results)
    if not keys or not shown:
        return (
            f"plots/{BATCH_PLOT} not written: no {'key with several values' if shown else 'result'} to draw",
        )
    with matplotlib.rc_context(RC):
        figure = Figure()
        if results.plot and len(shown) > 1 and len({unit_of(name) for name in shown}) == 1:
            draw_together(figure, results, keys, shown)
        else:
            draw_batch(figure, results, keys, shown)
        save(figure, directory / "plots" / BATCH_PLOT)
    return tuple(
        f"plots/{BATCH_PLOT}: no {name} to draw" for name in results.plot if name not in shown
    )


def quantities(results: BatchResults) -> list[str]:
    """Numbers that the sweep file wants drawn and some point has; else as many main results, not
    all zero, as fit.
    """
    if results.plot:
        every = [_numbers(point) for point in results.points]
        return [name for name in results.plot if any(row.get(name) is not None for row in every)]
    rows = [main_results(point.summary) for point in results.points]
    return [name for name in QUANTITIES if any(row.get(name) for row in rows)][:MOST_PANELS]


def draw_batch(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """A panel for each quantity over the first key; the second key as a family of lines, or as
    colour.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    results : BatchResults
    keys : list of Varied
        As `varied_keys` orders them.
    shown : list of str
        Quantities, units [um], [GPa], [N mm] as their names say.
    """
    keys = _one_family(keys)
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    figure.suptitle(results.title, fontsize=8.5)
    panels: Any = figure.subplots(1, len(shown), squeeze=False)[0]
    mapped = None
    for axes, name in zip(panels, shown, strict=True):
        x, colour, y, error, sound = _data(results, keys, name)
        if len(keys) == 1:
            _line(
                axes, x, y, error, sound, {"color": INK, "linestyle": "" if keys[0].words else "-"}
            )
        elif len(np.unique(colour)) <= MOST_LINES:
            _family(axes, (x, colour, y, error, sound), keys[1], legend=axes is panels[0])
        else:
            mapped = axes.scatter(x[sound], y[sound], c=colour[sound], s=14)
            axes.scatter(x[~sound], y[~sound], c=colour[~sound], s=18, marker="x")
        _first_key(axes, keys[0])
        axes.set_ylabel(f"{quantity_label(name)} [{quantity_unit(name)}]")
        axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])
    if mapped is not None:
        figure.colorbar(mapped, ax=panels, label=keys[1].label)
    notes = (
        ["error bars: uncertainty of the film"]
        if shown[0].startswith("film") and mapped is None
        else []
    )
    _note(figure, results, keys, notes)


def draw_together(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """Numbers of one unit as lines over the first key; a panel for each value of the second one,
    if there is one.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    results : BatchResults
    keys : list of Varied
        As `varied_keys` orders them.
    shown : list of str
        Names of numbers, units as they say.
    """
    values = (
        _some(np.unique([v for v in keys[1].values if v is not None]))
        if len(keys) > 1
        else np.zeros(1)
    )
    least = np.inf
    figure.set_size_inches(PAGE_WIDTH, 3.0)
    figure.suptitle(results.title, fontsize=8.5)
    panels: Any = figure.subplots(1, len(values), squeeze=False, sharey=True)[0]
    model = common_model(shown)
    for axes, value in zip(panels, values, strict=True):
        for k, name in enumerate(shown):
            x, second, y, _, sound = _data(results, keys, name)
            part = second == value
            style = {"color": LINES[k], "marker": MARKERS[k], "label": quantity_label(name, model)}
            style["linestyle"] = "" if keys[0].words else STYLES[k % len(STYLES)]
            _line(axes, x[part], y[part], np.zeros(part.sum()), sound[part], style)
            least = min(least, np.min(y[part], initial=np.inf))
        if len(keys) > 1:
            head, _, unit = keys[1].label.partition(" [")
            axes.set_title(f"{head} {keys[1].text(value)} {unit.rstrip(']')}".strip())
        _first_key(axes, keys[0])
        if not keys[0].words:
            axes.locator_params(axis="x", nbins=9 // len(values) + 2)
    top = panels[0].get_ylim()[1]
    panels[0].set_ylim(
        1.1 * min(least, 0.0) - (0.02 * top if least < 0.01 * top else 0.0), 1.05 * top
    )
    words = f"{LABELS[model]}: torque" if model else _common_words(shown)
    panels[0].set_ylabel(f"{words} [{quantity_unit(shown[0])}]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=min(len(labels), 4), loc="outside lower center")
    if len(keys) > 1 and len(values) < len(set(keys[1].values)):
        _note(
            figure,
            results,
            keys,
            [f"{len(values)} of {len(set(keys[1].values))} values of {keys[1].label}"],
        )
    else:
        _note(figure, results, keys, [])


def _some(values: Array) -> Array:
    """At most as many values as a figure has panels, the first and the last among them."""
    return np.asarray(
        values[
            np.unique(
                np.linspace(0, len(values) - 1, min(len(values), MOST_TOGETHER))
                .round()
                .astype(int)
            )
        ]
    )


def _note(figure: Figure, results: BatchResults, keys: list[Varied], notes: list[str]) -> None:
    """What a figure does not show by itself, below it."""
    notes = notes + (["crosses: not converged"] if not results.converged else [])
    notes += (
        [f"further keys vary: {', '.join(key.label for key in keys[2:5])}"]
        if 2 < len(keys) <= 5
        else []
    )
    notes += [f"{len(keys) - 2} further keys vary"] if len(keys) > 5 else []
    figure.supxlabel("; ".join(notes), fontsize=6.5, color=REFERENCE)


def _first_key(axes: Axes, key: Varied) -> None:
    """Name of a key along the axis, its words as ticks, and a grid."""
    axes.set_xlabel(key.label)
    axes.grid(linewidth=0.3, alpha=0.5)
    if key.words:
        words = [
            "\n".join(fill(part, WORD_WIDTH) for part in word.split(" / ")) for word in key.words
        ]
        axes.set_xticks(range(len(words)), words, fontsize=6.5)


def quantity_label(name: str, model: str | None = None) -> str:
    """A number in words; of a torque its model and part, the part alone where all numbers are of
    one `model`.
    """
    if name.startswith(MODELS):
        own, part = name.removeprefix(MODELS).split(".")
        words = PARTS.get(part, part)
        return words if own == model else LABELS[own] + ("" if part == "total" else f", {words}")
    return QUANTITIES.get(name) or without_unit(name.rpartition(".")[2])


def common_model(names: list[str]) -> str | None:
    """The torque model that all numbers are of, if there is one."""
    models = {
        name.removeprefix(MODELS).split(".")[0] if name.startswith(MODELS) else None
        for name in names
    }
    return models.pop() if len(models) == 1 else None


def _common_words(names: list[str]) -> str:
    """What numbers of one unit are, in words."""
    return (
        "torque"
        if all("torque_N_mm" in name for name in names)
        else "film"
        if names[0].startswith("film")
        else "value"
    )


def axis_label(key: str) -> str:
    """A key in words, its unit in brackets."""
    last = key.rpartition(".")[2]
    unit = unit_of(last).replace("um", "µm").replace("degC", "°C")
    return f"{without_unit(last)} [{unit}]" if unit else without_unit(last)


def quantity_unit(name: str) -> str:
    """Unit of a quantity for a label."""
    if name.endswith("_dimensionless"):
        return "a²/Rx"
    return unit_of(name).replace("um", "µm").replace("degC", "°C") or "-"


def _data(
    results: BatchResults, keys: list[Varied], name: str
) -> tuple[Array, Array, Array, Array, Any]:
    """First key, second key, quantity, its uncertainty, whether it converged, of the points that
    have all of them.
    """
    head, _, unit = name.rpartition("_")
    rows = []
    seconds = keys[1].values if len(keys) > 1 else [0.0] * len(results.points)
    for point, first, second in zip(results.points, keys[0].values, seconds, strict=True):
        row = _numbers(point)
        if row.get(name) is not None and first is not None and second is not None:
            rows.append(
                (
                    first,
                    second,
                    row[name],
                    row.get(f"{head}_uncertainty_{unit}") or 0.0,
                    point.converged,
                )
            )
    x, colour, y, error, sound = (np.array(column) for column in zip(*rows, strict=True))
    return x, colour, y, error, sound.astype(bool)


def _family(
    axes: Axes, data: tuple[Array, Array, Array, Array, Any], key: Varied, *, legend: bool
) -> None:
    x, colour, y, error, sound = data
    values = np.unique(colour)
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    for value, shade in zip(values, colours, strict=True):
        part = colour == value
        _line(
            axes,
            x[part],
            y[part],
            error[part],
            sound[part],
            {"color": shade, "label": key.text(value)},
        )
    if legend and len(values) > MOST_INSIDE:
        figure = axes.get_figure()
        assert figure is not None
        handles, labels = axes.get_legend_handles_labels()
        title = key.label.replace(" / ", " /\n")
        figure.legend(handles, labels, title=title, title_fontsize=7, loc="outside right center")
    elif legend:  # once is enough
        axes.legend(title=key.label, title_fontsize=7, ncols=1 if key.words else 2)


def _line(axes: Axes, x: Array, y: Array, error: Array, sound: Any, style: dict[str, Any]) -> None:
    """One curve in the order of the key, with error bars; crosses where it did not converge."""
    order = np.argsort(x, kind="stable")
    if len(np.unique(x)) < len(x):
        style = style | {"linestyle": ""}
    bars = error[order] if error.any() else None
    fixed: dict[str, Any] = {"marker": "o", "markersize": 3, "capsize": 2, "linewidth": 1.0}
    axes.errorbar(x[order], y[order], bars, **fixed | style)
    if not sound.all():
        axes.plot(x[~sound], y[~sound], "x", markersize=7, color=style["color"])


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)

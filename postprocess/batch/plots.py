"""Figures of a batch: film, pressure and torque over one or two of the varied keys."""

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ehl.solution import Array
from ehl.units import unit_of, unit_symbol, without_unit

from ..bearing.quantities import TORQUE_MODELS, TORQUE_PARTS
from ..main_results import BATCH_PANELS, MAIN_QUANTITY
from ..plot_style import INK, PAGE_WIDTH, REFERENCE, write_figure
from ..text import evenly_chosen, is_number
from .results import BatchResults
from .summary import point_numbers

BATCH_PLOT = "over_keys.png"
MODELS = "torque_N_mm.models."
LINES = ("#1b1f24", "#b23a3a", "#4c78a8", "#d67b1f", "#5a8f5a", "#8c6bb1", "#79b7c9", "#a65e7d")
STYLES = ("-", "--", "-.", ":")
MARKERS = "osD^vP*X"
MOST_PANELS = 3  # the second: of one quantity
MOST_TOGETHER = 4  # side by side
WORD_WIDTH = 16  # characters of a tick label
MOST_LINES = 8  # of a family; more values are shown by colour
MOST_INSIDE = 4  # lines of a family named inside the panel; more are beside it


@dataclass(frozen=True, slots=True, kw_only=True)
class Varied:
    """A key that varies: its label, its number at every point, and what the numbers stand for."""

    label: str
    values: tuple[float | None, ...]
    words: tuple[str, ...] = ()

    def text(self, value: float) -> str:
        """A value in words."""
        return self.words[int(value)] if self.words else f"{value:g}"


def varied_keys(results: BatchResults) -> list[Varied]:
    """Keys of at least two numbers, most of them first; keys of words as one, last."""
    numbers: list[Varied] = []
    wordy = []
    for key in results.keys:
        values = tuple(point.values.get(key) for point in results.points)
        if len({str(value) for value in values if value is not None}) < 2:
            continue
        if all(value is None or is_number(value) for value in values):
            numbers.append(Varied(label=axis_label(key), values=values))
        else:
            wordy.append(key)
    numbers.sort(key=lambda key: -len({*key.values} - {None}))
    numbers = numbers[:1] + [key for key in numbers[1:] if not _goes_along(numbers[0], key)]
    return numbers + ([_words(results, wordy)] if wordy else [])


def _one_family(keys: list[Varied]) -> list[Varied]:
    """The keys after the first as one, if no more combinations than lines fit a panel."""
    rows = list(zip(*(key.values for key in keys[1:]), strict=True))
    incomplete = any(value is None for row in rows for value in row)
    if len(keys) < 3 or incomplete or len(set(rows)) > MOST_LINES:
        return keys
    known = sorted(set(rows))
    words = tuple(
        " / ".join(key.text(v) for key, v in zip(keys[1:], row, strict=True)) for row in known
    )
    values = tuple(float(known.index(row)) for row in rows)
    label = " / ".join(key.label for key in keys[1:])
    return [keys[0], Varied(label=label, values=values, words=words)]


def _goes_along(first: Varied, other: Varied) -> bool:
    """Whether another key rises or falls strictly with the first one, as sizes of a bearing do."""
    both = zip(first.values, other.values, strict=True)
    pairs = sorted({(a, b) for a, b in both if a is not None and b is not None})
    if len(pairs) < MOST_PANELS or len({a for a, _ in pairs}) < len(pairs):
        return False
    steps = np.diff([b for _, b in pairs])
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _words(results: BatchResults, keys: list[str]) -> Varied:
    """Keys of words as one, numbered in the order in which their combinations appear."""
    texts = [" / ".join(str(point.values.get(key)) for key in keys) for point in results.points]
    words = tuple(dict.fromkeys(texts))
    values = tuple(float(words.index(text)) for text in texts)
    return Varied(label=" / ".join(map(axis_label, keys)), values=values, words=words)


def write_batch_plots(results: BatchResults, directory: Path) -> tuple[str, ...]:
    """Draw the figure of a batch into its folder `plots`; what could not be drawn, and why."""
    keys = varied_keys(results)
    shown = quantities(results)
    if not keys or not shown:
        missing = "key with several values" if shown else "result"
        return (f"plots/{BATCH_PLOT} not written: no {missing} to draw",)
    one_unit = len({unit_of(name) for name in shown}) == 1
    draw = draw_together if results.plot and len(shown) > 1 and one_unit else draw_batch
    path = directory / "plots" / BATCH_PLOT
    write_figure(path, partial(draw, results=results, keys=keys, shown=shown))
    return tuple(
        f"plots/{BATCH_PLOT}: no {name} to draw" for name in results.plot if name not in shown
    )


def quantities(results: BatchResults) -> list[str]:
    """Numbers that the sweep file wants drawn; else as many main results, not all zero, as fit."""
    rows = [point_numbers(point) for point in results.points]
    if results.plot:
        return [name for name in results.plot if any(row.get(name) is not None for row in rows)]
    return [name for name in BATCH_PANELS if any(row.get(name) for row in rows)][:MOST_PANELS]


def draw_batch(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """A panel for each quantity over the first key; the second as a family of lines, or as colour.

    Keys as `varied_keys` orders them; units [um], [GPa], [N mm] as the names of the numbers say.
    """
    keys = _one_family(keys)
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    figure.suptitle(results.title, fontsize=8.5)
    panels: Any = figure.subplots(1, len(shown), squeeze=False)[0]
    mapped = None
    for axes, name in zip(panels, shown, strict=True):
        data = _data(results, keys, name)
        if len(keys) == 1:
            _line(axes, data, data.error, color=INK, linestyle="" if keys[0].words else "-")
        elif len(np.unique(data.second)) <= MOST_LINES:
            _family(axes, data, keys[1], legend=axes is panels[0])
        else:
            converged = data[data.converged]
            failed = data[~data.converged]
            mapped = axes.scatter(converged.x, converged.y, c=converged.second, s=14)
            axes.scatter(failed.x, failed.y, c=failed.second, s=18, marker="x")
        _first_key(axes, keys[0])
        axes.set_ylabel(f"{quantity_label(name)} [{quantity_unit(name)}]")
        axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])
    if mapped is not None:
        figure.colorbar(mapped, ax=panels, label=keys[1].label)
    bars = shown[0].startswith("film") and mapped is None
    _note(figure, results, keys, ["error bars: uncertainty of the film"] if bars else [])


def draw_together(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """Numbers of one unit as lines over the first key, a panel for each value of the second one.

    Keys as `varied_keys` orders them; units [N mm] ... as the names of the numbers say.
    """
    values = np.zeros(1)
    if len(keys) > 1:
        values = np.unique([v for v in keys[1].values if v is not None])
        values = values[evenly_chosen(len(values), MOST_TOGETHER)]
    figure.set_size_inches(PAGE_WIDTH, 3.0)
    figure.suptitle(results.title, fontsize=8.5)
    panels: Any = figure.subplots(1, len(values), squeeze=False, sharey=True)[0]
    model = common_model(shown)
    least = np.inf
    for axes, value in zip(panels, values, strict=True):
        for k, name in enumerate(shown):
            data = _data(results, keys, name)
            data = data[data.second == value]
            style = {"color": LINES[k], "marker": MARKERS[k], "label": quantity_label(name, model)}
            style["linestyle"] = "" if keys[0].words else STYLES[k % len(STYLES)]
            _line(axes, data, np.zeros(data.size), **style)
            least = min(least, np.min(data.y, initial=np.inf))
        if len(keys) > 1:
            head, _, unit = keys[1].label.partition(" [")
            axes.set_title(f"{head} {keys[1].text(value)} {unit.rstrip(']')}".strip())
        _first_key(axes, keys[0])
        if not keys[0].words:
            axes.locator_params(axis="x", nbins=9 // len(values) + 2)
    # from zero or, where values are negative, from below the least one
    top = panels[0].get_ylim()[1]
    margin = 0.02 * top if least < 0.01 * top else 0.0
    panels[0].set_ylim(1.1 * min(least, 0.0) - margin, 1.05 * top)
    film = "film" if shown[0].startswith("film") else "value"
    quantity = "torque" if all("torque_N_mm" in name for name in shown) else film
    quantity = f"{TORQUE_MODELS[model].title}: torque" if model else quantity
    panels[0].set_ylabel(f"{quantity} [{quantity_unit(shown[0])}]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=min(len(labels), 4), loc="outside lower center")
    every = len(set(keys[1].values)) if len(keys) > 1 else 0
    left_out = len(values) < every
    note = [f"{len(values)} of {every} values of {keys[1].label}"] if left_out else []
    _note(figure, results, keys, note)


def _note(figure: Figure, results: BatchResults, keys: list[Varied], notes: list[str]) -> None:
    """What a figure does not show by itself, below it."""
    notes = notes + ["crosses: not converged"] * (not results.converged)
    if 2 < len(keys) <= 5:
        notes.append(f"further keys vary: {', '.join(key.label for key in keys[2:])}")
    if len(keys) > 5:
        notes.append(f"{len(keys) - 2} further keys vary")
    figure.supxlabel("; ".join(notes), fontsize=6.5, color=REFERENCE)


def _first_key(axes: Axes, key: Varied) -> None:
    """Name of a key along the axis, its words as ticks, and a grid."""
    axes.set_xlabel(key.label)
    axes.grid(linewidth=0.3, alpha=0.5)
    if key.words:
        parts = [[fill(part, WORD_WIDTH) for part in word.split(" / ")] for word in key.words]
        axes.set_xticks(range(len(parts)), ["\n".join(lines) for lines in parts], fontsize=6.5)


def quantity_label(name: str, model: str | None = None) -> str:
    """A number in words; of a torque its model and part, without the `model` of all numbers."""
    if name.startswith(MODELS):
        own, part = name.removeprefix(MODELS).split(".")
        part_title = TORQUE_PARTS.get(part, part)
        if own == model:
            return part_title
        return TORQUE_MODELS[own].title + ("" if part == "total" else f", {part_title}")
    main = MAIN_QUANTITY.get(name)
    return without_unit(name.rpartition(".")[2]) if main is None else main.title


def common_model(names: list[str]) -> str | None:
    """The torque model that all numbers are of, if there is one."""
    models = {name.removeprefix(MODELS).split(".")[0] for name in names}
    of_models = all(name.startswith(MODELS) for name in names)
    return models.pop() if of_models and len(models) == 1 else None


def axis_label(key: str) -> str:
    """A key in words, its unit in brackets."""
    last = key.rpartition(".")[2]
    return f"{without_unit(last)} [{unit_symbol(last)}]" if unit_of(last) else without_unit(last)


def quantity_unit(name: str) -> str:
    """Unit of a quantity for a label."""
    return "a²/Rx" if name.endswith("_dimensionless") else unit_symbol(name) or "-"


def _data(results: BatchResults, keys: list[Varied], name: str) -> Any:
    """Points that have all of it: keys `x`, `second`, quantity `y`, its `error`, `converged`.

    As a record array, in the units of the keys; a second key that is not there is 0.
    """
    head, _, unit = name.rpartition("_")
    rows: list[Any] = []
    seconds = keys[1].values if len(keys) > 1 else [0.0] * len(results.points)
    for point, first, second in zip(results.points, keys[0].values, seconds, strict=True):
        row = point_numbers(point)
        if row.get(name) is not None and first is not None and second is not None:
            error = row.get(f"{head}_uncertainty_{unit}") or 0.0
            rows.append((first, second, row[name], error, point.converged))
    return np.rec.fromrecords(rows, formats=None, names="x,second,y,error,converged")


def _family(axes: Axes, data: Any, key: Varied, *, legend: bool) -> None:
    values = np.unique(data.second)
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    for value, shade in zip(values, colours, strict=True):
        part = data[data.second == value]
        _line(axes, part, part.error, color=shade, label=key.text(value))
    if legend and len(values) > MOST_INSIDE:
        handles, labels = axes.get_legend_handles_labels()
        style: Any = {"title_fontsize": 7, "loc": "outside right center"}
        figure: Any = axes.get_figure()
        figure.legend(handles, labels, title=key.label.replace(" / ", " /\n"), **style)
    elif legend:  # once is enough
        axes.legend(title=key.label, title_fontsize=7, ncols=1 if key.words else 2)


def _line(axes: Axes, data: Any, error: Array, **style: Any) -> None:
    """One curve in the order of the key, with error bars; crosses where it did not converge."""
    order = np.argsort(data.x, kind="stable")
    if len(np.unique(data.x)) < len(data.x):
        style["linestyle"] = ""
    bars = error[order] if error.any() else None
    fixed: dict[str, Any] = {"marker": "o", "markersize": 3, "capsize": 2, "linewidth": 1.0}
    axes.errorbar(data.x[order], data.y[order], bars, **fixed | style)
    failed = data[~data.converged]
    if failed.size:
        axes.plot(failed.x, failed.y, "x", markersize=7, color=style["color"])

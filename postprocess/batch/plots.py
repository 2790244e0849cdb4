"""Figures of a batch: main results over one to three varied keys, the front of an optimisation."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import unit_of, unit_symbol, without_unit

from ..bearing.bearing_quantities import TORQUE_PARTS, torque_model
from ..plot_style import INK, REFERENCE, titled_panels, write_figure
from ..quantities import evenly_chosen
from .results import (
    BATCH_PANELS,
    MAIN_QUANTITY,
    BatchResults,
    Varied,
    are_distinguishable,
    families,
    varied_keys,
)
from .summary import point_numbers

BATCH_PLOT = "over_keys.png"
MODELS = "torque_N_mm.models."
LINES = ("#1b1f24", "#b23a3a", "#4c78a8", "#d67b1f", "#5a8f5a", "#8c6bb1", "#79b7c9", "#a65e7d")
STYLES = ("-", "--", "-.", ":")
MARKERS = "osD^vP*X"
MOST_PANELS = 3  # the second: of one quantity
MOST_TOGETHER = 4  # side by side
WORD_WIDTH = 16  # characters of a tick label
MOST_INSIDE = 4  # lines of a family named inside the panel; more are beside it
MANY_TIMES = 10.0  # largest over smallest value from which on an axis is logarithmic [-]
LARGE = 1e6  # from which on a logarithmic axis has powers of ten
LOGARITHMIC = ("film_", "rating")  # in the names of what may have a logarithmic axis
FRONT = "#b23a3a"


def write_batch_plots(results: BatchResults, directory: Path) -> tuple[str, ...]:
    """Draw the figure of a batch into its folder `plots`.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    directory : Path
        Folder of the batch.

    Returns
    -------
    tuple[str, ...]
        What could not be drawn, and why.
    """
    keys = list(varied_keys(results).values())
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


def write_diagram(
    results: BatchResults, path: Path, over: tuple[str, ...] = (), numbers: tuple[str, ...] = ()
) -> Path:
    """Draw numbers of a batch over keys of one's choice, as `draw_batch`, into a PNG, PDF or SVG.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.
    path : Path
        File that ends in .png, .pdf or .svg.
    over : tuple[str, ...], default ()
        Keys that come first: along the axis, by colour, by style; the last part of a key names it,
        too.
    numbers : tuple[str, ...], default ()
        Names of the numbers to draw; main results if empty.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        For a key that does not vary, or a number that no point has.
    """
    keys = varied_keys(results)
    chosen = [_one_named(name, keys, "varied key") for name in over]
    available = quantities(results)
    if numbers:
        every = dict.fromkeys(name for p in results.points for name in point_numbers(p))
        available = [_one_named(name, every, "number") for name in numbers]
    if not keys or not available:
        raise ValueError("there is nothing to draw: no key varies, or no point has a result")
    order = [keys[name] for name in (*chosen, *(name for name in keys if name not in chosen))]
    write_figure(path, partial(draw_batch, results=results, keys=order, shown=available))
    return path


def _one_named(name: str, available: Iterable[str], kind: str) -> str:
    """The one of the known names that is meant; ValueError if there is none, or several."""
    names = list(available)
    meant = [own for own in names if own == name] or [
        own for own in names if own.endswith(f".{name}")
    ]
    if len(meant) == 1:
        return meant[0]
    close = get_close_matches(name, names, n=1, cutoff=0.3)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    result = "several have this name" if meant else f"there is no {kind} of this name"
    raise ValueError(f"{name}: {result}{hint}")


def quantities(results: BatchResults) -> list[str]:
    """Numbers that the sweep file wants drawn; else as many main results, not all zero, as fit.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    list[str]
        Names of the numbers.
    """
    rows = [point_numbers(point) for point in results.points]
    if results.plot:
        return [name for name in results.plot if any(row.get(name) is not None for row in rows)]
    return [name for name in BATCH_PANELS if any(row.get(name) for row in rows)][:MOST_PANELS]


def draw_batch(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """A panel for each quantity over the first key; the second as colours, the third as styles.

    Where lines are too many, points have colours by the second. Keys as `varied_keys` orders
    them; units [um], [GPa], [N mm] as the names of the numbers say.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BatchResults
        Results of the batch.
    keys : list[Varied]
        Varied keys in the order of `varied_keys`.
    shown : list[str]
        Names of the numbers to draw.
    """
    every = keys
    keys = families(keys)
    panels: Any = titled_panels(figure, results.title, 2.9, 1, len(shown), squeeze=False)[0]
    mapped = None
    for axes, name in zip(panels, shown, strict=True):
        data = _data(results, keys, name)
        if len(keys) == 1:
            _line(axes, data, data.error, color=INK, linestyle="" if keys[0].words else "-")
        elif are_distinguishable(keys):
            _family(axes, data, keys)
        else:
            converged = data[data.converged]
            failed = data[~data.converged]
            mapped = axes.scatter(converged.x, converged.y, c=converged.second, s=14)
            axes.scatter(failed.x, failed.y, c=failed.second, s=18, marker="x")
        _first_key(axes, keys[0])
        axes.set_ylabel(f"{quantity_label(name)} [{quantity_unit(name)}]")
        _values_axis(axes, name, data)
    if mapped is not None:
        figure.colorbar(mapped, ax=panels, label=keys[1].label)
    elif len(keys) > 1:
        _family_legend(figure, panels[0], keys)
    bars = shown[0].startswith("film") and mapped is None
    distinguished = len(keys) if len(keys) < len(every) or mapped is None else 2
    hidden = [] if len(keys) < len(every) else every[distinguished:]
    _note(figure, results, hidden, ["error bars: uncertainty of the film"] if bars else [])


def _values_axis(axes: Axes, name: str, data: Any) -> None:
    """From zero, or logarithmic where films or lives differ by many times."""
    available = data.y[data.y > 0.0]
    spread = available.max() / available.min() if available.size == data.size > 0 else 1.0
    if spread > MANY_TIMES and any(word in name for word in LOGARITHMIC):
        axes.set_yscale("log")
        axes.set_ylim(0.7 * available.min(), 1.4 * available.max())
        if available.max() < LARGE:
            axes.yaxis.set_major_formatter("{x:g}")
    else:
        axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])


def draw_together(
    figure: Figure, results: BatchResults, keys: list[Varied], shown: list[str]
) -> None:
    """Numbers of one unit as lines over the first key, a panel for each value of the second one.

    Keys as `varied_keys` orders them; units [N mm] ... as the names of the numbers say.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BatchResults
        Results of the batch.
    keys : list[Varied]
        Varied keys in the order of `varied_keys`.
    shown : list[str]
        Names of the numbers to draw.
    """
    values = np.zeros(1)
    if len(keys) > 1:
        values = np.unique([v for v in keys[1].values if v is not None])
        values = values[evenly_chosen(len(values), MOST_TOGETHER)]
    panels: Any = titled_panels(
        figure, results.title, 3.0, 1, len(values), squeeze=False, sharey=True
    )[0]
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
    quantity = f"{torque_model(model).title}: torque" if model else quantity
    panels[0].set_ylabel(f"{quantity} [{quantity_unit(shown[0])}]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=min(len(labels), 4), loc="outside lower center")
    every = len(set(keys[1].values)) if len(keys) > 1 else 0
    left_out = len(values) < every
    note = [f"{len(values)} of {every} values of {keys[1].label}"] if left_out else []
    _note(figure, results, keys[2:], note)


def _note(figure: Figure, results: BatchResults, hidden: list[Varied], notes: list[str]) -> None:
    """Write below a figure which keys vary unseen, and further remarks."""
    notes = notes + ["crosses: not converged"] * (not results.converged)
    if 0 < len(hidden) <= MOST_PANELS:
        notes.append(f"further keys vary: {', '.join(key.label for key in hidden)}")
    elif hidden:
        notes.append(f"{len(hidden)} further keys vary")
    figure.supxlabel("; ".join(notes), fontsize=6.5, color=REFERENCE)


def _first_key(axes: Axes, key: Varied) -> None:
    """Name of a key along the axis, its words as ticks, and a grid."""
    axes.set_xlabel(key.label)
    axes.grid(linewidth=0.3, alpha=0.5)
    if key.words:
        parts = [[fill(part, WORD_WIDTH) for part in word.split(" / ")] for word in key.words]
        axes.set_xticks(range(len(parts)), ["\n".join(lines) for lines in parts], fontsize=6.5)


def quantity_label(name: str, model: str | None = None) -> str:
    """A number in words; of a torque its model and part, without the `model` of all numbers.

    Parameters
    ----------
    name : str
        Dotted name of the number.
    model : str | None, optional
        Torque model that all numbers of the figure are of.

    Returns
    -------
    str
        The words.
    """
    if name.startswith(MODELS):
        own, part = name.removeprefix(MODELS).split(".")
        part_title = TORQUE_PARTS.get(part, part)
        if own == model:
            return part_title
        return torque_model(own).title + ("" if part == "total" else f", {part_title}")
    main = MAIN_QUANTITY.get(name.removesuffix(".total"))
    return without_unit(name.rpartition(".")[2]) if main is None else main.title


def common_model(names: list[str]) -> str | None:
    """The torque model that all numbers are of, if there is one.

    Parameters
    ----------
    names : list[str]
        Dotted names of the numbers.

    Returns
    -------
    str | None
        Name of the model.
    """
    models = {name.removeprefix(MODELS).split(".")[0] for name in names}
    of_models = all(name.startswith(MODELS) for name in names)
    return models.pop() if of_models and len(models) == 1 else None


def quantity_unit(name: str) -> str:
    """Unit of a quantity for a label.

    Parameters
    ----------
    name : str
        Dotted name of the number.

    Returns
    -------
    str
        Unit as in labels.
    """
    return "a²/Rx" if name.endswith("_dimensionless") else unit_symbol(name) or "-"


def _data(results: BatchResults, keys: list[Varied], name: str) -> Any:
    """Points that have all of it: three keys, a quantity and its error, whether it converged.

    As a record array, in the units of the keys; a key that is not there is 0.
    """
    head, _, unit = name.rpartition("_")
    rows: list[Any] = []
    nothing = [0.0] * len(results.points)
    places = [keys[k].values if k < len(keys) else nothing for k in range(3)]
    for point, *place in zip(results.points, *places, strict=True):
        row = point_numbers(point)
        if row.get(name) is not None and None not in place:
            error = row.get(f"{head}_uncertainty_{unit}") or 0.0
            rows.append((*place, row[name], error, point.converged))
    return np.rec.fromrecords(rows, formats=None, names="x,second,third,y,error,converged")


def _family(axes: Axes, data: Any, keys: list[Varied]) -> None:
    """Lines by the colour of the second key and by the style of the third."""
    for colour, second in _colours(keys[1]):
        for style, third in _styles(keys):
            part = data[(data.second == second) & (data.third == third)]
            if part.size:
                lines = {"linestyle": ""} if keys[0].words else style
                _line(axes, part, part.error, color=colour, **style | lines)


def _colours(key: Varied) -> list[tuple[Any, float]]:
    """A colour for each value of a key."""
    values = key.distinct
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    return list(zip(colours, values, strict=True))


def _styles(keys: list[Varied]) -> list[tuple[dict[str, Any], float]]:
    """A style of line and marker for each value of a third key; one style without one."""
    values = keys[2].distinct if len(keys) > 2 else [0.0]
    return [
        ({"linestyle": STYLES[k], "marker": MARKERS[k]}, value) for k, value in enumerate(values)
    ]


def _family_legend(figure: Any, axes: Axes, keys: list[Varied]) -> None:
    """Colours of the second key and styles of the third, once for all panels."""
    plain: dict[str, Any] = {"marker": "o", "markersize": 3}
    lines = [Line2D([], [], color=c, label=keys[1].text(v), **plain) for c, v in _colours(keys[1])]
    if len(keys) == 2 and len(lines) <= MOST_INSIDE:
        axes.legend(
            handles=lines, title=keys[1].label, title_fontsize=7, ncols=1 if keys[1].words else 2
        )
        return
    entries = [_heading(keys[1]), *lines]
    for style, value in _styles(keys) if len(keys) > 2 else ():
        if value == keys[2].distinct[0]:
            entries += [_heading(None), _heading(keys[2])]
        style |= {"markersize": 3, "color": REFERENCE, "label": keys[2].text(value)}
        entries.append(Line2D([], [], **style))
    figure.legend(handles=entries, loc="outside right center", handlelength=2.6)


def _heading(key: Varied | None) -> Line2D:
    """A line of a legend that is text alone, or empty."""
    label = "" if key is None else key.label.replace(" / ", " /\n")
    return Line2D([], [], linestyle="", label=label)


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Designs:
    """Designs with their first one or two goals and error bars, shape (designs, goals); which meet
    the constraints and which make the front. NaN where a design has no result.
    """

    title: str
    names: Sequence[str]
    signs: Sequence[float]  # 1 where a goal is to be small, -1 where large
    goals: Array
    errors: Array
    feasible: Sequence[bool]
    front: Sequence[bool]
    case: int | None  # place of the case among the designs


def write_front(designs: Designs, path: Path) -> None:
    """Draw the designs into a PNG, PDF or SVG.

    Parameters
    ----------
    designs : Designs
        Designs of an optimisation.
    path : Path
        File that ends in .png, .pdf or .svg.
    """
    draw = draw_front if len(designs.names) > 1 else draw_progress
    write_figure(path, lambda figure: draw(figure, designs))


def draw_front(figure: Figure, designs: Designs) -> None:
    """One goal over the other: all designs, those that meet the constraints, the front.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    designs : Designs
        Designs of an optimisation with two goals.
    """
    axes = titled_panels(figure, designs.title, 3.4)
    met, front = np.array(designs.feasible), np.array(designs.front)
    x, y = designs.goals[:, 0], designs.goals[:, 1]
    axes.scatter(x[~met], y[~met], s=14, marker="x", color=REFERENCE, label="limits not met")
    rest = met & ~front
    axes.scatter(x[rest], y[rest], s=14, facecolors="none", edgecolors=INK, label="limits met")
    order = np.flatnonzero(front)[np.argsort(x[front])]
    bars = (designs.errors[order, 1], designs.errors[order, 0])
    axes.errorbar(x[order], y[order], *bars, color=FRONT, marker="o", markersize=4, label="front")
    if designs.case is not None:
        axes.scatter(x[designs.case], y[designs.case], s=60, marker="*", color=INK, label="case")
    axes.set(xlabel=_label(designs.names[0]), ylabel=_label(designs.names[1]))
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend(fontsize=7)


def draw_progress(figure: Figure, designs: Designs) -> None:
    """The goal of each design in the order in which they were computed, and the best so far.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    designs : Designs
        Designs of an optimisation.
    """
    axes = titled_panels(figure, designs.title, 3.0)
    met = np.array(designs.feasible)
    number = np.arange(1, len(met) + 1)
    goal, error = designs.goals[:, 0], designs.errors[:, 0]
    axes.scatter(
        number[~met], goal[~met], s=14, marker="x", color=REFERENCE, label="limits not met"
    )
    dots: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 3, "color": INK}
    axes.errorbar(number[met], goal[met], error[met], label="limits met", **dots)
    sign = designs.signs[0]
    best = sign * np.fmin.accumulate(np.where(met, sign * goal, np.inf))
    best[~np.isfinite(best)] = np.nan
    axes.step(number, best, where="post", color=FRONT, label="best so far")
    axes.set(xlabel="design", ylabel=_label(designs.names[0]))
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend(fontsize=7)


def _label(name: str) -> str:
    available = MAIN_QUANTITY.get(name)
    words = without_unit(name.rpartition(".")[2]) if available is None else available.title
    return f"{words} [{unit_symbol(name) or '-'}]"

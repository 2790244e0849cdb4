"""Figures of a batch: film, pressure and torque over one or two of the varied keys."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .batch_results import BatchResults, main_results
from .named_units import unit_of, without_unit
from .plot_style import INK, PAGE_WIDTH, RC, REFERENCE, Array, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BATCH_PLOT = "over_keys.png"
QUANTITIES = {
    "film_minimum_um": "minimum film",
    "film_minimum_dimensionless": "minimum film",
    "torque_N_mm": "torque",
    "hertz_pressure_maximum_GPa": "largest Hertz pressure",
    "hertz_pressure_GPa": "Hertz pressure",
}
MOST_PANELS = 3
MOST_LINES = 8  # of a family; more values are told by colour


def varied_keys(results: BatchResults) -> list[str]:
    """Keys with at least two different numbers, the one with most of them first."""
    counts = {}
    for key in results.keys:
        values = {point.values.get(key) for point in results.points if _is_number(point.values.get(key))}
        if len(values) > 1:
            counts[key] = len(values)
    return sorted(counts, key=lambda key: -counts[key])


def write_batch_plots(results: BatchResults, directory: Path) -> tuple[str, ...]:
    """Draw the figure of a batch into its folder `plots`; what could not be drawn, and why.

    Parameters
    ----------
    results : BatchResults
    directory : Path
        Folder of the batch.

    Returns
    -------
    tuple of str
    """
    import matplotlib
    import matplotlib.figure

    keys, shown = varied_keys(results), quantities(results)
    if not keys or not shown:
        return (f"plots/{BATCH_PLOT} not written: no {'key with several numbers' if shown else 'result'} to draw",)
    with matplotlib.rc_context(RC):
        figure = matplotlib.figure.Figure()
        draw_batch(figure, results, keys, shown)
        save(figure, directory / "plots" / BATCH_PLOT)
    return ()


def quantities(results: BatchResults) -> list[str]:
    """The main results that at least one point has, as many as fit a figure."""
    rows = [main_results(point.summary) for point in results.points]
    return [name for name in QUANTITIES if any(row.get(name) is not None for row in rows)][:MOST_PANELS]


def draw_batch(figure: Figure, results: BatchResults, keys: list[str], shown: list[str]) -> None:
    """A panel for each quantity over the first key; the second key as a family of lines, or as colour.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    results : BatchResults
    keys : list of str
        As `varied_keys` orders them.
    shown : list of str
        Quantities, units [um], [GPa], [N mm] as their names say.
    """
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    figure.suptitle(results.title, fontsize=8.5)
    panels: Any = figure.subplots(1, len(shown), squeeze=False)[0]
    mapped = None
    for axes, name in zip(panels, shown, strict=True):
        x, colour, y, error, sound = _data(results, keys, name)
        if len(keys) == 1:
            _line(axes, x, y, error, sound, {"color": INK})
        elif len(np.unique(colour)) <= MOST_LINES:
            _family(axes, (x, colour, y, error, sound), axis_label(keys[1]) if axes is panels[0] else "")
        else:
            mapped = axes.scatter(x[sound], y[sound], c=colour[sound], s=14)
            axes.scatter(x[~sound], y[~sound], c=colour[~sound], s=18, marker="x")
        axes.set_xlabel(axis_label(keys[0]))
        axes.set_ylabel(f"{QUANTITIES[name]} [{unit_of(name).replace('um', 'µm') or 'a²/Rx'}]")
        axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])
        axes.grid(linewidth=0.3, alpha=0.5)
    if mapped is not None:
        figure.colorbar(mapped, ax=panels, label=axis_label(keys[1]))
    notes = ["error bars: uncertainty of the film"] if shown[0].startswith("film") and mapped is None else []
    notes += ["crosses: not converged"] if not results.converged else []
    notes += [f"further keys vary: {', '.join(map(axis_label, keys[2:5]))}"] if 2 < len(keys) <= 5 else []
    notes += [f"{len(keys) - 2} further keys vary"] if len(keys) > 5 else []
    figure.supxlabel("; ".join(notes), fontsize=6.5, color=REFERENCE)


def axis_label(key: str) -> str:
    """A key in words, its unit in brackets."""
    last = key.rpartition(".")[2]
    unit = unit_of(last).replace("um", "µm")
    return f"{without_unit(last)} [{unit}]" if unit else without_unit(last)


def _data(results: BatchResults, keys: list[str], name: str) -> tuple[Array, Array, Array, Array, Any]:
    """First key, second key, quantity, its uncertainty, whether it converged, of the points that have all of them."""
    head, _, unit = name.rpartition("_")
    rows = []
    for point in results.points:
        row = main_results(point.summary)
        first = point.values.get(keys[0])
        second = point.values.get(keys[1]) if len(keys) > 1 else 0.0
        if row.get(name) is not None and _is_number(first) and _is_number(second):
            rows.append((first, second, row[name], row.get(f"{head}_uncertainty_{unit}") or 0.0, point.converged))
    x, colour, y, error, sound = (np.array(column) for column in zip(*rows, strict=True))
    return x, colour, y, error, sound.astype(bool)


def _family(axes: Axes, data: tuple[Array, Array, Array, Array, Any], label: str) -> None:
    import matplotlib

    x, colour, y, error, sound = data
    values = np.unique(colour)
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(values)))
    for value, shade in zip(values, colours, strict=True):
        part = colour == value
        _line(axes, x[part], y[part], error[part], sound[part], {"color": shade, "label": f"{value:g}"})
    if label:  # once is enough
        axes.legend(title=label, title_fontsize=7, ncols=2)


def _line(axes: Axes, x: Array, y: Array, error: Array, sound: Any, style: dict[str, Any]) -> None:
    """One curve in the order of the key, with error bars; crosses where it did not converge."""
    order = np.argsort(x, kind="stable")
    lines = "-" if len(np.unique(x)) == len(x) else ""
    bars = error[order] if error.any() else None
    axes.errorbar(x[order], y[order], bars, fmt=f"o{lines}", markersize=3, capsize=2, linewidth=1.0, **style)
    if not sound.all():
        axes.plot(x[~sound], y[~sound], "x", markersize=7, color=style["color"])


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)

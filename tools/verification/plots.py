"""Pictures of the verification page."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from oilfilm.ehl.arrays import Array
from oilfilm.postprocess.plot_style import INK, INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE

MARKERS = "os^Dv<>P"


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """Points of one curve, dimensionless unless the picture says otherwise."""

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]


def _colours(count: int) -> Array:
    return np.asarray(mpl.colormaps["viridis"](np.linspace(0.0, 0.85, max(count, 1))))


def _mathematical(name: str) -> str:
    return name.replace("R_x/R_y", "$R_x/R_y$")


def _slope(axes: Axes, x: tuple[float, float], y: float, power: int) -> None:
    """A dashed line of a power of x."""
    ends = np.array(x)
    axes.plot(ends, y * (ends / ends[0]) ** power, color=REFERENCE, linestyle="--", linewidth=0.9)
    axes.annotate(f"order {power}", (ends[1], y * (ends[1] / ends[0]) ** power), fontsize=7, color=REFERENCE)


def draw_orders(figure: Figure, curves: Sequence[Curve]) -> None:
    """Relative errors of films [-] over the mesh size in semi-axes [-], with a line of order 2."""
    figure.set_size_inches(PAGE_WIDTH, 3.6)
    axes: Axes = figure.subplots()
    names = list(dict.fromkeys(curve.label.rpartition(", ")[0] for curve in curves))
    colours = _colours(len(names))
    for curve in curves:
        name, _, which = curve.label.rpartition(", ")
        number = names.index(name)
        central = which == "central"
        style: Any = {"marker": MARKERS[number], "markersize": 4, "color": colours[number]}
        style["markerfacecolor"] = colours[number] if central else "white"
        style["label"] = f"{_mathematical(name)}: {which} film"
        axes.loglog(curve.x, curve.y, linestyle="-" if central else ":", **style)
    finest = min(min(curve.x) for curve in curves)
    least = min(min(curve.y) for curve in curves if min(curve.x) < 3.0 * finest)
    _slope(axes, (finest, 4.0 * finest), 0.4 * least, 2)
    axes.set_xlabel("mesh size $h_x$ [a]")
    axes.set_ylabel("relative error of the film [-]")
    axes.grid(which="major", linewidth=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def draw_hertz(figure: Figure, curves: Sequence[Curve]) -> None:
    """Pressure over Hertz' largest [-] along the centre line [a]."""
    figure.set_size_inches(0.8 * PAGE_WIDTH, 3.3)
    axes: Axes = figure.subplots()
    for colour, curve in zip(_colours(len(curves)), curves, strict=True):
        axes.plot(curve.x, curve.y, color=colour, label=curve.label)
    x = np.cos(np.linspace(np.pi, 0.0, 200))
    axes.plot(x, np.sqrt(1.0 - x**2), color=OUTER_COLOUR, linestyle="--", label="Hertz")
    axes.set_xlim(-2.5, 1.5)
    axes.set_ylim(0.0, 1.25)
    axes.set_xlabel("$x/a$, entrainment to the right")
    axes.set_ylabel("$p/p_h$ at $y$ = 0")
    axes.legend(loc="upper left")


def draw_moes(figure: Figure, curves: Sequence[Curve], fits: Sequence[Curve]) -> None:
    """Central film (h/Rx)(2U)^(-1/2) [-] over M [-], one curve each L; fits as lines."""
    figure.set_size_inches(0.8 * PAGE_WIDTH, 3.8)
    axes: Axes = figure.subplots()
    for number, (colour, curve, fit) in enumerate(zip(_colours(len(curves)), curves, fits, strict=True)):
        axes.loglog(fit.x, fit.y, color=colour, linewidth=0.9)
        style: Any = {"color": colour, "markersize": 4, "label": f"L = {curve.label}"}
        axes.loglog(curve.x, curve.y, MARKERS[number], **style)
    axes.set_xlabel("load parameter $M$ [-]")
    axes.set_ylabel("$(h_c/R_x)\\,(2U)^{-1/2}$ [-]")
    axes.grid(which="major", linewidth=0.3)
    handles: list[Any] = [*axes.get_legend_handles_labels()[0]]
    (line,) = axes.plot([], [], color=INK, linewidth=0.9, label="Nijenbanning, Venner and Moes")
    axes.legend(handles=[*handles[::-1], line], loc="upper right")


@dataclass(frozen=True, slots=True, kw_only=True)
class FormulaMap:
    """Formula over solved film less one, shape (L, M) [-]; NaN where there is no solved film."""

    title: str
    loads: tuple[float, ...]
    lubricant: tuple[float, ...]
    share: Array


def draw_formulas(figure: Figure, maps: Sequence[FormulaMap], columns: int) -> None:
    """Deviations [-] over M and L, one row of panels each formula."""
    rows = len(maps) // columns
    figure.set_size_inches(PAGE_WIDTH, 0.6 + 1.75 * rows)
    panels: Any = figure.subplots(rows, columns, squeeze=False)
    image: Any = None
    for axes, shown in zip(panels.ravel(), maps, strict=True):
        percent = 100.0 * np.ma.masked_invalid(shown.share)
        image = axes.imshow(percent, cmap="RdBu_r", vmin=-60.0, vmax=60.0, origin="lower", aspect="auto")
        for (j, i), value in np.ndenumerate(shown.share):
            text = "×" if np.isnan(value) else f"{100.0 * value:+.0f}"
            style: Any = {"ha": "center", "va": "center", "fontsize": 6}
            axes.text(i, j, text, color="white" if abs(value) > 0.45 else INK, **style)
        axes.set_title(shown.title, fontsize=6.5)
        axes.set_xticks(range(len(shown.loads)), [f"{m:g}" for m in shown.loads])
        axes.set_yticks(range(len(shown.lubricant)), [f"{v:g}" for v in shown.lubricant])
    for axes in panels[-1]:
        axes.set_xlabel("$M$ [-]")
    for axes in panels[:, 0]:
        axes.set_ylabel("$L$ [-]")
    figure.colorbar(image, ax=panels, label="formula over solved film, less one [%]", extend="both", aspect=40)


@dataclass(frozen=True, slots=True, kw_only=True)
class ScalingCurve:
    """Cost of one contact: times [us], memory [bytes] per unknown, and cycles [-]."""

    label: str
    unknowns: tuple[int, ...]
    time: tuple[float, ...]
    deflection: tuple[float, ...]
    cycles: tuple[int, ...]
    memory: tuple[float, ...]


def draw_scaling(figure: Figure, curves: Sequence[ScalingCurve]) -> None:
    """Time [us], cycles [-] and memory [bytes] over the number of unknowns [-]."""
    figure.set_size_inches(PAGE_WIDTH, 3.0)
    panels: Any = figure.subplots(1, 3)
    for number, (colour, curve) in enumerate(zip(_colours(len(curves)), curves, strict=True)):
        style: dict[str, Any] = {"color": colour, "marker": MARKERS[number], "markersize": 3.5}
        panels[0].loglog(curve.unknowns, curve.time, label=_mathematical(curve.label), **style)
        panels[0].loglog(curve.unknowns, curve.deflection, color=colour, linestyle="--", linewidth=0.8)
        panels[1].semilogx(curve.unknowns, curve.cycles, **style)
        panels[2].semilogx(curve.unknowns, curve.memory, **style)
    panels[0].set_ylabel("time per unknown [µs]\n(dashed: one deflection)")
    panels[1].set_ylabel("cycles on the finest grid [-]")
    panels[2].set_ylabel("memory per unknown [bytes]")
    panels[1].set_ylim(0.0, 1.3 * max(max(curve.cycles) for curve in curves))
    panels[2].set_ylim(0.0, 1.2 * max(max(curve.memory) for curve in curves))
    for axes in panels:
        axes.set_xlabel("unknowns [-]")
        axes.grid(which="major", linewidth=0.3)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)


@dataclass(frozen=True, slots=True)
class MapPoint:
    """One random contact: M, L, Rx/Ry [-], its kind of entrainment, and what it needed."""

    load: float
    lubricant: float
    ratio: float
    kind: str
    group: str


GROUPS = {
    "no measure": "#b7c0c9",
    "damping halved in passing": "#6aaed6",
    "another attempt": INNER_COLOUR,
    "converged, unresolved": "#e8a33d",
    "failed": OUTER_COLOUR,
}
KINDS = {"straight": "o", "at an angle": "^", "rotating": "s"}
BANDS = (0.0, 0.03, 0.3, 1.0, float("inf"))  # of Rx/Ry, a panel each


def draw_robustness(figure: Figure, points: Sequence[MapPoint]) -> None:
    """What random contacts needed, over M and L [-], a panel for each band of Rx/Ry [-]."""
    figure.set_size_inches(PAGE_WIDTH, 5.6)
    panels: Any = figure.subplots(2, 2, sharex=True, sharey=True)
    for axes, low, high in zip(panels.ravel(), BANDS[:-1], BANDS[1:], strict=True):
        shown = [point for point in points if low <= point.ratio < high]
        for group, colour in GROUPS.items():
            for kind, marker in KINDS.items():
                some = [p for p in shown if p.group == group and p.kind == kind]
                x, y = [p.load for p in some], [p.lubricant for p in some]
                axes.scatter(x, y, s=16, marker=marker, color=colour, edgecolor=INK, linewidth=0.2)
        axes.set_xscale("log")
        axes.set_title(f"$R_x/R_y$ {_band_name(low, high)}: {len(shown)} draws")
        axes.grid(linewidth=0.3)
    for axes in panels[-1]:
        axes.set_xlabel("load parameter $M$ [-]")
    for axes in panels[:, 0]:
        axes.set_ylabel("lubricant parameter $L$ [-]")
    style: Any = {"s": 16, "edgecolor": INK}
    groups = [
        panels[0, 0].scatter([], [], color=colour, linewidth=0.2, label=group, **style)
        for group, colour in GROUPS.items()
    ]
    style |= {"color": "none", "linewidth": 0.6}
    kinds = [
        panels[0, 0].scatter([], [], marker=marker, label=f"entrainment {kind}", **style)
        for kind, marker in KINDS.items()
    ]
    figure.legend(handles=[*groups, *kinds], loc="outside lower center", ncols=4)


def _band_name(low: float, high: float) -> str:
    if high == float("inf"):
        return f"above {low:g}"
    return f"{low:g} to {high:g}" if low > 0.0 else f"below {high:g}"

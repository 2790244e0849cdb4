"""Picture of an optimisation: the front of two goals, or one goal over the designs."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ehl.arrays import Array
from ehl.units import unit_symbol, without_unit

from ..plot_style import INK, REFERENCE, titled_panels, write_figure
from .main_results import MAIN_QUANTITY

FRONT = "#b23a3a"


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
    axes.set_xlabel(_label(designs.names[0]))
    axes.set_ylabel(_label(designs.names[1]))
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
    axes.set_xlabel("design")
    axes.set_ylabel(_label(designs.names[0]))
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend(fontsize=7)


def _label(name: str) -> str:
    available = MAIN_QUANTITY.get(name)
    words = without_unit(name.rpartition(".")[2]) if available is None else available.title
    return f"{words} [{unit_symbol(name) or '-'}]"

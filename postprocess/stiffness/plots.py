"""Figure of the stiffness over speed."""

from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from ..plot_style import titled_panels, write_figure
from ..results import STIFFNESS_ORDER
from .results import StiffnessResults
from .summary import SPEED, STIFFNESS, TILTING_STIFFNESS

COLOURS = ("#1f4e8c", "#c1440e", "#3a7d44", "#7a4fa3", "#8a6d1d")
SMALL_COUPLING = 1e-3  # of the largest stiffness: couplings below are not drawn [-]


def write_stiffness_plot(results: StiffnessResults, directory: Path) -> None:
    """Write `stiffness.png` into a folder; stiffness in [N/um] and [N m/mrad] over speed.

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.
    directory : Path
        Folder to write into.
    """
    write_figure(directory / "stiffness.png", partial(draw_stiffness, results=results))


def draw_stiffness(figure: Figure, results: StiffnessResults) -> None:
    """Diagonal, largest couplings of translation, and tilts, over the inner ring's speed.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : StiffnessResults
        Stiffness over speed of the case.
    """
    left, right = titled_panels(figure, results.title, 3.4, 1, 2)
    speeds = SPEED.value(results.study)
    matrices = results.study.matrices
    translation = STIFFNESS.in_unit(matrices[:, :3, :3])
    tilting = TILTING_STIFFNESS.in_unit(matrices[:, 3:, 3:])
    line: dict[str, Any] = {"marker": "o", "markersize": 3}
    for k, name in enumerate("xyz"):
        left.plot(speeds, translation[:, k, k], color=COLOURS[k], label=f"k {name}", **line)
    for k, name in enumerate("yz"):
        label = f"k tilt {name}"
        right.plot(speeds, tilting[:, k, k], color=COLOURS[k + 1], label=label, **line)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        values = translation[:, i, j]
        if abs(values).max() > SMALL_COUPLING * abs(translation).max():
            label = f"k {STIFFNESS_ORDER[i]}{STIFFNESS_ORDER[j]}"
            left.plot(speeds, values, "--", linewidth=1.0, color=COLOURS[i + j], label=label)
    for axes, quantity in ((left, STIFFNESS), (right, TILTING_STIFFNESS)):
        axes.set_xlabel(SPEED.label)
        axes.set_ylabel(quantity.label)
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
        axes.legend()

"""Figure of the stiffness over speed."""

from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from ehl.units import from_si

from ..plot_style import PAGE_WIDTH, write_figure
from ..results import STIFFNESS_ORDER
from .results import StiffnessResults
from .table import PER_MRAD, PER_UM

PLOT_FILE = "stiffness.png"
COLOURS = ("#1f4e8c", "#c1440e", "#3a7d44", "#7a4fa3", "#8a6d1d")
SMALL_COUPLING = 1e-3  # of the largest stiffness: couplings below are not drawn [-]


def write_stiffness_plot(results: StiffnessResults, directory: Path) -> None:
    """Write `stiffness.png` into a folder; stiffness in [N/um] and [N m/mrad] over speed."""
    write_figure(directory / PLOT_FILE, partial(draw_stiffness, results=results))


def draw_stiffness(figure: Figure, results: StiffnessResults) -> None:
    """Diagonal, largest couplings of translation, and tilts, over the inner ring's speed."""
    figure.set_size_inches(PAGE_WIDTH, 3.4)
    figure.suptitle(results.title, fontsize=8.5)
    left, right = figure.subplots(1, 2)
    study = results.study
    speeds = from_si("speeds_rpm", study.speeds)
    largest = abs(study.matrices[:, :3, :3]).max()
    line: dict[str, Any] = {"marker": "o", "markersize": 3}
    for k, name in enumerate(STIFFNESS_ORDER):
        axes, unit = (left, PER_UM) if k < 3 else (right, PER_MRAD)
        label = f"k {name}" if k < 3 else f"k tilt {name[1]}"
        colour = COLOURS[k] if k < 3 else COLOURS[k - 2]
        axes.plot(speeds, study.matrices[:, k, k] * unit, color=colour, label=label, **line)
    for i, j in ((0, 1), (0, 2), (1, 2)):
        values = study.matrices[:, i, j]
        if abs(values).max() > SMALL_COUPLING * largest:
            label = f"k {STIFFNESS_ORDER[i]}{STIFFNESS_ORDER[j]}"
            style: dict[str, Any] = {"linewidth": 1.0, "color": COLOURS[i + j], "label": label}
            left.plot(speeds, values * PER_UM, "--", **style)
    _finish(left, "stiffness [N/µm]")
    _finish(right, "tilting stiffness [N m/mrad]")


def _finish(axes: Any, label: str) -> None:
    axes.set_xlabel("speed of the inner ring [r/min]")
    axes.set_ylabel(label)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.legend()

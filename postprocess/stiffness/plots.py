"""Figure of the stiffness over speed."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from ehl.units import RPM

from ..plot_style import PAGE_WIDTH, RC, save
from .results import ORDER, StiffnessResults

PLOT_FILE = "stiffness.png"
COLOURS = ("#1f4e8c", "#c1440e", "#3a7d44", "#7a4fa3", "#8a6d1d")
PER_UM = 1e-6
PER_MRAD = 1e-3


def write_stiffness_plot(results: StiffnessResults, directory: Path) -> None:
    """Write `stiffness.png` into a folder; stiffness in [N/um] and [N m/mrad] over speed."""
    with mpl.rc_context(RC):
        figure = Figure()
        draw_stiffness(figure, results)
        save(figure, directory / PLOT_FILE)


def draw_stiffness(figure: Figure, results: StiffnessResults) -> None:
    """Diagonal and the largest couplings of translation, and the tilts, over the speed of the
    inner ring.
    """
    figure.set_size_inches(PAGE_WIDTH, 3.4)
    figure.suptitle(str(results.case.get("title", "")), fontsize=8.5)
    left, right = figure.subplots(1, 2)
    study = results.study
    speeds = study.speeds / RPM
    for k in range(3):
        left.plot(
            speeds,
            study.matrices[:, k, k] * PER_UM,
            "o-",
            markersize=3,
            color=COLOURS[k],
            label=f"k {ORDER[k]}",
        )
    for i, j in ((0, 1), (0, 2), (1, 2)):
        values = study.matrices[:, i, j] * PER_UM
        if abs(values).max() > 1e-3 * abs(study.matrices[:, :3, :3]).max() * PER_UM:
            left.plot(
                speeds,
                values,
                "--",
                linewidth=1.0,
                color=COLOURS[i + j],
                label=f"k {ORDER[i]}{ORDER[j]}",
            )
    for k in (3, 4):
        name = f"k tilt {ORDER[k][1]}"
        right.plot(
            speeds,
            study.matrices[:, k, k] * PER_MRAD,
            "o-",
            markersize=3,
            color=COLOURS[k - 2],
            label=name,
        )
    _finish(left, "stiffness [N/µm]")
    _finish(right, "tilting stiffness [N m/mrad]")


def _finish(axes: Any, label: str) -> None:
    axes.set_xlabel("speed of the inner ring [r/min]")
    axes.set_ylabel(label)
    axes.grid(linewidth=0.3, alpha=0.5)
    low = axes.get_ylim()[0]
    axes.set_ylim(bottom=min(0.0, low))
    axes.legend()

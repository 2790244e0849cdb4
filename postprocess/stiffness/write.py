"""Files, picture and table of the stiffness over speed."""

from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from rich.console import Group
from rich.text import Text

from ..netcdf_write import StudyFiles, write_study
from ..plot_style import titled_panels, write_figure
from ..quantities import STIFFNESS_ORDER, number, number_table, titled
from .results import (
    SPEED,
    STIFFNESS,
    TILTING_STIFFNESS,
    StiffnessResults,
    stiffness_columns,
    stiffness_summary,
    stiffness_variables,
)

COLOURS = ("#1f4e8c", "#c1440e", "#3a7d44", "#7a4fa3", "#8a6d1d")
SMALL_COUPLING = 1e-3  # of the largest stiffness: couplings below are not drawn [-]
ROUND_OFF = 1e-9  # of the largest entry: shown as zero [-]
HEADERS = ("r/min", "k_xx", "k_yy", "k_zz", "k_yz", "k_xy", "tilt y", "tilt z")
ENTRIES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 1))  # of translation


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
        axes.set(xlabel=SPEED.label, ylabel=quantity.label)
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
        axes.legend()


def write_stiffness(results: StiffnessResults, directory: Path) -> tuple[str, ...]:
    """Write matrices, table for ROSS, data set, summary; pictures that failed are messages.

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    files = StudyFiles(
        kind="stiffness",
        document=stiffness_summary(results),
        tables=stiffness_columns(results),
        variables=stiffness_variables(results),
    )
    return write_study(files, directory, lambda: write_stiffness_plot(results, directory))


def stiffness_table(results: StiffnessResults) -> Group:
    """Main entries over speed: stiffness [N/um] and [N m/mrad].

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.

    Returns
    -------
    Group
        The table.
    """
    study = results.study
    rows = []
    for speed, matrix in zip(SPEED.value(study), study.matrices, strict=True):
        entries = [STIFFNESS.in_unit(matrix[place]) for place in ENTRIES]
        entries += [TILTING_STIFFNESS.in_unit(matrix[i, i]) for i in (3, 4)]
        noise = ROUND_OFF * max(abs(entry) for entry in entries)
        cells = [number(e) if not abs(e) <= noise else "0" for e in entries]
        rows.append([f"{speed:.0f}", *cells])
    units = Text("stiffness k in N/µm, against tilting in N m/mrad", style="dim")
    return titled(results.title, units, number_table(HEADERS, rows))

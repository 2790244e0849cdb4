"""Traction curves over the slide-roll ratio, and maps of the traction over sliding and spin."""

from functools import partial
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ehl.traction_table.table import TractionTable

from ..plot_style import titled_panels, write_figure
from .results import TractionResults

COLOURS = ("#1f4e8c", "#3a7d44", "#8a6d1d", "#c1440e")
CURVE_POINTS = 161
MAP_POINTS = 61


def write_traction_plots(results: TractionResults, path: Path) -> tuple[Path, Path]:
    """Write `<name>_curves.png` and `<name>_map.png` beside the tables' file.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.
    path : Path
        File of the tables.

    Returns
    -------
    tuple[Path, Path]
        Both pictures.
    """
    files = tuple(path.with_name(f"{path.stem}_{kind}.png") for kind in ("curves", "map"))
    for file, draw in zip(files, (draw_traction_curves, draw_traction_map), strict=True):
        write_figure(file, partial(draw, results=results))
    return files[0], files[1]


def draw_traction_curves(figure: Figure, results: TractionResults) -> None:
    """Traction coefficient along the entrainment over the slide-roll ratio, by race and load.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : TractionResults
        Traction tables of the case.
    """
    panels = titled_panels(
        figure, results.title, 3.2, 1, len(results.tables), sharey=True, squeeze=False
    )[0]
    for axes, (race, table) in zip(panels, results.tables.items(), strict=True):
        speed = sqrt(table.range.speed[0] * table.range.speed[1])
        limit = table.range.slide_x
        ratios = limit * np.linspace(-1.0, 1.0, CURVE_POINTS) ** 3
        loads = np.geomspace(1.5 * table.range.load[0], table.range.load[1], len(COLOURS))
        for load, colour in zip(loads, COLOURS, strict=True):
            forces = [table.forces(load, speed, x * speed, 0.0, 0.0).force_x for x in ratios]
            style: dict[str, Any] = {"color": colour, "linewidth": 1.1, "label": f"{load:.0f} N"}
            axes.plot(ratios, -np.array(forces) / load, **style)
        axes.set_xscale("symlog", linthresh=1e-3, linscale=0.6)
        ticks = [-1.0, -1e-1, -1e-2, -1e-3, 0.0, 1e-3, 1e-2, 1e-1, 1.0]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks], rotation=45)
        axes.minorticks_off()
        axes.set_xlabel("slide-roll ratio (u₁ − u₂)/u [-], u₁ of the ball")
        axes.set_title(f"{race.value} race, u = {speed:.3g} m/s", fontsize=8)
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.axhline(0.0, color="black", linewidth=0.5)
    panels[0].set_ylabel("force on the ball, −Fx/Q [-]")
    panels[0].legend(loc="upper left", title="load")


def draw_traction_map(figure: Figure, results: TractionResults) -> None:
    """Traction coefficient over sliding along and across, and over sliding and spin, by race.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : TractionResults
        Traction tables of the case.
    """
    panels = titled_panels(figure, results.title, 5.4, len(results.tables), 2, squeeze=False)
    for row, (race, table) in zip(panels, results.tables.items(), strict=True):
        load = sqrt(table.range.load[0] * table.range.load[1])
        speed = sqrt(table.range.speed[0] * table.range.speed[1])
        along = 0.2 * np.linspace(-1.0, 1.0, MAP_POINTS)
        spins = table.range.spin * np.linspace(-1.0, 1.0, MAP_POINTS)
        flat = _coefficients(table, load, speed, [(x, y, 0.0) for y in along for x in along])
        spun = _coefficients(table, load, speed, [(x, 0.0, n) for n in spins for x in along])
        top = max(flat.max(), spun.max())
        style: dict[str, Any] = {"vmin": 0.0, "vmax": top, "rasterized": True}
        for axes, values, vertical in ((row[0], flat, along), (row[1], spun, spins)):
            image = axes.pcolormesh(along, vertical, values.reshape(MAP_POINTS, -1), **style)
            axes.set_xlabel("slide-roll ratio along [-]")
            figure.colorbar(image, ax=axes, label="|F|/Q [-]")
        row[0].set_ylabel("slide-roll ratio across [-]")
        row[1].set_ylabel("spin over rolling, Ω Rx/u [-]")
        name = f"{race.value} race, {load:.0f} N, {speed:.3g} m/s"
        row[0].set_title(f"{name}, no spin", fontsize=8)
        row[1].set_title("no sliding across", fontsize=8)


def _coefficients(
    table: TractionTable, load: float, speed: float, motions: list[tuple[float, float, float]]
) -> Any:
    radius = table.contact.radius_x
    forces = [
        table.forces(load, speed, x * speed, y * speed, n * speed / radius) for x, y, n in motions
    ]
    return np.array([np.hypot(f.force_x, f.force_y) / load for f in forces])

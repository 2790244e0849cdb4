"""Files, pictures and table of traction tables."""

from functools import partial
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from rich import box
from rich.console import Group
from rich.table import Table

from oilfilm.bearing.friction.tables import save_race_tables, save_temperature_tables
from oilfilm.ehl.traction_table.table import TractionTable

from ..plot_style import titled_panels, write_figure
from ..quantities import number_table
from .results import TractionResults, traction_summary

COLOURS = ("#1f4e8c", "#3a7d44", "#8a6d1d", "#c1440e")
CURVE_POINTS = 161
MAP_POINTS = 61
RANGES = ("race", "load [N]", "speed [m/s]", "films", "largest µ", "error 95 %", "largest")
PLACES = ("race", "load [N]", "speed [m/s]", "slide/roll", "µ, film", "µ, full", "film ratio")


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


def write_traction(results: TractionResults, path: Path) -> None:
    """Write the tables, and beside them `<name>_curves.png` and `<name>_map.png`.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.
    path : Path
        File of the tables.
    """
    save_tables(results, path)
    write_traction_plots(results, path)


def save_tables(results: TractionResults, path: Path) -> None:
    """Write the tables to a file; it appears under its name only when it is complete.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.
    path : Path
        File of the tables.
    """
    if results.over_temperature is None:
        save_race_tables(results.tables, path)
    else:
        save_temperature_tables(results.over_temperature, path)


def traction_table(results: TractionResults) -> Group:
    """Range and error of each race's table, full solves beside them, and the messages.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.

    Returns
    -------
    Group
        The tables.
    """
    rows = [
        [
            race.value,
            "{:.3g} to {:.4g}".format(*table.range.load),
            "{:.3g} to {:.3g}".format(*table.range.speed),
            str(table.films),
            f"{table.kappa_max:.4f}",
            f"{table.error.quantile:.2%}",
            f"{table.error.largest:.2%}",
        ]
        for race, table in results.tables.items()
    ]
    tables = [_boxed(RANGES, rows, results.title)]
    if any(table.full_solves for table in results.tables.values()):
        tables.append(_full_solves(results))
    messages = traction_summary(results)["messages"]
    return Group(*tables, *(f"  {message}" for message in messages))


def _full_solves(results: TractionResults) -> Table:
    """Effects that the films of the tables leave out, place by place."""
    rows = [
        [
            race.value,
            f"{solve.load:.4g}",
            f"{solve.speed:.3g}",
            f"{solve.slide_ratio:.4f}",
            f"{solve.by_film:.4f}",
            f"{solve.in_full:.4f}",
            f"{solve.film_ratio:.3f}" + ("" if solve.converged else ", not converged"),
        ]
        for race, table in results.tables.items()
        for solve in table.full_solves
    ]
    return _boxed(PLACES, rows, "Sliding on the table's film, and in full solves")


def _boxed(headers: tuple[str, ...], rows: list[list[str]], title: str) -> Table:
    style = {"box": box.HEAVY_HEAD, "pad_edge": True}
    return number_table(headers, rows, ("race",), title=title, **style)

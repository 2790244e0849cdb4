"""Files, pictures and tables of temperatures over speed and time."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich.console import Group
from rich.text import Text

from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.heating.over_speed import SpeedLimit

from ..files import CsvTable
from ..netcdf_write import StudyFiles, Variables, write_study
from ..plot_style import PAGE_WIDTH, write_figure
from ..quantities import evenly_chosen, number, number_table, titled
from .results import FILM, LIMIT, SPEED, TemperatureResults, temperatures_summary

LINES = (  # key, name, colour
    ("film_temperature_C", "films", "#000000"),
    ("balls_temperature_C", "balls", "#c1440e"),
    ("inner_ring_temperature_C", "inner ring", "#1f4e8c"),
    ("outer_ring_loaded_temperature_C", "outer ring, loaded half", "#3a7d44"),
    ("oil_temperature_C", "oil", "#8a6d1d"),
    ("housing_temperature_C", "housing", "#7a4fa3"),
)
KELVIN = {"units": "K"}
COLUMNS = (  # title and key; of the parts those that differ most
    ("films", "film_temperature_C"),
    ("inner", "inner_ring_temperature_C"),
    ("balls", "balls_temperature_C"),
    ("outer", "outer_ring_loaded_temperature_C"),
    ("oil", "oil_temperature_C"),
    ("housing", "housing_temperature_C"),
    ("P_d µm", "clearance_um"),
    ("heat W", "power_W"),
)
LIMITS = {
    SpeedLimit.RUNAWAY: "limit: friction exceeds the cooling",
    SpeedLimit.TEMPERATURE: "limit: highest temperature of the films",
    SpeedLimit.NO_STATE: "limit: no equilibrium beyond",
    SpeedLimit.NOT_REACHED: "end of the search",
}
ROWS = 12  # at most, of a course


def write_temperatures_plot(results: TemperatureResults, directory: Path) -> None:
    """Write `temperatures.png` into a folder; temperatures [degrees Celsius].

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.
    directory : Path
        Folder to write into.
    """
    write_figure(directory / "temperatures.png", partial(draw_temperatures, results=results))


def draw_temperatures(figure: Figure, results: TemperatureResults) -> None:
    """Balances over the speed with its limit, and the course from the start with the clearance.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : TemperatureResults
        Temperatures of the case.
    """
    document = temperatures_summary(results)
    figure.set_size_inches(PAGE_WIDTH, 3.8)
    figure.suptitle(results.title, fontsize=8.5)
    grid = figure.add_gridspec(2, 2, height_ratios=(3, 1))
    over_speed = figure.add_subplot(grid[:, 0])
    over_time = figure.add_subplot(grid[0, 1], sharey=over_speed)
    clearance = figure.add_subplot(grid[1, 1], sharex=over_time)
    _lines(over_speed, document["balances"], "speed_rpm", 1.0)
    over_speed.axvline(
        document["speed_rpm"], color="grey", linewidth=0.8, label="speed of the case"
    )
    limit = LIMIT.value(results)
    if limit is not None:
        fastest = FILM.value(results.branch.fastest.state)
        over_speed.plot([limit], [fastest], "kx", label=LIMITS[results.branch.limited_by])
    over_speed.set(xlabel=SPEED.label, ylabel="temperature [°C]")
    over_speed.set_xlim(left=0.0)
    figure.legend(*over_speed.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    course = document["warm_up"]["course"]
    _lines(over_time, course, "time_s", 1.0 / 60.0)
    over_time.tick_params(labelbottom=False)
    times = [row["time_s"] / 60.0 for row in course]
    clearance.plot(times, [row["clearance_um"] for row in course], "k", linewidth=1.0)
    clearance.set_ylabel("clearance [µm]")
    clearance.set_xlabel(f"time from the start, {document['speed_rpm']:.0f} r/min [min]")
    for axes in (over_speed, over_time, clearance):
        axes.grid(linewidth=0.3, alpha=0.5)


def _lines(axes: Axes, rows: list[dict[str, Any]], over: str, scale: float) -> None:
    places = [scale * row[over] for row in rows]
    for key, name, colour in LINES:
        axes.plot(places, [row[key] for row in rows], color=colour, linewidth=1.0, label=name)


def write_temperatures(results: TemperatureResults, directory: Path) -> tuple[str, ...]:
    """Write balances, course, data set, summary; pictures that failed are messages.

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    document = temperatures_summary(results)
    files = StudyFiles(
        kind="temperatures",
        document=document,
        tables={
            "balances": _table(document["balances"]),
            "warm_up": _table(document["warm_up"]["course"]),
        },
        variables=_variables(results),
    )
    return write_study(files, directory, lambda: write_temperatures_plot(results, directory))


def _table(rows: list[dict[str, float]]) -> CsvTable:
    return list(rows[0]), np.array([list(row.values()) for row in rows])


def _variables(results: TemperatureResults) -> Variables:
    """Temperatures of the nodes over `speed` [rad/s] and over `time` [s]."""
    balances = results.branch.balances
    warm = results.warm_up
    places = np.array([balance.speed for balance in balances])
    over_speed = np.stack([balance.state.temperatures for balance in balances])
    return {
        "node": (("node",), np.array(NODES, dtype=object), {}),
        "balance": (("balance",), np.arange(len(places)), {}),
        "speed": (("balance",), places, {"units": "rad/s"}),
        "temperature": (("balance", "node"), over_speed, KELVIN),
        "time": (("time",), warm.time, {"units": "s"}),
        "course": (("time", "node"), warm.temperatures, KELVIN),
        "clearance": (("time",), warm.clearance, {"units": "m"}),
    }


def temperatures_table(document: dict[str, Any]) -> Group:
    """Balances over the speed, and the course from the start, of a summary; [degrees Celsius].

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    titles = [title for title, _ in COLUMNS]
    course = document["warm_up"]["course"]
    course = [course[k] for k in evenly_chosen(len(course), ROWS)]
    limit = document["limiting_speed_rpm"]
    text = "none found" if limit is None else f"{limit:.0f} r/min ({document['limited_by']})"
    return titled(
        document["case"].get("title", ""),
        Text(f"limiting speed by heat: {text}"),
        Text("balances over the speed, °C", style="dim"),
        number_table(("r/min", *titles), _rows(document["balances"], "speed_rpm")),
        Text(f"from the start at {document['speed_rpm']:.0f} r/min, °C", style="dim"),
        number_table(("time s", *titles), _rows(course, "time_s")),
    )


def _rows(records: list[dict[str, Any]], first: str) -> list[list[str]]:
    keys = [key for _, key in COLUMNS]
    return [[f"{r[first]:.0f}", *(number(r[key]) for key in keys)] for r in records]

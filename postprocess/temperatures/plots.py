"""Figure of the temperatures over speed and over time."""

from functools import partial
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bearing.heating.over_speed import SpeedLimit

from ..plot_style import PAGE_WIDTH, write_figure
from .results import TemperatureResults
from .summary import FILM, LIMIT, SPEED, temperatures_summary

LINES = (  # key, name, colour
    ("film_temperature_C", "films", "#000000"),
    ("balls_temperature_C", "balls", "#c1440e"),
    ("inner_ring_temperature_C", "inner ring", "#1f4e8c"),
    ("outer_ring_loaded_temperature_C", "outer ring, loaded half", "#3a7d44"),
    ("oil_temperature_C", "oil", "#8a6d1d"),
    ("housing_temperature_C", "housing", "#7a4fa3"),
)


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
        fastest = results.branch.fastest
        word = (
            "turns back" if results.branch.limited_by is SpeedLimit.RUNAWAY else "end of the range"
        )
        over_speed.plot([limit], [FILM.value(fastest.state)], "kx", label=f"limit: {word}")
    over_speed.set_xlabel(SPEED.label)
    over_speed.set_ylabel("temperature [°C]")
    over_speed.set_xlim(left=0.0)
    over_speed.legend()
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

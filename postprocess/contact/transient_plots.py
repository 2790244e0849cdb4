"""Files of a contact over time: summary, series, fields, and its picture."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from oilfilm.ehl.transient.record import QUANTITIES, TransientSolution
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, from_si

from .. import plot_style
from ..files import SUMMARY_FILE, write_csv, write_json
from ..netcdf_write import FIELDS_FILE, DataGroup, Variables, root_attributes, write_groups
from .shown_part import SHOWN_INLET, SHOWN_OUTLET
from .transient_summary import TransientResults, transient_summary

HEIGHT = 6.2  # [in]
MILLISECOND = 1e-3  # [s]
LINES = 4  # times at which film and pressure along x are drawn
SPREAD = (2.0, 98.0)  # percentiles of the film in the contact that the colours span
MARGIN = 0.15  # of their span beyond them
SERIES_FILE = "steps.csv"
UNITS = {  # SI units of the series in netCDF, and their keys in CSV
    "time": ("s", "time_ms"),
    "speed": ("m/s", "speed_m_s"),
    "load": ("N", "load_N"),
    "film_force": ("N", "film_force_N"),
    "approach": ("m", "approach_um"),
    "approach_rate": ("m/s", "approach_rate_m_s"),
    "film_central": ("m", "film_central_um"),
    "film_minimum": ("m", "film_minimum_um"),
    "pressure_central": ("Pa", "pressure_central_GPa"),
    "pressure_maximum": ("Pa", "pressure_maximum_GPa"),
    "error": ("1", "step_error"),
    "oil_error": ("1", "oil_error"),
    "cycles": ("1", "cycles"),
}


def write_transient_plots(results: TransientResults, directory: Path) -> tuple[str, ...]:
    """Draw the run into the folder `plots`; a figure that failed is a message.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on figures that failed.
    """
    draw = partial(draw_transient, solution=results.solution, title=results.title)
    return plot_style.write_figures(directory, [("plots/transient", draw)])


def draw_transient(figure: Figure, solution: TransientSolution, title: str) -> None:
    """Film over x and time beside films and load over time, above lines along x.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    solution : TransientSolution
        Contact over time.
    title : str
        Title of the picture.
    """
    figure.set_size_inches(plot_style.PAGE_WIDTH, HEIGHT)
    figure.suptitle(title, fontsize=8.5)
    grid = figure.add_gridspec(3, 2, height_ratios=(1.0, 0.55, 1.0))
    _film_over_time(figure, figure.add_subplot(grid[:2, 0]), solution)
    _films(figure.add_subplot(grid[0, 1]), solution)
    _conditions(figure.add_subplot(grid[1, 1]), solution)
    for column, name in enumerate(("film", "pressure")):
        _lines(figure.add_subplot(grid[2, column]), solution, name)


def shown(solution: TransientSolution) -> Any:
    """Nodes along x that are drawn.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.

    Returns
    -------
    Any
        True at the nodes that are drawn, shape (nx,).
    """
    a = solution.semi_axes[0]
    return (solution.x >= SHOWN_INLET * a) & (solution.x <= SHOWN_OUTLET * a)


def film_span(solution: TransientSolution) -> tuple[float, float]:
    """Ends of the colours of films [um], by those inside the Hertz ellipse over all times.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.

    Returns
    -------
    tuple[float, float]
        Lower and upper end [um].
    """
    inside = np.abs(solution.x) < 0.9 * solution.semi_axes[0]
    films = solution.film_lines[:, inside] / MICROMETRE
    low, high = (float(value) for value in np.percentile(films, SPREAD))
    margin = MARGIN * max(high - low, 0.02 * high)
    return max(low - margin, 0.0), high + margin


def _film_over_time(figure: Figure, axes: Any, solution: TransientSolution) -> None:
    part = shown(solution)
    x = solution.x[part] / MILLIMETRE
    time = solution.series("time") / MILLISECOND
    low, high = film_span(solution)
    style: dict[str, Any] = {"cmap": plot_style.COLOUR_MAPS["film"], "vmin": low, "vmax": high}
    films = solution.film_lines[:, part] / MICROMETRE
    image = axes.pcolormesh(x, time, films, shading="nearest", rasterized=True, **style)
    figure.colorbar(image, ax=axes, location="top", label="film on $y$ = 0 [µm]", extend="max")
    for end in (-1.0, 1.0):
        place = end * solution.semi_axes[0] / MILLIMETRE
        axes.axvline(place, color="white", linestyle=(0, (4, 2)), linewidth=0.8)
    axes.xaxis.set_major_locator(MaxNLocator(6))
    axes.set(xlabel="x, along the entrainment [mm]; Hertz ellipse dashed", ylabel="time [ms]")


def _films(axes: Any, solution: TransientSolution) -> None:
    time = solution.series("time") / MILLISECOND
    for name, title, colour in (
        ("film_central", "centre", plot_style.INNER_COLOUR),
        ("film_minimum", "smallest", plot_style.OUTER_COLOUR),
    ):
        axes.plot(time, solution.series(name) / MICROMETRE, color=colour, label=title)
    axes.set_ylabel("film [µm]")
    axes.set_ylim(bottom=0.0)
    style = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": 2}
    axes.legend(**style)
    axes.tick_params(labelbottom=False)
    axes.grid(linewidth=0.3, alpha=0.5)


def _conditions(axes: Any, solution: TransientSolution) -> None:
    """Load, and what the film carries of it where that differs; the speed."""
    time = solution.series("time") / MILLISECOND
    load, force = solution.series("load"), solution.series("film_force")
    axes.plot(time, load, color=plot_style.INK, label="load", linewidth=1.0)
    if np.abs(force - load).max() > 0.01 * max(float(np.abs(force).max()), 1e-300):
        axes.plot(time, force, color=plot_style.OUTER_COLOUR, label="film force", linewidth=1.0)
    axes.set(ylabel="force [N]", xlabel="time [ms]")
    speed = axes.twinx()
    style = {"color": plot_style.REFERENCE, "linestyle": "--", "linewidth": 1.0}
    speed.plot(time, solution.series("speed"), label="speed", **style)
    speed.set_ylabel("$u_m$ [m/s]", color=plot_style.REFERENCE)
    handles = [*axes.get_legend_handles_labels()[0], *speed.get_legend_handles_labels()[0]]
    axes.legend(handles=handles, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def _lines(axes: Any, solution: TransientSolution, name: str) -> None:
    """Film or pressure on y = 0 at some times."""
    part = shown(solution)
    x = solution.x[part] / MILLIMETRE
    film = name == "film"
    unit = MICROMETRE if film else GIGAPASCAL
    lines = solution.film_lines if film else solution.pressure_lines
    time = solution.series("time") / MILLISECOND
    rows = np.unique(np.round(np.linspace(0, len(time) - 1, LINES)).astype(int))
    shades = np.linspace(0.85, 0.0, len(rows))
    for row, shade in zip(rows, shades, strict=True):
        label = f"{time[row]:.3g} ms"
        axes.plot(x, lines[row, part] / unit, color=_shade(shade), label=label, linewidth=1.0)
    axes.set(xlabel="x [mm], at $y$ = 0", ylabel="film [µm]" if film else "pressure [GPa]")
    if film:
        low, high = film_span(solution)
        axes.set_ylim(max(0.0, low - (high - low)), high + 0.5 * (high - low))
        return
    axes.legend(fontsize=6.5)


def _shade(share: float) -> tuple[float, float, float]:
    """From ink to pale blue [-]."""
    return (0.05 + 0.6 * share, 0.1 + 0.65 * share, 0.2 + 0.75 * share)


def write_transient(
    results: TransientResults, directory: Path, is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write series, fields, summary and pictures.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.
    directory : Path
        Folder to write into.
    is_interrupted : Callable[[], bool], default lambda: False
        Once it is true no picture is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    directory.mkdir(parents=True, exist_ok=True)
    document = transient_summary(results)
    solution = results.solution
    keys = [UNITS[name][1] for name in QUANTITIES]
    columns = [
        from_si(key, solution.series(name)).tolist()
        for name, key in zip(QUANTITIES, keys, strict=True)
    ]
    write_csv(directory / SERIES_FILE, keys, zip(*columns, strict=True))
    write_transient_netcdf(results, directory / FIELDS_FILE, document)
    write_json(document, directory / SUMMARY_FILE)
    return () if is_interrupted() else write_transient_plots(results, directory)


def write_transient_netcdf(
    results: TransientResults, path: Path, document: dict[str, Any]
) -> None:
    """Write all steps and the fields kept, SI; fields of y >= 0 where they are even in y.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.
    path : Path
        File to write.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    solution = results.solution
    about: dict[str, Any] = {"units": "m"}
    variables: Variables = {
        name: (("time",), solution.series(name), {"units": UNITS[name][0]}) for name in QUANTITIES
    }
    variables |= {
        "x": (("x",), solution.x, about | {"long_name": "along the entrainment"}),
        "y": (("y",), solution.y, about | {"long_name": "across the entrainment"}),
        "film_line": (("time", "x"), solution.film_lines.astype(np.float32), about),
        "pressure_line": (
            ("time", "x"),
            solution.pressure_lines.astype(np.float32),
            {"units": "Pa"},
        ),
        **_frames(solution),
    }
    attributes = root_attributes(document, "transient") | {
        "half": int(solution.symmetric),
        "semi_axis_x": solution.semi_axes[0],
        "semi_axis_y": solution.semi_axes[1],
        "hertz_pressure": solution.hertz_pressure,
    }
    write_groups({"/": DataGroup(variables=variables, attributes=attributes)}, path)


def _frames(solution: TransientSolution) -> Variables:
    """Fields kept, over frames, y and x."""
    plane = ("frame", "y", "x")
    named = {
        "P": ("pressure", {"units": "Pa"}),
        "h": ("film", {"units": "m"}),
        "filled": ("filled", {"units": "1", "long_name": "share of the gap filled with oil"}),
    }
    fields: Variables = {
        name: (
            plane,
            np.array([getattr(frame, source) for frame in solution.frames], dtype=np.float32),
            attributes,
        )
        for name, (source, attributes) in named.items()
    }
    times = np.array([frame.time for frame in solution.frames])
    return fields | {"frame_time": (("frame",), times, {"units": "s"})}

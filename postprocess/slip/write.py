"""Files, pictures and table of slip maps."""

from collections.abc import Callable
from functools import partial
from math import degrees
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, TwoSlopeNorm
from matplotlib.figure import Figure
from rich.console import Group
from rich.table import Table
from rich.text import Text

from oilfilm.bearing.studies.slip import CriticalCurves
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si, unit_symbol

from ..bearing.bearing_quantities import BALL_QUANTITY
from ..files import CsvTable
from ..netcdf_write import SPEED_COLUMN, StudyFiles, Variables, write_study
from ..plot_style import INK, INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE, write_figure
from ..quantities import evenly_chosen, number, number_table, titled
from .results import (
    AXIAL_LOAD,
    RADIAL_LOAD,
    SLIP_FACTOR,
    SPEED,
    WORST_FACTOR,
    SlipResults,
    ball_values,
    slip_summary,
)

# values of the contour lines, limit 10 [-]
LEVELS = np.array([0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0])
DEEPEST = 0.01  # of the limit: where the colours end [-]
MOST_TICKS = 12  # azimuths that are named [-]
NO_LOAD = 1e-3  # slip factor that counts as none [-]
UNLOADED = "#c9ced4"  # where a ball carries no load at the inner race
SAME_CURVE_RTOL = 1.0e-6  # relative difference below which two balls have one curve [-]
LOAD_STYLES: dict[str, Any] = {
    "hirano_N": {"color": INNER_COLOUR, "linewidth": 1.8},
    "as_printed_N": {"color": OUTER_COLOUR, "linestyle": "--"},
    "skf_axial_N": {"color": REFERENCE, "linestyle": "-."},
    "skf_radial_N": {"color": REFERENCE, "linestyle": ":"},
}
DIGITS = ".9g"  # of numbers in tables
SPEED_UNIT, LOAD, FACTOR = ({"units": unit} for unit in ("rad/s", "N", "1"))
MOST_ROWS = 11  # speeds listed
STYLE: dict[str, Any] = {"padding": (0, 2, 0, 0), "collapse_padding": True}
COLUMNS = {  # of the balls, with the format of their numbers
    "azimuth_deg": ".1f",
    "inner_load_N": ".1f",
    "inner_contact_angle_deg": ".2f",
    "centrifugal_force_N": ".2f",
}


def write_slip_plots(results: SlipResults, directory: Path) -> None:
    """Write the pictures of slip maps; critical_loads.png if these were computed.

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.
    directory : Path
        Folder to write into.
    """
    drawings = {
        "slip_factors": draw_surface,
        "minimum_preload": draw_minimum_loads,
        "slip_per_ball": draw_balls,
        "critical_loads": draw_critical_loads,
    }
    if not results.curves:
        del drawings["critical_loads"]
    for name, draw in drawings.items():
        write_figure(directory / f"{name}.png", partial(_titled, draw=draw, results=results))


def _titled(
    figure: Figure, draw: Callable[[Figure, SlipResults], None], results: SlipResults
) -> None:
    draw(figure, results)
    figure.suptitle(results.title, fontsize=8.5)


def draw_surface(figure: Figure, results: SlipResults) -> None:
    """Slip factor of the worst ball over speed [r/min] and axial load [N], heavy at the limit.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : SlipResults
        Slip maps of the case.
    """
    figure.set_size_inches(0.72 * PAGE_WIDTH, 4.0)
    axes: Axes = figure.subplots()
    surface = results.surface
    factors = np.log10(np.clip(surface.minimum.T / results.limit, DEEPEST, 1.0 / DEEPEST))
    shown = np.ma.masked_invalid(factors)
    x = SPEED.in_unit(surface.speeds)
    y = surface.axial_loads
    # the ends are too dark
    reach = 1.25 * max(float(np.ma.max(np.ma.abs(shown))), 0.1) if shown.count() else 1.0
    norm = TwoSlopeNorm(0.0, -reach, reach)
    image = axes.pcolormesh(x, y, shown, cmap="RdBu", norm=norm, shading="gouraud")
    unloaded = np.ma.masked_where(~(surface.minimum.T < NO_LOAD), np.ones_like(factors))
    axes.pcolormesh(x, y, unloaded, cmap=ListedColormap([UNLOADED]), shading="nearest", zorder=1.5)
    levels = LEVELS * results.limit / 10.0
    if shown.count():
        thin = [v for v in np.log10(levels / results.limit) if v != 0.0]
        style: Any = {"colors": INK, "linewidths": 0.5, "linestyles": "solid"}
        lines = axes.contour(x, y, shown, levels=thin, **style)
        axes.clabel(lines, fmt={v: f"{results.limit * 10.0**v:.3g}" for v in thin}, fontsize=6.5)
    _limit_line(axes, results)
    bar = figure.colorbar(image, ax=axes, label=WORST_FACTOR.label, aspect=30)
    ticks = [v for v in np.log10(levels / results.limit) if -reach <= v <= reach]
    bar.set_ticks(ticks, labels=[f"{results.limit * 10.0**v:.3g}" for v in ticks])
    if shown.count():
        bar.ax.set_ylim(min(float(shown.min()), -0.05), max(float(shown.max()), 0.05))
    axes.set(xlabel=SPEED.label, ylabel=AXIAL_LOAD.label)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))


def _limit_line(axes: Axes, results: SlipResults) -> None:
    """The minimum preload over speed, where the worst ball's factor is the limit."""
    minimum = results.minimum
    grid = slice(0, minimum.count)
    speeds = SPEED.in_unit(minimum.speeds[grid])
    axes.plot(speeds, minimum.hirano[grid], color=INK, linewidth=2.0)
    top = results.surface.axial_loads[-1]
    note = f"heavy line: factor {results.limit:g}; no ball slips above it"
    if not (minimum.hirano[grid] <= top).any():
        unreached = f"factor {results.limit:g} is not reached at these loads"
        note = f"{unreached}: some ball slips everywhere"
    if (results.surface.minimum < NO_LOAD).any():
        note += "\ngrey: a ball carries no load at the inner race"
    if results.surface.unsolved:
        note += "\nwhite: no equilibrium"
    axes.set_title(note, fontsize=7.0, color=REFERENCE)


def ball_groups(curve: CriticalCurves) -> dict[tuple[int, ...], Array]:
    """Critical axial loads of the balls whose curves are the same.

    Parameters
    ----------
    curve : CriticalCurves
        Critical loads of all balls at one speed.

    Returns
    -------
    dict[tuple[int, ...], Array]
        Loads by the numbers of the balls, from 1, shape (n,) [N].
    """
    groups: dict[tuple[int, ...], Array] = {}
    for ball, loads in enumerate(curve.axial_loads.T, 1):
        for members, available in groups.items():
            if np.allclose(loads, available, rtol=SAME_CURVE_RTOL, atol=0.0, equal_nan=True):
                groups[(*members, ball)] = groups.pop(members)
                break
        else:
            groups[(ball,)] = loads
    return dict(sorted(groups.items()))


def draw_critical_loads(figure: Figure, results: SlipResults) -> None:
    """Axial and radial load [N] at which each ball just slips; right of its curve it does not.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : SlipResults
        Slip maps of the case.
    """
    figure.set_size_inches(PAGE_WIDTH, 3.4)
    panels: Any = figure.subplots(1, len(results.curves), squeeze=False, sharey=True)
    azimuths = results.state.azimuth
    for axes, curve in zip(panels[0], results.curves, strict=True):
        groups = ball_groups(curve)
        colours = mpl.colormaps["viridis"](np.linspace(0.0, 0.88, len(groups)))
        for colour, (members, loads) in zip(colours, groups.items(), strict=True):
            angles = (degrees(azimuths[m - 1]) % 360.0 for m in members)
            smallest = min(round(min(a, 360.0 - a), 1) for a in angles)
            label = f"{', '.join(map(str, members))}  ({smallest:g}°)"
            axes.plot(loads, curve.radial_loads, color=colour, label=label)
        worst = curve.axial_loads.max(axis=1)
        end = max(float(np.nanmax(worst)) * 1.08, 1.0)
        style: Any = {"color": INNER_COLOUR, "alpha": 0.08, "lw": 0}
        axes.fill_betweenx(curve.radial_loads, worst, end, **style)
        axes.set_title(f"{from_si('speed_rpm', curve.speed):.0f} r/min")
        axes.set_xlabel(AXIAL_LOAD.label)
        axes.set(xlim=(0.0, end), ylim=(curve.radial_loads[0], curve.radial_loads[-1]))
    panels[0, 0].set_ylabel(RADIAL_LOAD.label)
    beside: Any = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5), "title_fontsize": 7}
    panels[0, -1].legend(title="ball (from load line)", **beside)
    note = "each line: slip factor of that ball at the limit; shaded: no ball slips"
    figure.supxlabel(note, fontsize=7)


def draw_minimum_loads(figure: Figure, results: SlipResults) -> None:
    """Minimum preload [N] over speed [r/min], with the catalogue's minimum loads.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : SlipResults
        Slip maps of the case.
    """
    figure.set_size_inches(0.72 * PAGE_WIDTH, 3.6)
    axes: Axes = figure.subplots()
    minimum = results.minimum
    x = SPEED.in_unit(minimum.speeds)
    grid = slice(0, minimum.count)
    for load, values in minimum.given():
        limit = f", factor {results.limit:g}" if load.key == "hirano_N" else ""
        axes.plot(x[grid], values[grid], label=load.title + limit, **LOAD_STYLES[load.key])
    if minimum.own and np.isfinite(minimum.hirano[-1]):
        at = x[-1], minimum.hirano[-1]
        axes.plot(*at, "o", color=INNER_COLOUR, markersize=4)
        style: Any = {"textcoords": "offset points", "ha": "right", "fontsize": 7}
        axes.annotate(f"{at[1]:.0f} N", at, xytext=(-6, 3), **style)
    axes.set(xlabel=SPEED.label, ylabel="minimum load [N]")
    axes.set_xlim(x[0], x[minimum.count - 1])
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper left")


def draw_balls(figure: Figure, results: SlipResults) -> None:
    """Slip factor of every ball at the case's own operation, over its azimuth [deg].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : SlipResults
        Slip maps of the case.
    """
    figure.set_size_inches(0.72 * PAGE_WIDTH, 3.2)
    axes: Axes = figure.subplots()
    factors = results.factors
    azimuths = np.degrees(results.state.azimuth) % 360.0
    finite = np.where(np.isfinite(factors), factors, 0.0)
    _ball_bars(axes, azimuths, finite, factors < results.limit)
    if results.printed_force is not None:
        style: Any = {"markersize": 4, "markerfacecolor": "none", "color": INK}
        label = "with half the force, as printed"
        axes.plot(azimuths, finite / results.printed_force, "D", label=label, **style)
    style = {"color": INK, "linewidth": 1.0, "linestyle": "--"}
    axes.axhline(results.limit, label=f"limit {results.limit:g}", **style)
    axes.set(xlabel=BALL_QUANTITY["azimuth_deg"].label, ylabel=SLIP_FACTOR.label)
    every = -(-len(azimuths) // MOST_TICKS)
    axes.set_xticks(azimuths[::every], [f"{a:.4g}" for a in azimuths[::every]])
    highest = float(finite.max()) / (results.printed_force or 1.0)
    lowest = min(finite[finite > NO_LOAD].min(initial=np.inf), results.limit)
    axes.set_yscale("log")
    # a bar of the lowest factor still has a height
    axes.set_ylim(0.4 * lowest, 3.0 * max(results.limit, highest))
    axes.yaxis.set_major_formatter("{x:g}")
    x, y, _ = results.state.ring_force
    speed = from_si("speed_rpm", results.state.operation.inner_speed)
    title = f"{speed:.0f} r/min, axial {round(x) + 0:d} N, radial {round(y) + 0:d} N"
    axes.set_title(title, fontsize=7.0, color=REFERENCE)
    axes.legend(loc="upper right", ncols=3, columnspacing=1.2)


def _ball_bars(axes: Axes, azimuths: Array, factors: Array, slips: Any) -> None:
    """Bars of the balls that slip and of those that do not; "none" where there is no bar."""
    width = 0.6 * 360.0 / len(factors)
    for label, colour in (("slips", OUTER_COLOUR), ("does not slip", INNER_COLOUR)):
        chosen = slips if label == "slips" else ~slips
        if chosen.any():
            axes.bar(azimuths[chosen], factors[chosen], width=width, color=colour, label=label)
    style: Any = {"textcoords": "offset points", "ha": "center", "fontsize": 6.5}
    style |= {"xycoords": axes.get_xaxis_transform(), "color": REFERENCE}
    for azimuth in azimuths[~(factors > NO_LOAD)]:
        axes.annotate("no\nload", (azimuth, 0.0), xytext=(0, 2), **style)


def write_slip(results: SlipResults, directory: str | Path) -> tuple[str, ...]:
    """Write pictures, tables and, last, the summary; pictures that failed are messages.

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.
    directory : str | Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    folder = Path(directory)
    files = StudyFiles(
        kind="slip",
        document=slip_summary(results),
        tables=_tables(results),
        variables=_variables(results),
        attributes={"limit": results.limit},
        number=DIGITS,
    )
    return write_study(files, folder, lambda: write_slip_plots(results, folder))


def _tables(results: SlipResults) -> dict[str, CsvTable]:
    surface = results.surface
    minimum = results.minimum
    balls = [f"ball {ball + 1}" for ball in range(results.state.bearing.balls)]
    factors = [f"slip factor of {ball} [-]" for ball in balls]
    header = [SPEED_COLUMN, AXIAL_LOAD.header, WORST_FACTOR.header, *factors]
    rows: list[Any] = [
        [from_si("speed_rpm", speed), load, surface.minimum[i, k], *surface.factors[i, k]]
        for i, speed in enumerate(surface.speeds)
        for k, load in enumerate(surface.axial_loads)
    ]
    tables: dict[str, CsvTable] = {"slip_factors": (header, rows)}
    rows = [
        [from_si("speed_rpm", curve.speed), radial, *loads]
        for curve in results.curves
        for radial, loads in zip(curve.radial_loads, curve.axial_loads, strict=True)
    ]
    if rows:
        header = [SPEED_COLUMN, RADIAL_LOAD.header, *(f"axial load of {b} [N]" for b in balls)]
        tables["critical_loads"] = header, rows
    loads = minimum.given()
    header = [SPEED_COLUMN, *(f"{load.source} [N]" for load, _ in loads)]
    speeds = from_si("speeds_rpm", minimum.speeds)
    columns = np.column_stack([speeds, *(values for _, values in loads)])
    return tables | {"minimum_loads": (header, columns.tolist())}


def _variables(results: SlipResults) -> Variables:
    """Slip factors [-] over speed [rad/s], axial load [N] and ball; minimum and critical loads."""
    surface = results.surface
    state = results.state
    minimum = results.minimum
    variables: Variables = {
        "speed": (("speed",), surface.speeds, SPEED_UNIT),
        "axial_load": (("axial_load",), surface.axial_loads, LOAD),
        "ball": (("ball",), np.arange(1, state.bearing.balls + 1), {}),
        "slip_factor": (("speed", "axial_load", "ball"), surface.factors, FACTOR),
        "operation_slip_factor": (("ball",), results.factors, FACTOR),
        "minimum_speed": (("minimum_speed",), minimum.speeds, SPEED_UNIT),
    }
    for name in ("inner_load", "centrifugal_force"):
        values = np.asarray(getattr(state, name), dtype=float)
        variables[f"operation_{name}"] = (("ball",), values, LOAD)
    for load, values in minimum.given():
        variables[f"minimum_load_{load.source}"] = (("minimum_speed",), values, LOAD)
    if results.curves:
        over = ("critical_speed", "critical_radial_load")
        speeds = np.array([curve.speed for curve in results.curves])
        variables |= {
            over[0]: (over[:1], speeds, SPEED_UNIT),
            over[1]: (over[1:], np.asarray(results.curves[0].radial_loads), LOAD),
            "critical_axial_load": (
                *((*over, "ball"), np.stack([curve.axial_loads for curve in results.curves])),
                LOAD,
            ),
        }
    return variables


def slip_table(results: SlipResults) -> Group:
    """The balls at the case's operation and the minimum loads [N] over speed [r/min].

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    Group
        The tables.
    """
    fx, fy, _ = results.state.ring_force
    speed = from_si("speed_rpm", results.state.operation.inner_speed)
    own = (
        f"At {speed:.0f} r/min, axial {fx:.1f} N, radial {fy:.1f} N; a ball slips below "
        f"{results.limit:g}:"
    )
    return titled(
        results.title,
        Text(own.replace("-0.0 N", "0.0 N")),
        _balls_table(results),
        Text("Minimum loads over speed (axial, but for the radial load of the last column), N:"),
        _loads_table(results),
    )


def _balls_table(results: SlipResults) -> Table:
    printed = results.printed_force is not None
    factors = ("slip_factor", *["slip_factor_as_printed"] * printed)
    rows = []
    for ball in ball_values(results):
        ball["azimuth_deg"] %= 360.0
        cells = [f"{ball[key]:{digits}}" for key, digits in COLUMNS.items()]
        cells += [number(ball[key], ".3f") for key in factors]
        rows.append([str(ball["ball"]), *cells, "slips" if ball["slips"] else ""])
    headers = ["ball", *(f"{BALL_QUANTITY[key].symbol} {unit_symbol(key)}" for key in COLUMNS)]
    headers += [SLIP_FACTOR.symbol, *["as printed"] * printed, ""]
    return number_table(headers, rows, **STYLE)


def _loads_table(results: SlipResults) -> Table:
    minimum = results.minimum
    loads = minimum.given()
    count = minimum.count
    chosen = evenly_chosen(count, MOST_ROWS)
    speeds = from_si("speeds_rpm", minimum.speeds)
    rows = [
        [
            f"{speeds[index]:.0f}" + (" *" if index == count else ""),
            *(number(float(values[index]), ".1f") for _, values in loads),
        ]
        for index in (*chosen, *([count] if minimum.own else []))
    ]
    table = number_table(["r/min", *(load.symbol for load, _ in loads)], rows, **STYLE)
    if minimum.own:
        table.caption = "* the case's own speed"
    return table

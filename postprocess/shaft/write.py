"""Files, pictures and table of a shaft on bearings."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from rich.console import Group
from rich.text import Text

from oilfilm.ehl.units import from_si

from ..bearing.results import BearingResults
from ..netcdf_write import StudyFiles, write_study
from ..plot_style import titled_panels, write_figure
from ..quantities import number, number_table, titled
from .results import (
    AMPLITUDE,
    CRITICAL,
    DEFLECTION,
    POSITION,
    SPEED,
    WHIRL,
    ShaftResults,
    shaft_columns,
    shaft_summary,
    shaft_variables,
)

HEADERS = ("bearing", "x mm", "F_x N", "F_y", "F_z", "mrad", "h_min µm", "N mm", "life h")
ROUND_OFF = 1.0e-6  # of the largest force: smaller ones are shown as zero [-]
BEARING_COLOUR = "#1f4e8c"
LOAD_COLOUR = "#c1440e"


def write_shaft_plots(results: ShaftResults, directory: Path) -> None:
    """Write `shaft.png`, and `campbell.png` where there are frequencies.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.
    directory : Path
        Folder to write into.
    """
    write_figure(directory / "shaft.png", partial(draw_shaft, results=results))
    if results.vibration is not None:
        write_figure(directory / "campbell.png", partial(draw_campbell, results=results))


def draw_shaft(figure: Figure, results: ShaftResults) -> None:
    """Draw the stepped shaft with its bearings and loads, and its deflection below.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : ShaftResults
        Results of the shaft.
    """
    above, below = titled_panels(figure, results.title, 4.6, 2, 1, sharex=True)
    _outline(above, results)
    solution = results.solution
    x = POSITION.value(solution)
    for column, axis in enumerate("yz", start=1):
        values = DEFLECTION.in_unit(solution.displacement[:, column])
        below.plot(x, values, marker="o", markersize=3, label=f"along {axis}")
    below.axhline(0.0, linewidth=0.5, color="0.5")
    below.set(xlabel=POSITION.label, ylabel=DEFLECTION.label)
    below.grid(linewidth=0.3, alpha=0.5)
    below.legend()


def _outline(axes: Axes, results: ShaftResults) -> None:
    """Longitudinal section of the shaft, bearings as boxes, forces as arrows."""
    system = results.solution.system
    radius = 0.0
    for section in system.sections:
        left = from_si("x_mm", section.start)
        width = from_si("x_mm", section.end - section.start)
        half = 0.5 * from_si("x_mm", section.outside_diameter)
        hole = 0.5 * from_si("x_mm", section.inside_diameter)
        radius = max(radius, half)
        for low in (hole, -half):
            box = Rectangle((left, low), width, half - hole, facecolor="0.85", edgecolor="0.4")
            axes.add_patch(box)
    for name, support in zip(results.names, system.supports, strict=True):
        bearing = support.bearing
        half = 0.5 * from_si("x_mm", bearing.pitch_diameter)
        ball = from_si("x_mm", bearing.ball_diameter)
        x = from_si("x_mm", support.position)
        radius = max(radius, half + ball)
        for low in (half - 0.5 * ball, -half - 0.5 * ball):
            box = Rectangle(
                (x - 0.5 * ball, low), ball, ball, fill=False, edgecolor=BEARING_COLOUR
            )
            axes.add_patch(box)
        text = f"{name}\n{support.location.value}"
        axes.annotate(text, (x, -1.6 * radius), ha="center", va="top", fontsize=7)
    for spring in system.springs:
        x = from_si("x_mm", spring.position)
        axes.plot((x, x), (-1.5 * radius, 0.0), ":", color=BEARING_COLOUR)
        axes.annotate(spring.name, (x, -1.6 * radius), ha="center", va="top", fontsize=7)
    for load in system.loads:
        force = (load.force[1] ** 2 + load.force[2] ** 2) ** 0.5
        x = from_si("x_mm", load.position)
        down = load.force[1] <= 0.0
        tip, tail = (radius, 2.0 * radius) if down else (-radius, -2.0 * radius)
        words = [f"{force:.4g} N"] if force else []
        words += [f"{load.mass:.3g} kg"] if load.mass else []
        arrow = {"arrowstyle": "->" if force else "-", "color": LOAD_COLOUR}
        axes.annotate(
            "\n".join(words),
            (x, tip),
            (x, tail),
            ha="center",
            va="bottom" if down else "top",
            fontsize=7,
            color=LOAD_COLOUR,
            arrowprops=arrow,
        )
    end = POSITION.in_unit(system.sections[-1].end)
    axes.set(xlim=(-0.05 * end, 1.05 * end), ylim=(-3.2 * radius, 2.9 * radius), ylabel="r [mm]")


def draw_campbell(figure: Figure, results: ShaftResults) -> None:
    """Draw natural frequencies over the speed, the line of the shaft's own, critical speeds.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : ShaftResults
        With vibration.
    """
    moving = results.vibration
    assert moving is not None
    axes = titled_panels(figure, results.title, 3.6)
    speeds = SPEED.value(moving)
    axes.plot(speeds, WHIRL.in_unit(moving.whirl), color=BEARING_COLOUR, linewidth=1.2)
    axes.plot(speeds, speeds / 60.0, "--", color="0.4", label="frequency of the shaft")
    operating = from_si("speed_rpm", abs(results.solution.system.speed))
    axes.axvline(operating, color=LOAD_COLOUR, linewidth=1.0, label="operating speed")
    axes.set(xlabel=SPEED.label, ylabel=WHIRL.label, xlim=(0.0, speeds[-1]))
    axes.set_ylim(bottom=0.0)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend()


def write_shaft(
    results: ShaftResults,
    directory: Path,
    write_scene: Callable[[ShaftResults, Path], object] | None = None,
) -> tuple[str, ...]:
    """Write deflection, frequencies, data set, scene, summary; pictures that failed are messages.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.
    directory : Path
        Folder to write into.
    write_scene : callable, optional
        Writes the files of a scene, as `scene.vtk.write_shaft_collection`.

    Returns
    -------
    tuple of str
        Messages on pictures that failed.
    """
    files = StudyFiles(
        kind="shaft",
        document=shaft_summary(results),
        tables=shaft_columns(results),
        variables=shaft_variables(results),
    )

    def draw() -> None:
        write_shaft_plots(results, directory)
        if write_scene is not None:
            write_scene(results, directory)

    return write_study(files, directory, draw)


def shaft_table(results: ShaftResults) -> Group:
    """Bearings with their loads, films, torques and lives; critical speeds.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.

    Returns
    -------
    Group
        The table.
    """
    rows = []
    for k, (name, bearing) in enumerate(zip(results.names, results.bearings, strict=True)):
        state = results.solution.bearings[k]
        place = POSITION.in_unit(results.solution.system.supports[k].position)
        least = ROUND_OFF * abs(state.ring_force).max()
        forces = [float(f) if abs(f) > least else 0.0 for f in state.ring_force]
        force = [f"{from_si('force_N', f):.0f}" for f in forces]
        tilt = number(float(from_si("tilt_mrad", (state.tilt @ state.tilt) ** 0.5)))
        rows.append([name, number(place), *force, tilt, *_bearing_cells(bearing)])
    lines = []
    system = results.solution.system
    for spring, load in zip(system.springs, results.solution.spring_loads, strict=True):
        carried = ", ".join(f"{from_si('force_N', float(f)):.0f}" for f in load[:3])
        place = number(POSITION.in_unit(spring.position))
        lines.append(Text(f"spring {spring.name} at {place} mm: {carried} N", style="dim"))
    moving = results.vibration
    if moving is not None and moving.critical.size:
        speeds = ", ".join(f"{speed:.0f}" for speed in CRITICAL.in_unit(moving.critical))
        lines.append(Text(f"critical speeds {speeds} r/min", style="dim"))
    if moving is not None and moving.response is not None:
        largest = float(abs(moving.response[:, 1:3]).max())
        text = f"largest amplitude by unbalance {number(AMPLITUDE.in_unit(largest))} µm"
        lines.append(Text(text, style="dim"))
    if results.heat is not None:
        films = [one.state.film_temperature for one in results.heat.bearings if one.state]
        words = ", ".join(f"{from_si('temperature_C', film):.0f}" for film in films)
        lines.append(Text(f"films at {words} °C, where friction and cooling agree"))
    torque = results.torque
    life = results.modified_life or results.basic_life
    if torque is not None:
        lines.append(Text(f"torque of all bearings {number(from_si('torque_N_mm', torque))} N mm"))
    if life is not None:
        lines.append(Text(f"life of the system {from_si('life_h', life):.0f} h"))
    units = Text(
        "force of the shaft on the bearing, tilt, least film, friction torque", style="dim"
    )
    return titled(results.title, units, number_table(HEADERS, rows), *lines)


def _bearing_cells(bearing: BearingResults | None) -> list[str]:
    """Least film, torque and life of one bearing."""
    if bearing is None:
        return ["–"] * 3
    films = [film.minimum.value for film in bearing.operating if film and film.minimum]
    torque = bearing.torque and bearing.torque.total
    life = bearing.life and (bearing.life.modified_life_time or bearing.life.basic_life_time)
    return [
        number(from_si("film_um", min(films))) if films else "–",
        "–" if torque is None else number(from_si("torque_N_mm", torque)),
        "–" if life is None else f"{from_si('life_h', life):.0f}",
    ]

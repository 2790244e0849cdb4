"""Files of a time simulation, and its pictures from history and summary."""

import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator, MultipleLocator

from oilfilm.bearing.dynamics.choices import Integration
from oilfilm.bearing.dynamics.statistics import INPUTS, LOSSES

from .. import plot_style
from ..files import SUMMARY_FILE, write_json
from ..quantities import FREQUENCIES
from .history import HISTORY_FILE
from .read import averaged, open_history, simulated_speeds
from .results import PLOTTED, STATES, DynamicsResults, dynamics_summary

RACES = (("inner", plot_style.INNER_COLOUR), ("outer", plot_style.OUTER_COLOUR))
STATE_COLOURS = ("#ffffff", "#7fa8d1", "#c1440e")  # free, contact, impact
MECHANISM_COLOURS = (
    "#0b5394 #c1440e #3a7d44 #7a4fa3 #8a6d1d #5b8c00 #1f9e9e #b8336a #666666 #d98c00".split()
)
TIME = PLOTTED["time_ms"]
SPEED = PLOTTED["speed_rpm"]
ROLLING: dict[str, Any] = {
    "linestyle": "--",
    "color": plot_style.REFERENCE,
    "label": "without sliding",
}
SHOWN_TURNS = 2.0  # turns of the cage in the pictures of one ball [-]
SPIKES = 0.01  # share of the time at each end of an axis that may lie beyond it [-]
ORBIT_POINTS = 4000  # of an orbit, the last ones
SMALLEST_LOAD = 1.0e-2  # of the largest one; below, a traction factor says nothing [-]
ROUND_ORBIT = 1e-3  # smaller over larger extent of an orbit below which it is a line [-]
SPECTRUM_REACH = 6.0  # highest frequency shown over the ball pass frequency of the inner ring [-]
FEWEST_SAMPLES = 8  # of the half that a spectrum is of [-]


def write_dynamics(
    results: DynamicsResults, directory: Path, is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write summary, history and pictures.

    Parameters
    ----------
    results : DynamicsResults
        Results of the simulation.
    directory : Path
        Folder to write into.
    is_interrupted : Callable[[], bool], default lambda: False
        Asked before each picture; once it is true no further one is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    directory.mkdir(parents=True, exist_ok=True)
    document = dynamics_summary(results)
    write_json(document, directory / SUMMARY_FILE)
    shutil.move(results.history, directory / HISTORY_FILE)
    if not results.running.rows or is_interrupted():
        return ()
    return write_dynamics_plots(directory, document, is_interrupted)


def write_dynamics_plots(
    directory: Path, document: dict[str, Any], is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write the pictures of a simulation beside its history.

    Parameters
    ----------
    directory : Path
        Folder of the history.
    document : dict[str, Any]
        Summary of the results in named units.
    is_interrupted : Callable[[], bool], default lambda: False
        Asked before each picture; once it is true no further one is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    with open_history(directory).load() as data:
        given = {"data": data, "document": document}
        vibrates = document["integration"] == Integration.EXPLICIT.value
        names = [name for name in PICTURES if vibrates or name not in OF_VIBRATION]
        drawings = [(name, partial(PICTURES[name], **given)) for name in names]
        return plot_style.write_figures(directory, drawings, is_interrupted)


def draw_speeds(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Cage and balls about the axis [r/min] over time [ms], and their slip [%].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    result = simulated_speeds(data, document)
    panels = _three_panels(figure, document)
    time = TIME.in_unit(data["time"].to_numpy())
    late = averaged(data)
    orbit, cage = (SPEED.in_unit(motion.speed) for motion in (result.orbit, result.cage))
    rolling = SPEED.in_unit(result.cage.without_slip)
    top = panels[0]
    _all_balls(top, time, orbit)
    top.plot(time, cage, color=plot_style.CAGE_COLOUR, label="cage")
    top.plot(time, rolling, **ROLLING)
    top.set_ylabel(SPEED.label)
    top.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    _without_spikes(top, cage, orbit.min(axis=1), orbit.max(axis=1), rolling)
    slips = [100.0 * motion.slip for motion in (result.orbit, result.cage)]
    for ax, part in zip(panels[1:], (slice(None), late), strict=True):
        balls, held = (slip[part] for slip in slips)
        _all_balls(ax, time[part], balls)
        ax.plot(time[part], held, color=plot_style.CAGE_COLOUR)
        ax.axhline(0.0, color=plot_style.REFERENCE, linewidth=0.6)
        from_zero = (np.zeros(1),) if ax is panels[1] else ()
        _without_spikes(ax, held, balls.min(axis=1), balls.max(axis=1), *from_zero)
    _mean_of_part(panels, time[late], document["cage_slip_ratio"], "slip of cage\nand balls [%]")


def draw_spin(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Balls about their own axes [r/min] over time [ms], and their slip against rolling [%].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    spin = simulated_speeds(data, document).spin
    panels = _three_panels(figure, document)
    time = TIME.in_unit(data["time"].to_numpy())
    late = averaged(data)
    turning, rolling = (SPEED.in_unit(speed) for speed in spin)
    top = panels[0]
    _all_balls(top, time, turning)
    top.plot(time, rolling, **ROLLING)
    top.set_ylabel(PLOTTED["spin_speed_rpm"].label)
    top.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    _without_spikes(top, turning.min(axis=1), turning.max(axis=1), rolling)
    for ax, part in zip(panels[1:], (slice(None), late), strict=True):
        slip = 100.0 * spin.slip[part]
        _all_balls(ax, time[part], slip)
        ax.axhline(0.0, color=plot_style.REFERENCE, linewidth=0.6)
        _without_spikes(ax, slip.min(axis=1), slip.max(axis=1))
    available = spin.slip[late]
    mean = float(available.mean()) if np.isfinite(available).all() else None
    _mean_of_part(panels, time[late], mean, "spin that balls\nlack [%]")


def _three_panels(figure: Figure, document: dict[str, Any]) -> Any:
    """Panels over the time [ms], the upper two over all of it."""
    panels = _start(figure, document, (3, 1), 6.4)
    panels[0].sharex(panels[1])
    panels[0].tick_params(labelbottom=False)
    panels[2].set_xlabel(TIME.label)
    return panels


def _all_balls(axes: Any, time: Any, values: Any) -> None:
    """Mean and range of the balls, whose values have the shape (m, Z)."""
    style: dict[str, Any] = {"color": plot_style.BALL_COLOUR, "alpha": 0.25, "linewidth": 0}
    axes.fill_between(time, values.min(axis=1), values.max(axis=1), **style)
    label = "balls: mean, and all (shaded)"
    axes.plot(time, values.mean(axis=1), color=plot_style.BALL_COLOUR, label=label)


def _mean_of_part(panels: Any, time: Any, mean: float | None, label: str) -> None:
    """Which time [ms] the lowest panel is of, in those above; its mean [-] as a line, labels."""
    for ax in panels[:2]:
        ax.axvspan(time[0], time[-1], color=plot_style.CAGE_COLOUR, alpha=0.08, linewidth=0)
    panels[1].set_ylabel(label)
    panels[2].set_ylabel("the same, in the\naveraged third")
    for ax in panels:
        ax.margins(x=0.0)
    if mean is not None:
        percent = 100.0 * mean
        shown = f"mean {percent:.3g} %".replace("-", "\N{MINUS SIGN}")
        line = panels[2].axhline(
            percent, color=plot_style.INK, linestyle=":", linewidth=1.0, label=shown
        )
        panels[2].legend(handles=[line], loc="upper right", framealpha=0.85)


def _without_spikes(axes: Any, *lines: Any) -> None:
    """Limits of an axis without short spikes, as at the start, and a note where some are cut."""
    available = [line[np.isfinite(line)] for line in lines]
    available = [line for line in available if line.size]
    low = min(float(np.quantile(line, SPIKES)) for line in available)
    high = max(float(np.quantile(line, 1.0 - SPIKES)) for line in available)
    margin = 0.15 * (high - low)
    if not margin > 0.0:
        return
    least, most = (float(end([end(line) for line in available])) for end in (np.min, np.max))
    axes.set_ylim(max(low - margin, least - 0.3 * margin), min(high + margin, most + 0.3 * margin))
    below = least < low - margin
    above = most > high + margin
    cut = [_plain(least)] * below + [_plain(most)] * above
    if cut:
        note = f"short spikes reach {' and '.join(cut)}".replace("-", "\N{MINUS SIGN}")
        place: dict[str, Any] = {"y": 0.97, "va": "top"} if above else {"y": 0.03, "va": "bottom"}
        style: dict[str, Any] = {
            "color": plot_style.REFERENCE,
            "fontsize": 6.5,
            "ha": "right",
            **place,
        }
        axes.text(0.995, s=note, transform=axes.transAxes, **style)


def _plain(value: float) -> str:
    """Four figures, or all before the point."""
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.4g}"


def draw_forces(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Normal and friction force of ball 1 [N] over time [ms], the last turns of the cage.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    top, bottom = _over_time(figure, document)
    part = last_turns(data).sel(ball=1)
    time = TIME.in_unit(part["time"].to_numpy())
    for race, colour in RACES:
        one = part.sel(race=race)
        style: dict[str, Any] = {"color": colour, "label": f"{race} race", "linewidth": 0.9}
        top.plot(time, one["contact_load"], **style)
        bottom.plot(time, one["contact_friction_x"], **style)
    top.plot(time, part["pocket_load"], color=plot_style.INK, label="pocket", linewidth=0.9)
    top.set_ylabel(PLOTTED["normal_force_N"].label)
    bottom.set_ylabel(PLOTTED["friction_N"].label)
    top.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_sliding(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Sliding speed [m/s] and traction factor [-] of ball 1 over its azimuth [deg].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    top, bottom = _over_time(figure, document)
    part = last_turns(data).sel(ball=1)
    azimuth = PLOTTED["azimuth_deg"].in_unit(_turned(part)) % 360.0
    # a line ends where a turn does
    wraps = np.flatnonzero(np.abs(np.diff(azimuth)) > 180.0) + 1
    azimuth = np.insert(azimuth, wraps, np.nan)
    for race, colour in RACES:
        one = {name: values.to_numpy() for name, values in part.sel(race=race).items()}
        load = one["contact_load"]
        slide = np.hypot(one["contact_slide_x"], one["contact_slide_y"])
        pull = np.hypot(one["contact_friction_x"], one["contact_friction_y"])
        loaded = load > SMALLEST_LOAD * max(float(load.max()), 1e-300)
        factor = np.divide(pull, load, out=np.full(load.shape, np.nan), where=loaded)
        slide = np.insert(np.where(loaded, slide, np.nan), wraps, np.nan)
        factor = np.insert(factor, wraps, np.nan)
        top.plot(azimuth, slide, color=colour, label=f"{race} race", linewidth=0.9)
        bottom.plot(azimuth, factor, color=colour, linewidth=0.9)
    top.set_ylabel(PLOTTED["sliding_speed_m_s"].label)
    bottom.set_ylabel(PLOTTED["traction_factor"].label)
    bottom.set_xlabel(f"{PLOTTED['azimuth_deg'].label}; the load line at 0")
    bottom.xaxis.set_major_locator(MultipleLocator(45.0))
    bottom.set_xlim(0.0, 360.0)
    for ax in (top, bottom):
        largest = max(float(np.nanmax(line.get_ydata(), initial=0.0)) for line in ax.lines)
        ax.set_ylim(0.0, 1.08 * largest or None)
    top.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_states(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Free, contact, impact of each ball at both races over time [ms], the last turns.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    axes = _over_time(figure, document, 4.2)
    data = last_turns(data)
    time = TIME.in_unit(data["time"].to_numpy())
    interval = time[1] - time[0] if time.size > 1 else time[0]  # before each sample
    extent = (float(time[0] - interval), float(time[-1]), data.sizes["ball"] + 0.5, 0.5)
    style: dict[str, Any] = {"aspect": "auto", "extent": extent, "interpolation": "nearest"}
    for ax in axes:
        ax.grid(visible=False)
    for ax, (race, _) in zip(axes, RACES, strict=True):
        kinds = data["contact_state"].sel(race=race).to_numpy().T
        ax.imshow(kinds, cmap=ListedColormap(STATE_COLOURS), vmin=-0.5, vmax=2.5, **style)
        ax.set_ylabel(f"ball, {race} race")
        ax.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=7))
    keys = [
        Patch(facecolor=colour, edgecolor=plot_style.INK, linewidth=0.4, label=state)
        for colour, state in zip(STATE_COLOURS, STATES, strict=True)
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=3)


def draw_orbits(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Orbits of the centres of ring and cage across the axis [um]; the load line points up.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    axes = _start(figure, document, (1, 2), 3.6)
    late = data.isel(time=slice(-ORBIT_POINTS, None))
    vertical, across = PLOTTED["y_um"], PLOTTED["z_um"]
    for ax, body, colour in zip(
        axes, ("ring", "cage"), (plot_style.INNER_COLOUR, plot_style.CAGE_COLOUR), strict=True
    ):
        place = late[f"{body}_position"]
        y = vertical.in_unit(place.sel({f"{body}_coordinate": "y"}).to_numpy())
        z = across.in_unit(place.sel({f"{body}_coordinate": "z"}).to_numpy())
        ax.plot(z, y, color=colour, linewidth=0.5)
        ax.plot(z[-1], y[-1], "o", color=plot_style.INK, markersize=3)
        whirl = document[f"{body}_whirl_speed_rpm"]
        is_line = min(np.ptp(y), np.ptp(z)) <= ROUND_ORBIT * max(np.ptp(y), np.ptp(z))
        turns = "" if whirl is None or is_line else f", turning at {whirl:.0f} r/min"
        title = f"centre of the {'inner ring' if body == 'ring' else 'cage'}{turns}"
        ax.set_title(title.replace("-", "\N{MINUS SIGN}"))
        ax.set_xlabel(across.label)
        ax.set_aspect("equal", adjustable="datalim")
        if np.ptp(y) == 0.0 and np.ptp(z) == 0.0:
            style = {"ha": "center", "transform": ax.transAxes, "color": plot_style.REFERENCE}
            ax.text(0.5, 0.6, "fixed in these equations", **style)
    axes[0].set_ylabel(vertical.label)


def draw_spectrum(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Spectrum of the ring along y, or x where y is fixed [um], and defect frequencies [Hz].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    (ax,) = _start(figure, document, (1, 1), 3.4)
    defects = document["frequencies_Hz"]["with_slip"]
    if data.sizes["time"] < 2 * FEWEST_SAMPLES:
        note = f"fewer than {2 * FEWEST_SAMPLES} samples hold no spectrum"
        ax.text(0.5, 0.5, note, ha="center", transform=ax.transAxes, color=plot_style.REFERENCE)
        return
    frequency, amplitude, direction = ring_spectrum(data)
    shown = frequency <= SPECTRUM_REACH * max(defects["ball_pass_inner"], 1.0)
    length = PLOTTED["amplitude_um"]
    heights = length.in_unit(amplitude[shown][1:])
    ax.semilogy(frequency[shown][1:], heights, color=plot_style.INNER_COLOUR, linewidth=0.8)
    style = {"color": plot_style.OUTER_COLOUR, "va": "top", "transform": ax.get_xaxis_transform()}
    # room for the names of the defects above the peaks
    ax.set_ylim(top=float(heights.max(initial=1e-12)) * 30.0)
    for k, defect in enumerate(f for f in FREQUENCIES if f.key in defects):
        value = defects[defect.key]
        ax.axvline(value, color=plot_style.OUTER_COLOUR, linestyle="--", linewidth=0.7)
        ax.text(value, 0.98 - 0.07 * k, f" {defect.symbol} {value:.1f} Hz", **style)
    ax.set_xlabel(f"{PLOTTED['frequency_Hz'].label}; defect frequencies with the slip of the cage")
    ax.set_ylabel(f"{length.label}, along {direction}")


def draw_energy(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Work put in, energy stored and lost by mechanism over time [J], and the residual.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    data : xarray.Dataset
        History of a simulation, SI.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    top, bottom = _over_time(figure, document, 4.8, height_ratios=(3, 1))
    time = TIME.in_unit(data["time"].to_numpy())
    work = data["work"].to_numpy().astype(np.float64)
    names = [str(name).replace("_", " ") for name in data["mechanism"].to_numpy()]
    stored = data["energy"].to_numpy().astype(np.float64).sum(axis=1)
    put_in = work[:, :INPUTS].sum(axis=1)
    lost = work[:, LOSSES].sum(axis=1)
    top.plot(time, put_in, color=plot_style.INK, label="put in", linewidth=1.6)
    top.plot(time, stored - stored[0], color=plot_style.REFERENCE, label="stored")
    taken = work[:, INPUTS:]
    largest = np.abs(taken).max()
    for name, column, colour in zip(names[INPUTS:], taken.T, MECHANISM_COLOURS, strict=True):
        if np.abs(column).max() > 1e-3 * largest:
            top.plot(time, column, color=colour, label=name, linewidth=0.9)
    top.set_ylabel(PLOTTED["energy_J"].label)
    top.legend(ncols=2)
    residual = stored - stored[0] - (put_in - taken.sum(axis=1))
    residual -= residual[0]
    scale = max(np.abs(put_in).max(), np.abs(lost).max(), 1e-300)
    bottom.plot(time, 100.0 * residual / scale, color=plot_style.INK, linewidth=0.9)
    bottom.set_ylabel("left over\n[% of the work]")


def last_turns(data: xarray.Dataset) -> xarray.Dataset:
    """The end of a history: `SHOWN_TURNS` turns of ball 1, or all of it.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.

    Returns
    -------
    xarray.Dataset
        The end of the history.
    """
    turned = _turned(data.sel(ball=1))
    first = int(np.searchsorted(np.abs(turned - turned[-1]) < 2.0 * np.pi * SHOWN_TURNS, True))
    return data.isel(time=slice(first, None))


def ring_spectrum(data: xarray.Dataset) -> tuple[Any, Any, str]:
    """Spectrum of the ring in the second half of a history; Hann window.

    Parameters
    ----------
    data : xarray.Dataset
        History of at least two times `FEWEST_SAMPLES`, SI.

    Returns
    -------
    value
        Frequencies, shape (n,) [Hz].
    value
        Amplitudes, shape (n,) [m].
    value
        Direction, "x" or "y".
    """
    late = data.isel(time=slice(data.sizes["time"] // 2, None))
    place = late["ring_position"]
    direction = "y" if float(np.ptp(place.sel(ring_coordinate="y").to_numpy())) > 0.0 else "x"
    values = place.sel(ring_coordinate=direction).to_numpy().astype(np.float64)
    time = late["time"].to_numpy()
    window = np.hanning(values.size)
    trend = np.polyval(np.polyfit(time - time[0], values, 1), time - time[0])
    amplitude = 2.0 * np.abs(np.fft.rfft((values - trend) * window)) / window.sum()
    return np.fft.rfftfreq(values.size, float(time[1] - time[0])), amplitude, direction


def _turned(ball: xarray.Dataset) -> Any:
    """Azimuth of a ball over time, without jumps [rad]."""
    place = ball["ball_position"].to_numpy()
    return np.unwrap(np.arctan2(place[:, 2], place[:, 1]))


def _over_time(
    figure: Figure, document: dict[str, Any], height: float = 4.6, **options: Any
) -> Any:
    """Two panels, one above the other, over the time [ms]."""
    axes = _start(figure, document, (2, 1), height, sharex=True, **options)
    axes[1].set_xlabel(TIME.label)
    return axes


def _start(
    figure: Figure,
    document: dict[str, Any],
    panels: tuple[int, int],
    height: float,
    **options: Any,
) -> Any:
    """Panels in rows and columns with a grid, below the title of the case."""
    title = str(document["case"].get("title", ""))
    axes = plot_style.titled_panels(
        figure, title, height, *panels, squeeze=False, **options
    ).ravel()
    for ax in axes:
        ax.grid(linewidth=0.3, alpha=0.5)
    return axes


OF_VIBRATION = ("states", "spectrum")  # not of steps that leave it out
PICTURES: dict[str, Callable[..., None]] = {
    "speeds": draw_speeds,
    "spin": draw_spin,
    "forces": draw_forces,
    "sliding": draw_sliding,
    "states": draw_states,
    "orbits": draw_orbits,
    "spectrum": draw_spectrum,
    "energy": draw_energy,
}

"""Pictures of a time simulation, from its history and summary."""

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

from bearing.dynamics.statistics import INPUTS, LOSSES
from ehl.units import to_si

from ..plot_style import (
    BALL_COLOUR,
    CAGE_COLOUR,
    INK,
    INNER_COLOUR,
    OUTER_COLOUR,
    PAGE_WIDTH,
    REFERENCE,
    write_figures,
)
from ..quantities import FREQUENCIES
from .history import open_history
from .quantities import PLOTTED, STATES

RACES = (("inner", INNER_COLOUR), ("outer", OUTER_COLOUR))
STATE_COLOURS = ("#ffffff", "#7fa8d1", "#c1440e")  # free, contact, impact
MECHANISM_COLOURS = (
    "#0b5394 #c1440e #3a7d44 #7a4fa3 #8a6d1d #5b8c00 #1f9e9e #b8336a #666666 #d98c00".split()
)
TIME = PLOTTED["time_ms"]
SPEED = PLOTTED["speed_rpm"]
SHOWN_TURNS = 2.0  # turns of the cage in the pictures of one ball [-]
SPIKES = 0.01  # share of the time at each end of an axis that may lie beyond it [-]
ORBIT_POINTS = 4000  # of an orbit, the last ones
SMALLEST_LOAD = 1.0e-2  # of the largest one; below, a traction factor says nothing [-]
ROUND_ORBIT = 1e-3  # smaller over larger extent of an orbit below which it is a line [-]
SPECTRUM_REACH = 6.0  # highest frequency shown over the ball pass frequency of the inner ring [-]


def write_dynamics_plots(
    directory: Path, document: dict[str, Any], hurried: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write pictures beside the history, by it and the summary, no further ones when one is
    `hurried`; those that failed are messages.
    """
    with open_history(directory).load() as data:
        given = {"data": data, "document": document}
        drawings = [(name, partial(draw, **given)) for name, draw in PICTURES.items()]
        return write_figures(directory, drawings, hurried)


def draw_speeds(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Cage and balls [r/min] and the slip ratio of the cage [%] over time [ms]."""
    top, bottom = _over_time(figure, document)
    time = TIME.in_unit(data["time"].to_numpy())
    speeds = data["cage_velocity"].sel(cage_coordinate="rotation").to_numpy()
    cage, orbit, kinematic = (
        SPEED.in_unit(speed)
        for speed in (speeds, orbit_speed(data), kinematic_speed(data, document))
    )
    style: dict[str, Any] = {"color": BALL_COLOUR, "alpha": 0.25, "linewidth": 0}
    slowest, fastest = orbit.min(axis=1), orbit.max(axis=1)
    top.fill_between(time, slowest, fastest, **style)
    top.plot(time, orbit.mean(axis=1), color=BALL_COLOUR, label="balls: mean, and all (shaded)")
    top.plot(time, cage, color=CAGE_COLOUR, label="cage")
    top.plot(time, kinematic, "--", color=REFERENCE, label="kinematic")
    top.set_ylabel(SPEED.label)
    top.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    _without_spikes(top, cage, slowest, fastest, kinematic)
    moving = kinematic > 0.02 * kinematic.max()
    slip = np.full(time.shape, np.nan)
    slip[moving] = 100.0 * (1.0 - cage[moving] / kinematic[moving])
    bottom.plot(time, slip, color=CAGE_COLOUR)
    bottom.axhline(0.0, color=REFERENCE, linewidth=0.6)
    bottom.set_ylabel("slip of the cage [%]")
    _without_spikes(bottom, slip, np.zeros(1))


def _without_spikes(axes: Any, *lines: Any) -> None:
    """Limits of an axis without short spikes, as at the start, and a note where some are cut."""
    known = [line[np.isfinite(line)] for line in lines]
    known = [line for line in known if line.size]
    low = min(float(np.quantile(line, SPIKES)) for line in known)
    high = max(float(np.quantile(line, 1.0 - SPIKES)) for line in known)
    margin = 0.15 * (high - low)
    if not margin > 0.0:
        return
    least, most = (float(end([end(line) for line in known])) for end in (np.min, np.max))
    axes.set_ylim(max(low - margin, least - 0.3 * margin), min(high + margin, most + 0.3 * margin))
    cut = [f"{least:.4g}"] * (least < low - margin) + [f"{most:.4g}"] * (most > high + margin)
    if cut:
        note = f"short spikes reach {' and '.join(cut)}".replace("-", "\N{MINUS SIGN}")
        style: dict[str, Any] = {"color": REFERENCE, "fontsize": 6.5, "va": "top", "ha": "right"}
        axes.text(0.995, 0.97, note, transform=axes.transAxes, **style)


def draw_forces(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Normal and friction force of ball 1 [N] over time [ms], the last turns of the cage."""
    top, bottom = _over_time(figure, document)
    part = last_turns(data).sel(ball=1)
    time = TIME.in_unit(part["time"].to_numpy())
    for race, colour in RACES:
        one = part.sel(race=race)
        style: dict[str, Any] = {"color": colour, "label": f"{race} race", "linewidth": 0.9}
        top.plot(time, one["contact_load"], **style)
        bottom.plot(time, one["contact_friction_x"], **style)
    top.plot(time, part["pocket_load"], color=INK, label="pocket", linewidth=0.9)
    top.set_ylabel(PLOTTED["normal_force_N"].label)
    bottom.set_ylabel(PLOTTED["friction_N"].label)
    top.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_sliding(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Sliding speed [m/s] and traction factor [-] of ball 1 over its azimuth [deg]."""
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
    bottom.set_ylim(bottom=0.0)
    top.set_ylim(bottom=0.0)
    top.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def draw_states(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Free, contact, impact of each ball at both races over time [ms], the last turns."""
    axes = _over_time(figure, document, 4.2)
    data = last_turns(data)
    time = TIME.in_unit(data["time"].to_numpy())
    extent = (float(time[0]), float(time[-1]), data.sizes["ball"] + 0.5, 0.5)
    style: dict[str, Any] = {"aspect": "auto", "extent": extent, "interpolation": "nearest"}
    for ax in axes:
        ax.grid(visible=False)
    for ax, (race, _) in zip(axes, RACES, strict=True):
        kinds = data["contact_state"].sel(race=race).to_numpy().T
        ax.imshow(kinds, cmap=ListedColormap(STATE_COLOURS), vmin=-0.5, vmax=2.5, **style)
        ax.set_ylabel(f"ball, {race} race")
        ax.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=7))
    keys = [
        Patch(facecolor=colour, edgecolor=INK, linewidth=0.4, label=state)
        for colour, state in zip(STATE_COLOURS, STATES, strict=True)
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=3)


def draw_orbits(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Orbits of the centres of ring and cage across the axis [um]; the load line points up."""
    axes = _start(figure, document, (1, 2), 3.6)
    late = data.isel(time=slice(-ORBIT_POINTS, None))
    vertical, across = PLOTTED["y_um"], PLOTTED["z_um"]
    for ax, body, colour in zip(axes, ("ring", "cage"), (INNER_COLOUR, CAGE_COLOUR), strict=True):
        place = late[f"{body}_position"]
        y = vertical.in_unit(place.sel({f"{body}_coordinate": "y"}).to_numpy())
        z = across.in_unit(place.sel({f"{body}_coordinate": "z"}).to_numpy())
        ax.plot(z, y, color=colour, linewidth=0.5)
        ax.plot(z[-1], y[-1], "o", color=INK, markersize=3)
        whirl = document[f"{body}_whirl_speed_rpm"]
        is_line = min(np.ptp(y), np.ptp(z)) <= ROUND_ORBIT * max(np.ptp(y), np.ptp(z))
        turns = "" if whirl is None or is_line else f", turning at {whirl:.0f} r/min"
        title = f"centre of the {'inner ring' if body == 'ring' else 'cage'}{turns}"
        ax.set_title(title.replace("-", "\N{MINUS SIGN}"))
        ax.set_xlabel(across.label)
        ax.set_aspect("equal", adjustable="datalim")
        if np.ptp(y) == 0.0 and np.ptp(z) == 0.0:
            style = {"ha": "center", "transform": ax.transAxes, "color": REFERENCE}
            ax.text(0.5, 0.6, "fixed in these equations", **style)
    axes[0].set_ylabel(vertical.label)


def draw_spectrum(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Spectrum of the ring along y, or x where y is fixed [um], and defect frequencies [Hz]."""
    (ax,) = _start(figure, document, (1, 1), 3.4)
    defects = document["frequencies_Hz"]["with_slip"]
    frequency, amplitude, direction = ring_spectrum(data)
    shown = frequency <= SPECTRUM_REACH * max(defects["ball_pass_inner"], 1.0)
    length = PLOTTED["amplitude_um"]
    heights = length.in_unit(amplitude[shown][1:])
    ax.semilogy(frequency[shown][1:], heights, color=INNER_COLOUR, linewidth=0.8)
    style = {"color": OUTER_COLOUR, "va": "top", "transform": ax.get_xaxis_transform()}
    # room for the names of the defects above the peaks
    ax.set_ylim(top=float(heights.max(initial=1e-12)) * 30.0)
    for k, defect in enumerate(f for f in FREQUENCIES if f.key in defects):
        value = defects[defect.key]
        ax.axvline(value, color=OUTER_COLOUR, linestyle="--", linewidth=0.7)
        ax.text(value, 0.98 - 0.07 * k, f" {defect.symbol} {value:.1f} Hz", **style)
    ax.set_xlabel(f"{PLOTTED['frequency_Hz'].label}; defect frequencies with the slip of the cage")
    ax.set_ylabel(f"{length.label}, along {direction}")


def draw_energy(figure: Figure, data: xarray.Dataset, document: dict[str, Any]) -> None:
    """Work put in, energy stored and lost by mechanism over time [J], and what is left over."""
    top, bottom = _over_time(figure, document, 4.8, height_ratios=(3, 1))
    time = TIME.in_unit(data["time"].to_numpy())
    work = data["work"].to_numpy().astype(np.float64)
    names = [str(name).replace("_", " ") for name in data["mechanism"].to_numpy()]
    stored = data["energy"].to_numpy().astype(np.float64).sum(axis=1)
    put_in = work[:, :INPUTS].sum(axis=1)
    lost = work[:, LOSSES].sum(axis=1)
    top.plot(time, put_in, color=INK, label="put in", linewidth=1.6)
    top.plot(time, stored - stored[0], color=REFERENCE, label="stored")
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
    bottom.plot(time, 100.0 * residual / scale, color=INK, linewidth=0.9)
    bottom.set_ylabel("left over\n[% of the work]")


def orbit_speed(data: xarray.Dataset) -> Any:
    """Angular speed of each ball's centre about the axis [rad/s], shape (m, Z)."""
    place = data["ball_position"].to_numpy()
    speed = data["ball_velocity"].to_numpy()
    turn = place[..., 1] * speed[..., 2] - place[..., 2] * speed[..., 1]
    return turn / (place[..., 1] ** 2 + place[..., 2] ** 2)


def kinematic_speed(data: xarray.Dataset, document: dict[str, Any]) -> Any:
    """Kinematic speed of the cage over time [rad/s], in step with the inner ring."""
    time = data["time"].to_numpy()
    angle = data["ring_rotation"].to_numpy()
    ring = np.gradient(angle, time) if time.size > 1 else np.ones(1)
    late = time >= time[-1] - (time[-1] - time[0]) / 3.0
    mean = float(ring[late].mean())
    speed = to_si("speed_rpm", document["kinematic_cage_speed_rpm"])
    return np.full(time.shape, speed) if mean == 0.0 else ring * (speed / mean)


def last_turns(data: xarray.Dataset) -> xarray.Dataset:
    """The end of a history: `SHOWN_TURNS` turns of ball 1, or all of it."""
    turned = _turned(data.sel(ball=1))
    first = int(np.searchsorted(np.abs(turned - turned[-1]) < 2.0 * np.pi * SHOWN_TURNS, True))
    return data.isel(time=slice(first, None))


def ring_spectrum(data: xarray.Dataset) -> tuple[Any, Any, str]:
    """Frequencies [Hz], amplitudes [m], direction of the ring in the second half; Hann window."""
    late = data.isel(time=slice(data.sizes["time"] // 2, None))
    place = late["ring_position"]
    direction = "y" if float(np.ptp(place.sel(ring_coordinate="y").to_numpy())) > 0.0 else "x"
    values = place.sel(ring_coordinate=direction).to_numpy().astype(np.float64)
    if values.size < 8:
        raise ValueError("too few samples for a spectrum")
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
    figure.set_size_inches(PAGE_WIDTH, height)
    figure.suptitle(str(document["case"].get("title", "")), fontsize=8.5)
    axes = figure.subplots(*panels, squeeze=False, **options).ravel()
    for ax in axes:
        ax.grid(linewidth=0.3, alpha=0.5)
    return axes


PICTURES: dict[str, Callable[..., None]] = {
    "speeds": draw_speeds,
    "forces": draw_forces,
    "sliding": draw_sliding,
    "states": draw_states,
    "orbits": draw_orbits,
    "spectrum": draw_spectrum,
    "energy": draw_energy,
}

"""Pictures of docs/validation/validation_001.md."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from dynamics_runs import Run
from matplotlib.figure import Figure

from oilfilm.postprocess.plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, RC, REFERENCE, save

IMAGES = Path(__file__).parents[2] / "docs" / "images"
COLOURS = (INNER_COLOUR, OUTER_COLOUR, "#3a7d44", "#7a3e9d", "#b8860b", "#555555")
TURNS = 1.5  # of the cage that are shown


def draw_loads(speeds: dict[str, dict[float, float]], no_slip: float, plateau: dict[str, float]) -> None:
    """Speed of the cage [r/min] over the load [N] by the inputs; band: the paper's plateau."""
    middle, width = plateau["cage_speed_rpm"], plateau["cage_speed_tolerance_rpm"]
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.9))
        left, right = figure.subplots(1, 2)
        for colour, (name, found) in zip(COLOURS, speeds.items(), strict=False):
            for ax in (left, right):
                ax.semilogx(list(found), list(found.values()), "o-", color=colour, markersize=3, label=name)
        for ax in (left, right):
            ax.axhline(8000.0 * no_slip, color=REFERENCE, linewidth=0.6)
            ax.axhspan(middle - width, middle + width, color=REFERENCE, alpha=0.2, linewidth=0)
            ax.set_xlabel("radial load [N]")
        left.set(ylabel="speed of the cage [r/min]", ylim=(0.0, 3100.0))
        right.set(ylim=(2850.0, 2960.0), title=f"grey: {middle:.0f} ± {width:.0f} r/min; line: no slip")
        left.legend(loc="lower right")
        save(figure, IMAGES / "validation_001_loads.png")


def _last(result: Run) -> tuple[Any, slice]:
    """Turns of the cage before the end [-], and the rows of the last `TURNS`."""
    turned = result.record.state[:, result.simulation.layout.cage][:, 3] / (2.0 * np.pi)
    turned -= turned[-1]
    return turned, slice(int(np.searchsorted(turned, -TURNS)), None)


def draw_forces(runs: dict[str, Run]) -> None:
    """Normal and friction force of ball 1 at both races [N] over the last turns of the cage."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 3.6))
        axes = figure.subplots(2, len(runs), sharex=True)
        for column, (name, result) in zip(axes.T, runs.items(), strict=True):
            turned, part = _last(result)
            races = result.record.races[part, :, 0]
            for race, (side, colour) in enumerate((("inner race", INNER_COLOUR), ("outer race", OUTER_COLOUR))):
                column[0].plot(turned[part], races[:, race, 0], color=colour, linewidth=0.8, label=side)
                column[1].plot(turned[part], races[:, race, 8], color=colour, linewidth=0.8)
            column[0].set_title(name)
            column[1].set_xlabel("turns of the cage")
        axes[0, 0].set_ylabel("normal force on ball 1 [N]")
        axes[1, 0].set_ylabel("friction force on it [N]")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
        save(figure, IMAGES / "validation_001_forces.png")


def draw_sliding(runs: dict[str, Run]) -> None:
    """Sliding speed [m/s] and contact state of ball 1 over the last turns of the cage."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 3.6))
        axes = figure.subplots(2, len(runs), sharex=True, gridspec_kw={"height_ratios": (2, 1)})
        for column, (name, result) in zip(axes.T, runs.items(), strict=True):
            turned, part = _last(result)
            slides, states = result.slides[part, :, 0], result.record.contact_state[part, :, 0]
            for race, (side, colour) in enumerate((("inner race", INNER_COLOUR), ("outer race", OUTER_COLOUR))):
                column[0].plot(turned[part], slides[:, race], color=colour, linewidth=0.8, label=side)
                shown = states[:, race] + 0.12 * (race - 0.5)
                column[1].plot(turned[part], shown, ".", color=colour, markersize=1.5)
            column[0].set_title(name)
            column[1].set(xlabel="turns of the cage", ylim=(-0.4, 2.4), yticks=(0, 1, 2), yticklabels=())
        axes[1, 0].set_yticks((0, 1, 2), ("free", "contact", "impact"))
        axes[0, 0].set_ylabel("sliding speed of ball 1,\nwhere in contact [m/s]")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
        save(figure, IMAGES / "validation_001_sliding.png")


def draw_run_ups(slips: dict[str, tuple[Any, Any]]) -> None:
    """Slip of the cage [%] over time [s] after a step of the ring's speed: speeds, loads, gaps, numbers of balls."""
    groups = {"speed, 100 N": "r/min", "load, 8000 r/min": " N", "gap between ball and race": "µm", "balls": "balls"}
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 3.8))
        axes = figure.subplots(2, 2, sharex=True, sharey=True)
        for ax, (title, mark) in zip(axes.ravel(), groups.items(), strict=True):
            named = {name: value for name, value in slips.items() if mark in name}
            for colour, (name, (time, slip)) in zip(COLOURS, named.items(), strict=False):
                ax.plot(time, 100.0 * slip, color=colour, linewidth=0.9, label=name.removeprefix("gap "))
            ax.set(title=title, ylim=(-2.0, 10.0))
            ax.legend(ncols=2)
        for ax in axes[1]:
            ax.set_xlabel("time [s]")
        for ax in axes[:, 0]:
            ax.set_ylabel("slip of the cage [%]")
        save(figure, IMAGES / "validation_001_run_up.png")


def draw_orbits(runs: dict[str, Run]) -> None:
    """Paths of the ring's centre [um] by speed, load and gap."""
    names = [name for name in runs if "balls" not in name]
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 5.4))
        axes = figure.subplots(3, 4)
        for ax, name in zip(axes.ravel(), names, strict=True):
            place = runs[name].record.state[:, :3] * 1e6
            ax.plot(place[:, 2], place[:, 1], color=INNER_COLOUR, linewidth=0.3)
            ax.set_title(name)
            ax.set_aspect("equal", adjustable="datalim")
        for ax in axes[-1]:
            ax.set_xlabel("z [µm]")
        for ax in axes[:, 0]:
            ax.set_ylabel("y, along the load [µm]")
        save(figure, IMAGES / "validation_001_orbits.png")

"""Pictures of docs/validation/validation_000.md."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from dynamics_runs import Run, over_azimuth
from matplotlib.figure import Figure

from oilfilm.postprocess.plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, RC, REFERENCE, save

IMAGES = Path(__file__).parents[2] / "docs" / "images"


def draw_axial(rows: dict[float, tuple[Any, Any, float]]) -> None:
    """Sliding [m/s], traction factors [-] and cage speed ratio [-] over the axial load [N]."""
    loads = list(rows)
    slides, factors = np.array([row[0] for row in rows.values()]), np.array([row[1] for row in rows.values()])
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.5))
        left, middle, right = figure.subplots(1, 3)
        for race, (name, colour, mark) in enumerate((("inner", INNER_COLOUR, "o-"), ("outer", OUTER_COLOUR, "s-"))):
            left.plot(loads, slides[:, race], mark, color=colour, markersize=3, label=f"{name} race")
            middle.plot(loads, factors[:, race], mark, color=colour, markersize=3)
        left.set(xlabel="axial load [N]", ylabel="sliding speed [m/s]", yscale="log")
        left.legend()
        middle.set(xlabel="axial load [N]", ylabel="traction factor [-]", ylim=(0.0, None))
        right.plot(loads, [row[2] for row in rows.values()], "o-", color=INNER_COLOUR, markersize=3)
        right.axhline(1.0, color=REFERENCE, linewidth=0.6)
        right.set(xlabel="axial load [N]", ylabel="cage speed over kinematic [-]", ylim=(0.0, 1.05))
        save(figure, IMAGES / "validation_000_axial.png")


def draw_azimuth(name: str, words: str, runs: dict[float, Run], *, gaps: bool) -> None:
    """Sliding [m/s] and traction factor [-] of both races over the azimuth [deg]."""
    colours = mpl.colormaps["viridis"](np.linspace(0.0, 0.85, len(runs)))
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 4.4))
        axes = figure.subplots(2, 2, sharex=True)
        for colour, (load, result) in zip(colours, runs.items(), strict=True):
            slides, bare = result.slides, result.surface_slides
            for race in range(2):
                place, loaded = over_azimuth(result, slides[:, race])
                axes[0, race].plot(place, loaded, color=colour, label=f"{load:.0f} N")
                if gaps and race == 0:
                    gap = np.where(np.isfinite(slides[:, 0]), np.nan, bare[:, 0])
                    axes[0, 0].plot(*over_azimuth(result, gap), ":", color=colour, linewidth=0.9)
                factors = np.nan_to_num(result.factors[:, race])
                axes[1, race].plot(*over_azimuth(result, factors), color=colour)
        for race, side in enumerate(("inner", "outer")):
            axes[0, race].set_title(f"{side} race")
            axes[1, race].set_xlabel("azimuth from the load line [deg]")
            axes[1, race].set_xticks(range(-180, 181, 60))
        axes[0, 0].set_ylabel("sliding speed [m/s]" + (";\ndotted: at a gap" if gaps else ""))
        axes[1, 0].set_ylabel("traction factor [-], 0 at a gap")
        for ax in axes.ravel():
            ax.set_ylim(0.0, None)
        axes[0, 1].legend(title=words, ncols=2)
        save(figure, IMAGES / f"{name}.png")


def draw_skid(points: Any, catalogue: Any, factor: float) -> None:
    """Onset, Hirano's load and the catalogue's [N] over the speed [r/min]."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(0.65 * PAGE_WIDTH, 3.2))
        ax = figure.subplots()
        n, result, hirano = points.T
        ax.fill_between(n, result, ax.get_ylim()[0] + 1.0, color=OUTER_COLOUR, alpha=0.08, linewidth=0)
        ax.loglog(n, hirano, "^-", color=REFERENCE, markersize=4, label="Hirano, SF = 10")
        ax.loglog(n, catalogue, "-.", color="#3a7d44", label=f"catalogue, A = {factor:.0f} N (assumed)")
        ax.loglog(n, result, "o-", color=OUTER_COLOUR, markersize=4, label="onset of gross skid, simulated")
        ax.text(n[-1], 0.35 * result[-1], "gross skid", ha="right", color=OUTER_COLOUR)
        ax.set(xlabel="speed of the inner ring [r/min]", ylabel="axial load [N]", ylim=(0.5 * result.min(), None))
        ax.set_xticks(n, [f"{speed:.0f}" for speed in n])
        ax.xaxis.set_minor_formatter(mpl.ticker.NullFormatter())
        ax.grid(linewidth=0.3, alpha=0.5)
        ax.legend(loc="upper left")
        save(figure, IMAGES / "validation_000_skid.png")

"""Figures of the whole bearing: film or pressure of every ball over the azimuth, and the load zone."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from .plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE, ContactView, contact_view
from .plots_contact import draw_map
from .results import GIGAPASCAL, MICROMETRE, BearingResults

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ehl import ContactSolution

COLUMNS = 6  # maps side by side at most
RACES = ("inner", "outer")
COLOURS = {"inner": INNER_COLOUR, "outer": OUTER_COLOUR}


@dataclass(frozen=True, slots=True, kw_only=True)
class BallColumn:
    """Balls whose two contacts are the same, at azimuths that mirror each other about the load line."""

    azimuths: tuple[float, ...]  # [deg]
    views: dict[str, ContactView | None]  # by race

    @property
    def label(self) -> str:
        """Azimuths in words."""
        return ", ".join(f"{a:.4g}°" for a in self.azimuths)


def ball_columns(results: BearingResults) -> tuple[BallColumn, ...]:
    """Columns of the overview: one per ball, mirrored equal balls together, at most `COLUMNS` spread evenly.

    Parameters
    ----------
    results : BearingResults

    Returns
    -------
    tuple of BallColumn
        Azimuths in [deg], in ascending order of their distance from the load line.
    """
    groups: dict[tuple[float, int, int], list[float]] = {}
    pairs: dict[tuple[float, int, int], tuple[ContactSolution | None, ContactSolution | None]] = {}
    for i in range(0, len(results.contacts), 2):
        azimuth = degrees(results.contacts[i].azimuth) % 360.0
        pair = results.solutions[i], results.solutions[i + 1]
        key = (round(min(azimuth, 360.0 - azimuth), 6), id(pair[0]), id(pair[1]))
        groups.setdefault(key, []).append(azimuth)
        pairs[key] = pair
    keys = sorted(groups)
    chosen = np.unique(np.linspace(0, len(keys) - 1, min(COLUMNS, len(keys))).round().astype(int))
    views: dict[int, ContactView] = {}
    for key in keys:
        for solution in pairs[key]:
            if solution is not None and id(solution) not in views:
                views[id(solution)] = contact_view(solution)
    return tuple(
        BallColumn(
            azimuths=tuple(sorted(groups[key])),
            views={race: views.get(id(s)) for race, s in zip(RACES, pairs[key], strict=True)},
        )
        for key in (keys[i] for i in chosen)
    )


def draw_per_azimuth(figure: Figure, results: BearingResults, quantity: str) -> None:
    """Maps of both races ball by ball on one colour scale, above the values over the azimuth.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    results : BearingResults
        With at least one film.
    quantity : {"film", "pressure"}
        Film in [um] or pressure in [GPa].
    """
    columns = ball_columns(results)
    figure.set_size_inches(PAGE_WIDTH, 6.0)
    figure.suptitle(str(results.case.get("title", "")), fontsize=8.5)
    halves: Any = figure.subfigures(2, 1, height_ratios=[1.75, 1.0])
    upper, lower = halves
    panels: Any = upper.subplots(2, len(columns), squeeze=False)
    image = None
    for row, race in enumerate(RACES):
        limits = _limits([c.views[race] for c in columns] + [c.views[r] for c in columns for r in RACES], quantity)
        for panel, column in zip(panels[row], columns, strict=True):
            image = _small_map(panel, column.views[race], quantity, limits) or image
        panels[row, 0].set_ylabel(f"{race} race\ntransverse $y/b$")
    for panel, column in zip(panels[0], columns, strict=True):
        panel.set_title(f"ψ = {column.label}")
    for panel in panels[1]:
        panel.set_xlabel("rolling $x/a$")
    for panel in panels[:, 1:].flat:
        panel.set_yticklabels([])
    label = "film thickness [µm]" if quantity == "film" else "pressure [GPa]"
    upper.colorbar(image, ax=panels, label=label, extend="max" if quantity == "film" else "neither", aspect=40)
    _over_azimuth(lower.subplots(), results, quantity)


def _limits(views: list[ContactView | None], quantity: str) -> tuple[float, float]:
    """Ends of the common colour scale over all maps."""
    shown = [v for v in views if v is not None]
    if quantity == "pressure":
        return 0.0, max(float(v.pressure.max()) for v in shown)
    ranges = [v.film_range for v in shown]
    return min(r[0] for r in ranges), max(r[1] for r in ranges)


def _small_map(axes: Axes, view: ContactView | None, quantity: str, limits: tuple[float, float]) -> Any:
    """One map in semi-axes of its own Hertz ellipse; an empty panel says that there is no contact."""
    if view is None:
        axes.set_facecolor("#eeeeee")
        axes.text(0.5, 0.5, "no film", ha="center", va="center", transform=axes.transAxes, color=REFERENCE)
        axes.set_xticks([])
        axes.set_yticks([])
        return None
    image = draw_map(axes, view, quantity, limits)
    axes.set_xlabel("")
    axes.set_ylabel("")
    axes.set_xticks([-2.0 * view.half_x, 0.0, view.half_x], ["−2", "0", "1"])
    axes.set_yticks([-view.half_y, 0.0, view.half_y], ["−1", "0", "1"])
    size = f"{2 * view.half_x:.2g} × {2 * view.half_y:.2g} mm"
    axes.text(0.03, 0.03, size, fontsize=6, transform=axes.transAxes, color="white" if quantity == "film" else "black")
    return image


def _over_azimuth(axes: Axes, results: BearingResults, quantity: str) -> None:
    """Film with error bars, or pressure, of every contact over the azimuth."""
    for race in RACES:
        pairs = [
            (degrees(c.azimuth) % 360.0, s)
            for c, s in zip(results.contacts, results.solutions, strict=True)
            if s is not None and c.race.value == race
        ]
        if not pairs:
            continue
        azimuth = np.array([p[0] for p in pairs])
        if quantity == "film":
            _film_points(axes, azimuth, [p[1] for p in pairs], race)
        else:
            maximum = [p[1].pressure_maximum / GIGAPASCAL for p in pairs]
            hertz = [p[1].hertz_pressure / GIGAPASCAL for p in pairs]
            axes.plot(azimuth, maximum, "o", color=COLOURS[race], markersize=4, label=f"{race} race, largest")
            axes.plot(azimuth, hertz, "_", color=COLOURS[race], markersize=9, label=f"{race} race, Hertz")
    axes.set_xlim(-12.0, 372.0)
    balls = np.degrees(results.quasistatic.azimuth) % 360.0
    axes.set_xticks(balls if len(balls) <= 12 else np.arange(0.0, 361.0, 30.0))
    axes.set_ylim(0.0, 1.12 * axes.get_ylim()[1])
    axes.set_xlabel("azimuth ψ from the load line [deg]")
    axes.set_ylabel("film thickness [µm]" if quantity == "film" else "pressure [GPa]")
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def _film_points(axes: Axes, azimuth: Any, solutions: list[ContactSolution], race: str) -> None:
    for name, marker, filled in (("central", "o", True), ("minimum", "v", False)):
        value = [getattr(s, f"film_{name}") / MICROMETRE for s in solutions]
        error = [getattr(s, f"film_{name}_uncertainty") / MICROMETRE for s in solutions]
        face = COLOURS[race] if filled else "white"
        style: Any = {"color": COLOURS[race], "markerfacecolor": face, "markersize": 4, "capsize": 3, "linewidth": 0.9}
        axes.errorbar(azimuth, value, error, fmt=marker, label=f"{race} race, {name}", **style)


def draw_load_zone(figure: Figure, results: BearingResults) -> None:
    """Contact loads over the azimuth, seen against the axis x: the load line upwards, azimuth counter-clockwise.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    results : BearingResults
        Loads in [N].
    """
    state = results.quasistatic
    figure.set_size_inches(0.5 * PAGE_WIDTH, 3.9)
    figure.suptitle(str(results.case.get("title", "")), fontsize=7.5, wrap=True)
    axes: Any = figure.add_subplot(projection="polar")
    axes.set_theta_zero_location("N")
    width = 0.55 * 2.0 * pi / len(state.azimuth)
    axes.bar(state.azimuth, state.outer_load, width, color=OUTER_COLOUR, alpha=0.35, label="outer race")
    axes.bar(state.azimuth, state.inner_load, 0.55 * width, color=INNER_COLOUR, label="inner race")
    axes.set_xticks(state.azimuth, [f"{degrees(a) % 360.0:.4g}°" for a in state.azimuth])
    emptiest = int(np.argmin(state.outer_load + np.roll(state.outer_load, -1)))
    axes.set_rlabel_position(degrees(state.azimuth[emptiest] + pi / len(state.azimuth)) % 360.0)
    axes.set_rticks([tick for tick in axes.get_yticks() if tick > 0.0][1::2])
    axes.set_axisbelow(True)
    axes.grid(linewidth=0.3)
    axes.legend(
        title="contact load [N] by azimuth ψ",
        title_fontsize=7,
        ncols=2,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.08),
    )

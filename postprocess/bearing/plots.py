"""Figures of a bearing: films or pressures of every ball, torque, strength, decay."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from io import StringIO
from itertools import chain, islice
from math import degrees, pi
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import matplotlib
import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import LogLocator, NullFormatter

from oilfilm.bearing.films.film import ContactFilm
from oilfilm.bearing.fits.ring_strength import LARGE_SHARE, StrengthMap
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.torque.models import ModelTorque
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import axis_label, from_si, value_with_error

from .. import plot_style
from ..contact.plots import draw_contact, draw_map, film_text
from ..contact.shown_part import (
    SHOWN_INLET,
    SHOWN_OUTLET,
    SHOWN_SIDE,
    ContactView,
    common_film_range,
    contact_view,
)
from ..quantities import FILMS, OTHERS, Quantity, by_key, evenly_chosen
from .bearing_quantities import BALL_QUANTITY, DECAY_COURSE, TORQUE, TORQUE_MODELS
from .measured import MeasuredComparison
from .results import BearingResults, azimuths_text, distinct_contacts
from .torque import shown_titles, shown_torques

SMALLEST = 1e-15  # probability at the lower end of the axis [-]
HEIGHT = 3.0  # [in]
MEASURED_HEIGHT = 2.4  # of a panel [in]
# states of measurements, the first that varies is the abscissa
VARIED = ("time_s", "inner_speed_rpm", "radial_load_N", "axial_load_N", "temperature_C")
COURSE = by_key(DECAY_COURSE)
OIL = "#4c78a8"
SLIDING = "#d67b1f"
SPIN = "#b23a3a"
CURVATURE = "#e0b35a"
ROTATION = "#f0dcae"
ORBIT = "#8c6bb1"
DRAG = "#79b7c9"
SEAL = "#9a9a9a"
OTHER_PARTS = "#5f9e6e"
ASPERITY = "#4d3b2f"
LOAD = "#a65e7d"
KINDS = (  # what one colour stands for, and the components of the models that are of this kind
    ("oil: rolling resistance", OIL, ("rolling", "hydrodynamic", "viscous", "ML")),
    ("sliding", SLIDING, ("sliding", "film")),
    ("spin", SPIN, ("spin", "MS")),
    ("curvature slip", CURVATURE, ("curvature", "MD")),
    ("curvature slip: ball rotation", ROTATION, ("rotation",)),
    ("curvature slip: orbit", ORBIT, ("orbit",)),
    ("asperities", ASPERITY, ("asperity",)),
    ("hysteresis", plot_style.REFERENCE, ("hysteresis", "ME")),
    ("load term", LOAD, ("load",)),
    ("cage", plot_style.CAGE_COLOUR, ("cage", "MC")),
    ("churning", DRAG, ("drag",)),
    ("seals", SEAL, ("seal",)),
)
SVG = "http://www.w3.org/2000/svg"
METADATA = ("Creator", "Date", "Format", "Type")  # of SVG, left out
VISIBLE = 1.0e-4  # of the largest torque: smaller parts are not drawn
DODGE = 2.3  # points of the two races stand this far beside their azimuth [deg]
NUDGE = 1.1  # central and minimum film stand so far to the left and right [deg]
ROW_DODGE = 5.0  # and those of rows side by side this far apart [deg]
# contour lines of small maps over the central film [-]
FILM_LEVELS = np.array([0.8, 0.85, 0.9, 0.95, 1.05, 1.1, 1.2, 1.5])
PRESSURE_LEVELS = np.array([0.1, 0.3, 0.5, 0.7, 0.9])  # of the largest pressure, likewise
WIDE_LABEL = 10  # characters of azimuths that fit above a map
ROOM = 0.25  # below a map for its numbers, over the half width of the window [-]
COLUMNS = 6  # maps side by side at most
# boxes of the overview, in shares of the figure
MAPS = {"left": 0.1, "right": 0.878, "bottom": 0.425, "hspace": 0.1, "wspace": 0.18}
MAPS_TOP = 0.932
LABEL_LINE = 0.021  # height of a further line of a column's label
FEWEST_COLUMNS = 2  # that take the whole width; fewer ones are as wide
BAR_GAP = 0.044
BAR_WIDTH = 0.0115
VALUES = (0.075, 0.124, 0.913, 0.18)
RACE_LEFT = 0.043  # of the race beside its row
FOOTNOTES = {
    "film": "Oil moves to the right; axes stretched; Hertz ellipse dashed; numbers: central and "
    "minimum film; grey: film beyond the colour scale;\ncontour lines at 0.8 … 1.5 of each "
    "contact's central film; error bars: mesh, heat and supply",
    "pressure": "Oil moves to the right; axes stretched; Hertz ellipse dashed; number: largest "
    "pressure;\ncontour lines at 0.1, 0.3 … 0.9 of it",
}
FILLED = "; dotted: filled with oil"
BOX_ENDS = "; hatched: outside the computed box"
MANY_TIMES = 5.0  # largest over smallest film from which on the film axis is logarithmic [-]
COLOURS = {"inner": plot_style.INNER_COLOUR, "outer": plot_style.OUTER_COLOUR}  # by race
FIELDS = {
    "film": Quantity("film_um", "film thickness"),
    "pressure": Quantity("pressure_GPa", "pressure"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class BallColumn:
    """Balls of one row with equal contacts."""

    azimuths: tuple[float, ...]  # [deg]
    views: dict[str, ContactView | None]  # by race
    loads: dict[str, float]  # by race [N]
    row: int | None  # of several, from 1
    # ends along the rolling direction, half width, of every column [mm]
    window: tuple[float, float, float]

    @property
    def label(self) -> str:
        """Azimuths, and below them the number of balls or of the row."""
        text = azimuths_text(self.azimuths)
        if len(text) > WIDE_LABEL:
            text = azimuths_text(self.azimuths, pair=",\n")
        count = f"{len(self.azimuths)} balls" if len(self.azimuths) > 2 else ""
        row = "" if self.row is None else f"row {self.row}"
        below = ", ".join(filter(None, (count, row)))
        return f"{text}\n{below}" if below else text


def ball_columns(results: BearingResults) -> tuple[BallColumn, ...]:
    """Columns of the overview: one for balls of a row with equal contacts, at most `COLUMNS`.

    Azimuths in [deg], ascending; all views show one window.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    tuple[BallColumn, ...]
        The columns.
    """
    groups: dict[tuple[Any, ...], list[float]] = {}
    pairs: dict[tuple[Any, ...], tuple[ContactSolution | None, ...]] = {}
    loads: dict[tuple[Any, ...], dict[str, float]] = {}
    for i in range(0, len(results.contacts), 2):
        ball = results.contacts[i : i + 2]
        azimuth = degrees(ball[0].azimuth) % 360.0
        pair = results.fields[i : i + 2]
        alone = 0.0 if any(pair) else azimuth  # without fields
        key = (alone, ball[0].row, *map(_looks, pair))
        groups.setdefault(key, []).append(azimuth)
        pairs[key] = pair
        loads[key] = {contact.race.value: contact.load for contact in ball}
    # else no film was asked for
    with_film = [key for key, pair in pairs.items() if pair != (None, None)]
    keys = sorted(with_film or groups, key=lambda key: (key[1], groups[key][0]))
    distinct = {id(s): s for key in keys for s in pairs[key] if s is not None}
    window = _common_window(_ruling([contact_view(s) for s in distinct.values()]))
    views = {name: contact_view(s, window) for name, s in distinct.items()}
    return tuple(
        BallColumn(
            azimuths=tuple(sorted(groups[key])),
            views={race: views.get(id(s)) for race, s in zip(COLOURS, pairs[key], strict=True)},
            loads=loads[key],
            row=key[1] if len(results.quasistatic.rows) > 1 else None,
            window=window,
        )
        for key in _chosen(keys, {key for key in keys if None in pairs[key]})
    )


def _looks(field: ContactSolution | None) -> tuple[str, ...] | None:
    """Pressure and films to the figures in which pictures are alike."""
    if field is None:
        return None
    films = (field.film_central_dimensionless.value, field.film_minimum_dimensionless.value)
    return tuple(f"{value:.5g}" for value in (field.hertz_pressure, *films))


def _chosen(keys: list[tuple[Any, ...]], idle: set[Any]) -> list[tuple[Any, ...]]:
    """At most `COLUMNS` of the columns' keys, whose second entry is the row: as many of each, the
    loaded ones first; `idle` are those whose balls touch one race alone.
    """
    rows = {key[1]: [same for same in keys if same[1] == key[1]] for key in keys}
    most = max(COLUMNS // max(len(rows), 1), 1)
    chosen = []
    for row in rows.values():
        loaded = [key for key in row if key not in idle]
        rest = [key for key in row if key in idle]
        taken = [loaded[i] for i in evenly_chosen(len(loaded), max(most - bool(rest), 1))]
        taken += [rest[i] for i in evenly_chosen(len(rest), most - len(taken))]
        chosen += [key for key in row if key in taken]
    return chosen[:COLUMNS]


def _ruling(views: list[ContactView]) -> list[ContactView]:
    """The contacts under load, after which a picture of all chooses its scales."""
    least = plot_style.RULING_PRESSURE * max((view.hertz for view in views), default=0.0)
    return [view for view in views if view.hertz >= least]


def _common_window(views: list[ContactView]) -> tuple[float, float, float]:
    """Part that all maps show: ends along the rolling direction, half width [mm]."""
    x_in = max((-SHOWN_INLET * v.half_x for v in views), default=1.0)
    x_out = max((SHOWN_OUTLET * v.half_x for v in views), default=1.0)
    return -x_in, x_out, max((SHOWN_SIDE * v.half_y for v in views), default=1.0)


def write_bearing_plots(
    results: BearingResults, directory: Path, picture: tuple[str, int] | None = None
) -> tuple[str, ...]:
    """Draw load zone, torque and contacts, equal ones once; figures that failed are messages.

    All pictures, or the one of that kind and number from 0, if there is one.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.
    directory : Path
        Folder to write into.
    picture : tuple[str, int] | None, optional
        Kind of a picture and its number from 0; all if None.

    Returns
    -------
    tuple[str, ...]
        Messages on figures that failed.
    """
    if picture is None:
        return plot_style.write_figures(
            directory, chain(*(figures(results) for figures in FIGURES.values()))
        )
    kind, number = picture
    return plot_style.write_figures(directory, islice(FIGURES[kind](results), number, number + 1))


def _film_figures(results: BearingResults) -> Iterator[tuple[str, Callable[[Figure], None]]]:
    yield "plots/load_zone", partial(draw_load_zone, results=results)
    groups = distinct_contacts(results)
    for quantity in ("film", "pressure") if groups else ():
        draw = partial(draw_per_azimuth, results=results, quantity=quantity)
        yield f"plots/{quantity}_per_azimuth", draw
    for group in groups:
        first = group.contacts[0]
        view = contact_view(group.field)
        place = f"$Q$ = {first.load:.4g} N, contact angle {degrees(first.contact_angle):.1f}°"
        title = f"{results.title}\n{group.label}: operating film\n{place}, {film_text(view)}"
        name = f"plots/{first.race.value}_ball{first.ball:02d}"
        yield name, partial(draw_contact, view=view, title=title)


def draw_per_azimuth(figure: Figure, results: BearingResults, quantity: str) -> None:
    """Maps of both races on one colour scale, above the values over the azimuth.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.
    quantity : str
        "film" [um] or "pressure" [GPa].
    """
    columns = ball_columns(results)
    # fixed boxes: the layout engine takes as long as the drawing
    figure.set_layout_engine("none")
    figure.set_size_inches(plot_style.PAGE_WIDTH, 6.0)
    of_film = "operating film" if quantity == "film" else quantity
    figure.suptitle(f"{results.title}, {of_film}", fontsize=8.5, y=0.99)
    top = MAPS_TOP - LABEL_LINE * max(column.label.count("\n") for column in columns)
    width = (MAPS["right"] - MAPS["left"]) * min(len(columns) / FEWEST_COLUMNS, 1.0)
    right = MAPS["left"] + width
    boxes = MAPS | {"top": top, "right": right}
    panels: Any = figure.subplots(2, len(columns), squeeze=False, gridspec_kw=boxes)
    limits = _limits([c.views[race] for c in columns for race in COLOURS], quantity)
    start, end, half_width = columns[0].window
    image: Any = None
    for row, race in zip(panels, COLOURS, strict=True):
        for panel, column in zip(row, columns, strict=True):
            loaded = column.loads[race] > 0.0
            image = _small_map(panel, column.views[race], quantity, limits, loaded) or image
            panel.set(xlim=(start, end), ylim=(-(1.0 + ROOM) * half_width, half_width))
            _few_ticks(panel, start, end, len(columns))
            _hatch_outside(panel, column.views[race])
        row[0].set_ylabel(f"{race} race\ntransverse $y$ [mm]")
        row[0].yaxis.set_label_coords(RACE_LEFT, _middle(row[0]), figure.transFigure)
    for panel, column in zip(panels[0], columns, strict=True):
        panel.set_title(f"ψ = {column.label}")
        panel.set_xticklabels([])
    for panel in panels[1]:
        panel.set_xlabel("rolling $x$ [mm]")
    for panel in panels[:, 1:].flat:
        panel.set_yticklabels([])
    extend = "max" if quantity == "film" else "neither"
    label = FIELDS[quantity].label
    height = top - MAPS["bottom"]
    box = figure.add_axes((right + BAR_GAP, MAPS["bottom"], BAR_WIDTH, height))
    bar = figure.colorbar(image, cax=box, label=label, extend=extend)
    if quantity == "film":
        bar.ax.minorticks_off()
        ticks = plot_style.logarithmic_ticks(*limits)
        bar.set_ticks(ticks, labels=[f"{tick:.3g}" for tick in ticks])
    _over_azimuth(figure.add_axes(VALUES), results, quantity, _left_out(columns, results))
    views = [view for column in columns for view in column.views.values() if view is not None]
    starved = quantity == "film" and any(view.filled is not None for view in views)
    note = FOOTNOTES[quantity] + FILLED * starved + BOX_ENDS * any(view.cut for view in views)
    figure.text(
        0.5, 0.008, note, fontsize=6.5, color=plot_style.REFERENCE, ha="center", va="bottom"
    )


def _left_out(columns: tuple[BallColumn, ...], results: BearingResults) -> str:
    """How many of the balls with films have a map, where not all have one."""
    films = results.fields
    available = sum(map(any, zip(films[::2], films[1::2], strict=True)))
    drawn = sum(len(column.azimuths) for column in columns)
    return f"; maps: {drawn} of the {available} balls with films" if drawn < available else ""


def _middle(axes: Axes) -> float:
    """Height of the middle of its box [-]."""
    box = axes.get_position()
    return 0.5 * (box.y0 + box.y1)


def _limits(views: list[ContactView | None], quantity: str) -> tuple[float, float]:
    """Ends of the common colour scale over all maps."""
    shown = _ruling([v for v in views if v is not None])
    if quantity == "pressure":
        return 0.0, max(v.pressure_top for v in shown)
    return common_film_range([v.central for v in shown], [v.smallest for v in shown])


def _hatch_outside(axes: Axes, view: ContactView | None) -> None:
    """Mark what of a panel lies outside the computed box."""
    if view is None or not view.cut:
        return
    x_first, x_last, y_first, y_last = view.box
    style: Any = {
        "facecolor": "white",
        "edgecolor": plot_style.BEYOND_SCALE,
        "hatch": "////",
        "zorder": 3,
    }
    far = 1e3 * max(map(abs, view.window))
    for start, end in ((-far, x_first), (x_last, far)):
        axes.axvspan(start, end, **style)
    for start, end in ((-far, y_first), (y_last, far)):
        axes.axhspan(start, end, **style)


def _few_ticks(axes: Axes, start: float, end: float, count: int) -> None:
    """Ticks along the rolling direction [mm] that fit below one of `count` narrow maps."""
    ticks = plot_style.few_ticks(start, end, min(5.0, 16.0 / count))
    axes.set_xticks(ticks, [f"{tick:.3g}".replace("-", "−") for tick in ticks])


def _small_map(
    axes: Axes, view: ContactView | None, quantity: str, limits: tuple[float, float], loaded: bool
) -> Any:
    """One map; an empty panel where there is no contact or no field."""
    if view is None:
        axes.set_facecolor("#eeeeee")
        middle: Any = {"ha": "center", "va": "center", "transform": axes.transAxes}
        axes.text(
            0.5, 0.5, "no map" if loaded else "no load", color=plot_style.REFERENCE, **middle
        )
        axes.set(xticks=[], yticks=[])
        return None
    film = quantity == "film"
    levels = view.central * FILM_LEVELS if film else view.pressure_top * PRESSURE_LEVELS
    levels = levels[levels < limits[1]]
    image = draw_map(axes, view, quantity, limits, levels)
    axes.set_facecolor(image.get_cmap()(np.inf if film else 0.0))
    axes.set(xlabel="", ylabel="")
    text = f"{_with_error(view, 'central')}\n{_with_error(view, 'minimum')}"
    text = text if film else f"{view.pressure_top:.3g} GPa"
    small: Any = {"fontsize": 6.5, "transform": axes.transAxes, "zorder": 4}
    axes.text(0.04, 0.03, text, color=plot_style.INK, **small)
    axes.text(0.04, 0.97, view.doubt, va="top", color=plot_style.OUTER_COLOUR, **small)
    return image


def _with_error(view: ContactView, name: str) -> str:
    """Central or minimum film of a contact with its uncertainty, without the unit [um]."""
    return value_with_error(getattr(view, name), getattr(view, f"{name}_uncertainty"), most=3)


def _over_azimuth(axes: Axes, results: BearingResults, quantity: str, maps: str) -> None:
    """Film with error bars, or pressure, of every contact over the azimuth."""
    middle = 0.5 * (1 + len(results.quasistatic.rows))
    drawn: Any = results.operating if quantity == "film" else results.fields
    for race in COLOURS:
        pairs = [
            (degrees(c.azimuth) % 360.0 + ROW_DODGE * (c.row - middle), one)
            for c, one in zip(results.contacts, drawn, strict=True)
            if one is not None and c.race.value == race
        ]
        if pairs:
            azimuth = np.array([place for place, _ in pairs])
            azimuth += -DODGE if race == "inner" else DODGE
            draw: Any = _film_points if quantity == "film" else _pressure_points
            draw(axes, azimuth, [one for _, one in pairs], race)
    balls = np.unique(np.round(BALL_QUANTITY["azimuth_deg"].value(results.quasistatic) % 360.0, 6))
    axes.set_xticks(balls if len(balls) <= 12 else np.arange(0.0, 361.0, 30.0))
    axes.set(xlim=(-12.0, 372.0), ylim=(0.0, 1.12 * axes.get_ylim()[1]))
    if quantity == "film":
        _logarithmic_film(axes, results)
    several = "; rows side by side, row 1 on the left" if len(results.quasistatic.rows) > 1 else ""
    axes.set_xlabel(f"{BALL_QUANTITY['azimuth_deg'].label}{several}{maps}")
    axes.set_ylabel(FIELDS[quantity].label)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))


def _logarithmic_film(axes: Axes, results: BearingResults) -> None:
    """A logarithmic axis where films differ by many times, else the thin ones are not seen."""
    films = [value for film in results.operating if film is not None for value in film.values]
    available = [FIELDS["film"].in_unit(value) for value in films if value]
    if not available or max(available) < MANY_TIMES * min(available):
        return
    axes.set_yscale("log")
    axes.set_ylim(0.5 * min(available), 2.0 * max(available))
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter("{x:.3g}")
    axes.yaxis.set_minor_formatter(NullFormatter())


def _film_points(axes: Axes, azimuth: Any, films: list[ContactFilm], race: str) -> None:
    for name, marker, face in (("central", "o", COLOURS[race]), ("minimum", "v", "white")):
        parts = [getattr(film, name) for film in films]
        value, error = (
            np.array(
                [FIELDS["film"].in_unit(part and getattr(part, which)) for part in parts],
                dtype=float,  # not a number where there is none
            )
            for which in ("value", "error")
        )
        style: Any = {"color": COLOURS[race], "markerfacecolor": face, "markersize": 4}
        style |= {"capsize": 2, "linewidth": 0.9, "label": f"{race} race, {name}"}
        beside = -NUDGE if name == "central" else NUDGE
        axes.errorbar(azimuth + beside, value, error, fmt=marker, **style)


def _pressure_points(axes: Axes, azimuth: Any, fields: list[ContactSolution], race: str) -> None:
    for name, marker, size in (("pressure_maximum", "o", 4), ("hertz_pressure", "_", 9)):
        values = [FIELDS["pressure"].in_unit(getattr(field, name)) for field in fields]
        text = f"{race} race, {'largest' if marker == 'o' else 'Hertz'}"
        axes.plot(azimuth, values, marker, markersize=size, color=COLOURS[race], label=text)


def draw_load_zone(figure: Figure, results: BearingResults) -> None:
    """Contact loads [N] over the azimuth, seen against the axis x: load line upwards.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.
    """
    state = results.quasistatic
    rows = len(state.rows)
    figure.set_size_inches(min(0.5 * rows, 1.0) * plot_style.PAGE_WIDTH, 3.9 if rows == 1 else 4.3)
    figure.suptitle(results.title, fontsize=7.5, wrap=True)
    panels: Any = figure.subplots(1, rows, squeeze=False, subplot_kw={"projection": "polar"})
    top = float(max(state.outer_load.max(), state.inner_load.max()))
    for index, axes in enumerate(panels[0]):
        _load_zone(axes, state.row(index), top, f"row {index + 1}: " if rows > 1 else "")


def _load_zone(axes: Any, state: QuasistaticSolution, top: float, name: str) -> None:
    """Contact loads of one row as bars, on a scale up to the largest load of all rows [N]."""
    axes.set_theta_zero_location("N")
    width = 0.55 * 2.0 * pi / len(state.azimuth)
    outer: Any = {"color": plot_style.OUTER_COLOUR, "alpha": 0.35, "label": "outer race"}
    axes.bar(state.azimuth, state.outer_load, width, **outer)
    axes.bar(
        state.azimuth,
        state.inner_load,
        0.55 * width,
        color=plot_style.INNER_COLOUR,
        label="inner race",
    )
    axes.set_xticks(state.azimuth, [f"{degrees(a) % 360.0:.4g}°" for a in state.azimuth])
    emptiest = int(np.argmin(state.outer_load + np.roll(state.outer_load, -1)))
    axes.set_rlabel_position(degrees(state.azimuth[emptiest] + pi / len(state.azimuth)) % 360.0)
    axes.set_rlim(0.0, 1.05 * top if top > 0.0 else 1.0)
    axes.set_rticks([tick for tick in axes.get_yticks() if 0.0 < tick <= top][1::2])
    axes.set_axisbelow(True)
    axes.grid(linewidth=0.3)
    style: Any = {"title_fontsize": 7, "ncols": 2, "loc": "upper center"}
    title = f"{name}contact load [N] by azimuth ψ"
    axes.legend(title=title, bbox_to_anchor=(0.5, -0.08), **style)


def draw_strength(figure: Figure, results: BearingResults) -> None:
    """Hoop tension and probability of failure over the temperature, a line for each speed.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.

    Raises
    ------
    ValueError
        If the results have no map of the strength.
    """
    strength = results.strength
    if strength is None or strength.inner_map is None:
        raise ValueError("no strength to draw")
    result = strength.inner_map
    ring = next(ring for ring in strength.rings if ring.race is Race.INNER)
    left, right = plot_style.titled_panels(
        figure, f"{results.title}\ninner ring of {ring.material.name}", HEIGHT, 1, 2
    )
    _lines(left, result, from_si("tension_MPa", result.hoop_tension))
    left.set_ylabel("hoop tension [MPa]")
    if ring.material.bending_strength is not None:
        limit = LARGE_SHARE * from_si("strength_MPa", ring.material.bending_strength)
        left.axhline(limit, color=plot_style.REFERENCE, linestyle="--", linewidth=0.8)
        text = f"{LARGE_SHARE:.0%} of the bending strength"
        left.annotate(
            text,
            (0.02, limit),
            xycoords=("axes fraction", "data"),
            xytext=(0, 2),
            textcoords="offset points",
            fontsize=7,
            color=plot_style.REFERENCE,
        )
    left.plot(
        *_operation(results, ring.hoop_tension), "o", color=plot_style.INK, label="this case"
    )
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=6)
    if result.failure_probability is not None:
        _lines(right, result, np.maximum(result.failure_probability, SMALLEST))
        _band(right, result)
        right.set_yscale("log")
        right.set_ylim(SMALLEST, 1.0)
        right.set_ylabel("probability of failure [-]")


def _lines(axes: Axes, result: StrengthMap, values: Array) -> None:
    """A line for each speed over the temperature of the inner ring."""
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, result.speed.size))
    temperature = from_si("temperature_C", result.temperature)
    for j, colour in enumerate(colours):
        label = f"{from_si('speed_rpm', float(result.speed[j])):.5g} rpm"
        axes.plot(temperature, values[:, j], color=colour, label=label)
    axes.set_xlabel("temperature of the inner ring [°C]")
    axes.spines[["top", "right"]].set_visible(False)


def _band(axes: Axes, result: StrengthMap) -> None:
    """The range of the probability by that of the material, at the highest speed."""
    low, high = (
        np.maximum(np.asarray(end)[:, -1], SMALLEST)
        for end in (result.failure_low, result.failure_high)
    )
    temperature = from_si("temperature_C", result.temperature)
    label = "range of the material's data"
    band = axes.fill_between(
        temperature, low, high, color=plot_style.REFERENCE, alpha=0.18, lw=0.0
    )
    axes.legend([band], [label], loc="upper left")


def _operation(results: BearingResults, tension: float) -> tuple[list[float], list[float]]:
    """The case's own point: temperature [degC], hoop tension [MPa]; none without temperatures."""
    given = (results.case.get("temperatures") or {}).get("inner_ring_C")
    return ([], []) if given is None else ([given], [from_si("tension_MPa", tension)])


def other_figures(results: BearingResults) -> Iterator[tuple[str, Callable[[Figure], None]]]:
    """Figures beside those of the films: torque, strength of the rings, film after the supply
    stops.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[tuple[str, Callable[[Figure], None]]]
        Name without suffix and function that draws.
    """
    if results.torque is not None and results.torque.total is not None:
        yield "plots/torque", partial(draw_torque, results=results)
    if results.strength is not None and results.strength.inner_map is not None:
        yield "plots/ring_strength", partial(draw_strength, results=results)
    if results.decay is not None:
        yield "plots/decay", partial(draw_decay, results=results)
    if results.measured is not None:
        yield "plots/measured", partial(draw_measured, comparison=results.measured)


def draw_torque(figure: Figure, results: BearingResults) -> None:
    """Stacked bars of the models [N mm], and below the torque of each ball over its azimuth.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.

    Raises
    ------
    ValueError
        If the results have no torque.
    """
    torque = results.torque
    if torque is None:
        raise ValueError("no torque to draw")
    available = shown_torques(results)
    shares = None if torque.shear is None else torque.shear.torque.per_ball
    height = 1.1 + 0.26 * len(available) + (1.9 if shares is not None else 0.0)
    figure.set_size_inches(plot_style.PAGE_WIDTH, height)
    figure.suptitle(f"{results.title}\nfriction torque by model", fontsize=8.5)
    if shares is None:
        draw_models(figure.subplots(), available, torque.chosen)
        return
    upper, lower = figure.subplots(2, 1, height_ratios=[0.26 * len(available) + 0.5, 1.6])
    draw_models(upper, available, torque.chosen)
    _draw_balls(lower, results, TORQUE.in_unit(shares))


def draw_models(axes: Axes, models: dict[str, ModelTorque], chosen: str | None = None) -> None:
    """Horizontal stacked bars of models [N mm], the chosen one in bold.

    Parameters
    ----------
    axes : Axes
        Axes to draw into.
    models : dict[str, ModelTorque]
        Torque of each model by its name.
    chosen : str | None, optional
        Name of the model of the total.
    """
    sizes = [sum(map(abs, model.components.values())) for model in models.values()]
    visible = VISIBLE * max(sizes, default=0.0)
    own = [name for name in TORQUE_MODELS if name in models]
    names = [*own, *(name for name in models if name not in own)]
    for row, name in enumerate(names):
        _draw_bar(axes, row, models[name], visible)
    titles = shown_titles({name: models[name] for name in names})
    axes.set_yticks(range(len(names)), titles)
    for label, name in zip(axes.get_yticklabels(), names, strict=True):
        if name == chosen:
            label.set_fontweight("bold")
    axes.invert_yaxis()
    axes.set_xlim(
        right=1.13 * max(TORQUE.in_unit(model.total or 0.0) for model in models.values())
    )
    axes.set_xlabel(TORQUE.label)
    axes.spines[["top", "right"]].set_visible(False)
    parts = [item for model in models.values() for item in model.components.items()]
    used = {part for part, value in parts if abs(value) > visible}
    kinds = [*KINDS, _others(used)]
    shown = [(label, colour) for label, colour, members in kinds if used & set(members)]
    handles = [axes.barh(0.0, 0.0, color=colour, label=label) for label, colour in shown]
    axes.legend(handles=handles, ncols=4, loc="lower center", bbox_to_anchor=(0.42, 1.0))


def torque_svg(models: dict[str, ModelTorque]) -> Markup:
    """The bars of models [N mm] as an SVG element, which names each part below the mouse.

    Parameters
    ----------
    models : dict[str, ModelTorque]
        Torque of each model by its name.

    Returns
    -------
    Markup
        The SVG element.
    """
    content = StringIO()
    with matplotlib.rc_context(plot_style.RC | {"svg.fonttype": "none"}):
        figure = Figure(figsize=(plot_style.PAGE_WIDTH, 0.8 + 0.24 * len(models)))
        axes = figure.subplots()
        draw_models(axes, models)
        drawn = [bar for bar in axes.patches if isinstance(bar, Rectangle) and bar.get_width()]
        bars = {f"part{n}": bar for n, bar in enumerate(drawn)}
        for bar in axes.patches:
            bar.set_clip_on(False)
        for name, bar in bars.items():
            bar.set_gid(name)
        figure.savefig(content, format="svg", metadata=dict.fromkeys(METADATA))
    ElementTree.register_namespace("", SVG)
    fonts = content.getvalue().replace("'DejaVu Sans'", "system-ui, 'DejaVu Sans', sans-serif")
    svg = ElementTree.fromstring(fonts.replace("xlink:href", "href"))
    for group in svg.iter(f"{{{SVG}}}g"):
        if (name := group.get("id", "")) in bars:
            title = ElementTree.SubElement(group, f"{{{SVG}}}title")
            title.text = str(bars[name].get_label())
    svg.attrib |= {"role": "img", "aria-label": "bars of the friction torque", "width": "860"}
    del svg.attrib["height"]
    return Markup(ElementTree.tostring(svg, encoding="unicode"))


def _others(components: Iterable[str]) -> tuple[str, str, tuple[str, ...]]:
    """Components of plug-ins, which are of no kind here."""
    available = {part for _, _, members in KINDS for part in members}
    return "other parts", OTHER_PARTS, tuple(part for part in components if part not in available)


def _draw_bar(axes: Axes, row: int, model: ModelTorque, visible: float) -> None:
    right = left = 0.0
    for kind, colour, members in [*KINDS, _others(model.components)]:
        value = TORQUE.in_unit(sum(model.components.get(part, 0.0) for part in members))
        if abs(value) <= TORQUE.in_unit(visible):
            continue
        start = right if value > 0.0 else left
        label = f"{kind} {value:.4g}".replace("-", "\N{MINUS SIGN}")
        axes.barh(row, value, left=start, color=colour, height=0.72, label=[label])
        right, left = (right + value, left) if value > 0.0 else (right, left + value)
    total = f" {TORQUE.in_unit(model.total or 0.0):.4g}"
    axes.text(max(right, 0.0), row, total, va="center", fontsize=7)


def _draw_balls(axes: Axes, results: BearingResults, shares: np.ndarray) -> None:
    """Torque of each ball's contacts over its azimuth from the load line, row beside row."""
    state = results.quasistatic
    several = len(state.rows) > 1
    width = min(18.0, 200.0 / len(shares))
    for row in range(len(state.rows)):
        in_row = state.row_of_ball == row
        azimuth = np.degrees(state.azimuth[in_row]) % 360.0 + (row - 0.5) * width * several
        style: Any = {"color": plot_style.BALL_COLOUR, "alpha": 1.0 if row == 0 else 0.5}
        axes.bar(azimuth, shares[in_row], width=width, label=f"row {row + 1}", **style)
    if several:
        axes.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))  # off the bars
    axes.set_xlim(-20.0, 380.0)
    axes.set_xticks(range(0, 361, 45))
    axes.set(xlabel=BALL_QUANTITY["azimuth_deg"].label, ylabel=f"per ball: {TORQUE.label}")
    axes.spines[["top", "right"]].set_visible(False)


def draw_decay(figure: Figure, results: BearingResults) -> None:
    """Central film [um] over the time [s] after the supply stops, both logarithmic.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.

    Raises
    ------
    ValueError
        If the results have no decay.
    """
    decay = results.decay
    if decay is None:
        raise ValueError("no decay to draw")
    place = f"ball {decay.contact.ball}, {decay.contact.race.value} race"
    title = f"{results.title}\nfilm after the supply stops, {place}"
    axes = plot_style.titled_panels(figure, title, 2.9)
    later = decay.time > 0.0
    seconds = COURSE["time_s"].in_unit(decay.time[later])
    film = COURSE["film_um"].in_unit(decay.film[later])
    text = f"all losses, {decay.loss:.3g} between two balls" if decay.loss else "from ball to ball"
    axes.loglog(seconds[film > 0.0], film[film > 0.0], color=plot_style.INNER_COLOUR, label=text)
    joined = COURSE["joined_um"].in_unit(decay.joined[later])
    style: Any = {"color": plot_style.OUTER_COLOUR, "linestyle": "--", "linewidth": 0.9}
    axes.loglog(seconds, joined, label="closed forms joined, no loss", **style)
    if decay.roughness > 0.0:
        rough = COURSE["film_um"].in_unit(decay.roughness)
        axes.axhline(
            rough, color=plot_style.REFERENCE, linewidth=0.7, linestyle=":", label="roughness"
        )
    axes.set_xlim(seconds[0], seconds[-1])
    axes.set(xlabel=COURSE["time_s"].label, ylabel=COURSE["film_um"].label)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


FIGURES = {FILMS: _film_figures, OTHERS: other_figures}


def draw_measured(figure: Figure, comparison: MeasuredComparison) -> None:
    """Measured points and the computed line of each quantity over the state that varies.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    comparison : MeasuredComparison
        The comparison.
    """
    keys = list(comparison.measured)
    figure.set_size_inches(0.75 * plot_style.PAGE_WIDTH, 0.5 + MEASURED_HEIGHT * len(keys))
    over, label = _abscissa(comparison)
    order = np.argsort(over, kind="stable")
    panels = np.atleast_1d(figure.subplots(len(keys), 1, sharex=True)).tolist()
    ours = COLOURS["inner"]
    theirs = COLOURS["outer"]
    for axes, key in zip(panels, keys, strict=True):
        line = "-" if np.unique(over).size == over.size else "none"
        computed = comparison.computed[key][order]
        measured = comparison.measured[key]
        axes.plot(over[order], computed, "x", ls=line, color=ours, ms=4, label="computed")
        axes.plot(over, measured, "o", color=theirs, ms=4, label="measured")
        axes.set_ylabel(axis_label(key))
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.legend()
    panels[-1].set_xlabel(label)


def _abscissa(comparison: MeasuredComparison) -> tuple[Array, str]:
    """The state that varies, of several the first of `VARIED`; else the number of the row."""
    varied = [
        key
        for key in sorted(comparison.states, key=VARIED.index)
        if np.ptp(comparison.states[key]) > 0.0
    ]
    if varied:
        return comparison.states[varied[0]], axis_label(varied[0])
    count = next(iter(comparison.measured.values())).size
    return np.arange(1.0, count + 1.0), "row"

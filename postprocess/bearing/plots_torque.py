"""Figures of the friction torque: all models side by side in their components, and the share of
every ball; of the film after the supply of oil has stopped.

Figure of the inner ring's strength: hoop tension and failure over temperature and speed.
"""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from io import StringIO
from typing import Any
from xml.etree import ElementTree

import matplotlib
import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from oilfilm.bearing.fits.ring_strength import LARGE_SHARE, StrengthMap
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.torque.models import ModelTorque
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from ..plot_style import (
    BALL_COLOUR,
    CAGE_COLOUR,
    INK,
    INNER_COLOUR,
    OUTER_COLOUR,
    PAGE_WIDTH,
    RC,
    REFERENCE,
    titled_panels,
)
from ..quantities import by_key
from .quantities import BALL_QUANTITY, DECAY_COURSE, TORQUE, TORQUE_MODELS
from .results import BearingResults
from .torque import shown_titles, shown_torques

SMALLEST = 1e-15  # probability at the lower end of the axis [-]
HEIGHT = 3.0  # [in]


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
    left, right = titled_panels(
        figure, f"{results.title}\ninner ring of {ring.material.name}", HEIGHT, 1, 2
    )
    _lines(left, result, from_si("tension_MPa", result.hoop_tension))
    left.set_ylabel("hoop tension [MPa]")
    if ring.material.bending_strength is not None:
        limit = LARGE_SHARE * from_si("strength_MPa", ring.material.bending_strength)
        left.axhline(limit, color=REFERENCE, linestyle="--", linewidth=0.8)
        text = f"{LARGE_SHARE:.0%} of the bending strength"
        left.annotate(
            text,
            (0.02, limit),
            xycoords=("axes fraction", "data"),
            xytext=(0, 2),
            textcoords="offset points",
            fontsize=7,
            color=REFERENCE,
        )
    left.plot(*_operation(results, ring.hoop_tension), "o", color=INK, label="this case")
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
    band = axes.fill_between(temperature, low, high, color=REFERENCE, alpha=0.18, lw=0.0)
    axes.legend([band], [label], loc="upper left")


def _operation(results: BearingResults, tension: float) -> tuple[list[float], list[float]]:
    """The case's own point: temperature [degC], hoop tension [MPa]; none without temperatures."""
    given = (results.case.get("temperatures") or {}).get("inner_ring_C")
    return ([], []) if given is None else ([given], [from_si("tension_MPa", tension)])


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
    ("hysteresis", REFERENCE, ("ME",)),
    ("load term", LOAD, ("load",)),
    ("cage", CAGE_COLOUR, ("cage", "MC")),
    ("churning", DRAG, ("drag",)),
    ("seals", SEAL, ("seal",)),
)
SVG = "http://www.w3.org/2000/svg"
METADATA = ("Creator", "Date", "Format", "Type")  # of SVG, left out
VISIBLE = 1.0e-4  # of the largest torque: smaller parts are not drawn


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
    figure.set_size_inches(PAGE_WIDTH, height)
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
    with matplotlib.rc_context(RC | {"svg.fonttype": "none"}):
        figure = Figure(figsize=(PAGE_WIDTH, 0.8 + 0.24 * len(models)))
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
        style: Any = {"color": BALL_COLOUR, "alpha": 1.0 if row == 0 else 0.5}
        axes.bar(azimuth, shares[in_row], width=width, label=f"row {row + 1}", **style)
    if several:
        axes.legend(ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))  # off the bars
    axes.set_xlim(-20.0, 380.0)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel(BALL_QUANTITY["azimuth_deg"].label)
    axes.set_ylabel(f"per ball: {TORQUE.label}")
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
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    place = f"ball {decay.contact.ball}, {decay.contact.race.value} race"
    figure.suptitle(f"{results.title}\nfilm after the supply stops, {place}", fontsize=8.5)
    axes = figure.subplots()
    later = decay.time > 0.0
    seconds = COURSE["time_s"].in_unit(decay.time[later])
    film = COURSE["film_um"].in_unit(decay.film[later])
    text = f"all losses, {decay.loss:.3g} between two balls" if decay.loss else "from ball to ball"
    axes.loglog(seconds[film > 0.0], film[film > 0.0], color=INNER_COLOUR, label=text)
    joined = COURSE["joined_um"].in_unit(decay.joined[later])
    style: Any = {"color": OUTER_COLOUR, "linestyle": "--", "linewidth": 0.9}
    axes.loglog(seconds, joined, label="closed forms joined, no loss", **style)
    if decay.roughness > 0.0:
        rough = COURSE["film_um"].in_unit(decay.roughness)
        axes.axhline(rough, color=REFERENCE, linewidth=0.7, linestyle=":", label="roughness")
    axes.set_xlim(seconds[0], seconds[-1])
    axes.set_xlabel(COURSE["time_s"].label)
    axes.set_ylabel(COURSE["film_um"].label)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

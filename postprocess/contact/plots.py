"""Figures and tables of one contact: maps and centre lines, interferogram, a line cut.

An optical interferometer would see the film, beside pictures of a ball on a glass disc, as two
beams, reflected by the coated glass and by the ball, with equal strength at normal incidence:

    I = (1 + cos(4 pi n h/lambda + phi))/2

h the film, n the oil's refractive index, lambda the wavelength in vacuum, phi the difference of
the phase shifts at the two reflections (Born and Wolf, Principles of Optics, section 7.5: two-beam
interference). Bright fringes of phi = 0 lie at h = N lambda/(2 n), N = 0, 1, 2 ... Multiple
reflections, absorption, the finite bandwidth of a lamp and the rise of n with pressure are left
out.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import MICROMETRE, MILLIMETRE, NANOMETRE, value_with_error

from .. import plot_style
from ..files import write_csv
from ..open_results import open_contact
from ..plot_style import INNER_COLOUR as FILM_COLOUR
from ..plot_style import OUTER_COLOUR as PRESSURE_COLOUR
from .shown_part import ContactView, contact_view, refined, shown, shown_nodes
from .summary import ContactResults

HEIGHT = 5.9  # of the figure [in]
LINES = 8  # contour intervals of a map
QUANTITIES = ("film", "pressure")
FINE = 201  # nodes of a map each way, between those of the solution
TICKS = 6  # of a colour bar at most
MOST_HERTZ = 3.0  # of the largest pressure: the dry contact of a lighter one is not drawn [-]
TICK_WIDTH = 0.5  # of a map for each of its tick labels [in]
CUT = "the map ends with the computed box"
# boxes, in shares of the figure
PANEL_LEFTS = (0.085, 0.585)
MAP_WIDTH = 0.41
STRETCHED_WIDTH = 0.33
LINE_WIDTH = 0.325
MAP_BOTTOM = 0.49
MAP_HEIGHT = 0.31
BAR_BOTTOM = 0.835
LINE_BOTTOM = 0.125
LINE_HEIGHT = 0.245
SODIUM = 589.3e-9  # mean of the sodium D lines [m]
NODES = 1200  # each way: more than the picture has pixels
STRETCHED = 2.5  # pictures longer than this are drawn with stretched axes [-]
REFRACTIVE_INDEX = 1.5  # of an oil [-], unverified: give that of yours


def write_contact_plots(results: ContactResults, directory: Path) -> tuple[str, ...]:
    """Draw the contact into the folder `plots`; a figure that failed is a message.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on figures that failed.
    """
    solution = results.solution
    view = contact_view(solution)
    groups = f"$M$ = {solution.moes_load:.4g}, $L$ = {solution.moes_lubricant:.4g}"
    title = f"{results.title}\n{groups}, {film_text(view)}"
    draw = partial(draw_contact, view=view, title=title)
    figures: list[tuple[str, Callable[[Figure], None]]] = [("plots/contact", draw)]
    if results.passes:
        figures.append(("plots/passes", partial(draw_passes, results=results)))
    return plot_style.write_figures(directory, figures)


def draw_contact(figure: Figure, view: ContactView, title: str) -> None:
    """Film and pressure maps of one contact above its centre lines, below lines of a title.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    view : ContactView
        Shown part of the contact.
    title : str
        Lines of the title.
    """
    # fixed boxes: the layout engine takes longer than the drawing
    figure.set_layout_engine("none")
    figure.set_size_inches(plot_style.PAGE_WIDTH, HEIGHT)
    figure.suptitle(title, fontsize=8.5, y=0.99)
    for quantity, left in zip(QUANTITIES, PANEL_LEFTS, strict=True):
        width = STRETCHED_WIDTH if view.stretched else MAP_WIDTH
        panel = figure.add_axes((left, MAP_BOTTOM, width, MAP_HEIGHT))
        image = draw_map(panel, view, quantity)
        if view.stretched:
            gap = width + 0.01
            strip = figure.add_axes((left + gap, MAP_BOTTOM, MAP_WIDTH - gap, MAP_HEIGHT))
            draw_map(strip, view, quantity, levels=())
            _in_proportion(strip)
        else:
            panel.set_aspect("equal", anchor="W")
            proportion = float(np.ptp(view.shown[:2]) / np.ptp(view.shown[2:]))
            width = min(MAP_WIDTH, MAP_HEIGHT * HEIGHT / plot_style.PAGE_WIDTH * proportion)
        panel.xaxis.set_major_locator(
            MaxNLocator(max(int(width * plot_style.PAGE_WIDTH / TICK_WIDTH), 1))
        )
        bar = figure.add_axes((left, BAR_BOTTOM, width, 0.018))
        _colour_bar(figure, image, bar, view, quantity)
    for along, left in zip((True, False), PANEL_LEFTS, strict=True):
        centre_line(figure.add_axes((left, LINE_BOTTOM, LINE_WIDTH, LINE_HEIGHT)), view, along)
    style: Any = {"fontsize": 6.5, "color": plot_style.REFERENCE, "ha": "center", "va": "bottom"}
    figure.text(0.5, 0.01, _footnote(view), **style)


def _footnote(view: ContactView) -> str:
    """Remarks on the figure: direction of the oil, shown range, colours."""
    fills = " and fills the gap inside the dotted line" if view.filled is not None else ""
    where = f"at {view.oblique:.3g}° from x towards y" if view.oblique else "to the right"
    stretched = "axes stretched, so that the Hertz ellipse (dashed) is seen"
    ellipse = stretched if view.stretched else "Hertz ellipse dashed"
    ends = [end / view.half_x for end in (*view.shown[:2], *view.box[:2])]
    range_text = "{:.3g} ... {:.3g} of the computed {:.4g} ... {:.4g}".format(*ends)
    shown = f"shown is x/a = {range_text}".replace("-", "\N{MINUS SIGN}")
    cut = f"; {CUT}" if view.cut else ""
    return (
        f"Oil moves {where}{fills}; {ellipse};\n{shown}; film beyond the colour scale is grey{cut}"
    )


def draw_map(
    axes: Axes,
    view: ContactView,
    quantity: str,
    limits: tuple[float, float] | None = None,
    levels: Sequence[float] | Array | None = None,
) -> Any:
    """One map with contour lines and the Hertz ellipse; the oil moves to the right.

    Parameters
    ----------
    axes : Axes
        Axes to draw into.
    view : ContactView
        Shown part of the contact.
    quantity : str
        "film" or "pressure".
    limits : tuple[float, float] | None, optional
        Ends of the colour scale in the unit of the quantity; films then have a logarithmic scale.
    levels : Sequence[float] | Array | None, optional
        Contour lines in that unit; equal steps if None.

    Returns
    -------
    Any
        The image, for a colour bar.
    """
    film = quantity == "film"
    field = view.film if film else view.pressure
    low, high = limits or (view.film_range if film else (0.0, view.pressure_top))
    x, y, values = refined(view.x, view.y, field, FINE)
    image = axes.imshow(
        values.T,
        extent=_extent(x, y),
        origin="lower",
        aspect="auto",
        cmap=plot_style.colour_map(quantity),
        norm="log" if film and limits else "linear",
        interpolation="bilinear",
        interpolation_stage="data",
    )
    image.set_clim(low, high)
    if film:
        image.set_cmap(image.get_cmap().with_extremes(over=plot_style.BEYOND_SCALE))
    lines = np.linspace(low, high, LINES + 1)[1:-1] if levels is None else levels
    available = values[np.isfinite(values)]
    lines = [line for line in lines if available.size and available.min() < line < available.max()]
    if lines:
        style: Any = {"colors": "white" if film else "black", "alpha": 0.6}
        axes.contour(x, y, values.T, levels=lines, **style)
    axes.plot(*view.ellipse, color="black", linestyle=(0, (4, 2)), linewidth=0.8)
    if view.filled is not None and 0.0 < view.filled.min() < 1.0:
        meniscus: Any = {"colors": FILM_COLOUR, "linestyles": ":", "linewidths": 1.0}
        axes.contour(view.x, view.y, view.filled.T, levels=[0.999], **meniscus)
    axes.set_xlim(view.shown[:2])
    axes.set_ylim(view.shown[2:])
    axes.set_xlabel(f"{view.names[0]} [{view.length_unit}]")
    axes.set_ylabel(f"{view.names[1]} [{view.length_unit}]")
    return image


def _extent(x: Array, y: Array) -> tuple[float, float, float, float]:
    """Edges of an image whose pixels are nodes at equal steps; in their unit, as [mm]."""
    dx = 0.5 * float(x[1] - x[0])
    dy = 0.5 * float(y[1] - y[0])
    return float(x[0]) - dx, float(x[-1]) + dx, float(y[0]) - dy, float(y[-1]) + dy


def _in_proportion(axes: Axes) -> None:
    """Make the map a strip in true proportion beside the stretched one."""
    axes.set_aspect("equal")
    axes.set_title("equal\nscales", fontsize=6.5)
    axes.set(xlabel="", ylabel="", xticks=[], yticks=[])


def _colour_bar(figure: Figure, image: Any, axes: Axes, view: ContactView, quantity: str) -> None:
    film = quantity == "film"
    label = f"film thickness [{view.film_unit}]" if film else f"pressure [{view.pressure_unit}]"
    extend = "max" if film else "neither"
    bar = figure.colorbar(image, cax=axes, orientation="horizontal", extend=extend)
    bar.set_label(label)
    bar.ax.xaxis.set_major_locator(MaxNLocator(TICKS))
    bar.ax.xaxis.set_major_formatter("{x:.3g}")
    bar.ax.xaxis.set_ticks_position("top")
    bar.ax.xaxis.set_label_position("top")


def centre_line(axes: Axes, view: ContactView, along: bool) -> None:
    """Pressure and film along the middle of the contact, in rolling direction or across it.

    Parameters
    ----------
    axes : Axes
        Axes to draw into.
    view : ContactView
        Shown part of the contact.
    along : bool
        Along the rolling direction, else across it.
    """
    s, pressure = _on_centre_line(view, view.pressure, along)
    axes.plot(s, pressure, color=PRESSURE_COLOUR, label="pressure")
    reach = np.cos(np.linspace(-np.pi, 0.0, 121))
    style: Any = {"color": plot_style.REFERENCE, "linestyle": "--", "linewidth": 0.8}
    ends = view.reach_x if along else view.reach_y
    hertz = view.hertz * np.sqrt(1.0 - reach**2)
    if view.hertz < MOST_HERTZ * view.pressure_top:  # else two lines that rise out of the picture
        axes.plot(ends * reach, hertz, label=f"Hertz, peak {view.hertz:.3g}", **style)
    axes.set_ylim(0.0, 1.08 * view.pressure_top)
    axes.set_xlim(view.shown[:2] if along else view.shown[2:])
    name = view.names[0 if along else 1]
    axes.set_xlabel(f"{name} [{view.length_unit}], at ${'y' if along else 'x'}$ = 0")
    axes.set_ylabel(f"pressure [{view.pressure_unit}]", color=PRESSURE_COLOUR)
    film: Any = axes.twinx()
    _film_line(film, view, *_on_centre_line(view, view.film, along))
    if view.outlet is not None and not along:
        style = {"color": FILM_COLOUR, "linestyle": "-.", "linewidth": 0.8}
        film.plot(view.y, view.outlet, label="oil left behind", **style)
    handles = [*axes.get_legend_handles_labels()[0], *film.get_legend_handles_labels()[0]]
    style = {"loc": "lower center", "bbox_to_anchor": (0.5, 0.99), "handlelength": 1.6}
    columns = 4 if len(handles) <= 4 else 3
    axes.legend(handles=handles, ncols=columns, columnspacing=0.8, **style)


def _on_centre_line(view: ContactView, field: Array, along: bool) -> tuple[Array, Array]:
    """Positions and values along the middle of the contact, in the units of the view."""
    x, y, values = refined(view.x, view.y, field, FINE)
    if along:
        return x, values[:, abs(y).argmin()]
    return y, values[abs(x).argmin()]


def _film_line(axes: Axes, view: ContactView, s: Array, film: Array) -> None:
    """Film along a centre line, the central one with its error bar, the smallest as a level."""
    axes.plot(s, film, color=FILM_COLOUR, label="film")
    style: Any = {"fmt": "o", "markersize": 2.5, "capsize": 2, "color": FILM_COLOUR}
    axes.errorbar([0.0], [view.central], [view.central_uncertainty], **style)
    style = {"color": FILM_COLOUR, "linestyle": ":", "linewidth": 0.8}
    axes.axhline(view.minimum, label="smallest film", **style)
    axes.set_ylim(0.0, 3.0 * view.central if view.central > 0.0 else 1.0)
    axes.set_ylabel(f"film thickness [{view.film_unit}]", color=FILM_COLOUR)


def film_text(view: ContactView) -> str:
    """Central and minimum film with their uncertainties ([um] or [a^2/Rx]), and any doubt.

    Parameters
    ----------
    view : ContactView
        Shown part of the contact.

    Returns
    -------
    str
        The words.
    """
    central = value_with_error(view.central, view.central_uncertainty)
    minimum = value_with_error(view.minimum, view.minimum_uncertainty)
    doubt = f" ({view.doubt})" if view.doubt else ""
    return f"$h_c$ = {central} {view.film_unit}, $h_{{min}}$ = {minimum} {view.film_unit}{doubt}"


def draw_passes(figure: Figure, results: ContactResults) -> None:
    """Film over the passes, and the layers that they leave over the track.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : ContactResults
        Results of the contact.
    """
    number = len(results.passes)
    title = f"{results.title}\neach pass stands behind the layer that the last one left"
    left, right = plot_style.titled_panels(figure, title, 3.0, 1, 2)
    films = [one for one in results.passes if one.solution.converged]
    style: Any = {"color": FILM_COLOUR, "marker": "o", "markersize": 3, "linewidth": 1.0}
    left.plot(range(1, len(films) + 1), [one.film_fraction for one in films], **style)
    left.set_ylim(0.0, 1.05)
    left.set(xlabel="pass [-]", ylabel="central film over the flooded one [-]")
    left.xaxis.get_major_locator().set_params(integer=True)
    first = results.solution
    scale = first.film_scale
    unit = 1.0 if scale is None else scale / MICROMETRE
    colours = plot_style.colour_stops("film", number + 1)[:number]
    for index, one in enumerate(results.passes, 1):
        label = f"pass {index}" if index in (1, number) else None
        y = one.solution.Y / first.semi_axis_ratio
        style = {"color": colours[index - 1], "linewidth": 0.9, "label": label}
        right.plot(y, one.outlet * unit, **style)
    for side in (-1.0, 1.0):
        right.axvline(side, color=plot_style.REFERENCE, linestyle="--", linewidth=0.6)
    right.set_xlabel("$y/b$ [-]; the contact ends at ±1")
    right.set_ylabel(f"layer that leaves [{'a²/Rx' if scale is None else 'µm'}]")
    right.set_yscale("log")
    right.legend(loc="upper center")
    for axes in (left, right):
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.spines[["top", "right"]].set_visible(False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Optics:
    """Wavelengths [m], one for grey, three for colours; refractive index [-]; phase [rad]."""

    wavelengths: tuple[float, ...] = (SODIUM,)
    refractive_index: float = REFRACTIVE_INDEX
    phase: float = 0.0

    def __post_init__(self) -> None:
        shown = all(1e-8 < length < 1e-4 for length in self.wavelengths)
        if not shown or len(self.wavelengths) not in (1, 3):
            raise ValueError("wavelengths must be one or three, between 10 nm and 0.1 mm")
        if not 1.0 <= self.refractive_index < 5.0:
            index = self.refractive_index
            raise ValueError(f"refractive_index must lie between 1 and 5, got {index}")


def intensity(film: Array, optics: Optics) -> Array:
    """Reflected intensity of a film over its largest value.

    Parameters
    ----------
    film : Array
        Film thickness [m].
    optics : Optics
        Wavelengths, refractive index and phase.

    Returns
    -------
    Array
        Intensity, shape of the film, with an axis of three colours [-].
    """
    layers = [
        0.5 * (1.0 + np.cos(4.0 * pi * optics.refractive_index * film / w + optics.phase))
        for w in optics.wavelengths
    ]
    return layers[0] if len(layers) == 1 else np.stack(layers, axis=-1)


def write_interferogram(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    optics: Optics | None = None,
) -> Path:
    """Draw the simulated interferogram of one contact of a result folder.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        PNG file.
    contact : str | None, optional
        Name of the contact, as in `open_contact`.
    optics : Optics | None, optional
        Wavelengths, refractive index and phase.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without such a contact, or if its film has no dimension.
    """
    path = Path(file)
    if path.suffix.lower() != ".png":
        raise ValueError(f"the picture must be a .png file, got {path.name}")
    name, data = open_contact(directory, contact)
    if data["h"].attrs["units"] != "m":
        reason = "since the contact is given by Moes' groups"
        raise ValueError(f"{name}: the film has no dimension, {reason}")
    plot_style.write_figure(path, lambda figure: _draw(figure, name, data, optics or Optics()))
    return path


def _draw(figure: Figure, name: str, data: Any, optics: Optics) -> None:
    x, y, film = _fine_film(data)
    width, height = float(np.ptp(x)), float(np.ptp(y))
    equal = 1.0 / STRETCHED < width / height < STRETCHED
    side = 0.6 * plot_style.PAGE_WIDTH
    figure.set_size_inches(side, side * (min(1.4, height / width) if equal else 1.0) + 0.6)
    axes = figure.add_subplot()
    picture = intensity(film, optics)
    ends = tuple(end / MILLIMETRE for end in (x[0], x[-1], y[0], y[-1]))
    style: Any = {"cmap": "gray", "vmin": 0.0, "vmax": 1.0, "origin": "lower", "extent": ends}
    axes.imshow(np.swapaxes(picture, 0, 1), aspect="equal" if equal else "auto", **style)
    axes.set_xlabel(f"{data['x'].attrs['long_name']} [mm]")
    axes.set_ylabel(f"{data['y'].attrs['long_name']} [mm]")
    lengths = ", ".join(f"{w / NANOMETRE:.4g}" for w in optics.wavelengths)
    index = f"n = {optics.refractive_index:g}"
    axes.set_title(f"{name}: simulated interferogram, {lengths} nm, {index}")
    step = optics.wavelengths[0] / (2.0 * optics.refractive_index) / NANOMETRE
    note = f"from fringe to fringe {step:.4g} nm of film"
    note += " (first wavelength)" if len(optics.wavelengths) > 1 else ""
    note += "" if equal else "; axes stretched"
    figure.supxlabel(note, fontsize=6.5, color=plot_style.REFERENCE)


def _fine_film(data: Any) -> tuple[Array, Array, Array]:
    """Positions and film [m] of the shown part, between the nodes; fringes are finer."""
    part = shown_nodes(data)
    x, y = data["x"].values[part[0]], data["y"].values[part[1]]
    return refined(x, y, data["h"].values[part], NODES)


def write_line_cut(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    axis: str = "x",
    at: float = 0.0,
) -> Path:
    """Write position [mm], film [um] and pressure [GPa] along one axis, linear between nodes.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        CSV file.
    contact : str | None, optional
        Name of the contact, as in `open_contact`.
    axis : str, default 'x'
        "x", along the entrainment, or "y", across it.
    at : float, default 0.0
        Position of the line on the other axis, in Hertz half extents [-].

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without such a contact, or if the line lies outside the box.
    """
    if axis not in ("x", "y"):
        raise ValueError(f"axis must be x or y, got {axis!r}")
    name, data = open_contact(directory, contact)
    other = "y" if axis == "x" else "x"
    semi_axis = float(data.attrs[f"semi_axis_{other}"])
    place = at * semi_axis
    across = data[other].values
    if not across[0] <= place <= across[-1]:
        ends = (across[[0, -1]] / semi_axis).round(3).tolist()
        raise ValueError(
            f"{name}: the line at {other} = {at:g} is outside the box, {ends} semi-axes"
        )
    values, unit = shown("x", data[axis].attrs["units"], data[axis].values)
    columns = {f"{axis} [{unit}]": values}
    for label, field in (("film", "h"), ("pressure", "P")):
        rows = data[field].values if axis == "x" else data[field].values.T
        line = np.array([np.interp(place, across, row) for row in rows])
        values, unit = shown(field, data[field].attrs["units"], line)
        columns[f"{label} [{unit}]"] = values
    path = Path(file)
    write_csv(path, columns, zip(*columns.values(), strict=True), ".7g")
    return path

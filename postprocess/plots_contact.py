"""Figure of one contact: film map, pressure map, and both along the two centre lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .plot_style import COLOUR_MAPS, INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE, ContactView, value_with_error

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

LINES = 8  # contour intervals of a map
QUANTITIES = ("film", "pressure")
FILM_COLOUR, PRESSURE_COLOUR = INNER_COLOUR, OUTER_COLOUR


def draw_contact(figure: Figure, view: ContactView, title: str) -> None:
    """Film and pressure maps of one contact above its centre lines.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    view : ContactView
        Lengths in [mm], film in [um], pressure in [GPa], or dimensionless.
    title : str
        Lines above the figure.
    """
    figure.set_size_inches(PAGE_WIDTH, 5.9)
    figure.suptitle(title, fontsize=8.5)
    halves: Any = figure.subfigures(2, 1, height_ratios=[1.3, 1.0])
    maps, lines = halves
    if view.stretched:
        strip = float(np.clip(np.ptp(view.x) / np.ptp(view.y), 0.1, 0.5))
        panels = list(maps.subplots(1, 4, width_ratios=[1.0, strip, 1.0, strip]))
        for quantity, panel, narrow in zip(QUANTITIES, panels[::2], panels[1::2], strict=True):
            image = draw_map(panel, view, quantity)
            draw_map(narrow, view, quantity, contours=False)
            _in_proportion(narrow, view)
            _colour_bar(maps, image, panel, view, quantity)
    else:
        for quantity, panel in zip(QUANTITIES, maps.subplots(1, 2), strict=True):
            image = draw_map(panel, view, quantity)
            panel.set_aspect("equal")
            _colour_bar(maps, image, panel, view, quantity)
    for axes, along in zip(lines.subplots(1, 2), (True, False), strict=True):
        centre_line(axes, view, along)
    lines.supxlabel(_footnote(view), fontsize=6.5, color=REFERENCE)


def _footnote(view: ContactView) -> str:
    """What the figure leaves out and how it is drawn."""
    scale = (
        "axes stretched, so that the Hertz ellipse (dashed) is seen; " if view.stretched else "Hertz ellipse dashed; "
    )
    ends = [end / view.half_x for end in (view.x[0], view.x[-1])]
    return (
        f"oil moves to the right; {scale}shown is x/a = {ends[0]:.3g} ... {ends[1]:.3g} "
        f"of the computed {view.whole[0]:.3g} ... {view.whole[1]:.3g}; equal film steps between contour lines"
    )


def draw_map(
    axes: Axes,
    view: ContactView,
    quantity: str,
    limits: tuple[float, float] | None = None,
    contours: bool = True,
) -> Any:
    """One map with contour lines and the Hertz ellipse, x to the right in the direction of the oil.

    Parameters
    ----------
    axes : matplotlib Axes
    view : ContactView
        Lengths in [mm], film in [um], pressure in [GPa], or dimensionless.
    quantity : {"film", "pressure"}
    limits : tuple of float, optional
        Ends of the colour scale, in the unit of the quantity.
    contours : bool

    Returns
    -------
    matplotlib image
    """
    film = quantity == "film"
    field = view.film if film else view.pressure
    low, high = limits or (view.film_range if film else (0.0, float(view.pressure.max())))
    image = axes.pcolormesh(
        view.x, view.y, field.T, cmap=COLOUR_MAPS[quantity], vmin=low, vmax=high, shading="gouraud", rasterized=True
    )
    if contours:
        levels = np.linspace(low, high, LINES + 1)[1:-1]
        axes.contour(view.x, view.y, field.T, levels=levels, colors="white" if film else "black", alpha=0.6)
    axes.plot(*view.ellipse, color="black", linestyle=(0, (4, 2)), linewidth=0.8)
    axes.set_xlim(view.x[0], view.x[-1])
    axes.set_ylim(view.y[0], view.y[-1])
    axes.set_xlabel(f"rolling direction $x$ [{view.length_unit}]")
    axes.set_ylabel(f"transverse $y$ [{view.length_unit}]")
    return image


def _in_proportion(axes: Axes, view: ContactView) -> None:
    """Make the map a strip in true proportion beside the stretched one."""
    axes.set_aspect("equal")
    axes.set_title("equal\nscales", fontsize=6.5)
    axes.set_xlabel("")
    axes.set_ylabel("")
    axes.set_xticks([])
    axes.set_yticks([])


def _colour_bar(figure: Any, image: Any, axes: Axes, view: ContactView, quantity: str) -> None:
    film = quantity == "film"
    label = f"film thickness [{view.film_unit}]" if film else f"pressure [{view.pressure_unit}]"
    figure.colorbar(
        image, ax=axes, location="top", label=label, extend="max" if film else "neither", aspect=30, pad=0.02
    )


def centre_line(axes: Axes, view: ContactView, along: bool) -> None:
    """Pressure and film along the middle of the contact.

    Parameters
    ----------
    axes : matplotlib Axes
    view : ContactView
        Lengths in [mm], film in [um], pressure in [GPa], or dimensionless.
    along : bool
        Along the rolling direction, or across it.
    """
    i, j = abs(view.x).argmin(), abs(view.y).argmin()
    cut = (slice(None), j) if along else (i, slice(None))
    s = view.x if along else view.y
    axes.plot(s, view.pressure[cut], color=PRESSURE_COLOUR, label="pressure")
    axes.plot(s, view.hertz[cut], color=REFERENCE, linestyle="--", linewidth=0.8, label="Hertz")
    axes.set_ylim(0.0, 1.08 * float(view.pressure.max()))
    axes.set_xlim(s[0], s[-1])
    name = "rolling direction $x$" if along else "transverse $y$"
    axes.set_xlabel(f"{name} [{view.length_unit}], at ${'y' if along else 'x'}$ = 0")
    axes.set_ylabel(f"pressure [{view.pressure_unit}]", color=PRESSURE_COLOUR)
    film = axes.twinx()
    film.plot(s, view.film[cut], color=FILM_COLOUR, label="film")
    film.errorbar(
        [0.0], [view.central], [view.central_uncertainty], fmt="o", markersize=2.5, capsize=2, color=FILM_COLOUR
    )
    film.axhline(view.minimum, color=FILM_COLOUR, linestyle=":", linewidth=0.8, label="smallest film")
    film.set_ylim(0.0, 3.0 * view.central)
    film.set_ylabel(f"film thickness [{view.film_unit}]", color=FILM_COLOUR)
    handles = [*axes.get_legend_handles_labels()[0], *film.get_legend_handles_labels()[0]]
    axes.legend(
        handles=handles, ncols=4, loc="lower center", bbox_to_anchor=(0.5, 0.99), columnspacing=1.0, handlelength=1.6
    )


def film_text(view: ContactView) -> str:
    """Central and minimum film with their uncertainties, in the unit of the plots ([um] or [a^2/Rx])."""
    central = value_with_error(view.central, view.central_uncertainty)
    minimum = value_with_error(view.minimum, view.minimum_uncertainty)
    return f"$h_c$ = {central} {view.film_unit}, $h_{{min}}$ = {minimum} {view.film_unit}"

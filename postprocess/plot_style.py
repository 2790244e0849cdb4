"""Common to all plots: type sizes, colours, colour maps, the part of a contact shown, saving."""

import io
import re
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Colormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from matplotlib.text import Text

from oilfilm.bearing.files import write_bytes
from oilfilm.ehl.arrays import Array

# a formula has no blanks beside its signs and no digit behind them; others are amounts
FORMULA = re.compile(r"(\$(?=\S)[^$\n]*(?<=\S)\$(?!\d))")
PAGE_WIDTH = 7.1  # two columns, 180 mm [in]
DPI = 200
FORMATS = (".png", ".pdf", ".svg")  # of pictures
# level of zlib, 1 to 9; of a contact's picture 1 takes 0.04 s and 0.40 MB, 3 0.04 s and 0.38 MB,
# the default 6 0.07 s and 0.35 MB, 9 0.33 s and 0.34 MB
PNG_COMPRESSION = 3
INNER_COLOUR = "#0b5394"
OUTER_COLOUR = "#c1440e"
CAGE_COLOUR = "#a6761d"
BALL_COLOUR = "#6b7785"
REFERENCE = "#666666"
INK = "#1b1f24"
# perceptually uniform
COLOUR_MAPS = {"film": "viridis", "pressure": "magma_r", "displacement": "plasma"}
PAPER_WHITE = 0.12  # of the pressure's colours, which begin white [-]
RC: Any = {
    "font.size": 8.0,
    "font.family": "DejaVu Sans",
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.frameon": False,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.2,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "contour.linewidth": 0.4,
    "figure.constrained_layout.use": True,
}
# share of the largest Hertz pressure, 1/20 of the load [-]: contacts above it rule colours and
# window, not the balls that carry little more than their centrifugal force
RULING_PRESSURE = 0.05 ** (1.0 / 3.0)
TICK_GAP = 0.05  # between ticks of a logarithmic colour bar, of its length [-]
BEYOND_SCALE = "#e4e7eb"  # film thicker than the colour scale


def film_ticks(low: float, high: float) -> list[float]:
    """About eight round values on a linear scale.

    Parameters
    ----------
    low : float
        Lower end [any unit].
    high : float
        Upper end, in that unit.

    Returns
    -------
    list[float]
        Values of the ticks.
    """
    step = 10.0 ** np.floor(np.log10((high - low) / 4.0))
    step *= 5.0 if (high - low) / step > 30.0 else 2.0 if (high - low) / step > 12.0 else 1.0
    numbers = np.arange(np.ceil(low / step), np.floor(high / step) + 1.0)
    return [float(tick) for tick in numbers * step]


def few_ticks(low: float, high: float, most: float) -> list[float]:
    """Multiples of a round step, at most so many steps (2 or more), and two ticks at least.

    Parameters
    ----------
    low : float
        Lower end [any unit].
    high : float
        Upper end, in that unit.
    most : float
        Steps at most, 2 or more [-].

    Returns
    -------
    list[float]
        Values of the ticks.
    """
    size = 10.0 ** np.floor(np.log10(high - low))
    steps = [factor * size for factor in (5.0, 2.5, 2.0, 1.0, 0.5, 0.2, 0.1)]
    fitting = [step for step in steps if (high - low) / step <= most]
    step = min(fitting)
    while np.floor(high / step) - np.ceil(low / step) < 1.0:
        step *= 0.5
    numbers = np.arange(np.ceil(low / step), np.floor(high / step) + 1.0)
    return [float(tick) for tick in numbers * step]


def logarithmic_ticks(low: float, high: float) -> list[float]:
    """Round values on a logarithmic scale, none too near to another.

    Parameters
    ----------
    low : float
        Lower end, positive [any unit].
    high : float
        Upper end, in that unit.

    Returns
    -------
    list[float]
        Values of the ticks.
    """
    ticks: list[float] = []
    for tick in film_ticks(low, high):
        if not ticks or np.log(tick / ticks[-1]) > TICK_GAP * np.log(high / low):
            ticks.append(tick)
    return ticks


def colour_stops(quantity: str, count: int) -> Array:
    """Even colours of a quantity's map, red, green, blue from 0 to 1 [-], shape (count, 3).

    Parameters
    ----------
    quantity : str
        "film", "pressure" or "displacement".
    count : int
        Colours [-].

    Returns
    -------
    Array
        Red, green and blue from 0 to 1, shape (count, 3) [-].
    """
    return np.asarray(colour_map(quantity)(np.linspace(0.0, 1.0, count))[:, :3])


@cache
def colour_map(quantity: str) -> Colormap:
    """Colours of a quantity, white where there is no pressure.

    Parameters
    ----------
    quantity : str
        "film", "pressure" or "displacement".

    Returns
    -------
    Colormap
        The colours.
    """
    own = matplotlib.colormaps[COLOUR_MAPS[quantity]]
    if quantity != "pressure":
        return own
    share = np.linspace(0.0, 1.0, own.N)
    white = np.clip(1.0 - share / PAPER_WHITE, 0.0, 1.0)[:, None]
    return ListedColormap(white + (1.0 - white) * own(share))


def titled_panels(
    figure: Figure, title: str, height: float, rows: int = 1, columns: int = 1, **options: Any
) -> Any:
    """Panels of a page-wide picture below its title, as `Figure.subplots` gives them.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    title : str
        Title of the picture.
    height : float
        Height of the picture [in].
    rows, columns : int, default 1
        Panels one below the other and side by side [-].
    **options : Any
        Further options of `Figure.subplots`.

    Returns
    -------
    Any
        Axes, or an array of them.
    """
    figure.set_size_inches(PAGE_WIDTH, height)
    figure.suptitle(title, fontsize=8.5)
    return figure.subplots(rows, columns, **options)


def save(figure: Figure, path: Path) -> None:
    """Write a figure as PNG, PDF or SVG under its final name when it is complete.

    The canvas draws a PNG once; `Figure.savefig` gives the same pixels, but draws twice.

    Parameters
    ----------
    figure : Figure
        Drawn figure.
    path : Path
        File that ends in .png, .pdf or .svg.

    Raises
    ------
    ValueError
        If the file has another suffix.
    """
    kind = path.suffix.lower()
    if kind not in FORMATS:
        raise ValueError(f"{path.name}: allowed: a file that ends in {', '.join(FORMATS)}")
    write_bytes(path, _content(figure, kind, DPI))


def _content(figure: Figure, kind: str, dpi: int) -> bytes:
    """A drawn figure as PNG, PDF or SVG."""
    figure.set_dpi(dpi)
    keep_dollars(figure)
    content = io.BytesIO()
    if kind == ".png":
        FigureCanvasAgg(figure).print_png(content, pil_kwargs={"compress_level": PNG_COMPRESSION})
    else:
        figure.savefig(content, format=kind[1:])
    return content.getvalue()


def png_of(draw: Callable[[Figure], object], dpi: int = DPI) -> bytes:
    """Draw into an empty figure, as a PNG in memory.

    Parameters
    ----------
    draw : Callable[[Figure], object]
        Draws into an empty figure.
    dpi : int, default DPI
        Pixels an inch [-].

    Returns
    -------
    bytes
        The picture.
    """
    with matplotlib.rc_context(RC):
        return _content(figure_of(draw), ".png", dpi)


def keep_dollars(figure: Figure) -> None:
    """Draw dollar signs that enclose no formula, as in titles of users, as they are.

    Parameters
    ----------
    figure : Figure
        Drawn figure, changed.
    """
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        words = text.get_text()
        if "$" in words:
            text.set_text("".join(map(_as_drawn, FORMULA.split(words))))


def _as_drawn(part: str) -> str:
    """A formula as it is, if matplotlib can draw it; else with its dollar signs escaped."""
    if FORMULA.fullmatch(part):
        with suppress(ValueError):
            MathTextParser("path").parse(part)
            return part
    return re.sub(r"(?<!\\)\$", r"\\$", part)


def write_figure(path: Path, draw: Callable[[Figure], object]) -> None:
    """Draw into an empty figure and write it.

    Parameters
    ----------
    path : Path
        File that ends in .png, .pdf or .svg.
    draw : Callable[[Figure], object]
        Draws into an empty figure.
    """
    with matplotlib.rc_context(RC):
        save(figure_of(draw), path)


def figure_of(draw: Callable[[Figure], object]) -> Figure:
    """Draw into an empty figure.

    Parameters
    ----------
    draw : Callable[[Figure], object]
        Draws into an empty figure.

    Returns
    -------
    Figure
        The figure.
    """
    with matplotlib.rc_context(RC):
        figure = Figure(dpi=DPI)
        draw(figure)
    return figure


def write_figures(
    directory: Path,
    figures: Iterable[tuple[str, Callable[[Figure], object]]],
    is_interrupted: Callable[[], bool] = lambda: False,
) -> tuple[str, ...]:
    """Write PNG pictures by their paths without suffix; what cannot be drawn is a message.

    Parameters
    ----------
    directory : Path
        Folder of the pictures.
    figures : Iterable[tuple[str, Callable[[Figure], object]]]
        Path without suffix and function that draws, of each picture.
    is_interrupted : Callable[[], bool], default lambda: False
        Asked before each picture; once it is true no further one is drawn.

    Returns
    -------
    tuple[str, ...]
        What could not be drawn, and why.
    """
    problems: list[str] = []
    for name, draw in figures:
        if is_interrupted():
            return (*problems, "the other pictures not written: interrupted")
        try:
            write_figure(directory / f"{name}.png", draw)
        # fields may be such that no picture can be drawn
        except (ValueError, ArithmeticError, LookupError, RuntimeError) as error:
            problems.append(f"{name}.png not written: {type(error).__name__}: {error}")
    return tuple(problems)

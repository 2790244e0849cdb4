"""The scene as one page for browsers: what vtk.js does not know of is laid over it, or becomes a
body.

vtk.js draws surfaces with even colour scales; logarithmic colours come as the logarithm itself
with a scale of its own beside the picture, and words in space as flat letters.
"""

import json
from dataclasses import dataclass
from html import escape
from math import log10
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
import xarray

from ehl.units import MILLIMETRE

from ..plot_style import colour_stops, film_ticks
from .parts import INK, Array, label_places

OFFLINE = """<meta http-equiv="Content-Security-Policy" content="img-src data: blob:; connect-src data: blob:">"""
STOPS = 24  # of the gradient of a colour scale
LETTER = 0.32  # height of letters in ball diameters
# letters stand before the rings and off the films by so many ball diameters
FORWARD = 0.8
OUTWARD = 0.55


@dataclass(frozen=True, slots=True, kw_only=True)
class ColourBar:
    """Scale of a scene: label with unit, ends in that unit, whether it is logarithmic."""

    quantity: str
    label: str
    limits: tuple[float, float]
    logarithmic: bool = False

    def height(self, value: float) -> float:
        """Place of a value on the bar, 0 at the bottom, 1 at the top [-]."""
        low, high = self.limits
        if self.logarithmic:
            return log10(value / low) / log10(high / low)
        return (value - low) / (high - low)


def add_words(file: Path, title: str, note: str, bar: ColourBar | None) -> None:
    """Lay title, note and colour scale over an exported page, and keep it from asking anybody."""
    words = f"<b>{escape(title)}</b><br>{escape(note)}; turn, zoom and shift with the mouse"
    style = f"position:fixed;left:12px;top:10px;font:15px system-ui,sans-serif;color:{INK};pointer-events:none"
    over = f'<div style="{style}">{words}</div>' + ("" if bar is None else bar_html(bar))
    text = json.dumps(over).replace("<", "\\u003c")
    # it empties the body
    script = f"<script>document.documentElement.insertAdjacentHTML('beforeend', {text})</script>"
    page = file.read_text(encoding="utf-8").replace("</body>", f"{script}</body>")
    file.write_text(page.replace("<head>", f"<head>{OFFLINE}", 1), encoding="utf-8")


def bar_html(bar: ColourBar) -> str:
    """A colour scale with its ticks as HTML."""
    shades = ",".join(
        f"rgb({r:.0f},{g:.0f},{b:.0f})" for r, g, b in 255.0 * colour_stops(bar.quantity, STOPS)
    )
    ticks = "".join(
        f'<span style="position:absolute;left:20px;bottom:calc({100.0 * bar.height(tick):.2f}% - 8px);'
        f'border-bottom:0;white-space:nowrap">– {tick:.3g}</span>'
        for tick in film_ticks(*bar.limits)
    )
    place = (
        f"position:fixed;right:64px;top:22%;height:56%;width:18px;color:{INK};pointer-events:none"
    )
    label = f'<div style="position:absolute;right:-44px;top:-44px;white-space:nowrap">{escape(bar.label)}</div>'
    return (
        f'<div style="{place};font:14px system-ui,sans-serif;background:linear-gradient(to top,{shades})">'
        f"{ticks}{label}</div>"
    )


def add_flat_labels(plotter: Any, tree: xarray.DataTree, up: Array) -> None:
    """Azimuths and load of a bearing as flat letters that look along +x, upright where `up` is up.

    Parameters
    ----------
    plotter : pyvista.Plotter
    tree : xarray.DataTree
        Results of a bearing.
    up : ndarray, shape (3,)
        Unit vector [-].
    """
    diameter = float(tree["ring"].attrs["ball_diameter"]) / MILLIMETRE
    before = np.array([FORWARD * diameter, 0.0, 0.0])
    for place, words in label_places(tree):
        out = (
            OUTWARD * diameter * place / np.linalg.norm(place)
            if words.endswith("°")
            else np.zeros(3)
        )
        plotter.add_mesh(
            flat_words(words, place + before + out, up, LETTER * diameter),
            color=INK,
            lighting=False,
        )


def flat_words(words: str, place: Array, up: Array, size: float) -> Any:
    """Letters of a height [mm] centred at a place [mm]; the sign of degrees is a ring, which the
    letters lack.
    """
    body = pv.Text3D(
        words.removesuffix("°"),
        depth=0.0,
        height=size,
        center=(0.0, 0.0, 0.0),
        normal=(0.0, 0.0, 1.0),
    )
    if words.endswith("°"):
        right, top = body.bounds[1], body.bounds[3]
        ring = pv.Disc(
            center=(right + 0.2 * size, top - 0.14 * size, 0.0),
            inner=0.08 * size,
            outer=0.14 * size,
            c_res=24,
        )
        body = body.merge(ring)
    right = np.cross([-1.0, 0.0, 0.0], up)
    turn = np.eye(4)
    turn[:3, 0], turn[:3, 1], turn[:3, 2], turn[:3, 3] = right, up, [1.0, 0.0, 0.0], place
    return body.transform(turn, inplace=False)

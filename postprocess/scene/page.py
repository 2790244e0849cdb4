"""The scene as one page for browsers.

vtk.js draws surfaces with even colour scales; logarithmic colours come as the logarithm itself
with a scale of its own beside the picture, and texts in space as flat letters.
"""

import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv

from ehl.solution import Array

from ..plot_style import INK, colour_stops, film_ticks
from .parts import ColourScale, Label

OFFLINE = (
    '<meta http-equiv="Content-Security-Policy" '
    'content="img-src data: blob:; connect-src data: blob:">'
)
STOPS = 24  # of the gradient of a colour scale
LETTER = 0.32  # height of letters in ball diameters
# letters stand before the rings and off the films by so many ball diameters
FORWARD = 0.8
OUTWARD = 0.55
FONT = f"font:{{}}px system-ui,sans-serif;color:{INK};pointer-events:none"
TICK = "position:absolute;left:20px;bottom:calc({:.2f}% - 8px);border-bottom:0;white-space:nowrap"


def add_overlay(file: Path, title: str, note: str, colours: ColourScale | None) -> None:
    """Lay title, note and colour scale over an exported page; it loads nothing from a network."""
    text = f"<b>{escape(title)}</b><br>{escape(note)}; turn, zoom and shift with the mouse"
    style = f"position:fixed;left:12px;top:10px;{FONT.format(15)}"
    over = f'<div style="{style}">{text}</div>' + ("" if colours is None else bar_html(colours))
    # inserted after the body, which the page's own script empties
    literal = json.dumps(over).replace("<", "\\u003c")
    script = f"document.documentElement.insertAdjacentHTML('beforeend', {literal})"
    page = file.read_text(encoding="utf-8")
    page = page.replace("</body>", f"<script>{script}</script></body>")
    file.write_text(page.replace("<head>", f"<head>{OFFLINE}", 1), encoding="utf-8")


def bar_html(colours: ColourScale) -> str:
    """A colour scale with its ticks as HTML."""
    shades = ",".join(
        f"rgb({r:.0f},{g:.0f},{b:.0f})"
        for r, g, b in 255.0 * colour_stops(colours.quantity, STOPS)
    )
    ticks = "".join(
        f'<span style="{TICK.format(100.0 * colours.height(tick))}">– {tick:.3g}</span>'
        for tick in film_ticks(*colours.limits)
    )
    place = "position:fixed;right:64px;top:22%;height:56%;width:18px"
    gradient = f"background:linear-gradient(to top,{shades})"
    label = "position:absolute;right:-44px;top:-44px;white-space:nowrap"
    return (
        f'<div style="{place};{FONT.format(14)};{gradient}">{ticks}'
        f'<div style="{label}">{escape(colours.label)}</div></div>'
    )


def add_flat_labels(plotter: Any, labels: Sequence[Label], up: Array) -> None:
    """Labels as flat letters that look along +x, upright where the unit vector `up` [-] is up."""
    for label in labels:
        before = np.array([FORWARD * label.ball_diameter, 0.0, 0.0])
        if label.text.endswith("°"):
            distance = np.linalg.norm(label.place)
            before += OUTWARD * label.ball_diameter * label.place / distance
        body = flat_text(label.text, label.place + before, up, LETTER * label.ball_diameter)
        plotter.add_mesh(body, color=INK, lighting=False)


def flat_text(text: str, place: Array, up: Array, size: float) -> Any:
    """Letters of a height about a place [mm]; the sign of degrees, which they lack, is a ring."""
    centre = (0.0, 0.0, 0.0)
    letters = text.removesuffix("°")
    body = pv.Text3D(letters, depth=0.0, height=size, center=centre, normal=(0.0, 0.0, 1.0))
    if text.endswith("°"):
        corner = (body.bounds[1] + 0.2 * size, body.bounds[3] - 0.14 * size, 0.0)
        body = body.merge(pv.Disc(center=corner, inner=0.08 * size, outer=0.14 * size, c_res=24))
    turn = np.eye(4)
    turn[:3] = np.stack([np.cross([-1.0, 0.0, 0.0], up), up, [1.0, 0.0, 0.0], place], axis=1)
    return body.transform(turn, inplace=False)

"""The scene as one page for browsers.

vtk.js draws surfaces with even colour scales; logarithmic colours come as the logarithm itself
with a scale of its own beside the picture, and texts in space as flat letters.
"""

import json
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
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
FONT = f"font:{{}}px system-ui,sans-serif;color:{INK};pointer-events:none"
NUMBERS_BOX = (
    f'<div id="numbers" style="position:fixed;left:12px;bottom:12px;white-space:pre-line;'
    f'background:rgba(255,255,255,0.85);padding:6px 10px;display:none;{FONT.format(14)}"></div>'
)
# The viewer of vtk.js leaves its window as `global.renderWindow`. A click shows the numbers of the
# contact whose place on the screen is nearest, if it is near; a drag turns and picks nothing.
PICK = """
(() => {
  const contacts = CONTACTS, reach = 40, steady = 4;
  const scene = () => window.global && window.global.renderWindow;
  const nearest = (x, y) => {
    const view = scene().getViews()[0];
    const renderer = scene().getRenderers().find((one) => one.getActors().length);
    const [width, height] = view.getSize();
    const frame = view.getCanvas().getBoundingClientRect();
    let found = null, least = reach;
    for (const contact of contacts) {
      const [u, v] = view.worldToDisplay(...contact.place, renderer);
      const distance = Math.hypot(
        frame.left + (u * frame.width) / width - x,
        frame.bottom - (v * frame.height) / height - y);
      if (distance < least) { found = contact; least = distance; }
    }
    return found;
  };
  const show = (x, y) => {
    const found = scene() && nearest(x, y);
    const box = document.getElementById("numbers");
    box.style.display = found ? "block" : "none";
    box.textContent = found ? found.text : "";
    return found;
  };
  let start = [0, 0];
  window.addEventListener("pointerdown", (e) => { start = [e.clientX, e.clientY]; }, true);
  window.addEventListener("pointerup", (e) => {
    const moved = Math.hypot(e.clientX - start[0], e.clientY - start[1]);
    if (moved < steady) show(e.clientX, e.clientY);
  }, true);
  window.oilfilm = { contacts, show };
})();
"""
TICK = "position:absolute;left:20px;bottom:calc({:.2f}% - 8px);border-bottom:0;white-space:nowrap"


@dataclass(frozen=True, slots=True, kw_only=True)
class Spot:
    """A contact that can be clicked: its place in the scene [mm], and its numbers in words."""

    place: tuple[float, float, float]
    text: str


def add_overlay(
    file: Path, title: str, note: str, colours: ColourScale | None, spots: Sequence[Spot] = ()
) -> None:
    """Lay title, note, colour scale and the numbers of a clicked contact over an exported page.

    It loads nothing from a network.
    """
    use = "turn, zoom and shift with the mouse" + ("; click a film for its numbers" * bool(spots))
    text = f"<b>{escape(title)}</b><br>{escape(note)}; {use}"
    style = f"position:fixed;left:12px;top:10px;{FONT.format(15)}"
    over = f'<div style="{style}">{text}</div>' + ("" if colours is None else bar_html(colours))
    over += NUMBERS_BOX
    # inserted after the body, which the page's own script empties
    literal = _literal(over)
    script = f"document.documentElement.insertAdjacentHTML('beforeend', {literal});"
    script += PICK.replace("CONTACTS", _literal([asdict(spot) for spot in spots]))
    page = file.read_text(encoding="utf-8")
    page = re.sub(
        r"<title>.*?</title>", lambda _: f"<title>{escape(title)}</title>", page, count=1
    )
    page = page.replace("</body>", f"<script>{script}</script></body>")
    file.write_text(page.replace("<head>", f"<head>{OFFLINE}", 1), encoding="utf-8")


def _literal(value: object) -> str:
    """A value as JavaScript inside a page."""
    return json.dumps(value).replace("<", "\\u003c")


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
        body = flat_text(label.text, label.place, up, LETTER * label.ball_diameter)
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

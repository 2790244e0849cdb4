"""Controls of a scene's window, and the page of a scene for browsers.

vtk.js draws surfaces with even colour scales; logarithmic colours come as the logarithm itself
with a scale of its own next to the picture, and texts in space as flat letters.
"""

import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import degrees, pi, radians
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
from jinja2.utils import htmlsafe_json_dumps
from markupsafe import escape
from PIL import Image

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import parse_json
from oilfilm.ehl.units import GIGAPASCAL

from ..plot_style import INK, colour_stops, film_ticks
from ..report.html import environment
from .parts import ColourScale, Label, look_at
from .patch import Patch
from .render_process import write_gif

NUMBERS = "numbers"  # field data of a patch: its numbers as text


FRAMES = 48  # of a movie of one turn


PER_FRAME = 100  # [ms]


LEAN = 20.0  # views of a single contact lean this far to both sides [deg]


OFFLINE = (
    '<meta http-equiv="Content-Security-Policy" '
    'content="img-src data: blob:; connect-src data: blob:">'
)


STOPS = 24  # of the gradient of a colour scale


LETTER = 0.32  # height of letters in ball diameters


def patch_numbers(patch: Patch) -> str:
    """The numbers of one contact as text: load [N], pressure [GPa], films [um].

    Parameters
    ----------
    patch : Patch
        Shown part of a contact.

    Returns
    -------
    str
        The words.
    """
    facts = patch.attributes
    azimuth = degrees(facts["azimuth"]) % 360.0
    pressure = float(facts["hertz_pressure"]) / GIGAPASCAL
    return (
        f"ball {facts['ball']}, {facts['race']} race, azimuth {azimuth:.4g}°\n"
        f"{float(facts['load']):.5g} N, Hertz pressure {pressure:.4g} GPa\n"
        f"central film {patch.central:.4g} µm, minimum film {patch.minimum:.4g} µm"
    )


def add_controls(plotter: Any) -> None:
    """A slider that brings an azimuth [deg] to the top; a click on a film shows its numbers.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    """
    if not shown_films(plotter):
        return
    place = {"pointa": (0.06, 0.16), "pointb": (0.32, 0.16), "title_height": 0.02}
    style = {"title": "azimuth on top [°]", "color": INK, "fmt": "%.0f", "style": "modern"}
    plotter.add_slider_widget(
        lambda value: look_at(plotter, radians(value)), (0.0, 360.0), value=0.0, **place, **style
    )
    silent = {"show": False, "show_message": False}
    plotter.enable_mesh_picking(
        lambda mesh: show_numbers(plotter, mesh), left_clicking=True, **silent
    )


def show_numbers(plotter: Any, mesh: Any) -> None:
    """Write the numbers of a clicked film into the upper right corner.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    mesh : Any
        Clicked mesh.
    """
    numbers = numbers_of(mesh)
    if numbers:
        plotter.add_text(numbers, position="upper_right", font_size=10, color=INK, name=NUMBERS)


def shown_films(plotter: Any) -> list[Any]:
    """Meshes of the films on balls; none for a single contact.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.

    Returns
    -------
    list[Any]
        The meshes.
    """
    mappers = [getattr(actor, "mapper", None) for actor in plotter.actors.values()]
    meshes = [getattr(mapper, "dataset", None) for mapper in mappers]
    return [mesh for mesh in meshes if numbers_of(mesh)]


def numbers_of(mesh: Any) -> str:
    """Numbers that the mesh of a film holds.

    Parameters
    ----------
    mesh : Any
        Mesh of the scene.

    Returns
    -------
    str
        The numbers in words; empty of another body.
    """
    data = getattr(mesh, "field_data", None)
    return (
        str(parse_json(data[NUMBERS][0], NUMBERS)) if data is not None and NUMBERS in data else ""
    )


def write_movie(plotter: Any, file: Path) -> None:
    """One turn of a bearing, or a single contact seen from side to side, as an animated GIF.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    file : Path
        GIF file.
    """
    is_bearing = bool(shown_films(plotter))
    frames = []
    before = 0.0
    for k in range(FRAMES):
        turn = 2.0 * pi * k / FRAMES
        if is_bearing:
            look_at(plotter, turn)
        else:
            lean = LEAN * (1.0 - abs(1.0 - turn / pi) * 2.0)
            plotter.camera.Azimuth(lean - before)
            before = lean
        plotter.render()
        frames.append(Image.fromarray(plotter.screenshot(return_img=True)))
    write_gif(frames, file, PER_FRAME)


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

    Parameters
    ----------
    file : Path
        Exported page.
    title : str
        Title of the scene.
    note : str
        Magnification of the patches.
    colours : ColourScale | None
        Colour scale, or None.
    spots : Sequence[Spot], default ()
        Contacts that can be clicked.
    """
    over = overlay_html(title, note, colours, spots)
    # inserted after the body, which the page's own script empties
    script = (
        f"document.documentElement.insertAdjacentHTML('beforeend', {htmlsafe_json_dumps(over)});"
    )
    script += (
        environment(__package__)
        .get_template("pick.js")
        .render(spots=[asdict(spot) for spot in spots])
    )
    page = file.read_text(encoding="utf-8")
    page = re.sub(
        r"<title>.*?</title>", lambda _: f"<title>{escape(title)}</title>", page, count=1
    )
    page = page.replace("</body>", f"<script>{script}</script></body>")
    file.write_text(page.replace("<head>", f"<head>{OFFLINE}", 1), encoding="utf-8")


def overlay_html(
    title: str, note: str, colours: ColourScale | None, spots: Sequence[Spot] = ()
) -> str:
    """Title, note, colour scale with its ticks, and the box of a contact's numbers as HTML.

    Parameters
    ----------
    title : str
        Title of the scene.
    note : str
        Magnification of the patches.
    colours : ColourScale | None
        Colour scale, or None.
    spots : Sequence[Spot], default ()
        Contacts that can be clicked.

    Returns
    -------
    str
        The HTML.
    """
    shades: Any = ()
    ticks: Any = ()
    if colours is not None:
        shades = 255.0 * colour_stops(colours.quantity, STOPS)
        ticks = [(tick, 100.0 * colours.height(tick)) for tick in film_ticks(*colours.limits)]
    return (
        environment(__package__)
        .get_template("overlay.html")
        .render(
            title=title,
            note=note,
            colours=colours,
            spots=spots,
            ink=INK,
            shades=[f"rgb({r:.0f},{g:.0f},{b:.0f})" for r, g, b in shades],
            ticks=ticks,
        )
    )


def add_flat_labels(plotter: Any, labels: Sequence[Label], up: Array) -> None:
    """Labels as flat letters that look along +x.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    labels : Sequence[Label]
        Texts in space.
    up : Array
        Unit vector to the top of the picture, shape (3,) [-].
    """
    for label in labels:
        body = flat_text(label.text, label.place, up, LETTER * label.ball_diameter)
        plotter.add_mesh(body, color=INK, lighting=False)


def flat_text(text: str, place: Array, up: Array, size: float) -> Any:
    """Letters about a point; the sign of degrees, which the font lacks, is a ring.

    Parameters
    ----------
    text : str
        Letters, with a sign of degrees at the end or not.
    place : Array
        Centre, shape (3,) [mm].
    up : Array
        Unit vector upwards, shape (3,) [-].
    size : float
        Height of the letters [mm].

    Returns
    -------
    Any
        The mesh.
    """
    centre = (0.0, 0.0, 0.0)
    letters = text.removesuffix("°")
    body = pv.Text3D(letters, depth=0.0, height=size, center=centre, normal=(0.0, 0.0, 1.0))
    if text.endswith("°"):
        corner = (body.bounds[1] + 0.2 * size, body.bounds[3] - 0.14 * size, 0.0)
        body = body.merge(pv.Disc(center=corner, inner=0.08 * size, outer=0.14 * size, c_res=24))
    turn = np.eye(4)
    turn[:3] = np.stack([np.cross([-1.0, 0.0, 0.0], up), up, [1.0, 0.0, 0.0], place], axis=1)
    return body.transform(turn, inplace=False)

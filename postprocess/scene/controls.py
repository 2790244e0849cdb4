"""Controls of a scene: slider over azimuth, click on a contact, movie of one turn."""

import json
from math import degrees, pi, radians
from pathlib import Path
from typing import Any

from PIL import Image

from ehl.units import GIGAPASCAL

from ..plot_style import INK
from .parts import look_at
from .patch import Patch
from .rendering import write_gif

NUMBERS = "numbers"  # field data of a patch: its numbers as text
FRAMES = 48  # of a movie of one turn
PER_FRAME = 100  # [ms]
LEAN = 20.0  # views of a single contact lean this far to both sides [deg]


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
    return str(json.loads(data[NUMBERS][0])) if data is not None and NUMBERS in data else ""


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

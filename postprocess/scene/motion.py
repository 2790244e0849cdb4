"""What moves in a scene: a slider over azimuth, a click that tells a contact's numbers, a movie of
one turn.
"""

from math import degrees, pi, radians
from pathlib import Path
from typing import Any

from PIL import Image

from ehl.units import GIGAPASCAL

from .parts import INK, look_at
from .patch import Patch

FACTS = "facts"  # field data of a patch: its numbers in words
FRAMES = 48  # of a movie of one turn
PER_FRAME = 100  # [ms]
BACK = 20.0  # views of a single contact lean this far to both sides [deg]


def patch_facts(patch: Patch) -> str:
    """The numbers of one contact in words: load [N], pressure [GPa], films [um]."""
    facts = patch.attributes
    place = f"ball {facts['ball']}, {facts['race']} race, azimuth {degrees(facts['azimuth']) % 360.0:.4g} deg"
    pressure = float(facts["hertz_pressure"]) / GIGAPASCAL
    films = f"central film {patch.central:.4g} um, minimum film {patch.minimum:.4g} um"
    return f"{place}\n{float(facts['load']):.5g} N, Hertz pressure {pressure:.4g} GPa\n{films}"


def add_controls(plotter: Any) -> None:
    """A slider that brings an azimuth [deg] to the top, and a click on a film that tells its
    numbers.
    """
    picked = [actor for actor in plotter.actors.values() if _facts(_dataset(actor))]
    if not picked:  # a single contact, or no films
        return
    plotter.add_slider_widget(
        lambda value: look_at(plotter, radians(value)),
        rng=(0.0, 360.0),
        value=0.0,
        title="azimuth on top [deg]",
        pointa=(0.06, 0.16),
        pointb=(0.32, 0.16),
        color=INK,
        fmt="%.0f",
        style="modern",
        title_height=0.02,
    )
    plotter.enable_mesh_picking(
        lambda mesh: show_facts(plotter, mesh), left_clicking=True, show=False, show_message=False
    )


def show_facts(plotter: Any, mesh: Any) -> None:
    """Write the numbers of a picked film into the upper right corner; nothing for another body."""
    words = _facts(mesh)
    if words:
        plotter.add_text(words, position="upper_right", font_size=10, color=INK, name="picked")


def _dataset(actor: Any) -> Any:
    mapper = getattr(actor, "mapper", None)
    return getattr(mapper, "dataset", None)


def _facts(mesh: Any) -> str:
    data = getattr(mesh, "field_data", None)
    return str(data[FACTS][0]) if data is not None and FACTS in data else ""


def write_movie(plotter: Any, file: Path) -> None:
    """One turn of a bearing, or a single contact seen from side to side, as an animated GIF."""
    bearing = any(_facts(_dataset(actor)) for actor in plotter.actors.values())
    frames = []
    before = 0.0
    for k in range(FRAMES):
        turn = 2.0 * pi * k / FRAMES
        if bearing:
            look_at(plotter, turn)
        else:
            lean = BACK * (1.0 - abs(1.0 - turn / pi) * 2.0)
            plotter.camera.Azimuth(lean - before)
            before = lean
        plotter.render()
        frames.append(Image.fromarray(plotter.screenshot(return_img=True)).quantize(128))
    frames[0].save(
        file, save_all=True, append_images=frames[1:], duration=PER_FRAME, loop=0, optimize=True
    )

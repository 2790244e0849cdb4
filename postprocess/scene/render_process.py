"""Scenes drawn in a process of their own, their controls, and as one page for browsers.

A missing OpenGL library ends that process, and is an error here. vtk.js draws surfaces with even
colour scales; logarithmic colours come as the logarithm itself with a scale of its own beside the
picture, and texts in space as flat letters.
"""

import errno
import json
import os
import re
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import lru_cache
from math import degrees, pi, radians
from pathlib import Path
from shutil import disk_usage
from typing import Any, BinaryIO

import numpy as np
import pyvista as pv
from jinja2.utils import htmlsafe_json_dumps
from markupsafe import escape
from PIL import Image

from oilfilm.bearing.files import atomic_path
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import GIGAPASCAL

from ..plot_style import INK, colour_stops, film_ticks
from ..report.html import environment
from .parts import ColourScale, Label, look_at
from .patch import Patch

WINDOW_VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
WINDOW_WITHOUT_DISPLAY = "vtkEGLRenderWindow"
PACKAGES = "libegl1 libegl-mesa0 libgl1-mesa-dri"
PATIENCE = 300.0  # for one picture, which takes seconds on an idle machine [s]
FULL = 2**22  # below so much free space a picture may have been too large for the disk [bytes]
# colours of a frame, chosen to cover all colours, not by area, so that thin arrows keep theirs
COLOURS = 128
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


class RenderingError(RuntimeError):
    """No picture can be drawn here; the message says what is missing and what to do."""


def with_suffix(file: str | Path, *suffixes: str) -> Path:
    """The file, if its name ends as it must.

    Parameters
    ----------
    file : str | Path
        Name of a file.
    *suffixes : str
        Allowed suffixes, in lower case.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        If it has another suffix.
    """
    path = Path(file)
    if path.suffix.lower() not in suffixes:
        raise ValueError(f"the file must end in {' or '.join(suffixes)}, got {path.name}")
    return path


def draw(
    module: str, directory: str | Path, file: Path, options: dict[str, Any], patience: float
) -> Path:
    """Draw a file by a module of this package in a process of its own.

    Parameters
    ----------
    module : str
        Module of this package that draws.
    directory : str | Path
        Folder of the results.
    file : Path
        File to write.
    options : dict[str, Any]
        Options of plain JSON types.
    patience : float
        Longest time of the drawing process [s].

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RenderingError
        If nothing was drawn.
    OSError
        If the disk is full.
    """
    with atomic_path(file) as temporary:
        try:
            run_module(module, directory, temporary, options, patience)
            if not temporary.stat().st_size:
                raise RenderingError(advice(f"{file.name} was left empty"))
        except RenderingError:
            if disk_usage(temporary.parent).free < FULL:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(file)) from None
            raise
    return file


def run_module(
    module: str,
    directory: str | Path,
    file: Path | None,
    options: dict[str, Any],
    patience: float | None,
) -> None:
    """Run a module of this package with a request, as `draw`.

    Parameters
    ----------
    module : str
        Module of this package that draws.
    directory : str | Path
        Folder of the results.
    file : Path | None
        File to write; a window opens if None.
    options : dict[str, Any]
        Options of plain JSON types.
    patience : float | None
        Longest time of the drawing process [s].

    Raises
    ------
    RenderingError
        If the process fails.
    """
    request = json.dumps([str(directory), None if file is None else str(file), options])
    run_python(["-m", f"{__package__}.{module}", request], patience)


def read_request(text: str) -> tuple[Path, Path | None, dict[str, Any]]:
    """Read a request; from then on this process ends with the one that asked.

    Parameters
    ----------
    text : str
        Request of `run_module`.

    Returns
    -------
    value
        Folder of the results.
    value
        File to draw, or None for a window.
    value
        Options.
    """
    threading.Thread(target=_end_with_parent, daemon=True).start()
    directory, file, options = json.loads(text)
    tuples = {name: tuple(value) for name, value in options.items() if isinstance(value, list)}
    return Path(directory), None if file is None else Path(file), options | tuples


def _end_with_parent() -> None:
    """End when nobody holds the other end of standard input any more."""
    with suppress(OSError):
        os.read(0, 1)
    os._exit(1)


def run_python(arguments: list[str], patience: float | None) -> None:
    """Run Python in a process of its own.

    Parameters
    ----------
    arguments : list[str]
        Arguments of the interpreter.
    patience : float | None
        Longest time of the drawing process [s].

    Raises
    ------
    RenderingError
        If the process fails or takes too long.
    """
    home = str(Path(sys.modules["oilfilm"].__file__ or "").resolve().parents[1])
    paths = [home, *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = rendering_environment() | {"PYTHONPATH": os.pathsep.join(paths)}
    reader, writer = os.pipe()
    try:
        process = subprocess.run(
            [sys.executable, *arguments],
            env=environment,
            stdin=reader,
            capture_output=True,
            text=True,
            timeout=patience,
            check=False,
            errors="replace",
        )
    except subprocess.TimeoutExpired:
        raise RenderingError(advice(f"drawing took more than {patience:.0f} s")) from None
    finally:
        os.close(reader)
        os.close(writer)
    if process.returncode != 0:
        lines = [line.strip() for line in process.stderr.splitlines() if line.strip()]
        crashed = process.returncode < 0 or process.returncode > 128
        ended = f"the drawing process ended with code {process.returncode}"
        raise RenderingError(advice(ended if crashed or not lines else lines[-1]))


def advice(reason: str) -> str:
    """Say why no picture was drawn, and what to install.

    Parameters
    ----------
    reason : str
        Reason why no picture was drawn.

    Returns
    -------
    str
        The message.
    """
    text = f"the scene cannot be drawn: {reason}"
    if not sys.platform.startswith("linux"):
        return text
    return f"{text}. Is OpenGL installed? On Debian and Ubuntu: apt install {PACKAGES}"


def rendering_environment() -> dict[str, str]:
    """Environment for drawing: on Linux without a display EGL, unless the user chose."""
    environment = dict(os.environ)
    if sys.platform.startswith("linux") and not environment.get("DISPLAY"):
        environment.setdefault(WINDOW_VARIABLE, WINDOW_WITHOUT_DISPLAY)
    return environment


@lru_cache(maxsize=1)
def require_rendering() -> None:
    """Try a tiny picture, for notebooks; `RenderingError` if this machine cannot draw."""
    plotter = "pyvista.Plotter(off_screen=True, window_size=(16, 16))"
    run_python(["-c", f"import pyvista; p = {plotter}; p.show(); p.close()"], PATIENCE)
    os.environ.update({k: v for k, v in rendering_environment().items() if k == WINDOW_VARIABLE})


def require_display() -> None:
    """`RenderingError` where a window cannot be opened for want of a display."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        raise RenderingError(
            "there is no display to open a window on; --screenshot FILE.png writes a picture"
        )


def write_gif(frames: Sequence[Image.Image], file: Path | BinaryIO, per_frame: int) -> None:
    """Write pictures as an endless GIF.

    Parameters
    ----------
    frames : Sequence[Image.Image]
        Pictures of one size.
    file : Path | BinaryIO
        File, or memory.
    per_frame : int
        Time of each picture [ms].
    """
    method = Image.Quantize.MAXCOVERAGE
    first, *others = [frame.quantize(COLOURS, method=method) for frame in frames]
    first.save(
        file,
        format="gif",
        save_all=True,
        append_images=others,
        duration=per_frame,
        loop=0,
        optimize=True,
    )


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

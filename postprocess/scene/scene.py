"""The results in three dimensions with pyvista: a bearing with its films, or the surface of one
contact.

Drawing happens in a process of its own, since a missing OpenGL library ends the process that asks
for a window.
"""

import asyncio
import json
import sys
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
import pyvista as pv
import xarray
from numpy.typing import NDArray

from ehl.units import MILLIMETRE

from ..files import atomic_path
from ..plot_style import common_film_range, film_range
from ..reader import open_results
from .geometry import Placement
from .motion import FACTS, add_controls, patch_facts, write_movie
from .page import ColourBar, add_flat_labels, add_words
from .parts import INK, add_bodies, add_colour_bar, add_field, add_labels, add_load, aim, frame
from .patch import Patch
from .rendering import (
    PATIENCE,
    RenderingError,
    advice,
    require_display,
    require_rendering,
    run_python,
)
from .vtk import COLLECTION_FILE

Array = NDArray[np.float64]

NICE_FACTORS = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0)
PATCH_SIZE = 1.8  # of the largest patch, in ball radii: along the ball to both sides together
PAGES = (".html", ".htm")
DRAWN = ("bearing", "contact")  # kinds of results that have a scene
LINE_COLOURS = {"film": "white", "pressure": "black"}
LABELS = {"film": "film thickness [µm]", "pressure": "pressure [GPa]"}
BACKGROUND = "white"


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneOptions:
    """What a scene shows.

    Attributes
    ----------
    quantity : {"film", "pressure"}
    magnification : tuple of float or None
        Of the patches, along and across the rolling direction [-]; None chooses what can be seen.
    film_exaggeration : float
        Film drawn as height, times this [-].
    size : tuple of int
        Width and height of the picture in pixels [-].
    """

    quantity: str = "film"
    magnification: tuple[float, float] | None = None
    film_exaggeration: float = 0.0
    size: tuple[int, int] = (1600, 1200)

    @property
    def scale(self) -> float:
        """Height of the picture over that for which sizes of type are chosen [-]."""
        return self.size[1] / 1200.0

    def __post_init__(self) -> None:
        if self.quantity not in LABELS:
            raise ValueError(f"quantity must be one of {', '.join(LABELS)}, got {self.quantity!r}")


def screenshot(
    directory: str | Path, file: str | Path, options: SceneOptions | None = None
) -> Path:
    """Draw the scene of a result directory into a PNG file, with or without a display.

    Parameters
    ----------
    directory : str or Path
        Result directory.
    file : str or Path
        Picture to write.
    options : SceneOptions, optional

    Returns
    -------
    Path
        The picture.

    Raises
    ------
    ValueError
        If the directory holds no readable results.
    RenderingError
        If the machine cannot draw; this process is not harmed.
    """
    path = Path(file)
    if path.suffix.lower() != ".png":
        raise ValueError(f"the picture must be a .png file, got {path.name}")
    _check(directory)
    with atomic_path(path) as temporary:
        _draw_elsewhere(directory, temporary, options or SceneOptions())
        if not temporary.stat().st_size:
            raise RenderingError(advice("no picture came out"))
    return path


def export_html(
    directory: str | Path, file: str | Path, options: SceneOptions | None = None
) -> Path:
    """Write the scene as one HTML page that is turned with the mouse, offline; arguments as
    `screenshot`.

    The viewer (vtk.js) is inside the page. Azimuths and load are flat letters there, which read
    from the side of +x.

    Raises
    ------
    ValueError
        If the directory holds no readable results, or the page is no .html file.
    RenderingError
        If the machine cannot draw, or the extra `html` (trame-pyvista) is not installed.
    """
    path = Path(file)
    if path.suffix.lower() not in PAGES:
        raise ValueError(f"the page must be an .html file, got {path.name}")
    if find_spec("trame_pyvista") is None:
        raise RenderingError(
            "the page needs the package trame-pyvista: pip install 'oilfilm[html]'"
        )
    _check(directory)
    with atomic_path(path) as temporary:
        _draw_elsewhere(directory, temporary, options or SceneOptions())
        if not temporary.stat().st_size:
            raise RenderingError(advice("no page came out"))
    return path


def movie(directory: str | Path, file: str | Path, options: SceneOptions | None = None) -> Path:
    """Write the scene as an animated GIF in which every azimuth comes to the top once; arguments
    as `screenshot`.
    """
    path = Path(file)
    if path.suffix.lower() != ".gif":
        raise ValueError(f"the movie must be a .gif file, got {path.name}")
    _check(directory)
    with atomic_path(path) as temporary:
        _draw_elsewhere(directory, temporary, options or SceneOptions(size=(800, 600)))
        if not temporary.stat().st_size:
            raise RenderingError(advice("no movie came out"))
    return path


def show(directory: str | Path, options: SceneOptions | None = None) -> None:
    """Open a window with the scene of a result directory, to be turned with the mouse; arguments
    as `screenshot`.
    """
    require_display()
    _check(directory)
    _draw_elsewhere(directory, None, options or SceneOptions())


def _check(directory: str | Path) -> None:
    """Whether there is something to draw, before a process is started for it."""
    tree = open_results(directory)
    kind = tree.attrs["kind"]
    tree.close()
    if kind not in DRAWN:
        raise ValueError(
            f"{directory} holds results of kind {kind}, which have no scene; allowed: {', '.join(DRAWN)}"
        )
    if kind == "bearing" and not (Path(directory) / COLLECTION_FILE).is_file():
        raise ValueError(f"{directory} holds no VTK files: {COLLECTION_FILE} is missing")


def _draw_elsewhere(directory: str | Path, file: Path | None, options: SceneOptions) -> None:
    """Run this module in a process of its own, and turn its end into an exception if need be."""
    request = {
        "directory": str(directory),
        "file": None if file is None else str(file),
        "options": asdict(options),
    }
    patience = None if file is None else PATIENCE
    run_python(["-m", f"{__package__}.scene", json.dumps(request)], patience)


def bearing_scene(
    directory: str | Path, options: SceneOptions | None = None, off_screen: bool = False
) -> pyvista.Plotter:
    """Plotter with the scene of a result directory: a bearing with its patches, or the surface of
    one contact.

    Parameters
    ----------
    directory : str or Path
        Result directory.
    options : SceneOptions, optional
    off_screen : bool

    Returns
    -------
    pyvista.Plotter
        To be shown, or to add to.

    Raises
    ------
    ValueError, RenderingError
        As `screenshot`.
    """
    _check(directory)
    require_rendering()
    return _scene(Path(directory), options or SceneOptions(), off_screen)[0]


def _scene(
    directory: Path, options: SceneOptions, off_screen: bool, page: bool = False
) -> tuple[pyvista.Plotter, str, str, ColourBar | None]:
    """Plotter, title, the note that states what is magnified, and the colour bar, which a `page`
    draws itself.
    """
    tree = open_results(directory)
    try:
        plotter = pv.Plotter(off_screen=off_screen, window_size=list(options.size))
        plotter.set_background(BACKGROUND)
        scale = options.scale
        title = str(tree.attrs.get("title", ""))
        if not page:  # which has its own words
            plotter.add_text(title, position="upper_left", font_size=int(17 * scale), color=INK)
        if tree.attrs["kind"] == "contact":
            note, bar = _add_contact(plotter, tree["contacts/contact"].to_dataset(), options, page)
        else:
            note, bar = _add_bearing(plotter, directory, tree, options, page)
        if not page:
            plotter.add_text(note, position="lower_left", font_size=int(13 * scale), color=INK)
        plotter.enable_anti_aliasing("ssaa")
        return plotter, title, note, bar
    finally:
        tree.close()


def _add_bearing(
    plotter: Any, directory: Path, tree: xarray.DataTree, options: SceneOptions, page: bool
) -> tuple[str, ColourBar | None]:
    """Bodies, patches, labels, camera; return the note that states the factors, and the scale of
    the colours.
    """
    # no films were asked for
    balls = tree["contacts"].children.values() if "contacts" in tree.children else ()
    nodes = [node for ball in balls for node in ball.children.values()]
    patches = [Patch.read(node.to_dataset(inherit=False)) for node in nodes]
    radius = 0.5 * float(tree["ring"].attrs["ball_diameter"])
    placement = _placement(patches, radius, options)
    add_bodies(plotter, directory)
    limits = _limits(patches, options.quantity) if patches else (0.0, 1.0)
    mapper = None
    logarithmic = options.quantity == "film" and len(patches) > 1
    scale = "linear" if not logarithmic else "logarithm" if page else "logarithmic"
    for patch in patches:
        mesh = pv.wrap(patch.mesh(radius, placement))
        if options.quantity == "film":
            mesh = _within_scale(mesh, limits[1])
        if not mesh.n_points:  # a failed solution may have no film within the scale
            continue
        mesh.field_data[FACTS] = [patch_facts(patch)]
        mapper = add_field(plotter, mesh, options.quantity, limits, scale)
        lines = mesh.contour(patch.levels(options.quantity), scalars=options.quantity)
        if lines.n_points:
            plotter.add_mesh(
                lines, color=LINE_COLOURS[options.quantity], line_width=1.5, opacity=0.7
            )
    note = _note(placement) if patches else "no films in these results"
    add_load(plotter, tree)
    if page:
        add_flat_labels(plotter, tree, aim(plotter, tree))
        label = LABELS[options.quantity]
        bar = ColourBar(
            quantity=options.quantity, label=label, limits=limits, logarithmic=logarithmic
        )
        return note, bar if mapper is not None else None
    if mapper is not None:
        add_colour_bar(plotter, mapper, LABELS[options.quantity], options.scale)
    add_labels(plotter, tree, options.scale)
    aim(plotter, tree)
    return note, None


def _within_scale(mesh: Any, top: float) -> Any:
    """The part of a surface where the film is below `top` [um]: the inlet would hide bodies and
    contact.
    """
    return mesh.clip_scalar(scalars="film", value=top, invert=True).extract_surface(algorithm=None)


def _note(placement: Placement) -> str:
    """State the factors of the patches."""
    rolling, transverse = placement.rolling, placement.transverse
    note = f"patches magnified {rolling:g}x along and {transverse:g}x across the rolling direction"
    if rolling == transverse:
        note = (
            "patches in true size"
            if rolling == 1.0
            else f"patches magnified {rolling:g}x, as far as they fit the balls"
        )
    return note + (f"; film height exaggerated {placement.film:g}x" if placement.film else "")


def _placement(patches: list[Patch], ball_radius: float, options: SceneOptions) -> Placement:
    """Factors of the patches: as asked for, or so that the largest patch covers a good part of its
    ball.
    """
    if options.magnification is not None:
        rolling, transverse = options.magnification
    else:
        room = PATCH_SIZE * ball_radius / MILLIMETRE
        rolling = _nice(room / max((float(np.ptp(p.x)) for p in patches), default=room))
        transverse = _nice(room / max((float(np.ptp(p.y)) for p in patches), default=room))
    return Placement(rolling=rolling, transverse=transverse, film=options.film_exaggeration)


def _nice(factor: float) -> float:
    """Largest of the round factors below `factor` [-], at least 1."""
    return max(f for f in NICE_FACTORS if f <= max(factor, 1.0))


def _limits(patches: list[Patch], quantity: str) -> tuple[float, float]:
    """Ends of the common colour scale, in the unit of the quantity."""
    if quantity == "pressure":
        return 0.0, max((float(p.pressure.max()) for p in patches), default=1.0)
    if len(patches) == 1:
        return film_range(patches[0].central, patches[0].minimum)
    return common_film_range([p.central for p in patches], [p.minimum for p in patches])


def _add_contact(
    plotter: Any, data: xarray.Dataset, options: SceneOptions, page: bool
) -> tuple[str, ColourBar | None]:
    """One contact as a surface whose height is the quantity; return what the height means, and the
    colours' scale.
    """
    patch = Patch.read(data)
    size = min(float(np.ptp(patch.x)), float(np.ptp(patch.y)))
    mesh = pv.wrap(patch.relief(options.quantity, 0.45 * size))
    limits = _limits([patch], options.quantity)
    if options.quantity == "film":
        mesh = _within_scale(mesh, limits[1])
    mapper = add_field(plotter, mesh, options.quantity, limits)
    unit = data["P" if options.quantity == "pressure" else "h"].attrs["units"]
    label = LABELS[options.quantity] if unit in ("m", "Pa") else f"{options.quantity} [{unit}]"
    if not page:
        add_colour_bar(plotter, mapper, label, options.scale)
    plotter.camera.position, plotter.camera.focal_point, plotter.camera.up = (
        (-0.75, -1.35, 1.3),
        (0, 0, 0),
        (0, 0, 1),
    )
    frame(plotter, 1.0)
    unit = data["x"].attrs["units"].replace("m", "mm")
    extent = f"{patch.x.min():.3g} ... {patch.x.max():.3g} by {patch.y.min():.3g} ... {patch.y.max():.3g} {unit}"
    cut = ", cut off at the end of the colour scale" if options.quantity == "film" else ""
    bar = ColourBar(quantity=options.quantity, label=label, limits=limits) if page else None
    return f"height: {options.quantity}{cut}; shown: {extent}; oil moves to the right", bar


def _main(request: str) -> None:
    """Draw what `_draw_elsewhere` asked for, in this process."""
    asked = json.loads(request)
    options = asked["options"]
    options["size"] = tuple(options["size"])
    options["magnification"] = options["magnification"] and tuple(options["magnification"])
    off_screen = asked["file"] is not None
    page = off_screen and Path(asked["file"]).suffix.lower() in PAGES
    plotter, title, note, bar = _scene(
        Path(asked["directory"]), SceneOptions(**options), off_screen, page
    )
    if asked["file"] is None:
        add_controls(plotter)
        plotter.show()
    elif asked["file"].endswith(".gif"):
        write_movie(plotter, Path(asked["file"]))
    elif asked["file"].endswith(".png"):
        plotter.screenshot(asked["file"])
    else:
        asyncio.run(_export(plotter, asked["file"]))
        add_words(Path(asked["file"]), title, note, bar)
    plotter.close()


async def _export(plotter: Any, file: str) -> None:
    """The page of vtk.js."""
    from trame_pyvista.jupyter import launch_server

    # of this process only, on the loopback interface: it serialises the scene
    await launch_server().ready
    plotter.trame.export_html(file)


if __name__ == "__main__":
    _main(sys.argv[1])

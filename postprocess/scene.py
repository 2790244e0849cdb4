"""The results in three dimensions with pyvista: a bearing with its films, or the surface of one contact.

Drawing happens in a process of its own, since a missing OpenGL library ends the process that asks for a window.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .geometry import Placement
from .patch import Patch
from .plot_style import COLOUR_MAPS, common_film_range, film_range
from .rendering import PATIENCE, RenderingError, advice, require_display, require_rendering, run_python
from .results_io import atomic_path, open_results
from .units import MILLIMETRE
from .vtk import COLLECTION_FILE

if TYPE_CHECKING:
    import pyvista
    import xarray

Array = NDArray[np.float64]

NICE_FACTORS = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0)
ROUND_OFF = 1e-6  # a radial load below this share of the axial one is noise of the equilibrium
PATCH_SIZE = 1.8  # of the largest patch, in ball radii: along the ball to both sides together
LINE_COLOURS = {"film": "white", "pressure": "black"}
LABELS = {"film": "film thickness [µm]", "pressure": "pressure [GPa]"}
BODY, EDGE, BACKGROUND, INK, LOAD_COLOUR = "#c9ced6", "#5b6470", "white", "#1b1f24", "#b3202c"


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

    def __post_init__(self) -> None:
        if self.quantity not in LABELS:
            raise ValueError(f"quantity must be one of {', '.join(LABELS)}, got {self.quantity!r}")


def screenshot(directory: str | Path, file: str | Path, options: SceneOptions | None = None) -> Path:
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


def show(directory: str | Path, options: SceneOptions | None = None) -> None:
    """Open a window with the scene of a result directory, to be turned with the mouse; arguments as `screenshot`."""
    require_display()
    _check(directory)
    _draw_elsewhere(directory, None, options or SceneOptions())


def _check(directory: str | Path) -> None:
    """Whether there is something to draw, before a process is started for it."""
    tree = open_results(directory)
    kind = tree.attrs["kind"]
    tree.close()
    if kind == "bearing" and not (Path(directory) / COLLECTION_FILE).is_file():
        raise ValueError(f"{directory} holds no VTK files: {COLLECTION_FILE} is missing")


def _draw_elsewhere(directory: str | Path, file: Path | None, options: SceneOptions) -> None:
    """Run this module in a process of its own, and turn its end into an exception if need be."""
    request = {"directory": str(directory), "file": None if file is None else str(file), "options": asdict(options)}
    patience = None if file is None else PATIENCE
    run_python(["-m", f"{__package__}.scene", json.dumps(request)], patience)


def bearing_scene(
    directory: str | Path, options: SceneOptions | None = None, off_screen: bool = False
) -> pyvista.Plotter:
    """Plotter with the scene of a result directory: a bearing with its patches, or the surface of one contact.

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
    return _scene(Path(directory), options or SceneOptions(), off_screen)


def _scene(directory: Path, options: SceneOptions, off_screen: bool) -> pyvista.Plotter:
    import pyvista as pv

    tree = open_results(directory)
    try:
        plotter = pv.Plotter(off_screen=off_screen, window_size=list(options.size))
        plotter.set_background(BACKGROUND)
        scale = options.size[1] / 1200.0
        plotter.add_text(str(tree.attrs.get("title", "")), position="upper_left", font_size=int(17 * scale), color=INK)
        if tree.attrs["kind"] == "contact":
            note = _add_contact(plotter, tree["contacts/contact"].to_dataset(), options)
        else:
            note = _add_bearing(plotter, directory, tree, options)
        plotter.add_text(note, position="lower_left", font_size=int(13 * scale), color=INK)
        plotter.enable_anti_aliasing("ssaa")
        return plotter
    finally:
        tree.close()


def _add_bearing(plotter: Any, directory: Path, tree: xarray.DataTree, options: SceneOptions) -> str:
    """Bodies, patches, camera; return the note that states the factors."""
    import pyvista as pv

    balls = tree["contacts"].children.values() if "contacts" in tree.children else ()  # no films were asked for
    nodes = [node for ball in balls for node in ball.children.values()]
    patches = [Patch.read(node.to_dataset(inherit=False)) for node in nodes]
    radius = 0.5 * float(tree["ring"].attrs["ball_diameter"])
    placement = _placement(patches, radius, options)
    _add_bodies(plotter, directory)
    limits, mapper = _limits(patches, options.quantity) if patches else (0.0, 1.0), None
    for patch in patches:
        mesh = pv.wrap(patch.mesh(radius, placement))
        if options.quantity == "film":
            mesh = _within_scale(mesh, limits[1])
        if not mesh.n_points:  # a failed solution may have no film within the scale
            continue
        mapper = _add_field(plotter, mesh, options.quantity, limits, logarithmic=len(patches) > 1)
        lines = mesh.contour(patch.levels(options.quantity), scalars=options.quantity)
        if lines.n_points:
            plotter.add_mesh(lines, color=LINE_COLOURS[options.quantity], line_width=1.5, opacity=0.7)
    if mapper is not None:
        _colour_bar(plotter, mapper, LABELS[options.quantity], options)
    _add_labels(plotter, tree, options)
    _aim(plotter, tree)
    return _note(placement) if patches else "no films in these results"


def _within_scale(mesh: Any, top: float) -> Any:
    """The part of a surface where the film is below `top` [um]: the inlet would hide bodies and contact."""
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
    """Factors of the patches: as asked for, or so that the largest patch covers a good part of its ball."""
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


def _add_field(plotter: Any, mesh: Any, quantity: str, limits: tuple[float, float], logarithmic: bool = False) -> Any:
    actor = plotter.add_mesh(
        mesh,
        scalars=quantity,
        cmap=COLOUR_MAPS[quantity],
        clim=limits,
        log_scale=quantity == "film" and logarithmic,
        show_scalar_bar=False,
        ambient=0.6,
        diffuse=0.45,
        specular=0.0,
        smooth_shading=True,
    )
    return actor.mapper


def _add_bodies(plotter: Any, directory: Path) -> None:
    """Balls like smoked glass, the inner ring whole, the outer one cut open, with their edges drawn."""
    import pyvista as pv

    bodies = pv.get_reader(directory / COLLECTION_FILE).read()[0]["bodies"]
    balls = bodies["balls"].clean().compute_normals(auto_orient_normals=True)
    plotter.add_mesh(balls, color="#aab4c0", opacity=0.2, smooth_shading=True, specular=0.5, specular_power=30)
    for name in ("inner ring", "outer ring"):
        ring = bodies[name].clean()
        solid = ring.compute_normals(consistent_normals=False, split_vertices=True, feature_angle=40.0)
        plotter.add_mesh(solid, color=BODY, smooth_shading=True, specular=0.2, ambient=0.35, diffuse=0.7)
        edges = ring.extract_feature_edges(feature_angle=50.0)
        plotter.add_mesh(edges, color=EDGE, line_width=1.0)


def _add_labels(plotter: Any, tree: xarray.DataTree, options: SceneOptions) -> None:
    """Azimuths beside the balls, and the radial load on the inner ring as an arrow in the bore."""
    import pyvista as pv

    balls, ring = tree["balls"].to_dataset(), tree["ring"].to_dataset()
    turn, diameter = balls["azimuth"].values, float(ring.attrs["ball_diameter"]) / MILLIMETRE
    radius = balls["ball_radial"].values / MILLIMETRE + 1.05 * diameter
    points = np.stack([np.zeros_like(turn), radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    style: dict[str, Any] = {
        "font_size": int(22 * options.size[1] / 1200.0),
        "text_color": INK,
        "shape": None,
        "show_points": False,
        "always_visible": True,
    }
    plotter.add_point_labels(points, [f"{angle % 360.0:.4g}°" for angle in np.degrees(turn)], **style)
    force = ring["force"].values[:3] * np.array([0.0, 1.0, 1.0])
    size = float(np.linalg.norm(force))
    if size > ROUND_OFF * float(np.abs(ring["force"].values).max()):
        bore = 0.5 * float(ring.attrs["pitch_diameter"]) / MILLIMETRE - diameter
        direction = force / size
        arrow = pv.Arrow(
            start=-0.65 * bore * direction,
            direction=direction,
            scale=1.3 * bore,
            shaft_radius=0.025,
            tip_radius=0.06,
            tip_length=0.18,
        )
        plotter.add_mesh(arrow, color=LOAD_COLOUR, ambient=0.4)
        plotter.add_point_labels([-0.78 * bore * direction], [f"{size:.4g} N"], **style)


def _aim(plotter: Any, tree: xarray.DataTree) -> None:
    """Look from the side of +x down on the most loaded ball, which is up."""
    balls = tree["balls"].to_dataset()
    turn = float(balls["azimuth"].values[int(np.argmax(balls["outer_load"].values))])
    radial, tangential = np.array([0.0, np.cos(turn), np.sin(turn)]), np.array([0.0, -np.sin(turn), np.cos(turn)])
    direction = np.array([0.66, 0.0, 0.0]) + 0.70 * radial - 0.30 * tangential
    plotter.camera.focal_point = (0.0, 0.0, 0.0)
    plotter.camera.position = tuple(direction)
    plotter.camera.up = tuple(radial)
    _frame(plotter)


def _frame(plotter: Any, zoom: float = 1.25) -> None:
    """Fill the picture, with room for the colour bar at the right."""
    plotter.reset_camera()
    plotter.camera.zoom(zoom)
    plotter.camera.SetWindowCenter(0.1, 0.0)


def _add_contact(plotter: Any, data: xarray.Dataset, options: SceneOptions) -> str:
    """One contact as a surface whose height is the quantity; return what the height means."""
    import pyvista as pv

    patch = Patch.read(data)
    size = min(float(np.ptp(patch.x)), float(np.ptp(patch.y)))
    mesh = pv.wrap(patch.relief(options.quantity, 0.45 * size))
    limits = _limits([patch], options.quantity)
    if options.quantity == "film":
        mesh = _within_scale(mesh, limits[1])
    mapper = _add_field(plotter, mesh, options.quantity, limits)
    unit = data["P" if options.quantity == "pressure" else "h"].attrs["units"]
    label = LABELS[options.quantity] if unit in ("m", "Pa") else f"{options.quantity} [{unit}]"
    _colour_bar(plotter, mapper, label, options)
    plotter.camera.position, plotter.camera.focal_point, plotter.camera.up = (-0.75, -1.35, 1.3), (0, 0, 0), (0, 0, 1)
    _frame(plotter, 1.0)
    unit = data["x"].attrs["units"].replace("m", "mm")
    extent = f"{patch.x.min():.3g} ... {patch.x.max():.3g} by {patch.y.min():.3g} ... {patch.y.max():.3g} {unit}"
    cut = ", cut off at the end of the colour scale" if options.quantity == "film" else ""
    return f"height: {options.quantity}{cut}; shown: {extent}; oil moves to the right"


def _colour_bar(plotter: Any, mapper: Any, label: str, options: SceneOptions) -> None:
    scale = options.size[1] / 1200.0
    plotter.add_scalar_bar(
        title=f"{label}\n",
        mapper=mapper,
        vertical=True,
        position_x=0.88,
        position_y=0.2,
        width=0.05,
        height=0.6,
        title_font_size=int(26 * scale),
        label_font_size=int(24 * scale),
        color=INK,
        n_labels=6,
        fmt="%.2f",
    )


def _main(request: str) -> None:
    """Draw what `_draw_elsewhere` asked for, in this process."""
    asked = json.loads(request)
    options = asked["options"]
    options["size"] = tuple(options["size"])
    options["magnification"] = options["magnification"] and tuple(options["magnification"])
    plotter = _scene(Path(asked["directory"]), SceneOptions(**options), off_screen=asked["file"] is not None)
    if asked["file"] is None:
        plotter.show()
    else:
        plotter.screenshot(asked["file"])
    plotter.close()


if __name__ == "__main__":
    _main(sys.argv[1])

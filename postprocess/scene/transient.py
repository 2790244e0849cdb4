"""A contact over time for ParaView and as a movie, and a simulated bearing as a GIF."""

import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from oilfilm.bearing.files import write_bytes
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.grid import unfolded
from oilfilm.ehl.transient.record import Frame, TransientSolution
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE

from .. import plot_style
from ..contact.transient_plots import MILLISECOND, film_span, shown
from ..dynamics.read import open_history
from ..files import write_text
from .geometry import Surface, ring_shape, ring_surface
from .render_process import read_request, write_gif
from .scene import AnimationOptions
from .vtk import FILLED, FILM, PRESSURE, collection_text, poly_data, structured_grid, write_block
from .vtk_history import RACES, MovingBearing

COLLECTION_FILE = "transient.pvd"
FOLDER = "transient"
MOVIE_FILE = "transient.gif"
MOST_NODES = 129  # along x in the files for ParaView
EXAGGERATION = 100.0  # of the film drawn as height
PER_FRAME = 80  # [ms]
MOVIE_SIZE = (6.4, 4.6)  # [in]
MOVIE_DPI = 110
SHOWN_SIDE = 1.35  # semi-axes across
LIGHT = "#e8ebef"
DARK = "#39424e"
RING_COLOUR = "#c3cad3"
FORCE_COLOURS = dict(zip(RACES, (plot_style.INNER_COLOUR, plot_style.OUTER_COLOUR), strict=True))
FRAME_TIME = 60  # [ms]
LONGEST_ARROW = 0.9  # over the ball diameter [-]


def _whole(solution: TransientSolution, values: Array) -> Array:
    """A field on both sides of y = 0, shape (ny, nx)."""
    return unfolded(values) if solution.symmetric else values


def _never() -> bool:
    return False


def write_transient_series(
    solution: TransientSolution, directory: Path, is_interrupted: Callable[[], bool] = _never
) -> Path:
    """Write a file for each frame, its film as height, and their series.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.
    directory : Path
        Folder to write into.
    is_interrupted : Callable[[], bool], default _never
        Asked before each frame; once it is true no further one is written.

    Returns
    -------
    Path
        The .pvd file.
    """
    step = max(1, (solution.x.size - 1) // (MOST_NODES - 1))
    x = solution.x[::step]
    y = unfolded(solution.y, sign=-1.0) if solution.symmetric else solution.y
    lines = _line_step(solution, step)
    y = y[::lines]
    files = {}
    for frame in solution.frames:
        if is_interrupted():
            break
        name = f"{FOLDER}/step{frame.step:06d}.vts"
        thin = [
            _whole(solution, values)[::lines, ::step].T
            for values in (frame.film, frame.pressure, frame.filled)
        ]
        film, pressure, filled = thin
        places = np.stack(
            np.broadcast_arrays(x[:, None], y[None, :], EXAGGERATION * film), axis=-1
        )
        fields = {FILM: film / MICROMETRE, PRESSURE: pressure / GIGAPASCAL, FILLED: filled}
        facts: dict[str, float | str] = {
            "time [ms]": frame.time / MILLISECOND,
            "coordinates": "mm",
            "film exaggeration [-]": EXAGGERATION,
        }
        write_block(structured_grid(places / MILLIMETRE, fields, facts), directory / name)
        files[frame.time] = name
    write_text(directory / COLLECTION_FILE, collection_text(files))
    return directory / COLLECTION_FILE


def _line_step(solution: TransientSolution, step: int) -> int:
    """Step between lines that leaves the edges and y = 0 [-]."""
    cells = (solution.y.size - 1) * (2 if solution.symmetric else 1)
    return step if cells % (2 * step) == 0 else 1


def write_movie(
    solution: TransientSolution,
    file: Path,
    title: str,
    is_interrupted: Callable[[], bool] = _never,
) -> None:
    """Write the frames as a GIF: map of the film above film and pressure on y = 0.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.
    file : Path
        GIF file.
    title : str
        Title of the case.
    is_interrupted : Callable[[], bool], default _never
        Asked before each frame; once it is true nothing is written.
    """
    pictures = []
    with rc_context(plot_style.RC):
        for frame in solution.frames:
            if is_interrupted():
                return
            pictures.append(_picture(solution, frame, title))
    content = io.BytesIO()
    write_gif(pictures, content, PER_FRAME)
    write_bytes(file, content.getvalue())


def _picture(solution: TransientSolution, frame: Frame, title: str) -> Image.Image:
    figure = Figure(figsize=MOVIE_SIZE, dpi=MOVIE_DPI)
    time = frame.time / MILLISECOND
    figure.suptitle(f"{title}\n{time:.3f} ms", fontsize=8.5)
    top, bottom = figure.subplots(2, 1, height_ratios=(1.35, 1.0), sharex=True)
    low, high = film_span(solution)
    part = shown(solution)
    x = solution.x[part] / MILLIMETRE
    y = (unfolded(solution.y, sign=-1.0) if solution.symmetric else solution.y) / MILLIMETRE
    film = _whole(solution, frame.film)[:, part] / MICROMETRE
    style: dict[str, Any] = {"cmap": plot_style.COLOUR_MAPS["film"], "vmin": low, "vmax": high}
    image = top.pcolormesh(x, y, film, shading="nearest", **style)
    figure.colorbar(image, ax=top, label="film [µm]", extend="max")
    side = SHOWN_SIDE * solution.semi_axes[1] / MILLIMETRE
    top.set_ylim(-min(side, float(y[-1])), min(side, float(y[-1])))
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    a, b = (length / MILLIMETRE for length in solution.semi_axes)
    top.plot(a * np.cos(angle), b * np.sin(angle), "--", color="white", linewidth=0.8)
    top.set_ylabel("y [mm]")
    middle = 0 if solution.symmetric else solution.y.size // 2
    bottom.plot(x, frame.film[middle, part] / MICROMETRE, color=plot_style.INNER_COLOUR)
    bottom.set_ylim(max(0.0, low - (high - low)), high + 0.5 * (high - low))
    bottom.set_ylabel("film [µm]", color=plot_style.INNER_COLOUR)
    bottom.set_xlabel("x, along the entrainment [mm]")
    pressure = bottom.twinx()
    pressure.plot(
        x, frame.pressure[middle, part] / GIGAPASCAL, color=plot_style.OUTER_COLOUR, linewidth=0.8
    )
    top_pressure = float(solution.series("pressure_maximum").max()) / GIGAPASCAL
    pressure.set_ylim(0.0, 1.05 * top_pressure)
    pressure.set_ylabel("pressure [GPa]", color=plot_style.OUTER_COLOUR)
    plot_style.keep_dollars(figure)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


class Frames:
    """A plotter whose bodies are moved from row to row of a history; lengths in [mm]."""

    def __init__(self, bearing: MovingBearing, title: str, size: tuple[int, int]) -> None:
        data = bearing.data
        self.bearing = bearing
        self.balls = _mesh(bearing.balls_at(0))
        self.balls["mark"] = np.tile(bearing.marks, data.sizes["ball"])
        self.cage = _mesh(bearing.cage_at(0))
        self.ring = _mesh(bearing.ring_at(0))
        largest_load = max(float(data["contact_load"].max()), 1e-300)
        self.arrow = LONGEST_ARROW * float(data.attrs["ball_diameter"]) / MILLIMETRE / largest_load
        self.plotter = pv.Plotter(off_screen=True, window_size=list(size))
        self.plotter.set_background("white")
        self._add_bodies()
        self.plotter.add_text(title, position="upper_left", font_size=9, color=plot_style.INK)
        camera = self.plotter.camera
        camera.focal_point = (0.0, 0.0, 0.0)
        camera.position = (1.0, 0.25, -0.35)
        camera.up = (0.0, 1.0, 0.0)
        self.plotter.reset_camera()
        camera.zoom(1.2)

    def _add_bodies(self) -> None:
        add = self.plotter.add_mesh
        marks = {"scalars": "mark", "cmap": [LIGHT, DARK], "clim": (0, 1)}
        add(self.balls, **marks, show_scalar_bar=False, specular=0.3, smooth_shading=False)
        add(self.cage, color=plot_style.CAGE_COLOUR, ambient=0.3)
        add(self.ring, color=RING_COLOUR, ambient=0.3, opacity=0.45)
        shape = ring_shape(self.bearing.data.attrs, inner=False)
        add(_mesh(ring_surface(shape, 0.0, (0.0, 0.0))), color=RING_COLOUR, opacity=0.12)

    def frame(self, row: int) -> Image.Image:
        """Picture of a sample.

        Parameters
        ----------
        row : int
            Sample of the history, counted from 0.

        Returns
        -------
        Image.Image
            The picture.
        """
        self.balls.points = _mesh(self.bearing.balls_at(row)).points
        self.cage.points = _mesh(self.bearing.cage_at(row)).points
        self.ring.points = _mesh(self.bearing.ring_at(row)).points
        for race, colour in FORCE_COLOURS.items():
            self._draw_forces(row, race, colour)
        time = 1000.0 * float(self.bearing.data["time"][row])
        self.plotter.add_text(
            f"{time:.2f} ms", position="lower_left", font_size=9, color=plot_style.INK, name="time"
        )
        self.plotter.render()
        return Image.fromarray(self.plotter.screenshot(return_img=True))

    def _draw_forces(self, row: int, race: str, colour: str) -> None:
        """Arrows that end where a race pushes on the balls."""
        name = f"forces {race}"
        self.plotter.remove_actor(name, render=False)
        points, forces = self.bearing.forces_at(row, race)
        pushed = np.linalg.norm(forces, axis=1) > 0.0
        if not pushed.any():
            return
        length = forces[pushed] * self.arrow
        cloud = pv.PolyData(points[pushed] / MILLIMETRE - length)
        cloud["force"] = length
        form = pv.Arrow(tip_length=0.3, tip_radius=0.1, shaft_radius=0.04)
        arrows = cloud.glyph(orient="force", scale="force", factor=1.0, geom=form)
        self.plotter.add_mesh(arrows, color=colour, name=name, lighting=False, render=False)


def _mesh(surface: Surface) -> pv.PolyData:
    return pv.wrap(poly_data(surface))


def draw_frames(directory: Path, file: Path, options: AnimationOptions) -> None:
    """Draw all frames in this process.

    Parameters
    ----------
    directory : Path
        Folder of the results.
    file : Path
        GIF file.
    options : AnimationOptions
        Choices of the picture; the defaults if None.
    """
    with open_history(directory) as data:
        bearing = MovingBearing.read(data, options.frames, options.turns, options.window)
        title = str(data.attrs.get("title", ""))
    legend = "forces on the balls: inner race blue, outer race orange"
    frames = Frames(bearing, f"{title}\n{legend}", options.size)
    write_gif([frames.frame(row) for row in range(bearing.data.sizes["time"])], file, FRAME_TIME)
    frames.plotter.close()


if __name__ == "__main__":
    folder, target, asked = read_request(sys.argv[1])
    assert target is not None
    draw_frames(folder, target, AnimationOptions(**asked))

"""The frames of a simulated bearing in motion, drawn with pyvista into a GIF."""

import sys
from pathlib import Path

import numpy as np
import pyvista as pv
from PIL import Image

from ehl.units import MILLIMETRE

from ..dynamics.stored import open_history
from ..plot_style import CAGE_COLOUR, INK, INNER_COLOUR, OUTER_COLOUR
from .geometry import Surface, ring_shape, ring_surface
from .rendering import read_request, write_gif
from .scene import AnimationOptions
from .vtk import poly_data
from .vtk_history import RACES, MovingBearing

LIGHT = "#e8ebef"
DARK = "#39424e"
RING_COLOUR = "#c3cad3"
FORCE_COLOURS = dict(zip(RACES, (INNER_COLOUR, OUTER_COLOUR), strict=True))
PER_FRAME = 60  # [ms]
LONGEST_ARROW = 0.9  # over the ball diameter [-]


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
        self.plotter.add_text(title, position="upper_left", font_size=9, color=INK)
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
        add(self.cage, color=CAGE_COLOUR, ambient=0.3)
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
            f"{time:.2f} ms", position="lower_left", font_size=9, color=INK, name="time"
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
    write_gif([frames.frame(row) for row in range(bearing.data.sizes["time"])], file, PER_FRAME)
    frames.plotter.close()


if __name__ == "__main__":
    folder, target, asked = read_request(sys.argv[1])
    assert target is not None
    draw_frames(folder, target, AnimationOptions(**asked))

"""A simulated bearing in motion: balls that roll with visible marks, cage, forces as arrows; a
GIF, steps for ParaView.

Drawing happens in a process of its own, which may die of a missing library without harm
(`rendering`).
"""

import json
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
import pyvista as pv
import xarray
from numpy.typing import NDArray
from PIL import Image

from bearing import Bearing, load_material
from ehl.units import MILLIMETRE

from ..dynamics.history import open_history
from ..files import atomic_path
from .geometry import Surface, ball_surface, grid_quads, merge, ring_surface
from .rendering import PATIENCE, RenderingError, advice, run_python
from .vtk import collection_text

Array = NDArray[np.float64]

COLLECTION_FILE = "motion.pvd"
STEP_FOLDER = "motion"
LIGHT = "#e8ebef"
DARK = "#39424e"
CAGE_COLOUR = "#b98a4a"
RING_COLOUR = "#c3cad3"
INK = "#1b1f24"
# of a frame; picked to cover, not by area, so that the few points of the arrows keep theirs
COLOURS = 128
FORCE_COLOURS = {"inner": "#0b5394", "outer": "#c1440e"}
PER_FRAME = 60  # [ms]
BALL_RINGS = 16  # of a ball's mesh
# width of the cage's rims and length of its bars over the ball's diameter [-]
BAND = 0.18
BAR = 0.5
LONGEST_ARROW = 0.9  # over the ball's diameter [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class AnimationOptions:
    """What is shown.

    Attributes
    ----------
    frames : int
    turns : float
        Turns of the cage at the end of the history [-].
    size : tuple of int
        Pixels.
    steps : bool
        Write steps for ParaView, too.
    """

    frames: int = 72
    turns: float = 0.5
    size: tuple[int, int] = (800, 720)
    steps: bool = True

    def __post_init__(self) -> None:
        if self.frames < 2 or not self.turns > 0.0:
            raise ValueError(
                f"frames must be at least 2 and turns positive, got {self.frames}, {self.turns}"
            )


def animate(
    directory: str | Path, file: str | Path, options: AnimationOptions | None = None
) -> Path:
    """Write the motion of a simulation as an animated GIF, without a display, and beside its
    history for ParaView.

    Parameters
    ----------
    directory : str or Path
        With `history.nc`.
    file : str or Path
        A .gif file.
    options : AnimationOptions, optional

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        If there is no history, or the file is no .gif.
    RenderingError
        If the machine cannot draw; this process is not harmed.
    """
    path = Path(file)
    if path.suffix.lower() != ".gif":
        raise ValueError(f"the animation must be a .gif file, got {path.name}")
    open_history(directory).close()
    with atomic_path(path) as temporary:
        request = {
            "directory": str(directory),
            "file": str(temporary),
            "options": asdict(options or AnimationOptions()),
        }
        run_python(["-m", f"{__package__}.animation", json.dumps(request)], 4.0 * PATIENCE)
        if not temporary.stat().st_size:
            raise RenderingError(advice("no animation came out"))
    return path


def shown_rows(data: xarray.Dataset, options: AnimationOptions) -> NDArray[np.int64]:
    """Rows of the history that become frames, evenly spaced over the last turns."""
    place = data["ball_position"].sel(ball=1).to_numpy()
    turned = np.unwrap(np.arctan2(place[:, 2], place[:, 1]))
    near = np.abs(turned - turned[-1]) < 2.0 * np.pi * options.turns
    first = int(np.argmax(near))
    rows = np.linspace(first, turned.size - 1, min(options.frames, turned.size - first))
    return np.unique(np.round(rows).astype(np.int64))


def rotation(quaternion: Array) -> Array:
    """Rotation matrix [-], shape (3, 3), of a unit quaternion w, x, y, z [-]."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def ball_marks(radius: float) -> tuple[Surface, Array]:
    """A ball of `radius` [m] and, at its points, 1 on dark and 0 on light eighths of it [-]."""
    surface = ball_surface(np.zeros(3), radius, BALL_RINGS)
    direction = surface.points / radius
    return surface, (np.prod(np.sign(np.round(direction, 9)), axis=1) > 0.0).astype(np.float64)


def cage_surface(pitch: float, ball: float, balls: int) -> Surface:
    """A cage for the eye, in its own frame [m]: two rims beside the balls and bars between them."""
    side = 0.5 * ball * (1.0 + BAND)
    radius = 0.5 * pitch
    parts = []
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for axial in (-side, side):
        parts.append(_band(turn, (axial - 0.5 * BAND * ball, axial + 0.5 * BAND * ball), radius))
    half = 0.5 * BAR * (2.0 * np.pi / balls - 2.0 * np.arcsin(0.52 * ball / radius))
    for k in range(balls):
        middle = 2.0 * np.pi * (k + 0.5) / balls
        parts.append(_band(np.linspace(middle - half, middle + half, 5), (-side, side), radius))
    return merge(parts)


def _band(turn: Array, axial: tuple[float, float], radius: float) -> Surface:
    x, t = np.meshgrid(np.array(axial), turn, indexing="ij")
    points = np.stack([x, radius * np.cos(t), radius * np.sin(t)], axis=-1)
    return Surface(points=points.reshape(-1, 3), quads=grid_quads(*x.shape))


def bearing_of(data: xarray.Dataset) -> Bearing:
    """Bearing of a history by its dimensions [m]; the materials do not show."""
    steel = load_material("bearing steel")
    names = (
        "ball_diameter",
        "pitch_diameter",
        "inner_groove_radius",
        "outer_groove_radius",
        "diametral_clearance",
    )
    dimensions: dict[str, Any] = {name: float(data.attrs[name]) for name in names}
    dimensions |= {
        name: float(data.attrs[name])
        for name in ("bore", "width", "outside_diameter")
        if name in data.attrs
    }
    dimensions |= dict.fromkeys(
        ("ball_material", "inner_ring_material", "outer_ring_material"), steel
    )
    return Bearing(name="shown", balls=data.sizes["ball"], **dimensions)


class _Motion:
    """Meshes of a moving bearing [mm], brought to a row of its history."""

    def __init__(self, data: xarray.Dataset, rows: NDArray[np.int64]) -> None:
        self.data = data.isel(time=rows).load()
        self.bearing = bearing_of(data)
        radius = 0.5 * self.bearing.ball_diameter
        self.ball, marks = ball_marks(radius)
        n = self.bearing.balls
        self.cage_form = cage_surface(self.bearing.pitch_diameter, self.bearing.ball_diameter, n)
        self.balls = _mesh(merge([self.ball] * n))
        self.balls["mark"] = np.tile(marks, n)
        self.cage = _mesh(self.cage_form)
        self.ring_form = ring_surface(self.bearing, True, 0.0, (0.0, 0.0))
        self.ring = _mesh(self.ring_form)
        loads = self.data["contact_load"].to_numpy()
        self.arrow = LONGEST_ARROW * self.bearing.ball_diameter / max(float(loads.max()), 1e-300)

    def move(self, row: int) -> None:
        """Bring the meshes to a row."""
        one = self.data.isel(time=row)
        centres = one["ball_position"].to_numpy()
        attitude = one["ball_attitude"].to_numpy().astype(np.float64)
        parts = [
            c + self.ball.points @ rotation(q).T for c, q in zip(centres, attitude, strict=True)
        ]
        self.balls.points = np.concatenate(parts) / MILLIMETRE
        cage = one["cage_position"].to_numpy()
        first = float(self.data.attrs["first_ball_azimuth"])
        self.cage.points = (
            cage[:3] + self.cage_form.points @ about_axis(first + cage[3]).T
        ) / MILLIMETRE
        ring = one["ring_position"].to_numpy()
        turn = about_axis(float(one["ring_rotation"]))
        self.ring.points = (ring[:3] + self.ring_form.points @ turn.T) / MILLIMETRE

    def forces(self, row: int, race: str) -> tuple[Array, Array]:
        """Where the forces of a race act on the balls [m], and the forces [N], shapes (Z, 3)."""
        one = self.data.isel(time=row)
        centres = one["ball_position"].to_numpy().astype(np.float64)
        load = one["contact_load"].sel(race=race).to_numpy()[:, None]
        angle = one["contact_contact_angle"].sel(race=race).to_numpy()[:, None]
        radial = centres * np.array([0.0, 1.0, 1.0])
        radial /= np.linalg.norm(radial, axis=1, keepdims=True)
        out = np.sin(angle) * np.array([1.0, 0.0, 0.0]) + np.cos(angle) * radial
        normal = out if race == "outer" else -out
        return centres + 0.5 * self.bearing.ball_diameter * normal, -load * normal


def about_axis(angle: float) -> Array:
    """Rotation about x by an angle [rad], shape (3, 3) [-]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _mesh(surface: Surface) -> pyvista.PolyData:
    faces = np.column_stack([np.full(len(surface.quads), 4), surface.quads]).ravel()
    return pv.PolyData(surface.points / MILLIMETRE, faces)


def _arrows(motion: _Motion, row: int, race: str) -> pyvista.PolyData | None:
    """Arrows that end where a race pushes on the balls [mm]; None where it does not."""
    points, forces = motion.forces(row, race)
    pushed = np.linalg.norm(forces, axis=1) > 0.0
    if not pushed.any():
        return None
    length = forces[pushed] * motion.arrow / MILLIMETRE
    cloud = pv.PolyData(points[pushed] / MILLIMETRE - length)
    cloud["force"] = length
    form = pv.Arrow(tip_length=0.3, tip_radius=0.1, shaft_radius=0.04)
    return cloud.glyph(orient="force", scale="force", factor=1.0, geom=form)


def _plotter(motion: _Motion, title: str, size: tuple[int, int]) -> pyvista.Plotter:
    plotter = pv.Plotter(off_screen=True, window_size=list(size))
    plotter.set_background("white")
    plotter.add_mesh(
        motion.balls,
        scalars="mark",
        cmap=[LIGHT, DARK],
        clim=(0, 1),
        show_scalar_bar=False,
        specular=0.3,
        smooth_shading=False,
    )
    plotter.add_mesh(motion.cage, color=CAGE_COLOUR, ambient=0.3)
    plotter.add_mesh(motion.ring, color=RING_COLOUR, ambient=0.3, opacity=0.45)
    outer = _mesh(ring_surface(motion.bearing, False, 0.0, (0.0, 0.0)))
    plotter.add_mesh(outer, color=RING_COLOUR, opacity=0.12)
    plotter.add_text(title, position="upper_left", font_size=9, color=INK)
    plotter.camera.focal_point = (0.0, 0.0, 0.0)
    plotter.camera.position = (1.0, 0.25, -0.35)
    plotter.camera.up = (0.0, 1.0, 0.0)
    plotter.reset_camera()
    plotter.camera.zoom(1.2)
    return plotter


def _draw(directory: Path, file: Path, options: AnimationOptions) -> None:
    """All frames, in this process."""
    with open_history(directory) as data:
        rows = shown_rows(data, options)
        motion = _Motion(data, rows)
        title = str(data.attrs.get("title", ""))
    plotter = _plotter(
        motion, f"{title}\nforces on the balls: inner race blue, outer race red", options.size
    )
    frames = []
    steps = {}
    for row, time in enumerate(motion.data["time"].to_numpy()):
        motion.move(row)
        for race, colour in FORCE_COLOURS.items():
            arrows = _arrows(motion, row, race)
            plotter.remove_actor(f"forces {race}", render=False)
            if arrows is not None:
                plotter.add_mesh(
                    arrows, color=colour, name=f"forces {race}", lighting=False, render=False
                )
        plotter.add_text(
            f"{1000.0 * time:.2f} ms", position="lower_left", font_size=9, color=INK, name="time"
        )
        plotter.render()
        picture = Image.fromarray(plotter.screenshot(return_img=True))
        frames.append(picture.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE))
        if options.steps:
            steps[float(time)] = _write_step(motion, directory, row)
    plotter.close()
    frames[0].save(
        file, save_all=True, append_images=frames[1:], duration=PER_FRAME, loop=0, optimize=True
    )
    if steps:
        with atomic_path(directory / COLLECTION_FILE) as temporary:
            temporary.write_text(collection_text(steps), encoding="utf-8")


def _write_step(motion: _Motion, directory: Path, row: int) -> str:
    """Balls, cage and ring of one step for ParaView in one file [mm], marks and loads [N] on the
    points.
    """
    folder = directory / STEP_FOLDER
    folder.mkdir(exist_ok=True)
    each = len(motion.ball.points)
    one = motion.data.isel(time=row)
    balls = motion.balls.copy()
    for race in FORCE_COLOURS:
        balls[f"{race} load [N]"] = np.repeat(one["contact_load"].sel(race=race).to_numpy(), each)
    parts: list[pv.PolyData] = [balls]
    for number, mesh in enumerate((motion.cage, motion.ring), start=2):
        part = mesh.copy()
        part["mark"] = np.full(part.n_points, float(number))
        parts.append(part)
    name = f"{STEP_FOLDER}/step{row:04d}.vtp"
    pv.merge(parts).extract_surface(algorithm=None).save(directory / name)
    return name


def _main(request: str) -> None:
    asked = json.loads(request)
    options = asked["options"]
    options["size"] = tuple(options["size"])
    _draw(Path(asked["directory"]), Path(asked["file"]), AnimationOptions(**options))


if __name__ == "__main__":
    _main(sys.argv[1])

"""A simulated bearing in motion, read from its history: shapes at a time, steps for ParaView.

Nothing is drawn here; `transient` draws the same shapes.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from ..dynamics.read import open_history
from ..files import write_text
from . import geometry
from .vtk import add_array, collection_text, poly_data, write_block

COLLECTION_FILE = "motion.pvd"
STEP_FOLDER = "motion"
RACES = ("inner", "outer")
BALL_RINGS = 16  # of a ball's mesh
RING_RESOLUTION = (16, 91)  # each step holds the ring anew
MOVED = tuple(  # quantities that the shapes are moved by
    (
        "ball_position ball_attitude cage_position ring_position ring_rotation contact_load "
        "contact_contact_angle"
    ).split()
)
FRAMES = 72
TURNS = 0.5  # of the cage at the end of the history that are shown [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class MovingBearing:
    """Shapes of a bearing in their own frames [m], and the history that moves them."""

    data: xarray.Dataset  # the rows shown, in memory, SI
    ball: geometry.Surface
    marks: Array  # at the points of a ball: 1 on dark, 0 on light eighths of it [-]
    cage: geometry.Surface
    ring: geometry.Surface

    @classmethod
    def read(
        cls,
        data: xarray.Dataset,
        frames: int,
        turns: float,
        window: tuple[float, float] | None = None,
    ) -> "MovingBearing":
        """Take evenly spaced samples of a history, over its last turns or over a window.

        Parameters
        ----------
        data : xarray.Dataset
            History of a simulation, SI.
        frames : int
            Pictures at most [-].
        turns : float
            Turns of the cage at the end of the history [-].
        window : tuple[float, float] | None, optional
            First and last time [s], instead of the turns.

        Returns
        -------
        MovingBearing
            The bearing.
        """
        diameter = float(data.attrs["ball_diameter"])
        ball, marks = marked_ball(0.5 * diameter)
        rows = shown_rows(data, frames, turns, window)
        # in one piece of each quantity: rows one by one take a hundred times as many look-ups
        piece = data[list(MOVED)].isel(time=slice(int(rows[0]), int(rows[-1]) + 1)).load()
        return cls(
            data=piece.isel(time=rows - rows[0]),
            ball=ball,
            marks=marks,
            cage=geometry.cage_surface(
                float(data.attrs["pitch_diameter"]), diameter, data.sizes["ball"]
            ),
            ring=geometry.ring_surface(
                geometry.ring_shape(data.attrs, inner=True), 0.0, (0.0, 0.0), RING_RESOLUTION
            ),
        )

    def balls_at(self, row: int) -> geometry.Surface:
        """All balls, at their positions and in their attitudes.

        Parameters
        ----------
        row : int
            Sample of the history, counted from 0.

        Returns
        -------
        Surface
            The surface [m].
        """
        centres = self.data["ball_position"].to_numpy()[row]
        attitudes = self.data["ball_attitude"].to_numpy()[row].astype(np.float64)
        return geometry.merge(
            [
                _moved(self.ball, centre, geometry.rotation(attitude))
                for centre, attitude in zip(centres, attitudes, strict=True)
            ]
        )

    def cage_at(self, row: int) -> geometry.Surface:
        """The cage at a sample.

        Parameters
        ----------
        row : int
            Sample of the history, counted from 0.

        Returns
        -------
        Surface
            The surface [m].
        """
        place = self.data["cage_position"].to_numpy()[row]
        angle = float(self.data.attrs["first_ball_azimuth"]) + place[3]
        return _moved(self.cage, place[:3], geometry.about_axis(angle))

    def ring_at(self, row: int) -> geometry.Surface:
        """The inner ring at a sample.

        Parameters
        ----------
        row : int
            Sample of the history, counted from 0.

        Returns
        -------
        Surface
            The surface [m].
        """
        turn = geometry.about_axis(float(self.data["ring_rotation"].to_numpy()[row]))
        return _moved(self.ring, self.data["ring_position"].to_numpy()[row, :3], turn)

    def forces_at(self, row: int, race: str) -> tuple[Array, Array]:
        """Points where a race pushes on the balls, and the forces.

        Parameters
        ----------
        row : int
            Sample of the history, counted from 0.
        race : str
            "inner" or "outer".

        Returns
        -------
        value
            Points, shape (Z, 3) [m].
        value
            Forces, shape (Z, 3) [N].
        """
        one = self.data.isel(time=row)
        centres = one["ball_position"].to_numpy().astype(np.float64)
        load = one["contact_load"].sel(race=race).to_numpy()[:, None]
        angle = one["contact_contact_angle"].sel(race=race).to_numpy()[:, None]
        radial = centres * np.array([0.0, 1.0, 1.0])
        radial /= np.linalg.norm(radial, axis=1, keepdims=True)
        out = np.sin(angle) * np.array([1.0, 0.0, 0.0]) + np.cos(angle) * radial
        normal = out if race == "outer" else -out
        return centres + 0.5 * self.data.attrs["ball_diameter"] * normal, -load * normal


def _moved(surface: geometry.Surface, place: Array, turn: Array) -> geometry.Surface:
    return geometry.Surface(points=place + surface.points @ turn.T, quads=surface.quads)


def marked_ball(radius: float) -> tuple[geometry.Surface, Array]:
    """A ball with dark and light eighths.

    Parameters
    ----------
    radius : float
        Radius [m].

    Returns
    -------
    value
        The surface [m].
    value
        1 at points of dark, 0 of light eighths, shape (n,) [-].
    """
    surface = geometry.ball_surface(np.zeros(3), radius, BALL_RINGS)
    direction = surface.points / radius
    return surface, (np.prod(np.sign(np.round(direction, 9)), axis=1) > 0.0).astype(np.float64)


def shown_rows(
    data: xarray.Dataset, frames: int, turns: float, window: tuple[float, float] | None = None
) -> NDArray[np.int64]:
    """Samples that are shown, evenly spaced.

    Parameters
    ----------
    data : xarray.Dataset
        History of a simulation, SI.
    frames : int
        Pictures at most [-].
    turns : float
        Turns of the cage at the end of the history [-].
    window : tuple[float, float] | None, optional
        First and last time [s], instead of the turns.

    Returns
    -------
    NDArray[np.int64]
        Numbers of the samples, ascending.

    Raises
    ------
    ValueError
        If the window has no two samples.
    """
    if window is None:
        place = data["ball_position"].sel(ball=1).to_numpy()
        turned = np.unwrap(np.arctan2(place[:, 2], place[:, 1]))
        first = int(np.argmax(np.abs(turned - turned[-1]) < 2.0 * np.pi * turns))
        last = turned.size - 1
    else:
        time = data["time"].to_numpy()
        inside = np.flatnonzero((time >= window[0]) & (time <= window[1]))
        if inside.size < 2:
            span = f"{1e3 * window[0]:g} to {1e3 * window[1]:g} ms"
            raise ValueError(f"no two samples of the history lie in {span}")
        first = int(inside[0])
        last = int(inside[-1])
    rows = np.linspace(first, last, min(frames, last - first + 1))
    return np.unique(np.round(rows).astype(np.int64))


def write_motion(directory: Path, frames: int = FRAMES, turns: float = TURNS) -> Path:
    """Write steps over the last turns of the cage for ParaView, and their .pvd file.

    Each step is one file: balls, cage and inner ring, lengths in [mm]; at the points `mark` (0 and
    1 on balls, 2 cage, 3 ring) and the loads of the ball there [N].

    Parameters
    ----------
    directory : Path
        Folder of the history.
    frames : int, default FRAMES
        Pictures at most [-].
    turns : float, default TURNS
        Turns of the cage at the end of the history [-].

    Returns
    -------
    Path
        The .pvd file.
    """
    with open_history(directory) as data:
        bearing = MovingBearing.read(data, frames, turns)
    steps = {}
    for row, time in enumerate(bearing.data["time"].to_numpy()):
        name = f"{STEP_FOLDER}/step{row:04d}.vtp"
        write_block(_step(bearing, row), directory / name)
        steps[float(time)] = name
    write_text(directory / COLLECTION_FILE, collection_text(steps))
    return directory / COLLECTION_FILE


def _step(bearing: MovingBearing, row: int) -> object:
    """Balls, cage and ring at one time as vtkPolyData."""
    bodies = (bearing.balls_at(row), bearing.cage_at(row), bearing.ring_at(row))
    numbers = np.repeat((0.0, 2.0, 3.0), [len(body.points) for body in bodies])
    of_balls = numbers == 0.0
    time = float(bearing.data["time"].to_numpy()[row])
    grid = poly_data(geometry.merge(bodies), {"time [s]": time})
    loads = bearing.data["contact_load"].to_numpy()[row]
    for race, load_of_race in zip(RACES, loads, strict=True):
        load = np.zeros_like(numbers)
        load[of_balls] = np.repeat(load_of_race, len(bearing.marks))
        add_array(grid, f"{race} load [N]", load)
    numbers[of_balls] = np.tile(bearing.marks, loads.shape[1])
    add_array(grid, "mark", numbers)
    return grid

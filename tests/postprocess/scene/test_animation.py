"""The motion of a simulation: which rows are shown, marks that turn with the balls, steps for ParaView and a GIF."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose

from oilfilm.postprocess.dynamics.read import open_history
from oilfilm.postprocess.scene.geometry import about_axis, cage_surface, ring_shape, ring_surface, rotation
from oilfilm.postprocess.scene.render_process import RenderingError, require_rendering
from oilfilm.postprocess.scene.scene import AnimationOptions, animate
from oilfilm.postprocess.scene.vtk_history import RING_RESOLUTION, marked_ball, shown_rows, write_motion


def test_rotation_of_a_quaternion():
    half = 0.5 * 0.7
    assert_allclose(rotation(np.array([np.cos(half), np.sin(half), 0.0, 0.0])), about_axis(0.7), atol=1e-15)
    turn = rotation(np.array([0.3, -0.2, 0.9, 0.1]))
    assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)


def test_half_of_a_ball_is_marked():
    surface, marks = marked_ball(3.0e-3)
    assert_allclose(np.linalg.norm(surface.points, axis=1), 3.0e-3)
    assert 0.3 < marks.mean() < 0.6


def test_the_bars_of_a_cage_lie_between_the_balls():
    cage = cage_surface(54e-3, 7e-3, 18)
    bars = cage.points[np.abs(cage.points[:, 0]) < 4.2e-3]
    azimuth = np.arctan2(bars[:, 2], bars[:, 1])
    for j in range(18):
        middle = 2.0 * np.pi * j / 18
        inside = np.abs(np.angle(np.exp(1j * (azimuth - middle)))) < np.arcsin(3.5 / 27.0)
        rims = np.abs(np.abs(bars[:, 0]) - 0.5 * 7e-3 * 1.18) < 0.7e-3
        assert not (inside & ~rims).any()


def test_options_are_checked(tmp_path):
    with pytest.raises(ValueError, match="frames"):
        AnimationOptions(frames=1)
    with pytest.raises(ValueError, match=r"must end in \.gif"):
        animate(tmp_path, tmp_path / "film.mp4")
    with pytest.raises(ValueError, match="no history"):
        animate(tmp_path, tmp_path / "film.gif")


@pytest.fixture
def history(tmp_path):
    """Three balls that go round with the cage, the ring ahead of them; the first is loaded."""
    m, balls = 9, 3
    time = np.linspace(0.0, 8e-3, m)
    angle = 0.5 + 100.0 * time
    of_ball = angle[:, None] + 2.0 * np.pi * np.arange(balls) / balls
    position = np.stack([np.full_like(of_ball, 1e-4), 0.02 * np.cos(of_ball), 0.02 * np.sin(of_ball)], axis=-1)
    attitude = np.zeros((m, balls, 4))
    attitude[..., 0] = np.cos(0.5 * angle[:, None])
    attitude[..., 1] = np.sin(0.5 * angle[:, None])
    cage, ring = np.zeros((m, 6)), np.zeros((m, 5))
    cage[:, 3] = angle - 0.5
    load = np.zeros((m, 2, balls))
    load[:, :, 0] = [70.0, 80.0]
    data = xr.Dataset(
        {
            "ball_position": (("time", "ball", "axis"), position),
            "ball_attitude": (("time", "ball", "quaternion"), attitude),
            "cage_position": (("time", "cage_coordinate"), cage),
            "ring_position": (("time", "ring_coordinate"), ring),
            "ring_rotation": (("time",), 2.5 * angle),
            "contact_load": (("time", "race", "ball"), load),
            "contact_contact_angle": (("time", "race", "ball"), np.full((m, 2, balls), 0.1)),
        },
        {"time": time, "ball": [1, 2, 3], "race": ["inner", "outer"]},
        LENGTHS | {"oilfilm_history": 1, "first_ball_azimuth": 0.5, "title": "three balls"},
    )
    data.to_netcdf(tmp_path / "history.nc", engine="h5netcdf")
    return tmp_path


LENGTHS = {
    "ball_diameter": 8e-3,
    "pitch_diameter": 40e-3,
    "inner_groove_radius": 4.1e-3,
    "outer_groove_radius": 4.2e-3,
    "diametral_clearance": 10e-6,
}


def test_rows_are_those_of_the_last_turns(history):
    """0.8 rad in all: 0.05 turns are the last four samples, half a turn is everything."""
    with open_history(history) as data:
        assert shown_rows(data, 72, 0.05).tolist() == [5, 6, 7, 8]
        assert shown_rows(data, 72, 0.5).tolist() == list(range(9))
        assert shown_rows(data, 3, 0.5).tolist() == [0, 4, 8]


def test_steps_are_the_history(history):
    """Places of balls, cage and ring at a time, read back; marks turn with the balls."""
    pv = pytest.importorskip("pyvista")
    path = write_motion(history, frames=3)
    reader = pv.get_reader(path)
    assert_allclose(reader.time_values, [0.0, 4e-3, 8e-3])
    reader.set_active_time_value(4e-3)
    step = reader.read()[0]
    ball, marks = marked_ball(4e-3)
    n = len(ball.points)
    turn = about_axis(0.5 + 0.4)
    expected = np.array([1e-4, 0.02 * np.cos(0.9), 0.02 * np.sin(0.9)]) + ball.points @ turn.T
    assert_allclose(step.points[:n], 1e3 * expected, atol=1e-5)  # float32 at 20 mm
    assert_allclose(step["mark"][:n], marks)
    cage = cage_surface(40e-3, 8e-3, 3).points @ turn.T  # azimuth of the first ball and the cage's own
    start, stop = 3 * n, 3 * n + len(cage)
    assert_allclose(step.points[start:stop], 1e3 * cage, atol=1e-5)
    assert (step["mark"][start:stop] == 2.0).all() and (step["mark"][stop:] == 3.0).all()
    ring = ring_surface(ring_shape(LENGTHS, inner=True), 0.0, (0.0, 0.0), RING_RESOLUTION).points
    ring = ring @ about_axis(2.25).T
    assert_allclose(step.points[stop:], 1e3 * ring, atol=1e-5)
    for race, load in (("inner", 70.0), ("outer", 80.0)):
        assert_allclose(step[f"{race} load [N]"], np.where(np.arange(step.n_points) < n, load, 0.0))
    assert step.field_data["time [s]"][0] == 4e-3
    assert step.field_data["coordinates"][0] == "mm"


@pytest.mark.slow
def test_steps_need_no_drawing(history):
    """Written in a process that can import neither pyvista nor VTK's rendering."""
    code = """
import sys
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == "pyvista" or "Rendering" in name:
            raise ImportError(f"{name} is blocked")
sys.meta_path.insert(0, Blocked())
from pathlib import Path
from oilfilm.postprocess.scene.vtk_history import write_motion
write_motion(Path(sys.argv[1]))
"""
    subprocess.run([sys.executable, "-c", code, str(history)], check=True)
    assert len(list((history / "motion").glob("*.vtp"))) == 9
    assert not list(history.rglob(".*"))


@pytest.mark.slow
def test_a_gif_has_a_frame_for_each_row(history, tmp_path):
    from PIL import Image

    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    animate(history, tmp_path / "film.gif", AnimationOptions(frames=3, size=(160, 144)))
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 3
        assert np.asarray(film.convert("L")).std() > 10.0


@pytest.mark.slow
def test_a_simulation_gives_a_gif_and_steps(tmp_path):
    from dataclasses import replace

    from PIL import Image

    from oilfilm.cases import load_case
    from oilfilm.cases.runs.dynamics import run_dynamics

    case = load_case("7008_axial")
    assert case.file.dynamics is not None
    table = case.file.dynamics.model_copy(update={"end_time_s": 2e-3, "output_interval_us": 100.0})
    case = replace(case, file=case.file.model_copy(update={"dynamics": table}))
    run_dynamics(case, "case", tmp_path / "history.nc")
    with open_history(tmp_path) as data:
        assert shown_rows(data, 3, 0.5).tolist() == [0, 10, 19]
    animate(tmp_path, tmp_path / "film.gif", AnimationOptions(frames=3, size=(320, 240)))
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 3
        assert np.asarray(film.convert("L")).std() > 10.0
    write_motion(tmp_path, frames=3)
    assert len(list((tmp_path / "motion").glob("*.vtp"))) == 3
    assert "motion/step0002.vtp" in (tmp_path / "motion.pvd").read_text(encoding="utf-8")

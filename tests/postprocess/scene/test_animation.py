"""The motion of a simulation: which rows are shown, marks that turn with the balls, a GIF and steps for ParaView."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from postprocess.dynamics.history import open_history
from postprocess.scene.animation import (
    AnimationOptions,
    about_axis,
    animate,
    ball_marks,
    cage_surface,
    rotation,
    shown_rows,
)


def test_rotation_of_a_quaternion():
    half = 0.5 * 0.7
    assert_allclose(rotation(np.array([np.cos(half), np.sin(half), 0.0, 0.0])), about_axis(0.7), atol=1e-15)
    turn = rotation(np.array([0.3, -0.2, 0.9, 0.1]))
    assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)


def test_half_of_a_ball_is_marked():
    surface, marks = ball_marks(3.0e-3)
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
    with pytest.raises(ValueError, match="gif"):
        animate(tmp_path, tmp_path / "film.mp4")
    with pytest.raises(ValueError, match="no history"):
        animate(tmp_path, tmp_path / "film.gif")


@pytest.mark.slow
def test_a_gif_and_steps(tmp_path):
    from PIL import Image

    from cases import load_case
    from cases.runs.dynamics import run_dynamics

    case = load_case("7008_axial")
    from dataclasses import replace

    assert case.dynamics is not None
    case = replace(case, dynamics=replace(case.dynamics, end_time=2e-3, sample_interval=1e-4))
    run_dynamics(case, "case", tmp_path / "history.nc")
    options = AnimationOptions(frames=3, size=(320, 240))
    with open_history(tmp_path) as data:
        assert shown_rows(data, options).tolist() == [0, 10, 19]
    animate(tmp_path, tmp_path / "film.gif", options)
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 3
        assert np.asarray(film.convert("L")).std() > 10.0
    assert len(list((tmp_path / "motion").glob("*.vtp"))) == 3
    assert "motion/step0002.vtp" in (tmp_path / "motion.pvd").read_text(encoding="utf-8")

"""The 3-D scene: drawn in a process of its own; where that dies, an error says what to install."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from postprocess import write_results
from postprocess.scene.rendering import (
    WINDOW_VARIABLE,
    RenderingError,
    rendering_environment,
    require_rendering,
    run_python,
)
from postprocess.scene.scene import SceneOptions, screenshot, show

LINUX = sys.platform.startswith("linux")


@pytest.fixture(scope="module")
def drawing():
    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))


@pytest.mark.usefixtures("drawing")
@pytest.mark.parametrize("quantity", ["film", "pressure"])
def test_screenshot_shows_something(bearing_folder, tmp_path, quantity):
    from matplotlib.image import imread

    path = screenshot(bearing_folder, tmp_path / "scene.png", SceneOptions(quantity=quantity, size=(400, 300)))
    picture = imread(path)
    assert picture.shape[:2] == (300, 400)
    saturation = np.ptp(picture[..., :3], axis=2)
    assert (saturation > 0.3).mean() > 0.005  # coloured patches, arrow and bar on grey bodies


@pytest.mark.usefixtures("drawing")
def test_single_contact_in_moes_units(moes_folder, tmp_path):
    assert screenshot(moes_folder, tmp_path / "scene.png", SceneOptions(size=(400, 300))).stat().st_size > 1000


@pytest.mark.usefixtures("drawing")
def test_round_off_of_a_radial_load_is_no_arrow(bearing_results, tmp_path):
    """Axial load alone, no films: nothing in the scene is red."""
    from matplotlib.image import imread

    state = replace(bearing_results.quasistatic, ring_force=np.array([3000.0, 1e-12, -2e-13]))
    bare = replace(bearing_results, quasistatic=state, solutions=(None,) * len(bearing_results.solutions))
    write_results(bare, tmp_path / "run")
    picture = imread(screenshot(tmp_path / "run", tmp_path / "scene.png", SceneOptions(size=(400, 300))))
    red = (picture[..., 0] > 0.5) & (picture[..., 1] < 0.25)
    assert not red.any()


def test_dying_process_becomes_an_error():
    with pytest.raises(RenderingError, match="apt install libegl1"):
        run_python(["-c", "import os; os.abort()"], 60.0)
    with pytest.raises(RenderingError, match="no display server"):
        run_python(["-c", "raise OSError('no display server')"], 60.0)


@pytest.mark.skipif(not LINUX, reason="Linux only")
def test_window_kind_is_chosen_without_a_display(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv(WINDOW_VARIABLE, raising=False)
    assert rendering_environment()[WINDOW_VARIABLE] == "vtkEGLRenderWindow"
    monkeypatch.setenv(WINDOW_VARIABLE, "mine")
    assert rendering_environment()[WINDOW_VARIABLE] == "mine"


@pytest.mark.skipif(not LINUX, reason="Linux only")
def test_window_needs_a_display(bearing_folder, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(RenderingError, match="--screenshot"):
        show(bearing_folder)


def test_bad_requests(bearing_folder, tmp_path):
    with pytest.raises(ValueError, match="holds no results"):
        screenshot(tmp_path, tmp_path / "scene.png")
    with pytest.raises(ValueError, match=r"\.png"):
        screenshot(bearing_folder, tmp_path / "scene.jpg")
    with pytest.raises(ValueError, match="quantity"):
        SceneOptions(quantity="temperature")


def test_importing_the_scene_opens_nothing():
    code = "import sys, postprocess.scene.scene; print('pyvista' in sys.modules)"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "False"


def test_results_without_a_scene_are_reported(tmp_path):
    """A history or a batch is no matter of a missing OpenGL."""
    import h5netcdf

    with h5netcdf.File(tmp_path / "history.nc", "w") as file:
        file.attrs.update({"oilfilm_history": 1, "oilfilm": "1.0"})
    with pytest.raises(ValueError, match="kind dynamics, which have no scene; allowed: bearing, contact"):
        screenshot(tmp_path, tmp_path / "scene.png")

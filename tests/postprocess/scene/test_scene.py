"""The 3-D scene: drawn in a process of its own; where that dies, an error says what to install."""

from __future__ import annotations

import errno
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

from oilfilm.postprocess.scene.render_process import (
    WINDOW_VARIABLE,
    RenderingError,
    rendering_environment,
    require_rendering,
    run_python,
)
from oilfilm.postprocess.scene.scene import SceneOptions, screenshot, view

from ...kept import kept

LINUX = sys.platform.startswith("linux")


@pytest.fixture(scope="module")
def drawing():
    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))


@pytest.mark.usefixtures("drawing")
@pytest.mark.parametrize("quantity", ["film", pytest.param("pressure", marks=pytest.mark.slow)])
def test_screenshot_shows_something(bearing_folder, tmp_path, quantity):
    from matplotlib.image import imread

    path = screenshot(bearing_folder, tmp_path / "scene.png", SceneOptions(quantity=quantity, size=(400, 300)))
    picture = imread(path)
    assert picture.shape[:2] == (300, 400)
    saturation = np.ptp(picture[..., :3], axis=2)
    assert (saturation > 0.3).mean() > 0.005  # coloured patches, arrow and bar on grey bodies


@pytest.mark.usefixtures("drawing")
@pytest.mark.slow
def test_single_contact_in_moes_units(moes_folder, tmp_path):
    assert screenshot(moes_folder, tmp_path / "scene.png", SceneOptions(size=(400, 300))).stat().st_size > 1000


@pytest.fixture(scope="module")
def scene(drawing, bearing_folder):
    """What stands in the scene of a bearing, for a page, drawn nowhere."""
    from oilfilm.postprocess.scene.drawing import build_scene

    return build_scene(bearing_folder, SceneOptions(quantity="pressure"), off_screen=True, for_page=True)


@pytest.mark.slow
def test_cage_axes_loads_and_rotation_stand_in_the_scene(scene, bearing_results):
    """Of a radial load: no axial arrow; a case without [operation] has no rotation."""
    names = set(scene.plotter.actors)
    assert {"cage", "balls", "inner ring", "outer ring"} <= names
    assert {"axis x", "axis y", "axis z", "radial load"} <= names
    assert not {"axial load", "rotation inner", "rotation outer"} & names
    texts = [label.text for label in scene.labels]
    assert {"x", "y", "z", "3000 N"} <= set(texts)
    cage = scene.plotter.actors["cage"].mapper.dataset
    pitch = 1e3 * bearing_results.quasistatic.bearing.pitch_diameter
    radii = np.hypot(*np.asarray(cage.points)[:, 1:].T)
    assert radii.max() == pytest.approx(0.5 * pitch, rel=0.01)


def test_quiet_pressure_does_not_hide_the_balls(scene):
    fields = [actor.mapper.dataset for actor in scene.plotter.actors.values() if hasattr(actor, "mapper")]
    patches = [mesh["pressure"] for mesh in fields if "pressure" in getattr(mesh, "point_data", {})]
    assert patches
    assert all(pressure.min() >= 0.04 * pressure.max() for pressure in patches)


def test_arrows_show_both_loads_and_both_senses(scene):
    from oilfilm.postprocess.scene.drawing import Room, add_loads, add_rotation

    bodies = {name: scene.plotter.actors[name].mapper.dataset for name in ("inner ring", "outer ring")}
    room = Room.of(bodies, 12.0)
    assert 0.0 < room.bore < room.faces["inner"] < room.faces["outer"] < room.outside
    labels = add_loads(scene.plotter, np.array([-300.0, 400.0, 0.0]), room)
    assert [label.text for label in labels] == ["400 N", "300 N"]
    axial = scene.plotter.actors["axial load"].mapper.dataset
    assert axial.bounds[0] == pytest.approx(room.front, abs=0.1)  # its tip touches the face, from outside
    labels = add_rotation(scene.plotter, {"inner": 1000.0, "outer": -500.0}, room, 0.0)
    assert [label.text for label in labels] == ["1000 r/min", "500 r/min"]
    inner, outer = (scene.plotter.actors[f"rotation {race}"].mapper.dataset for race in ("inner", "outer"))
    # about +x: from y to z, so that the tip of a positive rotation stands at positive z
    assert inner.bounds[5] > -inner.bounds[4] and -outer.bounds[4] > outer.bounds[5]


def test_round_off_of_a_radial_load_is_no_arrow(scene):
    from oilfilm.postprocess.scene.drawing import Room, add_loads

    bodies = {name: scene.plotter.actors[name].mapper.dataset for name in ("inner ring", "outer ring")}
    labels = add_loads(scene.plotter, np.array([3000.0, 1e-12, -2e-13]), Room.of(bodies, 12.0))
    assert [label.text for label in labels] == ["3000 N"]


def test_the_size_of_a_radial_load_stands_on_the_other_side_of_it_than_the_axes(scene):
    """Seen with the load upwards: z points to the left, the axes stand to the right."""
    from oilfilm.postprocess.scene.drawing import Room, add_axes, add_loads

    bodies = {name: scene.plotter.actors[name].mapper.dataset for name in ("inner ring", "outer ring")}
    room = Room.of(bodies, 12.0)
    (load,) = add_loads(scene.plotter, np.array([0.0, 3000.0, 0.0]), room)
    axes = [label for label in add_axes(scene.plotter, room, 0.0) if label.text != "z"]
    assert load.place[2] > 0.2 * room.bore
    assert all(label.place[2] < -0.2 * room.bore for label in axes)


def test_labels_of_many_balls_do_not_crowd():
    import xarray

    from oilfilm.postprocess.scene.parts import MOST_LABELS, ball_labels

    turn = np.tile(np.linspace(0.0, 2.0 * np.pi, 34, endpoint=False), 2)
    balls = xarray.Dataset(
        {
            "azimuth": ("ball", turn),
            "ball_axial": ("ball", np.repeat([-0.01, 0.01], 34)),
            "outer_load": ("ball", np.cos(turn)),
        }
    )
    labels = ball_labels(balls, 8.0, 40.0, 15.0)
    assert len(labels) <= MOST_LABELS
    assert labels[0].text == "0°" and labels[0].place[0] == pytest.approx(-10.0)
    assert all(np.hypot(*label.place[1:]) > 40.0 for label in labels)


def test_dying_process_becomes_an_error():
    with pytest.raises(RenderingError, match="apt install libegl1"):
        run_python(["-c", "import os; os.abort()"], 60.0)
    with pytest.raises(RenderingError, match="no display server"):
        run_python(["-c", "raise OSError('no display server')"], 60.0)


def test_a_full_disk_is_no_missing_library():
    with pytest.raises(OSError, match=r"File too large") as full:
        run_python(["-c", "import errno; raise OSError(errno.EFBIG, 'File too large')"], 60.0)
    assert full.value.errno == errno.EFBIG
    assert "OpenGL" not in str(full.value)


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
        view(bearing_folder)


def test_bad_requests(bearing_folder, tmp_path):
    with pytest.raises(ValueError, match="holds no results"):
        screenshot(tmp_path, tmp_path / "scene.png")
    with pytest.raises(ValueError, match=r"\.png"):
        screenshot(bearing_folder, tmp_path / "scene.jpg")
    with pytest.raises(ValueError, match="quantity"):
        SceneOptions(quantity="temperature")


@pytest.mark.slow
def test_importing_the_scene_opens_nothing():
    code = "import sys, oilfilm.postprocess.scene.scene; print('pyvista' in sys.modules)"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "False"


def test_results_without_a_scene_are_reported(tmp_path):
    """A history or a batch is no matter of a missing OpenGL."""
    import h5netcdf

    with h5netcdf.File(tmp_path / "history.nc", "w") as file:
        file.attrs.update({"oilfilm_history": 1, "oilfilm": "1.0"})
    with pytest.raises(ValueError, match="kind dynamics, which have no scene; allowed: bearing, contact"):
        screenshot(tmp_path, tmp_path / "scene.png")


def test_a_drawing_process_ends_with_the_one_that_asked():
    """Also where that is killed: the pipe to its standard input ends."""
    code = "from oilfilm.postprocess.scene.render_process import read_request\n"
    code += "read_request('[\"results\", null, {}]'); print('up', flush=True); import time; time.sleep(60)"
    with subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"up\n"
        assert process.poll() is None
        process.stdin.close()
        assert process.wait(20) == 1


@pytest.mark.parametrize(
    ("words", "drawing"),
    [(["--screenshot", "a.png"], "screenshot"), (["--html", "a.html"], "export_html"), (["--movie", "a.gif"], "movie")],
)
def test_what_cannot_be_drawn_is_a_failure(words, drawing, bearing_folder, tmp_path, monkeypatch):
    """One line and the exit code of a failure, not 0."""
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app
    from oilfilm.cases.runs.output_directory import write_digests
    from oilfilm.postprocess.scene import scene as module

    def fails(*_):
        raise module.RenderingError("no picture: the driver of the screen is missing")

    folder = shutil.copytree(bearing_folder, tmp_path / "results")
    write_digests(folder, [])
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(module, drawing, fails)
    result = CliRunner().invoke(app, ["view", str(folder), *words])
    assert result.exit_code == 4, result.output
    assert "no picture: the driver of the screen is missing" in result.output
    assert not list(tmp_path.glob("a.*"))


@pytest.mark.usefixtures("drawing")
def test_every_number_is_kept(scene, contact_folder):
    """Points and colours of all bodies that stand in the scenes of a bearing and of a contact."""
    from oilfilm.postprocess.scene.drawing import build_scene

    found = {}
    single = build_scene(contact_folder, SceneOptions(), off_screen=True, for_page=False)
    for name, one in (("bearing", scene), ("contact", single)):
        for key, actor in sorted(one.plotter.actors.items()):
            mesh = getattr(getattr(actor, "mapper", None), "dataset", None)
            if hasattr(mesh, "points") and not re.search("0x|Addr|axial load|rotation", key):  # others draw those two
                arrays = {kind: np.asarray(values) for kind, values in mesh.point_data.items()}
                found[f"{name} {key}"] = [np.asarray(mesh.points), arrays]
        found[f"{name} texts"] = [one.title, one.note, one.labels, one.spots, one.up, one.colours]
        found[f"{name} camera"] = [list(place) for place in one.plotter.camera_position]
    kept("scene", found, 1e-4)

"""One loader for the folders of every command."""

from __future__ import annotations

import gc
import json
import shutil

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm import postprocess
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.document import read_text
from oilfilm.cases.format.shipped import find_case

CHANGES = {
    "slip": ("hirano_7000C", (("points = 51\n", "points = 3\ncritical_points = 2\n"),)),
    "stiffness": ("7008_back_to_back", ()),
    "dynamics": ("7008_axial", (("end_time_s = ", "end_time_s = 0.0004 # "), ("output_interval_us = ", "# "))),
}


def compute(command, folder):
    """Results of a small case, in the folder `out`."""
    stem, changes = CHANGES[command]
    text = read_text(find_case(stem))
    for old, new in changes:
        text = text.replace(old, new)
    (folder / "case.toml").write_text(text, encoding="utf-8")
    words = [command, str(folder / "case.toml"), "-o", str(folder / "out"), "-q"]
    found = CliRunner().invoke(app, [*words, "--points", "2"] if command == "stiffness" else words)
    assert found.exit_code == 0, found.output
    return folder / "out"


@pytest.fixture(scope="module")
def computed(tmp_path_factory):
    """Function `computed(command, folder)`: a copy of results that are computed once, in a folder."""
    folders = {}

    def copied(command, folder):
        if command not in folders:
            folders[command] = compute(command, tmp_path_factory.mktemp(command))
        shutil.copytree(folders[command], folder / "out")
        return folder / "out"

    return copied


def opened(folder, command):
    """The summary of a folder, and what the loader opens."""
    document = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    tree = postprocess.open_results(folder)
    assert tree.attrs["kind"] == command
    assert tree.attrs["oilfilm"] == document["oilfilm"]
    assert json.loads(tree.attrs["case"]) == document["case"]
    assert json.loads(tree.attrs["messages"]) == document["messages"]
    assert bool(tree.attrs["converged"]) is document["converged"]
    return document, tree


def is_lazy(variable):
    return not isinstance(variable.variable._data, np.ndarray)


def test_slip(tmp_path, computed):
    document, tree = opened(computed("slip", tmp_path), "slip")
    with tree:
        assert is_lazy(tree["slip_factor"])
        least = tree["slip_factor"].min("ball").values
        np.testing.assert_allclose(least, np.array(document["surface"]["slip_factor_minimum"], dtype=float))
        np.testing.assert_allclose(
            tree["speed"].values * 30.0 / np.pi, np.array(document["surface"]["speeds_rpm"], dtype=float)
        )
        curve = document["critical_curves"][1]["axial_loads_N"][2]
        assert tree["ball"].values[2] == curve["ball"]
        found = tree["critical_axial_load"].isel(critical_speed=1, ball=2).values
        np.testing.assert_allclose(found, np.array(curve["values"], dtype=float))
        assert tree["minimum_load_hirano"].attrs["units"] == "N"
    left = postprocess.open_results(tmp_path / "out")["slip_factor"]  # nothing else refers to the file
    gc.collect()
    np.testing.assert_array_equal(left.min("ball").values, least)
    left = postprocess.open_results(tmp_path / "out")
    left.close()  # xarray opens the file again for what is read later
    np.testing.assert_array_equal(left["slip_factor"].min("ball").values, least)
    left.close()


def test_stiffness(tmp_path, computed):
    document, tree = opened(computed("stiffness", tmp_path), "stiffness")
    with tree:
        assert is_lazy(tree["stiffness"])
        place = {"freedom": "ty", "freedom_2": "z"}
        found = tree["stiffness"].sel(place).values
        np.testing.assert_allclose(found, [point["stiffness"][3][2] for point in document["points"]])


@pytest.mark.slow
def test_dynamics(tmp_path, computed):
    _, tree = opened(computed("dynamics", tmp_path), "dynamics")
    with tree:
        assert is_lazy(tree["contact_load"])
        assert tree["contact_load"].dims == ("time", "race", "ball")
    (tmp_path / "out" / "summary.json").write_text("{", encoding="utf-8")  # cut off
    with postprocess.open_results(tmp_path / "out") as tree:
        assert tree.attrs["converged"] == 0
        assert "no readable summary.json" in tree.attrs["messages"]


@pytest.mark.parametrize("command", [pytest.param("slip", marks=pytest.mark.slow), "stiffness"])
def test_folders_of_older_versions_are_told(tmp_path, command, computed):
    opened(computed(command, tmp_path), command)[1].close()
    (tmp_path / "out" / "results.nc").unlink()
    with pytest.raises(ValueError, match=r"no results\.nc: compute it again"):
        postprocess.open_results(tmp_path / "out")


def test_a_newer_history_is_refused(tmp_path):
    import h5netcdf

    with h5netcdf.File(tmp_path / "history.nc", "w") as file:
        file.attrs.update({"oilfilm_history": 99, "oilfilm": "9.0"})
    with pytest.raises(ValueError, match=r"oilfilm 9\.0 in format 99"):
        postprocess.open_results(tmp_path)

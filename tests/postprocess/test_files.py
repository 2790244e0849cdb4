"""Files of a run: complete or absent, read back as written, foreign and damaged ones refused."""

from __future__ import annotations

import csv
import json
import os

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.files import atomic_path
from oilfilm.postprocess import open_results, summary
from oilfilm.postprocess.bearing.write import write_bearing_netcdf, write_contacts_csv
from oilfilm.postprocess.contact.write import write_contact_netcdf
from oilfilm.postprocess.files import write_json

xr = pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def run_folder(bearing_results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    write_bearing_netcdf(bearing_results, folder / "results.nc", summary(bearing_results))
    return folder


def test_fields_come_back(run_folder, bearing_results):
    solution, contact = bearing_results.fields[0], bearing_results.contacts[0]
    with open_results(run_folder) as tree:
        node = tree["contacts/ball01/inner"]
        assert_allclose(node["P"].values, solution.pressure, rtol=1e-6)  # float32
        assert_allclose(node["h"].values, solution.film, rtol=1e-6)
        assert_allclose(node["x"].values, solution.x, rtol=1e-12)
        assert node["h"].attrs["units"] == "m"
        assert_allclose(node.attrs["normal"], contact.normal, atol=1e-15)
        assert_allclose(node["film_minimum"], solution.film_minimum)
        assert_allclose(tree["balls"]["inner_load"].values, bearing_results.quasistatic.inner_load)
        assert_allclose(tree["ring"]["stiffness"].values, bearing_results.quasistatic.stiffness)


def test_every_solved_contact_is_there(run_folder, bearing_results):
    with open_results(run_folder) as tree:
        found = {f"{ball}/{race}" for ball, node in tree["contacts"].children.items() for race in node.children}
    solved = {f"ball{c.ball:02d}/{c.race.value}" for c in bearing_results.contacts if c.conditions is not None}
    assert found == solved


def test_input_and_version_inside(run_folder, bearing_results):
    with open_results(run_folder) as tree:
        assert json.loads(tree.attrs["case"]) == bearing_results.case
        assert tree.attrs["oilfilm"] == bearing_results.version


def test_fields_are_read_when_used(run_folder):
    with open_results(run_folder) as tree:
        data = tree["contacts/ball01/inner"]["h"].variable._data
        assert not isinstance(data, np.ndarray)


def test_moes_input_in_its_own_units(moes_results, tmp_path):
    write_contact_netcdf(moes_results, tmp_path / "results.nc", summary(moes_results))
    with open_results(tmp_path) as tree:
        data = tree["contacts/contact"].to_dataset()
        assert data["h"].attrs["units"] == "a^2/Rx"
        assert_allclose(data["h"].values, moes_results.solution.H, rtol=1e-6)


def test_missing_results_are_refused(tmp_path):
    with pytest.raises(ValueError, match="holds no results"):
        open_results(tmp_path)


@pytest.mark.parametrize("keep", [0, 10, 1000, -100])
def test_damaged_file_is_refused(run_folder, tmp_path, keep):
    content = (run_folder / "results.nc").read_bytes()
    (tmp_path / "results.nc").write_bytes(content[:keep])
    with pytest.raises(ValueError, match="damaged"):
        open_results(tmp_path)


def test_foreign_file_is_refused(tmp_path):
    xr.Dataset({"temperature": ("x", [1.0, 2.0])}).to_netcdf(tmp_path / "results.nc", engine="h5netcdf")
    with pytest.raises(ValueError, match="not one of oilfilm"):
        open_results(tmp_path)


def test_the_first_format_is_read(contact_results, tmp_path):
    """Written before a grid could lie at an angle to the entrainment."""
    from oilfilm.postprocess.scene.patch import Patch

    write_contact_netcdf(contact_results, tmp_path / "new.nc", summary(contact_results))
    with xr.open_datatree(tmp_path / "new.nc", engine="h5netcdf") as tree:
        old = tree.load()
    old.attrs["oilfilm_format"] = 1
    contact = old["contacts/contact"]
    del contact.attrs["frame_angle"]
    contact.attrs["entrainment_angle"] = 0.3
    old.to_netcdf(tmp_path / "results.nc", engine="h5netcdf")
    with open_results(tmp_path) as tree:
        assert tree["contacts/contact"].attrs["frame_angle"] == 0.3
        Patch.read(tree["contacts/contact"].to_dataset())


def test_newer_format_is_refused(tmp_path):
    attrs = {"oilfilm_format": 99, "oilfilm": "9.0"}
    tree = xr.DataTree.from_dict({"/": xr.Dataset(attrs=attrs), "/contacts/contact": xr.Dataset()})
    tree.to_netcdf(tmp_path / "results.nc", engine="h5netcdf")
    with pytest.raises(ValueError, match=r"oilfilm 9\.0 in format 99"):
        open_results(tmp_path)


def test_csv_has_units_and_one_line_a_contact(bearing_results, tmp_path):
    document = summary(bearing_results)
    write_contacts_csv(document, tmp_path / "contacts.csv")
    rows = list(csv.DictReader((tmp_path / "contacts.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 18
    assert float(rows[0]["load [N]"]) == document["contacts"][0]["load_N"]
    assert rows[4]["central film [um]"] == ""


def test_failed_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "summary.json"
    write_json({"value": 1}, path)
    with pytest.raises(ValueError, match="JSON"):
        write_json({"value": float("nan")}, path)
    with pytest.raises(UnicodeEncodeError), atomic_path(path) as temporary:
        temporary.write_text("half \ud800", encoding="utf-8")
    assert json.loads(path.read_text(encoding="utf-8")) == {"value": 1}
    assert os.listdir(tmp_path) == ["summary.json"]

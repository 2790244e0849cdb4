"""Command transient: files, what they hold, faults, interruption and going on."""

from __future__ import annotations

import csv
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from PIL import Image
from typer.testing import CliRunner

from oilfilm.cases import load_case
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shipped import shipped_cases
from oilfilm.cases.runs.transient import run_transient
from oilfilm.postprocess import open_results

from ...kept import drawn, kept

STEMS = [stem for stem, path in shipped_cases().items() if path.parent.name == "transient"]
WAVES = shipped_cases()["waviness_ball_on_disc"].read_text(encoding="utf-8")
COARSE = WAVES.replace("points = 129", "points = 65").replace("[transient]", "[transient]\nframes = 4")


SHOWN = {}  # of the run in `results`


def run(*arguments):
    return CliRunner().invoke(app, ["transient", *map(str, arguments)])


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("transient")
    case = folder / "waves.toml"
    case.write_text(COARSE, encoding="utf-8")
    with drawn(as_well=True) as SHOWN["pictures"]:
        answer = run(case, "-o", folder / "out")
    assert answer.exit_code == 0, answer.output
    assert "of its amplitude in the film" in answer.output
    return folder / "out"


def test_summary(results):
    document = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    assert document["converged"]
    assert document["steps"] == document["planned_steps"] > 100
    (wave,) = document["features"]
    assert wave["kind"] == "waviness"
    assert wave["amplitude_ratio"] == pytest.approx(0.667, abs=0.04)  # of 257 points; here 16 nodes a wave
    assert wave["fitted_amplitude_ratio"] == pytest.approx(1.0 / (1.0 + 0.15 * 3.16 + 0.015 * 10.0), rel=2e-3)
    assert wave["passing_frequency_Hz"] == pytest.approx(0.46227 / 106.9e-6, rel=1e-9)
    assert abs(document["oil_error"]) < 1e-3
    assert 0.01 < document["film_central_mesh_error"] < 0.2
    nulls = [key for key, value in document.items() if value is None]
    assert all(any(key in text for text in document["messages"]) for key in nulls)


def test_series_and_fields(results):
    with (results / "steps.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    with xr.open_dataset(results / "results.nc", engine="h5netcdf") as data:
        assert data.sizes["time"] == len(rows)
        assert data.sizes["frame"] == 4
        assert float(rows[-1]["film_central_um"]) == pytest.approx(1e6 * float(data["film_central"][-1]), rel=1e-6)
        middle = int(np.abs(data["x"].to_numpy()).argmin())
        assert float(data["film_line"][5, middle]) == pytest.approx(float(data["film_central"][5]), rel=1e-6)
        assert float(data["h"][-1, 0, middle]) == pytest.approx(float(data["film_central"][-1]), rel=1e-6)
        assert 0.0 < float(data["filled"].min()) < 0.5  # the cavity behind the contact
        assert data["h"].attrs["units"] == "m"


def test_results_are_opened_with_all_others(results):
    with open_results(results) as tree:
        assert tree.attrs["kind"] == "transient"
        assert tree["film_line"].dims == ("time", "x")


def test_series_for_paraview_and_movie(results):
    from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader

    text = (results / "transient.pvd").read_text(encoding="utf-8")
    files = sorted((results / "transient").iterdir())
    assert [f"transient/{file.name}" in text for file in files] == [True] * 4
    reader = vtkXMLStructuredGridReader()
    reader.SetFileName(str(files[-1]))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfPoints() == 65 * 65
    assert {grid.GetPointData().GetArrayName(k) for k in range(3)} == {
        "film thickness [um]", "pressure [GPa]", "filled share of the gap [-]",
    }  # fmt: skip
    with Image.open(results / "transient.gif") as movie:
        assert movie.n_frames == 4
    assert (results / "plots" / "transient.png").stat().st_size > 20_000


@pytest.mark.parametrize("stem", STEMS)
def test_shipped_cases_have_a_run_and_say_what_is_assumed(stem):
    conditions, options = load_case(stem).transient
    assert conditions.end_time > 0.0
    assert options.points in (65, 129, 257)


FAULTS = {
    "wavelength_um = 106.9": ("", "features.0.wavelength_um: missing"),
    "amplitude_um = 0.011": ("amplitude_um = 0.011\nradius_um = 3.0", "features.0.radius_um: found with kind"),
    "body = 1": ("body = 3", "body"),
    "end_time_ms = 1.8": ("end_time_ms = 1.8\nmass_kg = 0.1", "approach_speed_m_s: missing"),
    "load_N = 18.387": ("load_N = 18.387\nspin_rad_s = 5.0", "contacts over time without spin"),
    'kind = "waviness"': ('kind = "profile"\nfile = "none.txt"', "cannot be read"),
}


@pytest.mark.parametrize("found", FAULTS)
def test_faults_name_their_key(tmp_path, found):
    given, message = FAULTS[found]
    text = WAVES.replace(found, given)
    if "profile" in given:
        text = "\n".join(line for line in text.splitlines() if not line.startswith(("amplitude_um", "wavelength_um")))
    case = tmp_path / "case.toml"
    case.write_text(text, encoding="utf-8")
    answer = run(case, "--json")
    assert answer.exit_code == 2
    assert message in answer.output


def test_a_kind_that_is_a_table_is_told(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(WAVES.replace('kind = "waviness"', "kind = { a = 1 }"), encoding="utf-8")
    answer = run(case, "--json")
    assert answer.exit_code == 2
    assert "features.0.kind" in answer.output


def test_a_case_without_a_course_is_refused(tmp_path):
    answer = run("ball_on_disc", "--json")
    assert answer.exit_code == 2
    assert "has no table [transient]" in answer.output
    assert run("6208_life", "--json").exit_code == 2


def test_a_mesh_without_a_film_at_the_start_is_told(tmp_path):
    text = WAVES.replace("load_N = 18.387", "load_N = 2000.0").replace("points = 129", "points = 33")
    case = tmp_path / "case.toml"
    case.write_text(text, encoding="utf-8")
    answer = run(case, "--json")
    assert answer.exit_code == 1
    assert "steady film at the start" in answer.output


def test_a_measured_profile(tmp_path, monkeypatch):
    """A file of x and height, and one of a grid, in um: the film feels both alike."""
    x = np.linspace(0.0, 200.0, 41)
    z = 0.01 * np.sin(np.pi * x / 200.0) ** 2
    monkeypatch.chdir(tmp_path)
    np.savetxt("line.txt", np.stack([x, z], axis=1))
    y = np.array([-400.0, 0.0, 400.0])
    grid = [(a, b, c) for a, c in zip(x, z, strict=True) for b in y]
    np.savetxt("map.csv", grid, delimiter=",", header="x y z")
    head = COARSE.partition("[[features]]")[0].replace("end_time_ms = 1.8", "end_time_ms = 0.5")
    films = []
    for name in ("line.txt", "map.csv"):
        feature = f'[[features]]\nkind = "profile"\nbody = 2\nfile = "{name}"\nstart_um = -100.0\n'
        Path("case.toml").write_text(head + feature, encoding="utf-8")
        case = load_case("case.toml")
        found = run_transient(case, "case")
        films.append(found.solution.series("film_central"))
    assert np.ptp(films[0]) > 0.02 * films[0][0]
    assert np.allclose(*films, rtol=5e-4)
    Path("map.csv").write_text("1,2,3\n1,2,4\n", encoding="utf-8")
    with pytest.raises(CaseError, match="are no grid"):
        load_case("case.toml")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupted_run_keeps_its_steps_and_goes_on(tmp_path, results):
    case = tmp_path / "waves.toml"
    case.write_text(COARSE, encoding="utf-8")
    code = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    code += "from oilfilm.cases.runs import transient; transient.EVERY = 0.0\n"
    code += "from oilfilm.cases.cli.start import main; main()"
    command = [sys.executable, "-c", code, "transient", str(case), "-o", str(tmp_path / "out"), "--no-movie"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, cwd=tmp_path) as process:
        deadline = time.monotonic() + 120.0
        while not (tmp_path / "out_steps" / "state.npz").exists():
            assert time.monotonic() < deadline
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        errors = process.communicate(timeout=60)[1].decode()
    assert process.returncode == 3, errors
    assert "the same command goes on with them" in errors
    answer = run(case, "-o", tmp_path / "out", "--no-movie", "-q")
    assert answer.exit_code == 0
    document = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert document["resumed_at_step"] > 0
    assert not (tmp_path / "out_steps").exists()
    whole = (results / "steps.csv").read_text(encoding="utf-8")
    assert (tmp_path / "out" / "steps.csv").read_text(encoding="utf-8") == whole


def test_every_number_is_kept(results):
    files = {path.name: path for path in results.iterdir() if path.suffix in (".json", ".nc", ".csv")}
    kept("transient", files | SHOWN, 1e-4)

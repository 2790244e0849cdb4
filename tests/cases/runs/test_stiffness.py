"""Command stiffness: matrices over speed, the table for the rotor code, errors."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.bearing import solve_quasistatic
from oilfilm.cases import load_case
from oilfilm.cases.cli.main import app

from ...kept import drawn, kept

CASE = "7008_back_to_back"


def run(*arguments):
    return CliRunner().invoke(app, ["stiffness", *arguments])


SHOWN = {}  # of the run in `folder`


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stiffness")
    with drawn(as_well=True) as SHOWN["pictures"]:
        found = run(CASE, "-o", str(folder / "out"), "--points", "3", "--damping", "300", "--quiet")
    assert found.exit_code == 0
    return folder / "out"


def test_matrices_are_those_of_the_equilibrium(folder):
    document = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    case = load_case(CASE)
    state = solve_quasistatic(case.bearing, case.operation, case.model, rows=case.rows)
    last = document["points"][-1]
    assert last["speed_rpm"] == pytest.approx(12000.0)
    matrix = np.array(last["stiffness"])
    assert np.abs(matrix - state.stiffness).max() < 1e-6 * np.abs(state.stiffness).max()
    assert document["units"][0][4] == "N/rad"
    assert document["units"][3][1] == "N m/m"
    assert document["units"][4][4] == "N m/rad"


def test_the_table_for_the_rotor_code(folder):
    with (folder / "ross_bearing.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    with (folder / "stiffness.csv").open(encoding="utf-8") as file:
        full = list(csv.DictReader(file))
    assert list(rows[0]) == ["speed", "kxx", "kxy", "kyx", "kyy", "kzz", "cxx", "cxy", "cyx", "cyy", "czz"]
    assert float(rows[-1]["speed"]) == pytest.approx(12000.0 * np.pi / 30.0)
    assert float(rows[1]["kxx"]) == float(full[1]["k z z [N/m]"])
    assert float(rows[1]["kzz"]) == float(full[1]["k x x [N/m]"])
    assert {row["cyy"] for row in rows} == {"300.0"}


def test_the_table_in_the_terminal_fits(tmp_path):
    found = run(CASE, "-o", str(tmp_path / "out"), "--points", "2", "--speeds", "0", "60000")
    assert found.exit_code == 0
    assert max(len(line.rstrip()) for line in found.stdout.splitlines()) <= 80
    assert "60000" in found.stdout


def test_speeds_without_equilibrium_are_flagged(tmp_path):
    """A thrust that lifts the balls out of the groove: results written, values null, exit code 1."""
    text = 'schema_version = 1\n[bearing]\nname = "6208"\n[lubricant]\nviscosity_mPa_s = 26.0\n'
    text += "pressure_viscosity_1_GPa = 18.0\n[operation]\naxial_load_N = 3e6\n"
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    found = run(str(tmp_path / "case.toml"), "-o", str(tmp_path / "out"), "--points", "2", "--speeds", "0", "100")
    assert found.exit_code == 1
    document = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert document["points"][0]["stiffness"][0][0] is None
    assert any("not converged at 100 r/min" in message for message in document["messages"])


def test_bad_input_is_told():
    assert run("209_radial_8900N", "--json").exit_code == 2  # at rest, and no speeds are given
    assert run("moes_20_10", "--json").exit_code == 2


def test_the_lines_for_the_rotor_code_have_the_damping_of_the_films(tmp_path):
    arguments = (CASE, "-o", str(tmp_path / "out"), "--points", "2", "--speeds", "6000", "12000", "--ross")
    found = run(*arguments)
    assert found.exit_code == 0, found.output
    assert "rs.BearingElement(" in found.stdout
    document = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    table = document["ross"]
    assert all(10.0 < c < 1e4 for c in table["cxx"])  # one ball under 100 N and 5 m/s has some 50 N s/m
    assert table["cxx"][1] < table["cxx"][0]  # film over speed falls
    assert any("damping by the films" in message for message in document["messages"])


def test_every_number_is_kept(folder):
    kept("stiffness", {"files": folder, **SHOWN}, floor=1e-6)

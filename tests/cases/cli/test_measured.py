"""Measured tables beside computed ones, in the terminal, in a run, over speed and time; the fit of keys."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs import measured
from oilfilm.cases.runs.bearing import Interrupted, run_case
from oilfilm.cases.runs.heating import self_heated
from oilfilm.cases.runs.measured import compare_temperatures, text_with

CASE = """\
schema_version = 1
title = "test rig"
[bearing]
name = "6306"
[lubricant]
kinematic_viscosity_40C_mm2_s = 120.0
kinematic_viscosity_100C_mm2_s = 12.0
pressure_viscosity_1_GPa = 18.0  # estimated, 14 to 23
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 1500.0
temperature_C = 80.0
[ehl]
film_maps = "none"
"""
TABLE = "speed [1/min];radial load [kN];temperature [°C];torque [Nmm]\n{}"


def invoke(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """A case, a table of its own torques with 5 % on top, and what compare gives."""
    folder = tmp_path_factory.mktemp("rig")
    case, table = folder / "rig.toml", folder / "rig.csv"
    case.write_text(CASE)
    states = ["500;1,5;60;", "2000;1,5;70;", "4000;1,5;80;"]
    table.write_text(TABLE.format("".join(f"{state}50,0\n" for state in states)), encoding="utf-8")
    first = invoke("compare", case, table, "--json", "--quiet")
    assert first.exit_code == 0, first.output
    torque = [row["torque_N_mm"]["computed"] for row in json.loads(first.stdout)["rows"]]
    rows = (f"{state}{1.05 * m:.4f}".replace(".", ",") for state, m in zip(states, torque, strict=True))
    table.write_text(TABLE.format("\n".join(rows) + "\n"), encoding="utf-8")
    return case, table, torque


def test_residuals_of_a_case(rig, tmp_path):
    case, table, torque = rig
    picture = tmp_path / "a.png"
    found = invoke("compare", case, table, "--json", "-o", picture)
    document = json.loads(found.stdout)
    assert found.exit_code == 0
    assert document["residuals"]["torque_N_mm"]["ratio"] == pytest.approx(1.0 / 1.05, rel=1e-4)
    assert document["residuals"]["torque_N_mm"]["mean"] == pytest.approx(-0.05 * np.mean(torque), rel=1e-3)
    assert document["rows"][1]["temperature_C"] == pytest.approx(70.0)
    assert picture.stat().st_size > 5000
    assert invoke("compare", case, table, "--quiet", "--within", "0.01").exit_code == 1
    printed = invoke("compare", case, table).stdout
    assert "computed less measured" in printed


def test_a_run_has_the_table_that_its_case_names(rig, tmp_path):
    _, table, _ = rig
    named = tmp_path / "named.toml"
    named.write_text(f"measured = '{table}'\n{CASE}")
    found = invoke("run", named, "--json", "--quiet", "-o", tmp_path / "out")
    assert found.exit_code == 0, found.output
    assert json.loads(found.stdout)["measured"]["residuals"]["torque_N_mm"]["points"] == 3
    assert (tmp_path / "out" / "plots" / "measured.png").is_file()
    again = invoke("compare", tmp_path / "out", table, "--json", "--quiet")
    assert json.loads(again.stdout)["residuals"]["torque_N_mm"]["ratio"] == pytest.approx(1.0 / 1.05, rel=1e-3)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("1;2\n3;4\n", "no header"),
        ("speed [rpm];load [N]\n1;2\n3;4\n", "nothing measured"),
        ("speed [rpm];torque [um]\n1;2\n3;4\n", "the unit is none of torque_N_mm"),
        ("speed [rpm];torque [N mm]\n1;2\n;4\n", "line 3: no inner_speed_rpm"),
        ("speed [rpm];torque [N mm]\n1;2\nx;4\n", "line 3, column 1"),
    ],
)
def test_faults_of_a_table(rig, tmp_path, content, expected):
    table = tmp_path / "bad.csv"
    table.write_text(content)
    found = invoke("compare", rig[0], table, "--quiet")
    assert found.exit_code == 2
    assert expected in found.output


def test_a_table_that_is_not_there_is_named(rig, tmp_path):
    found = invoke("compare", rig[0], tmp_path / "none.csv")
    assert found.exit_code == 2
    assert "none.csv: no such file; allowed: a measured table" in " ".join(found.output.split())


def test_temperatures_of_parts_are_none_of_the_oil(tmp_path):
    table = tmp_path / "parts.csv"
    table.write_text("speed [rpm];outer ring temp [C];oil temp [C];torque [N cm]\n500;50;40;1\n600;51;41;2\n")
    found = measured.read_measured(table)
    assert found["temperature_C"].tolist() == pytest.approx([40.0, 41.0])
    assert found["outer_ring_C"].tolist() == pytest.approx([50.0, 51.0])
    assert found["torque_N_mm"].tolist() == pytest.approx([10.0, 20.0])
    assert measured.read_measured(table, of_parts=True)["oil_C"].tolist() == pytest.approx([40.0, 41.0])


def test_temperatures_over_time_and_speed(tmp_path):
    course = [{"time_s": t, "film_temperature_C": 20.0 + t, "housing_temperature_C": 20.0} for t in (0.0, 100.0)]
    balances = [{"speed_rpm": n, "film_temperature_C": n / 100.0, "torque_N_mm": 10.0} for n in (1000.0, 3000.0)]
    document = {"balances": balances, "warm_up": {"course": course}}
    table = tmp_path / "warm.csv"
    table.write_text("time [min],temperature [C],housing temperature [C]\n0.5,55,21\n1,75,22\n9,99,23\n")
    found = compare_temperatures(document, "results", table)
    assert found.computed["temperature_C"][:2] == pytest.approx([50.0, 80.0])
    assert np.isnan(found.computed["temperature_C"][2])
    assert found.computed["housing_C"][0] == pytest.approx(20.0)
    assert not found.converged
    table.write_text("speed [rpm],torque [N mm]\n2000,12\n")
    assert compare_temperatures(document, "results", table).residuals()["torque_N_mm"]["mean"] == pytest.approx(-2.0)
    table.write_text("load [N],torque [N mm]\n2000,12\n")
    with pytest.raises(CaseError, match="no column of time or speed"):
        compare_temperatures(document, "results", table)


def test_a_batch_beside_a_table(tmp_path, monkeypatch):
    """Torque of a batch over speed and load, linear between its points; what it varies has to be measured."""
    path = tmp_path / "torque.csv"
    path.write_text("speed [rpm],radial load [N],torque [N mm]\n1500,1000,30\n3000,1500,70\n9000,1000,80\n")
    folder = tmp_path / "batch"
    folder.mkdir()

    def batch(*keys):
        points = [
            SimpleNamespace(
                converged=True,
                values=dict(zip(keys, pair, strict=True)),
                summary={"contacts": [], "torque_N_mm": {"total": pair[0] / 100.0 + pair[1] / 50.0}},
            )
            for pair in ((1000, 1000), (1000, 2000), (4000, 1000), (4000, 2000))
        ]
        return SimpleNamespace(keys=keys, points=points)

    monkeypatch.setattr(measured, "read_summary", lambda _: {"kind": "batch"})
    speeds = "operation.inner_speed_rpm"
    monkeypatch.setattr(measured, "read_batch", lambda _: batch(speeds, "operation.radial_load_N"))
    found = measured.compare_with(folder, path)
    assert found.computed["torque_N_mm"][:2] == pytest.approx([35.0, 60.0])
    assert np.isnan(found.computed["torque_N_mm"][2])
    monkeypatch.setattr(measured, "read_batch", lambda _: batch(speeds, "bearing.balls"))
    with pytest.raises(CaseError, match=r"varies bearing\.balls, of which .* has no column"):
        measured.compare_with(folder, path)


def test_a_fit_meets_the_points_within_the_interval(rig, tmp_path):
    case, table, _ = rig
    fitted = tmp_path / "fitted.toml"
    key = "lubricant.pressure_viscosity_1_GPa"
    found = invoke("calibrate", case, table, "--keys", key, "--json", "--quiet", "-o", fitted)
    assert found.exit_code == 0, found.output
    document = json.loads(found.stdout)
    (one,) = document["keys"]
    assert (one["low"], one["high"], one["interval"]) == (14.0, 23.0, "by the comment in the case")
    assert one["low"] <= one["value"] <= one["high"]
    assert document["relative_error"] < document["relative_error_before"]
    assert document["messages"][1].startswith("a fit: ")
    assert f"pressure_viscosity_1_GPa = {one['value']!r}  # fitted" in fitted.read_text()
    assert invoke("validate", fitted).exit_code == 0


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ("lubricant.name", "no number of this case"),
        ("lubricant.pressure_viscosity_1_GPa=5:3", "is empty"),
        ("lubricant.pressure_viscosity_1_GPa=a", "KEY=LOW:HIGH"),
    ],
)
def test_keys_that_cannot_be_fitted(rig, keys, expected):
    found = invoke("calibrate", rig[0], rig[1], "--keys", keys, "--quiet")
    assert found.exit_code == 2
    assert expected in found.output


def test_values_in_the_text_of_a_case():
    changed = text_with(
        CASE, {"lubricant.pressure_viscosity_1_GPa": 20.5, "friction.hysteresis_loss": 0.01}, (0.2, None)
    )
    assert "pressure_viscosity_1_GPa = 20.5  # fitted, standard deviation 0.2\n" in changed
    assert changed.endswith("\n[friction]\nhysteresis_loss = 0.01  # fitted\n")


WARM = CASE.replace("temperature_C = 80.0", 'temperature_C = 60.0\ntemperature = "self-heated"') + (
    "[friction]\nheat_transfer_W_K = 1.2\nambient_C = 25.0\n"
)


@pytest.mark.parametrize("expected", [None, 200.0, 318.0, 330.0, 500.0])
def test_a_balance_is_found_about_the_one_expected(expected):
    """The same as that of the search from ambient, also from far away, in fewer states."""
    case = measured.case_from_text(WARM, "warm.toml")
    near = replace(case, heating=replace(case.heating, expected=expected))
    found = self_heated(near, judged=False).balance
    whole = self_heated(case, judged=False).balance
    assert found.temperature == pytest.approx(whole.temperature, abs=2e-3)
    if expected in (318.0, 330.0):
        assert found.evaluations < whole.evaluations


def test_an_interrupted_fit_leaves_the_best_so_far(rig, tmp_path, monkeypatch):
    case, table, _ = rig
    fitted = tmp_path / "best.toml"
    left = iter(range(3 * 3))  # runs of the model: as it is, at the start and once beside it

    def stopped(*arguments, **words):
        if next(left, None) is None:
            raise Interrupted(None)
        return run_case(*arguments, **words)

    monkeypatch.setattr(measured, "run_case", stopped)
    key = "lubricant.pressure_viscosity_1_GPa"
    found = invoke("calibrate", case, table, "--keys", key, "--json", "-o", fitted)
    assert found.exit_code == 3
    document = json.loads(found.stdout)
    assert any(message.startswith("interrupted: the best") for message in document["messages"])
    assert document["relative_error"] <= document["relative_error_before"]
    assert "# fitted" in fitted.read_text()

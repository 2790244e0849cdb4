"""`oilfilm shaft`: the shipped shaft, its bearings, and faults told at their lines."""

from __future__ import annotations

import json

import pytest

from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.format.shipped import shipped_cases
from oilfilm.cases.runs.shaft import run_shaft
from oilfilm.postprocess.shaft.results import shaft_summary
from oilfilm.postprocess.shaft.write import write_shaft

TEXT = shipped_cases()["spindle_two_bearings"].read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def results():
    return run_shaft(load_shaft("spindle_two_bearings"))


def test_the_summary_has_shaft_bearings_and_critical_speeds(results):
    document = json.loads(json.dumps(shaft_summary(results), allow_nan=False))
    assert document["converged"], document["messages"]
    assert [support["bearing"] for support in document["supports"]] == ["6207 CN", "6206 CN"]
    assert document["supports"][0]["force_N"][1] == pytest.approx(-1143.0, abs=1.0)
    assert len(document["shaft"]["x_mm"]) == len(document["shaft"]["deflection_um"])
    assert document["critical_speeds_rpm"] == sorted(document["critical_speeds_rpm"])
    lives = [bearing["life"]["basic_reference_rating_h"] for bearing in document["bearings"]]
    assert 0.5 * min(lives) < document["system"]["basic_reference_rating_h"] < min(lives)


def test_each_bearing_has_the_loads_that_the_shaft_puts_on_it(results):
    for state, bearing in zip(results.solution.bearings, results.bearings, strict=True):
        assert bearing.elastic.inner_load == pytest.approx(state.inner_load, rel=1e-6, abs=1e-6)
        assert bearing.quasistatic.ring_force[1:] == pytest.approx(state.ring_force[1:], rel=1e-6, abs=1e-3)
        assert bearing.torque.total > 0.0


def test_files_and_pictures_are_written(results, tmp_path):
    assert write_shaft(results, tmp_path) == ()
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"summary.json", "shaft.csv", "campbell.csv", "results.nc", "shaft.png", "campbell.png"}


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("at_mm = 268.0", "at_mm = 468.0", "support.1.at_mm: found 468.0; allowed: on the shaft, up to 280 mm"),
        ("to_mm = 70.0", "to_mm = 30.0", "shaft.section.1.to_mm: found 30.0; allowed: more than 40 mm"),
        ('fixed = "both"', 'fixed = "none"', "no support holds the shaft along x"),
        ('"6207 CN"', '"6297 CN"', "support.0.bearing: unknown bearing"),
        ("force_N", "forces_N", "did you mean 'force_N'?"),
        ('fixed = "both"', "preload_N = 100.0", "support.0.loaded_by: missing"),
    ],
)
def test_a_fault_is_told_at_its_key(tmp_path, before, after, message):
    path = tmp_path / "shaft.toml"
    path.write_text(TEXT.replace(before, after), encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        load_shaft(path)
    assert message in str(caught.value)
    assert f"{path}:" in str(caught.value)


def test_a_shaft_is_not_run_as_a_bearing_nor_a_bearing_as_a_shaft():
    from typer.testing import CliRunner

    runner = CliRunner()
    run = runner.invoke(app, ["run", "spindle_two_bearings"])
    assert (run.exit_code, "oilfilm shaft" in run.output + run.stderr) == (2, True)
    shaft = runner.invoke(app, ["shaft", "6208_full_ceramic"])
    assert (shaft.exit_code, "oilfilm run" in shaft.output + shaft.stderr) == (2, True)
    assert runner.invoke(app, ["validate", "spindle_two_bearings"]).exit_code == 0

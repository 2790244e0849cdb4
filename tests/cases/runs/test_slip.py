"""`oilfilm slip`: its files, summary, exit codes; the physics is tested in tests/bearing/studies/test_slip.py."""

from __future__ import annotations

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from oilfilm.cases import load_case, run_case
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.document import read_text
from oilfilm.cases.format.shipped import find_case
from oilfilm.postprocess import summary

FEW = "points = 3\ncritical_points = 2\n"
PLOTS = ("slip_factors.png", "critical_loads.png", "minimum_preload.png", "slip_per_ball.png")


@pytest.fixture
def case(tmp_path):
    """Write a shipped case with few points, changed by pairs of text."""

    def write(*changes, stem="hirano_7000C"):
        text = read_text(find_case(stem)).replace("points = 51\n", FEW)
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "few.toml"
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


def call(*arguments):
    return CliRunner().invoke(app, ["slip", *arguments])


def test_files_and_summary(case, tmp_path):
    result = call(case(), "-o", str(tmp_path / "out"), "--json", "--workers", "1")
    assert result.exit_code == 0
    summary = json.loads(result.stdout)
    assert summary["converged"] and summary["limit"] == 10.0
    preload = dict(zip(summary["minimum_preload"]["speeds_rpm"], summary["minimum_preload"]["hirano_N"], strict=True))
    assert preload[20000.0] == pytest.approx(214.5, rel=1e-3)
    assert summary["minimum_preload"]["as_printed_N"][0] == pytest.approx(107.0, rel=2e-3)
    assert summary["minimum_preload"]["skf_axial_N"][0] == pytest.approx(0.154 * 20.0**2)
    assert np.shape(summary["surface"]["slip_factor_minimum"]) == (3, 3)
    assert [curve["speed_rpm"] for curve in summary["critical_curves"]] == pytest.approx([24000.0, 40000.0])
    assert all(ball["slips"] == (ball["slip_factor"] < 10.0) for ball in summary["operation"]["balls"])
    assert all((tmp_path / "out" / name).stat().st_size > 10_000 for name in PLOTS)
    assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8")) == summary
    with (tmp_path / "out" / "slip_factors.csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert len(rows) == 10 and len(rows[0]) == 13
    assert float(rows[1][2]) == pytest.approx(summary["surface"]["slip_factor_minimum"][0][0], rel=1e-8)


def test_processes_change_nothing(case):
    changes = (("critical_speeds_rpm = [24000.0, 40000.0]\n", ""),)
    one, two = (json.loads(call(case(*changes), "--json", "--workers", n).stdout) for n in ("1", "2"))
    for key in ("surface", "minimum_preload", "operation"):
        assert one[key] == two[key]


def test_left_out_factors_are_null_with_a_reason(case):
    result = call(case(stem="hirano_7000C_tilt_300N"), "--json", "--workers", "1")
    summary = json.loads(result.stdout)
    assert summary["minimum_preload"]["as_printed_N"] is None
    assert any("as_printed" in message for message in summary["messages"])
    assert any("a fourth to a fifth" in message for message in summary["messages"])
    assert summary["critical_curves"] == []


def test_table(case):
    result = call(case(), "--workers", "1", "-o", "out_of_table")
    assert result.exit_code == 0
    assert "873.6" in result.stdout and "slips" in result.stdout


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_no_equilibrium_is_flagged(case):
    """100 kN tear the balls out of the grooves: exit code 1, null in the summary."""
    result = call(case(("axial_loads_N = [50.0, 600.0]", "axial_loads_N = [50.0, 1e5]")), "--json", "--workers", "1")
    assert result.exit_code == 1
    summary = json.loads(result.stdout)
    assert not summary["converged"]
    assert summary["surface"]["slip_factor_minimum"][0][2] is None
    assert any("3 of 9 points" in message or "6 of 9 points" in message for message in summary["messages"])


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ("speeds_rpm = [20000.0, 70000.0]", "speeds_rpm = [0.0, 70000.0]", "slip.speeds_rpm"),
        ("axial_loads_N = [50.0, 600.0]", "axial_loads_N = [600.0, 50.0]", "slip.axial_loads_N"),
        ('as_printed = "half', 'as_printed = "hlf', "slip.as_printed"),
        ("axial_load_N = 500.0", 'displacement_um = [20.0, "free", "free"]', "axial load"),
    ],
)
def test_bad_input(case, old, new, word):
    result = call(case((old, new)), "--json")
    assert result.exit_code == 2
    assert word in result.output


def test_a_case_without_slip_is_refused():
    result = call("218_axial_22250N", "--json")
    assert result.exit_code == 2
    assert "[slip]" in result.output


@pytest.mark.parametrize(
    ("axial", "warned", "noted"), [(40.0, True, False), (250.0, False, True), (600.0, False, False)]
)
def test_gross_slip_is_a_warning_where_simulations_slip(axial, warned, noted):
    """7008 at 5000 r/min under thrust: Hirano's ratio of 10 needs some 360 N, simulations slip at a quarter of it."""
    case = load_case("7008_axial")
    found = summary(run_case(replace(case, operation=replace(case.operation, force=(axial, 0.0, 0.0)))))
    assert any("all balls slip grossly" in message for message in found["warnings"]) is warned
    cautious = [message for message in found["messages"] if "a fourth to a fifth" in message]
    assert bool(cautious) is noted
    assert not set(cautious) & set(found["warnings"])


@pytest.mark.parametrize(("force", "told"), [((0.0, 500.0, 0.0), True), ((300.0, 100.0, 0.0), False)])
def test_balls_on_the_open_side_of_angular_contact_are_a_warning(force, told):
    """A 7008 without thrust rolls at the bottom of its grooves; a tandem pushed the other way on its open sides."""
    case = load_case("7008_axial").with_values({"ehl.film_maps": "none"})
    found = summary(run_case(replace(case, operation=replace(case.operation, force=force))))
    assert any("open (contact angles down to" in message for message in found["warnings"]) is told
    tandem = [{"axial_position_mm": x, "loaded_by": "+x" if told else "-x"} for x in (-8.0, 8.0)]
    rows = case.with_values({"rows": tandem})
    found = summary(run_case(replace(rows, operation=replace(rows.operation, force=(-300.0, 100.0, 0.0)))))
    assert any("open (contact angles down to -" in message for message in found["warnings"]) is told

"""Torque points of a batch: balls in traction equilibrium where tables or a law are there, as `run` has it."""

from __future__ import annotations

import pytest

from bearing.operation import BallKinematics
from cases import load_case, run_case
from cases.batch import run_batch
from cases.batch.compute import torque_by_tables
from cases.batch.results import gathered
from cases.batch.sweep import sweep_from_text
from cases.batch.tables import _without_films, case_of_document, ready_tables
from cases.shipped import find_case
from postprocess import summary

from .test_batch import HerePool
from .test_batch_kinds import shared

__all__ = ["shared"]  # the fixture with tables of solved films

SWEEP = 'case = "case.toml"\ncompute = "torque"\n[sweep]\n"operation.radial_load_N" = [2000.0, 3000.0]\n'
LAW = 'traction = "four constants"\ntraction_maximum = 0.05\ntraction_maximum_slide = 0.03\ntraction_limit = 0.03\n'


def case_text(friction="", kinematics=None):
    """The shipped 6208 with no ball kinematics, or others, and more in [friction]."""
    text = find_case("6208_five_terms").read_text(encoding="utf-8")
    given = next(line for line in text.splitlines() if line.startswith("ball_kinematics"))
    text = text.replace(given, "" if kinematics is None else f'ball_kinematics = "{kinematics}"')
    return text.replace("[friction]\n", f"[friction]\n{friction}")


def sweep_of(tmp_path, text):
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    return sweep_from_text(SWEEP, "sweep.toml", tmp_path)


def without_times(document):
    return {key: value for key, value in document.items() if key not in ("timing_s", "case", "messages")}


def test_traction_equilibrium_is_the_default_with_tables(tmp_path):
    """Told in the point's case, so that it has another name than a hypothesis, which stays where it is given."""
    default = sweep_of(tmp_path, case_text()).points
    assert [point.resolved["model"]["ball_kinematics"] for point in default] == ["traction equilibrium"] * 2
    assert all(point.tables for point in default)
    given = sweep_of(tmp_path, case_text(kinematics="half and half")).points
    assert [point.resolved["model"]["ball_kinematics"] for point in given] == ["half and half"] * 2
    assert default[0].key != given[0].key
    films = SWEEP.replace('"torque"', '"run"')
    (point, _) = sweep_from_text(films, "sweep.toml", tmp_path).points
    assert point.resolved["model"]["ball_kinematics"] == "half and half"


def test_no_film_is_solved_for_the_loads_of_shared_tables(tmp_path):
    case = case_of_document(sweep_of(tmp_path, case_text()).points[0].document)
    assert case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
    plain = _without_films(case.model)
    assert plain.ball_kinematics is BallKinematics.HALF_AND_HALF
    assert plain.traction is None
    law = case_of_document(sweep_of(tmp_path, case_text(LAW)).points[0].document)
    assert _without_films(law.model) is law.model


@pytest.mark.parametrize("kinematics", [None, "outer race control"])
def test_a_law_of_the_case_itself_is_taken_as_by_run(tmp_path, kinematics):
    """No tables are made for it; the summary is that of `run` without films."""
    text = case_text(LAW, kinematics).replace('film_maps = "all"', 'film_maps = "none"')
    sweep = sweep_of(tmp_path, text)
    assert [point.tables for point in sweep.points] == [None, None]
    results = gathered(run_batch(sweep, tmp_path / "out", HerePool))
    found = results.points[1].summary
    assert found["converged"]
    assert without_times(found) == without_times(summary(run_case(load_case(tmp_path / "case.toml"))))
    assert found["torque_N_mm"]["power_balance"]["hypothesis"] == (kinematics or "traction equilibrium")


@pytest.mark.slow
def test_a_point_from_tables_is_the_run_of_the_case_with_them(shared, tmp_path):
    """To the last bit, and its power balance closes."""
    _, file, _ = shared
    (tmp_path / "ready.zip").write_bytes(file.read_bytes())
    (tmp_path / "case.toml").write_text(case_text(), encoding="utf-8")
    text = SWEEP.replace("[sweep]", 'table = "ready.zip"\n[sweep]')
    results = gathered(run_batch(sweep_from_text(text, "sweep.toml", tmp_path), tmp_path / "out", HerePool))
    found = results.points[1].summary
    named = case_text(f'traction = "table"\ntraction_table = "{file}"\n')
    path = tmp_path / "named.toml"
    path.write_text(named.replace('film_maps = "all"', 'film_maps = "none"'), encoding="utf-8")
    assert found["converged"], found["messages"]
    assert without_times(found) == without_times(summary(run_case(load_case(path))))
    balance = found["torque_N_mm"]["power_balance"]
    assert balance["hypothesis"] == "traction equilibrium"
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert balance["hypothesis_imbalance"] == pytest.approx(0.0, abs=1e-6)
    (tmp_path / "half.toml").write_text(case_text(kinematics="half and half"), encoding="utf-8")
    half, _ = torque_by_tables(load_case(tmp_path / "half.toml"), ready_tables(str(tmp_path / "ready.zip")))
    assert half.quasistatic.model.ball_kinematics is BallKinematics.HALF_AND_HALF
    assert found["balls"] != summary(half)["balls"]

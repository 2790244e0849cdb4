"""Torque points of a batch: balls in traction equilibrium where tables or a law are there, as `run` has it."""

from __future__ import annotations

import pytest

from oilfilm.bearing import Race
from oilfilm.bearing.operation import BallKinematics
from oilfilm.cases import CaseError, load_case, run_case
from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results
from oilfilm.cases.batch.shared_tables import _without_films, shared_tables
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.format.shipped import find_case
from oilfilm.postprocess import summary

from .test_batch import HerePool

SWEEP = 'case = "case.toml"\ncompute = "torque"\n[sweep]\n"operation.radial_load_N" = [2000.0, 3000.0]\n'
TABLES = "table_points = 257"
LAW = 'traction = "four constants"\ntraction_maximum = 0.05\ntraction_maximum_slide = 0.03\ntraction_limit = 0.03\n'


def case_text(friction="", kinematics=None):
    """The shipped 6208 with no ball kinematics, or others, and more in [friction]."""
    text = find_case("6208_five_terms").read_text(encoding="utf-8")
    given = next(line for line in text.splitlines() if line.startswith("ball_kinematics"))
    text = text.replace(given, "" if kinematics is None else f'ball_kinematics = "{kinematics}"')
    return text.replace("[friction]\n", f"[friction]\n{friction}")


def sweep_of(tmp_path, text, more=""):
    """Two loads of a case, with more lines at the top of the sweep."""
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    return sweep_from_text(SWEEP.replace("[sweep]", f"{more}\n[sweep]"), "sweep.toml", tmp_path)


def without_times(document):
    return {key: value for key, value in document.items() if key not in ("timing_s", "case", "messages")}


def test_torque_is_that_of_a_run_without_film_maps(tmp_path):
    """No tables are built for it; balls stay under the hypothesis of the case."""
    sweep = sweep_of(tmp_path, case_text())
    assert [point.tables for point in sweep.points] == [None, None]
    results = load_results(run_batch(sweep, tmp_path / "out", HerePool))
    path = tmp_path / "plain.toml"
    path.write_text(case_text().replace('film_maps = "all"', 'film_maps = "none"'), encoding="utf-8")
    assert without_times(results.points[1].summary) == without_times(summary(run_case(load_case(path))))


@pytest.mark.parametrize("asked", ["", 'table_films = "atlas"\n'])
def test_tables_are_shared_where_they_are_asked_for(asked, tmp_path):
    sweep = sweep_of(tmp_path, case_text(asked), "" if asked else "table_points = 257")
    assert len({point.tables for point in sweep.points} - {None}) == 1
    balanced = sweep_of(tmp_path, case_text(kinematics="traction equilibrium"))
    assert all(point.tables for point in balanced.points)


def test_traction_equilibrium_is_the_default_with_tables(tmp_path):
    """Told in the point's case, so that it has another name than a hypothesis, which stays where it is given."""
    default = sweep_of(tmp_path, case_text(), TABLES).points
    assert [point.resolved["model"]["ball_kinematics"] for point in default] == ["traction equilibrium"] * 2
    assert all(point.tables for point in default)
    given = sweep_of(tmp_path, case_text(kinematics="half and half"), TABLES).points
    assert [point.resolved["model"]["ball_kinematics"] for point in given] == ["half and half"] * 2
    assert default[0].key != given[0].key
    films = SWEEP.replace('"torque"', '"run"')
    (point, _) = sweep_from_text(films, "sweep.toml", tmp_path).points
    assert point.resolved["model"]["ball_kinematics"] == "half and half"


def test_no_film_is_solved_for_the_loads_of_shared_tables(tmp_path):
    case = case_of_document(sweep_of(tmp_path, case_text(), TABLES).points[0].document)
    assert case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
    plain = _without_films(case)
    assert plain.model.ball_kinematics is BallKinematics.HALF_AND_HALF
    assert plain.traction is None
    law = case_of_document(sweep_of(tmp_path, case_text(LAW)).points[0].document)
    assert _without_films(law) is law


@pytest.mark.parametrize("kinematics", [None, "outer race control"])
def test_a_law_of_the_case_itself_is_taken_as_by_run(tmp_path, kinematics):
    """No tables are made for it; the summary is that of `run` without films."""
    text = case_text(LAW, kinematics).replace('film_maps = "all"', 'film_maps = "none"')
    sweep = sweep_of(tmp_path, text)
    assert [point.tables for point in sweep.points] == [None, None]
    results = load_results(run_batch(sweep, tmp_path / "out", HerePool))
    found = results.points[1].summary
    assert found["converged"]
    assert without_times(found) == without_times(summary(run_case(load_case(tmp_path / "case.toml"))))
    assert found["torque_N_mm"]["power_balance"]["hypothesis"] == (kinematics or "traction equilibrium")


def test_tables_of_points_with_heat_have_heat(tmp_path, monkeypatch):
    """Made with the thermal properties of ball and race, and named apart from those without."""
    monkeypatch.setattr("oilfilm.cases.batch.shared_tables.build_traction_table", lambda contact, *arguments: contact)
    oil = "viscosity_mPa_s = 26.1 # assumed: 30 mm2/s of the paper times 870 kg/m3, at no stated temperature\n"
    warm = "thermal_conductivity_W_m_K = 0.14\nspecific_heat_J_kg_K = 2000.0\nviscosity_temperature_1_K = 0.04\n"
    text = case_text().replace(oil, oil + warm)
    assert text != case_text()
    names = set()
    for heated in (False, True):
        warmed = text.replace("[ehl]\n", '[ehl]\nfilm_model = "thermal"\n') if heated else text
        sweep = sweep_of(tmp_path, warmed, TABLES)
        (name,) = {point.tables for point in sweep.points}
        names.add(name)
        made = shared_tables(sweep, name, lambda done, total, state: None)
        solids = case_of_document(sweep.points[0].document).films.solids
        assert (solids is not None) == heated
        assert made[Race.INNER].solids == made[Race.OUTER].solids == solids
    assert len(names) == 2


@pytest.mark.parametrize(("name", "left_out"), [("torque_N_mm", True), ("self_heating.temperature_C", False)])
def test_what_is_asked_for_is_that_of_the_whole_run(name, left_out, tmp_path):
    """Loads, films, total, life to the last bit; a heat balance at a given temperature only where it is asked for."""
    text = case_text("heat_transfer_W_K = 2.0\nambient_C = 25.0\n")
    found = {}
    for outputs in ((), (name,)):
        sweep = sweep_of(tmp_path, text, f"outputs = {list(outputs)}")
        results = load_results(run_batch(sweep, tmp_path / f"out{len(outputs)}", HerePool))
        found[outputs] = results.points[1]
    whole, asked = (found[key].summary for key in ((), (name,)))
    assert whole["self_heating"]["temperature_C"] is not None
    assert (asked["self_heating"]["temperature_C"] is None) == left_out
    assert asked["torque_N_mm"]["flooded_isothermal"] is None
    for key in ("balls", "life", "cage_speed_rpm"):
        assert asked[key] == whole[key]
    for one, other in zip(asked["contacts"], whole["contacts"], strict=True):
        assert all(one[key] == other[key] for key in one if "conductance" not in key)
    assert asked["torque_N_mm"]["total"] == whole["torque_N_mm"]["total"]
    assert asked["torque_N_mm"]["parts"] == whole["torque_N_mm"]["parts"]
    assert found[()].key != found[(name,)].key


def test_an_output_that_no_point_has_is_told(tmp_path):
    with pytest.raises(CaseError) as caught:
        sweep_of(tmp_path, case_text(), 'outputs = ["torque"]')
    assert "outputs" in caught.value.messages[0] and "torque_N_mm" in caught.value.messages[0]

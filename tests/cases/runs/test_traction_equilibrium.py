"""Traction equilibrium in case files: where the friction comes from, what the summary says, what is refused."""

from __future__ import annotations

from math import radians

import pytest

from oilfilm.bearing.friction.friction_sources import CoefficientTraction, CoulombTraction, FilmTraction
from oilfilm.bearing.friction.tables import save_race_tables
from oilfilm.bearing.operation import BallKinematics
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.stiffness_and_slip import run_slip
from oilfilm.postprocess import summary

from ..made_up_tables import made_up_tables

TEXT = """
schema_version = 1
[bearing]
name = "6208"
[lubricant]
viscosity_mPa_s = 20.0
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 6000.0
radial_load_N = 300.0
axial_load_N = 600.0
[ehl]
points = 65
film_maps = "none"
"""
LAW = '[friction]\ntraction = "four constants"\ntraction_maximum = 0.05\ntraction_maximum_slide = 0.03\n'
LAW += "traction_limit = 0.03\n"
ASKED = '[model]\nball_kinematics = "traction equilibrium"\n'


def case(text):
    return case_from_text(text, "case.toml")


def test_a_law_named_makes_traction_equilibrium_the_default():
    assert case(TEXT).model.ball_kinematics is BallKinematics.HALF_AND_HALF
    named = case(TEXT + LAW)
    assert named.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
    assert named.document["model"]["ball_kinematics"] == "traction equilibrium"
    assert isinstance(named.traction.source, CoefficientTraction)
    kept = case(TEXT + LAW + '[model]\nball_kinematics = "inner race control"\n')
    assert kept.model.ball_kinematics is BallKinematics.INNER_RACE_CONTROL
    coulomb = case(TEXT + '[friction]\ntraction = "coulomb"\ncoefficient = 0.06\n')
    assert coulomb.traction.source == CoulombTraction(friction=0.06)
    assert isinstance(case(TEXT + ASKED).traction.source, FilmTraction)


def test_the_summary_has_the_new_state_and_power_closes():
    """The summary's motion, friction and slide are those of the balance; shaft power is heat to 1e-6."""
    results = run_case(case(TEXT + LAW))
    document = summary(results)
    assert document["converged"]
    balance = document["torque_N_mm"]["power_balance"]
    assert balance["hypothesis"] == "traction equilibrium"
    assert balance["shaft_W"] == pytest.approx(balance["heat_W"], rel=1e-6)
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert balance["hypothesis_imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert document["torque_N_mm"]["model"] == "integrated"
    ball, diameter = document["balls"][0], case(TEXT).bearing.ball_diameter
    couple = (ball["inner_friction_N"] + ball["outer_friction_N"]) * 0.5e3 * diameter
    assert couple == pytest.approx(ball["gyroscopic_moment_N_mm"], rel=1e-6)
    assert radians(ball["attitude_deg"]) == pytest.approx(results.quasistatic.attitude[0])
    assert ball["pivot_speed_rad_s"] < 0.0
    assert any(contact["slide_roll_ratio"] != 0.0 for contact in document["contacts"])
    assert any("four constants" in message for message in document["messages"])


def test_drag_of_the_balls_is_in_the_balance():
    """Rings' power less heat is what the drag takes; balls and cage are slower by the slide that drives them."""
    drag = LAW + "oil_fraction = 0.05\n"
    found, free = (summary(run_case(case(TEXT + text))) for text in (drag, LAW))
    balance = found["torque_N_mm"]["power_balance"]
    assert balance["resisted_W"] > 0.1 * balance["heat_W"]
    assert balance["shaft_W"] == pytest.approx(balance["heat_W"] + balance["resisted_W"], rel=1e-6)
    assert balance["hypothesis_imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert found["cage_speed_rpm"] < free["cage_speed_rpm"]
    assert free["torque_N_mm"]["power_balance"]["resisted_W"] == 0.0


def test_race_control_reports_its_imbalance():
    document = summary(run_case(case(TEXT + LAW + '[model]\nball_kinematics = "outer race control"\n')))
    balance = document["torque_N_mm"]["power_balance"]
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert abs(balance["hypothesis_imbalance"]) > 1.0
    assert balance["hypothesis"] == "outer race control"


def test_films_of_the_case_are_the_friction_where_none_is_named():
    """Half and half with the same films, balanced at its own loads, is a per cent away in torque."""
    text = TEXT.replace('film_maps = "none"', "").replace("radial_load_N = 300.0\n", "")  # two films
    found = summary(run_case(case(text + ASKED)))
    assumed = summary(run_case(case(text)))
    assert found["converged"]
    balance = found["torque_N_mm"]["power_balance"]
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert balance["hypothesis_imbalance"] == pytest.approx(0.0, abs=1e-2)  # films solved at loads 1e-3 apart
    assert found["torque_N_mm"]["total"] == pytest.approx(assumed["torque_N_mm"]["total"], rel=0.02)
    first, other = found["balls"][0], assumed["balls"][0]
    assert first["orbit_speed_rad_s"] == pytest.approx(other["orbit_speed_rad_s"], rel=0.01)
    assert first["attitude_deg"] != pytest.approx(other["attitude_deg"], rel=1e-3)
    assert any("shear of the solved films" in message for message in found["messages"])


@pytest.fixture(scope="module")
def tables():
    """Tables for the case's contacts with spline coefficients that no film was solved for."""
    return made_up_tables(case(TEXT))


def test_a_table_is_read_and_a_foreign_one_refused(tables, tmp_path):
    path = tmp_path / "6208.table"
    save_race_tables(tables, path)
    named = f'[friction]\ntraction = "table"\ntraction_table = "{path}"\n'
    table_case = case(TEXT + named)
    assert table_case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
    for race, table in tables.items():
        motion = (sum(table.range.load) / 2.0, sum(table.range.speed) / 2.0, 0.1, 0.02, 50.0)
        assert table_case.traction.source.laws[race].forces(*motion) == table.forces(*motion)
    with pytest.raises(CaseError, match="oil"):
        case(TEXT.replace("20.0\n", "21.0\n", 1) + named)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ('[friction]\ntraction = "table"\n', "traction_table"),
        ('[friction]\ntraction = "table"\ntraction_table = "nowhere.table"\n', "cannot be read"),
        ('[friction]\ntraction = "coulomb"\n', "coefficient"),
        ('[friction]\ntraction = "four constants"\ntraction_maximum = 0.05\n', "traction_limit"),
        (LAW.replace("0.03\n", "0.06\n"), "traction_limit"),
        ("[friction]\ntraction_limit = 0.02\n", "traction_limit"),
        ('[friction]\ntraction = "glue"\n', "glue"),
    ],
)
def test_what_does_not_go_together_is_told(more, words):
    with pytest.raises(CaseError, match=words):
        case(TEXT + more)


def test_slip_maps_take_a_hypothesis():
    text = TEXT + LAW + "[slip]\nspeeds_rpm = [1000.0, 9000.0]\naxial_loads_N = [100.0, 900.0]\npoints = 3\n"
    with pytest.raises(CaseError, match="ball_kinematics"):
        run_slip(case(text), "case.toml", 1)

"""`oilfilm film`: keys, refusals, exit codes; the films themselves are tested in tests/ehl/traction/atlas."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from oilfilm import ehl
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import load_case
from oilfilm.cases.runs import atlas
from oilfilm.cases.runs.bearing import run_case


def call(*arguments):
    return CliRunner().invoke(app, ["film", *arguments])


def document(*arguments):
    found = call(*arguments, "--json")
    assert found.exit_code == 0, found.stderr
    return json.loads(found.stdout)


def test_a_contact_has_the_keys_of_a_solved_one():
    told = document("ball_on_disc")
    films = ehl.atlas_films(load_case("ball_on_disc").conditions)
    assert told["source"] == "atlas"
    assert told["film_central_um"] == pytest.approx(films.central.value * 1e6)
    assert told["film_minimum_uncertainty_um"] == pytest.approx(films.minimum.uncertainty * 1e6)
    assert told["stiffness_N_um"] == pytest.approx(films.stiffness.value * 1e-6)
    assert told["rolling_moment_N_mm"] == pytest.approx(films.rolling_moment.value * 1e3)
    ratio = told["film_central_um"] / told["film_central_dimensionless"]
    assert films.approach.value * 1e6 == pytest.approx(told["approach_dimensionless"] * ratio)
    assert "±" in call("ball_on_disc").stdout


def test_groups_have_no_lengths():
    told = document("moes_20_10")
    assert 0.0 < told["film_minimum_dimensionless"] < told["film_central_dimensionless"]
    assert told["film_central_um"] is told["stiffness_N_um"] is None
    assert any("no lengths" in message for message in told["messages"])


def test_a_bearing_lists_its_contacts_and_why_some_have_no_films():
    told = document("6208_full_ceramic")
    for one in told["contacts"]:
        assert (one["film_central_um"] is not None) == one["loaded"]
        assert bool(one["inside"]) == (not one["note"])
    inner = [one for one in told["contacts"] if one["race"] == "inner"]
    assert [one["ball"] for one in inner if one["inside"]] == [1, 2, 9]
    for one in told["contacts"]:
        between = one["note"].startswith("between two films, in a gap of ")
        assert one["inside"] or between or (one["load_N"] == 0.0 and "does not fill the gap" in one["note"])
    state = run_case(replace(load_case("6208_full_ceramic"), film_maps="none"))  # the same loads between films
    assert [one["load_N"] for one in told["contacts"]] == pytest.approx([contact.load for contact in state.contacts])
    pairs = zip(state.torque.shear.films, told["contacts"], strict=True)
    shown = [(film.central.value * 1e6, one["film_central_um"]) for film, one in pairs if film is not None]
    assert all(run == pytest.approx(quick, rel=1e-6) for run, quick in shown) and len(shown) > 10


BEYOND = """
schema_version = 1
[bearing]
name = "7000C"
ball_material = "silicon nitride"
[lubricant]
name = "iso vg 46"
[operation]
inner_speed_rpm = 32000
axial_load_N = 250
temperature_C = 28
"""


def test_a_bearing_lists_its_contacts_beyond_the_atlas(tmp_path):
    """A fast spindle in a thick oil."""
    case = tmp_path / "fast.toml"
    case.write_text(BEYOND)
    told = document(str(case))
    beyond = [one for one in told["contacts"] if one["loaded"] and not one["inside"]]
    assert beyond and all(one["note"].startswith("L must lie in 3 to 42") for one in beyond)
    message = next(one for one in told["messages"] if "null, L must" in one)
    assert f"oilfilm run {case}" in message
    assert message.partition("null, ")[2][:20] in " ".join(call(str(case)).stdout.split())


def test_what_nobody_solves_is_not_sent_to_the_solver():
    found = document("209_radial_8900N")
    (notes,) = {one["note"] for one in found["contacts"] if one["loaded"]}
    assert notes == "no entrainment: ball and race move as one"
    assert all(one["film_central_um"] is None for one in found["contacts"])


def test_without_an_equilibrium_there_are_no_films(monkeypatch):
    solve = atlas.solve_quasistatic
    monkeypatch.setattr(
        atlas, "solve_quasistatic", lambda *a, **k: replace(solve(*a, **k), converged=False, message="made up")
    )
    found = call("6208_full_ceramic", "--json")
    assert found.exit_code == 1
    told = json.loads(found.stdout)
    assert {one["note"] for one in told["contacts"] if one["loaded"]} == {"there is no equilibrium"}
    assert any("no film was computed" in message for message in told["messages"])


@pytest.mark.parametrize(
    ("case", "fault", "solver"),
    [
        ("coated_steel", "coating_thickness_um", "oilfilm contact coated_steel"),
        ("ball_on_disc_starved", "inlet_film_um", "oilfilm contact ball_on_disc_starved"),
        ("6208_with_heat", "film_model", "oilfilm run 6208_with_heat"),
    ],
)
def test_what_is_not_covered_ends_with_one_line(case, fault, solver):
    found = call(case)
    assert found.exit_code == 2
    assert found.stdout == ""
    (line,) = found.stderr.strip().splitlines()
    assert fault in line
    assert solver in line


def test_the_moment_at_an_angle_is_null_for_its_reason(tmp_path):
    case = tmp_path / "skew.toml"
    case.write_text(
        """schema_version = 1
[contact]
load_N = 60.0
radius_x_mm = 5.0
radius_y_mm = 12.0
reduced_modulus_GPa = 226.0
entrainment_speed_m_s = 3.0
entrainment_angle_deg = 25.0
[lubricant]
viscosity_mPa_s = 20.0
pressure_viscosity_1_GPa = 18.0
density_kg_m3 = 870.0
"""
    )
    found = call(str(case), "--json")
    assert found.exit_code == 0, found.stderr
    told = json.loads(found.stdout)
    assert told["rolling_moment_N_mm"] is None
    assert "rolling_moment_...: null, the atlas has no moment of entrainment at an angle" in told["messages"]

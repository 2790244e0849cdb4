"""`oilfilm hertz` and `oilfilm frequencies`."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

from oilfilm.bearing import Operation, load_bearing, solve_quasistatic
from oilfilm.bearing.quasistatic.thrust import loads_at_rest
from oilfilm.cases.cli.main import app
from oilfilm.ehl import hertz_contact


def answer(*words):
    """What a command prints as JSON."""
    result = CliRunner().invoke(app, [*words, "--json"])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def test_a_designation_is_answered_without_the_solvers():
    code = (
        "import sys\n"
        "from oilfilm.cases.cli.answers import frequencies_answer, hertz_answer\n"
        "frequencies_answer('6306-2Z/C3', 3000.0, None, None)\n"
        "hertz_answer('7014C', None, 500.0, 1000.0, None)\n"
        "print([m for m in sys.argv[1:] if m in sys.modules])"
    )
    heavy = ["numba", "scipy.optimize", "scipy.special", "skfem", "pydantic", "rich"]
    run = subprocess.run([sys.executable, "-c", code, *heavy], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("name", "radial", "axial"),
    [("6208", 1000.0, 0.0), ("6208", 1000.0, 300.0), ("7208B", 500.0, 2000.0), ("7014C", 0.0, 500.0)],
)
def test_loads_at_rest_are_those_of_the_equilibrium(name, radial, axial):
    bearing = load_bearing(name)
    operation = Operation(inner_speed=0.0, force=(axial, radial, 0.0))
    expected = solve_quasistatic(bearing, operation)
    loads, angles = loads_at_rest(bearing, radial, axial)
    # both balances to rounding
    assert_allclose(loads, expected.inner_load, atol=1e-9 * loads.max())
    pressed = loads > 0.0
    assert_allclose(angles[pressed], expected.inner_contact_angle[pressed], rtol=1e-9, atol=1e-12)


def test_contact_by_numbers():
    (contact,) = answer("hertz", "--load", "50", "--radius-x", "6", "--radius-y", "60", "--modulus", "230")["contacts"]
    expected = hertz_contact(50.0, 6e-3, 60e-3, 2.3e11)
    assert contact["hertz_pressure_GPa"] == pytest.approx(1e-9 * expected.pressure, rel=1e-12)
    assert contact["semi_axis_transverse_mm"] == pytest.approx(1e3 * expected.semi_axis_y, rel=1e-12)
    assert contact["approach_um"] == pytest.approx(1e6 * expected.approach, rel=1e-12)


def test_contacts_of_a_bearing_and_of_a_ball():
    contacts = answer("hertz", "6208", "--radial", "3000")["contacts"]
    assert [contact["race"] for contact in contacts] == ["inner", "outer"]
    load = f"{contacts[0]['load_N']!r}"
    again = answer("hertz", "6208", "--load", load, "--angle", "0")["contacts"]
    assert again[0]["hertz_pressure_GPa"] == pytest.approx(contacts[0]["hertz_pressure_GPa"], rel=1e-12)


def test_a_case_brings_its_loads_and_speeds():
    document = answer("hertz", "6208_full_ceramic")
    assert document["radial_load_N"] == 3000.0
    document = answer("frequencies", "6208_full_ceramic")
    # 10 000 r/min, 9 balls of 12 mm on 60 mm
    assert document["frequencies_Hz"]["ball_pass_outer"] == pytest.approx(600.0)
    assert document["ranges_Hz"] is None


def test_frequencies_with_either_ring_turning():
    inner = answer("frequencies", "6208", "--speed", "6000")["frequencies_Hz"]
    outer = answer("frequencies", "6208", "--outer-speed", "6000")["frequencies_Hz"]
    assert inner["ball_pass_outer"] == pytest.approx(360.0)
    assert outer["ball_pass_outer"] == pytest.approx(inner["ball_pass_outer"])
    assert outer["cage"] + inner["cage"] == pytest.approx(100.0)
    assert inner["twice_ball_spin"] == 2.0 * inner["ball_spin"]


def test_an_estimated_interior_has_an_interval():
    document = answer("frequencies", "6306-2Z/C3", "--speed", "3000")
    for key, value in document["frequencies_Hz"].items():
        low, high = document["ranges_Hz"][key]
        assert low < value < high


@pytest.mark.parametrize(
    "words",
    [
        ("hertz",),
        ("hertz", "--load", "-3", "--radius-x", "5"),
        ("hertz", "6208"),
        ("hertz", "6208", "--radial", "nan"),
        ("hertz", "6208", "--load", "0"),
        ("hertz", "6208", "--load", "5", "--radius-x", "5"),
        ("frequencies", "6299"),
        ("frequencies", "no_such.toml"),
        ("frequencies", "ball_on_disc"),
        ("frequencies", "6208", "--angle", "90"),
    ],
)
def test_bad_input_is_refused(words):
    result = CliRunner().invoke(app, list(words))
    assert result.exit_code == 2, result.output
    assert len(result.output.splitlines()) == 1

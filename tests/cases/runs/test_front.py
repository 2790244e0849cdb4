"""`oilfilm.run`: from a designation to results, and a case with other values."""

from __future__ import annotations

import dataclasses
import re
import subprocess
import sys
from pathlib import Path

import pytest

import oilfilm
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.format.shipped import shipped_cases

PAGE = Path(__file__).parents[3] / "docs" / "user" / "python.md"
BLOCKS = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
PLACES = ("heating",)  # functions of the oil's temperature, which compare by identity
SHAFTS = ("spindle_two_bearings",)


@pytest.fixture(scope="module")
def result():
    return oilfilm.run("6306-2Z/C3", speed_rpm=3000, radial_N=800, films="atlas")


def test_main_numbers_are_those_of_the_summary(result):
    summary = result.summary
    films = [c["film_minimum_um"] for c in summary["contacts"] if c["film_minimum_um"] is not None]
    assert result.film_minimum == pytest.approx(1e-6 * min(films))
    assert result.torque == pytest.approx(1e-3 * summary["torque_N_mm"]["total"])
    assert result.temperature == pytest.approx(273.15 + summary["self_heating"]["temperature_C"])
    assert summary["case"]["operation"]["inner_speed_rpm"] == 3000.0
    assert summary["case"]["ehl"]["films"] == "atlas"


def test_a_result_shows_itself_in_ten_lines(result):
    text = repr(result)
    assert 5 < len(text.splitlines()) <= 10
    assert text.startswith("6306-2Z/C3: converged\n")
    assert "> 1 000 000 h" in text.replace("\N{NO-BREAK SPACE}", " ")
    assert "<table>" in result._repr_html_()


def test_contacts_are_a_frame(result):
    frame = result.to_dataframe()
    assert len(frame) == 16
    assert frame["load_N"].max() == pytest.approx(result.summary["contacts"][0]["load_N"], rel=0.1)


def test_pictures(result, tmp_path):
    with pytest.raises(ValueError, match="picture must be one of"):
        result.plot("torque")
    result.plot("load_zone").savefig(tmp_path / "picture.png")
    oilfilm.run("moes_20_10").plot().savefig(tmp_path / "picture.png")


@pytest.mark.slow
def test_oil_and_temperature_of_a_designation():
    result = oilfilm.run("6206", speed_rpm=3000, radial_N=500, oil="ISO VG 68", temperature_C=60, films="atlas")
    assert result.summary["case"]["lubricant"]["name"] == "iso vg 68"
    assert result.temperature == pytest.approx(333.15)


@pytest.mark.parametrize(
    ("what", "values", "text"),
    [
        ("6306", {"speedrpm": 3}, "did you mean 'speed_rpm'"),
        ("6306", {"radial_N": "x"}, 'radial_load_N: found "x"'),
        ("6306", {"radial_N": float("nan")}, "radial_load_N: found nan"),
        ("6399", {}, "is unknown"),
        ("no_such.toml", {}, "no such file"),
        ("moes_20_10", {"radial_N": 3}, "operation"),
    ],
)
def test_what_is_wrong_is_named(what, values, text):
    with pytest.raises(oilfilm.CaseError, match=re.escape(text)):
        oilfilm.run(what, **values)


def test_values_take_the_place_of_their_alternatives():
    case = oilfilm.load_case("6208_full_ceramic")
    changed = case.with_values({"bearing.free_contact_angle_deg": 12.0, "lubricant.viscosity_mPa_s": 10.0})
    assert changed.bearing.free_contact_angle == pytest.approx(0.2094395)
    assert changed.lubricant.viscosity == pytest.approx(0.01)
    assert case.bearing.diametral_clearance != changed.bearing.diametral_clearance
    again = changed.with_values({"bearing.free_contact_angle_deg": None, "bearing.diametral_clearance_um": 13.0})
    assert again.bearing.diametral_clearance == pytest.approx(13e-6)


@pytest.mark.parametrize("name", [name for name in shipped_cases() if name not in SHAFTS])
def test_the_document_of_a_case_is_that_case(name):
    case = oilfilm.load_case(name)
    again = case_of_document(case.document)
    assert again.document == case.document
    for field in dataclasses.fields(case):
        if field.compare and field.name not in PLACES:
            assert repr(getattr(again, field.name)) == repr(getattr(case, field.name)), field.name


def test_the_sweep_of_the_page_has_four_lines():
    assert len(BLOCKS[1].splitlines()) <= 5  # with its import


@pytest.mark.slow
@pytest.mark.parametrize("text", BLOCKS)
def test_the_blocks_of_the_page_run(text, tmp_path):
    run = subprocess.run([sys.executable, "-c", text], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr

"""Oils by their data sheets: ASTM D341 and D2270, and what the base oil stands for.

8.533 and 21.55 mm^2/s at 80 degrees Celsius by hand from ln ln(nu + 0.7) = A - B ln T.
"""

from __future__ import annotations

import pytest

from oilfilm.bearing import load_lubricant
from oilfilm.cases.format.case import Case, case_from_text, case_of_document
from oilfilm.cases.format.fits import HeatingInput
from oilfilm.cases.format.rules import CaseError
from oilfilm.ehl.oil.assumed_heat import BaseOil, assumed_pressure_viscosity, line_of_index, line_through

TEXT = """
schema_version = 1
[bearing]
name = "6306"
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 1500.0
temperature_C = 80.0
[lubricant]
"""


def case_of(keys, more="") -> Case:
    case = case_from_text(TEXT + keys + more, "case.toml")
    assert isinstance(case, Case)
    return case


def kinematic(keys, more=""):
    oil = case_of(keys, more).lubricant
    return 1e6 * oil.viscosity / oil.density


SHEET = "kinematic_viscosity_40C_mm2_s = {}\nkinematic_viscosity_100C_mm2_s = {}\n"


@pytest.mark.parametrize(("cold", "hot", "expected"), [(32.0, 5.4, 8.533), (120.0, 12.0, 21.55)])
def test_two_viscosities_of_a_sheet(cold, hot, expected):
    assert kinematic(SHEET.format(cold, hot)) == pytest.approx(expected, abs=0.005)
    pair = f"kinematic_viscosity_table_mm2_s = [[100.0, {hot}], [40.0, {cold}]]\n"
    assert kinematic(pair) == pytest.approx(expected, abs=0.005)


def test_one_viscosity_and_the_index():
    """ASTM D2270 forwards and backwards; VG 46 of index 100 has 6.77 mm^2/s at 100 degrees Celsius."""
    line = line_of_index(46e-6, 313.15, 100.0)
    assert 1e6 * line.at(373.15) == pytest.approx(6.77, abs=0.01)
    for index in (50.0, 99.0, 150.0, 250.0):
        assert line_of_index(46e-6, 313.15, index).viscosity_index == pytest.approx(index, abs=0.1)
    assert line_through((313.15, 373.15), (22.83e-6, 5.05e-6)).viscosity_index == pytest.approx(156.37, abs=0.3)
    by_index = kinematic("kinematic_viscosity_40C_mm2_s = 46.0\nviscosity_index = 100\n")
    assert by_index == pytest.approx(1e6 * line.at(353.15), rel=1e-9)


@pytest.mark.parametrize(
    ("name", "base"),
    [
        ("iso vg 22", "mineral"),
        ("iso vg 68", "mineral"),
        ("iso vg 220", "mineral"),
        ("arana n100", "mineral"),
        ("fva 3", "mineral"),
        ("pao 4", "PAO"),
        ("pao 40", "PAO"),
        ("mil-l-23699", "ester"),
        ("mil-l-7808", "ester"),
    ],
)
def test_coefficients_of_the_library_lie_in_the_ranges(name, base):
    for celsius in (40.0, 90.0):
        oil = load_lubricant(name, celsius + 273.15)
        _, low, high = assumed_pressure_viscosity(oil.viscosity / oil.density, BaseOil(base))
        assert 0.97 * low <= oil.pressure_viscosity <= 1.03 * high


def test_density_follows_that_at_15_degrees():
    oil = case_of(SHEET.format(32.0, 5.4) + "density_15C_kg_m3 = 860.0\n").lubricant
    assert oil.density == pytest.approx(860.0 * (1.0 - 65.0 * 6.5e-4), rel=1e-3)


def test_what_is_assumed_is_told_with_its_interval():
    case = case_of(SHEET.format(46.0, 8.1) + 'base_oil = "polyalphaolefin"\nname = "brand 46"\n')
    note = next(note for note in case.warnings if note.startswith("lubricant: "))
    assert "estimated as PAO oil: pressure_viscosity_1_GPa = 11.7 (9.6 to 14.9)" in note
    assert "density_15C_kg_m3 = 845 (825 to 870)" in note
    assert case.lubricant.thermal.ranges.viscosity_temperature == 0.0
    assert "unverified" in " ".join(case_of(SHEET.format(46.0, 8.1) + 'base_oil = "PFPE"').warnings)


def test_a_line_that_is_extrapolated_or_of_another_index_is_flagged():
    far = TEXT.replace("80.0", "-20.0") + SHEET.format(46.0, 6.8)
    assert "is extrapolated by ASTM D341" in " ".join(case_from_text(far, "case.toml").warnings)
    assert "extrapolated" not in " ".join(case_of(SHEET.format(46.0, 6.8)).warnings)
    other = " ".join(case_of(SHEET.format(46.0, 6.8) + "viscosity_index = 150\n").warnings)
    assert "150 is given, 101 is that of the two viscosities" in other
    thin = " ".join(case_of(SHEET.format(4.0, 1.4), "").warnings)
    assert "below 2 mm2/s" in thin


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (SHEET.format(5.4, 32.0), "kinematic_viscosity_100C_mm2_s: found 32.0, and 5.4 at 40 C"),
        (SHEET.format(32.0, 5.4) + 'name = "iso vg 32"', 'found with the oil "iso vg 32", which has its own data'),
        (SHEET.format(32.0, 5.4) + "viscosity_mPa_s = 20.0", "found together with viscosity_mPa_s"),
        ("kinematic_viscosity_table_mm2_s = [[40, 5.0], [100, 32.0]]", "falling with heat"),
        ("density_15C_kg_m3 = 860.0", "needed: viscosity_mPa_s, kinematic_viscosity_mm2_s, those of a data sheet"),
        (
            SHEET.format(32.0, 5.4) + "density_15C_kg_m3 = 0.87",
            "density_15C_kg_m3: found 0.87; allowed: a number >= 500",
        ),
        ("viscosity_mPa_s = 20.0", "needed, or base_oil, which estimates it"),
        (SHEET.format(32.0, 5.4) + "viscosity_at_C = 40.0", "viscosity_at_C: found without its viscosity"),
        (SHEET.format(32.0, 5.4) + 'base_oil = "POA"', "base_oil: found"),
    ],
)
def test_faults(keys, expected):
    with pytest.raises(CaseError, match="lubricant") as caught:
        case_of(keys)
    assert expected in str(caught.value)


HEAT = "\n[friction]\nheat_transfer_W_K = 2.0\n"


def test_one_viscosity_follows_the_temperature_of_a_heat_balance():
    """By the index of its base oil from operation.temperature_C; the library's oil by its own law."""
    case = case_of("kinematic_viscosity_mm2_s = 20.0\npressure_viscosity_1_GPa = 20.0\n", HEAT)
    assert isinstance(case.heating, HeatingInput)
    oil = case.heating.oil(313.15)
    line = line_of_index(20e-6, 353.15, 95.0)
    assert oil.viscosity / oil.density == pytest.approx(line.at(313.15), rel=1e-9)
    assert "viscosity_index = 95 (30 to 130)" in " ".join(case.warnings)
    named = case_of('name = "iso vg 32"\nviscosity_mPa_s = 10.0\n', HEAT)
    ratio = load_lubricant("iso vg 32", 313.15).viscosity / load_lubricant("iso vg 32", 353.15).viscosity
    assert named.heating.oil(313.15).viscosity == pytest.approx(0.010 * ratio)


def test_load_cases_have_the_viscosity_of_their_temperature():
    more = "[[load_cases]]\nshare = 0.5\ntemperature_C = 40.0\n[[load_cases]]\nshare = 0.5\n"
    cold, hot = case_of(SHEET.format(32.0, 5.4), more).load_cases
    assert 1e6 * cold.case.lubricant.viscosity / cold.case.lubricant.density == pytest.approx(32.0)
    assert hot.case.lubricant.viscosity < 0.3 * cold.case.lubricant.viscosity
    own = case_of("viscosity_mPa_s = 7.0\npressure_viscosity_1_GPa = 20.0\n", more)
    assert own.load_cases[1].case.lubricant.viscosity == pytest.approx(0.007)
    assert own.load_cases[0].case.lubricant.viscosity > 0.02


def test_the_document_of_a_sheet_is_a_case_again():
    case = case_of(SHEET.format(32.0, 5.4), HEAT)
    again = case_of_document(case.document)
    assert again.document == case.document
    assert again.lubricant.viscosity == case.lubricant.viscosity


def test_the_base_oil_of_a_grease_by_its_sheet():
    case = case_of('grease = "lithium mineral 100"\n' + SHEET.format(110.0, 11.5))
    assert 1e6 * case.lubricant.viscosity / case.lubricant.density == pytest.approx(20.5, abs=0.5)
    assert case.friction.lubrication.value == "grease"

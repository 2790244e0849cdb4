"""Seats by tolerance and greases by name in a case."""

from __future__ import annotations

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text

CASE = """
schema_version = 1
[bearing]
name = "6208"
[lubricant]
name = "VG68"
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 700.0
temperature_C = 70.0
[fit]
housing_outside_diameter_mm = 120.0
"""
SEATS = 'shaft_tolerance = "k5"\nhousing_tolerance = "H7"\nhousing_material = "aluminium"\n'


def case(text):
    return case_from_text(text, "case.toml")


def test_tolerances_give_the_mean_interference_and_say_its_interval():
    """k5 on 40 mm: 2 to 25 um, H7 in 80 mm: -43 to 0 um; class P5 has a bore of -8 to 0."""
    named = case(CASE + SEATS)
    given = case(
        CASE + "inner_ring_interference_um = 13.5\nouter_ring_interference_um = -21.5\nhousing_material = 'aluminium'\n"
    )
    assert named.clearance.mounted == pytest.approx(given.clearance.mounted)
    assert any("k5 with the bore of 40 mm in the class normal: interference of 2 to 25 um" in n for n in named.warnings)
    precise = case(CASE.replace('name = "6208"', 'name = "6208/P5"') + SEATS)
    assert any("in the class P5: interference of 2 to 21 um, 11.5 taken" in note for note in precise.warnings)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ('shaft_tolerance = "k12"', "allowed: f6"),
        ('housing_tolerance = "k6"', "allowed: F6"),
        ('shaft_tolerance = "k5"\ninner_ring_interference_um = 5.0', "found together with inner_ring_interference_um"),
    ],
)
def test_faults_of_seats_by_name(line, expected):
    with pytest.raises(CaseError, match=expected):
        case(CASE + line + "\n")


def test_a_grease_is_its_base_oil_and_says_so():
    greased = case(CASE.replace('name = "VG68"', 'grease = "Lithium-Mineral 100"'))
    oiled = case(CASE.replace("VG68", "VG100"))
    assert greased.lubricant.viscosity == oiled.lubricant.viscosity
    assert greased.friction.lubrication.value == "grease"
    assert any("1.1 to 1.4 of that when fresh, 0.16 to 0.7 when aged" in note for note in greased.warnings)
    with pytest.raises(CaseError, match="did you mean 'lithium mineral 100'"):
        case(CASE.replace('name = "VG68"', 'grease = "lithium minral 100"'))


def test_a_document_of_named_seats_and_greases_is_a_case_again():
    from oilfilm.cases.format.case import case_of_document

    first = case(CASE.replace('name = "VG68"', 'grease = "lithium mineral 100"') + SEATS)
    again = case_of_document(first.document)
    assert again.clearance == first.clearance
    assert again.lubricant.viscosity == pytest.approx(first.lubricant.viscosity)

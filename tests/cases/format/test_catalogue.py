"""Cases that name a bearing of the catalogue, a material or an oil in other words than the libraries."""

from __future__ import annotations

import pytest

from oilfilm.cases.format.case import case_from_text

CASE = """
schema_version = 1
[bearing]
name = "{name}"
{more}
[lubricant]
name = "ISO-VG 32"
[operation]
inner_speed_rpm = 3000.0
radial_load_N = 1000.0
axial_load_N = 200.0
temperature_C = 60.0
"""


def case(name, more=""):
    return case_from_text(CASE.format(name=name, more=more), "case.toml")


def test_names_are_those_of_the_libraries():
    found = case("7208-b", 'ball_material = "Silicon Nitride"')
    assert found.document["bearing"]["name"] == "7208B"
    assert found.document["bearing"]["ball_material"] == "silicon nitride"
    assert found.lubricant.name == "iso vg 32"
    assert found.bearing.ball_material.name == "silicon nitride"


def test_an_estimated_geometry_is_reported_with_its_range():
    (message,) = [text for text in case("6305").warnings if "estimated" in text]
    assert "'6305'" in message
    assert "balls 8 (7 to 9)" in message
    assert "diametral clearance 12.5 um (5 to 20)" in message


def test_what_the_case_gives_or_assumes_is_not_reported():
    known = "ball_diameter_mm = 10.32\npitch_diameter_mm = 43.4\nballs = 7"
    (message,) = [text for text in case("6305", known).warnings if "estimated" in text]
    assert "balls" not in message
    assert "inner groove radius" in message
    assumed = 'assumed = ["bearing.diametral_clearance_um"]\n'
    text = assumed + CASE.format(name="6208", more="")
    assert not [note for note in case_from_text(text, "case.toml").warnings if "estimated" in note]


@pytest.mark.parametrize(("more", "rating"), [("", 20600.0), ("balls = 8", 20600.0), ("balls = 7", None)])
def test_the_makers_rating_belongs_to_the_catalogues_geometry(more, rating):
    assert case("6305", more).rating.dynamic_rating == rating

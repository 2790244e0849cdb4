"""Rolling moments in the summary of a run: the layer that ends the oil, its uncertainty, and what is said of both."""

from __future__ import annotations

import pytest

from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.bearing import run_case
from oilfilm.cases.runs.contact import run_contact
from oilfilm.postprocess import summary

TEXT = """
schema_version = 1
[bearing]
name = "6208"
[lubricant]
kinematic_viscosity_mm2_s = 20.0
density_kg_m3 = 870.0
pressure_viscosity_1_GPa = 18.0
[operation]
inner_speed_rpm = 8000.0
radial_load_N = 2000.0
[ehl]
points = 65
"""
# every ball is loaded at both races, so that all films are solved and none is between two films
AXIAL = TEXT.replace("radial_load_N = 2000.0", "axial_load_N = 1500.0")
CONTACT = """
schema_version = 1
[contact]
load_N = 15.0
radius_x_mm = 12.5
radius_y_mm = 12.5
reduced_modulus_GPa = 110.0
entrainment_speed_m_s = 0.5
[lubricant]
viscosity_mPa_s = 40.0
pressure_viscosity_1_GPa = 18.0
[ehl]
points = 65
"""


def document_of(text):
    return summary(run_case(case_from_text(text, "case.toml")))


def contact_of(text):
    return summary(run_contact(case_from_text(text, "case.toml")))


def test_bearing_states_its_layer_and_the_torque_takes_it():
    document = document_of(AXIAL)
    torque, contacts = document["torque_N_mm"], document["contacts"]
    extent = torque["rolling_extent"]
    assert document["case"]["lubricant"]["flooded_layer_um"] == 100.0 == pytest.approx(extent["layer_um"])
    assert extent["within_extent"] == pytest.approx(torque["models"]["integrated"]["rolling"], rel=1e-9)
    assert 0.0 < extent["uncertainty"] < 0.4 * extent["within_extent"]  # 65 points
    heavy = contacts[0]
    assert heavy["rolling_moment_box_N_mm"] != heavy["rolling_moment_N_mm"] > 0.0
    assert 0.0 < heavy["rolling_moment_uncertainty_N_mm"] < 0.5 * heavy["rolling_moment_N_mm"]  # 65 points
    assert heavy["flooded_layer_um"] == pytest.approx(100.0)
    # sqrt(2 R_x 0.1 mm), a little more with the film and less with the circles
    assert heavy["rolling_extent_mm"] == pytest.approx((2.0 * 4.8 * 0.1) ** 0.5, rel=0.06)
    assert not any(m.startswith("contacts.rolling_moment_N_mm: null") for m in document["messages"])


def test_the_extent_holds_films_between_two_races():
    """Of light balls, by the film atlas: no moment of theirs is solved, but their part of the torque counts."""
    document = document_of(TEXT)
    contacts = document["contacts"]
    solved = [c["film_origin"] == "solved" for c in contacts]
    assert 0 < sum(solved) < len(solved)
    assert [c["rolling_moment_N_mm"] is not None for c in contacts] == solved
    assert any(m.startswith("contacts.rolling_moment_N_mm: null") for m in document["messages"])
    extent = document["torque_N_mm"]["rolling_extent"]
    assert extent["within_extent"] == pytest.approx(document["torque_N_mm"]["models"]["integrated"]["rolling"])
    assert 0.0 < extent["uncertainty"] < 0.1 * extent["within_extent"]
    assert any("light balls between two films, by atlas or formula" in m for m in document["messages"])


def test_a_layer_that_decides_is_told():
    """Where twice of it adds more than 5 % of the torque."""
    document = document_of(AXIAL.replace("density", "flooded_layer_um = 30\ndensity"))
    extent = document["torque_N_mm"]["rolling_extent"]
    assert extent["doubling"] > 0.05 * document["torque_N_mm"]["total"]
    told = [m for m in document["messages"] if "lubricant.flooded_layer_um" in m]
    assert len(told) == 1
    assert f"{extent['within_extent']:.4g} ± {extent['uncertainty']:.4g} N mm" in told[0]
    assert f"{extent['doubling']:.4g} more with twice" in told[0] and "a layer of 30 um" in told[0]


def test_a_thicker_layer_has_more_rolling_moment_in_the_torque():
    some, more = (
        document_of(AXIAL.replace("density", f"flooded_layer_um = {layer}\ndensity"))["torque_N_mm"]
        for layer in (50, 100)
    )
    added = more["rolling_extent"]["within_extent"] - some["rolling_extent"]["within_extent"]
    assert added == pytest.approx(some["rolling_extent"]["doubling"], rel=0.02)  # the balls find other speeds
    assert more["total"] - some["total"] == pytest.approx(added, rel=0.1)


def test_run_without_films_has_no_extent():
    document = document_of(TEXT.replace("points = 65", 'film_maps = "none"'))
    assert set(document["torque_N_mm"]["rolling_extent"].values()) == {None}
    assert any(m.startswith("torque_N_mm.rolling_extent: null") for m in document["messages"])


def test_single_contact_in_an_open_and_a_fixed_box():
    document = contact_of(CONTACT)
    assert document["flooded_layer_um"] == pytest.approx(100.0)
    assert document["rolling_extent_mm"] == pytest.approx((2.0 * 12.5 * 0.1) ** 0.5, rel=0.02)
    assert document["rolling_moment_N_mm"] > document["rolling_moment_uncertainty_N_mm"] > 0.0
    thin = contact_of(CONTACT.replace("[ehl]", "flooded_layer_um = 1\n[ehl]"))
    assert any(m.startswith("rolling_moment_N_mm: the layer ends") for m in thin["messages"])
    fixed = contact_of(CONTACT + "domain = [-4.5, 1.5, 2.5]\n")
    assert fixed["rolling_moment_N_mm"] == fixed["rolling_moment_box_N_mm"] > 0.0
    assert fixed["rolling_extent_mm"] is None
    assert any("rolling_extent_mm: null" in m and "[ehl] domain" in m for m in fixed["messages"])


@pytest.mark.parametrize("layer", ["0", "-3", "2e4", '"thick"'])
def test_a_layer_out_of_range_is_named(layer):
    with pytest.raises(CaseError, match=r"lubricant\.flooded_layer_um"):
        case_from_text(TEXT.replace("density", f"flooded_layer_um = {layer}\ndensity"), "case.toml")

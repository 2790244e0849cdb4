"""Rolling moments in the summary of a run, and what is said of the boxes they depend on."""

from __future__ import annotations

import pytest

from cases.format.case import case_from_text
from cases.runs.bearing import run_case
from cases.runs.contact import run_contact
from postprocess import summary

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


def test_bearing_tells_how_far_its_boxes_decide():
    document = document_of(TEXT)
    torque, contacts = document["torque_N_mm"], document["contacts"]
    extent = torque["rolling_extent"]
    assert extent["box"] == pytest.approx(torque["models"]["integrated"]["rolling"], rel=1e-9)
    assert extent["within_extent"] == pytest.approx(extent["box"] - extent["beyond_extent"] + extent["beyond_box"])
    assert "beyond_box" not in torque["models"]["integrated"]
    heavy = contacts[0]
    assert heavy["rolling_moment_beyond_box_N_mm"] > 0.03 * heavy["rolling_moment_N_mm"] > 0.0
    assert heavy["rolling_extent_mm"] == pytest.approx(0.5 * 4.8, rel=0.02)  # half of R_x at the inner race
    assert all(c["rolling_moment_N_mm"] is None for c in contacts if not c["loaded"])
    assert any(m.startswith("contacts.rolling_moment_N_mm: null") for m in document["messages"])
    told = [m for m in document["messages"] if "depends on the films' boxes" in m]
    decided = max(extent["beyond_box"], extent["beyond_extent"]) > 0.05 * torque["total"]
    assert decided and len(told) == 1
    assert f"{extent['within_extent']:.4g} N mm" in told[0]


def test_run_without_films_has_no_extent():
    document = document_of(TEXT.replace("points = 65", 'film_maps = "none"'))
    assert set(document["torque_N_mm"]["rolling_extent"].values()) == {None}
    assert any(m.startswith("torque_N_mm.rolling_extent: null") for m in document["messages"])


def test_single_contact_in_an_open_and_a_fixed_box():
    document = contact_of(CONTACT)
    box, beyond = document["rolling_moment_N_mm"], document["rolling_moment_beyond_box_N_mm"]
    assert document["rolling_extent_mm"] == pytest.approx(6.25)
    assert box < document["rolling_moment_within_extent_N_mm"] <= box + beyond
    fixed = contact_of(CONTACT + "domain = [-4.5, 1.5, 2.5]\n")
    assert 0.0 < fixed["rolling_moment_N_mm"] < box
    assert fixed["rolling_moment_within_extent_N_mm"] is None
    assert any("beyond_box_N_mm" in m and "[ehl] domain" in m for m in fixed["messages"])

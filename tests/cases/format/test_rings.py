"""[rings]: seats, what they need, and that they reach the equilibrium."""

from __future__ import annotations

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text
from oilfilm.ehl.solid.bodies import Seat

CASE = """\
schema_version = 1
[bearing]
name = "6208"
ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 68"
[operation]
inner_speed_rpm = 1000.0
radial_load_N = 1000.0
"""
UNKNOWN = CASE.replace('name = "6208"', "ball_diameter_mm = 12.0\npitch_diameter_mm = 60.0\nballs = 9\n"
    "inner_groove_radius_mm = 6.17\nouter_groove_radius_mm = 6.29\nfree_contact_angle_deg = 15.0")  # fmt: skip


def of(text):
    return case_from_text(text, "case.toml")


def messages(text):
    with pytest.raises(CaseError) as caught:
        of(text)
    return list(caught.value.messages)


def test_without_the_table_rings_are_rigid():
    assert of(CASE).model.rings is None
    assert of(CASE + "[rings]\n").model.rings is None


def test_seats_of_both_rings():
    rings = of(
        CASE + '[rings]\ninner_seat = "free"\nouter_seat = "elastic"\n[fit]\nhousing_outside_diameter_mm = 120.0\n'
    ).model.rings
    assert rings.inner.seat is Seat.FREE
    assert rings.inner.profile.body_radius is None
    assert rings.outer.seat is Seat.ELASTIC
    assert rings.outer.profile.body_radius == pytest.approx(60e-3)
    assert rings.inner.estimated_shoulder
    alone = of(CASE + '[rings]\nouter_seat = "rigid"\n').model.rings
    assert alone.inner is None


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (CASE + '[rings]\ninner_seat = "loose"\n', ("rings.inner_seat", '"rigid", "elastic", "free"')),
        (CASE + '[rings]\ninner_seat = "elastic"\n', ("fit.shaft_bore_mm", "0 of a solid one")),
        (CASE + '[rings]\nouter_seat = "elastic"\n', ("fit.housing_outside_diameter_mm", "outer_seat")),
        (UNKNOWN + '[rings]\ninner_seat = "free"\n', ("bearing.bore_mm", "inner_seat")),
        (UNKNOWN + '[rings]\nouter_seat = "rigid"\n', ("bearing.outside_diameter_mm", "outer_seat")),
        (CASE + '[rings]\nouter_seat = "rigid"\n[dynamics]\nend_time_s = 1.0\n', ("rings", "simulations")),
        (
            CASE.replace('name = "6208"', 'name = "6208"\nwidth_mm = 8.0') + '[rings]\ninner_seat = "rigid"\n',
            ("rings.inner_seat", "no such ring"),
        ),
        (CASE + "[rings]\nseat = 1\n", ("rings.seat",)),
    ],
)
def test_one_message_for_a_bad_combination(text, parts):
    found = messages(text)
    assert any(all(part in message for part in parts) for message in found), found


@pytest.mark.parametrize(
    ("keys", "line"), [('inner_seat = "elastic"', 13), ('inner_seat = "rigid"\nouter_seat = "elastic"', 14)]
)
def test_a_seat_without_its_body_has_the_line_of_the_seat(keys, line):
    """The table [fit] that must be added has no line; the first line of the file would mislead."""
    (message,) = messages(CASE + f"[rings]\n# seats\n{keys}\n")
    assert message.startswith(f"case.toml:{line}: fit.")


def test_angular_contact_bearings_need_shoulders():
    text = UNKNOWN.replace("balls = 9", "balls = 9\nbore_mm = 40.0\noutside_diameter_mm = 80.0\nwidth_mm = 18.0")
    (message,) = messages(text + '[rings]\ninner_seat = "rigid"\n')
    assert "bearing.inner_shoulder_diameter_mm" in message
    given = text.replace("balls = 9", "balls = 9\ninner_shoulder_diameter_mm = 52.6")
    rings = of(given + '[rings]\ninner_seat = "rigid"\n').model.rings
    assert not rings.inner.estimated_shoulder

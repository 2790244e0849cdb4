"""Distance of ellipses to shoulders and what these cut off, against counted points and simple limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import Operation, Race, contact_conditions, contact_stress, solve_quasistatic
from oilfilm.bearing.contacts.shape import groove_radius
from oilfilm.bearing.contacts.stress import cut_approach, shoulder_angle, truncation
from oilfilm.bearing.geometry import shoulder_diameter
from oilfilm.ehl import Lubricant
from oilfilm.ehl.closed_form.hertz import hertz_contact

from ..quasistatic.test_random_bearings import random_bearing

OIL = Lubricant(viscosity=0.03, pressure_viscosity=18e-9)
POINTS = 4000  # of a line across an ellipse: shares by counting are right within 1/POINTS


def ellipse(load=1000.0):
    return hertz_contact(load, 5e-3, 80e-3, 226e9)


def with_shoulder(plain, angle):
    """The bearing with its inner shoulder at an angle from the bottom of the groove."""
    inner = 2.0 * (plain.inner_centre_radius - plain.inner_groove_radius * np.cos(angle))
    return replace(plain, inner_shoulder_diameter=inner)


def test_shoulder_angle(bearings):
    """Edge of the groove at 45 degrees by construction, at both rings."""
    plain = with_shoulder(bearings.b6208, np.pi / 4.0)
    outer = 2.0 * (plain.outer_centre_radius + plain.outer_groove_radius * np.sqrt(0.5))
    bearing = replace(plain, outer_shoulder_diameter=outer)
    assert [shoulder_angle(bearing, race) for race in Race] == pytest.approx([np.pi / 4.0] * 2)


def test_shoulders_of_deep_groove_bearings_are_estimated_and_named_so(bearings):
    """0.2 of the ball above the raceways; nothing for angular contact, whose shoulders are unlike."""
    plain = bearings.b6208
    height = 0.2 * plain.ball_diameter
    bottom = 2.0 * (plain.inner_centre_radius - plain.inner_groove_radius)
    top = 2.0 * (plain.outer_centre_radius + plain.outer_groove_radius)
    assert shoulder_diameter(plain, Race.INNER) == pytest.approx((bottom + 2.0 * height, True))
    assert shoulder_diameter(plain, Race.OUTER) == pytest.approx((top - 2.0 * height, True))
    assert truncation(plain, Race.INNER, 0.0, ellipse()).estimated
    given = with_shoulder(plain, 0.7)
    assert shoulder_diameter(given, Race.INNER) == (given.inner_shoulder_diameter, False)
    assert not truncation(given, Race.INNER, 0.0, ellipse()).estimated
    assert shoulder_diameter(bearings.b7008, Race.INNER) is None
    assert truncation(bearings.b7008, Race.INNER, 0.26, ellipse()) is None


def test_truncation_grows_from_none_to_all(bearings):
    """Edge in the middle of the ellipse: half of length and load beyond it, the whole pressure at it."""
    bearing, hertz = with_shoulder(bearings.b6208, 0.5), ellipse()
    half = truncation(bearing, Race.INNER, -0.5, hertz)
    assert (half.length_share, half.load_share, half.distance_ratio) == pytest.approx((0.5, 0.5, 0.0))
    assert half.edge_pressure == pytest.approx(hertz.pressure)
    assert half.truncated and half.cut_pressure is None and half.cut_edge_pressure is None
    none = truncation(bearing, Race.INNER, 0.0, hertz)
    assert (none.length_share, none.load_share, none.edge_pressure) == (0.0, 0.0, 0.0)
    assert not none.truncated and (none.cut_pressure, none.cut_edge_pressure) == (hertz.pressure, 0.0)
    edge = bearing.inner_groove_radius * np.sin(0.5)
    assert none.margin == pytest.approx(edge - hertz.semi_axis_y)
    assert none.distance_ratio == pytest.approx(edge / hertz.semi_axis_y)
    beyond = truncation(bearing, Race.INNER, 1.2, hertz)
    assert (beyond.length_share, beyond.load_share) == (1.0, 1.0)


def test_load_beyond_the_edge_against_the_sum_of_pressures(bearings):
    """(1 - s)^2 (2 + s)/4 is what the semi-ellipsoid holds beyond s."""
    hertz = ellipse()
    angle = 0.3 - np.arcsin(0.4 * hertz.semi_axis_y / bearings.b6208.inner_groove_radius)
    cut = truncation(with_shoulder(bearings.b6208, 0.3), Race.INNER, angle, hertz)
    x, y = np.meshgrid(np.linspace(-1, 1, 1001), np.linspace(-1, 1, 1001), indexing="ij")
    pressure = np.sqrt(np.maximum(0.0, 1.0 - x**2 - y**2))
    assert cut.load_share == pytest.approx(pressure[y > 0.4].sum() / pressure.sum(), rel=5e-3)
    assert cut.length_share == pytest.approx(0.3)


def test_pressure_of_a_cut_ellipse_by_hand(bearings):
    """At s 0.7 the approach is 1.0473 times Hertz': 1.0473 (0.7 + 1.0234) - (0.7^3 + 1.0234^3)/3 = 4/3."""
    hertz = ellipse()
    angle = 0.3 - np.arcsin(0.7 * hertz.semi_axis_y / bearings.b6208.inner_groove_radius)
    cut = truncation(with_shoulder(bearings.b6208, 0.3), Race.INNER, angle, hertz)
    assert cut.distance_ratio == pytest.approx(0.7)
    assert cut.cut_pressure / hertz.pressure == pytest.approx(np.sqrt(1.0473), abs=1e-4)
    assert cut.cut_edge_pressure / hertz.pressure == pytest.approx(np.sqrt(1.0473 - 0.49), abs=1e-4)


def test_both_shoulders_cut_an_ellipse_in_the_middle_of_a_shallow_groove(bearings):
    """At no contact angle either side loses the same."""
    hertz = ellipse()
    angle = np.arcsin(0.6 * hertz.semi_axis_y / bearings.b6208.inner_groove_radius)
    cut = truncation(with_shoulder(bearings.b6208, angle), Race.INNER, 0.0, hertz)
    assert cut.length_share == pytest.approx(0.4)
    assert cut.load_share == pytest.approx(2.0 * 0.25 * 0.4**2 * 2.6)


@pytest.mark.parametrize("seed", [719, 5302, 88131])
def test_random_bearings_against_points_of_the_groove(seed):
    """Shares of ellipses by counting points of the groove above the shoulders, at any load and angle.

    A point y of the ellipse stands on the groove at the contact angle plus asin(y/r), R_c - r cos
    from the axis at the inner race, R_c + r cos at the outer one.
    """
    rng = np.random.default_rng(seed)
    cuts = []
    for _ in range(40):
        plain = random_bearing(rng)
        race = Race.INNER if rng.random() < 0.5 else Race.OUTER
        inner, r = race is Race.INNER, groove_radius(plain, race)
        centre = plain.inner_centre_radius if inner else plain.outer_centre_radius
        side = -1.0 if inner else 1.0
        diameter = 2.0 * (centre + side * r * np.cos(rng.uniform(0.1, 1.2)))
        field = f"{race.value}_shoulder_diameter"
        bearing, angle = replace(plain, **{field: diameter}), rng.uniform(-0.8, 0.8)
        hertz = hertz_contact(10 ** rng.uniform(1.0, 4.0), *radii(plain, inner), 226e9)
        if hertz.semi_axis_y > 0.9 * r:  # no ellipse of Hertz
            continue
        cut = truncation(bearing, race, angle, hertz)
        t = (np.arange(POINTS) + 0.5) / POINTS * 2.0 - 1.0
        place = angle + np.arcsin(t * hertz.semi_axis_y / r)
        height = side * (centre + side * r * np.cos(place) - 0.5 * diameter)
        beyond = height < 0.0
        assert cut.length_share == pytest.approx(beyond.mean(), abs=2.0 / POINTS)
        assert cut.load_share == pytest.approx(0.75 * (1.0 - t[beyond] ** 2).sum() * 2.0 / POINTS, abs=2e-3)
        assert cut.truncated == (cut.margin < 0.0) == (cut.length_share > 0.0)
        cuts.append(cut.truncated)
    assert 5 < sum(cuts) < len(cuts) - 5  # both kinds were drawn


def radii(bearing, inner):
    """Reduced radii of a contact, those of the bearing at no contact angle [m]."""
    gamma = bearing.ball_diameter / bearing.pitch_diameter
    groove = bearing.inner_groove_radius if inner else bearing.outer_groove_radius
    along = 0.5 * bearing.ball_diameter * (1.0 - gamma if inner else 1.0 + gamma)
    return along, 1.0 / (2.0 / bearing.ball_diameter - 1.0 / groove)


def test_slices_keep_the_load():
    """The integral of e - t^2 over what is left is that of 1 - t^2 over the whole ellipse."""
    for near, far in [(0.9, 3.0), (0.5, 0.7), (0.05, 1.5), (0.3, 0.3), (0.999, 1.0)]:
        approach = cut_approach(near, far)
        edges = np.linspace(-min(np.sqrt(approach), far), near, 20001)
        t = 0.5 * (edges[1:] + edges[:-1])
        load = (np.maximum(approach - t * t, 0.0) * np.diff(edges)).sum()
        assert load == pytest.approx(4.0 / 3.0, rel=1e-7)
        assert approach > 1.0
    assert cut_approach(1.0, 1.0) == 1.0
    assert cut_approach(0.0, 1.0) is None


def test_contacts_of_a_bearing_have_their_distance(bearings):
    """A pure thrust of 6 kN on a 6208 with a shallow inner groove: all balls alike, cut at one side."""
    bearing = with_shoulder(bearings.b6208, 0.45)
    solution = solve_quasistatic(bearing, Operation(inner_speed=100.0, force=(6000.0, 0.0, 0.0)))
    inner = [c for c in contact_conditions(solution, OIL) if c.race is Race.INNER]
    found = [contact_stress(solution, contact).truncation for contact in inner]
    ratio = np.sin(0.45 - inner[0].contact_angle) * bearing.inner_groove_radius / inner[0].hertz.semi_axis_y
    assert [cut.distance_ratio for cut in found] == pytest.approx([ratio] * bearing.balls, rel=1e-9)
    assert 0.0 < ratio < 1.0
    assert found[0].cut_pressure > inner[0].hertz.pressure > found[0].edge_pressure


@pytest.mark.parametrize("field", ["inner_shoulder_diameter", "outer_shoulder_diameter"])
def test_impossible_shoulders_are_refused(bearings, field):
    for value in (0.03, 0.09):
        with pytest.raises(ValueError, match=field):
            replace(bearings.b6208, **{field: value})

"""Finite bodies in the conditions of films: both or none, in proportion to the load, and what is reported."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import Operation, Race, contact_conditions, solve_quasistatic
from oilfilm.bearing.contacts import finite_bodies as module
from oilfilm.bearing.contacts.finite_bodies import finite_bodies, ring_profile, with_finite_bodies
from oilfilm.ehl import Lubricant
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.solid.bodies.ring import StressDifference
from oilfilm.ehl.solid.bodies.surface_difference import SurfaceDifference

OIL = Lubricant(viscosity=0.03, pressure_viscosity=18e-9)
SIZES = {"bore": 40e-3, "outside_diameter": 80e-3, "width": 18e-3}
RING = SurfaceDifference(
    constant=-1e-6, tilt=1e-5, curvature_x=0.3, curvature_y=0.2, rest=1e-8, unknowns=9, residual=1e-9
)
WIDE = np.array([-1.0, 1.0])  # lines beyond any box [m]
NO_STRESS = StressDifference((np.array([0.0, 1.0]), WIDE, np.array([0.0, 1.0])), np.zeros((6, 2, 2, 2)))


@pytest.fixture
def solved(bearings, monkeypatch):
    """A 6208 under a radial load, its contacts, and a ring whose finite elements are not solved."""
    monkeypatch.setattr(module, "ring_difference", lambda *arguments: (RING, NO_STRESS))
    bearing = replace(bearings.b6208, **SIZES)
    solution = solve_quasistatic(bearing, Operation(inner_speed=300.0, force=(0.0, 3000.0, 0.0)))
    return bearing, contact_conditions(solution, OIL)


def test_films_have_the_new_radii_and_dry_contacts_the_old_ones(solved):
    """1/R grows by the sum of ring, ball and gap at the heaviest contact, elsewhere by its share of the load."""
    bearing, contacts = solved
    found = finite_bodies(bearing, contacts)
    changed = with_finite_bodies(contacts, found)
    assert not found.reason
    for race in Race:
        difference = found.at(race)
        total = difference.total
        heaviest = max((c for c in contacts if c.race is race), key=lambda c: c.load)
        assert difference.contact is heaviest
        assert total.curvature_y > difference.ring.curvature_y == 0.2
        for before, after in zip(contacts, changed, strict=True):
            if before.race is race and before.conditions is not None:
                share = before.load / heaviest.load
                for axis, curvature in (("radius_x", total.curvature_x), ("radius_y", total.curvature_y)):
                    new, old = (getattr(c.conditions, axis) for c in (after, before))
                    assert 1.0 / new - 1.0 / old == pytest.approx(share * curvature, rel=1e-6)
                assert after.hertz == before.hertz
            elif before.race is race:
                assert after is before


def test_what_is_reported_is_hertz_and_the_formula_with_the_new_radii(solved):
    bearing, contacts = solved
    difference = finite_bodies(bearing, contacts).inner
    hertz, total = difference.contact.hertz, difference.total
    radii = (1.0 / (1.0 / hertz.radius_x + total.curvature_x), 1.0 / (1.0 / hertz.radius_y + total.curvature_y))
    pressure = hertz_contact(hertz.load, *radii, hertz.reduced_modulus).pressure
    assert difference.pressure_share == pytest.approx(pressure / hertz.pressure - 1.0)
    assert 0.0 < difference.pressure_share < 0.03  # both curvatures grow
    assert abs(difference.film_share) < 0.01
    assert difference.ring_stress.von_mises_change == 0.0
    assert difference.transverse_curvature_share == pytest.approx(total.curvature_y * hertz.radius_y)
    assert difference.shift == pytest.approx(1e-5 * hertz.radius_y)
    assert difference.approach_change == pytest.approx(-1e-6 + difference.ball.constant)


def test_both_races_or_none(solved):
    """Without an outside diameter, or with an ellipse cut at one race, films keep half-spaces, and it is said why."""
    bearing, contacts = solved
    for bad, reason in (
        (replace(bearing, outside_diameter=None), "outer ring: outside_diameter is needed"),
        (replace(bearing, outer_shoulder_diameter=71.8e-3), "shoulder of the outer ring cuts the ellipse"),
        (replace(bearing, bore=48.5e-3), "bore leaves no wall"),
    ):
        found = finite_bodies(bad, contacts)
        assert reason in found.reason
        assert found.inner is None and found.outer is None
        assert with_finite_bodies(contacts, found) == tuple(contacts)


def test_profiles_have_the_rings_of_the_bearing(bearings):
    """Grooves about the centres of curvature, inner ring inside, outer ring outside of its track."""
    bearing = replace(bearings.b6208, **SIZES)
    inner, outer = (ring_profile(bearing, race) for race in Race)
    assert (inner.side, outer.side) == (1.0, -1.0)
    play = bearing.diametral_clearance
    assert inner.centre_radius == pytest.approx(bearing.inner_centre_radius, abs=play)
    assert outer.centre_radius == pytest.approx(bearing.outer_centre_radius, abs=play)
    assert inner.shoulder_radius - inner.track_radius == pytest.approx(0.2 * bearing.ball_diameter, abs=play)
    with pytest.raises(ValueError, match="bore is needed"):
        ring_profile(bearings.b6208, Race.INNER)
    with pytest.raises(ValueError, match="inner_shoulder_diameter is not known"):
        ring_profile(bearings.b7008, Race.INNER)
    assert np.isclose(outer.wall, 0.5 * 80e-3 - outer.track_radius)

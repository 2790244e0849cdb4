"""Differences of temperature that a ring bears: the closed form of a plain ring, tension that is there already."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import Operation, Race, load_material
from oilfilm.bearing.fits.ring_strength import ring_strengths
from oilfilm.bearing.rating.ceramic import ring_gradient
from oilfilm.bearing.rings.elastic_ring import heated_section
from oilfilm.ehl.solid.bodies import thermal_hoop

NITRIDE = load_material("silicon nitride")


@pytest.fixture(scope="module")
def ceramic(bearings):
    parts = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), NITRIDE)
    return replace(bearings.b6208, **parts, bore=40e-3, outside_diameter=80e-3, width=18e-3)


def gradients(bearing, speed=0.0):
    operation = Operation(inner_speed=speed, force=(0.0, 1000.0, 0.0))
    return {ring.race: ring_gradient(bearing, ring) for ring in ring_strengths(bearing, operation, None)}


def test_of_a_ring_at_rest(ceramic):
    """Strength over the largest tension for each kelvin, E alpha times the solved stress of the section."""
    found = gradients(ceramic)[Race.INNER]
    section = heated_section(ceramic, Race.INNER)
    hoop = thermal_hoop(section, NITRIDE.poisson_ratio)
    scale = NITRIDE.youngs_modulus * NITRIDE.thermal_expansion
    assert found.tension == pytest.approx(scale * hoop.max())
    assert found.warm.value == pytest.approx(800e6 / found.tension)
    assert found.cold.value == pytest.approx(800e6 / (-scale * hoop.min()))
    ends = np.array(NITRIDE.bending_strength_range) / 800e6
    assert found.warm[1:] == pytest.approx(found.warm.value * ends)
    assert found.cold[1:] == pytest.approx(found.cold.value * ends)
    assert found.conductance == pytest.approx(section.conductance * NITRIDE.thermal_conductivity)


def test_rotation_uses_strength_up(ceramic):
    still, fast = gradients(ceramic)[Race.INNER], gradients(ceramic, 8000.0)[Race.INNER]
    operation = Operation(inner_speed=8000.0, force=(0.0, 1000.0, 0.0))
    turning = ring_strengths(ceramic, operation, None)[0].hoop_tension
    assert fast.warm.value == pytest.approx(still.warm.value * (1.0 - turning / 800e6))  # both largest in the bore
    burst = gradients(ceramic, 40000.0)[Race.INNER]
    assert (burst.warm.value, burst.cold.value) == (0.0, 0.0)


def test_steel_and_rings_without_a_width_have_none(ceramic):
    steel = load_material("bearing steel")
    assert gradients(replace(ceramic, outer_ring_material=steel))[Race.OUTER] is None
    assert gradients(replace(ceramic, width=None)) == {Race.INNER: None, Race.OUTER: None}
    assert gradients(replace(ceramic, width=9e-3))[Race.INNER] is None  # narrower than the groove

"""Cracks under ceramic contacts, and the static rating by the rule of makers."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import pytest

from oilfilm.bearing import Operation, contact_conditions, load_bearing, load_material, solve_quasistatic
from oilfilm.bearing.contacts.stress import edge_tension
from oilfilm.bearing.rating.ceramic import contact_strength, critical_flaw, makers_static_rating
from oilfilm.bearing.rating.load_rating import static_rating
from oilfilm.ehl import Lubricant

OIL = Lubricant(viscosity=0.02, pressure_viscosity=18e-9)


def made_of(bearing, rings, balls):
    ring, ball = load_material(rings), load_material(balls)
    return replace(bearing, inner_ring_material=ring, outer_ring_material=ring, ball_material=ball)


def solved(rings, balls, radial=1000.0):
    bearing = made_of(load_bearing("6206"), rings, balls)
    solution = solve_quasistatic(bearing, Operation(inner_speed=100.0, force=(0.0, radial, 0.0)))
    return solution, contact_conditions(solution, OIL)


@pytest.fixture(scope="module")
def carbide():
    return solved("silicon carbide", "silicon nitride")


def test_a_crack_of_the_critical_depth_has_the_fracture_toughness(carbide):
    solution, contacts = carbide
    one = max(contacts, key=lambda contact: contact.load)
    depth = critical_flaw(solution.bearing, one)
    ring = 1.12 * 2.0 / pi * edge_tension(solution.bearing, one) * sqrt(pi * depth)
    assert ring == pytest.approx(solution.bearing.inner_ring_material.fracture_toughness, rel=1e-12)


def test_the_weaker_body_decides():
    """Balls of silicon nitride in rings of steel, then of a tough and of a brittle ceramic."""
    depths = []
    for rings in ("bearing steel", "zirconia", "alumina"):
        solution, contacts = solved(rings, "silicon nitride")
        one = max(contacts, key=lambda contact: contact.load)
        depths.append(critical_flaw(solution.bearing, one))
    assert depths[2] < depths[0]


def test_a_heavier_load_opens_smaller_cracks(carbide):
    light = contact_strength(*carbide, 0.0)
    heavy = contact_strength(*solved("silicon carbide", "silicon nitride", 8000.0), 0.0)
    assert heavy.critical_flaw < light.critical_flaw
    assert heavy.edge_tension > light.edge_tension
    assert heavy.low_safety == pytest.approx(light.low_safety / 8.0, rel=1e-9)


def test_makers_rate_ceramic_by_the_bearing_of_steel():
    bearing = made_of(load_bearing("6206"), "silicon carbide", "silicon carbide")
    rated = static_rating(made_of(bearing, "bearing steel", "bearing steel"), 0.0)
    assert makers_static_rating(bearing, 0.0) == pytest.approx((0.65 * rated, 0.75 * rated))


def test_safety_is_the_rating_over_the_equivalent_load(carbide):
    found = contact_strength(*carbide, 0.0)
    assert found.load == pytest.approx(1000.0, rel=1e-6)  # a radial load
    assert (found.low_safety, found.high_safety) == pytest.approx(tuple(r / 1000.0 for r in found.rating), rel=1e-6)


def test_strength_over_the_tension_at_the_rims(carbide):
    """Ring and ball of one material: the largest tension decides; by the ends of its strength."""
    found = contact_strength(*carbide, 0.0)
    material = load_material("silicon carbide")
    ends = (material.bending_strength, *material.bending_strength_range)
    assert found.rim_safety == pytest.approx(tuple(end / found.edge_tension for end in ends))
    without = replace(material, bending_strength=None, bending_strength_range=None)
    solution, contacts = carbide
    bare = replace(
        solution,
        bearing=replace(
            solution.bearing, inner_ring_material=without, outer_ring_material=without, ball_material=without
        ),
    )
    assert contact_strength(bare, contacts, 0.0).rim_safety is None


def test_steel_rings_have_none():
    assert contact_strength(*solved("bearing steel", "silicon nitride"), 0.0) is None


@pytest.mark.parametrize("name", ["silicon carbide", "alumina", "zirconia mg"])
def test_ceramics_have_what_strength_needs(name):
    material = load_material(name)
    for field in ("bending_strength", "weibull_modulus", "fracture_toughness"):
        low, high = getattr(material, f"{field}_range")
        assert low <= getattr(material, field) <= high
    assert material.thermal_expansion
    assert material.thermal_conductivity

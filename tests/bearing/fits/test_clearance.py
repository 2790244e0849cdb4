"""Clearance budget: Lame's closed forms, an independent solution of ring on shaft, signs, and refusals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import Operation, Race, load_material
from oilfilm.bearing.fits.clearance import (
    Fit,
    TemperatureRise,
    cage_clearance,
    centrifugal_growth,
    clearance_budget,
    groove_diameters,
)

STEEL, CERAMIC = load_material("bearing steel"), load_material("silicon nitride")
STILL = Operation(inner_speed=0.0)
UM = 1e-6


@pytest.fixture(scope="module")
def b6208(bearings):
    parts = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), STEEL)
    return replace(bearings.b6208, bore=0.04, outside_diameter=0.08, **parts)


def fit(**fields):
    return Fit(**({"shaft_material": STEEL, "housing_material": STEEL} | fields))


def test_a_solid_shaft_of_the_same_material(b6208):
    """The raceway grows by delta d/d_i, the seat's pressure is E delta (d_i^2 - d^2)/(2 d d_i^2)."""
    delta, bore = 12.0 * UM, 0.04
    bottom, _ = groove_diameters(b6208)
    budget = clearance_budget(b6208, STILL, fit(inner_interference=delta))
    assert budget.initial == b6208.diametral_clearance
    assert budget.mounted - budget.initial == pytest.approx(-delta * bore / bottom, rel=1e-9)
    pressure = STEEL.youngs_modulus * delta * (bottom**2 - bore**2) / (2.0 * bore * bottom**2)
    assert budget.inner_pressure == pytest.approx(pressure, rel=1e-9)
    assert budget.operating == budget.mounted


def test_a_thick_housing_of_the_same_material(b6208):
    """In an infinite housing the outer raceway shrinks by delta d_o/D, Lame."""
    delta = 10.0 * UM
    _, top = groove_diameters(b6208)
    budget = clearance_budget(b6208, STILL, fit(outer_interference=delta, housing_outside_diameter=100.0))
    assert budget.mounted - budget.initial == pytest.approx(-delta * top / 0.08, rel=1e-5)


def test_a_thin_ring_grows_by_rho_omega2_r3_over_e():
    growth = centrifugal_growth(STEEL, 0.1, 0.0999, 1000.0)
    assert growth == pytest.approx(2.0 * STEEL.density * 1000.0**2 * 0.05**3 / STEEL.youngs_modulus, rel=2e-3)


def ring_on_shaft(radii, materials, interference, omega, warmings):
    """Diameter growth at the far radius: u = A r + B/r - (1 - nu^2) rho omega^2 r^3/(8 E) in each part, solved at once.

    Unknowns A, B of the shaft and of the ring; free bore of the shaft, free raceway, equal radial stress in the seat,
    and a jump of displacement by the interference there.
    """
    s, d, h = radii
    rows, right = np.zeros((4, 4)), np.zeros(4)

    def stress(k, r):
        material, warming = materials[k], warmings[k]
        e, nu = material.youngs_modulus, material.poisson_ratio
        row = np.zeros(4)
        row[2 * k] = e / (1.0 - nu)
        row[2 * k + 1] = -e / (1.0 + nu) / r**2
        body = -(3.0 + nu) / 8.0 * material.density * omega**2 * r**2
        return row, body - e * material.thermal_strain(warming) / (1.0 - nu)

    def displacement(k, r):
        material = materials[k]
        row = np.zeros(4)
        row[2 * k], row[2 * k + 1] = r, 1.0 / r
        nu = material.poisson_ratio
        return row, -(1.0 - nu**2) * material.density * omega**2 * r**3 / (8.0 * material.youngs_modulus)

    (rows[0], b0), (rows[1], b1) = stress(0, s), stress(1, h)
    (shaft, bs), (ring, br) = stress(0, d), stress(1, d)
    (us, cs), (ur, cr) = displacement(0, d), displacement(1, d)
    rows[2], rows[3] = shaft - ring, ur - us
    right[:] = -b0, -b1, br - bs, 0.5 * interference + cs - cr
    scale = np.abs(rows).max(axis=1)
    unknowns = np.linalg.solve(rows / scale[:, None], right / scale)
    far, body = displacement(1, h)
    return 2.0 * (far @ unknowns + body)


def test_hollow_shaft_fast_and_warm_against_one_solution_of_both(b6208):
    """A ceramic ring on a hollow steel shaft, turning and warm: superposition of fit, speed and heat is exact."""
    bearing = replace(b6208, inner_ring_material=CERAMIC)
    bottom, _ = groove_diameters(bearing)
    operation = Operation(inner_speed=2000.0)
    warming = TemperatureRise(inner_ring=40.0, shaft=35.0)
    budget = clearance_budget(bearing, operation, fit(inner_interference=8.0 * UM, shaft_bore=0.02), warming)
    expected = ring_on_shaft(
        (0.01, 0.02, 0.5 * bottom), (STEEL, CERAMIC), 8.0 * UM, operation.inner_speed, (35.0, 40.0)
    )
    assert budget.inner_pressure > 0.0
    assert budget.initial - budget.operating == pytest.approx(expected, rel=1e-9)
    assert budget.initial + budget.inner_fit + budget.thermal + budget.centrifugal == pytest.approx(budget.operating)


def test_signs_of_heat(b6208):
    """Warm balls and inner ring take clearance away, a warm outer ring gives it (one source prints the opposite)."""
    bottom, top = groove_diameters(b6208)
    alpha = STEEL.thermal_expansion
    for part, expected in (("inner_ring", -bottom), ("outer_ring", top), ("ball", -2.0 * b6208.ball_diameter)):
        budget = clearance_budget(b6208, STILL, None, TemperatureRise(**{part: 30.0}))
        assert budget.operating - budget.initial == pytest.approx(alpha * 30.0 * expected, rel=1e-9)
        assert budget.mounted == budget.initial


@pytest.mark.parametrize(("part", "sign"), [("outer_ring", 1.0), ("housing", -1.0), ("shaft", 0.0)])
def test_a_warm_housing_loosens_the_outer_seat(b6208, part, sign):
    """Interference left: 20 um, and alpha D 10 K more by a warm ring, less by a warm housing."""
    seat = fit(outer_interference=20.0 * UM, housing_outside_diameter=0.12)
    budget = clearance_budget(b6208, STILL, seat, TemperatureRise(**{part: 10.0}))
    growth = STEEL.thermal_expansion * 0.08 * 10.0
    assert budget.outer_interference == pytest.approx(20.0 * UM + sign * growth, rel=1e-9)


def test_uniform_warming_scales_the_clearance(b6208):
    warming = TemperatureRise(inner_ring=50.0, outer_ring=50.0, ball=50.0, shaft=50.0, housing=50.0)
    budget = clearance_budget(b6208, STILL, None, warming)
    factor = 1.0 + STEEL.thermal_expansion * 50.0
    assert budget.operating == pytest.approx(factor * budget.initial, rel=1e-9)


def test_a_turning_inner_ring_grows_and_may_come_loose(b6208):
    seat = fit(inner_interference=1.0 * UM)
    slow, fast = (clearance_budget(b6208, Operation(inner_speed=w), seat) for w in (0.0, 6000.0))
    assert slow.centrifugal == 0.0
    assert fast.centrifugal < 0.0
    assert fast.inner_interference < 0.0
    assert fast.inner_pressure == fast.inner_fit == 0.0
    assert any("comes loose" in message for message in fast.messages)
    assert not slow.messages


def test_a_loose_fit_changes_nothing(b6208):
    seat = fit(inner_interference=-5.0 * UM, outer_interference=-5.0 * UM, housing_outside_diameter=0.12)
    assert clearance_budget(b6208, STILL, seat).operating == b6208.diametral_clearance


def test_what_is_left_out_is_told(b6208):
    budget = clearance_budget(replace(b6208, bore=None), Operation(inner_speed=1000.0))
    assert budget.centrifugal == 0.0
    assert "no bore_mm" in budget.messages[0]


@pytest.mark.parametrize(
    ("fields", "changes", "match"),
    [
        ({"inner_interference": UM}, {"bore": None}, "bore is needed"),
        ({"outer_interference": UM}, {}, "housing_outside_diameter"),
        ({"shaft_bore": 0.04}, {}, "shaft_bore"),
        ({"housing_outside_diameter": 0.08}, {}, "housing_outside_diameter"),
        ({"inner_interference": float("nan")}, {}, "inner_interference"),
    ],
)
def test_impossible_fits_are_refused(b6208, fields, changes, match):
    with pytest.raises(ValueError, match=match):
        clearance_budget(replace(b6208, **changes), STILL, fit(**fields))


def test_heat_needs_an_expansion(b6208):
    bare = replace(STEEL, name="mystery", thermal_expansion=None)
    with pytest.raises(ValueError, match="'mystery' has no thermal_expansion"):
        clearance_budget(replace(b6208, ball_material=bare), STILL, None, TemperatureRise(ball=1.0))


def test_a_warm_cage(b6208):
    """PA66 (1e-4/K) 60 K warmer, balls 50 K and rings 55 and 40 K (1.2e-5/K): by hand."""
    cage = replace(load_material("pa66"), thermal_expansion=1e-4)
    steel = replace(STEEL, thermal_expansion=1.2e-5)
    bearing = replace(b6208, ball_material=steel, inner_ring_material=steel, outer_ring_material=steel)
    warming = TemperatureRise(inner_ring=55.0, outer_ring=40.0, ball=50.0)
    outer = cage_clearance(bearing, cage, warming, 60.0, (Race.OUTER, 0.069))
    inner = cage_clearance(bearing, cage, warming, 60.0, (Race.INNER, 0.051))
    assert outer.pocket == pytest.approx(12e-3 * (6e-3 - 6e-4), rel=1e-12)
    assert outer.land == pytest.approx(0.5 * 0.069 * (4.8e-4 - 6e-3), rel=1e-12)
    assert inner.land == pytest.approx(0.5 * 0.051 * (6e-3 - 6.6e-4), rel=1e-12)
    assert cage_clearance(bearing, cage, warming, 60.0, None).land is None


def test_a_cage_like_its_bearing_keeps_its_clearances(b6208):
    same = cage_clearance(b6208, STEEL, TemperatureRise(inner_ring=30.0, ball=30.0), 30.0, (Race.INNER, 0.051))
    assert same.pocket == pytest.approx(0.0, abs=1e-15)
    assert same.land == pytest.approx(0.0, abs=1e-15)

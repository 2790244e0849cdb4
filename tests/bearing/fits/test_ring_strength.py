"""Hoop tension of rings and Weibull's probability: Lame and the disc in closed form, bars that break as they should."""

from __future__ import annotations

from dataclasses import replace
from math import exp, gamma, log, pi

import numpy as np
import pytest
from scipy.integrate import quad

from oilfilm.bearing import Fit, Operation, Race, TemperatureRise, load_material
from oilfilm.bearing.fits.clearance import clearance_budget, groove_diameters
from oilfilm.bearing.fits.ring_strength import (
    RingStrength,
    bar_volume,
    failure_probability,
    ring_strengths,
    strength_map,
)

RPM = pi / 30.0
NITRIDE, STEEL = load_material("silicon nitride"), load_material("bearing steel")
SEAT = Fit(shaft_material=STEEL, housing_material=STEEL, inner_interference=5e-6)


@pytest.fixture(scope="module")
def ceramic(bearings):
    parts = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), NITRIDE)
    return replace(bearings.b6208, **parts, bore=40e-3, outside_diameter=80e-3, width=18e-3)


def inner_ring(bearing, operation, fit=SEAT, rise=None):
    return ring_strengths(bearing, operation, clearance_budget(bearing, operation, fit, rise))[0]


def still(rpm=0.0):
    return Operation(inner_speed=rpm * RPM, force=(0.0, 1000.0, 0.0))


def test_tension_of_a_fit(ceramic):
    """p (b^2 + a^2)/(b^2 - a^2) at the bore, 2 p a^2/(b^2 - a^2) at the groove; p by hand from both bodies."""
    ring = inner_ring(ceramic, still())
    bottom, _ = groove_diameters(ceramic)
    a2, b2 = 0.04**2, bottom**2
    compliance = ((b2 + a2) / (b2 - a2) + NITRIDE.poisson_ratio) / NITRIDE.youngs_modulus
    compliance += (1.0 - STEEL.poisson_ratio) / STEEL.youngs_modulus
    pressure = 5e-6 / (0.04 * compliance)
    assert ring.seat_pressure == pytest.approx(pressure)
    assert ring.hoop_tension == ring.fit_tension == pytest.approx(pressure * (b2 + a2) / (b2 - a2))
    assert ring.groove_tension == pytest.approx(2.0 * pressure * a2 / (b2 - a2))


def test_tension_of_rotation(ceramic):
    """Free: rho w^2 [(3 + nu) b^2 + (1 - nu) a^2]/4; a thin ring of radius r has rho w^2 r^2."""
    ring = ring_strengths(ceramic, still(20000.0), None)[0]
    bottom, _ = groove_diameters(ceramic)
    nu, speed = NITRIDE.poisson_ratio, 20000.0 * RPM
    expected = NITRIDE.density * speed**2 / 4.0 * ((3.0 + nu) * bottom**2 + (1.0 - nu) * 0.04**2) / 4.0
    assert ring.hoop_tension == ring.rotation_tension == pytest.approx(expected)
    thin = ring_strengths(replace(ceramic, bore=bottom - 1e-6), still(20000.0), None)[0]
    assert thin.groove_tension == pytest.approx(NITRIDE.density * (speed * bottom / 2.0) ** 2, rel=1e-3)


def test_a_hot_steel_shaft_pulls_and_a_housing_presses(ceramic):
    warm = TemperatureRise(inner_ring=60.0, shaft=60.0, ball=60.0, outer_ring=60.0, housing=60.0)
    cold, hot = (inner_ring(ceramic, still(), rise=rise) for rise in (None, warm))
    mismatch = (STEEL.thermal_expansion * 60.0 - NITRIDE.thermal_strain(60.0)) * 0.04
    assert hot.hoop_tension / cold.hoop_tension == pytest.approx(1.0 + mismatch / 5e-6)
    tight = replace(SEAT, outer_interference=10e-6, housing_outside_diameter=0.12)
    outer = ring_strengths(ceramic, still(), clearance_budget(ceramic, still(), tight, None))[1]
    assert outer.race is Race.OUTER
    _, top = groove_diameters(ceramic)
    by_lame = -2.0 * outer.seat_pressure * 0.08**2 / (0.08**2 - top**2)  # pressed from outside, at the free surface
    assert outer.hoop_tension == outer.groove_tension == pytest.approx(by_lame)
    assert outer.hoop_tension < 0.0
    assert (outer.failure_probability, outer.strength_share) == (0.0, 0.0)


def test_bars_break_at_their_strength():
    """The bar itself at its median strength breaks in half of all cases; its volume is that of the bending."""
    for modulus in (8.0, 12.0, 20.0):
        scale = 800e6 / gamma(1.0 + 1.0 / modulus)
        median = scale * log(2.0) ** (1.0 / modulus)
        found = failure_probability(median, bar_volume(modulus), 800e6, modulus)
        assert found == pytest.approx(0.5)
        inner, _ = quad(lambda z, m=modulus: z**m, 0.0, 1.0)  # over half the depth, from the neutral axis
        outer, _ = quad(lambda x, m=modulus: x**m, 0.0, 1.0)  # between inner and outer rollers
        expected = 3e-3 * 2e-3 * inner * (20e-3 + 20e-3 * outer)
        assert bar_volume(modulus) == pytest.approx(expected)


def test_probability_of_a_ring(ceramic):
    """Against the integral over the wall by another quadrature; grows with the width as volume does."""
    ring = inner_ring(ceramic, still(9000.0))
    bottom, _ = groove_diameters(ceramic)
    a, b, m = 0.02, bottom / 2.0, NITRIDE.weibull_modulus
    nu, spin = NITRIDE.poisson_ratio, NITRIDE.density * (9000.0 * RPM) ** 2

    def stress(r):
        fit = ring.seat_pressure * a**2 / (b**2 - a**2) * (1.0 + (b / r) ** 2)
        form = a**2 + b**2 + (a * b / r) ** 2 - (1.0 + 3.0 * nu) / (3.0 + nu) * r**2
        return fit + (3.0 + nu) / 8.0 * spin * form

    scale = NITRIDE.bending_strength / gamma(1.0 + 1.0 / m)
    integral, _ = quad(lambda r: (stress(r) / scale) ** m * 2.0 * pi * r * 18e-3, a, b, epsabs=0.0)
    assert ring.failure_probability == pytest.approx(1.0 - exp(-integral / bar_volume(m)), rel=1e-6, abs=1e-16)
    assert ring.failure_low < ring.failure_probability < ring.failure_high
    wide = inner_ring(replace(ceramic, width=36e-3), still(9000.0))
    assert wide.effective_volume == pytest.approx(2.0 * ring.effective_volume)
    assert inner_ring(replace(ceramic, width=None), still()).failure_probability is None


def test_steel_has_a_tension_and_no_probability(ceramic):
    ring = inner_ring(replace(ceramic, inner_ring_material=STEEL), still())
    assert ring.hoop_tension > 0.0
    assert (ring.failure_probability, ring.strength_share) == (None, None)


def test_map(ceramic):
    """The map's points are those of rings computed there; parts warm in proportion."""
    rise = TemperatureRise(inner_ring=40.0, shaft=50.0, ball=45.0, outer_ring=30.0, housing=30.0)
    found = strength_map(ceramic, still(10000.0), SEAT, rise, 293.15)
    assert found.temperature[0] == 293.15
    assert found.speed[-1] == pytest.approx(15000.0 * RPM)
    assert (np.diff(found.hoop_tension, axis=0) > 0.0).all()
    double = TemperatureRise(inner_ring=80.0, shaft=100.0, ball=90.0, outer_ring=60.0, housing=60.0)
    at = int(np.argmin(abs(found.temperature - 373.15)))
    ring = inner_ring(ceramic, still(15000.0), rise=double)
    assert found.hoop_tension[at, -1] == pytest.approx(ring.hoop_tension)
    assert found.failure_high[at, -1] == pytest.approx(ring.failure_high)
    assert strength_map(replace(ceramic, bore=None), still(), None, None, 293.15) is None
    unknown = replace(STEEL, thermal_expansion=None)
    assert strength_map(ceramic, still(), replace(SEAT, shaft_material=unknown), None, 293.15) is None


def growing(tension, material):
    return RingStrength(
        race=Race.INNER,
        material=material,
        seat_pressure=0.0,
        fit_tension=tension,
        rotation_tension=0.0,
        groove_tension=0.0,
    )


def test_slow_crack_growth_is_the_integral_of_its_law():
    """v = A K^n by steps: a bar under rising tension and a ring under constant tension, the same first crack."""
    n, strength, tension = 20.0, 800e6, 200e6
    steps = 100_000
    step = 1.0 / steps

    def time_of(stress):
        """Time in t_0, K_Ic of the first crack at `strength` in t_0 = 1 gives A."""
        total = 0.0
        for index in range(steps):
            total += step * stress((index + 0.5) * step) ** n
        return total

    damage = time_of(lambda t: strength * t)  # integral of sigma^n dt to the break
    ring = growing(tension, load_material("silicon nitride"))
    assert ring.growth_life(n, strength) == pytest.approx(10.0 * damage / tension**n, rel=1e-6)


def test_ends_of_growth_and_shock_enclose_them():
    ring = growing(100e6, load_material("silicon nitride"))
    assert ring.growth_low < ring.growth < ring.growth_high
    assert ring.shock_low < ring.shock < ring.shock_high
    # 800 MPa (1 - 0.26)/(310 GPa 3.3e-6/K)
    assert ring.shock == pytest.approx(578.7, abs=0.1)
    assert growing(-1e6, load_material("silicon nitride")).growth is None
    assert growing(1e6, load_material("bearing steel")).growth is None

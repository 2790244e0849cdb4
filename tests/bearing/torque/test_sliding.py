"""Sliding torque of bearings: limits, and the models against each other."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    BallKinematics,
    Bearing,
    Material,
    Operation,
    QuasistaticModel,
    contact_conditions,
    solve_quasistatic,
)
from oilfilm.bearing.films.heavy_moment import heavy_moment
from oilfilm.bearing.friction.cage import resisted_power
from oilfilm.bearing.friction.resistance import SHIELDING, Cage, Mixture, hysteresis_torque, resistance_of
from oilfilm.bearing.torque.models import spent_powers
from oilfilm.bearing.torque.paper_models import (
    SlidingContact,
    houpert_torque,
    kakuta_torque,
    pure_rolling_line_torque,
    rolling_lines,
    sliding_contacts,
    spin_moment,
)
from oilfilm.bearing.torque.skf import Series, SkfBearing, SkfOperation, skf_constants, skf_torque
from oilfilm.ehl import ContactConditions, Lubricant

from ...reference.coulomb import coulomb_power, coulomb_torque

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
STEEL = Material(name="steel", youngs_modulus=206e9, poisson_ratio=0.3, density=7800.0, source="test")
RPM = 2.0 * pi / 60.0
B6206 = Bearing(
    name="6206",
    ball_diameter=9.525e-3,
    pitch_diameter=46e-3,
    balls=9,
    inner_groove_radius=0.515 * 9.525e-3,
    outer_groove_radius=0.525 * 9.525e-3,
    diametral_clearance=0.0,
    ball_material=STEEL,
    inner_ring_material=STEEL,
    outer_ring_material=STEEL,
)


def solved(axial, radial, speed=500.0):
    state = solve_quasistatic(B6206, Operation(inner_speed=speed * RPM, force=(axial, radial, 0.0)))
    assert state.converged
    return state, sliding_contacts(state, contact_conditions(state, OIL))


def contact(spin, rolling=300.0, ratio=8.0):
    return SlidingContact(
        load=500.0,
        semi_axis=1e-3,
        semi_axis_rolling=1e-3 / ratio,
        radius=6e-3,
        spin=spin,
        ball_rolling=0.6 * rolling,
        orbit_rolling=0.4 * rolling,
        angle=0.3,
        inner=True,
    )


def test_radial_torque_grows_with_the_five_thirds_power():
    """Without clearance and hardly a centrifugal force: moments Q a^2, a from Q^(1/3), load zone unchanged."""
    torques = [pure_rolling_line_torque(solved(0.0, load, 10.0)[1], 1.0, 0.1).total for load in (500.0, 1000.0)]
    assert torques[1] / torques[0] == pytest.approx(2.0 ** (5 / 3), rel=1e-3)


def test_parts_of_friction_are_never_negative_and_keep_their_sum():
    powers = np.random.default_rng(3).normal((0.0, 0.5, 1.5), size=(40, 3))
    powers = np.vstack([powers[powers.sum(axis=1) > 0.0], np.zeros(3), [-0.2, 0.0, 1.2], [2.0, 1.0, 0.0]])
    parts = spent_powers(powers)
    assert (parts >= 0.0).all()
    np.testing.assert_allclose(parts.sum(axis=1), powers.sum(axis=1), atol=1e-14)
    np.testing.assert_allclose(parts[-2:], [[0.0, 0.0, 1.0], [2.0, 1.0, 0.0]], atol=1e-14)


def test_no_spin_under_radial_load():
    state, contacts = solved(0.0, 1000.0)
    torque = pure_rolling_line_torque(contacts, state.operation.shaft_speed, 0.1)
    assert torque.spin == 0.0
    assert torque.rotation > 0.0
    assert torque.orbit > 0.0


def test_the_two_dimensional_integral_without_spin_is_the_line_model():
    c = contact(0.0)
    lines = rolling_lines(0.0)
    moment = 0.07 * c.load * c.semi_axis**2 / (2.0 * c.radius) * lines.curvature
    assert coulomb_power(c, 0.07) == pytest.approx(moment * c.rolling, rel=2e-3)


def test_the_two_dimensional_integral_of_pure_spin():
    c = contact(200.0, rolling=0.0, ratio=3.0)
    assert coulomb_power(c, 0.07) == pytest.approx(spin_moment(c, 0.07) * c.spin, rel=1e-4)


@pytest.mark.parametrize("spin", [5.0, 30.0, 100.0])
def test_line_model_falls_short_by_the_sliding_across(spin):
    """It leaves out w_s x: always too small; the less, the narrower the contact."""
    shortfalls = []
    for ratio in (2.0, 8.0, 30.0):
        c = contact(spin, ratio=ratio)
        lines = pure_rolling_line_torque([c], 1.0, 0.07).total
        shortfalls.append(1.0 - lines / coulomb_power(c, 0.07))
    assert shortfalls[0] > shortfalls[1] > shortfalls[2] > -1e-3
    assert shortfalls[2] < 0.02


def test_models_side_by_side_under_axial_load():
    """6206, 500 N: Houpert's fits lie within 3 % of the lines, Kakuta above."""
    state, contacts = solved(500.0, 0.0)
    speed = state.operation.shaft_speed
    lines, houpert, kakuta = (
        f(contacts, speed, 0.1) for f in (pure_rolling_line_torque, houpert_torque, kakuta_torque)
    )
    assert houpert.total == pytest.approx(lines.total, rel=0.03)
    assert kakuta.spin > lines.spin  # unsplit, and lines that the spin does not move
    assert kakuta.rotation > lines.rotation
    assert coulomb_torque(contacts, speed, 0.1) > lines.total


def skf_6206(axial, radial):
    """SKF's model of the 6206 at 500 r/min."""
    return skf_torque(
        SkfBearing(
            constants=skf_constants(Series.DEEP_GROOVE, "62"), bore=0.03, outside_diameter=0.062, static_rating=11200.0
        ),
        SkfOperation(radial_load=radial, axial_load=axial, speed=500.0 * RPM, viscosity=20e-6),
    )


def test_friction_of_a_6206_is_that_of_the_sliding_friction_paper_within_its_open_inputs():
    """Axial 500 N, 500 r/min: 26.416 N mm there with mu 0.0935; groove radii and clearance are not given there."""
    skf = skf_6206(500.0, 0.0)
    state, contacts = solved(500.0, 0.0)
    ours = pure_rolling_line_torque(contacts, state.operation.shaft_speed, skf.friction_coefficient).total
    assert 1e3 * ours == pytest.approx(26.416, rel=0.25)


@pytest.mark.parametrize(
    ("kinematics", "tilt", "gap"),
    [
        (BallKinematics.OUTER_RACE_CONTROL, None, -0.064),
        (BallKinematics.HALF_AND_HALF, None, -0.159),
        (BallKinematics.HALF_AND_HALF, 0.0, -0.253),
    ],
)
def test_under_combined_load_the_ring_of_the_sliding_friction_paper_tilts(kinematics, tilt, gap):
    """1000 N axial and radial, 500 r/min: 67.6801 N mm there; its load vector has moments, so its ring tilts."""
    moment = 0.0 if tilt is None else None
    operation = Operation(
        inner_speed=500.0 * RPM, force=(1000.0, 1000.0, 0.0), moment=(moment, moment), tilt=(tilt, tilt)
    )
    state = solve_quasistatic(B6206, operation, QuasistaticModel(ball_kinematics=kinematics))
    assert state.converged
    if tilt is None:
        assert state.ring_moment == pytest.approx((0.0, 0.0), abs=1e-6)
        assert max(abs(angle) for angle in state.tilt) == pytest.approx(1.67e-3, rel=0.01)
    contacts = sliding_contacts(state, contact_conditions(state, OIL))
    skf = skf_6206(1000.0, 1000.0)
    ours = pure_rolling_line_torque(contacts, 500.0 * RPM, skf.friction_coefficient).total
    assert 1e3 * ours / 67.6801 - 1.0 == pytest.approx(gap, abs=0.001)


def test_rolling_moment_of_the_oil():
    """Biboulet and Houpert (2010), circular contact: beta = (4/pi)(pi/2)/2 = 1."""
    c = ContactConditions(
        load=20.0, radius_x=0.01, radius_y=0.01, reduced_modulus=226e9, entrainment_speed=1.0, lubricant=OIL
    )
    u = 0.0261 / (226e9 * 0.01)
    expected = 2.0 * 1.8 * (2.0 * 1e-4 / 0.01) * (2.0 * u) ** 0.75 * 226e9 * 1e-6
    assert heavy_moment(c, 1e-4, 1e-4) == pytest.approx(expected, rel=1e-12)


def test_hysteresis_is_the_moment_of_the_pressure_ahead():
    """Phi = 3/16 Q b/Rx over the half ellipse: the integral of x p ahead of the centre, 3/16 Q b, by the radius."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    x = 0.5 * (nodes + 1.0)  # p over a strip at x: 3/4 Q/b (1 - x^2)
    assert 0.5 * np.sum(weights * 0.75 * (1.0 - x**2) * x) == pytest.approx(3.0 / 16.0, rel=1e-12)
    state = solve_quasistatic(B6206, Operation(inner_speed=100.0, force=(0.0, 1000.0, 0.0)))
    contacts = contact_conditions(state, OIL)
    torque = hysteresis_torque(state, contacts, 0.01)
    assert torque == pytest.approx(2.0 * hysteresis_torque(state, contacts, 0.005))
    g = 9.525 / 46.0
    phi = sum(3 / 16 * c.load * c.hertz.semi_axis_x / c.hertz.radius_x for c in contacts if c.hertz is not None)
    assert torque == pytest.approx(0.25 * 0.046 * (1.0 - g**2) * phi * 0.01, rel=1e-12)


def test_cage_and_drag():
    state, _ = solved(500.0, 0.0, 5000.0)
    cage = Cage(pocket_friction=0.1, land_diameter=0.05, land_width=0.004, land_clearance=2e-4, outer_guided=False)
    power = resisted_power(state, resistance_of(cage, 0.02))
    slip = 0.025 * abs(state.cage_speed - state.operation.inner_speed)
    assert power.land == pytest.approx(0.02 * slip / 2e-4 * (2 * pi * 0.025 * 0.004) * slip, rel=1e-3)
    assert 0.0 < power.pocket < power.land
    free = resistance_of(replace(cage, land_diameter=None), 0.02)
    assert resisted_power(state, free).land == 0.0


def test_drag_of_a_ball_in_oil_has_its_limits():
    """Stokes' drag and the moment of a sphere in creeping flow (to a third: the law is of Re above 20), White's
    coefficient of a lone sphere at Re = 1e5, all times the shielding; in proportion to the oil's share.
    """
    creeping = Mixture(oil_share=1.0, density=900.0, viscosity=100.0, ball_radius=0.005)
    stokes = 6.0 * pi * 100.0 * 0.005 * 0.01
    assert creeping.drag(np.array([0.01, -0.01])) == pytest.approx(SHIELDING * stokes * np.array([1.0, -1.0]), rel=1e-2)
    turned = creeping.spin_drag(np.array([[0.0, 0.01, 0.0]]))[0]
    assert turned[[0, 2]] == pytest.approx(0.0)
    assert turned[1] == pytest.approx(SHIELDING * 8.0 * pi * 100.0 * 0.005 * 0.01, rel=0.4)
    thin = replace(creeping, viscosity=900.0 * 0.01 * 100.0 / 1e5)
    expected = SHIELDING * (6.0 / (1.0 + sqrt(1e5)) + 0.4) * 0.5 * 900.0 * pi * 0.005**2 * 1e4
    assert thin.drag(np.array([100.0]))[0] == pytest.approx(expected, rel=1e-3)
    assert replace(thin, oil_share=0.02).drag(np.array([100.0]))[0] == pytest.approx(
        0.02 * thin.drag(np.array([100.0]))[0]
    )


@pytest.mark.parametrize("reynolds", [0.01, 1.0, 7.8, 8.0, 1e4])
def test_a_ball_that_spins_in_oil(reynolds):
    """C_M = 6.45/sqrt(Re) + 32.1/Re on rho r^5 w^2/2 (Dennis, Singh and Ingham, 1980), about each axis; Stokes' 8 pi
    eta r^3 w where that is more.
    """
    radius, density, viscosity, share = 0.006, 870.0, 0.02, 0.3
    speed = reynolds * viscosity / (density * radius**2)
    surface = radius * speed * np.array([[1.0, 0.0, 0.0], [0.0, -0.6, 0.8]])
    mixture = Mixture(oil_share=share, density=density, viscosity=viscosity, ball_radius=radius)
    moment = 0.5 * density * radius**5 * speed**2 * (6.45 / reynolds**0.5 + 32.1 / reynolds)
    stokes = 8.0 * pi * viscosity * radius**3 * speed
    assert (stokes > moment) == (reynolds < 7.9)
    moment = max(moment, stokes)
    found = radius * mixture.spin_drag(surface)
    assert_allclose(found, SHIELDING * share * moment * surface / (radius * speed), rtol=1e-12)

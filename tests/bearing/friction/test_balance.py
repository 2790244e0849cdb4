"""Balls balanced by Coulomb friction: potentials against closed forms, equilibrium, energy."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import ellipe

from oilfilm.bearing import (
    BallKinematics,
    Bearing,
    Material,
    Operation,
    QuasistaticModel,
    contact_conditions,
    solve_quasistatic,
)
from oilfilm.bearing.contacts.motion import ball_speeds
from oilfilm.bearing.friction import balance
from oilfilm.bearing.friction.coulomb import Ellipses, balanced_friction, ellipse_sums, line_sums
from oilfilm.bearing.torque.paper_models import rolling_lines
from oilfilm.ehl import Lubricant

from ...reference.coulomb import coulomb_dissipation_twin as reference

OIL = Lubricant(viscosity=0.0174, pressure_viscosity=18e-9)
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
HALF, OUTER = BallKinematics.HALF_AND_HALF, BallKinematics.OUTER_RACE_CONTROL


def ellipses(ratio=8.0, rounding=1e-9):
    """One contact: 500 N, a = 1 mm across, R = 6 mm, mu = 0.07."""
    values = {"load": 500.0, "semi_axis_x": 1e-3 / ratio, "semi_axis_y": 1e-3, "radius": 6e-3, "friction": 0.07}
    return Ellipses(rounding=np.array([rounding]), **{name: np.array([value]) for name, value in values.items()})


def solved(axial, radial, speed, kinematics=HALF):
    operation = Operation(inner_speed=speed * RPM, force=(axial, radial, 0.0))
    state = solve_quasistatic(B6206, operation, QuasistaticModel(ball_kinematics=kinematics))
    assert state.converged
    return state, contact_conditions(state, OIL)


@pytest.mark.parametrize("law", [line_sums, ellipse_sums])
@pytest.mark.parametrize("motion", [(0.002, 0.0, 5.0, 300.0), (-0.01, 0.004, -20.0, 300.0), (0.02, 0.1, 40.0, -200.0)])
def test_friction_is_the_slope_of_its_power_and_the_power_is_convex(law, motion):
    k, e = np.array([motion]), ellipses(rounding=1e-4).numbers
    found = law(k, e)
    for j, size in enumerate((1e-2, 1e-2, 10.0, 300.0)):
        step = np.zeros((1, 4))
        step[0, j] = 1e-5 * size
        ahead, behind = law(k + step, e), law(k - step, e)
        slope = (ahead.power - behind.power) / (2.0 * step[0, j])
        scale = 0.07 * 500.0 * abs(np.array([1.0, 1.0, 1e-3, 1e-6 / 12e-3])[j])
        assert slope[0] == pytest.approx(found.gradient[0, j], abs=1e-6 * scale)
        bend = (ahead.gradient - behind.gradient)[0] / (2.0 * step[0, j])
        assert bend == pytest.approx(found.curvature[0, j], rel=1e-4, abs=1e-6 * scale / size)
    assert np.linalg.eigvalsh(found.curvature[0]).min() >= -1e-9 * np.abs(found.curvature).max()


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.6, 1.5])
def test_line_law_at_the_lines_of_no_force(ratio):
    """Motion with the roots c_1 and -c_2 gives F = 0, m_s and S of `rolling_lines`."""
    lines, a, radius, rolling = rolling_lines(ratio), 1e-3, 6e-3, 300.0
    bend = rolling * a**2 / (2.0 * radius)
    motion = np.array([[bend * lines.first * lines.second, 0.0, bend * (lines.second - lines.first) / a, rolling]])
    force, _, spin, curvature = -line_sums(motion, ellipses().numbers).gradient[0]
    friction = 0.07 * 500.0
    assert force == pytest.approx(0.0, abs=1e-12 * friction)
    assert abs(spin) == pytest.approx(friction * a * lines.spin_moment, abs=1e-12 * friction * a)
    assert abs(curvature) == pytest.approx(friction * a**2 / (2 * radius) * lines.curvature, rel=1e-9)


def test_compiled_coulomb_friction_agrees_with_its_twin():
    """To round-off of sums over some four hundred nodes; an unloaded contact has none."""
    rng = np.random.default_rng(61283)
    contacts = Ellipses(
        load=np.array([500.0, 0.0, 20.0]),
        semi_axis_x=np.array([1e-4, 1e-6, 2e-4]),
        semi_axis_y=np.array([1e-3, 1e-6, 3e-4]),
        radius=np.array([6e-3, 6e-3, -7e-3]),
        friction=np.array([0.07, 0.07, 0.1]),
        rounding=np.array([1e-4, 1e-300, 1e-3]),
    )
    motion = rng.normal(size=(3, 4)) * [0.05, 0.05, 50.0, 500.0]
    found, twin = ellipse_sums(motion, contacts.numbers), reference(motion, contacts)
    for part, other in zip(found, twin, strict=True):
        assert_allclose(part, other, rtol=1e-11, atol=1e-13 * np.abs(other[0]).max())
        assert np.abs(part[[0, 2]]).min(axis=0).max() > 0.0
        assert not part[1].any()


def test_pure_spin_over_the_ellipse():
    """3/8 mu Q a E(k), exact for Coulomb friction about the centre."""
    for ratio in (1.0, 3.0, 10.0):
        spin = -ellipse_sums(np.array([[0.0, 0.0, 100.0, 0.0]]), ellipses(ratio).numbers).gradient[0, 2]
        assert abs(spin) == pytest.approx(0.375 * 0.07 * 500.0 * 1e-3 * ellipe(1.0 - ratio**-2), rel=2e-3)


def test_narrow_ellipse_is_the_line_law():
    motion = np.array([[0.002, 0.0, 5.0, 300.0]])
    exact = line_sums(motion, ellipses().numbers).power[0]
    shortfalls = [1.0 - exact / ellipse_sums(motion, ellipses(r, 2e-5).numbers).power[0] for r in (3.0, 10.0, 100.0)]
    assert shortfalls[0] > shortfalls[1] > shortfalls[2]
    assert shortfalls[2] == pytest.approx(0.0, abs=2e-3)


@pytest.mark.parametrize(("axial", "radial"), [(500.0, 0.0), (1000.0, 1000.0)])
def test_balance_closes_the_energy_and_forgets_the_hypothesis(axial, radial):
    """The rings' power is the heat; the motion does not depend on the race control that the loads were found with."""
    torques = []
    for kinematics in (HALF, OUTER):
        state, contacts = solved(axial, radial, 500.0, kinematics)
        for lines in (True, False):
            found = balanced_friction(state, contacts, 0.1, lines=lines)
            assert found.converged
            assert found.energy_error == pytest.approx(0.0, abs=1e-6)
            torques.append(found.power.sum() / state.operation.shaft_speed)
    assert torques[2] == pytest.approx(torques[0], rel=2e-4)
    assert torques[3] == pytest.approx(torques[1], rel=2e-4)
    assert 0.97 < torques[0] / torques[1] < 1.0  # lines leave out the sliding across


def test_the_gyroscopic_couple_is_the_change_of_the_angular_momentum():
    """J w_m e_x x w by the cross product, for balls that also turn about the tangent; it is linear in the rotation."""
    state = solve_quasistatic(B6206, Operation(inner_speed=9000.0 * RPM, force=(600.0, 300.0, 0.0)))
    pivot = np.linspace(-80.0, 120.0, state.azimuth.size)
    state = replace(state, pivot_speed=pivot)
    orbit, rotation = ball_speeds(state)
    couple, matrix = balance._gyroscopic(state, np.ones(orbit.size, dtype=bool))
    inertia = 7800.0 * np.pi / 60.0 * B6206.ball_diameter**5
    turned = inertia * orbit[:, None] * np.cross([1.0, 0.0, 0.0], rotation)  # along x, e_r, e_t
    half = 0.5 * B6206.ball_diameter
    assert_allclose(couple[:, 1:] * half, turned, rtol=1e-12, atol=1e-15)
    assert_allclose(np.einsum("bij,bj->bi", matrix[:, 1:, 1:], half * rotation), couple[:, 1:], rtol=1e-12, atol=1e-12)
    assert not balance._gyroscopic(state, np.zeros(orbit.size, dtype=bool))[0].any()


def test_balance_with_gyroscopic_couple():
    """At 15000 r/min the couple turns the balls across; the energy still closes, since it does no work."""
    state, contacts = solved(500.0, 0.0, 15000.0)
    held, free = (balanced_friction(state, contacts, 0.1, gyroscopic=g) for g in (True, False))
    assert held.converged
    assert held.energy_error == pytest.approx(0.0, abs=1e-5)
    assert np.abs(held.kinematics[..., 1]).max() > 100.0 * np.abs(free.kinematics[..., 1]).max()
    couple = 0.5 * B6206.ball_diameter * (held.forces[:, 1, 1] - held.forces[:, 0, 1])  # x runs opposite ways
    assert couple == pytest.approx(state.gyroscopic_moment, rel=0.05)  # that of the hypothesis


def test_friction_too_small_for_the_couple_turns_the_axis_until_there_is_none():
    """The ball then turns about an axis parallel to the bearing's: J w_m w_R sin(beta) is what the friction holds."""
    state, contacts = solved(500.0, 0.0, 15000.0)
    found = balanced_friction(state, contacts, 1e-4)
    assert found.converged
    assert found.energy_error == pytest.approx(0.0, abs=1e-5)
    turn = np.array([motion.rotation for motion in found.motions])
    orbit = np.array([motion.orbit_speed for motion in found.motions])
    assert np.abs(turn[:, 1] / turn[:, 0]).max() < 1e-3
    inertia = pi / 60.0 * B6206.ball_material.density * B6206.ball_diameter**5
    couple = 0.5 * B6206.ball_diameter * (found.forces[:, 1, 1] - found.forces[:, 0, 1])
    assert couple == pytest.approx(inertia * orbit * turn[:, 1], rel=0.01)  # the orbit taken is the hypothesis'
    assert (np.abs(couple) < 0.1 * np.abs(state.gyroscopic_moment)).all()


def test_radial_load_splits_the_curvature_slip_in_balance():
    """Without spin the force on each side of the ball is that of the two curvature moments, F D = m_i + m_o."""
    state, contacts = solved(0.0, 1000.0, 10.0)
    found = balanced_friction(state, contacts, 0.1, lines=True)
    loaded = state.inner_load > 50.0
    assert found.energy_error == pytest.approx(0.0, abs=1e-6)  # with the balls that the cage pushes
    push = np.abs(found.forces[loaded, :, 0])
    moments = np.abs(found.forces[loaded, :, 3]).sum(axis=1)
    assert push[:, 0] == pytest.approx(push[:, 1], rel=1e-6)
    assert push[:, 0] * B6206.ball_diameter == pytest.approx(moments, rel=2e-2)
    doubled = balanced_friction(*solved(0.0, 2000.0, 10.0), 0.1, lines=True)
    ratio = doubled.power.sum() / found.power.sum()
    assert ratio == pytest.approx(2.0 ** (5 / 3), rel=3e-3)  # not exact: the force over mu Q grows with a^2

"""Sliding, shear and their integrals.

Sources: Johnson, Contact Mechanics (1985), for the couple of a spinning circle; the line model of Heathcote slip with
constant friction as re-derived for deep groove bearings, F = mu Q [1 - 3/2 (c1+c2) + 1/2 (c1^3+c2^3)] with the roots
at c of the semi-axis; Biboulet and Houpert (2010), rolling moment in the limit of high load.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import ellipe

from oilfilm import ehl
from oilfilm.ehl.conditions import ContactKinematics, contact_kinematics
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.traction.shear import Cavitation, integrate_traction, shear_fields, sheared_width

NEWTON = Rheology()
MU = 0.05
RIGID_PLASTIC = Rheology(limiting_coefficient=MU, limiting_minimum=1.0)
THICK = ehl.Lubricant(viscosity=1e6, pressure_viscosity=0.0, viscosity_law=ehl.ViscosityLaw.ISOVISCOUS)


def test_velocities_are_those_of_two_rigid_bodies():
    """v = v_centre + omega x r on the surface z = -y^2/(2R), tangential parts; sliding is their difference."""
    rng = np.random.default_rng(20431)
    spins, rollings = rng.normal(size=2), rng.normal(size=2)
    centre = rng.normal(size=(2, 2))
    radius, x, y = 0.7, rng.normal(size=30), rng.normal(size=30)
    place = np.stack([x, y, -(y**2) / (2.0 * radius)], axis=1)
    expected = [
        centre[body] + np.cross([0.0, rollings[body], spins[body]], place)[:, :2] for body in range(2)
    ]  # no angular speed about x
    mean, slide = centre.mean(axis=0), centre[0] - centre[1]
    kinematics = ContactKinematics(
        entrainment_speed=mean[0],
        entrainment_lateral=mean[1],
        sliding_x=slide[0],
        sliding_y=slide[1],
        spin=spins[0] - spins[1],
        mean_spin=spins.mean(),
        rolling=rollings[0] - rollings[1],
        mean_rolling=rollings.mean(),
        curvature_radius=radius,
    )
    middle = np.stack(kinematics.entrainment(x, y), axis=1)
    sliding = np.stack(kinematics.sliding(x, y), axis=1)
    assert_allclose(middle + 0.5 * sliding, expected[0], rtol=1e-12, atol=1e-12)
    assert_allclose(middle - 0.5 * sliding, expected[1], rtol=1e-12, atol=1e-12)


def test_kinematics_of_conditions_turn_into_the_frame_of_the_grid(conditions):
    c = replace(conditions, entrainment_angle=0.3, slide_roll_ratio=0.1, lateral_slide_ratio=-0.02, spin=7.0)
    along, turned = contact_kinematics(c), contact_kinematics(c, grid_angle=0.0)
    assert_allclose(along.sliding_x, 1.508)
    assert_allclose(along.entrainment_lateral, 0.0)
    assert_allclose(np.hypot(turned.sliding_x, turned.sliding_y), np.hypot(along.sliding_x, along.sliding_y))
    assert_allclose(np.arctan2(turned.entrainment_lateral, turned.entrainment_speed), 0.3)
    assert along.spin == turned.spin == 7.0
    assert along.mean_spin == 3.5


@pytest.mark.parametrize("field", ["sliding_x", "spin", "curvature_radius"])
def test_bad_kinematics_name_the_field(field):
    with pytest.raises(ValueError, match=field):
        ContactKinematics(**{"entrainment_speed": 1.0, field: float("nan")})


def test_curvature_slip_ends_at_the_width_of_the_ellipse():
    motion = ContactKinematics(entrainment_speed=1.0, rolling=2.0, curvature_radius=0.5, curvature_width=0.3)
    assert_allclose(motion.sliding(np.zeros(3), np.array([0.1, 0.3, -0.7]))[0], [-0.02, -0.18, -0.18])


def test_couette_flow_between_parallel_walls(hertzian):
    """F = eta S A/h and heat = F S; the ball is held back where it is the faster one."""
    film, slide = 2e-6, np.array([0.3, -0.4])
    oil = replace(THICK, viscosity=0.01)
    solution = hertzian(film=film, lubricant=oil)
    area = 4.0 * solution.semi_axis_x**2 * solution.semi_axis_ratio
    motion = ContactKinematics(entrainment_speed=15.08, sliding_x=slide[0], sliding_y=slide[1])
    result = integrate_traction(solution, motion, NEWTON, cavitation=Cavitation.FULL_WIDTH)
    force = np.array([result.sliding_force_x, result.sliding_force_y])
    assert_allclose(force, -0.01 * slide * area / film, rtol=1e-12)
    assert_allclose(result.sliding_loss, -force @ slide, rtol=1e-12)
    assert_allclose(result.coefficient, np.hypot(*force) / 500.0, rtol=1e-12)


def test_film_all_at_its_limiting_stress_rubs_like_coulomb(hertzian):
    solution = hertzian(lubricant=THICK)
    motion = ContactKinematics(entrainment_speed=15.08, sliding_x=0.3, sliding_y=0.4)
    result = integrate_traction(solution, motion, RIGID_PLASTIC, cavitation=Cavitation.NONE)
    assert_allclose(result.coefficient, MU, rtol=1e-4)  # trapezoidal rule at the rim of the ellipse
    assert_allclose(result.force_y / result.force_x, 4.0 / 3.0, rtol=1e-9)


def test_spin_of_a_circle_under_coulomb_friction(hertzian):
    """M = 3 pi/16 mu Q a, against the spin of body 1."""
    solution = hertzian(lubricant=THICK, radius_y=4.8e-3)
    motion = ContactKinematics(entrainment_speed=15.08, spin=500.0)
    result = integrate_traction(solution, motion, RIGID_PLASTIC, cavitation=Cavitation.NONE)
    assert_allclose(result.spin_moment, -3.0 * pi / 16.0 * MU * 500.0 * solution.semi_axis_x, rtol=1e-4)
    assert abs(result.force_x) < 1e-9


def test_heathcote_slip_with_constant_friction(hertzian):
    """Force-free rolling has its roots at 0.347296 of the semi-axis; moment mu Q b^2/(2R) 0.161142 about y."""
    solution = hertzian(lubricant=THICK, points=1601)
    b = solution.semi_axis_x * solution.semi_axis_ratio
    radius, rolling, root = 6.083e-3, 3000.0, 0.347296
    motion = ContactKinematics(
        entrainment_speed=15.08,
        sliding_x=rolling * (root * b) ** 2 / (2.0 * radius),
        rolling=rolling,
        curvature_radius=radius,
    )
    result = integrate_traction(solution, motion, RIGID_PLASTIC, cavitation=Cavitation.NONE)
    scale = MU * 500.0
    assert abs(result.sliding_force_x) < 2e-3 * scale  # a grid of 1601 lines across
    assert_allclose(result.curvature_moment, -scale * b**2 / (2.0 * radius) * 0.161142, rtol=2e-3)


def motion_of(conditions, **changes):
    ball, race = 2.0 / 12e-3, 1.0 / conditions.radius_x - 2.0 / 12e-3
    rolled = contact_kinematics(conditions, curvature_radius=6.083e-3)
    slide = changes.get("sliding_x", 0.0)
    difference = race - ball
    rolling = conditions.entrainment_speed / conditions.radius_x - 0.5 * slide * difference
    return replace(rolled, curvature_difference=difference, rolling=rolling, **changes)


@pytest.mark.parametrize(
    "rheology",
    [
        NEWTON,
        Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6, limiting_coefficient=0.047),
        Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=7e6, carreau_exponent=0.46),
    ],
    ids=["newtonian", "eyring limited", "carreau"],
)
def test_forces_and_power_balance(solution, conditions, rheology):
    """Forces on the film sum to zero; power of the rigid motion is the heat of sliding and what pumping takes."""
    motion = motion_of(conditions, sliding_x=0.02, sliding_y=-0.01, spin=40.0)
    result = integrate_traction(solution, motion, rheology)
    # deflection of the grid is antisymmetric to round-off; the corners of the outlet carry 1e-5 p_h
    assert abs(result.force_balance_error) < 2e-7
    assert result.power_balance_error < 1e-12
    power = (
        result.force_x * motion.sliding_x
        + result.force_y * motion.sliding_y
        + result.spin_moment * motion.spin
        + result.rolling_moment_1 * motion.rolling
    )
    assert_allclose(result.power_loss, -power, rtol=1e-12)
    assert result.power_loss > 0.0


def test_tractions_on_both_surfaces(solution, conditions):
    """Their difference is the Couette part, their sum is -h grad p: the rheology does not enter it."""
    motion = motion_of(conditions, sliding_x=0.02)
    fields = shear_fields(solution, motion, NEWTON)
    assert_allclose(fields.body_2_x - fields.body_1_x, 2.0 * fields.couette_x, rtol=1e-9, atol=1e-3)
    gradient = np.gradient(solution.pressure, solution.x, axis=0)
    assert_allclose(fields.body_1_x + fields.body_2_x, -solution.film * gradient, rtol=1e-9, atol=1e-3)
    assert np.all(fields.heat >= 0.0)


def test_pumping_takes_the_rolling_moment(solution, conditions):
    """Integral of h u.grad p and what crosses the edges of the box are the moment times the rolling speed."""
    result = integrate_traction(solution, motion_of(conditions), NEWTON)
    x, y, p, h = solution.x, solution.y, solution.pressure, solution.film
    inside = np.trapezoid(np.trapezoid(h * np.gradient(p, x, axis=0), y, axis=1), x)
    edges = np.trapezoid(p[-1] * h[-1] - p[0] * h[0], y)
    assert_allclose(result.pumping_loss, 15.08 * (inside - edges), rtol=1e-5)


@pytest.mark.parametrize(("radius_ratio", "load", "speed"), [(10.0, 500.0, 1.5), (45.0, 500.0, 5.0)])
def test_rolling_moment_in_the_limit_of_high_load(radius_ratio, load, speed):
    """t = 1.8 beta^(-1/4) (2 b/Rx) (2U)^(3/4) E' Rx^3 is Rx times the pumping force on one body, half the moment.

    5 %: the fit, and the box, with whose logarithm the moment grows.
    """
    c = replace(
        ehl.ContactConditions(
            load=load,
            radius_x=4.8e-3,
            radius_y=4.8e-3 * radius_ratio,
            reduced_modulus=230e9,
            entrainment_speed=speed,
            lubricant=ehl.Lubricant(viscosity=0.0261, pressure_viscosity=18e-9),
        )
    )
    solution = ehl.solve_contact(c, ehl.SolverOptions(points=513, domain=(-8.0, 1.6, 5.5)))
    result = integrate_traction(solution, contact_kinematics(c), NEWTON)
    a, k = solution.semi_axis_x, solution.semi_axis_ratio
    beta = 4.0 / pi * ellipe(1.0 - 1.0 / k**2) / (1.0 + 1.0 / radius_ratio)
    u = 0.0261 * speed / (c.reduced_modulus * c.radius_x)
    t = 1.8 * beta**-0.25 * (2.0 * a * k / c.radius_x) * (2.0 * u) ** 0.75 * c.reduced_modulus * c.radius_x**3
    assert_allclose(-0.5 * result.hydrodynamic_moment, t, rtol=0.05)
    assert_allclose(-result.pumping_force_x * c.radius_x, t, rtol=0.05)


def test_strips_behind_the_contact_carry_the_film_of_the_rupture(solution):
    p, h = solution.pressure, solution.film
    width = sheared_width(h, p, Cavitation.STRIATED)
    middle = h.shape[1] // 2
    last = np.flatnonzero(p[:, middle] > 0.0)[-1]
    assert np.all(width[: last + 1, middle] == 1.0)
    assert_allclose(width[last + 1 :, middle] * h[last + 1 :, middle], h[last, middle], rtol=1e-12)
    assert np.all(sheared_width(h, p, Cavitation.NONE) == (p > 0.0))


def test_moes_conditions_are_refused(conditions):
    oil = ehl.Lubricant(viscosity=0.02, pressure_viscosity=2e-8)
    groups = ehl.MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=oil)
    solution = ehl.solve_contact(groups, ehl.SolverOptions(points=65))
    with pytest.raises(ValueError, match="dimensional"):
        integrate_traction(solution, ContactKinematics(entrainment_speed=1.0), NEWTON)

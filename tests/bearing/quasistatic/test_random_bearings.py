"""Random bearings, loads, speeds and hypotheses: every one converges or says why there is no equilibrium."""

from __future__ import annotations

from dataclasses import replace
from math import asin, pi, radians

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    Arrangement,
    Bearing,
    Curvature,
    Material,
    Operation,
    QuasistaticModel,
    Race,
    Row,
    contact_angle_to_clearance,
    duplex,
    reduced_radii,
    solve_quasistatic,
)
from oilfilm.bearing.geometry import contact_modulus
from oilfilm.bearing.operation import HYPOTHESES
from oilfilm.ehl.closed_form.hertz import hertz_coefficients

SMALLEST, LARGEST = 3e-3, 30e-3  # ball diameters [m]


def random_bearing(rng):
    """Deep groove with play, or angular contact of 5 to 45 degrees; conformities 0.51 to 0.54; steel or ceramic."""
    ball = np.exp(rng.uniform(np.log(SMALLEST), np.log(LARGEST)))
    pitch = ball * rng.uniform(3.5, 8.0)
    balls = int(min(rng.integers(6, 32), np.floor(pi / asin(ball / pitch))))
    inner, outer = rng.uniform(0.51, 0.54, 2) * ball
    play = rng.uniform(1e-4, 2e-3) * ball
    if rng.random() < 0.5:
        play = contact_angle_to_clearance(radians(rng.uniform(5.0, 45.0)), inner, outer, ball)
    body = Material(
        name="random",
        youngs_modulus=rng.choice([206e9, 310e9]),
        poisson_ratio=0.28,
        density=rng.choice([3250.0, 7850.0]),
    )
    return Bearing(
        name="random",
        ball_diameter=ball,
        pitch_diameter=pitch,
        balls=balls,
        inner_groove_radius=inner,
        outer_groove_radius=outer,
        diametral_clearance=play,
        ball_material=body,
        inner_ring_material=body,
        outer_ring_material=body,
        first_ball_azimuth=rng.choice([0.0, rng.uniform(0.0, 6.0)]),
    )


def load_at(bearing, pressure):
    """Load of the inner contact [N] at a Hertz pressure [Pa]."""
    radius_x, radius_y = reduced_radii(bearing, Race.INNER, 0.0)
    modulus = contact_modulus(bearing, Race.INNER)
    return (pressure / modulus / hertz_coefficients(radius_x / radius_y)[1]) ** 3 * modulus * radius_x**2


def random_operation(rng, bearing, highest_dn):
    """Radial, axial, combined, moments with free tilt, preload by displacement, given tilt; 0.3 to 4 GPa."""
    share = load_at(bearing, rng.uniform(0.3e9, 4e9)) * bearing.balls
    axial = share * np.sin(max(bearing.free_contact_angle, 0.1)) * rng.choice([-1.0, 1.0])
    arm = 0.5 * bearing.pitch_diameter
    kind = rng.integers(0, 6)
    fields = {"force": (0.0, 0.2 * share, 0.0)}
    if kind == 1:
        fields = {"force": (axial, 0.0, 0.0)}
    elif kind == 2:
        fields = {"force": (rng.uniform(0.1, 1.0) * axial, *(0.1 * share * rng.normal(size=2)))}
    elif kind == 3:
        moment = tuple(0.02 * share * arm * rng.normal(size=2))
        fields = {"force": (0.5 * axial, 0.05 * share, 0.0), "moment": moment, "tilt": (None, None)}
    elif kind == 4:
        preload = bearing.free_axial_position + rng.uniform(1e-4, 2e-3) * bearing.ball_diameter
        fields = {"force": (None, 0.05 * share, 0.0), "displacement": (preload, None, None)}
    elif kind == 5:
        fields = {"force": (0.5 * axial, 0.05 * share, 0.0), "tilt": tuple(5e-4 * rng.normal(size=2))}
    dn = rng.choice([0.0, rng.uniform(0.0, highest_dn)])  # [mm rpm]
    speed = dn / (1e3 * bearing.pitch_diameter) * pi / 30.0 * rng.choice([-1.0, 1.0])
    return Operation(inner_speed=speed, outer_speed=rng.choice([0.0, 0.0, -0.5, 1.0]) * speed, **fields)


def random_model(rng):
    return QuasistaticModel(ball_kinematics=rng.choice(list(HYPOTHESES)), curvature=rng.choice(list(Curvature)))


def check(solution):
    """A converged solution carries its loads: 1e-10 of the largest contact load, plus rounding of positions."""
    assert solution.message
    if not solution.converged:
        assert "equilibrium" in solution.message or "floats" in solution.message
        return
    assert np.isfinite(solution.stiffness).all()
    scale = max(solution.inner_load.max(), *(abs(load or 0.0) for load in solution.operation.force))
    for found, wanted in zip(solution.ring_force, solution.operation.force, strict=True):
        if wanted is not None:
            assert_allclose(found, wanted, atol=1e-9 * scale)
    assert (solution.outer_load[solution.inner_load > 0.0] > 0.0).all()


@settings(max_examples=40, deadline=None, derandomize=True)
@given(seed=st.integers(0, 2**32 - 1))
def test_random_bearings_are_in_equilibrium_or_say_why_not(seed):
    rng = np.random.default_rng(seed)
    bearing = random_bearing(rng)
    check(solve_quasistatic(bearing, random_operation(rng, bearing, 3e6), random_model(rng)))


def wide_bearing(rng):
    """Three balls and more, conformities 0.505 to 0.56, interference to 60 degrees of free angle."""
    plain = random_bearing(rng)
    ball = plain.ball_diameter
    inner, outer = rng.uniform(0.505, 0.56, 2) * ball
    balls = int(min(rng.integers(3, 40), np.floor(pi / asin(ball / plain.pitch_diameter))))
    play = rng.uniform(-0.02, 1.0) * (inner + outer - ball)
    if rng.random() < 0.5:
        play = contact_angle_to_clearance(radians(rng.uniform(5.0, 45.0)), inner, outer, ball)
    return replace(plain, balls=balls, inner_groove_radius=inner, outer_groove_radius=outer, diametral_clearance=play)


def random_rows(rng, bearing):
    """One row, or every fourth time a pair with a preload of a 1 GPa contact or less."""
    if rng.random() < 0.75:
        return (Row(),)
    arrangement, distance = rng.choice(list(Arrangement)), rng.uniform(1.2, 6.0) * bearing.ball_diameter
    force = 0.1 * 10.0 ** rng.uniform(-1.0, 0.0) * load_at(bearing, 1e9) * bearing.balls
    return duplex(bearing, arrangement, distance, preload_force=force)


OUTSIDE = ("passes 80 degrees", "wider than the ball", "floats")
ADVICE = ("of the centrifugal forces of the balls", "rings turning against each other", "wider than the ball")
ADVICE += ("check the loads for a direction",)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3301])
def test_five_hundred_wide_bearings(seed):
    """Any outer-ring speed, pairs, and geometries no one makes: 19 of 20 converge, each of the others gives advice.

    No balance is found (1 %) mostly for loads far below the centrifugal forces and for rings turning against each
    other; the rest lies outside the model: beyond 80 degrees, or ellipses wider than the ball.
    """
    rng = np.random.default_rng(seed)
    lost, outside = [], 0
    for _ in range(500):
        bearing = wide_bearing(rng)
        operation = random_operation(rng, bearing, 3e6)
        if rng.random() < 0.4:
            operation = replace(operation, outer_speed=rng.uniform(-1.0, 1.0) * operation.inner_speed)
        model, rows = random_model(rng), random_rows(rng, bearing)
        solution = solve_quasistatic(bearing, operation, model, rows=rows)
        check(solution)
        if not solution.converged:
            outside += any(words in solution.message for words in OUTSIDE)
            lost += [solution.message] if "equilibrium found" in solution.message else []
    assert all(any(words in message for words in ADVICE) for message in lost), lost
    assert len(lost) <= 10
    assert outside <= 30


@pytest.mark.slow
def test_five_hundred_bearings():
    """From rest to dn 3e6 at 0.3 to 4 GPa: at most 1 % without equilibrium; up to dn 1e6, nearly all (99.5 %) have one.

    Those without are light thrust against heavy centrifugal force, where the balls climb out of the groove.
    """
    converged = {1e6: [], 3e6: []}
    for highest, found in converged.items():
        rng = np.random.default_rng(270817)
        for _ in range(250):
            bearing = random_bearing(rng)
            solution = solve_quasistatic(bearing, random_operation(rng, bearing, highest), random_model(rng))
            check(solution)
            found.append(solution.converged)
    assert np.mean(converged[1e6]) >= 0.995
    assert np.mean(converged[3e6]) >= 0.99

"""Properties any equilibrium must have: balance, tangent, symmetry, limits, and an honest word where there is none."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import BallKinematics, Curvature, Operation, QuasistaticModel, solve_quasistatic
from oilfilm.bearing.operation import HYPOTHESES
from oilfilm.bearing.quasistatic._kernels import differentiated
from oilfilm.bearing.quasistatic.balls import _kernel_arguments, _prescribed, ball_problem, ball_state, solve_balls
from oilfilm.bearing.quasistatic.kinematics import PrescribedBalls
from oilfilm.bearing.quasistatic.ring import ring_of

from ...reference.balls import balances_twin, ball_balance, solve_balls_twin

FREE = (None, None)
COMBINED = {"force": (900.0, 700.0, -300.0), "moment": (2.0, -5.0), "tilt": FREE}


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_ring_and_balls_are_in_balance(bearings, kinematics):
    """The contact forces, put together anew from loads and angles, hold the load and each ball to 1e-10."""
    operation = Operation(inner_speed=15000.0 * bearings.rpm, **COMBINED)
    solution = solve_quasistatic(bearings.b7008, operation, QuasistaticModel(ball_kinematics=kinematics))
    assert solution.converged
    assert solution.residual < 1e-10
    assert_allclose(solution.ring_force, operation.force, atol=1e-10 * 900.0)
    assert_allclose(solution.ring_moment, operation.moment, atol=1e-10 * 900.0 * 0.03)
    inner_part = {"outer race control": 0.0, "inner race control": 2.0, "half and half": 1.0}[kinematics.value]
    friction = solution.gyroscopic_moment / solution.bearing.ball_diameter
    si, ci = np.sin(solution.inner_contact_angle), np.cos(solution.inner_contact_angle)
    so, co = np.sin(solution.outer_contact_angle), np.cos(solution.outer_contact_angle)
    qi, qo, li, lo = solution.inner_load, solution.outer_load, inner_part, 2.0 - inner_part
    full = 2.0 * np.abs(friction) < 0.2 * np.minimum(qi, qo)  # where the races can give the friction
    assert full.sum() >= 9
    axial = qi * si - qo * so + friction * (li * ci - lo * co)
    radial = qi * ci - qo * co - friction * (li * si - lo * so) + solution.centrifugal_force
    assert_allclose(axial[full], 0.0, atol=1e-10 * qo.max())
    assert_allclose(radial[full], 0.0, atol=1e-10 * qo.max())


def test_gyroscopic_friction_is_tangential_and_gives_the_couple(bearings):
    """Friction at both contacts has no normal part and turns the ball by +Mg about e_t: the sign of the couple."""
    problem = ball_problem(bearings.b218, 1000.0, 0.0, QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF))
    u = 1.01 * problem.outer_length * np.array([[np.sin(0.6)], [np.cos(0.6)]])
    w = 1.01 * problem.inner_length * np.array([[np.sin(0.8)], [np.cos(0.8)]])
    state = ball_state(u, w, problem)
    total = ball_balance(state, problem)
    none = 0.0 * state.inner_friction
    still = ball_balance(state._replace(inner_friction=none, outer_friction=none), problem)
    on_ball_inner = -(total - still)[2:4, 0]
    on_ball_outer = (total - still)[:2, 0] - on_ball_inner
    n_inner, n_outer = -np.array([np.sin(0.8), np.cos(0.8)]), np.array([np.sin(0.6), np.cos(0.6)])
    scale = state.gyroscopic_moment[0] / problem.ball_diameter
    assert state.gyroscopic_moment[0] > 0.0
    assert_allclose([on_ball_inner @ n_inner, on_ball_outer @ n_outer], 0.0, atol=1e-11 * scale)
    arm = 0.5 * problem.ball_diameter
    couple = sum(arm * (n[0] * f[1] - n[1] * f[0]) for n, f in ((n_inner, on_ball_inner), (n_outer, on_ball_outer)))
    assert couple == pytest.approx(state.gyroscopic_moment[0], rel=1e-10)
    lever, on_ring = problem.inner_groove_radius * n_inner, -on_ball_inner  # from the groove's centre to the contact
    assert total[4, 0] == pytest.approx(lever[0] * on_ring[1] - lever[1] * on_ring[0], rel=1e-10)


@pytest.mark.parametrize("prescribed", [False, True])
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_compiled_balance_agrees_with_its_twin(bearings, kinematics, prescribed):
    """Balls pressed, free, off the groove and beyond its edge: 1e-13 of the largest of each row."""
    problem = ball_problem(bearings.b218, 1000.0, -80.0, QuasistaticModel(ball_kinematics=kinematics))
    generator = np.random.default_rng(20261127)
    angles = generator.uniform([-0.3, -0.5], [1.55, 1.6], (400, 2)).T
    lengths = np.array([problem.outer_length, problem.inner_length])[:, None] * generator.uniform(0.98, 1.02, (2, 400))
    lengths[1, :5] *= 0.3
    u, w = (size * np.stack([np.sin(a), np.cos(a)]) for size, a in zip(lengths, angles, strict=True))
    if prescribed:
        names = [field.name for field in fields(PrescribedBalls)]
        motion = dict(zip(names, generator.uniform(1.0, 2.0, (len(names), 400)), strict=True))
        problem = replace(problem, prescribed=PrescribedBalls(**motion))
    known, given = _prescribed(problem, 400), _kernel_arguments(problem)
    found, slopes = np.empty((400, 6)), np.empty((400, 6, 4))
    sizes = [
        differentiated(*at, given, values, slope)
        for *at, values, slope in zip(u.T, (u + w).T, known, found, slopes, strict=True)
    ]
    values, size, jacobian = balances_twin(u, u + w, problem)
    assert_allclose(sizes, size, rtol=1e-12)
    for own, other in zip((*found.T, *slopes.transpose(1, 2, 0)), (*values, *jacobian), strict=True):
        assert_allclose(own, other, rtol=1e-11, atol=1e-13 * np.abs(other).max())


@pytest.mark.parametrize("speed", [0.0, 300.0, 1500.0])
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_compiled_equilibrium_agrees_with_its_twin(bearings, kinematics, speed):
    """Balls pressed by 0.3 to 60 um, free, floating and past the groove's edge, all to round-off of their loads."""
    problem = ball_problem(bearings.b218, speed, -0.1 * speed, QuasistaticModel(ball_kinematics=kinematics))
    generator = np.random.default_rng(20261201)
    approach = np.exp(generator.uniform(np.log(3e-7), np.log(6e-5), 300)) * generator.choice([-1.0, 1.0, 1.0], 300)
    angle = generator.uniform(-0.2, 1.3, 300)
    V = (problem.inner_length + problem.outer_length + approach) * np.stack([np.sin(angle), np.cos(angle)])
    found, other = (solve(V, None, problem) for solve in (solve_balls, solve_balls_twin))
    balanced = (found.residual < 1e-11) & (other.residual < 1e-11)
    assert_allclose(found.residual < 1e-11, other.residual < 1e-11)
    assert balanced.mean() > 0.6
    for name, scale in (("u", problem.outer_length), ("values", None), ("du_dV", 1.0), ("ring_dV", None)):
        own, twin = (getattr(state, name)[..., balanced] for state in (found, other))
        scale = np.abs(twin).max() if scale is None else scale
        assert_allclose(own, twin, rtol=1e-8, atol=1e-10 * scale)


@pytest.mark.parametrize("kinematics", HYPOTHESES)
@pytest.mark.parametrize("curvature", Curvature)
def test_stiffness_is_the_derivative_of_the_load(bearings, kinematics, curvature):
    """Central differences of displacement-controlled solves, away from contact loss: 1e-6 of the largest entry.

    The step balances truncation against round-off: 2e-9 of the groove distance A, errors about 1e-8.
    """
    model = QuasistaticModel(ball_kinematics=kinematics, curvature=curvature)
    bearing = bearings.b7008
    operation = Operation(inner_speed=12000.0 * bearings.rpm, **{**COMBINED, "force": (2500.0, 300.0, -100.0)})
    base = solve_quasistatic(bearing, operation, model)
    assert base.converged
    assert (base.inner_load > 0.0).all()
    position = np.concatenate([base.displacement, base.tilt])
    scale = np.array([1.0, 1.0, 1.0, bearing.inner_centre_radius, bearing.inner_centre_radius])
    differences = np.empty((5, 5))
    for k in range(5):
        loads = []
        for sign in (1.0, -1.0):
            moved = position.copy()
            moved[k] += sign * 2e-9 / scale[k]
            held = solve_quasistatic(bearing, _held(operation, moved), model)
            loads.append(np.concatenate([held.ring_force, held.ring_moment]))
        differences[:, k] = (loads[0] - loads[1]) * scale[k] / 4e-9
    unit = np.outer(scale, scale)
    assert_allclose(differences / unit, base.stiffness / unit, atol=1e-6 * np.abs(base.stiffness / unit).max())


def test_stiffness_without_speed_is_symmetric(bearings):
    """At rest and with the curvature of the free angle the contact forces have a potential."""
    operation = Operation(inner_speed=0.0, **COMBINED)
    solution = solve_quasistatic(bearings.b7008, operation, QuasistaticModel(curvature=Curvature.FREE))
    scale = np.array([1.0, 1.0, 1.0, 0.03, 0.03])
    scaled = solution.stiffness / np.outer(scale, scale)
    assert_allclose(scaled, scaled.T, atol=1e-9 * np.abs(scaled).max())
    assert np.linalg.eigvalsh(scaled).min() > 0.0


def test_loads_and_displacements_are_interchangeable(bearings):
    """Holding the ring where a load has put it returns the load."""
    operation = Operation(inner_speed=9000.0 * bearings.rpm, **COMBINED)
    loaded = solve_quasistatic(bearings.b7008, operation)
    held = solve_quasistatic(bearings.b7008, _held(operation, np.concatenate([loaded.displacement, loaded.tilt])))
    assert held.converged
    assert_allclose(held.ring_force, operation.force, atol=1e-8)  # stiffness 1e8 N/m times round-off 1e-17 m, and more
    assert_allclose(held.inner_load, loaded.inner_load, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("speed", [0.0, 10000.0])
def test_pure_radial_load_is_symmetric(bearings, speed):
    """Balls at psi and -psi are equal, nothing moves along the axis, contact angle zero."""
    solution = solve_quasistatic(bearings.b6208, Operation(inner_speed=speed * bearings.rpm, force=(0.0, 3000.0, 0.0)))
    assert solution.converged
    assert_allclose(solution.inner_load[1:], solution.inner_load[:0:-1], rtol=1e-12)
    assert_allclose(solution.inner_contact_angle[solution.inner_load > 0.0], 0.0, atol=1e-15)
    assert solution.displacement[0] == 0.0
    assert abs(solution.displacement[2]) < 1e-18
    assert solution.inner_load @ np.cos(solution.azimuth) == pytest.approx(3000.0, rel=1e-9)


def test_axial_load_is_shared_equally(bearings):
    solution = solve_quasistatic(
        bearings.b218, Operation(inner_speed=10000.0 * bearings.rpm, force=(22250.0, 0.0, 0.0))
    )
    assert_allclose(solution.inner_load, solution.inner_load[0], rtol=1e-12)
    assert_allclose(solution.orbit_speed, solution.cage_speed, rtol=1e-12)


def test_reversed_thrust_is_the_mirror_image(bearings):
    one, two = (
        solve_quasistatic(bearings.b7008, Operation(inner_speed=500.0, force=(sign * 800.0, 200.0, 0.0)))
        for sign in (1.0, -1.0)
    )
    assert_allclose(one.inner_load, two.inner_load, rtol=1e-10)
    assert_allclose(one.inner_contact_angle, -two.inner_contact_angle, rtol=1e-10)
    assert_allclose(one.displacement, two.displacement * [-1.0, 1.0, 1.0], rtol=1e-9, atol=1e-18)


def test_turning_the_load_turns_the_solution(bearings):
    """Load and balls turned by the same angle: the same loads."""
    angle = 0.7
    turned = replace(bearings.b7008, first_ball_azimuth=angle)
    one = solve_quasistatic(bearings.b7008, Operation(inner_speed=800.0, force=(500.0, 300.0, 0.0)))
    force = (500.0, 300.0 * np.cos(angle), 300.0 * np.sin(angle))
    two = solve_quasistatic(turned, Operation(inner_speed=800.0, force=force))
    assert_allclose(one.inner_load, two.inner_load, rtol=1e-9)


def test_both_rings_turning_as_one_leave_centrifugal_force_only(bearings):
    solution = solve_quasistatic(
        bearings.b7008, Operation(inner_speed=700.0, outer_speed=700.0, force=(400.0, 100.0, 0.0))
    )
    assert_allclose(solution.orbit_speed, 700.0, rtol=1e-12)
    assert_allclose(solution.spin_speed, 0.0, atol=1e-12)
    assert_allclose(solution.gyroscopic_moment, 0.0, atol=1e-15)


def test_at_rest_two_contacts_of_a_ball_are_opposite(bearings):
    """No body force: Qi = Qo, ai = ao; the classical series stiffness of both contacts."""
    solution = solve_quasistatic(bearings.b7008, Operation(inner_speed=0.0, force=(600.0, 300.0, 0.0)))
    loaded = solution.inner_load > 0.0
    assert_allclose(solution.inner_load, solution.outer_load, rtol=1e-10, atol=1e-9)
    assert_allclose(solution.inner_contact_angle[loaded], solution.outer_contact_angle[loaded], atol=1e-9)


def test_ball_at_outer_race_alone(bearings):
    """Unloaded at the inner race: centred in the outer groove, Qo = Fc, no couple, rolling on the outer race."""
    solution = solve_quasistatic(bearings.b7008, Operation(inner_speed=2000.0, force=(20.0, 900.0, 0.0)))
    alone = solution.inner_load == 0.0
    assert alone.any()
    assert_allclose(solution.outer_load[alone], solution.centrifugal_force[alone], rtol=1e-10)
    assert_allclose(solution.outer_contact_angle[alone], 0.0, atol=1e-12)
    assert_allclose(solution.gyroscopic_moment[alone], 0.0, atol=1e-12)
    # with the cage, which the loaded balls drive, and without sliding at the outer race
    assert_allclose(solution.orbit_speed[alone], solution.cage_speed, rtol=1e-14)
    gamma = solution.bearing.ball_diameter / solution.bearing.pitch_diameter
    rolling = solution.spin_speed * np.cos(solution.attitude) / (1.0 / gamma + 1.0)
    assert_allclose(rolling[alone], solution.orbit_speed[alone], rtol=1e-12)
    force = 0.5 * ball_problem(solution.bearing, 2000.0, 0.0, solution.model).mass * solution.bearing.pitch_diameter
    assert_allclose(solution.centrifugal_force, force * solution.orbit_speed**2, rtol=1e-12)


def test_hypothesis_that_friction_cannot_hold_is_named(bearings):
    """Inner race control of light balls at speed; under a heavy thrust friction holds every hypothesis."""
    model = QuasistaticModel(ball_kinematics=BallKinematics.INNER_RACE_CONTROL)
    light = solve_quasistatic(bearings.b7008, Operation(inner_speed=3000.0, force=(60.0, 0.0, 0.0)), model)
    assert light.converged
    balls = bearings.b7008.balls
    assert f"inner race control asks more friction than 0.2 of the load of {balls} of {balls} loaded" in light.message
    for kind in HYPOTHESES:
        model = QuasistaticModel(ball_kinematics=kind)
        heavy = solve_quasistatic(bearings.b7008, Operation(inner_speed=300.0, force=(3000.0, 0.0, 0.0)), model)
        assert "friction" not in heavy.message


def test_load_without_a_ball_to_carry_it_is_refused(bearings):
    """No load on the ring: it floats in its play, and the solution says so."""
    solution = solve_quasistatic(bearings.b6208, Operation(inner_speed=1000.0, force=(0.0, 0.0, 0.0)))
    assert not solution.converged
    assert "floats" in solution.message


def test_thrust_beyond_the_groove_is_refused(bearings):
    solution = solve_quasistatic(bearings.b6208, Operation(inner_speed=0.0, force=(3e6, 0.0, 0.0)))
    assert not solution.converged
    assert "no equilibrium" in solution.message


def test_from_rest_to_limiting_speed(bearings):
    """No tuning, no failure, and continuity: the inner angle grows with speed, the outer one falls."""
    inner, outer = [], []
    for speed in np.linspace(0.0, 3e6 / 54.0, 12):  # dn up to 3e6
        operation = Operation(inner_speed=speed * bearings.rpm, force=(400.0, 0.0, 0.0))
        solution = solve_quasistatic(bearings.b7008, operation)
        assert solution.converged
        assert solution.residual < 1e-10
        inner.append(solution.inner_contact_angle[0])
        outer.append(solution.outer_contact_angle[0])
    assert (np.diff(inner) > 0.0).all()
    assert (np.diff(outer) < 0.0).all()


def test_ball_positions_follow_from_the_ring(bearings):
    """The groove centres' distance at each ball is that of the displaced rigid ring."""
    operation = Operation(inner_speed=1000.0, **COMBINED)
    solution = solve_quasistatic(bearings.b7008, operation)
    ring = ring_of(bearings.b7008, operation)
    c, s = bearings.b7008.azimuth_directions
    V = ring.position(np.concatenate([solution.displacement, solution.tilt * ring.scale[3:]]))
    (ty, tz), radius = solution.tilt, bearings.b7008.inner_centre_radius
    assert_allclose(V[0], solution.displacement[0] + radius * (ty * s - tz * c), rtol=1e-12)
    gap = np.hypot(V[0] - solution.ball_axial, V[1] - (solution.ball_radial - bearings.b7008.outer_centre_radius))
    approach = gap - (bearings.b7008.inner_groove_radius - 0.5 * bearings.b7008.ball_diameter)
    assert ((approach > 0.0) == (solution.inner_load > 0.0)).all()


def _held(operation, position):
    return Operation(
        inner_speed=operation.inner_speed,
        outer_speed=operation.outer_speed,
        force=(None,) * 3,
        moment=FREE,
        displacement=tuple(position[:3]),
        tilt=tuple(position[3:]),
    )


def test_an_absurd_load_is_called_so(bearings):
    """10 MN on a 6208: not a ring that nothing holds, but ellipses wider than the ball."""
    solution = solve_quasistatic(bearings.b6208, Operation(inner_speed=1047.2, force=(0.0, 1e7, 0.0)))
    assert not solution.converged
    assert "wider than the ball" in solution.message

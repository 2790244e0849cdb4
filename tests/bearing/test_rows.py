"""Rows on one ring: the single row among them, known limits of pairs, tangent and balance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from oilfilm.bearing import (
    Arrangement,
    Operation,
    QuasistaticModel,
    RatingInput,
    Row,
    bearing_life,
    contact_conditions,
    duplex,
    load_material,
    preloaded_row,
    solve_quasistatic,
)
from oilfilm.bearing.geometry import SINGLE
from oilfilm.bearing.operation import HYPOTHESES
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.models import skf_model
from oilfilm.ehl import Lubricant

WIDTH = 16e-3  # [m]
FREE = (None, None)


def pair(bearing, arrangement=Arrangement.BACK_TO_BACK, force=300.0):
    return duplex(bearing, arrangement, WIDTH, preload_force=force)


def test_the_outer_groove_lies_behind_the_inner_one_of_a_loaded_row():
    """By the offset: a push of the inner ring to +x loads the row where the outer groove stands farther to -x."""
    assert Row(axial_position=0.02, offset=3e-3).outer_plane == pytest.approx(0.017)


def test_tandem_rows_share_alike(bearings):
    """Two rows in tandem under a thrust and a held tilt: each as one row under half of it, to the last digits."""
    one = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(500.0, 150.0, 0.0)))
    rows = duplex(bearings.b7008, Arrangement.TANDEM, WIDTH)
    two = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(1000.0, 300.0, 0.0)), rows=rows)
    assert two.converged
    assert_allclose(two.inner_load.reshape(2, -1), np.stack([one.inner_load] * 2), rtol=1e-9, atol=1e-9)
    assert two.displacement[0] + rows[0].offset == pytest.approx(one.displacement[0], rel=1e-9)
    assert_allclose(two.row_load[:, :3], [one.ring_force] * 2, atol=1e-7)


def test_skf_s_torque_of_a_set_is_that_of_its_bearings(bearings):
    """SKF's catalogue computes paired bearings one by one and adds; a preload counts as a load."""
    oil = Lubricant(viscosity=0.03, pressure_viscosity=2e-8)
    friction = FrictionInput(series="other single row", static_rating=1e4)
    b7008 = replace(bearings.b7008, bore=0.04, outside_diameter=0.068)

    def total(force, rows):
        loads = solve_quasistatic(b7008, Operation(inner_speed=300.0, force=force), rows=rows)
        return skf_model(loads, oil, friction)["skf"].total

    one = total((500.0, 150.0, 0.0), SINGLE)
    tandem = total((1000.0, 300.0, 0.0), duplex(b7008, Arrangement.TANDEM, WIDTH))
    assert tandem == pytest.approx(2.0 * one, rel=1e-6)
    assert total((0.0, 50.0, 0.0), pair(b7008, force=600.0)) > 1.2 * total((0.0, 50.0, 0.0), pair(b7008))


@pytest.mark.parametrize("arrangement", [Arrangement.BACK_TO_BACK, Arrangement.FACE_TO_FACE])
def test_preload_is_the_force_in_both_rows(bearings, arrangement):
    still = solve_quasistatic(bearings.b7008, Operation(inner_speed=0.0), rows=pair(bearings.b7008, arrangement))
    assert still.converged
    assert_allclose(still.displacement, 0.0, atol=1e-14)
    sign = 1.0 if arrangement is Arrangement.BACK_TO_BACK else -1.0
    assert_allclose(still.row_load[:, 0], [sign * 300.0, -sign * 300.0], rtol=1e-9)


def test_preload_by_displacement_and_by_force_agree(bearings):
    by_force = preloaded_row(bearings.b7008, 0.0, -1, preload_force=300.0)
    further = -by_force.offset - bearings.b7008.free_axial_position
    by_length = preloaded_row(bearings.b7008, 0.0, -1, preload_displacement=further)
    assert by_length.offset == pytest.approx(by_force.offset, rel=1e-12)
    with pytest.raises(ValueError, match="one of them"):
        preloaded_row(bearings.b7008, 0.0, 1, preload_force=1.0, preload_displacement=1e-6)


def test_axial_load_on_a_preloaded_pair(bearings):
    """The pair is two springs about the preload: each row's force is that of one row at its own displacement."""
    rows = pair(bearings.b7008)
    for load in (100.0, 700.0, 1500.0):
        found = solve_quasistatic(bearings.b7008, Operation(inner_speed=500.0, force=(load, 0.0, 0.0)), rows=rows)
        assert found.converged
        x = found.displacement[0]
        for row, sense in zip(found.row_load, (1.0, -1.0), strict=True):
            held = Operation(
                inner_speed=500.0, force=(None, 0.0, 0.0), displacement=(rows[0].offset + sense * x, None, None)
            )
            assert sense * row[0] == pytest.approx(
                solve_quasistatic(bearings.b7008, held).ring_force[0], rel=1e-7, abs=1e-6
            )
        assert found.row_load[:, 0].sum() == pytest.approx(load, rel=1e-9)


def test_unloading_of_the_second_row(bearings):
    """At constant contact angle F goes with displacement^1.5, and a row unloads at 2^1.5 times the preload.

    The contact angle falls as the row unloads, which takes a few percent.
    """
    steep = bearings.make((7.0, 54.0), 18, (3.99, 3.78), (206.0, 0.3, 7850.0), angle=40.0)
    rows = pair(steep)

    def second_row(load):
        return solve_quasistatic(steep, Operation(inner_speed=0.0, force=(load, 0.0, 0.0)), rows=rows).row_load[1, 0]

    assert second_row(2.6 * 300.0) < -1.0
    assert abs(second_row(3.0 * 300.0)) < 1e-9


def hertz_constant(bearing, groove, side, angle):
    """Q/delta^1.5 [N/m^1.5] of one race, Hertz by complete elliptic integrals; side is 1 inside, -1 outside."""
    d, dm = bearing.ball_diameter, bearing.pitch_diameter
    curvatures = np.array(
        [2.0 / d, 2.0 / d, side * 2.0 * np.cos(angle) / (dm - side * d * np.cos(angle)), -1.0 / groove]
    )
    total = curvatures.sum()
    ratio = (curvatures[2] - curvatures[3]) / total

    def of_ellipse(k):
        first, second = ellipk(1.0 - k**-2.0), ellipe(1.0 - k**-2.0)
        return ((k * k + 1.0) * second - 2.0 * first) / ((k * k - 1.0) * second) - ratio

    k = brentq(of_ellipse, 1.0001, 200.0)
    first, second = ellipk(1.0 - k**-2.0), ellipe(1.0 - k**-2.0)
    steel = bearing.ball_material
    modulus = steel.youngs_modulus / (1.0 - steel.poisson_ratio**2) / 2.0
    approach = 2.0 * first / np.pi * (np.pi / (2.0 * k * k * second)) ** (1.0 / 3.0)
    return (approach * (3.0 / (2.0 * total * modulus)) ** (2.0 / 3.0) * 0.5 * total) ** -1.5


def thrust(bearing, displacement):
    """Axial force [N] of a resting row pushed so far [m] beyond first touch: Z K (s - A)^1.5 sin(alpha)."""
    if displacement <= 0.0:
        return 0.0
    free, distance = bearing.free_contact_angle, bearing.curvature_centre_distance
    axial, radial = distance * np.sin(free) + displacement, distance * np.cos(free)
    angle = np.arctan2(axial, radial)
    races = ((bearing.inner_groove_radius, 1.0), (bearing.outer_groove_radius, -1.0))
    both = sum(hertz_constant(bearing, groove, side, angle) ** (-2.0 / 3.0) for groove, side in races) ** -1.5
    return bearing.balls * both * (np.hypot(axial, radial) - distance) ** 1.5 * np.sin(angle)


def test_preloaded_pair_follows_the_closed_form(bearings):
    """Back to back at rest: displacement under thrust from two curves F(x) of one row, unloading included."""
    bearing, preload = bearings.b7008, 200.0
    start = brentq(lambda x: thrust(bearing, x) - preload, 1e-9, 1e-3)
    rows = duplex(bearing, Arrangement.BACK_TO_BACK, WIDTH, preload_force=preload)
    for load in (100.0, 300.0, 500.0, 700.0):

        def unbalanced(x, load=load):
            return thrust(bearing, start + x) - thrust(bearing, start - x) - load

        expected = brentq(unbalanced, 0.0, 1e-3, xtol=1e-15)
        found = solve_quasistatic(bearing, Operation(inner_speed=0.0, force=(load, 0.0, 0.0)), rows=rows)
        assert found.converged
        assert found.displacement[0] == pytest.approx(expected, rel=1e-5)
        pushed = sorted(abs(found.row_load[:, 0]))
        assert_allclose(pushed, [thrust(bearing, start - expected), thrust(bearing, start + expected)], rtol=1e-4)


def test_back_to_back_is_stiffer_against_tilt(bearings):
    """Lines of force that meet far apart: levers L/2 + R tan(a) against L/2 - R tan(a)."""
    operation = Operation(inner_speed=0.0, moment=(0.0, 0.0), tilt=FREE)
    tilt = {
        arrangement: solve_quasistatic(
            bearings.b7008, operation, rows=pair(bearings.b7008, arrangement, 800.0)
        ).stiffness[4, 4]
        for arrangement in (Arrangement.BACK_TO_BACK, Arrangement.FACE_TO_FACE)
    }
    assert tilt[Arrangement.BACK_TO_BACK] > 2.0 * tilt[Arrangement.FACE_TO_FACE] > 0.0


def test_rows_in_one_plane_are_the_sum(bearings):
    """Two rows at the origin without offset are two bearings side by side: twice the load at the same displacement."""
    held = Operation(
        inner_speed=700.0, force=(None,) * 3, moment=FREE, displacement=(3e-4, 1.0e-5, -4e-6), tilt=(2e-4, -3e-4)
    )
    one = solve_quasistatic(bearings.b7008, held)
    two = solve_quasistatic(bearings.b7008, held, rows=(Row(), Row()))
    assert_allclose(two.ring_force, 2.0 * one.ring_force, rtol=1e-12)
    assert_allclose(two.ring_moment, 2.0 * one.ring_moment, rtol=1e-12)
    assert_allclose(two.stiffness, 2.0 * one.stiffness, rtol=1e-9, atol=1.0)


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_stiffness_of_a_pair_is_the_derivative_of_its_load(bearings, kinematics):
    """As for one row: central differences, 1e-6 of the largest entry, turning, tilted, all balls loaded."""
    bearing, model, rows = (
        bearings.b7008,
        QuasistaticModel(ball_kinematics=kinematics),
        pair(bearings.b7008, force=1500.0),
    )
    operation = Operation(
        inner_speed=12000.0 * bearings.rpm, force=(300.0, 200.0, -100.0), moment=(1.0, -2.0), tilt=FREE
    )
    base = solve_quasistatic(bearing, operation, model, rows=rows)
    assert base.converged
    assert (base.inner_load > 0.0).all()
    position, scale = np.concatenate([base.displacement, base.tilt]), np.array([1.0, 1.0, 1.0, 0.027, 0.027])
    differences = np.empty((5, 5))
    for k in range(5):
        loads = []
        for sign in (1.0, -1.0):
            moved = position.copy()
            moved[k] += sign * 2e-9 / scale[k]
            held = replace(
                operation, force=(None,) * 3, moment=FREE, displacement=tuple(moved[:3]), tilt=tuple(moved[3:])
            )
            found = solve_quasistatic(bearing, held, model, rows=rows)
            loads.append(np.concatenate([found.ring_force, found.ring_moment]))
        differences[:, k] = (loads[0] - loads[1]) * scale[k] / 4e-9
    unit = np.outer(scale, scale)
    assert_allclose(differences / unit, base.stiffness / unit, atol=1e-6 * np.abs(base.stiffness / unit).max())


def test_external_load_is_the_sum_of_the_rows(bearings):
    operation = Operation(inner_speed=900.0, force=(200.0, 800.0, 50.0), moment=(3.0, -6.0), tilt=FREE)
    found = solve_quasistatic(bearings.b7008, operation, rows=pair(bearings.b7008))
    assert found.converged
    assert_allclose(found.row_load[:, :3].sum(axis=0), operation.force, atol=1e-7)
    assert_allclose(found.row_load[:, 3:].sum(axis=0), operation.moment, atol=1e-8)


def test_a_load_off_the_middle_goes_by_the_lever(bearings):
    """Rows far apart and free to tilt: a radial load at a quarter of the distance splits 3 to 1, rows as supports."""
    bearing, rows = bearings.b6208, (Row(axial_position=-0.125), Row(axial_position=0.375))
    found = solve_quasistatic(
        bearing, Operation(inner_speed=0.0, force=(0.0, 2000.0, 0.0), tilt=FREE, moment=(0, 0)), rows=rows
    )
    assert found.converged
    assert_allclose(found.row_load[:, 1], [1500.0, 500.0], rtol=1e-2)


def test_turned_round_a_pair_is_its_mirror_image(bearings):
    """DB seen from the other side: x and tilts about y, z with the rows' places change sign."""
    rows = pair(bearings.b7008)
    one = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(200.0, 300.0, 0.0)), rows=rows)
    two = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(-200.0, 300.0, 0.0)), rows=rows)
    assert_allclose(two.inner_load.reshape(2, -1)[::-1], one.inner_load.reshape(2, -1), rtol=1e-9, atol=1e-8)
    assert_allclose(two.displacement, one.displacement * [-1.0, 1.0, 1.0], rtol=1e-8, atol=1e-16)


def test_one_row_of_a_pair(bearings):
    """`row` cuts the balls, the load and the cage of one row out of the whole."""
    rows = (replace(pair(bearings.b7008)[0], first_ball_azimuth=0.1), pair(bearings.b7008)[1])
    whole = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(200.0, 300.0, 0.0)), rows=rows)
    second = whole.row(1)
    assert second.inner_load.size == 18
    assert second.azimuth[0] == 0.0
    assert whole.azimuth[0] == pytest.approx(0.1)
    assert_allclose(second.ring_force, whole.row_load[1, :3])
    assert whole.row(0).cage_speed != pytest.approx(second.cage_speed, rel=1e-6)
    assert list(whole.row_of_ball) == [0] * 18 + [1] * 18


def test_contacts_of_a_pair_lie_on_their_rows(bearings):
    rows = pair(bearings.b7008)
    whole = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(0.0, 300.0, 0.0)), rows=rows)
    contacts = contact_conditions(whole, Lubricant(viscosity=0.03, pressure_viscosity=18e-9))
    assert [c.ball for c in contacts[::2]] == list(range(1, 37))
    assert [c.row for c in contacts] == [1] * 36 + [2] * 36
    middles = [np.mean([c.origin[0] for c in contacts if c.row == row]) for row in (1, 2)]
    assert middles == pytest.approx([-0.5 * WIDTH, 0.5 * WIDTH], abs=0.1 * WIDTH)
    assert middles[0] == pytest.approx(-middles[1])
    assert contacts[0].contact_angle == pytest.approx(-contacts[36].contact_angle, rel=1e-9)


def test_a_neighbour_of_a_pair_is_a_start(bearings):
    rows = pair(bearings.b7008)
    first = solve_quasistatic(bearings.b7008, Operation(inner_speed=900.0, force=(100.0, 300.0, 0.0)), rows=rows)
    operation = Operation(inner_speed=910.0, force=(110.0, 300.0, 0.0))
    cold = solve_quasistatic(bearings.b7008, operation, rows=rows)
    warm = solve_quasistatic(bearings.b7008, operation, initial_guess=first, rows=rows)
    assert warm.iterations < cold.iterations + 1
    assert_allclose(warm.inner_load, cold.inner_load, rtol=1e-8, atol=1e-7)


@pytest.mark.parametrize("field", ["axial_position", "offset"])
def test_impossible_rows_are_refused(field):
    with pytest.raises(ValueError, match=field):
        Row(**{field: float("inf")})


def test_life_of_equal_rows(bearings):
    """Two rows that share a load have the P of one bearing with i = 2: L falls by 2^0.9 against one row under half."""
    material = load_material("bearing steel")
    steel = replace(bearings.b7008, ball_material=material, inner_ring_material=material, outer_ring_material=material)
    rating, oil = (
        RatingInput(nominal_contact_angle=np.radians(15.0)),
        Lubricant(viscosity=0.03, pressure_viscosity=2e-8),
    )
    one = solve_quasistatic(steel, Operation(inner_speed=100.0, force=(500.0, 400.0, 0.0)))
    rows = duplex(steel, Arrangement.TANDEM, WIDTH)
    two = solve_quasistatic(steel, Operation(inner_speed=100.0, force=(1000.0, 800.0, 0.0)), rows=rows)
    single, pair_life = (bearing_life(found, oil, rating) for found in (one, two))
    assert pair_life.basic_life == pytest.approx(2.0**-0.9 * single.basic_life, rel=1e-6)
    assert pair_life.equivalent_load == pytest.approx(2.0 * single.equivalent_load, rel=1e-6)
    assert pair_life.fatigue_load_limit == pytest.approx(2.0 * single.fatigue_load_limit, rel=1e-12)
    assert pair_life.static_safety_factor == pytest.approx(single.static_safety_factor, rel=1e-6)
    assert any("2 rows together" in message for message in pair_life.messages)


def test_a_row_without_load_does_not_shorten_life(bearings):
    material = load_material("bearing steel")
    steel = replace(bearings.b7008, ball_material=material, inner_ring_material=material, outer_ring_material=material)
    rating, oil = (
        RatingInput(nominal_contact_angle=np.radians(15.0)),
        Lubricant(viscosity=0.03, pressure_viscosity=2e-8),
    )
    rows = duplex(steel, Arrangement.BACK_TO_BACK, WIDTH)
    pair_state = solve_quasistatic(steel, Operation(inner_speed=0.1, force=(800.0, 0.0, 0.0)), rows=rows)
    alone = solve_quasistatic(steel, Operation(inner_speed=0.1, force=(800.0, 0.0, 0.0)))
    lives = [bearing_life(found, oil, rating).basic_life for found in (pair_state, alone)]
    assert lives[0] == pytest.approx(lives[1], rel=1e-6)

"""Elastic rings in the balls' equilibrium: forces in balance, stiffness as the derivative, known deflections, limits.

On coarse meshes, whose accuracy plays no part here; `tests/ehl/solid/bodies` has it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    Bearing,
    Curvature,
    Operation,
    QuasistaticModel,
    Race,
    Row,
    load_material,
    preload_offset,
    solve_quasistatic,
)
from oilfilm.bearing.geometry import shoulder_diameter
from oilfilm.bearing.quasistatic.ring import ball_forces, ring_displacements, seat_reactions
from oilfilm.bearing.rings.compliance import response_of, ring_compliance
from oilfilm.bearing.rings.elastic_ring import ElasticRings, elastic_ring
from oilfilm.ehl.solid.bodies import RingCells, Seat
from oilfilm.ehl.solid.bodies.compliance import _directions, _patch

STEEL = load_material("bearing steel")
MATERIALS = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), STEEL)
B6208 = Bearing(
    name="6208",
    ball_diameter=12e-3,
    pitch_diameter=60e-3,
    balls=9,
    inner_groove_radius=6.17e-3,
    outer_groove_radius=6.29e-3,
    diametral_clearance=13e-6,
    bore=40e-3,
    outside_diameter=80e-3,
    width=18e-3,
    **MATERIALS,
)
B61808 = Bearing(
    name="61808",
    ball_diameter=3.5e-3,
    pitch_diameter=46e-3,
    balls=20,
    inner_groove_radius=1.82e-3,
    outer_groove_radius=1.85e-3,
    diametral_clearance=5e-6,
    bore=40e-3,
    outside_diameter=52e-3,
    width=7e-3,
    **MATERIALS,
)
RIGID = QuasistaticModel()
COARSE = RingCells(groove=4, largest_angle=np.pi / 9)
SUPPORTS = (0.3, 2.4, 4.4)


def rings(bearing, inner=None, outer=None):
    """Seats by name; None for a rigid ring."""
    given = {Race.INNER: inner, Race.OUTER: outer}
    made = {
        race.value: replace(
            elastic_ring(
                bearing,
                race,
                Seat(seat),
                shoulder_diameter(bearing, race),
                supports=SUPPORTS if seat == "split" else (),
            ),
            cells=COARSE,
        )
        for race, seat in given.items()
        if seat is not None
    }
    return QuasistaticModel(rings=ElasticRings(**made))


def operation(axial=0.0, radial=0.0, speed=1000.0, **keys):
    return Operation(inner_speed=speed, force=(axial, radial, 0.0), **keys)


CASES = [
    (B6208, rings(B6208, "rigid", "rigid"), operation(0.0, 3000.0)),
    (B6208, rings(B6208, "free", "free"), operation(800.0, 2000.0)),
    (B61808, rings(B61808, "free"), operation(0.0, 300.0, 300.0)),
    (B61808, rings(B61808, "free", "split"), operation(200.0, 150.0, 300.0)),
    (B6208, rings(B6208, "split"), operation(1500.0, 1000.0)),
    (B61808, rings(B61808, "free"), operation(200.0, 150.0, moment=(0.5, -0.3), tilt=(None, None))),
]


def groove_distances(bearing, found):
    """V (2, N) from the ball's centre to both grooves [m]; directions alone matter here."""
    angle = found.inner_contact_angle
    return bearing.curvature_centre_distance * np.stack([np.sin(angle), np.cos(angle)])


@pytest.mark.parametrize(("bearing", "model", "at"), CASES)
def test_forces_balance_and_rings_yield_as_their_compliance_says(bearing, model, at):
    found = solve_quasistatic(bearing, at, model)
    assert found.converged
    assert found.residual < 1e-10
    c, s = np.cos(found.azimuth), np.sin(found.azimuth)
    radial = found.inner_load * np.cos(found.inner_contact_angle)
    axial = found.inner_load * np.sin(found.inner_contact_angle)
    # friction of the gyroscopic couple acts across the normal
    radial -= found.inner_friction * np.sin(found.inner_contact_angle)
    axial += found.inner_friction * np.cos(found.inner_contact_angle)
    load = [axial.sum(), (radial * c).sum(), (radial * s).sum()]
    scale = found.inner_load.max()
    assert_allclose(load, [axis if axis is not None else 0.0 for axis in at.force], atol=1e-8 * scale)
    compliance = ring_compliance(model.rings, found.azimuth, bearing.balls)
    inner, outer = compliance.deflections(
        -np.stack([axial, radial]), found.centrifugal_force, groove_distances(bearing, found)
    )
    assert_allclose(np.stack([found.inner_ring_axial, found.inner_ring_radial]), inner, atol=1e-14)
    assert_allclose(np.stack([found.outer_ring_axial, found.outer_ring_radial]), outer, atol=1e-14)


@pytest.mark.parametrize(("bearing", "model", "at"), CASES)
def test_stiffness_is_the_derivative_of_the_load(bearing, model, at):
    """By central differences of displacements, elastic rings yielding; radial, as under a radial load the hypothesis on
    the gyroscopic couple has a kink at the contact angle of zero."""
    found = solve_quasistatic(bearing, at, model)
    step = 2e-9
    for k in (1, 2):
        forces = []
        for sign in (1.0, -1.0):
            place = found.displacement + sign * step * np.eye(3)[k]
            held = replace(
                at, force=(None,) * 3, displacement=tuple(place), moment=(None, None), tilt=tuple(found.tilt)
            )
            forces.append(solve_quasistatic(bearing, held, model, found).ring_force)
        measured = (forces[0] - forces[1]) / (2.0 * step)
        assert_allclose(measured, found.stiffness[:3, k], atol=2e-5 * np.abs(found.stiffness[:3, :3]).max())


def test_derivative_of_the_movements_by_the_forces():
    """By central differences; symmetric, as the movements have an energy; an unloaded ball has the direction of V."""
    groove = ring_compliance(rings(B6208, "free", "free").rings, B6208.azimuths, B6208.balls).outer
    draw = np.random.default_rng(61803)
    angle = np.radians(draw.uniform(-40.0, 40.0, 9))
    direction = np.stack([np.sin(angle), np.cos(angle)])
    force = draw.uniform(1.0, 1e3, 9) * direction
    force[:, 3] = 0.0
    found = groove.derivative(force, direction)
    assert_allclose(found, found.transpose(2, 3, 0, 1), atol=1e-9 * np.abs(found).max())
    for w, k in ((0, 2), (1, 5)):
        step = np.zeros_like(force)
        step[w, k] = 1e-2
        low, high = (groove.deflection(force + sign * step, direction) for sign in (-1.0, 1.0))
        assert_allclose(found[:, :, w, k], (high - low) / 2e-2, atol=1e-6 * np.abs(found).max())
    barely = force.copy()
    barely[:, 3] = 1e-9 * direction[:, 3]
    assert_allclose(groove.deflection(barely, direction), groove.deflection(force, direction), atol=1e-15)


def test_stiffness_of_rings_at_rest_is_symmetric():
    """Contacts of constant curvature keep their energy; a reciprocal compliance leaves the matrix symmetric."""
    model = replace(rings(B61808, "free", "free"), curvature=Curvature.FREE)
    found = solve_quasistatic(B61808, operation(200.0, 300.0, 0.0), model)
    assert_allclose(found.stiffness, found.stiffness.T, atol=1e-12 * np.abs(found.stiffness).max())


def test_equal_loads_take_the_compliance_of_equal_loads():
    """Thrust at rest: all balls alike, e = C sum; the displacement is that of rigid rings at these loads and angles."""
    model = rings(B6208, None, "free")
    found = solve_quasistatic(B6208, operation(2000.0, 0.0, 0.0), model)
    assert_allclose(found.outer_load, found.outer_load.mean(), rtol=1e-9)
    angles = 2.0 * np.pi * np.arange(9) / 9
    axial, radial, opened, opening = response_of(model.rings.outer).at(angles).sum(axis=1)
    alpha = found.outer_contact_angle[0]
    normal = np.array([np.sin(alpha), np.cos(alpha)])
    moved = normal @ (found.outer_ring_axial[0], found.outer_ring_radial[0])
    share = (np.sin(alpha) / np.sin(model.rings.outer.contact_angle)) ** 2
    force = np.array([*normal, share])
    matrix = np.array([[axial, 0.0, 0.0], [0.0, radial, opened], [0.0, opened, opening]])
    assert_allclose(moved, found.outer_load[0] * force @ matrix @ force, rtol=1e-9)


def test_a_free_thin_ring_spreads_the_load():
    """Largest ball load falls, more balls carry, loads fall from the load line outwards; seated, they hardly change."""
    at = operation(0.0, 400.0, 0.0)
    rigid, seated, free = (
        solve_quasistatic(B61808, at, model)
        for model in (RIGID, rings(B61808, "rigid", "rigid"), rings(B61808, None, "free"))
    )
    half = slice(0, 11)
    for found in (rigid, seated, free):
        assert (np.diff(found.inner_load[half]) <= 1e-9 * found.inner_load.max()).all()
    assert_allclose(seated.inner_load.max(), rigid.inner_load.max(), rtol=0.03)
    assert seated.stiffness[1, 1] > rigid.stiffness[1, 1]
    assert free.stiffness[1, 1] < 0.8 * rigid.stiffness[1, 1]
    assert (free.inner_load > 0.0).sum() > (rigid.inner_load > 0.0).sum()


def test_stiff_rings_are_rigid_rings():
    """A ring whose compliance goes to zero; the deflections fall with it."""
    rigid = solve_quasistatic(B6208, operation(0.0, 3000.0), RIGID)
    ring = rings(B6208, "free").rings.inner
    stiff = replace(ring, elasticity=replace(ring.elasticity, young=ring.elasticity.young * 1e5))
    found = solve_quasistatic(B6208, operation(0.0, 3000.0), QuasistaticModel(rings=ElasticRings(inner=stiff)))
    assert_allclose(found.inner_load, rigid.inner_load, atol=1e-4 * rigid.inner_load.max())
    assert_allclose(found.displacement, rigid.displacement, atol=1e-9)


def test_preload_of_thin_rings_needs_a_longer_way():
    """The way to a thrust grows with free rings, as they are widened and turned."""
    rigid, free = (preload_offset(B61808, 200.0, model) for model in (RIGID, rings(B61808, "free", "free")))
    assert free > rigid + 1e-6


@pytest.mark.parametrize(
    ("at", "seat"),
    [(operation(0.0, 300.0), "free"), (operation(200.0, 100.0), "free"), (operation(30.0, 300.0), "rigid")],
)
def test_the_field_of_a_ring_moves_its_groove_as_the_compliance_says(at, seat):
    """Outer ring: at the bottom of the groove, the half-space's part of the ball's own load taken off; 1 %, as loads at
    the contact angle and at the bottom are reciprocal to that on this mesh."""
    model = rings(B61808, None, seat)
    found = solve_quasistatic(B61808, at, model)
    response = response_of(model.rings.outer)
    (field,) = ring_displacements(found, Race.OUTER)
    mesh = response.mesh
    assert field.points.shape[0] == 120
    turns = np.arctan2(field.points[:, 0, 0, 2], field.points[:, 0, 0, 1])
    lines = np.unique(mesh.body.parameters[1][mesh.track].round(12))
    force = ball_forces(found, Race.OUTER)
    bottom, across, _, _ = response.half_space
    alpha = response.angles[1]
    share = force[0] ** 2 / np.maximum(np.hypot(*force), 1e-300) / np.sin(alpha) ** 2
    for k in (0, 5, 10):
        places, weights, _ = _patch(mesh, 0.0, 0.25 * mesh.profile.groove_radius)
        x, r = _directions(mesh, places, 0.0)
        columns = [int(np.abs(lines - place).argmin()) for place in places]
        azimuth = found.azimuth[k]
        row = np.cos(turns - azimuth).argmax()
        moved = field.displacement[row, columns, 0]
        radial = moved[:, 1] * np.cos(azimuth) + moved[:, 2] * np.sin(azimuth)
        measured = (weights * (x * moved[:, 0] + r * radial)).sum()
        measured -= (force[1, k] - share[k] * np.cos(alpha)) * bottom + share[k] * across
        entries = response.at(azimuth - found.azimuth)
        assert_allclose(measured, entries[1] @ force[1] + entries[2] @ share, rtol=0.01)


def test_rows_do_not_feel_each_other():
    model = rings(B61808, "rigid", "free")
    azimuths = np.concatenate([B61808.azimuths, B61808.azimuths])
    compliance = ring_compliance(model.rings, azimuths, B61808.balls)
    assert not compliance.outer.entries[:, :20, 20:].any()
    pair = (Row(axial_position=-10e-3, offset=60e-6), Row(axial_position=10e-3, offset=-60e-6))
    found = solve_quasistatic(B61808, operation(0.0, 300.0, 0.0), model, rows=pair)
    assert found.converged
    assert_allclose(found.row_load[0, 1], found.row_load[1, 1], rtol=1e-6)


@pytest.mark.parametrize(
    ("change", "field"), [({"bore": None}, "bore"), ({"width": None}, "width"), ({"bore": 49e-3}, "bore leaves no")]
)
def test_a_section_that_is_not_known_is_named(change, field):
    with pytest.raises(ValueError, match=field):
        rings(replace(B6208, **change), "rigid")


@pytest.mark.parametrize("race", [Race.INNER, Race.OUTER])
def test_supports_of_a_split_seat_balance_the_balls_and_never_pull(race):
    """Two of three press; the third lets go. The spring across takes a thousandth."""
    model = rings(B6208, **{race.value: "split"})
    found = solve_quasistatic(B6208, operation(0.0, 2000.0, 10.0), model)
    assert found.converged
    (forces,), _ = seat_reactions(found, race)
    balls = ball_forces(found, race)[1]
    resultant = np.array([(balls * np.cos(found.azimuth)).sum(), (balls * np.sin(found.azimuth)).sum()])
    outward = 1.0 if race is Race.INNER else -1.0
    pushed = outward * np.array([forces @ np.cos(SUPPORTS), forces @ np.sin(SUPPORTS)])
    assert_allclose(pushed, -resultant, atol=3e-3 * np.hypot(*resultant))
    assert (forces >= 0.0).all() and (forces > 0.0).sum() == 2


def test_a_split_seat_bends_a_thin_ring_more_than_a_loose_one():
    """The field of the ring stands still where its supports press it."""
    model = rings(B61808, None, "split")
    found = solve_quasistatic(B61808, operation(0.0, 300.0), model)
    loose = solve_quasistatic(B61808, operation(0.0, 300.0), rings(B61808, None, "free"))
    assert found.converged and np.ptp(found.outer_ring_radial) > 2.0 * np.ptp(loose.outer_ring_radial)
    (field,) = ring_displacements(found, Race.OUTER)
    (forces,), _ = seat_reactions(found, Race.OUTER)
    seat, moved = field.points[:, :, -1], field.displacement[:, :, -1]
    around = np.arctan2(seat[:, 0, 2], seat[:, 0, 1])
    radial = (moved[..., 1:] * seat[..., 1:]).sum(axis=-1).mean(axis=1) / np.hypot(*seat[0, 0, 1:])
    at_supports = np.array([radial[np.abs(np.angle(np.exp(1j * (around - turn)))).argmin()] for turn in SUPPORTS])
    assert np.abs(at_supports[forces > 0.0]).max() < 0.05 * np.ptp(radial)
    assert (at_supports[forces == 0.0] < 0.05 * np.ptp(radial)).all()  # off it, or touching


@pytest.mark.parametrize("supports", [(0.0, np.pi), (0.0, 1.0, 2.0), (0.0, 0.01, 2.0, 4.0)])
def test_supports_that_do_not_hold_a_ring_are_refused(supports):
    shoulder = shoulder_diameter(B6208, Race.OUTER)
    with pytest.raises(ValueError, match="supports must be"):
        elastic_ring(B6208, Race.OUTER, Seat.SPLIT, shoulder, supports=supports)

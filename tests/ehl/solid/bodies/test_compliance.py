"""Structural compliance of rings: closed forms of thin rings, reciprocity, limits, convergence.

Rings of shared measurements: 6208 inner (wall of 4 mm) and 61808 inner (1.25 mm), estimated shoulders.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.closed_form.hertz import contact_stiffness
from oilfilm.ehl.solid.bodies import Elasticity, RingCells, RingProfile, Seat, ring_response
from oilfilm.ehl.solid.bodies.compliance import (
    _balanced,
    _directions,
    _half_space,
    _in_place,
    _moved,
    _patch,
    _support,
    flat_block,
    indentation,
)
from oilfilm.ehl.solid.bodies.elasticity import elastic_body, solve_elasticity
from oilfilm.ehl.solid.bodies.ring import ring_field
from oilfilm.ehl.solid.bodies.ring_mesh import ring_mesh

STEEL = Elasticity(young=206e9, poisson=0.3, body_young=206e9, body_poisson=0.3)
INNER_6208 = RingProfile(
    groove_radius=6.17e-3, track_radius=24e-3, shoulder_radius=26.3e-3, seat_radius=20e-3, width=18e-3
)
OUTER_6208 = RingProfile(
    groove_radius=6.29e-3, track_radius=36e-3, shoulder_radius=33.7e-3, seat_radius=40e-3, width=18e-3
)
INNER_61808 = RingProfile(
    groove_radius=1.82e-3, track_radius=21.25e-3, shoulder_radius=21.8e-3, seat_radius=20e-3, width=7e-3
)
ANGLE = np.radians(20.0)
COARSE = RingCells(groove=6, largest_angle=np.pi / 18)


@cache
def response(profile, seat, cells=COARSE):
    return ring_response(profile, STEEL, seat, ANGLE, cells)


def equal_loads(found, loads):
    """Radial displacement at each of equal loads evenly around the ring, less the half-space's [m/N]."""
    return found.at(2.0 * np.pi * np.arange(loads) / loads)[1].sum()


def test_seated_ring_is_stiffer_than_a_half_space_by_six_per_cent():
    """6208 on a rigid shaft at 1 kN: -0.55 um with linear cells, graded or line load; of 9.31 um Hertz approach."""
    found = response(INNER_6208, Seat.RIGID)
    assert_allclose(1e9 * equal_loads(found, 9), -0.52, atol=0.04)
    radii = (6e-3 * (1 - 12 / 60), 1 / (2 / 12e-3 - 1 / 6.17e-3))
    hertz = (1e3 / contact_stiffness(*radii, 206e9 / (1 - 0.3**2))) ** (2 / 3)
    assert_allclose(hertz, 9.31e-6, rtol=0.01)


@pytest.mark.parametrize(("loads", "thin_ring"), [(2, 68.1), (4, 5.9)])
def test_thin_ring_under_equal_loads(loads, thin_ring):
    """u = F R^3/(2 E I) [(cot t + t/sin^2 t)/2 - 1/t] + F n R/(2 pi E A), t = pi/n, section of the real profile
    (Timoshenko): 68.1 and 5.9 um for a 61808 under 60 N; within 5 %, for the theory leaves out shear and the load's
    spread."""
    found = response(INNER_61808, Seat.FREE)
    assert_allclose(60e6 * equal_loads(found, loads), thin_ring, rtol=0.05)


@pytest.mark.parametrize("seat", [Seat.FREE, Seat.RIGID])
def test_energy_is_never_gained(seat):
    """With the half-space's part the compliance of the balls on each other is symmetric and positive definite."""
    found = response(INNER_6208, seat)
    balls = 2.0 * np.pi * np.arange(9) / 9
    matrix = np.array([found.at(balls - psi)[1] for psi in balls])
    assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix + found.half_space[0] * np.eye(9)).min() > 0.0


def test_forces_and_displacements_are_reciprocal():
    """Maxwell and Betti: what a load at the contact angle does at the bottom of the groove is what it suffers from a
    load there: to the residual of the solve at the load, elsewhere as the mesh is coarser."""
    found = response(INNER_61808, Seat.FREE)
    mesh = found.mesh
    patches = [_patch(mesh, angle, 0.25 * mesh.profile.groove_radius) for angle in found.angles]
    there, back = (_moved(mesh, found.field[..., k], *patches[1 - k]) for k in range(2))
    assert_allclose(there, found.displacement[1], rtol=1e-12)
    assert_allclose(there[0], back[0], rtol=1e-7)
    assert_allclose(there, back, atol=1e-4 * np.abs(there).max())


def direct_solution(profile, seat, turns, angles, loads):
    """All balls at once on an even mesh of half a ring, each at its own contact angle: d along the normal at each, and
    at its mirror image, less what a flat block does [m]; balls at turns from 0 to pi, those between stand for two."""
    mesh = ring_mesh(profile, COARSE, uniform=48)
    theta, s, _ = mesh.body.parameters
    patches = [_patch(mesh, angle, 0.25 * profile.groove_radius) for angle in angles]

    def weighted(turn, patch):
        line = np.flatnonzero(mesh.track & (np.abs(theta - turn) < 1e-6))
        nodes = line[[int(np.abs(s[line] - place).argmin()) for place in patch[0]]]
        x, r = _directions(mesh, patch[0], patch[2])
        return nodes, patch[1][:, None] * np.stack([x, r * np.cos(turn), r * np.sin(turn)], axis=1)

    forces = np.zeros((theta.size, 3, 1))
    for turn, patch, load in zip(turns, patches, loads, strict=True):
        nodes, directions = weighted(turn, patch)
        half = 0.5 if min(turn, np.pi - turn) < 1e-9 else 1.0
        forces[nodes, :, 0] += half * load * directions
    held = np.zeros((theta.size, 3), dtype=bool)
    held[mesh.symmetric, 2] = True
    support = _support(mesh, seat)
    body = elastic_body(mesh.body, STEEL.young, STEEL.poisson)
    field = _in_place(mesh, solve_elasticity(body, _balanced(mesh, forces, support), held).values, support)[..., 0]
    found = []
    for turn, (lines, weights, angle), load in zip(turns, patches, loads, strict=True):
        places = ((lines, weights, angle), (-lines, weights, -angle))
        flat = _half_space(mesh, places[0], places, STEEL)
        moved = [(directions * field[nodes]).sum() for nodes, directions in (weighted(turn, p) for p in places)]
        found.append(np.array(moved) - load * flat)
    return np.transpose(found)


@pytest.mark.parametrize(
    "side", [pytest.param(np.ones(5), id="thrust"), pytest.param(np.array([1.0, 1.0, 1.0, -1.0, -1.0]), id="moment")]
)
@pytest.mark.slow
def test_loads_at_contact_angles_against_a_direct_calculation(side):
    """Loose outer ring of a 6208, eight balls: approach and axial movement. Without the groove's opening the axial
    entry held it, and was 0.43 off under thrust (0.0015 here)."""
    turns = 0.25 * np.pi * np.arange(5)
    loads = np.full(5, 1e3) if side.min() > 0.0 else 1e3 * (0.1 + np.abs(np.cos(turns)))
    here, image = direct_solution(OUTER_6208, Seat.FREE, turns, ANGLE * side, loads)
    everywhere = np.concatenate([turns, -turns[1:4]])
    force = np.concatenate([loads, loads[1:4]])
    sign = np.concatenate([side, side[1:4]])
    entries = np.array([response(OUTER_6208, Seat.FREE).at(psi - everywhere) for psi in turns])
    axial, radial, opened, opening = np.einsum("jck,k->cj", entries, force)
    axial = np.einsum("jk,k->j", entries[:, 0], force * sign) * side
    c, s = np.cos(ANGLE), np.sin(ANGLE)
    even = c * c * radial + 2.0 * c * opened + opening
    assert_allclose(s * axial, (here - image) / (2.0 * s), atol=0.005 * np.abs(here - image).max() / (2.0 * s))
    assert_allclose(even + s * s * axial, here, atol=0.005 * np.abs(here).max())


def test_a_whole_thin_ring_under_two_forces():
    """Superposed field of a 61808 under 60 N at 30 and 210 degrees: the bore moves by what thin-ring theory gives, 68.1
    um inwards at the loads, and 62 um (0.0683 F R^3/EI) outwards between them; Timoshenko, 5 %."""
    found = response(INNER_61808, Seat.FREE)
    turns = np.radians([30.0, 210.0])
    field = ring_field(found, turns, np.array([[60.0, 60.0], [0.0, 0.0], [0.0, 0.0]]))
    middle = field.points.shape[1] // 2
    points, moved = (part[:, middle, -1] for part in (field.points, field.displacement))
    radius = np.hypot(*points[:, 1:].T)
    assert_allclose(radius, 20e-3)
    radial = 1e6 * (moved[:, 1:] * points[:, 1:]).sum(axis=1) / radius
    turn = np.degrees(np.arctan2(points[:, 2], points[:, 1])) % 360.0
    assert_allclose([radial[np.abs(turn - psi).argmin()] for psi in (30.0, 210.0)], -68.1, rtol=0.05)
    assert_allclose([radial[np.abs(turn - psi).argmin()] for psi in (120.0, 300.0)], 62.4, rtol=0.05)


@pytest.mark.parametrize("part", [1, 2])
def test_a_field_turned_to_its_load_is_that_of_the_load(part):
    """At the nodes of the finite elements, for the load at the contact angle and its mirror image."""
    found = response(OUTER_6208, Seat.FREE)
    field = ring_field(found, np.zeros(1), 1e3 * np.eye(3)[:, part : part + 1])
    nodes = found.mesh.body.points
    own = 1e3 * found.field[..., 1]
    if part == 2:
        nodes, own = nodes * np.array([[-1.0], [1.0], [1.0]]), own * np.array([-1.0, 1.0, 1.0])
    for n in (0, 60):  # opposite ends of the half ring, where lines of both meet
        at = np.abs(nodes[1:].T[:, None] - field.points[n].reshape(-1, 3)[None, :, 1:]).sum(axis=2)
        at += np.abs(nodes[0][:, None] - field.points[n].reshape(-1, 3)[None, :, 0])
        nearest = at.argmin(axis=0)
        assert at.min(axis=0).max() < 1e-9
        assert_allclose(field.displacement[n].reshape(-1, 3), own[nearest], atol=1e-9 * np.abs(own).max())


def test_load_that_the_seat_spreads_alike_moves_the_ring_little():
    """A free ring under cos(psi), balls and seat, against the ovalising cos(2 psi): by ring theory not at all."""
    found = response(INNER_61808, Seat.FREE)
    balls = 2.0 * np.pi * np.arange(26) / 26
    radial = found.at(balls)[1]
    assert abs((radial * np.cos(balls)).sum()) < 0.1 * (radial * np.cos(2.0 * balls)).sum()


@pytest.mark.slow
def test_halved_cells():
    """2 % of the half-space's approach of 4 um/kN."""
    coarse, fine = (response(INNER_6208, Seat.RIGID, cells) for cells in (COARSE, RingCells(groove=10)))
    places = 2.0 * np.pi * np.arange(9) / 9
    assert_allclose(coarse.at(places), fine.at(places), atol=0.02 * 4e-9)


@pytest.mark.slow
def test_thick_ring_on_a_rigid_shaft_tends_to_the_half_space():
    """The rest falls like the contact's size over the wall."""
    thick = RingProfile(
        groove_radius=6.17e-3, track_radius=32e-3, shoulder_radius=34.3e-3, seat_radius=20e-3, width=24e-3
    )
    thin, rest = (abs(response(profile, Seat.RIGID).at(np.zeros(1))[1, 0]) for profile in (INNER_6208, thick))
    assert rest < 0.5 * thin


def test_block_does_not_know_where_it_ends():
    """Boussinesq's displacements on its far faces: half the block yields the same depth to 0.5 %."""
    across = np.linspace(-6e-3, 6e-3, 9)
    depth = np.linspace(0.0, 5e-3, 5)
    nodes = np.array([-1.5e-3, -0.75e-3, 0.0, 0.75e-3, 1.5e-3])
    weights = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
    load = (nodes, weights)
    large, small = (
        indentation(flat_block(np.linspace(0.0, 1.5e-3 * n, n + 1), across, depth), load, [load], 206e9, 0.3)
        for n in (6, 3)
    )
    assert_allclose(small, large, rtol=5e-3)


def test_mesh_has_the_ring_s_shape():
    mesh = ring_mesh(OUTER_6208)
    radius = np.hypot(*mesh.body.points[1:])
    assert_allclose(radius[mesh.seat], 40e-3)
    groove = mesh.track & (np.abs(mesh.body.parameters[1]) < OUTER_6208.edge)
    x = mesh.body.points[0]
    assert_allclose(np.hypot(x, radius - OUTER_6208.centre_radius)[groove], 6.29e-3, rtol=1e-12)
    assert_allclose(np.abs(x).max(), 9e-3)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"seat_radius": 25e-3, "shoulder_radius": 26.3e-3}, "shoulder_radius"),
        ({"shoulder_radius": 23e-3}, "shoulder_radius"),
        ({"width": 5e-3}, "width"),
        ({"body_radius": 22e-3}, "body_radius"),
    ],
)
def test_impossible_profiles_name_the_field(change, field):
    with pytest.raises(ValueError, match=field):
        replace(INNER_6208, **change)


@pytest.mark.parametrize(("loads", "thin_ring"), [(2, 68.1), (3, 14.9)])
def test_places_on_the_seat_of_a_thin_ring(loads, thin_ring):
    """Equal forces on its bore: as between loads on the track, 68.1 and 14.9 um of a 61808 under 60 N (Timoshenko)."""
    places = ring_response(INNER_61808, STEEL, Seat.SPLIT, ANGLE, COARSE, seat_contact=0.0625).seat_contacts
    moved = places.at(2.0 * np.pi * np.arange(loads) / loads)
    assert_allclose(60e6 * moved[2].sum(), thin_ring, rtol=0.05)
    # a load on the track beyond its normal pushes the bore inwards: the same bending, other sign
    assert_allclose(-60e6 * moved[0].sum(), thin_ring, rtol=0.05)

"""Elasticity of finite bodies against closed forms: patch test, Lame's cylinder, Timoshenko's ring under two forces.

Timoshenko and Gere, Mechanics of Materials, and Timoshenko, Strength of Materials II: radial displacement under each
of two opposite forces on a thin ring, (pi/4 - 2/pi) F R^3/(2 E I) = 0.0744 F R^3/(E I), and F R pi/8 (1/(E A) + ...)
of the normal and shear forces.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from skfem import Basis, BilinearForm, ElementHex2, ElementVector, asm
from skfem.helpers import ddot, sym_grad, trace

from oilfilm.ehl.solid.bodies import elasticity
from oilfilm.ehl.solid.bodies.elasticity import (
    elastic_body,
    hexahedra,
    rigid_body_modes,
    solve_elasticity,
    solve_symmetric,
    surface_weights,
    volume_weights,
)

YOUNG, POISSON = 206e9, 0.3


def skewed(parameters):
    x, y, z = parameters
    return np.stack([x + 0.2 * y * z, y + 0.1 * x**2, z + 0.15 * x * y])


def cylinder(inner, outer, width, angle, cells):
    """Sector of a plain ring, its axis along x, from theta = 0."""
    lines = [np.linspace(0.0, length, n + 1) for length, n in zip((angle, width, 1.0), cells, strict=True)]

    def place(parameters):
        theta, s, t = parameters
        r = outer + (inner - outer) * t
        return np.stack([s - 0.5 * width, r * np.cos(theta), r * np.sin(theta)])

    return hexahedra(lines, place)


def test_block_assembly_is_that_of_the_vector_element():
    body = hexahedra([np.linspace(0.0, 1.0, n) for n in (3, 2, 2)], skewed)
    own = elastic_body(body, 2.5, 0.3).stiffness.toarray()
    shear = 2.5 / 2.6
    lame = 2.5 * 0.3 / (1.3 * 0.4)
    basis = Basis(body.mesh, ElementVector(ElementHex2()), intorder=4)
    form = BilinearForm(
        lambda u, v, w: 2 * shear * ddot(sym_grad(u), sym_grad(v)) + lame * trace(sym_grad(u)) * trace(sym_grad(v))
    )
    # both number 3 times the node plus the component
    assert_allclose(own, asm(form, basis).toarray(), atol=1e-14 * np.abs(own).max())


def test_rigid_motions_cost_nothing_and_the_rest_does():
    body = hexahedra([np.linspace(0.0, 1.0, 3)] * 3, skewed)
    matrix = elastic_body(body, YOUNG, POISSON).stiffness
    modes = rigid_body_modes(body.points)
    assert np.abs(matrix @ modes).max() < 1e-13 * np.abs(matrix.data).max()
    values = np.linalg.eigvalsh(matrix.toarray())
    assert (values[:6] < 1e-12 * values[-1]).all()
    assert values[6] > 1e-6 * values[-1]


def test_patch_test():
    """A linear displacement on the boundary of skewed cells is found inside to round-off."""
    body = hexahedra([np.linspace(0.0, 1.0, 4)] * 3, lambda p: p + 0.05 * np.sin(2.0 * p[[1, 2, 0]]))
    gradient = np.array([[1.0, 0.2, -0.3], [0.5, -0.4, 0.1], [0.0, 0.7, 0.6]])
    exact = (gradient @ body.points).T[:, :, None]
    boundary = np.any([body.on(k, x) for k in range(3) for x in (0.0, 1.0)], axis=0)
    held = np.repeat(boundary[:, None], 3, axis=1)
    solution = solve_elasticity(elastic_body(body, YOUNG, POISSON), np.zeros_like(exact), held, exact)
    assert_allclose(solution.values, exact, atol=1e-8)


def lame_error(cells):
    """Largest relative error of the radial displacement of a quarter ring under internal pressure."""
    a, b, angle = 20e-3, 30e-3, np.pi / 2
    body = cylinder(a, b, 2e-3, angle, (cells, 1, cells // 2))
    theta = body.parameters[0]
    radial = np.stack([np.zeros_like(theta), np.cos(theta), np.sin(theta)], axis=1)
    pressure = 100e6
    forces = (pressure * surface_weights(body, body.on(2, 1.0))[:, None] * radial)[:, :, None]
    held = np.zeros((theta.size, 3), dtype=bool)
    held[body.on(0, 0.0), 2] = True
    held[body.on(0, angle), 1] = True
    held[body.on(1, 0.0), 0] = True
    solution = solve_elasticity(elastic_body(body, YOUNG, POISSON), forces, held)
    found = (solution.values[:, :, 0] * radial).sum(axis=1)
    r = np.hypot(*body.points[1:])
    exact = pressure * a**2 / (YOUNG * (b**2 - a**2)) * ((1 - POISSON) * r + (1 + POISSON) * b**2 / r)
    return np.abs(found / exact - 1.0).max()


def test_thick_cylinder_under_internal_pressure():
    """Lame (1852), plane stress: u = p a^2/(E (b^2 - a^2)) [(1 - nu) r + (1 + nu) b^2/r]; order 3 at the nodes, 4 by
    the arcs."""
    coarse, fine = lame_error(6), lame_error(12)
    assert fine < 3e-4
    assert coarse > 8.0 * fine


@pytest.mark.parametrize("multigrid", [True, False])
def test_thin_ring_under_two_opposite_forces(multigrid, monkeypatch):
    """Half of a free ring: 98.3 um by bending and 0.9 um by normal and shear forces; 0.3 % by the mesh."""
    inner, outer, width, load = 20e-3, 21.5e-3, 7e-3, 60.0
    monkeypatch.setattr(elasticity, "DIRECT_BELOW", 0 if multigrid else 10**9)
    body = cylinder(inner, outer, width, np.pi, (24, 2, 2))
    forces = np.zeros((body.points.shape[1], 3, 1))
    across = np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0
    for angle, sign in ((0.0, 1.0), (np.pi, -1.0)):
        line = np.flatnonzero(body.on(0, angle) & body.on(2, 1.0))
        line = line[np.argsort(body.parameters[1, line])]
        forces[line, 1, 0] = sign * 0.5 * load * across
    held = np.zeros((body.points.shape[1], 3), dtype=bool)
    held[body.on(0, 0.0) | body.on(0, np.pi), 2] = True
    solution = solve_elasticity(elastic_body(body, YOUNG, POISSON), forces, held)
    assert solution.method == ("smoothed aggregation" if multigrid else "factors")
    ends = [solution.values[body.on(0, angle) & body.on(2, 1.0), 1, 0].mean() for angle in (0.0, np.pi)]
    radius = 0.5 * (inner + outer)
    inertia = width * (outer - inner) ** 3 / 12.0
    bending = (np.pi / 4 - 2 / np.pi) * load * radius**3 / (2 * YOUNG * inertia)
    assert_allclose(0.5 * (ends[0] - ends[1]), bending * (1.0 + 0.9 / 98.3), rtol=0.02)


def test_factors_and_multigrid_agree():
    body = cylinder(20e-3, 24e-3, 6e-3, np.pi, (12, 2, 2))
    matrix = elastic_body(body, YOUNG, POISSON).stiffness
    held = body.on(2, 1.0)
    matrix = matrix.tolil()
    for row in np.flatnonzero(np.repeat(held, 3)):
        matrix[row, row] = matrix[row, row] + YOUNG
    matrix = matrix.tobsr((3, 3))
    right = np.random.default_rng(31).normal(size=(matrix.shape[0], 2))
    modes = rigid_body_modes(body.points)
    direct, iterated = (solve_symmetric(matrix, modes, right, 1e-10, multigrid=choice) for choice in (False, True))
    assert direct.method != iterated.method
    scale = np.abs(direct.values).max()
    assert_allclose(iterated.values, direct.values, atol=1e-7 * scale)


def test_weights_are_volume_and_area():
    body = cylinder(20e-3, 24e-3, 6e-3, np.pi, (24, 1, 1))
    volume = volume_weights(body, np.ones(body.mesh.nelements, dtype=bool)).sum()
    assert_allclose(volume, 0.5 * np.pi * (24e-3**2 - 20e-3**2) * 6e-3, rtol=1e-6)
    assert_allclose(surface_weights(body, body.on(2, 1.0)).sum(), np.pi * 20e-3 * 6e-3, rtol=1e-6)


def test_inverted_cells_are_refused():
    with pytest.raises(ValueError, match="inside out"):
        hexahedra([np.linspace(0.0, 1.0, 3)] * 3, lambda p: np.stack([p[0] * (p[1] - 0.6), p[1], p[2]]))

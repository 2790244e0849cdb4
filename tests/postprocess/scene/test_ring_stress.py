"""Stress of rings as meshes: nodes, cells and values read back."""

from __future__ import annotations

import meshio
import numpy as np
import pytest

from oilfilm.ehl.solid.bodies.ring import RingStress
from oilfilm.ehl.solid.subsurface import SubsurfaceStress
from oilfilm.postprocess.scene.vtk import stress_mesh


def test_a_box_is_read_back_with_its_stresses(tmp_path):
    """Hexahedra fill the box, each with positive volume; values at the nodes in GPa."""
    x, y, depth = np.linspace(-1e-4, 1e-4, 3), np.linspace(-1e-3, 1e-3, 4), np.linspace(0.0, 3e-4, 5)
    flat = np.random.default_rng(80231).normal(0.0, 1e9, (6, 3, 4, 5))
    bodies = [SubsurfaceStress(x=x, y=y, depth=depth, stress=s) for s in (flat, 1.1 * flat)]
    path = tmp_path / "stress.vtu"
    stress_mesh(RingStress(half_space=bodies[0], ring=bodies[1])).write(path)
    mesh = meshio.read(path)
    corners = mesh.points[mesh.cells_dict["hexahedron"]]
    edges = corners[:, [1, 3, 4]] - corners[:, :1]
    assert np.linalg.det(edges).min() > 0.0
    assert np.linalg.det(edges).sum() == pytest.approx(0.2 * 2.0 * 0.3)
    k = 7 + 5 * 4  # x[1], y[1], depth[2]
    assert mesh.points[k] == pytest.approx([0.0, -1.0 / 3.0, 0.15])
    assert mesh.point_data["stress yz [GPa]"][k] == pytest.approx(1.1 * flat[4, 1, 1, 2] / 1e9)
    ratio = mesh.point_data["von Mises [GPa]"] / mesh.point_data["von Mises, half-space [GPa]"]
    assert ratio == pytest.approx(np.full(60, 1.1))

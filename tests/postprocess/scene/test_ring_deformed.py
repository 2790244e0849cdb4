"""Elastic rings with their displacement: files read back, exported, drawn."""

from __future__ import annotations

from dataclasses import replace

import meshio
import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, QuasistaticModel, Race, load_material, solve_quasistatic
from oilfilm.bearing.geometry import shoulder_diameter
from oilfilm.bearing.quasistatic.ring import ring_displacements
from oilfilm.bearing.rings.elastic_ring import ElasticRings, elastic_ring
from oilfilm.ehl.solid.bodies import RingCells, Seat
from oilfilm.postprocess import write_results
from oilfilm.postprocess.bearing.summary import ring_messages
from oilfilm.postprocess.scene.export import export_results
from oilfilm.postprocess.scene.render_process import RenderingError, require_rendering
from oilfilm.postprocess.scene.scene import SceneOptions, screenshot
from oilfilm.postprocess.scene.vtk import DISPLACEMENT, DISTANCE, RADIAL, displacement_mesh

STEEL = load_material("bearing steel")
COARSE = RingCells(groove=4, largest_angle=np.pi / 9)


@pytest.fixture(scope="module")
def results(bearing_results):
    """The 6208 in steel on a loose inner ring, without films."""
    materials = dict.fromkeys(("ball_material", "inner_ring_material", "outer_ring_material"), STEEL)
    bearing = replace(bearing_results.quasistatic.bearing, **materials)
    shoulder = shoulder_diameter(bearing, Race.INNER)
    ring = replace(elastic_ring(bearing, Race.INNER, Seat.FREE, shoulder), cells=COARSE)
    model = QuasistaticModel(rings=ElasticRings(inner=ring))
    state = solve_quasistatic(bearing, Operation(inner_speed=100.0, force=(0.0, 3000.0, 0.0)), model)
    return replace(bearing_results, quasistatic=state, solutions=(None,) * len(bearing_results.solutions))


@pytest.fixture(scope="module")
def folder(results, tmp_path_factory):
    directory = tmp_path_factory.mktemp("rings") / "run"
    write_results(results, directory)
    return directory


def test_a_ring_is_read_back_with_its_displacement(folder, results):
    """In mm and um, in the bearing's frame, closed around; only the ring that is an elastic body."""
    assert [path.name for path in folder.glob("ring_deformed_*")] == ["ring_deformed_inner.vtu"]
    mesh = meshio.read(folder / "ring_deformed_inner.vtu")
    corners = mesh.points[mesh.cells_dict["hexahedron"]]
    edges = corners[:, [1, 3, 4]] - corners[:, :1]
    volumes = np.linalg.det(edges)
    assert volumes.min() > 0.0
    radius = np.hypot(*mesh.points[:, 1:].T)
    assert_allclose([radius.min(), np.ptp(mesh.points[:, 0])], [20.0, 18.0], rtol=1e-6)
    profile = results.quasistatic.model.rings.inner.profile
    half = profile.edge_angle
    groove = 6.17**2 * (half - np.sin(half) * np.cos(half))
    shoulder = 1e3 * profile.shoulder_radius
    ring = np.pi * (shoulder**2 - 20.0**2) * 18.0 - 2.0 * np.pi * (shoulder - 1.0) * groove
    assert_allclose(volumes.sum(), ring, rtol=0.02)
    (field,) = ring_displacements(results.quasistatic, Race.INNER)
    moved = mesh.point_data[DISPLACEMENT]
    assert_allclose(moved, field.displacement.reshape(-1, 3) * 1e6)
    assert_allclose(mesh.point_data[DISTANCE], np.linalg.norm(moved, axis=1))
    outward = mesh.points[:, 1:] / radius[:, None]
    assert_allclose(mesh.point_data[RADIAL], (moved[:, 1:] * outward).sum(axis=1), atol=1e-9)


def test_rows_are_rings_of_one_mesh():
    points = np.random.default_rng(27183).normal(size=(5, 3, 2, 3))
    mesh = displacement_mesh([points, points + 1.0], [points, points])
    assert len(mesh.points) == 2 * 30
    assert len(mesh.cells_dict["hexahedron"]) == 2 * 5 * 2
    assert np.bincount(mesh.cell_data["row"][0]).tolist() == [0, 10, 10]


@pytest.mark.parametrize("suffix", ["vtu", "xdmf"])
def test_export_without_films(folder, tmp_path, suffix):
    files = export_results(folder, tmp_path / f"films.{suffix}")
    assert files[0] == tmp_path / f"films_ring_deformed_inner.{suffix}"
    written, own = (meshio.read(path) for path in (files[0], folder / "ring_deformed_inner.vtu"))
    assert_allclose(written.point_data[DISPLACEMENT], own.point_data[DISPLACEMENT])
    with pytest.raises(ValueError, match="no film maps"):
        export_results(folder, tmp_path / "films.msh")


@pytest.mark.slow
def test_export_beside_films(bearing_folder, folder, tmp_path):
    directory = tmp_path / "run"
    directory.mkdir()
    for path in (*bearing_folder.glob("*.nc"), *bearing_folder.glob("*.json"), folder / "ring_deformed_inner.vtu"):
        (directory / path.name).write_bytes(path.read_bytes())
    names = [path.name for path in export_results(directory, tmp_path / "all.vtu")]
    assert names == ["all.vtu", "all_ring_deformed_inner.vtu"]


def test_picture_of_rigid_rings_says_what_is_missing(bearing_folder, tmp_path):
    with pytest.raises(ValueError, match=r"no ring with a displacement: a case with \[rings\]"):
        screenshot(bearing_folder, tmp_path / "scene.png", SceneOptions(quantity="displacement"))


@pytest.mark.slow
def test_picture_in_the_colours_of_the_displacement(folder, tmp_path):
    from matplotlib.image import imread

    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    options = SceneOptions(quantity="displacement", size=(400, 300))
    picture = imread(screenshot(folder, tmp_path / "scene.png", options))
    saturation = np.ptp(picture[..., :3], axis=2)
    assert (saturation > 0.3).mean() > 0.05  # a whole ring, where patches are a tenth of that


def test_scene_states_its_factor(folder):
    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    from oilfilm.postprocess.scene.drawing import deformed_rings, deformed_surface, shown_factor

    assert shown_factor(17.0, 12.0) == 100.0  # 1.7 of 12 mm
    assert shown_factor(0.5, 12.0) == 2000.0
    assert shown_factor(1e5, 12.0) == 1.0
    (ring,) = deformed_rings(folder).values()
    still, moved = (deformed_surface(ring, factor, None) for factor in (0.0, 100.0))
    shift = np.linalg.norm(np.asarray(moved.points) - np.asarray(still.points), axis=1)
    assert_allclose(shift.max(), 0.1 * np.asarray(ring[DISTANCE]).max(), rtol=1e-4)
    up = np.array([0.0, 1.0, 0.0])
    assert np.asarray(deformed_surface(ring, 0.0, up).points)[:, 1].max() < 1e-6


def test_a_loose_seat_that_pulls_is_told(results):
    """3000 N over pi 20 mm 18 mm: 2.65 MPa on the far side, which a loose seat cannot carry."""
    (_, message) = ring_messages(results.quasistatic)
    assert "2.65 MPa" in message

"""The VTK collection: read back with pyvista, checked against the geometry it stands for; no window is opened."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.postprocess.scene.geometry import (
    ContactFrame,
    Placement,
    bearing_lengths,
    place_patch,
    ring_shape,
    ring_surface,
)
from oilfilm.postprocess.scene.vtk import (
    FILM,
    PRESSURE,
    TEMPERATURE,
    bodies,
    collection_text,
    flat_patch,
    groove_axial,
    write_collection,
    write_subsurface,
)

from ..conftest import made_up_results

pv = pytest.importorskip("pyvista")


@pytest.fixture(scope="module")
def collection(bearing_results, tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    write_collection(bearing_results, folder)
    moved = folder.with_name("moved")
    shutil.move(folder, moved)
    return pv.get_reader(moved / "fields.pvd").read()[0]


def test_one_block_per_ball_and_race(collection, bearing_results):
    names = {(g, b) for g in collection.keys() for b in collection[g].keys()}  # noqa: SIM118
    solved = {(f"ball{c.ball:02d}", c.race.value) for c in bearing_results.contacts if c.conditions is not None}
    assert names == solved | {("bodies", n) for n in ("balls", "inner ring", "outer ring", "cage")}


def test_steps_of_the_azimuth_hold_the_films_there(bearing_results, tmp_path):
    write_collection(bearing_results, tmp_path)
    reader = pv.get_reader(tmp_path / "azimuth.pvd")
    azimuths = sorted({round(float(np.degrees(c.azimuth)) % 360.0, 6) for c in bearing_results.contacts})
    assert_allclose(reader.time_values, azimuths)
    reader.set_active_time_value(azimuths[1])
    shown = reader.read()[0]
    assert set(shown.keys()) == {"ball02", "bodies"}
    assert set(shown["ball02"].keys()) == {"inner", "outer"}
    radius = np.hypot(*shown["ball02"]["outer"].center[1:])
    turn = np.arctan2(shown["ball02"]["outer"].center[2], shown["ball02"]["outer"].center[1])
    assert radius > 30.0  # [mm]
    assert np.degrees(turn) == pytest.approx(azimuths[1], abs=1.0)


def test_collections_name_their_steps():
    text = collection_text({2.5e-3: "b.vtm", 0.0: "a.vtm"})
    assert text.index("a.vtm") < text.index("b.vtm")
    assert 'timestep="0.0025"' in text


def test_fields_carry_units_and_values(collection, bearing_results):
    solution = bearing_results.fields[0]
    block = collection["ball01"]["inner"]
    assert_allclose(np.sort(block[FILM]), np.sort(solution.film.ravel() * 1e6), rtol=1e-6)  # float32
    assert_allclose(block[PRESSURE].max(), solution.pressure_maximum * 1e-9, rtol=1e-6)
    assert block.field_data["race"][0] == "inner"
    assert block.field_data["film exaggeration [-]"][0] == 0.0


def test_patches_lie_on_their_balls(collection, bearing_results):
    for contact in bearing_results.contacts:
        if contact.conditions is None:
            continue
        block = collection[f"ball{contact.ball:02d}"][contact.race.value]
        centre = (contact.origin - 0.006 * contact.normal) * 1e3
        assert_allclose(np.linalg.norm(block.points - centre, axis=1), 6.0, rtol=1e-5)  # float32 at 40 mm
        nearest = block.points[block[PRESSURE].argmax()]
        assert_allclose(nearest, contact.origin * 1e3, atol=0.05)  # the made-up pressure peaks at the nearest node


def test_balls_stand_at_their_azimuths(bearing_results):
    """In the order of their numbers: azimuths that mirror each other are not to be exchanged."""
    points = bodies(bearing_results)["balls"].points.reshape(9, -1, 3)
    contacts = [c for c in bearing_results.contacts if c.race.value == "outer"]
    centres = np.stack([c.origin - 0.006 * c.normal for c in contacts])
    assert_allclose(0.5 * (points.min(axis=1) + points.max(axis=1)), centres, atol=1e-5)
    assert_allclose(np.degrees(np.arctan2(centres[:, 2], centres[:, 1])) % 360.0, 40.0 * np.arange(9), atol=1e-6)


def test_grooves_stand_behind_their_contacts():
    """Under thrust on the inner ring, +x: its groove's centre moves on by the ring's way, the outer one's stays."""
    results = made_up_results((500.0, 0.0, 0.0))
    inner, outer = (groove_axial(results, race, 1) for race in ("inner", "outer"))
    state = results.quasistatic
    ring = float(state.displacement[0])
    assert ring > 1e-5
    assert outer == pytest.approx(0.0, abs=2e-6)  # the deflection of the contacts
    assert inner == pytest.approx(ring, abs=2e-6)


@pytest.mark.parametrize("inner", [True, False])
def test_normals_of_a_groove_point_to_the_balls(bearing_results, inner):
    """Also those of the ring's other faces point out of it: the flux of the place is three times the volume."""
    shape = ring_shape(bearing_lengths(bearing_results.quasistatic.bearing), inner)
    surface = ring_surface(shape, 0.0, (0.0, 0.0))
    a, b, c, d = (surface.points[surface.quads[:, k]] for k in range(4))
    normal = 0.5 * np.cross(c - a, d - b)
    middle = 0.25 * (a + b + c + d)
    outward = (normal[:, 1:] * middle[:, 1:]).sum(axis=1) * (1.0 if inner else -1.0)
    radius = np.hypot(middle[:, 1], middle[:, 2])
    near_balls = np.abs(radius - 0.03) < np.abs(radius - shape.base_radius)
    facing = near_balls & (np.abs(normal[:, 0]) < 0.99 * np.linalg.norm(normal, axis=1))
    assert facing.sum() > 1000
    assert (outward[facing] > 0.0).all()
    assert 3e-6 < (normal * middle).sum() / 3.0 < 5e-5  # [m3]


def test_raceways_enclose_the_balls(bearing_results):
    bearing = bearing_results.quasistatic.bearing
    for inner in (True, False):
        points = ring_surface(ring_shape(bearing_lengths(bearing), inner), 0.0, (0.0, 0.0)).points
        centre = np.stack([np.zeros(len(points)), points[:, 1], points[:, 2]])
        centre *= 0.03 / np.hypot(points[:, 1], points[:, 2])
        assert np.linalg.norm(points - centre.T, axis=1).min() > 0.006


def test_centres_of_the_grooves_are_those_of_the_bearing(bearing_results):
    bearing = bearing_results.quasistatic.bearing
    lengths = bearing_lengths(bearing)
    assert_allclose(ring_shape(lengths, inner=True).centre_radius, bearing.inner_centre_radius, rtol=1e-14)
    assert_allclose(ring_shape(lengths, inner=False).centre_radius, bearing.outer_centre_radius, rtol=1e-14)


def test_cut_ring_leaves_its_sector_open(bearing_results):
    shape = ring_shape(bearing_lengths(bearing_results.quasistatic.bearing), inner=False)
    points = ring_surface(shape, 0.0, (0.5, np.pi)).points
    turn = np.angle(np.exp(1j * (np.arctan2(points[:, 2], points[:, 1]) - 0.5)))
    assert np.abs(turn).min() >= 0.5 * np.pi - 1e-9


def test_magnified_patch_keeps_distances_times_the_factor():
    frame = ContactFrame(
        origin=np.zeros(3), axis_x=np.eye(3)[0], axis_y=np.eye(3)[1], normal=np.eye(3)[2], ball_radius=0.006
    )
    x, y = np.array([[1e-4]]), np.array([[0.0]])
    point = place_patch(x, y, frame, Placement(rolling=15.0))[0, 0]
    angle = np.arctan2(point[0], point[2] + 0.006)
    assert_allclose(angle * 0.006, 15.0 * 1e-4, rtol=1e-12)


def test_film_exaggeration_lifts_the_patch(bearing_results, tmp_path):
    write_collection(bearing_results, tmp_path, patch_magnification=(3.0, 1.0), film_exaggeration=100.0)
    block = pv.read(tmp_path / "vtk" / "ball01_outer.vts")
    contact = bearing_results.contacts[1]
    height = np.linalg.norm(block.points - (contact.origin - 0.006 * contact.normal) * 1e3, axis=1) - 6.0
    assert_allclose(height, 100.0 * block[FILM] * 1e-3, atol=1e-5)  # float32 at 40 mm
    assert block.field_data["patch magnification rolling [-]"][0] == 3.0


def test_single_contact_is_flat(contact_results, moes_results, tmp_path):
    write_collection(contact_results, tmp_path / "si")
    block = pv.get_reader(tmp_path / "si" / "fields.pvd").read()[0]["contact"]["contact"]
    assert np.ptp(block.points[:, 2]) == 0.0
    assert_allclose(block.points[:, 0].min(), contact_results.solution.x[0] * 1e3, rtol=1e-6)
    solution = contact_results.solution
    assert_allclose(np.sort(block[FILM]), np.sort(solution.film.ravel() * 1e6), rtol=1e-6)  # float32
    assert_allclose(block[PRESSURE].max(), solution.pressure_maximum * 1e-9, rtol=1e-6)
    write_collection(moes_results, tmp_path / "moes")
    block = pv.get_reader(tmp_path / "moes" / "fields.pvd").read()[0]["contact"]["contact"]
    assert "film thickness [a^2/Rx]" in block.point_data


def test_temperature_of_a_film_in_degrees_celsius(contact_results):
    """40 C at the inlet side, warmer by 25 K in the middle."""
    solution = contact_results.solution
    kelvin = 313.15 + 25.0 * solution.P / solution.P.max()
    state = SimpleNamespace(temperature=kelvin)
    block = pv.wrap(flat_patch(replace(solution, state=state), 0.0))
    assert_allclose(block[TEMPERATURE].min(), 40.0, rtol=1e-6)
    assert_allclose(block[TEMPERATURE].max(), 65.0, rtol=1e-6)


def von_mises(stress):
    """Of components xx yy zz xy yz xz, in their unit."""
    xx, yy, zz, xy, yz, xz = stress
    pairs = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * pairs + 3.0 * (xy**2 + yz**2 + xz**2))


@pytest.mark.slow
def test_writing_needs_no_rendering_library():
    code = (
        "import sys, oilfilm.postprocess.scene.vtk, oilfilm.postprocess.scene.vtk_history, vtkmodules.vtkIOXML; "
        "print(any('Rendering' in m or 'pyvista' in m for m in sys.modules))"
    )
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "False"


def test_stress_below_the_contacts_on_request(bearing_results, tmp_path):
    """One volume a solved contact, its surface on the ball, the largest shear near that of Hertz (0.3 p_h)."""
    assert write_subsurface(bearing_results, tmp_path) is None
    case = {**bearing_results.case, "ehl": {"subsurface_stress": True}}
    first = (bearing_results.solutions[0],) + (None,) * (len(bearing_results.solutions) - 1)
    path = write_subsurface(replace(bearing_results, case=case, solutions=first), tmp_path)
    block = pv.get_reader(path).read()[0]["ball01"]["inner"]
    contact, hertz = bearing_results.contacts[0], bearing_results.contacts[0].hertz
    centre = (contact.origin - 0.006 * contact.normal) * 1e3
    surface = block["depth [mm]"] == 0.0
    assert_allclose(np.linalg.norm(block.points[surface] - centre, axis=1), 6.0, rtol=1e-5)
    assert_allclose(np.linalg.norm(block.points - centre, axis=1), 6.0 + block["depth [mm]"], rtol=1e-4)
    assert block["depth [mm]"].max() > 0.1  # some semi-axes
    shear = block["largest shear [GPa]"]
    assert shear.max() == pytest.approx(0.3e-9 * hertz.pressure, rel=0.15)  # the fixture's pressure is made up
    components = block["stress xx yy zz xy yz xz [GPa]"]
    assert components.shape == (block.n_points, 6)
    assert_allclose(block["von Mises stress [GPa]"], von_mises(components.T), rtol=1e-3, atol=1e-4)
    assert block["stress xx yy zz xy yz xz [GPa]"][surface, 2].min() == pytest.approx(-1e-9 * hertz.pressure, rel=0.1)

"""Traction tables: lookups against NumPy and against shear in the films, range, storage, normal response.

The four constants follow from (kappa_0, kappa_max at s_max, kappa_inf) = (0, 0.05 at 0.03, 0.03); the line model of
curvature slip under constant friction as in test_shear.
"""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm import ehl
from oilfilm.ehl.conditions import ContactKinematics, contact_kinematics
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction import normal_response
from oilfilm.ehl.traction.film_quadrature import film_quadrature, sliding_forces
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb, coefficient
from oilfilm.ehl.traction.linear_response import NormalResponse, ResponseValue
from oilfilm.ehl.traction.rolling_moment import rolling_moment
from oilfilm.ehl.traction.shear import ContactShape, EllipseLaw, integrate_traction
from oilfilm.ehl.traction_table import build
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table, spin_free_motions
from oilfilm.ehl.traction_table.compression import VALUE_STEP, compressed, decompressed, stored_values, whole_numbers
from oilfilm.ehl.traction_table.splines import node_values, spline_coefficients, spline_weights
from oilfilm.ehl.traction_table.storage import inputs_digest, load_table, save_table
from oilfilm.ehl.traction_table.table import FullSolve, TableContact, TableRange, load_coordinate

from ....reference.ehl import traction as reference

RHEOLOGY = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=2.0 * 0.047 / 18e-9, limiting_coefficient=0.047)
CIRCLE = TableContact(
    radius_x=10e-3,
    radius_y=10e-3,
    reduced_modulus=226e9,
    lubricant=ehl.Lubricant(viscosity=0.04, pressure_viscosity=18e-9),
    rheology=RHEOLOGY,
    temperature=313.15,
    curvature_radius=0.5,
    curvature_difference=50.0,
)
LIMITS = TableRange(load=(40.0, 80.0), speed=(1.0, 2.0), slide_x=0.5, slide_y=0.3, spin=0.3)
DIGEST = "44878706143f430ab0082a2bb5297abf5e6fdc21521aeb65d0aa0355aafbcbdf"  # of both, in files of format 10
OPTIONS = TableOptions(points=65, tolerance=0.02, check_films=3, check_motions=40, rounds=1, nodes=(5, 4, 21, 9, 13))


@pytest.fixture(scope="module")
def table():
    return build_traction_table(CIRCLE, LIMITS, OPTIONS)


def motions(count, seed):
    rng = np.random.default_rng(seed)
    for share in rng.uniform(-1.0, 1.0, (count, 5)):
        load, speed = 60.0 + 19.0 * share[0], 1.5 + 0.49 * share[1]
        yield load, speed, 0.4 * share[2] ** 3 * speed, 0.3 * share[3] ** 3 * speed, 0.3 * share[4] ** 3 * speed / 10e-3


def test_compiled_lookup_agrees_with_its_reference(table):
    for motion in motions(40, 71934):
        assert_allclose(table.forces(*motion)[:8], reference.table_forces(table, *motion), rtol=1e-9, atol=1e-12)


def test_whole_numbers_of_lookups_are_as_fine_as_those_of_files(table):
    """Coefficients are off by half a unit, at the ends of load and speed what follows by up to three times that each:
    0.03 % of a film's largest forces and moments at worst in this table.
    """
    unit = whole_numbers(table.values)[1]
    assert unit <= VALUE_STEP
    for row, speed in ((0, LIMITS.speed[0]), (-1, LIMITS.speed[1])):
        load = LIMITS.load[row]
        for _, at, *sliding in motions(20, 60417 + row):
            motion = (load, speed, *(part * speed / at for part in sliding))
            found = table.forces(*motion)
            wanted = reference.table_forces(table, *motion, whole=False)
            off = np.array(found[:4]) - wanted[:4]
            largest = table.units(load, speed)[[0, 0, 1, 2]]
            assert np.all(np.abs(off) <= 4.5 * unit * largest)
            assert 4.5 * unit < 3e-4


def test_lookup_agrees_with_shear_in_a_film_solved_there(table):
    """Within the error that the table states, for a load and motions that are not in it."""
    load, speed = 53.0, 1.37
    solution = ehl.solve_contact(CIRCLE.conditions(load, speed), ehl.SolverOptions(points=65))
    largest = table.units(load, speed)
    errors = []
    for _, other, *motion_at_other in motions(40, 88123):
        slide_x, slide_y, spin = (part * speed / other for part in motion_at_other)
        motion = replace(
            contact_kinematics(
                CIRCLE.conditions(load, speed), curvature_radius=0.5, curvature_width=solution.semi_axis_x
            ),
            sliding_x=slide_x,
            sliding_y=slide_y,
            spin=spin,
            curvature_difference=50.0,
            rolling=speed / 10e-3 - 25.0 * slide_x,
        )
        wanted = integrate_traction(
            solution, motion, RHEOLOGY, temperature=313.15, rolling_resistance=rolling_moment(solution).value
        )
        found = table.forces(load, speed, slide_x, slide_y, spin)
        assert found.outside == ()
        errors.append(np.hypot(found.force_x - wanted.force_x, found.force_y - wanted.force_y) / largest[0])
        assert_allclose(found.rolling_moment, wanted.rolling_moment_1, rtol=0.05)
        assert found.power_loss > 0.0
    assert np.quantile(errors, 0.95) < 0.03
    assert_allclose(found.film, solution.film_central, rtol=0.01)


def test_table_states_its_error(table):
    error = table.error
    assert error.rms < error.quantile < error.largest
    assert 0.0 < error.largest_straight < 0.02
    assert error.responses == 3 and 0.0 < error.largest_stiffness < 0.02 and 0.0 < error.largest_damping < 0.05
    assert 4 <= error.films <= 7  # three random ones, and where the splines bend most
    assert (error.motions, table.films) == (40, 20 + error.films)
    assert table.converged == (error.largest <= 0.02)


def test_error_is_that_of_points_not_in_the_table(table):
    """Its check has films between the nodes; a table of fewer nodes for the motions states a larger error."""
    coarse = build_traction_table(CIRCLE, LIMITS, replace(OPTIONS, nodes=(5, 4, 9, 5, 7)))
    assert coarse.error.largest > 2.0 * table.error.largest
    assert coarse.error.largest_straight > 2.0 * table.error.largest_straight
    assert not coarse.converged
    assert "above 2.00%" in coarse.message


def test_check_draws_rolling_without_spin():
    """Slides in every factor of ten from 1e-7 on, both signs, along or across alone and together; some with spin."""
    slide_x, slide_y, spin = spin_free_motions(CIRCLE, LIMITS, 60.0, np.random.default_rng(3), 600)
    straight = spin == 0.0
    assert np.count_nonzero(straight) == 400
    assert np.abs(spin).max() == abs(spin[0]) == LIMITS.spin and slide_x[0] == slide_y[0] == 0.0
    assert np.all((np.abs(spin[~straight]) >= 1e-5) & (np.abs(spin[~straight]) <= LIMITS.spin))
    for slide, other in ((slide_x, slide_y), (slide_y, slide_x)):
        alone = slide[straight & (other == 0.0)]
        for sign in (-1.0, 1.0):
            counts, _ = np.histogram(np.log10(np.abs(alone[sign * alone > 0.0])), np.arange(-7, 0))
            assert np.all(counts > 0)
    assert np.any(straight & (slide_x != 0.0) & (slide_y != 0.0))


def test_check_draws_motions_at_which_a_body_nearly_stands_still():
    limits = replace(LIMITS, slide_x=2.0)
    slide_x, slide_y, spin = build.standstill_motions(limits, np.random.default_rng(4), 600)
    gap = 2.0 - np.abs(slide_x)
    assert np.count_nonzero(gap == 0.0) == 75
    counts, _ = np.histogram(np.log10(gap[gap > 0.0]), [-3.0, -2.0, -1.0, 0.0])
    assert np.all(counts > 90)
    for part, limit in ((slide_y, limits.slide_y), (spin, limits.spin)):
        assert np.any(part == 0.0) and 0.5 * limit < part.max() <= limit and -limit <= part.min() < -0.5 * limit
    assert {-1.0, 1.0} == set(np.sign(slide_x))
    narrow, *_ = build.standstill_motions(LIMITS, np.random.default_rng(4), 600)
    assert np.abs(narrow).max() == LIMITS.slide_x


def test_check_draws_films_where_the_splines_bend_most(table):
    """A kink of the force between two loads, at one speed, and another of the spin moment."""
    values = np.zeros_like(table.values)
    values[3, 1, ..., 0] = 0.5  # coefficients stand one before the nodes
    values[4, 4, ..., 2] = 0.5
    found = build.adaptive_check_points(replace(table, values=values, scalars=np.zeros_like(table.scalars)))
    counted = [[load_coordinate(np.exp(q)), u] for q, u in found]
    places = (np.array(counted) - table.axes[:2, 0]) * table.axes[:2, 1]
    slow, fast = places[0], places[-1]
    assert slow[0] % 1.0 == pytest.approx(0.5) and 1.0 < slow[0] < 3.0 and slow[1] == pytest.approx(0.5)
    assert fast[0] % 1.0 == pytest.approx(0.5) and 2.0 < fast[0] < 4.0 and fast[1] == pytest.approx(2.5)


def test_mirror_image_in_y(table):
    for load, speed, slide_x, slide_y, spin in motions(10, 30291):
        one, other = (
            table.forces(load, speed, slide_x, slide_y, spin),
            table.forces(load, speed, slide_x, -slide_y, -spin),
        )
        assert_allclose(
            [other.force_x, -other.force_y, -other.spin_moment, other.rolling_moment],
            [one.force_x, one.force_y, one.spin_moment, one.rolling_moment],
            rtol=1e-9,
        )


def test_message_tells_how_far_stiffness_and_damping_are_off(table):
    error = replace(table.error, largest_stiffness=0.01, largest_damping=0.08)
    values = [ResponseValue(value=2.0, uncertainty=bar) for bar in (0.06, 0.2)]
    response = NormalResponse(
        stiffness=values[0], damping=values[1], converged=True, resolved=True, message="converged"
    )
    film = SimpleNamespace(response=response)
    told = build.response_message([film, SimpleNamespace(response=None)], error)
    assert "stiffness is off by up to 1.0%, damping by 8.0%" in told and "up to 3.0% and 10.0%" in told
    for small in (0.04, np.nan):
        assert not build.response_message([film], replace(error, largest_damping=small, largest_stiffness=small))


def test_a_share_of_the_rolling_moment_costs_no_new_numbers(table):
    """Torque points with heat of the inlet ask for one each."""
    share = table.with_rolling(0.5)
    assert share.kernel_arguments()[3] is table.kernel_arguments()[3]
    whole, half = (one.forces(60.0, 5.0, 0.0, 0.0, 0.0).rolling_moment for one in (table, share))
    assert half == pytest.approx(0.5 * whole, rel=1e-9)


def test_halves_of_the_mirror_image_meet(table):
    """Without slide_y and spin nothing pulls across, to round-off; with spin, no step and no bend at slide_y = 0."""
    for load, speed, slide_x, _, spin in motions(10, 55418):
        straight = table.forces(load, speed, slide_x, 0.0, 0.0)
        largest = table.units(load, speed)
        assert_allclose([straight.force_y, straight.spin_moment], 0.0, atol=1e-14 * largest[0])
        step = 1e-8 * speed
        below, at, above = (np.array(table.forces(load, speed, slide_x, k * step, spin)[:4]) for k in (-1, 0, 1))
        assert_allclose(above - at, at - below, rtol=1e-3, atol=1e-11 * largest[0])


def test_packed_values_are_the_same_whole_numbers(table):
    """Splines pass through the values at the nodes, rounded; a file has them, and gives the same splines."""
    values = np.random.default_rng(60331).standard_normal((5, 4, 6, 4, 7, 4))
    stored = stored_values(values)
    assert_allclose(
        node_values(stored.astype(float), (0, 1, 2, 3, 4))[:, :, :, 1:], values[:, :, :, 1:], atol=0.51 * VALUE_STEP
    )
    assert np.array_equal(decompressed(compressed(stored), stored.shape), stored)
    assert compressed(table.values).nbytes < 0.2 * table.values.nbytes
    other = stored + np.float32(0.5 * VALUE_STEP)
    assert np.array_equal(decompressed(compressed(other), other.shape), other)
    with pytest.raises(ValueError, match="reshape"):
        decompressed(other, (*other.shape[:5], 3))


def test_values_meet_their_mirror_image():
    """Where a film that is not quite symmetric has left a step at slide_y = 0: the mean of both counts."""
    values = np.random.default_rng(41220).standard_normal((4, 4, 4, 6, 5, 4))
    joined, signs = stored_values(values), np.array([1.0, -1.0, -1.0, 1.0])
    assert_allclose(joined[:, :, :, 1], signs * joined[:, :, :, 1, ::-1], atol=1e-6)
    assert_allclose(joined[:, :, :, 0], signs * joined[:, :, :, 2, ::-1], atol=1e-6)
    seam = 0.5 * (values[:, :, :, 0] + signs * values[:, :, :, 0, ::-1])
    assert_allclose(node_values(joined.astype(float), (0, 1, 2, 3, 4))[:, :, :, 0], seam, atol=0.51 * VALUE_STEP)


@pytest.mark.parametrize(
    ("motion", "outside"),
    [
        ((39.0, 1.5, 0.0, 0.0, 0.0), "load below"),
        ((60.0, 2.1, 0.0, 0.0, 0.0), "speed above"),
        ((60.0, 1.5, 0.9, 0.0, 0.0), "slide_x"),
        ((60.0, 1.5, 0.0, -0.6, 0.0), "slide_y"),
        ((60.0, 1.5, 0.0, 0.0, -60.0), "spin"),
    ],
)
def test_what_lies_outside_is_told(table, motion, outside):
    assert outside in table.forces(*motion).outside


def test_below_its_smallest_load_forces_fall_with_the_load(table):
    edge, below = table.forces(40.0, 1.5, 0.1, 0.0, 0.0), table.forces(20.0, 1.5, 0.1, 0.0, 0.0)
    assert_allclose(below.force_x, 0.5 * edge.force_x, rtol=1e-12)


def test_saved_table_is_the_same(table, tmp_path):
    save_table(table, tmp_path / "table.npz")
    read = load_table(tmp_path / "table.npz", inputs_digest(CIRCLE, LIMITS, 65))
    assert read.contact == table.contact
    assert read.error == table.error
    motion = (50.0, 1.2, 0.1, -0.02, 3.0)
    assert read.forces(*motion) == table.forces(*motion)
    assert [path.name for path in tmp_path.iterdir()] == ["table.npz"]


def test_damaged_or_foreign_files_are_refused(table, tmp_path):
    path = tmp_path / "table.npz"
    save_table(table, path)
    with pytest.raises(ValueError, match="made for another"):
        load_table(path, inputs_digest(replace(CIRCLE, temperature=333.15), LIMITS, 65))
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(ValueError, match="damaged"):
        load_table(path)
    path.write_text("no archive")
    with pytest.raises(ValueError, match="no traction table"):
        load_table(path)
    np.savez(path, document=np.array(json.dumps({"format": "else"})), axes=0.0, scalars=0.0, values=0.0)
    with pytest.raises(ValueError, match="no traction table"):
        load_table(path)


def test_heat_and_full_solves_are_kept(table, tmp_path):
    """Another digest than without heat; a full solve that ran away comes back as no number."""
    steel = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=470.0, temperature=320.0)
    good = FullSolve(load=50.0, speed=1.5, slide_ratio=0.01, by_film=0.02, in_full=0.01, film_ratio=0.9, converged=True)
    lost = replace(good, in_full=np.nan, film_ratio=np.nan, converged=False)
    warm = replace(table, contact=replace(CIRCLE, solids=(steel, steel)), full_solves=(good, lost))
    save_table(warm, tmp_path / "table.npz")
    found = load_table(tmp_path / "table.npz", inputs_digest(warm.contact, LIMITS, 65))
    assert found.contact == warm.contact
    assert found.full_solves[0] == good
    assert np.isnan(found.full_solves[1].in_full)
    with pytest.raises(ValueError, match="another contact, oil"):
        load_table(tmp_path / "table.npz", inputs_digest(CIRCLE, LIMITS, 65))


def test_types_keep_their_names_in_files(table, tmp_path):
    """Those of format 10, wherever the classes stand: modules may move, files written before stay readable, and their
    digests equal. What the file names is a class, by its own name; the values of enumerations stand as they are.
    """
    save_table(table, tmp_path / "table.npz")
    with np.load(tmp_path / "table.npz") as file:
        document = json.loads(str(file["document"]))
    contact = document["contact"]
    assert contact["class"] == "TableContact"
    assert contact["lubricant"]["class"] == "Lubricant"
    assert contact["lubricant"]["viscosity_law"] == "roelands"
    assert contact["rheology"]["class"] == "Rheology"
    assert contact["rheology"]["law"] == "ree-eyring"
    assert [document[part]["class"] for part in ("range", "error")] == ["TableRange", type(table.error).__name__]
    assert "ehl." not in json.dumps(document)
    assert document["inputs"] == inputs_digest(CIRCLE, LIMITS, 65) == DIGEST


@pytest.mark.parametrize("version", [6, 7, 8, 9])
def test_files_of_an_older_format_are_refused(table, tmp_path, version):
    path = tmp_path / "table.npz"
    save_table(table, path)
    with np.load(path) as file:
        parts = {name: file[name] for name in file.files}
    document = json.loads(str(parts["document"]))
    parts["document"] = np.array(json.dumps(document | {"format_version": version}))
    np.savez(path, **parts)
    with pytest.raises(ValueError, match=f"format version {version}, this program reads 10; make the table again"):
        load_table(path)


def test_changed_content_is_noticed(table, tmp_path):
    path = tmp_path / "table.npz"
    save_table(table, path)
    with np.load(path) as file:
        parts = {name: file[name] for name in file.files}
    parts["scalars"] = parts["scalars"] + 1e-6
    np.savez(path, **parts)
    with pytest.raises(ValueError, match="damaged"):
        load_table(path)


def test_spline_passes_through_its_values_and_reproduces_cubics():
    nodes = np.arange(7.0)
    coefficients = spline_coefficients(nodes**3 - 2.0 * nodes, (0,))
    for place in (0.0, 0.3, 2.5, 5.9, 6.0):
        first, weights = spline_weights(place, 7)
        assert_allclose(weights @ coefficients[first : first + 4], place**3 - 2.0 * place, atol=1e-10)


def test_sums_over_a_film(solution):
    """The kernel agrees with NumPy, and its thinned nodes with the integrals over the whole grid."""
    nodes = film_quadrature(solution, RHEOLOGY)
    motion = ContactKinematics(
        entrainment_speed=15.08,
        sliding_x=0.15,
        sliding_y=0.05,
        spin=50.0,
        rolling=3142.0,
        curvature_radius=6.08e-3,
        curvature_width=nodes.half_width,
    )
    slide = tuple(np.array([value]) for value in (0.15, 0.05, 50.0))
    found = sliding_forces(nodes, slide, np.array([3142.0]), 0.5 / 6.08e-3)[0]
    assert_allclose(found, reference.sliding_forces(nodes, motion), rtol=1e-10)
    whole = integrate_traction(solution, motion, RHEOLOGY)
    assert_allclose(found[:2], [whole.sliding_force_x, whole.sliding_force_y], atol=3e-3 * 0.047 * 500.0)


@pytest.mark.parametrize(("spin", "limit"), [(0.0, 0.0015), (0.01, 0.001), (0.1, 0.001)])
def test_strips_of_a_film_are_close_enough(solution, monkeypatch, spin, limit):
    """96 strips between 64 lines against 1024 lines, near rolling, where a strip's sliding changes its sign."""
    pair = replace(CIRCLE, radius_x=4.8e-3, radius_y=12e-3, curvature_radius=6.08e-3)
    limits = TableRange(load=(10.0, 1000.0), speed=(1.0, 20.0))
    slide_x, slide_y, _ = spin_free_motions(pair, limits, 500.0, np.random.default_rng(7), 120)
    turns = np.full(120, spin)
    slide = (slide_x * 15.08, slide_y * 15.08, turns * 15.08 / 4.8e-3)
    rolling = np.full(120, 15.08 / 4.8e-3)
    forces = []
    for lines in (64, 1024):
        monkeypatch.setattr("oilfilm.ehl.traction.film_quadrature.LINES", lines)
        forces.append(sliding_forces(film_quadrature(solution, RHEOLOGY), slide, rolling, 0.5 / 6.08e-3)[:, :2])
    assert np.hypot(*(forces[0] - forces[1]).T).max() < limit * np.hypot(*forces[1].T).max()


def spin_moments(conditions):
    """Of slides along, across and of spin, over the largest, on a film's nodes."""
    film = film_quadrature(ehl.solve_contact(conditions, ehl.SolverOptions(points=65)), RHEOLOGY)
    slide = (np.array([30.0, 1.5, 7.5, 0.0]), np.array([0.0, 0.0, 7.5, 0.0]), np.array([0.0, 0.0, 0.0, 1500.0]))
    moments = sliding_forces(film, slide, np.zeros(4), 0.0)[:, 2]
    return moments / np.abs(moments).max()


@pytest.mark.parametrize("load", [15.0, 100.0])
def test_oil_around_a_light_contact_has_its_spin_moment(conditions, monkeypatch, load):
    """Sliding along has none; blocks of the grid have those of all its nodes to 0.5 %."""
    moments = spin_moments(replace(conditions, load=load))
    assert np.abs(moments[:2]).max() < 1e-9
    monkeypatch.setattr("oilfilm.ehl.traction.film_quadrature.BLOCKS", 1000)
    assert_allclose(moments, spin_moments(replace(conditions, load=load)), atol=5e-3)


@pytest.mark.parametrize("load", [15.0, 500.0])
def test_stiffness_is_that_of_neighbouring_loads(conditions, load):
    """-dF/dh_0 between loads 5 % apart, 6 %: their boxes differ; far below Hertz' in the thick film of 15 N."""
    options = ehl.SolverOptions(points=129)
    low, high = (ehl.solve_contact(replace(conditions, load=part * load), options) for part in (1 / 1.05, 1.05))
    response = normal_response(replace(conditions, load=load), options)
    h_0 = [s.approach_dimensionless.finest * s.film_scale for s in (low, high)]
    assert response.converged
    assert response.damping.value > 0.0
    assert_allclose(response.stiffness.value, (1.05 - 1 / 1.05) * load / (h_0[0] - h_0[1]), rtol=0.06)


SHAPE = ContactShape(semi_axis_x=1e-4, semi_axis_y=6e-4, radius_x=4.8e-3, curvature_radius=6e-3)


@pytest.mark.parametrize(
    ("given", "expected"),
    [((0.05, 0.03, 0.03), (-0.03, 3.64488, 45.9363, 0.03)), ((0.05, 1.0, 0.036), (-0.036, 0.10178, 1.5473, 0.036))],
)
def test_four_constants_from_a_traction_curve(given, expected):
    law = FourConstants.of_curve(*given)
    assert_allclose((law.a, law.b, law.c, law.d), expected, rtol=5e-5)
    slides = np.linspace(0.5, 1.5, 2001) * given[1]
    largest = max(coefficient(law.kernel_law, slide, 1.0) for slide in slides)
    assert_allclose(largest, given[0], rtol=1e-6)


@pytest.mark.parametrize("zero", [0.01, 0.03, 0.04])
def test_four_constants_with_friction_at_no_slide(zero):
    law = FourConstants.of_curve(0.05, 0.03, 0.03, zero)
    a, b, c, d = law.a, law.b, law.c, law.d
    assert_allclose(a + d, zero, atol=1e-12)
    assert_allclose((a + b * 0.03) * np.exp(-c * 0.03) + d, 0.05)
    assert_allclose(b, c * (a + b * 0.03))


@pytest.mark.parametrize(
    "law",
    [
        EllipseLaw(SHAPE, RampedCoulomb(friction=0.05, slide_none=0.01, slide_full=0.1)),
        EllipseLaw(SHAPE, FourConstants(-0.03, 3.64, 45.9, 0.03)),
    ],
    ids=["coulomb", "four constants"],
)
def test_compiled_law_agrees_with_its_reference(law):
    for motion in motions(20, 11773):
        assert_allclose(law.forces(*motion)[:4], reference.law_forces(law, *motion), rtol=1e-9, atol=1e-14)


def test_coulomb_law_on_the_ellipse():
    """Sliding as a whole mu Q; below the dead band nothing; curvature slip as the line model, 3 % of its quadrature."""
    coulomb = RampedCoulomb(friction=0.05, slide_none=1e-3, slide_full=2e-3)
    flat = EllipseLaw(replace(SHAPE, curvature_radius=np.inf), coulomb)
    assert_allclose(flat.forces(500.0, 15.0, -1.0, 0.0, 0.0).force_x, 25.0)
    assert flat.forces(500.0, 15.0, 5e-4, 0.0, 0.0).force_x == 0.0
    law = EllipseLaw(SHAPE, RampedCoulomb(friction=0.05, slide_full=1e-9))
    b = 6e-4 * 500.0 ** (1 / 3)
    slide = 15.0 / 4.8e-3 * (0.347296 * b) ** 2 / (2.0 * 6e-3)
    found = law.forces(500.0, 15.0, slide, 0.0, 0.0)
    assert abs(found.force_x) < 0.03 * 25.0
    assert_allclose(found.rolling_moment, -25.0 * b**2 / (2.0 * 6e-3) * 0.161142, rtol=0.03)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: RampedCoulomb(friction=-1.0), "friction"),
        (lambda: RampedCoulomb(slide_none=2.0, slide_full=1.0), "slide_full"),
        (lambda: FourConstants(dead_band=0.0), "dead_band"),
        (lambda: FourConstants.of_curve(0.02, 0.03, 0.03), "largest"),
        (lambda: TableRange(load=(0.0, 1.0), speed=(1.0, 2.0)), "load"),
        (lambda: TableRange(load=(1.0, 2.0), speed=(1.0, 2.0), spin=0.0), "spin"),
    ],
)
def test_bad_input_names_the_field(make, field):
    with pytest.raises(ValueError, match=field):
        make()

"""Shaft on bearings: closed forms of beams, statics by hand, rows of balls as supports, growth, whirl."""

from dataclasses import replace

import numpy as np
import pytest
import scipy
from numpy.testing import assert_allclose

import oilfilm
from oilfilm.bearing import Operation, QuasistaticModel, load_bearing, load_material, solve_quasistatic
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.films.unsolved_films import film_lag
from oilfilm.bearing.operation import Curvature
from oilfilm.bearing.shaft.beam import FREEDOMS, Section, stepped_beam
from oilfilm.bearing.shaft.equilibrium import ring_part, solve_shaft
from oilfilm.bearing.shaft.system import AxialLocation, PointLoad, ShaftSystem, Support
from oilfilm.bearing.shaft.vibration import Vibration, critical_speeds, unbalance_response, vibration, whirl_frequencies
from oilfilm.bearing.studies.preload import Arrangement, duplex, preloaded_row
from oilfilm.bearing.studies.stiffness import ring_damping

STEEL = load_material("bearing steel")
BAR = Section(start=0.0, end=0.3, outside_diameter=0.04, inside_diameter=0.01, material=STEEL)
DEEP_GROOVE = load_bearing("6208")
ANGULAR = load_bearing("7014C")
SUPPORTS = (
    Support(position=0.05, bearing=DEEP_GROOVE),
    Support(position=0.25, bearing=DEEP_GROOVE, location=AxialLocation.NONE),
)


def stepped(rigid: float = 1.0) -> tuple[Section, ...]:
    """A shaft of three sections, `rigid` times as stiff as steel."""
    material = replace(STEEL, youngs_modulus=rigid * STEEL.youngs_modulus)
    ends = (0.0, 0.08, 0.2, 0.3)
    outside = (0.035, 0.05, 0.03)
    return tuple(
        Section(start=a, end=b, outside_diameter=d, inside_diameter=0.0, material=material)
        for a, b, d in zip(ends[:-1], ends[1:], outside, strict=True)
    )


def on_two(loads, **changes) -> ShaftSystem:
    """The bar on its two bearings under loads."""
    return ShaftSystem(sections=(BAR,), supports=SUPPORTS, loads=loads, speed=300.0, **changes)


@pytest.mark.parametrize("direction", [1, 2])
def test_a_cantilever_bends_and_shears_as_in_closed_form(direction):
    beam = stepped_beam([BAR], [])
    force = np.zeros(FREEDOMS)
    force[direction] = 1000.0
    found = np.linalg.solve(beam.stiffness[FREEDOMS:, FREEDOMS:], force)
    bending = STEEL.youngs_modulus * BAR.second_moment
    shear = BAR.shear_coefficient * BAR.shear_modulus * BAR.area
    deflection = 1000.0 * (BAR.end**3 / (3.0 * bending) + BAR.end / shear)
    slope = 1000.0 * BAR.end**2 / (2.0 * bending)
    assert_allclose(found[direction], deflection, rtol=1e-9)
    assert_allclose(abs(found[6 - direction]), slope, rtol=1e-9)


def test_a_bar_on_two_springs_follows_the_lever():
    beam = stepped_beam(stepped(), [0.05, 0.12, 0.25])
    stiffness = beam.stiffness.copy()
    spring = 1.0e8
    for place in (0.05, 0.25):
        first = FREEDOMS * beam.node(place)
        stiffness[first + 1, first + 1] += spring
    held = np.setdiff1d(
        np.arange(stiffness.shape[0]), np.flatnonzero(~np.isin(np.arange(stiffness.shape[0]) % 6, [1, 5]))
    )
    load = np.zeros(stiffness.shape[0])
    load[FREEDOMS * beam.node(0.12) + 1] = 1000.0
    found = np.zeros_like(load)
    found[held] = np.linalg.solve(stiffness[np.ix_(held, held)], load[held])
    reactions = [spring * found[FREEDOMS * beam.node(place) + 1] for place in (0.05, 0.25)]
    assert_allclose(reactions, [650.0, 350.0], rtol=1e-9)


def test_mass_and_weight_are_those_of_the_cylinder():
    beam = stepped_beam(stepped(), [0.1], longest=0.01)
    mass = sum(s.area * (s.end - s.start) * STEEL.density for s in stepped())
    for direction in range(3):
        rigid = np.zeros(beam.mass.shape[0])
        rigid[direction::FREEDOMS] = 1.0
        assert_allclose(rigid @ beam.mass @ rigid, mass, rtol=1e-12)
        assert_allclose(beam.weight[direction::FREEDOMS, direction].sum(), mass, rtol=1e-12)
    assert_allclose(beam.gyroscopic, -beam.gyroscopic.T, atol=0.0)


@pytest.mark.parametrize("seed", range(8))
def test_reactions_of_random_shafts_balance_their_loads(seed):
    rng = np.random.default_rng(20261129 + seed)
    loads = tuple(
        PointLoad(
            position=float(place),
            force=(float(rng.uniform(-300, 300)), *rng.uniform(-2000, 2000, 2).tolist()),
            moment=(0.0, *rng.uniform(-20, 20, 2).tolist()),
            mass=float(rng.uniform(0, 5)),
        )
        for place in rng.uniform(0.0, 0.3, 3)
    )
    stiff = None
    if seed % 2:  # a housing whose seats move each other
        stiff = np.kron([[2.0, 0.5], [0.5, 1.0]], np.diag([2e8, 1e8, 1e8, 1e5, 1e5]))
    system = on_two(loads, gravity=(0.0, -9.81, 0.0), housing=stiff)
    solution = solve_shaft(system)
    assert solution.converged, solution.message
    beam = system.beam()
    load = system.load_vector(beam).reshape(-1, FREEDOMS)
    places = np.column_stack([beam.positions, np.zeros((beam.positions.size, 2))])
    reaction = solution.reactions
    assert_allclose(reaction[:, :3].sum(axis=0), load[:, :3].sum(axis=0), rtol=1e-8, atol=1e-6)
    at = np.array([[s.position, 0.0, 0.0] for s in SUPPORTS])
    moment = (np.cross(at, reaction[:, :3])[:, 1:] + reaction[:, 3:]).sum(axis=0)
    outside = (np.cross(places, load[:, :3]) + load[:, 3:]).sum(axis=0)[1:]
    assert_allclose(moment, outside, rtol=1e-8, atol=1e-6)
    if stiff is not None:
        assert_allclose(stiff @ solution.seats.ravel(), reaction.ravel(), rtol=1e-6, atol=1e-3)


def test_two_supports_of_a_rigid_shaft_are_a_pair_of_rows():
    distance, preload = 0.08, 400.0
    left, right = duplex(ANGULAR, Arrangement.BACK_TO_BACK, distance, preload)
    operation = Operation(inner_speed=500.0, force=(300.0, 2000.0, 100.0), moment=(0.0, 0.0), tilt=(None, None))
    pair = solve_quasistatic(ANGULAR, operation, rows=(left, right))
    supports = tuple(
        Support(position=x, bearing=ANGULAR, rows=(preloaded_row(ANGULAR, 0.0, sense, preload),))
        for x, sense in ((0.11, 1), (0.19, -1))
    )
    loads = (PointLoad(position=0.15, force=(300.0, 2000.0, 100.0)),)
    solution = solve_shaft(ShaftSystem(sections=stepped(1.0e9), supports=supports, loads=loads, speed=500.0))
    assert solution.converged, solution.message
    node = int(np.argmin(abs(solution.positions - 0.15)))
    movement = solution.displacement[node]
    assert_allclose(movement[:3], pair.displacement, rtol=1e-9)
    assert_allclose(movement[4:], pair.tilt, rtol=1e-9)
    rows = np.array([state.inner_load for state in solution.bearings]).ravel()
    assert_allclose(rows, pair.inner_load, rtol=1e-9)


@pytest.mark.parametrize("growth", [4.0e-6, -4.0e-6])
def test_growth_of_the_shaft_frees_a_pair_back_to_back_and_shrinking_loads_it(growth):
    """Longer by g between the rows: each row of a rigid pair is displaced g/2 less."""
    preload = 400.0
    senses = ((0.11, 1, 0.0), (0.19, -1, growth))
    supports = tuple(
        Support(position=x, bearing=ANGULAR, rows=(preloaded_row(ANGULAR, 0.0, sense, preload),), growth=g)
        for x, sense, g in senses
    )
    solution = solve_shaft(ShaftSystem(sections=stepped(1.0e7), supports=supports, loads=(), speed=0.0))
    row = supports[0].rows[0]
    at = Operation(inner_speed=0.0, force=(None,) * 3, displacement=(-0.5 * growth, 0.0, 0.0))
    alone = solve_quasistatic(ANGULAR, at, rows=(row,))
    assert solution.converged, solution.message
    assert_allclose(solution.bearings[0].ring_force[0], alone.ring_force[0], rtol=1e-6)
    assert (alone.ring_force[0] < preload) == (growth > 0.0)


def test_a_floating_bearing_takes_no_axial_force():
    solution = solve_shaft(on_two((PointLoad(position=0.1, force=(400.0, 2000.0, 0.0)),)))
    assert solution.converged
    assert_allclose(solution.reactions[:, 0], [400.0, 0.0], atol=1e-6)


@pytest.mark.parametrize(("location", "force"), [(AxialLocation.RIGHT, 300.0), (AxialLocation.LEFT, -300.0)])
def test_shoulders_hold_one_way(location, force):
    other = AxialLocation.LEFT if location is AxialLocation.RIGHT else AxialLocation.RIGHT
    supports = (replace(SUPPORTS[0], location=location), replace(SUPPORTS[1], location=other))
    loads = (PointLoad(position=0.1, force=(force, 2000.0, 0.0)),)
    solution = solve_shaft(replace(on_two(loads), supports=supports))
    assert solution.converged, solution.message
    assert_allclose(solution.reactions[:, 0], [force, 0.0], atol=1e-5)


def test_a_shaft_without_a_fixed_bearing_is_refused():
    floats = tuple(replace(s, location=AxialLocation.NONE) for s in SUPPORTS)
    with pytest.raises(ValueError, match="along x"):
        solve_shaft(replace(on_two(()), supports=floats))


def timoshenko(number: int) -> float:
    """Frequency of a simply supported beam with shear and rotatory inertia, closed form [rad/s]."""
    density, modulus = STEEL.density, STEEL.youngs_modulus
    shear = BAR.shear_coefficient * BAR.shear_modulus
    b = number * np.pi / BAR.end
    quartic = density**2 * BAR.second_moment / shear
    middle = density * BAR.area + density * BAR.second_moment * b**2 * (1.0 + modulus / shear)
    last = modulus * BAR.second_moment * b**4
    return float(np.sqrt((middle - np.sqrt(middle**2 - 4.0 * quartic * last)) / (2.0 * quartic)))


def test_frequencies_of_a_simply_supported_beam():
    beam = stepped_beam([BAR], [], longest=0.3 / 40.0)
    stiffness = beam.stiffness.copy()
    for node in (0, beam.positions.size - 1):
        for freedom in range(3):
            stiffness[FREEDOMS * node + freedom, FREEDOMS * node + freedom] += 1e13
    free = np.setdiff1d(np.arange(stiffness.shape[0]), [3])
    matrices = Vibration(beam=beam, stiffness=stiffness, damping=0.0 * stiffness, across=0.0 * stiffness, free=free)
    found = whirl_frequencies(matrices, [0.0], 4)[0][0]
    assert_allclose(found, np.repeat([timoshenko(1), timoshenko(2)], 2), rtol=3e-4)


def test_critical_speeds_are_where_whirl_meets_the_speed():
    loads = (
        PointLoad(position=0.02, force=(300.0, 2000.0, 0.0), mass=3.0, polar_inertia=0.02, diametral_inertia=0.01),
        PointLoad(position=0.15, mass=5.0, unbalance=1e-5),
    )
    solution = solve_shaft(on_two(loads))
    matrices = vibration(solution)
    critical = critical_speeds(matrices, 1e4)
    assert critical.size >= 2
    for speed in critical[:3]:
        whirl = whirl_frequencies(matrices, [speed], 8)[0][0]
        assert abs(whirl / speed - 1.0).min() < 1e-4
    near, far = (
        abs(unbalance_response(matrices, solution, factor * critical[0])[:, 1:3]).max() for factor in (0.999, 0.5)
    )
    assert near > 20.0 * far


def test_a_bearing_off_its_shoulder_adds_no_axial_stiffness_to_the_vibration():
    supports = (replace(SUPPORTS[0], location=AxialLocation.RIGHT), replace(SUPPORTS[1], location=AxialLocation.LEFT))
    loads = (PointLoad(position=0.1, force=(300.0, 2000.0, 0.0)),)
    one_sided = solve_shaft(replace(on_two(loads), supports=supports))
    floating = solve_shaft(on_two(loads))
    found, expected = (vibration(solution).stiffness for solution in (one_sided, floating))
    assert_allclose(found, expected, rtol=1e-6, atol=1e-6 * abs(expected).max())
    tangent = one_sided.bearings[1].stiffness
    assert tangent[0, 0] > 1e6  # of the bearing itself


OIL = oilfilm.load_lubricant("iso vg 68", 330.0)


def test_stiffness_of_the_balls_in_the_directions_of_their_films_is_that_of_the_ring():
    """With c = k of each ball the damping matrix is the stiffness, but for the turn of the contact angles."""
    at = Operation(inner_speed=1.0, force=(50.0, 0.0, 0.0))  # light: the contact angles hardly turn
    state = solve_quasistatic(ANGULAR, at)
    contacts = contact_conditions(state, OIL)
    damping, _ = ring_damping(state, contacts)
    ball = [c for c in contacts if c.ball == 1]
    flexibility = sum(c.hertz.approach / (1.5 * c.load) for c in ball)
    each = sum(film_lag(c.conditions, c.hertz) for c in ball) / flexibility**2
    assert_allclose(damping / each, state.stiffness * flexibility, rtol=0.03, atol=1e-9)


def test_films_that_turn_with_the_shaft_do_not_damp_it():
    """Balls that orbit as fast as the shaft whirls: C q' + S q of the circular whirl is zero."""
    state = solve_quasistatic(ANGULAR, Operation(inner_speed=500.0, force=(1000.0, 0.0, 0.0)))
    damping, across = ring_damping(state, contact_conditions(state, OIL))
    whirl = np.array([0.0, 1.0, -1j, 0.0, 0.0])  # from y to z, exp(i w t)
    orbit = state.cage_speed
    assert_allclose((1j * orbit * damping + across) @ whirl, 0.0, atol=1e-9 * orbit * damping.max())


def test_damping_of_whirl_and_of_unbalance_are_those_of_a_rotor_on_springs():
    """A stiff shaft between two bearings: m x'' + c x' + k x, at rest and at its critical speed."""
    load = PointLoad(position=0.15, mass=30.0, unbalance=1e-5)
    supports = tuple(
        Support(position=x, bearing=ANGULAR, rows=(preloaded_row(ANGULAR, 0.0, sense, 400.0),))
        for x, sense in ((0.11, 1), (0.19, -1))
    )
    solution = solve_shaft(ShaftSystem(sections=stepped(1.0e4), supports=supports, loads=(load,), speed=500.0))
    lateral = np.zeros((5, 5))
    lateral[1, 1] = lateral[2, 2] = 2000.0
    matrices = vibration(solution, [(lateral, 0.0 * lateral)] * 2)
    found, ratio = (values[0, 0] for values in whirl_frequencies(matrices, [0.0], 2))
    mass = 30.0 + sum(s.area * (s.end - s.start) * STEEL.density for s in stepped())
    assert_allclose(ratio, 4000.0 / (2.0 * mass * found), rtol=0.05)
    critical = critical_speeds(matrices, 1e4)[0]
    amplitude = abs(unbalance_response(matrices, solution, critical)[:, 1]).max()
    assert_allclose(amplitude, 1e-5 * critical / 4000.0, rtol=0.1)


@pytest.mark.parametrize(("curvature", "symmetric"), [(Curvature.FREE, 1e-12), (Curvature.OPERATING, 4e-5)])
def test_stiffness_condensed_through_bearings_and_housing_is_symmetric(curvature, symmetric):
    """K_b (K_b + K_housing)^-1 K_housing at rest; a Hertz K that changes with the angle is no elastic energy."""
    housing = np.kron([[2.0, 0.5], [0.5, 1.0]], np.diag([2e8, 1e8, 1e8, 1e5, 1e5]))
    loads = (PointLoad(position=0.1, force=(400.0, 2000.0, 300.0)),)
    supports = tuple(replace(one, model=QuasistaticModel(curvature=curvature)) for one in SUPPORTS)
    solution = solve_shaft(replace(on_two(loads, housing=housing), supports=supports, speed=0.0))
    bearings = scipy.linalg.block_diag(*(state.stiffness for state in solution.bearings))
    free = bearings @ scipy.linalg.block_diag(*(ring_part(state) for state in solution.bearings))
    series = free @ np.linalg.solve(free + housing, housing)
    assert_allclose(series, series.T, atol=symmetric * abs(series).max())

"""Films sheared with heat: closed solutions of the parts, kernels against NumPy, full solves of contacts that slide."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp

from oilfilm.ehl import Lubricant, SolverOptions
from oilfilm.ehl.conditions import ContactKinematics
from oilfilm.ehl.generalized.heated_film import heated_film, heated_forces, line_history
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.lubricant import ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, thinning_by_gradient
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction import _heated_kernels
from oilfilm.ehl.traction._heated_kernels import nahme
from oilfilm.ehl.traction.film_quadrature import FilmQuadrature, sliding_forces
from oilfilm.ehl.traction.shear import integrate_traction
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table
from oilfilm.ehl.traction_table.film import table_film, vectorised_heated_forces
from oilfilm.ehl.traction_table.full_solves import full_solves
from oilfilm.ehl.traction_table.table import TableContact, TableRange

from ....reference.ehl import heated as reference
from ....reference.ehl.traction import largest_force

OIL = Lubricant(
    viscosity=0.04,
    pressure_viscosity=15e-9,
    temperature=313.15,
    thermal=ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.035, expansion=7e-4),
)
STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=470.0)
ZIRCONIA = SolidThermal(conductivity=2.0, density=6040.0, specific_heat=450.0)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
CARREAU = Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=4e6, carreau_exponent=0.5, limiting_coefficient=0.05)
LIMITED = replace(EYRING, limiting_coefficient=0.05)
CONTACT = TableContact(
    radius_x=8e-3,
    radius_y=20e-3,
    reduced_modulus=2.3e11,
    lubricant=OIL,
    rheology=LIMITED,
    temperature=313.15,
    curvature_radius=0.01,
    solids=(STEEL, ZIRCONIA),
)
LOAD, SPEED = 60.0, 5.0


@pytest.fixture(scope="module")
def film():
    return table_film(CONTACT, LOAD, SPEED, SolverOptions(points=65))


def fewer_lines(film):
    """Every fourth line, as wide as four."""
    lines = film.lines.lines[1::4].copy()
    lines[..., 2] *= 4.0
    lines[..., 10] *= 16.0
    return replace(film, lines=replace(film.lines, lines=lines, span=film.lines.span[1::4].copy()))


def motions(count, seed):
    rng = np.random.default_rng(seed)
    slide = SPEED * 10.0 ** rng.uniform(-3.0, 0.2, (2, count)) * rng.choice([-1.0, 1.0], (2, count)) * [[1.0], [0.2]]
    return (*slide, rng.uniform(-0.3, 0.3, count) * SPEED / 8e-3)


def test_couette_flow_heated_by_itself():
    """Nahme (1940): stress over the isothermal one at Na = b eta U^2/(8 k), walls at one temperature."""
    number = np.geomspace(1e-4, 1e6, 41)
    m = np.arcsinh(np.sqrt(number))
    fluidity, swell = nahme(m * np.tanh(m))
    assert_allclose(np.exp(-fluidity), m / np.sqrt(number * (1.0 + number)), rtol=1e-9)
    assert_allclose(swell, np.log1p(number), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("fall", [0.0, 0.004, 0.01])
@pytest.mark.parametrize("wall", [0.0, 30.0])
def test_thinning_agrees_with_its_reference(fall, wall):
    for flux in np.geomspace(1e2, 1e9, 15):
        found = _heated_kernels.thinning_by_heat(wall, flux, 0.7e-6, 0.09, fall, 0.14)
        expected = reference.thinning_by_heat(
            np.array([wall]), np.array([flux]), np.array([0.7e-6]), (np.array([0.09]), np.array([fall])), 0.14
        )
        assert_allclose(found, expected[0], rtol=3e-3, atol=1e-5)


@pytest.mark.parametrize("middle", [10.0, 40.0, 90.0])
def test_softening_that_falls_against_conduction_across_the_film(middle):
    """ln g by the secant of the softening, against k T'' = -q(T) of an oil after Vogel sheared at one stress.

    From the middle, where the rise is given, to the wall: T'' = -f(T) in a coordinate of whatever source it takes.
    """
    soft, fall, gap, k = 0.08, 0.006, 1e-6, 0.14

    def slopes(_, state):
        fluidity = np.exp(soft * state[0] / (1.0 + fall * state[0]))
        return [state[1], -fluidity, fluidity]

    def wall(_, state):
        return state[0]

    wall.terminal = True
    found = solve_ivp(slopes, (0.0, 100.0), [middle, 0.0, 0.0], events=wall, rtol=1e-10, atol=1e-12)
    half, mean = found.t[-1], found.y[2, -1] / found.t[-1]
    flux = 4.0 * half**2 * k / gap * mean  # the source is (2 half)^2 k/gap^2 at the wall
    column = (np.zeros(1), np.array([flux]), np.array([gap]), (np.array([soft]), np.array([fall])), k)
    assert_allclose(reference.thinning_by_heat(*column)[0], np.log(mean), rtol=0.03)


def test_history_of_uniform_and_rising_flux():
    """int ds'/sqrt(s - s') = 2 sqrt(s), and s' beneath it 4/3 s^1.5."""
    nodes = 0.5 * (np.polynomial.legendre.leggauss(24)[0] + 1.0)
    weights = line_history(nodes)
    assert_allclose(weights @ nodes, 4.0 / 3.0 * nodes**1.5, rtol=1e-12)
    far, near, first = nodes, nodes - nodes[0], nodes[0]
    rise = (2.0 * far * (np.sqrt(far) - np.sqrt(near)) - 2.0 / 3.0 * (far**1.5 - near**1.5)) / first  # up to the first
    assert_allclose(weights @ np.ones(24), rise + 2.0 * np.sqrt(near), rtol=1e-10)


@pytest.mark.parametrize("stress", [0.3, 2.0])
def test_stress_that_rises_across_the_film(stress):
    """Mean rate of a Ree-Eyring oil of uniform viscosity under tau_m + (z - 1/2) rise, against the factor's."""
    tau_0, rise = EYRING.eyring_stress, 17e6
    rate = quad(lambda z: np.sinh((stress * tau_0 + (z - 0.5) * rise) / tau_0), 0.0, 1.0)[0]
    assert_allclose(rate, np.sinh(stress) * thinning_by_gradient(np.array(rise), EYRING), rtol=1e-10)
    assert thinning_by_gradient(np.array([rise]), Rheology()) == 1.0


@pytest.mark.parametrize("rheology", [LIMITED, EYRING, Rheology(), CARREAU])
def test_compiled_sums_agree_with_their_reference(rheology):
    """The sliding of a strip is its mean square: with spin and slides across, 2 % of the forces at most."""
    contact = replace(CONTACT, rheology=rheology)
    heated = fewer_lines(table_film(contact, LOAD, SPEED, SolverOptions(points=65)).quadrature)
    slide_x, slide_y, spin = motions(3, 90127)
    rolling = np.full(3, SPEED / 8e-3)
    found = heated_forces(heated, (slide_x, slide_y, spin), rolling, 50.0)
    for k in range(3):
        motion = ContactKinematics(
            entrainment_speed=SPEED,
            sliding_x=slide_x[k],
            sliding_y=slide_y[k],
            spin=spin[k],
            rolling=rolling[k],
            curvature_radius=0.01,
            curvature_width=heated.low_pressure.half_width,
        )
        expected = reference.heated_forces(heated, motion)
        assert_allclose(found[k], expected, rtol=0.02, atol=1e-4 * np.abs(expected).max())


@pytest.mark.parametrize("ratio", [-2.05, -1.98, -0.3, 0.02, 0.8, 1.3, 1.7, 1.9, 1.97, 1.995, 2.0, 2.02, 2.1])
def test_factors_of_lines_against_the_march_of_every_node(film, ratio):
    """Between the slide-roll ratios and speeds of the factors, also where one body stands still: 0.3 % of the force.

    Beyond 2, which motions of a table reach with spin alone: 4 %, there a sixth of the largest force.
    """
    heated = fewer_lines(film.quadrature)
    slide_x = ratio * SPEED
    found = heated_forces(heated, (np.array([slide_x]), np.zeros(1), np.zeros(1)), np.array([SPEED / 8e-3]), 50.0)
    motion = ContactKinematics(
        entrainment_speed=SPEED,
        sliding_x=slide_x,
        rolling=SPEED / 8e-3,
        curvature_radius=0.01,
        curvature_width=heated.low_pressure.half_width,
    )
    assert_allclose(found[0, 0], reference.heated_forces(heated, motion)[0], rtol=3e-3 if abs(ratio) <= 2.0 else 0.04)


def test_bodies_and_oil_that_take_all_heat_leave_the_film_of_rolling(film):
    lines, endless = film.quadrature.lines, replace(STEEL, conductivity=1e18)
    nodes = lines.lines.copy()
    nodes[..., _heated_kernels.CONDUCTIVITY] = 1e9
    cold = replace(film.quadrature, lines=replace(lines, lines=nodes, solids=(endless, endless)))
    rows = np.moveaxis(lines.nodes, 1, 0).reshape(8, -1)
    plain = FilmQuadrature(nodes=rows, half_width=film.quadrature.low_pressure.half_width, rheology=LIMITED)
    slide, rolling = motions(8, 41077), np.full(8, SPEED / 8e-3)
    both = sliding_forces(plain, slide, rolling, 50.0) + sliding_forces(
        film.quadrature.low_pressure, slide, rolling, 50.0
    )
    assert_allclose(heated_forces(cold, slide, rolling, 50.0), both, rtol=1e-5)
    assert lines.lines[..., _heated_kernels.TEMPERATURE].max() > 315.0  # what rolling warmed stays


def test_heat_takes_more_friction_the_faster_it_slides(film):
    """Coefficient over slide-roll ratio rises, has a largest value, and falls; zirconia keeps the oil warmer."""
    ratio = np.geomspace(1e-4, 2.0, 25)
    none = np.zeros(25)
    slide, rolling = (SPEED * ratio, none, none), np.full(25, SPEED / 8e-3)
    friction = -film.sliding_forces(slide, rolling, 0.0)[:, 0] / LOAD
    top = int(friction.argmax())
    assert 5 < top < 24
    assert np.all(np.diff(friction[: top + 1]) > 0.0)
    assert np.all(np.diff(friction[top:]) < 0.0)
    better = replace(film.quadrature.lines, solids=(STEEL, STEEL))
    steel = -heated_forces(replace(film.quadrature, lines=better), slide, rolling, 0.0)[:, 0] / LOAD
    assert np.all(steel > friction)
    assert steel[-1] > 1.05 * friction[-1]


def test_films_with_heat_against_full_solves():
    """Random loads, speeds and slide-roll ratios to 0.1: friction on the table's film against a full thermal solve."""
    limits = TableRange(load=(40.0, 90.0), speed=(2.0, 6.0))
    for solids in ((STEEL, STEEL), (STEEL, ZIRCONIA)):
        contact = replace(CONTACT, rheology=EYRING, solids=solids)
        for one in full_solves(contact, limits, 2, SolverOptions(points=65)):
            assert one.converged
            assert_allclose(one.by_film, one.in_full, rtol=0.05)
            assert_allclose(one.film_ratio, 1.0, atol=0.02)


def test_traction_of_a_film_solved_with_heat_is_that_of_its_own_stress():
    """Sheared afterwards at the solved temperatures, against the stress in the middle of the film of the solve."""
    sliding = replace(CONTACT.conditions(LOAD, SPEED), slide_roll_ratio=0.1)
    solution = solve_generalized(sliding, EYRING, solids=(STEEL, ZIRCONIA), options=SolverOptions(points=65))
    motion = ContactKinematics(entrainment_speed=SPEED, sliding_x=0.1 * SPEED, rolling=SPEED / 8e-3)
    found = integrate_traction(solution.contact, motion, EYRING).sliding_force_x
    own = np.trapezoid(np.trapezoid(solution.mid_stress[0], solution.contact.y, axis=1), solution.contact.x)
    assert_allclose(found, own, rtol=0.02)
    cold = integrate_traction(replace(solution.contact, state=None), motion, EYRING).sliding_force_x
    assert abs(cold) > 1.1 * abs(own)


def test_a_film_without_temperatures_is_refused():
    plain = solve_generalized(CONTACT.conditions(LOAD, SPEED), EYRING, options=SolverOptions(points=33))
    with pytest.raises(ValueError, match="no temperatures"):
        heated_film(plain, (STEEL, STEEL), EYRING)


@pytest.mark.slow
def test_table_with_heat():
    """Its lookups against the film it would shear at a load and speed that are not nodes.

    On 33 points the mesh is too coarse for the thin film: neighbouring nodes are reached by different attempts of the
    solver, with other meshes and films that do not follow one another; on 65 all are plain.
    """
    limits = TableRange(load=(40.0, 80.0), speed=(3.0, 5.0), slide_x=0.5, slide_y=0.3, spin=0.3)
    options = TableOptions(
        points=65, tolerance=0.03, check_films=2, check_motions=40, rounds=1, nodes=(4, 4, 25, 7, 9), workers=2
    )
    table = build_traction_table(CONTACT, limits, options)
    assert table.error.quantile < 0.015
    film = table_film(CONTACT, 57.0, 4.1, SolverOptions(points=65))
    ratio = np.geomspace(1e-3, 0.5, 9)
    none = np.zeros(9)
    wanted = film.sliding_forces((4.1 * ratio, none, none), np.full(9, 4.1 / 8e-3), 50.0)[:, 0]
    found = np.array([table.forces(57.0, 4.1, 4.1 * one, 0.0, 0.0).force_x for one in ratio])
    assert_allclose(found, wanted, atol=0.01 * largest_force(table, 57.0, 4.1))


def test_forces_of_thousands_of_motions_are_those_of_each(film):
    """By pulls as a table in single precision: within 0.06 % of the largest force, also at rest and beyond ratio 2."""
    rng = np.random.default_rng(8)
    size = 10.0 ** rng.uniform(-7.0, 0.4, (3, 400))
    slide = SPEED * rng.choice([-1.0, 1.0], size.shape) * size * np.array([[1.0], [1.0], [50.0]])
    slide[:, :3] = 0.0
    rolling = np.full(400, SPEED / 8e-3)
    several, each = (f(film.quadrature, tuple(slide), rolling, 50.0) for f in (vectorised_heated_forces, heated_forces))
    assert np.all(np.abs(several - each) < 6e-4 * np.abs(each).max(axis=0))
    none = np.zeros(2)
    assert np.all(vectorised_heated_forces(film.quadrature, (none, none, none), none, 0.0) == 0.0)

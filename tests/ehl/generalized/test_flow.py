"""Integrals across the film: limits and closed forms, and kernels against their NumPy twins.

Eyring line flow: Conry, Wang and Cusano (1987), flux of a slide-rolling line contact in closed form.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from oilfilm.ehl.generalized import _kernels
from oilfilm.ehl.generalized._kernels import ROWS
from oilfilm.ehl.generalized.film_heat import film_section
from oilfilm.ehl.oil.lubricant import Lubricant, ThermalProperties, ViscosityLaw, density, oil_numbers, viscosity
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology

from ...reference.ehl.film_columns import FilmColumns, _stresses, flow_integrals, fluidities, mid_stress

SECTION = film_section()
ROOM = np.empty((ROWS, SECTION.nodes.size))
NEWTON = Rheology()
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
CARREAU = Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=7e6, carreau_exponent=0.46)
LAWS = {"newtonian": NEWTON, "ree-eyring": EYRING, "carreau": CARREAU}
LAWS |= {f"{name}, limited": replace(law, limiting_coefficient=0.06) for name, law in LAWS.items()}


@pytest.fixture(params=LAWS.values(), ids=LAWS.keys())
def rheology(request):
    return request.param


def random_columns(count, seed, *, warm=True):
    """Columns as in a contact, from inlet to middle, with slip in both directions and viscosity falling with heat."""
    random = np.random.default_rng(seed)
    p = random.uniform(0.0, 2e9, count)
    heat = random.uniform(0.0, 40.0, (count, 1)) * SECTION.nodes * (1.3 - SECTION.nodes) if warm else 0.0
    speed = random.uniform(-5.0, 15.0, (count, 2))
    ones = np.ones((count, SECTION.nodes.size))
    return FilmColumns(
        film=10.0 ** random.uniform(-8, -5, count),
        pressure=p,
        gradient=10.0 ** random.uniform(8, 14, (count, 2)) * random.choice([-1, 1], (count, 2)),
        speed_a=speed,
        speed_b=speed + 10.0 ** random.uniform(-6, 0.7, (count, 2)) * random.choice([-1, 1], (count, 2)),
        viscosity=np.exp(np.log(0.03) + 1e-8 * p[:, None] - 0.04 * heat) * ones,
        density=870.0 * (1.0 - 7e-4 * heat) * ones,
    )


def test_section_is_exact_for_polynomials():
    z, degree = SECTION.nodes, SECTION.nodes.size - 1
    assert_allclose(SECTION.cumulative @ z**degree, z ** (degree + 1) / (degree + 1), atol=1e-14)
    assert_allclose(SECTION.weights @ z ** (2 * degree - 1), 1.0 / (2 * degree), rtol=1e-13)
    assert z[0] == 0.0
    assert z[-1] == 1.0


def test_newtonian_uniform_film_has_the_ordinary_coefficients():
    """(rho/eta)_e = rho/eta and the flux of the surfaces is rho times their mean, to round-off."""
    columns = random_columns(200, 88117, warm=False)
    middle, converged = mid_stress(columns, SECTION, NEWTON)
    flow = flow_integrals(columns, SECTION, NEWTON, middle)
    assert converged.all()
    assert_allclose(flow.poiseuille, columns.density[:, 0] / columns.viscosity[:, 0], rtol=1e-12)
    mean = 0.5 * (columns.speed_a + columns.speed_b)
    assert_allclose(flow.couette, 870.0 * mean, rtol=1e-12, atol=1e-9)
    slip = (columns.speed_b - columns.speed_a) / columns.film[:, None]
    assert_allclose(middle, columns.viscosity[:, :1] * slip, rtol=1e-9)


def eyring_column(gradient, slip, film=2e-7, eta=20.0):
    return FilmColumns(
        film=np.array([film]),
        pressure=np.array([5e8]),
        gradient=np.array([[gradient, 0.0]]),
        speed_a=np.array([[3.0, 0.0]]),
        speed_b=np.array([[3.0 + slip, 0.0]]),
        viscosity=np.full((1, SECTION.nodes.size), eta),
        density=np.full((1, SECTION.nodes.size), 900.0),
    )


@pytest.mark.parametrize("gradient", [1e11, 3e13, 1.5e14])
@pytest.mark.parametrize("slip", [0.0, 1e-3, 0.1, 3.0])
def test_eyring_line_flow_is_conrys(gradient, slip):
    """S = 3 (s cosh s - sinh s)/s^3 sqrt(1 + [eta slip s/(tau_0 h sinh s)]^2), s = h p_x/(2 tau_0), and tau_m.

    Pressure's part of the flux is S h^3/(12 eta); 1.5e14 Pa/m is s = 3. The series of the first factor takes over
    where its terms cancel.
    """
    column = eyring_column(gradient, slip)
    middle, converged = mid_stress(column, SECTION, EYRING)
    flow = flow_integrals(column, SECTION, EYRING, middle)
    assert converged.all()
    h, eta, tau_0 = 2e-7, 20.0, 5e6
    s = h * gradient / (2.0 * tau_0)
    ratio = eta * slip / h * s / (tau_0 * np.sinh(s))
    assert_allclose(middle[0, 0], tau_0 * np.arcsinh(ratio), rtol=1e-10, atol=1e-6)
    shape = 3.0 * (s * np.cosh(s) - np.sinh(s)) / s**3 if s > 0.01 else 1.0 + s * s / 10.0
    expected = -900.0 * h**3 / (12.0 * eta) * gradient * shape * np.hypot(1.0, ratio)
    pressure_flux = -flow.poiseuille[0] * h**3 / 12.0 * gradient + h * (flow.couette[0, 0] - 900.0 * (3.0 + slip / 2))
    assert_allclose(pressure_flux, expected, rtol=1e-8, atol=1e-13)  # atol: round-off of the flux of the surfaces


def test_viscosity_varying_across_the_film():
    """Newtonian, eta by a linear temperature and rho too: Yang and Wen's integrals by adaptive quadrature."""
    z = SECTION.nodes
    columns = FilmColumns(
        film=np.array([4e-7]),
        pressure=np.array([4e8]),
        gradient=np.array([[2e12, -1e12]]),
        speed_a=np.array([[2.0, 0.3]]),
        speed_b=np.array([[1.0, -0.2]]),
        viscosity=5.0 * np.exp(-2.0 * z)[None],
        density=(900.0 * (1.0 - 0.05 * z))[None],
    )
    flow = flow_integrals(columns, SECTION, NEWTON, mid_stress(columns, SECTION, NEWTON)[0])

    def fluidity(x):
        return np.exp(2.0 * x) / 5.0

    def integral(f, end=1.0):
        return quad(f, 0.0, end, epsabs=0.0, epsrel=1e-12)[0]

    def rho(x):
        return 900.0 * (1.0 - 0.05 * x)

    mean, moment = integral(fluidity), integral(lambda x: x * fluidity(x))
    first = integral(lambda x: rho(x) * integral(fluidity, x))
    second = integral(lambda x: rho(x) * integral(lambda y: y * fluidity(y), x))
    assert_allclose(flow.poiseuille, 12.0 * (moment / mean * first - second), rtol=1e-10)
    couette = first / mean * np.array([-1.0, -0.5]) + integral(rho) * np.array([2.0, 0.3])
    assert_allclose(flow.couette[0], couette, rtol=1e-10)


def total_flux(columns, rheology):
    middle, converged = mid_stress(columns, SECTION, rheology)
    assert converged.all()
    flow = flow_integrals(columns, SECTION, rheology, middle)
    pressure = -(flow.poiseuille * columns.film**3 / 12.0)[:, None] * columns.gradient
    return pressure + columns.film[:, None] * flow.couette


def test_flux_does_not_know_which_body_is_which(rheology):
    columns = random_columns(200, 27001)
    turned = replace(
        columns,
        speed_a=columns.speed_b,
        speed_b=columns.speed_a,
        viscosity=columns.viscosity[:, ::-1],
        density=columns.density[:, ::-1],
    )
    scale = 900.0 * columns.film[:, None] * 15.0  # the parts of the flux cancel where both are large
    here, there = total_flux(columns, rheology), total_flux(turned, rheology)
    assert_allclose(here, there, rtol=1e-7, atol=1e-9 * scale.max())


def test_flux_turns_with_the_frame(rheology):
    """All vectors turned by a right angle turn the flux."""
    columns = random_columns(100, 55190)

    def turn(vectors):
        return np.stack((-vectors[:, 1], vectors[:, 0]), axis=1)

    turned = replace(
        columns, gradient=turn(columns.gradient), speed_a=turn(columns.speed_a), speed_b=turn(columns.speed_b)
    )
    here, there = total_flux(columns, rheology), total_flux(turned, rheology)
    assert_allclose(turn(here), there, rtol=1e-7, atol=1e-12)


def test_every_column_is_solved_and_the_limit_kept(rheology):
    columns = random_columns(3000, 90127)
    middle, converged = mid_stress(columns, SECTION, rheology)
    assert converged.all()
    flow = flow_integrals(columns, SECTION, rheology, middle)
    assert np.all(flow.poiseuille > 0.0)
    # thinning oil flows more easily than at low shear; the least viscous node bounds from below if Newtonian
    bound = (columns.density / columns.viscosity).min(axis=1)
    assert np.all(flow.poiseuille > 0.9 * bound)
    if rheology.limiting_coefficient is not None:
        stress = _stresses(middle, columns, SECTION)
        rise = columns.film * np.hypot(*columns.gradient.T)
        limit = np.maximum(0.06 * columns.pressure, 5e6)
        held = rise < limit  # a gradient beyond the strength of the film has no steady solution within the law
        assert held.sum() > 1000
        magnitude = np.hypot(stress[..., 0], stress[..., 1]).max(axis=1)
        assert np.all(magnitude[held] <= 1.05 * limit[held])  # the base law exceeds it up to 3e7 times
        if rheology.law is ShearLaw.NEWTONIAN:
            sheared = held & (rise < 1e-3 * limit)
            assert np.all(magnitude[sheared] <= 1.002 * limit[sheared])


def test_mean_rate_is_the_slip_over_the_film(rheology):
    columns = random_columns(300, 61553)
    middle, _ = mid_stress(columns, SECTION, rheology)
    rate = (columns.speed_b - columns.speed_a) / columns.film[:, None]
    stress = _stresses(middle, columns, SECTION)
    fluidity, _ = fluidities(stress, columns, rheology, rate)
    ours = np.einsum("k,mk,mkc->mc", SECTION.weights, fluidity, stress)
    scale = np.abs(np.einsum("k,mk,mkc->mkc", SECTION.weights, fluidity, stress)).sum(axis=1)
    assert np.all(np.abs(ours - rate) <= 1e-11 * (scale.max(axis=1, keepdims=True) + np.abs(rate)))


def test_tangent_is_the_derivative_of_the_flux(rheology):
    """-12/h^3 d(flux)/d(grad p) by central differences; where the film holds, as its derivative jumps elsewhere."""
    columns = random_columns(200, 40993)
    middle, _ = mid_stress(columns, SECTION, rheology)
    tangent = flow_integrals(columns, SECTION, rheology, middle).tangent
    rise = columns.film * np.hypot(*columns.gradient.T)
    held = rise < np.maximum(0.06 * columns.pressure, 5e6)
    step = 1e-4 * np.hypot(*columns.gradient.T)
    for along in (0, 1):
        moved = step[:, None] * np.eye(2)[along]
        more, less = (total_flux(replace(columns, gradient=columns.gradient + s * moved), rheology) for s in (1, -1))
        slope = -12.0 / columns.film[:, None] ** 3 * (more - less) / (2.0 * step[:, None])
        noise = 1e-12 * columns.film * 900.0 * 15.0 * 12.0 / columns.film**3 / step  # round-off of the flux
        told = held & (noise < 1e-3 * tangent[:, along, along])
        assert told.sum() > 20
        assert_allclose(slope[told, along], tangent[told, along, along], rtol=5e-3)


def test_kernel_agrees(rheology):
    """A grid of columns with their own temperatures, started from nothing."""
    shape, random = (6, 9), np.random.default_rng(70013)
    heat = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.04, expansion=7e-4)
    oil = Lubricant(viscosity=0.03, pressure_viscosity=1.6e-8, temperature=340.0, thermal=heat, roelands_z=0.6)
    p, h = random.uniform(0.0, 1.5e9, shape), 10.0 ** random.uniform(-8, -5, shape)
    gradient = 10.0 ** random.uniform(8, 13.5, (2, *shape))
    speed_a, speed_b = random.uniform(-3, 9, (2, *shape)), random.uniform(-3, 9, (2, *shape))
    temperature = 340.0 + random.uniform(0, 40, (*shape, 1)) * SECTION.nodes * (1.2 - SECTION.nodes)
    h[2, 3] = -1e-9
    middle, poiseuille = np.full((2, *shape), np.nan), np.empty(shape)
    couette, tangent, power = np.empty((2, *shape)), np.empty((2, *shape)), np.empty(shape)
    fields = (p, h, gradient, speed_a, speed_b, temperature)
    given = (oil_numbers(oil), SECTION.integration, kernel_rheology(rheology))
    missed = _kernels.flow_factors(*fields, *given, middle, poiseuille, couette, tangent, power, ROOM)
    assert missed == 0
    assert poiseuille[2, 3] == 1.0
    assert power[2, 3] == 0.0
    assert_allclose(couette[:, 2, 3], 0.5 * (speed_a + speed_b)[:, 2, 3], rtol=1e-15)
    film = h > 0.0
    columns = FilmColumns(
        film=h[film],
        pressure=p[film],
        gradient=gradient[:, film].T,
        speed_a=speed_a[:, film].T,
        speed_b=speed_b[:, film].T,
        viscosity=viscosity(p[film][:, None], oil, temperature[film]),
        density=density(p[film][:, None], oil, temperature[film]),
        temperature=temperature[film] @ SECTION.weights,
    )
    twin, converged = mid_stress(columns, SECTION, rheology)
    assert converged.all()
    flow, reference = flow_integrals(columns, SECTION, rheology, twin), density(p[film], oil)
    assert_allclose(middle[:, film].T, twin, rtol=1e-8, atol=1e-5)
    assert_allclose(poiseuille[film], flow.poiseuille / reference * viscosity(p[film], oil), rtol=1e-8)
    assert_allclose(couette[:, film].T, flow.couette / reference[:, None], rtol=1e-8, atol=1e-10)
    thick = viscosity(p[film], oil) / reference
    assert_allclose(tangent[0, film], flow.tangent[:, 0, 0] * thick, rtol=1e-8)
    assert_allclose(tangent[1, film], flow.tangent[:, 1, 1] * thick, rtol=1e-8)
    # m: central difference of ln (rho/eta)_e by ln |grad p|
    logs = []
    for share in (1.0 + 1e-5, 1.0 - 1e-5):
        steeper = replace(columns, gradient=share * columns.gradient)
        stress, _ = mid_stress(steeper, SECTION, rheology)
        logs.append(np.log(flow_integrals(steeper, SECTION, rheology, stress).poiseuille))
    smooth = columns.film * np.hypot(*columns.gradient.T) < 0.06 * columns.pressure  # below the tangents
    assert smooth.sum() > 5
    assert_allclose(power[film][smooth], ((logs[0] - logs[1]) / 2e-5)[smooth], rtol=1e-4, atol=1e-5)


def test_kernel_is_ordinary_without_heat_and_thinning():
    """Factor 1 to round-off, the velocity the mean, for every law of the viscosity that needs no constants."""
    shape, random = (4, 5), np.random.default_rng(13441)
    for law in (ViscosityLaw.ROELANDS, ViscosityLaw.BARUS, ViscosityLaw.ISOVISCOUS):
        oil = Lubricant(viscosity=0.03, pressure_viscosity=1.6e-8, viscosity_law=law)
        p, h = random.uniform(0.0, 1e9, shape), 10.0 ** random.uniform(-8, -5, shape)
        speed_a, speed_b = random.uniform(-3, 9, (2, *shape)), random.uniform(-3, 9, (2, *shape))
        temperature = np.full((*shape, SECTION.nodes.size), 298.15)
        poiseuille, couette, tangent = np.empty(shape), np.empty((2, *shape)), np.empty((2, *shape))
        fields = (p, h, random.uniform(-1e12, 1e12, (2, *shape)), speed_a, speed_b, temperature)
        results = (np.full((2, *shape), np.nan), poiseuille, couette, tangent, np.empty(shape))
        _kernels.flow_factors(*fields, oil_numbers(oil), SECTION.integration, kernel_rheology(NEWTON), *results, ROOM)
        assert_allclose(poiseuille, 1.0, rtol=1e-13)
        assert_allclose(tangent, 1.0, rtol=1e-13)
        assert_allclose(couette, 0.5 * (speed_a + speed_b), rtol=1e-12, atol=1e-12)


def test_section_needs_three_nodes():
    with pytest.raises(ValueError, match="count"):
        film_section(2)

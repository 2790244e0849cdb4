"""Shear laws: limits, inverses, and kernels against their NumPy twins."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose

from oilfilm.ehl.oil import _kernels, _laws
from oilfilm.ehl.oil.lubricant import Lubricant, ViscosityLaw
from oilfilm.ehl.oil.lubricant import viscosity as lubricant_viscosity
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, contact_rheology, kernel_rheology, limiting_stress
from oilfilm.ehl.oil.shear_stress import shear_stress, shear_stress_vector

from ...reference.ehl.rheology import limiting, shear_rate, shear_rate_vector, stress

LAWS = {
    "newtonian": Rheology(),
    "ree-eyring": Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6),
    "carreau": Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=7e6, carreau_exponent=0.46),
    "yasuda": Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=2e5, carreau_exponent=0.3, yasuda_exponent=5.0),
}
LAWS |= {f"{name}, limited": replace(law, limiting_coefficient=0.06) for name, law in LAWS.items()}
ROUND_OFF = 1e-12  # relative; a few elementary functions


@pytest.fixture(params=LAWS.values(), ids=LAWS.keys())
def rheology(request):
    return request.param


@pytest.fixture
def states():
    """Rates, viscosities and pressures over all decades of a contact, from the inlet to the middle."""
    random = np.random.default_rng(51877)
    count = 400
    return 10.0 ** random.uniform(0, 8, count), 10.0 ** random.uniform(-3, 4, count), random.uniform(0.0, 3e9, count)


def test_newtonian_without_limit(states):
    rate, viscosity, pressure = states
    assert_allclose(shear_stress(rate, viscosity, pressure, Rheology()), viscosity * rate, rtol=1e-15)
    assert Rheology().newtonian
    assert not LAWS["newtonian, limited"].newtonian


def test_small_stress_is_newtonian(rheology):
    """Every law starts as Newton's: the deviation is first order in the stress at most (with the limit)."""
    rate, viscosity = np.array([1e-2, 1.0, 10.0]), 0.1
    assert_allclose(shear_stress(rate, viscosity, 1e9, rheology), viscosity * rate, rtol=1e-6)
    at_rest = shear_stress_vector((np.zeros(1), np.zeros(1)), viscosity, 1e9, rheology)
    assert_allclose(at_rest, 0.0, atol=0)


def test_rate_is_odd_and_increasing(rheology):
    stress = np.linspace(0.0, 2e7, 200)
    rate = shear_rate(stress, 10.0, 1e9, rheology)
    assert np.all(np.diff(rate) > 0.0)
    assert_allclose(shear_rate(-stress, 10.0, 1e9, rheology), -rate, rtol=0)


def test_rate_inverts_stress(rheology, states):
    rate, viscosity, pressure = states
    stress = shear_stress(rate, viscosity, pressure, rheology)
    limit = limiting_stress(pressure, rheology)
    plain = stress < 0.999 * limit  # nearer the limit the stress no longer tells the rate apart
    assert plain.sum() > 100
    again = shear_rate(stress, viscosity, pressure, rheology)
    assert_allclose(again[plain], rate[plain], rtol=1e-9)  # of digits lost in 1 - tau/tau_L = 1e-3, and in sinh


def test_limiting_stress_bounds(states):
    rate, viscosity, pressure = states
    for name, rheology in LAWS.items():
        stress = shear_stress(rate, viscosity, pressure, rheology)
        assert np.all(stress <= limiting_stress(pressure, rheology))
        if name == "newtonian, limited":
            assert np.any(stress > 0.999 * limiting_stress(pressure, rheology))
    assert np.isinf(shear_rate(7e7, 1.0, 1e9, LAWS["newtonian, limited"]))


@pytest.mark.parametrize("name", ["ree-eyring", "carreau", "yasuda"])
def test_limit_is_the_smaller_of_both_stresses(name, states):
    """Within 2.2 % where base law and limit meet (2^(1/32) - 1), 0.2 % from a tenth apart, and exact far from there."""
    rate, viscosity, pressure = states
    base = shear_stress(rate, viscosity, pressure, LAWS[name])
    limit = limiting_stress(pressure, LAWS[f"{name}, limited"])
    share = shear_stress(rate, viscosity, pressure, LAWS[f"{name}, limited"]) / np.minimum(base, limit)
    assert np.all((share <= 1.0) & (share > 0.978))
    ratio = base / limit
    assert np.all(share[(ratio < 0.9) | (ratio > 1.1)] > 0.998)
    far = (ratio < 0.5) | (ratio > 2.0)
    assert far.sum() > 100
    assert_allclose(share[far], 1.0, rtol=1e-5)


def test_eyring_stress_follows_the_mean_pressure_and_lambda():
    """2 Lambda_0/alpha, alpha the secant of the oil's law; in proportion to Lambda_0, refused without alpha."""
    oil = Lubricant(viscosity=0.03, pressure_viscosity=20e-9, viscosity_law=ViscosityLaw.BARUS)
    for coefficient in (0.02, 0.1):
        rheology = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=coefficient)
        known = contact_rheology(rheology, oil, 0.7e9)
        assert_allclose(known.eyring_stress, 2.0 * coefficient / 20e-9, rtol=1e-12)
        assert known.of_contact
        assert not rheology.of_contact
    roelands = replace(oil, viscosity_law=ViscosityLaw.ROELANDS)
    secant = np.log(lubricant_viscosity(0.7e9, roelands) / 0.03) / 0.7e9
    assert_allclose(contact_rheology(rheology, roelands, 0.7e9).eyring_stress, 0.2 / secant, rtol=1e-12)
    assert contact_rheology(LAWS["carreau"], oil, 0.7e9) is LAWS["carreau"]
    dead = replace(oil, viscosity_law=ViscosityLaw.ISOVISCOUS, pressure_viscosity=0.0)
    with pytest.raises(ValueError, match="eyring_coefficient"):
        contact_rheology(rheology, dead, 0.7e9)


def test_stress_of_no_contact_is_refused():
    rheology = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=0.05)
    for use in (kernel_rheology, lambda law: shear_stress(1.0, 1.0, 1e9, law)):
        with pytest.raises(ValueError, match="eyring_coefficient"):
            use(rheology)
    with pytest.raises(ValueError, match="one of them"):
        replace(rheology, eyring_stress=5e6)


def test_bair_winer_by_hand():
    """rate = -(tau_L/eta) ln(1 - tau/tau_L), Bair and Winer (1979), at tau = tau_L/2 with tau_L = 0.06 GPa."""
    assert_allclose(shear_rate(3e7, 100.0, 1e9, LAWS["newtonian, limited"]), 6e7 / 100.0 * np.log(2.0), rtol=ROUND_OFF)


def test_ree_eyring_by_hand():
    assert_allclose(shear_rate(1e7, 2.0, 0.0, LAWS["ree-eyring"]), 5e6 / 2.0 * np.sinh(2.0), rtol=ROUND_OFF)


def test_carreau_slope_at_high_rates():
    """d ln(tau)/d ln(rate) tends to n."""
    stress = shear_stress(np.array([1e9, 1e10]), 1.0, 0.0, LAWS["yasuda"])
    assert_allclose(np.log10(stress[1] / stress[0]), 0.3, rtol=1e-8)


def test_dyson_law_as_printed():
    """0.25 [1.2 p/(2.52 + 0.024 t) - 1e8] at 1 GPa and 40 degrees Celsius, Zhou and Hoeprich (1991)."""
    dyson = Rheology(
        limiting_coefficient=0.3 / 2.52,
        limiting_stress=-2.5e7,
        limiting_temperature_slope=0.024 / 2.52,
        reference_temperature=273.15,
    )
    wanted = 0.25 * (1.2e9 / (2.52 + 0.024 * 40.0) - 1e8)
    assert_allclose(limiting_stress(1e9, dyson, 313.15), wanted, rtol=ROUND_OFF)
    assert_allclose(limiting_stress(0.0, dyson, 313.15), dyson.limiting_minimum, rtol=0)


def test_vector_is_parallel(rheology):
    rates = np.array([3e5, -2e6, 0.0]), np.array([4e5, 1e6, 0.0])
    x, y = shear_stress_vector(rates, 10.0, 1e9, rheology)
    assert_allclose(x * rates[1], y * rates[0], rtol=ROUND_OFF)
    assert_allclose(np.hypot(x, y), shear_stress(np.hypot(*rates), 10.0, 1e9, rheology), rtol=ROUND_OFF)
    back = shear_rate_vector((x, y), 10.0, 1e9, rheology)
    assert_allclose(back, rates, rtol=1e-9)


def test_laws_agree_with_their_twins(rheology, states):
    """Over arrays, and of one node as kernels have it."""
    numbers = kernel_rheology(rheology)
    base, limits = numbers[:4], numbers[4:]
    bound = limiting(states[2], rheology, 350.0)
    assert_allclose(limiting_stress(states[2], rheology, 350.0), bound, rtol=ROUND_OFF)
    wanted = stress(*states[:2], bound, rheology)
    assert_allclose(shear_stress(*states, rheology, 350.0), wanted, rtol=ROUND_OFF)
    rates = shear_rate(0.9 * wanted, states[1], states[2], rheology, 350.0)
    for node, (rate, viscosity, pressure) in enumerate(zip(*states, strict=True)):
        limit = compiled_limit(pressure, 350.0, *limits)
        assert_allclose(limit, bound[node], rtol=ROUND_OFF)
        assert_allclose(_kernels.shear_stress(rate, viscosity, limit, *base), wanted[node], rtol=ROUND_OFF)
        ours = _kernels.shear_rate(0.9 * wanted[node], viscosity, limit, *base)
        assert_allclose(ours, rates[node], rtol=ROUND_OFF)


@njit(error_model="numpy")
def compiled_limit(pressure, temperature, coefficient, stress, slope, reference, minimum):
    return _laws.limiting_stress(pressure, temperature, coefficient, stress, slope, reference, minimum)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("eyring_stress", 0.0),
        ("carreau_modulus", np.inf),
        ("carreau_exponent", 1.2),
        ("yasuda_exponent", -1.0),
        ("limiting_coefficient", 0.0),
        ("limiting_stress", np.nan),
    ],
)
def test_bad_constants_are_named(field, value):
    law = ShearLaw.REE_EYRING if field == "eyring_stress" else ShearLaw.CARREAU_YASUDA
    good = {"law": law, "eyring_stress": 5e6, "carreau_modulus": 1e6, "limiting_coefficient": 0.05}
    with pytest.raises(ValueError, match=field):
        Rheology(**(good | {field: value}))


def test_the_root_under_a_limit_is_that_of_the_library():
    powers = np.concatenate([[0.0], np.logspace(-20.0, 0.0, 400)])
    found = np.array([_kernels.root_of(power) for power in powers])
    assert_allclose(found, (1.0 + powers) ** (1.0 / _kernels.LIMIT_POWER), rtol=4e-16)

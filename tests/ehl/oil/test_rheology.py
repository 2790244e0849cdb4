"""Shear laws: limits, inverses, and kernels against their NumPy twins."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from ehl.oil import _rheology_kernels as _kernels
from ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology, limiting_stress, shear_stress, shear_stress_vector

from ...reference.ehl.rheology import shear_rate, shear_rate_vector

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


def test_kernels_agree(rheology, states):
    numbers = kernel_rheology(rheology)
    base, limits = numbers[:4], numbers[4:]
    for rate, viscosity, pressure in zip(*states, strict=True):
        limit = _kernels.limiting_stress(pressure, 350.0, *limits)
        assert_allclose(limit, limiting_stress(pressure, rheology, 350.0), rtol=ROUND_OFF)
        stress = _kernels.shear_stress(rate, viscosity, limit, *base)
        assert_allclose(stress, shear_stress(rate, viscosity, pressure, rheology, 350.0), rtol=ROUND_OFF)
        ours = _kernels.shear_rate(0.9 * stress, viscosity, limit, *base)
        assert_allclose(ours, shear_rate(0.9 * stress, viscosity, pressure, rheology, 350.0), rtol=ROUND_OFF)


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

"""Viscosity and density laws: reference values, limits, and kernels against their NumPy twins.

Squalane at 298 K after Table 1 of Liu, Long, Li and Guo (2023); values at pressure computed from its printed constants.
5P4E after Yasutomi's law with the constants of Ehret, Dowson and Taylor as read in a public program.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose

from oilfilm.ehl.multigrid.levels import NOTHING
from oilfilm.ehl.oil import _kernels, _laws
from oilfilm.ehl.oil.free_volume import (
    DoolittleFreeVolume,
    ExpansivityForm,
    TaitVolume,
    YasutomiGlass,
    log_viscosity_yasutomi,
    pressure_viscosity_doolittle,
    pressure_viscosity_yasutomi,
    relative_volume,
)
from oilfilm.ehl.oil.lubricant import (
    DensityLaw,
    Lubricant,
    ThermalProperties,
    ViscosityLaw,
    density,
    log_viscosity_ratio,
    oil_numbers,
    viscosity,
)

from ...reference.ehl import oil_laws as reference

TAIT = TaitVolume(bulk_modulus=1.312e9, bulk_modulus_derivative=11.74, reference_temperature=298.0)
DOOLITTLE = DoolittleFreeVolume(factor=5.258, occupied_share=0.6633)
HEAT = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.045, expansion=8e-4)
SQUALANE = Lubricant(
    viscosity=0.0276,
    pressure_viscosity=pressure_viscosity_doolittle(TAIT, DOOLITTLE, 298.0),
    density=864.0,
    viscosity_law=ViscosityLaw.TAIT_DOOLITTLE,
    density_law=DensityLaw.TAIT,
    temperature=298.0,
    tait=TAIT,
    doolittle=DOOLITTLE,
    thermal=HEAT,
)
# with all temperature coefficients, Bair (2006) from memory: any numbers would do here
WARM_TAIT = replace(TAIT, bulk_modulus_temperature=6.332e-3, expansion=8.36e-4)
WARM_DOOLITTLE = DoolittleFreeVolume(factor=4.710, occupied_share=0.6568, occupied_expansion=-7.273e-4)
WARM_SQUALANE = replace(
    SQUALANE,
    temperature=313.15,
    tait=WARM_TAIT,
    doolittle=WARM_DOOLITTLE,
    pressure_viscosity=pressure_viscosity_doolittle(WARM_TAIT, WARM_DOOLITTLE, 313.15),
)
POLYPHENYL_ETHER = YasutomiGlass(
    glass_temperature=244.95,
    glass_rise=134.2,
    glass_pressure_coefficient=1.929e-9,
    expansivity_1=4.815,
    expansivity_2=0.160e-9,
    slope=16.01,
    width=20.69,
    form=ExpansivityForm.LOGARITHMIC,
)
IMPROVED = replace(POLYPHENYL_ETHER, expansivity_1=11e-9, expansivity_2=-0.5, form=ExpansivityForm.POWER)


def yasutomi_oil(glass):
    alpha = pressure_viscosity_yasutomi(glass, 365.15)
    law = ViscosityLaw.YASUTOMI
    return Lubricant(
        viscosity=0.03, pressure_viscosity=alpha, viscosity_law=law, yasutomi=glass, temperature=365.15, thermal=HEAT
    )


OILS = {
    law.value: Lubricant(
        viscosity=0.04, pressure_viscosity=2e-8, viscosity_law=law, temperature=340.0, thermal=HEAT, density_law=dense
    )
    for law, dense in (
        (ViscosityLaw.ROELANDS, DensityLaw.DOWSON_HIGGINSON),
        (ViscosityLaw.BARUS, DensityLaw.INCOMPRESSIBLE),
        (ViscosityLaw.ISOVISCOUS, DensityLaw.INCOMPRESSIBLE),
    )
} | {
    "roelands without pressure": Lubricant(viscosity=0.04, pressure_viscosity=0.0, roelands_z=0.6),
    "tait-doolittle": SQUALANE,
    "tait-doolittle, warm": WARM_SQUALANE,
    "yasutomi": yasutomi_oil(POLYPHENYL_ETHER),
    "yasutomi, improved": yasutomi_oil(IMPROVED),
}


@pytest.fixture(params=OILS.values(), ids=OILS.keys())
def oil(request):
    return request.param


def test_squalane_at_pressure():
    """V/V0 to five digits; viscosity to the four digits given, and 5e-4 where its last digit is a part in 2000."""
    p = np.array([0.1, 0.3, 0.5, 0.8, 1.0]) * 1e9
    volume = [0.94674, 0.89291, 0.86128, 0.82958, 0.81388]
    assert_allclose(relative_volume(p, 298.0, TAIT), volume, atol=5.1e-6)
    assert_allclose(density(p, SQUALANE), 864.0 / np.array(volume), rtol=1e-5)
    assert_allclose(viscosity(p, SQUALANE), [0.1933, 3.460, 39.18, 1126.0, 10033.0], rtol=5e-4)


def test_squalane_pressure_viscosity():
    """B R/[K0 (1 - R)^2] by hand: 5.258 * 0.6633/(1.312 * 0.3367^2) = 23.448 1/GPa."""
    assert_allclose(SQUALANE.pressure_viscosity, 23.448e-9, rtol=1e-4)


def test_yasutomi_glass_line():
    """Along the glass temperature of any pressure the viscosity is that of the glass; below, it is held."""
    p = np.linspace(0.0, 1.5e9, 7)
    line = 244.95 + 134.2 * np.log1p(1.929e-9 * p)
    for glass in (POLYPHENYL_ETHER, IMPROVED):
        assert_allclose(log_viscosity_yasutomi(p, line, glass), 0.0, atol=1e-9)
        assert_allclose(log_viscosity_yasutomi(p, line - 20.0, glass), 0.0, atol=0)
        assert np.all(np.diff(log_viscosity_yasutomi(p, 420.0, glass)) > 0.0)


def test_yasutomi_by_hand():
    """5P4E at 92 degrees Celsius and ambient pressure: D = 120.2 K, eta = 1e12 Pa s 10^(-16.01 D/(20.69 + D))."""
    ratio = log_viscosity_yasutomi(0.0, 365.15, POLYPHENYL_ETHER)
    assert_allclose(1e12 * np.exp(ratio), 10.0 ** (12.0 - 16.01 * 120.2 / 140.89), rtol=1e-12)


def test_pressure_viscosity_is_the_slope(oil):
    """d(ln eta)/dp at ambient pressure; 1 kPa either side, round-off 1e-16/(1e3 Pa * alpha)."""
    slope = (log_viscosity_ratio(1e3, oil) - log_viscosity_ratio(-1e3, oil)) / 2e3
    expected = 0.0 if oil.viscosity_law is ViscosityLaw.ISOVISCOUS else oil.pressure_viscosity
    assert_allclose(slope, expected, rtol=1e-6, atol=1e-13)


def test_pressure_viscosity_must_fit_the_law():
    with pytest.raises(ValueError, match="pressure_viscosity"):
        replace(SQUALANE, pressure_viscosity=18e-9)


@pytest.mark.parametrize("field", ["tait", "doolittle", "temperature"])
def test_missing_constants_are_named(field):
    with pytest.raises(ValueError, match=field):
        replace(SQUALANE, **{field: None})


def test_viscosity_temperature_coefficient(oil):
    """-d(ln eta)/dT at operation and ambient pressure is the oil's own beta unless its law knows better."""
    if oil.temperature is None:
        with pytest.raises(ValueError, match="temperature"):
            viscosity(0.0, oil, 350.0)
        return
    t = oil.temperature
    slope = (log_viscosity_ratio(0.0, oil, t - 1e-3) - log_viscosity_ratio(0.0, oil, t + 1e-3)) / 2e-3
    if oil.yasutomi is None and oil is not WARM_SQUALANE:
        assert_allclose(slope, 0.045, rtol=1e-6)
    else:
        assert slope > 0.01
    assert_allclose(log_viscosity_ratio(3e8, oil, t), log_viscosity_ratio(3e8, oil), rtol=1e-13)


def test_hot_oil_is_thinner_and_lighter(oil):
    if oil.temperature is None:
        return
    p = np.linspace(0.0, 1e9, 5)
    assert np.all(viscosity(p, oil, oil.temperature + 30.0) < viscosity(p, oil))
    assert np.all(density(p, oil, oil.temperature + 30.0) < density(p, oil))


def test_general_form_is_the_isothermal_one():
    p = np.linspace(0.0, 3e9, 9)
    oil = OILS["roelands"]
    z, p_r = oil.exponent, oil.roelands_pressure
    exponent = oil.pressure_viscosity * p_r / z * ((1.0 + p / p_r) ** z - 1.0)
    assert_allclose(viscosity(p, oil), oil.viscosity * np.exp(exponent), rtol=1e-13)
    oil = OILS["barus"]
    assert_allclose(viscosity(p, oil), oil.viscosity * np.exp(oil.pressure_viscosity * p), rtol=1e-13)


@njit(error_model="numpy")
def compiled_laws(p, t, numbers):
    """ln(eta/eta_0), eta and rho/rho_0 as kernels have them."""
    log_ratio = _laws.log_viscosity_ratio(p, t, numbers)
    return log_ratio, _laws.viscosity(p, t, numbers), _laws.density_ratio(p, t, numbers)


def test_laws_agree_with_their_twins(oil):
    """Over arrays and compiled, property by property [exp of up to 60 loses two digits]."""
    numbers, heated = oil_numbers(oil), oil.temperature is not None
    pressures = np.array([0.0, 2e8, 8e8, 1.6e9])
    for t in (320.0, 345.0, 420.0) if heated else (298.15,):
        at = t if heated else None
        log_ratio, ratio = (
            reference.log_viscosity_ratio(pressures, oil, at),
            reference.density_ratio(pressures, oil, at),
        )
        assert_allclose(log_viscosity_ratio(pressures, oil, at), log_ratio, rtol=1e-12, atol=1e-13)
        assert_allclose(density(pressures, oil, at), oil.density * ratio, rtol=1e-14)
        by_node = np.array([compiled_laws(p, t, numbers) for p in pressures]).T
        assert_allclose(by_node[0], log_ratio, rtol=1e-12, atol=1e-13)
        assert_allclose(by_node[1], oil.viscosity * np.exp(log_ratio), rtol=1e-10)
        assert_allclose(by_node[2], ratio, rtol=1e-13)


def test_softening(oil):
    """Minus the slope of ln(eta) over temperature, by a difference of 0.02 K."""
    numbers, heated = oil_numbers(oil), oil.temperature is not None
    for p in (0.0, 2e8, 8e8, 1.6e9):
        for t in (320.0, 345.0, 420.0) if heated else (298.15,):
            cold = viscosity(p, oil, t - 0.01) if heated else 1.0
            hot = viscosity(p, oil, t + 0.01) if heated else 1.0
            softening = _kernels.viscosity_softening(p, t, numbers)
            assert_allclose(softening, np.log(cold / hot) / 0.02, rtol=1e-4, atol=1e-9)


def test_thermal_expansion(oil):
    """Constant with Dowson and Higginson's law; with Tait's own coefficients it falls under pressure."""
    if oil.temperature is None:
        return
    numbers = oil_numbers(oil)
    for p in (0.0, 1e9):
        t = oil.temperature + 5.0
        slope = np.log(density(p, oil, t - 0.1) / density(p, oil, t + 0.1)) / 0.2
        assert_allclose(_kernels.thermal_expansion(p, t, numbers), slope, rtol=1e-5)
    if oil is WARM_SQUALANE:
        assert _kernels.thermal_expansion(1e9, 320.0, numbers) < 0.5 * _kernels.thermal_expansion(0.0, 320.0, numbers)


def test_density_slope(oil):
    """Against a central difference over 20 kPa."""
    numbers = oil_numbers(oil)
    for p in (1e5, 3e8, 2e9):
        slope = (density(p + 1e4, oil) - density(p - 1e4, oil)) / 2e4 / oil.density
        assert_allclose(_laws.density_slope(p, numbers), slope, rtol=1e-5, atol=1e-18)


def test_the_glass_is_thick_beyond_numbers_and_warns_nobody():
    """ln(eta/eta_0) is 600 at most, where the occupied volume fills the whole too."""
    assert log_viscosity_ratio(np.array([0.0, 1e11]), SQUALANE).tolist() == [0.0, _laws.EXPONENT_LIMIT]


def test_flow_properties(oil):
    random = np.random.default_rng(33817)
    P, H = random.uniform(-0.1, 1.2, (5, 7)), random.uniform(-0.05, 1.0, (5, 7))
    eps, rho, slope = (np.empty_like(P) for _ in range(3))
    _kernels.flow_properties(P, H, 1.1e9, oil_numbers(oil), NOTHING, NOTHING, 0.03, eps, rho, slope, 0, len(P))
    p = np.maximum(P, 0.0) * 1.1e9
    assert_allclose(rho, density(p, oil) / oil.density, rtol=1e-13)
    thin = np.exp(-log_viscosity_ratio(p, oil))
    assert_allclose(eps, rho * np.maximum(H, 0.0) ** 3 / 0.03 * thin, rtol=1e-10)

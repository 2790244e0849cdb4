"""Oils of the library: the numbers their sources print, laws against each other, thermal properties."""

from __future__ import annotations

from math import log, log10

import numpy as np
import pytest
from numba import njit
from numpy.testing import assert_allclose

import oilfilm.ehl.oil._kernels  # noqa: F401  # registers the laws with numba
from oilfilm.bearing import list_lubricants, load_lubricant
from oilfilm.bearing.library.lubricants import LAWS, PROPERTIES, lubricant_data
from oilfilm.ehl import DensityLaw, Lubricant, ViscosityLaw
from oilfilm.ehl.data_files import as_document, from_document
from oilfilm.ehl.oil import _laws
from oilfilm.ehl.oil.lubricant import density, heat_properties, log_viscosity_ratio, oil_numbers, viscosity

from ...reference.ehl import oil_laws as reference

VOGEL = {10: (0.1, 623.0), 22: (0.087, 748.0), 32: (0.0813, 808.0), 46: (0.0762, 866.0), 68: (0.071, 929.0)}
VOGEL[100] = (0.0662, 990.0)
POLYALPHAOLEFINS = {  # viscosity [mPa s], coefficient [1/GPa], density [kg/m^3], conductivity [W/(m K)]
    4: (13.62, 14.8, 815.8, 0.1407),
    10: (52.52, 17.1, 835.0, 0.16),
    40: (345.8, 23.89, 843.4, 0.1641),
    100: (1068.0, 23.06, 854.2, 0.165),
}
GRADES = (10, 15, 22, 32, 46, 68, 100, 150, 220)


def kinematic(name, celsius):
    """[mm^2/s]"""
    oil = load_lubricant(name, celsius + 273.15)
    return 1e6 * oil.viscosity / oil.density


def test_the_oils_are_there():
    wanted = {f"iso vg {grade}" for grade in GRADES} | {f"pao {grade}" for grade in (4, 10, 40, 100)}
    assert wanted | {"mil-l-23699", "mil-l-7808", "squalane"} <= set(list_lubricants())


def is_sourced(data):
    """Whether a property names a source, as unverified exactly where it says so."""
    source = data["source"]
    return bool(source) and data.get("verified", True) == (not source.startswith("unverified"))


def test_every_property_has_a_source():
    oils = {name: lubricant_data(name) for name in list_lubricants()}
    assert [(name, field) for name, data in oils.items() for field in PROPERTIES if not is_sourced(data[field])] == []
    assert [name for name, data in oils.items() if not data["range_C"][0] < 40.0 <= data["range_C"][1]] == []
    assert [name for name, data in oils.items() if data["viscosity"]["law"] not in LAWS] == []
    assert [name for name, data in oils.items() if not is_sourced(data.get("pour_point", data["viscosity"]))] == []


@pytest.mark.parametrize("grade", VOGEL)
def test_vogel_of_the_mineral_oils(grade):
    """nu = a exp(b/(t + 95)), constants printed by Thermca."""
    a, b = VOGEL[grade]
    for celsius in (20.0, 40.0, 70.0, 100.0):
        assert kinematic(f"iso vg {grade}", celsius) == pytest.approx(a * np.exp(b / (celsius + 95.0)), rel=1e-12)


def test_vogel_of_vg_32_as_printed():
    assert_allclose([kinematic("iso vg 32", t) for t in (40.0, 70.0, 100.0)], [32.3, 10.9, 5.12], rtol=4e-3)


@pytest.mark.parametrize("grade", [15, 150, 220])
def test_grades_that_continue_the_series(grade):
    """b of Vogel's law is a straight line over ln(grade) in the six printed ones, and the grade is met at 40 C."""
    x = [log(kinematic(f"iso vg {g}", 40.0)) for g in VOGEL]
    y = [lubricant_data(f"iso vg {g}")["viscosity"]["b_K"] for g in VOGEL]
    line = np.polyfit(x, y, 1)
    assert np.abs(np.polyval(line, x) - y).max() < 0.2
    assert lubricant_data(f"iso vg {grade}")["viscosity"]["b_K"] == pytest.approx(np.polyval(line, log(grade)), abs=1.0)
    assert kinematic(f"iso vg {grade}", 40.0) == pytest.approx(grade, rel=2e-3)


@pytest.mark.parametrize(
    ("grade", "celsius", "alpha"),
    [(10, 60.0, 16.0), (32, 30.0, 28.0), (46, 100.0, 16.0), (68, 30.0, 23.7), (100, 60.0, 20.5), (220, 100.0, 17.6)],
)
def test_pressure_viscosity_of_the_mineral_oils(grade, celsius, alpha):
    """Stachowiak and Batchelor, Table 2.3, at its own temperatures."""
    oil = load_lubricant(f"iso vg {grade}", celsius + 273.15)
    assert 1e9 * oil.pressure_viscosity == pytest.approx(alpha, rel=1e-12)


@pytest.mark.parametrize("grade", POLYALPHAOLEFINS)
def test_polyalphaolefins_as_printed(grade):
    """At 40 C the printed set (five figures of nu), at 100 C the grade."""
    viscosity_mPa_s, alpha, rho, conductivity = POLYALPHAOLEFINS[grade]
    oil = load_lubricant(f"pao {grade}", 313.15)
    assert 1e3 * oil.viscosity == pytest.approx(viscosity_mPa_s, rel=5e-5)
    assert 1e9 * oil.pressure_viscosity == pytest.approx(alpha, rel=1e-12)
    assert oil.density == rho
    assert oil.thermal.conductivity == conductivity
    assert kinematic(f"pao {grade}", 100.0) == pytest.approx(grade, rel=1e-12)


def test_pao_10_beside_a_makers_sheet():
    """Chevron Phillips, Synfluid PAO 10: 61.0 and 9.64 mm^2/s at 40 and 100 C; grades are rounded."""
    assert kinematic("pao 10", 40.0) == pytest.approx(61.0, rel=0.04)
    assert kinematic("pao 10", 100.0) == pytest.approx(9.64, rel=0.04)


def test_astm_d341_is_a_straight_line():
    """log10 log10(nu + 0.7) over log10 T."""
    kelvin = np.array([290.0, 313.15, 350.0, 373.15])
    y = [log10(log10(kinematic("pao 40", t - 273.15) + 0.7)) for t in kelvin]
    slopes = np.diff(y) / np.diff(np.log10(kelvin))
    assert_allclose(slopes, slopes[0], rtol=1e-9)


def test_roelands_exponent_of_a_polyalphaolefin_is_the_same_at_every_temperature():
    z = [load_lubricant("pao 40", t).exponent for t in (290.0, 313.15, 370.0)]
    assert_allclose(z, z[0], rtol=1e-12)


def test_mil_l_23699_and_7808_as_printed():
    """Density and conductivity of the printed points."""
    for celsius, expected in ((-40.0, 3.27619), (100.0, 5.00578e-3)):  # the fit's three constants by hand
        found = load_lubricant("mil-l-23699", celsius + 273.15).viscosity
        assert found == pytest.approx(expected, rel=1e-4)
    assert load_lubricant("mil-l-23699", 367.0).density == 922.0
    assert load_lubricant("mil-l-23699", 366.67).thermal.conductivity == pytest.approx(0.14868, rel=1e-12)
    hot = load_lubricant("mil-l-7808", 373.15)
    assert hot.pressure_viscosity == pytest.approx(7.5808e-10 + 1.0742e-6 / (373.15 - 215.56), rel=1e-12)


def test_squalane_at_pressure():
    """Values computed for the constants of Liu et al. (2023): at 0.1, 0.3, 0.5, 0.8 and 1 GPa and 25 C."""
    laws = {"viscosity_law": ViscosityLaw.TAIT_DOOLITTLE, "density_law": DensityLaw.TAIT}
    oil = load_lubricant("squalane", 298.15, **laws)
    p = np.array([0.1, 0.3, 0.5, 0.8, 1.0]) * 1e9
    volume = [0.94674, 0.89291, 0.86128, 0.82958, 0.81388]
    assert_allclose(864.0 / density(p, oil), volume, rtol=1e-5)
    assert_allclose(viscosity(p, oil), [0.1933, 3.460, 39.18, 1126.0, 10033.0], rtol=5e-4)
    default = load_lubricant("squalane", 298.15)
    assert default.viscosity_law is ViscosityLaw.ROELANDS
    assert default.pressure_viscosity == pytest.approx(oil.pressure_viscosity, rel=1e-3)


def thermal_faults(name):
    """Properties of an oil that contradict its laws or are no oil's."""
    low, high = (t + 273.15 for t in lubricant_data(name)["range_C"])
    middle = 0.5 * (low + high)
    oil, cold, hot = (load_lubricant(name, t) for t in (middle, middle - 1.0, middle + 1.0))
    thermal = oil.thermal
    viscosity_slope = 0.5 * log(cold.viscosity / hot.viscosity)
    density_slope = 0.5 * log(cold.density / hot.density)
    checks = {
        "temperature": oil.temperature == middle,
        "slope of viscosity": thermal.viscosity_temperature == pytest.approx(viscosity_slope, rel=2e-3),
        "slope of density": thermal.expansion == pytest.approx(density_slope, rel=2e-3),
        "viscosity_temperature": 0.01 < thermal.viscosity_temperature < 0.1,
        "expansion": 5e-4 < thermal.expansion < 9e-4,
        "conductivity": 0.11 < thermal.conductivity < 0.17,
        "specific_heat": 1800.0 < thermal.specific_heat < 2200.0,
    }
    return [check for check, passed in checks.items() if not passed]


def test_temperature_coefficients_are_the_slopes_of_the_laws():
    """-d(ln eta)/dT and -d(ln rho)/dT against differences over 2 K; curvature of the laws enters with 1e-3."""
    found = {name: thermal_faults(name) for name in list_lubricants()}
    assert {name: wrong for name, wrong in found.items() if wrong} == {}


@pytest.mark.parametrize(("name", "celsius"), [("pao 4", 130.0), ("squalane", 100.0), ("iso vg 220", 0.0)])
def test_outside_its_range_an_oil_warns(name, celsius):
    with pytest.warns(UserWarning, match="outside"):
        load_lubricant(name, celsius + 273.15)


@pytest.mark.parametrize("name", ["ISO-VG 150", "isovg150", "MIL-L-23699", "PAO-40", "Squalane"])
def test_names_match_without_case_spaces_and_hyphens(name):
    assert load_lubricant(name, 313.15).name in list_lubricants()


def test_the_higher_the_grade_the_thicker():
    for series in ([f"iso vg {g}" for g in GRADES], [f"pao {g}" for g in (4, 10, 40, 100)]):
        for celsius in (40.0, 100.0):
            values = [kinematic(name, celsius) for name in series]
            assert values == sorted(values)


def asymptotic_coefficient(oil):
    """Reciprocal asymptotic isoviscous pressure coefficient, 1/int eta_0/eta dp [1/GPa]."""
    p = np.linspace(0.0, 0.9e9, 30001)  # beyond it the oil is 1e7 times as thick
    return 1e9 / np.trapezoid(oil.viscosity / viscosity(p, oil), p)


def test_fva_3_as_its_constants_give():
    """Wingertszahn (2023): 84.54 mPa s, 96.9 mm^2/s and a coefficient of 22.36 /GPa at 40 C; the law at 0.8 GPa."""
    oil = load_lubricant("fva 3", 313.15)
    assert 1e3 * oil.viscosity == pytest.approx(84.54, abs=5e-3)
    assert kinematic("fva 3", 40.0) == pytest.approx(96.9, abs=0.05)
    assert 1e9 * oil.pressure_viscosity == pytest.approx(22.36, abs=5e-3)
    bar, celsius = 8000.0, 60.0
    modulus = 327.7918 + 2.9862 * celsius + (4.419e-3 + 3.0115e-4 * celsius) * bar
    ambient = 0.062e-3 * np.exp(1021.7 / (celsius + 101.5517))
    assert viscosity(8e8, oil, 333.15) == pytest.approx(ambient * np.exp(bar / modulus), rel=2e-4)


@pytest.mark.parametrize(
    ("name", "cold", "hot", "viscosity_mPa_s"),
    [("arana n100", 27.3, 17.4, 86.0), ("arana m100", 20.9, 16.3, 84.0), ("arana pao100", 15.4, 11.3, 78.0)],
)
def test_oils_of_the_twin_discs(name, cold, hot, viscosity_mPa_s):
    """Coefficients of the printed constants at 40 and 100 C, and the ambient viscosity from nu and rho."""
    for celsius, alpha in ((40.0, cold), (100.0, hot)):
        oil = load_lubricant(name, celsius + 273.15)
        assert 1e9 * oil.pressure_viscosity == pytest.approx(alpha, abs=0.06)
    assert 1e3 * load_lubricant(name, 313.15).viscosity == pytest.approx(viscosity_mPa_s, rel=0.02)


def test_shell_t9_as_known():
    """8.97 mPa s at 40 C, coefficient 19.0 /GPa; k 0.111 W/mK, rho c 1.56e6 at 298 K, 2.2 and 1.34 times at 1 GPa."""
    oil = load_lubricant("shell t9", 313.15)
    assert 1e3 * oil.viscosity == pytest.approx(8.97, rel=0.01)
    assert asymptotic_coefficient(oil) == pytest.approx(19.0, rel=0.02)
    ambient = load_lubricant("shell t9", 298.0)
    assert ambient.density == pytest.approx(872.0, rel=1e-9)
    k, capacity = heat_properties(0.0, ambient, 298.0)
    assert k == pytest.approx(0.111, abs=5e-4)
    assert capacity == pytest.approx(1.56e6, rel=1e-6)
    under = heat_properties(1e9, ambient, 298.0)
    assert_allclose([under[0] / k, under[1] / capacity], [2.2, 1.34], rtol=0.02)


def test_mineral_23d_at_its_reference():
    oil = load_lubricant("mineral 23d", 273.15)
    assert 1e3 * oil.viscosity == pytest.approx(84.7, rel=1e-9)
    assert oil.density == pytest.approx(829.0, rel=1e-9)
    assert oil.exponent == pytest.approx(0.79, abs=2e-3)


def test_heat_of_mineral_oil_and_pao_under_pressure():
    """Larsson and Andersson (2000) at 22 C: k and rho c at 1 GPa by hand; they stay beyond 1.1 GPa and 107 C."""
    for name, k_factor, capacity_factor in (
        ("iso vg 46", 1.0 + 1.72 / 1.54, 1.0 + 0.47 / 1.81),
        ("pao 40", 1.0 + 1.40 / 1.34, 1.0 + 0.41 / 2.05),
    ):
        oil = load_lubricant(name, 295.15)
        k, capacity = heat_properties(1e9, oil, 295.15)
        assert k / oil.thermal.conductivity == pytest.approx(k_factor, rel=1e-12)
        assert capacity / (oil.density * oil.thermal.specific_heat) == pytest.approx(capacity_factor, rel=1e-12)
        assert_allclose(heat_properties(3e9, oil, 500.0), heat_properties(1.1e9, oil, 380.15), rtol=1e-12)


@pytest.mark.parametrize("name", list_lubricants())
@pytest.mark.filterwarnings("ignore:lubricant")
def test_kernels_have_the_same_oil(name):
    """Viscosity and heat of every oil, over pressure and temperature, as the compiled laws have them."""
    oil = load_lubricant(name, 333.15)
    numbers = oil_numbers(oil)
    p, t = (a.ravel() for a in np.meshgrid([0.0, 3e8, 1.3e9], [310.0, 333.15, 400.0]))
    wanted = reference.log_viscosity_ratio(p, oil, t)
    assert_allclose(log_viscosity_ratio(p, oil, t), wanted, rtol=1e-12, atol=1e-13)
    assert_allclose(
        [compiled_log_viscosity(*at, numbers) for at in zip(p, t, strict=True)], wanted, rtol=1e-9, atol=1e-9
    )
    ratios = reference.heat_ratios(p, oil, t)
    ambient = oil.thermal.conductivity, oil.density * oil.thermal.specific_heat
    for found, ratio, unit in zip(heat_properties(p, oil, t), ratios, ambient, strict=True):
        assert_allclose(found, ratio * unit, rtol=1e-12)
    found = [compiled_heat(*at, numbers) for at in zip(p, t, strict=True)]
    assert_allclose(np.transpose(found), ratios, rtol=1e-11)


@njit(error_model="numpy")
def compiled_log_viscosity(p, t, numbers):
    return _laws.log_viscosity_ratio(p, t, numbers)


@njit(error_model="numpy")
def compiled_heat(p, t, numbers):
    rho = _laws.density_ratio(p, t, numbers)
    return _laws.conductivity_ratio(p, t, numbers), _laws.capacity_ratio(p, t, rho, numbers)


def test_the_interval_of_the_coefficient_of_pressure_is_no_part_of_files():
    """Tables of films belong to the value alone, and those made before still do."""
    oil = load_lubricant("iso vg 68", 333.15)
    low, high = oil.pressure_viscosity_ends
    assert 0.6 < low < 1.0 < high < 1.4
    document = as_document(oil, {})
    assert "pressure_viscosity_ends" not in document
    assert from_document(document, Lubricant, {}) == oil
    assert load_lubricant("fva 3", 333.15).pressure_viscosity_ends == (1.0, 1.0)

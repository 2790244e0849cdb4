"""Materials: every number with source and range, thermal data, second names."""

from __future__ import annotations

import math

import numpy as np
import pytest

from oilfilm.bearing import Material, MaterialKind, list_materials, load_material
from oilfilm.bearing.material import FIELDS, material_data

CAGES = ("brass", "bronze", "pa66", "pa66 glass filled", "peek", "phenolic", "pvx")


def is_documented(key, number):
    """Whether a number of a material is known, in its range, and sourced, as unverified exactly where it says so."""
    if key == "expansion":  # points over the temperature
        return bool(number["source"]) and len(number["temperature_K"]) == len(number["strain_um_m"])
    if key == "over_temperature":
        rows = number.values()
        kept = all(row["source"] and len(row["temperature_K"]) == len(row["value"]) for row in rows)
        return kept and set(number) <= set(FIELDS.values())
    low, high = number["range"]
    source = number["source"]
    sourced = bool(source) and number.get("verified", True) == (not source.startswith("unverified"))
    return sourced and low <= number["value"] <= high and key in FIELDS.values()


def test_every_number_has_a_source_and_lies_in_its_range():
    numbers = [
        (name, key, number) for name in list_materials() for key, number in material_data(name).items() if key != "kind"
    ]
    assert numbers
    assert [(name, key) for name, key, number in numbers if not is_documented(key, number)] == []


def test_materials_of_rings_balls_and_cages_are_there():
    wanted = {"52100", "100cr6", "m50", "cr4mo4v", "silicon nitride", "silicon nitride hp", "silicon nitride gps"}
    assert wanted | {"zirconia"} | set(CAGES) <= set(list_materials())


@pytest.mark.parametrize(
    ("name", "conductivity", "heat"),
    [("silicon nitride hp", 30.0, None), ("zirconia", 2.0, 500.0), ("brass", 120.0, 380.0), ("pvx", 0.82, 1100.0)],
)
def test_thermal_data_of_the_sources(name, conductivity, heat):
    """Lily Bearing, Kientec, MakeItFrom, and Table 3 of Yao et al. (2022)."""
    material = load_material(name)
    assert material.thermal_conductivity == conductivity
    assert heat is None or material.specific_heat == heat


def test_what_is_not_known_is_left_out_and_what_is_not_read_is_named():
    phenolic, pvx = load_material("phenolic"), load_material("PVX")
    assert phenolic.thermal_conductivity is None
    assert phenolic.specific_heat is None
    assert phenolic.thermal_expansion is None
    assert set(pvx.unverified) == {"poisson_ratio", "density"}
    assert load_material("zirconia").unverified == ()


@pytest.mark.parametrize(("second", "first"), [("100Cr6", "52100"), ("Cr4Mo4V", "M50")])
def test_second_names(second, first):
    one, other = load_material(second), load_material(first)
    assert one.youngs_modulus == other.youngs_modulus
    assert one.kind is other.kind is MaterialKind.BEARING_STEEL


@pytest.mark.parametrize("field", ["thermal_conductivity", "specific_heat"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan")])
def test_impossible_thermal_data_name_the_field(field, value):
    data = {"name": "x", "youngs_modulus": 2e11, "poisson_ratio": 0.3, "density": 7800.0}
    with pytest.raises(ValueError, match=field):
        Material(**data, **{field: value})


def test_expansion_is_its_integral_where_it_is_known():
    """304 at 77 K: -280e-5 by NIST's polynomial; by the mean coefficient of warm steel a quarter more."""
    steel = load_material("stainless steel")
    assert steel.thermal_strain(77.0 - 293.15) == pytest.approx(-2.80e-3, rel=0.01)
    assert steel.thermal_expansion * (77.0 - 293.15) / steel.thermal_strain(77.0 - 293.15) > 1.25
    assert steel.thermal_strain(100.0) == pytest.approx(1.65e-3)  # beyond the data by the coefficient
    assert steel.thermal_strain(0.0) == 0.0
    alumina = load_material("alumina")
    # NIST's densities of sintered alumina, 3.984 and 3.834 g/cm3 at 20 and 1500 C
    assert alumina.thermal_strain(1480.0) == pytest.approx((3.984 / 3.834) ** (1 / 3) - 1.0, rel=1e-3)
    for material in (steel, alumina, load_material("silicon nitride")):
        strains = [material.thermal_strain(rise) for rise in range(-250, 1400, 50)]
        assert strains == sorted(strains)
    m50 = load_material("m50")
    assert m50.thermal_strain(100.0) == m50.thermal_expansion * 100.0


def test_silicon_nitride_expands_with_its_heat_content():
    """JANAF's heat capacity of 300 to 3000 K, 3.3e-6 1/K on average over 20 to 1000 C; 0.25 per mille to 77 K."""

    def heat(kelvin):
        low = kelvin < 1000.0
        cold = (7.163568, 0.019007111, -1.1469333e-05, 7.0665915e-09, -2.745864e-12)
        hot = (2.7981745, 0.027975018, -1.5020578e-05, 3.5872288e-09, -3.1776969e-13)
        return 8.314462 / 0.140283 * np.polynomial.polynomial.polyval(kelvin, cold if low else hot)

    cold, warm = load_material("silicon nitride"), load_material("silicon nitride", 773.15)
    assert warm.specific_heat / cold.specific_heat == pytest.approx(heat(773.15) / heat(293.15), rel=0.02)
    kelvins = np.linspace(293.15, 1273.15, 2001)
    content = np.concatenate([[0.0], np.cumsum(np.diff(kelvins) * [heat(k) for k in kelvins[1:]])])
    share = np.interp(773.15, kelvins, content) / content[-1]
    assert cold.thermal_strain(480.0) == pytest.approx(share * cold.thermal_strain(980.0), rel=5e-3)
    assert cold.thermal_strain(980.0) == pytest.approx(3.3e-6 * 980.0, rel=1e-3)
    assert cold.thermal_strain(77.0 - 293.15) == pytest.approx(-252e-6)


def test_properties_over_the_temperature_change_by_the_ratio_of_their_source():
    """Sintered alumina at 1000 C by NIST, 364 of 416 GPa and 345 of 380 MPa; SiC by Snead et al. at 500 C."""
    cold, hot = load_material("alumina"), load_material("alumina", 1273.15)
    assert hot.youngs_modulus / cold.youngs_modulus == pytest.approx(364.0 / 416.0)
    assert hot.bending_strength / cold.bending_strength == pytest.approx(345.0 / 380.0)
    assert hot.bending_strength_range[0] / cold.bending_strength_range[0] == pytest.approx(345.0 / 380.0)
    assert hot.thermal_conductivity == cold.thermal_conductivity
    carbide = load_material("silicon carbide", 773.15)
    expected = (460.0 - 0.04 * 773.15 * math.exp(-962.0 / 773.15)) / (460.0 - 0.04 * 293.15 * math.exp(-962.0 / 293.15))
    assert carbide.youngs_modulus / load_material("silicon carbide").youngs_modulus == pytest.approx(expected, rel=1e-4)
    mean = carbide.thermal_strain(980.0) / 980.0
    assert mean == pytest.approx(4.36e-6, rel=0.01)


def test_beyond_the_ends_of_a_source_a_property_is_held_with_a_warning():
    with pytest.warns(UserWarning, match="alumina: ") as found:
        cold = load_material("alumina", 77.0)
    assert "alumina: youngs_modulus_GPa at 77 K is held at 293 K" in str(found[0].message)
    assert cold.youngs_modulus == load_material("alumina").youngs_modulus

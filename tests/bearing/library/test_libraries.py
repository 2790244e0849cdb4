"""Data files: every entry loads, gives possible things, and meets the numbers its source quotes."""

from __future__ import annotations

from dataclasses import fields
from itertools import pairwise

import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import (
    list_bearings,
    list_lubricants,
    list_materials,
    load_catalogue_entry,
    load_lubricant,
    load_material,
    reduced_modulus,
)
from oilfilm.bearing.library.lubricants import lubricant_data
from oilfilm.ehl import DensityLaw


def test_materials_load_with_source():
    materials = {name: load_material(name.upper()) for name in list_materials()}
    assert {name: material.name for name, material in materials.items() if material.name != name} == {}
    assert [name for name, material in materials.items() if "youngs_modulus_GPa" not in material.source] == []


@pytest.mark.parametrize(
    ("one", "two", "expected"),
    [("bearing steel", "bearing steel", 226.4e9), ("silicon nitride", "bearing steel", 269.0e9)],
)
def test_reduced_modulus(one, two, expected):
    """206 GPa, 0.3: 226.4; with silicon nitride of 310 GPa, 0.26: 269.4 GPa, and symmetric."""
    a, b = load_material(one), load_material(two)
    assert reduced_modulus(a, b) == pytest.approx(expected, rel=2e-3)
    assert reduced_modulus(a, b) == reduced_modulus(b, a)


def test_unknown_names_list_the_known():
    with pytest.raises(ValueError, match="silicon nitride"):
        load_material("cheese")
    with pytest.raises(ValueError, match="mil-l-23699"):
        load_lubricant("butter", 313.15)
    with pytest.raises(ValueError, match="6208"):
        load_catalogue_entry("1")


def test_viscosity_falls_with_temperature():
    offenders = []
    for name in list_lubricants():
        low, high = lubricant_data(name)["range_C"]
        oils = [load_lubricant(name, 273.15 + low + share * (high - low)) for share in (0.0, 0.3, 0.7, 1.0)]
        for cold, hot in pairwise(oils):
            if cold.viscosity <= hot.viscosity or cold.pressure_viscosity < hot.pressure_viscosity:
                offenders.append((name, cold, hot))
    assert offenders == []


def test_a_law_of_density_can_be_chosen_for_every_oil():
    chosen = DensityLaw.INCOMPRESSIBLE
    oils = [load_lubricant(name, 313.15, density_law=chosen) for name in list_lubricants()]
    assert [oil for oil in oils if oil.density_law is not chosen] == []


@pytest.mark.parametrize(
    ("name", "at_40", "at_100", "alpha"),
    [
        ("mil-l-23699", 26.7, 5.45, (14.2, 11.0)),
        ("mil-l-7808", 12.2, 3.15, (11.8, 7.6)),
        ("iso vg 32", 32.3, 5.12, None),
    ],
)
def test_kinematic_viscosities_quoted_with_the_fits(name, at_40, at_100, alpha):
    """Three quoted figures, in mm^2/s and 1/GPa."""
    cold, hot = load_lubricant(name, 313.15), load_lubricant(name, 373.15)
    assert_allclose([1e6 * oil.viscosity / oil.density for oil in (cold, hot)], [at_40, at_100], rtol=5e-3)
    if alpha:
        assert_allclose([1e9 * oil.pressure_viscosity for oil in (cold, hot)], alpha, rtol=5e-3)


def test_viscosity_grades():
    """ISO 3448: within 10 % of the grade at 40 C."""
    oils = {name: load_lubricant(name, 313.15) for name in list_lubricants() if name.startswith("iso vg")}
    relative = {name: 1e6 * oil.viscosity / oil.density / float(name.split()[-1]) for name, oil in oils.items()}
    assert relative
    assert {name: ratio for name, ratio in relative.items() if abs(ratio - 1.0) > 0.1} == {}


def test_outside_its_range_a_lubricant_warns():
    with pytest.warns(UserWarning, match="outside"):
        load_lubricant("iso vg 32", 253.15)


DIMENSIONS = {"ball_diameter_mm", "pitch_diameter_mm", "balls", "inner_groove_radius_mm", "outer_groove_radius_mm"}


def faults(name, entry):
    """What is wrong with an entry of the catalogue."""
    ranges = entry.get("range", {})
    checks = {
        "name": entry["name"] == name,
        "source": bool(entry["source"]),
        "dimensions": entry.keys() >= DIMENSIONS,
        "clearance or angle": ("diametral_clearance_um" in entry) != ("free_contact_angle_deg" in entry),
        "estimates and ranges": set(entry["estimated"]) == set(ranges),
        "values in ranges": all(low <= entry[key] <= high for key, (low, high) in ranges.items()),
        "materials": {entry["ball_material"], entry["ring_material"]} <= set(list_materials()),
    }
    return [check for check, passed in checks.items() if not passed]


def test_catalogue_entries_are_complete_and_name_their_estimates():
    found = {name: faults(name, load_catalogue_entry(name)) for name in list_bearings()}
    assert found
    assert {name: wrong for name, wrong in found.items() if wrong} == {}


def test_material_is_frozen():
    material = load_material("zirconia")
    with pytest.raises(AttributeError):
        setattr(material, fields(material)[0].name, "glass")

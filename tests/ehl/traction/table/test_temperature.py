"""Traction tables over the temperature: what lies between them, their range, the check at temperatures not in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl.arrays import lagrange_weights
from oilfilm.ehl.oil.lubricant import log_viscosity_ratio
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.traction_table.build import TableOptions
from oilfilm.ehl.traction_table.storage import load_table, save_table
from oilfilm.ehl.traction_table.table import TableContact, TableRange
from oilfilm.ehl.traction_table.temperature import TemperatureTable, build_temperature_table

from ....reference.ehl import traction as reference

LIMITS = TableRange(load=(40.0, 80.0), speed=(4.0, 8.0), slide_x=0.5, slide_y=0.3, spin=0.3)
OPTIONS = TableOptions(points=65, tolerance=0.03, check_films=2, check_motions=40, rounds=1, nodes=(4, 4, 17, 7, 9))
TEMPERATURES = (313.15, 333.15, 353.15)


def contact_at(temperature):
    """A circle in an oil whose viscosity falls by half every twenty degrees or so."""
    return TableContact(
        radius_x=10e-3,
        radius_y=10e-3,
        reduced_modulus=226e9,
        lubricant=load_lubricant("iso vg 32", temperature),
        rheology=Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6, limiting_coefficient=0.047),
        temperature=temperature,
        curvature_radius=0.5,
        curvature_difference=50.0,
    )


@pytest.fixture(scope="module")
def table():
    return build_temperature_table(contact_at, TEMPERATURES, LIMITS, OPTIONS)


@pytest.mark.slow
def test_at_its_temperatures_it_is_the_table_there(table):
    assert [table.at(one) for one in TEMPERATURES] == list(table.tables)


def test_between_it_agrees_with_films_there(table):
    """The check half-way has oil of that temperature; three tables twenty kelvin apart leave no more than 2 %."""
    assert len(table.errors) == 2
    for error, own in zip(table.errors, table.tables, strict=False):
        assert 0.0 < error.rms < error.largest < own.error.largest + 0.02
    middle, warm = table.at(323.15), contact_at(323.15)
    assert_allclose(middle.contact.lubricant.viscosity, warm.lubricant.viscosity, rtol=0.02)
    cold, hot = (own.forces(60.0, 6.0, 0.01, 0.0, 0.0) for own in table.tables[:2])
    found = middle.forces(60.0, 6.0, 0.01, 0.0, 0.0)
    assert hot.film < found.film < cold.film
    motion = (60.0, 6.0, 0.01, 0.02, 5.0)
    assert_allclose(middle.forces(*motion)[:8], reference.table_forces(middle, *motion))


def test_tables_count_by_the_viscosity_in_the_contact(table):
    """Lagrange's weights over ln eta at two thirds of Hertz' pressure under the largest load."""
    oil = contact_at(323.15).lubricant
    pressure = 2.0 / 3.0 * (6.0 * 80.0 * (0.5 * 226e9) ** 2 / (np.pi**3 * 0.01**2)) ** (1.0 / 3.0)
    logs = [np.log(one.viscosity) + log_viscosity_ratio(pressure, one) for one in (*oils_of(table), oil)]
    expected = lagrange_weights(np.array(logs[:-1]), logs[-1])
    assert_allclose(table._weights(table.tables, oil), expected, rtol=1e-6)


def oils_of(table):
    return [one.contact.lubricant for one in table.tables]


def test_tables_between_are_saved_as_they_are(table, tmp_path):
    """Their values are sums of whole numbers with weights, no whole numbers themselves."""
    middle = table.at(323.15)
    save_table(middle, tmp_path / "middle.npz")
    read = load_table(tmp_path / "middle.npz")
    motion = (60.0, 6.0, 0.01, 0.02, 5.0)
    assert read.forces(*motion) == middle.forces(*motion)


def test_temperatures_out_of_range_are_refused(table):
    with pytest.raises(ValueError, match=r"temperature must lie within 313.15 to 353.15 K.* got 360.00 K"):
        table.at(360.0)


def test_tables_that_do_not_fit_are_refused(table):
    with pytest.raises(ValueError, match="rising temperatures"):
        TemperatureTable(tables=table.tables[::-1])
    other = replace(table.tables[1], range=replace(LIMITS, spin=0.2))
    with pytest.raises(ValueError, match="same range and nodes"):
        TemperatureTable(tables=(table.tables[0], other))


def test_weights_reproduce_polynomials():
    places = np.array([313.0, 333.0, 343.0, 373.0])
    weights = lagrange_weights(places, 350.0)
    assert_allclose(weights.sum(), 1.0)
    assert_allclose(weights @ (places - 340.0) ** 3, 1000.0, rtol=1e-9)

"""Block `electrical`: films and balls in series, the films of made-up results."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.contacts import electrical
from oilfilm.bearing.material import MaterialKind
from oilfilm.ehl.traction.instruments import VACUUM_PERMITTIVITY
from oilfilm.postprocess import summary

KINDS = (MaterialKind.BEARING_STEEL, MaterialKind.SILICON_NITRIDE, MaterialKind.OTHER)
STEEL, NITRIDE, OTHER = KINDS


@pytest.fixture
def of(bearing_results):
    """Results of a bearing with rings and balls of two kinds of material."""

    def made(rings, balls):
        state = bearing_results.quasistatic
        material = state.bearing.ball_material
        parts = {"ball_material": replace(material, kind=balls)}
        for ring in ("inner", "outer"):
            parts[f"{ring}_ring_material"] = replace(material, kind=rings)
        bearing = replace(state.bearing, **parts)
        return replace(bearing_results, quasistatic=replace(state, bearing=bearing))

    return made


def electrical_block(results):
    return summary(results)["electrical"]


def electrical_messages(results):
    return [text for text in summary(results)["messages"] if text.startswith("electrical")]


def test_steel_balls_join_two_films_in_series(of):
    results = of(STEEL, STEEL)
    block = electrical_block(results)
    by_ball = {}
    for contact, film in zip(results.contacts, results.instruments, strict=True):
        if film is not None:
            by_ball.setdefault(contact.ball, []).append(film)
    pairs = [films for films in by_ball.values() if len(films) == 2]
    total = sum(a.capacitance * b.capacitance / (a.capacitance + b.capacitance) for a, b in pairs)
    assert pairs
    assert_allclose(block["capacitance_pF"], 1e12 * total)
    assert block["capacitance_low_pF"] < block["capacitance_pF"] < block["capacitance_high_pF"]
    # two equal films would share the voltage evenly
    a, b = pairs[0]
    voltage = min(
        a.breakdown_voltage * (a.capacitance + b.capacitance) / b.capacitance,
        b.breakdown_voltage * (a.capacitance + b.capacitance) / a.capacitance,
    )
    assert block["breakdown_voltage_low_V"] < block["breakdown_voltage_V"] <= voltage * (1.0 + 1e-12)


def test_ceramic_balls_take_most_of_the_voltage(of):
    steel, hybrid = electrical_block(of(STEEL, STEEL)), electrical_block(of(STEEL, NITRIDE))
    assert hybrid["capacitance_pF"] < 0.2 * steel["capacitance_pF"]
    assert hybrid["breakdown_voltage_V"] is None
    assert any("balls of silicon nitride" in text for text in electrical_messages(of(STEEL, NITRIDE)))


def test_ball_between_spots_and_columns():
    """Two circular spots: 4 eps a each; straight columns through a sphere: pi R eps."""
    spots, radius = np.full((2, 2), 1e-4), 6e-3
    value, low, high = electrical._ball_capacitance(spots, radius)
    permittivity = 8.0 * VACUUM_PERMITTIVITY
    assert_allclose(low, 0.5 * 4.0 * permittivity * 1e-4)
    assert_allclose(high, np.pi * radius * permittivity)
    assert_allclose(value, np.sqrt(low * high))


@pytest.mark.parametrize(("rings", "balls", "why"), [(NITRIDE, STEEL, "insulates"), (OTHER, STEEL, "not known")])
def test_what_is_not_known_is_null_with_its_reason(of, rings, balls, why):
    results = of(rings, balls)
    assert electrical_block(results) is None
    assert any(text.startswith("electrical: null") and why in text for text in electrical_messages(results))

"""What inlets leave of the rolling moment, by SKF's formulas written out apart; n 6000 r/min, nu 20 mm^2/s, 6208."""

from __future__ import annotations

from dataclasses import replace
from math import exp, sqrt

import pytest

from oilfilm.bearing.torque.skf import LEAST_REPLENISHMENT, NO_LOSS, Lubrication, inlet_factors, mean_diameter
from oilfilm.ehl.units import RPM

SPEED = 6000.0 * RPM
VISCOSITY = 20e-6  # [m^2/s]
SHEAR = 1.0 / (1.0 + 1.84e-9 * (6000.0 * 60.0) ** 1.28 * 20.0**0.64)
SUPPLY = exp(-3e-8 * 20.0 * 6000.0 * (40.0 + 80.0) * sqrt(3.1 / (2.0 * (80.0 - 40.0))))


@pytest.mark.parametrize("diameters", [(0.04, 0.08), (None, None)])
def test_both_factors_by_hand(bearings, diameters):
    """A section of 0.3 balls apart about the pitch, 12 mm and 60 mm, is that of the catalogue, 40 and 80 mm."""
    bearing = replace(bearings.b6208, bore=diameters[0], outside_diameter=diameters[1])
    found = inlet_factors(bearing, SPEED, VISCOSITY, Lubrication.OIL_JET)
    assert found.shear_heating == pytest.approx(SHEAR, rel=1e-9)
    assert found.replenishment == pytest.approx(SUPPLY, rel=1e-9)
    assert found.rolling == pytest.approx(SHEAR * SUPPLY, rel=1e-9)
    assert mean_diameter(bearing) == pytest.approx(0.06)


def test_a_layer_that_is_given_is_not_counted_again(bearings):
    layered = inlet_factors(bearings.b6208, SPEED, VISCOSITY, Lubrication.OIL_JET, layered=True)
    assert layered.replenishment == 1.0
    assert layered.rolling == layered.shear_heating < 1.0
    assert NO_LOSS.rolling == 1.0


@pytest.mark.parametrize("viscosity", [510e-6, 0.02])
def test_beyond_the_range_the_factors_stay_at_its_end(bearings, viscosity):
    """Up to 500 mm^2/s inside; beyond it a 6208 has the factors of 500, and a reason that says so."""
    at_end = inlet_factors(bearings.b6208, 0.01 * SPEED, 499.9999999999e-6, Lubrication.GREASE)
    beyond = inlet_factors(bearings.b6208, 0.01 * SPEED, viscosity, Lubrication.GREASE)
    assert at_end.limit == ""
    assert beyond.shear_heating == pytest.approx(at_end.shear_heating, rel=1e-9)
    assert beyond.replenishment == pytest.approx(at_end.replenishment, rel=1e-9)
    assert "500 mm2/s" in beyond.limit


def test_replenishment_ends_where_its_source_does(bearings):
    """phi_rs of grease at 6000 r/min: 0.43 at 100 mm^2/s, 0.12 at 250; a bath has all of its oil."""
    falling, held = (inlet_factors(bearings.b6208, SPEED, nu * 1e-6, Lubrication.GREASE) for nu in (100.0, 250.0))
    assert LEAST_REPLENISHMENT < falling.replenishment < 0.55
    assert "falls as the oil thickens" in falling.limit
    assert held.replenishment == LEAST_REPLENISHMENT
    assert "held" in held.limit
    bath = inlet_factors(bearings.b6208, SPEED, 250e-6, Lubrication.OIL_BATH)
    assert (bath.replenishment, bath.limit) == (1.0, "")

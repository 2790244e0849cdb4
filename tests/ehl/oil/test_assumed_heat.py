"""Heat properties that are assumed: viscosity index after ASTM D2270, oils of the library, laws of their own.

The examples of ASTM D2270: 73.30 and 8.86 mm^2/s at 40 and 100 degrees Celsius are of index 92, 22.83 and 5.05 of 156.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from numpy import log

from oilfilm.bearing import load_lubricant
from oilfilm.ehl import DensityLaw, Lubricant, ViscosityLaw
from oilfilm.ehl.oil.assumed_heat import COLD, HOT, WALTHER, BaseOil, heat_of, line_of_index, with_heat
from oilfilm.ehl.oil.free_volume import TaitVolume
from oilfilm.ehl.oil.lubricant import ScaledVolume, pressure_viscosity_scaled

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, temperature=313.15)


@pytest.mark.parametrize(("cold", "hot", "index"), [(73.30, 8.86, 92.43), (22.83, 5.05, 156.37)])
def test_examples_of_the_standard(cold, hot, index):
    """Walther's line through both viscosities has the slope that the index gives."""
    line = log(log(cold + WALTHER) / log(hot + WALTHER)) / log(HOT / COLD)
    for nu, temperature in ((cold, COLD), (hot, HOT)):
        slope = line * (1.0 + WALTHER / nu) * log(nu + WALTHER) / temperature
        assert line_of_index(1e-6 * nu, temperature, index).fall(temperature) == pytest.approx(slope, rel=0.006)


@pytest.mark.parametrize(
    ("name", "base", "index"),
    [
        ("iso vg 32", BaseOil.MINERAL, 79.0),
        ("iso vg 220", BaseOil.MINERAL, 83.0),
        ("arana n100", BaseOil.MINERAL, 33.0),
        ("fva 3", BaseOil.MINERAL, 111.0),
        ("pao 10", BaseOil.POLYALPHAOLEFIN, 144.0),
        ("mil-l-7808", BaseOil.ESTER, 123.0),
    ],
)
def test_oils_of_the_library_lie_in_the_ranges(name, base, index):
    """And fall with temperature as their index says."""
    for celsius in (40.0, 70.0, 100.0):
        oil = load_lubricant(name, celsius + 273.15)
        assumed = heat_of(replace(oil, thermal=None), base)
        for field in ("conductivity", "specific_heat", "viscosity_temperature", "expansion"):
            ratio = getattr(oil.thermal, field) / getattr(assumed, field)
            assert abs(ratio - 1.0) <= getattr(assumed.ranges, field) + 0.01, field
        known = heat_of(
            replace(oil, thermal=None), base, line_of_index(oil.viscosity / oil.density, celsius + 273.15, index)
        )
        assert known.viscosity_temperature == pytest.approx(oil.thermal.viscosity_temperature, rel=0.04)


def test_no_property_is_zero_and_known_ones_stay():
    heat = heat_of(OIL)
    assert min(heat.conductivity, heat.specific_heat, heat.viscosity_temperature, heat.expansion) > 0.0
    known = with_heat(OIL)
    assert known.thermal == heat
    assert with_heat(known) is known
    assert heat_of(replace(OIL, temperature=None)).viscosity_temperature < heat.viscosity_temperature
    thin, thick = (heat_of(replace(OIL, viscosity=v)).viscosity_temperature for v in (1e-3, 5.0))
    assert 0.0 < thin < heat.viscosity_temperature < thick < 0.3


def test_a_law_over_temperature_keeps_its_own_fall():
    tait = TaitVolume(
        bulk_modulus=1.0e9,
        bulk_modulus_derivative=10.545,
        reference_temperature=298.0,
        bulk_modulus_temperature=6.09e-3,
        expansion=7.734e-4,
    )
    law = ScaledVolume(factor=12.898, limit=0.26844, exponent=5.0348)
    oil = Lubricant(
        viscosity=0.01,
        pressure_viscosity=pressure_viscosity_scaled(tait, law, 313.15),
        temperature=313.15,
        viscosity_law=ViscosityLaw.SCALED,
        density_law=DensityLaw.TAIT,
        tait=tait,
        scaled=law,
    )
    heat = heat_of(oil)
    assert heat.ranges.viscosity_temperature == 0.0
    assert 0.02 < heat.viscosity_temperature < 0.06

"""Heat along a shaft and its growth, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import load_bearing, load_material
from oilfilm.bearing.heating.network import Conductance, HeatNetwork, HeatPath
from oilfilm.bearing.heating.paths import HOUSING_DIAMETER, Surroundings
from oilfilm.bearing.shaft.beam import Section
from oilfilm.bearing.shaft.heat import heat_links
from oilfilm.bearing.shaft.system import REFERENCE_TEMPERATURE, ShaftSystem, Support

STEEL = load_material("bearing steel")
COPPER = replace(STEEL, name="copper", thermal_conductivity=380.0, thermal_expansion=17.0e-6)
BEARING = load_bearing("6208")
ENDS = ((0.0, 0.1, 0.04, STEEL), (0.1, 0.3, 0.03, COPPER))


def system(**changes) -> ShaftSystem:
    """A shaft of steel and copper on bearings at 50 and 250 mm."""
    return ShaftSystem(
        sections=tuple(
            Section(start=a, end=b, outside_diameter=d, inside_diameter=0.01, material=m) for a, b, d, m in ENDS
        ),
        supports=tuple(Support(position=x, bearing=BEARING) for x in (0.05, 0.25)),
        loads=(),
        **changes,
    )


class Problem:
    """As much of a bearing's balance of heat as the paths between bearings take."""

    bearing = BEARING
    around = Surroundings(ambient=293.15, shaft_material=STEEL, housing_material=STEEL)


def resistance(length: float, outside: float, conductivity: float) -> float:
    return length / (conductivity * 0.25 * np.pi * (outside**2 - 0.01**2))


def test_a_rod_between_two_sources_has_the_temperatures_of_the_hand_calculation():
    """Q_1, Q_2 into the ends of a rod g, each to the surroundings by G: T_1 + T_2 = 2 T_a +
    (Q_1 + Q_2)/G and T_1 - T_2 = (Q_1 - Q_2)/(G + 2 g).
    """
    ambient, out, heats = 300.0, 0.8, np.array([12.0, 2.0])
    rod = heat_links(system(), (Problem, Problem))[0].conductance
    paths = [HeatPath(first=n, second="air", conductance=Conductance.exactly(out), description="") for n in "ab"]
    paths.append(HeatPath(first="a", second="b", conductance=rod, description=""))
    found = HeatNetwork(paths=tuple(paths), boundaries={"air": ambient}, nodes=("a", "b")).temperatures(heats)
    assert_allclose(found.sum(), 2.0 * ambient + 14.0 / out, rtol=1e-12)
    assert_allclose(found[0] - found[1], 10.0 / (out + 2.0 * rod.value), rtol=1e-10)


def test_sections_of_the_shaft_conduct_in_series_and_the_housing_has_a_range():
    along, around = heat_links(system(), (Problem, Problem))
    by_hand = resistance(0.05, 0.04, STEEL.thermal_conductivity) + resistance(0.15, 0.03, 380.0)
    assert_allclose(along.conductance.value, 1.0 / by_hand, rtol=1e-12)
    tube = 0.25 * np.pi * (HOUSING_DIAMETER**2 - 1.0) * 0.08**2 * STEEL.thermal_conductivity / 0.2
    assert_allclose(around.conductance.value, tube, rtol=1e-12)
    assert around.conductance.low < tube < around.conductance.high
    assert "estimate" in around.description
    given = heat_links(system(housing_conductance=3.0), (Problem, Problem))[1].conductance
    assert (given.low, given.value, given.high) == (3.0, 3.0, 3.0)


def test_a_shaft_of_one_temperature_grows_by_its_expansion():
    rise = 40.0
    found = system(housing_expansion=12e-6).axial_growth(REFERENCE_TEMPERATURE + rise, REFERENCE_TEMPERATURE + 15.0)
    steel, copper = STEEL.thermal_expansion, 17.0e-6
    shaft = np.array([0.05 * steel, 0.1 * steel + 0.15 * copper]) * rise
    assert_allclose(found, shaft - 12e-6 * 15.0 * np.array([0.05, 0.25]), rtol=1e-12)


@pytest.mark.parametrize("turned", [False, True])
def test_the_growth_between_bearings_is_that_of_a_rod_with_two_ends(turned):
    """T falls from bearing to bearing in proportion to the resistance passed; beyond it stays."""
    hot, cold = np.array([70.0, 30.0])
    steel, copper = resistance(0.05, 0.04, STEEL.thermal_conductivity), resistance(0.15, 0.03, 380.0)
    step = hot - (hot - cold) * steel / (steel + copper)
    between = STEEL.thermal_expansion * 0.05 * 0.5 * (hot + step) + 17e-6 * 0.15 * 0.5 * (step + cold)
    shaft = system()
    rises = np.array([hot, cold])
    if turned:  # the order of the supports in the file does not count
        shaft = replace(shaft, supports=shaft.supports[::-1])
        rises = rises[::-1]
    growth = shaft.axial_growth(REFERENCE_TEMPERATURE + rises, REFERENCE_TEMPERATURE)
    assert_allclose(abs(growth[1] - growth[0]), between, rtol=1e-12)

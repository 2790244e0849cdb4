"""Thermal reduction of films: limits of the law, its tangents, ranges, and films solved with heat that it was not
fitted to.
"""

from __future__ import annotations

from dataclasses import astuple, replace
from math import hypot

import numpy as np
import pytest

from oilfilm import load_lubricant
from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.closed_form.film import film_reduction_gupta, thermal_loading
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.closed_form.thermal_reduction import NO_HEAT, ThermalReduction, inlet_groups, table, thermal_reductions
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.multigrid.supply.oil_supply import pressure_moment
from oilfilm.ehl.oil.lubricant import HeatRanges, ThermalProperties, heat_properties
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.rolling_moment import rolling_moment, scaled_as_solved

OIL = Lubricant(
    viscosity=0.02,
    pressure_viscosity=18e-9,
    temperature=323.15,
    thermal=ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.037, expansion=7e-4),
)
STEEL = SolidThermal(conductivity=21.0, density=7850.0, specific_heat=470.0)
CONTACT = ContactConditions(
    load=300.0, radius_x=4e-3, radius_y=0.12, reduced_modulus=2.27e11, lubricant=OIL, entrainment_speed=12.0
)
FILM = 0.55e-6  # central, isothermal [m]


def groups(film=FILM, **changes):
    contact = replace(CONTACT, **changes)
    hertz = hertz_contact(contact.load, contact.radius_x, contact.radius_y, contact.reduced_modulus)
    return inlet_groups(contact, film, hertz.semi_axis_x, (STEEL.effusivity, STEEL.effusivity))


def reduction(known=None, **changes):
    """Films grow with speed to the power 0.67, as those of formulas do."""
    film = FILM * (changes.get("entrainment_speed", 12.0) / 12.0) ** 0.67
    return thermal_reductions(groups(film, **changes)[None], [known or HeatRanges()])[0]


def test_a_slow_film_keeps_its_thickness_and_a_fast_one_loses():
    """Below the solved ones the loss goes with the thermal loading."""
    slow, slower = (1.0 - reduction(entrainment_speed=speed).central.value for speed in (2e-3, 1e-3))
    assert slow == pytest.approx(4.0 * slower, rel=1e-3)
    assert slow < 1e-5
    speeds = [reduction(entrainment_speed=speed).central.value for speed in (1.0, 3.0, 10.0, 30.0)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] < 0.6


def test_the_minimum_film_of_a_heavy_contact_loses_less():
    heat = reduction()
    assert heat.central.value < heat.minimum.value < 1.0
    assert heat.central.inside and heat.minimum.inside


def test_beyond_the_solved_ones_the_law_stays_and_says_so():
    near, far = reduction(entrainment_speed=25.0), reduction(entrainment_speed=120.0)
    assert near.central.inside and not far.central.inside
    for one in (*near, *far):
        assert 0.0 <= one.low < one.value < one.high <= 1.0
    assert far.central.relative_error > 3.0 * near.central.relative_error
    isoviscous = reduction(lubricant=replace(OIL, viscosity_law=ViscosityLaw.ISOVISCOUS))
    assert np.isfinite(isoviscous.central.value) and not isoviscous.central.inside


def test_cold_oil_loses_more_of_its_film_than_warm_oil():
    """Beyond the largest L_T the losses go on as those of contacts with thinner oil do, within SKF's phi_ish and what
    Murch and Wilson's formula leaves, 3.94/(3.94 + L_T^0.62), 0.16 at L_T 150.
    """
    thick = 1.14 / 2.0  # of the film over ln L_T
    central, moments = [], []
    for loading in (5.0, 11.0, 11.6, 25.0, 150.0):
        x = np.log([loading, loading, 0.057, 250.0 * (11.0 / loading) ** 0.64, 0.022, 39.0, 0.43])
        x[1] = np.log(9.0) + 2.0 * thick * np.log(loading / 11.0)
        heat = thermal_reductions(x[None], [HeatRanges()])[0]
        central.append(heat.central)
        moments.append(heat.moment)
    values = [one.value for one in central]
    assert values == sorted(values, reverse=True)
    assert values[1] / values[2] == pytest.approx((11.6 / 11.0) ** 0.45, rel=0.05)  # no step
    assert [one.inside for one in central] == [True, True, False, False, False]
    assert central[-1].value < 0.16 < central[-1].high + 0.05
    assert 0.2 < moments[-1].value < moments[1].value
    assert moments[-1].low < 0.4


def test_ranges_of_the_oil_are_its_tangents():
    """Each property moved by a percent."""
    fields = ("conductivity", "specific_heat", "viscosity_temperature", "expansion")
    changes = {}
    for field in fields:
        ends = []
        for factor in (0.99, 1.01):
            moved = replace(OIL.thermal, **{field: factor * getattr(OIL.thermal, field)})
            ends.append(reduction(lubricant=replace(OIL, thermal=moved)))
        changes[field] = [0.5 * abs(a.value - b.value) for a, b in zip(*ends, strict=True)]
        only = reduction(known=HeatRanges(**{field: 0.01}))
        assert [one.oil for one in only] == pytest.approx(changes[field], rel=1e-3)
    together = reduction(known=HeatRanges(**dict.fromkeys(fields, 0.01)))
    for film in range(2):
        assert together[film].oil == pytest.approx(hypot(*(changes[field][film] for field in fields)), rel=1e-3)
    assert not any(astuple(OIL.thermal.ranges)) and reduction().central.oil == 0.0


def test_many_contacts_at_once_are_each_alone():
    some = np.array([groups(), groups(load=3.0), groups(entrainment_speed=2.0)])
    together = thermal_reductions(some, [HeatRanges()] * 3)
    alone = [thermal_reductions(one[None], [HeatRanges()])[0] for one in some]
    for a, b in zip(together, alone, strict=True):
        assert a.central == pytest.approx(b.central, rel=1e-12)
    assert table() is table()


def test_a_layer_takes_the_heat_with_the_moment():
    whole = ThermalReduction(0.7, 0.02, 0.01)
    assert whole.at(1.0) is whole
    assert whole.at(0.0)[:3] == (1.0, 0.0, 0.0)
    assert whole.at(0.5).value == pytest.approx(0.7**0.5)
    assert whole.at(0.5).law == pytest.approx(0.02 * 0.5 / 0.7**0.5)
    assert NO_HEAT.at(0.3) == NO_HEAT


def test_films_solved_with_heat_are_met():
    """Of a contact that the law was not fitted to; Gupta's formula takes more."""
    options = SolverOptions(points=257)
    cold = solve_contact(CONTACT, options)
    hot = solve_generalized(CONTACT, Rheology(), solids=(STEEL, STEEL), options=options).contact
    assert cold.converged and hot.converged
    by_law = thermal_reductions(groups(cold.film_central)[None], [HeatRanges()])[0]
    for name, one in zip(("film_central", "film_minimum"), by_law[:2], strict=True):
        solved, isothermal = (getattr(film, f"{name}_dimensionless").finest for film in (hot, cold))
        assert one.value == pytest.approx(solved / isothermal, rel=0.025)
    lever = rolling_moment(cold).value - pressure_moment(cold, scaled_as_solved(cold))[1] * (
        cold.hertz_pressure * cold.semi_axis_x**3
    )
    assert by_law.moment.value == pytest.approx(rolling_moment(hot).value / lever, rel=0.02)
    hertz = hertz_contact(CONTACT.load, CONTACT.radius_x, CONTACT.radius_y, CONTACT.reduced_modulus)
    pressure = hertz.pressure / CONTACT.reduced_modulus
    assert film_reduction_gupta(pressure, thermal_loading(CONTACT), 0.0) < by_law.central.low


def test_the_inlet_conducts_as_oil_under_its_pressure_does():
    """At 1/alpha a mineral oil conducts 9 % more (Larsson and Andersson, 2000): it loses less film."""
    oil = load_lubricant("iso vg 22", 341.0)
    still = replace(oil, thermal=replace(oil.thermal, under_pressure=None))
    loads, constant = groups(lubricant=oil), groups(lubricant=still)
    more = np.log(heat_properties(1.0 / oil.pressure_viscosity, oil, 341.0)[0] / oil.thermal.conductivity)
    assert 0.06 < more < 0.14
    np.testing.assert_allclose(loads - constant, more * np.array([-1.0, -1.0, 0.5, 0.0, 0.0, 0.0, 0.0]), atol=1e-12)
    assert reduction(lubricant=oil).central.value > reduction(lubricant=still).central.value

"""What heat leaves of films: limits of the formula, and films solved with heat that it was not fitted to."""

from __future__ import annotations

from dataclasses import replace

import pytest

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import ThermalReduction, film_reduction_gupta, heat_loss, inlet_heat, thermal_loading
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.lubricant import ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.heat import SolidThermal

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


def hertz(contact):
    return hertz_contact(contact.load, contact.radius_x, contact.radius_y, contact.reduced_modulus).pressure


def share(**changes):
    contact = replace(CONTACT, **changes)
    return inlet_heat(contact, hertz(contact))


def test_a_slow_film_keeps_its_thickness_and_a_fast_one_loses():
    assert share(entrainment_speed=1e-3).value > 0.9999
    speeds = [share(entrainment_speed=speed).value for speed in (1.0, 3.0, 10.0, 30.0)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] < 0.6


def test_the_range_holds_the_value_and_widens_beyond_what_was_solved():
    near, far = share(), share(entrainment_speed=60.0)
    for one in (near, far):
        assert 0.0 <= one.low < one.value < one.high < 1.0
    assert near.uncertainty == pytest.approx(0.2 * (1.0 - near.value), rel=0.01)
    assert far.high - far.value == pytest.approx(0.4 * (1.0 - far.value), rel=0.01)


def test_an_oil_without_heat_properties_is_a_mineral_oil_with_a_wider_range():
    known, assumed = share(), share(lubricant=replace(OIL, thermal=None))
    assert assumed.assumed and not known.assumed
    assert assumed.value == pytest.approx(known.value, abs=0.04)
    assert assumed.uncertainty > 1.5 * known.uncertainty


def test_a_light_contact_may_lose_all_or_nothing():
    """Its load lies far ahead of it, where the solver heats nothing: the range goes from one end to the other."""
    light = share(load=0.3)
    assert light.value > 0.95
    assert light.low < 1.0 - heat_loss(thermal_loading(CONTACT), hertz(replace(CONTACT, load=0.3)) / 2.27e11)


def test_a_layer_takes_the_heat_with_the_moment():
    whole = ThermalReduction(0.7, 0.6, 0.8)
    assert whole.at(1.0) is whole
    assert whole.at(0.0)[:3] == (1.0, 1.0, 1.0)
    assert whole.at(0.5).value == pytest.approx(0.7**0.5)


def test_a_film_solved_with_heat_lies_in_the_range():
    """Of a contact that the formula was not fitted to; Gupta's formula takes more."""
    options = SolverOptions(points=129)
    cold = solve_contact(CONTACT, options)
    hot = solve_generalized(CONTACT, Rheology(), solids=(STEEL, STEEL), options=options).contact
    assert cold.converged and hot.converged
    solved = hot.film_central_dimensionless.finest / cold.film_central_dimensionless.finest
    left = share()
    assert left.low < solved < left.high
    assert film_reduction_gupta(hertz(CONTACT) / 2.27e11, thermal_loading(CONTACT), 0.0) < left.low

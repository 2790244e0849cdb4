"""Starved films in a steady state, oil in the cavity, asperities, and the heat balance."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import erfc, exp, pi

import numpy as np
import pytest

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.films.asperities import Asperities, asperity_share
from oilfilm.bearing.films.operating_film import (
    OilAtInlets,
    film_heats,
    least_lambda,
    mean_fraction,
    of_driven_balls,
    supplied_films,
)
from oilfilm.bearing.films.unsolved_films import formula_values
from oilfilm.bearing.heating.limits import HIGHEST_TEMPERATURE
from oilfilm.bearing.supply.inlet_oil import PrescribedInlet, Supply, cavity_volume, oil_fraction
from oilfilm.bearing.supply.supply import compression, shares_behind
from oilfilm.bearing.supply.track import Track
from oilfilm.ehl import Lubricant, ViscosityLaw
from oilfilm.ehl.closed_form.starvation import starvation_exponent, starvation_factors, starved_film_factor
from oilfilm.ehl.conditions import moes_groups

from ...reference.heat_balance import Cooling, heat_balance
from ...reference.track import steady_share

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
ML_MIN = 1e-6 / 60.0  # [m^3/s]


def law_of(exponent):
    return dict.fromkeys(("film_fraction", "passing"), partial(starved_film_factor, exponent=exponent))


def test_starved_film():
    """Little oil: the film is the layer; much oil: flooded; r = 1: 2^(-1/g), g 3 for a circle, 15 for wide ellipses."""
    assert starvation_exponent(1.0) == pytest.approx(3.0)
    assert starvation_exponent(10.0) == pytest.approx(15.0)
    assert 3.0 < starvation_exponent(3.0) < 15.0
    assert starved_film_factor(0.01, 3.0) == pytest.approx(0.01, rel=1e-5)
    assert starved_film_factor(1e9, 3.0) == starved_film_factor(1e6, 15.0) == 1.0
    assert starved_film_factor(2.0, 3.0) == pytest.approx(2.0 / 9.0 ** (1 / 3), rel=1e-14)
    assert starved_film_factor(1.0, 3.0) == pytest.approx(2.0 ** (-1 / 3))
    assert starved_film_factor(1.0, 15.0) == pytest.approx(2.0 ** (-1 / 15))


@pytest.mark.parametrize("exponent", [3.0, 5.0, 15.0])
@pytest.mark.parametrize("loss", [0.0, 0.05, 1.0])
def test_steady_film_is_where_many_balls_lead(exponent, loss):
    """Ball after ball the layer loses what is pressed out and gains what is added: the fixed point is the one found."""
    for added in (0.003, 0.05, 0.4, 3.0):
        layer = 5.0
        for _ in range(20000):
            layer = (1.0 - loss) * starved_film_factor(layer, exponent) + added
        found = steady_share(Track(**law_of(exponent), loss=loss), added)
        assert found == pytest.approx(starved_film_factor(layer, exponent), rel=1e-6)


@pytest.mark.parametrize("exponent", [3.0, 5.0, 15.0])
def test_steady_film_at_the_ends(exponent):
    track = Track(**law_of(exponent))
    assert steady_share(track, 0.0) == 0.0
    assert steady_share(track, 1e9) == 1.0
    few, many = steady_share(track, 1e-6), steady_share(track, 2e-6)
    assert many / few == pytest.approx(2.0 ** (1.0 / (exponent + 1.0)), rel=1e-2)  # r^(g + 1)/g = added


def starved_films(contacts, supply, balls, roughness=(0.0, 0.0)):
    """Films of formulas at a supply."""
    rough = Asperities(inner_roughness=roughness[0], outer_roughness=roughness[1], boundary=0.12)
    oil = OilAtInlets(oil=supply, balls=balls)
    return supplied_films(contacts, [None] * len(contacts), oil, rough)


def test_films_of_a_bearing_over_the_supply(bearings):
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=5000 * bearings.rpm, force=(0.0, 900.0, 0.0)))
    contacts = contact_conditions(state, OIL)
    supply = Supply(flow=0.2 * ML_MIN, track_share=0.5, groove_width=0.01, residence_time=60.0)
    films = [starved_films(contacts, replace(supply, flow=f * ML_MIN), 9) for f in (0.2, 1.0, 5.0, 1e7)]
    lubricated = [c.conditions is not None for c in contacts]
    assert [film is not None for film in films[0]] == lubricated
    shares = np.array([[film.supply.central for film in row if film is not None] for row in films])
    assert np.all(np.diff(shares, axis=0) > 0.0)
    assert shares[-1] == pytest.approx(1.0)
    alone = [c for c in contacts if c.conditions is None]
    left, _ = shares_behind(alone, [1e-6] * len(alone), np.full((len(alone), 1), 1e-7))
    assert len(alone) == lubricated.count(False) and np.all(left == 1.0)
    assert 1.0 < compression(1e9, OIL) < 0.6 / 1.7 + 1.0


@pytest.fixture(scope="module")
def radial(bearings):
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=5000 * bearings.rpm, force=(0.0, 900.0, 0.0)))
    return state, contact_conditions(state, OIL)


def test_a_layer_at_the_inlets_starves_every_contact_by_its_own_film(radial):
    """The law of starvation at each contact's r; a thin layer is the film, compressed, whatever the flooded one was."""
    _, contacts = radial
    films = starved_films(contacts, PrescribedInlet(layer=0.3e-6), 9, (0.2e-6, 0.1e-6))
    thin = starved_films(contacts, PrescribedInlet(layer=1e-9), 9)
    lubricated = [i for i, c in enumerate(contacts) if c.conditions is not None]
    assert [film is not None for film in films] == [i in lubricated for i in range(len(contacts))]
    assert len({round(films[i].supply.central, 6) for i in lubricated}) > 1
    for i in lubricated:
        own = contacts[i].conditions
        hertz = contacts[i].hertz
        flooded = formula_values(own, (hertz.semi_axis_y, hertz.semi_axis_x)).central
        packed = compression(hertz.pressure, OIL)
        shares = starvation_factors(*moes_groups(own), own.radius_x / own.radius_y, 0.3e-6 / (packed * flooded))
        assert films[i].supply.central == pytest.approx(shares.central.value, rel=1e-3)
        assert films[i].supply.rolling_moment == pytest.approx(shares.rolling_moment.value, abs=2e-3)
        heat = film_heats([contacts[i]], [films[i]])[0].central.value
        assert heat < 1.0
        assert films[i].heat.central.value == pytest.approx(heat ** films[i].supply.rolling_moment, rel=1e-12)
        assert films[i].central.value == pytest.approx(films[i].gap_fraction * flooded, rel=1e-12)
        assert films[i].gap_fraction == pytest.approx(films[i].heat.central.value * films[i].supply.central, rel=1e-12)
        assert films[i].minimum.value <= films[i].central.value
        rough = 0.2e-6 if contacts[i].race.value == "inner" else 0.1e-6
        assert films[i].lambda_ratio == pytest.approx(films[i].minimum.value / rough, rel=1e-12)
        assert thin[i].central.value == pytest.approx(1e-9 / packed, rel=0.02)
        assert thin[i].lambda_ratio == np.inf


def test_ample_oil_leaves_the_flooded_films_to_the_last_digit(radial):
    state, contacts = radial
    films = [film for film in starved_films(contacts, PrescribedInlet(layer=1e-3), 9) if film is not None]
    assert all(
        film.supply.central == 1.0 and film.central.value == film.heat.central.value * film.flooded_central
        for film in films
    )
    scarce = starved_films(contacts, PrescribedInlet(layer=0.2e-6), 9, (0.2e-6, 0.2e-6))
    driven = of_driven_balls(state, contacts, scarce)
    loaded = int((state.inner_load > 0.0).sum())
    assert len(driven) == 2 * loaded < len([film for film in scarce if film is not None])
    assert 0.0 < mean_fraction(driven) < 1.0
    assert least_lambda(driven) == min(film.lambda_ratio for film in driven)
    assert (mean_fraction([]), least_lambda([])) == (1.0, np.inf)


def test_an_oil_without_pressure_viscosity_has_no_formula(radial):
    contacts = contact_conditions(radial[0], replace(OIL, viscosity_law=ViscosityLaw.ISOVISCOUS))
    assert set(starved_films(contacts, PrescribedInlet(layer=1e-6), 9)) == {None}


@pytest.mark.parametrize("layer", [-1e-9, np.nan, np.inf])
def test_a_layer_is_a_length(layer):
    with pytest.raises(ValueError, match="layer"):
        PrescribedInlet(layer=layer)


def test_cavity_and_oil_in_it(bearings):
    """Without balls a plain ring; a fraction never beyond 1."""
    bearing = replace(bearings.b6208, width=0.018)
    ring = 0.25 * pi * (0.068**2 - 0.052**2) * 0.018
    assert 0.6 * ring < cavity_volume(bearing) < ring
    supply = Supply(flow=1e-8, track_share=0.5, groove_width=0.01, residence_time=60.0)
    assert oil_fraction(supply, 2e-5) == pytest.approx(0.03)
    assert oil_fraction(replace(supply, flow=1.0), 2e-5) == 1.0
    with pytest.raises(ValueError, match="width"):
        cavity_volume(bearings.b6208)
    with pytest.raises(ValueError, match="track_share"):
        Supply(flow=1e-8, track_share=0.0, groove_width=0.01, residence_time=1.0)


def test_asperities():
    assert asperity_share(0.0) == 1.0
    assert asperity_share(1.0) == pytest.approx(erfc(1.0))
    assert asperity_share(5.0) < 1e-11


def test_heat_balance_of_a_law_with_a_closed_form():
    """M = m (2 - T/T_0) against h (T - T_0) alone: T - T_0 = m w/(h + m w/T_0)."""
    m, w, h, t_0 = 0.2, 500.0, 2.0, 300.0
    found = heat_balance(lambda t: m * (2.0 - t / t_0), w, Cooling(conductance=h, ambient=t_0))
    assert found.converged
    assert found.temperature - t_0 == pytest.approx(m * w / (h + m * w / t_0), abs=1e-3)
    assert found.power == pytest.approx(h * (found.temperature - t_0), rel=1e-4)


@pytest.mark.parametrize("speed", [500.0, -500.0])
def test_heat_balance_with_warm_oil_by_hand(speed):
    """50 W, 1 W/K to 300 K and 1.5 W/K of oil supplied at 320 K: (50 + 300 + 480)/2.5 = 332 K, either way round."""
    cooling = Cooling(conductance=1.0, ambient=300.0, oil_flow=1.5, oil_supply=320.0)
    assert heat_balance(lambda t: 0.1, speed, cooling).temperature == pytest.approx(332.0, abs=1e-3)
    assert cooling.frictionless_temperature == pytest.approx(312.0, rel=1e-12)


def test_oil_cools_and_a_hot_bearing_is_told():
    def torque(temperature):
        return 0.1 * exp(-0.02 * (temperature - 300.0))

    dry = heat_balance(torque, 500.0, Cooling(conductance=1.0, ambient=300.0))
    wet = heat_balance(torque, 500.0, Cooling(conductance=1.0, ambient=300.0, oil_flow=1.0, oil_supply=300.0))
    assert wet.converged
    assert 300.0 < wet.temperature < dry.temperature
    assert wet.torque > dry.torque  # colder oil is thicker
    burning = heat_balance(lambda t: 10.0, 500.0, Cooling(conductance=1.0, ambient=300.0))
    assert not burning.converged
    assert burning.temperature == HIGHEST_TEMPERATURE
    assert burning.residual == pytest.approx(1.0 - (HIGHEST_TEMPERATURE - 300.0) / 5000.0)  # of 5000 W
    with pytest.raises(ValueError, match="conductance and oil_flow"):
        Cooling(conductance=0.0, ambient=300.0)

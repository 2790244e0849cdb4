"""Conductance of a rolling contact through its film: the limits, and a film that varies along rolling."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from scipy.linalg import expm

from oilfilm.ehl.solid.film_conductance import BETA, marched_conductance, marched_flux, moving_speed, spot_conductance
from oilfilm.ehl.solid.heat import SolidThermal

from ...reference.ehl.even_film import bare_conductance, exchanged_heat, film_conductance
from ...reference.ehl.marched import marched_flux_twin

STEEL = SolidThermal(conductivity=21.0, density=7850.0, specific_heat=460.0)
NITRIDE = SolidThermal(conductivity=29.0, density=3250.0, specific_heat=700.0)
AXES = (0.13e-3, 1.2e-3)  # along rolling, across
PAIR = (NITRIDE, STEEL)
E12 = STEEL.effusivity * NITRIDE.effusivity / (STEEL.effusivity + NITRIDE.effusivity)


def test_beta_function():
    assert pytest.approx(1.74804, abs=1e-5) == BETA


@pytest.mark.parametrize("speed", [1.0, 10.0, 60.0])
def test_without_a_film_the_half_spaces_limit(speed):
    """2 e12 sqrt(2 b u/pi) a B(1/2, 5/4), the share of bodies at rest included."""
    along, across = AXES
    u = moving_speed(speed, AXES, *PAIR)
    limit = 2.0 * E12 * sqrt(2.0 * along * u / pi) * across * 1.748038
    assert film_conductance(speed, AXES, 1e13, *PAIR) == pytest.approx(limit, rel=1e-5)
    assert bare_conductance(u, AXES, *PAIR) == pytest.approx(limit, rel=1e-6)


@pytest.mark.parametrize("speed", [0.0, 1.0, 60.0])
def test_a_film_that_hardly_conducts_limits(speed):
    """pi a b H, whatever moves."""
    h = 1e-2
    assert film_conductance(speed, AXES, h, *PAIR) == pytest.approx(pi * AXES[0] * AXES[1] * h, rel=1e-4)


def test_at_rest_without_a_film_it_is_a_spot():
    """Circle: 1/(1/(4 k1 a) + 1/(4 k2 a)); an ellipse by K(m), both ways round."""
    circle = spot_conductance(1e-3, 1e-3, *PAIR)
    assert circle == pytest.approx(1.0 / (1.0 / (4.0 * 29.0 * 1e-3) + 1.0 / (4.0 * 21.0 * 1e-3)), rel=1e-12)
    assert spot_conductance(*AXES, *PAIR) == pytest.approx(spot_conductance(*AXES[::-1], *PAIR))
    assert film_conductance(0.0, AXES, 1e13, *PAIR) == pytest.approx(spot_conductance(*AXES, *PAIR), rel=1e-5)


def test_between_the_limits_below_both():
    for h in np.logspace(3, 9, 13):
        g = film_conductance(10.0, AXES, float(h), *PAIR)
        u = moving_speed(10.0, AXES, *PAIR)
        assert 0.0 < g < min(pi * AXES[0] * AXES[1] * h, bare_conductance(u, AXES, *PAIR))


@pytest.mark.parametrize("film", [1e4, 1e6])
def test_exchanged_heat_solves_the_conduction_of_two_bodies(film):
    """Finite volumes in both half-spaces, 40 cells that grow with the depth, integrated exactly."""
    time, cells = 2e-5, 40
    ramp = np.sinh(np.linspace(0.0, 5.0, cells + 1)) / np.sinh(5.0)
    steps = [np.diff(8.0 * sqrt(body.diffusivity * time) * ramp) for body in PAIR]
    halves = [0.5 * step[0] / body.conductivity for step, body in zip(steps, PAIR, strict=True)]
    across = 1.0 / (1.0 / film + sum(halves))
    rates = np.zeros((2 * cells + 1, 2 * cells + 1))  # of both bodies' temperatures and the heat exchanged
    for k, (body, step) in enumerate(zip(PAIR, steps, strict=True)):
        capacity = step * body.density * body.specific_heat
        own = slice(k * cells, (k + 1) * cells)
        inner = body.conductivity / (0.5 * (step[1:] + step[:-1]))
        chain = np.diag(np.append(inner, 0.0) + np.append(0.0, inner)) - np.diag(inner, 1) - np.diag(inner, -1)
        rates[own, own] -= chain / capacity[:, None]
        rates[k * cells, [k * cells, (1 - k) * cells]] += np.array([-1.0, 1.0]) * across / capacity[0]
    rates[-1, [0, cells]] = [across, -across]
    start = np.concatenate([np.ones(cells), np.zeros(cells + 1)])
    heat = (expm(rates * time) @ start)[-1]
    found = exchanged_heat(time, film, NITRIDE.effusivity, STEEL.effusivity)
    assert found == pytest.approx(heat, rel=3e-3)


def test_the_series_meets_the_closed_form():
    h = 1e5
    limit = (1e-2 * E12 / h) ** 2
    below, above = (
        float(exchanged_heat(t, h, NITRIDE.effusivity, STEEL.effusivity)) for t in (0.999 * limit, 1.001 * limit)
    )
    assert above / below == pytest.approx(1.001 / 0.999, rel=1e-5)


def test_a_marched_even_film_is_the_closed_form():
    x, y = np.linspace(-1.2, 1.2, 241) * AXES[0], np.linspace(-1.1, 1.1, 89) * AXES[1]
    inside = (x[:, None] / AXES[0]) ** 2 + (y[None, :] / AXES[1]) ** 2 <= 1.0
    u = moving_speed(10.0, AXES, *PAIR)
    for h in (1e4, 4e5, 1e7):
        marched = marched_conductance(u, x, y, np.where(inside, h, 0.0), *PAIR)
        assert marched == pytest.approx(film_conductance(10.0, AXES, h, *PAIR), rel=0.02)


def test_the_compiled_march_agrees_with_its_twin():
    """Lines of other lengths, a gap in some, rows without film at both ends."""
    rng = np.random.default_rng(20261130)
    film = np.exp(rng.uniform(9.0, 16.0, (40, 70))) * (rng.random((40, 70)) < 0.9)
    film[[0, 1, -1]] = 0.0
    rates = np.exp(rng.uniform(-15.0, -8.0, 70))
    np.testing.assert_allclose(marched_flux(film, rates), marched_flux_twin(film, rates), rtol=1e-12)

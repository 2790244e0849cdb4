"""Layers from ball to ball: closed forms of the recursion, side flow of severe starvation, steady states, mass."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import exp, pi, sin

import numpy as np
import pytest
import scipy

from oilfilm.bearing import Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.supply.supply import barus_integral, side_flow, side_flow_integral
from oilfilm.bearing.supply.track import Track, TrackPasses, added_layer, solved_passes, steady_layer
from oilfilm.ehl import InletLayer, Lubricant, SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.closed_form.starvation import starved_film_factor
from oilfilm.ehl.conditions import MoesConditions

from ...reference.track import after_passes, steady_share

EXPONENTS = (3.0, 5.0, 15.0)


def law(exponent: float):
    """Of film and layer."""
    return dict.fromkeys(("film_fraction", "passing"), partial(starved_film_factor, exponent=exponent))


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_passes_without_supply_follow_the_closed_form(exponent):
    """r_n = (r_0^-g + n)^(-1/g), exact."""
    for start in (0.3, 1.0, 20.0):
        found = after_passes(Track(**law(exponent)), start, 400)
        count = np.arange(1, 401)
        assert found == pytest.approx((start**-exponent + count) ** (-1.0 / exponent), rel=1e-11)


@pytest.mark.parametrize("side", [1e-3, 5e-3, 0.05])
def test_severe_starvation_follows_van_zoelen(side):
    """Where the side flow inside the contact is the larger loss, r_n^-2 = r_0^-2 + n d, exact."""
    found = after_passes(Track(**law(15.0), side_flow=side), 0.3, 1000)
    assert found == pytest.approx((0.3**-2 + side * np.arange(1, 1001)) ** -0.5, rel=1e-11)


@pytest.mark.parametrize("side", [0.0, 1e-9, 5e-3, 0.5])
def test_what_is_lost_is_what_is_not_left(side):
    """By the law, by the side flow, and between."""
    track = Track(**law(15.0), side_flow=side)
    for layer in (0.01, 0.3, 0.9, 1.0, 2.0, 30.0):
        assert layer - track.left(layer) == pytest.approx(track.lost(layer), rel=1e-6, abs=1e-15)
        by_side = min(layer, 1.0) - (min(layer, 1.0) ** -2 + side) ** -0.5
        expected = max(layer - starved_film_factor(layer, 15.0), by_side)
        assert track.lost(layer) == pytest.approx(expected, rel=1e-6, abs=1e-15)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_the_larger_of_two_losses_counts_and_never_their_sum(exponent):
    """Early the law, late the side flow; at no pass more is lost than by the larger one."""
    side = 5e-3
    track = Track(**law(exponent), side_flow=side)
    layers = np.concatenate([[2.0], after_passes(track, 2.0, 3000)])
    for before, after in zip(layers[:-1], layers[1:], strict=True):
        by_law, by_side = starved_film_factor(before, exponent), (before**-2 + side) ** -0.5
        assert after == pytest.approx(min(by_law, by_side), rel=1e-12) or before > 1.0
        assert after <= by_law
    late = np.diff(layers[-3:] ** -2.0)
    assert late == pytest.approx(side, rel=1e-6) if exponent > 3.0 else late.min() >= side


def test_ample_oil_floods_whatever_the_side_flow():
    """The side flow of a light contact, d above 1, does not keep it from its flooded film."""
    for side in (0.0, 0.5, 9.0, 1e6):
        track = Track(**law(5.0), side_flow=side)
        assert track.left(1e4) == starved_film_factor(1e4, 5.0)
        assert steady_share(track, 1e9) == 1.0
        layers = np.geomspace(1e-6, 1e3, 400)
        left = np.array([track.left(layer) for layer in layers])
        assert np.all(np.diff(left) > -1e-15)
        assert np.all(left <= layers)


@pytest.mark.parametrize("loss", [0.0, 0.05, 1.0])
@pytest.mark.parametrize("side", [0.0, 0.005, 0.1])
def test_steady_layer_balances_what_is_added_and_lost(loss, side):
    """In the steady state a pass loses exactly what the supply adds, over twelve decades of it."""
    track = Track(**law(8.0), side_flow=side, loss=loss)
    for added in np.geomspace(1e-9, 1e3, 25):
        layer = steady_layer(track, added)
        kept = (1.0 - loss) * track.left(layer)
        assert layer - kept == pytest.approx(added, rel=1e-9 * max(1.0, layer / added))
        assert steady_share(track, added) == pytest.approx(track.film_fraction(layer), rel=1e-12)
    shares = [steady_share(track, added) for added in np.geomspace(1e-9, 1e3, 25)]
    assert np.all(np.diff(shares) >= 0.0)


def test_many_passes_lead_to_the_steady_layer():
    track = Track(**law(8.0), side_flow=0.01, loss=0.02)
    for start in (0.0, 5.0):
        layers = after_passes(track, start, 5000, added=0.01)
        assert layers[-1] == pytest.approx(track.left(steady_layer(track, 0.01)), rel=1e-9)


def test_steady_film_of_severe_starvation():
    """r = (2 D/d)^(1/3): in layers of one surface s = r/2 and per pass, (3 S/F)^(1/3) with S = D/2, F = 6 d/4."""
    side = 0.01
    for added in (1e-9, 1e-8):
        layer = steady_layer(Track(**law(15.0), side_flow=side), added)
        assert layer == pytest.approx((2.0 * added / side) ** (1.0 / 3.0), rel=2e-3)


@pytest.mark.parametrize("number", [2.0, 5.0, 10.0, 20.0, 60.0])
def test_side_flow_integral_of_barus(number):
    """Against adaptive quadrature, and the closed form within the errors it is known with."""
    oil = Lubricant(viscosity=0.03, pressure_viscosity=20e-9, viscosity_law=ViscosityLaw.BARUS)
    exact = 2.0 * scipy.integrate.quad(lambda t: exp(-number * sin(t)), 0.0, 0.5 * pi, epsabs=1e-13)[0]
    assert side_flow_integral(number / 20e-9, oil) == pytest.approx(exact, rel=1e-3)
    error = {2.0: 0.17, 5.0: 0.08, 10.0: 0.022, 20.0: 0.01, 60.0: 0.01}[number]
    assert barus_integral(number) == pytest.approx(exact, rel=error)


def test_side_flow_integral_without_pressure_viscosity():
    oil = Lubricant(viscosity=0.03, pressure_viscosity=0.0, viscosity_law=ViscosityLaw.ISOVISCOUS)
    assert side_flow_integral(1e9, oil) == pytest.approx(pi, rel=1e-3)


def test_side_flow_of_a_bearing(bearings):
    """p_h a I/(6 eta b^2 u) of every contact that entrains oil, and none elsewhere."""
    oil = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9)
    state = solve_quasistatic(bearings.b6208, Operation(inner_speed=5000 * bearings.rpm, force=(0.0, 3000.0, 0.0)))
    contacts = contact_conditions(state, oil)
    for contact in contacts:
        if contact.conditions is None:
            assert side_flow(contact) == 0.0
            continue
        hertz = contact.hertz
        of_track = 6.0 * 0.0261 * hertz.semi_axis_y**2 * contact.conditions.entrainment_speed
        expected = hertz.pressure * hertz.semi_axis_x * side_flow_integral(hertz.pressure, oil) / of_track
        assert side_flow(contact) == pytest.approx(expected, rel=1e-12)
        # 1 um of film on this track is thinned by less than a hundredth in one pass
        assert hertz.pressure < 1e9 or 1e-12 * side_flow(contact) < 0.02


def test_added_layer_conserves_the_flow():
    """What is laid between two balls, times the area of track that passes a second, is the flow."""
    layer = added_layer(1e-8, 2e-3, 7.5, 9)
    assert layer * 2e-3 * 7.5 * 9 == pytest.approx(1e-8, rel=1e-12)


@pytest.mark.parametrize(("key", "value"), [("side_flow", -1.0), ("side_flow", np.inf), ("loss", 1.5)])
def test_what_a_track_is(key, value):
    with pytest.raises(ValueError, match=key):
        Track(**law(3.0), **{key: value})


def test_solved_passes_hand_their_layer_on():
    """Each pass is solved behind the layer that the last one left: no oil is made or lost, ridges pile up beside the
    track, and the film falls as the passes of Damiens' law, faster by up to a quarter."""
    oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    contact = MoesConditions(
        load_parameter=20.0, lubricant_parameter=10.0, lubricant=oil, inlet_layer=InletLayer(thickness=(0.3,))
    )
    passes = solved_passes(contact, SolverOptions(points=65), TrackPasses(number=4), solve_contact)
    assert len(passes) == 4
    assert all(one.solution.converged for one in passes)
    for before, after in pairwise(passes):
        assert after.inlet == pytest.approx(before.outlet, rel=1e-12)
        assert before.remaining == pytest.approx(1.0, abs=1e-3)
    middle = passes[-1].outlet.size // 2
    assert passes[-1].outlet.max() > 3.0 * passes[-1].outlet[middle]
    films = [one.film_fraction for one in passes]
    assert all(b < a for a, b in pairwise(films))
    chain = after_passes(Track(**law(3.0)), passes[0].ratio, 4)
    assert films == pytest.approx(chain.tolist(), rel=0.25)
    track = TrackPasses(number=2, loss=0.5, added=0.01)
    halved = solved_passes(contact, SolverOptions(points=65), track, solve_contact, passes[0].solution)
    assert halved[1].inlet == pytest.approx(0.5 * halved[0].outlet + 0.01, rel=1e-12)
    with pytest.raises(ValueError, match="inlet_layer"):
        solved_passes(replace(contact, inlet_layer=None), SolverOptions(points=65), track, solve_contact)

"""Balances over the speed and over time, on friction whose answers are known in closed form."""

from __future__ import annotations

from dataclasses import replace
from math import e, exp

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from oilfilm.bearing import BallKinematics, Operation, QuasistaticModel, load_lubricant, load_material
from oilfilm.bearing.heating.friction_heat import heat_of_torque
from oilfilm.bearing.heating.heat_state import SelfHeatingProblem, heat_state
from oilfilm.bearing.heating.network import NODES, Conductance
from oilfilm.bearing.heating.over_speed import SpeedLimit, at_speed, balances_over_speed
from oilfilm.bearing.heating.over_time import Slopes, heat_capacities, stability, warm_up
from oilfilm.bearing.heating.self_heating import solve_self_heating

STEEL = load_material("bearing steel")
MODEL = QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF)
AMBIENT = 298.15
SPEED = 500.0
HEAT = 3.0  # of cold friction at that speed [W]


@pytest.fixture(scope="module")
def bearing(bearings):
    parts = {f"{part}_material": STEEL for part in ("ball", "inner_ring", "outer_ring")}
    return replace(bearings.b6208, **parts, width=0.018)


@pytest.fixture
def problem(bearing):
    """Friction of HEAT at SPEED, in proportion to the speed and to exp(rise (T - T_a)); contacts conduct 0.4 W/K."""
    from oilfilm.bearing.heating.paths import Surroundings

    around = Surroundings(
        ambient=AMBIENT,
        conductance=0.5,
        oil_supply=AMBIENT,
        cavity=Conductance.exactly(50.0),
        shaft_material=STEEL,
        housing_material=STEEL,
    )

    def make(rise, **changes):
        def friction(solution, contacts, lubricant):
            torque = HEAT / SPEED * exp(rise * (solution.operation.temperature - AMBIENT))
            conductance = np.full((3, 9, 2), 0.4)
            return heat_of_torque({"rolling": torque}, solution, conductance)

        study = SelfHeatingProblem(
            bearing=bearing,
            operation=Operation(inner_speed=SPEED, force=(0.0, 1000.0, 0.0), temperature=AMBIENT),
            model=MODEL,
            oil=lambda temperature: load_lubricant("iso vg 32", 313.15),
            friction=friction,
            around=around,
            reference=None,
        )
        return replace(study, **changes)

    return make


def cold(problem):
    return heat_state(problem, problem.fixed_paths(), AMBIENT, problem.bearing.diametral_clearance)


def resistance(problem):
    """Of the films' rise over the heat of friction [K/W]: the network is linear."""
    state = cold(problem)
    return (state.resulting_temperature - AMBIENT) / state.friction.power


@pytest.mark.parametrize("rise", [0.02, 0.035])
def test_the_branch_turns_where_the_closed_form_does(problem, rise):
    """theta = R Q n exp(k theta): the fastest balance is at theta = 1/k, n = 1/(R Q k e), and its margin is zero."""
    study = problem(rise)
    found = balances_over_speed(study, solve_self_heating(study, "made up").state)
    assert found.limited_by is SpeedLimit.RUNAWAY
    top = found.fastest
    # R of that speed: centrifugal force spreads the loads over the halves of the outer ring
    own = (top.state.resulting_temperature - AMBIENT) / top.state.friction.power
    assert found.limit == pytest.approx(SPEED / (own * HEAT * rise * e), rel=1e-3)
    assert top.state.film_temperature - AMBIENT == pytest.approx(1.0 / rise, rel=0.03)  # flat there
    at = at_speed(study, top.factor)
    warmer = heat_state(at, at.fixed_paths(), top.state.film_temperature + 0.5, top.state.clearance)
    capacities = heat_capacities(at.bearing, at.around, at.oil(AMBIENT))
    margin = stability(
        Slopes(state=top.state, warmer=warmer, wider=None), at, capacities, top.state.temperatures
    ).margin
    assert margin == pytest.approx(0.0, abs=0.03)


def test_every_balance_is_one(problem):
    """On both sides of the turn, friction heats the films to the temperature that it was computed at."""
    study = problem(0.03)
    found = balances_over_speed(study, solve_self_heating(study, "made up").state)
    temperatures = [balance.state.film_temperature for balance in found.balances]
    assert temperatures == sorted(temperatures)
    for balance in found.balances:
        assert balance.state.resulting_temperature == pytest.approx(balance.state.film_temperature, abs=0.011)
        theta = balance.state.film_temperature - AMBIENT
        speed = SPEED * theta * exp(-0.03 * theta) / (resistance(study) * HEAT)
        assert balance.speed == pytest.approx(speed, rel=2e-3)


def test_a_branch_begins_beside_what_is_a_little_off_balance(problem):
    """As where the films of a run leave a degree: the balance there has another speed."""
    study = problem(0.02)
    balance = solve_self_heating(study, "made up").state
    off = heat_state(study, study.fixed_paths(), balance.film_temperature + 1.0, balance.clearance)
    found, exact = (balances_over_speed(study, start) for start in (off, balance))
    assert found.limit == pytest.approx(exact.limit, rel=2e-3)
    far = heat_state(study, study.fixed_paths(), balance.film_temperature + 40.0, balance.clearance)
    with pytest.raises(ValueError, match="no steady temperature near"):
        balances_over_speed(study, far)


def test_oil_that_thins_has_no_turn(problem):
    """The branch ends at the highest temperature, or where the search does."""
    study = problem(-0.002)
    found = balances_over_speed(study, solve_self_heating(study, "made up").state)
    assert found.limited_by is SpeedLimit.TEMPERATURE
    assert found.limit == found.balances[-1].speed
    thin = problem(-0.05)
    found = balances_over_speed(thin, solve_self_heating(thin, "made up").state)
    assert found.limited_by is SpeedLimit.NOT_REACHED
    assert found.limit is None


def test_a_state_that_cannot_be_is_told(problem):
    """Friction that fails above a temperature ends the branch below it, with its reason."""
    study = problem(0.0)
    inner = study.friction

    def failing(solution, contacts, lubricant):
        if solution.operation.temperature > AMBIENT + 50.0:
            raise ValueError("too warm to compute")
        return inner(solution, contacts, lubricant)

    study = replace(study, friction=failing)
    found = balances_over_speed(study, solve_self_heating(study, "made up").state)
    assert (found.limited_by, found.message, found.limit) == (SpeedLimit.NO_STATE, "too warm to compute", None)
    assert found.balances[-1].state.film_temperature > AMBIENT + 45.0


def test_with_a_floating_clearance_both_agree(problem, bearing):
    """The balances have the clearance of their own temperatures and speed."""
    study = problem(0.01, reference=293.15)
    found = balances_over_speed(study, solve_self_heating(study, "made up").state)
    for balance in found.balances:
        clearance = at_speed(study, balance.factor).clearance(balance.state.temperatures)
        assert balance.state.clearance == pytest.approx(clearance, abs=1.1e-9)
    assert np.ptp([balance.state.clearance for balance in found.balances]) > 1e-6


def reference_course(study, rise, duration):
    """Temperatures by SciPy's Radau at a tight tolerance, of the same network, which is linear."""
    state = cold(study)
    capacities = heat_capacities(study.bearing, study.around, study.oil(AMBIENT))
    leaving, given = state.network.matrix()

    def rates(_, temperatures):
        heat = state.sources * exp(rise * (state.weights @ temperatures - AMBIENT))
        return (heat + given - leaving @ temperatures) / capacities

    options = {"method": "Radau", "rtol": 1e-8, "atol": 1e-6, "dense_output": True}
    return solve_ivp(rates, (0.0, duration), np.full(len(NODES), AMBIENT), **options).sol


def test_the_course_is_that_of_the_equations(problem):
    """Friction that falls with the temperature: within 0.2 K of a tight integration, at the end the steady balance."""
    study = problem(-0.01)
    found = warm_up(study, 20000.0)
    assert found.ended
    exact = reference_course(study, -0.01, 20000.0)
    assert np.abs(found.temperatures - exact(found.time).T).max() < 0.2
    assert len(found.time) < 80
    end = solve_self_heating(study, "made up")
    assert found.film_temperature[-1] == pytest.approx(end.state.film_temperature, abs=0.3)


def test_a_bearing_that_runs_away_ends_its_course(problem):
    """Above the limiting speed there is no balance: the films pass the highest temperature after a while."""
    study = at_speed(problem(0.03), 1.0)
    limit = 1.0 / (resistance(study) * HEAT * 0.03 * e)
    found = warm_up(at_speed(study, 1.2 * limit), 1e6)
    assert not found.ended
    assert 0.0 < found.time[-1] < 1e6
    assert (np.diff(found.film_temperature) > 0.0).all()

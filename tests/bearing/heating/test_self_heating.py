"""A bearing that warms itself, and its torque over the supply."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm.bearing import (
    BallKinematics,
    Operation,
    QuasistaticModel,
    contact_conditions,
    load_lubricant,
    load_material,
    solve_quasistatic,
)
from oilfilm.bearing.films.operating_film import solved_films, with_formulas
from oilfilm.bearing.friction.resistance import contact_rolling_power
from oilfilm.bearing.heating.friction_heat import FrictionHeat, heat_of_torque
from oilfilm.bearing.heating.heat_state import SelfHeatingProblem, film_conductances, formula_conductances
from oilfilm.bearing.heating.network import NODES, node_values
from oilfilm.bearing.heating.paths import Surroundings
from oilfilm.bearing.heating.self_heating import solve_self_heating
from oilfilm.bearing.supply.inlet_oil import PrescribedInlet, Supply
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.starved import starved_torque
from oilfilm.ehl import SolverOptions, ViscosityLaw, solve_contact

pytestmark = pytest.mark.filterwarnings("ignore:lubricant")  # the search goes beyond the data of the oil
STEEL = load_material("bearing steel")
ML_MIN = 1e-6 / 60.0
MODEL = QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF)


@pytest.fixture(scope="module")
def bearing(bearings):
    parts = {f"{part}_material": STEEL for part in ("ball", "inner_ring", "outer_ring")}
    return replace(bearings.b6208, **parts, width=0.018)


def oil(temperature):
    return load_lubricant("iso vg 32", temperature)


def torque(solution, contacts, lubricant):
    """Rolling resistance of flooded films alone [N m]."""
    return sum(map(contact_rolling_power, contacts)) / solution.operation.shaft_speed


def friction(solution, contacts, lubricant):
    parts = {"rolling": torque(solution, contacts, lubricant)}
    return heat_of_torque(parts, solution, formula_conductances(solution, contacts))


AROUND = Surroundings(ambient=298.15, conductance=0.5, shaft_material=STEEL, housing_material=STEEL)


def warm(bearing, **changes):
    operation = Operation(inner_speed=500.0, force=(0.0, 1000.0, 0.0))
    study = SelfHeatingProblem(
        bearing=bearing, operation=operation, model=MODEL, oil=oil, friction=friction, around=AROUND
    )
    return replace(study, **changes)


def nodes(inner, others):
    """Temperatures of the nodes, inner ring and shaft above the others."""
    return np.array([inner if name in ("inner_ring", "shaft") else others for name in NODES])


def test_self_heating_balances_friction_and_cooling(bearing):
    """At the film temperature told the friction is what leaves; all energies sum to 1e-9 of it."""
    study = warm(bearing)
    found = solve_self_heating(study, "rolling")
    assert found.converged
    state = found.state
    assert found.balance.temperature > 303.0
    assert state.resulting_temperature == pytest.approx(state.film_temperature, abs=1e-4)
    assert state.clearance == pytest.approx(study.clearance(state.temperatures), abs=1e-10)
    assert state.friction.power == pytest.approx(state.network.removed(state.temperatures), rel=1e-9)
    assert state.sources.sum() == pytest.approx(state.friction.power, rel=1e-12)
    assert found.energy_error < 1e-9
    cooler = solve_self_heating(replace(study, around=replace(AROUND, conductance=2.0)), "rolling")
    assert cooler.balance.temperature < found.balance.temperature
    assert cooler.balance.torque > found.balance.torque


def test_one_node_is_the_limit_of_parts_that_conduct_well(bearing):
    """All inner conductances times 1e6: one temperature, that of the one-node balance."""
    study = warm(bearing, reference=None)
    state = solve_self_heating(study, "rolling").state
    wide = [
        path if path.second == "ambient" else replace(path, conductance=path.conductance.times(1e6))
        for path in state.network.paths
    ]
    even = replace(state.network, paths=tuple(wide)).temperatures(state.sources)
    assert np.ptp(even) < 1e-3
    assert even[0] == pytest.approx(298.15 + state.friction.power / 0.5, abs=1e-3)


def test_the_margin_counts_how_friction_falls(bearing):
    """Oil that thins: above 1; the slowest mode is slower with friction that stays; ends lie about the value."""
    found = solve_self_heating(warm(bearing), "rolling")
    assert found.stability.margin > 1.0
    assert found.stability.rate < found.stability.constant_friction_rate < 0.0
    assert (found.stability.coldest < found.stability.hottest).all()
    assert (found.stability.coldest <= found.state.temperatures).all()
    assert (found.state.temperatures <= found.stability.hottest).all()


def test_friction_that_rises_with_temperature_runs_away(bearing):
    """A torque proportional to T - T_a: the margin is 1 - M' w/h in the limit of one node, below 0 beyond."""

    def rising(slope):
        def heat(solution, contacts, lubricant):
            own = slope * (solution.operation.temperature - 290.0) / 500.0
            return heat_of_torque({"rolling": own}, solution, formula_conductances(solution, contacts))

        return heat

    mild = solve_self_heating(warm(bearing, friction=rising(0.2), reference=None), "rising")
    assert mild.converged
    assert 0.0 < mild.stability.margin < 1.0
    wild = solve_self_heating(warm(bearing, friction=rising(2.0), reference=None), "rising")
    assert not wild.converged or wild.stability.margin < 0.0


def test_a_warm_inner_ring_takes_clearance(bearing):
    """Both rings at one temperature leave the clearance of 13 um but for its own growth; 10 K more inside take some."""
    assert warm(bearing).clearance(nodes(333.15, 333.15)) == pytest.approx(13e-6, rel=2e-3)
    lost = STEEL.thermal_expansion * 10.0 * 0.048
    assert warm(bearing).clearance(nodes(343.15, 333.15)) == pytest.approx(13e-6 - lost, abs=0.2e-6)


def test_starved_torque_at_its_ends(bearing):
    """Much oil: flooded films, the formulas' rolling resistance, no asperities; none: asperities carry all sliding."""
    solution = solve_quasistatic(bearing, Operation(inner_speed=500.0, force=(0.0, 2000.0, 0.0)), MODEL)
    lubricant = oil(313.15)
    contacts = contact_conditions(solution, lubricant)
    friction = FrictionInput(coefficient=0.05, roughness=(0.1e-6, 0.1e-6))
    supply = Supply(flow=1e6 * ML_MIN, track_share=1.0, groove_width=0.01, residence_time=0.0)
    ample = starved_torque(solution, contacts, lubricant, friction, supply)
    assert ample.rolling == pytest.approx(sum(map(contact_rolling_power, contacts)) / 500.0, rel=1e-3)
    assert ample.drag == ample.cage == 0.0
    assert ample.asperity < 1e-3 * ample.film
    dry = starved_torque(solution, contacts, lubricant, friction, replace(supply, flow=0.0))
    assert dry.rolling == dry.film == 0.0
    assert dry.asperity == pytest.approx(0.12 / 0.05 * ample.film, rel=1e-3)
    assert dry.total == dry.asperity
    for ends in (ample, dry):
        assert ends.flooded == pytest.approx(ample.total, rel=1e-3)
    with pytest.raises(ValueError, match="roughness"):
        starved_torque(solution, contacts, lubricant, replace(friction, roughness=None), supply)


def test_torque_at_an_inlet_film(bearing):
    """Ample: the flooded torque to round-off, churning by the oil given; scarce: less rolling, more asperities."""
    solution = solve_quasistatic(bearing, Operation(inner_speed=500.0, force=(0.0, 2000.0, 0.0)), MODEL)
    lubricant = oil(313.15)
    contacts = contact_conditions(solution, lubricant)
    friction = FrictionInput(coefficient=0.05, roughness=(0.2e-6, 0.2e-6), oil_fraction=0.02)
    layers = [
        starved_torque(solution, contacts, lubricant, friction, PrescribedInlet(layer=h)) for h in (1e-3, 0.4e-6, 0.0)
    ]
    ample, scarce, dry = layers
    assert ample.total == pytest.approx(ample.flooded, rel=1e-12)
    assert ample.rolling == pytest.approx(sum(map(contact_rolling_power, contacts)) / 500.0, rel=1e-12)
    assert ample.film_share == 1.0
    assert ample.drag == scarce.drag == dry.drag > 0.0
    assert ample.flooded == scarce.flooded == dry.flooded
    assert ample.rolling > scarce.rolling > dry.rolling == 0.0
    assert ample.asperity < scarce.asperity < dry.asperity
    assert ample.lambda_least > scarce.lambda_least > dry.lambda_least == 0.0
    none = starved_torque(
        solution, contacts, lubricant, replace(friction, oil_fraction=None), PrescribedInlet(layer=1e-3)
    )
    assert none.drag == 0.0
    isoviscous = contact_conditions(solution, replace(lubricant, viscosity_law=ViscosityLaw.ISOVISCOUS))
    with pytest.raises(ValueError, match="no formula"):
        starved_torque(solution, isoviscous, lubricant, friction, PrescribedInlet(layer=1e-6))


# a made-up torque over the temperature of the films [N m]: falls, rises to a bump at 360 K, falls
PLAIN, BUMP, PLACE, WIDTH = 0.02, 0.06, 360.0, 12.0


def bumped(height):
    def heat(solution, contacts, lubricant):
        warmth = (solution.operation.temperature - PLACE) / WIDTH
        parts = {"rolling": PLAIN + height * np.exp(-(warmth**2))}
        return heat_of_torque(parts, solution, formula_conductances(solution, contacts))

    return heat


@pytest.mark.parametrize("ambient", [298.15, 283.15])
def test_all_balances_are_found_and_the_one_of_a_warm_up_is_reported(bearing, ambient):
    """Power P(T) of one node against h (T - T_a): three balances, of which cold ambient reaches the coldest."""
    conductance = 0.45
    around = replace(AROUND, ambient=ambient, oil_supply=ambient, conductance=conductance)
    study = warm(bearing, friction=bumped(BUMP), around=around, reference=None)
    found = solve_self_heating(study, "bump")
    assert found.converged
    kinds = [one.stable for one in found.balances]
    assert kinds == [True, False, True]
    assert found.balance.temperature == pytest.approx(found.balances[0].temperature, abs=1e-3)
    stability = [
        solve_self_heating(
            replace(study, operation=replace(study.operation, temperature=one.temperature), enough=0.5), "bump"
        ).stability.margin
        > 0.0
        for one in found.balances
    ]
    assert stability == kinds
    above = replace(around, ambient=found.balances[1].temperature + 2.0, conductance=conductance)
    hot = solve_self_heating(replace(study, around=replace(above, oil_supply=ambient)), "bump")
    assert hot.balance.temperature > found.balances[1].temperature


def test_balances_close_to_each_other_between_two_states_are_seen(bearing):
    """A narrow bump whose top just exceeds the cooling: the excess turns at it, within one step of the search."""
    study = warm(bearing, friction=bumped(0.0), reference=None)
    alone = solve_self_heating(study, "plain")
    assert [one.stable for one in alone.balances] == [True]
    seen = 0
    for height in np.linspace(0.0, 0.08, 9):
        found = solve_self_heating(replace(study, friction=bumped(height)), "bump")
        assert [one.stable for one in found.balances] == [True, False] * (len(found.balances) // 2) + [True]
        seen += len(found.balances) > 1
    assert 0 < seen < 9


def test_a_solved_film_conducts_as_that_of_the_film_atlas(bearing):
    """A light contact, whose pressure reaches far ahead of the ellipse: by nodes above 1 % of Hertz' pressure, which
    cover 1.7 ellipses there, it conducted a fifth more. What is left is the shape of the film.
    """
    solution = solve_quasistatic(bearing, Operation(inner_speed=150.0, force=(0.0, 600.0, 0.0), temperature=330.0))
    contacts = contact_conditions(solution, load_lubricant("iso vg 46", 330.0))
    solved = solve_contact(contacts[0].conditions, SolverOptions(points=129))
    films = with_formulas(contacts, solved_films(contacts, [solved, *[None] * (len(contacts) - 1)]))
    own, atlas = film_conductances(solution, contacts, films), formula_conductances(solution, contacts)
    assert own[0, 0, 0] == pytest.approx(atlas[0, 0, 0], rel=0.04)


@pytest.mark.parametrize("filled", [True, False])
def test_heat_of_drag_and_cage_goes_where_it_can_leave(filled):
    """Into oil and cage where oil passes them, else into balls and rings; all heat arrives."""
    friction = FrictionHeat(
        torque=1.0, speed=1.0, contact=np.ones((3, 2)), pumped=np.ones((3, 2)), drag=0.3, cage=0.7, seal=0.1,
        conductance=np.ones((3, 3, 2)), loaded=np.array([1.0, 0.5, 0.0]),
    )  # fmt: skip
    quiet = replace(friction, drag=0.0, cage=0.0)
    sources, without = (one.sources((0.4, 0.6), filled=filled) for one in (friction, quiet))
    assert sources.sum() == pytest.approx(13.1, rel=1e-12)
    places = {"oil": 0.3, "cage": 0.7}
    if not filled:
        places = {"balls": 0.5, "inner_ring": 0.25, "outer_ring_loaded": 0.125, "outer_ring_unloaded": 0.125}
    assert sources - without == pytest.approx(node_values(places), abs=1e-12)


@pytest.mark.parametrize("widest", [24.0, 20.0])
def test_ranges_and_margin_do_not_hang_on_where_the_search_begins(bearing, monkeypatch, widest):
    """Other states of the search: the same balance, so the same slopes, and the same ends to 0.02 K."""
    study = warm(bearing)
    usual = solve_self_heating(study, "rolling")
    monkeypatch.setattr("oilfilm.bearing.heating.self_heating.WIDEST", widest)
    other = solve_self_heating(study, "rolling")
    for name in ("coldest", "hottest"):
        assert getattr(other.stability, name) == pytest.approx(getattr(usual.stability, name), abs=0.02)
    assert other.stability.margin == pytest.approx(usual.stability.margin, abs=1e-3)

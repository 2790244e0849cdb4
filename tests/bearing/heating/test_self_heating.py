"""A bearing that warms itself, and its torque over the supply."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bearing import (
    BallKinematics,
    Operation,
    QuasistaticModel,
    contact_conditions,
    library_lubricant,
    load_material,
    solve_quasistatic,
)
from bearing.friction.resistance import contact_rolling_power
from bearing.heating.heat_balance import Cooling
from bearing.heating.self_heating import SelfHeatingProblem, self_heating
from bearing.supply.supply import InletFilm, Supply
from bearing.torque.inputs import FrictionInput
from bearing.torque.starved import starved_torque
from ehl import ViscosityLaw

STEEL = load_material("bearing steel")
ML_MIN = 1e-6 / 60.0
MODEL = QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF)


@pytest.fixture(scope="module")
def bearing(bearings):
    parts = {f"{part}_material": STEEL for part in ("ball", "inner_ring", "outer_ring")}
    return replace(bearings.b6208, **parts, width=0.018)


def oil(temperature):
    return library_lubricant("iso vg 32", temperature)


def torque(solution, contacts, lubricant):
    """Rolling resistance of flooded films alone [N m]."""
    return sum(map(contact_rolling_power, contacts)) / solution.operation.shaft_speed


def warm(bearing, **changes):
    operation = Operation(inner_speed=500.0, force=(0.0, 1000.0, 0.0))
    study = SelfHeatingProblem(bearing=bearing, operation=operation, model=MODEL, oil=oil, torque=torque)
    return replace(study, **changes)


def test_self_heating_balances_friction_and_cooling(bearing):
    study, cooling = warm(bearing), Cooling(conductance=0.5, ambient=298.15)
    found = self_heating(study, cooling)
    assert found.converged
    assert found.temperature > 303.0
    assert study.torque_at(found.temperature) * 500.0 == pytest.approx(cooling.heat(found.temperature), rel=1e-4)
    cooler = self_heating(study, replace(cooling, conductance=2.0))
    assert cooler.temperature < found.temperature
    assert cooler.torque > found.torque


def test_a_warm_inner_ring_takes_clearance(bearing):
    """Both rings at one temperature leave the clearance of 13 um but for its own growth; 10 K more inside take some."""
    assert warm(bearing).clearance(333.15) == pytest.approx(13e-6, rel=2e-3)
    groove = 0.048
    lost = STEEL.thermal_expansion * 5.0 * (groove + 0.072)
    assert warm(bearing, inner_excess=5.0).clearance(333.15) == pytest.approx(13e-6 - lost, abs=0.2e-6)


def test_starved_torque_at_its_ends(bearing):
    """Much oil: flooded films, the formulas' rolling resistance, no asperities; none: asperities carry all sliding."""
    solution = solve_quasistatic(bearing, Operation(inner_speed=500.0, force=(0.0, 2000.0, 0.0)), MODEL)
    lubricant = oil(313.15)
    contacts = contact_conditions(solution, lubricant)
    friction = FrictionInput(coefficient=0.05, roughness=(0.1e-6, 0.1e-6))
    supply = Supply(flow=1e5 * ML_MIN, track_share=1.0, residence_time=0.0)  # 1000 mL/min leave 0.97 of rolling
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
    layers = [starved_torque(solution, contacts, lubricant, friction, InletFilm(layer=h)) for h in (1e-3, 0.4e-6, 0.0)]
    ample, scarce, dry = layers
    assert ample.total == pytest.approx(ample.flooded, rel=1e-12)
    assert ample.rolling == pytest.approx(sum(map(contact_rolling_power, contacts)) / 500.0, rel=1e-12)
    assert ample.film_share == 1.0
    assert ample.drag == scarce.drag == dry.drag > 0.0
    assert ample.flooded == scarce.flooded == dry.flooded
    assert ample.rolling > scarce.rolling > dry.rolling == 0.0
    assert ample.asperity < scarce.asperity < dry.asperity
    assert ample.lambda_least > scarce.lambda_least > dry.lambda_least == 0.0
    none = starved_torque(solution, contacts, lubricant, replace(friction, oil_fraction=None), InletFilm(layer=1e-3))
    assert none.drag == 0.0
    isoviscous = contact_conditions(solution, replace(lubricant, viscosity_law=ViscosityLaw.ISOVISCOUS))
    with pytest.raises(ValueError, match="no formula"):
        starved_torque(solution, isoviscous, lubricant, friction, InletFilm(layer=1e-6))

"""Duty cycles: Miner's sum and the equivalent load by hand, and the limits in which both are one case."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from oilfilm.bearing import Operation
from oilfilm.bearing.operation import RatingInput
from oilfilm.bearing.rating.duty_cycle import LoadCase, duty_cycle, miner_life
from oilfilm.bearing.rating.life import LifeRating, life_factor, viscosity_ratio

RPM = pi / 30.0
CAPACITY, LIMIT, CLEAN = 30e3, 900.0, 0.5  # [N], [N], [-]


def rated(load, rpm, viscosity, bearing):
    """The life of a load case as `bearing_life` gives it, its equivalent load prescribed."""
    kappa = viscosity_ratio(viscosity, rpm * RPM, bearing.pitch_diameter)
    factor = life_factor(kappa, CLEAN * LIMIT / load)
    basic = 1e6 * (CAPACITY / load) ** 3
    return LifeRating(
        rating=RatingInput(contamination_factor=CLEAN),
        dynamic_rating=CAPACITY,
        equivalent_load=load,
        basic_life=basic,
        modified_life=factor * basic,
        viscosity_ratio=kappa,
        life_factor=factor,
        fatigue_load_limit=LIMIT,
        static_safety_factor=20e3 / load,
        shaft_speed=rpm * RPM,
    )


def state(bearing, share, rpm, load, torque=0.1, viscosity=15e-6):
    life = rated(load, rpm, viscosity, bearing) if rpm else LifeRating(rating=RatingInput())
    return LoadCase(
        time_share=share,
        operation=Operation(inner_speed=rpm * RPM, force=(0.0, load, 0.0)),
        viscosity=viscosity,
        largest_load=load,
        largest_pressure=2e9,
        life=life,
        converged=True,
        torque=torque,
        torque_model="skf",
    )


def test_turns_without_load_do_no_damage(bearings):
    """3, 2 and 1 kN for 10, 20 and 30 %, 40 % without: P_m = (0.1 x 27 + 0.2 x 8 + 0.3)^(1/3) = 1.663 kN."""
    shares = {3e3: 0.1, 2e3: 0.2, 1e3: 0.3}
    loaded = [state(bearings.b6208, share, 1500.0, load) for load, share in shares.items()]
    bare = replace(loaded[0], time_share=0.4, life=LifeRating(rating=RatingInput()), torque=None)
    cycle = duty_cycle(bearings.b6208, [*loaded, replace(bare, idle=True)])
    assert cycle.equivalent_load == pytest.approx(4600.0 ** (1.0 / 3.0) * 100.0, rel=1e-6)
    assert [case.damage_share for case in cycle.cases][-1] == 0.0
    assert sum(case.damage_share for case in cycle.cases) == pytest.approx(1.0)
    assert cycle.mean_power == pytest.approx(0.6 * 0.1 * 1500.0 * RPM)
    assert any("without load 4" in message for message in cycle.messages)
    assert duty_cycle(bearings.b6208, [*loaded, bare]).equivalent_load is None


def test_by_hand(bearings):
    """60 % of the time 1000 r/min at 4 kN, 40 % 3000 r/min at 2 kN: a third and two thirds of the revolutions.

    P_m^3 = 64/3 + 2 x 8/3 = 80/3; n_m = 1800 r/min; power 0.6 x 0.1 x 104.72 + 0.4 x 0.05 x 314.16 W.
    """
    cases = [state(bearings.b6208, 0.6, 1000.0, 4e3), state(bearings.b6208, 0.4, 3000.0, 2e3, torque=0.05)]
    cycle = duty_cycle(bearings.b6208, cases)
    assert [case.revolution_share for case in cycle.cases] == pytest.approx([1 / 3, 2 / 3])
    assert cycle.equivalent_load == pytest.approx(1e3 * (80.0 / 3.0) ** (1.0 / 3.0))
    assert cycle.basic_life == pytest.approx(1e6 * (CAPACITY / cycle.equivalent_load) ** 3)
    assert cycle.mean_speed == pytest.approx(1800.0 * RPM)
    assert cycle.basic_life_time == pytest.approx(cycle.basic_life / 1800.0 * 60.0)
    modified = [case.life.modified_life for case in cases]
    assert cycle.modified_life == pytest.approx(1.0 / (1.0 / 3.0 / modified[0] + 2.0 / 3.0 / modified[1]))
    assert sum(case.damage_share for case in cycle.cases) == pytest.approx(1.0)
    assert cycle.cases[0].damage_share == pytest.approx(cycle.modified_life / 3.0 / modified[0])
    power = 0.6 * 0.1 * 1000.0 * RPM + 0.4 * 0.05 * 3000.0 * RPM
    assert cycle.mean_power == pytest.approx(power)
    assert cycle.mean_torque == pytest.approx(power / (1800.0 * RPM))
    assert cycle.energy_per_hour == pytest.approx(3600.0 * power)
    assert cycle.static_safety_factor == pytest.approx(5.0)


def test_power_is_by_the_speed_of_the_rings_against_each_other(bearings):
    """1000 r/min inner and -500 outer, the outer ring alone, or both the other way round."""
    case = state(bearings.b6208, 1.0, 1500.0, 2e3)
    for inner, outer, relative in ((1000.0, -500.0, 1500.0), (0.0, 1500.0, 1500.0), (-700.0, 800.0, 1500.0)):
        turning = replace(case, operation=replace(case.operation, inner_speed=inner * RPM, outer_speed=outer * RPM))
        assert turning.power == pytest.approx(0.1 * relative * RPM)
        cycle = duty_cycle(bearings.b6208, [turning])
        assert cycle.mean_power == pytest.approx(0.1 * relative * RPM)
        assert cycle.mean_speed == pytest.approx(relative * RPM)
        assert cycle.mean_torque == pytest.approx(0.1)


def test_the_two_modified_lives_differ(bearings):
    """a_ISO at the equivalent load flatters a cycle whose heavy part does the damage."""
    cycle = duty_cycle(
        bearings.b6208, [state(bearings.b6208, 0.5, 1000.0, 9e3), state(bearings.b6208, 0.5, 1000.0, 1e3)]
    )
    assert cycle.life_factor < cycle.equivalent_life_factor
    assert cycle.equivalent_modified_life == pytest.approx(cycle.equivalent_life_factor * cycle.basic_life)


def test_one_case_in_parts_is_that_case(bearings):
    parts = [state(bearings.b6208, share, 2500.0, 3e3) for share in (0.2, 0.3, 0.5)]
    cycle, life = duty_cycle(bearings.b6208, parts), parts[0].life
    assert cycle.basic_life == pytest.approx(life.basic_life)
    assert cycle.modified_life == pytest.approx(life.modified_life)
    assert cycle.equivalent_modified_life == pytest.approx(life.modified_life)
    assert cycle.modified_life_time == pytest.approx(life.modified_life_time)
    assert cycle.mean_torque == pytest.approx(0.1)


def test_standing_still_costs_time_and_no_life(bearings):
    """Half the time at rest: the same revolutions, twice the hours, half the mean power."""
    runs = duty_cycle(bearings.b6208, [state(bearings.b6208, 1.0, 2500.0, 3e3)])
    idle = [state(bearings.b6208, 0.5, 2500.0, 3e3), state(bearings.b6208, 0.5, 0.0, 8e3, torque=0.0)]
    cycle = duty_cycle(bearings.b6208, idle)
    assert cycle.basic_life == pytest.approx(runs.basic_life)
    assert cycle.basic_life_time == pytest.approx(2.0 * runs.basic_life_time)
    assert cycle.mean_power == pytest.approx(0.5 * runs.mean_power)
    assert cycle.cases[1].damage_share == 0.0
    rest = duty_cycle(bearings.b6208, [replace(idle[1], time_share=1.0)])
    assert (rest.basic_life, rest.basic_life_time, rest.mean_torque) == (None, None, None)
    assert rest.messages == (
        "load_cases: life, kappa and a_iso null where nothing turns, 1",
        "duty_cycle: life and torque null, no load case turns",
    )


def test_what_is_null_is_told(bearings):
    good = state(bearings.b6208, 0.5, 2500.0, 3e3)
    dirty = replace(good, life=replace(good.life, modified_life=None), torque=None)
    cycle = duty_cycle(bearings.b6208, [good, dirty])
    assert cycle.modified_life is cycle.mean_power is None
    assert cycle.basic_life == pytest.approx(good.life.basic_life)
    assert [case.damage_share for case in cycle.cases] == pytest.approx([0.5, 0.5])
    assert "duty_cycle: modified life null, load case 2 has none" in cycle.messages
    assert "duty_cycle: torque null, no model gives that of load case 2" in cycle.messages


def test_miner():
    assert miner_life([0.25, 0.75], [100.0, 300.0]) == pytest.approx(200.0)
    assert miner_life([1.0, 0.0], [100.0, None]) == pytest.approx(100.0)
    assert miner_life([0.5, 0.5], [100.0, None]) is None
    assert miner_life([0.0], [None]) is None

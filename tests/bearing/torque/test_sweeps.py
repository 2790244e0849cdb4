"""Torque over speed, load and temperature."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from torque_sweeps import TorqueStudy, torque_sweep

from oilfilm.bearing import Operation, QuasistaticModel, contact_conditions, load_lubricant, solve_quasistatic
from oilfilm.bearing.torque.breakdown import NAMES, friction_torque
from oilfilm.bearing.torque.inputs import FrictionInput

RPM = pi / 30.0


def oil(temperature):
    return load_lubricant("iso vg 32", temperature)


@pytest.fixture(scope="module")
def study(bearings):
    friction = FrictionInput(series="62", static_rating=19e3, coefficient=0.05, all_models=True)
    operation = Operation(inner_speed=1.0)
    return TorqueStudy(
        bearing=bearings.b6208, operation=operation, model=QuasistaticModel(), oil=oil, friction=friction
    )


def test_a_sweep_is_its_points(study):
    speeds, forces, kelvin = [1000.0 * RPM, 4000.0 * RPM], [(300.0, 500.0, 0.0), (0.0, 2000.0, 0.0)], [313.15, 343.15]
    sweep = torque_sweep(study, speeds, forces, kelvin)
    assert sweep.converged.all()
    operation = Operation(inner_speed=speeds[1], force=forces[1], temperature=kelvin[0])
    state = solve_quasistatic(study.bearing, operation, study.model)
    lubricant = oil(kelvin[0])
    point = friction_torque(state, contact_conditions(state, lubricant), lubricant, study.friction)
    for name in NAMES:
        total = point.models[name].total
        assert sweep.totals[name].shape == (2, 2, 2)
        if total is None:
            assert np.isnan(sweep.totals[name]).all()
        else:
            assert sweep.totals[name][0, 1, 1] == pytest.approx(total, rel=1e-12)
    viscous = sweep.components["palmgren", "viscous"]
    assert np.all(viscous[1] < viscous[0])  # warm oil
    assert np.all(viscous[..., 1] > viscous[..., 0])  # more speed
    assert sweep.totals["pure_rolling_lines"][1] == pytest.approx(sweep.totals["pure_rolling_lines"][0])  # fixed mu


def test_points_without_equilibrium_are_told(study):
    sweep = torque_sweep(study, [1000.0 * RPM], [(0.0, 1e7, 0.0), (0.0, 500.0, 0.0)])
    assert sweep.converged[0, :, 0].tolist() == [False, True]
    assert np.isnan(sweep.totals["kakuta"][0, 0, 0])
    assert sweep.totals["kakuta"][0, 1, 0] > 0.0

"""Implicit steps: their linear algebra, and the motion on which vibration rides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.dynamics._sdirk_kernels import Blocks, factorise, solve_blocks
from oilfilm.bearing.dynamics.choices import Integration
from oilfilm.bearing.dynamics.friction import race_friction
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.friction.friction_sources import CoefficientTraction
from oilfilm.ehl.traction.friction_coefficients import FourConstants


def test_blocks_solve_what_the_whole_matrix_does():
    """Two balls of three speeds and two bodies, at random, as one matrix of eight."""
    random = np.random.default_rng(5)
    members, bodies = np.array([[2, 3, 4], [5, 6, 7]]), np.array([0, 1])
    slopes = random.normal(size=(8, 8))
    for row, column in ((0, 1), (1, 0)):
        slopes[np.ix_(members[row], members[column])] = 0.0
    blocks = Blocks(
        members=members,
        bodies=bodies,
        across=np.full((2, 2, 2), -1),
        orbits=np.zeros(2),
        own=np.array([slopes[np.ix_(m, m)] for m in members]),
        onto=np.array([slopes[np.ix_(bodies, m)] for m in members]),
        back=np.array([slopes[np.ix_(m, bodies)] for m in members]),
        border=slopes[np.ix_(bodies, bodies)].copy(),
    )
    residual, found = random.normal(size=8), np.zeros(8)
    factorise(0.3, blocks)
    solve_blocks(blocks, residual, found)
    assert_allclose(found, np.linalg.solve(np.eye(8) - 0.3 * slopes, residual), rtol=1e-10)


def test_implicit_steps_carry_balls_round(setup):
    """Rolling balls in circles: their centrifugal force on the outer race, the energies, a tenth of the evaluations."""
    bearing = setup.bearing_7008(5)
    law = CoefficientTraction(FourConstants.of_curve(0.05, 0.03, 0.03))
    angle = bearing.free_contact_angle
    friction = race_friction(law, bearing, (angle, angle))
    model = setup.model(bearing, friction, end_time=0.01, sample_interval=1e-4)
    ends = []
    for kind in Integration:
        options = replace(model.options, integration=kind)
        run = simulation(bearing, setup.operation(5000.0, 100.0, 60.0), replace(model, options=options))
        record = setup.run(run)
        loads = record.races[50:, :, :, 0].mean(axis=(0, 2))
        ends.append((loads, record.state[-1][run.layout.cage_speed][3], run.state.counters[4]))
        # of the work of ten milliseconds, the vibration that the steps take out is some part
        assert setup.balance(run, record) < (1e-3 if kind is Integration.EXPLICIT else 5e-3)
    explicit, implicit = ends
    assert_allclose(implicit[0], explicit[0], rtol=2e-3)
    assert implicit[1] == pytest.approx(explicit[1], rel=1e-4)
    assert implicit[2] < 0.3 * explicit[2]

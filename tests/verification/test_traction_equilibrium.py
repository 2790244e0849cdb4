"""Traction equilibrium of loads, ring and balls against the equations of motion run until nothing changes."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, Race, solve_quasistatic, solve_traction_equilibrium
from oilfilm.bearing.dynamics.bodies import ring_body
from oilfilm.bearing.dynamics.friction import RaceFriction, race_friction
from oilfilm.bearing.dynamics.inputs import DynamicsModel, DynamicsOptions
from oilfilm.bearing.dynamics.simulation import simulation
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, LawTraction
from oilfilm.ehl.traction.friction_coefficients import FourConstants

from .test_dynamics_equilibrium import BEARING, OIL, motion, settled


def test_steady_dynamics_is_the_traction_equilibrium_with_its_loads():
    """9000 r/min, 60 N: centrifugal force and couple count; loads and speeds to 1e-3, sliding and friction to 1 %."""
    operation = Operation(inner_speed=9000.0 * pi / 30.0, force=(60.0, 0.0, 0.0))
    options = DynamicsOptions(end_time=1.0, sample_interval=1.0)
    still = simulation(
        BEARING, operation, DynamicsModel(options=options, ring=ring_body(BEARING), friction=RaceFriction())
    )
    friction = race_friction(CoefficientTraction(FourConstants.of_curve(0.05, 0.03, 0.03)), BEARING, still.point.angles)
    record, layout, _ = settled(operation, friction)
    races = record.races[-1, :, 0]  # columns as `oilfilm.bearing.dynamics.arrays.ContactColumns`

    source = LawTraction(laws={Race.INNER: friction.inner, Race.OUTER: friction.outer})
    traction = BallTraction(source=source, lubricant=OIL)
    state = solve_traction_equilibrium(BEARING, operation, None, traction)
    assert state.converged, state.message
    assumed = solve_quasistatic(BEARING, operation)

    expected = np.array([state.orbit_speed[0], *(0.0 for _ in range(3))])
    beta, spin = state.attitude[0], state.spin_speed[0]
    expected[1:] = -spin * np.cos(beta), spin * np.sin(beta), state.pivot_speed[0]
    found = motion(record.state[-1], layout)
    assert_allclose(found[:3], expected[:3], rtol=1e-3)
    assert_allclose(found[3], expected[3], rtol=0.01)
    loads = np.array([state.inner_load[0], state.outer_load[0]])
    assert_allclose(races[:, 0], loads, rtol=1e-3)
    assert_allclose(np.abs(races[:, 9]), np.abs([state.inner_friction[0], state.outer_friction[0]]), rtol=0.01)
    # half and half is farther from it than that
    assert abs(assumed.attitude[0] - beta) > 0.01 * abs(beta)

"""Torque of operating films: power of the rings against torque times speed in random bearings, limits of factors."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.bearing import BallKinematics, Operation, contact_conditions, solve_quasistatic
from oilfilm.bearing.friction.resistance import Cage
from oilfilm.bearing.operation import QuasistaticModel
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.integrated import films_torque
from oilfilm.bearing.torque.skf import InletFactors, Lubrication, inlet_factors
from oilfilm.ehl import Lubricant
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw

from ..quasistatic.test_random_bearings import load_at, random_bearing

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, density=870.0)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5.2e6, limiting_coefficient=0.047)
HYPOTHESES = [k for k in BallKinematics if k is not BallKinematics.TRACTION_EQUILIBRIUM]


def random_operation(rng, bearing):
    """Radial, axial and combined load, 0.8 to 2.5 GPa; 200 to 20000 r/min, at most 1.5 million mm/min."""
    load = load_at(bearing, rng.uniform(0.8e9, 2.5e9))
    axial = load * bearing.balls * np.sin(max(bearing.free_contact_angle, 0.1))
    radial = 0.2 * load * bearing.balls
    forces = ((0.0, radial, 0.0), (axial, 0.0, 0.0), (0.7 * axial, 0.3 * radial, 0.0))
    highest = min(20000.0, 1.5e3 / bearing.pitch_diameter)
    speed = np.exp(rng.uniform(np.log(200.0), np.log(highest))) * np.pi / 30.0
    return Operation(inner_speed=speed * rng.choice([-1.0, 1.0]), force=forces[rng.integers(3)])


def drawn(seed):
    """A bearing at 200 to 20000 r/min with cage, pockets, drag and roughness, and a hypothesis on its balls."""
    rng = np.random.default_rng(90210 + seed)
    bearing = random_bearing(rng)
    operation = random_operation(rng, bearing)
    kinematics = HYPOTHESES[seed % len(HYPOTHESES)]
    state = solve_quasistatic(bearing, operation, QuasistaticModel(ball_kinematics=kinematics))
    pitch = bearing.pitch_diameter
    cage = Cage(
        pocket_friction=rng.uniform(0.02, 0.2),
        land_diameter=pitch * rng.choice([0.9, 1.1]),
        land_width=0.08 * pitch,
        land_clearance=4e-3 * pitch,
        outer_guided=bool(rng.integers(2)),
    )
    friction = FrictionInput(
        cage=cage, oil_fraction=rng.uniform(0.0, 0.05), roughness=(rng.uniform(0.05e-6, 0.5e-6),) * 2
    )
    return state, friction


SLIDES = 7


@pytest.mark.parametrize("seed", range(30))
def test_torque_times_speed_is_what_the_rings_feed_in(seed):
    """Heat, drag and cage: to 1e-6 whatever the hypothesis on the motion of the balls was.

    In draw 7 (10 to 20 N a ball, A 3 to 5, 2060 rad/s) no ball is driven, on these films and on solved ones.
    """
    state, friction = drawn(seed)
    if not state.converged or not (state.inner_load > 0.0).any():
        pytest.fail("the draw has no equilibrium")
    contacts = contact_conditions(state, OIL)
    inlet = inlet_factors(state.bearing, state.operation.shaft_speed, 3e-5, Lubrication.LOW_OIL_BATH)
    shear = films_torque(state, contacts, [None] * len(contacts), friction, inlet, EYRING, OIL)
    if seed == SLIDES:
        assert shear.balanced is None and "all slide" in shear.note
        return
    assert shear.balanced is not None, shear.note
    assert shear.torque.relative_error < 1e-6
    parts = shear.torque.parts
    assert parts["cage"] > 0.0
    assert parts["drag"] >= 0.0
    assert shear.torque.total * state.operation.shaft_speed == pytest.approx(shear.torque.rings_power, rel=1e-6)
    assert shear.flooded is not None
    assert shear.torque.total <= shear.flooded.total * (1.0 + 1e-9)


def test_oil_is_ample_where_the_films_have_a_layer_already(bearings):
    solved = inlet_factors(bearings.b6208, 1000.0, 3e-5, Lubrication.GREASE, layered=True)
    assert solved.replenishment == 1.0
    assert InletFactors().rolling == 1.0

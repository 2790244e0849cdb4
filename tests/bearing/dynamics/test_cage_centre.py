"""A cage that balls guide stays with them."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.bearing.dynamics.arrays import CAGE_LOAD
from oilfilm.bearing.dynamics.choices import Guidance, LoadType
from oilfilm.bearing.dynamics.reduction import derivative
from oilfilm.bearing.dynamics.simulation import simulation


def displaced(setup, guidance, by):
    """A simulation whose cage moved along y [m] while every ball made way along its race into the shifted pocket."""
    land = {"land_diameter": 50e-3, "land_width": 4e-3, "land_clearance": 5e-3}
    cage = {"guidance": guidance} | ({} if guidance is Guidance.BALLS else land)
    bearing = setup.bearing_7008(7)
    model = setup.model(bearing, cage_options=cage, equations=LoadType.GENERAL)
    sim = simulation(bearing, setup.operation(0.0, 50.0), model)
    y, layout = sim.state.y, sim.layout
    y[layout.cage][1] = by
    balls = y[layout.ball].reshape(-1, 3)
    radius, angle = np.hypot(balls[:, 1], balls[:, 2]), sim.data.pocket_angle
    turned = angle + np.arcsin(-by * np.sin(angle) / radius)  # on the pocket's axis, by the law of sines
    balls[:, 1], balls[:, 2] = radius * np.cos(turned), radius * np.sin(turned)
    derivative(0.0, y, sim.data, np.zeros_like(y))
    return sim


@pytest.mark.parametrize("by", [0.3e-3, -2e-3])
def test_balls_hold_a_cage_that_they_guide(setup, by):
    """Pockets along the radius would let it go: the balls can make way. Spherical ones push it back."""
    push = displaced(setup, Guidance.BALLS, by).data.loads[CAGE_LOAD]
    assert push[1] * np.sign(by) < -1.0
    assert abs(push[1]) > 10.0 * abs(push[2])


def test_pockets_of_a_cage_on_a_land_let_it_move_across(setup):
    """Cylindrical pockets along the radius: the land does the guiding."""
    sim = displaced(setup, Guidance.OUTER_RING, 0.3e-3)
    assert sim.data.pocket_out[:, 0].max() == 0.0
    assert sim.data.constants.pocket_circle == 0.0

"""Compiled moment of Kapitza's pressure against its NumPy twin."""

import numpy as np
import pytest

from ehl import ContactConditions, Lubricant
from ehl.traction.kapitza import kapitza_moment

from ...reference.ehl.kapitza import kapitza_moment_twin


@pytest.mark.parametrize("circles", [True, False])
@pytest.mark.parametrize("ball", [None, 5e-3])
def test_kapitza_moment_agrees_with_its_twin(circles, ball):
    rng = np.random.default_rng(5127)
    oil = Lubricant(viscosity=0.02, pressure_viscosity=18e-9, density=870.0)
    for _ in range(20):
        film, layer = 10.0 ** rng.uniform(-8.0, -5.0), 10.0 ** rng.uniform(-5.0, -3.0)
        contact = ContactConditions(
            load=100.0,
            radius_x=5e-3 * rng.uniform(0.6, 1.4),
            radius_y=10.0 ** rng.uniform(-2.0, 0.0),
            reduced_modulus=2.2e11,
            entrainment_speed=10.0,
            lubricant=oil,
            ball_radius=ball,
        )
        expected = kapitza_moment_twin(contact, film, layer, circles=circles)
        assert kapitza_moment(contact, film, layer, circles=circles) == pytest.approx(expected, rel=1e-12)
    assert kapitza_moment(contact, 1e-4, 1e-4) == 0.0

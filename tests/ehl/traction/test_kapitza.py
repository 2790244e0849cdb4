"""Compiled moment of Kapitza's pressure, and what circles take from it, against their NumPy twins."""

import numpy as np
import pytest

from oilfilm.ehl import ContactConditions, Lubricant
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction.rolling_moment import circles_moment_loss, kapitza_moment

from ...reference.ehl.kapitza import circles_loss_twin, kapitza_moment_twin


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


@pytest.mark.parametrize(("load", "film", "layer"), [(300.0, 3e-7, 1e-4), (1500.0, 1e-7, 5e-5)])
def test_what_circles_lose_agrees_with_its_twin(load, film, layer):
    """The gap of circles starts with a step at 0.2 of a radius: Gauss' rule is within 3 % there."""
    contact = ContactConditions(
        load=load,
        radius_x=3.4e-3,
        radius_y=95e-3,
        reduced_modulus=2.3e11,
        entrainment_speed=9.0,
        lubricant=Lubricant(viscosity=0.03, pressure_viscosity=20e-9),
        ball_radius=4e-3,
    )
    scaled = scale_contact(contact)
    axes = (scaled.semi_axis_x, scaled.semi_axis_x * scaled.semi_axis_ratio)
    lost = circles_moment_loss(contact, axes, film, layer)
    assert lost == pytest.approx(circles_loss_twin(contact, axes, film, layer), rel=0.03)
    rigid = kapitza_moment(contact, film, layer, circles=False) - kapitza_moment(contact, film, layer)
    assert lost > 1.2 * rigid > 0.0
    assert circles_moment_loss(contact, axes, 1e-4, 1e-4) == 0.0

"""Compiled friction of films against its NumPy twin."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from bearing.friction._kernels import film_frictions
from bearing.friction.films import MIN_SLIDING
from ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology, limiting_stress

from ...reference.film_friction import film_friction_twin

STRESSES = {
    ShearLaw.NEWTONIAN: {},
    ShearLaw.REE_EYRING: {"eyring_stress": 5e6},
    ShearLaw.CARREAU_YASUDA: {"carreau_modulus": 2e6, "carreau_exponent": 0.45, "yasuda_exponent": 1.7},
}


@pytest.mark.parametrize("limit", [None, 0.05])
@pytest.mark.parametrize("law", list(ShearLaw))
def test_film_friction_agrees_with_its_twin(law, limit):
    rng = np.random.default_rng(8251)
    rheology = Rheology(law=law, limiting_coefficient=limit, **STRESSES[law])
    pressure = 2e9 * rng.random(300)
    places = rng.normal(size=(3, 300)) * np.array([1e-3, 1e-3, 1e-6])[:, None]
    rows = (1e-10 * rng.random(300), 1e-6 * (0.5 + rng.random(300)), 10.0 ** rng.uniform(-2, 5, 300))
    nodes = np.stack([*rows, limiting_stress(pressure, rheology), *places])
    laws = np.array([kernel_rheology(rheology)[:4]] * 2)
    first = np.array([0, 0, 300])
    motions = np.array([[0.0] * 4, [0.01, -0.003, 40.0, 900.0], [3.0, 0.0, 0.0, 500.0], [1.0, 1.0, 1.0, 1.0]])
    own = np.array([1, 1, 1, 0])
    gradient, slope = np.empty((4, 4)), np.empty((4, 4, 4))
    film_frictions(nodes, first, laws, motions, own, MIN_SLIDING, gradient, slope)
    nodes[3] = pressure
    for found, bend, motion in zip(gradient[:3], slope[:3], motions[:3], strict=True):
        expected, steeper = film_friction_twin(nodes, rheology, motion, MIN_SLIDING)
        assert_allclose(found, expected, rtol=1e-11, atol=1e-13 * np.abs(expected).max())
        # the twin's is a central difference quotient
        assert_allclose(bend, steeper, rtol=1e-7, atol=1e-8 * np.abs(steeper).max())
    assert not gradient[3].any() and not slope[3].any()  # a film without nodes

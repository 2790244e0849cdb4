"""Compiled friction of films against its NumPy twin."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.friction._kernels import PROPORTIONAL, film_frictions, thin_sums
from oilfilm.bearing.friction.film_friction import MIN_SLIDING
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, kernel_rheology, limiting_stress

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
    rows = (1e-10 * rng.random(300), 1e6 / (0.5 + rng.random(300)), 10.0 ** rng.uniform(-2, 5, 300))
    nodes = np.stack([*rows, limiting_stress(pressure, rheology), *places])
    laws = np.array([kernel_rheology(rheology)[:4]] * 2)
    parts = np.array([[0, 0, 0], [0, 300, 300]])
    thin = np.zeros((2, 11))
    motions = np.array([[0.0] * 4, [0.01, -0.003, 40.0, 900.0], [3.0, 0.0, 0.0, 500.0], [1.0, 1.0, 1.0, 1.0]])
    own = np.array([1, 1, 1, 0])
    gradient, slope = np.empty((4, 4)), np.empty((4, 4, 4))
    film_frictions(nodes, parts, thin, laws, motions, own, MIN_SLIDING, gradient, slope)
    nodes[3] = pressure
    for found, bend, motion in zip(gradient[:3], slope[:3], motions[:3], strict=True):
        expected, steeper = film_friction_twin(nodes, rheology, motion, MIN_SLIDING)
        assert_allclose(found, expected, rtol=1e-11, atol=1e-13 * np.abs(expected).max())
        # the twin's is a central difference quotient
        assert_allclose(bend, steeper, rtol=1e-7, atol=1e-8 * np.abs(steeper).max())
    assert not gradient[3].any() and not slope[3].any()  # a film without nodes


@pytest.mark.parametrize("limit", [None, 0.05])
@pytest.mark.parametrize("law", list(ShearLaw))
def test_oil_at_ambient_pressure_is_summed_once(law, limit):
    """Proportional to the motion where it is slow, to the stated share; node by node where it is fast."""
    rng = np.random.default_rng(4187)
    rheology = Rheology(law=law, limiting_coefficient=limit, **STRESSES[law])
    places = rng.normal(size=(3, 200)) * np.array([1e-3, 1e-3, 1e-6])[:, None]
    rows = (1e-10 * rng.random(200), 1e6 / (0.5 + rng.random(200)), np.full(200, 0.02))
    nodes = np.stack([*rows, limiting_stress(np.zeros(200), rheology), *places])
    sums = np.empty(11)
    thin_sums(nodes, sums)
    laws = np.array([kernel_rheology(rheology)[:4]])
    direction = np.array([0.4, -0.3, 100.0, 200.0])
    shares = []
    for speed in np.geomspace(1e-6, 1e3, 19):
        found = []
        for parts in ([[0, 0, 200]], [[0, 200, 200]]):
            gradient, slope = np.empty((1, 4)), np.empty((1, 4, 4))
            thin = sums[None] if parts[0][1] == 0 else np.zeros((1, 11))
            film_frictions(
                nodes,
                np.array(parts),
                thin,
                laws,
                speed * direction[None],
                np.zeros(1, int),
                MIN_SLIDING,
                gradient,
                slope,
            )
            found.append((gradient[0], slope[0]))
        shares.append(max(np.abs(a - b).max() / np.abs(b).max() for a, b in zip(*found, strict=True)))
    assert max(shares) < 4.0 * PROPORTIONAL  # of the slope, which bends more than the stress
    assert max(shares[:5]) > 0.0 or law is ShearLaw.NEWTONIAN  # summed once where slow
    assert max(shares[-5:]) < 1e-12 or (law is ShearLaw.NEWTONIAN and limit is None)

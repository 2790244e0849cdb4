"""Compiled sums of the table's radial functions beside their matrices."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.ehl.arrays import radial
from oilfilm.ehl.atlas.table import NO_STEP, slanted_radial, table, weighted_radial_sums


def test_sums_are_those_of_the_matrices():
    """With the step of light contacts and without, to round-off; also where functions are none."""
    rng = np.random.default_rng(52163)
    light = table().light
    x = light.places[::97] + rng.normal(size=(len(light.places[::97]), 3)) * 0.1
    x = np.concatenate([x, [[1e3, -1e4, 1e5]]])
    size = np.abs(light.weights).sum(axis=0)
    found = weighted_radial_sums(x, light.places, light.scales, light.step, light.weights)
    known = slanted_radial(x, light.places, light.scales, light.step) @ light.weights
    assert_allclose(found / size, known / size, atol=1e-13)
    found = weighted_radial_sums(x, light.places, light.scales, NO_STEP, light.weights)
    assert_allclose(found / size, radial(x, light.places, light.scales) @ light.weights / size, atol=1e-13)

"""Exponential and logarithm of lines against those of NumPy."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.ehl.oil._kernels import exponential, logarithm

LAST_DIGITS = 4.0 * np.finfo(np.float64).eps  # two roundings of each side


def test_exponential_over_the_range_of_viscosities():
    x = np.concatenate((np.random.default_rng(40127).uniform(-600.0, 600.0, 20000), [0.0, -0.0, 1.0]))
    ours = x.copy()
    exponential(ours)
    assert_allclose(ours, np.exp(x), rtol=LAST_DIGITS)


def test_logarithm_of_normal_numbers():
    """To round-off of the result, also beside one, where it is small itself."""
    random = np.random.default_rng(9311)
    x = np.concatenate(
        (
            1.0 + 10.0 ** random.uniform(-15.0, 4.0, 20000),
            10.0 ** random.uniform(-300.0, 300.0, 20000),
            [0.25, 0.5, 1.0, 2.0, 4.0, np.sqrt(0.5), np.sqrt(2.0)],
        )
    )
    ours = x.copy()
    logarithm(ours)
    assert_allclose(ours, np.log(x), rtol=LAST_DIGITS, atol=0.0)

"""The tableau of Dormand and Prince's method: its identities, as SciPy's test_rk.py checks its own.

Order conditions: Hairer, Norsett and Wanner (1993), Solving Ordinary Differential Equations I, section II.2, a sum over
stages for each rooted tree.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing.dynamics import _integration_kernels as method

STAGES = 7
A = np.zeros((STAGES, STAGES))
A[1:, :6] = method.A
C = np.concatenate([[0.0], method.C])
B = np.concatenate([method.A[-1], [0.0]])  # the last stage is the first of the next step
EMBEDDED = B - method.E  # weights of order 4
TREES = {  # order: (sum of b times this, its value)
    1: [(np.ones(STAGES), 1)],
    2: [(C, 1 / 2)],
    3: [(C**2, 1 / 3), (A @ C, 1 / 6)],
    4: [(C**3, 1 / 4), (C * (A @ C), 1 / 8), (A @ C**2, 1 / 12), (A @ A @ C, 1 / 24)],
    5: [
        (C**4, 1 / 5),
        (C**2 * (A @ C), 1 / 10),
        ((A @ C) ** 2, 1 / 20),
        (C * (A @ C**2), 1 / 15),
        (A @ C**3, 1 / 20),
        (C * (A @ A @ C), 1 / 30),
        (A @ (C * (A @ C)), 1 / 40),
        (A @ A @ C**2, 1 / 60),
        (A @ A @ A @ C, 1 / 120),
    ],
}
ROUNDING = 1e-14


def test_rows_sum_to_the_times_of_the_stages():
    assert_allclose(A.sum(axis=1), C, atol=ROUNDING)


def test_the_method_is_explicit():
    assert np.array_equal(A, np.tril(A, -1))


def test_weights_sum_to_one_and_those_of_the_error_to_nothing():
    assert B.sum() == pytest.approx(1.0, abs=ROUNDING)
    assert method.E.sum() == pytest.approx(0.0, abs=ROUNDING)


@pytest.mark.parametrize(("weights", "order"), [(B, 5), (EMBEDDED, 4)], ids=["step", "embedded"])
def test_order_conditions(weights, order):
    """A step of order 5, the error estimate its difference to one of order 4."""
    for up_to in range(1, order + 1):
        for vector, value in TREES[up_to]:
            assert weights @ vector == pytest.approx(value, abs=ROUNDING)


def test_the_embedded_weights_are_not_of_order_five():
    """Otherwise their difference would estimate nothing."""
    misses = [abs(EMBEDDED @ vector - value) for vector, value in TREES[5]]
    assert max(misses) > 1e-4

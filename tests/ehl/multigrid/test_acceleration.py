"""Acceleration of a fixed-point map."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.ehl.multigrid.full_multigrid import Acceleration


def linear_map(size):
    """A slowly contracting affine map with swings, and its fixed point."""
    random = np.random.default_rng(81723)
    vectors = np.linalg.qr(random.standard_normal((size + 1, size + 1)))[0]
    values = np.zeros(size + 1)
    values[:4] = 0.97, -0.95, 0.9, 0.6
    matrix, fixed = vectors @ np.diag(values) @ vectors.T, 1.0 + random.random(size + 1)
    return lambda x: fixed + matrix @ (x - fixed), fixed


def test_a_linear_map_with_few_slow_modes_is_solved_at_once():
    """Four modes and the rest at zero: exact after as many cycles as there are modes, and two."""
    cycle, fixed = linear_map(20)
    acceleration, given = Acceleration(), (np.zeros((4, 5)) + 1.0, 1.0)
    for _ in range(6):
        found = cycle(np.append(given[0].ravel(), given[1]))
        given = acceleration.next(given, (found[:-1].reshape(4, 5), float(found[-1])))
    assert_allclose(np.append(given[0].ravel(), given[1]), fixed, rtol=1e-6)
    plain = np.ones(21)
    for _ in range(6):
        plain = cycle(plain)
    assert np.abs(plain - fixed).max() > 0.1


def test_pressure_stays_positive():
    acceleration = Acceleration()
    first = (np.array([[1.0, 0.2]]), 0.0)
    acceleration.next(first, (np.array([[1.0, 0.1]]), 0.0))
    P, _ = acceleration.next((np.array([[1.0, 0.1]]), 0.0), (np.array([[1.0, 0.01]]), 0.0))
    assert P.min() >= 0.0

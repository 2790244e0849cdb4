"""The fit of the atlas: reproducible, and its bars honest."""

from __future__ import annotations

import numpy as np
import pytest
from fit import DEVIATION, NOISE, bar, labels, patch, robust_fit

from oilfilm.ehl.arrays import radial, trend_terms
from oilfilm.ehl.atlas.table import table


def test_a_fit_does_not_depend_on_the_order_of_its_labels():
    """Trend and radial functions over eight decades of eigenvalues: in one covariance three digits were left."""
    rng = np.random.default_rng(7431)
    x = rng.uniform(0.0, 5.0, (300, 3))
    y = np.sin(x[:, 0]) + x[:, 1] ** 2 + 1e-4 * rng.standard_normal(300)
    order = rng.permutation(300)
    found = []
    for own in (np.arange(300), order):
        prior = DEVIATION**2 * radial(x[own], x[own], np.array([1.4, 7.0, 7.0]))
        weights, trend = robust_fit(y[own], prior, NOISE["light"], trend_terms(x[own]))
        at = np.empty(300)
        at[own] = prior @ weights + trend_terms(x[own]) @ trend
        found.append(at)
    assert np.abs(found[0] - found[1]).max() < 1e-7
    assert np.abs(found[0] - y).max() < 1e-3


def test_a_bar_holds_one_more_error_in_nineteen_of_twenty_draws():
    rng = np.random.default_rng(8124)
    draws = rng.standard_normal((4000, 41, 1))
    held = np.mean([np.abs(own[40]) <= bar(own[:40]) for own in draws])
    assert held == pytest.approx(39.0 / 41.0, abs=0.01)
    assert bar(draws[0, :10])[0] == np.abs(draws[0, :10]).max()


@pytest.mark.slow
def test_the_labels_give_the_stored_functions():
    """Those of heavy contacts, refitted."""
    own, known = patch("heavy", *labels()), table().heavy
    assert np.abs(own.mean - known.mean).max() < 1e-12
    assert np.abs(own.places - known.places).max() == 0.0
    shape = radial(own.places, own.places, own.scales)
    change = shape @ (own.weights - known.weights) + trend_terms(own.places) @ (own.trend - known.trend)
    assert np.abs(change).max() < 1e-6

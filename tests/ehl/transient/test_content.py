"""Oil carried along the characteristic: moved exactly, by second order at uneven steps, conserved."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.transient.content import advected, steady_content, weights


def parabolas():
    x = np.arange(40.0)
    return np.stack([0.3 + 0.02 * x**2, 1.0 - 0.1 * x + 0.005 * x**2])


@pytest.mark.parametrize("nodes", [0.0, 1.0, 2.0, -1.0, -2.0, 0.3, 1.7, -0.4, -1.9])
def test_parabolas_move_exactly_also_from_beyond_the_ends(nodes):
    x = np.arange(40.0) - nodes
    exact = np.stack([0.3 + 0.02 * x**2, 1.0 - 0.1 * x + 0.005 * x**2])
    assert_allclose(advected(parabolas(), nodes), exact, rtol=1e-12)


def test_whole_nodes_move_without_rounding():
    values = np.random.default_rng(9127).random((3, 20))
    assert (advected(values, 1.0)[:, 1:] == values[:, :-1]).all()


@pytest.mark.parametrize("nodes", [0.37, -0.62, 1.0])
def test_a_lump_inside_the_line_keeps_its_oil(nodes):
    values = np.zeros((1, 60))
    values[0, 20:40] = np.random.default_rng(4411).random(20)
    assert_allclose(advected(values, nodes).sum(), values.sum(), rtol=1e-13)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.4])
def test_weights_differentiate_parabolas_of_time(ratio):
    c0, c1, c2 = weights(ratio)
    step = 0.3

    def f(t):
        return 2.0 - 0.7 * t + 1.3 * t**2

    t, before, first = 1.0, 1.0 - step, 1.0 - step - step / ratio
    assert_allclose((c0 * f(t) - c1 * f(before) + c2 * f(first)) / step, -0.7 + 2.6 * t, rtol=1e-12)


def test_oil_of_a_steady_film_is_marched_through_the_cavity():
    """Behind rupture the content tends to a constant and never exceeds the gap."""
    full = np.array([[3.0, 2.0, 1.2, 1.0, 1.0, 1.1, 1.5, 2.5, 4.0, 6.0]])
    empty = np.arange(10) > 5
    content = steady_content(full, np.zeros_like(full), empty[None, :], 0.1)
    assert (content[0, :6] == full[0, :6]).all()
    assert (content <= full).all()
    assert_allclose(content[0, -1], content[0, -2], rtol=2e-3)  # a third of the last change is left a node

"""Batch means: the interval covers the mean as often as it says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import t

from bearing.dynamics.statistics import BATCHES, STUDENT, batch_interval, whirl_speed


def test_student():
    assert pytest.approx(t.ppf(0.975, BATCHES - 1), rel=1e-4) == STUDENT


def correlated(random, count, memory):
    """Values of mean zero, each `memory` of the last one and noise."""
    noise, values = random.standard_normal(count), np.zeros(count)
    values[0] = noise[0] / np.sqrt(1.0 - memory**2)
    for k in range(1, count):
        values[k] = memory * values[k - 1] + noise[k]
    return values


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_the_interval_holds_the_mean_in_95_of_100_histories(memory):
    random = np.random.default_rng(90317)
    histories = [correlated(random, 2000, memory) for _ in range(400)]
    held = np.mean([abs(values.mean()) <= batch_interval(values) for values in histories])
    assert 0.91 < held < 0.985


def test_a_trend_widens_it_and_few_samples_have_none():
    steady = np.tile([1.0, -1.0], 100)
    assert batch_interval(steady) == pytest.approx(0.0, abs=1e-15)
    assert batch_interval(steady + np.linspace(0.0, 1.0, 200)) > 0.1
    assert batch_interval(np.ones(19)) is None


@pytest.mark.parametrize("speed", [340.0, -55.0])
def test_whirl_of_a_circle_off_the_axis(speed):
    time = np.linspace(0.0, 0.1, 1001)
    place = 1e-6 * np.stack([3.0 + np.cos(speed * time), 0.5 + np.sin(speed * time)], axis=1)
    assert whirl_speed(time, place) == pytest.approx(speed, rel=0.02)  # the mean of parts of turns is off the centre
    assert whirl_speed(time, np.zeros((1001, 2))) is None
    assert whirl_speed(time[:2], place[:2]) is None


def test_interval_of_known_means():
    """Batches of means 1, 2, .. n: the variance of the batches is n (n + 1)/12, with n - 1 as the divisor."""
    history = np.repeat(np.arange(1.0, BATCHES + 1.0), 50)
    assert batch_interval(history) == pytest.approx(STUDENT * ((BATCHES + 1) / 12.0) ** 0.5, rel=1e-12)

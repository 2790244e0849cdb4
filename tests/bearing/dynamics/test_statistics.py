"""Batch means: the interval covers the mean as often as it says."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import t

from oilfilm.bearing.dynamics.arrays import CONTACT, Layout
from oilfilm.bearing.dynamics.statistics import (
    BATCHES,
    INPUTS,
    MECHANISMS,
    STUDENT,
    RunningStatistics,
    batch_interval,
    gyroscopic_motion,
    load_interval,
    orbit_speeds,
    stationarity,
    whirl_speed,
)

BALLS = 3


def made_up_record(work, energy):
    """One sample of balls that orbit at 40, 50 and 60 rad/s on circles about the axis, with energies [J]."""
    layout = Layout(BALLS)
    state = np.zeros((1, layout.size))
    azimuth, radius, speed = np.array([0.3, 2.0, 4.5]), np.array([0.02, 0.021, 0.03]), np.array([40.0, 50.0, 60.0])
    out, around = np.stack([np.cos(azimuth), np.sin(azimuth)]), np.stack([-np.sin(azimuth), np.cos(azimuth)])
    place, velocity = np.ones((BALLS, 3)), np.ones((BALLS, 3))
    place[:, 1:] = (radius * out).T
    velocity[:, 1:] = (radius * speed * around + 0.7 * out).T
    state[0, layout.ball], state[0, layout.ball_speed] = place.ravel(), velocity.ravel()
    state[0, layout.energy] = work
    still = np.zeros((1, 2, BALLS, len(CONTACT)))
    return SimpleNamespace(
        time=np.array([0.1]),
        state=state,
        races=still,
        pockets=still[:, 0],
        energy=np.array([energy]),
        loads=np.zeros((1, 12)),
    )


def test_orbit_speed_is_that_across_the_radius():
    record = made_up_record(np.zeros(len(MECHANISMS)), [0.0, 0.0, 0.0])
    assert_allclose(orbit_speeds(record.state, Layout(BALLS)), [[40.0, 50.0, 60.0]], rtol=1e-12)


def test_what_is_put_in_is_lost_or_stored():
    """7 J in four ways, 4 J lost in others, one taken up by films: 2 J more than at the start balance."""
    work = np.zeros(len(MECHANISMS))
    work[:INPUTS] = 3.0, 2.5, 0.5, 1.0
    work[INPUTS], work[INPUTS + 2], work[-1] = 3.0, 1.0, 1.0
    running = RunningStatistics(BALLS)
    running.add(made_up_record(work, [1.0, 4.0, 2.0]), start_energy=5.0)
    assert running.residual == pytest.approx(0.0, abs=1e-12)
    running.add(made_up_record(work, [1.0, 4.0, 2.3]), start_energy=5.0)
    assert running.residual == pytest.approx(0.3)
    assert running.rows == 2


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


def test_what_a_relaxation_has_left():
    """100 + 50 exp(-t/0.4) over t from 0 to 1: not steady, 50/e^2.5 to come in a relaxation time of 0.4."""
    time = np.linspace(0.0, 1.0, 2001)
    found = stationarity(100.0 + 50.0 * np.exp(-time / 0.4))
    assert not found.steady
    assert found.left == pytest.approx(-50.0 * np.exp(-2.5), rel=0.03)  # of means
    assert found.relaxation == pytest.approx(0.4, rel=1e-3)
    assert stationarity(np.ones(19)) is None


def test_noise_and_small_trends_are_steady():
    """Of 400 histories without a trend few are called drifting; a trend beyond the spread is one."""
    random = np.random.default_rng(61723)
    histories = [10.0 + correlated(random, 2000, 0.9) for _ in range(400)]
    assert np.mean([stationarity(values).steady for values in histories]) > 0.9
    assert not stationarity(histories[0] + np.linspace(0.0, 5.0, 2000)).steady
    assert stationarity(1000.0 + np.linspace(0.0, 0.9, 100)).steady


def test_turning_about_the_tangent():
    """A ball at azimuth 0.4 that turns about the tangent at 7, about the radius at 30 rad/s."""
    layout = Layout(1)
    state = np.zeros((1, layout.size))
    out, around = np.array([0.0, np.cos(0.4), np.sin(0.4)]), np.array([0.0, -np.sin(0.4), np.cos(0.4)])
    state[0, layout.ball] = 0.02 * out
    state[0, layout.ball_turn] = 7.0 * around + 30.0 * out
    assert_allclose(gyroscopic_motion(state, layout, np.array([[50.0]])), [[7.0, 1500.0]])


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


def test_loads_that_come_and_go_are_known_less_well():
    """Half width over the mean, of the race where it is larger; none of few samples."""
    steady = np.full((400, 1), 20.0)
    bounces = np.random.default_rng(11).exponential(5.0, (400, 1))
    assert load_interval(np.hstack([steady, steady])) == 0.0
    width = load_interval(np.hstack([bounces, steady]))
    assert width == pytest.approx(batch_interval(bounces[:, 0]) / bounces.mean())
    assert 0.02 < width < 0.3
    assert load_interval(np.ones((5, 2))) is None

"""Axes of pictures of simulations and slip maps: the window that matters, and nothing hidden in silence."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

from oilfilm.postprocess.dynamics.plots import FEWEST_SAMPLES, _without_spikes, draw_spectrum
from oilfilm.postprocess.slip.write import draw_balls


def drawn(*lines):
    axes = Figure().subplots()
    for line in lines:
        axes.plot(line)
    _without_spikes(axes, *lines)
    return axes


def test_a_spike_at_the_start_does_not_rule_the_axis():
    slip = 1.5 + 0.2 * np.sin(np.linspace(0.0, 60.0, 2000))
    slip[:5] = 40.0
    axes = drawn(slip)
    assert axes.get_ylim()[1] < 2.0
    assert "short spikes reach 40" in axes.texts[0].get_text()


def test_a_run_up_is_shown_whole():
    speed = np.linspace(0.0, 100.0, 1000)
    axes = drawn(speed)
    assert axes.get_ylim()[0] <= 0.0 and axes.get_ylim()[1] >= 100.0
    assert not axes.texts


def test_constant_and_missing_lines_leave_the_axis():
    axes = drawn(np.full(10, 3.0), np.full(4, np.nan))
    assert axes.get_ylim()[0] < 3.0 < axes.get_ylim()[1]


def test_slip_factors_of_all_sizes_are_seen():
    """Factors from 1 to 300 on one logarithmic axis, a ball without load named."""
    factors = np.array([300.0, 20.0, 1.0, 0.0])
    state = SimpleNamespace(
        azimuth=np.radians([0.0, 90.0, 180.0, 270.0]),
        ring_force=(100.0, 50.0, 0.0),
        operation=SimpleNamespace(inner_speed=1000.0),
    )
    figure = Figure()
    draw_balls(figure, SimpleNamespace(factors=factors, state=state, limit=10.0, printed_force=None))
    axes = figure.axes[0]
    low, high = axes.get_ylim()
    assert axes.get_yscale() == "log"
    assert 0.0 < low < 1.0 and high > 300.0
    assert [text.get_text() for text in axes.texts] == ["no\nload"]
    bars = {bar.get_height(): bar for bar in axes.patches}
    assert bars[1.0].get_facecolor() == bars[0.0].get_facecolor() != bars[20.0].get_facecolor()


@pytest.mark.parametrize("factor", [0.0, 5.0])
def test_slip_factors_all_alike(factor):
    state = SimpleNamespace(
        azimuth=np.radians([0.0, 180.0]), ring_force=(100.0, 50.0, 0.0), operation=SimpleNamespace(inner_speed=1000.0)
    )
    figure = Figure()
    results = SimpleNamespace(factors=np.full(2, factor), state=state, limit=10.0, printed_force=None)
    draw_balls(figure, results)
    assert figure.axes[0].get_ylim()[1] > 10.0


@pytest.mark.parametrize("samples", [1, 2 * FEWEST_SAMPLES - 1, 2 * FEWEST_SAMPLES])
def test_a_history_too_short_for_a_spectrum_says_so(samples):
    figure, time = Figure(), np.linspace(0.0, 1.0, samples)
    place = np.stack((0.0 * time, np.sin(9.0 * time)), axis=1)
    ring = (("time", "ring_coordinate"), place)
    data = xarray.Dataset({"ring_position": ring}, coords={"time": time, "ring_coordinate": ["x", "y"]})
    draw_spectrum(figure, data, {"case": {}, "frequencies_Hz": {"with_slip": {"ball_pass_inner": 5.0}}})
    (axes,) = figure.axes
    told = any("hold no spectrum" in text.get_text() for text in axes.texts)
    assert told is (samples < 2 * FEWEST_SAMPLES)
    assert bool(axes.lines) is not told

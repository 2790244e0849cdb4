"""Figure of the friction torque: every component has a colour, bars are as long as the torques."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from oilfilm.bearing.torque.breakdown import NAMES, TorqueBreakdown
from oilfilm.bearing.torque.integrated import IntegratedTorque, SolvedShear
from oilfilm.bearing.torque.models import ModelTorque, summed
from oilfilm.postprocess.bearing.bearing_quantities import TORQUE_MODELS
from oilfilm.postprocess.bearing.plots import KINDS, draw_models, draw_torque


def test_every_model_has_a_label_and_every_component_one_colour():
    assert set(TORQUE_MODELS) == {*NAMES, "skf_as_printed"}
    parts = [part for _, _, members in KINDS for part in members]
    assert len(parts) == len(set(parts))
    assert {part for model in TORQUE_MODELS.values() for part in model.parts} <= set(parts)


def test_bars_end_where_the_components_do():
    models = {
        "skf": summed({"rolling": 0.03, "sliding": 0.02, "seal": 0.0, "drag": 0.0}),
        "coulomb": summed({"sliding": -0.005, "spin": 0.01, "curvature": 0.02}),
    }
    axes = Figure().subplots()
    draw_models(axes, models, "skf")
    ends = sorted(round(bar.get_x() + bar.get_width(), 9) for bar in axes.patches if bar.get_width() != 0.0)
    assert ends == [-5.0, 10.0, 30.0, 30.0, 50.0]
    assert {text.get_text().strip() for text in axes.texts} == {"50", "25"}


def test_negative_parts_stand_left_of_zero():
    axes = Figure().subplots()
    draw_models(axes, {"skf": summed({"rolling": 2e-3, "sliding": -1e-3}), "houpert": summed({"spin": 1e-3})})
    bars = [bar for bar in axes.patches if bar.get_width() != 0.0]
    rolling, sliding, spin = ((min(x, x + w), abs(w)) for x, w in ((b.get_x(), b.get_width()) for b in bars))
    assert rolling == pytest.approx((0.0, 2.0))
    assert sliding == pytest.approx((-1.0, 1.0))
    assert spin == pytest.approx((0.0, 1.0))
    assert len({bar.get_facecolor() for bar in bars}) == 3


def test_tiny_negative_parts_leave_the_others_their_colours():
    """A sliding part of -0.0001 of 10.5 N mm must not turn the bar grey."""
    axes = Figure().subplots()
    draw_models(axes, {"integrated": summed({"rolling": 10.47e-3, "sliding": -1e-7, "curvature": 6e-5})})
    assert len({bar.get_facecolor() for bar in axes.patches if bar.get_width() != 0.0}) == 2


def test_figure_with_and_without_the_balls():
    names = dict.fromkeys(NAMES, ModelTorque(note="left out"))
    names["skf"] = summed({"rolling": 0.03, "sliding": 0.02})
    torque = TorqueBreakdown(models=names, coefficient=0.05)
    azimuth = np.radians([0.0, 120.0, -120.0])
    state = SimpleNamespace(azimuth=azimuth, rows=(None,), row_of_ball=np.zeros(3, dtype=int))
    results = SimpleNamespace(torque=torque, case={}, title="three balls", quasistatic=state, frozen=False)
    figure = Figure()
    draw_torque(figure, results)
    assert len(figure.axes) == 1
    part = IntegratedTorque(
        rolling=0.01,
        sliding=0.0,
        spin=0.0,
        curvature=0.0,
        shaft_power=1.0,
        heat=1.0,
        per_ball=np.array([6e-3, 2e-3, 2e-3]),
    )
    results.torque = replace(torque, shear=SolvedShear(hypothesis=part))
    figure = Figure()
    draw_torque(figure, results)
    heights = [bar.get_height() for bar in figure.axes[1].patches]
    assert heights == pytest.approx([6.0, 2.0, 2.0])
    centres = [bar.get_x() + 0.5 * bar.get_width() for bar in figure.axes[1].patches]
    assert centres == pytest.approx([0.0, 120.0, 240.0])  # as every table and picture counts them
    state.rows, state.azimuth, state.row_of_ball = (None, None), np.tile(azimuth, 2), np.repeat([0, 1], 3)
    results.torque = replace(torque, shear=SolvedShear(hypothesis=replace(part, per_ball=np.full(6, 1e-3))))
    figure = Figure(layout="constrained")
    draw_torque(figure, results)
    figure.draw_without_rendering()
    below = figure.axes[1]
    assert below.get_legend().get_window_extent().y0 >= below.bbox.y1  # it hides no bar
    results.torque = None
    with pytest.raises(ValueError, match="no torque"):
        draw_torque(Figure(), results)

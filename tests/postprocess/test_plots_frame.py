"""The figure of the conventions, drawn from a solved bearing."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from bearing import BallKinematics, Model, solve_quasistatic
from cases import load_case
from postprocess.plots_frame import WINDOW, draw_frame


def test_every_arrow_and_label_lies_within_its_panel():
    case = load_case("218_axial_22250N")
    state = solve_quasistatic(case.bearing, case.operation, Model(ball_kinematics=BallKinematics.HALF_AND_HALF))
    figure = Figure()
    draw_frame(figure, state)
    assert len(figure.axes) == 3
    labels = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert {"$n_o$", "$n_i$", r"$\alpha_o$", r"$\alpha_i$", r"$\beta$", "$Q_o$", "$Q_i$", "$F_c$", "$M_g$"} <= set(
        labels
    )
    for axes in figure.axes:
        for line in axes.lines:
            assert np.abs(line.get_xydata()).max() < WINDOW

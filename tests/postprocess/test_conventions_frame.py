"""The figure of the conventions draws what was solved."""

from __future__ import annotations

import numpy as np
import pytest
from conventions_frame import draw_frame
from matplotlib.figure import Figure

from oilfilm.bearing import BallKinematics, QuasistaticModel, solve_quasistatic
from oilfilm.cases import load_case


@pytest.fixture(scope="module")
def state():
    case = load_case("218_axial_22250N")
    return solve_quasistatic(
        case.bearing, case.operation, QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF)
    )


def arrows(axes):
    """Start and step of every arrow, in the order they are drawn."""
    found = [text for text in axes.texts if getattr(text, "arrow_patch", None) is not None]
    return [(np.array(text.xyann), np.array(text.xy) - np.array(text.xyann)) for text in found]


def test_arrows_have_the_directions_of_the_solution(state):
    """Normals at the solved contact angles; friction at right angles to them; both friction forces turn as Mg does."""
    figure = Figure()
    draw_frame(figure, state)
    section, forces, _ = figure.axes
    outer, inner = state.outer_contact_angle[0], state.inner_contact_angle[0]
    normal = arrows(section)[0][1]
    assert np.arctan2(*normal) == pytest.approx(outer)
    load_o, load_i, centrifugal, friction_o, friction_i = arrows(forces)[:5]
    assert np.arctan2(*-load_o[1]) == pytest.approx(outer)
    assert np.arctan2(*load_i[1]) == pytest.approx(inner)
    assert np.hypot(*load_o[1]) / np.hypot(*load_i[1]) == pytest.approx(state.outer_load[0] / state.inner_load[0])
    assert centrifugal[1][1] > 0.0
    for load, friction in ((load_o, friction_o), (load_i, friction_i)):
        assert abs(load[1] @ friction[1]) < 1e-12
        assert np.linalg.det([friction[0], friction[1]]) > 0.0  # x to the right, r up: counter-clockwise is about +e_t

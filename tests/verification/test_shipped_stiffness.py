"""Stiffness of shipped cases against differences of their own equilibria."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import BallKinematics, solve_quasistatic
from oilfilm.bearing.geometry import SINGLE
from oilfilm.cases import load_case
from oilfilm.cases.format.case import Case
from oilfilm.cases.format.shipped import shipped_cases

FAST = ("6208_full_ceramic", "6208_full_ceramic_400N", "6304_planar", "7008_radial", "7008_back_to_back")
STEP = 2e-9  # balances truncation against round-off, errors about 1e-8 [m]
LEAST = 1e-3  # of the largest entry, which measures a direction without stiffness [-]
TOLERANCE = 1e-6  # of the root of the product of two diagonal entries [-]


def stems():
    """Shipped bearings; elastic rings take seconds and are among the slow ones."""
    bearings = [name for name, path in shipped_cases().items() if path.parent.name != "shaft"]
    marks = {name: () if name in FAST else (pytest.mark.slow,) for name in bearings}
    return [pytest.param(name, marks=some) for name, some in marks.items()]


@pytest.mark.parametrize("stem", stems())
def test_stiffness_is_the_difference_of_equilibria(stem):
    """A ball off the inner race under a radial load once counted as one that this race drives: 6.8 % of K_yy."""
    case = load_case(stem)
    if not isinstance(case, Case) or case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        pytest.skip("no bearing, or the tangent at prescribed motion")
    rows = case.rows or SINGLE
    base = solve_quasistatic(case.bearing, case.operation, case.model, rows=rows)
    assert base.converged, base.message
    radius = case.bearing.inner_centre_radius
    scale = np.array([1.0, 1.0, 1.0, radius, radius])
    unit = np.outer(scale, scale)
    position = np.concatenate([base.displacement, base.tilt])

    def load_at(freedom, step):
        at = position.copy()
        at[freedom] += step / scale[freedom]
        held = replace(
            case.operation, force=(None,) * 3, moment=(None,) * 2, displacement=tuple(at[:3]), tilt=tuple(at[3:])
        )
        found = solve_quasistatic(case.bearing, held, case.model, base, rows)
        assert found.converged, found.message
        return np.concatenate([found.ring_force, found.ring_moment]) / scale

    differences = np.stack([(load_at(k, STEP) - load_at(k, -STEP)) / (2.0 * STEP) for k in range(5)], axis=1)
    stiffness = base.stiffness / unit
    size = np.sqrt(np.maximum(np.abs(np.diag(stiffness)), LEAST * np.abs(stiffness).max()))
    assert_allclose(differences / np.outer(size, size), stiffness / np.outer(size, size), atol=TOLERANCE)

"""The equilibrium against independently computed cases of the literature.

Sources: Harris and Kotzalas, Rolling Bearing Analysis (218, 209); Yao et al. 2022 (6208, silicon nitride); a slip
study of the 7000C after Hirano. Frame as everywhere: x axial, psi = 0 the load line. The numbers are those of
docs/theory/bearing.md; each was computed by a program that shares no code with this one, to the digits given.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from oilfilm.bearing import BallKinematics, Curvature, Operation, QuasistaticModel, solve_quasistatic

OUTER_CONTROL = QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL)


@pytest.mark.parametrize("curvature", Curvature)
def test_218_angular_contact(bearings, curvature):
    """22250 N axial, 10000 rpm, outer race control: 0.3 %; where the curvature is taken moves the angles by 0.01 %."""
    model = QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL, curvature=curvature)
    solution = solve_quasistatic(
        bearings.b218, Operation(inner_speed=10000.0 * bearings.rpm, force=(22250.0, 0.0, 0.0)), model
    )
    assert solution.converged
    found = [
        np.degrees(solution.inner_contact_angle[0]),
        np.degrees(solution.outer_contact_angle[0]),
        solution.inner_load[0],
        solution.outer_load[0],
        solution.centrifugal_force[0],
        1e3 * solution.gyroscopic_moment[0],
    ]
    assert_allclose(found, [48.71, 33.62, 1850.8, 2304.7, 621.7, 1530.0], rtol=3e-4)


def test_209_deep_groove_radial_load(bearings):
    """8900 N radial at rest; four printed figures, 0.02 %."""
    solution = solve_quasistatic(bearings.b209, Operation(inner_speed=0.0, force=(0.0, 8900.0, 0.0)))
    assert solution.inner_load[0] == pytest.approx(4526.0, rel=2e-4)
    assert 1e6 * solution.displacement[1] == pytest.approx(60.7, rel=5e-4)
    assert solution.displacement[0] == 0.0


def test_6208_silicon_nitride(bearings):
    """3000 N, 10000 rpm: loads of the balls at 0 and 40 degrees, those beyond carry their centrifugal force alone."""
    solution = solve_quasistatic(
        bearings.b6208, Operation(inner_speed=10000.0 * bearings.rpm, force=(0.0, 3000.0, 0.0))
    )
    assert_allclose(solution.inner_load[:5], [1596.3, 916.2, 0.0, 0.0, 0.0], rtol=1e-4)
    assert_allclose(solution.centrifugal_force, 15.48, rtol=2e-4)
    assert_allclose(solution.outer_load, solution.inner_load + solution.centrifugal_force, rtol=1e-11)


@pytest.mark.parametrize(
    ("axial", "expected"), [(50.0, (2.340, 0.569, 0.176)), (600.0, (27.69, 6.901, 2.229))], ids=["50 N", "600 N"]
)
def test_7000c_hirano_ratio(bearings, axial, expected):
    """Qi sin(ai)/Fc at 20, 40 and 70 krpm, three or four printed figures: half a unit of the last is up to 0.3 %."""
    assert_allclose([_hirano(bearings, axial, speed) for speed in (20e3, 40e3, 70e3)], expected, rtol=2e-3)


@pytest.mark.parametrize(
    ("speed", "expected"), [(20e3, 214.5), (30e3, 486.9), (40e3, 873.6), (50e3, 1377.7), (60e3, 2002.2), (70e3, 2750.3)]
)
def test_7000c_minimum_preload(bearings, speed, expected):
    """Axial load at which Qi sin(ai)/Fc = 10: 0.03 %."""
    found = brentq(lambda axial: _hirano(bearings, axial, speed) - 10.0, 0.8 * expected, 1.2 * expected, rtol=1e-7)
    assert found == pytest.approx(expected, rel=3e-4)


def _hirano(bearings, axial, speed):
    solution = solve_quasistatic(
        bearings.b7000c, Operation(inner_speed=speed * bearings.rpm, force=(axial, 0.0, 0.0)), OUTER_CONTROL
    )
    assert solution.converged
    return (solution.inner_load * np.sin(solution.inner_contact_angle) / solution.centrifugal_force)[0]

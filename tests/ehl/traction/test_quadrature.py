"""Rules over the ellipse: shares of the load, and the errors that the table of the module states."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl.traction._kernels import hertz_friction
from oilfilm.ehl.traction.friction_coefficients import FourConstants, RampedCoulomb
from oilfilm.ehl.traction.shear import EllipseRule, ellipse_lines, ellipse_nodes

SHAPE = np.array([1e-4, 1.1e-3, 5e-3, 0.5 / 6e-3, 0.0])  # an ellipse of 1 to 11
LOAD = 100.0  # [N]
SPEED = 10.0  # entrainment [m/s]


def forces(nodes, law):
    """Along the rolling direction over mu Q, mu 0.05, at 150 motions with slides and spin up to the curvature slip."""
    rng = np.random.default_rng(70411)
    bend = SPEED / SHAPE[2] * SHAPE[3] * (SHAPE[1] * np.cbrt(LOAD)) ** 2  # largest curvature slip [m/s]
    out, found = np.empty(8), []
    for _ in range(150):
        slide, across, turn = rng.uniform(-1.0, 1.0, 3) * bend
        hertz_friction(
            nodes, law.kernel_law, SHAPE, LOAD, SPEED, slide, 0.1 * across, turn / (SHAPE[1] * np.cbrt(LOAD)), out
        )
        found.append(out[0] / (0.05 * LOAD))
    return np.array(found)


@pytest.mark.parametrize("rule", EllipseRule)
def test_shares_of_the_load_and_second_moments(rule):
    """Hertz' pressure has a mean square of x/a and of y/b of one fifth; the coarsest rings have it to 0.14 %."""
    x, y, share = ellipse_nodes(rule)
    assert_allclose(share.sum(), 1.0, rtol=1e-12)
    assert_allclose([share @ x**2, share @ y**2], 0.2, rtol=2e-3)


@pytest.mark.parametrize(
    ("rule", "coulomb", "constants"),
    [
        (EllipseRule.FORCES, (0.0020, 0.013), (0.0010, 0.0039)),
        (EllipseRule.BALANCE, (0.0028, 0.0092), (0.0008, 0.0033)),
        (EllipseRule.TIME_STEPS, (0.011, 0.052), (0.0095, 0.035)),
    ],
)
def test_errors_are_those_of_the_table(rule, coulomb, constants):
    """Root of the mean square and largest error of the force over mu Q, to the digits printed."""
    laws = (RampedCoulomb(friction=0.05, slide_full=1e-9), FourConstants.of_curve(0.05, 0.03, 0.03))
    for law, printed in zip(laws, (coulomb, constants), strict=True):
        error = forces(ellipse_nodes(rule), law) - forces(ellipse_lines(600, 64), law)
        assert_allclose((np.sqrt(np.mean(error**2)), np.abs(error).max()), printed, rtol=0.06)

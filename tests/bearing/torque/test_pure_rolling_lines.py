"""Lines of pure rolling: closed forms, limits, and quadrature."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from oilfilm.bearing.torque.paper_models import line_curvature, line_force, line_spin_moment, rolling_lines


@pytest.mark.parametrize(
    ("ratio", "second", "spin", "curvature"),
    [
        (0.0, 0.347296, 0.0, 0.161142),
        (0.1, 0.298286, 0.045775, 0.158855),
        (1.0, 0.0, 0.375, 0.0),
        (30.0, 0.0, 0.375, 0.0),
    ],
)
def test_without_a_net_force(ratio, second, spin, curvature):
    """Values computed independently, six digits."""
    lines = rolling_lines(ratio)
    assert lines.second == pytest.approx(second, abs=1e-6)
    assert lines.first == pytest.approx(second + ratio, abs=1e-6)
    assert lines.spin_moment == pytest.approx(spin, abs=1e-6)
    assert lines.curvature == pytest.approx(curvature, abs=1e-6)
    assert lines.force == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(("first", "second"), [(0.5, 0.3), (0.9, -0.4), (1.7, 0.2), (0.2, 0.2)])
def test_closed_forms_are_the_integrals(first, second):
    """Friction 3/4 (1 - y^2) per unit length against the sense of (y - c_1)(y + c_2)."""
    sense = lambda y: np.sign((y - first) * (y + second))  # noqa: E731
    ends = [c for c in (first, -second) if abs(c) < 1.0]
    for power, closed in (
        (0, line_force(first, second)),
        (1, -line_spin_moment(first, second)),
        (2, line_curvature(first, second)),
    ):
        integral = quad(lambda y, n=power: 0.75 * (1 - y * y) * sense(y) * y**n, -1.0, 1.0, points=ends)[0]
        assert closed == pytest.approx(integral, abs=1e-9)


@pytest.mark.parametrize("force", [-0.9, -0.2, 0.4, 0.99])
@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.95, 1.5, 50.0])
def test_lines_carry_the_force(force, ratio):
    assert rolling_lines(ratio, force).force == pytest.approx(force, abs=1e-9)


def test_a_force_beyond_friction():
    with pytest.raises(ValueError, match="force"):
        rolling_lines(0.1, 1.0)

"""Stress in the surface under pressure and shear: circle, ellipse, friction, plane strain, symmetries.

Johnson (1985), sections 4.2 and 7.1, and Hamilton and Goodman (1966): the circle's tension (1 - 2 nu) p_h/3 at the rim,
mu p_h pi (4 + nu)/8 more behind a sliding one, -(1/2 + nu) p_h in the middle; plane strain amid a long strip.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.bearing.contacts.stress import fatigue_damage
from oilfilm.ehl.closed_form.hertz_stress import hertz_edge_tension
from oilfilm.ehl.solid.subsurface import surface_stress

NU = 0.26


def hertz(points, ratio=1.0):
    """Pressure over an ellipse of semi-axes 1 and `ratio`, its axes and steps."""
    x = np.linspace(-1.6, 1.6, points)
    y = ratio * np.linspace(-1.6, 1.6, points)
    p = np.sqrt(np.maximum(0.0, 1.0 - x[:, None] ** 2 - (y[None, :] / ratio) ** 2))
    return p, x, y, (x[1] - x[0], y[1] - y[0])


def solved(points, ratio=1.0, mu=0.0, nu=NU):
    p, x, y, steps = hertz(points, ratio)
    return surface_stress(p, (mu * p, 0.0 * p), steps, nu), x, y


def test_edge_tension_of_circle_and_ellipse():
    """Continuous at the circle; Johnson's two forms evaluated apart at a ratio of 4."""
    assert hertz_edge_tension((1.0, 1.0), 3.0, NU) == pytest.approx((0.48, 0.48))
    near = hertz_edge_tension((1.0, 1.0 + 1e-4), 3.0, NU)
    assert near == pytest.approx((0.48, 0.48), rel=1e-4)
    ends = hertz_edge_tension((1.0, 4.0), 1.0, NU)
    e = np.sqrt(15.0) / 4.0
    scale = (1.0 - 2.0 * NU) * 0.25 / e**2
    assert ends[1] == pytest.approx(scale * (np.arctanh(e) / e - 1.0))
    assert ends[0] == pytest.approx(scale * (1.0 - 0.25 / e * np.arctan(4.0 * e)))
    assert hertz_edge_tension((4.0, 1.0), 1.0, NU) == pytest.approx(ends[::-1])


def test_middle_of_a_circle():
    stress, x, _ = solved(257)
    middle = x.size // 2
    for part in (stress.xx, stress.yy):
        assert part[middle, middle] == pytest.approx(-(0.5 + NU), rel=2e-3)


@pytest.mark.parametrize("ratio", [1.0, 4.0, 8.0])
@pytest.mark.parametrize("points", [65, 129, 257])
def test_four_differences_enclose_the_rim(ratio, points):
    """The slope at the rim is vertical, the error falls like the square root of the mesh: four differences cover it."""
    exact = max(hertz_edge_tension((1.0, ratio), 1.0, NU))
    fine, coarse = (float(solved(n, ratio)[0].tension.max()) for n in (points, points // 2 + 1))
    assert abs(fine - exact) < 4.0 * abs(fine - coarse)
    assert fine == pytest.approx(exact, rel=0.25)


def test_friction_pulls_behind():
    """mu 0.1 on a circle: (1 - 2 nu)/3 + 0.1 pi (4 + nu)/8 at the rear end, four differences enclosing it."""
    exact = (1.0 - 2.0 * NU) / 3.0 + 0.1 * pi * (4.0 + NU) / 8.0
    values = []
    for points in (129, 257):
        stress, x, y = solved(points, mu=0.1)
        i, j = np.unravel_index(stress.tension.argmax(), stress.tension.shape)
        assert x[i] == pytest.approx(-1.0, abs=0.05)
        assert abs(y[j]) < 0.4
        values.append(stress.tension.max())
    assert values[1] == pytest.approx(exact, rel=0.08)
    assert abs(values[1] - exact) < 4.0 * abs(values[1] - values[0])


def test_long_strip_is_in_plane_strain():
    """Line contact, in the middle of its length: sigma_x = -p + 2 mu x under the strip, sigma_y = nu (sigma_x - p)."""
    x = np.linspace(-1.6, 1.6, 257)
    y = np.linspace(-60.0, 60.0, 257)
    p = np.repeat(np.sqrt(np.maximum(0.0, 1.0 - x**2))[:, None], y.size, axis=1)
    stress = surface_stress(p, (-0.1 * p, 0.0 * p), (x[1] - x[0], y[1] - y[0]), NU)
    inside = abs(x) < 0.7
    along = stress.xx[inside, y.size // 2]
    assert along == pytest.approx(-p[inside, 0] + 0.2 * x[inside], abs=0.012)
    across = stress.yy[inside, y.size // 2]
    assert across == pytest.approx(NU * (along - p[inside, 0]), abs=0.02)


def test_directions_are_alike():
    """A shear along y is one along x with the axes exchanged; uniform tension adds as it is."""
    p, _, _, steps = hertz(65)
    along = surface_stress(p, (0.2 * p, 0.0 * p), steps, NU)
    across = surface_stress(p.T, (0.0 * p, 0.2 * p.T), steps[::-1], NU)
    assert across.yy == pytest.approx(along.xx.T, abs=1e-12)
    assert across.xx == pytest.approx(along.yy.T, abs=1e-12)
    assert across.xy == pytest.approx(along.xy.T, abs=1e-12)
    assert replace(along, xx=0.0 * p + 2.0, yy=0.0 * p, xy=0.0 * p).tension.max() == 2.0


def test_fatigue_damage_of_a_dry_contact_is_one_and_a_pull_along_rolling_raises_it():
    """The pressure of Hertz itself; a flatter pressure of the same load spares the depth; half the mesh, 3 %."""
    found = {}
    for points in (65, 129):
        p, x, y, _ = hertz(points, 2.0)
        contact = SimpleNamespace(semi_axis_x=1.0, semi_axis_y=2.0, pressure=1.0)
        flat = np.where(p > 0.0, 2.0 / 3.0, 0.0)
        films = [SimpleNamespace(x=x, y=y, pressure=pressure) for pressure in (p, flat)]
        found[points] = [fatigue_damage(film, contact, NU, hoop) for film in films for hoop in (0.0, 0.02)]
    same, pulled, flat, _ = found[129]
    assert same == pytest.approx(1.0, abs=1e-12)
    assert 1.0 < pulled < 1.4
    assert flat < 1.0
    assert found[65] == pytest.approx(found[129], rel=0.03)  # the flat one ends steeply

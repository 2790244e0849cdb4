"""What the rolling moment leaves out far from a contact: rupture, the meniscus, Reynolds' equation in circles.

A rigid sphere on a plane has fields P = p(r) cos(phi), here in units of its radius and 12 eta u, positive ahead.
"""

from __future__ import annotations

from math import log, pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import solve_banded
from scipy.optimize import brentq

START = 0.02  # of the radius: Kapitza's pressure there


def parabola(r):
    return 0.5 * r**2, r


def circle(r):
    root = np.sqrt(1.0 - r**2)
    return 1.0 - root, r / root


def kapitza(r, gap):
    """x/(5 h^2), the solution in a paraboloid."""
    return r / (5.0 * gap(r)[0] ** 2)


def moment(p, r):
    """Over pi, of a field p(r) cos(phi)."""
    return np.trapezoid(p * r**3, np.log(r))


def reynolds(gap, end, nodes=4001):
    """(h^3 p_s)_s - h^3 p = -r^2 h', s = ln r: p(START) of Kapitza, no pressure at the end."""
    r = np.geomspace(START, end, nodes)
    step = log(r[1] / r[0])
    faces = gap(np.sqrt(r[1:] * r[:-1]))[0] ** 3 / step**2
    film, slope = gap(r)
    bands = np.zeros((3, nodes))
    bands[0, 2:], bands[2, :-2] = faces[1:], faces[:-1]
    bands[1, 1:-1] = -faces[1:] - faces[:-1] - film[1:-1] ** 3
    bands[1, 0] = bands[1, -1] = 1.0
    wanted = -(r**2) * slope
    wanted[0], wanted[-1] = kapitza(r[0], gap), 0.0
    return r, solve_banded((1, 1), bands, wanted)


def test_meniscus_of_a_uniform_layer_under_a_sphere():
    """With no pressure at a circle the field is (r^-3 - r_2^-sqrt(10) r^(sqrt(10) - 3)) cos(phi): there the flow ahead
    is 1 - sqrt(10)/5 of the gap at every angle, a uniform layer, and the moment is that of Kapitza up to
    exp(-1/sqrt(10)) of the distance."""
    end = 0.2
    r, p = reynolds(parabola, end)
    flow = 1.0 + parabola(end)[0] ** 2 * (p[-1] - p[-2]) / log(r[-1] / r[-2]) / end
    assert_allclose(flow, 1.0 - sqrt(10.0) / 5.0, rtol=2e-3)  # a one-sided difference
    lost = (moment(kapitza(r, parabola), r) - moment(p, r)) / 0.8  # Kapitza's per logarithm of the distance
    assert_allclose(lost, 1.0 / sqrt(10.0), rtol=2e-3)
    assert_allclose(np.exp(-2.0 / sqrt(10.0)) / (1.0 - sqrt(10.0) / 5.0), 1.446, rtol=1e-3)


@pytest.mark.parametrize(("end", "expected"), [(0.1, 0.002), (0.2, 0.006), (0.3, 0.012), (0.5, 0.028)])
def test_kapitza_over_the_gap_of_a_circle(end, expected):
    """His moment less that of Reynolds' equation in the same gap, up to shares of the radius."""
    r, p = reynolds(circle, 0.95, 16001)
    within = r <= end
    ratio = moment(kapitza(r, circle)[within], r[within]) / moment(p[within], r[within])
    assert_allclose(ratio - 1.0, expected, atol=0.0006)


@pytest.mark.parametrize(("radius_ratio", "expected"), [(1.0, 1.0138), (1.0 / 45.0, 1.0346)])
def test_rupture_adds_little_to_kapitzas_moment(radius_ratio, expected):
    """r^-3 f with pressure and slope zero where the film ends, against the positive half of Kapitza's pressure."""
    phi = np.linspace(0.0, pi, 1501)
    half = _rupturing(phi, radius_ratio)
    gap = np.cos(phi) ** 2 + radius_ratio * np.sin(phi) ** 2
    kapitza = np.maximum(4.0 * np.cos(phi) / ((3.0 + 2.0 * radius_ratio) * gap**2), 0.0)
    ratio = np.trapezoid(half * np.cos(phi), phi) / np.trapezoid(kapitza * np.cos(phi), phi)
    assert_allclose(ratio, expected, rtol=2e-4)
    if radius_ratio == 1.0:  # f = 0.8 cos + A cosh(3 phi), orthogonal to cos
        end = brentq(lambda angle: np.sin(angle) + 3.0 * np.cos(angle) * np.tanh(3.0 * angle), 1.7, 2.0)
        assert_allclose(ratio, (end + np.sin(end) * np.cos(end)) / (0.5 * pi), rtol=1e-4)


def _rupturing(phi, radius_ratio):
    """f(phi) of (q^3 f')' - 9 q^3 f = -8 cos(phi), f >= 0, phi from the inlet's direction; lambda S = 1."""
    step = phi[1]
    cube = (np.cos(phi) ** 2 + radius_ratio * np.sin(phi) ** 2) ** 3
    middle = phi[:-1] + 0.5 * step
    faces = (np.cos(middle) ** 2 + radius_ratio * np.sin(middle) ** 2) ** 3 / step**2
    below, above = np.append(0.0, faces), np.append(faces, 0.0)
    below[-1], above[0] = 2.0 * below[-1], 2.0 * above[0]
    diagonal, wanted = below + above + 9.0 * cube, 8.0 * np.cos(phi)
    full = np.ones(phi.size, dtype=bool)
    for _ in range(phi.size):
        bands = np.zeros((3, phi.size))
        bands[1] = np.where(full, diagonal, 1.0)
        bands[0, 1:], bands[2, :-1] = np.where(full, -above, 0.0)[:-1], np.where(full, -below, 0.0)[1:]
        f = solve_banded((1, 1), bands, np.where(full, wanted, 0.0))
        rest = diagonal * f - wanted
        rest[:-1] -= above[:-1] * f[1:]
        rest[1:] -= below[1:] * f[:-1]
        now = np.where(full, f > 0.0, rest < 0.0)
        if np.array_equal(now, full):
            return f
        full = now
    raise AssertionError("the active set did not settle")

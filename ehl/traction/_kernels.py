"""Compiled kernels of traction: sums over the nodes of a film, and lookups that dynamics calls at every step.

Everything is arrays and floats in SI. The NumPy twins stand in `quadrature.py`, `table.py` and `laws.py`.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from ..rheology._kernels import shear_stress

OPTIONS = {"cache": True, "nogil": True, "fastmath": False, "error_model": "numpy"}
COLUMNS = 4  # of a table's values: F_x, F_y, M_n, M_y of sliding, over the film's largest force and moments
SCALARS = 10  # of a table's films: logarithms of three scales, film, hydrodynamic moment, stiffness, damping, largest
SPIN_SHARE = 0.5  # as in `table`
BELOW_LOAD, ABOVE_LOAD, BELOW_SPEED, ABOVE_SPEED, SLIDE_X, SLIDE_Y, SPIN = 1, 2, 4, 8, 16, 32, 64


@njit(**OPTIONS)
def sliding_sums(nodes, law, stress, exponent, breadth, slide_x, slide_y, spin, rolling, curvature, width, out):
    """Forces and moments on body 1 by sliding: F_x, F_y, M_n, M_y.

    nodes, shape (6, n): x, y, area times sheared width, film, viscosity, limiting stress. curvature: 1/(2R) of the
    surface over +-width across.
    """
    f_x = f_y = m_n = m_y = 0.0
    for k in range(nodes.shape[1]):
        x, y = nodes[0, k], nodes[1, k]
        bend = curvature * min(y * y, width * width)
        s_x = slide_x - spin * y - rolling * bend
        s_y = slide_y + spin * x
        s = np.sqrt(s_x * s_x + s_y * s_y)
        if s <= 0.0:
            continue
        tau = shear_stress(s / nodes[3, k], nodes[4, k], nodes[5, k], law, stress, exponent, breadth)
        pull = nodes[2, k] * tau / s
        t_x, t_y = pull * s_x, pull * s_y
        f_x -= t_x
        f_y -= t_y
        m_n += y * t_x - x * t_y
        m_y += bend * t_x
    out[0], out[1], out[2], out[3] = f_x, f_y, m_n, m_y


@njit(**OPTIONS)
def sliding_sums_many(nodes, law, stress, exponent, breadth, slide_x, slide_y, spin, rolling, curvature, width, out):
    """`sliding_sums` for each of n motions given as arrays, out of shape (n, 4)."""
    for k in range(slide_x.size):
        sliding_sums(
            nodes, law, stress, exponent, breadth, slide_x[k], slide_y[k], spin[k], rolling[k], curvature, width, out[k]
        )


@njit(**OPTIONS)
def _weights(place, axis, w):
    """Uniform cubic B-spline weights at a place on an axis (start, nodes per unit, nodes); returns the first index."""
    n = int(axis[2])
    t = (place - axis[0]) * axis[1]
    i = min(max(int(np.floor(t)), 0), n - 2)
    t -= i
    r = 1.0 - t
    w[0] = r * r * r / 6.0
    w[1] = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0
    w[2] = (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0
    w[3] = t * t * t / 6.0
    return i


@njit(**OPTIONS)
def _clamped(place, axis):
    """The nearest place on an axis, and -1, 0, 1 where the place lies before, on, or beyond it."""
    last = axis[0] + (axis[2] - 1.0) / axis[1]
    if place < axis[0]:
        return axis[0], -1 if place < axis[0] - 1e-12 else 0
    if place > last:
        return last, 1 if place > last + 1e-12 else 0
    return place, 0


@njit(**OPTIONS)
def vertex_slide(spin, b_axis, radius_x, curvature):
    """Sliding at the vertex of the parabola -Omega y - omega y^2/(2R), near enough to the ellipse, over u.

    spin is Omega R_x/u; the vertex y = -Omega R/omega is drawn back to less than the semi-axis.
    """
    if curvature <= 0.0:
        return 0.0
    far = 0.5 * spin / (curvature * b_axis)
    share = far / np.sqrt(1.0 + far * far)
    return b_axis / radius_x * (spin * share - curvature * b_axis * share * share)


@njit(**OPTIONS)
def _motion_weights(axes, constants, scalars, log_load, motion, w):
    """Weights along the axes of the motions and where they begin; returns the flags of what lies outside."""
    top_x, top_y, turn = motion
    b_axis = constants[5] * np.exp(log_load / 3.0)
    top_x += vertex_slide(turn, b_axis, constants[0], constants[6])
    scale_x = np.hypot(np.exp(scalars[0]), SPIN_SHARE * turn * b_axis / constants[0])
    scale_y, scale_n = np.exp(scalars[1]), np.exp(scalars[2])
    x, side_x = _clamped(np.arcsinh(top_x / scale_x) / np.arcsinh(constants[2] / scale_x), axes[2])
    y, side_y = _clamped(np.arcsinh(top_y / scale_y) / np.arcsinh(constants[3] / scale_y), axes[3])
    n, side_n = _clamped(np.arcsinh(turn / scale_n) / np.arcsinh(constants[4] / scale_n), axes[4])
    w[5, 0], w[5, 1], w[5, 2] = _weights(x, axes[2], w[2]), _weights(y, axes[3], w[3]), _weights(n, axes[4], w[4])
    return (SLIDE_X if side_x != 0 else 0) + (SLIDE_Y if side_y != 0 else 0) + (SPIN if side_n != 0 else 0)


@njit(**OPTIONS)
def _spline_sum(values, i0, i1, i2, i3, i4, w, out):
    """Sum of the 4^5 coefficients around a place, weighted along each axis."""
    t0 = t1 = t2 = t3 = 0.0
    n0, n1, n2, n3 = w[4, 0], w[4, 1], w[4, 2], w[4, 3]
    for a in range(4):
        for b in range(4):
            w01 = w[0, a] * w[1, b]
            for c in range(4):
                w012 = w01 * w[2, c]
                for d in range(4):
                    v = values[i0 + a, i1 + b, i2 + c, i3 + d]
                    weight = w012 * w[3, d]
                    t0 += weight * (n0 * v[i4, 0] + n1 * v[i4 + 1, 0] + n2 * v[i4 + 2, 0] + n3 * v[i4 + 3, 0])
                    t1 += weight * (n0 * v[i4, 1] + n1 * v[i4 + 1, 1] + n2 * v[i4 + 2, 1] + n3 * v[i4 + 3, 1])
                    t2 += weight * (n0 * v[i4, 2] + n1 * v[i4 + 1, 2] + n2 * v[i4 + 2, 2] + n3 * v[i4 + 3, 2])
                    t3 += weight * (n0 * v[i4, 3] + n1 * v[i4 + 1, 3] + n2 * v[i4 + 2, 3] + n3 * v[i4 + 3, 3])
    out[0], out[1], out[2], out[3] = t0, t1, t2, t3


@njit(**OPTIONS)
def table_lookup(axes, constants, scalars, values, load, speed, slide_x, slide_y, spin, out):
    """Traction of a contact from its table; returns 0, or the sum of flags of what lay outside the table's range.

    axes, shape (5, 3): start, nodes per unit, nodes of ln(load), ln(speed) and the three scaled motions. constants:
    R_x, curvature difference, largest slide_x/speed, slide_y/speed, spin R_x/speed, transverse semi-axis at 1 N,
    1/(2R). scalars, shape (nQ + 2, nU + 2, 10), values, shape (nQ + 2, nU + 2, nX + 2, nY + 2, nS + 2, 4):
    B-spline coefficients. out, 8 numbers: F_x, F_y on body 1 [N], M_n, M_y on body 1 [N m], power lost [W], central
    film [m], stiffness [N/m], damping [N s/m]. Outside, the nearest place in the table counts, forces per load.
    """
    flag = 0
    q, side = _clamped(np.log(max(load, 1e-300)), axes[0])
    flag += BELOW_LOAD if side < 0 else (ABOVE_LOAD if side > 0 else 0)
    u, side = _clamped(np.log(max(speed, 1e-300)), axes[1])
    flag += BELOW_SPEED if side < 0 else (ABOVE_SPEED if side > 0 else 0)
    w = np.empty((6, 4))  # weights along each axis, and where those of the motions begin
    i0, i1 = _weights(q, axes[0], w[0]), _weights(u, axes[1], w[1])
    s = np.zeros(SCALARS)
    for a in range(4):
        for b in range(4):
            weight = w[0, a] * w[1, b]
            for c in range(SCALARS):
                s[c] += weight * scalars[i0 + a, i1 + b, c]
    mirror = 1.0 if slide_y >= 0.0 else -1.0
    size = max(abs(speed), 1e-300)
    t = np.zeros(COLUMNS)
    motion = (slide_x / size, abs(slide_y) / size, mirror * spin * constants[0] / size)
    flag += _motion_weights(axes, constants, s, q, motion, w)
    _spline_sum(values, i0, i1, int(w[5, 0]), int(w[5, 1]), int(w[5, 2]), w, t)
    force, per_load = np.exp(s[7]), load / np.exp(q)
    force_x, force_y = t[0] * force * per_load, mirror * t[1] * force * per_load
    moment_n, moment_y = mirror * t[2] * np.exp(s[8]) * per_load, t[3] * np.exp(s[9]) * per_load
    hydrodynamic = -np.exp(s[4]) * per_load
    rolling = speed / constants[0] - 0.5 * constants[1] * slide_x
    out[0] = force_x + 0.5 * constants[1] * hydrodynamic
    out[1] = force_y
    out[2] = moment_n
    out[3] = moment_y + hydrodynamic
    out[4] = -(out[0] * slide_x + force_y * slide_y + moment_n * spin + out[3] * rolling)
    out[5], out[6], out[7] = np.exp(s[3]), np.exp(s[5]), np.exp(s[6])
    return flag


@njit(**OPTIONS)
def hertz_friction(disc, law, constants, load, speed, slide_x, slide_y, spin, out):
    """Friction over the Hertz ellipse with a coefficient that depends on the local sliding; out as `table_lookup`.

    disc, shape (3, n): x/a, y/b, share of the load. law: kind (0 Coulomb, 1 four constants), then Coulomb's
    coefficient, v_0, v_1 [m/s] or A, B, C, D, and v_0. constants: semi-axes x and y at 1 N, R_x, 1/(2R), curvature
    difference. Film, stiffness and damping are zero.
    """
    third = np.cbrt(max(load, 0.0))
    a, b = constants[0] * third, constants[1] * third
    rolling = speed / constants[2] - 0.5 * constants[4] * slide_x
    f_x = f_y = m_n = m_y = 0.0
    for k in range(disc.shape[1]):
        x, y = a * disc[0, k], b * disc[1, k]
        bend = constants[3] * y * y
        s_x, s_y = slide_x - spin * y - rolling * bend, slide_y + spin * x
        s = np.sqrt(s_x * s_x + s_y * s_y)
        if s <= 0.0:
            continue
        pull = disc[2, k] * load * coefficient(law, s, speed) / s
        f_x -= pull * s_x
        f_y -= pull * s_y
        m_n += pull * (y * s_x - x * s_y)
        m_y += pull * bend * s_x
    out[0], out[1], out[2], out[3] = f_x, f_y, m_n, m_y
    out[4] = -(f_x * slide_x + f_y * slide_y + m_n * spin + m_y * rolling)
    out[5] = out[6] = out[7] = 0.0
    return 0


@njit(**OPTIONS)
def coefficient(law, slide, speed):
    """Friction coefficient at a local sliding speed [m/s] and an entrainment speed [m/s]."""
    if law[0] == 0.0:
        low, high = law[2], law[3]
        if slide <= low:
            return 0.0
        return law[1] if slide >= high else law[1] * (slide - low) / (high - low)
    ratio = slide / max(abs(speed), 1e-300)
    ramp = 1.0 if ratio >= law[5] else ratio / law[5]
    return ramp * ((law[1] + law[2] * ratio) * np.exp(-law[3] * ratio) + law[4])

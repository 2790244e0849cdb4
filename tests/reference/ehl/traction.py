"""Sliding forces of a film, friction over the Hertz ellipse and lookups in traction tables, in NumPy."""

from __future__ import annotations

from math import exp, log

import numpy as np

from oilfilm.ehl.oil.shear_stress import limited, shear_stress
from oilfilm.ehl.traction.friction_coefficients import RampedCoulomb
from oilfilm.ehl.traction_table.compression import whole_numbers
from oilfilm.ehl.traction_table.splines import spline_weights
from oilfilm.ehl.traction_table.table import (
    COORDINATE_TERMS,
    at_vertex,
    load_coordinate,
    motion_coordinate,
    spinning_scales,
    vertex_slide,
)


def sliding_forces(film, kinematics):
    """`film_quadrature.sliding_forces` of one motion, shape (4,), [N] and [N m]."""
    x, y, area, gap, eta, limit, spread_x, spread_y = film.nodes
    sliding = mean_sliding(kinematics, x, y, (spread_x, spread_y))
    tau = shear_stress(sliding[2] / gap, eta, 0.0 * eta, film.rheology.unlimited)
    tau = limited(tau, limit, film.rheology.law)
    return summed_forces(kinematics, (x, y, area), tau, sliding)


def mean_sliding(kinematics, x, y, spread):
    """Sliding at nodes along x, across as its mean over the node's strip counts, and the mean of its size [m/s].

    spread: a twelfth of the nodes' squared size along x and y.
    """
    k = kinematics
    s_x, s_y = k.sliding(x, y)
    slope = k.spin + 2.0 * k.rolling * k.curvature * np.where(np.abs(y) < k.curvature_width, y, 0.0)
    return s_x, *over_strip(s_x, s_y, slope * np.sqrt(12.0 * spread[1]), k.spin**2 * spread[0])


def over_strip(s_x, s_y, change, further):
    """Sliding across and size [m/s] of nodes whose s_x changes by so much over their strips; further: mean square of
    the change of s_y along x.

    The size is the mean of those on both sides, the mean of s_y/s of a constant stress s_y artanh(z)/(z size), z half
    the change over the size; artanh(z)/z as the second convergent of its continued fraction.
    """
    sides = [np.sqrt((s_x + part * change) ** 2 + s_y**2 + further) for part in (-0.5, 0.5)]
    size = 0.5 * (sides[0] + sides[1])
    q = (0.5 * change / np.where(size > 0.0, size, 1.0)) ** 2
    return s_y / (1.0 - q / (3.0 - 4.0 * q / 5.0)), size


def summed_forces(kinematics, nodes, stress, sliding):
    """F_x, F_y [N] and M_n, M_y [N m] on body 1, shape (4,), of stresses [Pa] at nodes x, y, area."""
    (x, y, area), (s_x, s_y, speed) = nodes, sliding
    pull = area * stress / np.where(speed > 0.0, speed, 1.0)
    t_x, t_y = pull * s_x, pull * s_y
    return np.array([-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), -(kinematics.curvature_height(y) * t_x).sum()])


def law_forces(law, load, speed, slide_x, slide_y, spin):
    """F_x, F_y [N], M_n, M_y [N m] of a coefficient over the Hertz ellipse, as `law.forces`."""
    a, b, radius, curvature, difference = law.shape.constants
    x, y, share = law.kernel_arguments()[0] * np.array([[a * np.cbrt(load)], [b * np.cbrt(load)], [load]])
    rolling = speed / radius - 0.5 * difference * slide_x
    s_x = slide_x - spin * y - rolling * curvature * y * y
    s_y = slide_y + spin * x
    s = np.hypot(s_x, s_y)
    pull = share * coefficient(law.coefficient, s, speed) / np.where(s > 0.0, s, 1.0)
    t_x, t_y = pull * s_x, pull * s_y
    return np.array([-t_x.sum(), -t_y.sum(), (y * t_x - x * t_y).sum(), (curvature * y * y * t_x).sum()])


def coefficient(law, slide, speed):
    """Coefficient of friction [-] of a law at a local sliding speed and an entrainment speed [m/s]."""
    if isinstance(law, RampedCoulomb):
        return law.friction * np.clip((slide - law.slide_none) / (law.slide_full - law.slide_none), 0.0, 1.0)
    s = slide / max(abs(speed), 1e-300)
    return np.minimum(s / law.dead_band, 1.0) * ((law.a + law.b * s) * np.exp(-law.c * s) + law.d)


def table_forces(table, load, speed, slide_x, slide_y, spin, whole=True):
    """F_x, F_y, M_n, M_y, power, film, stiffness, damping as `table.forces`, within its range; whole: by the whole
    numbers of lookups, else by the table's own.
    """
    scalars, values = table.scalars, table.values.astype(float)
    if whole:
        numbers, unit = whole_numbers(table.values)
        values = unit * with_ends(with_ends(np.moveaxis(numbers, (3, 4), (0, 1)), 0), 1)
    for axis, place in enumerate((load_coordinate(load), log(speed))):
        scalars, values = (along_first(part, place, table.axes[axis]) for part in (scalars, values))
    radius, difference, *limits = table.constants[:5]
    mirror = 1.0 if slide_y >= 0.0 else -1.0
    turn = mirror * spin * radius / speed
    shift = vertex_slide(np.asarray(turn), table.contact, load)
    top = float(at_vertex(np.asarray(slide_x / speed), shift, limits[0]))
    scales = np.exp(scalars[:3])
    scales[:2] = spinning_scales(tuple(scales[:2]), np.asarray(turn), table.contact, load)
    motion = (top, abs(slide_y) / speed, turn)
    for axis, (part, scale, limit) in enumerate(zip(motion, scales, limits, strict=True)):
        place = float(motion_coordinate(np.asarray(part), scale, limit, COORDINATE_TERMS[axis]))
        values = along_first(values, place, table.axes[2 + axis])
    hydrodynamic = -exp(scalars[4])
    force = np.array([values[0], mirror * values[1]]) * exp(scalars[7])
    force[0] += 0.5 * difference * hydrodynamic
    moment = np.array([mirror * values[2] * exp(scalars[8]), values[3] * exp(scalars[9]) + hydrodynamic])
    rolling = speed / radius - 0.5 * difference * slide_x
    power = -(force @ [slide_x, slide_y] + moment @ [spin, rolling])
    return np.array([*force, *moment, power, exp(scalars[3]), exp(scalars[5]), exp(scalars[6])])


def with_ends(inner, axis):
    """Coefficients along an axis with those beyond its ends, where the third derivative is continuous at the second and
    the last but one node.
    """
    c = np.moveaxis(inner.astype(float), axis, 0)
    first = 4.0 * c[0] - 6.0 * c[1] + 4.0 * c[2] - c[3]
    last = 4.0 * c[-1] - 6.0 * c[-2] + 4.0 * c[-3] - c[-4]
    return np.moveaxis(np.concatenate([first[None], c, last[None]]), 0, axis)


def along_first(coefficients, place, axis):
    """Spline along the first axis at a place of that axis."""
    first, weights = spline_weights((place - axis[0]) * axis[1], int(axis[2]))
    return np.tensordot(weights, coefficients[first : first + 4], axes=1)


def largest_force(table, load, speed):
    """Of a table's film at load [N] and speed [m/s] by sliding along or across it, of 60 slides each [N]."""
    shares = speed * np.geomspace(1e-5, 1.0, 60)
    along = [table.forces(load, speed, one * table.range.slide_x, 0.0, 0.0).force_x for one in shares]
    across = [table.forces(load, speed, 0.0, one * table.range.slide_y, 0.0).force_y for one in shares]
    return float(np.abs([along, across]).max())

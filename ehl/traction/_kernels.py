"""Compiled kernels of traction: sums over the nodes of a film, and lookups that dynamics calls at
every step.

Everything is arrays and floats in SI. The NumPy twins stand in `tests/reference/ehl`.
"""

import numpy as np

from ..compiled import compiled
from ..oil._rheology_kernels import inverse_sine
from ._spline_kernels import inner_weights, row_sums, spline_sum, spline_weights
from .coefficient_kernels import coefficient as coefficient_formula

# rows of the nodes of a film; spread: a twelfth of the squared size
X, Y, AREA, FILM, VISCOSITY, LIMIT, SPREAD_X, SPREAD_Y = range(8)
# of a table's films, logarithms: scales of the motions, central film, hydrodynamic moment,
# response, largest force and moments of sliding
SCALE_X, SCALE_Y, SCALE_SPIN, CENTRAL_FILM, HYDRODYNAMIC = range(5)
STIFFNESS, DAMPING, LARGEST_FORCE, LARGEST_SPIN, LARGEST_ROLLING = range(5, 10)
# of a table's constants: bodies, range of the motions, transverse semi-axis at 1 N, 1/(2R), unit
# of its whole numbers, semi-axis along the rolling direction at 1 N, `TractionTable.spacing`,
# entrainment that sliding is taken over at least
RADIUS_X, DIFFERENCE, RANGE_X, RANGE_Y, RANGE_SPIN, UNIT_AXIS, CURVATURE, VALUE_UNIT = range(8)
UNIT_AXIS_X, SPACING_LIMIT, SPACING_SPIN, SPACING_REST, LEAST_SPEED = range(8, 13)
# of the shape of an ellipse: semi-axes at 1 N, R_x, 1/(2R), curvature difference of the bodies
SHAPE_AXIS_X, SHAPE_AXIS_Y, SHAPE_RADIUS_X, SHAPE_CURVATURE, SHAPE_DIFFERENCE = range(5)
LOAD_POWER = -0.2  # of the load in its coordinate
# chosen by trial on tables with heat of both races of a 6208 [-]: the sliding by spin at the end
# of the ellipse in the scale of slide_x, and of slide_y; the further part of a place
SPIN_SHARE = 0.3
SPIN_SHARE_Y = 0.15
LIMIT_SHARE = 0.1
# share of the entrainment below which the slow body's own takes up heat no more as its root
REST_SHARE = 0.005
STANDING = 2.0  # slide over the entrainment speed at which one body stands still [-]
# twice the shift of slide_x over its reach stays below the inverse: chosen, any above 1 will do
SHIFT_MARGIN = 1.1 * 2.0
TINY = np.finfo(np.float64).tiny
# flags of what lies outside a table's range
BELOW_LOAD, ABOVE_LOAD, BELOW_SPEED, ABOVE_SPEED = (1 << bit for bit in range(4))
SLIDE_X, SLIDE_Y, SPIN = (1 << bit for bit in range(4, 7))

coefficient = compiled(coefficient_formula)


@compiled
def _clamped(place, axis):
    """The nearest place on an axis, and -1, 0, 1 where the place lies before, on, or beyond it."""
    last = axis[0] + (axis[2] - 1.0) / axis[1]
    if place < axis[0]:
        return axis[0], -1 if place < axis[0] - 1e-12 else 0
    if place > last:
        return last, 1 if place > last + 1e-12 else 0
    return place, 0


@compiled
def vertex_slide(spin, b_axis, radius_x, curvature):
    """Sliding over u at the vertex of the parabola -Omega y - omega y^2/(2R), at y = -Omega
    R/omega but no farther out than the semi-axis; spin is Omega R_x/u.
    """
    if curvature <= 0.0:
        return 0.0
    far = 0.5 * spin / (curvature * b_axis)
    share = far / np.sqrt(np.sqrt(1.0 + far * far * far * far))
    return b_axis / radius_x * (spin * share - curvature * b_axis * share * share)


@compiled
def _scaled(motion, scale, limit, axis, part, weight):
    """Place of a motion on its axis, at most the end, and whether it lies beyond it; part: the
    further one by its weight, see `table.coordinates`.
    """
    share = inverse_sine(abs(motion) / scale) / inverse_sine(limit / scale)
    share = (1.0 - weight) * share + weight * part
    place, side = _clamped(np.copysign(share, motion), axis)
    return place, side != 0


@compiled
def _motion_scale(scale, turn, b_axis, constants):
    """Scale of slide_x at a spin, see `table.spinning_scale`."""
    far = 0.5 * turn
    slope = constants[CURVATURE] * b_axis
    steep = far * far * far * far
    curved = slope * slope * slope * slope
    share = SPIN_SHARE * steep / (steep + curved + TINY)
    spread = share * turn * b_axis / constants[RADIUS_X]
    return np.sqrt(scale * scale + spread * spread)


@compiled
def _film_values(scalars, load, speed, film):
    """What splines over load and speed have logarithms of, all columns at once, into film; load,
    speed: first coefficient and weights.
    """
    i0, w0 = load
    i1, w1 = speed
    columns = scalars.shape[2]
    film[:columns] = 0.0
    for a in range(4):
        for b in range(4):
            weight = w0[a] * w1[b]
            for k in range(columns):
                film[k] += weight * scalars[i0 + a, i1 + b, k]
    for k in range(columns):
        film[k] = np.exp(film[k])


@compiled
def _standing_part(size, rest):
    """See `table.coordinates.standing_part`."""
    return np.sqrt(1.0 + rest) - np.sqrt(1.0 + rest - min(size / STANDING, 1.0))


@compiled
def _fading_shift(shift, slide, limit):
    """What `table.coordinates.at_vertex` adds to a slide."""
    reach = min(limit, STANDING)
    share = min(abs(slide) / reach, 1.0)
    over = (SHIFT_MARGIN * shift / reach) ** 2
    over = over * over * over * over
    return shift / np.sqrt(np.sqrt(np.sqrt(1.0 + over))) * (1.0 - share * share)


@compiled
def _motion_places(film, axes, constants, motions, load):
    """Places of slide_x and slide_y over u and spin over u/R_x on their axes, by the scales of the
    film, and the flags of those beyond.
    """
    slide_x, slide_y, turn = motions
    root = np.cbrt(load)
    b_axis = constants[UNIT_AXIS] * root
    weight = constants[SPACING_LIMIT]
    limit_x = constants[RANGE_X]
    limit_y = constants[RANGE_Y]
    shift = vertex_slide(turn, b_axis, constants[RADIUS_X], constants[CURVATURE])
    top = slide_x + _fading_shift(shift, slide_x, limit_x)
    scale = _motion_scale(film[SCALE_X], turn, b_axis, constants)
    rest = constants[SPACING_REST]
    part = _standing_part(min(abs(top), limit_x), rest) / _standing_part(limit_x, rest)
    x, beyond_x = _scaled(top, scale, limit_x, axes[2], part, weight)
    spread = constants[SPACING_SPIN] * turn * constants[UNIT_AXIS_X] * root / constants[RADIUS_X]
    scale = np.hypot(film[SCALE_Y], spread)
    part = min(abs(slide_y) / limit_y, 1.0)
    y, beyond_y = _scaled(slide_y, scale, limit_y, axes[3], part, weight)
    scale = film[SCALE_SPIN]
    n, beyond_n = _scaled(turn, scale, constants[RANGE_SPIN], axes[4], 0.0, 0.0)
    flag = (SLIDE_X if beyond_x else 0) + (SLIDE_Y if beyond_y else 0)
    return x, y, n, flag + (SPIN if beyond_n else 0)


@compiled
def table_lookup(axes, constants, scalars, values, load, speed, slide_x, slide_y, spin, out):
    """Traction of a contact from its table; returns 0, or the sum of flags of what lay outside the
    table's range.

    axes, shape (5, 3): start, nodes per unit, nodes of -load^LOAD_POWER, ln(speed), and the three
    scaled motions. constants, shape (13,), and scalars, shape (nQ + 2, nU + 2, 10): as named
    above. values, shape (nX + 2, nY + 2, nS + 2, nQ, nU, 4), whole numbers. Both are B-spline
    coefficients, of values those of the nodes of load and speed alone. out, 8 numbers: F_x, F_y on
    body 1 [N], M_n, M_y on body 1 [N m], power lost [W], central film [m], stiffness [N/m],
    damping [N s/m]. Outside, the nearest place in the table counts, forces per load, below the
    speeds the hydrodynamic moment in proportion to them.
    """
    # 1. place on the axes of load and speed, and the film there
    q, side = _clamped(-(max(load, 1e-300) ** LOAD_POWER), axes[0])
    flag = BELOW_LOAD if side < 0 else (ABOVE_LOAD if side > 0 else 0)
    u, side = _clamped(np.log(max(speed, 1e-300)), axes[1])
    flag += BELOW_SPEED if side < 0 else (ABOVE_SPEED if side > 0 else 0)
    film = row_sums()
    _film_values(scalars, spline_weights(q, axes[0]), spline_weights(u, axes[1]), film)
    i0, w0 = inner_weights(q, axes[0])
    i1, w1 = inner_weights(u, axes[1])
    # 2. place on the axes of the motions, the half above slide_y = 0
    mirror = 1.0 if slide_y >= 0.0 else -1.0
    size = max(abs(speed), constants[LEAST_SPEED], 1e-300)
    radius = constants[RADIUS_X]
    table_load = -1.0 / q**5  # -1/LOAD_POWER
    motions = (slide_x / size, abs(slide_y) / size, mirror * spin * radius / size)
    x, y, n, beyond = _motion_places(film, axes, constants, motions, table_load)
    flag += beyond
    i2, w2 = spline_weights(x, axes[2])
    i3, w3 = spline_weights(y, axes[3])
    i4, w4 = spline_weights(n, axes[4])
    # 3. forces and moments: sliding over its largest, and the hydrodynamic moment
    t = spline_sum(values, (i0, i1, i2, i3, i4), w0, w1, w2, w3, w4)
    per_load = load / table_load
    unit = constants[VALUE_UNIT]
    hydrodynamic = -film[HYDRODYNAMIC] * per_load
    if side < 0:  # no oil is drawn in at rest
        hydrodynamic *= abs(speed) * np.exp(-axes[1, 0])
    force = film[LARGEST_FORCE] * per_load
    out[0] = unit * t[0] * force + 0.5 * constants[DIFFERENCE] * hydrodynamic
    out[1] = unit * mirror * t[1] * force
    out[2] = unit * mirror * t[2] * film[LARGEST_SPIN] * per_load
    out[3] = unit * t[3] * film[LARGEST_ROLLING] * per_load + hydrodynamic
    # 4. power and film
    rolling = speed / radius - 0.5 * constants[DIFFERENCE] * slide_x
    out[4] = -(out[0] * slide_x + out[1] * slide_y + out[2] * spin + out[3] * rolling)
    out[5] = film[CENTRAL_FILM]
    out[6] = film[STIFFNESS]
    out[7] = film[DAMPING]
    return flag


@compiled
def hertz_friction(disc, law, constants, load, speed, slide_x, slide_y, spin, out):
    """Friction over the Hertz ellipse with a coefficient that depends on the local sliding; out as
    `table_lookup`.

    disc, shape (3, n): x/a, y/b, share of the load. law: as `coefficient` takes it. constants:
    semi-axes x and y at 1 N, R_x, 1/(2R), curvature difference. Film, stiffness and damping are
    zero.
    """
    third = np.cbrt(max(load, 0.0))
    a = constants[SHAPE_AXIS_X] * third
    b = constants[SHAPE_AXIS_Y] * third
    rolling = speed / constants[SHAPE_RADIUS_X] - 0.5 * constants[SHAPE_DIFFERENCE] * slide_x
    f_x = f_y = m_n = m_y = 0.0
    for k in range(disc.shape[1]):
        x = a * disc[0, k]
        y = b * disc[1, k]
        curvature_height = constants[SHAPE_CURVATURE] * y * y
        s_x = slide_x - spin * y - rolling * curvature_height
        s_y = slide_y + spin * x
        s = np.sqrt(s_x * s_x + s_y * s_y)
        if s <= 0.0:
            continue
        pull = disc[2, k] * load * coefficient(law, s, speed) / s
        f_x -= pull * s_x
        f_y -= pull * s_y
        m_n += pull * (y * s_x - x * s_y)
        m_y += pull * curvature_height * s_x
    out[0] = f_x
    out[1] = f_y
    out[2] = m_n
    out[3] = m_y
    out[4] = -(f_x * slide_x + f_y * slide_y + m_n * spin + m_y * rolling)
    out[5] = out[6] = out[7] = 0.0
    return 0


@compiled
def _strip_sums(nodes, law, motion, constants, ends):
    """Force along x over the load and its mean of y^2/(2R) [m], of both halves of an ellipse, by
    the lines along x between two places y/b.

    Hertz' pressure along a line at y/b adds up to 3/4 (1 - (y/b)^2) of the load; half of the lines
    count twice.
    """
    slide_x, rolling, speed, height = motion
    first, last = ends
    pull = moment = 0.0
    for k in range(nodes.shape[1]):
        place = first + (last - first) * nodes[0, k]
        square = place * place
        share = 1.5 * (last - first) * nodes[1, k] * (1.0 - square)
        s_x = slide_x - rolling * height * square
        part = np.copysign(share * coefficient(law, abs(s_x), speed), s_x)
        pull += part
        moment += part * height * square
    return pull, moment


@compiled
def straight_friction(nodes, law, constants, load, speed, slide_x, out):
    """`hertz_friction` without sliding across and spin: sliding depends on y^2 alone.

    nodes, shape (2, n): of Gauss' rule on [0, 1] and their weights, taken on either side of the
    line of pure rolling.
    """
    b = constants[SHAPE_AXIS_Y] * np.cbrt(max(load, 0.0))
    height = constants[SHAPE_CURVATURE] * b * b
    rolling = speed / constants[SHAPE_RADIUS_X] - 0.5 * constants[SHAPE_DIFFERENCE] * slide_x
    motion = (slide_x, rolling, speed, height)
    most = rolling * height
    turns = 0.0
    if most != 0.0 and 0.0 < slide_x / most < 1.0:
        turns = np.sqrt(slide_x / most)
    pull, moment = _strip_sums(nodes, law, motion, constants, (turns, 1.0))
    if turns > 0.0:
        more, more_moment = _strip_sums(nodes, law, motion, constants, (0.0, turns))
        pull += more
        moment += more_moment
    out[:] = 0.0
    out[0] = -load * pull
    out[3] = load * moment
    out[4] = -(out[0] * slide_x + out[3] * rolling)

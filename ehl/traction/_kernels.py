"""Compiled kernels of traction: sums over the nodes of a film, lookups that dynamics calls at
every step, and Kapitza's moment.

Everything is arrays and floats in SI. The NumPy twins stand in `tests/reference/ehl`.
"""

import numpy as np
from numba import types
from numba.extending import intrinsic, overload

from ..compiled import compiled
from ..oil._kernels import LIMIT_POWER, LIMIT_ROOTS, SMALL_SINE, inverse_sine, shear_stress
from ..oil._laws import REE_EYRING
from ._spline_kernels import inner_weights, spline_sum, spline_weights
from .friction_coefficients import coefficient as coefficient_law

# rows of the nodes of a film; spread: a twelfth of the squared size
X, Y, AREA, FILM, VISCOSITY, LIMIT, SPREAD_X, SPREAD_Y = range(8)
# columns of a table's films, logarithms: scales of the motions, central film, hydrodynamic moment,
# response, largest force and moments of sliding
SCALE_X, SCALE_Y, SCALE_SPIN, CENTRAL_FILM, HYDRODYNAMIC = range(5)
STIFFNESS, DAMPING, LARGEST_FORCE, LARGEST_SPIN, LARGEST_ROLLING = range(5, 10)
# constants of a table: bodies, range of the motions, transverse semi-axis at 1 N, 1/(2R), unit of
# its whole numbers, semi-axis along the rolling direction at 1 N, `TractionTable.spacing`,
# entrainment that sliding is taken over at least
RADIUS_X, DIFFERENCE, RANGE_X, RANGE_Y, RANGE_SPIN, UNIT_AXIS, CURVATURE, VALUE_UNIT = range(8)
UNIT_AXIS_X, SPACING_LIMIT, SPACING_SPIN, SPACING_REST, LEAST_SPEED = range(8, 13)
# shape of an ellipse: semi-axes at 1 N, R_x, 1/(2R), curvature difference of the bodies
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
BEYOND_SLIDE_X, BEYOND_SLIDE_Y, BEYOND_SPIN = (1 << bit for bit in range(4, 7))

coefficient = compiled(coefficient_law)

BLOCK = 32  # motions of a block; 16 and 64 take as long
# rows of a block's room: motions, sliding at a node and its pull (area stress/sliding), sums
SLIDE_X, SLIDE_Y, SPIN, ROLLING, AT_X, AT_Y, SLIDE, PULL = (BLOCK * row for row in range(8))
F_X, F_Y, M_N, M_Y, SQUARES = (BLOCK * row for row in range(8, 13))
ROOM = 13 * BLOCK
HALF_ROOT = 0x3FE6A09E667F3BCD  # bits of the root of 1/2
FRACTION_BITS = 52  # of a number's binary form
ROUNDED = 0x4338000000000000  # bits of ROUND_NUMBER
ROUND_NUMBER = 6755399441055744.0  # 1.5 2^52: whole numbers added to its bits add to its value
LOG_2 = float(np.log(2.0))

NEWTON_STEPS = 60  # most of them for the meniscus: 5 to 9 are taken
LAST_STEP = 1e-6  # of the square of its distance, after which a step of second order is exact
NEAREST = 0.03  # of the distance at which the gap is twice the film: what is within is left out
# gap beyond the film of elastic bodies from which on pressure counts, in a^2/Rx: 0.015 to 0.1
# serve alike
INLET_GAP = 0.04
SECANTS = 60  # most of them for a gap: 5 to 8 are taken, more where the gap of circles jumps
LAST_SECANT = 1e-9  # of the gap, or of the square of its distance, at which they end [-]
PARABOLA_SHARE = 0.2  # as `rolling_moment.PARABOLA_SHARE`
CIRCLE_END = 1.0 - 1e-9  # as `rolling_moment.CIRCLE_END`


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
    further one by its weight, see `traction_table/table.py`.
    """
    share = inverse_sine(abs(motion) / scale) / inverse_sine(limit / scale)
    share = (1.0 - weight) * share + weight * part
    place, side = _clamped(np.copysign(share, motion), axis)
    return place, side != 0


@compiled
def _motion_scale(scale, turn, b_axis, constants):
    """Scale of slide_x at a spin, see `traction_table.table.spinning_scales`."""
    far = 0.5 * turn
    slope = constants[CURVATURE] * b_axis
    steep = far * far * far * far
    curved = slope * slope * slope * slope
    share = SPIN_SHARE * steep / (steep + curved + TINY)
    spread = share * turn * b_axis / constants[RADIUS_X]
    return np.sqrt(scale * scale + spread * spread)


@compiled
def _film_values(scalars, load, speed, film):
    """Values whose logarithms are splines over load and speed, all columns at once, into film;
    load, speed: first coefficient and weights.
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
    """Further part of a slide's coordinate; see `traction_table.table.standstill_term`."""
    return np.sqrt(1.0 + rest) - np.sqrt(1.0 + rest - min(size / STANDING, 1.0))


@compiled
def _fading_shift(shift, slide, limit):
    """Shift that `traction_table.table.at_vertex` adds to a slide."""
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
    flag = (BEYOND_SLIDE_X if beyond_x else 0) + (BEYOND_SLIDE_Y if beyond_y else 0)
    return x, y, n, flag + (BEYOND_SPIN if beyond_n else 0)


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
    film = np.empty(scalars.shape[2])
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


@intrinsic
def bits_of(typing, number):
    """The binary form of a number of single or double precision, a whole number of its size."""
    del typing
    whole = types.int32 if number == types.float32 else types.int64

    def build(context, builder, signature, arguments):
        del signature
        return builder.bitcast(arguments[0], context.get_value_type(whole))

    return whole(number), build


@intrinsic
def _number(typing, bits):
    """The number of a binary form."""
    del typing, bits

    def build(context, builder, signature, arguments):
        del signature
        return builder.bitcast(arguments[0], context.get_value_type(types.float64))

    return types.float64(types.int64), build


def logarithm(x):
    """ln(x) of a positive number, to 1e-15 absolutely."""
    return np.log(x)


@overload(logarithm)
def _compiled_logarithm(x):
    """`logarithm` where it is compiled: 2 artanh((m - 1)/(m + 1)) of x = m 2^e, m within a factor
    of sqrt(2) of one, by its series.
    """
    del x

    def of(x):
        bits = bits_of(x)
        power = (bits - HALF_ROOT) >> FRACTION_BITS
        m = _number(bits - (power << FRACTION_BITS))
        z = (m - 1.0) / (m + 1.0)
        q = z * z
        series = 1.0 / 11.0 + q * (1.0 / 13.0 + q * (1.0 / 15.0 + q * (1.0 / 17.0 + q / 19.0)))
        series = 1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0 + q * series))
        series = 1.0 + q * (1.0 / 3.0 + q * series)
        return 2.0 * z * series + LOG_2 * (_number(power + ROUNDED) - ROUND_NUMBER)

    return of


@compiled
def _slide_block(room, node, surface):
    """Sliding of a block's motions at a node, s_y times g, and its mean size over the node's strip
    as `film_quadrature` has both; area times the square of that added up.

    node: x, y, area and spread_x, spread_y, a twelfth of its squared size; surface: 1/(2R) over
    +-width across; y^2/(2R) does not grow beyond.
    """
    x, y, area, spread_x, spread_y = node
    curvature, width = surface
    height = curvature * min(y * y, width * width)
    steep = 2.0 * curvature * y if abs(y) < width else 0.0
    quarter = 3.0 * spread_y  # of the squared size
    for n in range(BLOCK):
        k = np.uint64(n)
        spin = room[k + np.uint64(SPIN)]
        rolling = room[k + np.uint64(ROLLING)]
        s_x = room[k + np.uint64(SLIDE_X)] - spin * y - rolling * height
        s_y = room[k + np.uint64(SLIDE_Y)] + spin * x
        slope = spin + rolling * steep
        along = s_x * s_x
        change = slope * slope * quarter
        both = along + s_y * s_y + change + spin * spin * spread_x
        square = max(0.5 * (both + np.sqrt(abs(both * both - 4.0 * along * change))), TINY)
        room[k + np.uint64(AT_X)] = s_x
        room[k + np.uint64(AT_Y)] = (
            s_y * (15.0 * square - 4.0 * change) / (15.0 * square - 9.0 * change)
        )
        room[k + np.uint64(SLIDE)] = np.sqrt(square)
        room[k + np.uint64(SQUARES)] += area * square


@compiled
def _eyring_pulls(room, gap, viscosity, stress):
    """Stress of a node at the sliding of a block by the law of Ree and Eyring, into its pull."""
    by_slide = viscosity / (gap * stress)
    for n in range(BLOCK):
        k = np.uint64(n)
        x = by_slide * room[k + np.uint64(SLIDE)]
        sine = logarithm(x + np.sqrt(x * x + 1.0))
        small = x * (1.0 - x * x * (1.0 / 6.0 - 0.075 * x * x))
        room[k + np.uint64(PULL)] = stress * (small if x < SMALL_SINE else sine)


@compiled
def _limit_pulls(room, area, limit):
    """Pull of a node from its stress, under the limit as `limited` has it: times (1 +
    ratio^m)^(-1/m) by the series of artanh and exp, to 1e-9.
    """
    for n in range(BLOCK):
        k = np.uint64(n)
        tau = room[k + np.uint64(PULL)]
        below = min(tau, limit)
        power = below / max(tau, limit)
        for _ in range(LIMIT_ROOTS):
            power *= power
        z = power / (2.0 + power)
        q = z * z
        series = 1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0 + q / 13.0))
        series = 1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * series))
        rest = z * series * (-2.0 / LIMIT_POWER)
        root = 1.0 + rest * (1.0 + rest * (0.5 + rest * (1.0 / 6.0 + rest / 24.0)))
        room[k + np.uint64(PULL)] = area * below * root / room[k + np.uint64(SLIDE)]


@compiled
def _other_pulls(room, area, gap, viscosity, limit, law):
    """Pull of a node on the motions of a block by any law."""
    for n in range(BLOCK):
        slide = room[SLIDE + n]
        room[PULL + n] = area * shear_stress(slide / gap, viscosity, limit, *law) / slide


@compiled
def pull_block(room, oil, law):
    """Pull of a node, of area, film, viscosity and limiting stress, at the sliding of a block."""
    area, gap, viscosity, limit = oil
    if law[0] == REE_EYRING:
        _eyring_pulls(room, gap, viscosity, law[1])
        _limit_pulls(room, area, limit)
    else:
        _other_pulls(room, area, gap, viscosity, limit, law)


@compiled
def _add_pulls(room, x, y, height):
    """Add a node's shares of F_x, F_y, M_n, M_y on body 1."""
    for n in range(BLOCK):
        k = np.uint64(n)
        pull = room[k + np.uint64(PULL)]
        t_x = pull * room[k + np.uint64(AT_X)]
        t_y = pull * room[k + np.uint64(AT_Y)]
        room[k + np.uint64(F_X)] -= t_x
        room[k + np.uint64(F_Y)] -= t_y
        room[k + np.uint64(M_N)] += y * t_x - x * t_y
        room[k + np.uint64(M_Y)] += height * t_x


@compiled
def block_sums(nodes, law, surface, room):
    """Forces and moments of a block's motions by sliding over nodes, and the sum of area times
    mean square of the sliding, into the room.

    nodes, shape (8, n): rows as `_kernels` names them. law: base law and its constants. surface:
    1/(2R) over +-width across.
    """
    room[F_X:ROOM] = 0.0
    curvature, width = surface
    for k in range(nodes.shape[1]):
        x, y, area = nodes[X, k], nodes[Y, k], nodes[AREA, k]
        oil = (area, nodes[FILM, k], nodes[VISCOSITY, k], nodes[LIMIT, k])
        _slide_block(room, (x, y, area, nodes[SPREAD_X, k], nodes[SPREAD_Y, k]), surface)
        pull_block(room, oil, law)
        _add_pulls(room, x, y, curvature * min(y * y, width * width))


@compiled
def load_block(motions, first, room):
    """Motions of a block, slide_x, slide_y, spin, rolling, from the first on; their number."""
    slide_x, slide_y, spin, rolling = motions
    count = min(BLOCK, slide_x.size - first)
    for n in range(BLOCK):
        k = first + min(n, count - 1)  # the last one again where there are no more
        room[SLIDE_X + n] = slide_x[k]
        room[SLIDE_Y + n] = slide_y[k]
        room[SPIN + n] = spin[k]
        room[ROLLING + n] = rolling[k]
    return count


@compiled
def _add_block(room, first, count, out):
    """Add a block's sums to the rows of its motions of out, shape (n, 4)."""
    for n in range(count):
        out[first + n, 0] += room[F_X + n]
        out[first + n, 1] += room[F_Y + n]
        out[first + n, 2] += room[M_N + n]
        out[first + n, 3] += room[M_Y + n]


@compiled
def sliding_sums_many(nodes, law, motions, surface, out):
    """F_x, F_y, M_n, M_y on body 1 by sliding for each of n motions, added to out, shape (n, 4).

    nodes, law and surface as in `block_sums`; motions: slide_x, slide_y, spin, rolling.
    """
    room = np.empty(ROOM)
    for first in range(0, motions[0].size, BLOCK):
        count = load_block(motions, first, room)
        block_sums(nodes, law, surface, room)
        _add_block(room, first, count, out)


@compiled
def height(curvature, square):
    """Height of a circle at the square of a distance, signed as its curvature [m]."""
    return curvature * square / (1.0 + np.sqrt(1.0 - min(curvature * curvature * square, 1.0)))


@compiled
def meniscus(film, layer, ball, race, end):
    """Distance along a ray [m] at which the gap of two circles is as wide as a layer, or the
    smaller circle ends: Newton's method in the square of the distance, by which the gap is convex,
    kept inside a bracket.
    """
    if not film + height(ball, end * end) + height(race, end * end) > layer:
        return end
    low = 0.0
    high = end * end
    square = min(2.0 * (layer - film) / (ball + race), 0.5 * high)
    for _ in range(NEWTON_STEPS):
        excess = film + height(ball, square) + height(race, square) - layer
        if excess < 0.0:
            low = square
        else:
            high = square
        rise = 0.5 * ball / np.sqrt(1.0 - ball * ball * square)
        rise += 0.5 * race / np.sqrt(1.0 - race * race * square)
        step = -excess / rise
        inside = low <= square + step <= high
        done = abs(step) <= LAST_STEP * square
        square = square + step if inside else 0.5 * (low + high)
        if done:
            break
    return np.sqrt(square)


@compiled
def kapitza_integral(film, layer, radii, ball_curvature, circles, rays, steps):
    """Integral of cos^2 r^3/h^2 over a quarter from near the centre to the meniscus [m^2].

    radii: reduced, along and across [m]; ball_curvature: of body 1 [1/m], not a number: that of
    the gap; circles: whether the bodies are circles, else paraboloids; rays, steps: Gauss and
    Legendre's places and weights on [-1, 1] for angles and distances, shape (2, n).
    """
    total = 0.0
    for i in range(rays.shape[1]):
        angle = 0.25 * np.pi * (rays[0, i] + 1.0)
        cosine = np.cos(angle) ** 2
        curvature = cosine / radii[0] + np.sin(angle) ** 2 / radii[1]
        ball = curvature if np.isnan(ball_curvature) else ball_curvature
        race = curvature - ball
        circle_end = CIRCLE_END / max(abs(ball), abs(race))
        end = min(np.sqrt(2.0 * (layer - film) / curvature), circle_end)
        if circles:
            end = meniscus(film, layer, ball, race, circle_end)
        start = min(NEAREST * np.sqrt(2.0 * film / curvature), end)
        span = np.log(end / start)
        radial = 0.0
        for j in range(steps.shape[1]):
            square = (start * np.exp(0.5 * span * (steps[0, j] + 1.0))) ** 2
            gap = film
            if circles:
                gap += height(ball, square) + height(race, square)
            else:
                gap += 0.5 * curvature * square
            radial += 0.5 * span * steps[1, j] * (square / gap) ** 2
        total += 0.25 * np.pi * rays[1, i] * cosine * radial
    return total


@compiled
def excess(ball, race, square):
    """Gap of two circles less that of their parabolas at the square of a distance [m]; none near
    by, as in `rolling_moment`.
    """
    if max(ball * ball, race * race) * square <= PARABOLA_SHARE**2:
        return 0.0
    found = 0.0
    for curvature in (ball, race):
        turned = min(curvature * curvature * square, 1.0)
        found += 0.5 * curvature * square * turned / (1.0 + np.sqrt(1.0 - turned)) ** 2
    return found


@compiled
def hertz_gap(ratio):
    """Gap outside a dry circular contact over a^2/R, at a distance over a (Johnson, 1985, 4.2)."""
    if ratio <= 1.0:
        return 0.0
    return ((ratio**2 - 2.0) * np.arccos(1.0 / ratio) + np.sqrt(ratio**2 - 1.0)) / np.pi


@compiled
def elastic_gap(r, ray, ball, reciprocal, axes, circles):
    """Gap beyond the film [m] at a distance r [m] along a ray (cosine, sine, distance of the
    ellipse's edge [m]) with curvatures ball and, along and across, `reciprocal` [1/m]; outside the
    ellipse with `axes` that of a circular contact along the ray, of circles with what these part
    more than paraboloids from the edge beside on.
    """
    cosine, sine, edge = ray
    curvature = cosine**2 * reciprocal[0] + sine**2 * reciprocal[1]
    gap = curvature * edge**2 * hertz_gap(r / edge)
    if circles and r > edge:
        across = min(r * sine, axes[1])
        along = min(r * cosine, axes[0] * np.sqrt(max(1.0 - (across / axes[1]) ** 2, 0.0)))
        square = along**2 + across**2
        beside = (along**2 * reciprocal[0] + across**2 * reciprocal[1]) / square
        gap += excess(ball, curvature - ball, r**2) - excess(ball, beside - ball, square)
    return gap


@compiled
def distance_of(gap, low, high, ray, ball, reciprocal, axes, circles):
    """Distance along a ray at which the gap beyond the film is as wide as `gap`, or `high` [m]: a
    secant in the square of the distance kept inside a bracket, after Illinois.
    """
    left = elastic_gap(low, ray, ball, reciprocal, axes, circles) - gap
    right = elastic_gap(high, ray, ball, reciprocal, axes, circles) - gap
    if right <= 0.0:
        return high
    if left >= 0.0:
        return low
    near = low * low
    far = high * high
    square = near
    for _ in range(SECANTS):
        width = abs(far - near)
        square = far - right * (far - near) / (right - left)
        found = elastic_gap(np.sqrt(square), ray, ball, reciprocal, axes, circles) - gap
        if found * right > 0.0:
            left *= 0.5
        else:
            near = far
            left = right
        far = square
        right = found
        if abs(found) <= LAST_SECANT * gap or width <= LAST_SECANT * square:
            break
    return np.sqrt(square)


@compiled
def circles_loss(film, layer, reciprocal, ball_curvature, axes, rays, steps):
    """Loss of the integral of cos^2 r^3/h^2 over a quarter by circles in place of paraboloids,
    elastic bodies [m^2].

    reciprocal: 1/Rx and 1/Ry [1/m]; axes: semi-axes of Hertz' ellipse [m]; others as in
    `kapitza_integral`.
    """
    lost = 0.0
    for i in range(rays.shape[1]):
        angle = 0.25 * np.pi * (rays[0, i] + 1.0)
        cosine, sine = np.cos(angle), np.sin(angle)
        edge = 1.0 / np.sqrt((cosine / axes[0]) ** 2 + (sine / axes[1]) ** 2)
        ray = (cosine, sine, edge)
        curvature = cosine**2 * reciprocal[0] + sine**2 * reciprocal[1]
        ball = curvature if np.isnan(ball_curvature) else ball_curvature
        ends = max(abs(ball), abs(curvature - ball))
        # the gap of a circular contact near its edge is 8 sqrt(2)/(3 pi) (r/edge - 1)^1.5 of its
        # a^2/R there
        least = min(INLET_GAP * axes[0] ** 2 * reciprocal[0], layer - film)
        narrow = 3.0 * np.pi / (8.0 * np.sqrt(2.0)) * least / (curvature * edge**2)
        start = edge * (1.0 + narrow ** (2.0 / 3.0))
        far = edge + np.sqrt(2.0 * layer / curvature)
        for circles in (False, True):
            reach = max(min(far, CIRCLE_END / ends) if circles else far, start)
            end = distance_of(layer - film, start, reach, ray, ball, reciprocal, axes, circles)
            span = np.log(end / start)
            radial = 0.0
            for j in range(steps.shape[1]):
                r = start * np.exp(0.5 * span * (steps[0, j] + 1.0))
                gap = film + elastic_gap(r, ray, ball, reciprocal, axes, circles)
                radial += 0.5 * span * steps[1, j] * (r**2 / gap) ** 2
            part = 0.25 * np.pi * rays[1, i] * cosine**2 * radial
            lost += -part if circles else part
    return lost

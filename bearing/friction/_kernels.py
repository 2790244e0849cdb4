"""Compiled friction of many contacts and its slope, and Newton's steps for balls under it; SI.

Friction is that of laws of `oilfilm.ehl.traction` by difference quotients, of films node by node,
and Coulomb's. Everything is arrays and floats; motion k = (S_x, S_y, Omega, omega). The NumPy
twins are `tables.law_gradient`, contact by contact, `film_friction_twin` and
`coulomb_dissipation_twin` of tests/reference.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled, summing
from oilfilm.ehl.oil._kernels import (
    FAR_BELOW,
    copy,
    copy_rows,
    eyring_slope,
    limited_slope,
    shear_stress_slope,
)
from oilfilm.ehl.oil._laws import NEWTONIAN, REE_EYRING
from oilfilm.ehl.traction._kernels import hertz_friction, table_lookup

# error of the stress of oil at ambient pressure, up to which it counts as proportional [-]:
# it makes some 1e-3 of the friction of a film
PROPORTIONAL = 1.0e-6
# slope of the sliding at a line of pure rolling, over its largest one, below which it counts as
# this [-], and that keeps quotients finite [m/s]
FLAT_LINE = 1.0e-9
NO_SLOPE = 1.0e-300
FAR_LINE = 1.0e30  # where lines beyond reach stand, over the semi-axis [-]

TINY = 1.0e-300  # as `law.TINY`
NOISE = 1.0e-13  # of the power that rounding leaves [-]
LESS_DAMPING = 0.2  # after a step taken [-]
MORE_DAMPING = 6.0  # after one refused [-]
LEAST_DAMPING = 1.0e-14


@compiled
def table_gradients(table, places, motion, step, gradient, slope):
    """Minus forces and moments (n, 4) of one table, and their slope (n, 4, 4) by sliding and spin.

    table: what `table_lookup` takes first; places, shape (n, 3): load, entrainment speed, rolling
    radius; motion (n, 4); step: of slides over the speed and of spin over the speed over the
    radius.
    """
    out = np.empty(8)
    m = np.empty(3)
    for k in range(motion.shape[0]):
        load, speed, radius = places[k]
        copy(motion[k], m)
        table_lookup(*table, load, speed, m[0], m[1], m[2], out)
        for i in range(4):
            gradient[k, i] = -out[i]
        slope[k] = 0.0
        for j in range(3):
            size = step * speed if j < 2 else step * speed / radius
            copy(motion[k], m)
            m[j] += size
            table_lookup(*table, load, speed, m[0], m[1], m[2], out)
            for i in range(4):
                slope[k, i, j] = -(out[i] + gradient[k, i]) / size


@compiled
def hertz_gradients(disc, laws, shapes, places, motion, step, gradient, slope):
    """Gradients as in `table_gradients` for coefficients over the Hertz ellipse; laws (n, m) and
    shapes (n, 5) a contact each.
    """
    out = np.empty(8)
    m = np.empty(3)
    for k in range(motion.shape[0]):
        load, speed, radius = places[k]
        copy(motion[k], m)
        hertz_friction(disc, laws[k], shapes[k], load, speed, m[0], m[1], m[2], out)
        for i in range(4):
            gradient[k, i] = -out[i]
        slope[k] = 0.0
        for j in range(3):
            size = step * speed if j < 2 else step * speed / radius
            copy(motion[k], m)
            m[j] += size
            hertz_friction(disc, laws[k], shapes[k], load, speed, m[0], m[1], m[2], out)
            for i in range(4):
                slope[k, i, j] = -(out[i] + gradient[k, i]) / size


@compiled
def film_frictions(nodes, parts, thin, laws, motion, film_numbers, least, gradient, slope):
    """Friction (n, 4) of sheared films, A tau s/|s| K summed over the nodes of each, and its slope
    (n, 4, 4) by the motions (n, 4); s = (K_x, K_y) motion is the sliding of `coulomb_sums`.

    nodes: rows of area [m^2], 1 over the gap [1/m], viscosity [Pa s], limiting stress [Pa], x, y
    and height of the surface [m], shape (7, m); parts (films, 3): where the nodes of a film begin,
    those of oil at ambient pressure, and where they end; thin (films, 11): of these what
    `thin_sums` gives; laws (films, 4): the first four fields of `KernelRheology`; film_numbers
    (n,): film of each motion; least: sliding below which the stress is proportional to it [m/s].
    """
    most = 0
    for film in range(parts.shape[0]):
        most = max(most, parts[film, 2] - parts[film, 0])
    work = np.empty((3, most))
    for n in range(motion.shape[0]):
        film = film_numbers[n]
        law = laws[film]
        begin, end = parts[film, 0], parts[film, 2]
        gradient[n] = 0.0
        slope[n] = 0.0
        if proportional(thin[film], motion[n], int(law[0]), law[1], law[3]):
            end = parts[film, 1]
            thin_friction(thin[film], motion[n], gradient[n], slope[n])
        place = (nodes[4, begin:end], nodes[5, begin:end], nodes[6, begin:end])
        oil = (nodes[1, begin:end], nodes[2, begin:end], nodes[3, begin:end])
        area = nodes[0, begin:end]
        stresses(oil, place, motion[n], law, least, work[0], work[1], work[2])
        sums = pull_sums(area, oil[0], place, motion[n], work[0], work[1], work[2])
        add_sums(sums, gradient[n], slope[n])


@compiled
def stresses(oil, coordinates, motion, law, least, speeds, tau, bent):
    """Sliding [m/s], stress [Pa] and its derivative by the rate [Pa s] at nodes; loops apart, that
    each be compiled for several nodes at a time.
    """
    opening, eta, limit = oil
    x, y, height = coordinates
    slide_x, slide_y, spin, rolling = motion
    code = int(law[0])
    stress, exponent, breadth = law[1], law[2], law[3]
    for k in range(x.size):
        s0 = slide_x - spin * y[k] + rolling * height[k]
        s1 = slide_y + spin * x[k]
        speeds[k] = np.sqrt(s0 * s0 + s1 * s1 + least * least)
    if code == REE_EYRING:
        for k in range(x.size):
            rate = speeds[k] * opening[k]
            tau[k], bent[k] = eyring_slope(rate, eta[k], stress)
        for k in range(x.size):
            tau[k], bent[k] = limited_slope(tau[k], bent[k], limit[k])
    else:
        for k in range(x.size):
            rate = speeds[k] * opening[k]
            tau[k], bent[k] = shear_stress_slope(
                rate, eta[k], limit[k], code, stress, exponent, breadth
            )


@summing
def pull_sums(area, opening, coordinates, motion, speeds, tau, bent):
    """Friction of nodes by their stress: its four parts, and of its slope the ten above and on the
    diagonal.
    """
    slide_x, slide_y, spin, rolling = motion
    g0 = g1 = g2 = g3 = c00 = c01 = c02 = c03 = c11 = c12 = c13 = c22 = c23 = c33 = 0.0
    for k in range(area.size):
        over = 1.0 / speeds[k]
        pull = area[k] * tau[k] * over
        bend = (area[k] * bent[k] * opening[k] - pull) * over * over
        x, y, height = coordinates[0][k], coordinates[1][k], coordinates[2][k]
        s0 = slide_x - spin * y + rolling * height
        s1 = slide_y + spin * x
        s2 = s1 * x - s0 * y
        s3 = s0 * height
        g0 += pull * s0
        g1 += pull * s1
        g2 += pull * s2
        g3 += pull * s3
        c00 += pull + bend * s0 * s0
        c01 += bend * s0 * s1
        c02 += bend * s0 * s2 - pull * y
        c03 += bend * s0 * s3 + pull * height
        c11 += pull + bend * s1 * s1
        c12 += bend * s1 * s2 + pull * x
        c13 += bend * s1 * s3
        c22 += bend * s2 * s2 + pull * (x * x + y * y)
        c23 += bend * s2 * s3 - pull * y * height
        c33 += bend * s3 * s3 + pull * height * height
    return (g0, g1, g2, g3), (c00, c01, c02, c03, c11, c12, c13, c22, c23, c33)


@compiled
def add_sums(sums, gradient, slope):
    """Add `pull_sums` to a gradient (4,) and a slope (4, 4)."""
    (g0, g1, g2, g3), (c00, c01, c02, c03, c11, c12, c13, c22, c23, c33) = sums
    gradient[0] += g0
    gradient[1] += g1
    gradient[2] += g2
    gradient[3] += g3
    slope[0, 0] += c00
    slope[0, 1] += c01
    slope[0, 2] += c02
    slope[0, 3] += c03
    slope[1, 1] += c11
    slope[1, 2] += c12
    slope[1, 3] += c13
    slope[2, 2] += c22
    slope[2, 3] += c23
    slope[3, 3] += c33
    for i in range(4):
        for j in range(i):
            slope[i, j] = slope[j, i]


@compiled
def thin_friction(thin, motion, gradient, slope):
    """Friction of oil at ambient pressure, proportional to the motion: the upper half of its slope
    and its gradient.
    """
    c00, c02, c03, c12, c22, c23, c33 = thin[4:11]
    slide_x, slide_y, spin, rolling = motion
    gradient[0] = c00 * slide_x + c02 * spin + c03 * rolling
    gradient[1] = c00 * slide_y + c12 * spin
    gradient[2] = c02 * slide_x + c12 * slide_y + c22 * spin + c23 * rolling
    gradient[3] = c03 * slide_x + c23 * spin + c33 * rolling
    copy((c00, 0.0, c02, c03), slope[0])
    slope[1, 1] = c00
    slope[1, 2] = c12
    slope[2, 2] = c22
    slope[2, 3] = c23
    slope[3, 3] = c33


@compiled
def proportional(thin, motion, code, stress, breadth):
    """The stress of oil at ambient pressure is that of a Newtonian to `PROPORTIONAL`
    wherever a film has some, at a motion (4,).
    """
    most = thin[0] * (abs(motion[0]) + abs(motion[1])) + thin[1] * abs(motion[2])
    most += thin[2] * abs(motion[3])
    limit = thin[3]
    if code == NEWTONIAN:
        return most < 2.0 * PROPORTIONAL * limit
    if not most < FAR_BELOW * limit:
        return False
    if code == REE_EYRING:
        return most * most < 6.0 * PROPORTIONAL * stress * stress
    return (most / stress) ** breadth < PROPORTIONAL


@compiled
def thin_sums(nodes, out):
    """Sums of nodes as in `film_frictions` (7, m): largest viscosity over gap, times |x| + |y|,
    times the height of the surface, least limiting stress; then of A eta/gap the sums over K_i
    K_j, i <= j, that are not zero or that of another: 00, 02, 03, 12, 22, 23, 33.
    """
    out[:] = 0.0
    out[3] = np.inf
    for k in range(nodes.shape[1]):
        x, y, height = nodes[4, k], nodes[5, k], nodes[6, k]
        rate = nodes[2, k] * nodes[1, k]
        out[0] = max(out[0], rate)
        out[1] = max(out[1], rate * (abs(x) + abs(y)))
        out[2] = max(out[2], rate * abs(height))
        out[3] = min(out[3], nodes[3, k])
        pull = nodes[0, k] * rate
        out[4] += pull
        out[5] -= pull * y
        out[6] += pull * height
        out[7] += pull * x
        out[8] += pull * (x * x + y * y)
        out[9] -= pull * y * height
        out[10] += pull * height * height


@compiled
def line_sums(ellipses, motion, power, gradient, slope):
    """Sums as in `coulomb_sums` of narrow ellipses, by the lines of pure rolling u = y/a, roots of
    omega a^2/(2R) u^2 + Omega a u = S_x.
    """
    moments = np.empty(3)
    arms = np.zeros(4)
    for n in range(motion.shape[0]):
        friction, _, a, curvature, _ = ellipses[n]
        slide = motion[n, 0]
        tilt = motion[n, 2] * a
        bend = motion[n, 3] * a * a * curvature
        arms[0] = 1.0
        arms[2] = -a
        arms[3] = -a * a * curvature
        roots = _line_roots(slide, tilt, bend)
        sign = 1.0 if bend >= 0.0 else -1.0
        for k in range(3):
            high = _line_moment(min(max(roots[1], -1.0), 1.0), k)
            low = _line_moment(min(max(roots[0], -1.0), 1.0), k)
            whole = 1.0 if k == 0 else 0.2 if k == 2 else 0.0
            moments[k] = sign * (2.0 * (high - low) - whole)
        gradient[n, 0] = friction * moments[0]
        gradient[n, 1] = 0.0
        gradient[n, 2] = friction * arms[2] * moments[1]
        gradient[n, 3] = friction * arms[3] * moments[2]
        power[n] = gradient[n, 0] * slide
        power[n] += gradient[n, 2] * motion[n, 2] + gradient[n, 3] * motion[n, 3]
        slope[n] = 0.0
        flat = FLAT_LINE * (abs(tilt) + abs(bend)) + NO_SLOPE
        for u in roots:
            if abs(u) < 1.0:
                weight = friction * 1.5 * (1.0 - u * u) / max(abs(tilt + 2.0 * bend * u), flat)
                for i in (0, 2, 3):
                    for j in (0, 2, 3):
                        across = u ** (max(i - 1, 0) + max(j - 1, 0))
                        slope[n, i, j] += weight * arms[i] * arms[j] * across


@compiled
def _line_roots(slide, tilt, bend):
    """Roots of bend u^2 + tilt u - slide, the lower first; 2 where there are none."""
    square = tilt * tilt + 4.0 * bend * slide
    if not square > 0.0:
        return 2.0, 2.0
    q = -0.5 * (tilt + np.copysign(np.sqrt(square), tilt + 0.0))
    first = _far(q / bend)
    second = _far(-slide / q)
    return min(first, second), max(first, second)


@compiled
def _far(root):
    """A root as a finite number."""
    if np.isnan(root):
        return 0.0
    return min(max(root, -FAR_LINE), FAR_LINE)


@compiled
def _line_moment(u, power):
    """Integral of 3/4 (1 - u^2) u^n from 0."""
    return 0.75 * (u ** (power + 1) / (power + 1) - u ** (power + 3) / (power + 3))


@summing
def coulomb_sums(nodes, ellipses, motion, power, gradient, slope):
    """Power (n,), gradient (n, 4) and slope (n, 4, 4) of Coulomb friction at motions (n, 4).

    phi = mu sum p dA sqrt(s_x^2 + s_y^2 + e^2), s_x = S_x - Omega y - omega y^2/(2R),
    s_y = S_y + Omega x.

    nodes, shape (3, m): x/b, y/a, share of the load; ellipses, shape (n, 5): mu Q, b, a, 1/(2R),
    rounding.
    """
    for n in range(motion.shape[0]):
        friction, b, a, curvature, rounding = ellipses[n]
        slide_x, slide_y, spin, rolling = motion[n]
        p = g0 = g1 = g2 = g3 = c00 = c01 = c02 = c03 = c11 = c12 = c13 = c22 = c23 = c33 = 0.0
        for k in range(nodes.shape[1]):
            x, y = b * nodes[0, k], a * nodes[1, k]
            curved = -curvature * y * y
            s0 = slide_x - spin * y + rolling * curved
            s1 = slide_y + spin * x
            s2 = s1 * x - s0 * y
            s3 = s0 * curved
            square = s0 * s0 + s1 * s1 + rounding * rounding
            pull = friction * nodes[2, k] / np.sqrt(square)
            stiffness = pull / square
            p += pull * square
            g0 += pull * s0
            g1 += pull * s1
            g2 += pull * s2
            g3 += pull * s3
            c00 += pull - stiffness * s0 * s0
            c01 -= stiffness * s0 * s1
            c02 -= pull * y + stiffness * s0 * s2
            c03 += pull * curved - stiffness * s0 * s3
            c11 += pull - stiffness * s1 * s1
            c12 += pull * x - stiffness * s1 * s2
            c13 -= stiffness * s1 * s3
            c22 += pull * (x * x + y * y) - stiffness * s2 * s2
            c23 -= pull * y * curved + stiffness * s2 * s3
            c33 += pull * curved * curved - stiffness * s3 * s3
        power[n] = p
        copy((g0, g1, g2, g3), gradient[n])
        copy((c00, c01, c02, c03), slope[n, 0])
        copy((c01, c11, c12, c13), slope[n, 1])
        copy((c02, c12, c22, c23), slope[n, 2])
        copy((c03, c13, c23, c33), slope[n, 3])


@compiled
def motions(problem, at, z, k):
    """Motions of contacts k = start + slopes z, (n, 2, 4)."""
    start, slopes = problem[0], problem[1]
    for n in range(at.size):
        ball = at[n]
        for c in range(2):
            for i in range(4):
                total = start[ball, c, i]
                for j in range(4):
                    total += slopes[ball, c, i, j] * z[n, j]
                k[n, c, i] = total


@compiled
def left_on_balls(problem, at, z, friction, left):
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the unknowns z (n, 4).

    problem: start and slopes of the motions, forces that do not change, the gyroscopic matrix,
    friction of the pockets and the motion in them, which unknowns are free (1 or 0); friction:
    power, gradient and curvature of the contacts, two a ball.
    """
    _, slopes, fixed, matrix, pocket, rubbing, free = problem
    bent = np.empty((4, 4))
    for n in range(at.size):
        ball = at[n]
        power = friction[0][2 * n] + friction[0][2 * n + 1]
        gradient = left[1][n]
        hessian = left[2][n]
        # 1. fixed forces and the gyroscopic couple
        for i in range(4):
            power += fixed[ball, i] * z[n, i]
            gradient[i] = fixed[ball, i]
            for j in range(4):
                gradient[i] += matrix[ball, i, j] * z[n, j]
                hessian[i, j] = matrix[ball, i, j]
        # 2. friction of both contacts
        for c in range(2):
            force = friction[1][2 * n + c]
            curvature = friction[2][2 * n + c]
            turn = slopes[ball, c]
            for i in range(4):
                for j in range(4):
                    gradient[j] += turn[i, j] * force[i]
                    bent[i, j] = 0.0
                    for m in range(4):
                        bent[i, j] += curvature[i, m] * turn[m, j]
            for i in range(4):
                for j in range(4):
                    for m in range(4):
                        hessian[i, j] += turn[m, i] * bent[m, j]
        # 3. friction in the pocket
        power += add_pocket(pocket[ball], rubbing[ball], z[n], gradient, hessian)
        # 4. what is not free stays
        for i in range(4):
            gradient[i] *= free[ball, i]
            for j in range(4):
                hessian[i, j] *= free[ball, i] * free[ball, j]
        left[0][n] = power


@compiled
def add_pocket(force, rubbing, z, gradient, hessian):
    """Power of Coulomb's friction in a pocket, which is added to force and slope."""
    s0 = rubbing[0] + z[1]
    s1 = rubbing[1] + z[2]
    speed = np.hypot(s0, s1) + TINY
    s0 /= speed
    s1 /= speed
    bend = force / speed
    gradient[1] += force * s0
    gradient[2] += force * s1
    hessian[1, 1] += bend * (1.0 - s0 * s0)
    hessian[1, 2] -= bend * s0 * s1
    hessian[2, 1] -= bend * s0 * s1
    hessian[2, 2] += bend * (1.0 - s1 * s1)
    return force * speed


@compiled
def solve_four(matrix, right):
    """Unknowns of four equations, by elimination with pivots; both are overwritten."""
    for i in range(4):
        best = i
        for j in range(i + 1, 4):
            if abs(matrix[j, i]) > abs(matrix[best, i]):
                best = j
        for k in range(4):
            matrix[i, k], matrix[best, k] = matrix[best, k], matrix[i, k]
        right[i], right[best] = right[best], right[i]
        for j in range(i + 1, 4):
            factor = matrix[j, i] / matrix[i, i]
            for k in range(i, 4):
                matrix[j, k] -= factor * matrix[i, k]
            right[j] -= factor * right[i]
    for i in range(3, -1, -1):
        for k in range(i + 1, 4):
            right[i] -= matrix[i, k] * right[k]
        right[i] /= matrix[i, i]


@compiled
def damped_steps(state, friction, slip, limits, at, trial):
    """Number of the balls that are not done yet, their places and unknowns after the next step,
    the damping scaled by the mean curvature.

    state: unknowns, power, force left, its slope and damping of all balls; friction, slip: what
    forces and speeds are measured by; limits: residual, speed and damping at which a ball is done
    [-].
    """
    z, _, gradient, hessian, damping = state
    target, runaway, stuck = limits
    count = 0
    matrix = np.empty((4, 4))
    for ball in range(damping.size):
        largest = np.abs(gradient[ball]).max()
        fastest = np.abs(z[ball]).max()
        moves = largest / friction[ball] > target and fastest < runaway * slip[ball]
        if not (moves and damping[ball] < stuck):
            continue
        size = 0.0
        for i in range(4):
            size += hessian[ball, i, i]
        size = max(size, friction[ball] / slip[ball])
        copy_rows(hessian[ball], matrix)
        for i in range(4):
            matrix[i, i] += damping[ball] * size
        copy(gradient[ball], trial[count])
        solve_four(matrix, trial[count])
        for i in range(4):
            trial[count, i] = z[ball, i] - trial[count, i]
        at[count] = ball
        count += 1
    return count


@compiled
def accept_steps(state, at, trial, new, descent, stuck):
    """Take the steps by which the power falls (at round-off: the force left), or, without a
    potential, the length of the force left: where the friction is monotone that falls in small
    steps; its largest component may not. Less damping after a step taken, more after one refused.
    """
    z, power, gradient, hessian, damping = state
    for n in range(at.size):
        ball = at[n]
        before = 0.0
        after = 0.0
        for i in range(4):
            before += gradient[ball, i] ** 2
            after += new[1][n, i] ** 2
        better = after < before
        if descent:
            noise = NOISE * abs(power[ball])
            falls = new[0][n] < power[ball] - noise
            better = falls or (new[0][n] <= power[ball] + noise and better)
        if better:
            copy(trial[n], z[ball])
            power[ball] = new[0][n]
            copy(new[1][n], gradient[ball])
            copy_rows(new[2][n], hessian[ball])
        factor = LESS_DAMPING if better else MORE_DAMPING
        damping[ball] = min(max(factor * damping[ball], LEAST_DAMPING), 10.0 * stuck)

"""Compiled parts of Newton's method for the balance of friction on balls; SI.

Arrays of all balls and the places `at` of those that are looked at; twins are in tests/reference.
"""

import numpy as np

from ehl.compiled import compiled
from ehl.oil._kernels import copy, copy_rows

TINY = 1.0e-300  # as `law.TINY`
NOISE = 1.0e-13  # of the power that rounding leaves [-]
LESS_DAMPING = 0.2  # after a step taken [-]
MORE_DAMPING = 6.0  # after one refused [-]
LEAST_DAMPING = 1.0e-14


@compiled
def motions(given, at, z, k):
    """Motions of contacts k = start + slopes z, (n, 2, 4)."""
    start, slopes = given[0], given[1]
    for n in range(at.size):
        ball = at[n]
        for c in range(2):
            for i in range(4):
                total = start[ball, c, i]
                for j in range(4):
                    total += slopes[ball, c, i, j] * z[n, j]
                k[n, c, i] = total


@compiled
def left_on_balls(given, at, z, friction, left):
    """Power (n,), force left (n, 4) and its slope (n, 4, 4) by the unknowns z (n, 4).

    given: start and slopes of the motions, forces that do not change, the gyroscopic matrix,
    friction of the pockets and the motion in them, which unknowns are free (1 or 0); friction:
    power, gradient and curvature of the contacts, two a ball.
    """
    _, slopes, fixed, matrix, pocket, rubbing, free = given
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

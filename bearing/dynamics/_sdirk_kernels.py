"""Alexander's implicit method of order two around the equations of motion, with Newton's iteration
over the speeds in blocks of one ball each.

Alexander (1977), SIAM J. Numer. Anal. 14, 1006-1021: two stages, gamma = 1 - 1/sqrt 2, L-stable,
the last stage the state after the step. The vibration of balls between races, which such steps do
not resolve, dies out in them; contacts that close within a step are met by Newton's iteration.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.compiled import compiled, inlined
from oilfilm.ehl.oil._kernels import copy, copy_rows

from ._integration_kernels import (
    DONE,
    EVALUATIONS,
    REJECTED,
    STEPS,
    TOO_SMALL,
    ball_alone,
    begin_steps,
    end_step,
    forget_slopes,
    renew_friction,
    renew_pockets,
    sample,
)
from ._motion_kernels import (
    ball_rates,
    cage_equations,
    outer_equations,
    place_bodies,
    ring_equations,
    schedule_at,
    solved_derivative,
)
from .arrays import INNER_SPEED, OUTER_SPEED

GAMMA = 1.0 - 1.0 / np.sqrt(2.0)
ITERATIONS = 16  # of Newton in a stage
JACOBIANS = 4  # in a stage
SLOW = 0.3  # ratio of two changes in Newton's iteration from which the slopes are taken anew [-]
MANY = 4  # changes after which they are, too
KEPT = 5  # steps that slopes serve
CALM = 40  # steps after which a shorter one is doubled
SAME = 0.8  # ratio of two steps of about the same length [-]
ROUNDING = 1.0e-9  # of a step [-]
SHORTEST = 1.0e-4  # of the longest step, below which a step has failed [-]


class Blocks(NamedTuple):
    """Unknown speeds by what they belong to, their places among the unknown speeds, and slopes of
    the accelerations by blocks.
    """

    members: NDArray[np.int64]  # of each ball that acts alone, shape (Z or 0, s)
    bodies: NDArray[np.int64]  # all others, shape (n,)
    across: NDArray[np.int64]  # y and z of each ball's velocity and turn, (Z, 2, 2); -1: held
    orbits: Array  # speeds at which the balls go round, shape (Z,) [rad/s]
    own: Array  # of a ball over its speeds, shape (Z or 0, s, s)
    onto: Array  # of the bodies over a ball's speeds, shape (Z or 0, n, s)
    back: Array  # of a ball over the bodies' speeds, shape (Z or 0, s, n)
    border: Array  # of the bodies over theirs, shape (n, n)


@compiled
def invert(a, out):
    """Inverse of a square by Gauss and Jordan with partial pivots; the square is used up."""
    n = a.shape[0]
    out[:] = 0.0
    for i in range(n):
        out[i, i] = 1.0
    for i in range(n):
        best = i
        for row in range(i + 1, n):
            if abs(a[row, i]) > abs(a[best, i]):
                best = row
        for column in range(n):
            a[i, column], a[best, column] = a[best, column], a[i, column]
            out[i, column], out[best, column] = out[best, column], out[i, column]
        factor = 1.0 / a[i, i]
        for column in range(n):
            a[i, column] *= factor
            out[i, column] *= factor
        for row in range(n):
            factor = a[row, i]
            if row != i and factor != 0.0:
                for column in range(n):
                    a[row, column] -= factor * a[i, column]
                    out[row, column] -= factor * out[i, column]


@compiled
def product(a, b, out):
    """Product of two matrices."""
    for i in range(a.shape[0]):
        for k in range(b.shape[1]):
            total = 0.0
            for m in range(a.shape[1]):
                total += a[i, m] * b[m, k]
            out[i, k] = total


@compiled
def turn_vector(angle, values, pair):
    """Turn two components of a vector by an angle; none where its places are negative."""
    a = pair[0]
    b = pair[1]
    if a < 0:
        return
    co, si = np.cos(angle), np.sin(angle)
    values[a], values[b] = co * values[a] - si * values[b], si * values[a] + co * values[b]


@compiled
def go_round(blocks, time, places, speeds):
    """Turn places, velocities and turns of each ball about the axis as it goes round in a time: a
    motion that is steady for who goes with the ball is then steady for the method.
    """
    for j in range(blocks.orbits.size):
        angle = time * blocks.orbits[j]
        turn_vector(angle, places, blocks.across[j, 0])
        turn_vector(angle, speeds, blocks.across[j, 0])
        turn_vector(angle, speeds, blocks.across[j, 1])


@compiled
def set_orbits(blocks, places, speeds):
    """Speeds at which the balls go round."""
    for j in range(blocks.orbits.size):
        a = blocks.across[j, 0, 0]
        b = blocks.across[j, 0, 1]
        if a >= 0:
            square = places[a] * places[a] + places[b] * places[b]
            blocks.orbits[j] = (places[a] * speeds[b] - places[b] * speeds[a]) / square


@compiled
def place_stage(data, base, delay, speed, blocks, y, dy):
    """State at a stage: all but the speeds follow over the time `delay`."""
    first = data.bearing.mechanical - speed.size
    for k in range(first):
        y[k] = base[k] + delay * speed[k]
    for j in range(blocks.orbits.size):
        a = blocks.across[j, 0, 0]
        b = blocks.across[j, 0, 1]
        if a >= 0:  # x = base + delay (v - orbit x)
            e = delay * blocks.orbits[j]
            less = 1.0 / (1.0 + e * e)
            y[a], y[b] = less * (y[a] + e * y[b]), less * (y[b] - e * y[a])
    copy(speed, y[first : first + speed.size])
    for k in range(data.bearing.mechanical, y.size):
        y[k] = base[k] + delay * dy[k]


@compiled
def rates_at(data, t, base, delay, speed, blocks, y, dy):
    """State and rates at a stage."""
    place_stage(data, base, delay, speed, blocks, y, dy)
    solved_derivative(t, y, data, dy)


@inlined
def ball_columns(data, t, j, delay, blocks, scale, rates):
    """Slopes over one ball's speeds, coordinates following: of its own rates and the bodies'."""
    p = data.bearing
    c = p.constants
    y = data.full_state
    members = blocks.members[j]
    first = p.mechanical - scale.size
    acceleration = schedule_at(data.times, data.schedule, t, p.prescribed)
    placed = place_bodies(c.balls, y, p.prescribed[INNER_SPEED], p.prescribed[OUTER_SPEED])
    total = p.loads.copy()
    p.loads[:] = 0.0
    ball_alone(data, placed, y, j)
    others = total - p.loads
    for k in range(members.size):
        column = members[k]
        step = scale[column]
        at = data.solved[first + column]
        kept = y[at]
        moved = data.solved[column] if column < first else at
        place = y[moved]
        if column < first:
            y[moved] = place + delay * step
        y[at] = kept + step
        copy_rows(others, p.loads)
        ball_alone(data, placed, y, j)
        ball_rates(p, data.balls[j], t, acceleration, y, j, data.rates)
        ring_equations(p, t, y, acceleration, placed[0], data.rates)
        cage_equations(p, y, placed[2], data.rates)
        outer_equations(p, t, y, data.rates)
        for i in range(members.size):
            rate = data.rates[data.solved[first + members[i]]]
            blocks.own[j, i, k] = (rate - rates[members[i]]) / step
        for i in range(blocks.bodies.size):
            rate = data.rates[data.solved[first + blocks.bodies[i]]]
            blocks.onto[j, i, k] = (rate - rates[blocks.bodies[i]]) / step
        y[moved] = place
        y[at] = kept
    copy_rows(total, p.loads)


@compiled
def slopes(data, t, base, delay, speed, blocks, scale, y, dy):
    """Slopes of the accelerations over the speeds, coordinates following, by blocks."""
    members = blocks.members
    bodies = blocks.bodies
    first = data.bearing.mechanical - speed.size
    rates = np.empty(speed.size)
    rates_at(data, t, base, delay, speed, blocks, y, dy)
    copy(dy[first : first + speed.size], rates)
    # 1. columns of the bodies, by all contacts
    for k in range(bodies.size):
        column = bodies[k]
        kept = speed[column]
        speed[column] = kept + scale[column]
        rates_at(data, t, base, delay, speed, blocks, y, dy)
        speed[column] = kept
        for i in range(bodies.size):
            blocks.border[i, k] = (dy[first + bodies[i]] - rates[bodies[i]]) / scale[column]
        for j in range(members.shape[0]):
            for i in range(members.shape[1]):
                row = members[j, i]
                blocks.back[j, i, k] = (dy[first + row] - rates[row]) / scale[column]
    # 2. columns of each ball, by its own
    rates_at(data, t, base, delay, speed, blocks, y, dy)
    for j in range(members.shape[0]):
        ball_columns(data, t, j, delay, blocks, scale, rates)


@compiled
def factorise(delay, blocks):
    """Inverses of 1 - delay times the slopes: of each ball's block, and of what the balls leave of
    the bodies'.
    """
    border = blocks.border
    size = blocks.own.shape[1]
    n = border.shape[0]
    block = np.empty((size, size))
    wide = np.empty((size, n))
    square = np.empty((n, n))
    border *= -delay
    for i in range(n):
        border[i, i] += 1.0
    for j in range(blocks.own.shape[0]):
        for i in range(size):
            for k in range(size):
                block[i, k] = (1.0 if i == k else 0.0) - delay * blocks.own[j, i, k]
            for k in range(n):
                blocks.back[j, i, k] *= -delay
                blocks.onto[j, k, i] *= -delay
        invert(block, blocks.own[j])
        product(blocks.own[j], blocks.back[j], wide)
        copy_rows(wide, blocks.back[j])
        product(blocks.onto[j], wide, square)
        for i in range(n):
            for k in range(n):
                border[i, k] -= square[i, k]
    copy_rows(border, square)
    invert(square, border)


@compiled
def solve_blocks(blocks, residual, change):
    """Solution by the inverses of `factorise`."""
    members = blocks.members
    bodies = blocks.bodies
    right = np.empty(bodies.size)
    for i in range(bodies.size):
        right[i] = residual[bodies[i]]
    # 1. each ball as if the bodies kept their speeds, and what that does to them
    for j in range(members.shape[0]):
        for i in range(members.shape[1]):
            total = 0.0
            for k in range(members.shape[1]):
                total += blocks.own[j, i, k] * residual[members[j, k]]
            change[members[j, i]] = total
        for i in range(bodies.size):
            for k in range(members.shape[1]):
                right[i] -= blocks.onto[j, i, k] * change[members[j, k]]
    # 2. bodies, and what their change does to the balls
    for i in range(bodies.size):
        total = 0.0
        for k in range(bodies.size):
            total += blocks.border[i, k] * right[k]
        change[bodies[i]] = total
    for j in range(members.shape[0]):
        for i in range(members.shape[1]):
            for k in range(bodies.size):
                change[members[j, i]] -= blocks.back[j, i, k] * change[bodies[k]]


@compiled
def largest(change, scale):
    """Largest component over its scale; not a number where one is none."""
    worst = 0.0
    for m in range(change.size):
        size = abs(change[m]) / scale[m]
        if not size <= worst:
            worst = size
    return worst


@compiled
def stage(data, t, base, start, delay, speed, blocks, scale, y, dy, held, counters):
    """Speeds of a stage from a guess, v = start + delay A(v) for who goes round with each ball:
    whether they were found. held: whether slopes are there; they are afterwards.
    """
    first = data.bearing.mechanical - speed.size
    residual = np.empty(speed.size)
    change = np.empty(speed.size)
    before = 0.0
    since = 0
    taken = 0
    for _ in range(ITERATIONS):
        if not held:
            if taken == JACOBIANS:
                return False
            slopes(data, t, base, delay, speed, blocks, scale, y, dy)
            factorise(delay, blocks)
            counters[EVALUATIONS] += 2 + blocks.bodies.size + blocks.members.shape[1]
            taken += 1
            since = 0
        rates_at(data, t, base, delay, speed, blocks, y, dy)
        counters[EVALUATIONS] += 1
        for k in range(speed.size):
            residual[k] = start[k] + delay * dy[first + k] - speed[k]
        for j in range(blocks.orbits.size):
            e = delay * blocks.orbits[j]
            for k in range(2):
                a = blocks.across[j, k, 0]
                b = blocks.across[j, k, 1]
                if a >= 0:
                    residual[a] += e * speed[b]
                    residual[b] -= e * speed[a]
        solve_blocks(blocks, residual, change)
        now = largest(change, scale)
        if not np.isfinite(now):
            return False
        for k in range(speed.size):
            speed[k] += change[k]
        if now <= 1.0:
            place_stage(data, base, delay, speed, blocks, y, dy)
            return True
        since += 1
        held = since < MANY and (since == 1 or now <= SLOW * before)
        before = now
    return False


@compiled
def implicit_step(t, y, step, data, change, blocks, scale, trial, dy, held, counters):
    """State after a step, in `trial`: whether it was found. change: of the speeds in the step
    before, for who goes round.
    """
    first = data.bearing.mechanical - scale.size
    delay = GAMMA * step
    share = (1.0 - GAMMA) / GAMMA
    base = y.copy()
    start = y[first : first + scale.size].copy()
    set_orbits(blocks, base, start)
    # 1. first stage
    go_round(blocks, delay, base, start)
    speed = start + GAMMA * change
    dy[data.bearing.mechanical :] = 0.0
    if not stage(
        data, t + delay, base, start, delay, speed, blocks, scale, trial, dy, held, counters
    ):
        return False
    # 2. second stage, to the end of the step
    for k in range(y.size):
        base[k] += share * (trial[k] - base[k])
    for k in range(scale.size):
        moved = speed[k] - start[k]
        start[k] += share * moved
        speed[k] = start[k] + moved
    go_round(blocks, step - delay, base, start)
    go_round(blocks, step - delay, trial, speed)
    if not stage(
        data, t + step, base, start, delay, speed, blocks, scale, trial, dy, True, counters
    ):
        return False
    rates_at(data, t + step, base, delay, speed, blocks, trial, dy)
    return True


@compiled
def advance_slowly(t, y, h, data, longest, friction, scale, blocks, history, counters, record):
    """Steps of at most `longest` to each time of a record, and its rows. Status, rows written,
    time, next step.

    friction: an error of velocity by the slopes of the friction that counts as one.
    """
    p = data.bearing
    p.implicit_step[0] = 0.0
    first = p.mechanical - scale.size
    dy = np.zeros(y.size)
    trial = np.zeros(y.size)
    change = np.zeros(scale.size)
    kept = 0
    used = 0.0
    calm = 0
    forget_slopes(data.balls)
    solved_derivative(t, y, data, dy)
    renew_friction(data, data.full_state, counters[STEPS], h, friction)
    renew_pockets(p, data.balls, data.full_state, counters[STEPS], h, friction)
    begin_steps(data)
    for row in range(record.time.size):
        end = record.time[row]
        while t < end:
            # 1. equal steps to the sample; slopes serve some of the same length
            h = min(h, longest)
            step = (end - t) / np.ceil((end - t) / h * (1.0 - ROUNDING))
            held = kept > 0 and SAME * used < step < used / SAME
            if not held:
                kept = KEPT
                used = step
            # 2. a step; where it fails, a shorter one
            if not implicit_step(
                t, y, step, data, change, blocks, scale, trial, dy, held, counters
            ):
                counters[REJECTED] += 1
                h = 0.5 * step
                kept = 0
                calm = 0
                change[:] = 0.0
                if h < SHORTEST * longest:
                    return TOO_SMALL, row, t, h
                continue
            # 3. accepted
            speeds = y[first : first + scale.size]
            go_round(blocks, step, y, speeds)
            for k in range(scale.size):
                change[k] = trial[first + k] - speeds[k]
            copy(trial, y)
            t = end if end - t <= step * (1.0 + ROUNDING) else t + step
            counters[STEPS] += 1
            kept -= 1
            calm += 1
            renew_friction(data, data.full_state, counters[STEPS], step, friction)
            renew_pockets(p, data.balls, data.full_state, counters[STEPS], step, friction)
            end_step(t, y, step, data, history)
            if calm >= CALM:
                h = 2.0 * h
                calm = 0
        sample(y, data, history, record, row)
    return DONE, record.time.size, t, h

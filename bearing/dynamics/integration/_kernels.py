"""Dormand and Prince's method of order 5(4) around the equations of motion, compiled as a whole.

Coefficients: Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19-26; test for stiffness:
Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2. The last stage of a
step is the first of the next. After a step the memory of the impacts is brought up to date; that
of a contact does not change while it lasts, and does not count while there is none, so the
derivative stays valid. Work and dissipation are integrated along, outside the error control.
"""

import numpy as np

from ehl.compiled import compiled, inlined
from ehl.oil._kernels import copy, copy_rows

from .._kernels import energies, put, solved_derivative
from .._state_kernels import ball_turn, plus, times, vector
from ..arrays import (
    ACCUMULATORS,
    CAGE_LOAD,
    CONTACT,
    EXPONENT,
    FILM,
    INNER,
    LAND,
    LOAD_COLUMNS,
    POCKET,
    STEP_FILM,
    STEP_LOAD,
    STIFFNESS,
    WORK,
)
from ..contact._kernels import elastic_force
from ._clock_kernels import forget_slopes, renew_friction, renew_pockets

A = np.array(
    [
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
C = np.array([1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
E = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
STAGES = 7
# rows of the stages beside the seven derivatives: states of stage 6 and 7
STATE_6 = 7
STATE_7 = 8
STAGE_ROWS = 9
# step control: new step = safety times step times error^(-1/5), between the two limits
SAFETY = 0.9
SMALLEST_FACTOR = 0.2
LARGEST_FACTOR = 5.0
FEW_ERRORS = (SAFETY / LARGEST_FACTOR) ** 5  # a step grows by the largest factor below them
# stiff: h |lambda| beyond the edge of the stability region in fifteen steps, fewer than six not
STIFF_BOUND = 3.25
STIFF_STEPS = 15
SOFT_STEPS = 6
DONE, TOO_SMALL, STIFF, NOT_FINITE = range(4)
STEPS, REJECTED, STIFF_SEEN, SOFT_SEEN, EVALUATIONS = range(5)  # of the counters
COUNTERS = 5
SEPARATED, IN_CONTACT, IN_IMPACT = range(3)  # states of a contact
# duration of an elastic impact over largest approach by speed, Hertz (1882)
HERTZ_DURATION = 2.943


@inlined
def stages(t, y, h, data, k, trial):
    """Stages 2 to 7 from the first one in k[0]; then the states of stages 6 and 7."""
    for i in range(STAGES - 1):
        for m in range(y.size):
            trial[m] = y[m]
        for j in range(i + 1):
            share = h * A[i, j]
            for m in range(y.size):
                trial[m] += share * k[j, m]
        if i == STAGES - 3:
            copy(trial, k[STATE_6])
        solved_derivative(t + C[i] * h, trial, data, k[i + 1])
    copy(trial, k[STATE_7])


@compiled
def error_norm(k, h, scale):
    """Largest error of a component over its scale; not a number where a stage is none."""
    worst = 0.0
    for m in range(scale.size):
        error = 0.0
        for j in range(STAGES):
            error += E[j] * k[j, m]
        error = abs(h * error) / scale[m]
        if not error <= worst:
            worst = error
    return worst


@compiled
def stiffness(k, h, scale):
    """h times an estimate of the largest eigenvalue, from the two last stages."""
    top = 0.0
    bottom = 0.0
    for m in range(scale.size):
        top += ((k[STAGES - 1, m] - k[STAGES - 2, m]) / scale[m]) ** 2
        bottom += ((k[STATE_7, m] - k[STATE_6, m]) / scale[m]) ** 2
    return h * np.sqrt(top / bottom) if bottom > 0.0 else 0.0


@compiled
def duration(law, mass, speed):
    """Duration of an elastic impact [s]."""
    power = law[EXPONENT] + 1.0
    deepest = (0.5 * power * mass * speed**2 / law[STIFFNESS]) ** (1.0 / power)
    return HERTZ_DURATION * deepest / speed


@compiled
def contact_state(c, law, approach, speed, age, before):
    """Whether a ball is separated from a race, in contact, or in an impact: within the duration of
    an elastic one of the speed at which the contact began. Impact turns to contact, not back.
    """
    if approach <= 0.0:
        return SEPARATED
    if before == IN_CONTACT:
        return IN_CONTACT
    if speed > c.floor and age < duration(law, c.ball_mass, speed):
        return IN_IMPACT
    return IN_CONTACT


@compiled
def remember_onset(memory, onset, place, contact, floor, t):
    """Speed of approach and time of an open contact; those of a closed one stay as it began."""
    if contact[CONTACT.approach] <= 0.0:
        memory[place] = max(floor, contact[CONTACT.approach_speed])
        onset[place] = t


@compiled
def after_step(p, balls, memory, t, h, history):
    """Memory of the impacts, and the time spent separated, in contact and in impacts."""
    c = p.constants
    onset = history.onset
    states = history.states
    shares = history.shares
    for race in range(2):
        for j in range(c.balls):
            place = race * c.balls + j
            contact = balls[j].race_out[race]
            age = t - onset[place]
            speed = memory[place]
            state = contact_state(
                c, p.normal[race], contact[CONTACT.approach], speed, age, states[race, j]
            )
            states[race, j] = state
            shares[race, j, state] += h
            remember_onset(memory, onset, place, contact, c.floor, t)
    for j in range(c.balls):
        remember_onset(memory, onset, POCKET * c.balls + j, balls[j].pocket_out, c.floor, t)
    for side in range(2):
        remember_onset(memory, onset, LAND * c.balls + side, p.land_out[side], c.floor, t)


@compiled
def mark_films(p, balls):
    """Load and film of the races' contacts as the last `derivative` left them."""
    for race in range(2):
        for j in range(p.constants.balls):
            out = balls[j].race_out[race]
            film = balls[j].films[race]
            film[STEP_LOAD] = elastic_force(p.normal[race], out[CONTACT.approach])
            film[STEP_FILM] = out[CONTACT.film]


@compiled
def add_film_work(p, balls, y):
    """After a step: energy taken up by separating films, -integral of Q dh_c, O(h^2)."""
    if p.friction_kind != FILM:
        return
    place = y.size - ACCUMULATORS + WORK.films
    for race in range(2):
        for j in range(p.constants.balls):
            out = balls[j].race_out[race]
            film = balls[j].films[race]
            load = elastic_force(p.normal[race], out[CONTACT.approach])
            change = out[CONTACT.film] - film[STEP_FILM]
            taken = -0.5 * (load + film[STEP_LOAD]) * change
            y[place] += p.constants.symmetric_copies * taken
    mark_films(p, balls)


@compiled
def remember_turns(balls, whole):
    """Angular velocities of the balls as the last `solved_derivative` had them."""
    for j in range(balls.size):
        place = ball_turn(balls.size, j)
        for i in range(3):
            balls[j].turns[i] = whole[place + i]


@compiled
def turn_balls(balls, whole, h, attitude):
    """Attitudes (w, x, y, z) after a step, right after `solved_derivative` at its end: the
    rotation by the mean angular velocity, O(h^2).
    """
    for j in range(balls.size):
        after = vector(whole, ball_turn(balls.size, j))
        a, b, c = times(0.25 * h, plus(vector(balls[j].turns, 0), after))
        half = np.sqrt(a * a + b * b + c * c)
        s = np.sin(half) / half if half > 0.0 else 1.0
        w = np.cos(half)
        a, b, c = a * s, b * s, c * s
        q0 = attitude[j, 0]
        q1 = attitude[j, 1]
        q2 = attitude[j, 2]
        q3 = attitude[j, 3]
        attitude[j, 0] = w * q0 - a * q1 - b * q2 - c * q3
        attitude[j, 1] = w * q1 + a * q0 + b * q3 - c * q2
        attitude[j, 2] = w * q2 - a * q3 + b * q0 + c * q1
        attitude[j, 3] = w * q3 + a * q2 - b * q1 + c * q0
    remember_turns(balls, whole)


@compiled
def longest_step(p, balls, control):
    """Longest next step: shorter where a ball is pressed harder than `control` counts with, by
    the frequency of its vibration.
    """
    steepest = control.steepest
    for race in range(2):
        law = p.normal[race]
        for j in range(p.constants.balls):
            approach = balls[j].race_out[race, CONTACT.approach]
            if approach > 0.0:
                steepest = max(steepest, elastic_force(law, approach) / approach)
    return control.longest * np.sqrt(control.steepest / steepest)


@inlined
def trial_step(t, y, step, data, control, scale, k, trial, counters):
    """Stages of a step, its error, and whether a law of friction was asked at its end."""
    p = data.bearing
    p.pace[0] = step
    stages(t, y, step, data, k, trial)
    counters[EVALUATIONS] += STAGES - 1
    error = error_norm(k, step, scale)
    if not error <= 1.0:
        return error, False
    number = counters[STEPS] + 1
    renewed = renew_friction(data, data.whole, number, step, control.speed)
    pockets = renew_pockets(p, data.balls, data.whole, number, step, control.speed)
    return error, pockets or renewed


@inlined
def accept_step(t, y, step, data, k, renewed, history, counters):
    """State, attitudes, memory of impacts and work of films after a step that ends at t."""
    turn_balls(data.balls, data.whole, step, history.attitude)
    copy(k[STATE_7], y)
    if renewed:
        solved_derivative(t, y, data, k[0])
        counters[EVALUATIONS] += 1
    else:
        copy(k[STAGES - 1], k[0])
    after_step(data.bearing, data.balls, data.memory, t, step, history)
    add_film_work(data.bearing, data.balls, y)
    counters[STEPS] += 1


@inlined
def advance(t, y, end, h, data, control, scale, k, trial, history, counters):
    """Steps from t to `end`; y, k[0] (its derivative) and the history are brought up to date.
    Status, time, next step.

    Automatic step size and detection of stiffness after Hairer, Norsett and Wanner, Solving
    Ordinary Differential Equations I, section II.4, and II, section IV.2.
    """
    after_rejection = False
    while t < end:
        remaining = end - t
        last = h >= remaining * (1.0 - 1e-9)
        # 1. a trial step and its error
        step = remaining if last else min(h, control.longest)
        error, renewed = trial_step(t, y, step, data, control, scale, k, trial, counters)
        finite = np.isfinite(error)
        factor = SMALLEST_FACTOR
        if error < FEW_ERRORS:
            factor = LARGEST_FACTOR
        elif finite:
            factor = max(SMALLEST_FACTOR, SAFETY * (1.0 / error) ** 0.2)
        # 2. rejected: again with a smaller step
        if not finite or error > 1.0:
            counters[REJECTED] += 1
            h = step * min(factor, 1.0)
            after_rejection = True
            if h < control.shortest:
                return (TOO_SMALL if finite else NOT_FINITE), t, h
            continue
        # 3. accepted
        t = end if last else t + step
        stiff = count_stiff(stiffness(k, step, scale), counters)
        accept_step(t, y, step, data, k, renewed, history, counters)
        # 4. next step, not longer right after a rejection
        grown = step * (min(factor, 1.0) if after_rejection else factor)
        longest = longest_step(data.bearing, data.balls, control)
        h = min(max(h, grown) if last else grown, longest)
        after_rejection = False
        # 5. stiff, with steps too short to go on like this
        if stiff and step < control.stiff:
            return STIFF, t, h
    return DONE, t, h


@compiled
def count_stiff(value, counters):
    """Whether the problem looked stiff in fifteen steps with fewer than six that did not."""
    if value > STIFF_BOUND:
        counters[SOFT_SEEN] = 0
        counters[STIFF_SEEN] += 1
    else:
        counters[SOFT_SEEN] += 1
        if counters[SOFT_SEEN] == SOFT_STEPS:
            counters[STIFF_SEEN] = 0
    return counters[STIFF_SEEN] >= STIFF_STEPS


@compiled
def sample(y, data, history, record, row):
    """One row of a `Record`, right after `solved_derivative` of the state.

    An open contact has no film there; its film goes on over the gap for `add_film_work` alone.
    """
    p = data.bearing
    put(y, data.solved, data.whole)
    copy(data.whole, record.state[row])
    for j in range(p.constants.balls):
        ball = data.balls[j]
        for race in range(2):
            copy(ball.race_out[race], record.races[row, race, j])
            if ball.race_out[race, CONTACT.approach] <= 0.0:
                record.races[row, race, j, CONTACT.film] = 0.0
        copy(ball.pocket_out, record.pockets[row, j])
    energies(data.whole, data, record.energy[row])
    copy(p.loads[INNER], record.loads[row, :LOAD_COLUMNS])
    copy(p.loads[CAGE_LOAD], record.loads[row, LOAD_COLUMNS:])
    copy_rows(history.states, record.contact_state[row])
    copy_rows(history.attitude, record.attitude[row])


@compiled
def begin_steps(data):
    """Before steps, right after `solved_derivative` of the state."""
    remember_turns(data.balls, data.whole)
    mark_films(data.bearing, data.balls)


@compiled
def end_step(t, y, step, data, history):
    """After a step to a time `t` and `solved_derivative` there: attitudes, memory of impacts, work
    of films.
    """
    turn_balls(data.balls, data.whole, step, history.attitude)
    after_step(data.bearing, data.balls, data.memory, t, step, history)
    add_film_work(data.bearing, data.balls, y)


@compiled
def advance_samples(t, y, h, data, control, scale, k, trial, history, counters, record):
    """`advance` to each time of a record, and its rows. Status, rows written, time, next step."""
    p = data.bearing
    p.pace[0] = h
    forget_slopes(data.balls)
    solved_derivative(t, y, data, k[0])
    renew_friction(data, data.whole, counters[STEPS], h, control.speed)
    renew_pockets(p, data.balls, data.whole, counters[STEPS], h, control.speed)
    solved_derivative(t, y, data, k[0])
    remember_turns(data.balls, data.whole)
    mark_films(p, data.balls)
    for row in range(record.time.size):
        end = record.time[row]
        status, t, h = advance(t, y, end, h, data, control, scale, k, trial, history, counters)
        if status != DONE:
            return status, row, t, h
        sample(y, data, history, record, row)
    return DONE, record.time.size, t, h

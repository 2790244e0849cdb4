"""Dormand and Prince's method of order 5(4) around the equations of motion, with its step control
and the slopes of the friction in the motions, compiled as a whole.

Coefficients: Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19-26; test for stiffness:
Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2. The last stage of a
step is the first of the next. After a step the speeds of the impacts are brought up to date; that
of a contact does not change while it lasts, and does not count while there is none, so the
derivative stays valid. Work and dissipation are integrated along, outside the error control.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled, inlined
from oilfilm.ehl.oil._kernels import copy, copy_rows

from ._cage_kernels import (
    INTERVAL,
    ball_in_pocket,
    cage_direction,
    film_by_matrix,
    film_matrix,
    film_matrix_is_valid,
    pocket_film_gap,
    pocket_frame,
    pocket_motion,
)
from ._implicit_kernels import motion_of
from ._motion_kernels import (
    ball_rates,
    cage_equations,
    energies,
    outer_equations,
    place_bodies,
    put,
    ring_equations,
    schedule_at,
    solved_derivative,
    take,
)
from ._race_kernels import (
    FORCES,
    ball_on_race,
    elastic_force,
    friction_by_slopes,
    friction_law,
    load_changed,
    set_friction,
    set_slopes,
    slopes_hold,
)
from ._state_kernels import (
    ball_motion,
    ball_turn,
    minus,
    norm,
    plus,
    point_velocity,
    times,
    vector,
    velocities,
)
from .arrays import (
    ACCUMULATORS,
    BODIES,
    CAGE_LOAD,
    CONTACT,
    EXPONENT,
    FILM,
    FRICTIONLESS,
    INNER,
    INNER_SPEED,
    LAND,
    LINEAR,
    LOAD_COLUMNS,
    OIL_VISCOSITY,
    OUTER,
    OUTER_SPEED,
    POCKET,
    STEP_FILM,
    STEP_LOAD,
    STIFFNESS,
    WORK,
)

LONGEST_INTERVAL = 8.0  # [steps]
# errors of the friction over that which counts as one: slopes are taken anew above it, the law
# is asked twice as often above it, half as often below it [-]
STEEP = 0.1
LARGE = 0.25
SMALL = 0.05

OF_BODIES = -1  # in place of a ball: a coordinate of ring or cage

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


@compiled
def costs_little(coefficient):
    """True of a law that is asked in every evaluation: a coefficient at the contact's centre."""
    if coefficient is not None:
        return coefficient.disc.shape[1] == 1
    return False


@compiled
def friction_error(c, linear, friction, time, speed):
    """Error of a ball's velocity that the slopes led to within a time, over a speed."""
    force = abs(friction[0] - linear[0]) + abs(friction[1] - linear[1])
    moment = abs(friction[2] - linear[2]) + abs(friction[3] - linear[3])
    mobility = 1.0 / c.ball_mass + c.ball_radius * c.ball_radius / c.ball_inertia
    return 0.5 * time * mobility * (force + moment / c.ball_radius) / speed


@compiled
def renew_contact(c, data, load, motion, linear, predicted_friction, friction, time, speed):
    """Friction of one contact from its law, and after how many steps again."""
    held = slopes_hold(linear, load, motion)
    if held:
        friction_by_slopes(c.mirrored, linear, load, motion, friction)
        copy(friction[:FORCES], predicted_friction)
    motions = (motion.slide_x, motion.slide_y, motion.spin)
    friction_law(
        c.mirrored, data.coefficient, data.table, load, motion.entrainment, motions, friction
    )
    error = 0.0
    interval = linear[LINEAR.interval]
    if held:
        error = friction_error(c, predicted_friction, friction, interval * time, speed)
    changed = abs(load - linear[LINEAR.load]) > 0.2 * load
    set_friction(linear, load, motion, friction)
    if not held or error > STEEP or changed:
        set_slopes(c, data, load, motion, linear, friction, time)
    if not held or error > LARGE:
        linear[LINEAR.interval] = 1.0
    elif error < SMALL:
        linear[LINEAR.interval] = min(LONGEST_INTERVAL, 2.0 * interval)


@compiled
def forget_slopes(balls):
    """Slopes of friction and matrices of films, so that all are due at the next step."""
    for j in range(balls.size):
        linear = balls[j].linear
        linear[:] = 0.0
        linear[:, LINEAR.interval] = 1.0
        film = balls[j].pocket_films
        film[:] = 0.0
        film[INTERVAL] = 1.0


@compiled
def renew_friction(data, y, step, time, speed):
    """Ask the law of the contacts that are due at a state whose `derivative` was just taken:
    whether there were any.

    step: number of this one. speed: an error of velocity that counts as one.
    """
    p = data.bearing
    c = p.constants
    if p.friction_kind == FRICTIONLESS or costs_little(data.friction_inner.coefficient):
        return False
    inner, outer, _ = place_bodies(
        c.balls, y, p.prescribed[INNER_SPEED], p.prescribed[OUTER_SPEED]
    )
    some = False
    for race in range(2):
        body = inner if race == INNER else outer
        for j in range(c.balls):
            ball = data.balls[j]
            linear = ball.linear[race]
            load = elastic_force(p.normal[race], ball.race_out[race, CONTACT.approach])
            if load <= 0.0:
                linear[LINEAR.load] = 0.0
                linear[LINEAR.interval] = 1.0
            due = step % int(linear[LINEAR.interval]) == 0
            if load <= 0.0 or not (due or load_changed(linear, load)):
                continue
            some = True
            motion = motion_of(c, race, body, y, j)
            law = data.friction_inner if race == INNER else data.friction_outer
            renew_contact(
                c, law, load, motion, linear, p.predicted_friction, p.friction, time, speed
            )
    return some


@compiled
def renew_pocket(c, frame, play, motion, film, time, speed):
    """The matrix of one pocket's film anew, and when again; time: of a step, times the viscosity
    over that of the matrix.
    """
    place, velocity, turn = motion
    error = 0.0
    held = film_matrix_is_valid(c, film, pocket_film_gap(play, place))
    interval = film[INTERVAL]
    if held:
        force, moment, _ = film_by_matrix(c, film, velocity, turn)
    film_matrix(c, frame, play, place, velocity, film)
    film[INTERVAL] = 1.0
    if held:
        real, about, _ = film_by_matrix(c, film, velocity, turn)
        off = norm(minus(real, force)) + norm(minus(about, moment)) / c.ball_radius
        mobility = 1.0 / c.ball_mass + c.ball_radius * c.ball_radius / c.ball_inertia
        error = 0.5 * interval * time * mobility * off / speed
        if error < SMALL:
            film[INTERVAL] = min(LONGEST_INTERVAL, 2.0 * interval)
        elif error < LARGE:
            film[INTERVAL] = interval


@compiled
def renew_pockets(p, balls, y, step, time, speed):
    """`renew_friction` of the films in the pockets: whether there were any to renew."""
    c = p.constants
    if c.cage_mass <= 0.0 or c.film_viscosity * c.pocket_height <= 0.0:
        return False
    some = False
    _, _, body = place_bodies(c.balls, y, p.prescribed[INNER_SPEED], p.prescribed[OUTER_SPEED])
    turned = cage_direction(y)
    for j in range(c.balls):
        ball = balls[j]
        film = ball.pocket_films
        due = step % int(film[INTERVAL]) == 0
        # in a round pocket the film's gap is wider by what the ball is off along the pocket's axis
        if not due and film_matrix_is_valid(c, film, -ball.pocket_out[CONTACT.approach]):
            continue
        some = True
        position, velocity, turn = ball_motion(y, c.balls, j)
        frame = pocket_frame(c, body, ball.pocket_direction, turned)
        place = pocket_motion(c, body, frame, position)[2]
        relative = minus(velocity, point_velocity(body, position))
        motion = (place, relative, minus(turn, body.turn))
        time_of_film = p.prescribed[OIL_VISCOSITY] * time
        renew_pocket(c, frame, ball.pocket_play, motion, film, time_of_film, speed)
    return some


@compiled
def ball_of(balls, index):
    """The ball that a coordinate or speed of the state vector belongs to, or `OF_BODIES`."""
    first = velocities(balls)
    inside = index - BODIES if index < first else index - first - BODIES
    if inside < 0:
        return OF_BODIES
    return (inside // 3) % balls


@compiled
def balls_act_alone(c):
    """No ball acts on another but through ring and cage, and each stands for itself."""
    return c.symmetric_copies == 1 and c.cage_mass > 0.0


@compiled
def ball_alone(data, bodies, y, j):
    """Contacts of one ball: forces on it, added to the loads of rings and cage."""
    p = data.bearing
    ball = data.balls[j]
    impact_speeds = data.impact_speeds
    inner, outer, cage = bodies
    ball.forces[:] = 0.0
    forms = data.inner_form, data.ball_form[INNER]
    ball_on_race(p, ball, data.friction_inner, forms, impact_speeds, INNER, inner, y, j)
    forms = data.outer_form, data.ball_form[OUTER]
    ball_on_race(p, ball, data.friction_outer, forms, impact_speeds, OUTER, outer, y, j)
    ball_in_pocket(p, ball, impact_speeds, cage, cage_direction(y), y, j)


@compiled
def difference(data, base, owner, ball, column, step, out):
    """A column of slopes from the rates now: rows of ring and cage, and of a ball or all balls."""
    for row in range(owner.size):
        if ball == OF_BODIES or owner[row] == OF_BODIES or owner[row] == ball:
            out[row, column] = (data.rates[data.solved[row]] - base[row]) / step


@inlined
def columns_of_ball(data, t, j, base, owner, scale, out):
    """Columns of one ball, by its contacts alone; `p.loads` are those of all balls, before and
    after.
    """
    p = data.bearing
    c = p.constants
    y = data.full_state
    acceleration = schedule_at(data.times, data.schedule, t, p.prescribed)
    bodies = place_bodies(c.balls, y, p.prescribed[INNER_SPEED], p.prescribed[OUTER_SPEED])
    total = p.loads.copy()
    p.loads[:] = 0.0
    ball_alone(data, bodies, y, j)
    others = total - p.loads
    for column in range(owner.size):
        if owner[column] != j:
            continue
        place = data.solved[column]
        kept = y[place]
        y[place] = kept + scale[column]
        copy_rows(others, p.loads)
        ball_alone(data, bodies, y, j)
        ball_rates(p, data.balls[j], t, acceleration, y, j, data.rates)
        ring_equations(p, t, y, acceleration, bodies[0], data.rates)
        cage_equations(p, y, bodies[2], data.rates)
        outer_equations(p, t, y, data.rates)
        difference(data, base, owner, j, column, scale[column], out)
        y[place] = kept
    copy_rows(total, p.loads)


@compiled
def jacobian(t, y, data, scale, out):
    """Slopes of the rates of coordinates and speeds that are solved over them, shape (mechanical,
    mechanical), by one-sided differences of steps `scale`.
    """
    c = data.bearing.constants
    size = scale.size
    base = np.zeros(y.size)
    rates = np.zeros(y.size)
    owner = np.zeros(size, np.int64)
    alone = balls_act_alone(c)
    for column in range(size):
        owner[column] = ball_of(c.balls, data.solved[column])
    solved_derivative(t, y, data, base)
    # 1. ring and cage, and balls that act on each other, by all contacts
    for column in range(size):
        if alone and owner[column] != OF_BODIES:
            continue
        kept = y[column]
        y[column] = kept + scale[column]
        solved_derivative(t, y, data, rates)
        difference(data, base, owner, OF_BODIES, column, scale[column], out)
        y[column] = kept
    # 2. each ball by its own
    solved_derivative(t, y, data, rates)
    if alone:
        for j in range(c.balls):
            columns_of_ball(data, t, j, base, owner, scale, out)


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
    """State of a ball: separated from a race, in contact, or in an impact, within the duration of
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
def remember_onset(impact_speeds, onset, row, contact, floor, t):
    """Speed of approach and time of an open contact; those of a closed one stay as it began."""
    if contact[CONTACT.approach] <= 0.0:
        impact_speeds[row] = max(floor, contact[CONTACT.approach_speed])
        onset[row] = t


@compiled
def after_step(p, balls, impact_speeds, t, h, history):
    """Memory of the impacts, and the time spent separated, in contact and in impacts: whether an
    impact is over, so that its contact lasts and is damped by its film.
    """
    ended = False
    c = p.constants
    onset = history.onset
    states = history.states
    shares = history.shares
    for race in range(2):
        for j in range(c.balls):
            place = race * c.balls + j
            contact = balls[j].race_out[race]
            age = t - onset[place]
            speed = impact_speeds[place]
            state = contact_state(
                c, p.normal[race], contact[CONTACT.approach], speed, age, states[race, j]
            )
            if states[race, j] == IN_IMPACT and state == IN_CONTACT:
                impact_speeds[place] = c.floor
                ended = True
            states[race, j] = state
            shares[race, j, state] += h
            remember_onset(impact_speeds, onset, place, contact, c.floor, t)
    for j in range(c.balls):
        remember_onset(impact_speeds, onset, POCKET * c.balls + j, balls[j].pocket_out, c.floor, t)
    for side in range(2):
        remember_onset(impact_speeds, onset, LAND * c.balls + side, p.land_out[side], c.floor, t)
    return ended


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
def remember_turns(balls, full_state):
    """Angular velocities of the balls as the last `solved_derivative` had them."""
    for j in range(balls.size):
        place = ball_turn(balls.size, j)
        for i in range(3):
            balls[j].turns[i] = full_state[place + i]


@compiled
def turn_balls(balls, full_state, h, attitude):
    """Attitudes (w, x, y, z) after a step, right after `solved_derivative` at its end: the
    rotation by the mean angular velocity, O(h^2).
    """
    for j in range(balls.size):
        after = vector(full_state, ball_turn(balls.size, j))
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
    remember_turns(balls, full_state)


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
    p.implicit_step[0] = step
    stages(t, y, step, data, k, trial)
    counters[EVALUATIONS] += STAGES - 1
    error = error_norm(k, step, scale)
    if not error <= 1.0:
        return error, False
    number = counters[STEPS] + 1
    renewed = renew_friction(data, data.full_state, number, step, control.speed)
    pockets = renew_pockets(p, data.balls, data.full_state, number, step, control.speed)
    return error, pockets or renewed


@inlined
def accept_step(t, y, step, data, k, renewed, history, counters):
    """State, attitudes, speeds of impacts and work of films after a step that ends at t."""
    turn_balls(data.balls, data.full_state, step, history.attitude)
    take(data.full_state, data.solved, y)  # with what is held in its place
    ended = after_step(data.bearing, data.balls, data.impact_speeds, t, step, history)
    if renewed or ended:
        solved_derivative(t, y, data, k[0])
        counters[EVALUATIONS] += 1
    else:
        copy(k[STAGES - 1], k[0])
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
    """The problem looked stiff in fifteen steps with fewer than six that did not."""
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
    put(y, data.solved, data.full_state)
    copy(data.full_state, record.state[row])
    for j in range(p.constants.balls):
        ball = data.balls[j]
        for race in range(2):
            copy(ball.race_out[race], record.races[row, race, j])
            if ball.race_out[race, CONTACT.approach] <= 0.0:
                record.races[row, race, j, CONTACT.film] = 0.0
        copy(ball.pocket_out, record.pockets[row, j])
    energies(data.full_state, data, record.energy[row])
    copy(p.loads[INNER], record.loads[row, :LOAD_COLUMNS])
    copy(p.loads[CAGE_LOAD], record.loads[row, LOAD_COLUMNS:])
    first = velocities(p.constants.balls)
    copy(data.rates[first : first + BODIES], record.acceleration[row])
    copy_rows(history.states, record.contact_state[row])
    copy_rows(history.attitude, record.attitude[row])


@compiled
def begin_steps(data):
    """Before steps, right after `solved_derivative` of the state."""
    remember_turns(data.balls, data.full_state)
    mark_films(data.bearing, data.balls)


@compiled
def end_step(t, y, step, data, history):
    """After a step to a time `t` and `solved_derivative` there: attitudes, speeds of impacts, work
    of films.
    """
    turn_balls(data.balls, data.full_state, step, history.attitude)
    after_step(data.bearing, data.balls, data.impact_speeds, t, step, history)
    add_film_work(data.bearing, data.balls, y)


@compiled
def advance_samples(t, y, h, data, control, scale, k, trial, history, counters, record):
    """`advance` to each time of a record, and its rows. Status, rows written, time, next step."""
    p = data.bearing
    p.implicit_step[0] = h
    forget_slopes(data.balls)
    solved_derivative(t, y, data, k[0])
    renew_friction(data, data.full_state, counters[STEPS], h, control.speed)
    renew_pockets(p, data.balls, data.full_state, counters[STEPS], h, control.speed)
    solved_derivative(t, y, data, k[0])
    remember_turns(data.balls, data.full_state)
    mark_films(p, data.balls)
    for row in range(record.time.size):
        end = record.time[row]
        status, t, h = advance(t, y, end, h, data, control, scale, k, trial, history, counters)
        if status != DONE:
            return status, row, t, h
        sample(y, data, history, record, row)
    return DONE, record.time.size, t, h

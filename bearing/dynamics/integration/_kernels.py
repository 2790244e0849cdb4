"""Dormand and Prince's method of order 5(4) around the equations of motion, compiled as a whole.

Coefficients: Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19-26; test for stiffness:
Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2. The last stage of a
step is the first of the next. After a step the memory of the impacts is brought up to date; that
of a contact does not change while it lasts, and does not count while there is none, so the
derivative stays valid. Work and dissipation are integrated along, outside the error control.
"""

import numpy as np

from ehl.compiled import compiled

from .._kernels import derivative, energies
from ..contact._kernels import elastic_force
from ..problem import APPROACH, EXPONENT, FILM, FILMS, STIFFNESS, THICKNESS

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
SAFETY = 0.9
SHRINK = 0.2
GROW = 5.0
STIFF_BOUND = 3.25
STIFF_STEPS = 15
SOFT_STEPS = 6
DONE, TOO_SMALL, STIFF, NOT_FINITE = range(4)
STEPS, REJECTED, STIFF_SEEN, SOFT_SEEN, EVALUATIONS = range(5)  # of the counters
# duration of an elastic impact over largest approach by speed, Hertz (1882)
HERTZ_DURATION = 2.943


@compiled
def stages(t, y, h, p, k, trial):
    """Stages 2 to 7 from the first one in k[0]; the new state is left in k[8], that of stage 6 in
    k[7].
    """
    for i in range(6):
        for m in range(y.size):
            total = 0.0
            for j in range(i + 1):
                total += A[i, j] * k[j, m]
            trial[m] = y[m] + h * total
        if i == 4:
            k[7, :] = trial
        derivative(t + C[i] * h, trial, p, k[i + 1])
    k[8, :] = trial


@compiled
def error_norm(k, h, scale):
    """Largest error of a component over its scale; not a number where a stage is none."""
    worst = 0.0
    for m in range(scale.size):
        error = 0.0
        for j in range(7):
            error += E[j] * k[j, m]
        error = abs(h * error) / scale[m]
        if not error <= worst:
            worst = error
    return worst


@compiled
def stiffness(k, h, scale):
    """h times an estimate of the largest eigenvalue, from the two stages at the end of the step."""
    top = 0.0
    bottom = 0.0
    for m in range(scale.size):
        top += ((k[6, m] - k[5, m]) / scale[m]) ** 2
        bottom += ((k[8, m] - k[7, m]) / scale[m]) ** 2
    return h * np.sqrt(top / bottom) if bottom > 0.0 else 0.0


@compiled
def duration(stiffness_constant, exponent, mass, speed):
    """Duration of an elastic impact [s]."""
    deepest = (0.5 * (exponent + 1.0) * mass * speed**2 / stiffness_constant) ** (
        1.0 / (exponent + 1.0)
    )
    return HERTZ_DURATION * deepest / speed


@compiled
def remember_one(memory, floor, place, approach, rate, t, onset):
    """Memory of one contact: speed of the approach and time, kept as they were while the contact
    lasts.
    """
    if approach <= 0.0:
        memory[place] = max(floor, rate)
        onset[place] = t


@compiled
def remember(p, t, h, onset, states, shares):
    """After a step: memory of the impacts, and the time spent free (0), in contact (1), in an
    impact (2).
    """
    c = p.constants
    n = p.constants.balls
    for race in range(2):
        law = p.normal[race]
        for j in range(n):
            place = race * n + j
            approach, rate = p.race_out[race, j, 1], p.race_out[race, j, 2]
            state = 0
            if approach > 0.0:
                state = 1
                speed = p.memory[place]
                if speed > c.floor:
                    age = t - onset[place]
                    state = (
                        2
                        if age < duration(law[STIFFNESS], law[EXPONENT], c.ball_mass, speed)
                        else 1
                    )
            remember_one(p.memory, c.floor, place, approach, rate, t, onset)
            states[race, j] = state
            shares[race, j, state] += h
    for j in range(n):
        remember_one(
            p.memory, c.floor, 2 * n + j, p.pocket_out[j, 1], p.pocket_out[j, 2], t, onset
        )
    for side in range(2):
        remember_one(
            p.memory, c.floor, 3 * n + side, p.land_out[side, 0], p.land_out[side, 1], t, onset
        )


@compiled
def mark_films(p):
    """Load and film of the races' contacts as the last `derivative` left them."""
    for race in range(2):
        for j in range(p.constants.balls):
            p.films[race, j, 0] = elastic_force(p.normal[race], p.race_out[race, j, APPROACH])
            p.films[race, j, 1] = p.race_out[race, j, THICKNESS]


@compiled
def add_film_work(p, y):
    """After a step: what films that part the bodies took up, -integral of Q dh_c by trapezoids,
    O(h^2).
    """
    if p.friction_kind != FILM:
        return
    place = 23 + 9 * p.constants.balls + FILMS
    for race in range(2):
        for j in range(p.constants.balls):
            load = elastic_force(p.normal[race], p.race_out[race, j, APPROACH])
            change = p.race_out[race, j, THICKNESS] - p.films[race, j, 1]
            y[place] -= 0.5 * (load + p.films[race, j, 0]) * change
    mark_films(p)


@compiled
def turn_balls(y_before, y_after, h, balls, attitude):
    """Attitudes (w, x, y, z) after a step: the rotation by the mean angular velocity, O(h^2)."""
    first = 22 + 6 * balls
    for j in range(balls):
        m = first + 3 * j
        a = 0.25 * h * (y_before[m] + y_after[m])
        b = 0.25 * h * (y_before[m + 1] + y_after[m + 1])
        c = 0.25 * h * (y_before[m + 2] + y_after[m + 2])
        half = np.sqrt(a * a + b * b + c * c)
        s = np.sin(half) / half if half > 0.0 else 1.0
        w = np.cos(half)
        a = a * s
        b = b * s
        c = c * s
        q0 = attitude[j, 0]
        q1 = attitude[j, 1]
        q2 = attitude[j, 2]
        q3 = attitude[j, 3]
        attitude[j, 0] = w * q0 - a * q1 - b * q2 - c * q3
        attitude[j, 1] = w * q1 + a * q0 + b * q3 - c * q2
        attitude[j, 2] = w * q2 - a * q3 + b * q0 + c * q1
        attitude[j, 3] = w * q3 + a * q2 - b * q1 + c * q0


@compiled
def advance(t, y, end, h, p, control, scale, k, trial, history, counters):
    """Steps from t to `end`; y, k[0] (its derivative) and the history are brought up to date.
    Status, time, next step.

    control: least step, longest step [s], step below which a stiff problem is given back [s].
    history: onset, states, shares, attitude.
    """
    onset, states, shares, attitude = history
    after_rejection = False
    while t < end:
        rest = end - t
        last = h >= rest * (1.0 - 1e-9)
        step = rest if last else min(h, control[1])
        stages(t, y, step, p, k, trial)
        counters[EVALUATIONS] += 6
        error = error_norm(k, step, scale)
        if not np.isfinite(error):
            factor = SHRINK
            accepted = False
        else:
            factor = min(GROW, max(SHRINK, SAFETY * (1.0 / max(error, 1e-10)) ** 0.2))
            accepted = error <= 1.0
        if accepted:
            turn_balls(y, k[8], step, p.constants.balls, attitude)
            t = end if last else t + step
            y[:] = k[8]
            k[0, :] = k[6]
            remember(p, t, step, onset, states, shares)
            add_film_work(p, y)
            counters[STEPS] += 1
            grown = step * (min(factor, 1.0) if after_rejection else factor)
            h = min(max(h, grown) if last else grown, control[1])
            after_rejection = False
            if count_stiff(stiffness(k, step, scale), counters) and step < control[2]:
                return STIFF, t, h
        else:
            counters[REJECTED] += 1
            h = step * min(factor, 1.0)
            after_rejection = True
            if h < control[0]:
                return (NOT_FINITE if not np.isfinite(error) else TOO_SMALL), t, h
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
def sample(y, p, history, record, row):
    """One row of the record: state, contacts, pockets, energies, loads, states, attitudes.

    An open contact has no film there; its film goes on over the gap for `add_film_work` alone.
    """
    states, races, pockets, energy, loads, contact_states, attitudes = record
    states[row] = y
    races[row] = p.race_out
    for race in range(2):
        for j in range(p.constants.balls):
            if p.race_out[race, j, APPROACH] <= 0.0:
                races[row, race, j, THICKNESS] = 0.0
    pockets[row] = p.pocket_out
    energies(y, p, energy[row])
    loads[row, :6] = p.loads[0]
    loads[row, 6:] = p.loads[1]
    contact_states[row] = history[1]
    attitudes[row] = history[3]


@compiled
def advance_samples(t, y, times, h, p, control, scale, k, trial, history, counters, record):
    """`advance` to each of the times, with a row of the record at each. Status, rows written,
    time, next step.
    """
    derivative(t, y, p, k[0])
    mark_films(p)
    for row in range(times.size):
        status, t, h = advance(t, y, times[row], h, p, control, scale, k, trial, history, counters)
        if status != DONE:
            return status, row, t, h
        sample(y, p, history, record, row)
    return DONE, times.size, t, h


@compiled
def jacobian(t, y, p, scale, out):
    """Jacobian of the mechanical equations by forward differences over `scale`, shape (mechanical,
    mechanical).
    """
    base, rates, trial = np.empty(y.size), np.empty(y.size), np.empty(y.size)
    derivative(t, y, p, base)
    for place in range(scale.size):
        trial[:] = y
        trial[place] += scale[place]
        derivative(t, trial, p, rates)
        for m in range(scale.size):
            out[m, place] = (rates[m] - base[m]) / scale[place]

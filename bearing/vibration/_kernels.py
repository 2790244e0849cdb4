"""Equations of motion of rings, sensor and balls, compiled.

Balls keep their places in the cage, which turns as prescribed, and move in their axial planes;
inner ring in five coordinates, outer ring in three, sensor in one:

    m u_j''  = Q_o e_o + Q_i e_i + F_c e_r                    ball; e towards the grooves' centres
    M q''    = F - sum_j J_ij Q_i (- gyroscopic couple)       inner ring
    M_o p''  = F_o - sum_j J_oj Q_o - k p - c p' + sensor     outer ring
    Q        = K d^n + c d', not below zero,   d = distance of ball and centre - (r - D/2) + form

Fourth-order Runge-Kutta steps; works are integrated along with them.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled
from oilfilm.ehl.oil._kernels import copy

from .assembly import (
    BALLS,
    BY_FORM,
    DAMPING,
    ENERGY,
    EXTERNAL,
    FACTOR,
    INNER,
    LOST,
    OUTER,
    SENSOR,
    STORED,
)

TURN = 2.0 * np.pi


@compiled
def law_at(law, approach):
    """Elastic force [N], damping [N s/m] and elastic energy [J] at an approach [m]."""
    if approach <= 0.0:
        return 0.0, 0.0, 0.0
    last = law.table.shape[0] - 1
    place = (np.log(approach) - law.first) / law.step
    place = min(max(place, 0.0), last - 1e-9)
    k = int(place)
    part = place - k
    table = law.table
    factor = table[k, FACTOR] + part * (table[k + 1, FACTOR] - table[k, FACTOR])
    damping = table[k, DAMPING] + part * (table[k + 1, DAMPING] - table[k, DAMPING])
    energy = table[k, ENERGY] + part * (table[k + 1, ENERGY] - table[k, ENERGY])
    power = approach * np.sqrt(approach) if law.exponent == 1.5 else approach
    return factor * power, damping, energy * power * approach


@compiled
def height_at(heights, angle):
    """Height [m] and its slope by the angle [m/rad], linear between the places of a turn."""
    n = heights.size
    place = (angle / TURN - np.floor(angle / TURN)) * n
    k = int(place) % n
    after = heights[(k + 1) % n]
    slope = (after - heights[k]) * n / TURN
    return heights[k] + (place - int(place)) * (after - heights[k]), slope


@compiled
def turned(c, time):
    """Time that would turn all as far at the end's speeds [s], and the ratio of speeds [-]."""
    start = c.start_ratio
    if time <= 0.0:
        return start * time, start
    gain = (1.0 - start) / c.duration
    return start * time + 0.5 * gain * time * time, start + gain * time


@compiled
def groove_motion(c, race, q, v, about):
    """Place of a race's centre of curvature at a ball, axial and radial [m], its velocity by the
    ring's motion, and by the turn of the ball's plane [m/s]. about: azimuth's cosine and sine, its
    rate [rad/s].
    """
    cosine, sine, turn = about
    body = INNER if race == 0 else OUTER
    y, z = q[body + 1], q[body + 2]
    turning = turn * (z * cosine - y * sine)
    speed = v[body + 1] * cosine + v[body + 2] * sine
    shift = y * cosine + z * sine
    if race == 1:
        return q[OUTER], c.outer_centre_radius + shift, v[OUTER], speed, 0.0, turning
    radius = c.inner_centre_radius
    tilt = radius * (q[INNER + 3] * sine - q[INNER + 4] * cosine)
    tilting = radius * (v[INNER + 3] * sine - v[INNER + 4] * cosine)
    along = radius * turn * (q[INNER + 3] * cosine + q[INNER + 4] * sine)
    return q[INNER] + tilt, radius + shift, v[INNER] + tilting, speed, along, turning


@compiled
def form_at(c, race, j, psi, time):
    """Form of race and ball at their contact [m], and its rate at the end's speeds [m/s].

    The ball meets the two races with opposite points of its track.
    """
    heights = c.inner_height if race == 0 else c.outer_height
    ring, slope = height_at(heights, psi - c.speeds[race] * time)
    spin = c.speeds[3]
    at = spin * time if race == 0 else np.pi + spin * time
    ball, ball_slope = height_at(c.ball_height[race, j % c.ball_height.shape[1]], at)
    rate = slope * (c.speeds[2] - c.speeds[race]) + ball_slope * spin
    return ring + ball + c.ball_excess[j], rate


@compiled
def race_contact(c, race, j, q, v, about):
    """Direction from ball to groove's centre (axial, radial), load [N]; powers of the turning
    plane, of the form and of what is lost [W], elastic energy [J]. about: cosine, sine, azimuth,
    turned time, ratio of speeds, share of the form.
    """
    cosine, sine, psi, time, ratio, share = about
    turn = c.speeds[2] * ratio
    cx, cr, wx, wr, tx, tr = groove_motion(c, race, q, v, (cosine, sine, turn))
    place = BALLS + 2 * j
    dx = cx - q[place]
    dr = cr - q[place + 1]
    distance = np.sqrt(dx * dx + dr * dr)
    ex, er = dx / distance, dr / distance
    height, rate = form_at(c, race, j, psi, time)
    form_rate = rate * share * ratio
    length = c.inner_length if race == 0 else c.outer_length
    turning = ex * tx + er * tr
    speed = ex * (wx - v[place]) + er * (wr - v[place + 1]) + turning + form_rate
    law = c.inner_law if race == 0 else c.outer_law
    elastic, damping, energy = law_at(law, distance - length + share * height)
    load = max(elastic + damping * speed, 0.0)
    powers = (load * turning, load * form_rate, (load - elastic) * speed)
    return ex, er, load, powers, energy


@compiled
def add_ball(c, j, q, v, about, result):
    """Add the contacts of one ball to forces on the rings, powers and loads, and set its own
    acceleration. about: turned time, ratio of speeds, share of the form.
    """
    a, force, power, loads = result
    time, ratio, share = about
    psi = c.azimuth[j] + c.speeds[2] * time
    cosine = np.cos(psi)
    sine = np.sin(psi)
    place = BALLS + 2 * j
    a[place] = 0.0
    a[place + 1] = c.centrifugal_force * ratio * ratio / c.ball_mass
    power[EXTERNAL] += c.centrifugal_force * ratio * ratio * v[place + 1]
    for race in range(2):
        around = (cosine, sine, psi, time, ratio, share)
        ex, er, load, powers, energy = race_contact(c, race, j, q, v, around)
        body = INNER if race == 0 else OUTER
        force[body] -= load * ex
        force[body + 1] -= load * er * cosine
        force[body + 2] -= load * er * sine
        if race == 0:
            lever = c.inner_centre_radius * load * ex
            force[INNER + 3] -= lever * sine
            force[INNER + 4] += lever * cosine
        a[place] += load * ex / c.ball_mass
        a[place + 1] += load * er / c.ball_mass
        loads[race * c.balls + j] = load
        power[EXTERNAL] += powers[0]
        power[BY_FORM] += powers[1]
        power[LOST] += powers[2]
        power[STORED] += energy


@compiled
def accelerations(c, time, q, v, outside, result):
    """Accelerations, powers with the elastic energy, loads of the contacts (Z inner, Z outer) into
    the arrays of result. outside: share of the form, damping of all bodies [1/s].
    """
    a, power, loads = result
    tau, ratio = turned(c, time)
    force = np.zeros(BALLS)
    power[:] = 0.0
    for k in range(SENSOR):
        force[k] = c.load[k]
        power[EXTERNAL] += c.load[k] * v[k]
    for j in range(c.balls):
        add_ball(c, j, q, v, (tau, ratio, outside[0]), (a, force, power, loads))
    add_seat_and_sensor(c, q, v, force, power)
    couple = c.polar_inertia * c.speeds[0] * ratio
    force[INNER + 3] -= couple * v[INNER + 4]
    force[INNER + 4] += couple * v[INNER + 3]
    for k in range(BALLS):
        a[k] = c.free[k] * force[k] / c.mass[k]
    for k in range(a.size):
        a[k] -= outside[1] * v[k]


@compiled
def add_seat_and_sensor(c, q, v, force, power):
    """Forces of the seat and of the sensor's spring, their energy and what is lost in them."""
    for k in range(3):
        shift, rate = q[OUTER + k], v[OUTER + k]
        force[OUTER + k] -= c.seat_stiffness[k] * shift + c.seat_damping * rate
        power[LOST] += c.seat_damping * rate * rate
        power[STORED] += 0.5 * c.seat_stiffness[k] * shift * shift
    axis = OUTER + int(c.sensor[2])
    shift, rate = q[SENSOR] - q[axis], v[SENSOR] - v[axis]
    push = c.sensor[0] * shift + c.sensor[1] * rate
    force[axis] += push
    force[SENSOR] -= push
    power[LOST] += c.sensor[1] * rate * rate
    power[STORED] += 0.5 * c.sensor[0] * shift * shift


@compiled
def kinetic_energy(c, v):
    """Kinetic energy of rings, sensor and balls [J]."""
    total = 0.0
    for k in range(BALLS):
        total += 0.5 * c.free[k] * c.mass[k] * v[k] * v[k]
    for k in range(BALLS, v.size):
        total += 0.5 * c.ball_mass * v[k] * v[k]
    return total


@compiled
def moved(values, slopes, step):
    """Advance values in place by the four slopes of a Runge-Kutta step."""
    for k in range(values.size):
        inner = slopes[1, k] + slopes[2, k]
        values[k] += step / 6.0 * (slopes[0, k] + 2.0 * inner + slopes[3, k])


@compiled
def keep_row(record, row, state, slopes, kinetic):
    """Write motion, loads, energy and works before a step into a row of the record."""
    motion, loads_kept, energies = record
    q, v, work = state
    a, power, loads = slopes
    copy(q, motion[row, :BALLS])
    copy(v, motion[row, BALLS : 2 * BALLS])
    copy(a, motion[row, 2 * BALLS :])
    copy(loads, loads_kept[row])
    energies[row, 0] = kinetic + power[STORED]
    copy(work, energies[row, 1:])


@compiled
def advance(c, clock, form_gain, state, record):
    """Steps of Runge and Kutta; the state (q, v, works) moves on in place, a row of the record is
    written before every stride-th step; none with a stride of zero.

    clock: time [s], step [s], steps, stride; form_gain: of the form at the start, its gain [1/s],
    damping of all bodies [1/s]; record: displacements, speeds and accelerations of rings and
    sensor (n, 27), loads (n, 2 Z), energy and works (n, 4).
    """
    start, step, steps, stride = clock
    q, v, work = state
    loads = np.empty(2 * c.balls)
    slopes_q = np.empty((4, q.size))
    slopes_v = np.empty((4, q.size))
    slopes_w = np.empty((4, work.size))
    for i in range(steps):
        for stage in range(4):
            ahead = 0.0 if stage == 0 else (step if stage == 3 else 0.5 * step)
            q_at, v_at = q.copy(), v.copy()
            if stage:
                q_at += ahead * slopes_q[stage - 1]
                v_at += ahead * slopes_v[stage - 1]
            copy(v_at, slopes_q[stage])
            part = min(form_gain[0] + form_gain[1] * (i * step + ahead), 1.0)
            result = (slopes_v[stage], slopes_w[stage], loads)
            at = start + i * step + ahead
            accelerations(c, at, q_at, v_at, (part, form_gain[2]), result)
            if stage == 0 and stride > 0 and i % stride == 0:
                slopes = (slopes_v[0], slopes_w[0], loads)
                keep_row(record, i // stride, (q, v, work), slopes, kinetic_energy(c, v))
        moved(q, slopes_q, step)
        moved(v, slopes_v, step)
        moved(work, slopes_w, step)

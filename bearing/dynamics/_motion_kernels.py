"""The equations of motion of rings, cage and balls as one compiled function without allocation.

To be read from the top: `motion_rates` goes through the steps of Walters (1971) and Gupta (1984),
and what follows it are these steps in their order. Forces of contacts stand in `_race_kernels`
(`ball_on_race`: approach, normal force, friction) and `_cage_kernels` (`ball_in_pocket`,
`cage_land`).

One inertial frame: x is the axis of the bearing, y and z lie across it. A ball has its centre and
velocity in it, and an angular velocity: Newton's and Euler's equations without centrifugal and
gyroscopic terms, as its inertia is the same about every axis. The inner ring turns at a given
speed, tilts little, and is coupled by the gyroscopic moment of its polar inertia; so is the cage,
whose rotation is free.

Letters: t time, y state (coordinates, speeds in the same order, angles, works, `arrays.Layout`),
dy its rates, j number of a ball, c constants, p what is prescribed, free or held, `p.loads` forces
and moments of all contacts on a body, `p.power` the power of each mechanism, added where its force
is. Their NumPy twin: tests/reference/dynamics.py.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled, inlined

from ._cage_kernels import cage_direction, cage_land, pocket_forces
from ._implicit_kernels import friction_is_stiff, implicit_friction
from ._race_kernels import ball_collisions, elastic_energy, form_share, race_forces, roll_speed
from ._state_kernels import (
    accumulators,
    ball_motion,
    ball_position,
    ball_turn,
    ball_velocity,
    dot,
    norm,
    outer_angle,
    ring_angle,
    roll_angle,
    times,
    vector,
    velocities,
)
from .arrays import (
    BODIES,
    CAGE,
    CAGE_LOAD,
    CAGE_ROTATION,
    CAGE_TILT,
    CONTACT,
    ELASTIC,
    FORCE,
    FORM_SHARE,
    FREE_TURN,
    GUIDE_SPEED,
    GUIDED_BY_BALLS,
    GUIDED_BY_INNER_RING,
    INNER,
    INNER_SPEED,
    KINETIC,
    LAND,
    MOMENT,
    OUTER,
    OUTER_SPEED,
    POCKET,
    POTENTIAL,
    PRESCRIBED_DISPLACEMENT,
    PRESCRIBED_FORCE,
    PRESCRIBED_MOMENT,
    PRESCRIBED_RATE,
    RING,
    RING_TILT,
    SEAT,
    SENSOR,
    WORK,
    Body,
)


@inlined
def motion_rates(t, y, data, dy):
    """Rates of the state vector; contact states and powers are left in `KernelData`."""
    p = data.bearing
    balls = data.balls
    impact_speeds = data.impact_speeds
    c = p.constants
    prescribed = p.prescribed
    # 1. prescribed speeds, loads and places; places of the bodies
    acceleration = schedule_at(data.times, data.schedule, t, prescribed)
    prescribed[FORM_SHARE] = form_share(c, t)
    place_ring(c.balls, p.constrained, prescribed, y)
    if c.guided:
        guide_balls(c, prescribed[GUIDE_SPEED], y)
    inner, outer, cage = place_bodies(c.balls, y, prescribed[INNER_SPEED], prescribed[OUTER_SPEED])
    p.power[:] = 0.0
    p.loads[:] = 0.0
    for j in range(c.balls):
        balls[j].forces[:] = 0.0
    # 2. forces between races and balls
    for race in range(2):  # written out, the number of a race would be compiled for by itself
        law = data.friction_inner if race == INNER else data.friction_outer
        forms = (data.inner_form if race == INNER else data.outer_form), data.ball_form[race]
        body = inner if race == INNER else outer
        race_forces(p, balls, law, forms, impact_speeds, race, body, y)
    # 3. in pockets, or of balls that meet
    if c.cage_mass > 0.0:
        pocket_forces(p, balls, impact_speeds, cage, y)
    elif c.symmetric_copies == 1 and not c.guided:
        ball_collisions(p, balls, impact_speeds, y)
    # 4. friction that is stiff; balls that are not solved; lands of the cage
    if friction_is_stiff(p, balls):
        implicit_friction(p, balls, y, inner, outer)
    if c.symmetric_copies > 1:
        add_copies(c, p.loads, p.power)
    p.power[WORK.drive_outer] -= outer.turn[0] * p.loads[OUTER, MOMENT]
    if c.cage_mass > 0.0 and c.guide != GUIDED_BY_BALLS:
        ring = inner if c.guide == GUIDED_BY_INNER_RING else outer
        for side in range(2):
            cage_land(p, impact_speeds, side, ring, cage)
    # 5. equations of motion
    for j in range(c.balls):
        ball_rates(p, balls[j], t, acceleration, y, j, dy)
    ring_equations(p, t, y, acceleration, inner, dy)
    cage_equations(p, y, cage, dy)
    outer_equations(p, t, y, dy)
    dy[ring_angle(c.balls)] = prescribed[INNER_SPEED]
    dy[outer_angle(c.balls)] = prescribed[OUTER_SPEED]
    first = accumulators(c.balls)
    for k in range(p.power.size):
        dy[first + k] = p.power[k]


@compiled
def row_before(times, t):
    """Index of the last row at or before a time, of the rows but the last."""
    k = 0
    after = times.size - 1
    while after - k > 1:
        middle = (k + after) // 2
        if t >= times[middle]:
            k = middle
        else:
            after = middle
    return k


@compiled
def schedule_at(times, schedule, t, out):
    """The schedule at a time, linear between its rows but for the places; returns the inner
    acceleration.
    """
    last = times.size - 1
    if t >= times[last] or last == 0:
        for column in range(out.size):
            out[column] = schedule[last, column]
        return 0.0
    if t < times[0]:
        for column in range(out.size):
            out[column] = schedule[0, column]
        return 0.0
    k = row_before(times, t)
    span = times[k + 1] - times[k]
    share = max(0.0, (t - times[k]) / span)
    for column in range(out.size):
        before = schedule[k, column]
        out[column] = before + share * (schedule[k + 1, column] - before)
    if out.size > PRESCRIBED_DISPLACEMENT:
        places_between(schedule[k], schedule[k + 1], span, share, out)
    return (schedule[k + 1, INNER_SPEED] - schedule[k, INNER_SPEED]) / span


@compiled
def places_between(before, after, span, fraction, out):
    """Places of the ring and their rates between two rows, by the cubic that has both at either
    end (Hermite).
    """
    left = 1.0 - fraction
    for i in range(RING):
        start, end = before[PRESCRIBED_DISPLACEMENT + i], after[PRESCRIBED_DISPLACEMENT + i]
        first, final = before[PRESCRIBED_RATE + i], after[PRESCRIBED_RATE + i]
        bend = left * (span * first - end + start) - fraction * (span * final - end + start)
        out[PRESCRIBED_DISPLACEMENT + i] = (
            start + fraction * (end - start) + fraction * left * bend
        )
        slope = (left - fraction) * bend - fraction * left * (first + final) * span
        slope += 2.0 * fraction * left * (end - start)
        out[PRESCRIBED_RATE + i] = (end - start + slope) / span


@compiled
def place_ring(balls, constrained, prescribed, y):
    """The inner ring where it is held: places and speeds of the state."""
    first = velocities(balls)
    for i in range(RING):
        if constrained[i] > 0.0:
            y[i] = prescribed[PRESCRIBED_DISPLACEMENT + i]
            y[first + i] = prescribed[PRESCRIBED_RATE + i]


@compiled
def place_body(y, first, tilt, first_velocity, spin):
    """A body from its coordinates, `tilt` the index of its tilts, and its axial speed."""
    ty = y[first + tilt]
    tz = y[first + tilt + 1]
    axis = (1.0, 0.0, 0.0)
    if ty != 0.0 or tz != 0.0:
        size = 1.0 / np.sqrt(1.0 + ty * ty + tz * tz)
        axis = (size, tz * size, -ty * size)
    rate = first_velocity + tilt
    x, y_turn, z_turn = times(spin, axis)
    turn = (x, y_turn + y[rate], z_turn + y[rate + 1])
    return Body(vector(y, first), axis, vector(y, first_velocity), turn)


@compiled
def place_bodies(balls, y, inner_speed, outer_speed):
    """Inner ring, outer ring and cage."""
    v = velocities(balls)
    turn = (outer_speed, 0.0, 0.0)
    outer = Body(vector(y, SEAT), (1.0, 0.0, 0.0), vector(y, v + SEAT), turn)
    cage_speed = y[v + RING + CAGE_ROTATION]
    inner = place_body(y, 0, RING_TILT, v, inner_speed)
    return inner, outer, place_body(y, RING, CAGE_TILT, v + RING, cage_speed)


@compiled
def guide_balls(c, speed, y):
    """Speeds along the orbits of balls that keep their places in a cage turned as prescribed."""
    for j in range(c.balls):
        x = ball_position(j)
        v = ball_velocity(c.balls, j)
        ry, rz = y[x + 1], y[x + 2]
        along = (ry * y[v + 2] - rz * y[v + 1]) / (ry * ry + rz * rz)
        y[v + 1] -= (speed - along) * rz
        y[v + 2] += (speed - along) * ry


@compiled
def settling(c, t):
    """Damping of all bodies over their masses [1/s]."""
    return c.settling_rate if t < c.settling_end else 0.0


@compiled
def guided_rates(p, ball, t, acceleration, y, j, dy):
    """Newton's equations of a ball along the axis and the radius; it goes round as prescribed, and
    what makes it do so works.
    """
    c = p.constants
    x = ball_position(j)
    v = ball_velocity(c.balls, j)
    spin = p.prescribed[GUIDE_SPEED]
    shaft = p.prescribed[INNER_SPEED]
    gain = acceleration * spin / shaft if shaft != 0.0 else 0.0
    ry, rz = y[x + 1], y[x + 2]
    rho = np.sqrt(ry * ry + rz * rz)
    ny, nz = ry / rho, rz / rho
    force_x, force_y, force_z = vector(ball.forces, FORCE)
    outward = ny * y[v + 1] + nz * y[v + 2]
    damping = settling(c, t)
    radial = (force_y * ny + force_z * nz) / c.ball_mass - damping * outward
    along = 2.0 * outward * spin + rho * gain
    pull = c.ball_mass * along - (force_z * ny - force_y * nz)
    p.power[WORK.drive_cage] += c.symmetric_copies * pull * rho * spin
    lost = c.ball_mass * damping * (outward * outward + y[v] * y[v])
    p.power[WORK.support] += c.symmetric_copies * lost
    for i in range(3):
        dy[x + i] = y[v + i]
        dy[ball_turn(c.balls, j) + i] = 0.0
    dy[v] = p.free[BODIES] * (force_x / c.ball_mass - damping * y[v])
    dy[v + 1] = radial * ny - along * nz
    dy[v + 2] = radial * nz + along * ny


@inlined
def ball_rates(p, ball, t, acceleration, y, j, dy):
    """Newton's and Euler's equations of a ball, m dv/dt = F - d |v| v + m g and J dw/dt = M, with
    forces F and moments M of its contacts, drag d and weight.
    """
    c = p.constants
    free = p.free
    motion = ball_motion(y, c.balls, j)
    dy[roll_angle(c.balls, j)] = roll_speed(p, motion[1], motion[2], motion[0])
    if c.guided:
        guided_rates(p, ball, t, acceleration, y, j, dy)
        return
    x = ball_position(j)
    v = ball_velocity(c.balls, j)
    w = ball_turn(c.balls, j)
    speed = norm(vector(y, v))
    pull = c.drag * speed
    p.power[WORK.churning] += c.symmetric_copies * pull * speed * speed
    for i in range(3):
        force = ball.forces[FORCE + i] - pull * y[v + i]
        dy[x + i] = y[v + i]
        dy[v + i] = free[BODIES + i] * (force / c.ball_mass + c.gravity[i])
        dy[w + i] = free[FREE_TURN + i] * ball.forces[MOMENT + i] / c.ball_inertia


@compiled
def tilting_equations(p, t, y, rate, dy):
    """Euler's equations of the tilts of the inner ring at its speed s, J dw_y/dt = M_y - J_p s w_z
    and J dw_z/dt = M_z + J_p s w_y; their rates stand from the place `rate` on.
    """
    c = p.constants
    gyro = c.ring_polar * p.prescribed[INNER_SPEED]
    load = p.loads[INNER]
    wy = y[rate]
    wz = y[rate + 1]
    damping = c.ring_transverse * settling(c, t)
    p.power[WORK.support] += damping * (p.free[3] * wy * wy + p.free[4] * wz * wz)
    coupled = (
        load[MOMENT + 1] - gyro * wz - damping * wy,
        load[MOMENT + 2] + gyro * wy - damping * wz,
    )
    for i in range(2):
        tilt = RING_TILT + i
        w = y[rate + i]
        moment = p.prescribed[PRESCRIBED_MOMENT + i]
        dy[tilt] = w
        dy[rate + i] = p.free[tilt] * (moment + coupled[i]) / c.ring_transverse
        p.power[WORK.loads] += (p.free[tilt] * moment - p.constrained[tilt] * coupled[i]) * w


@compiled
def ring_equations(p, t, y, acceleration, body, dy):
    """Newton's equations of the inner ring, m dv/dt = F + P(t) - d v + m g: contacts F, loads P,
    also one that goes round, unbalance; what holds the ring works where its place changes.
    """
    c = p.constants
    free = p.free
    constrained = p.constrained
    prescribed = p.prescribed
    load = p.loads[INNER]
    power = p.power
    first = velocities(c.balls)
    spin = prescribed[INNER_SPEED]
    fx, fy, fz = vector(prescribed, PRESCRIBED_FORCE)
    if c.unbalance != 0.0:
        phase = y[ring_angle(c.balls)] + c.unbalance_phase
        co, si = np.cos(phase), np.sin(phase)
        steady = c.unbalance * spin * spin
        swing = c.unbalance * acceleration
        fy += steady * co + swing * si
        fz += steady * si - swing * co
    if c.rotating_force != 0.0:
        turning = c.rotating_speed * t + c.rotating_phase
        fy += c.rotating_force * np.cos(turning)
        fz += c.rotating_force * np.sin(turning)
    pushes = (fx, fy, fz)
    mobility = 1.0 / c.ring_mass
    damping = c.ring_damping + c.ring_mass * settling(c, t)
    for i in range(3):
        v = y[first + i]
        dy[i] = v
        force = pushes[i] + load[FORCE + i] - damping * v
        dy[first + i] = free[i] * (force * mobility + c.gravity[i])
        power[WORK.loads] += (free[i] * pushes[i] - constrained[i] * load[FORCE + i]) * v
        power[WORK.support] += free[i] * damping * v * v
    tilting_equations(p, t, y, first + RING_TILT, dy)
    power[WORK.drive_inner] -= spin * dot(vector(load, MOMENT), body.axis)


@compiled
def outer_equations(p, t, y, dy):
    """Newton's equations of the outer ring on its seat, m dv/dt = F + P - k x - d v, and of the
    sensor on it, an oscillator along one axis.
    """
    c = p.constants
    first = velocities(c.balls)
    load = p.loads[OUTER]
    stretch = y[SENSOR] - y[SEAT + c.sensor_axis]
    rate = y[first + SENSOR] - y[first + SEAT + c.sensor_axis]
    pull = c.sensor_stiffness * stretch + c.sensor_damping * rate
    damping = c.seat_damping + c.outer_mass * settling(c, t)
    for i in range(3):
        place = SEAT + i
        v = y[first + place]
        dy[place] = v
        force = load[FORCE + i] + c.outer_load[i] - c.seat_stiffness[i] * y[place] - damping * v
        force += pull if i == c.sensor_axis else 0.0
        dy[first + place] = p.free[place] * force / c.outer_mass
        p.power[WORK.loads] += c.outer_load[i] * v
        p.power[WORK.support] += damping * v * v
    v = y[first + SENSOR]
    dy[SENSOR] = v
    dy[first + SENSOR] = 0.0
    if c.sensor_mass > 0.0:
        slowed = settling(c, t) * v
        dy[first + SENSOR] = p.free[SENSOR] * (-pull / c.sensor_mass - slowed)
        p.power[WORK.support] += c.sensor_damping * rate * rate + c.sensor_mass * slowed * v


@compiled
def cage_equations(p, y, body, dy):
    """Newton's and Euler's equations of the cage, m dv/dt = F + m g and J_p ds/dt = M_x - d |s| s
    about its axis, tilts as those of the ring: pockets, lands, weight, unbalance, drag of the oil.
    """
    c = p.constants
    free = p.free
    load = p.loads[CAGE_LOAD]
    power = p.power
    first = velocities(c.balls) + RING
    for i in range(CAGE):
        dy[RING + i] = y[first + i]
        dy[first + i] = 0.0
    if c.cage_mass <= 0.0:
        return
    gravity = c.gravity
    turning = first + CAGE_ROTATION
    tilting = first + CAGE_TILT
    spin = y[turning]
    mobility = 1.0 / c.cage_mass
    swing = (0.0, 0.0, 0.0)
    if c.cage_unbalance != 0.0:
        steady = c.cage_unbalance * spin * spin
        co, si = cage_direction(y)
        swing = (0.0, steady * co, steady * si)
    for i in range(3):
        force = load[FORCE + i] + swing[i]
        dy[first + i] = free[RING + i] * (force * mobility + gravity[i])
        power[WORK.loads] += swing[i] * y[first + i]
    gyro = c.cage_polar * spin
    pull = c.cage_drag * abs(spin) * spin
    power[WORK.churning] += pull * spin
    about = dot(vector(load, MOMENT), body.axis) - pull
    _, load_y, load_z = vector(load, MOMENT)
    my = load_y - gyro * y[tilting + 1]
    mz = load_z + gyro * y[tilting]
    dy[turning] = free[RING + CAGE_ROTATION] * about / c.cage_polar
    dy[tilting] = free[RING + CAGE_TILT] * my / c.cage_transverse
    dy[tilting + 1] = free[RING + CAGE_TILT + 1] * mz / c.cage_transverse


@compiled
def add_copies(c, loads, power):
    """Loads and powers of all balls from those of one, the others standing evenly around: forces
    and moments across the axis cancel.
    """
    for body in range(loads.shape[0]):
        for part in (FORCE, MOMENT):
            loads[body, part] *= c.symmetric_copies
            loads[body, part + 1] = 0.0
            loads[body, part + 2] = 0.0
    for k in range(power.size):
        power[k] *= c.symmetric_copies


@compiled
def put(values, places, out):
    """Values at their places in an array."""
    for m in range(values.size):
        out[places[m]] = values[m]


@compiled
def take(values, places, out):
    """Values of an array at some places."""
    for m in range(out.size):
        out[m] = values[places[m]]


@compiled
def solved_derivative(t, y, data, dy):
    """`motion_rates` of the coordinates that are solved; the others rest where `whole` has them,
    or go where the schedule holds them. `data`: `KernelData`.
    """
    put(y, data.solved, data.full_state)
    motion_rates(t, data.full_state, data, data.rates)
    take(data.rates, data.solved, dy)


@compiled
def energies(y, data, out):
    """Kinetic, elastic and potential energy [J] of a state whose `derivative` was just taken; the
    kinetic energy of a ring that is held is none of the bearing's.
    """
    p = data.bearing
    balls = data.balls
    c = p.constants
    free = p.free
    gravity = c.gravity
    kinetic = 0.0
    elastic = 0.0
    weight = 0.0
    for j in range(c.balls):
        for i in range(3):
            v = y[ball_velocity(c.balls, j) + i]
            w = y[ball_turn(c.balls, j) + i]
            kinetic += 0.5 * (c.ball_mass * v * v + c.ball_inertia * w * w)
            weight -= free[BODIES + i] * c.ball_mass * gravity[i] * y[ball_position(j) + i]
        for race in range(2):
            approach = balls[j].race_out[race, CONTACT.approach]
            elastic += elastic_energy(p.normal[race], approach)
        elastic += elastic_energy(p.normal[POCKET], balls[j].pocket_out[CONTACT.approach])
    kinetic *= c.symmetric_copies
    elastic *= c.symmetric_copies
    weight *= c.symmetric_copies
    first = velocities(c.balls)
    for i in range(3):
        kinetic += 0.5 * free[i] * c.ring_mass * y[first + i] ** 2
        kinetic += 0.5 * c.cage_mass * y[first + RING + i] ** 2
        weight -= gravity[i] * (
            free[i] * c.ring_mass * y[i] + free[RING + i] * c.cage_mass * y[RING + i]
        )
    for i in range(RING_TILT, RING):
        kinetic += 0.5 * free[i] * c.ring_transverse * y[first + i] ** 2
    for i in range(3):
        kinetic += 0.5 * free[SEAT + i] * c.outer_mass * y[first + SEAT + i] ** 2
        elastic += 0.5 * c.seat_stiffness[i] * y[SEAT + i] ** 2
    kinetic += 0.5 * c.sensor_mass * y[first + SENSOR] ** 2
    elastic += 0.5 * c.sensor_stiffness * (y[SENSOR] - y[SEAT + c.sensor_axis]) ** 2
    tilting = first + RING + CAGE_TILT
    kinetic += (
        0.5 * c.cage_transverse * (y[tilting] ** 2 + y[tilting + 1] ** 2)
        + 0.5 * c.cage_polar * y[first + RING + CAGE_ROTATION] ** 2
    )
    if c.cage_mass > 0.0 and c.guide != GUIDED_BY_BALLS:
        law = p.normal[LAND]
        sides = p.land_out[:, CONTACT.approach]
        elastic += elastic_energy(law, sides[0]) + elastic_energy(law, sides[1])
    out[KINETIC], out[ELASTIC], out[POTENTIAL] = kinetic, elastic, weight

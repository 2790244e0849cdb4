"""The equations of motion of ring, cage and balls as one compiled function without allocation.

Newton's and Euler's equations in the inertial frame: no centrifugal and no gyroscopic force on a
ball, whose inertia is the same about every axis. The inner ring turns at a given speed, tilts
little, and is coupled by the gyroscopic moment of its polar inertia; so is the cage, whose
rotation is free. Their NumPy twin: tests/reference/dynamics.py.
"""

import numpy as np

from ehl.compiled import compiled

from ._state_kernels import (
    accumulators,
    ball_position,
    ball_turn,
    ball_velocity,
    dot,
    norm,
    ring_angle,
    times,
    vector,
    velocities,
    write,
)
from .arrays import (
    AXIS,
    CAGE_BODY,
    CAGE_LOAD,
    CENTRE,
    CHURNING,
    DRIVE_INNER,
    DRIVE_OUTER,
    ELASTIC,
    FORCE,
    GIVEN_COLUMNS,
    GIVEN_FORCE,
    GIVEN_MOMENT,
    GUIDED_BY_BALLS,
    INNER,
    INNER_SPEED,
    KINETIC,
    LAND,
    LAND_APPROACH,
    LOADS,
    MOMENT,
    OUTER,
    OUTER_SPEED,
    POCKET,
    POCKET_APPROACH,
    POTENTIAL,
    RACE_APPROACH,
    RING_LOAD,
    SCHEDULED,
    SUPPORT,
    TIME,
    TURN,
    VELOCITY,
)
from .contact._cage_kernels import cage_land, pocket_forces
from .contact._kernels import elastic_energy
from .contact._race_kernels import race_forces, race_friction, race_motions
from .layout import BODIES, CAGE, CAGE_ROTATION, CAGE_TILT, FREE_TURN, RING, RING_TILT


@compiled
def schedule_at(schedule, t, out):
    """Speeds, force and moment of the schedule at a time; returns the inner acceleration."""
    n = schedule.shape[0]
    k = 0
    while k < n - 2 and t >= schedule[k + 1, TIME]:
        k += 1
    if n == 1 or t >= schedule[n - 1, TIME]:
        out[:] = schedule[n - 1, SCHEDULED:]
        return 0.0
    before = schedule[k]
    after = schedule[k + 1]
    span = after[TIME] - before[TIME]
    share = max(0.0, (t - before[TIME]) / span)
    for given in range(GIVEN_COLUMNS):
        column = SCHEDULED + given
        out[given] = before[column] + share * (after[column] - before[column])
    return (after[SCHEDULED + INNER_SPEED] - before[SCHEDULED + INNER_SPEED]) / span


@compiled
def place_body(y, first, tilt, first_velocity, spin, body):
    """Row of a body from its coordinates, `tilt` the index of its tilts, and its axial speed."""
    ty = y[first + tilt]
    tz = y[first + tilt + 1]
    size = 1.0 / np.sqrt(1.0 + ty * ty + tz * tz)
    axis = (size, tz * size, -ty * size)
    write(body, CENTRE, vector(y, first))
    write(body, AXIS, axis)
    write(body, VELOCITY, vector(y, first_velocity))
    write(body, TURN, times(spin, axis))
    body[TURN + 1] += y[first_velocity + tilt]
    body[TURN + 2] += y[first_velocity + tilt + 1]


@compiled
def place_bodies(balls, y, inner_speed, outer_speed, bodies):
    """Rows of inner ring, outer ring and cage."""
    bodies[OUTER, :] = 0.0
    bodies[OUTER, AXIS] = 1.0
    bodies[OUTER, TURN] = outer_speed
    v = velocities(balls)
    place_body(y, 0, RING_TILT, v, inner_speed, bodies[INNER])
    cage_speed = y[v + RING + CAGE_ROTATION]
    place_body(y, RING, CAGE_TILT, v + RING, cage_speed, bodies[CAGE_BODY])


@compiled
def ball_equations(c, free, y, forces, power, dy):
    """Newton's and Euler's equations of the balls with drag and weight."""
    gravity = c.gravity
    for j in range(c.balls):
        x = ball_position(j)
        v = ball_velocity(c.balls, j)
        w = ball_turn(c.balls, j)
        speed = norm(vector(y, v))
        pull = c.drag * speed
        power[CHURNING] += pull * speed * speed
        for i in range(3):
            force = forces[j, FORCE + i] - pull * y[v + i]
            dy[x + i] = y[v + i]
            dy[v + i] = free[BODIES + i] * (force / c.ball_mass + gravity[i])
            dy[w + i] = free[FREE_TURN + i] * forces[j, MOMENT + i] / c.ball_inertia


@compiled
def ring_equations(c, free, y, given, acceleration, load, body, power, dy):
    """The inner ring: contacts, loads, unbalance, support, weight, gyroscopic coupling."""
    first = velocities(c.balls)
    phase = y[ring_angle(c.balls)] + c.unbalance_phase
    spin = given[INNER_SPEED]
    co, si = np.cos(phase), np.sin(phase)
    steady = c.unbalance * spin * spin
    swing = c.unbalance * acceleration
    fx, fy, fz = vector(given, GIVEN_FORCE)
    pushes = (fx, fy + steady * co + swing * si, fz + steady * si - swing * co)
    gravity = c.gravity
    for i in range(3):
        v = y[first + i]
        dy[i] = v
        force = pushes[i] + load[FORCE + i] - c.ring_damping * v
        dy[first + i] = free[i] * (force / c.ring_mass + gravity[i])
        power[LOADS] += pushes[i] * v
        power[SUPPORT] += c.ring_damping * v * v
    tilting = first + RING_TILT
    wy = y[tilting]
    wz = y[tilting + 1]
    dy[RING_TILT] = wy
    dy[RING_TILT + 1] = wz
    gyro = c.ring_polar * spin
    my = given[GIVEN_MOMENT] + load[MOMENT + 1] - gyro * wz
    mz = given[GIVEN_MOMENT + 1] + load[MOMENT + 2] + gyro * wy
    dy[tilting] = free[RING_TILT] * my / c.ring_transverse
    dy[tilting + 1] = free[RING_TILT + 1] * mz / c.ring_transverse
    power[LOADS] += given[GIVEN_MOMENT] * wy + given[GIVEN_MOMENT + 1] * wz
    power[DRIVE_INNER] -= spin * dot(vector(load, MOMENT), vector(body, AXIS))


@compiled
def cage_equations(c, free, y, load, body, dy):
    """The cage: pockets, lands, weight."""
    first = velocities(c.balls) + RING
    for i in range(CAGE):
        dy[RING + i] = y[first + i]
        dy[first + i] = 0.0
    if c.cage_mass <= 0.0:
        return
    gravity = c.gravity
    for i in range(3):
        dy[first + i] = free[RING + i] * (load[FORCE + i] / c.cage_mass + gravity[i])
    turning = first + CAGE_ROTATION
    tilting = first + CAGE_TILT
    gyro = c.cage_polar * y[turning]
    about = dot(vector(load, MOMENT), vector(body, AXIS))
    my = load[MOMENT + 1] - gyro * y[tilting + 1]
    mz = load[MOMENT + 2] + gyro * y[tilting]
    dy[turning] = free[RING + CAGE_ROTATION] * about / c.cage_polar
    dy[tilting] = free[RING + CAGE_TILT] * my / c.cage_transverse
    dy[tilting + 1] = free[RING + CAGE_TILT + 1] * mz / c.cage_transverse


@compiled
def contact_forces(p, y):
    """All contacts: forces on balls, ring, cage; powers; states."""
    c = p.constants
    bodies = p.bodies
    loads = p.loads
    power = p.power
    forces = p.forces
    outer_load = p.outer_load
    power[:] = 0.0
    loads[:] = 0.0
    forces[:] = 0.0
    outer_load[:] = 0.0
    # 1. motion of the balls on the races, friction there
    race_motions(c, bodies, y, p.motion)
    kind = p.friction_kind
    race_friction(kind, p.friction_inner, p.normal[INNER], p.motion[INNER], p.friction[INNER])
    race_friction(kind, p.friction_outer, p.normal[OUTER], p.motion[OUTER], p.friction[OUTER])
    # 2. forces of races and balls
    for race in range(2):
        load = loads[RING_LOAD] if race == INNER else outer_load
        race_forces(
            c, kind, race, bodies[race], p.normal[race], p.memory, p.motion[race],
            p.friction[race], forces, load, power, p.race_out[race],
        )  # fmt: skip
    power[DRIVE_OUTER] -= bodies[OUTER, TURN] * outer_load[MOMENT]
    if c.cage_mass <= 0.0:
        return
    # 3. forces of pockets and lands
    pocket_forces(
        c, bodies[CAGE_BODY], p.normal[POCKET], p.memory, p.pocket_angle, y,
        forces, loads[CAGE_LOAD], power, p.pocket_out,
    )  # fmt: skip
    if c.guide == GUIDED_BY_BALLS:
        return
    for side in range(2):
        impact_speed = p.memory[LAND * c.balls + side]
        cage_land(c, side, bodies, p.normal[LAND], impact_speed, loads, power, p.land_out)


@compiled
def derivative(t, y, p, dy):
    """Rates of the state vector; contact states and powers are left in the arrays of `p`."""
    c, given, free = p.constants, p.given, p.free
    acceleration = schedule_at(p.schedule, t, given)
    place_bodies(c.balls, y, given[INNER_SPEED], given[OUTER_SPEED], p.bodies)
    contact_forces(p, y)
    ball_equations(c, free, y, p.forces, p.power, dy)
    ring = p.bodies[INNER]
    ring_equations(c, free, y, given, acceleration, p.loads[RING_LOAD], ring, p.power, dy)
    cage_equations(c, free, y, p.loads[CAGE_LOAD], p.bodies[CAGE_BODY], dy)
    dy[ring_angle(c.balls)] = given[INNER_SPEED]
    dy[accumulators(c.balls) :] = p.power


@compiled
def energies(y, p, out):
    """Kinetic, elastic and potential energy [J] of a state whose `derivative` was just taken."""
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
            elastic += elastic_energy(p.normal[race], p.race_out[race, j, RACE_APPROACH])
        if c.cage_mass > 0.0:
            elastic += elastic_energy(p.normal[POCKET], p.pocket_out[j, POCKET_APPROACH])
    first = velocities(c.balls)
    for i in range(3):
        kinetic += 0.5 * (c.ring_mass * y[first + i] ** 2 + c.cage_mass * y[first + RING + i] ** 2)
        weight -= gravity[i] * (
            free[i] * c.ring_mass * y[i] + free[RING + i] * c.cage_mass * y[RING + i]
        )
    tilting = first + RING_TILT
    kinetic += 0.5 * c.ring_transverse * (y[tilting] ** 2 + y[tilting + 1] ** 2)
    tilting = first + RING + CAGE_TILT
    kinetic += (
        0.5 * c.cage_transverse * (y[tilting] ** 2 + y[tilting + 1] ** 2)
        + 0.5 * c.cage_polar * y[first + RING + CAGE_ROTATION] ** 2
    )
    if c.cage_mass > 0.0 and c.guide != GUIDED_BY_BALLS:
        elastic += elastic_energy(p.normal[LAND], p.land_out[0, LAND_APPROACH]) + elastic_energy(
            p.normal[LAND], p.land_out[1, LAND_APPROACH]
        )
    out[KINETIC], out[ELASTIC], out[POTENTIAL] = kinetic, elastic, weight

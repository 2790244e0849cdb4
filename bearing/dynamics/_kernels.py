"""The equations of motion of ring, cage and balls as one compiled function without allocation.

Newton's and Euler's equations in the inertial frame: no centrifugal and no gyroscopic force on a
ball, whose inertia is the same about every axis. The inner ring turns at a given speed, tilts
little, and is coupled by the gyroscopic moment of its polar inertia; so is the cage, whose
rotation is free. The NumPy twin stands in `reference.py`.
"""

import numpy as np

from ehl.compiled import compiled

from .contact._kernels import (
    cross,
    elastic_force,
    groove_contact,
    land_film,
    normal_force,
    point_velocity,
    race_friction,
    ramped,
    wall_shear,
)
from .problem import (
    CHURNING,
    DRIVE_INNER,
    DRIVE_OUTER,
    EXPONENT,
    FILM,
    FRICTION_INNER,
    LAND,
    LAND_FRICTION,
    LOADS,
    POCKET,
    POCKET_DAMPING,
    POCKET_FRICTION,
    RACE_DAMPING,
    SUPPORT,
)


@compiled
def schedule_at(schedule, t, out):
    """Speeds, force and moment of the schedule at a time, linear between its rows; returns the
    inner acceleration.
    """
    n = schedule.shape[0]
    k = 0
    while k < n - 2 and t >= schedule[k + 1, 0]:
        k += 1
    if n == 1 or t >= schedule[n - 1, 0]:
        out[:7] = schedule[n - 1, 1:]
        return 0.0
    span = schedule[k + 1, 0] - schedule[k, 0]
    share = max(0.0, (t - schedule[k, 0]) / span)
    for c in range(7):
        out[c] = schedule[k, 1 + c] + share * (schedule[k + 1, 1 + c] - schedule[k, 1 + c])
    return (schedule[k + 1, 1] - schedule[k, 1]) / span


@compiled
def place_bodies(balls, y, inner_speed, outer_speed, b):
    """Rows of b: inner ring, outer ring, cage."""
    nq = 11 + 3 * balls
    b[1, :] = 0.0
    b[1, 3] = 1.0
    b[1, 9] = outer_speed
    for row in (0, 2):
        first = 0 if row == 0 else 5
        tilt = first + (3 if row == 0 else 4)
        ty = y[tilt]
        tz = y[tilt + 1]
        size = 1.0 / np.sqrt(1.0 + ty * ty + tz * tz)
        b[row, 3], b[row, 4], b[row, 5] = size, tz * size, -ty * size
        spin = inner_speed if row == 0 else y[nq + 8]
        for c in range(3):
            b[row, c] = y[first + c]
            b[row, 6 + c] = y[nq + first + c]
            b[row, 9 + c] = spin * b[row, 3 + c]
        b[row, 10] += y[nq + tilt]
        b[row, 11] += y[nq + tilt + 1]


@compiled
def add_load(load, body, x, y, z, fx, fy, fz):
    """Add a force at a point to the force on a body and to the moment about its centre."""
    m0, m1, m2 = cross(x - body[0], y - body[1], z - body[2], fx, fy, fz)
    load[0] += fx
    load[1] += fy
    load[2] += fz
    load[3] += m0
    load[4] += m1
    load[5] += m2


@compiled
def race_motion(c, body, centre_radius, groove_radius, pos, vel, turn, k):
    """How a ball meets a race: k holds n, t, y, the point, slides, spin, rolling, speed, rate,
    angle, approach.
    """
    arm = c.ball_radius
    k[19], axial, radial, rho, a0, a1, a2 = groove_contact(
        body, centre_radius, groove_radius - arm, pos, k
    )
    n0, n1, n2 = k[0], k[1], k[2]
    k[9], k[10], k[11] = pos[0] + arm * n0, pos[1] + arm * n1, pos[2] + arm * n2
    r0, r1, r2 = point_velocity(body, k[9], k[10], k[11])
    c0, c1, c2 = cross(turn[0], turn[1], turn[2], arm * n0, arm * n1, arm * n2)
    b0, b1, b2 = vel[0] + c0, vel[1] + c1, vel[2] + c2
    s0, s1, s2 = b0 - r0, b1 - r1, b2 - r2
    along = vel[0] * a0 + vel[1] * a1 + vel[2] * a2
    orbit = (along - body[6] * a0 - body[7] * a1 - body[8] * a2) / rho
    u = 0.5 * ((b0 + r0) * a0 + (b1 + r1) * a1 + (b2 + r2) * a2) - along - orbit * arm * radial
    sense = 1.0 if u >= 0.0 else -1.0  # u: mean speed of the surfaces past the contact
    k[3], k[4], k[5] = sense * a0, sense * a1, sense * a2
    k[6], k[7], k[8] = cross(n0, n1, n2, k[3], k[4], k[5])
    w0, w1, w2 = turn[0] - body[9], turn[1] - body[10], turn[2] - body[11]
    k[12] = s0 * k[3] + s1 * k[4] + s2 * k[5]
    k[13] = s0 * k[6] + s1 * k[7] + s2 * k[8]
    k[14] = w0 * n0 + w1 * n1 + w2 * n2
    k[15] = w0 * k[6] + w1 * k[7] + w2 * k[8]
    k[16] = abs(u)
    k[17] = s0 * n0 + s1 * n1 + s2 * n2
    k[18] = np.arctan2(axial, radial) if radial > 0.0 else np.arctan2(-axial, -radial)


@compiled
def race_motions(c, bodies, y, motion):
    """`race_motion` of every ball and both races."""
    nq = 11 + 3 * c.balls
    nb = 3 * c.balls
    for j in range(c.balls):
        a = 11 + 3 * j
        b = nq + 11 + 3 * j
        d = nq + 11 + nb + 3 * j
        pos, vel, turn = y[a : a + 3], y[b : b + 3], y[d : d + 3]
        race_motion(c, bodies[0], c.inner_centre, c.inner_groove, pos, vel, turn, motion[0, j])
        race_motion(c, bodies[1], c.outer_centre, c.outer_groove, pos, vel, turn, motion[1, j])


@compiled
def race_forces(c, kind, race, body, law, memory, motion, friction, forces, load, power, race_out):
    """Forces of one race on every ball, and of the balls on the race; powers; states of the
    contacts.
    """
    arm = c.ball_radius
    for j in range(c.balls):
        k = motion[j]
        f = friction[j]
        out = race_out[j]
        force = forces[j]
        out[:] = 0.0
        approach, rate = k[19], k[17]
        out[1], out[2], out[3], out[10] = approach, rate, k[18], k[20]
        if approach <= 0.0:
            continue
        elastic = elastic_force(law, approach)
        if kind == FILM:
            push = max(0.0, elastic + f[7] * rate)
        else:
            push = normal_force(law, approach, rate, memory[race * c.balls + j])
        out[0], out[4], out[5], out[6], out[7], out[8], out[9] = (
            push,
            k[16],
            k[12],
            k[13],
            k[14],
            f[0],
            f[1],
        )
        power[FRICTION_INNER + race] -= f[0] * k[12] + f[1] * k[13] + f[2] * k[14] + f[3] * k[15]
        power[RACE_DAMPING] += (push - elastic) * rate
        g0 = f[0] * k[3] + f[1] * k[6]
        g1 = f[0] * k[4] + f[1] * k[7]
        g2 = f[0] * k[5] + f[1] * k[8]
        f0, f1, f2 = g0 - push * k[0], g1 - push * k[1], g2 - push * k[2]
        m0 = f[2] * k[0] + f[3] * k[6]
        m1 = f[2] * k[1] + f[3] * k[7]
        m2 = f[2] * k[2] + f[3] * k[8]
        add_load(load, body, k[9], k[10], k[11], -f0, -f1, -f2)
        load[3] -= m0
        load[4] -= m1
        load[5] -= m2
        force[0] += f0
        force[1] += f1
        force[2] += f2
        c0, c1, c2 = cross(arm * k[0], arm * k[1], arm * k[2], g0, g1, g2)
        force[3] += c0 + m0
        force[4] += c1 + m1
        force[5] += c2 + m2


@compiled
def pocket_motion(c, body, angle, pos, vel, turn, k):
    """Where and how a ball meets its pocket: k holds n, the point, the slide vector, its size, the
    rate, the depth.
    """
    arm = c.ball_radius
    a0, a1, a2 = body[3], body[4], body[5]
    e1, e2 = np.cos(angle), np.sin(angle)
    tilted = e1 * a1 + e2 * a2
    e0 = -tilted * a0
    e1 = e1 - tilted * a1
    e2 = e2 - tilted * a2
    size = 1.0 / np.sqrt(e0 * e0 + e1 * e1 + e2 * e2)
    e0, e1, e2 = e0 * size, e1 * size, e2 * size
    t0, t1, t2 = cross(a0, a1, a2, e0, e1, e2)
    s0, s1, s2 = pos[0] - body[0], pos[1] - body[1], pos[2] - body[2]
    across, axial = s0 * t0 + s1 * t1 + s2 * t2, s0 * a0 + s1 * a1 + s2 * a2
    outward = s0 * e0 + s1 * e1 + s2 * e2 - c.pocket_circle if c.pocket_circle > 0.0 else 0.0
    offset = np.sqrt(across * across + axial * axial + outward * outward)
    p, q, r = (
        (across / offset, axial / offset, outward / offset) if offset > 1e-15 else (1.0, 0.0, 0.0)
    )
    k[0], k[1], k[2] = p * t0 + q * a0 + r * e0, p * t1 + q * a1 + r * e1, p * t2 + q * a2 + r * e2
    k[3], k[4], k[5] = pos[0] + arm * k[0], pos[1] + arm * k[1], pos[2] + arm * k[2]
    c0, c1, c2 = point_velocity(body, k[3], k[4], k[5])
    b0, b1, b2 = cross(turn[0], turn[1], turn[2], arm * k[0], arm * k[1], arm * k[2])
    k[6], k[7], k[8] = vel[0] + b0 - c0, vel[1] + b1 - c1, vel[2] + b2 - c2
    k[10] = k[6] * k[0] + k[7] * k[1] + k[8] * k[2]
    for i in range(3):
        k[6 + i] -= k[10] * k[i]
    k[9] = np.sqrt(k[6] * k[6] + k[7] * k[7] + k[8] * k[8])
    k[11] = offset - c.pocket_play


@compiled
def pocket_forces(c, body, law, memory, angles, y, k, forces, load, power, pocket_out):
    """Forces of the pockets on the balls: contact with friction, and the shear of a thin film on
    the near side.
    """
    nq = 11 + 3 * c.balls
    nb = 3 * c.balls
    for j in range(c.balls):
        a = 11 + 3 * j
        b = nq + 11 + 3 * j
        d = nq + 11 + nb + 3 * j
        pocket_motion(c, body, angles[j] + y[8], y[a : a + 3], y[b : b + 3], y[d : d + 3], k)
        slide, rate, approach = k[9], k[10], k[11]
        push = normal_force(law, approach, rate, memory[2 * c.balls + j])
        pocket_out[j, 0], pocket_out[j, 1], pocket_out[j, 2] = push, approach, rate
        pull = c.pocket_shear * wall_shear(c.ball_radius, max(c.film_least, -approach))
        if slide > 0.0:
            pull += push * ramped(c.pocket_friction, slide, c.friction_ramp) / slide
        power[POCKET_DAMPING] += (push - elastic_force(law, approach)) * rate
        power[POCKET_FRICTION] += pull * slide * slide
        f0 = -pull * k[6] - push * k[0]
        f1 = -pull * k[7] - push * k[1]
        f2 = -pull * k[8] - push * k[2]
        add_load(load, body, k[3], k[4], k[5], -f0, -f1, -f2)
        arm = -c.ball_radius * pull
        m0, m1, m2 = cross(arm * k[0], arm * k[1], arm * k[2], k[6], k[7], k[8])
        force = forces[j]
        force[0] += f0
        force[1] += f1
        force[2] += f2
        force[3] += m0
        force[4] += m1
        force[5] += m2


@compiled
def cage_land(c, side, bodies, law, impact_speed, loads, power, land_out):
    """One land of the guiding ring and the cage: film, its friction, and the solid contact when
    the gap is used up.
    """
    ring = bodies[0] if c.guide == 1 else bodies[1]
    cage = bodies[2]
    offset = (2.0 * side - 1.0) * c.land_offset
    x, y, z = cage[0] + offset * cage[3], cage[1] + offset * cage[4], cage[2] + offset * cage[5]
    rx, ry, rz = ring[0] + offset * ring[3], ring[1] + offset * ring[4], ring[2] + offset * ring[5]
    _, v1, v2 = point_velocity(cage, x, y, z)
    _, u1, u2 = point_velocity(ring, rx, ry, rz)
    ey = y - ry
    ez = z - rz
    vy = v1 - u1
    vz = v2 - u2
    # the ring inside the cage, or the cage inside the ring
    journal = -1.0 if c.guide == 1 else 1.0
    radius = c.land_radius
    apart = cage[9] - ring[9]
    mean = 0.5 * (cage[9] + ring[9])
    fy, fz, factor = land_film(
        radius, c.land_clearance, c.land_width, c.land_viscosity, ey, ez, vy, vz, mean
    )
    turning = (
        -factor
        * 2.0
        * np.pi
        * c.land_viscosity
        * radius**3
        * c.land_width
        / c.land_clearance
        * apart
    )
    # the friction is the journal's; the couple is the other's
    turning += min(journal, 0.0) * (ey * fz - ez * fy)
    e = np.sqrt(ey * ey + ez * ez)
    uy, uz = (ey / e, ez / e) if e > 0.0 else (1.0, 0.0)
    approach = e - c.land_clearance
    rate = vy * uy + vz * uz
    land_out[side, 0], land_out[side, 1] = approach, rate
    push = normal_force(law, approach, rate, impact_speed)
    slide = journal * radius * apart + uy * vz - uz * vy
    grip = (
        -push
        * ramped(c.land_friction, abs(slide), c.friction_ramp)
        * (1.0 if slide >= 0.0 else -1.0)
    )
    fy = fy - push * uy - grip * uz
    fz = fz - push * uz + grip * uy
    turning += journal * radius * grip
    at_ring = -turning - (ey * fz - ez * fy)  # no moment is left over
    add_load(loads[1], cage, x, y, z, 0.0, fy, fz)
    loads[1, 3] += turning
    if c.guide == 1:
        add_load(loads[0], ring, rx, ry, rz, 0.0, -fy, -fz)
        loads[0, 3] += at_ring
    else:
        power[DRIVE_OUTER] -= ring[9] * at_ring
    stored_power = elastic_force(law, approach) * rate
    power[LAND_FRICTION] -= (
        fy * vy + fz * vz + turning * cage[9] + at_ring * ring[9] + stored_power
    )


@compiled
def ball_equations(c, free, y, forces, power, dy):
    """Newton's and Euler's equations of the balls with drag and weight."""
    nq = 11 + 3 * c.balls
    nb = 3 * c.balls
    for j in range(c.balls):
        for i in range(3):
            dy[11 + 3 * j + i] = y[nq + 11 + 3 * j + i]
            dy[nq + 11 + nb + 3 * j + i] = free[14 + i] * forces[j, 3 + i] / c.ball_inertia
        v = nq + 11 + 3 * j
        size = np.sqrt(y[v] ** 2 + y[v + 1] ** 2 + y[v + 2] ** 2)
        pull = c.drag * size
        power[CHURNING] += pull * size * size
        dy[v] = free[11] * ((forces[j, 0] - pull * y[v]) / c.ball_mass + c.gravity_x)
        dy[v + 1] = free[12] * ((forces[j, 1] - pull * y[v + 1]) / c.ball_mass + c.gravity_y)
        dy[v + 2] = free[13] * ((forces[j, 2] - pull * y[v + 2]) / c.ball_mass + c.gravity_z)


@compiled
def ring_equations(c, free, y, given, acceleration, load, body, power, dy):
    """The inner ring: contacts, loads, unbalance, support, weight, gyroscopic coupling of its
    tilts.
    """
    nq = 11 + 3 * c.balls
    phase = y[22 + 9 * c.balls] + c.unbalance_phase
    spin = given[0]
    co, si = np.cos(phase), np.sin(phase)
    steady = c.unbalance * spin * spin
    swing = c.unbalance * acceleration
    pushes = (given[2], given[3] + steady * co + swing * si, given[4] + steady * si - swing * co)
    weights = (c.gravity_x, c.gravity_y, c.gravity_z)
    for i in range(3):
        v = y[nq + i]
        dy[i] = v
        dy[nq + i] = free[i] * (
            (pushes[i] + load[i] - c.ring_damping * v) / c.ring_mass + weights[i]
        )
        power[LOADS] += pushes[i] * v
        power[SUPPORT] += c.ring_damping * v * v
    vy, vz = y[nq + 3], y[nq + 4]
    dy[3], dy[4] = vy, vz
    gyro = c.ring_polar * spin
    dy[nq + 3] = free[3] * (given[5] + load[4] - gyro * vz) / c.ring_transverse
    dy[nq + 4] = free[4] * (given[6] + load[5] + gyro * vy) / c.ring_transverse
    power[LOADS] += given[5] * vy + given[6] * vz
    power[DRIVE_INNER] -= spin * (load[3] * body[3] + load[4] * body[4] + load[5] * body[5])


@compiled
def cage_equations(c, free, y, load, body, dy):
    """The cage: pockets, lands, weight."""
    nq = 11 + 3 * c.balls
    weights = (c.gravity_x, c.gravity_y, c.gravity_z)
    for i in range(6):
        dy[5 + i] = y[nq + 5 + i]
        dy[nq + 5 + i] = 0.0
    if c.cage_mass <= 0.0:
        return
    for i in range(3):
        dy[nq + 5 + i] = free[5 + i] * (load[i] / c.cage_mass + weights[i])
    spin, vy, vz = y[nq + 8], y[nq + 9], y[nq + 10]
    about = load[3] * body[3] + load[4] * body[4] + load[5] * body[5]
    dy[nq + 8] = free[8] * about / c.cage_polar
    dy[nq + 9] = free[9] * (load[4] - c.cage_polar * spin * vz) / c.cage_transverse
    dy[nq + 10] = free[10] * (load[5] + c.cage_polar * spin * vy) / c.cage_transverse


@compiled
def contact_forces(p, y):
    """All contacts: forces on balls, ring, cage; powers; states."""
    c = p.constants
    bodies = p.bodies
    loads = p.loads
    power = p.power
    forces = p.forces
    power[:] = 0.0
    loads[:] = 0.0
    forces[:] = 0.0
    race_motions(c, bodies, y, p.motion)
    race_friction(p.friction_kind, p.friction_inner, p.normal[0], p.motion[0], p.friction[0])
    race_friction(p.friction_kind, p.friction_outer, p.normal[1], p.motion[1], p.friction[1])
    outer = p.given[7:13]
    outer[:] = 0.0
    for race in range(2):
        load = loads[0] if race == 0 else outer
        race_forces(
            c, p.friction_kind, race, bodies[race], p.normal[race], p.memory, p.motion[race], p.friction[race], forces,
            load, power, p.race_out[race],
        )  # fmt: skip
    power[DRIVE_OUTER] -= bodies[1, 9] * outer[3]
    if c.cage_mass > 0.0:
        scratch = p.given[13:]
        pocket_forces(
            c,
            bodies[2],
            p.normal[POCKET],
            p.memory,
            p.pocket_angle,
            y,
            scratch,
            forces,
            loads[1],
            power,
            p.pocket_out,
        )
        if c.guide > 0:
            for side in range(2):
                cage_land(
                    c,
                    side,
                    bodies,
                    p.normal[LAND],
                    p.memory[3 * c.balls + side],
                    loads,
                    power,
                    p.land_out,
                )


@compiled
def derivative(t, y, p, dy):
    """Rates of the state vector at a time; states of the contacts and powers are left in the
    arrays of `p`.
    """
    c, given, free = p.constants, p.given, p.free
    acceleration = schedule_at(p.schedule, t, given)
    place_bodies(c.balls, y, given[0], given[1], p.bodies)
    contact_forces(p, y)
    ball_equations(c, free, y, p.forces, p.power, dy)
    ring_equations(c, free, y, given, acceleration, p.loads[0], p.bodies[0], p.power, dy)
    cage_equations(c, free, y, p.loads[1], p.bodies[2], dy)
    angle = 22 + 9 * c.balls
    dy[angle] = given[0]
    dy[angle + 1 :] = p.power


@compiled
def energies(y, p, out):
    """Kinetic, elastic and potential energy [J] of a state whose `derivative` was just taken."""
    c = p.constants
    free = p.free
    n = p.constants.balls
    nq = 11 + 3 * n
    nb = 3 * n
    gravity = (c.gravity_x, c.gravity_y, c.gravity_z)
    kinetic = 0.0
    elastic = 0.0
    weight = 0.0
    for j in range(n):
        for i in range(3):
            v = y[nq + 11 + 3 * j + i]
            w = y[nq + 11 + nb + 3 * j + i]
            kinetic += 0.5 * (c.ball_mass * v * v + c.ball_inertia * w * w)
            weight -= free[11 + i] * c.ball_mass * gravity[i] * y[11 + 3 * j + i]
        for race in range(2):
            elastic += stored(p.normal[race], p.race_out[race, j, 1])
        if c.cage_mass > 0.0:
            elastic += stored(p.normal[POCKET], p.pocket_out[j, 1])
    for i in range(3):
        kinetic += 0.5 * (c.ring_mass * y[nq + i] ** 2 + c.cage_mass * y[nq + 5 + i] ** 2)
        weight -= gravity[i] * (
            free[i] * c.ring_mass * y[i] + free[5 + i] * c.cage_mass * y[5 + i]
        )
    kinetic += 0.5 * c.ring_transverse * (y[nq + 3] ** 2 + y[nq + 4] ** 2)
    kinetic += (
        0.5 * c.cage_transverse * (y[nq + 9] ** 2 + y[nq + 10] ** 2)
        + 0.5 * c.cage_polar * y[nq + 8] ** 2
    )
    if c.cage_mass > 0.0 and c.guide > 0:
        elastic += stored(p.normal[LAND], p.land_out[0, 0]) + stored(
            p.normal[LAND], p.land_out[1, 0]
        )
    out[0], out[1], out[2] = kinetic, elastic, weight


@compiled
def stored(law, approach):
    """Elastic energy of a contact, K approach^(n + 1)/(n + 1)."""
    return elastic_force(law, approach) * max(approach, 0.0) / (law[EXPONENT] + 1.0)

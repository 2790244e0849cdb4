"""Balls on races, compiled: where and how they meet, friction, forces."""

import numpy as np

from ehl.compiled import compiled, inlined

from .._state_kernels import accumulate, ball_motion, cross, dot, minus, norm, plus, times, vector
from ..arrays import (
    CENTRAL_FILM,
    CONTACT,
    FILM,
    FILM_DAMPING,
    FORCE,
    FORCE_X,
    FORCE_Y,
    FRICTIONLESS,
    INNER,
    MOMENT,
    ROLL_MOMENT,
    SPIN_MOMENT,
    TABLE,
    WORK,
    RaceMotion,
)
from ._film_kernels import elastic_approach, smallest_load
from ._friction_kernels import friction_by_slopes, friction_law, slopes_hold
from ._kernels import add_load, damped, elastic_force, point_velocity


@compiled
def groove_contact(body, centre_radius, reach, position):
    """Ball in a groove: normal into the race, approach, cosine of the contact angle, distance from
    the axis, direction of the azimuth; the contact angle itself.

    reach = groove radius less ball radius; the approach is the distance of the ball from the
    circle of the groove's centres, less the reach.
    """
    offset = minus(position, body.centre)
    axial = dot(offset, body.axis)
    outward = minus(offset, times(axial, body.axis))
    rho = norm(outward)
    outward = times(1.0 / rho, outward)
    radial = rho - centre_radius
    distance = max(np.sqrt(axial * axial + radial * radial), 1e-12)
    inverse = 1.0 / distance
    sine, cosine = axial * inverse, radial * inverse
    normal = plus(times(sine, body.axis), times(cosine, outward))
    angle = np.arctan(axial / radial)
    return normal, distance - reach, cosine, rho, cross(body.axis, outward), angle


@compiled
def race_motion(c, body, centre_radius, groove_radius, position, velocity, turn):
    """Motion of a ball on a race.

    The entrainment is the mean speed of the two surfaces past the contact, which moves with the
    ball's orbit.
    """
    normal, approach, cosine, rho, around, angle = groove_contact(
        body, centre_radius, groove_radius - c.ball_radius, position
    )
    arm = times(c.ball_radius, normal)
    point = plus(position, arm)
    of_race = point_velocity(body, point)
    of_ball = plus(velocity, cross(turn, arm))
    slide = minus(of_ball, of_race)
    centre = body.velocity
    along = dot(velocity, around)
    orbit = (along - centre[0] * around[0] - centre[1] * around[1] - centre[2] * around[2]) / rho
    mean = 0.5 * dot(plus(of_ball, of_race), around)
    entrainment = mean - along - orbit * c.ball_radius * cosine
    x_axis = times(1.0 if entrainment >= 0.0 else -1.0, around)
    y_axis = cross(normal, x_axis)
    relative_turn = minus(turn, body.turn)
    return RaceMotion(
        normal=normal,
        x_axis=x_axis,
        y_axis=y_axis,
        point=point,
        slide_x=dot(slide, x_axis),
        slide_y=dot(slide, y_axis),
        spin=dot(relative_turn, normal),
        roll=dot(relative_turn, y_axis),
        entrainment=abs(entrainment),
        approach_speed=dot(slide, normal),
        angle=angle,
        approach=approach,
    )


@compiled
def straight_motion(c, body, centre_radius, groove_radius, position, velocity, turn):
    """`race_motion` where all motion is in the middle plane and all turning about the axis."""
    _, ry, rz = minus(position, body.centre)
    rho = np.sqrt(ry * ry + rz * rz)
    inverse = 1.0 / rho  # one division: they and the root are what this costs
    ny, nz = ry * inverse, rz * inverse
    radial = rho - centre_radius
    side = 1.0 if radial >= 0.0 else -1.0  # of the race: outer, inner
    arm = side * c.ball_radius
    _, vy, vz = velocity
    _, by, bz = body.velocity
    along = vz * ny - vy * nz
    drift = bz * ny - by * nz
    of_ball = along + turn[0] * arm
    of_race = drift + body.turn[0] * (rho + arm)
    entrainment = 0.5 * (of_ball + of_race) - along - (along - drift) * inverse * arm
    sense = 1.0 if entrainment >= 0.0 else -1.0
    _, py, pz = position
    return RaceMotion(
        normal=(0.0, side * ny, side * nz),
        x_axis=(0.0, -sense * nz, sense * ny),
        y_axis=(side * sense, 0.0, 0.0),
        point=(0.0, py + arm * ny, pz + arm * nz),
        slide_x=sense * (of_ball - of_race),
        slide_y=0.0,
        spin=0.0,
        roll=side * sense * (turn[0] - body.turn[0]),
        entrainment=abs(entrainment),
        approach_speed=side * ((vy - by) * ny + (vz - bz) * nz),
        angle=0.0,
        approach=abs(radial) - groove_radius + c.ball_radius,
    )


@compiled
def motion_on_race(c, body, centre_radius, groove_radius, y, ball):
    """`race_motion` of a ball of the state, or `straight_motion` where the middle plane is a
    mirror.
    """
    position, velocity, turn = ball_motion(y, c.balls, ball)
    if c.mirrored:
        return straight_motion(c, body, centre_radius, groove_radius, position, velocity, turn)
    return race_motion(c, body, centre_radius, groove_radius, position, velocity, turn)


@compiled
def elastic_and_film(kind, table, law, motion):
    """Approach of the elastic bodies, and the film between them, 0 where the bodies meet dry."""
    approach = motion.approach
    if table is not None and kind == FILM:
        approach = elastic_approach(table.axes, table.scalars, law, approach, motion.entrainment)
    return approach, approach - motion.approach


@compiled
def fade_damping(table, load, friction):
    """Damping of a film, which fades below the table's smallest load as friction does."""
    if table is not None:
        friction[FILM_DAMPING] *= min(1.0, load / smallest_load(table.axes))


@inlined
def race_friction(c, kind, data, load, motion, linear, friction):
    """Friction of a race on a ball under a load, a row of numbers: by its slopes in `linear` where
    they hold, else by the law.
    """
    if load <= 0.0 or kind == FRICTIONLESS:
        friction[:] = 0.0
    else:
        if slopes_hold(linear, load, motion):
            friction_by_slopes(c.mirrored, linear, load, motion, friction)
        else:
            speed = motion.entrainment
            motions = (motion.slide_x, motion.slide_y, motion.spin)
            friction_law(c.mirrored, data.coefficient, data.table, load, speed, motions, friction)
        if kind == FILM:
            fade_damping(data.table, load, friction)


@compiled
def record_contact(motion, approach, film, friction, out):
    """State of a contact without its normal force; an open one has no motion and friction."""
    out[:] = 0.0
    out[CONTACT.approach] = approach
    out[CONTACT.approach_speed] = motion.approach_speed
    out[CONTACT.contact_angle] = motion.angle
    out[CONTACT.film] = film
    if approach <= 0.0:
        return
    out[CONTACT.entrainment_speed] = motion.entrainment
    out[CONTACT.slide_x] = motion.slide_x
    out[CONTACT.slide_y] = motion.slide_y
    out[CONTACT.spin] = motion.spin
    out[CONTACT.friction_x] = friction[FORCE_X]
    out[CONTACT.friction_y] = friction[FORCE_Y]


@compiled
def add_friction(c, motion, body, along, roll, forces, load):
    """Add friction to the loads of a ball and of its race: F_x, F_y, M_n in `along`, M_y."""
    f_x, f_y, spin = along
    grip = plus(times(f_x, motion.x_axis), times(f_y, motion.y_axis))
    couple = plus(times(spin, motion.normal), times(roll, motion.y_axis))
    add_load(load, body, motion.point, times(-1.0, grip))
    accumulate(load, MOMENT, times(-1.0, couple))
    accumulate(forces, FORCE, grip)
    about_centre = cross(times(c.ball_radius, motion.normal), grip)
    accumulate(forces, MOMENT, plus(about_centre, couple))


@inlined
def ball_on_race(p, ball, data, memory, race, body, y, j):
    """Forces of one race on a ball and back; powers; state of the contact."""
    c = p.constants
    kind = p.friction_kind
    law = p.normal[race]
    friction = p.friction
    power = p.power
    centre_radius = c.inner_centre if race == INNER else c.outer_centre
    groove_radius = c.inner_groove if race == INNER else c.outer_groove
    # 1. motion, friction, normal force
    motion = motion_on_race(c, body, centre_radius, groove_radius, y, j)
    approach, film = elastic_and_film(kind, data.table, law, motion)
    elastic = elastic_force(law, approach)
    race_friction(c, kind, data, elastic, motion, ball.linear[race], friction)
    if kind == TABLE:
        film = friction[CENTRAL_FILM]
    out = ball.race_out[race]
    record_contact(motion, approach, film, friction, out)
    if approach <= 0.0:
        return
    rate = motion.approach_speed
    if kind == FILM:
        push = max(0.0, elastic + friction[FILM_DAMPING] * rate)
    else:
        push = damped(law, elastic, rate, memory[race * c.balls + j])
    out[CONTACT.load] = push
    # 2. power lost
    power[WORK.friction_inner + race] -= (
        friction[FORCE_X] * motion.slide_x
        + friction[FORCE_Y] * motion.slide_y
        + friction[SPIN_MOMENT] * motion.spin
        + friction[ROLL_MOMENT] * motion.roll
    )
    power[WORK.race_damping] += (push - elastic) * rate
    # 3. loads on ball and ring
    force = times(-push, motion.normal)
    load = p.loads[race]
    forces = ball.forces
    add_load(load, body, motion.point, times(-1.0, force))
    accumulate(forces, FORCE, force)
    add_friction(c, motion, body, vector(friction, 0), friction[ROLL_MOMENT], forces, load)


@compiled
def race_forces(p, balls, data, memory, race, body, y):
    """Forces of one race on every ball and back; powers; states of the contacts."""
    for j in range(p.constants.balls):
        ball_on_race(p, balls[j], data, memory, race, body, y, j)

"""Balls on races, compiled: where and how they meet, friction, forces."""

import numpy as np

from ehl.compiled import compiled
from ehl.traction._kernels import hertz_friction, table_lookup

from .._state_kernels import (
    accumulate,
    ball_position,
    ball_turn,
    ball_velocity,
    cross,
    dot,
    minus,
    norm,
    plus,
    times,
    vector,
    write,
)
from ..arrays import (
    ANGLE,
    APPROACH,
    APPROACH_SPEED,
    AXIS,
    CENTRAL_FILM,
    CENTRE,
    COEFFICIENT,
    ENTRAINMENT,
    FILM,
    FILM_DAMPING,
    FORCE,
    FORCE_X,
    FORCE_Y,
    FRICTION_INNER,
    FRICTIONLESS,
    INNER,
    MOMENT,
    NORMAL,
    OUTER,
    POINT,
    RACE_ANGLE,
    RACE_APPROACH,
    RACE_DAMPING,
    RACE_ENTRAINMENT,
    RACE_FILM,
    RACE_FORCE,
    RACE_FRICTION_X,
    RACE_FRICTION_Y,
    RACE_RATE,
    RACE_SLIDE_X,
    RACE_SLIDE_Y,
    RACE_SPIN,
    ROLL,
    ROLL_MOMENT,
    SLIDE_X,
    SLIDE_Y,
    SPIN,
    SPIN_MOMENT,
    THICKNESS,
    TURN,
    VELOCITY,
    X_AXIS,
    Y_AXIS,
)
from ..films._kernels import elastic_approach, smallest_load
from ._kernels import add_load, elastic_force, normal_force, point_velocity


@compiled
def groove_contact(body, centre_radius, reach, position):
    """Ball in a groove: normal into the race, approach, cosine of the contact angle, distance from
    the axis, direction of the azimuth; the contact angle itself.

    reach = groove radius less ball radius; the approach is the distance of the ball from the
    circle of the groove's centres, less the reach.
    """
    offset = minus(position, vector(body, CENTRE))
    axis = vector(body, AXIS)
    axial = dot(offset, axis)
    outward = minus(offset, times(axial, axis))
    rho = norm(outward)
    outward = (outward[0] / rho, outward[1] / rho, outward[2] / rho)
    radial = rho - centre_radius
    distance = max(np.sqrt(axial * axial + radial * radial), 1e-12)
    sine, cosine = axial / distance, radial / distance
    normal = plus(times(sine, axis), times(cosine, outward))
    angle = np.arctan2(sine, cosine) if cosine > 0.0 else np.arctan2(-sine, -cosine)
    return normal, distance - reach, cosine, rho, cross(axis, outward), angle


@compiled
def race_motion(c, body, centre_radius, groove_radius, position, velocity, turn, k):
    """Motion of a ball on a race, to a row of `EquationData.motion`.

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
    centre = vector(body, VELOCITY)
    along = dot(velocity, around)
    orbit = (along - centre[0] * around[0] - centre[1] * around[1] - centre[2] * around[2]) / rho
    mean = 0.5 * dot(plus(of_ball, of_race), around)
    entrainment = mean - along - orbit * c.ball_radius * cosine
    x_axis = times(1.0 if entrainment >= 0.0 else -1.0, around)
    y_axis = cross(normal, x_axis)
    relative_turn = minus(turn, vector(body, TURN))
    write(k, NORMAL, normal)
    write(k, X_AXIS, x_axis)
    write(k, Y_AXIS, y_axis)
    write(k, POINT, point)
    k[SLIDE_X] = dot(slide, x_axis)
    k[SLIDE_Y] = dot(slide, y_axis)
    k[SPIN] = dot(relative_turn, normal)
    k[ROLL] = dot(relative_turn, y_axis)
    k[ENTRAINMENT] = abs(entrainment)
    k[APPROACH_SPEED] = dot(slide, normal)
    k[ANGLE] = angle
    k[APPROACH] = approach


@compiled
def race_motions(c, bodies, y, motion):
    """`race_motion` of every ball and both races."""
    inner, outer = bodies[INNER], bodies[OUTER]
    for j in range(c.balls):
        position = vector(y, ball_position(j))
        velocity = vector(y, ball_velocity(c.balls, j))
        turn = vector(y, ball_turn(c.balls, j))
        race_motion(
            c, inner, c.inner_centre, c.inner_groove, position, velocity, turn, motion[INNER, j]
        )
        race_motion(
            c, outer, c.outer_centre, c.outer_groove, position, velocity, turn, motion[OUTER, j]
        )


@compiled
def race_friction(kind, data, law, motion, friction):
    """Friction of one race on all balls, rows of `EquationData.friction`.

    Where films separate the bodies the approach in the motion becomes that of the elastic bodies,
    and the damping fades below the table's smallest load as friction does.
    """
    for j in range(motion.shape[0]):
        k, out = motion[j], friction[j]
        k[THICKNESS] = 0.0
        if kind == FILM:
            distance = k[APPROACH]
            k[APPROACH] = elastic_approach(data.axes, data.scalars, law, distance, k[ENTRAINMENT])
            k[THICKNESS] = k[APPROACH] - distance
        load = elastic_force(law, k[APPROACH])
        speed = k[ENTRAINMENT]
        slide_x = k[SLIDE_X]
        slide_y = k[SLIDE_Y]
        spin = k[SPIN]
        if load <= 0.0 or kind == FRICTIONLESS:
            out[:] = 0.0
        elif kind == COEFFICIENT:
            hertz_friction(
                data.disc, data.law, data.shape, load, speed, slide_x, slide_y, spin, out
            )
        else:
            table_lookup(
                data.axes, data.constants, data.scalars, data.values,
                load, speed, slide_x, slide_y, spin, out,
            )  # fmt: skip
            if kind == FILM:
                out[FILM_DAMPING] *= min(1.0, load / smallest_load(data.axes))
            else:
                k[THICKNESS] = out[CENTRAL_FILM]


@compiled
def record_contact(k, f, out):
    """State of a contact without its normal force; an open one has no motion and friction."""
    out[:] = 0.0
    out[RACE_APPROACH] = k[APPROACH]
    out[RACE_RATE] = k[APPROACH_SPEED]
    out[RACE_ANGLE] = k[ANGLE]
    out[RACE_FILM] = k[THICKNESS]
    if k[APPROACH] <= 0.0:
        return
    out[RACE_ENTRAINMENT] = k[ENTRAINMENT]
    out[RACE_SLIDE_X] = k[SLIDE_X]
    out[RACE_SLIDE_Y] = k[SLIDE_Y]
    out[RACE_SPIN] = k[SPIN]
    out[RACE_FRICTION_X] = f[FORCE_X]
    out[RACE_FRICTION_Y] = f[FORCE_Y]


@compiled
def race_forces(c, kind, race, body, law, memory, motion, friction, forces, load, power, race_out):
    """Forces of one race on every ball and back; powers; states of the contacts."""
    for j in range(c.balls):
        k = motion[j]
        f = friction[j]
        out = race_out[j]
        record_contact(k, f, out)
        approach, rate = k[APPROACH], k[APPROACH_SPEED]
        if approach <= 0.0:
            continue
        elastic = elastic_force(law, approach)
        if kind == FILM:
            push = max(0.0, elastic + f[FILM_DAMPING] * rate)
        else:
            push = normal_force(law, approach, rate, memory[race * c.balls + j])
        out[RACE_FORCE] = push
        power[FRICTION_INNER + race] -= (
            f[FORCE_X] * k[SLIDE_X]
            + f[FORCE_Y] * k[SLIDE_Y]
            + f[SPIN_MOMENT] * k[SPIN]
            + f[ROLL_MOMENT] * k[ROLL]
        )
        power[RACE_DAMPING] += (push - elastic) * rate
        normal = vector(k, NORMAL)
        y_axis = vector(k, Y_AXIS)
        grip = plus(times(f[FORCE_X], vector(k, X_AXIS)), times(f[FORCE_Y], y_axis))
        force = minus(grip, times(push, normal))
        couple = plus(times(f[SPIN_MOMENT], normal), times(f[ROLL_MOMENT], y_axis))
        add_load(load, body, vector(k, POINT), times(-1.0, force))
        accumulate(load, MOMENT, times(-1.0, couple))
        accumulate(forces[j], FORCE, force)
        about_centre = cross(times(c.ball_radius, normal), grip)
        accumulate(forces[j], MOMENT, plus(about_centre, couple))

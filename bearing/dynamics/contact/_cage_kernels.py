"""Balls in pockets and the cage on its guiding lands, compiled."""

import numpy as np

from ehl.compiled import compiled, inlined

from .._state_kernels import accumulate, ball_motion, cross, dot, minus, norm, plus, times
from ..arrays import (
    CAGE_LOAD,
    CONTACT,
    FORCE,
    GUIDED_BY_INNER_RING,
    INNER,
    LAND,
    MOMENT,
    OIL_VISCOSITY,
    POCKET,
    WORK,
)
from ..layout import CAGE_ROTATION, RING
from ._belt_kernels import film_by_matrix, film_matrix_is_valid, pocket_film, pocket_film_gap
from ._kernels import add_load, elastic_force, land_film, normal_force, point_velocity, ramped


@compiled
def pocket_frame(c, body, place, turned):
    """Directions of a pocket: outward along its axis, around the cage, along the cage's axis.

    place: direction (y, z) of the pocket in the cage; turned: that of the cage's own z = 0.
    """
    axis = body.axis
    e1 = place[0] * turned[0] - place[1] * turned[1]
    e2 = place[1] * turned[0] + place[0] * turned[1]
    if c.mirrored:
        return (0.0, e1, e2), (0.0, -e2, e1), axis
    tilted = e1 * axis[1] + e2 * axis[2]
    outward = (-tilted * axis[0], e1 - tilted * axis[1], e2 - tilted * axis[2])
    outward = times(1.0 / norm(outward), outward)
    return outward, cross(axis, outward), axis


@compiled
def pocket_motion(c, body, frame, position):
    """Where a ball stands in its pocket: normal and distance from the middle, and its place around
    and along the axis.
    """
    outward, around, axis = frame
    offset = minus(position, body.centre)
    across = dot(offset, around)
    axial = dot(offset, axis)
    radial = dot(offset, outward) - c.pocket_circle if c.pocket_circle > 0.0 else 0.0
    distance = np.sqrt(across * across + axial * axial + radial * radial)
    p = 1.0
    q = 0.0
    r = 0.0
    if distance > 1e-15:
        p, q, r = times(1.0 / distance, (across, axial, radial))
    normal = plus(plus(times(p, around), times(q, axis)), times(r, outward))
    return normal, distance, (across, axial)


@compiled
def pocket_contact(c, position, relative, spin, normal, push):
    """Force and moment on a ball that is pressed against its pocket, the point, and the power of
    friction; relative, spin: velocity and turn of the ball in the pocket.
    """
    arm = times(c.ball_radius, normal)
    slide = plus(relative, cross(spin, arm))
    slide = minus(slide, times(dot(slide, normal), normal))
    speed = norm(slide)
    pull = push * ramped(c.pocket_friction, speed, c.friction_ramp) / max(speed, 1e-300)
    grip = times(-pull, slide)
    return (
        minus(grip, times(push, normal)),
        cross(arm, grip),
        plus(position, arm),
        pull * speed * speed,
    )


@compiled
def film_now(p, film, frame, play, motion):
    """`pocket_film`, by its matrix where that holds, at the viscosity of this time.

    motion: place, velocity and turn of the ball in its pocket.
    """
    place, velocity, turn = motion
    if film_matrix_is_valid(p.constants, film, pocket_film_gap(play, place)):
        force, moment, lost = film_by_matrix(p.constants, film, velocity, turn)
    else:
        force, moment, lost = pocket_film(p.constants, frame, play, place, velocity, turn)
    ratio = p.given[OIL_VISCOSITY]
    return times(ratio, force), times(ratio, moment), ratio * lost


@inlined
def ball_in_pocket(p, ball, memory, body, turned, y, j):
    """Forces of its pocket on a ball and back: contact with friction, film all around the ball.

    turned: direction (y, z) of the cage's own z = 0.
    """
    c = p.constants
    law = p.normal[POCKET]
    load = p.loads[CAGE_LOAD]
    power = p.power
    # 1. contact
    position, velocity, turn = ball_motion(y, c.balls, j)
    play = ball.pocket_play
    forces = ball.forces
    out = ball.pocket_out
    frame = pocket_frame(c, body, ball.pocket_direction, turned)
    normal, distance, place = pocket_motion(c, body, frame, position)
    relative = minus(velocity, point_velocity(body, position))
    spin = minus(turn, body.turn)
    rate = dot(relative, normal)
    push = normal_force(law, distance - play, rate, memory[POCKET * c.balls + j])
    out[CONTACT.load] = push
    out[CONTACT.approach] = distance - play
    out[CONTACT.approach_speed] = rate
    if push > 0.0:
        force, moment, point, lost = pocket_contact(c, position, relative, spin, normal, push)
        power[WORK.pocket_damping] += (push - elastic_force(law, distance - play)) * rate
        power[WORK.pocket_friction] += lost
        add_load(load, body, point, times(-1.0, force))
        accumulate(forces, FORCE, force)
        accumulate(forces, MOMENT, moment)
    # 2. film
    if c.film_viscosity * c.pocket_height > 0.0:
        force, moment, lost = film_now(p, ball.pocket_films, frame, play, (place, relative, spin))
        power[WORK.pocket_film] += lost
        add_load(load, body, position, times(-1.0, force))
        accumulate(load, MOMENT, times(-1.0, moment))
        accumulate(forces, FORCE, force)
        accumulate(forces, MOMENT, moment)


@compiled
def cage_direction(y):
    """Direction (y, z) of the cage's own z = 0."""
    rotation = y[RING + CAGE_ROTATION]
    return np.cos(rotation), np.sin(rotation)


@compiled
def pocket_forces(p, balls, memory, body, y):
    """Forces of pockets on balls, and back."""
    turned = cage_direction(y)
    for j in range(p.constants.balls):
        ball_in_pocket(p, balls[j], memory, body, turned, y, j)


@compiled
def land_contact(p, memory, side, eccentricity, velocity, slide_about):
    """Solid contact of cage and land where the gap is used up: normal force, its direction (y, z),
    friction, power stored; slide_about: sliding speed by the rotations.
    """
    c = p.constants
    law = p.normal[LAND]
    out = p.land_out[side]
    ey, ez = eccentricity
    vy, vz = velocity
    e = np.sqrt(ey * ey + ez * ez)
    uy, uz = (ey / e, ez / e) if e > 0.0 else (1.0, 0.0)
    approach = e - c.land_clearance
    rate = vy * uy + vz * uz
    out[CONTACT.approach] = approach
    out[CONTACT.approach_speed] = rate
    push = normal_force(law, approach, rate, memory[LAND * c.balls + side])
    out[CONTACT.load] = push
    slide = slide_about + uy * vz - uz * vy
    grip = -push * ramped(c.land_friction, abs(slide), c.friction_ramp)
    grip = grip * (1.0 if slide >= 0.0 else -1.0)
    return push, uy, uz, grip, elastic_force(law, approach) * rate


@compiled
def cage_land(p, memory, side, ring, cage):
    """One land of the guiding ring and the cage: film, its friction, and the solid contact.

    The friction of the film is the journal's, the couple of its force the sleeve's; the journal is
    the ring inside the cage (-1) or the cage inside the ring (+1).
    """
    c = p.constants
    loads = p.loads
    inside = c.guide == GUIDED_BY_INNER_RING
    journal = -1.0 if inside else 1.0
    # 1. eccentricity, its rate, and the speeds of the two surfaces
    offset = (2.0 * side - 1.0) * c.land_offset
    on_cage = plus(cage.centre, times(offset, cage.axis))
    on_ring = plus(ring.centre, times(offset, ring.axis))
    _, ey, ez = minus(on_cage, on_ring)
    _, vy, vz = minus(point_velocity(cage, on_cage), point_velocity(ring, on_ring))
    cage_speed = cage.turn[0]
    ring_speed = ring.turn[0]
    speed_difference = cage_speed - ring_speed
    # 2. film
    mean = 0.5 * (cage_speed + ring_speed)
    gap = c.land_radius, c.land_clearance, c.land_width
    viscosity = c.film_viscosity * p.given[OIL_VISCOSITY]
    fy, fz, factor = land_film(*gap, viscosity, ey, ez, vy, vz, mean)
    shear = -factor * 2.0 * np.pi * viscosity * c.land_radius**3
    turning = shear * c.land_width / c.land_clearance * speed_difference
    turning += min(journal, 0.0) * (ey * fz - ez * fy)
    # 3. solid contact with friction
    slide_about = journal * c.land_radius * speed_difference
    motion = (ey, ez), (vy, vz)
    push, uy, uz, grip, stored_power = land_contact(p, memory, side, *motion, slide_about)
    fy = fy - push * uy - grip * uz
    fz = fz - push * uz + grip * uy
    turning += journal * c.land_radius * grip
    at_ring = -turning - (ey * fz - ez * fy)  # the moments of the pair add up to nothing
    # 4. loads on cage and ring, power
    add_load(loads[CAGE_LOAD], cage, on_cage, (0.0, fy, fz))
    loads[CAGE_LOAD, MOMENT] += turning
    if inside:
        add_load(loads[INNER], ring, on_ring, (0.0, -fy, -fz))
        loads[INNER, MOMENT] += at_ring
    else:
        p.power[WORK.drive_outer] -= ring_speed * at_ring
    p.power[WORK.land_friction] -= (
        fy * vy + fz * vz + turning * cage_speed + at_ring * ring_speed + stored_power
    )

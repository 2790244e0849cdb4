"""Balls in pockets and the cage on its guiding lands, compiled."""

import numpy as np

from ehl.compiled import compiled

from .._state_kernels import accumulate, ball_motion, cross, dot, minus, norm, plus, times
from ..arrays import CAGE_LOAD, CONTACT, FORCE, GUIDED_BY_INNER_RING, INNER, MOMENT, POCKET, WORK
from ..layout import CAGE_ROTATION, RING
from ._kernels import add_load, elastic_force, land_film, normal_force, point_velocity, ramped

# of the film around a ball: cosine and sine of the angle of its places [-]; 8 of them hold shear
# and squeeze to 0.4 % up to an eccentricity of 0.9, to 4 % at 0.98
BELT_ANGLES = 0.25 * np.pi * (np.arange(8) + 0.5)
BELT = np.stack((np.cos(BELT_ANGLES), np.sin(BELT_ANGLES)))


@compiled
def pocket_frame(body, angle):
    """Directions of a pocket: outward along its axis, around the cage, along the cage's axis."""
    axis = body.axis
    e1, e2 = np.cos(angle), np.sin(angle)
    tilted = e1 * axis[1] + e2 * axis[2]
    outward = (-tilted * axis[0], e1 - tilted * axis[1], e2 - tilted * axis[2])
    outward = times(1.0 / norm(outward), outward)
    return outward, cross(axis, outward), axis


@compiled
def pocket_motion(c, body, frame, play, position, velocity, turn):
    """Where a ball meets its pocket: normal, point, slide vector and size, approach and rate; the
    ball's place around and along the axis in the pocket.
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
        p, q, r = across / distance, axial / distance, radial / distance
    normal = plus(plus(times(p, around), times(q, axis)), times(r, outward))
    arm = times(c.ball_radius, normal)
    point = plus(position, arm)
    slide = minus(plus(velocity, cross(turn, arm)), point_velocity(body, point))
    rate = dot(slide, normal)
    slide = minus(slide, times(rate, normal))
    return normal, point, slide, norm(slide), rate, distance - play, (across, axial)


@compiled
def belt_film(c, gap):
    """Shear and squeeze of the film between a ball and a wall of some height around it, for a
    gap at the middle: integrals over y of 1/h [-] and of the pressure by 6 viscosity R rate [1/m].

    h = gap + y^2/(2R) within half the height; the pressure p = -6 viscosity R rate (1/h^2 -
    1/h_end^2) of Reynolds' equation where the oil leaves along y.
    """
    square = 2.0 * c.ball_radius * gap
    s = np.sqrt(square)
    end = 0.5 * c.pocket_height
    whole = square + end * end
    angle = np.arctan(end / s)
    shear = 4.0 * c.ball_radius / s * angle
    ends = end / (square * whole) + angle / (s * square) - 2.0 * end / (whole * whole)
    return shear, 4.0 * c.ball_radius**2 * ends


@compiled
def pocket_film(c, frame, play, place, velocity, turn):
    """Force and moment of the oil between ball and pocket on the ball, and the power lost.

    Around the ball the film is h = play (1 - eps cos(phi)); it is sheared by the sliding, and
    squeezed where the ball comes nearer; where it goes away the oil is torn and does not pull.
    Places are spaced evenly in the angle theta of cos(phi) = (a + cos(theta))/(1 + a cos(theta)),
    a = eps/(1 + root(1 - eps^2)): between an even spacing and Sommerfeld's (1904), which is that
    of the narrow side.

    place: of the ball around and along the axis; velocity, turn: relative to the pocket. Where the
    middle plane is a mirror, half of the places do.
    """
    across, axial = place
    e = np.sqrt(across * across + axial * axial)
    u, w = (across / e, axial / e) if e > 1e-15 else (1.0, 0.0)
    _, around, axis = frame
    main = plus(times(u, around), times(w, axis))
    side = plus(times(-w, around), times(u, axis))
    eps = max(0.0, min(e, play - c.film_least) / play)
    a = eps / (1.0 + np.sqrt(1.0 - eps * eps))
    root = np.sqrt(1.0 - a * a)
    force = (0.0, 0.0, 0.0)
    moment = (0.0, 0.0, 0.0)
    power = 0.0
    places = BELT.shape[1] // 2 if c.mirrored else BELT.shape[1]
    step = 2.0 * np.pi * c.film_viscosity * c.ball_radius * root / places
    for k in range(places):
        d = 1.0 + a * BELT[0, k]
        cosine = (a + BELT[0, k]) / d
        normal = plus(times(cosine, main), times(root * BELT[1, k] / d, side))
        shear, squeeze = belt_film(c, play * (1.0 - eps * cosine))
        slide = plus(velocity, times(c.ball_radius, cross(turn, normal)))
        rate = dot(velocity, normal)
        slide = minus(slide, times(rate, normal))
        pull = step / d * shear
        push = 6.0 * c.ball_radius * step / d * squeeze * max(rate, 0.0)
        force = minus(force, plus(times(pull, slide), times(push, normal)))
        moment = minus(moment, times(c.ball_radius * pull, cross(normal, slide)))
        power += pull * dot(slide, slide) + push * rate
    if c.mirrored:
        force = minus(force, times(dot(force, axis), axis))
        moment = times(dot(moment, axis), axis)
    return force, moment, power


@compiled
def pocket_forces(c, body, law, memory, angles, plays, y, forces, load, power, pocket_out):
    """Forces of pockets on balls: contact with friction, film all around the ball."""
    rotation = y[RING + CAGE_ROTATION]
    for j in range(c.balls):
        # 1. contact
        position, velocity, turn = ball_motion(y, c.balls, j)
        frame = pocket_frame(body, angles[j] + rotation)
        normal, point, slide, speed, rate, approach, place = pocket_motion(
            c, body, frame, plays[j], position, velocity, turn
        )
        push = normal_force(law, approach, rate, memory[POCKET * c.balls + j])
        pocket_out[j, CONTACT.load] = push
        pocket_out[j, CONTACT.approach] = approach
        pocket_out[j, CONTACT.approach_speed] = rate
        if push > 0.0:
            pull = push * ramped(c.pocket_friction, speed, c.friction_ramp) / max(speed, 1e-300)
            power[WORK.pocket_damping] += (push - elastic_force(law, approach)) * rate
            power[WORK.pocket_friction] += pull * speed * speed
            force = minus(times(-pull, slide), times(push, normal))
            add_load(load, body, point, times(-1.0, force))
            accumulate(forces[j], FORCE, force)
            accumulate(forces[j], MOMENT, cross(times(-c.ball_radius * pull, normal), slide))
        # 2. film
        if c.film_viscosity * c.pocket_height > 0.0:
            velocity = minus(velocity, point_velocity(body, position))
            force, moment, lost = pocket_film(
                c, frame, plays[j], place, velocity, minus(turn, body.turn)
            )
            power[WORK.pocket_film] += lost
            add_load(load, body, position, times(-1.0, force))
            accumulate(load, MOMENT, times(-1.0, moment))
            accumulate(forces[j], FORCE, force)
            accumulate(forces[j], MOMENT, moment)


@compiled
def land_contact(c, law, impact_speed, eccentricity, velocity, slide_about, out):
    """Solid contact of cage and land where the gap is used up: normal force, its direction (y, z),
    friction, power stored; slide_about: sliding speed by the rotations.
    """
    ey, ez = eccentricity
    vy, vz = velocity
    e = np.sqrt(ey * ey + ez * ez)
    uy, uz = (ey / e, ez / e) if e > 0.0 else (1.0, 0.0)
    approach = e - c.land_clearance
    rate = vy * uy + vz * uz
    out[CONTACT.approach] = approach
    out[CONTACT.approach_speed] = rate
    push = normal_force(law, approach, rate, impact_speed)
    out[CONTACT.load] = push
    slide = slide_about + uy * vz - uz * vy
    grip = -push * ramped(c.land_friction, abs(slide), c.friction_ramp)
    grip = grip * (1.0 if slide >= 0.0 else -1.0)
    return push, uy, uz, grip, elastic_force(law, approach) * rate


@compiled
def cage_land(c, side, ring, cage, law, impact_speed, loads, power, land_out):
    """One land of the guiding ring and the cage: film, its friction, and the solid contact.

    The friction of the film is the journal's, the couple of its force the sleeve's; the journal is
    the ring inside the cage (-1) or the cage inside the ring (+1).
    """
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
    fy, fz, factor = land_film(
        c.land_radius, c.land_clearance, c.land_width, c.film_viscosity, ey, ez, vy, vz,
        0.5 * (cage_speed + ring_speed),
    )  # fmt: skip
    shear = -factor * 2.0 * np.pi * c.film_viscosity * c.land_radius**3
    turning = shear * c.land_width / c.land_clearance * speed_difference
    turning += min(journal, 0.0) * (ey * fz - ez * fy)
    # 3. solid contact with friction
    slide_about = journal * c.land_radius * speed_difference
    push, uy, uz, grip, stored_power = land_contact(
        c, law, impact_speed, (ey, ez), (vy, vz), slide_about, land_out[side]
    )
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
        power[WORK.drive_outer] -= ring_speed * at_ring
    power[WORK.land_friction] -= (
        fy * vy + fz * vz + turning * cage_speed + at_ring * ring_speed + stored_power
    )

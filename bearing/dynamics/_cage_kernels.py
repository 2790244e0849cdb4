"""Balls in pockets, the films around them, and the cage on its guiding lands, compiled."""

import numpy as np

from oilfilm.ehl.compiled import compiled, inlined

from ._race_kernels import elastic_force, land_film, normal_force, ramped
from ._state_kernels import (
    accumulate,
    add_load,
    ball_motion,
    cross,
    dot,
    minus,
    norm,
    plus,
    point_velocity,
    times,
    vector,
)
from .arrays import (
    CAGE_LOAD,
    CAGE_ROTATION,
    CONTACT,
    FORCE,
    GUIDED_BY_INNER_RING,
    INNER,
    LAND,
    MOMENT,
    OIL_VISCOSITY,
    POCKET,
    RING,
    WORK,
)

# angles of the places of the film around a ball [rad], with cosine and sine [-]; 8 hold shear
# and squeeze to 0.4 % up to an eccentricity of 0.9, to 4 % at 0.98
POCKET_FILM_ANGLES = 0.25 * np.pi * (np.arange(8) + 0.5)
POCKET_FILM_DIRECTIONS = np.stack((np.cos(POCKET_FILM_ANGLES), np.sin(POCKET_FILM_ANGLES)))
# columns of `pocket_films`: gap of a matrix [m], 0 for none; steps between two; the matrix
GAP, INTERVAL, MATRIX = range(3)
GAP_CHANGE = 0.2  # of the gap, up to which a matrix holds [-]


@compiled
def pocket_film_integrals(c, gap):
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
def pocket_film_points(c):
    """Places around a ball: half of them where the middle plane is a mirror."""
    return POCKET_FILM_DIRECTIONS.shape[1] // 2 if c.mirrored else POCKET_FILM_DIRECTIONS.shape[1]


@compiled
def pocket_film_gap(play, position):
    """Gap of the narrow side of a ball at a place in its pocket, negative where pressed [m]."""
    across, axial = position
    return play - np.sqrt(across * across + axial * axial)


@compiled
def pocket_film_circle(c, frame, play, position):
    """Directions towards the narrow side and across it, play, eccentricity and its `a`."""
    across, axial = position
    e = np.sqrt(across * across + axial * axial)
    u, w = (across / e, axial / e) if e > 1e-15 else (1.0, 0.0)
    _, around, axis = frame
    main = plus(times(u, around), times(w, axis))
    side = plus(times(-w, around), times(u, axis))
    eps = max(0.0, min(e, play - c.film_least) / play)
    return main, side, play, eps, eps / (1.0 + np.sqrt(1.0 - eps * eps))


@compiled
def pocket_film_point(c, belt, k):
    """Normal of a place around a ball, its shear and squeeze over a sliding speed [N s/m]."""
    main, side, play, eps, a = belt
    root = np.sqrt(1.0 - a * a)
    d = 1.0 + a * POCKET_FILM_DIRECTIONS[0, k]
    cosine = (a + POCKET_FILM_DIRECTIONS[0, k]) / d
    normal = plus(times(cosine, main), times(root * POCKET_FILM_DIRECTIONS[1, k] / d, side))
    shear, squeeze = pocket_film_integrals(c, play * (1.0 - eps * cosine))
    step = 2.0 * np.pi * c.film_viscosity * c.ball_radius * root / (pocket_film_points(c) * d)
    return normal, step * shear, 6.0 * c.ball_radius * step * squeeze


@compiled
def pocket_film(c, frame, play, position, velocity, turn):
    """Force and moment of the oil between ball and pocket on the ball, and the power lost.

    Around the ball the film is h = play (1 - eps cos(phi)); it is sheared by the sliding, and
    squeezed where the ball comes nearer; where it goes away the oil is torn and does not pull.
    Places are spaced evenly in the angle theta of cos(phi) = (a + cos(theta))/(1 + a cos(theta)),
    a = eps/(1 + root(1 - eps^2)): between an even spacing and Sommerfeld's (1904), which is that
    of the narrow side.

    position: of the ball around and along the axis; velocity, turn: relative to the pocket. Where
    the middle plane is a mirror, half of the places do.
    """
    belt = pocket_film_circle(c, frame, play, position)
    axis = frame[2]
    force = (0.0, 0.0, 0.0)
    moment = (0.0, 0.0, 0.0)
    power = 0.0
    for k in range(pocket_film_points(c)):
        normal, pull, squeeze = pocket_film_point(c, belt, k)
        slide = plus(velocity, times(c.ball_radius, cross(turn, normal)))
        rate = dot(velocity, normal)
        slide = minus(slide, times(rate, normal))
        push = squeeze * max(rate, 0.0)
        force = minus(force, plus(times(pull, slide), times(push, normal)))
        moment = minus(moment, times(c.ball_radius * pull, cross(normal, slide)))
        power += pull * dot(slide, slide) + push * rate
    if c.mirrored:
        force = minus(force, times(dot(force, axis), axis))
        moment = times(dot(moment, axis), axis)
    return force, moment, power


@compiled
def film_matrix(c, frame, play, position, velocity, film):
    """`pocket_film` as a matrix over velocity and angular velocity of the ball, squeezed where it
    comes nearer now; with the gap that it is of.
    """
    film[:] = 0.0
    film[GAP] = max(pocket_film_gap(play, position), c.film_least)
    belt = pocket_film_circle(c, frame, play, position)
    matrix = film[MATRIX:].reshape((6, 6))
    for k in range(pocket_film_points(c)):
        normal, pull, squeeze = pocket_film_point(c, belt, k)
        push = squeeze if dot(velocity, normal) > 0.0 else 0.0
        arm = c.ball_radius * pull
        if c.mirrored:
            straight_place(matrix, normal, pull, push, c.ball_radius)
            continue
        for i in range(3):
            for j in range(3):
                both = normal[i] * normal[j]
                across_normal = (1.0 if i == j else 0.0) - both
                matrix[i, j] += pull * across_normal + push * both
                matrix[i + 3, j + 3] += c.ball_radius * arm * across_normal
            p, q = (i + 1) % 3, (i + 2) % 3
            # the vector product with the normal
            matrix[i + 3, p] -= arm * normal[q]
            matrix[i + 3, q] += arm * normal[p]
            matrix[i, p + 3] += arm * normal[q]
            matrix[i, q + 3] -= arm * normal[p]


@compiled
def straight_place(matrix, normal, pull, push, radius):
    """Contribution of one place to a film's matrix of motions in the middle plane, y and z, and
    turns about the axis.
    """
    n_x, n_y, n_z = normal
    arm = radius * pull
    matrix[1, 1] += pull * (1.0 - n_y * n_y) + push * n_y * n_y
    matrix[2, 2] += pull * (1.0 - n_z * n_z) + push * n_z * n_z
    matrix[1, 2] += (push - pull) * n_y * n_z
    matrix[2, 1] += (push - pull) * n_y * n_z
    matrix[1, 3] -= arm * n_z
    matrix[3, 1] -= arm * n_z
    matrix[2, 3] += arm * n_y
    matrix[3, 2] += arm * n_y
    matrix[3, 3] += radius * arm * (1.0 - n_x * n_x)


@compiled
def film_matrix_is_valid(c, film, gap):
    """There is a matrix, of about this gap."""
    change = abs(max(gap, c.film_least) - film[GAP])
    return film[GAP] > 0.0 and change <= GAP_CHANGE * film[GAP]


@compiled
def film_by_matrix(c, film, velocity, turn):
    """`pocket_film` by its matrix: force, moment, power lost."""
    if c.mirrored:
        motion = velocity[1], velocity[2], turn[0]
        force = (0.0, -straight_row(film, 1, motion), -straight_row(film, 2, motion))
        moment = (-straight_row(film, 3, motion), 0.0, 0.0)
    else:
        force = film_rows(film, MATRIX, velocity, turn)
        moment = film_rows(film, MATRIX + 18, velocity, turn)
    return force, moment, -dot(force, velocity) - dot(moment, turn)


@compiled
def straight_row(film, row, motion):
    """A row of a film's matrix times a motion in the middle plane, and a turn across it."""
    return dot(vector(film, MATRIX + 6 * row + 1), motion)


@compiled
def film_rows(film, first, velocity, turn):
    """Three rows of a film's matrix times the motion, negative."""
    out = (0.0, 0.0, 0.0)
    for i in range(3):
        row = first + 6 * i
        part = -dot(vector(film, row), velocity) - dot(vector(film, row + 3), turn)
        out = (part if i == 0 else out[0], part if i == 1 else out[1], part if i == 2 else out[2])
    return out


@compiled
def pocket_frame(c, body, direction, turned):
    """Directions of a pocket: outward along its axis, around the cage, along the cage's axis.

    direction: direction (y, z) of the pocket in the cage; turned: that of the cage's own z = 0.
    """
    axis = body.axis
    e1 = direction[0] * turned[0] - direction[1] * turned[1]
    e2 = direction[1] * turned[0] + direction[0] * turned[1]
    if c.mirrored:
        return (0.0, e1, e2), (0.0, -e2, e1), axis
    tilted = e1 * axis[1] + e2 * axis[2]
    outward = (-tilted * axis[0], e1 - tilted * axis[1], e2 - tilted * axis[2])
    outward = times(1.0 / norm(outward), outward)
    return outward, cross(axis, outward), axis


@compiled
def pocket_motion(c, body, frame, position):
    """Position of a ball in its pocket: normal and distance from the middle, and its place around
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
    ratio = p.prescribed[OIL_VISCOSITY]
    return times(ratio, force), times(ratio, moment), ratio * lost


@inlined
def ball_in_pocket(p, ball, impact_speeds, body, turned, y, j):
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
    push = normal_force(law, distance - play, rate, impact_speeds[POCKET * c.balls + j])
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
def pocket_forces(p, balls, impact_speeds, body, y):
    """Forces of pockets on balls, and back."""
    turned = cage_direction(y)
    for j in range(p.constants.balls):
        ball_in_pocket(p, balls[j], impact_speeds, body, turned, y, j)


@compiled
def land_contact(p, impact_speeds, side, eccentricity, velocity, slide_about):
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
    push = normal_force(law, approach, rate, impact_speeds[LAND * c.balls + side])
    out[CONTACT.load] = push
    slide = slide_about + uy * vz - uz * vy
    grip = -push * ramped(c.land_friction, abs(slide), c.friction_ramp)
    grip = grip * (1.0 if slide >= 0.0 else -1.0)
    return push, uy, uz, grip, elastic_force(law, approach) * rate


@compiled
def cage_land(p, impact_speeds, side, ring, cage):
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
    viscosity = c.film_viscosity * p.prescribed[OIL_VISCOSITY]
    fy, fz, factor = land_film(*gap, viscosity, ey, ez, vy, vz, mean)
    shear = -factor * 2.0 * np.pi * viscosity * c.land_radius**3
    turning = shear * c.land_width / c.land_clearance * speed_difference
    turning += min(journal, 0.0) * (ey * fz - ez * fy)
    # 3. solid contact with friction
    slide_about = journal * c.land_radius * speed_difference
    motion = (ey, ez), (vy, vz)
    push, uy, uz, grip, stored_power = land_contact(p, impact_speeds, side, *motion, slide_about)
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

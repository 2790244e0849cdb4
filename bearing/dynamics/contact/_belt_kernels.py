"""The oil film around a ball in its pocket, compiled; and as a matrix between its evaluations."""

import numpy as np

from ehl.compiled import compiled

from .._state_kernels import cross, dot, minus, plus, times, vector

# of the film around a ball: cosine and sine of the angle of its places [-]; 8 of them hold shear
# and squeeze to 0.4 % up to an eccentricity of 0.9, to 4 % at 0.98
POCKET_FILM_ANGLES = 0.25 * np.pi * (np.arange(8) + 0.5)
POCKET_FILM_DIRECTIONS = np.stack((np.cos(POCKET_FILM_ANGLES), np.sin(POCKET_FILM_ANGLES)))
# of `pocket_films`: gap that a matrix is of [m], 0 for none; steps between two; the matrix
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
def pocket_film_gap(play, place):
    """Gap of the narrow side of a ball at a place in its pocket, negative where pressed [m]."""
    across, axial = place
    return play - np.sqrt(across * across + axial * axial)


@compiled
def pocket_film_circle(c, frame, play, place):
    """Directions towards the narrow side and across it, play, eccentricity and its `a`."""
    across, axial = place
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
    belt = pocket_film_circle(c, frame, play, place)
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
def film_matrix(c, frame, play, place, velocity, film):
    """`pocket_film` as a matrix over velocity and angular velocity of the ball, squeezed where it
    comes nearer now; with the gap that it is of.
    """
    film[:] = 0.0
    film[GAP] = max(pocket_film_gap(play, place), c.film_least)
    belt = pocket_film_circle(c, frame, play, place)
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
    """What one place adds to a film's matrix of motions in the middle plane, y and z, and of turns
    about the axis.
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
    """Whether a matrix is there, of about a gap."""
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

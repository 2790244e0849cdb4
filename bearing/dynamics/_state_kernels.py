"""Places in the state vector (`arrays`), vectors of three components and loads of bodies, for the
other kernels.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled

from .arrays import BODIES, FORCE, MOMENT


@compiled
def velocities(balls):
    """Place of the first velocity."""
    return BODIES + 3 * balls


@compiled
def ball_position(ball):
    """Place of the x coordinate of a ball."""
    return BODIES + 3 * ball


@compiled
def ball_velocity(balls, ball):
    """Place of the x velocity of a ball."""
    return velocities(balls) + BODIES + 3 * ball


@compiled
def ball_turn(balls, ball):
    """Place of the angular velocity of a ball about x."""
    return velocities(balls) + BODIES + 3 * balls + 3 * ball


@compiled
def ring_angle(balls):
    """Place of the rotation of the inner ring."""
    return velocities(balls) + BODIES + 6 * balls


@compiled
def outer_angle(balls):
    """Place of the rotation of the outer ring."""
    return ring_angle(balls) + 1


@compiled
def roll_angle(balls, ball):
    """Place of the angle by which a ball has rolled about its own axis."""
    return ring_angle(balls) + 2 + ball


@compiled
def accumulators(balls):
    """Place of the first accumulator of energy."""
    return ring_angle(balls) + 2 + balls


@compiled
def vector(row, first):
    """Three numbers of an array from a place on."""
    return row[first], row[first + 1], row[first + 2]


@compiled
def accumulate(row, first, a):
    """Add a vector to three numbers of an array from a place on."""
    row[first] += a[0]
    row[first + 1] += a[1]
    row[first + 2] += a[2]


@compiled
def ball_motion(y, balls, ball):
    """Position, velocity and angular velocity of a ball."""
    return (
        vector(y, ball_position(ball)),
        vector(y, ball_velocity(balls, ball)),
        vector(y, ball_turn(balls, ball)),
    )


@compiled
def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@compiled
def minus(a, b):
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@compiled
def times(factor, a):
    """Vector times a number."""
    return factor * a[0], factor * a[1], factor * a[2]


@compiled
def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def norm(a):
    """Length of a vector."""
    return np.sqrt(dot(a, a))


@compiled
def cross(a, b):
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@compiled
def point_velocity(body, point):
    """Velocity of a point of a body."""
    return plus(body.velocity, cross(body.turn, minus(point, body.centre)))


@compiled
def add_load(load, body, point, force):
    """Add a force at a point to the force on a body and to the moment about its centre."""
    accumulate(load, FORCE, force)
    accumulate(load, MOMENT, cross(minus(point, body.centre), force))

"""Jacobian of the equations of motion by differences, compiled.

A ball acts on the others through ring and cage alone, but where balls meet without a cage: of the
bearing a changed coordinate of a ball changes its own contacts, and by their loads the rates of
ring and cage. Its columns cost the contacts of one ball each, those of ring and cage all of them.
"""

import numpy as np

from ehl.compiled import compiled, inlined
from ehl.oil._kernels import copy_rows

from .._kernels import (
    ball_rates,
    cage_equations,
    place_bodies,
    ring_equations,
    schedule_at,
    solved_derivative,
)
from .._state_kernels import velocities
from ..arrays import INNER, INNER_SPEED, OUTER, OUTER_SPEED
from ..contact._cage_kernels import ball_in_pocket, cage_direction
from ..contact._race_kernels import ball_on_race
from ..layout import BODIES

OF_BODIES = -1  # in place of a ball: a coordinate of ring or cage


@compiled
def ball_of(balls, place):
    """The ball that a coordinate or speed of the state vector belongs to, or `OF_BODIES`."""
    first = velocities(balls)
    inside = place - BODIES if place < first else place - first - BODIES
    if inside < 0:
        return OF_BODIES
    return (inside // 3) % balls


@compiled
def balls_act_alone(c):
    """Whether no ball acts on another but through ring and cage, and each stands for itself."""
    return c.symmetric_copies == 1 and c.cage_mass > 0.0


@compiled
def ball_alone(data, bodies, y, j):
    """Contacts of one ball: forces on it, added to the loads of rings and cage."""
    p = data.bearing
    ball = data.balls[j]
    memory = data.memory
    inner, outer, cage = bodies
    ball.forces[:] = 0.0
    ball_on_race(p, ball, data.friction_inner, memory, INNER, inner, y, j)
    ball_on_race(p, ball, data.friction_outer, memory, OUTER, outer, y, j)
    ball_in_pocket(p, ball, memory, cage, cage_direction(y), y, j)


@compiled
def difference(data, base, owner, ball, column, step, out):
    """A column of slopes from the rates now: rows of ring and cage, and of a ball or all balls."""
    for row in range(owner.size):
        if ball == OF_BODIES or owner[row] == OF_BODIES or owner[row] == ball:
            out[row, column] = (data.rates[data.solved[row]] - base[row]) / step


@inlined
def columns_of_ball(data, t, j, base, owner, scale, out):
    """Columns of one ball, by its contacts alone; `p.loads` are those of all balls, before and
    after.
    """
    p = data.bearing
    c = p.constants
    y = data.whole
    acceleration = schedule_at(data.times, data.schedule, t, p.given)
    bodies = place_bodies(c.balls, y, p.given[INNER_SPEED], p.given[OUTER_SPEED])
    total = p.loads.copy()
    p.loads[:] = 0.0
    ball_alone(data, bodies, y, j)
    others = total - p.loads
    for column in range(owner.size):
        if owner[column] != j:
            continue
        place = data.solved[column]
        kept = y[place]
        y[place] = kept + scale[column]
        copy_rows(others, p.loads)
        ball_alone(data, bodies, y, j)
        ball_rates(p, data.balls[j], y, j, data.rates)
        ring_equations(p, t, y, acceleration, bodies[0], data.rates)
        cage_equations(p, y, bodies[2], data.rates)
        difference(data, base, owner, j, column, scale[column], out)
        y[place] = kept
    copy_rows(total, p.loads)


@compiled
def jacobian(t, y, data, scale, out):
    """Slopes of the rates of coordinates and speeds that are solved over them, shape (mechanical,
    mechanical), by one-sided differences of steps `scale`.
    """
    c = data.bearing.constants
    size = scale.size
    base = np.zeros(y.size)
    rates = np.zeros(y.size)
    owner = np.zeros(size, np.int64)
    alone = balls_act_alone(c)
    for column in range(size):
        owner[column] = ball_of(c.balls, data.solved[column])
    solved_derivative(t, y, data, base)
    # 1. ring and cage, and balls that act on each other, by all contacts
    for column in range(size):
        if alone and owner[column] != OF_BODIES:
            continue
        kept = y[column]
        y[column] = kept + scale[column]
        solved_derivative(t, y, data, rates)
        difference(data, base, owner, OF_BODIES, column, scale[column], out)
        y[column] = kept
    # 2. each ball by its own
    solved_derivative(t, y, data, rates)
    if alone:
        for j in range(c.balls):
            columns_of_ball(data, t, j, base, owner, scale, out)

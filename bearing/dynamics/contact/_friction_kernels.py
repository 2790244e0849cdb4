"""Friction of a ball on a race by its law, and linearised in the sliding between calls of the law.

Loads vibrate within some microseconds, sliding changes within hundreds. A step in time takes

    f = (Q/Q_0)^n (f_0 + S (s - s_0))

with the friction f_0, its slopes S, load Q_0 and motions s_0 = (slide_x, slide_y, spin) of an
earlier state; `integration._clock_kernels` renews them. n = 1 for forces, 4/3 for the moment about
the normal, 5/3 for that of curvature, as under one coefficient on an ellipse that grows with the
cube root of the load.
"""

import numpy as np

from ehl.compiled import compiled
from ehl.traction._kernels import hertz_friction, straight_friction, table_lookup

from .._state_kernels import dot, vector
from ..arrays import FRICTION_COLUMNS, LINEAR

FORCES = 4  # F_x, F_y, M_n, M_y: those that sliding changes
MOTIONS = 3  # slide_x, slide_y, spin
STRAIGHT_ROWS = 2  # of the nodes of `straight_friction`; those over the ellipse have three
# load over that of the slopes, either way, up to which they hold [-]
LOAD_CHANGE = 2.0
# of the differences that slopes are taken from: over the entrainment [-], and at least [m/s]
DIFFERENCE = 1.0e-6
LEAST_DIFFERENCE = 1.0e-9
SPIN_RADIUS = 0.1  # radius at which a spin slides by the difference, over that of the ball [-]


@compiled
def friction_law(mirrored, coefficient, table, load, speed, motions, friction):
    """Friction of the law: a row of numbers, as the kernels of `ehl.traction` write them.

    One of coefficient and table is None, which is a type: its branch is not compiled.
    """
    slide_x, slide_y, spin = motions
    if coefficient is not None:
        disc, law, shape = coefficient
        if mirrored and disc.shape[0] == STRAIGHT_ROWS:
            straight_friction(disc, law, shape, load, speed, slide_x, friction)
        else:
            hertz_friction(disc, law, shape, load, speed, slide_x, slide_y, spin, friction)
    if table is not None:
        table_lookup(
            table.axes, table.constants, table.scalars, table.values,
            load, speed, slide_x, slide_y, spin, friction,
        )  # fmt: skip


@compiled
def load_changed(linear, load):
    """Whether there are no slopes of about this load."""
    base = linear[LINEAR.load]
    return not base <= LOAD_CHANGE * load or load > LOAD_CHANGE * base or base <= 0.0


@compiled
def slopes_hold(linear, load, motion):
    """Whether slopes are there, of about this load, and of rolling the same way round."""
    if load_changed(linear, load):
        return False
    return dot(motion.x_axis, vector(linear, LINEAR.x_axis)) > 0.0


@compiled
def friction_by_slopes(mirrored, linear, load, motion, friction):
    """Friction linearised in the sliding and in proportion to the load; films as they were."""
    d_x = motion.slide_x - linear[LINEAR.motion]
    if mirrored:
        straight_by_slopes(linear, load / linear[LINEAR.load], d_x, friction)
        return
    d_y = motion.slide_y - linear[LINEAR.motion + 1]
    d_n = motion.spin - linear[LINEAR.motion + 2]
    share = load / linear[LINEAR.load]
    growth = 1.0 + (share - 1.0) / 3.0  # its cube root, near 1
    for k in range(FORCES):
        share *= 1.0 if k < 2 else growth
        s = LINEAR.slopes + MOTIONS * k
        change = linear[s] * d_x + linear[s + 1] * d_y + linear[s + 2] * d_n
        friction[k] = share * (linear[LINEAR.friction + k] + change)
    for k in range(FORCES, FRICTION_COLUMNS):
        friction[k] = linear[LINEAR.friction + k]


@compiled
def straight_by_slopes(linear, share, d_x, friction):
    """`friction_by_slopes` where all sliding is along the entrainment: F_x and M_y alone."""
    growth = 1.0 + (share - 1.0) / 3.0
    last = FORCES - 1
    friction[0] = share * (linear[LINEAR.friction] + linear[LINEAR.slopes] * d_x)
    moment = linear[LINEAR.friction + last] + linear[LINEAR.slopes + MOTIONS * last] * d_x
    friction[1] = 0.0
    friction[2] = 0.0
    friction[last] = share * growth * growth * moment
    for k in range(FORCES, FRICTION_COLUMNS):
        friction[k] = linear[LINEAR.friction + k]


@compiled
def set_friction(linear, load, motion, friction):
    """Make a friction just taken from the law the base of the slopes."""
    linear[LINEAR.load] = load
    linear[LINEAR.motion] = motion.slide_x
    linear[LINEAR.motion + 1] = motion.slide_y
    linear[LINEAR.motion + 2] = motion.spin
    for i in range(3):
        linear[LINEAR.x_axis + i] = motion.x_axis[i]
    for k in range(FRICTION_COLUMNS):
        linear[LINEAR.friction + k] = friction[k]


@compiled
def difference(motion, force, mobility, least, time):
    """Change of a motion that its slope is taken over, towards rest: what the friction itself does
    to it in a step. A reversal within that is a slope of this step, not a jump.
    """
    size = max(least, 0.5 * time * mobility * abs(force))
    return -size if motion > 0.0 else size


@compiled
def set_slopes(c, data, load, motion, linear, friction, time):
    """Slopes of the law by differences at a load and motion for steps of some time, and the rate
    at which a ball that slides comes to rest by them; the base is that of `set_friction`.
    """
    speed = motion.entrainment
    least = max(DIFFERENCE * speed, LEAST_DIFFERENCE)
    inertia = c.ball_inertia
    mobility = 1.0 / c.ball_mass + c.ball_radius * c.ball_radius / inertia
    f = LINEAR.friction
    d_x = difference(motion.slide_x, linear[f], mobility, least, time)
    d_y = difference(motion.slide_y, linear[f + 1], mobility, least, time)
    least /= SPIN_RADIUS * c.ball_radius
    d_n = difference(motion.spin, linear[f + 2], 1.0 / inertia, least, time)
    motions = 1 if c.mirrored else MOTIONS
    for i in range(motions):
        size = d_x if i == 0 else (d_y if i == 1 else d_n)
        moved = (
            motion.slide_x + (size if i == 0 else 0.0),
            motion.slide_y + (size if i == 1 else 0.0),
            motion.spin + (size if i == 2 else 0.0),
        )
        friction_law(c.mirrored, data.coefficient, data.table, load, speed, moved, friction)
        for k in range(FORCES):
            change = friction[k] - linear[LINEAR.friction + k]
            linear[LINEAR.slopes + MOTIONS * k + i] = change / size
    s = LINEAR.slopes
    along = abs(linear[s]) + abs(linear[s + MOTIONS + 1])
    linear[LINEAR.rate] = along * mobility + abs(linear[s + 2 * MOTIONS + 2]) / inertia
    if not np.isfinite(linear[LINEAR.rate]):
        linear[LINEAR.load] = 0.0

"""Friction that a step cannot resolve, made implicit in the motion of each ball.

Where the step h times the rate at which friction ends a ball's sliding passes `STIFF`, explicit
stages would swing. There friction counts at the velocities V + gamma h a that the ball's own
acceleration a leads to,

    a = A (V + gamma h a),    gamma h = h/2 - 1/rate,

so that h times the rate is `STIFF` for the stages, and sliding follows what drives it with a delay
of less than h/2. Forces and powers are of the friction that acts: energies close as they did.
"""

from oilfilm.ehl.compiled import compiled

from ._race_kernels import (
    FORCES,
    LOAD_CHANGE,
    MOTIONS,
    add_friction,
    elastic_force,
    motion_on_race,
)
from ._state_kernels import ball_velocity, cross, dot, norm, times, vector
from .arrays import BODIES, CONTACT, FORCE, FREE_TURN, INNER, LINEAR, OUTER, WORK

STIFF = 2.0  # step times rate that the explicit stages are left with [-]
FREEDOMS = 6  # velocity and angular velocity of a ball


@compiled
def load_share(law, linear, approach):
    """Load over that of the slopes; 0 where they do not hold."""
    base = linear[LINEAR.load]
    if base <= 0.0:
        return 0.0
    share = elastic_force(law, approach) / base
    return share if 1.0 / LOAD_CHANGE <= share <= LOAD_CHANGE else 0.0


@compiled
def sliding_rate(p, ball):
    """Rate at which friction on both races ends the sliding of a ball, by its slopes."""
    rate = 0.0
    for race in range(2):
        approach = ball.race_out[race, CONTACT.approach]
        share = load_share(p.normal[race], ball.linear[race], approach)
        rate += share * ball.linear[race, LINEAR.rate]
    return rate


@compiled
def friction_is_stiff(p, balls):
    """A step cannot resolve the sliding of some ball."""
    h = p.implicit_step[0]
    for j in range(p.constants.balls):
        ball = balls[j]
        # shares of the loads are at most LOAD_CHANGE: most balls need no more than this
        most = LOAD_CHANGE * (ball.linear[INNER, LINEAR.rate] + ball.linear[OUTER, LINEAR.rate])
        if h * most > STIFF and h * sliding_rate(p, ball) > STIFF:
            return True
    return False


@compiled
def motion_direction(c, motion, which):
    """Velocity and angular velocity of the ball that slide_x, slide_y or the spin is the product
    with.
    """
    if which == 2:
        return (0.0, 0.0, 0.0), motion.normal
    axis = motion.x_axis if which == 0 else motion.y_axis
    return axis, cross(times(c.ball_radius, motion.normal), axis)


@compiled
def force_direction(c, motion, which):
    """Force and moment about the ball's centre of F_x, F_y, M_n or M_y of size one."""
    if which < MOTIONS:
        return motion_direction(c, motion, which)
    return (0.0, 0.0, 0.0), motion.y_axis


@compiled
def mobility(c, free, row):
    """Acceleration of a ball over a force or moment on it; 0 where it is not free."""
    if row < 3:
        return free[BODIES + row] / c.ball_mass
    return free[FREE_TURN + row - 3] / c.ball_inertia


@compiled
def add_slopes(c, free, motion, linear, factor, system):
    """Subtract the slopes of a contact from a ball's system, times the share of the load and gamma
    h.
    """
    for k in range(FORCES):
        force, moment = force_direction(c, motion, k)
        for i in range(MOTIONS):
            slope = factor * linear[LINEAR.slopes + MOTIONS * k + i]
            velocity, turn = motion_direction(c, motion, i)
            for row in range(FREEDOMS):
                push = force[row] if row < 3 else moment[row - 3]
                part = slope * push * mobility(c, free, row)
                for column in range(3):
                    system[row, column] -= part * velocity[column]
                    system[row, column + 3] -= part * turn[column]


@compiled
def solve(system):
    """Gauss' elimination of a square with its right-hand side as last column, which becomes the
    solution; diagonals dominate.
    """
    n = system.shape[0]
    for i in range(n):
        for row in range(i + 1, n):
            factor = system[row, i] / system[i, i]
            for column in range(i, n + 1):
                system[row, column] -= factor * system[i, column]
    for i in range(n - 1, -1, -1):
        for column in range(i + 1, n):
            system[i, n] -= system[i, column] * system[column, n]
        system[i, n] /= system[i, i]


@compiled
def begin_system(p, ball, y, j):
    """The unit matrix, and the acceleration of a ball as it would be."""
    c = p.constants
    free = p.free
    system = p.system
    v = ball_velocity(c.balls, j)
    pull = c.drag * norm(vector(y, v))
    system[:] = 0.0
    for row in range(FREEDOMS):
        system[row, row] = 1.0
        push = ball.forces[FORCE + row] - (pull * y[v + row] if row < 3 else 0.0)
        system[row, FREEDOMS] = push * mobility(c, free, row)
        if row < 3:
            system[row, FREEDOMS] += free[BODIES + row] * c.gravity[row]


@compiled
def ball_friction(p, ball, body, race, y, j, delay):
    """Add what friction gains by the acceleration of the ball, over a time `delay`."""
    c = p.constants
    linear = ball.linear[race]
    out = ball.race_out[race]
    system = p.system
    friction = p.friction
    share = load_share(p.normal[race], linear, out[CONTACT.approach])
    if share == 0.0:
        return
    motion = motion_of(c, race, body, y, j)
    friction[:] = 0.0
    for i in range(MOTIONS):
        velocity, turn = motion_direction(c, motion, i)
        change = 0.0
        for row in range(3):
            change += velocity[row] * system[row, FREEDOMS] + turn[row] * system[row + 3, FREEDOMS]
        for k in range(FORCES):
            slope = linear[LINEAR.slopes + MOTIONS * k + i]
            friction[k] += share * delay * slope * change
    add_friction(c, motion, body, vector(friction, 0), friction[3], ball.forces, p.loads[race])
    out[CONTACT.friction_x] += friction[0]
    out[CONTACT.friction_y] += friction[1]
    slides = dot(vector(friction, 0), (motion.slide_x, motion.slide_y, motion.spin))
    p.power[WORK.friction_inner + race] -= slides + friction[3] * motion.roll


@compiled
def motion_of(c, race, body, y, ball):
    """Motion of a ball of the state on a race."""
    centre_radius = c.inner_centre if race == INNER else c.outer_centre
    groove_radius = c.inner_groove if race == INNER else c.outer_groove
    return motion_on_race(c, body, centre_radius, groove_radius, y, ball)


@compiled
def implicit_friction(p, balls, y, inner, outer):
    """Make friction implicit over the step `p.implicit_step` where it is stiff; forces, loads and
    powers are those of all other parts before.
    """
    c = p.constants
    h = p.implicit_step[0]
    for j in range(c.balls):
        ball = balls[j]
        rate = sliding_rate(p, ball)
        if h * rate <= STIFF:
            continue
        delay = h / STIFF - 1.0 / rate
        begin_system(p, ball, y, j)
        for race in range(2):
            body = inner if race == INNER else outer
            linear = ball.linear[race]
            share = load_share(p.normal[race], linear, ball.race_out[race, CONTACT.approach])
            if share > 0.0:
                motion = motion_of(c, race, body, y, j)
                add_slopes(c, p.free, motion, linear, share * delay, p.system)
        solve(p.system)
        for race in range(2):
            body = inner if race == INNER else outer
            ball_friction(p, ball, body, race, y, j, delay)

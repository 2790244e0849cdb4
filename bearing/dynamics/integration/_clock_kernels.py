"""The slower clock of friction: when a step asks the law again, compiled.

Between its calls friction is linear in the sliding (`contact._friction_kernels`). A contact is
asked again after 1, 2, 4 or 8 steps: less often where its slopes predicted the friction, sooner
where they did not, at once where its load has doubled or halved.
"""

from ehl.compiled import compiled
from ehl.oil._kernels import copy

from .._kernels import place_bodies
from .._state_kernels import ball_motion, minus, norm
from ..arrays import CONTACT, FRICTIONLESS, INNER, INNER_SPEED, LINEAR, OIL_VISCOSITY, OUTER_SPEED
from ..contact._belt_kernels import (
    INTERVAL,
    film_by_matrix,
    film_matrix,
    film_matrix_is_valid,
    pocket_film_gap,
)
from ..contact._cage_kernels import cage_direction, pocket_frame, pocket_motion
from ..contact._friction_kernels import (
    FORCES,
    friction_by_slopes,
    friction_law,
    load_changed,
    set_friction,
    set_slopes,
    slopes_hold,
)
from ..contact._implicit_kernels import motion_of
from ..contact._kernels import elastic_force, point_velocity

LONGEST_INTERVAL = 8.0  # [steps]
# errors of the friction over that which counts as one: slopes are taken anew above it, the law
# is asked twice as often above it, half as often below it [-]
STEEP = 0.1
LARGE = 0.25
SMALL = 0.05


@compiled
def costs_little(coefficient):
    """True of a law that is asked in every evaluation: a coefficient at the contact's centre."""
    if coefficient is not None:
        return coefficient.disc.shape[1] == 1
    return False


@compiled
def friction_error(c, linear, friction, time, speed):
    """Error of a ball's velocity that the slopes led to within a time, over a speed."""
    force = abs(friction[0] - linear[0]) + abs(friction[1] - linear[1])
    moment = abs(friction[2] - linear[2]) + abs(friction[3] - linear[3])
    mobility = 1.0 / c.ball_mass + c.ball_radius * c.ball_radius / c.ball_inertia
    return 0.5 * time * mobility * (force + moment / c.ball_radius) / speed


@compiled
def renew_contact(c, data, load, motion, linear, predicted_friction, friction, time, speed):
    """Friction of one contact from its law, and after how many steps again."""
    held = slopes_hold(linear, load, motion)
    if held:
        friction_by_slopes(c.mirrored, linear, load, motion, friction)
        copy(friction[:FORCES], predicted_friction)
    motions = (motion.slide_x, motion.slide_y, motion.spin)
    friction_law(
        c.mirrored, data.coefficient, data.table, load, motion.entrainment, motions, friction
    )
    error = 0.0
    interval = linear[LINEAR.interval]
    if held:
        error = friction_error(c, predicted_friction, friction, interval * time, speed)
    changed = abs(load - linear[LINEAR.load]) > 0.2 * load
    set_friction(linear, load, motion, friction)
    if not held or error > STEEP or changed:
        set_slopes(c, data, load, motion, linear, friction, time)
    if not held or error > LARGE:
        linear[LINEAR.interval] = 1.0
    elif error < SMALL:
        linear[LINEAR.interval] = min(LONGEST_INTERVAL, 2.0 * interval)


@compiled
def forget_slopes(balls):
    """Slopes of friction and matrices of films, so that all are due at the next step."""
    for j in range(balls.size):
        linear = balls[j].linear
        linear[:] = 0.0
        linear[:, LINEAR.interval] = 1.0
        film = balls[j].pocket_films
        film[:] = 0.0
        film[INTERVAL] = 1.0


@compiled
def renew_friction(data, y, step, time, speed):
    """Ask the law of the contacts that are due at a state whose `derivative` was just taken:
    whether there were any.

    step: number of this one. speed: an error of velocity that counts as one.
    """
    p = data.bearing
    c = p.constants
    if p.friction_kind == FRICTIONLESS or costs_little(data.friction_inner.coefficient):
        return False
    inner, outer, _ = place_bodies(c.balls, y, p.given[INNER_SPEED], p.given[OUTER_SPEED])
    some = False
    for race in range(2):
        body = inner if race == INNER else outer
        for j in range(c.balls):
            ball = data.balls[j]
            linear = ball.linear[race]
            load = elastic_force(p.normal[race], ball.race_out[race, CONTACT.approach])
            if load <= 0.0:
                linear[LINEAR.load] = 0.0
                linear[LINEAR.interval] = 1.0
            due = step % int(linear[LINEAR.interval]) == 0
            if load <= 0.0 or not (due or load_changed(linear, load)):
                continue
            some = True
            motion = motion_of(c, race, body, y, j)
            law = data.friction_inner if race == INNER else data.friction_outer
            renew_contact(
                c, law, load, motion, linear, p.predicted_friction, p.friction, time, speed
            )
    return some


@compiled
def renew_pocket(c, frame, play, motion, film, time, speed):
    """The matrix of one pocket's film anew, and when again; time: of a step, times the viscosity
    over that of the matrix.
    """
    place, velocity, turn = motion
    error = 0.0
    held = film_matrix_is_valid(c, film, pocket_film_gap(play, place))
    interval = film[INTERVAL]
    if held:
        force, moment, _ = film_by_matrix(c, film, velocity, turn)
    film_matrix(c, frame, play, place, velocity, film)
    film[INTERVAL] = 1.0
    if held:
        real, about, _ = film_by_matrix(c, film, velocity, turn)
        off = norm(minus(real, force)) + norm(minus(about, moment)) / c.ball_radius
        mobility = 1.0 / c.ball_mass + c.ball_radius * c.ball_radius / c.ball_inertia
        error = 0.5 * interval * time * mobility * off / speed
        if error < SMALL:
            film[INTERVAL] = min(LONGEST_INTERVAL, 2.0 * interval)
        elif error < LARGE:
            film[INTERVAL] = interval


@compiled
def renew_pockets(p, balls, y, step, time, speed):
    """`renew_friction` of the films in the pockets: whether there were any to renew."""
    c = p.constants
    if c.cage_mass <= 0.0 or c.film_viscosity * c.pocket_height <= 0.0:
        return False
    some = False
    _, _, body = place_bodies(c.balls, y, p.given[INNER_SPEED], p.given[OUTER_SPEED])
    turned = cage_direction(y)
    for j in range(c.balls):
        ball = balls[j]
        film = ball.pocket_films
        due = step % int(film[INTERVAL]) == 0
        # in a round pocket the film's gap is wider by what the ball is off along the pocket's axis
        if not due and film_matrix_is_valid(c, film, -ball.pocket_out[CONTACT.approach]):
            continue
        some = True
        position, velocity, turn = ball_motion(y, c.balls, j)
        frame = pocket_frame(c, body, ball.pocket_direction, turned)
        place = pocket_motion(c, body, frame, position)[2]
        relative = minus(velocity, point_velocity(body, position))
        motion = (place, relative, minus(turn, body.turn))
        time_of_film = p.given[OIL_VISCOSITY] * time
        renew_pocket(c, frame, ball.pocket_play, motion, film, time_of_film, speed)
    return some

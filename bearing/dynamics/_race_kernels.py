"""Balls on races, compiled: normal force of Hertz or of a solved film, damping, friction by a law
or by its slopes, and what both races do to a ball.
"""

import numpy as np

from oilfilm.ehl.compiled import compiled, inlined
from oilfilm.ehl.traction._kernels import (
    CENTRAL_FILM,
    LOAD_POWER,
    hertz_friction,
    straight_friction,
    table_lookup,
)

from ._state_kernels import (
    accumulate,
    add_load,
    ball_motion,
    cross,
    dot,
    minus,
    norm,
    outer_angle,
    plus,
    point_velocity,
    ring_angle,
    roll_angle,
    times,
    vector,
)
from .arrays import (
    CONTACT,
    DAMPING,
    EXPONENT,
    FILM,
    FILM_DAMPING,
    FILM_LOAD,
    FILM_RATE,
    FORCE,
    FORCE_X,
    FORCE_Y,
    FORM_SHARE,
    FRICTION_COLUMNS,
    FRICTIONLESS,
    HEAVY_LOAD,
    HEAVY_RATE,
    INNER,
    KNOT_COUNT,
    KNOT_FIRST,
    KNOT_STEP,
    KNOTS,
    LINEAR,
    LOSS,
    MOMENT,
    POCKET,
    RACE_FILM,
    ROLL_MOMENT,
    ROLL_SPEED,
    SPIN_MOMENT,
    STIFFNESS,
    TABLE,
    WORK,
    RaceMotion,
)

# largest eccentricity of the film of a land; beyond, its forces stay and the solid contact counts
# [-]
ECCENTRICITY_LIMIT = 0.95

# rows and columns of the axes of a table
LOAD, SPEED = range(2)
FIRST, DENSITY, NODES = range(3)
NEWTON_STEPS = 40
# last step of Newton's iteration over the approach; the error left is its square [-]
STEP_TOLERANCE = 1.0e-9

FORCES = 4  # F_x, F_y, M_n, M_y: those that sliding changes
MOTIONS = 3  # slide_x, slide_y, spin
STRAIGHT_ROWS = 2  # of the nodes of `straight_friction`; those over the ellipse have three
# load over that of the slopes, either way, up to which they hold [-]
LOAD_CHANGE = 2.0
# differences that slopes are taken from: over the entrainment [-], and at least [m/s]
DIFFERENCE = 1.0e-6
LEAST_DIFFERENCE = 1.0e-9
TURN = 2.0 * np.pi
SPIN_RADIUS = 0.1  # radius at which a spin slides by the difference, over that of the ball [-]


@compiled
def stiffness_at(law, approach):
    """Stiffness of a law with knots [N/m^1.5], linear over ln(approach), constant at its ends."""
    place = (np.log(approach) - law[KNOT_FIRST]) / law[KNOT_STEP]
    place = min(max(place, 0.0), KNOT_COUNT - 1.0)
    k = min(int(place), KNOT_COUNT - 2)
    left = law[KNOTS + k]
    return left + (place - k) * (law[KNOTS + k + 1] - left)


@compiled
def knot_energy(law, approach):
    """Integral of the force of a law with knots: (K + s (u - u_k)) e^(5u/2), u = ln(approach)."""
    end = np.log(approach)
    first = law[KNOT_FIRST]
    energy = 0.4 * law[KNOTS] * np.exp(2.5 * min(end, first))
    for k in range(KNOT_COUNT):
        left = first + k * law[KNOT_STEP]
        if end <= left:
            break
        last = k == KNOT_COUNT - 1
        right = end if last else min(end, left + law[KNOT_STEP])
        slope = 0.0 if last else (law[KNOTS + k + 1] - law[KNOTS + k]) / law[KNOT_STEP]
        base = law[KNOTS + k] / 2.5 - slope / 6.25
        at_right = (base + slope * (right - left) / 2.5) * np.exp(2.5 * right)
        energy += at_right - base * np.exp(2.5 * left)
    return energy


@compiled
def elastic_force(law, approach):
    """K approach^n, zero in the gap."""
    if approach <= 0.0:
        return 0.0
    if law[KNOT_STEP] > 0.0:
        return stiffness_at(law, approach) * approach * np.sqrt(approach)
    if law[EXPONENT] == 1.5:  # a root costs a fifth of a power
        return law[STIFFNESS] * approach * np.sqrt(approach)
    return law[STIFFNESS] * approach ** law[EXPONENT]


@compiled
def elastic_energy(law, approach):
    """K approach^(n + 1)/(n + 1), stored in a contact."""
    if law[KNOT_STEP] > 0.0 and approach > 0.0:
        return knot_energy(law, approach)
    return elastic_force(law, approach) * max(approach, 0.0) / (law[EXPONENT] + 1.0)


@compiled
def normal_force(law, approach, speed, impact_speed):
    """K approach^n (1 + chi speed/impact speed), never adhesive."""
    return damped(law, elastic_force(law, approach), speed, impact_speed)


@compiled
def damped(law, elastic, speed, impact_speed):
    """Elastic force with its damping, never adhesive."""
    if elastic <= 0.0:
        return 0.0
    return max(0.0, elastic * (1.0 + law[DAMPING] * speed / impact_speed))


@compiled
def lasting(law, elastic, approach, speed):
    """Force of a contact that lasts, damped by its film and in proportion to its stiffness, never
    adhesive.
    """
    film = law[FILM_RATE] * min(1.0, elastic / law[FILM_LOAD])
    if law[HEAVY_LOAD] > 0.0 and elastic > law[FILM_LOAD]:
        heavy = np.log(law[HEAVY_LOAD] / law[FILM_LOAD])
        part = min(1.0, np.log(elastic / law[FILM_LOAD]) / heavy)
        film += part * (law[HEAVY_RATE] - law[FILM_RATE])
    loss = law[LOSS] * law[EXPONENT] * elastic / approach
    return max(0.0, elastic + (film + loss) * speed)


@compiled
def ramped(friction, slide, ramp):
    """Coefficient of friction that rises linearly up to a sliding speed `ramp`."""
    return friction if slide >= ramp else friction * slide / ramp


@compiled
def pressure_integrals(eps, cos_end, sin_end):
    """Integrals of cos^2, cos sin and sin^2 of theta over (1 + eps cos theta)^3 along the half of
    the circle that ends at (cos_end, sin_end).

    By Sommerfeld's substitution (1904) 1 + eps cos theta = (1 - eps^2)/(1 - eps cos psi).
    """
    d = 1.0 - eps * eps
    root = np.sqrt(d)
    end = 1.0 + eps * cos_end
    s = root * sin_end / end
    c = (eps + cos_end) / end
    start = 1.0 - eps * cos_end
    s0 = -root * sin_end / start
    c0 = (eps - cos_end) / start
    arc = np.arctan2(s * c0 - c * s0, c * c0 + s * s0)
    if arc < 0.0:
        arc += 2.0 * np.pi
    product = s * c - s0 * c0
    along = 0.5 * (arc + product) - 2.0 * eps * (s - s0) + eps * eps * arc
    mixed = 0.5 * (s * s - s0 * s0) + eps * (c - c0)
    return along / (d * d * root), mixed / (d * d), 0.5 * (arc - product) / (d * root)


@compiled
def land_film(radius, clearance, width, viscosity, ex, ey, vx, vy, mean_speed):
    """Film of a short journal bearing that carries pressure where it closes and is torn elsewhere:
    force on the journal, and 1/sqrt(1 - eps^2).

    p = (6 viscosity/h^3) (width^2/4 - z^2) max(0, -dh/dt) with dh/dt = clearance (turn sin theta -
    squeeze cos theta) seen by an observer who goes with the mean surface, theta from the thinnest
    film; Ocvirk (1952). Half the circle closes: which one, turning and squeezing decide together.
    (ex, ey) is the journal's eccentricity, (vx, vy) its rate, mean_speed half the sum of the
    speeds; the root is the factor of its friction.
    """
    e = np.sqrt(ex * ex + ey * ey)
    ux, uy = (ex / e, ey / e) if e > 1e-15 else (1.0, 0.0)
    eps = min(e / clearance, ECCENTRICITY_LIMIT)
    squeeze = (vx * ux + vy * uy) / clearance
    turn = mean_speed * eps - (vy * ux - vx * uy) / clearance  # (mean speed - whirl) eps
    root = 1.0 / np.sqrt(1.0 - eps * eps)
    closing = np.sqrt(squeeze * squeeze + turn * turn)
    if closing == 0.0:
        return 0.0, 0.0, root
    # the half ends a quarter of the circle after the direction (-squeeze, turn) of fastest closing
    cc, cs, ss = pressure_integrals(eps, -turn / closing, -squeeze / closing)
    scale = viscosity * radius * width**3 / clearance**2
    radial = scale * (-squeeze * cc + turn * cs)
    across = scale * (-squeeze * cs + turn * ss)
    return radial * ux - across * uy, radial * uy + across * ux, root


@compiled
def ball_collisions(p, balls, impact_speeds, y):
    """Each ball and the next one: Hertz contact with Coulomb friction, in the places of the
    pockets, of which there are none.
    """
    c = p.constants
    law = p.normal[POCKET]
    power = p.power
    for j in range(c.balls):
        k = (j + 1) % c.balls
        out = balls[j].pocket_out
        forces = balls[j].forces
        next_forces = balls[k].forces
        position, velocity, turn = ball_motion(y, c.balls, j)
        other, other_velocity, other_turn = ball_motion(y, c.balls, k)
        offset = minus(other, position)
        distance = norm(offset)
        normal = times(1.0 / distance, offset)
        approach = 2.0 * c.ball_radius - distance
        relative = minus(velocity, other_velocity)
        rate = dot(relative, normal)
        push = normal_force(law, approach, rate, impact_speeds[POCKET * c.balls + j])
        out[CONTACT.load] = push
        out[CONTACT.approach] = approach
        out[CONTACT.approach_speed] = rate
        if push <= 0.0:
            continue
        arm = times(c.ball_radius, normal)
        slide = minus(plus(relative, cross(plus(turn, other_turn), arm)), times(rate, normal))
        speed = norm(slide)
        pull = push * ramped(c.ball_friction, speed, c.friction_ramp) / max(speed, 1e-300)
        power[WORK.pocket_damping] += (push - elastic_force(law, approach)) * rate
        power[WORK.pocket_friction] += pull * speed * speed
        grip = times(-pull, slide)
        force = minus(grip, times(push, normal))
        moment = cross(arm, grip)
        accumulate(forces, FORCE, force)
        accumulate(next_forces, FORCE, times(-1.0, force))
        accumulate(forces, MOMENT, moment)
        accumulate(next_forces, MOMENT, moment)


@compiled
def smallest_load(axes):
    """Smallest load of a table."""
    return (-axes[LOAD, FIRST]) ** (1.0 / LOAD_POWER)


@compiled
def weights(position, axis):
    """Index, weights and slopes of a uniform cubic B-spline at a place clamped to its axis."""
    t = min(max(position - axis[FIRST], 0.0) * axis[DENSITY], axis[NODES] - 1.0)
    i = min(max(int(t), 0), int(axis[NODES]) - 2)
    t -= i
    r = 1.0 - t
    second = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0
    third = (4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0
    slopes = (-0.5 * r * r, 1.5 * t * t - 2.0 * t, 2.0 * r - 1.5 * r * r, 0.5 * t * t)
    return i, (r * r * r / 6.0, second, third, t * t * t / 6.0), slopes


@compiled
def film_and_slope(axes, scalars, load, at_speed, fraction):
    """A share of the central film at a load and the weights of a speed, and its slope over the
    load.

    Above the table's largest load the film is that of the largest.
    """
    place = -(load**LOAD_POWER)
    axis = axes[LOAD]
    i, w, d = weights(place, axis)
    j, v, _ = at_speed
    logarithm = 0.0
    steep = 0.0
    for a in range(4):
        c = scalars[i + a, j : j + 4, CENTRAL_FILM]
        mean = v[0] * c[0] + v[1] * c[1] + v[2] * c[2] + v[3] * c[3]
        logarithm += w[a] * mean
        steep += d[a] * mean
    film = fraction * np.exp(logarithm)
    beyond = (place - axis[FIRST]) * axis[DENSITY] >= axis[NODES] - 1.0
    return film, 0.0 if beyond else film * steep * axis[DENSITY] * LOAD_POWER * place / load


@compiled
def elastic_approach(axes, scalars, law, distance, speed):
    """Root w of w = distance + h_c(K w^n, speed): the elastic approach, negative where the film is
    not touched.

    Below the table's smallest load the film goes on linearly in w: nothing jumps, neither load nor
    stiffness. Below its smallest speed the film falls in proportion to the speed. Newton's steps
    start left of the root; w - h_c is concave where the film falls ever less steeply, so they rise
    to it.
    """
    at_speed = weights(np.log(max(speed, 1e-300)), axes[SPEED])
    share = min(1.0, speed / np.exp(axes[SPEED, FIRST]))
    lightest = smallest_load(axes)
    least = (lightest / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    w = distance
    if distance < least:
        film, slope = film_and_slope(axes, scalars, lightest, at_speed, share)
        w = least + (distance - least + film) / (1.0 - slope * law[EXPONENT] * lightest / least)
        if w <= least:
            return w
    for _ in range(NEWTON_STEPS):
        load = law[STIFFNESS] * w ** law[EXPONENT]
        film, slope = film_and_slope(axes, scalars, load, at_speed, share)
        step = (distance + film - w) / (1.0 - slope * law[EXPONENT] * load / w)
        w = max(w + step, least)
        if abs(step) <= STEP_TOLERANCE * w:
            return w
    return np.nan  # no root: the step in time is rejected


@compiled
def friction_law(mirrored, coefficient, table, load, speed, motions, friction):
    """Friction of the law: a row of numbers, as the kernels of `oilfilm.ehl.traction` write them.

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
    """There are no slopes of about this load."""
    base = linear[LINEAR.load]
    return not base <= LOAD_CHANGE * load or load > LOAD_CHANGE * base or base <= 0.0


@compiled
def slopes_hold(linear, load, motion):
    """Slopes are there, of about this load, and of rolling the same way round."""
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
def straight_by_slopes(linear, load_ratio, d_x, friction):
    """`friction_by_slopes` where all sliding is along the entrainment: F_x and M_y alone."""
    growth = 1.0 + (load_ratio - 1.0) / 3.0
    last = FORCES - 1
    friction[0] = load_ratio * (linear[LINEAR.friction] + linear[LINEAR.slopes] * d_x)
    moment = linear[LINEAR.friction + last] + linear[LINEAR.slopes + MOTIONS * last] * d_x
    friction[1] = 0.0
    friction[2] = 0.0
    friction[last] = load_ratio * growth * growth * moment
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


@compiled
def groove_contact(body, centre_radius, reach, position):
    """Ball in a groove: normal into the race, approach, cosine of the contact angle, distance from
    the axis, direction of the azimuth; the contact angle itself.

    reach = groove radius less ball radius; the approach is the distance of the ball from the
    circle of the groove's centres, less the reach.
    """
    offset = minus(position, body.centre)
    axial = dot(offset, body.axis)
    outward = minus(offset, times(axial, body.axis))
    rho = norm(outward)
    outward = times(1.0 / rho, outward)
    radial = rho - centre_radius
    distance = max(np.sqrt(axial * axial + radial * radial), 1e-12)
    inverse = 1.0 / distance
    sine, cosine = axial * inverse, radial * inverse
    normal = plus(times(sine, body.axis), times(cosine, outward))
    angle = np.arctan(axial / radial)
    return normal, distance - reach, cosine, rho, cross(body.axis, outward), angle


@compiled
def race_motion(c, body, centre_radius, groove_radius, position, velocity, turn):
    """Motion of a ball on a race.

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
    centre = body.velocity
    along = dot(velocity, around)
    orbit = (along - centre[0] * around[0] - centre[1] * around[1] - centre[2] * around[2]) / rho
    mean = 0.5 * dot(plus(of_ball, of_race), around)
    entrainment = mean - along - orbit * c.ball_radius * cosine
    x_axis = times(1.0 if entrainment >= 0.0 else -1.0, around)
    y_axis = cross(normal, x_axis)
    relative_turn = minus(turn, body.turn)
    return RaceMotion(
        normal=normal,
        x_axis=x_axis,
        y_axis=y_axis,
        point=point,
        slide_x=dot(slide, x_axis),
        slide_y=dot(slide, y_axis),
        spin=dot(relative_turn, normal),
        roll=dot(relative_turn, y_axis),
        entrainment=abs(entrainment),
        approach_speed=dot(slide, normal),
        angle=angle,
        approach=approach,
    )


@compiled
def straight_motion(c, body, centre_radius, groove_radius, position, velocity, turn):
    """`race_motion` where all motion is in the middle plane and all turning about the axis."""
    _, ry, rz = minus(position, body.centre)
    rho = np.sqrt(ry * ry + rz * rz)
    inverse = 1.0 / rho  # one division: they and the root are what this costs
    ny, nz = ry * inverse, rz * inverse
    radial = rho - centre_radius
    side = 1.0 if radial >= 0.0 else -1.0  # of the race: outer, inner
    arm = side * c.ball_radius
    _, vy, vz = velocity
    _, by, bz = body.velocity
    along = vz * ny - vy * nz
    drift = bz * ny - by * nz
    of_ball = along + turn[0] * arm
    of_race = drift + body.turn[0] * (rho + arm)
    entrainment = 0.5 * (of_ball + of_race) - along - (along - drift) * inverse * arm
    sense = 1.0 if entrainment >= 0.0 else -1.0
    _, py, pz = position
    return RaceMotion(
        normal=(0.0, side * ny, side * nz),
        x_axis=(0.0, -sense * nz, sense * ny),
        y_axis=(side * sense, 0.0, 0.0),
        point=(0.0, py + arm * ny, pz + arm * nz),
        slide_x=sense * (of_ball - of_race),
        slide_y=0.0,
        spin=0.0,
        roll=side * sense * (turn[0] - body.turn[0]),
        entrainment=abs(entrainment),
        approach_speed=side * ((vy - by) * ny + (vz - bz) * nz),
        angle=0.0,
        approach=abs(radial) - groove_radius + c.ball_radius,
    )


@compiled
def motion_on_race(c, body, centre_radius, groove_radius, y, ball):
    """`race_motion` of a ball of the state, or `straight_motion` where the middle plane is a
    mirror.
    """
    position, velocity, turn = ball_motion(y, c.balls, ball)
    if c.mirrored:
        return straight_motion(c, body, centre_radius, groove_radius, position, velocity, turn)
    return race_motion(c, body, centre_radius, groove_radius, position, velocity, turn)


@compiled
def on_form(motion, height, rate):
    """Motion of a ball on a race whose form brings them closer by a height, at a rate."""
    return RaceMotion(
        normal=motion.normal,
        x_axis=motion.x_axis,
        y_axis=motion.y_axis,
        point=motion.point,
        slide_x=motion.slide_x,
        slide_y=motion.slide_y,
        spin=motion.spin,
        roll=motion.roll,
        entrainment=motion.entrainment,
        approach_speed=motion.approach_speed + rate,
        angle=motion.angle,
        approach=motion.approach + height,
    )


@compiled
def elastic_and_film(kind, table, law, motion):
    """Approach of the elastic bodies, and the film between them, 0 where the bodies meet dry."""
    approach = motion.approach
    if table is not None and kind == FILM:
        approach = elastic_approach(table.axes, table.scalars, law, approach, motion.entrainment)
    return approach, approach - motion.approach


@compiled
def fade_damping(table, load, friction):
    """Damping of a film, which fades below the table's smallest load as friction does."""
    if table is not None:
        friction[FILM_DAMPING] *= min(1.0, load / smallest_load(table.axes))


@inlined
def race_friction(c, kind, data, load, motion, linear, friction):
    """Friction of a race on a ball under a load, a row of numbers: by its slopes in `linear` where
    they hold, else by the law.
    """
    if load <= 0.0 or kind == FRICTIONLESS:
        friction[:] = 0.0
    else:
        if slopes_hold(linear, load, motion):
            friction_by_slopes(c.mirrored, linear, load, motion, friction)
        else:
            speed = motion.entrainment
            motions = (motion.slide_x, motion.slide_y, motion.spin)
            friction_law(c.mirrored, data.coefficient, data.table, load, speed, motions, friction)
        fade_damping(data.table, load, friction)


@compiled
def record_contact(motion, approach, film, friction, out):
    """State of a contact without its normal force; an open one has no motion and friction."""
    out[:] = 0.0
    out[CONTACT.approach] = approach
    out[CONTACT.approach_speed] = motion.approach_speed
    out[CONTACT.contact_angle] = motion.angle
    out[CONTACT.film] = film
    if approach <= 0.0:
        return
    out[CONTACT.entrainment_speed] = motion.entrainment
    out[CONTACT.slide_x] = motion.slide_x
    out[CONTACT.slide_y] = motion.slide_y
    out[CONTACT.spin] = motion.spin
    out[CONTACT.friction_x] = friction[FORCE_X]
    out[CONTACT.friction_y] = friction[FORCE_Y]


@compiled
def add_friction(c, motion, body, along, roll, forces, load):
    """Add friction to the loads of a ball and of its race: F_x, F_y, M_n in `along`, M_y."""
    f_x, f_y, spin = along
    grip = plus(times(f_x, motion.x_axis), times(f_y, motion.y_axis))
    couple = plus(times(spin, motion.normal), times(roll, motion.y_axis))
    add_load(load, body, motion.point, times(-1.0, grip))
    accumulate(load, MOMENT, times(-1.0, couple))
    accumulate(forces, FORCE, grip)
    about_centre = cross(times(c.ball_radius, motion.normal), grip)
    accumulate(forces, MOMENT, plus(about_centre, couple))


@compiled
def height_at(heights, angle):
    """Height [m] over an angle of a turn and its slope [m/rad], by a cubic through four places
    (Catmull and Rom), smooth where the places join.
    """
    n = heights.size
    turn = angle / TURN
    place = (turn - np.floor(turn)) * n
    k = int(place)
    t = place - k
    a = heights[(k - 1) % n]
    b = heights[k % n]
    c = heights[(k + 1) % n]
    d = heights[(k + 2) % n]
    linear = 0.5 * (c - a)
    square = a - 2.5 * b + 2.0 * c - 0.5 * d
    cube = 0.5 * (d - a) + 1.5 * (b - c)
    height = b + t * (linear + t * (square + t * cube))
    return height, (linear + t * (2.0 * square + 3.0 * t * cube)) * n / TURN


@compiled
def form_share(c, t):
    """Part of the form that has grown."""
    if c.form_gain == 0.0:
        return 1.0
    return min(1.0, max(0.0, c.form_gain * (t - c.settling_start)))


@compiled
def form_at(heights, angles, excess, share):
    """Form of a race and a ball at their contact [m], and its slopes over the ball's place on the
    race and over the angle of rolling [m/rad].

    heights: of race and ball; angles: of the contact on either; share: of the form.
    """
    height = excess
    slope = 0.0
    roll = 0.0
    if heights[0].size > 2:
        own, slope = height_at(heights[0], angles[0])
        height += own
    if heights[1].size > 2:
        own, roll = height_at(heights[1], angles[1])
        height += own
    return share * height, share * slope, share * roll


@compiled
def add_form_forces(c, position, relative_turn, push, slopes, body, forces, load):
    """Add forces along a race and about the axis of a ball that a normal force has by the slopes
    of their forms; body: of the race, whose load it is.
    """
    along, roll = slopes
    _, ey, ez = minus(position, body.centre)
    rho = np.sqrt(ey * ey + ez * ez)
    around = (0.0, -ez / rho, ey / rho)
    pull = -push * along / rho
    force = times(pull, around)
    add_load(load, body, position, times(-1.0, force))
    accumulate(forces, FORCE, force)
    if roll != 0.0:
        # the ball's form gives way by its turning against the direction to the contact
        size = max(norm(relative_turn), 1e-300)
        sense = 1.0 if relative_turn[0] <= 0.0 else -1.0
        couple = -sense * push * roll / size
        accumulate(forces, MOMENT, times(couple, relative_turn))
        accumulate(forces, FORCE, times(-couple * relative_turn[0] / rho, around))


@compiled
def form_of_contact(p, ball, forms, race, body, y, j):
    """Form at the contact of a ball and a race [m], its rate [m/s], and its slopes over the ball's
    place on the race and the angle of rolling [m/rad].

    The ball meets the two races with opposite points of its track.
    """
    c = p.constants
    heights, ball_heights = forms
    if heights.size <= 2 and ball_heights.shape[1] <= 2:
        return p.prescribed[FORM_SHARE] * ball.excess, 0.0, 0.0, 0.0
    position, velocity, turn = ball_motion(y, c.balls, j)
    _, ey, ez = minus(position, body.centre)
    _, vy, vz = minus(velocity, body.velocity)
    orbit = (ey * vz - ez * vy) / (ey * ey + ez * ez)
    at = ring_angle(c.balls) if race == INNER else outer_angle(c.balls)
    own = y[roll_angle(c.balls, j)] + (0.0 if race == INNER else np.pi)
    angles = (np.arctan2(ez, ey) - y[at], own)
    height, slope, roll = form_at(
        (heights, ball_heights[j % ball_heights.shape[0]]),
        angles,
        ball.excess,
        p.prescribed[FORM_SHARE],
    )
    rate = slope * (orbit - body.turn[0]) + roll * roll_speed(p, velocity, turn, position)
    return height, rate, slope, roll


@compiled
def roll_speed(p, velocity, turn, position):
    """Speed at which a ball turns about its own axis against the direction to its contacts,
    positive where it rolls between an inner ring that turns and an outer one at rest.
    """
    if p.constants.guided:
        return p.prescribed[ROLL_SPEED]
    _, x, y = position
    orbit = (x * velocity[2] - y * velocity[1]) / (x * x + y * y)
    relative = minus(turn, (orbit, 0.0, 0.0))
    size = norm(relative)
    return size if relative[0] <= 0.0 else -size


@inlined
def ball_on_race(p, ball, data, forms, impact_speeds, race, body, y, j):
    """Forces of one race on a ball and back; powers; state of the contact.

    forms: heights of the race, shape (n,), and of the balls on it, shape (1 or Z, n) [m].
    """
    c = p.constants
    kind = p.friction_kind
    law = p.normal[race]
    friction = p.friction
    power = p.power
    centre_radius = c.inner_centre if race == INNER else c.outer_centre
    groove_radius = c.inner_groove if race == INNER else c.outer_groove
    # 1. motion, friction, normal force
    motion = motion_on_race(c, body, centre_radius, groove_radius, y, j)
    height, form_rate, slope, roll = form_of_contact(p, ball, forms, race, body, y, j)
    if height != 0.0 or form_rate != 0.0:
        motion = on_form(motion, height, form_rate)
    approach, film = elastic_and_film(kind, data.table, law, motion)
    elastic = elastic_force(law, approach)
    race_friction(c, kind, data, elastic, motion, ball.linear[race], friction)
    if kind == TABLE:
        film = friction[RACE_FILM]
    out = ball.race_out[race]
    record_contact(motion, approach, film, friction, out)
    if approach <= 0.0:
        return
    rate = motion.approach_speed
    onset = impact_speeds[race * c.balls + j]
    if kind == FILM or (kind == TABLE and law[DAMPING] > 0.0 and onset <= c.floor):
        push = max(0.0, elastic + friction[FILM_DAMPING] * rate)
    elif law[FILM_RATE] + law[LOSS] > 0.0 and onset <= c.floor:
        push = lasting(law, elastic, approach, rate)
    else:
        push = damped(law, elastic, rate, onset)
    out[CONTACT.load] = push
    # 2. power lost
    power[WORK.friction_inner + race] -= (
        friction[FORCE_X] * motion.slide_x
        + friction[FORCE_Y] * motion.slide_y
        + friction[SPIN_MOMENT] * motion.spin
        + friction[ROLL_MOMENT] * motion.roll
    )
    power[WORK.race_damping] += (push - elastic) * rate
    # 3. loads on ball and ring
    force = times(-push, motion.normal)
    load = p.loads[race]
    forces = ball.forces
    add_load(load, body, motion.point, times(-1.0, force))
    accumulate(forces, FORCE, force)
    if slope != 0.0 or roll != 0.0:
        if c.guided:
            power[WORK.drive_cage] += push * roll * p.prescribed[ROLL_SPEED]
            roll = 0.0
        position, velocity, turn = ball_motion(y, c.balls, j)
        _, oy, oz = position
        orbit = (oy * velocity[2] - oz * velocity[1]) / (oy * oy + oz * oz)
        relative = minus(turn, (orbit, 0.0, 0.0))
        add_form_forces(c, position, relative, push, (slope, roll), body, forces, load)
    add_friction(c, motion, body, vector(friction, 0), friction[ROLL_MOMENT], forces, load)


@compiled
def race_forces(p, balls, data, forms, impact_speeds, race, body, y):
    """Forces of one race on every ball and back; powers; states of the contacts."""
    for j in range(p.constants.balls):
        ball_on_race(p, balls[j], data, forms, impact_speeds, race, body, y, j)

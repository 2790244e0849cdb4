"""The equations of motion once more, by vector algebra in NumPy: the twin that the compiled
kernels are tested against. Traction tables are looked up within their range.
"""

from math import exp, log
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from oilfilm.bearing.dynamics.arrays import (
    COEFFICIENT,
    DAMPING,
    EXPONENT,
    FILM,
    GUIDED_BY_INNER_RING,
    LAND,
    POCKET,
    STIFFNESS,
    TABLE,
    CoefficientData,
    Constants,
    EquationData,
    Layout,
    TableData,
)
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction._kernels import LOAD_POWER
from oilfilm.ehl.traction_table.splines import spline_weights
from oilfilm.ehl.traction_table.table import TractionTable, load_coordinate

from .ehl.traction import table_forces

X = np.array([1.0, 0.0, 0.0])
LIMIT = 0.95  # of the eccentricity of a land's film [-]
CENTRAL_FILM = 3  # column of a table's scalars: logarithm of the central film
SLOPE_STEP = 1.0e-6  # of the load for the film's slope at the table's end [-]


class Body(NamedTuple):
    """Centre [m], axis [-], velocity [m/s], angular velocity [rad/s]."""

    centre: Array
    axis: Array
    velocity: Array
    turn: Array


class Balls(NamedTuple):
    """Positions [m], velocities [m/s], angular velocities [rad/s], each of shape (Z, 3)."""

    position: Array
    velocity: Array
    turn: Array


class Pair(NamedTuple):
    """Forces on the balls, couples beside them, moments of both about the balls' centres, and
    where the forces act.

    Shapes (Z, 3), [N], [N m], [N m], [m].
    """

    force: Array
    couple: Array
    moment: Array
    point: Array


def normal_force(law: Array, approach: Array, speed: Array, impact_speed: Array) -> Array:
    """K d^n (1 + chi v/v_0), never adhesive; twin of the kernel.

    Parameters
    ----------
    law : ndarray, shape (3,)
        K [N/m^n], n [-], chi [-].
    approach, speed, impact_speed : ndarray
        d [m], v and v_0 [m/s].

    Returns
    -------
    ndarray
        [N].
    """
    elastic = law[STIFFNESS] * np.maximum(approach, 0.0) ** law[EXPONENT]
    return np.maximum(0.0, elastic * (1.0 + law[DAMPING] * speed / impact_speed))


def table_loads(data: TableData) -> tuple[float, float]:
    """Smallest and largest load of a table [N]."""
    first, density, nodes = data.axes[0]
    smallest, largest = ((-place) ** (1.0 / LOAD_POWER) for place in (first, first + (nodes - 1) / density))
    return float(smallest), float(largest)


def table_speeds(data: TableData) -> tuple[float, float]:
    """Smallest and largest entrainment speed of a table [m/s]."""
    first, density, nodes = data.axes[1]
    return exp(first), exp(first + (nodes - 1) / density)


def film(data: TableData, load: float, speed: float) -> float:
    """Central film of a table [m]; beyond its ends that at the end, but in proportion to slower
    speeds.

    `data`: of a race with a table; `load`, `speed`: Q [N] and entrainment speed u [m/s].
    """
    slowest, fastest = table_speeds(data)
    places = (load_coordinate(float(np.clip(load, *table_loads(data)))), log(min(max(speed, slowest), fastest)))
    values: Array = data.scalars[..., CENTRAL_FILM]
    for place, (first, density, nodes) in zip(places, data.axes[:2], strict=True):
        start, weights = spline_weights((place - first) * density, int(nodes))
        values = np.tensordot(weights, values[start : start + 4], axes=1)
    return exp(float(values)) * min(1.0, speed / slowest)


def elastic_approach(data: TableData, law: Array, distance: float, speed: float) -> float:
    """w of w = delta + h_c(K w^n, u) [m], the load being K w^n; twin of the kernel by bracketing.

    Below the smallest load of the table the film goes on linearly in w.

    Parameters
    ----------
    data : TableData
        Of a race with a table.
    law : ndarray, shape (3,)
        K [N/m^n], n [-], chi [-].
    distance, speed : float
        delta, the approach of the bodies as if rigid [m], and u [m/s].

    Returns
    -------
    float
        [m]; negative where the ball does not touch the film.
    """
    least = (table_loads(data)[0] / law[STIFFNESS]) ** (1.0 / law[EXPONENT])

    def film_over(w: float) -> float:
        return film(data, law[STIFFNESS] * w ** law[EXPONENT], speed)

    lowest = film_over(least)
    slope = (film_over(least * (1.0 + SLOPE_STEP)) - lowest) / (SLOPE_STEP * least)
    if distance + lowest <= least:
        return float(least + (distance - least + lowest) / (1.0 - slope))
    highest = distance + 2.0 * lowest
    return float(brentq(lambda w: w - distance - film_over(w), least, highest, xtol=1e-18, rtol=1e-14))


def dots(a: Array, b: Array) -> Array:
    """Scalar products of rows, kept as a column [product of the units]."""
    return np.sum(a * b, axis=-1, keepdims=True)


def bodies(problem: EquationData, y: Array, inner: float, outer: float) -> tuple[Body, Body, Body]:
    """Inner ring, outer ring, cage of a state, the rings at speeds [rad/s]."""
    layout = Layout(problem.constants.balls)
    bodies = []
    seat = y[layout.seat], y[layout.positions :][layout.seat]
    for place, motion, first, spin in (
        (y[layout.ring], y[layout.ring_speed], 3, inner),
        (y[layout.cage], y[layout.cage_speed], 4, y[layout.cage_speed][3]),
    ):
        axis = np.array([1.0, place[first + 1], -place[first]])
        axis /= np.linalg.norm(axis)
        turn = spin * axis + np.array([0.0, motion[first], motion[first + 1]])
        bodies.append(Body(place[:3], axis, motion[:3], turn))
    x = np.array([1.0, 0.0, 0.0])
    return bodies[0], Body(seat[0], x, seat[1], outer * x), bodies[1]


def race_pair(problem: EquationData, race: int, body: Body, balls: Balls, table: TractionTable | None) -> Pair:
    """What a race (0 inner, 1 outer) does to the balls."""
    c = problem.constants
    centre, groove = ((c.inner_centre, c.inner_groove), (c.outer_centre, c.outer_groove))[race]
    s = balls.position - body.centre
    axial = dots(s, body.axis)
    out = s - axial * body.axis
    rho = np.linalg.norm(out, axis=1, keepdims=True)
    radial = rho - centre
    e = out / rho
    distance = np.hypot(axial, radial)
    n = (axial * body.axis + radial * e) / distance
    approach = distance - (groove - c.ball_radius) + problem.excess[:, None]
    arm = c.ball_radius * n
    ball = balls.velocity + np.cross(balls.turn, arm)
    ring = body.velocity + np.cross(body.turn, balls.position + arm - body.centre)
    around = np.cross(body.axis, e)
    orbit = dots(balls.velocity - body.velocity, around) / rho * body.axis
    u = dots(0.5 * (ball + ring) - balls.velocity - np.cross(orbit, arm), around)
    x = np.where(u >= 0.0, 1.0, -1.0) * around
    y = np.cross(n, x)
    slide = ball - ring
    turn = balls.turn - body.turn
    memory = problem.impact_speeds[race * c.balls : (race + 1) * c.balls, None]
    law = problem.normal[race]
    data = problem.friction_inner if race == 0 else problem.friction_outer
    if problem.friction_kind == FILM:
        apart = [elastic_approach(data.table, law, d, s) for d, s in zip(approach[:, 0], abs(u[:, 0]), strict=True)]
        approach = np.array(apart)[:, None]
    push = normal_force(law, approach, dots(slide, n), memory)
    elastic = normal_force(law, approach, 0.0 * approach, memory)
    force, moment = np.zeros_like(n), np.zeros_like(n)
    slides = (dots(slide, x), dots(slide, y))
    if problem.friction_kind == COEFFICIENT:
        parts = friction(data.coefficient, (elastic, abs(u)), slides, dots(turn, n))
        force, moment = parts[0] * x + parts[1] * y, parts[2] * n + parts[3] * y
    elif problem.friction_kind in (TABLE, FILM):
        values = looked_up(table, (elastic, abs(u)), slides, dots(turn, n))
        force = values[:, :1] * x + values[:, 1:2] * y
        moment = values[:, 2:3] * n + values[:, 3:4] * y
        lasts = (problem.friction_kind == FILM) | (memory <= c.floor)
        push = np.where(lasts, np.maximum(0.0, elastic + values[:, 7:] * dots(slide, n)), push)
    return Pair(force - push * n, moment, moment + np.cross(arm, force), balls.position + arm)


def looked_up(
    table: TractionTable | None, load_and_speed: tuple[Array, Array], slides: tuple[Array, Array], spin: Array
) -> Array:
    """`table_forces` of every ball, shape (Z, 8); nothing where there is no load."""
    rows = np.zeros((spin.size, 8))
    for row, values in zip(rows, np.hstack([*load_and_speed, *slides, spin]), strict=True):
        if values[0] > 0.0 and table is not None:
            row[:] = table_forces(table, *(float(value) for value in values))
    return rows


def friction(
    data: CoefficientData, load_and_speed: tuple[Array, Array], slides: tuple[Array, Array], spin: Array
) -> tuple[Array, Array, Array, Array]:
    """F_x, F_y [N], M_n, M_y [N m] on the balls by a coefficient over the ellipse."""
    load, speed = load_and_speed
    third = np.cbrt(load)
    x, y = data.shape[0] * third * data.disc[0], data.shape[1] * third * data.disc[1]
    rolling = speed / data.shape[2] - 0.5 * data.shape[4] * slides[0]
    curvature_height = data.shape[3] * y * y
    s_x = slides[0] - spin * y - rolling * curvature_height
    s_y = slides[1] + spin * x
    s = np.hypot(s_x, s_y)
    pull = load * data.disc[2] * coefficient(data.law, s, speed) / np.where(s > 0.0, s, 1.0)
    parts = (-pull * s_x, -pull * s_y, pull * (y * s_x - x * s_y), pull * curvature_height * s_x)
    f_x, f_y, m_n, m_y = (np.sum(part, axis=1, keepdims=True) for part in parts)
    return f_x, f_y, m_n, m_y


def coefficient(law: Array, slide: Array, speed: Array) -> Array:
    """Coefficient of friction [-] of Coulomb's law with a ramp, or of four constants, at speeds
    [m/s].
    """
    if law[0] == 0.0:
        return law[1] * np.clip((slide - law[2]) / (law[3] - law[2]), 0.0, 1.0)
    s = slide / np.maximum(speed, 1e-300)
    value: Array = np.minimum(s / law[5], 1.0) * ((law[1] + law[2] * s) * np.exp(-law[3] * s) + law[4])
    return value


def pocket_pairs(problem: EquationData, body: Body, rotation: float, balls: Balls) -> list[Pair]:
    """What the pockets of a cage, turned by `rotation` [rad], do to the balls: contact, and film."""
    c = problem.constants
    angle = problem.pocket_angle + rotation
    e = np.stack([0.0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    e = e - dots(e, body.axis) * body.axis
    e = e / np.linalg.norm(e, axis=1, keepdims=True)
    around = np.cross(body.axis, e)
    s = balls.position - body.centre
    across = dots(s, around) * around + dots(s, body.axis) * body.axis
    offset = s - c.pocket_circle * e if c.pocket_circle > 0.0 else across
    size = np.linalg.norm(offset, axis=1, keepdims=True)
    n = offset / size
    arm = c.ball_radius * n
    slide = balls.velocity + np.cross(balls.turn, arm) - body.velocity
    slide = slide - np.cross(body.turn, balls.position + arm - body.centre)
    rate = dots(slide, n)
    approach = size - problem.pocket_play[:, None]
    slide = slide - rate * n
    speed = np.linalg.norm(slide, axis=1, keepdims=True)
    memory = problem.impact_speeds[2 * c.balls : 3 * c.balls, None]
    push = normal_force(problem.normal[POCKET], approach, rate, memory)
    force = -push * c.pocket_friction * np.minimum(speed / c.friction_ramp, 1.0) / speed * slide
    contact = Pair(force - push * n, 0.0 * n, np.cross(arm, force), balls.position + arm)
    relative = balls.velocity - body.velocity - np.cross(body.turn, s)
    film = pocket_film(problem, across, np.cross(e, across), relative, balls.turn - body.turn)
    return [contact, Pair(film[0], film[1], film[1], balls.position)]


def pocket_film(
    problem: EquationData, offset: Array, beside: Array, velocity: Array, turn: Array
) -> tuple[Array, Array]:
    """Force and moment of the film around each ball at eight places, shape (Z, 3) [N], [N m].

    `offset`: of the ball from the pocket's axis, `beside` at a right angle to it [m]; motion
    relative to the pocket [m/s], [rad/s].
    """
    c = problem.constants
    play = problem.pocket_play[:, None]
    size = np.linalg.norm(offset, axis=1, keepdims=True)
    eps = np.minimum(size, play - c.film_least) / play
    end = 0.5 * c.pocket_height
    force = np.zeros_like(offset)
    moment = np.zeros_like(offset)
    for angle in 0.25 * np.pi * (np.arange(8) + 0.5):
        a = eps / (1.0 + np.sqrt(1.0 - eps**2))
        d = 1.0 + a * np.cos(angle)
        cosine, sine = (a + np.cos(angle)) / d, np.sqrt(1.0 - a**2) * np.sin(angle) / d
        n = (cosine * offset + sine * beside) / size
        arc = c.ball_radius * 0.25 * np.pi * np.sqrt(1.0 - a**2) / d
        gap = play * (1.0 - eps * cosine)
        s = np.sqrt(2.0 * c.ball_radius * gap)
        over_h = 4.0 * c.ball_radius / s * np.arctan(end / s)  # integral of 1/h over the wall
        inside = 4.0 * c.ball_radius**2 * (end / (s**2 * (s**2 + end**2)) + np.arctan(end / s) / s**3)
        at_end = 2.0 * end * (2.0 * c.ball_radius / (s**2 + end**2)) ** 2
        rate = dots(velocity, n)
        slide = velocity + c.ball_radius * np.cross(turn, n) - rate * n
        sheared = -c.film_viscosity * over_h * arc * slide
        squeezed = 6.0 * c.film_viscosity * c.ball_radius * (inside - at_end) * np.maximum(rate, 0.0)
        force += sheared - squeezed * arc * n
        moment += np.cross(c.ball_radius * n, sheared)
    return force, moment


def land_loads(problem: EquationData, side: int, ring: Body, cage: Body) -> tuple[Array, Array]:
    """Force on the cage at one land [N], and moments about the axis on cage and ring [N m], shapes
    (3,), (2,).
    """
    c = problem.constants
    offset = (2 * side - 1) * c.land_offset
    arm_c, arm_r = offset * cage.axis, offset * ring.axis
    e = (cage.centre + arm_c - ring.centre - arm_r)[1:]
    v = (cage.velocity + np.cross(cage.turn, arm_c) - ring.velocity - np.cross(ring.turn, arm_r))[1:]
    apart = cage.turn[0] - ring.turn[0]
    force, factor = film_force(c, e, v, 0.5 * (cage.turn[0] + ring.turn[0]))
    shear = -factor * 2.0 * np.pi * c.film_viscosity * c.land_radius**3 * c.land_width / c.land_clearance * apart
    inside = c.guide == GUIDED_BY_INNER_RING
    turning = shear - (e[0] * force[1] - e[1] * force[0] if inside else 0.0)
    size = float(np.hypot(*e))
    u = e / size if size > 0.0 else np.array([1.0, 0.0])
    across = np.array([-u[1], u[0]])
    memory = problem.impact_speeds[3 * c.balls + side]
    push = float(normal_force(problem.normal[LAND], np.array(size - c.land_clearance), np.dot(v, u), memory))
    side_sign = -1.0 if inside else 1.0
    slide = side_sign * c.land_radius * apart + float(np.dot(v, across))
    grip = -push * c.land_friction * min(abs(slide) / c.friction_ramp, 1.0) * np.sign(slide)
    force = force - push * u + grip * across
    turning += side_sign * c.land_radius * grip
    return np.array([0.0, *force]), np.array([turning, -turning - (e[0] * force[1] - e[1] * force[0])])


def film_force(c: Constants, e: Array, v: Array, mean_speed: float) -> tuple[Array, float]:
    """Force of a short film on its journal [N], and 1/sqrt(1 - eps^2) [-]; e [m], v [m/s], mean
    speed [rad/s].
    """
    size = float(np.hypot(*e))
    if size < 1e-15:
        return np.zeros(2), 1.0
    u = e / size
    across = np.array([-u[1], u[0]])
    eps = min(size / c.land_clearance, LIMIT)
    squeeze, whirl = v @ u / c.land_clearance, v @ across / c.land_clearance
    turn = mean_speed * eps - whirl
    d = 1.0 - eps**2
    scale = c.film_viscosity * c.land_radius * c.land_width**3 / c.land_clearance**2
    # closing speed -squeeze cos + turn sin, theta from the widest gap, over the half where it is positive
    nodes, weights = np.polynomial.legendre.leggauss(400)
    theta = np.arctan2(turn, -squeeze) + 0.5 * np.pi * nodes
    pressure = (turn * np.sin(theta) - squeeze * np.cos(theta)) / (1.0 + eps * np.cos(theta)) ** 3
    radial, around = 0.5 * np.pi * ((weights * pressure) @ np.stack([np.cos(theta), np.sin(theta)], axis=1))
    return scale * (radial * u + around * across), d**-0.5


def accelerations(
    problem: EquationData,
    y: Array,
    given: Array,
    tables: tuple[TractionTable | None, TractionTable | None] = (None, None),
) -> Array:
    """Accelerations of ring, cage, outer ring, sensor and balls, shape (15 + 6 Z,) [m/s^2],
    [rad/s^2].

    Parameters
    ----------
    problem : EquationData
    y : ndarray
        State vector.
    given : ndarray, shape (7,)
        Speeds of the rings [rad/s], force [N], moment [N m].
    tables : tuple of TractionTable
        Of the inner and outer race, where they are the friction.

    Returns
    -------
    ndarray
    """
    c = problem.constants
    layout = Layout(problem.constants.balls)
    inner, outer, cage = bodies(problem, y, given[0], given[1])
    shapes = (y[part].reshape(-1, 3) for part in (layout.ball, layout.ball_speed, layout.ball_turn))
    balls = Balls(*shapes)
    pairs = [race_pair(problem, race, (inner, outer)[race], balls, tables[race]) for race in (0, 1)]
    ring_load = _opposite(pairs[0], inner)
    cage_load = np.zeros(6)
    if c.cage_mass > 0.0:
        pairs += pocket_pairs(problem, cage, float(y[layout.cage][3]), balls)
        cage_load = _opposite(pairs[2], cage) + _opposite(pairs[3], cage)
        if c.guide:
            _add_lands(problem, (inner if c.guide == GUIDED_BY_INNER_RING else outer, cage), ring_load, cage_load)
    gravity = np.array(c.gravity)
    speed = np.linalg.norm(balls.velocity, axis=1, keepdims=True)
    force = sum(pair.force for pair in pairs) - c.drag * speed * balls.velocity
    ball = (force / c.ball_mass + gravity, sum(pair.moment for pair in pairs) / c.ball_inertia)
    ring = _rigid((c.ring_mass, c.ring_transverse, c.ring_polar), ring_load, inner, y[layout.ring_speed][3:])
    ring[:3] += (given[2:5] - c.ring_damping * inner.velocity) / c.ring_mass + gravity
    ring[4:] += given[5:7] / c.ring_transverse
    free = problem.free
    parts = [np.concatenate([ring[:3], ring[4:]]) * free[:5], np.zeros(6)]
    if c.cage_mass > 0.0:
        turning = _rigid((c.cage_mass, c.cage_transverse, c.cage_polar), cage_load, cage, y[layout.cage_speed][4:])
        turning[:3] += gravity
        spin, angle = y[layout.cage_speed][3], y[layout.cage][3]
        turning[1:3] += c.cage_unbalance * spin**2 / c.cage_mass * np.array([np.cos(angle), np.sin(angle)])
        turning[3] -= c.cage_drag * abs(spin) * spin / c.cage_polar
        parts[1] = turning * free[5:11]
    parts.append(seat_and_sensor(problem, y, outer, pairs[1]))
    return np.concatenate([*parts, (ball[0] * free[15:18]).ravel(), (ball[1] * free[18:]).ravel()])


def seat_and_sensor(problem: EquationData, y: Array, outer: Body, pair: Pair) -> Array:
    """Accelerations of the outer ring on its seat and of the sensor on it, shape (4,) [m/s^2]."""
    c = problem.constants
    layout = Layout(c.balls)
    axis = c.sensor_axis
    stretch = y[layout.seat.stop] - outer.centre[axis]
    rate = y[layout.positions + layout.seat.stop] - outer.velocity[axis]
    pull = c.sensor_stiffness * stretch + c.sensor_damping * rate
    force = _opposite(pair, outer)[:3] + np.array(c.outer_load)
    force = force - np.array(c.seat_stiffness) * outer.centre - c.seat_damping * outer.velocity
    force[axis] += pull
    sensor = -pull / c.sensor_mass if c.sensor_mass > 0.0 else 0.0
    return np.array([*(force / c.outer_mass), sensor]) * problem.free[11:15]


def _opposite(pair: Pair, body: Body) -> Array:
    """Force and moment about its centre on the body that exerts a pair, shape (6,) [N], [N m]."""
    moment = np.cross(pair.point - body.centre, pair.force) + pair.couple
    return -np.concatenate([pair.force.sum(axis=0), moment.sum(axis=0)])


def _rigid(inertia: tuple[float, float, float], load: Array, body: Body, tilts: Array) -> Array:
    """Accelerations of a spinning body: x, y, z [m/s^2], about its axis, tilt y, tilt z [rad/s^2]."""
    mass, across, polar = inertia
    spin = polar * float((body.turn - np.array([0.0, *tilts])) @ body.axis)
    about = load[3:] @ body.axis / polar
    gyroscopic = np.array([load[4] - spin * tilts[1], load[5] + spin * tilts[0]]) / across
    return np.array([*(load[:3] / mass), about, *gyroscopic])


def _add_lands(problem: EquationData, pair: tuple[Body, Body], ring_load: Array, cage_load: Array) -> None:
    ring, cage = pair
    for side in range(2):
        force, moments = land_loads(problem, side, ring, cage)
        arm = (2 * side - 1) * problem.constants.land_offset
        cage_load += np.concatenate([force, np.cross(arm * cage.axis, force) + moments[0] * X])
        if problem.constants.guide == GUIDED_BY_INNER_RING:
            ring_load -= np.concatenate([force, np.cross(arm * ring.axis, force) - moments[1] * X])

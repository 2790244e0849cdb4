"""Balance of the inner ring on its balls: Newton's method with the condensed tangent.

Tilts are counted as lengths, times the radius R_i of the circle of the inner groove's centres, and
moments as forces, over R_i. A point P = (a, R_i e_r) on the circle of a row at the axial position
a moves under the rotation (0, ty, tz) by R_i (ty sin psi - tz cos psi) along x and by a (tz cos
psi - ty sin psi) along e_r. All rows share the ring.

A row at rest under a thrust alone has a closed form but for one root: balls without body forces
lie on the line between the grooves' centres, L = hypot(x, facing) apart, and both contacts carry
the same load at the same angle (Harris and Kotzalas, Rolling Bearing Analysis, on thrust)::

    F/Z = Q x/L,   Q = [(L - A)/(K_i^(-2/3) + K_o^(-2/3))]^1.5

Elastic rings move on their seats under all balls of an equilibrium.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import asin, atan2, cos, hypot, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solid.bodies.ring import RingField, ring_field

from ..geometry import SINGLE, Bearing, Race, Row, per_ball, row_azimuths, row_directions
from ..operation import Operation
from ..rings.compliance import RingCompliance, response_of, ring_compliance
from ..rings.elastic_ring import ElasticRings
from .balls import (
    BallProblem,
    BallsEquilibrium,
    BetweenRings,
    solve_balls,
    solve_between_elastic_rings,
)
from .kinematics import ROUND_OFF, stiffness_at
from .solution import QuasistaticSolution
from .thrust import thrust_position

# The next constants, and those of `balls`, were measured on 60 random bearings at 0.3
# to 4 GPa: each halved and doubled leaves all of them converged, the loads equal to 8e-12 of the
# largest, and the number of steps, 268, between 264 and 284.
RESIDUAL_TOLERANCE = 1.0e-10  # relative residual of ring and balls in an equilibrium [-]
RESIDUAL_TARGET = 1.0e-12  # relative residual at which iterating stops [-]
# regularisation of the tangent, relative to its largest entry, for a ring without stiffness [-]
REGULARISATION = 1.0e-12
SOFTEST = 1.0e-6  # stiffness of the ring over that of a contact below which it counts as none [-]
# radial over axial load below which the search starts from the thrust alone [-]
MAX_THRUST_LOAD_RATIO = 2.0
MAX_RING_STEPS = 80
MAX_CUTS = 15
SUFFICIENT_DECREASE = 1.0e-4  # Armijo's constant (Nocedal and Wright, 2006, sec. 3.1) [-]
# bounds of a secant cut of the step, and the cut where a ball has no equilibrium; 150 random
# bearings take 680 steps, and 681 with the bounds 0.1 and 0.5 of Dennis and Schnabel (1996)
SECANT_CUTS = (0.1, 0.7)
PLAIN_CUT = 0.4
MAX_STALLED_STEPS = 30  # without a new best residual


class Ring(NamedTuple):
    """Prescribed loads, and the geometry between the ring and its balls; forces and lengths
    only.
    """

    free: NDArray[np.bool_]  # (5,) load prescribed
    load: Array  # (5,) [N]
    prescribed: Array  # (5,) [m]
    scale: Array  # (5,) 1 or R_i: moment = force * scale, tilt = length / scale
    distance: float  # A [m]
    # radial distance of the groove centres with concentric, facing grooves, A - Pd/2 [m]
    facing: float
    free_axial: float  # A sin(free angle) [m]
    offset: Array  # (Z,) axial distance from outer to inner groove centres, ring undisplaced [m]
    movement: Array  # (2, 5, Z) d(V)/dq [-]
    gather: Array  # (5, 3, Z) ring load from (x, r) forces [-] and couple about e_t [1/m]
    drive: Array  # (rows, 5) part of the load by friction of the balls along their orbits [N]
    compliance: RingCompliance | None  # of elastic rings

    def position(self, q: Array) -> Array:
        """Distances (x, r) from outer to inner groove centres at a ring position.

        Parameters
        ----------
        q : Array
            position of the ring, tilts times R_i, shape (5,) [m]

        Returns
        -------
        Array
            distances V, shape (2, Z) [m]
        """
        V: Array = np.einsum("vqz,q->vz", self.movement, q)
        V[0] += self.offset
        V[1] += self.facing
        return V

    def loads(self, equilibrium: BallsEquilibrium, balls: int) -> Array:
        """Load of the balls on the ring by rows, moments over R_i.

        Parameters
        ----------
        equilibrium : BallsEquilibrium
            balls at the ring's position
        balls : int
            number of balls a row [-]

        Returns
        -------
        Array
            loads, shape (rows, 5) [N]
        """
        each = np.einsum("qfz,fz->qz", self.gather, equilibrium.values[2:5])
        return each.reshape(5, -1, balls).sum(axis=2).T


class RingPoint(NamedTuple):
    """A ring position with its balls in equilibrium: q [m], forces of the balls on the ring [N],
    tangent [N/m].
    """

    q: Array
    between: BetweenRings
    force: Array
    stiffness: Array
    residual: float
    noise: float  # residual that round-off leaves [-]

    @property
    def balls(self) -> BallsEquilibrium:
        """Equilibrium of the balls."""
        return self.between.balls


class RingStart(NamedTuple):
    """Initial positions of ring and balls.

    Ring position q (5,), ball positions u (2, Z), None for a guess, and distances of the grooves'
    centres V (2, Z), None for those of rigid rings [m].
    """

    q: Array
    u: Array | None
    V: Array | None = None


def ring_of(
    bearing: Bearing,
    operation: Operation,
    rows: Sequence[Row] = SINGLE,
    rings: ElasticRings | None = None,
) -> Ring:
    """Assemble the numbers that `solve_ring` needs, SI.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    operation : Operation
        loads and displacements of the inner ring
    rows : Sequence[Row], default SINGLE
        rows of balls on the inner ring
    rings : ElasticRings | None, optional
        rings that are elastic bodies

    Returns
    -------
    Ring
        loads, geometry and compliance
    """
    radius = bearing.inner_centre_radius
    scale = np.array([1.0, 1.0, 1.0, radius, radius])
    free = np.array([load is not None for load in operation.loads])
    load = np.array([load or 0.0 for load in operation.loads]) / scale
    prescribed = np.array([value or 0.0 for value in operation.displacements]) * scale
    c, s = row_directions(bearing, rows)
    zero, one = np.zeros_like(c), np.ones_like(c)
    arm = per_ball(bearing, [row.axial_position for row in rows]) / radius
    movement = np.array([[one, zero, zero, s, -c], [zero, c, s, -arm * s, arm * c]])
    couple = np.array([zero, zero, zero, -s / radius, c / radius])
    gather = np.concatenate([movement.transpose(1, 0, 2), couple[:, None, :]], axis=1)
    distance = bearing.curvature_centre_distance
    facing = distance - 0.5 * bearing.diametral_clearance
    offset = per_ball(bearing, [row.offset for row in rows])
    geometry = (distance, facing, bearing.free_axial_position, offset, movement, gather)
    compliance = None
    if rings is not None:
        compliance = ring_compliance(rings, row_azimuths(bearing, rows), bearing.balls)
    return Ring(free, load, prescribed, scale, *geometry, np.zeros((len(rows), 5)), compliance)


def solve_ring(ring: Ring, problem: BallProblem, start: RingStart | None) -> tuple[RingPoint, int]:
    """Newton's method on the free degrees of freedom of the ring.

    Every ball is in equilibrium at every step. A step is accepted when the residual falls, or when
    the unbalanced force still points along it; it is shortened when the force has turned against
    it (the minimum of the energy has been passed).

    Parameters
    ----------
    ring : Ring
        loads and geometry of the ring
    problem : BallProblem
        numbers that all balls have in common
    start : RingStart | None
        position to begin with; None: a guess from the loads

    Returns
    -------
    point
        best point of the iterations
    iterations
        number of steps [-]
    """
    q = _guess(ring, problem) if start is None else start.q
    point = _point(q, start, ring, problem)
    best = point
    improved_at = 0
    for iteration in range(MAX_RING_STEPS):
        # 1. done at the target, or where nothing is free
        if not ring.free.any() or point.residual <= max(RESIDUAL_TARGET, point.noise):
            return point, iteration
        # 2. Newton step, shortened by a line search
        point = _search(point, _step(point, ring, problem), ring, problem)
        # 3. no more progress: round-off, a ball without equilibrium, or too many steps in vain
        unbalanced = bool(point.balls.residual.max() > max(RESIDUAL_TOLERANCE, point.noise))
        stalled = point.residual >= 0.5 * best.residual
        if point.residual < best.residual:
            best = point
            improved_at = iteration
        accurate = stalled and best.residual <= max(RESIDUAL_TOLERANCE, best.noise)
        if accurate or unbalanced or iteration - improved_at >= MAX_STALLED_STEPS:
            break
    return best, iteration + 1


def _point(q: Array, start: RingStart | None, ring: Ring, problem: BallProblem) -> RingPoint:
    between = _between_rings(ring, ring.position(q), start, problem)
    balls = between.balls
    force = np.einsum("qfz,fz->q", ring.gather, balls.values[2:5])
    stiffness = -np.einsum(
        "qfz,fpz->qp", ring.gather, np.einsum("fvz,vpz->fpz", balls.ring_dV[:3], between.movement)
    )
    unbalance = np.abs(force + ring.load)[ring.free]
    largest = max(np.abs(ring.load).max(), np.hypot(balls.values[2], balls.values[3]).max())
    residual = max(float(balls.residual.max()), between.residual)
    noise = max(balls.noise, between.noise)
    if largest > 0.0:
        residual = max(residual, float(unbalance.max(initial=0.0) / largest))
        rounding = ROUND_OFF * ring.distance * float(np.abs(stiffness).max())
        noise = max(noise, rounding / largest)
    return RingPoint(q, between, force, stiffness, residual, noise)


def _between_rings(
    ring: Ring, rigid: Array, start: RingStart | None, problem: BallProblem
) -> BetweenRings:
    """Balls between rings at the distances `rigid` of the grooves' centres, before rings yield."""
    u = None if start is None else start.u
    if ring.compliance is None:
        return BetweenRings(solve_balls(rigid, u, problem), rigid, ring.movement, 0.0, 0.0)
    V = rigid if start is None or start.V is None else start.V
    return solve_between_elastic_rings(rigid, (u, V), ring.movement, problem, ring.compliance)


def _step(point: RingPoint, ring: Ring, problem: BallProblem) -> Array:
    """Newton step of the free degrees of freedom, regularised, at most a quarter of A long [m]."""
    free = np.flatnonzero(ring.free)
    unbalance = (point.force + ring.load)[free]
    tangent = point.stiffness[np.ix_(free, free)]
    contact = float(stiffness_at(problem.inner_series, np.ones(1))[0]) * np.sqrt(ring.distance)
    reference = max(float(np.abs(tangent).max()), SOFTEST * contact)
    step = np.linalg.solve(tangent + REGULARISATION * reference * np.eye(free.size), unbalance)
    if not (step @ unbalance > 0.0):
        step = unbalance / reference
    longest = float(np.abs(step).max())
    result = np.zeros(5)
    result[free] = step * min(1.0, 0.25 * ring.distance / longest) if longest > 0.0 else step
    return result


def _search(point: RingPoint, step: Array, ring: Ring, problem: BallProblem) -> RingPoint:
    """Shorten the step until the residual falls or the unbalanced force no longer opposes it."""

    def along(candidate: RingPoint) -> float:
        return float(((candidate.force + ring.load) * ring.free) @ step)

    def norm(candidate: RingPoint) -> float:
        return float(np.linalg.norm((candidate.force + ring.load)[ring.free]))

    slope = along(point)
    size = norm(point)
    factor = 1.0
    for _ in range(MAX_CUTS):
        shift = np.einsum("vqz,q->vz", point.between.movement, factor * step)
        q = point.q + factor * step
        predicted = point.balls.u + np.einsum("uvz,vz->uz", point.balls.du_dV, shift)
        trial = _point(q, RingStart(q, predicted, point.between.V + shift), ring, problem)
        if trial.balls.residual.max() <= max(RESIDUAL_TOLERANCE, trial.noise):
            if norm(trial) < (1.0 - SUFFICIENT_DECREASE * factor) * size or along(trial) > 0.0:
                return trial
            # zero of the force along the step, by a secant
            low, high = SECANT_CUTS
            factor *= min(max(slope / (slope - along(trial)), low), high)
        else:
            factor *= PLAIN_CUT
    return trial


def _guess(ring: Ring, problem: BallProblem) -> Array:
    """Ring position from the loads: all balls alike under a thrust, else Stribeck's 5 F/Z on the
    load line [m].

    Rows set against each other hold the ring in its place: no displacement.
    """
    if np.ptp(ring.offset) > 0.0:
        return np.where(ring.free, 0.0, ring.prescribed)
    balls = ring.movement.shape[2]
    offset = float(ring.offset[0])
    compliance = sum(
        float(stiffness_at(s, np.ones(1))[0]) ** (-2.0 / 3.0)
        for s in (problem.inner_series, problem.outer_series)
    )
    q = np.where(ring.free, 0.0, ring.prescribed)
    axial = ring.load[0]
    radial = hypot(ring.load[1], ring.load[2])
    if axial != 0.0 and radial < MAX_THRUST_LOAD_RATIO * abs(axial) and ring.free[0]:
        beyond = ring.free_axial + ring.distance
        each = abs(axial) / balls
        position = (
            thrust_position(each, ring.distance, ring.facing, lambda _: compliance) or beyond
        )
        q[0] = np.sign(axial) * min(position, beyond) - offset
    elif radial > 0.0 and (ring.free[1] or ring.free[2]):
        length = ring.distance + compliance * (5.0 * hypot(axial, radial) / balls) ** (2.0 / 3.0)
        angle = min(atan2(abs(axial), radial), asin(min(1.0, ring.free_axial / ring.distance)))
        thrust = np.sign(axial) * sin(angle) * length - offset
        towards = np.array([thrust, *(ring.load[1:3] / radial)])
        towards[1:] *= cos(angle) * length - ring.facing
        q[:3] = np.where(ring.free[:3], towards, q[:3])
    return q


def ring_displacements(state: QuasistaticSolution, race: Race) -> tuple[RingField, ...]:
    """Displacement of the ring of each row, the middle of its groove at x = 0.

    Without the movement of the ring as a whole.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    tuple[RingField, ...]
        field of each row [m]; empty if the ring is no elastic body
    """
    rings = state.model.rings
    ring = None if rings is None else getattr(rings, race.value)
    if ring is None:
        return ()
    response = response_of(ring)
    loads = _loads(ball_forces(state, race), race, ring.contact_angle)
    balls = state.bearing.balls
    rows = [slice(first, first + balls) for first in range(0, state.azimuth.size, balls)]
    if not ring.supports:
        return tuple(ring_field(response, state.azimuth[row], loads[:, row]) for row in rows)
    pressed, movements = seat_reactions(state, race)
    outward = pressed if race is Race.INNER else -pressed
    fields = []
    for row, force, move in zip(rows, outward, movements, strict=True):
        turns = np.concatenate([state.azimuth[row], ring.supports])
        both = np.zeros((4, turns.size))
        both[:3, :balls] = loads[:, row]
        both[3, balls:] = force
        field = ring_field(response, turns, both)
        fields.append(replace(field, displacement=field.displacement + np.array([0.0, *move])))
    return tuple(fields)


def seat_reactions(state: QuasistaticSolution, race: Race) -> tuple[Array, Array]:
    """Forces of the supports of a split seat on the ring of each row, and its movement as a whole.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    pressed
        forces, shape (rows, supports); no rows for other seats [N]
    moved
        movement (y, z), shape (rows, 2) [m]
    """
    rings = state.model.rings
    ring = None if rings is None else getattr(rings, race.value)
    if rings is None or ring is None or not ring.supports:
        return np.zeros((0, 0)), np.zeros((0, 2))
    angle = state.inner_contact_angle if race is Race.INNER else state.outer_contact_angle
    directions = np.stack([np.sin(angle), np.cos(angle)])
    groove = getattr(ring_compliance(rings, state.azimuth, state.bearing.balls), race.value)
    pressed, movements = groove.reactions(ball_forces(state, race), directions)
    return pressed.reshape(-1, len(ring.supports)), movements


def ball_forces(state: QuasistaticSolution, race: Race) -> Array:
    """Forces of the balls on a ring.

    Parameters
    ----------
    state : QuasistaticSolution
        equilibrium of the bearing
    race : Race
        raceway of the ring

    Returns
    -------
    Array
        forces (x, r), shape (2, N) [N]
    """
    s, c = np.sin(state.inner_contact_angle), np.cos(state.inner_contact_angle)
    axial = state.inner_load * s + state.inner_friction * c
    radial = state.inner_load * c - state.inner_friction * s
    if race is Race.INNER:
        return -np.stack([axial, radial])
    return np.stack([axial, radial + state.centrifugal_force])


def _loads(force: Array, race: Race, angle: float) -> Array:
    """Loads at the bottom of the groove, at a contact angle and its mirror image that move and
    open the groove as forces do, shape (3, N) [N].
    """
    size = np.hypot(*force)
    axial = force[0] / sin(angle)
    opening = axial**2 / np.where(size > 0.0, size, 1.0)
    inward = -force[1] if race is Race.INNER else force[1]
    bottom = inward - opening * cos(angle)
    return np.stack([bottom, 0.5 * (opening + axial), 0.5 * (opening - axial)])

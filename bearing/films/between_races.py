r"""Balls that the elastic contacts leave free, between two films.

A ball off the inner race, or with next to no load there, fills its gap with oil: two film springs
in series. With the local law h = c Q^-m of each film and Hertz' approach d(Q), a race whose
groove's centre lies x beyond the ball's surface pushes with Q,

.. math:: d(Q) - h(Q) = x

and the ball is in balance in the axial plane, u and w to the grooves' centres, u + w = V, with
the friction T of the gyroscopic couple across the rolling direction, t:

.. math:: Q_i w/|w| + T_i t_i - Q_o u/|u| - T_o t_o + F_c e_r = 0

In a radial bearing this is h_i - d_i + h_o - d_o = P_d/2 - delta cos psi at Q_o = Q_i + F_c. The
films are the operating ones, which supply and heat limit: where the layers do not fill the gap,
Q_i = 0 and the outer film carries F_c. The heavier balls have the same law, and the ring is in
balance with all of them,

.. math:: F - \sum_j (dV/dq)^T (Q_i w/|w| + T_i t_i)_j = 0

The heavier balls yield to their films also where no gap is filled, so that loads do not jump as
the last light ball leaves its inner film. Where no ball is light, nothing changes. Position and
stiffness of the ring, life and strength are of this balance; friction, motion and the shape of
elastic rings are those of the dry equilibrium. The weight of a ball, 2 % of F_c in a 6205 at 3800
r/min and as much as it at 530, is left out, and so is squeeze as it goes round.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log
from typing import Any

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant

from ..contacts.contact import BearingContact
from ..contacts.contacts import NEGLIGIBLE_LOAD, contact_conditions
from ..contacts.motion import BearingContacts
from ..operation import BallKinematics
from ..quasistatic.ring import Ring, ring_of
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import OilAtInlets
from .operating_film import on_tracks, operating_films, with_formulas

# load of the inner race over the centrifugal force under which it counts as none [-]
LEAST_LOAD = 1.0e-3
SMALLEST = 1.0e-9  # load that is told from none [N]
LARGEST = 1.0e6  # [N]
STEEPEST = 3.0  # slope of a film over its load, logarithms [-]
STEP = 1.01  # factor of the loads over which the slope of a film is taken [-]
SLOPED = 0.1  # change of the logarithms of loads below which the slopes of films stay
ROUNDS = 40
SETS = 20  # sets of light balls that are tried
BISECTIONS = 60
TOLERANCE = 1.0e-4  # change of the logarithms of loads, of which films miss its square [-]
SINGULAR = 1.0e-9  # stiffness over the largest below which a direction has none [-]
NEWTON_STEPS = 40
HALVINGS = 12
BALANCED = 1.0e-10  # force left on the ring over the largest load [-]
UNBALANCED = 1.0e-6  # force left on a ball over its load, from which it is in no balance [-]
LONGEST = 2.0  # step of the logarithm of a load
LONGER = 1.5  # factor of a step that does not turn [-]
UNFILLED = "the oil does not fill the gap between ball and race"


@dataclass(frozen=True, slots=True, kw_only=True)
class _Springs:
    """Laws of the films of light balls, shape (2, n), inner and outer race."""

    stiffness: Array  # K of Hertz' law Q = K d^1.5 [N/m^1.5]
    film: Array  # h at `load` [m]
    slope: Array  # m [-]
    load: Array  # [N]
    length: Array  # of the arms from the grooves' centres to the ball's centre, (2,) [m]

    def room(self, load: Array) -> Array:
        """Approach less film [m] at loads [N]."""
        return self._elastic(load) - self._film(load)

    def loads(self, room: Array) -> Array:
        """Inverse of `room` [N], by Newton's method in ln Q from the loads of the laws."""
        y = np.log(self.load)
        for _ in range(NEWTON_STEPS):
            load = np.exp(y)
            miss = room - self.room(load)
            slope = 2.0 / 3.0 * self._elastic(load) + self.slope * self._film(load)
            step = np.clip(miss / slope, -LONGEST, LONGEST)
            y = np.clip(y + step, log(SMALLEST), log(LARGEST))
            if np.abs(step).max(initial=0.0) < 1.0e-14:
                break
        return np.exp(y)

    def softness(self, load: Array) -> Array:
        """dx/dQ [m/N]."""
        both = 2.0 / 3.0 * self._elastic(load) + self.slope * self._film(load)
        return both / load

    def _elastic(self, load: Array) -> Array:
        return (load / self.stiffness) ** (2.0 / 3.0)

    def _film(self, load: Array) -> Array:
        return self.film * (self.load / load) ** self.slope


@dataclass(frozen=True, slots=True, kw_only=True)
class _Balls:
    """Balls between two films, light ones and the heavier, and the ring that they hold."""

    solution: QuasistaticSolution
    oil: Lubricant
    supply: OilAtInlets | None
    ring: Ring
    numbers: NDArray[np.int64]  # of the balls, from 0

    @property
    def lengths(self) -> Array:
        """Arms from the grooves' centres to the centre of a ball that touches, (2,) [m]."""
        b = self.solution.bearing
        grooves = np.array([b.inner_groove_radius, b.outer_groove_radius])
        return grooves - 0.5 * b.ball_diameter

    @property
    def force(self) -> Array:
        """Centrifugal force [N]."""
        return self.solution.centrifugal_force[self.numbers]

    @property
    def friction(self) -> Array:
        """Friction across the rolling direction, (2, n) [N]."""
        s = self.solution
        return np.stack([s.inner_friction, s.outer_friction])[:, self.numbers]

    def position(self, s: QuasistaticSolution) -> Array:
        """Position of the ring in an equilibrium, (5,) [m]."""
        return np.concatenate([s.displacement, s.tilt]) * self.ring.scale

    def between(self, q: Array) -> Array:
        """V of the balls with the ring at q (5,), (2, n) [m]."""
        s = self.solution
        V = self.ring.position(q)
        V[0] += s.inner_ring_axial - s.outer_ring_axial
        V[1] += s.inner_ring_radial - s.outer_ring_radial
        return V[:, self.numbers]

    def contacts_at(self, load: Array, u: Array, V: Array) -> list[BearingContact]:
        """Contacts of the balls, inner and outer in turn, at loads (2, n) [N], with the balls at u
        and the grooves' centres V apart, (2, n) [m].
        """
        moved = replace(self.solution, **self.arrays(load, u, V))
        at = contact_conditions(moved, self.oil, thick=True)
        return [at[n] for n in _numbers(self.numbers)]

    def arrays(self, load: Array, u: Array, V: Array) -> dict[str, Any]:
        """Loads and contact angles of all balls with these at u, as `contacts_at`."""
        w = V - u
        changes = {
            "inner_load": load[0],
            "outer_load": load[1],
            "inner_contact_angle": np.arctan2(w[0], w[1]),
            "outer_contact_angle": np.arctan2(u[0], u[1]),
        }
        arrays = {}
        for name, values in changes.items():
            arrays[name] = getattr(self.solution, name).copy()
            arrays[name][self.numbers] = values
        return arrays

    def filled(self, contacts: Sequence[BearingContact]) -> NDArray[np.bool_]:
        """Balls whose gap the films fill under next to no load at the inner race, behind the
        layers of contacts, with the ring of the dry equilibrium; none with a gap as wide as an
        arm, in which a ball's centre could pass that of a groove.
        """
        V = self.between(self.position(self.solution))
        gap = self.lengths.sum() - np.hypot(*V)
        u = V * (self.lengths[1] / np.hypot(*V))
        least = np.stack([LEAST_LOAD * self.force, (1.0 + LEAST_LOAD) * self.force])
        supply = self.supply and on_tracks(self.supply, contacts)
        thickest = _films(self.contacts_at(least, u, V), supply).reshape(-1, 2)
        return np.asarray((thickest.sum(axis=1) > gap) & (gap < self.lengths.min()))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Balance:
    """Balls and ring in balance."""

    q: Array  # of the ring, (5,) [m]
    V: Array  # (2, n) [m]
    u: Array  # (2, n) [m]
    load: Array  # (2, n) [N]
    force: Array  # (x, r) and couple over R_i of the balls on the ring, (3, n) [N]
    tangent: Array  # (5, 5) change of the load that holds the ring by q [N/m]


def equilibrium_with_films(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    oil: Lubricant,
    supply: OilAtInlets | None = None,
    near: QuasistaticSolution | None = None,
) -> tuple[QuasistaticSolution, tuple[BearingContact, ...]]:
    """Balance of ring and balls with the films of all balls where some are without elastic load.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    oil : Lubricant
        The oil.
    supply : OilAtInlets, optional
        Oil that the contacts get; None: flooded.
    near : QuasistaticSolution, optional
        Such a balance at nearly the same temperature, from which this one is begun.

    Returns
    -------
    solution
        Position of ring and balls, loads and stiffness with films; the same object where no ball
        is light.
    contacts
        Those of light balls with the loads of their films and their `gap`; likewise.
    """
    light = _light(solution, contacts)
    if not light.any():
        return solution, contacts if isinstance(contacts, tuple) else tuple(contacts)
    ring = ring_of(solution.bearing, solution.operation, solution.rows, solution.model.rings)
    every = _Balls(
        solution=solution, oil=oil, supply=supply, ring=ring, numbers=np.arange(light.size)
    )
    if near is not None and near.inner_load.size != light.size:
        near = None
    held, found = _with_films(every, light, contacts, near)
    changed = (found.get(n, contact) for n, contact in enumerate(contacts))
    return held, BearingContacts.of(solution, changed)


def _numbers(balls: NDArray[np.int64]) -> list[int]:
    """Numbers of the contacts of balls, inner then outer."""
    return [int(2 * ball + race) for ball in balls for race in range(2)]


def _light(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> NDArray[np.bool_]:
    """Light balls; none where nothing turns, or they are balanced already."""
    s = solution
    light = s.inner_load < NEGLIGIBLE_LOAD * s.inner_load.max(initial=0.0)
    by_traction = s.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
    turning = s.operation.shaft_speed > 0.0 and bool((s.centrifugal_force > 0.0).all())
    known = any(contact.gap is not None for contact in contacts)
    return np.asarray(light & (s.converged and turning and not by_traction and not known))


def _films(contacts: Sequence[BearingContact], supply: OilAtInlets | None) -> Array:
    """Operating central films [m]; zero where there is none."""
    films = operating_films(
        contacts, with_formulas(contacts, [None] * len(contacts)), supply=supply
    )
    return np.array([0.0 if film is None else film.central.value for film in films])


def _with_films(
    every: _Balls,
    light: NDArray[np.bool_],
    contacts: Sequence[BearingContact],
    near: QuasistaticSolution | None,
) -> tuple[QuasistaticSolution, dict[int, BearingContact]]:
    """The balance with films, and contacts that they change, by their numbers."""
    held = every.solution
    free = light & (every.solution.inner_load == 0.0)
    filled = np.zeros_like(free)
    if free.any():
        filled[free] = replace(every, numbers=np.flatnonzero(free)).filled(contacts)
    changed: dict[int, BearingContact] = {}
    for _ in range(SETS):
        # 1. balls and ring in balance
        balls = replace(every, numbers=np.flatnonzero(~free | filled))
        balance = _rounds(balls, near)
        if balance is None:
            break
        # 2. balls that the ring has left are as those with too little oil
        left = np.zeros_like(light)
        left[balls.numbers] = balance.load[0] < LEAST_LOAD * balls.force
        if not (left & filled).any():
            changed = _changed(balls, balance, light)
            held = _held(balls, balance, contacts)
            break
        filled &= ~left
    for n in _numbers(np.flatnonzero(free & ~filled)):
        note = UNFILLED if n % 2 == 0 else contacts[n].note
        changed[n] = replace(contacts[n], note=note)
    return held, changed


def _held(
    balls: _Balls, balance: _Balance, contacts: Sequence[BearingContact]
) -> QuasistaticSolution:
    """The equilibrium with ring and balls where their films hold them; of elastic rings the dry
    stiffness stays.
    """
    s = balls.solution
    numbers = balls.numbers
    scale = balls.ring.scale
    arrays = balls.arrays(balance.load, balance.u, balance.V)
    hertz = [contacts[2 * n + 1].hertz for n in numbers]
    approach = np.array([0.0 if one is None else one.approach for one in hertz])
    angle = s.outer_contact_angle[numbers]
    dry = (balls.lengths[1] + approach) * np.stack([np.sin(angle), np.cos(angle)])
    for name, way in zip(("ball_axial", "ball_radial"), balance.u - dry, strict=True):
        arrays[name] = getattr(s, name).copy()
        arrays[name][numbers] += way
    force = np.zeros((3, s.azimuth.size))
    force[:, numbers] = balance.force
    each = np.einsum("qfz,fz->qz", balls.ring.gather, force).reshape(5, len(s.rows), -1)
    of_rows = -each.sum(axis=2).T * scale
    given = np.concatenate([s.ring_force, s.ring_moment])
    load = np.where(balls.ring.free, given, of_rows.sum(axis=0))
    q = balance.q / scale
    stiffness = balance.tangent * np.outer(scale, scale)
    return replace(
        s,
        **arrays,
        displacement=q[:3],
        tilt=q[3:],
        ring_force=load[:3],
        ring_moment=load[3:],
        stiffness=stiffness if balls.ring.compliance is None else s.stiffness,
        row_load=of_rows,
    )


def _changed(
    balls: _Balls, balance: _Balance, light: NDArray[np.bool_]
) -> dict[int, BearingContact]:
    """Contacts in balance by their numbers, those of light balls with their gaps."""
    u, V = balance.u, balance.V
    gap = balls.lengths[:, None] - np.stack([np.hypot(*(V - u)), np.hypot(*u)])
    at = balls.contacts_at(balance.load, u, V)
    places = zip(_numbers(balls.numbers), at, gap.T.ravel().tolist(), strict=True)
    return {
        n: replace(contact, gap=room if light[n // 2] else None) for n, contact, room in places
    }


def _rounds(balls: _Balls, near: QuasistaticSolution | None) -> _Balance | None:
    """Films and the balance of balls and ring in turn, begun near another one; None where they do
    not settle.

    The way of a load at which a film is taken is halved where it turns.
    """
    s = balls.solution if near is None else near
    q = balls.position(s)
    V = balls.between(q)
    load = np.stack([s.inner_load, s.outer_load])[:, balls.numbers]
    # from above, where films are as thin as of heavy balls
    start = np.maximum(balls.force, NEGLIGIBLE_LOAD * s.inner_load.max())
    least = np.stack([start, start + balls.force])
    load = np.maximum(load, least) if near is None else np.where(load > 0.0, load, least)
    u = V * (balls.lengths[1] / np.hypot(*V))
    way = np.zeros_like(load)
    longest = np.full_like(load, LONGEST)
    slope = None
    last = np.inf
    known = None  # the balls' places, where they are
    for _ in range(ROUNDS):
        springs = _springs(balls, load, u, V, slope)
        at = u
        found = _in_balance(balls, springs, q, known)
        if found is None:
            return None
        q, V = found.q, found.V
        u = known = found.u
        turn = float((np.hypot(*(u - at)) / np.hypot(*u)).max())
        ahead = np.log(found.load / load)
        change = float(np.abs(ahead).max())
        if max(change, turn) < TOLERANCE:
            return found
        turned = (way * ahead < 0.0) & (np.abs(ahead) > SLOPED)
        longest = np.where(turned, 0.5 * np.abs(way), np.minimum(LONGER * longest, LONGEST))
        way = np.clip(ahead, -longest, longest)
        load = load * np.exp(way)
        slope = springs.slope if max(change, turn) < min(SLOPED, 0.5 * last) else None
        last = change
    return None


def _springs(balls: _Balls, load: Array, u: Array, V: Array, slope: Array | None) -> _Springs:
    """Laws of the films at loads (2, n) [N]; slopes are taken anew where there are none."""
    contacts = balls.contacts_at(load, u, V)
    hertz = [contact.hertz for contact in contacts]
    approach = np.array([0.0 if one is None else one.approach for one in hertz])
    supply = balls.supply and on_tracks(balls.supply, contacts)
    more = balls.contacts_at(STEP * load, u, V) if slope is None else []
    film, *others = _films([*contacts, *more], supply).reshape(-1, load.shape[1], 2).swapaxes(1, 2)
    if slope is None:
        (other,) = others
        thin = film <= 0.0  # without a film
        ratio = np.where(thin, 1.0, film) / np.where(thin, 1.0, other)
        slope = np.clip(np.log(ratio) / log(STEP), 0.0, STEEPEST)
    return _Springs(
        stiffness=load / approach.reshape(-1, 2).T ** 1.5,
        film=film,
        slope=slope,
        load=load,
        length=balls.lengths,
    )


def _in_balance(balls: _Balls, springs: _Springs, q: Array, u: Array | None) -> _Balance | None:
    """Ring and balls in balance, begun with the ring at q (5,) and the balls at u, where that is
    known [m]; None where it is not found.

    Newton's method with the stiffness of balls in balance.
    """
    free = np.flatnonzero(balls.ring.free)
    movement = balls.ring.movement[:, :, balls.numbers]
    gather = balls.ring.gather[:, :, balls.numbers]
    radius = balls.solution.bearing.inner_groove_radius
    couple = -radius * balls.friction[0]

    def at(q: Array, u: Array | None) -> tuple[_Balance, Array, Array] | None:
        V = balls.between(q)
        balanced = _balls_in_balance(balls, springs, V, u)
        if balanced is None:
            return None
        u, load, push, stiffness = balanced
        force = np.concatenate([-push, couple[None]])
        left = np.einsum("qfz,fz->q", gather, force) + balls.ring.load
        tangent = np.einsum("iqz,ijz,jpz->qp", movement, stiffness, movement)
        found = _Balance(q=q, V=V, u=u, load=load, force=force, tangent=tangent)
        return found, left[free], tangent[np.ix_(free, free)]

    state = at(q, u)
    for _ in range(NEWTON_STEPS):
        if state is None:
            return None
        found, left, tangent = state
        if np.abs(left).max(initial=0.0) < BALANCED * found.load.max():
            return found
        step = np.zeros(5)
        step[free] = np.linalg.pinv(tangent, SINGULAR, hermitian=True) @ left
        for _ in range(HALVINGS):
            state = at(found.q + step, found.u)
            ahead = None if state is None else state[1]
            if ahead is not None and (
                np.linalg.norm(ahead) < np.linalg.norm(left) or ahead @ step[free] > 0.0
            ):
                break
            step *= 0.5
    return None


def _balls_in_balance(
    balls: _Balls, springs: _Springs, V: Array, u: Array | None
) -> tuple[Array, Array, Array, Array] | None:
    """Balls in balance at V: u (2, n) [m], loads and force on the inner ring (2, n) [N], and its
    stiffness by V (2, 2, n) [N/m]; None where a ball finds none.

    Newton's method with the exact stiffness of the springs, whose energy is convex, begun at u or
    on the line between the grooves' centres.
    """
    if u is None:
        u = V * ((springs.length[1] + _split(springs, V, balls.force)) / np.hypot(*V))
    load, left, push, stiffness = _forces(balls, springs, u, V)
    both = stiffness.sum(axis=0)
    for _ in range(NEWTON_STEPS):
        moving = np.hypot(*left) > 0.1 * BALANCED * load.max(axis=0)
        if not moving.any():
            break
        step = np.linalg.solve(both.T, left.T[..., None])[..., 0].T * moving
        factor = np.ones(balls.numbers.size)
        for _ in range(HALVINGS):
            at = u + factor * step
            load, ahead, push, stiffness = _forces(balls, springs, at, V)
            shorter = np.hypot(*ahead) < np.hypot(*left)
            good = shorter | ((ahead * step).sum(axis=0) > 0.0) | ~moving
            if good.all():
                break
            factor = np.where(good, factor, 0.5 * factor)
        if (~good & (np.hypot(*ahead) > UNBALANCED * load.max(axis=0))).any():
            return None
        u = at
        left = ahead
        both = stiffness.sum(axis=0)
    # K_i (K_i + K_o)^-1 K_o: the ball follows
    inner, outer = stiffness.transpose(0, 3, 1, 2)
    follows = inner @ np.linalg.solve(inner + outer, outer)
    return u, load, push, follows.transpose(1, 2, 0)


def _split(springs: _Springs, V: Array, force: Array) -> Array:
    """x of the outer race [m] with the ball on the line between the grooves' centres."""
    total = np.hypot(*V) - springs.length.sum()
    low = np.full(force.size, log(SMALLEST))
    high = np.full(force.size, log(LARGEST))
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        inner = np.exp(middle)
        room = springs.room(np.stack([inner, inner + force])).sum(axis=0)
        low, high = np.where(room < total, middle, low), np.where(room < total, high, middle)
    inner = np.exp(0.5 * (low + high))
    return springs.room(np.stack([inner, inner + force]))[1]


def _forces(
    balls: _Balls, springs: _Springs, u: Array, V: Array
) -> tuple[Array, Array, Array, Array]:
    """Loads (2, n), force left on the balls and that of the inner race (2, n) [N], stiffness of
    both races (2, 2, 2, n) [N/m].
    """
    arms = np.stack([V - u, u])
    distance = np.hypot(arms[:, 0], arms[:, 1])
    normal = arms / distance[:, None]
    load = springs.loads(distance - springs.length[:, None])
    across = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
    pull = load[:, None] * normal + balls.friction[:, None] * across
    left = pull[0] - pull[1]
    left[1] += balls.force
    along = np.einsum("cin,cjn->cijn", normal, normal)
    crosswise = np.eye(2)[None, :, :, None] - along
    stiff = (1.0 / springs.softness(load))[:, None, None] * along
    stiff += (load / distance)[:, None, None] * crosswise
    return load, left, pull[0], stiff

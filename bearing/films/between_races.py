r"""Balls that the elastic contacts leave free, between two films.

A ball off the inner race, or with next to no load there, fills its gap with oil: two film springs
in series. With the local law h = c Q^-m of each film and Hertz' approach d(Q), a race whose
groove's centre lies x beyond the ball's surface pushes with Q,

.. math:: d(Q) - h(Q) = x

and the ball is in balance in the axial plane, u and w to the grooves' centres, u + w = V:

.. math:: Q_i w/|w| - Q_o u/|u| + F_c e_r = 0

In a radial bearing this is h_i - d_i + h_o - d_o = P_d/2 - delta cos psi at Q_o = Q_i + F_c. The
films are the operating ones, which supply and heat limit: where the layers do not fill the gap,
Q_i = 0 and the outer film carries F_c. The ring moves by what the films of the heavier balls take
of the clearance, and by the push of the light ones,

.. math:: K dq = -\sum_j (dV/dq)^T \Delta Q_j w_j/|w_j|

with the stiffness K of the dry equilibrium; loads of the heavier balls stay those of that, which
they exceed by up to 5 %. The weight of a ball, 2 % of F_c in a 6205 at 3800 r/min and as much as
it at 530, is left out, and so are the couple of the ball and squeeze as it goes round.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

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
from ..supply.supply import OilAtInlets
from .operating_film import operating_films, with_formulas

# load of the inner race over the centrifugal force under which it counts as none [-]
LEAST_LOAD = 1.0e-3
SMALLEST = 1.0e-9  # load that is told from none [N]
LARGEST = 1.0e6  # [N]
STEEPEST = 3.0  # slope of a film over its load, logarithms [-]
STEP = 1.1  # factor of the loads over which the slope of a film is taken [-]
SLOPED = 0.1  # change of the logarithms of loads below which the slopes of films stay
ROUNDS = 40
LEAST_PART = 0.1  # of a step of the ring [-]
BISECTIONS = 60
TOLERANCE = 1.0e-4  # change of the logarithms of loads, of which films miss its square [-]
SINGULAR = 1.0e-9  # stiffness over the largest below which a direction has none [-]
NEWTON_STEPS = 40
HALVINGS = 12
BALANCED = 1.0e-10  # force left on a ball over the larger of its loads [-]
LONGEST = 2.0  # step of the logarithm of a load
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
class _LightBalls:
    """Light balls of a bearing and the ring that they push."""

    solution: QuasistaticSolution
    contacts: Sequence[BearingContact]
    oil: Lubricant
    supply: OilAtInlets | None
    ring: Ring
    light: NDArray[np.int64]  # numbers of the balls, from 0
    V: Array  # between the grooves' centres of all balls in the dry equilibrium, (2, N) [m]
    # sums over both races of each ball in the dry equilibrium, (N,) [m]
    approach: Array
    film: Array

    @property
    def lengths(self) -> Array:
        """Arms from the grooves' centres to the centre of a ball that touches, (2,) [m]."""
        b = self.solution.bearing
        grooves = np.array([b.inner_groove_radius, b.outer_groove_radius])
        return grooves - 0.5 * b.ball_diameter

    @property
    def force(self) -> Array:
        """Centrifugal force of the light balls [N]."""
        return self.solution.centrifugal_force[self.light]

    def contacts_at(self, load: Array, u: Array, V: Array) -> list[BearingContact]:
        """Contacts of the light balls, inner and outer in turn, at loads (2, n) [N], with the
        balls at u and the grooves' centres V apart, (2, n) [m].
        """
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
            arrays[name][self.light] = values
        at = contact_conditions(replace(self.solution, **arrays), self.oil, thick=True)
        return [at[n] for n in _numbers(self.light)]

    def films_at(self, load: Array, u: Array, V: Array) -> Array:
        """Operating central films there, (2, n) [m]."""
        return _films(self.contacts_at(load, u, V), self.supply).reshape(-1, 2).T

    def moved_ring(self, dq: Array, push: Array, stiffness: Array, w: Array) -> Array:
        """A Newton step on of the ring's movement dq, (5,) [m], under the pushes of the light
        balls along w, (n,) [N], (2, n) [m], with their stiffness, (n,) [N/m].
        """
        s = self.solution
        before = np.stack([np.sin(s.inner_contact_angle), np.cos(s.inner_contact_angle)])
        V = self.V + np.einsum("vqz,q->vz", self.ring.movement, dq)
        length = np.hypot(*V)
        normal = before + V / length - self.V / np.hypot(*self.V)
        normal[:, self.light] = w / np.hypot(*w)
        compressed = self.approach + length - np.hypot(*self.V) + self.film
        compressed = np.maximum(compressed, 0.0) / self.approach
        load = s.inner_load * compressed**1.5
        load[self.light] = push
        stiffer = 1.5 * s.inner_load / self.approach * (np.sqrt(compressed) - 1.0)
        stiffer[self.light] = stiffness
        along = np.einsum("vqz,vz->qz", self.ring.movement, normal)
        tangent = s.stiffness / np.outer(self.ring.scale, self.ring.scale)
        tangent = tangent + np.einsum("qz,pz,z->qp", along, along, stiffer)
        change = load * normal - s.inner_load * before
        free = np.flatnonzero(self.ring.free)
        step = np.zeros(5)
        inverse = np.linalg.pinv(tangent[np.ix_(free, free)], SINGULAR)
        step[free] = inverse @ -np.einsum("vqz,vz->q", self.ring.movement, change)[free]
        return dq + step


def contacts_between_films(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    oil: Lubricant,
    supply: OilAtInlets | None = None,
) -> tuple[BearingContact, ...]:
    """Contacts whose balls without elastic load are in balance between two films.

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

    Returns
    -------
    sequence of BearingContact
        Those of light balls with the loads of their films and their `gap`; the same object where
        there are none.
    """
    balls = _light_balls(solution, contacts, oil, supply)
    if balls is None:
        return contacts if isinstance(contacts, tuple) else tuple(contacts)
    found = _balanced(balls)
    return BearingContacts.of(
        solution, (found.get(n, contact) for n, contact in enumerate(contacts))
    )


def _numbers(balls: NDArray[np.int64]) -> list[int]:
    """Numbers of the contacts of balls, inner then outer."""
    return [int(2 * ball + race) for ball in balls for race in range(2)]


def _light_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    oil: Lubricant,
    supply: OilAtInlets | None,
) -> _LightBalls | None:
    """The light balls; None where there are none, nothing turns, or they are balanced already."""
    s = solution
    light = np.flatnonzero(s.inner_load < NEGLIGIBLE_LOAD * s.inner_load.max(initial=0.0))
    if s.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        return None
    turning = s.operation.shaft_speed > 0.0 and bool((s.centrifugal_force > 0.0).all())
    known = any(contact.gap is not None for contact in contacts)
    if not (s.converged and turning and light.size) or known:
        return None
    ring = ring_of(s.bearing, s.operation, s.rows, s.model.rings)
    V = ring.position(np.concatenate([s.displacement, s.tilt]) * ring.scale)
    V[0] += s.inner_ring_axial - s.outer_ring_axial
    V[1] += s.inner_ring_radial - s.outer_ring_radial
    heavy = np.setdiff1d(np.arange(s.azimuth.size), light)
    films = np.zeros(s.azimuth.size)
    approaches = np.ones(s.azimuth.size)
    pairs = [contacts[n] for n in _numbers(heavy)]
    films[heavy] = _films(pairs, supply).reshape(-1, 2).sum(axis=1)
    approach = np.array([0.0 if c.hertz is None else c.hertz.approach for c in pairs])
    approaches[heavy] = approach.reshape(-1, 2).sum(axis=1)
    return _LightBalls(
        solution=s,
        contacts=contacts,
        oil=oil,
        supply=supply,
        ring=ring,
        light=light,
        V=V,
        approach=approaches,
        film=films,
    )


def _films(contacts: Sequence[BearingContact], supply: OilAtInlets | None) -> Array:
    """Operating central films [m]; zero where there is none."""
    films = operating_films(
        contacts, with_formulas(contacts, [None] * len(contacts)), supply=supply
    )
    return np.array([0.0 if film is None else film.central.value for film in films])


def _balanced(balls: _LightBalls) -> dict[int, BearingContact]:
    """Contacts of the light balls in balance, by their numbers."""
    # 1. balls whose gap the layers fill: the thickest films leave no room
    filled = _filled(balls)
    rest = balls.light[~filled]
    balls = replace(balls, light=balls.light[filled])
    changed: dict[int, BearingContact] = {}
    if filled.any():
        # 2. balance with the ring that yields, else with the ring where it is
        found = _rounds(balls, ring_yields=True) or _rounds(balls, ring_yields=False)
        if found is None:
            return {}
        # 3. where they are; balls that the ring has left are as those with too little oil
        u, V, load = found
        left = load[0] < LEAST_LOAD * balls.force
        rest = np.concatenate([rest, balls.light[left]])
        gap = balls.lengths[:, None] - np.stack([np.hypot(*(V - u)), np.hypot(*u)])
        places = zip(balls.contacts_at(load, u, V), gap.T.ravel().tolist(), strict=True)
        between = [replace(contact, gap=room) for contact, room in places]
        changed = dict(zip(_numbers(balls.light), between, strict=True))
    for n in _numbers(rest):
        note = UNFILLED if n % 2 == 0 else balls.contacts[n].note
        changed[n] = replace(balls.contacts[n], note=note)
    return changed


def _rounds(balls: _LightBalls, *, ring_yields: bool) -> tuple[Array, Array, Array] | None:
    """Films, loads and the ring in turn: u, V [m] and loads [N], each (2, n); None where they do
    not settle.

    The way of a load is halved where it turns, the ring's where the changes grow.
    """
    V = balls.V[:, balls.light]
    u = V * (balls.lengths[1] / np.hypot(*V))
    load = np.stack([balls.force, 2.0 * balls.force])
    way = np.zeros_like(load)
    longest = np.full_like(load, LONGEST)
    slope = None
    dq = np.zeros(5)
    part = 1.0
    last = np.inf
    for _ in range(ROUNDS):
        springs = _springs(balls, load, u, V, slope)
        at = u
        u, found = _in_balance(springs, V, balls.force)
        turn = float((np.hypot(*(u - at)) / np.hypot(*u)).max())
        ahead = np.log(found / load)
        change = float(np.abs(ahead).max())
        turned = (way * ahead < 0.0) & (np.abs(ahead) > SLOPED)
        longest = np.where(turned, 0.5 * np.abs(way), longest)
        way = np.clip(ahead, -longest, longest)
        load = load * np.exp(way)
        if max(change, turn) < TOLERANCE:
            return u, V, load
        slope = springs.slope if max(change, turn) < SLOPED else None
        if ring_yields:
            part = part if change < last else max(0.5 * part, LEAST_PART)
            last = change
            soft = springs.softness(load).sum(axis=0)
            dq = dq + part * (balls.moved_ring(dq, load[0], 1.0 / soft, V - u) - dq)
            movement = np.einsum("vqz,q->vz", balls.ring.movement, dq)
            V = balls.V[:, balls.light] + movement[:, balls.light]
    return None


def _filled(balls: _LightBalls) -> NDArray[np.bool_]:
    """Balls whose gap the films fill under next to no load at the inner race."""
    V = balls.V[:, balls.light]
    u = V * (balls.lengths[1] / np.hypot(*V))
    least = np.stack([LEAST_LOAD * balls.force, (1.0 + LEAST_LOAD) * balls.force])
    return np.asarray(balls.films_at(least, u, V).sum(axis=0) > balls.lengths.sum() - np.hypot(*V))


def _springs(balls: _LightBalls, load: Array, u: Array, V: Array, slope: Array | None) -> _Springs:
    """Laws of the films at loads (2, n) [N]; slopes are taken anew where there are none."""
    contacts = balls.contacts_at(load, u, V)
    hertz = [contact.hertz for contact in contacts]
    approach = np.array([0.0 if one is None else one.approach for one in hertz])
    film = _films(contacts, balls.supply).reshape(-1, 2).T
    if slope is None:
        other = balls.films_at(STEP * load, u, V)
        slope = np.clip(np.log(film / other) / log(STEP), 0.0, STEEPEST)
    return _Springs(
        stiffness=load / approach.reshape(-1, 2).T ** 1.5,
        film=film,
        slope=slope,
        load=load,
        length=balls.lengths,
    )


def _in_balance(springs: _Springs, V: Array, force: Array) -> tuple[Array, Array]:
    """Balls in balance: u (2, n) [m] and loads (2, n) [N].

    Newton's method with the exact stiffness of the springs, whose energy is convex, begun on the
    line between the grooves' centres.
    """
    u = V * ((springs.length[1] + _split(springs, V, force)) / np.hypot(*V))
    load, left, stiffness = _forces(springs, u, V, force)
    for _ in range(NEWTON_STEPS):
        moving = np.hypot(*left) > BALANCED * load.max(axis=0)
        if not moving.any():
            break
        step = np.linalg.solve(stiffness.T, left.T[..., None])[..., 0].T * moving
        factor = np.ones(force.size)
        for _ in range(HALVINGS):
            at = u + factor * step
            load, ahead, stiffness = _forces(springs, at, V, force)
            shorter = np.hypot(*ahead) < np.hypot(*left)
            good = shorter | ((ahead * step).sum(axis=0) > 0.0) | ~moving
            if good.all():
                break
            factor = np.where(good, factor, 0.5 * factor)
        u, left = at, ahead
    return u, load


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


def _forces(springs: _Springs, u: Array, V: Array, force: Array) -> tuple[Array, Array, Array]:
    """Loads (2, n), force left on the balls (2, n) [N] and its stiffness (2, 2, n) [N/m]."""
    arms = np.stack([V - u, u])
    distance = np.hypot(arms[:, 0], arms[:, 1])
    normal = arms / distance[:, None]
    load = springs.loads(distance - springs.length[:, None])
    pull = load[:, None] * normal
    left = pull[0] - pull[1]
    left[1] += force
    along = np.einsum("cin,cjn->cijn", normal, normal)
    across = np.eye(2)[None, :, :, None] - along
    stiff = (1.0 / springs.softness(load))[:, None, None] * along
    stiff += (load / distance)[:, None, None] * across
    return load, left, stiff.sum(axis=0)

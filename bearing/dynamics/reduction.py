"""What is solved of the motion, and how the rest follows from it by symmetry.

Under an axial load all balls move alike, each in its place around the axis: the motion of one is
solved. Under a load across the axis the middle plane is a mirror: no body moves along the axis or
tilts, no ball spins on a race, and half a contact ellipse says what the whole one does. The state
of a simulation always holds all balls; the integrators work on what is solved alone.
"""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehl.traction.quadrature import STRAIGHT_NODES, unit_gauss

from ._kernels import solved_derivative
from .arrays import LOAD_COLUMNS, Array, EquationData, FrictionData, changed_data
from .choices import LoadType
from .layout import BODIES, FREE_TURN, Layout
from .record import ContactHistory, Record, SimulationState

MIRRORED = (LoadType.RADIAL, LoadType.PLANAR)
SYMMETRIC = (*MIRRORED, LoadType.AXIAL)
LANDS = 2  # places of the lands, the last of the memory of impacts


def solved_places(free: Array, balls: int) -> NDArray[np.int64]:
    """Places in the state vector of what is solved: free coordinates, their speeds, the rest.

    `free`: 1 or 0 for the coordinates of ring, cage and a ball, as `EquationData.free` [-].
    """
    layout = Layout(balls)
    bodies, position, turn = np.split(free > 0.0, (BODIES, FREE_TURN))
    coordinates = np.concatenate([bodies, np.tile(position, balls)])
    speeds = np.concatenate([coordinates, np.tile(turn, balls)])
    others = np.ones(layout.size - layout.mechanical, dtype=np.bool_)
    return np.flatnonzero(np.concatenate([coordinates, speeds, others]))


def derivative(t: float, y: Array, data: EquationData, dy: Array) -> None:
    """Rates `dy` of all coordinates at time t [s], also of those that are not solved; moves a ring
    that is held to its place in y [SI].

    By the kernel that gives those that are solved: one of its own would take as long to compile.
    """
    data.whole[:] = y
    solved_derivative(t, y[data.solved], data.kernel, np.empty(data.solved.size))
    y[:] = data.whole
    dy[:] = data.rates


@dataclass(frozen=True, slots=True)
class SolvedMotion:
    """Equations of what is solved, of a bearing with `balls` balls."""

    balls: int
    data: EquationData

    @property
    def solved(self) -> int:
        """Balls whose motion is solved [-]."""
        return self.data.constants.balls

    def scale(self, scale: Array) -> Array:
        """Errors that count as one of what is solved, from those of all, shape (mechanical,)."""
        one = scale[_first_places(self.balls, self.solved)[: Layout(self.solved).mechanical]]
        return one[self.data.solved[: self.data.mechanical]]

    def begin(self, state: SimulationState) -> tuple[Array, ContactHistory]:
        """What is solved of a state, and what its contacts remember."""
        whole = state.y[_first_places(self.balls, self.solved)]
        self.data.whole[:] = whole
        history = ContactHistory(state.onset, state.contact_state, state.shares, state.attitude)
        if self.solved < self.balls:
            kept = _first_contacts(self.balls)
            self.data.memory[:] = state.memory[kept]
            history = ContactHistory(
                onset=state.onset[kept],
                states=state.contact_state[:, :1].copy(),
                shares=state.shares[:, :1].copy(),
                attitude=state.attitude[:1].copy(),
            )
        return whole[self.data.solved], history

    def finish(self, state: SimulationState, y: Array, history: ContactHistory) -> None:
        """Bring a state up to date; inverse of `begin`."""
        self.data.whole[self.data.solved] = y
        state.y[:] = all_states(self.data.whole[None], self.balls, self.solved)[0]
        if self.solved < self.balls:
            contacts = _all_contacts(self.balls)
            state.memory[:] = self.data.memory[contacts]
            state.onset[:] = history.onset[contacts]
            state.contact_state[:] = history.states
            state.shares[:] = history.shares
            state.attitude[:] = turned_attitudes(history.attitude[None], self.balls)[0]

    def whole_record(self, record: Record) -> Record:
        """Record of all balls."""
        if self.solved == self.balls:
            return record
        return record._replace(
            state=all_states(record.state, self.balls, self.solved),
            races=_repeated(record.races, 2, self.balls),
            pockets=_repeated(record.pockets, 1, self.balls),
            contact_state=_repeated(record.contact_state, 2, self.balls),
            attitude=turned_attitudes(record.attitude, self.balls),
        )


def solved_motion(kind: LoadType, data: EquationData) -> SolvedMotion:
    """Equations of what a load type leaves to be solved, from those of all balls."""
    balls = data.constants.balls
    if kind in MIRRORED:
        mirrored = changed_data(
            data,
            constants=data.constants._replace(mirrored=1),
            friction_inner=_straight(data.friction_inner),
            friction_outer=_straight(data.friction_outer),
        )
        return SolvedMotion(balls, mirrored)
    if kind is LoadType.AXIAL:
        return SolvedMotion(balls, _one_ball(data))
    return SolvedMotion(balls, data)


def _straight(friction: FrictionData) -> FrictionData:
    """Nodes along half the ellipse; the centre stays where it counts alone."""
    law = friction.coefficient
    if law is None or law.disc.shape[1] == 1:
        return friction
    return friction._replace(coefficient=law._replace(disc=unit_gauss(STRAIGHT_NODES)))


def _one_ball(data: EquationData) -> EquationData:
    """Equations of the first ball, which stands for all."""
    balls = data.constants.balls
    layout = Layout(1)
    places = solved_places(data.free, 1)
    return changed_data(
        data,
        constants=data.constants._replace(balls=1, copies=balls),
        pocket_angle=data.pocket_angle[:1].copy(),
        pocket_place=data.pocket_place[:1].copy(),
        pocket_play=data.pocket_play[:1].copy(),
        memory=data.memory[_first_contacts(balls)],
        forces=np.zeros((1, LOAD_COLUMNS)),
        race_out=data.race_out[:, :1].copy(),
        pocket_out=data.pocket_out[:1].copy(),
        films=data.films[:, :1].copy(),
        linear=data.linear[:, :1].copy(),
        pocket_films=data.pocket_films[:1].copy(),
        solved=places,
        mechanical=places.size - (layout.size - layout.mechanical),
        whole=np.zeros(layout.size),
        rates=np.zeros(layout.size),
        turns=np.zeros((1, 3)),
    )


def _first_places(balls: int, solved: int) -> NDArray[np.int64]:
    """Places in the state vector of all balls of that of the first ones."""
    layout = Layout(balls)
    places = np.arange(layout.size)
    kept: list[Any] = []
    for bodies, of_balls in (
        (slice(0, BODIES), layout.ball),
        (slice(layout.positions, layout.positions + BODIES), layout.ball_speed),
        (slice(0, 0), layout.ball_turn),
    ):
        kept += [places[bodies], places[of_balls][: 3 * solved]]
    return np.concatenate([*kept, places[layout.mechanical :]])


def _first_contacts(balls: int) -> NDArray[np.int64]:
    """Places in the memory of impacts of the first ball's and the lands'."""
    return np.concatenate([balls * np.arange(3), 3 * balls + np.arange(LANDS)])


def _all_contacts(balls: int) -> NDArray[np.int64]:
    """Inverse of `_first_contacts`: where each contact's memory stands in that of one ball."""
    return np.concatenate([np.repeat(np.arange(3), balls), 3 + np.arange(LANDS)])


def _repeated(values: NDArray[Any], axis: int, balls: int) -> NDArray[Any]:
    """The one value along an axis for all balls, a view."""
    return np.broadcast_to(values, (*values.shape[:axis], balls, *values.shape[axis + 1 :]))


@cache
def _turns(balls: int) -> Array:
    """Rotations about the axis by multiples of a Z-th of a turn, side by side, shape (3, 3 Z)."""
    angle = 2.0 * np.pi / balls * np.arange(balls)
    out = np.zeros((3, balls, 3))
    out[0, :, 0] = 1.0
    out[1, :, 1] = out[2, :, 2] = np.cos(angle)
    out[1, :, 2] = np.sin(angle)
    out[2, :, 1] = -np.sin(angle)
    return out.reshape(3, 3 * balls)


def turned(vectors: Array, balls: int) -> Array:
    """Vectors of one ball, shape (m, 3), for all balls: turned about the axis, (m, Z, 3)."""
    return (vectors @ _turns(balls)).reshape(len(vectors), balls, 3)


def turned_attitudes(attitude: Array, balls: int) -> Array:
    """Quaternions of one ball, shape (m, 1, 4), for all balls, (m, Z, 4) [-]."""
    vectors = turned(attitude[:, 0, 1:], balls)
    scalars = np.repeat(attitude[:, :, :1], balls, axis=1)
    return np.concatenate([scalars, vectors], axis=-1)


def all_states(states: Array, balls: int, solved: int) -> Array:
    """State vectors of all balls from those of the solved ones, shape (m, size) [SI]."""
    if solved == balls:
        return states
    one = Layout(1)
    all_of_them = Layout(balls)
    out = np.zeros((len(states), all_of_them.size))
    out[:, _first_places(balls, solved)] = states[:, : one.size]
    for part in ("ball", "ball_speed", "ball_turn"):
        vectors = turned(states[:, getattr(one, part)], balls)
        out[:, getattr(all_of_them, part)] = vectors.reshape(len(states), -1)
    return out


def symmetric_part(motion: SolvedMotion, rates: Array) -> Array:
    """Rates of all balls as they would be if those that are solved stood for the others [SI]."""
    first = rates[_first_places(motion.balls, motion.solved)]
    kept = np.zeros_like(first)
    kept[motion.data.solved] = first[motion.data.solved]
    return all_states(kept[None], motion.balls, motion.solved)[0]

"""Unknowns of the motion, and the rest that follows from them by symmetry.

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

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction.shear import STRAIGHT_NODES, unit_gauss

from ._motion_kernels import solved_derivative
from .arrays import (
    BALL,
    BODIES,
    FREE_TURN,
    LOAD_COLUMNS,
    OF_RACES,
    EquationData,
    FrictionData,
    Layout,
    changed_data,
)
from .choices import LoadType
from .record import ContactHistory, Record, SimulationState

MIRRORED = (LoadType.RADIAL, LoadType.PLANAR)
SYMMETRIC = (*MIRRORED, LoadType.AXIAL)
LANDS = 2  # places of the lands, the last of the speeds of the impacts


def solved_indices(free: Array, balls: int) -> NDArray[np.int64]:
    """Indices in the state vector of the unknowns: free coordinates, their speeds, the rest.

    Parameters
    ----------
    free : Array
        1 or 0 for the coordinates of ring, cage and a ball, as `EquationData.free` [-]
    balls : int
        number of balls [-]

    Returns
    -------
    NDArray[np.int64]
        indices, rising [-]
    """
    layout = Layout(balls)
    bodies, position, turn = np.split(free > 0.0, (BODIES, FREE_TURN))
    coordinates = np.concatenate([bodies, np.tile(position, balls)])
    speeds = np.concatenate([coordinates, np.tile(turn, balls)])
    others = np.ones(layout.size - layout.mechanical, dtype=np.bool_)
    return np.flatnonzero(np.concatenate([coordinates, speeds, others]))


def derivative(t: float, y: Array, data: EquationData, dy: Array) -> None:
    """Rates of all coordinates, also of those that are not solved.

    By the kernel that gives those that are solved: one of its own would take as long to compile.

    Parameters
    ----------
    t : float
        time [s]
    y : Array
        state vector; a constrained ring is moved to its position in it [SI]
    data : EquationData
        problem in numbers
    dy : Array
        rates, written [SI]
    """
    data.full_state[:] = y
    solved_derivative(t, y[data.solved], data.kernel, np.empty(data.solved.size))
    y[:] = data.full_state
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
        """Errors of the unknowns that count as one.

        Parameters
        ----------
        scale : Array
            errors of all coordinates and speeds [SI]

        Returns
        -------
        Array
            errors, shape (mechanical,) [SI]
        """
        one = scale[_first_indices(self.balls, self.solved)[: Layout(self.solved).mechanical]]
        return one[self.data.solved[: self.data.mechanical]]

    def begin(self, state: SimulationState) -> tuple[Array, ContactHistory]:
        """Unknowns of a state, and the history of their contacts.

        Parameters
        ----------
        state : SimulationState
            state of all balls

        Returns
        -------
        y
            unknowns [SI]
        history
            onset, state and times of the contacts
        """
        selected = state.y[_first_indices(self.balls, self.solved)]
        self.data.full_state[:] = selected
        history = ContactHistory(state.onset, state.contact_state, state.shares, state.attitude)
        if self.solved < self.balls:
            contacts = _first_contacts(self.balls)
            self.data.impact_speeds[:] = state.impact_speeds[contacts]
            history = ContactHistory(
                onset=state.onset[contacts],
                states=state.contact_state[:, :1].copy(),
                shares=state.shares[:, :1].copy(),
                attitude=state.attitude[:1].copy(),
            )
        return selected[self.data.solved], history

    def finish(self, state: SimulationState, y: Array, history: ContactHistory) -> None:
        """Bring a state up to date; inverse of `begin`.

        Parameters
        ----------
        state : SimulationState
            state of all balls, changed
        y : Array
            unknowns [SI]
        history : ContactHistory
            history of their contacts
        """
        self.data.full_state[self.data.solved] = y
        state.y[:] = all_states(self.data.full_state[None], self.balls, self.solved)[0]
        if self.solved < self.balls:
            contacts = _all_contacts(self.balls)
            state.impact_speeds[:] = self.data.impact_speeds[contacts]
            state.onset[:] = history.onset[contacts]
            state.contact_state[:] = history.states
            state.shares[:] = history.shares
            state.attitude[:] = turned_attitudes(history.attitude[None], self.balls)[0]

    def full_record(self, record: Record) -> Record:
        """Record of all balls.

        Parameters
        ----------
        record : Record
            record of the balls that are solved

        Returns
        -------
        Record
            record by symmetry
        """
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
    """Equations of the unknowns that a load type leaves, from those of all balls.

    Parameters
    ----------
    kind : LoadType
        equations of motion
    data : EquationData
        problem in numbers, of all balls

    Returns
    -------
    SolvedMotion
        equations of the balls that are solved
    """
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
    indices = solved_indices(data.free, 1)
    fields = data._asdict()
    first = {
        name: fields[name][:, :1] if name in OF_RACES else fields[name][:1]
        for name in BALL.names or ()
    }
    return changed_data(
        data,
        **first | {"forces": np.zeros((1, LOAD_COLUMNS)), "turns": np.zeros((1, 3))},
        constants=data.constants._replace(balls=1, symmetric_copies=balls),
        impact_speeds=data.impact_speeds[_first_contacts(balls)],
        solved=indices,
        mechanical=indices.size - (layout.size - layout.mechanical),
        full_state=np.zeros(layout.size),
        rates=np.zeros(layout.size),
    )


def _first_indices(balls: int, solved: int) -> NDArray[np.int64]:
    """Places in the state vector of all balls of that of the first ones."""
    layout = Layout(balls)
    indices = np.arange(layout.size)
    selected: list[Any] = []
    for bodies, of_balls in (
        (slice(0, BODIES), layout.ball),
        (slice(layout.positions, layout.positions + BODIES), layout.ball_speed),
        (slice(0, 0), layout.ball_turn),
    ):
        selected += [indices[bodies], indices[of_balls][: 3 * solved]]
    angles = indices[layout.mechanical : layout.roll.start + solved]
    return np.concatenate([*selected, angles, indices[layout.energy]])


def _first_contacts(balls: int) -> NDArray[np.int64]:
    """Places in the speeds of the impacts of the first ball's and the lands'."""
    return np.concatenate([balls * np.arange(3), 3 * balls + np.arange(LANDS)])


def _all_contacts(balls: int) -> NDArray[np.int64]:
    """Inverse of `_first_contacts`: the place of each contact's speed in those of one ball."""
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
    """Vectors of one ball for all balls: turned about the axis.

    Parameters
    ----------
    vectors : Array
        vectors of the first ball, shape (m, 3) [any unit]
    balls : int
        number of balls [-]

    Returns
    -------
    Array
        vectors, shape (m, Z, 3) [any unit]
    """
    return (vectors @ _turns(balls)).reshape(len(vectors), balls, 3)


def turned_attitudes(attitude: Array, balls: int) -> Array:
    """Quaternions of one ball for all balls.

    Parameters
    ----------
    attitude : Array
        quaternions of the first ball, shape (m, 1, 4) [-]
    balls : int
        number of balls [-]

    Returns
    -------
    Array
        quaternions, shape (m, Z, 4) [-]
    """
    vectors = turned(attitude[:, 0, 1:], balls)
    scalars = np.repeat(attitude[:, :, :1], balls, axis=1)
    return np.concatenate([scalars, vectors], axis=-1)


def all_states(states: Array, balls: int, solved: int) -> Array:
    """State vectors of all balls from those of the solved ones.

    Parameters
    ----------
    states : Array
        state vectors, shape (m, size) [SI]
    balls : int
        number of balls [-]
    solved : int
        number of solved balls [-]

    Returns
    -------
    Array
        state vectors, shape (m, size of all) [SI]
    """
    if solved == balls:
        return states
    one = Layout(1)
    all_of_them = Layout(balls)
    out = np.zeros((len(states), all_of_them.size))
    out[:, _first_indices(balls, solved)] = states[:, : one.size]
    for name in ("ball", "ball_speed", "ball_turn"):
        vectors = turned(states[:, getattr(one, name)], balls)
        out[:, getattr(all_of_them, name)] = vectors.reshape(len(states), -1)
    out[:, all_of_them.roll] = states[:, one.roll]
    return out


def symmetric_part(motion: SolvedMotion, rates: Array) -> Array:
    """Rates of all balls if those that are solved stood for the others.

    Parameters
    ----------
    motion : SolvedMotion
        equations in use
    rates : Array
        rates of all coordinates, shape (size,) [SI]

    Returns
    -------
    Array
        symmetric rates, shape (size,) [SI]
    """
    first = rates[_first_indices(motion.balls, motion.solved)]
    solved = np.zeros_like(first)
    solved[motion.data.solved] = first[motion.data.solved]
    return all_states(solved[None], motion.balls, motion.solved)[0]

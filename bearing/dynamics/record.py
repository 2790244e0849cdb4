"""What a simulation keeps: samples, state to go on from, and the steps it may take."""

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .layout import Layout
from .problem import POCKET_COLUMNS, RACE_COLUMNS, Array

LEAST_STEP = 1.0e-12  # over the end time, below which a step has failed [-]


# of the period of contact vibration: a stiff problem with shorter steps goes to LSODA [-]
STIFF_STEP = 0.02


# longest step times the frequency of a loaded ball: at the limit of stability it would ring [-]
STEP_ANGLE = 0.8


class Record(NamedTuple):
    """Rows of the history; states [SI], contacts (`problem.RACE_NAMES`), pockets, energies [J],
    loads [N, N m].
    """

    time: Array  # (m,) [s]
    state: Array  # (m, size)
    races: Array  # (m, 2, Z, RACE_COLUMNS)
    pockets: Array  # (m, Z, POCKET_COLUMNS)
    energy: Array  # kinetic, elastic, potential (m, 3) [J]
    loads: Array  # on ring and cage (m, 12) [N], [N m]
    contact_state: NDArray[np.int8]  # 0 free, 1 contact, 2 impact (m, 2, Z)
    attitude: Array  # of the balls, quaternion w, x, y, z (m, Z, 4) [-]


@dataclass(slots=True, kw_only=True)
class SimulationState:
    """Where a simulation stands; all that a restart needs.

    Attributes
    ----------
    time, step : float
        [s].
    y : ndarray
        State vector [SI].
    memory, onset : ndarray, shape (3 Z + 2,)
        Speeds [m/s] and times [s] of the beginnings of the contacts.
    contact_state : ndarray, shape (2, Z)
    shares : ndarray, shape (2, Z, 3)
        Time spent free, in contact, in an impact [s].
    attitude : ndarray, shape (Z, 4)
        Quaternions of the balls [-].
    counters : ndarray
        Steps, rejected steps, of the test for stiffness, evaluations [-].
    stiff : bool
        Whether LSODA took over at some time.
    """

    time: float
    step: float
    y: Array
    memory: Array
    onset: Array
    contact_state: NDArray[np.int8]
    shares: Array
    attitude: Array
    counters: NDArray[np.int64]
    stiff: bool = False

    def put_back(self, other: "SimulationState") -> None:
        """Take over the values of another state, in the arrays that the equations hold."""
        for part in fields(self):
            mine, value = getattr(self, part.name), getattr(other, part.name)
            if isinstance(mine, np.ndarray):
                mine[...] = value
            else:
                setattr(self, part.name, value)


def empty_record(times: Array, balls: int) -> Record:
    """Room for a row at each time [s]."""
    m = times.size
    return Record(
        time=times.copy(),
        state=np.zeros((m, Layout(balls).size)),
        races=np.zeros((m, 2, balls, RACE_COLUMNS)),
        pockets=np.zeros((m, balls, POCKET_COLUMNS)),
        energy=np.zeros((m, 3)),
        loads=np.zeros((m, 12)),
        contact_state=np.zeros((m, 2, balls), dtype=np.int8),
        attitude=np.zeros((m, balls, 4)),
    )


def join(first: Record, second: Record) -> Record:
    """Two records one after the other."""
    parts: list[Any] = [np.concatenate((a, b)) for a, b in zip(first, second, strict=True)]  # type: ignore[arg-type]
    return Record(*parts)

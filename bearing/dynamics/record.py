"""State, step control and samples of the integrators, and the state that a restart needs."""

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array

from .arrays import BODIES, LOAD_COLUMNS, POCKET_COLUMNS, RACE_COLUMNS, Layout
from .choices import LoadType


class Record(NamedTuple):
    """Rows of the history [SI]: states, contacts (`arrays.ContactColumns`), pockets, energies."""

    time: Array  # (m,) [s]
    state: Array  # (m, size)
    races: Array  # (m, 2, Z, RACE_COLUMNS)
    pockets: Array  # (m, Z, POCKET_COLUMNS)
    energy: Array  # kinetic, elastic, potential (m, 3) [J]
    loads: Array  # on ring and cage (m, 12) [N], [N m]
    contact_state: NDArray[np.int8]  # 0 separated, 1 in contact, 2 in an impact (m, 2, Z)
    attitude: Array  # of the balls, quaternion w, x, y, z (m, Z, 4) [-]
    acceleration: Array  # of ring, cage, outer ring and sensor (m, BODIES) [m/s^2], [rad/s^2]


class StepControl(NamedTuple):
    """Limits of the steps."""

    shortest: float  # below it a step has failed [s]
    longest: float  # [s]
    implicit: float  # longest of the implicit method [s]
    steepest: float  # stiffness Q/approach of a contact, beyond which it is shorter [N/m]
    stiff: float  # a stiff problem with shorter steps goes to LSODA [s]
    speed: float  # error of a ball's velocity that counts as one [m/s]


class ContactHistory(NamedTuple):
    """History of the contacts, see `SimulationState`."""

    onset: Array
    states: NDArray[np.int8]
    shares: Array
    attitude: Array


@dataclass(slots=True, kw_only=True)
class SimulationState:
    """Present state of a simulation; all that a restart needs."""

    kind: LoadType  # whose equations move it on
    time: float  # [s]
    step: float  # [s]
    y: Array  # state vector [SI]
    impact_speeds: Array  # speed at the onset of each contact [m/s], shape (3 Z + 2,)
    onset: Array  # its time [s]
    contact_state: NDArray[np.int8]  # as in `Record`, shape (2, Z)
    shares: Array  # time spent separated, in contact, in an impact [s], shape (2, Z, 3)
    attitude: Array  # quaternions of the balls [-], shape (Z, 4)
    counters: NDArray[np.int64]  # steps, rejected, test for stiffness, evaluations [-]
    stiff: bool = False  # whether LSODA took over at some time

    def restore(self, snapshot: "SimulationState") -> None:
        """Take over the values of another state, in the arrays that the equations use.

        Parameters
        ----------
        snapshot : SimulationState
            state with the values
        """
        for field in fields(self):
            present = getattr(self, field.name)
            value = getattr(snapshot, field.name)
            if isinstance(present, np.ndarray):
                present[...] = value
            else:
                setattr(self, field.name, value)


def empty_record(times: Array, balls: int) -> Record:
    """Record with a row of zeros at each time.

    Parameters
    ----------
    times : Array
        times of the rows [s]
    balls : int
        number of balls [-]

    Returns
    -------
    Record
        record to fill
    """
    m = times.size
    return Record(
        time=times.copy(),
        state=np.zeros((m, Layout(balls).size)),
        races=np.zeros((m, 2, balls, RACE_COLUMNS)),
        pockets=np.zeros((m, balls, POCKET_COLUMNS)),
        energy=np.zeros((m, 3)),
        loads=np.zeros((m, 2 * LOAD_COLUMNS)),
        contact_state=np.zeros((m, 2, balls), dtype=np.int8),
        attitude=np.zeros((m, balls, 4)),
        acceleration=np.zeros((m, BODIES)),
    )


def first_rows(record: Record, rows: int) -> Record:
    """The first rows of a record.

    Parameters
    ----------
    record : Record
        record
    rows : int
        number of rows that were reached [-]

    Returns
    -------
    Record
        record with views of these rows
    """
    arrays: list[Any] = [array[:rows] for array in record]
    return Record(*arrays)


def picked_rows(record: Record, rows: NDArray[np.bool_]) -> Record:
    """Some rows of a record.

    Parameters
    ----------
    record : Record
        record
    rows : NDArray[np.bool_]
        true for those that are kept, shape (m,)

    Returns
    -------
    Record
        record of these rows
    """
    arrays: list[Any] = [array[rows] for array in record]
    return Record(*arrays)


def join(first: Record, second: Record) -> Record:
    """Two records one after the other.

    Parameters
    ----------
    first, second : Record
        records of the same bearing

    Returns
    -------
    Record
        one record
    """
    pairs: Any = zip(first, second, strict=True)
    arrays = [np.concatenate((a, b)) for a, b in pairs]
    return Record(*arrays)

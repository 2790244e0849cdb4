"""The history of a time simulation: one netCDF-4 file that grows piece by piece, SI."""

import os
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5netcdf
import h5py
import numpy as np

from oilfilm.bearing.dynamics.arrays import CONTACT, SEAT, SENSOR, ContactColumns, Layout
from oilfilm.bearing.dynamics.record import Record
from oilfilm.bearing.dynamics.statistics import MECHANISMS
from oilfilm.bearing.files import require_room

HISTORY_FILE = "history.nc"
FORMAT = 1
RING_NAMES = ("x", "y", "z", "tilt_y", "tilt_z")
CAGE_NAMES = ("x", "y", "z", "rotation", "tilt_y", "tilt_z")
RACE_UNITS = ("N", "m", "m/s", "rad", "m/s", "m/s", "m/s", "rad/s", "N", "N", "m")
STATES = "0 free, 1 contact, 2 impact"
CHUNK = 128  # rows
OVERHEAD = 2**20  # of HDF5 beside the values of a record, at most [bytes]
KINDS = {"time": "f8", "ring_rotation": "f8", "contact_state": "i1"}  # all others in f4
COMPRESSION: dict[str, Any] = {"compression": "gzip", "compression_opts": 1}


def variables(record: Record, balls: int) -> dict[str, tuple[tuple[str, ...], Any, str]]:
    """Dimensions, values and unit of every quantity of a record, by name; SI.

    Parameters
    ----------
    record : Record
        Samples of a simulation.
    balls : int
        Number of balls [-].

    Returns
    -------
    dict[str, tuple[tuple[str, ...], Any, str]]
        Dimensions, values and unit by name.
    """
    layout = Layout(balls)
    state = record.state
    ring, cage = ("time", "ring_coordinate"), ("time", "cage_coordinate")
    pocket = ("time", "ball")
    race = ("time", "race", "ball")
    load = ("time", "load")

    def of_balls(part: slice, unit: str) -> tuple[tuple[str, ...], Any, str]:
        return ("time", "ball", "axis"), state[:, part].reshape(len(state), balls, 3), unit

    quantities = {
        "ring_position": (ring, state[:, layout.ring], "m, rad"),
        "ring_velocity": (ring, state[:, layout.ring_speed], "m/s, rad/s"),
        "cage_position": (cage, state[:, layout.cage], "m, rad"),
        "cage_velocity": (cage, state[:, layout.cage_speed], "m/s, rad/s"),
        "ring_rotation": (("time",), state[:, layout.ring_angle], "rad"),
        "ball_position": of_balls(layout.ball, "m"),
        "ball_velocity": of_balls(layout.ball_speed, "m/s"),
        "ball_angular_velocity": of_balls(layout.ball_turn, "rad/s"),
        "ball_attitude": (("time", "ball", "quaternion"), record.attitude, "1"),
        "contact_state": (race, record.contact_state, "1"),
        "pocket_load": (pocket, record.pockets[..., CONTACT.load], "N"),
        "pocket_approach": (pocket, record.pockets[..., CONTACT.approach], "m"),
        "energy": (("time", "form"), record.energy, "J"),
        "work": (("time", "mechanism"), state[:, layout.energy], "J"),
        "friction_torque": (("time",), -record.loads[:, 3], "N m"),
        "ring_load": (load, record.loads[:, :6], "N, N m"),
        "cage_load": (load, record.loads[:, 6:], "N, N m"),
    }
    if len(state) and state[:, [SEAT, SENSOR]].any():  # they move
        axis = ("time", "axis")
        outer = slice(SEAT, SENSOR)
        speeds = state[:, layout.positions :]
        quantities |= {
            "outer_ring_position": (axis, state[:, outer], "m"),
            "outer_ring_velocity": (axis, speeds[:, outer], "m/s"),
            "outer_ring_acceleration": (axis, record.acceleration[:, outer], "m/s2"),
            "sensor_acceleration": (("time",), record.acceleration[:, SENSOR], "m/s2"),
        }
    for k, (name, unit) in enumerate(zip(ContactColumns._fields, RACE_UNITS, strict=True)):
        quantities[f"contact_{name}"] = (race, record.races[..., k], unit)
    return quantities


class HistoryWriter:
    """A netCDF-4 file that takes records one after the other.

    HDF5 cannot close a file of which the disk refused a part, and may end the program. The disk is
    therefore asked for the room of a record before HDF5 writes it. The number of rows is fixed:
    who opens a file without such a number asks all variables for it, again and again.
    """

    def __init__(
        self, path: Path, balls: int, length: int, attributes: Mapping[str, str | float]
    ) -> None:
        self.balls = balls
        self.length = length  # rows at most
        self.rows = 0
        self.path = path
        require_room(path.parent, OVERHEAD)
        self.file = h5netcdf.File(path, "w")
        coordinates: dict[str, tuple[str, ...] | Any] = {
            "ball": np.arange(1, balls + 1),
            "axis": ("x", "y", "z"),
            "race": ("inner", "outer"),
            "quaternion": ("w", "x", "y", "z"),
            "ring_coordinate": RING_NAMES,
            "cage_coordinate": CAGE_NAMES,
            "form": ("kinetic", "elastic", "potential"),
            "mechanism": MECHANISMS,
            "load": ("fx", "fy", "fz", "mx", "my", "mz"),
        }
        self.file.dimensions = {name: len(values) for name, values in coordinates.items()}
        for name, values in coordinates.items():
            text = name != "ball"
            data = np.array(values, dtype=object if text else None)
            kind = h5py.string_dtype() if text else data.dtype
            self.file.create_variable(name, (name,), dtype=kind, data=data)
        self.file.attrs.update({"oilfilm_history": FORMAT, **attributes})
        self._created = False

    def add(self, record: Record) -> None:
        """Append the samples of a record.

        Parameters
        ----------
        record : Record
            Samples of a simulation.

        Raises
        ------
        OSError
            If the disk does not take them.
        """
        m = record.time.size
        parts = {"time": (("time",), record.time, "s"), **variables(record, self.balls)}
        row = sum(values[0].nbytes for _, values, _ in parts.values())
        _require_growth(self.path, OVERHEAD + (m + CHUNK) * row)
        if not self._created:
            self._create(parts)
        for name, (_, values, _unit) in parts.items():
            self.file.variables[name][self.rows : self.rows + m] = values
        self.file.flush()
        self.rows += m

    def _create(self, parts: dict[str, tuple[tuple[str, ...], Any, str]]) -> None:
        self.file.dimensions["time"] = self.length
        for name, (dimensions, values, unit) in parts.items():
            kind = KINDS.get(name, "f4")
            form = {"chunks": (min(CHUNK, self.length), *values.shape[1:]), **COMPRESSION}
            variable = self.file.create_variable(name, dimensions, dtype=kind, **form)
            variable.attrs["units"] = unit
        self.file.variables["contact_state"].attrs["meaning"] = STATES
        self._created = True

    def close(self) -> None:
        """End the file at the last row."""
        self.file.close()
        if 0 < self.rows < self.length:
            with h5py.File(self.path, "r+") as file:
                for values in file.values():
                    if values.chunks is not None:
                        values.resize(self.rows, axis=0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def _require_growth(path: Path, size: int) -> None:
    """OSError where the disk does not let a file grow by a size [bytes]."""
    if not hasattr(os, "posix_fallocate"):
        require_room(path.parent, size)
        return
    with path.open("r+b") as file:
        end = file.seek(0, os.SEEK_END)
        try:
            os.posix_fallocate(file.fileno(), end, size)
        finally:
            file.truncate(end)

"""Files of the traction tables of both races, at one temperature of the oil or several."""

import io
import json
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ehl.traction_table.storage import read_table, write_table
from ehl.traction_table.table import TableError, TractionTable
from ehl.traction_table.temperature import TemperatureTable

from ..files import write_bytes
from ..geometry import Race
from .race_tables import Tables, TemperatureTables

DAMAGED = "no traction tables of a bearing, or damaged ones"
INDEX = "temperatures.json"  # its presence marks a file with several temperatures


def save_race_tables(tables: Tables, path: Path) -> None:
    """Write the tables of both races into one file; it appears under its name only when it is
    complete.

    Parameters
    ----------
    tables : Tables
        by race
    path : Path
        of the file
    """
    _write(path, {f"{race.value}.npz": _bytes(table) for race, table in tables.items()})


def save_temperature_tables(tables: TemperatureTables, path: Path) -> None:
    """Write the tables at all temperatures into one file, as `save_race_tables` does.

    Parameters
    ----------
    tables : TemperatureTables
        by race
    path : Path
        of the file
    """
    index = {}
    entries: dict[str, bytes | str] = {}
    for race, series in tables.items():
        index[race.value] = {
            "tables": len(series.tables),
            "errors": [asdict(error) for error in series.errors],
        }
        for number, table in enumerate(series.tables):
            entries[f"{race.value}_{number}.npz"] = _bytes(table)
    _write(path, entries | {INDEX: json.dumps(index)})


def _bytes(table: TractionTable) -> bytes:
    stream = io.BytesIO()
    write_table(table, stream)
    return stream.getvalue()


def _write(path: Path, entries: dict[str, bytes | str] | dict[str, bytes]) -> None:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    write_bytes(path, stream.getvalue())


def load_tables(path: Path) -> Tables | TemperatureTables:
    """Read the tables of both races, at one temperature or several, as the file has them.

    Parameters
    ----------
    path : Path
        of the file

    Returns
    -------
    Tables | TemperatureTables
        at one temperature or several, as the file has them

    Raises
    ------
    ValueError
        if the file is none of this kind, or damaged; the message says which
    """
    try:
        with zipfile.ZipFile(path) as archive:
            if INDEX in archive.namelist():
                index = json.loads(archive.read(INDEX))
                return {race: _temperature_table(archive, path, race, index) for race in Race}
            return {race: _table(archive, path, race.value) for race in Race}
    except OSError:
        raise
    except ValueError as problem:
        if str(path) in str(problem):  # of a table in it, which says what is wrong
            raise
        raise ValueError(f"{path}: {DAMAGED}") from problem
    except Exception as problem:  # of zip files, compression, types, whatever is damaged
        raise ValueError(f"{path}: {DAMAGED}") from problem


def _table(archive: zipfile.ZipFile, path: Path, name: str) -> TractionTable:
    return read_table(io.BytesIO(archive.read(f"{name}.npz")), str(path))


def _temperature_table(
    archive: zipfile.ZipFile, path: Path, race: Race, index: dict[str, Any]
) -> TemperatureTable:
    entry = index[race.value]
    numbers = range(entry["tables"])
    return TemperatureTable(
        tables=tuple(_table(archive, path, f"{race.value}_{number}") for number in numbers),
        errors=tuple(TableError(**error) for error in entry["errors"]),
    )

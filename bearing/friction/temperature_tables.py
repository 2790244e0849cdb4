"""Traction tables of both races of a bearing at several temperatures of the oil, and their file."""

import io
import json
import os
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology
from ehl.traction.table.build import TableOptions
from ehl.traction.table.storage import read_table, write_table
from ehl.traction.table.table import TableContact, TableError
from ehl.traction.table.temperature import TemperatureTable, build_temperature_table

from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .race_tables import Progress, Solids, Tables, race_progress, table_contacts, table_range

INDEX = "temperatures.json"
TemperatureTables = dict[Race, TemperatureTable]
OilAt = Callable[[float], tuple[Lubricant, Rheology]]


def build_temperature_tables(
    solution: QuasistaticSolution,
    oil_at: OilAt,
    temperatures: Sequence[float],
    options: TableOptions | None = None,
    progress: Progress | None = None,
    solids: Solids | None = None,
) -> TemperatureTables:
    """Traction tables of both races around a quasi-static solution.

    Parameters
    ----------
    solution : QuasistaticSolution
    oil_at : callable
        Lubricant and rheology at a temperature [K].
    temperatures : sequence of float
        Two or more, rising [K].
    options : TableOptions, optional
    progress : callable, optional
        Called with films done, films wanted so far, and a word.
    solids : tuple of SolidThermal, optional
        Ball and race, for films with heat; None: at the temperature of the oil [K].
    """
    limits = table_range(solution, oil_at(temperatures[0])[0])
    found = {}
    for race in Race:

        def contact_at(temperature: float, race: Race = race) -> TableContact:
            return table_contacts(solution, *oil_at(temperature), temperature, solids)[race]

        told = race_progress(progress, race)
        found[race] = build_temperature_table(contact_at, temperatures, limits, options, told)
    return found


def save_temperature_tables(tables: TemperatureTables, path: Path) -> None:
    """Write the tables into one file; it appears under its name only when it is complete."""
    partial = path.with_name(path.name + ".partial")
    with zipfile.ZipFile(partial, "w") as archive:
        for race, found in tables.items():
            for number, table in enumerate(found.tables):
                stream = io.BytesIO()
                write_table(table, stream)
                archive.writestr(f"{race.value}_{number}.npz", stream.getvalue())
        index = {
            race.value: {
                "tables": len(found.tables),
                "errors": [asdict(error) for error in found.errors],
            }
            for race, found in tables.items()
        }
        archive.writestr(INDEX, json.dumps(index))
    os.replace(partial, path)


def load_temperature_tables(path: Path) -> TemperatureTables:
    """Read the tables of both races at all of their temperatures.

    Raises
    ------
    ValueError
        If the file is none of this kind, or damaged; the message says which.
    """
    found = {}
    try:
        with zipfile.ZipFile(path) as archive:
            index = json.loads(archive.read(INDEX))
            for race in Race:
                count, errors = index[race.value]["tables"], index[race.value]["errors"]
                streams = [
                    io.BytesIO(archive.read(f"{race.value}_{number}.npz"))
                    for number in range(count)
                ]
                tables = tuple(read_table(stream, str(path)) for stream in streams)
                found[race] = TemperatureTable(
                    tables=tables, errors=tuple(TableError(**error) for error in errors)
                )
    except (zipfile.BadZipFile, KeyError, TypeError, json.JSONDecodeError) as problem:
        raise ValueError(
            f"{path}: no traction tables over the temperature, or damaged ones"
        ) from problem
    return found


def holds_temperatures(path: Path) -> bool:
    """Whether a file has tables at several temperatures."""
    try:
        with zipfile.ZipFile(path) as archive:
            return INDEX in archive.namelist()
    except zipfile.BadZipFile:
        return False


def tables_for_oil(path: Path, oil: Lubricant) -> Tables:
    """Tables of both races at the temperature of an oil, from a file with tables at several.

    Raises
    ------
    ValueError
        If the oil's temperature lies out of their range, or the oil is another one.
    """
    if oil.temperature is None:
        raise ValueError(f"{path}: has tables at several temperatures, and the lubricant has none")
    try:
        return {
            race: found.at(oil.temperature, oil)
            for race, found in load_temperature_tables(path).items()
        }
    except ValueError as problem:
        text = str(problem)
        raise ValueError(text if text.startswith(str(path)) else f"{path}: {text}") from problem

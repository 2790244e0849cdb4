"""Traction tables of both races from a file, refused unless built for this bearing and oil."""

from collections.abc import Callable
from dataclasses import replace
from math import isclose
from pathlib import Path

from bearing.friction.race_tables import Solids, Tables
from bearing.friction.table_files import load_tables
from bearing.geometry import Bearing, contact_modulus, reduced_radii
from ehl import Lubricant
from ehl.oil.rheology import Rheology
from ehl.traction.table.table import TableContact, TractionTable
from ehl.traction.table.temperature import TemperatureTable

NEAR = 1.0e-6  # relative difference up to which a table is for this bearing [-]
NEAR_RADIUS = 0.05  # the same of the rolling radius, which goes with the contact angle [-]


def read_race_tables(
    path: Path, bearing: Bearing, oil: Lubricant, rheology: Rheology, solids: Solids | None = None
) -> Tables:
    """Tables of both races for a bearing, an oil and the law by which it shears; with heat, for
    `solids`.

    Raises
    ------
    ValueError
        If the file cannot be read, is damaged, or was built for another bearing or oil; the message
        begins with its name.
    """
    return made_for(tables_of_file(path)(oil, rheology), str(path), bearing, oil, rheology, solids)


def tables_of_file(path: Path) -> Callable[[Lubricant, Rheology], Tables]:
    """A file read once: its tables of both races, those at the temperature of an oil if it has
    several temperatures.

    Raises
    ------
    ValueError
        As `read_race_tables`; what comes back does if the oil's temperature is out of range, or
        the oil another one.
    """
    try:
        read = load_tables(path)
    except OSError as problem:
        raise ValueError(f"{path} cannot be read: {problem.strerror or problem}") from None

    def tables_at(oil: Lubricant, rheology: Rheology) -> Tables:
        try:
            return {race: _at(table, oil, rheology) for race, table in read.items()}
        except ValueError as problem:
            raise ValueError(f"{path}: {problem}") from problem

    return tables_at


def _at(
    stored: TractionTable | TemperatureTable, oil: Lubricant, rheology: Rheology
) -> TractionTable:
    """The table at the temperature of an oil, with its rheology where that is the tables' own."""
    if isinstance(stored, TractionTable):
        return stored
    if oil.temperature is None:
        raise ValueError("has tables at several temperatures, and the lubricant has none")
    table = stored.at(oil.temperature, oil)
    if not all(_same_shear(one.contact, oil, rheology) for one in stored.tables):
        return table
    return replace(table, contact=replace(table.contact, rheology=rheology))


def _same_shear(contact: TableContact, oil: Lubricant, rheology: Rheology) -> bool:
    """Whether a table shears by this law; an Eyring stress may scale with 1/alpha."""
    stress = rheology.eyring_stress
    if contact.rheology.eyring_stress != stress and oil.pressure_viscosity > 0.0:
        stress *= oil.pressure_viscosity / contact.lubricant.pressure_viscosity
    if not isclose(contact.rheology.eyring_stress, stress, rel_tol=NEAR):
        return False
    return replace(rheology, eyring_stress=contact.rheology.eyring_stress) == contact.rheology


def made_for(
    tables: Tables,
    name: str,
    bearing: Bearing,
    oil: Lubricant,
    rheology: Rheology,
    solids: Solids | None = None,
) -> Tables:
    """The tables themselves, `name` in messages, if they were built for this bearing and oil; else
    ValueError.

    Tables with heat must be of the ball and race of a case with heat; a case without leaves that
    to its tables.
    """
    for race, table in tables.items():
        contact = table.contact
        radius_x, radius_y = reduced_radii(bearing, race, bearing.free_contact_angle)
        fitting = {
            "oil": contact.lubricant == oil,
            "shear law": contact.rheology == rheology,
            "moduli": isclose(
                contact.reduced_modulus, contact_modulus(bearing, race), rel_tol=NEAR
            ),
            "groove": isclose(contact.radius_y, radius_y, rel_tol=NEAR),
            "rolling radius": isclose(contact.radius_x, radius_x, rel_tol=NEAR_RADIUS),
            "thermal properties": None in (contact.solids, solids) or contact.solids == solids,
        }
        wrong = [what for what, fits in fitting.items() if not fits]
        if wrong:
            raise ValueError(
                f"{name} was made for another bearing or oil ({race.value} race: "
                f"{', '.join(wrong)})"
            )
    return tables

"""Friction of contacts by a law of `oilfilm.ehl.traction` each: traction tables of both races at
one temperature of the oil or at several, their files, and coefficients.

The rolling radius of a race changes little from ball to ball with the contact angle: the table
takes that of its heaviest loaded contact. Loads reach from below the lightest ball (which carries
its centrifugal force only) to above the heaviest one at either race, speeds from half to 1.25
times the entrainment speeds of the case.
"""

import io
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.data_files import as_document, from_document
from oilfilm.ehl.foreign_files import DAMAGE, entries_as_bytes, entries_of, open_file
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.law import TractionLaw
from oilfilm.ehl.traction.shear import EllipseLaw
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table
from oilfilm.ehl.traction_table.storage import read_table, write_table
from oilfilm.ehl.traction_table.table import TableContact, TableError, TableRange, TractionTable
from oilfilm.ehl.traction_table.temperature import TemperatureTable, build_temperature_table

from ..contacts.contact import BearingContact
from ..contacts.contacts import contact_conditions
from ..contacts.motion import bearing_kinematics
from ..files import write_bytes
from ..films.film import first_same
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from . import _kernels
from .contact_friction import REFERENCE_TRACTION, ContactFriction, Dissipation

Evaluate = Callable[[NDArray[np.int64], Array, Array], tuple[Array, Array]]

# slides over u, and spin over u/R_x, of difference quotients [-]; half and double of it change
# loads and speeds of eight random bearings in traction equilibrium by 5e-12 at most
STEP = 1.0e-5

# below the lightest and above the heaviest contact; in a simulation of 7008_combined 99.8 % of the
# loads lie within, in one of 7008_axial all (from 0.99 of the lightest to 1.01 of the heaviest)
LOAD_MARGIN = (0.7, 1.5)
SPEED_MARGIN = (0.5, 1.25)  # in the same simulations speeds are 0.94 to 1.02 of these
# largest over smallest load of a table at most: below, where friction goes with the load, it is a
# 300th of the largest at most
LOAD_SPAN = 300.0

# relative difference of rolling radii up to which a table counts, which 15 degrees of contact
# angle change by 4 % in shipped cases
SAME_RADIUS = 0.05
DAMAGED = "no traction tables of a bearing, or damaged ones"
INDEX = "temperatures.json"  # its presence marks a file with several temperatures


def contact_law(
    contacts: Sequence[BearingContact], laws: Sequence[TractionLaw]
) -> ContactFriction:
    """Friction of all contacts by a law each, where they are lubricated.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        all contacts, inner then outer, ball by ball
    laws : Sequence[TractionLaw]
        of the contacts

    Returns
    -------
    ContactFriction
        law of the contacts, SI
    """
    groups = _groups(contacts, laws)
    places = np.array([_place(contact) for contact in contacts])

    def evaluate(motion: Array, indices: NDArray[np.int64]) -> Dissipation:
        gradient = np.zeros((indices.size, 4))
        slope = np.zeros((indices.size, 4, 4))
        for members, evaluate_group in groups:
            rows = np.flatnonzero(members[indices])
            if rows.size:
                gradient[rows], slope[rows] = evaluate_group(
                    indices[rows], places[indices[rows]], motion[rows]
                )
        return Dissipation(np.zeros(indices.size), gradient, slope)

    load = np.array(
        [contact.load if contact.conditions is not None else 0.0 for contact in contacts]
    )
    return ContactFriction(
        evaluate=evaluate,
        reference_force=REFERENCE_TRACTION * load,
        is_potential=False,
        has_rolling_resistance=not all(isinstance(law, EllipseLaw) for law in laws),
    )


def _place(contact: BearingContact) -> tuple[float, float, float]:
    """Load [N], entrainment speed [m/s] and rolling radius [m]."""
    c = contact.conditions
    return (0.0, 0.0, 1.0) if c is None else (c.load, c.entrainment_speed, c.radius_x)


def _groups(
    contacts: Sequence[BearingContact], laws: Sequence[TractionLaw]
) -> list[tuple[NDArray[np.bool_], Evaluate]]:
    """Lubricated contacts that are evaluated together: those of one table, those of one kind of
    coefficient.
    """
    kinds: dict[object, list[int]] = {}
    first = first_same(laws)
    for number, (contact, law) in enumerate(zip(contacts, laws, strict=True)):
        if contact.conditions is not None:
            alike = type(law.coefficient) if isinstance(law, EllipseLaw) else first[number]
            kinds.setdefault(alike, []).append(number)
    groups = []
    for indices in kinds.values():
        members = np.zeros(len(contacts), dtype=np.bool_)
        members[indices] = True
        groups.append((members, _evaluation(laws, laws[indices[0]])))
    return groups


def _evaluation(laws: Sequence[TractionLaw], first: TractionLaw) -> Evaluate:
    """Minus the forces and their slopes of some contacts, by number, place and motion, for laws
    like the first.
    """
    if isinstance(first, EllipseLaw):
        kind = type(first.coefficient)
        alike = [
            law if isinstance(law, EllipseLaw) and isinstance(law.coefficient, kind) else first
            for law in laws
        ]
        disc = first.kernel_arguments()[0]
        constants = np.array([law.coefficient.kernel_law for law in alike])
        shapes = np.array([law.shape.constants for law in alike])

        def coefficients(
            indices: NDArray[np.int64], places: Array, motion: Array
        ) -> tuple[Array, Array]:
            result = np.empty((indices.size, 4)), np.empty((indices.size, 4, 4))
            _kernels.hertz_gradients(
                disc, constants[indices], shapes[indices], places, motion, STEP, *result
            )
            return result

        return coefficients
    if isinstance(first, TractionTable):
        arguments = first.kernel_arguments()

        def table(indices: NDArray[np.int64], places: Array, motion: Array) -> tuple[Array, Array]:
            result = np.empty((indices.size, 4)), np.empty((indices.size, 4, 4))
            _kernels.table_gradients(arguments, places, motion, STEP, *result)
            return result

        return table

    def one_by_one(
        indices: NDArray[np.int64], places: Array, motion: Array
    ) -> tuple[Array, Array]:
        pairs = [law_gradient(first, place, k) for place, k in zip(places, motion, strict=True)]
        gradients, slopes = zip(*pairs, strict=True)
        return np.array(gradients), np.array(slopes)

    return one_by_one


def law_gradient(law: TractionLaw, conditions: Array, motion: Array) -> tuple[Array, Array]:
    """Minus the forces and moments on the ball by a law, and their slope by sliding and spin; the
    entrainment is that of the rolling speed.

    Parameters
    ----------
    law : TractionLaw
        of the contact
    conditions : Array
        load [N], entrainment speed [m/s], rolling radius [m], shape (3,)
    motion : Array
        sliding along and across [m/s], spin and rolling [rad/s], shape (4,)

    Returns
    -------
    gradient
        shape (4,) [N], [N m]
    slope
        shape (4, 4) [N s/m]
    """
    load, speed, radius = (float(value) for value in conditions)
    here = np.array(law.forces(load, speed, *(float(part) for part in motion[:3]))[:4])
    slope = np.zeros((4, 4))
    for j, step in enumerate((STEP * speed, STEP * speed, STEP * speed / radius)):
        beside = motion[:3].copy()
        beside[j] += step
        forces = np.array(law.forces(load, speed, *(float(part) for part in beside))[:4])
        slope[:, j] = -(forces - here) / step
    return -here, slope


Progress = Callable[[int, int, str], None]
Tables = dict[Race, TractionTable]
TemperatureTables = dict[Race, TemperatureTable]
OilAt = Callable[[float], tuple[Lubricant, Rheology]]
Solids = tuple[SolidThermal, SolidThermal]


def table_contacts(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    rheology: Rheology,
    temperature: float | None = None,
    solids: Solids | None = None,
) -> dict[Race, TableContact]:
    """Contact that the table of each race is built for: that of its heaviest loaded contact.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    rheology : Rheology
        of the oil
    temperature : float | None, optional
        of the oil [K]; that of operation if left out
    solids : Solids | None, optional
        heat properties of ball and race, for films solved and sheared with heat

    Returns
    -------
    dict[Race, TableContact]
        by race

    Raises
    ------
    ValueError
        if no contact of a race is loaded and entrains oil
    """
    contacts = contact_conditions(solution, lubricant)
    contacts_of_races = {}
    for race in Race:
        lubricated = [c for c in contacts if c.race is race and c.loaded]
        if not lubricated:
            raise ValueError(f"no contact of the {race.value} race is loaded and entrains oil")
        heaviest = max(lubricated, key=lambda contact: contact.load)
        c = heaviest.conditions
        assert c is not None
        motion = bearing_kinematics(solution, heaviest)
        contacts_of_races[race] = TableContact(
            radius_x=c.radius_x,
            radius_y=c.radius_y,
            reduced_modulus=c.reduced_modulus,
            lubricant=lubricant,
            rheology=rheology,
            temperature=solution.operation.temperature if temperature is None else temperature,
            curvature_radius=motion.curvature_radius,
            curvature_difference=motion.curvature_difference,
            solids=solids,
            ball_radius=c.ball_radius,
        )
    return contacts_of_races


def table_range(solution: QuasistaticSolution, lubricant: Lubricant) -> TableRange:
    """Loads and speeds around those of a bearing's contacts, the same for both races.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil

    Returns
    -------
    TableRange
        loads [N] and speeds [m/s]

    Raises
    ------
    ValueError
        if no contact is loaded and entrains oil
    """
    contacts = [c for c in contact_conditions(solution, lubricant) if c.conditions is not None]
    if not contacts:
        raise ValueError(
            "no contact is loaded and entrains oil: there is nothing to make a table for"
        )
    loads = [contact.load for contact in contacts]
    speeds = [c.conditions.entrainment_speed for c in contacts if c.conditions is not None]
    highest = LOAD_MARGIN[1] * max(loads)
    return TableRange(
        load=(max(LOAD_MARGIN[0] * min(loads), highest / LOAD_SPAN), highest),
        speed=(SPEED_MARGIN[0] * min(speeds), SPEED_MARGIN[1] * max(speeds)),
    )


def build_race_tables(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    rheology: Rheology,
    options: TableOptions | None = None,
    progress: Progress | None = None,
    solids: Solids | None = None,
    limits: Callable[[TableRange], TableRange] = lambda usual: usual,
) -> Tables:
    """Traction tables of both races around a quasi-static solution.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    rheology : Rheology
        of the oil
    options : TableOptions | None, optional
        of the tables
    progress : Progress | None, optional
        called with films done, films wanted so far, and a word
    solids : Solids | None, optional
        heat properties of ball and race, for films solved and sheared with heat
    limits : Callable[[TableRange], TableRange], default lambda usual: usual
        gives the range [N], [m/s] to take for that of `table_range`

    Returns
    -------
    Tables
        by race
    """
    chosen = limits(table_range(solution, lubricant))
    tables = {}
    for race, contact in table_contacts(solution, lubricant, rheology, solids=solids).items():
        tables[race] = build_traction_table(
            contact, chosen, options, race_progress(progress, race)
        )
    return tables


def build_temperature_tables(
    solution: QuasistaticSolution,
    oil_at: OilAt,
    temperatures: Sequence[float],
    options: TableOptions | None = None,
    progress: Progress | None = None,
    solids: Solids | None = None,
    limits: Callable[[TableRange], TableRange] = lambda usual: usual,
) -> TemperatureTables:
    """Traction tables of both races at two or more rising temperatures.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    oil_at : OilAt
        gives lubricant and rheology at a temperature
    temperatures : Sequence[float]
        of the oil, rising [K]
    options : TableOptions | None, optional
        of the tables
    progress : Progress | None, optional
        called with films done, films wanted so far, and a word
    solids : Solids | None, optional
        heat properties of ball and race, for films solved and sheared with heat
    limits : Callable[[TableRange], TableRange], default lambda usual: usual
        gives the range [N], [m/s] to take for that of `table_range`

    Returns
    -------
    TemperatureTables
        by race
    """
    chosen = limits(table_range(solution, oil_at(temperatures[0])[0]))
    tables = {}
    for race in Race:

        def contact_at(temperature: float, race: Race = race) -> TableContact:
            return table_contacts(solution, *oil_at(temperature), temperature, solids)[race]

        notify = race_progress(progress, race)
        tables[race] = build_temperature_table(contact_at, temperatures, chosen, options, notify)
    return tables


def race_progress(progress: Progress | None, race: Race) -> Progress:
    """A progress whose state begins with the race; it does nothing where there is none.

    Parameters
    ----------
    progress : Progress | None
        called with films done, films wanted so far, and a word
    race : Race
        inner or outer race

    Returns
    -------
    Progress
        the progress of one race
    """

    def notify(done: int, total: int, state: str) -> None:
        if progress is not None:
            progress(done, total, f"{race.value} race: {state}")

    return notify


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
    entries = {f"{race.value}.npz": _bytes(table) for race, table in tables.items()}
    write_bytes(path, entries_as_bytes(entries))


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
            "errors": as_document(series.errors, {}),
        }
        for number, table in enumerate(series.tables):
            entries[f"{race.value}_{number}.npz"] = _bytes(table)
    write_bytes(path, entries_as_bytes(entries | {INDEX: json.dumps(index)}))


def _bytes(table: TractionTable) -> bytes:
    stream = io.BytesIO()
    write_table(table, stream)
    return stream.getvalue()


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
    with open_file(path) as stream:
        entries = entries_of(stream, str(path), DAMAGED)
    try:
        if INDEX in entries:
            index = json.loads(entries[INDEX])
            return {race: _temperature_table(entries, path, race, index) for race in Race}
        return {race: _table(entries, path, race.value) for race in Race}
    except DAMAGE as problem:
        if str(path) in str(problem):  # of a table in it, which says what is wrong
            raise
        raise ValueError(f"{path}: {DAMAGED}") from problem


def _table(entries: dict[str, bytes], path: Path, name: str) -> TractionTable:
    return read_table(io.BytesIO(entries[f"{name}.npz"]), str(path))


def _temperature_table(
    entries: dict[str, bytes], path: Path, race: Race, index: dict[str, Any]
) -> TemperatureTable:
    names, errors = index[race.value]["tables"], index[race.value]["errors"]
    return TemperatureTable(
        tables=tuple(_table(entries, path, f"{race.value}_{k}") for k in range(names)),
        errors=from_document(errors, tuple[TableError, ...], {}),
    )

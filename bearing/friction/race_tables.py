"""Traction tables of a bearing's two races, at one temperature of the oil or at several.

The rolling radius of a race changes little from ball to ball with the contact angle: the table
takes that of its heaviest loaded contact. Loads reach from below the lightest ball (which carries
its centrifugal force only) to above the heaviest one at either race, speeds from half to 1.25
times the entrainment speeds of the case.
"""

from collections.abc import Callable, Sequence

from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology
from ehl.solid.heat import SolidThermal
from ehl.traction_table.build import TableOptions, build_table
from ehl.traction_table.table import TableContact, TableRange, TractionTable
from ehl.traction_table.temperature import TemperatureTable, build_temperature_table

from ..contacts.contacts import contact_conditions
from ..contacts.motion import bearing_kinematics
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution

# below the lightest and above the heaviest contact; in a simulation of 7008_combined 99.8 % of the
# loads lie within, in one of 7008_axial all (from 0.99 of the lightest to 1.01 of the heaviest)
LOAD_MARGIN = (0.7, 1.5)
SPEED_MARGIN = (0.5, 1.25)  # in the same simulations speeds are 0.94 to 1.02 of these
# largest over smallest load of a table at most: below, where friction goes with the load, it is a
# 300th of the largest at most
LOAD_SPAN = 300.0
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
        tables[race] = build_table(contact, chosen, options, race_progress(progress, race))
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

"""[friction] traction: friction of balls on races, from films, a law, or tables in a file."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import isclose
from pathlib import Path
from typing import Any

from oilfilm.bearing.friction.contact_friction import BallTraction, FrictionSource
from oilfilm.bearing.friction.friction_sources import (
    CoefficientTraction,
    CoulombTraction,
    FilmTraction,
    LawTraction,
)
from oilfilm.bearing.friction.tables import SAME_RADIUS, Solids, Tables, load_tables
from oilfilm.bearing.geometry import Bearing, contact_modulus, reduced_radii
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.skf import InletFactors
from oilfilm.ehl import Lubricant
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.traction.friction_coefficients import COEFFICIENTS
from oilfilm.ehl.traction_table.table import TractionTable
from oilfilm.ehl.traction_table.temperature import TemperatureTable

from .film_model import CaseFilms, FilmPhysics
from .friction import FrictionTable, made_by
from .rules import InvalidKeyError
from .shipped import table_path

# along x of the films that traction is taken from, at most [-]; friction of the inner race of a
# 6208 at 500 N and 2 % slide is 0.2 % from that of 257 (65: 1.4 %)
FILM_POINTS = 129

SAME_RTOL = 1.0e-6  # relative difference up to which a table is for this bearing [-]


def ball_traction(
    table: FrictionTable,
    friction: FrictionInput,
    bearing: Bearing,
    oil: Lubricant,
    speed: float,
    films: CaseFilms,
    inlet: InletFactors,
) -> BallTraction:
    """Friction of balls on races and drag on the balls.

    Parameters
    ----------
    table : FrictionTable
        The checked table [friction].
    friction : FrictionInput
        Inputs of the friction models.
    bearing : Bearing
        The bearing.
    oil : Lubricant
        The lubricant.
    speed : float
        Of the rings against each other [rad/s].
    films : CaseFilms
        Films of the case.
    inlet : InletFactors
        Factors of the rolling moment at the inlets [-].

    Returns
    -------
    BallTraction
        The friction, SI.

    Raises
    ------
    InvalidKeyError
        If a file of tables cannot be read, or is of another bearing or oil.
    """
    source = _law(table, bearing, oil, films.films) or _films(friction, films)
    return resisted_traction(source, friction, bearing, oil, speed, inlet)


def resisted_traction(
    source: FrictionSource,
    friction: FrictionInput,
    bearing: Bearing,
    oil: Lubricant,
    speed: float,
    inlet: InletFactors,
) -> BallTraction:
    """A law of friction with drag, cage and the reduced rolling moment of the inlets.

    Parameters
    ----------
    source : FrictionSource
        The law.
    friction : FrictionInput
        Inputs of the friction models.
    bearing : Bearing
        The bearing.
    oil : Lubricant
        The lubricant.
    speed : float
        Of the rings against each other [rad/s].
    inlet : InletFactors
        Factors of the rolling moment at the inlets [-].

    Returns
    -------
    BallTraction
        The friction, SI.
    """
    if isinstance(source, FilmTraction):
        solved = replace(friction, supply=None)  # whose layers the films were solved behind
        supply = solved.oil_at_inlets(inlet, bearing.balls)
        source = replace(source, supply=supply, hysteresis=friction.hysteresis_loss)
    if isinstance(source, LawTraction):  # of tables, whose films are isothermal
        source = replace(source, rolling_factor=inlet.rolling)
    resistance = friction.resistance(bearing, oil, speed)
    return BallTraction(source=source, lubricant=oil, resistance=resistance)


def _law(
    table: FrictionTable, bearing: Bearing, oil: Lubricant, films: FilmPhysics
) -> FrictionSource | None:
    """The law that [friction] names; None where it takes films."""
    if table.traction == "coulomb":
        assert table.coefficient is not None  # checked before
        return CoulombTraction(friction=table.coefficient)
    if table.traction == "table":
        assert table.traction_table is not None and films.rheology is not None  # checked before
        path = table_path(table.traction_table)
        try:
            tables = read_race_tables(path, bearing, oil, films.rheology, films.solids)
        except ValueError as error:
            key = ("friction", "traction_table")
            raise InvalidKeyError(key, str(error), made_by(table.traction_table)) from None
        return LawTraction(laws=dict(tables))
    return coefficient_source(table.traction, dict(table))


def coefficient_source(
    name: str | None, constants: Mapping[str, Any]
) -> CoefficientTraction | None:
    """The coefficient over the contact ellipse of a name.

    Parameters
    ----------
    name : str | None
        Name of the law.
    constants : Mapping[str, Any]
        Constants of [friction] by key [-].

    Returns
    -------
    CoefficientTraction | None
        The law; None for another kind of law.
    """
    law = COEFFICIENTS.get(name or "")
    return None if law is None else CoefficientTraction(law.of_case(constants))


def _films(friction: FrictionInput, films: CaseFilms) -> FilmTraction:
    """Films on a coarser grid than those of the results."""
    points = min(films.options.max_points, FILM_POINTS)
    options = replace(films.options, points=points, tolerance=None)
    rheology = films.films.rheology
    assert rheology is not None  # of every bearing case
    solve = replace(films, options=options)
    return FilmTraction(solve=solve, rheology=rheology, asperities=friction.asperities)


def read_race_tables(
    path: Path, bearing: Bearing, oil: Lubricant, rheology: Rheology, solids: Solids | None = None
) -> Tables:
    """Read the tables of both races for a bearing, an oil and its shear law.

    Parameters
    ----------
    path : Path
        The file.
    bearing : Bearing
        The bearing.
    oil : Lubricant
        The lubricant.
    rheology : Rheology
        Shear law of the oil.
    solids : Solids | None, optional
        Thermal properties of ball and race, of a case with heat.

    Returns
    -------
    Tables
        Tables of both races.

    Raises
    ------
    ValueError
        If the file is damaged, or of another bearing or oil.
    """
    tables = tables_of_file(path)(oil)
    return require_fitting_tables(tables, str(path), bearing, oil, rheology, solids)


def tables_of_file(path: Path) -> Callable[[Lubricant], Tables]:
    """Read a file of traction tables once.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Callable[[Lubricant], Tables]
        Function of an oil that gives the tables; ValueError for another oil.

    Raises
    ------
    ValueError
        If the file cannot be read.
    """
    try:
        read = load_tables(path)
    except OSError as error:
        raise ValueError(f"{path} cannot be read: {error.strerror or error}") from None

    def tables_at(oil: Lubricant) -> Tables:
        try:
            return {race: _at(table, oil) for race, table in read.items()}
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from error

    return tables_at


def _at(stored: TractionTable | TemperatureTable, oil: Lubricant) -> TractionTable:
    """The table at the temperature of an oil."""
    if isinstance(stored, TractionTable):
        return stored
    if oil.temperature is None:
        raise ValueError("has tables at several temperatures, and the lubricant has none")
    return stored.at(oil.temperature, oil)


def require_fitting_tables(
    tables: Tables,
    name: str,
    bearing: Bearing,
    oil: Lubricant,
    rheology: Rheology,
    solids: Solids | None = None,
) -> Tables:
    """Check that tables are of a bearing and an oil.

    Tables with heat must be of the ball and race of a case with heat; a case without leaves that
    to its tables. Balls may roll at any angle up to the free one, which the clearance changes.

    Parameters
    ----------
    tables : Tables
        Tables of both races.
    name : str
        Name of the tables in messages.
    bearing : Bearing
        The bearing.
    oil : Lubricant
        The lubricant.
    rheology : Rheology
        Shear law of the oil.
    solids : Solids | None, optional
        Thermal properties of ball and race, of a case with heat.

    Returns
    -------
    Tables
        The same tables.

    Raises
    ------
    ValueError
        If they are of another bearing or oil.
    """
    for race, table in tables.items():
        contact = table.contact
        angles = (0.0, bearing.free_contact_angle)
        radii = [reduced_radii(bearing, race, angle) for angle in angles]
        radius_y = radii[0][1]
        nearest = min(max(contact.radius_x, min(radii)[0]), max(radii)[0])
        modulus = contact_modulus(bearing, race)
        isothermal = contact.solids is None  # heat properties of the oil do not count
        cold = replace(contact.lubricant, thermal=None)
        fitting = {
            "oil": contact.lubricant == oil or (isothermal and cold == replace(oil, thermal=None)),
            "shear law": contact.rheology == rheology,
            "moduli": isclose(contact.reduced_modulus, modulus, rel_tol=SAME_RTOL),
            "groove": isclose(contact.radius_y, radius_y, rel_tol=SAME_RTOL),
            "rolling radius": isclose(contact.radius_x, nearest, rel_tol=SAME_RADIUS),
            "thermal properties": None in (contact.solids, solids) or contact.solids == solids,
        }
        wrong = ", ".join(what for what, fits in fitting.items() if not fits)
        if wrong:
            raise ValueError(f"{name} is for another bearing or oil ({race.value} race: {wrong})")
    return tables

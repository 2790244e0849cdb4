"""[friction] traction: friction of balls on races in traction equilibrium."""

from dataclasses import replace
from pathlib import Path

from bearing.friction.films import Asperities
from bearing.friction.law import BallTraction, TractionLaw
from bearing.friction.resistance import resistance_of
from bearing.friction.sources import (
    CoulombTraction,
    FilmTraction,
    FourConstantTraction,
    LawTraction,
)
from bearing.geometry import Bearing
from bearing.torque.inputs import FrictionInput
from ehl import Lubricant
from ehl.traction.laws import four_constants

from .film_model import CaseFilms, FilmPhysics
from .friction import FOUR_CONSTANTS, FrictionTable
from .problems import UnfitKey
from .race_tables import read_race_tables

FILM_POINTS = 129  # along x of the films that traction is taken from, at most [-]


def ball_traction(
    table: FrictionTable,
    friction: FrictionInput,
    bearing: Bearing,
    oil: Lubricant,
    films: CaseFilms,
) -> BallTraction:
    """Friction of balls on races and drag on the balls, SI.

    Raises
    ------
    ValueError
        If the file of a table cannot be read, or was made for another bearing or oil.
    """
    resistance = resistance_of(
        friction.cage, bearing, oil.viscosity, oil.density, friction.oil_fraction
    )
    source = _law(table, bearing, oil, films.films) or _films(friction, films)
    return BallTraction(source=source, lubricant=oil, resistance=resistance)


def _law(
    table: FrictionTable, bearing: Bearing, oil: Lubricant, films: FilmPhysics
) -> TractionLaw | None:
    """The law that [friction] names; None where it takes films."""
    if table.traction == "coulomb":
        assert table.coefficient is not None  # checked before
        return CoulombTraction(friction=table.coefficient)
    if table.traction == "four constants":
        constants = (getattr(table, name) for name in FOUR_CONSTANTS)
        return FourConstantTraction(constants=four_constants(*constants))
    if table.traction == "table":
        assert table.traction_table is not None and films.rheology is not None  # checked before
        path = Path(table.traction_table)
        try:
            tables = read_race_tables(path, bearing, oil, films.rheology, films.solids)
        except ValueError as error:
            raise UnfitKey(("friction", "traction_table"), str(error)) from None
        return LawTraction(laws=dict(tables))
    return None


def _films(friction: FrictionInput, films: CaseFilms) -> FilmTraction:
    """Films on a coarser grid than those of the results."""
    points = min(films.options.points, FILM_POINTS)
    options = replace(films.options, points=points, tolerance=None)
    asperities = None
    if friction.roughness is not None:
        inner, outer = friction.roughness
        asperities = Asperities(
            inner_roughness=inner, outer_roughness=outer, boundary=friction.boundary
        )
    assert films.films.rheology is not None  # of every bearing case
    return FilmTraction(
        solve=replace(films, options=options), rheology=films.films.rheology, asperities=asperities
    )

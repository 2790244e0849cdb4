"""[friction] traction: where traction equilibrium takes the friction of balls on races from."""

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
from ehl import Lubricant
from ehl.oil.rheology import Rheology
from ehl.traction.laws import four_constants

from ..format.film_model import FilmPhysics
from ..format.problems import UnfitKey
from ..runs.race_tables import read_race_tables
from ..schema.files import BearingFile
from .contact import solver_options
from .friction import friction
from .operation import TRACTION_EQUILIBRIUM, kinematics_name

FILM_POINTS = 129  # along x of the films that traction is taken from, at most [-]


def ball_traction(
    file: BearingFile, bearing: Bearing, oil: Lubricant, rheology: Rheology, films: FilmPhysics
) -> BallTraction | None:
    """Friction of balls on races and drag on the balls, SI; None where the case asks for neither.

    Raises
    ------
    ValueError
        If the file of a table cannot be read, or was made for another bearing or oil.
    """
    if file.friction.traction is None and kinematics_name(file) != TRACTION_EQUILIBRIUM:
        return None
    asked = friction(file)
    resistance = resistance_of(asked.cage, bearing, oil.viscosity, oil.density, asked.oil_fraction)
    return BallTraction(
        source=_source(file, bearing, oil, rheology, films), lubricant=oil, resistance=resistance
    )


def _source(
    file: BearingFile, bearing: Bearing, oil: Lubricant, rheology: Rheology, films: FilmPhysics
) -> TractionLaw:
    table = file.friction
    if table.traction == "coulomb":
        assert table.coefficient is not None  # checked before
        return CoulombTraction(friction=table.coefficient)
    if table.traction == "four constants":
        largest = table.traction_maximum
        slide = table.traction_maximum_slide
        limit = table.traction_limit
        assert largest is not None and slide is not None and limit is not None  # checked before
        return FourConstantTraction(constants=four_constants(largest, slide, limit))
    if table.traction == "table":
        assert table.traction_table is not None  # checked before
        try:
            tables = read_race_tables(
                Path(table.traction_table), bearing, oil, rheology, films.solids
            )
        except ValueError as problem:
            raise UnfitKey(("friction", "traction_table"), str(problem)) from None
        return LawTraction(laws=dict(tables))
    from ..runs.traction_films import FilmSolver

    options = solver_options(file.ehl)
    options = replace(options, points=min(options.points, FILM_POINTS), tolerance=None)
    asked = friction(file)
    asperities = None
    if asked.roughness is not None:
        inner, outer = asked.roughness
        asperities = Asperities(
            inner_roughness=inner, outer_roughness=outer, boundary=asked.boundary
        )
    return FilmTraction(
        solve=FilmSolver(options=options, films=films), rheology=rheology, asperities=asperities
    )

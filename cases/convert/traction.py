"""[friction] traction: where traction equilibrium takes the friction of balls on races from."""

from __future__ import annotations

from dataclasses import replace
from math import isclose
from pathlib import Path
from typing import TYPE_CHECKING

from ..schema import BearingFile
from .contact import solver_options
from .friction import friction
from .operation import TRACTION_EQUILIBRIUM, kinematics_name

if TYPE_CHECKING:
    from bearing.geometry import Bearing
    from bearing.torque.traction_source import BallTraction, TractionSource
    from bearing.traction_tables import Tables
    from ehl import Lubricant
    from ehl.rheology import Rheology

    from ..film_model import FilmPhysics

FILM_POINTS = 129  # along x of the films that traction is taken from, at most [-]
NEAR = 1.0e-6  # relative difference up to which a table is for this bearing [-]
NEAR_RADIUS = 0.05  # the same of the rolling radius, which goes with the contact angle [-]


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
    from bearing.torque.resistance import resistance_of
    from bearing.torque.traction_source import BallTraction

    asked = friction(file)
    resistance = resistance_of(asked.cage, bearing, oil.viscosity, oil.density, asked.oil_fraction)
    return BallTraction(source=_source(file, bearing, oil, rheology, films), lubricant=oil, resistance=resistance)


def _source(
    file: BearingFile, bearing: Bearing, oil: Lubricant, rheology: Rheology, films: FilmPhysics
) -> TractionSource:
    from bearing.torque.traction_source import CoulombTraction, FilmTraction, FourConstantTraction, LawTraction

    table = file.friction
    if table.traction == "coulomb":
        assert table.coefficient is not None  # checked before
        return CoulombTraction(friction=table.coefficient)
    if table.traction == "four constants":
        from ehl.traction.laws import four_constants

        largest, slide, limit = table.traction_maximum, table.traction_maximum_slide, table.traction_limit
        assert largest is not None and slide is not None and limit is not None  # checked before
        return FourConstantTraction(constants=four_constants(largest, slide, limit))
    if table.traction == "table":
        assert table.traction_table is not None  # checked before
        return LawTraction(laws=dict(_tables(Path(table.traction_table), bearing, oil, rheology)))
    from bearing.torque.integrated import Asperities

    from ..traction_films import FilmSolver

    options = solver_options(file.ehl)
    options = replace(options, points=min(options.points, FILM_POINTS), tolerance=None)
    asked, asperities = friction(file), None
    if asked.roughness is not None:
        inner, outer = asked.roughness
        asperities = Asperities(inner_roughness=inner, outer_roughness=outer, boundary=asked.boundary)
    return FilmTraction(solve=FilmSolver(options=options, films=films), rheology=rheology, asperities=asperities)


def _tables(path: Path, bearing: Bearing, oil: Lubricant, rheology: Rheology) -> Tables:
    """Tables of both races from a file, if they are for this bearing and oil."""
    from bearing.geometry import contact_modulus, reduced_radii
    from bearing.traction_tables import load_race_tables

    try:
        tables = load_race_tables(path, oil=oil)
    except OSError as problem:
        raise ValueError(f"friction.traction_table: {path} cannot be read: {problem.strerror or problem}") from None
    for race, found in tables.items():
        contact = found.contact
        radius_x, radius_y = reduced_radii(bearing, race, bearing.free_contact_angle)
        wrong = [
            name
            for name, fits in (
                ("oil", contact.lubricant == oil),
                ("shear law", contact.rheology == rheology),
                ("moduli", isclose(contact.reduced_modulus, contact_modulus(bearing, race), rel_tol=NEAR)),
                ("groove", isclose(contact.radius_y, radius_y, rel_tol=NEAR)),
                ("rolling radius", isclose(contact.radius_x, radius_x, rel_tol=NEAR_RADIUS)),
            )
            if not fits
        ]
        if wrong:
            raise ValueError(f"friction.traction_table: {path} was made for another {wrong[0]} ({race.value} race)")
    return tables

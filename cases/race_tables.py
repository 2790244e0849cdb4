"""Traction tables of both races from a file, refused unless they were made for the bearing and oil that take them."""

from __future__ import annotations

from math import isclose
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bearing.geometry import Bearing
    from bearing.traction_tables import Tables
    from ehl import Lubricant
    from ehl.rheology import Rheology
    from ehl.thermal.solids import SolidThermal

    Solids = tuple[SolidThermal, SolidThermal]  # ball and race

NEAR = 1.0e-6  # relative difference up to which a table is for this bearing [-]
NEAR_RADIUS = 0.05  # the same of the rolling radius, which goes with the contact angle [-]


def read_race_tables(
    path: Path, bearing: Bearing, oil: Lubricant, rheology: Rheology, solids: Solids | None = None
) -> Tables:
    """Tables of both races for a bearing, an oil and the law by which it shears; with heat, for `solids`.

    Raises
    ------
    ValueError
        If the file cannot be read, is damaged, or was made for another bearing or oil; the message begins with its
        name.
    """
    from bearing.traction_tables import load_race_tables

    try:
        tables = load_race_tables(path, oil=oil)
    except OSError as problem:
        raise ValueError(f"{path} cannot be read: {problem.strerror or problem}") from None
    return made_for(tables, str(path), bearing, oil, rheology, solids)


def made_for(
    tables: Tables, name: str, bearing: Bearing, oil: Lubricant, rheology: Rheology, solids: Solids | None = None
) -> Tables:
    """The tables themselves, `name` in messages, if they were made for this bearing and oil; else ValueError.

    Tables with heat must be of the ball and race of a case with heat; a case without leaves that to its tables.
    """
    from bearing.geometry import contact_modulus, reduced_radii

    for race, found in tables.items():
        contact = found.contact
        radius_x, radius_y = reduced_radii(bearing, race, bearing.free_contact_angle)
        fitting = {
            "oil": contact.lubricant == oil,
            "shear law": contact.rheology == rheology,
            "moduli": isclose(contact.reduced_modulus, contact_modulus(bearing, race), rel_tol=NEAR),
            "groove": isclose(contact.radius_y, radius_y, rel_tol=NEAR),
            "rolling radius": isclose(contact.radius_x, radius_x, rel_tol=NEAR_RADIUS),
            "thermal properties": None in (contact.solids, solids) or contact.solids == solids,
        }
        wrong = [what for what, fits in fitting.items() if not fits]
        if wrong:
            raise ValueError(f"{name} was made for another bearing or oil ({race.value} race: {', '.join(wrong)})")
    return tables

"""[cage]: its friction for the torque, its body for the time simulation."""

from collections.abc import Iterator
from typing import Literal

from bearing.friction.resistance import Cage
from bearing.geometry import Race

from .fields import LENGTH_MAXIMUM, Table, above, between, described
from .problems import MISSING, CaseFault
from .rules import CaseValues


class CageTable(Table):
    """The cage."""

    pocket_friction: float | None = between(
        0.0, 1.0, "Coulomb's mu of ball against pocket; left out, no friction of the cage"
    )
    guided_by: Literal["balls", "inner ring", "outer ring"] = described(
        "balls", "what the cage runs on"
    )
    land_diameter_mm: float | None = above(0.0, LENGTH_MAXIMUM, "of the guiding land")
    land_width_mm: float | None = above(0.0, LENGTH_MAXIMUM, "of both lands together")
    land_clearance_um: float | None = above(0.0, 1.0e4, "radial, between cage and land")
    land_friction: float = between(
        0.0,
        1.0,
        "Coulomb's mu where the film of the land is used up; for the dynamics",
        default=0.0,
    )
    pocket_clearance_mm: float | None = above(
        0.0, 100.0, "diametral, pocket less ball; for the dynamics, estimated if left out"
    )
    thickness_mm: float | None = above(
        0.0, LENGTH_MAXIMUM, "radial; for the dynamics, estimated if left out"
    )
    width_mm: float | None = above(
        0.0, LENGTH_MAXIMUM, "axial; for the dynamics, estimated if left out"
    )
    mass_g: float | None = above(0.0, 1.0e6, "for the dynamics; left out, from the dimensions")
    polar_inertia_g_mm2: float | None = above(
        0.0, 1.0e15, "about the bearing's axis, for the dynamics; left out, from the dimensions"
    )


LAND = ("land_diameter_mm", "land_width_mm", "land_clearance_um")
RACES = {"inner ring": Race.INNER, "outer ring": Race.OUTER}


def cage_faults(values: CaseValues) -> Iterator[CaseFault]:
    """A cage that a ring guides has a land, where its friction or its motion is computed."""
    used = values.given("cage", "pocket_friction") or values.given("dynamics")
    if not used or values.get("cage", "guided_by") not in RACES:
        return
    for name in LAND:
        if not values.given("cage", name):
            allowed = "needed where a ring guides the cage"
            yield CaseFault(path=("cage", name), found=MISSING, allowed=allowed)


def cage_friction(table: CageTable | None) -> Cage | None:
    """Friction of the cage [m]; None without a pocket's coefficient."""
    if table is None or table.pocket_friction is None:
        return None
    si = table.si()
    lands = ("land_diameter", "land_width", "land_clearance")
    return Cage(
        pocket_friction=table.pocket_friction,
        outer_guided=table.guided_by == "outer ring",
        **{name: si[name] if table.guided_by in RACES else None for name in lands},
    )


def guiding_land(table: CageTable | None) -> tuple[Race, float] | None:
    """The race that guides the cage, with the diameter of its land [m]; None where balls do."""
    if table is None or table.guided_by not in RACES or table.land_diameter_mm is None:
        return None
    return RACES[table.guided_by], table.si()["land_diameter"]

"""Contacts of catalogue bearings under rising load, for the verification of their films."""

from bearing import contact_conditions, solve_quasistatic
from bearing.library.bearings import list_bearings
from verification.bearings import CatalogueContact

from ..format.case import Case, case_from_text

# a deep groove bearing of every size of ball, and the others
FEW = ("6205",)
LEFT_OUT = ("6208 full ceramic",)  # that of 6208, of another material
COUNT = 20
LOADS = (0.2, 1.5, 5.0)  # radial, over Z D^2 [N/mm^2]: 2, 12 and 40 % of ISO 76's static rating
SPEED = 3.0e5  # rotational speed times pitch diameter [mm/min]
CASE = """
schema_version = 1
[bearing]
name = "{name}"
ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 68"
[operation]
inner_speed_rpm = {speed}
radial_load_N = {load}
temperature_C = 70.0
"""


def catalogue_contacts(few: bool) -> list[list[CatalogueContact]]:
    """The heaviest contacts of 20 catalogue bearings, or of a few, by bearing and race; in each
    list that of one load after the other.
    """
    names = [name for name in list_bearings() if name not in LEFT_OUT]
    chosen = FEW if few else names[:: max(1, len(names) // COUNT)][:COUNT]
    return [group for name in chosen for group in _of_bearing(name)]


def _of_bearing(name: str) -> list[list[CatalogueContact]]:
    found = [_heaviest(name, load) for load in LOADS]
    return [list(race) for race in zip(*found, strict=True)]


def _heaviest(name: str, load: float) -> list[CatalogueContact]:
    """Heaviest contact of each race under a load over Z D^2 [N/mm^2]."""
    size = _case(name, 1.0, 1.0).bearing
    speed = SPEED / (1e3 * size.pitch_diameter)
    case = _case(name, speed, load * size.balls * (1e3 * size.ball_diameter) ** 2)
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contacts = [c for c in contact_conditions(state, case.lubricant) if c.conditions is not None]
    heaviest = []
    for race in dict.fromkeys(c.race for c in contacts):
        contact = max((c for c in contacts if c.race is race), key=lambda c: c.load)
        assert contact.conditions is not None
        heaviest.append(
            CatalogueContact(bearing=name, race=race.value, conditions=contact.conditions)
        )
    return heaviest


def _case(name: str, speed: float, load: float) -> Case:
    case = case_from_text(CASE.format(name=name, speed=speed, load=load), name)
    assert isinstance(case, Case)
    return case

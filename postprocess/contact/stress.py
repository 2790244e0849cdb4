"""Stress, sliding and truncation of contacts in the summary."""

from collections.abc import Iterator

from bearing.contacts.contact import BearingContact
from bearing.contacts.stress import contact_stress
from bearing.quasistatic.solution import QuasistaticSolution
from ehl.units import GIGAPASCAL, MILLIMETRE

from ..results import BearingResults
from ..text import listed

STRESS_KEYS = (
    "mean_pressure_GPa",
    "shear_maximum_GPa",
    "shear_maximum_depth_mm",
    "orthogonal_shear_GPa",
    "orthogonal_shear_depth_mm",
    "sliding_speed_maximum_m_s",
    "pressure_sliding_maximum_GPa_m_s",
)
SHOULDER_KEYS = (
    "shoulder_margin_mm",
    "truncated_length_share",
    "truncated_load_share",
    "pressure_at_shoulder_GPa",
)


def stress_values(state: QuasistaticSolution, contact: BearingContact) -> dict[str, float | None]:
    """Stresses [GPa], depths [mm], sliding speed [m/s] of a contact; None where it is unloaded or
    no shoulder given.
    """
    found: dict[str, float | None] = dict.fromkeys((*STRESS_KEYS, *SHOULDER_KEYS))
    stress = contact_stress(state, contact)
    if stress is None:
        return found
    values = (
        stress.mean_pressure / GIGAPASCAL,
        stress.shear_maximum / GIGAPASCAL,
        stress.shear_depth / MILLIMETRE,
        stress.orthogonal_shear / GIGAPASCAL,
        stress.orthogonal_depth / MILLIMETRE,
        stress.sliding_speed,
        stress.pressure_sliding / GIGAPASCAL,
    )
    found |= dict(zip(STRESS_KEYS, values, strict=True))
    if stress.truncation is not None:
        cut = stress.truncation
        shoulder = (
            cut.margin / MILLIMETRE,
            cut.length_share,
            cut.load_share,
            cut.edge_pressure / GIGAPASCAL,
        )
        found |= dict(zip(SHOULDER_KEYS, shoulder, strict=True))
    return found


def stress_messages(results: BearingResults) -> Iterator[str]:
    """Ellipses that a shoulder cuts, and rings without a shoulder diameter."""
    bearing = results.quasistatic.bearing
    for race in ("inner", "outer"):
        if getattr(bearing, f"{race}_shoulder_diameter") is None:
            yield f"contacts: shoulder and truncation null at the {race} race, no {race}_shoulder_diameter_mm is given"
            continue
        cut: dict[str, float] = {}
        for contact in results.contacts:
            values = stress_values(results.quasistatic, contact)
            share = values["truncated_length_share"]
            if contact.race.value == race and share:
                cut[str(contact.ball)] = share
        if cut:
            yield (
                f"contacts: the shoulder of the {race} ring cuts the ellipse of ball{'s' if len(cut) > 1 else ''} "
                f"{listed(list(cut))}, up to {max(cut.values()):.1%} of its length; the pressure at its edge is "
                "higher than Hertz' and films there are not those of a whole ellipse"
            )

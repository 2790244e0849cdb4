"""Strength of the rings of a case, and the tension in the surfaces of its contacts."""

from collections.abc import Sequence

from bearing.contacts.motion import ContactTraction
from bearing.contacts.stress import SurfaceTension, surface_tensions
from bearing.fits.ring_strength import Strength, ring_strengths, strength_map
from ehl import ContactSolution

from ..format.case import Case


def case_strength(case: Case) -> Strength:
    """Hoop tension of the rings; of a brittle inner ring on a shaft also over temperature and
    speed.

    Parameters
    ----------
    case : Case
        The bearing.

    Returns
    -------
    Strength
        Tensions and strengths.
    """
    rings = ring_strengths(case.bearing, case.operation, case.clearance)
    seats = case.seats
    brittle = case.bearing.inner_ring_material.bending_strength is not None
    if seats.fit is None or not brittle:
        return Strength(rings=rings)
    inner = strength_map(case.bearing, case.operation, seats.fit, seats.rise, seats.reference)
    return Strength(rings=rings, inner_map=inner)


def contact_tensions(
    case: Case,
    solutions: Sequence[ContactSolution | None],
    tractions: Sequence[ContactTraction | None],
) -> tuple[SurfaceTension | None, ...]:
    """Tension in the surfaces of the contacts that have films and a brittle body.

    Parameters
    ----------
    case : Case
        The bearing.
    solutions : Sequence[ContactSolution | None]
        Solved films of the contacts.
    tractions : Sequence[ContactTraction | None]
        Shear of the contacts.

    Returns
    -------
    tuple[SurfaceTension | None, ...]
        The tensions; None without film or brittle body.
    """
    if case.rheology is None:
        return ()
    rings = ring_strengths(case.bearing, case.operation, case.clearance)
    hoop = Strength(rings=rings).groove_tension()
    temperature = case.operation.temperature
    return surface_tensions(case.bearing, solutions, tractions, case.rheology, hoop, temperature)

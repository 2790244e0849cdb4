"""The contact nearest to one that the atlas does not cover."""

from dataclasses import replace
from math import log

from ...conditions import ContactConditions
from ...scaling import scale_contact
from .films import (
    RANGE,
    NotInAtlasError,
    atlas_load,
    oil_numbers,
    require_covered,
    require_range,
    skewed,
)
from .oils import with_inlet_oil
from .table import LIGHT
from .turning import rotation_law

EDGE = 1e-9  # within a range [-]


def nearest_covered(conditions: ContactConditions) -> tuple[ContactConditions | None, float]:
    """Search the nearest contact that the atlas covers: another load, pressure-viscosity and z.

    Parameters
    ----------
    conditions : ContactConditions
        flooded contact

    Returns
    -------
    contact
        nearest contact; None if these do not bring it into the range
    distance
        |ln(A/A')| + |ln(L/L')| + |z - z'| [-]
    """
    standing = with_inlet_oil(conditions)
    assert isinstance(standing, ContactConditions)
    contact = scale_contact(standing)
    if skewed(conditions.entrainment_angle):
        return None, 0.0
    load = atlas_load(contact)
    wanted = _nearest("A = a^2/(Rx^2 sqrt(2U))", load)
    slim = rotation_law(wanted, contact.radius_ratio)
    if slim is not None and contact.turning > slim.largest:
        wanted = max(wanted, LIGHT)
    # 1. the oil; that of an isoviscous one does not count
    alpha, z = oil_numbers(standing.lubricant)
    thick = _nearest("L", contact.moes_lubricant)
    rise = _nearest("roelands_z", z)
    way = abs(log(load / wanted)) + abs(z - rise)
    oil = standing.lubricant
    if rise != z:
        oil = replace(oil, roelands_z=rise)
    if thick != contact.moes_lubricant:
        alpha *= thick / contact.moes_lubricant
        oil = replace(oil, pressure_viscosity=alpha, roelands_z=rise)
        way += abs(log(contact.moes_lubricant / thick))
    # 2. check that the change brings it into the range
    nearest = replace(standing, load=conditions.load * (wanted / load) ** 1.5, lubricant=oil)
    try:
        require_covered(nearest, contact, wanted)
        require_range((wanted, thick, contact.radius_ratio, rise, alpha))
    except NotInAtlasError:
        return None, 0.0
    return (nearest, way) if way else (conditions, 0.0)


def _nearest(name: str, value: float) -> float:
    """Clip a value to the range, a little within it, so that rounding does not leave it."""
    low, high = RANGE[name]
    if low <= value <= high:
        return value
    return low * (1.0 + EDGE) if value < low else high * (1.0 - EDGE)

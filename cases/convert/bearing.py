"""[bearing], [fit] and [temperatures]."""

from dataclasses import replace
from math import radians

from bearing.fits.clearance import (
    CageClearance,
    ClearanceBudget,
    Fit,
    TemperatureRise,
    cage_clearance,
    clearance_budget,
)
from bearing.geometry import Bearing, Race, contact_angle_to_clearance
from bearing.operation import Operation, RatingInput

from ..schema.bearing import BearingTable
from ..schema.files import BearingFile
from .materials import materials, ring_materials, seat_materials
from .units import KN, MM, UM, mm


def bearing(file: BearingFile) -> Bearing:
    """Geometry [m, rad] and materials of the bearing."""
    table = file.bearing
    ball, inner, outer = ring_materials(table)
    library = materials(file, (ball, inner, outer))
    optional = {
        "bore": table.bore_mm,
        "outside_diameter": table.outside_diameter_mm,
        "width": table.width_mm,
    }
    optional |= {
        f"{r}_shoulder_diameter": getattr(table, f"{r}_shoulder_diameter_mm")
        for r in ("inner", "outer")
    }
    return Bearing(
        name=table.name or file.title or "bearing",
        ball_diameter=mm(table.ball_diameter_mm),
        pitch_diameter=mm(table.pitch_diameter_mm),
        balls=table.balls or 0,
        inner_groove_radius=mm(table.inner_groove_radius_mm),
        outer_groove_radius=mm(table.outer_groove_radius_mm),
        diametral_clearance=_clearance(table),
        ball_material=library[ball],
        inner_ring_material=library[inner],
        outer_ring_material=library[outer],
        first_ball_azimuth=radians(table.first_ball_azimuth_deg),
        **{key: None if value is None else value * MM for key, value in optional.items()},
    )


def _clearance(table: BearingTable) -> float:
    """The diametral clearance, or that of the free contact angle [m]."""
    if table.diametral_clearance_um is not None:
        return table.diametral_clearance_um * UM
    assert table.free_contact_angle_deg is not None  # checked before
    lengths = (table.inner_groove_radius_mm, table.outer_groove_radius_mm, table.ball_diameter_mm)
    return contact_angle_to_clearance(
        radians(table.free_contact_angle_deg), *(mm(length) for length in lengths)
    )


def operating_bearing(
    file: BearingFile, operation: Operation
) -> tuple[Bearing, ClearanceBudget | None]:
    """The bearing with its clearance in operation [m], and what made it that; None without [fit]
    and [temperatures].
    """
    given = bearing(file)
    if file.fit is None and file.temperatures is None:
        return given, None
    fit = seats(file)
    warming = None
    if file.temperatures is not None:
        at = file.temperatures
        mounts = {
            "shaft": at.inner_ring_C if at.shaft_C is None else at.shaft_C,
            "housing": at.outer_ring_C if at.housing_C is None else at.housing_C,
        }
        parts = {
            "inner_ring": at.inner_ring_C,
            "outer_ring": at.outer_ring_C,
            "ball": at.ball_C,
            **mounts,
        }
        warming = TemperatureRise(
            **{part: value - at.reference_C for part, value in parts.items()}
        )
    budget = clearance_budget(given, operation, fit, warming)
    if warming is not None:
        budget = replace(budget, cage=_warm_cage(file, given, warming))
    return replace(given, diametral_clearance=budget.operating), budget


def seats(file: BearingFile) -> Fit | None:
    """Fits of the rings [m]; None where the case gives none."""
    if file.fit is None:
        return None
    shaft, housing = seat_materials(file)
    library = materials(file, (shaft, housing))
    table = file.fit
    outside = table.housing_outside_diameter_mm
    return Fit(
        shaft_material=library[shaft],
        housing_material=library[housing],
        inner_interference=table.inner_ring_interference_um * UM,
        outer_interference=table.outer_ring_interference_um * UM,
        shaft_bore=table.shaft_bore_mm * MM,
        housing_outside_diameter=None if outside is None else outside * MM,
    )


def _warm_cage(
    file: BearingFile, given: Bearing, warming: TemperatureRise
) -> CageClearance | None:
    """What heat does to the clearances of the cage [m]; None without its temperature."""
    at, cage = file.temperatures, file.cage
    if at is None or at.cage_C is None:
        return None
    name = file.bearing.cage_material
    assert name is not None  # checked before
    races = {"inner ring": Race.INNER, "outer ring": Race.OUTER}
    land = None
    if cage is not None and cage.guided_by in races and cage.land_diameter_mm is not None:
        land = races[cage.guided_by], cage.land_diameter_mm * MM
    return cage_clearance(
        given, materials(file, (name,))[name], warming, at.cage_C - at.reference_C, land
    )


def rating(file: BearingFile) -> RatingInput:
    """What the rating life needs beyond the loads: C_r, C_0 [N], nominal contact angle [rad], e_C
    [-].
    """
    table = file.bearing
    angle, capacity = table.nominal_contact_angle_deg, table.basic_dynamic_rating_kN
    static = table.basic_static_rating_kN
    if angle is None:
        angle = table.free_contact_angle_deg or 0.0
    return RatingInput(
        dynamic_rating=None if capacity is None else capacity * KN,
        static_rating=None if static is None else static * KN,
        nominal_contact_angle=radians(angle),
        contamination_factor=file.lubricant.contamination_factor,
    )

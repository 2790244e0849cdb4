"""Diameters of the shoulders of a bearing's rings, given or estimated."""

from .geometry import Bearing, Race

# shoulders of deep groove bearings where none are given: height above the raceway over the ball
# diameter [-]; the 35 bearings 60, 62, 63 of the catalogue with the diameters that SKF prints have
# 0.198 (median), 0.164 to 0.208. Angular contact bearings have two unlike shoulders: no estimate
ESTIMATED_HEIGHT = 0.2


def shoulder_diameter(bearing: Bearing, race: Race) -> tuple[float, bool] | None:
    """Diameter of a ring's shoulders, prescribed or estimated.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    race : Race
        raceway of the ring

    Returns
    -------
    tuple[float, bool] | None
        diameter [m] and whether it is an estimate; None if the bearing gives none and is no deep
        groove bearing
    """
    inner = race is Race.INNER
    diameter = bearing.inner_shoulder_diameter if inner else bearing.outer_shoulder_diameter
    if diameter is not None:
        return diameter, False
    if bearing.angular_contact:
        return None
    centre = bearing.inner_centre_radius if inner else bearing.outer_centre_radius
    groove = bearing.inner_groove_radius if inner else bearing.outer_groove_radius
    depth = groove - ESTIMATED_HEIGHT * bearing.ball_diameter
    return 2.0 * (centre - depth if inner else centre + depth), True

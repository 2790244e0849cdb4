"""Clearances of a warm cage, in its pockets and on its land."""

from ..geometry import Bearing, Race
from ..material import Material
from .clearance import CageClearance, Warming, thermal_growth


def cage_clearance(
    bearing: Bearing,
    material: Material,
    warming: Warming,
    cage_warming: float,
    land: tuple[Race, float] | None,
) -> CageClearance:
    """Thermal growth of cage, balls and guiding ring; every part grows freely, alpha D dT.

    A pocket grows with the cage around it. On the inner ring the cage's bore grows away from the
    land, on the outer ring its outside grows towards it. Growth of the rings by fits and speed,
    some micrometres, is left out.

    Parameters
    ----------
    bearing : Bearing
    material : Material
        Of the cage, with its thermal expansion [1/K].
    warming : Warming
        Of rings and balls [K].
    cage_warming : float
        Of the cage [K].
    land : tuple of Race and float, or None
        The guiding ring and the diameter of its land [m]; None where balls guide the cage.

    Returns
    -------
    CageClearance
        Positive where there is more room when warm [m].
    """
    ball = bearing.ball_diameter
    pocket = thermal_growth(material, ball, cage_warming) - thermal_growth(
        bearing.ball_material, ball, warming.ball
    )
    if land is None:
        return CageClearance(pocket=pocket)
    race, diameter = land
    cage = thermal_growth(material, diameter, cage_warming)
    if race is Race.INNER:
        room = cage - thermal_growth(bearing.inner_ring_material, diameter, warming.inner_ring)
    else:
        room = thermal_growth(bearing.outer_ring_material, diameter, warming.outer_ring) - cage
    return CageClearance(pocket=pocket, land=0.5 * room)

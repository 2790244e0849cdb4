"""Heat capacities of the nodes of a bearing: they set how fast it warms, not where it ends."""

from math import pi

from ehl.arrays import Array
from ehl.oil.lubricant import Lubricant

from ..geometry import Bearing
from ..material import Material
from ..supply.supply import cavity_volume
from .friction_heat import solid_thermal
from .network import node_values
from .paths import Surroundings, dimensions, with_dimensions

OIL_SHARE = 0.1  # of the cavity that holds oil, where none is given, assumed [-]
CAGE_SHARE = 0.1  # of the volume of the balls that a cage has, assumed, as dense as steel [-]
CAGE_CAPACITY = 3.6e6  # rho c of steel [J/(m^3 K)]


def heat_capacities(
    bearing: Bearing,
    around: Surroundings,
    oil: Lubricant,
    oil_share: float | None = None,
    rows: int = 1,
) -> Array:
    """Heat capacities C of the nodes, rho c V; rings and housing as cylinders.

    The shaft counts over its whole length.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    around : Surroundings
        shaft, housing and surroundings
    oil : Lubricant
        oil in the cavity
    oil_share : float | None, optional
        fraction of the cavity that holds oil; None: `OIL_SHARE` [-]
    rows : int, default 1
        number of rows of balls [-]

    Returns
    -------
    Array
        C, shape (nodes,) [J/K]
    """
    size = dimensions(bearing, around, rows)
    length = size.width + 2.0 * size.shaft_length
    outer = _capacity(bearing.outer_ring_material)
    outer *= _ring(size.outer_track, size.outside, size.width)
    balls = rows * bearing.balls * pi / 6.0 * bearing.ball_diameter**3
    sized = with_dimensions(bearing, size.bore, size.outside, size.width / rows)
    cavity = rows * cavity_volume(sized) * (OIL_SHARE if oil_share is None else oil_share)
    fluid = oil.density * oil.thermal.specific_heat if oil.thermal else 0.0
    values = {
        "shaft": _capacity(around.shaft_material) * _ring(around.shaft_bore, size.bore, length),
        "inner_ring": _capacity(bearing.inner_ring_material)
        * _ring(size.bore, size.inner_track, size.width),
        "balls": _capacity(bearing.ball_material) * balls,
        "outer_ring_loaded": 0.5 * outer,
        "outer_ring_unloaded": 0.5 * outer,
        "cage": CAGE_CAPACITY * CAGE_SHARE * balls,
        "oil": max(fluid * cavity, 1e-3 * outer),
        "housing": _capacity(around.housing_material)
        * _ring(size.outside, size.housing, size.housing_width),
    }
    return node_values(values)


def _ring(inner: float, outer: float, width: float) -> float:
    """Volume of a cylinder with a bore [m^3]."""
    return 0.25 * pi * (outer**2 - inner**2) * width


def _capacity(material: Material) -> float:
    """Rho c [J/(m^3 K)]."""
    solid = solid_thermal(material)
    return solid.density * solid.specific_heat

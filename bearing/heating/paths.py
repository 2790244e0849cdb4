"""Paths of heat through the parts of a bearing, seats, shaft, housing, oil and air.

Assumed, and stated in the text of each path: coefficients of seats, of surfaces to the oil in
the cavity and to air, dimensions of shaft and housing where a case gives none.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import pi

from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.oil.lubricant import Lubricant

from ..geometry import Bearing, Race, ring_material
from ..material import Material
from ..rings.elastic_ring import heated_section
from ..torque.skf import diameters
from .friction_heat import FrictionHeat, solid_thermal
from .network import (
    AIR_CAPACITY,
    AIR_CONDUCTIVITY,
    AIR_PRANDTL,
    AIR_VISCOSITY,
    AMBIENT,
    OIL_SUPPLY,
    Conductance,
    HeatPath,
    cylinder_conductance,
    fin_conductance,
    in_series,
    plate_coefficients,
    radiation_coefficient,
    ring_halves_conductance,
    rotating_coefficient,
    side_by_side,
)

SEAT = Conductance(3e3, 1e3, 1e4)  # of seats [W/(m^2 K)], from memory, unverified
# housing to still air: free convection 3 to 8 and radiation [W/(m^2 K)], from memory, unverified
FREE_AIR = Conductance(5.0, 3.0, 8.0)
EMISSIVITY = 0.9  # of a painted housing, assumed [-]
SHAFT_LENGTH = 2.5  # of the shaft on each side over its diameter, assumed [-]
HOUSING_DIAMETER = 1.6  # of the housing over the bearing's, assumed [-]
HOUSING_WIDTH = 2.0  # of the housing over the bearing's, assumed [-]
WIDTH = 0.9  # of a bearing over the height of its section, where none is given, assumed [-]
HARRIS_SPEED = 1.0 / 3.0  # of the cage, with which oil or air passes the walls (Harris) [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings:
    """Shaft, housing, oil and air, SI; None leaves a number to the path's estimate."""

    ambient: float  # [K]
    # shaft and housing together to the surroundings [W/K]: split by the areas of the seats
    conductance: float | None = None
    oil_flow: float = 0.0  # rho c V of the oil that passes through [W/K]
    oil_supply: float = 293.15  # temperature of the oil supplied [K]
    air_flow: float = 0.0  # volume of the air that passes through [m^3/s]
    shaft_material: Material
    housing_material: Material
    shaft_bore: float = 0.0  # [m]
    shaft_length: float | None = None  # on each side of the bearing [m]
    housing_diameter: float | None = None  # [m]
    housing_width: float | None = None  # [m]
    seat: Conductance = SEAT  # [W/(m^2 K)]
    cavity: Conductance | None = None  # of all walls to the oil [W/(m^2 K)]
    filled: bool = True  # oil passes the walls of the cavity, else air
    # paths to other bearings on the shaft, and the temperatures of these [K]
    neighbours: tuple[tuple[HeatPath, float], ...] = ()

    @property
    def boundaries(self) -> dict[str, float]:
        """Temperatures prescribed [K]."""
        own = {AMBIENT: self.ambient, OIL_SUPPLY: self.oil_supply}
        return own | {path.second: temperature for path, temperature in self.neighbours}


@dataclass(frozen=True, slots=True, kw_only=True)
class Dimensions:
    """Dimensions of a bearing on its shaft and in its housing [m]."""

    bore: float
    outside: float
    width: float
    inner_track: float  # diameter at the bottom of the inner groove
    outer_track: float  # and of the outer one
    housing: float
    housing_width: float
    shaft_length: float


def dimensions(bearing: Bearing, around: Surroundings, rows: int = 1) -> Dimensions:
    """Dimensions of a bearing on its shaft and in its housing, estimated if not prescribed.

    Parameters
    ----------
    bearing : Bearing
        geometry of a row
    around : Surroundings
        shaft and housing
    rows : int, default 1
        number of rows of balls [-]

    Returns
    -------
    Dimensions
        dimensions [m]
    """
    bore, outside = diameters(bearing)
    width = bearing.width or WIDTH * 0.5 * (outside - bore)
    return Dimensions(
        bore=bore,
        outside=outside,
        width=rows * width,
        inner_track=bearing.pitch_diameter - bearing.ball_diameter,
        outer_track=bearing.pitch_diameter + bearing.ball_diameter,
        housing=around.housing_diameter or HOUSING_DIAMETER * outside,
        housing_width=around.housing_width or HOUSING_WIDTH * rows * width,
        shaft_length=around.shaft_length or SHAFT_LENGTH * bore,
    )


def solid_paths(
    bearing: Bearing, around: Surroundings, speed: float, rows: int = 1
) -> tuple[HeatPath, ...]:
    """Paths that friction and oil leave as they are: rings, seats, shaft, housing, air.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    around : Surroundings
        shaft, housing and surroundings
    speed : float
        speed of the shaft [rad/s]
    rows : int, default 1
        number of rows of balls [-]

    Returns
    -------
    tuple[HeatPath, ...]
        paths with their conductances [W/K]
    """
    size = dimensions(bearing, around, rows)
    return (*_ring_paths(bearing, around, size, rows), *_outside_paths(around, size, speed))


def _ring_paths(
    bearing: Bearing, around: Surroundings, size: Dimensions, rows: int
) -> Iterator[HeatPath]:
    """From the tracks of the rings to shaft and housing, and around the outer ring."""
    inner = Conductance.exactly(rows * ring_conductance(bearing, Race.INNER, size.width / rows))
    seat = around.seat.times(pi * size.bore * size.width)
    yield HeatPath(
        "inner_ring",
        "shaft",
        in_series(inner, seat),
        "track to bore by finite elements, and the seat (assumed)",
    )
    outer = Conductance.exactly(rows * ring_conductance(bearing, Race.OUTER, size.width / rows))
    seat = around.seat.times(pi * size.outside * size.width)
    k = solid_thermal(around.housing_material).conductivity
    wall = cylinder_conductance(k, size.housing_width, size.outside, size.housing)
    half = in_series(outer, seat, Conductance.exactly(wall)).times(0.5)
    for name in ("outer_ring_loaded", "outer_ring_unloaded"):
        yield HeatPath(
            name,
            "housing",
            half,
            "track to seat by finite elements, seat (assumed), wall of the housing",
        )
    k = solid_thermal(bearing.outer_ring_material).conductivity
    section = 0.5 * (size.outside - size.outer_track) * size.width
    radius = 0.25 * (size.outside + size.outer_track)
    around_ring = ring_halves_conductance(k, section, radius)
    yield HeatPath(
        "outer_ring_loaded",
        "outer_ring_unloaded",
        Conductance.exactly(around_ring),
        "around the ring, closed form",
    )


def _outside_paths(around: Surroundings, size: Dimensions, speed: float) -> Iterator[HeatPath]:
    """Shaft and housing to the surroundings and other bearings, oil and air that pass through."""
    if around.conductance is not None:
        sizes = {"shaft": size.bore, "housing": size.outside}
        for name, diameter in sizes.items():
            fraction = diameter / (size.bore + size.outside)
            yield HeatPath(
                name,
                AMBIENT,
                Conductance.exactly(fraction * around.conductance),
                "heat_transfer_W_K as given, split by the areas of the seats",
            )
    else:
        yield _shaft_path(around, size, speed)
        yield _housing_path(around, size)
    if around.oil_flow > 0.0:
        yield oil_path(around.oil_flow)
    if around.air_flow > 0.0:
        yield HeatPath(
            "oil",
            AMBIENT,
            Conductance.exactly(AIR_CAPACITY * around.air_flow),
            "air that passes through, rho c V",
        )
    yield from (path for path, _ in around.neighbours)


def oil_path(flow: float) -> HeatPath:
    """Heat that the oil takes along from the cavity, which has the mean of its temperatures at
    inlet and outlet: 2 rho c V (T - T_in); rho c V of a cavity that is stirred, all of it as warm
    as at the outlet.

    Parameters
    ----------
    flow : float
        rho c V [W/K]

    Returns
    -------
    HeatPath
        path from the oil to its supply
    """
    return HeatPath(
        "oil",
        OIL_SUPPLY,
        Conductance(2.0 * flow, flow, 2.0 * flow),
        "oil that passes through, rho c V, by its mean temperature",
    )


def _shaft_path(around: Surroundings, size: Dimensions, speed: float) -> HeatPath:
    """Two rods that turn in air."""
    k = solid_thermal(around.shaft_material).conductivity
    area = 0.25 * pi * (size.bore**2 - around.shaft_bore**2)
    turning = rotating_coefficient(speed, size.bore)
    radiation = radiation_coefficient(EMISSIVITY, around.ambient)
    ends = (turning + radiation, 0.5 * turning + radiation, 2.0 * turning + radiation)
    rods = [
        2.0 * fin_conductance(h, pi * size.bore, k, area, size.shaft_length) if h > 0.0 else 0.0
        for h in ends
    ]
    return HeatPath(
        "shaft",
        AMBIENT,
        Conductance(*rods),
        "a fin on each side, its length and coefficient assumed",
    )


def _housing_path(around: Surroundings, size: Dimensions) -> HeatPath:
    """Mantle and faces of a housing in still air."""
    area = pi * size.housing * size.housing_width
    area += 0.5 * pi * (size.housing**2 - size.bore**2)
    radiated = Conductance.exactly(radiation_coefficient(EMISSIVITY, around.ambient))
    return HeatPath(
        "housing",
        AMBIENT,
        side_by_side(FREE_AIR, radiated).times(area),
        "free convection and radiation of an assumed housing",
    )


def state_paths(
    bearing: Bearing,
    around: Surroundings,
    oil: Lubricant,
    friction: FrictionHeat,
    cage_speed: float,
    rows: int = 1,
) -> tuple[HeatPath, ...]:
    """Paths that depend on the state: contacts by their films, walls of the cavity by its oil.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    around : Surroundings
        shaft, housing and surroundings
    oil : Lubricant
        oil in the cavity
    friction : FrictionHeat
        heat and conductances of the contacts
    cage_speed : float
        speed of the cage [rad/s]
    rows : int, default 1
        number of rows of balls [-]

    Returns
    -------
    tuple[HeatPath, ...]
        paths with their conductances [W/K]
    """
    size = dimensions(bearing, around, rows)
    contacts = [
        HeatPath("balls", name, friction.race(name), "contacts, by the film of each")
        for name in ("inner_ring", "outer_ring_loaded", "outer_ring_unloaded")
    ]
    h = around.cavity or _cavity(bearing, around, oil, cage_speed)
    areas = {
        "inner_ring": pi * size.inner_track * size.width,
        "outer_ring_loaded": 0.5 * pi * size.outer_track * size.width,
        "outer_ring_unloaded": 0.5 * pi * size.outer_track * size.width,
        "balls": rows * bearing.balls * pi * bearing.ball_diameter**2,
        # both sides of a band as wide as the balls, assumed
        "cage": 2.0 * rows * pi * bearing.pitch_diameter * bearing.ball_diameter,
    }
    words = "given" if around.cavity else "a flat plate between Harris' coefficient and theory's"
    walls = [
        HeatPath(
            name,
            "oil",
            h.times(area),
            f"wall to the {'oil' if around.filled else 'air'} in the cavity, {words}",
        )
        for name, area in areas.items()
    ]
    return (*contacts, *walls)


def _cavity(
    bearing: Bearing, around: Surroundings, oil: Lubricant, cage_speed: float
) -> Conductance:
    """Per area of walls to the oil or air that passes them [W/(m^2 K)]."""
    length = bearing.pitch_diameter
    speed = HARRIS_SPEED * 0.5 * abs(cage_speed) * length
    if not around.filled:
        return plate_coefficients(speed, length, AIR_CONDUCTIVITY, AIR_VISCOSITY, AIR_PRANDTL)
    heat = heat_of(oil)
    k = heat.conductivity
    viscosity = oil.viscosity / oil.density
    prandtl = oil.viscosity * heat.specific_heat / k
    return plate_coefficients(speed, length, k, viscosity, prandtl)


def ring_conductance(bearing: Bearing, race: Race, width: float) -> float:
    """Conductance from the track of one row's ring to its seat, by finite elements.

    The rest of the ring is insulated.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    race : Race
        raceway of the ring
    width : float
        width of the row [m]

    Returns
    -------
    float
        conductance [W/K]
    """
    k = solid_thermal(ring_material(bearing, race)).conductivity
    sized = with_dimensions(bearing, *diameters(bearing), width)
    return k * heated_section(sized, race).conductance


def with_dimensions(bearing: Bearing, bore: float, outside: float, width: float) -> Bearing:
    """The bearing with boundary dimensions.

    Parameters
    ----------
    bearing : Bearing
        geometry of a row
    bore, outside : float
        diameters [m]
    width : float
        width [m]

    Returns
    -------
    Bearing
        changed bearing
    """
    return replace(bearing, bore=bore, outside_diameter=outside, width=width)

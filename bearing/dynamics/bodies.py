"""Masses and inertias of ring and cage, and the equations of motion that the loads need."""

from math import inf, pi, sin

import numpy as np

from oilfilm.ehl.closed_form.hertz import contact_stiffness
from oilfilm.ehl.units import from_si

from ..geometry import Bearing
from ..material import Material, reduced_modulus
from ..operation import Operation
from .arrays import PRESCRIBED_FORCE, PRESCRIBED_MOMENT, RING_TILT
from .choices import Guidance, LoadType
from .inputs import CageBody, DynamicsModel, RingBody
from .support import Support

# estimated cage over the ball's diameter [-]; pockets: 0.2 mm at balls of 7 mm, Ma et al.
# (2023). Thickness and web make a light cage: half or twice of each takes the shipped 7008 under
# combined load from 1.7 g to 0.9 to 3.5 g, changes its speed by 1e-5 and the largest force in a
# pocket by up to a half. Half or twice the clearance changes the slip by a tenth and a quarter.
THICKNESS = 0.25
WEB = 0.35
CLEARANCE = 0.03
# F = (pi/4) E* L d of parallel cylinders, Popov (2010), Contact Mechanics and Friction
LAND_FORCE = 0.25 * pi
ESTIMATES = ("mass", "thickness", "width", "pocket_clearance")  # where they are left out
SENSOR_AXIS = 1  # y, along the load line
SMALLEST_FILM = 1.0e-6  # between ball and pocket [m]


def ring_body(
    bearing: Bearing,
    mass: float | None = None,
    damping: float = 0.0,
    unbalance: tuple[float, float] = (0.0, 0.0),
) -> RingBody:
    """The inner ring as a hollow cylinder from its bore to the bottom of its groove.

    Parameters
    ----------
    bearing : Bearing
        geometry with bore and width
    mass : float | None, optional
        mass of ring and shaft [kg]; None: that of the cylinder
    damping : float, default 0.0
        damping of the support [N s/m]
    unbalance : tuple[float, float], default (0.0, 0.0)
        unbalance [kg m], and its phase from +y [rad]

    Returns
    -------
    RingBody
        mass and inertias of the ring

    Raises
    ------
    ValueError
        if bore or width is missing
    """
    if bearing.bore is None or bearing.width is None:
        raise ValueError("bore and width are needed for the inertia of the inner ring")
    inside = 0.5 * bearing.bore
    outside = bearing.inner_centre_radius - bearing.inner_groove_radius
    assumed = ("ring.mass", "ring.inertia") if mass is None else ("ring.inertia",)
    if mass is None:
        density = bearing.inner_ring_material.density
        mass = density * pi * (outside**2 - inside**2) * bearing.width
    polar, transverse = hollow_cylinder(mass, inside, outside, bearing.width)
    return RingBody(
        mass=mass,
        polar_inertia=polar,
        transverse_inertia=transverse,
        damping=damping,
        unbalance=unbalance[0],
        unbalance_phase=unbalance[1],
        assumed=assumed,
    )


def outer_ring_mass(bearing: Bearing, support: Support) -> float:
    """Mass of the outer ring and what moves with it: prescribed, or that of a cylinder outside of
    its groove.

    Parameters
    ----------
    bearing : Bearing
        geometry with outside diameter and width
    support : Support
        masses that are known

    Returns
    -------
    float
        mass [kg]

    Raises
    ------
    ValueError
        if a dimension is missing, or leaves no ring
    """
    if support.outer_mass is not None:
        return support.outer_mass + support.housing_mass
    if bearing.outside_diameter is None or bearing.width is None:
        raise ValueError("outside_diameter and width are needed for the mass of the outer ring")
    inside = bearing.outer_centre_radius + bearing.outer_groove_radius
    section = pi * (0.25 * bearing.outside_diameter**2 - inside**2)
    if not section > 0.0:
        raise ValueError("outside_diameter leaves no outer ring around its groove")
    mass = bearing.outer_ring_material.density * section * bearing.width
    return mass + support.housing_mass


def hollow_cylinder(
    mass: float, inside: float, outside: float, width: float
) -> tuple[float, float]:
    """Moments of inertia of a hollow cylinder.

    Parameters
    ----------
    mass : float
        mass [kg]
    inside, outside : float
        radii [m]
    width : float
        length along the axis [m]

    Returns
    -------
    polar
        about the axis [kg m^2]
    transverse
        across it [kg m^2]
    """
    square = inside**2 + outside**2
    return 0.5 * mass * square, mass * (3.0 * square + width**2) / 12.0


def require_web(bearing: Bearing, clearance: float) -> None:
    """Check that pockets leave a web between them on the pitch circle.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    clearance : float
        diametral clearance of a pocket [m]

    Raises
    ------
    ValueError
        if pockets overlap
    """
    apart = bearing.pitch_diameter * sin(pi / bearing.balls)
    if bearing.ball_diameter + clearance >= apart:
        largest = from_si("clearance_mm", apart - bearing.ball_diameter)
        if largest <= 0.0:
            raise ValueError(f"{bearing.balls} balls leave no room for a cage between them")
        prescribed = from_si("clearance_mm", clearance)
        raise ValueError(
            f"pocket_clearance: pockets overlap at {prescribed:.4g} mm; {bearing.balls} balls "
            f"leave less than {largest:.4g} mm"
        )


def pocket_stiffness(ball: float, clearance: float, modulus: float) -> float:
    """K of a ball against its pocket, a cylinder.

    Parameters
    ----------
    ball : float
        ball diameter [m]
    clearance : float
        diametral clearance of the pocket [m]
    modulus : float
        reduced modulus E' [Pa]

    Returns
    -------
    float
        K [N/m^1.5]
    """
    pocket = 0.5 * (ball + clearance)
    across = 0.5 * ball * pocket / (pocket - 0.5 * ball)  # reduced radius around the pocket
    return contact_stiffness(across, 0.5 * ball, modulus)


def cage_body(
    bearing: Bearing, material: Material, **prescribed: float | tuple[float, ...] | Guidance | None
) -> CageBody:
    """The cage: a hollow cylinder around the pitch circle, less its pockets.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    material : Material
        material of the cage
    **prescribed : float | tuple[float, ...] | Guidance | None
        any of `mass`, `polar_inertia`, `transverse_inertia` [kg, kg m^2], `thickness`, `width`,
        `pocket_clearance` (diametral) [m], `pocket_friction` [-], `film_least` [m], `guidance`,
        `land_diameter`, `land_width` (both lands together), `land_clearance` (radial) [m],
        `land_friction` [-], `unbalance` [kg m], `drag` [N m s^2], `pocket_clearances`, one a ball
        [m]; others are estimated and listed in `assumed`

    Returns
    -------
    CageBody
        cage in numbers

    Raises
    ------
    ValueError
        if pockets overlap
    """
    guidance = prescribed.get("guidance")
    plays = next((value for value in prescribed.values() if isinstance(value, tuple)), ())
    values = {name: value for name, value in prescribed.items() if isinstance(value, int | float)}
    values |= {"pocket_clearance": max(plays)} if plays else {}
    number = values.get
    ball = bearing.ball_diameter
    # 1. hollow cylinder around the pitch circle, less its pockets
    clearance = number("pocket_clearance", CLEARANCE * ball)
    require_web(bearing, clearance)
    thickness = number("thickness", THICKNESS * ball)
    width = number("width", (1.0 + 2.0 * 0.5 * WEB) * ball)
    inside, outside = (0.5 * (bearing.pitch_diameter + side * thickness) for side in (-1, 1))
    pockets = bearing.balls * 0.25 * pi * (ball + clearance) ** 2 * thickness
    volume = pi * (outside**2 - inside**2) * width - pockets
    mass = number("mass", material.density * volume)
    polar, transverse = hollow_cylinder(mass, inside, outside, width)
    # 2. contact of a ball with its pocket, of the cage with its lands
    modulus = reduced_modulus(bearing.ball_material, material)
    land = 0.5 * number("land_width", 0.0)
    return CageBody(
        mass=mass,
        polar_inertia=number("polar_inertia", polar),
        transverse_inertia=number("transverse_inertia", transverse),
        pocket_clearance=clearance,
        pocket_stiffness=pocket_stiffness(ball, clearance, modulus),
        pocket_friction=number("pocket_friction", 0.0),
        pocket_height=thickness,
        film_least=number("film_least", SMALLEST_FILM),
        pocket_clearances=plays,
        unbalance=number("unbalance", 0.0),
        drag=number("drag", 0.0),
        guidance=guidance if isinstance(guidance, Guidance) else Guidance.BALLS,
        land_radius=0.5 * number("land_diameter", 0.0),
        land_clearance=number("land_clearance", 0.0),
        land_width=land,
        land_offset=0.5 * (width - land),
        land_stiffness=LAND_FORCE * 0.5 * modulus * land,
        land_friction=number("land_friction", 0.0),
        assumed=tuple(f"cage.{name}" for name in ESTIMATES if name not in values),
    )


# values that a load type needs at zero besides gravity: columns of `prescribed_values`,
# coordinates of the ring
ACROSS = slice(PRESCRIBED_FORCE + 1, None)
ALONG = (PRESCRIBED_FORCE, PRESCRIBED_MOMENT, PRESCRIBED_MOMENT + 1)
# the same of `prescribed_displacements`
DISPLACEMENTS_ACROSS = slice(1, None)
DISPLACEMENTS_ALONG = (0, 3, 4)


def load_type(operation: Operation, model: DynamicsModel) -> LoadType:
    """Fewest equations that the loads allow at the start.

    Those of the symmetry that lasts longer, radial or axial; without one, combined if there are
    loads along x and y alone, else general.

    Parameters
    ----------
    operation : Operation
        speeds and loads
    model : DynamicsModel
        schedule, weight and unbalance

    Returns
    -------
    LoadType
        equations of motion
    """
    lasts = {
        kind: symmetric_until(kind, operation, model) for kind in (LoadType.RADIAL, LoadType.AXIAL)
    }
    kind = max(lasts, key=lambda each: lasts[each])
    if lasts[kind] > 0.0:
        return kind
    others = np.array(model.rows(operation))[:, PRESCRIBED_FORCE + 2 :]
    plain = not (
        np.any(others)
        or any(model.options.gravity)
        or model.ring.unbalance > 0.0
        or model.rotating is not None
        or (model.cage is not None and model.cage.unbalance > 0.0)
        or None in operation.force
        or None in operation.tilt
        or np.any(np.array(model.places(operation))[:, RING_TILT:])
    )
    return LoadType.COMBINED if plain else LoadType.GENERAL


def symmetric_until(kind: LoadType, operation: Operation, model: DynamicsModel) -> float:
    """Time up to which loads, weight, unbalance and displacements leave bodies a symmetry.

    Parameters
    ----------
    kind : LoadType
        load type with the symmetry
    operation : Operation
        speeds and loads
    model : DynamicsModel
        schedule, weight and unbalance

    Returns
    -------
    float
        time; zero if they never do, infinite if they always do [s]
    """
    gravity = np.array(model.options.gravity)
    displacements = np.array(model.places(operation))
    rows = np.array(model.rows(operation))
    if kind is LoadType.AXIAL:
        even = model.ring.unbalance == 0.0 and (model.cage is None or model.cage.even)
        even = even and model.rotating is None
        even = even and (model.surfaces is None or model.surfaces.even)
        broken = np.any(gravity[1:]) or not even
        loaded = np.any(rows[:, ACROSS], axis=1) | np.any(
            displacements[:, DISPLACEMENTS_ACROSS], axis=1
        )
    elif kind in (LoadType.RADIAL, LoadType.PLANAR):
        broken = bool(gravity[0])
        loaded = np.any(rows[:, ALONG], axis=1) | np.any(
            displacements[:, DISPLACEMENTS_ALONG], axis=1
        )
    else:
        return inf
    if broken:
        return 0.0
    if not loaded.any():
        return inf
    first = int(np.argmax(loaded))
    return model.times[first - 1] if first else 0.0


# coordinates that move, by the symmetry of the loads: ring x, y, z, tilt y, tilt z; cage x, y, z,
# rotation, tilt y, tilt z; ball x, y, z and turns
FREE_COORDINATES: dict[LoadType, tuple[tuple[int, ...], ...]] = {
    LoadType.RADIAL: ((0, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.AXIAL: ((1, 0, 0, 0, 0), (1, 0, 0, 1, 0, 0), (1, 1, 1, 1, 1, 1)),
    LoadType.COMBINED: ((1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1)),
    LoadType.PLANAR: ((0, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.GENERAL: ((1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1)),
}


def free_support(kind: LoadType, support: Support) -> tuple[int, ...]:
    """Free coordinates of the outer ring and the sensor on it: as those of the inner ring.

    Parameters
    ----------
    kind : LoadType
        equations of motion
    support : Support
        seat and sensor

    Returns
    -------
    tuple[int, ...]
        1 or 0 for x, y, z of the outer ring and for the sensor [-]
    """
    if not support.outer_moves:
        return (0, 0, 0, 0)
    along = FREE_COORDINATES[kind][0][:3]
    sensor = 0 if support.sensor is None else along[SENSOR_AXIS]
    return (*along, sensor)


def free_coordinates(kind: LoadType, operation: Operation) -> tuple[tuple[int, ...], ...]:
    """Free coordinates of ring, cage and a ball.

    The ring is fixed along a coordinate with a prescribed displacement.

    Parameters
    ----------
    kind : LoadType
        equations of motion
    operation : Operation
        prescribed loads and displacements

    Returns
    -------
    tuple[tuple[int, ...], ...]
        1 or 0 for each coordinate of ring, cage and ball [-]
    """
    ring, cage, ball = FREE_COORDINATES[kind]
    loads = operation.loads
    ring = tuple(free if load is not None else 0 for free, load in zip(ring, loads, strict=True))
    return ring, cage, ball


def equation_counts(kind: LoadType, balls: int, operation: Operation) -> dict[str, int]:
    """Number of equations of motion that are solved, of second order.

    Ma et al. (2023), Table 1, integrate all balls under an axial load, too; under a load across
    the axis and under both they constrain the ring and the cage to the load line, where friction
    pushes them aside.

    Parameters
    ----------
    kind : LoadType
        equations of motion
    balls : int
        number of balls [-]
    operation : Operation
        prescribed loads and displacements

    Returns
    -------
    dict[str, int]
        numbers of ring, cage, balls, and in all [-]
    """
    ring, cage, ball = (sum(component) for component in free_coordinates(kind, operation))
    solved = 1 if kind is LoadType.AXIAL else balls
    return {
        "ring": ring,
        "cage": cage,
        "balls": ball * solved,
        "dynamic": ring + cage + ball * solved,
    }

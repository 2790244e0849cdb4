"""Masses and inertias of ring and cage, and the equations of motion that the loads need."""

from math import pi

import numpy as np

from ehl.closed_form.hertz import contact_stiffness

from ..geometry import Bearing
from ..material import Material, reduced_modulus
from ..operation import Operation
from .arrays import GIVEN_FORCE
from .choices import Guidance, LoadType
from .inputs import CageBody, DynamicsModel, RingBody

# of an estimated cage, over the ball's diameter [-]; pockets: 0.2 mm at balls of 7 mm, Ma et al.
# (2023). Thickness and web make a light cage: half or twice of each takes the shipped 7008 under
# combined load from 1.7 g to 0.9 to 3.5 g, changes its speed by 1e-5 and the largest force in a
# pocket by up to a half. Half or twice the clearance changes the slip by a tenth and a quarter.
THICKNESS = 0.25
WEB = 0.35
CLEARANCE = 0.03
# F = (pi/4) E* L d of parallel cylinders, Popov (2010), Contact Mechanics and Friction
LAND_FORCE = 0.25 * pi
SMALLEST_FILM = 1.0e-6  # between ball and pocket [m]


def ring_body(
    bearing: Bearing,
    mass: float | None = None,
    damping: float = 0.0,
    unbalance: tuple[float, float] = (0.0, 0.0),
) -> RingBody:
    """The inner ring as a hollow cylinder from its bore to the bottom of its groove.

    `bearing`: with bore and width, else ValueError; `mass`: of ring and what turns with it [kg];
    None: of the cylinder; `damping`: of the support [N s/m]; `unbalance` [kg m], and its phase
    from +y [rad].
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


def hollow_cylinder(
    mass: float, inside: float, outside: float, width: float
) -> tuple[float, float]:
    """Polar and transverse moment of inertia [kg m^2] of a mass [kg] between two radii [m]."""
    square = inside**2 + outside**2
    return 0.5 * mass * square, mass * (3.0 * square + width**2) / 12.0


def cage_body(bearing: Bearing, material: Material, **given: float | Guidance | None) -> CageBody:
    """The cage: a hollow cylinder around the pitch circle, less its pockets.

    `given`: any of `mass`, `polar_inertia`, `transverse_inertia` [kg, kg m^2], `thickness`,
    `width`, `pocket_clearance` (diametral) [m], `pocket_friction` [-], `film_least` [m],
    `guidance`, `land_diameter`, `land_width` (both lands together), `land_clearance` (radial) [m],
    `land_friction` [-]. What is left out is estimated, and named so.
    """
    guidance = given.get("guidance")
    values = {name: value for name, value in given.items() if isinstance(value, int | float)}
    estimates = ("mass", "thickness", "width", "pocket_clearance")
    number = values.get
    ball = bearing.ball_diameter
    # 1. hollow cylinder around the pitch circle, less its pockets
    clearance = number("pocket_clearance", CLEARANCE * ball)
    thickness = number("thickness", THICKNESS * ball)
    width = number("width", (1.0 + 2.0 * 0.5 * WEB) * ball)
    inside = 0.5 * bearing.pitch_diameter - 0.5 * thickness
    outside = 0.5 * bearing.pitch_diameter + 0.5 * thickness
    pockets = bearing.balls * 0.25 * pi * (ball + clearance) ** 2 * thickness
    volume = pi * (outside**2 - inside**2) * width - pockets
    mass = number("mass", material.density * volume)
    polar, transverse = hollow_cylinder(mass, inside, outside, width)
    # 2. contact of a ball with its pocket, of the cage with its lands
    modulus = reduced_modulus(bearing.ball_material, material)
    pocket = 0.5 * (ball + clearance)
    across = 0.5 * ball * pocket / (pocket - 0.5 * ball)  # reduced radius around the pocket
    land = 0.5 * number("land_width", 0.0)
    return CageBody(
        mass=mass,
        polar_inertia=number("polar_inertia", polar),
        transverse_inertia=number("transverse_inertia", transverse),
        pocket_clearance=clearance,
        pocket_stiffness=contact_stiffness(across, 0.5 * ball, modulus),
        pocket_friction=number("pocket_friction", 0.0),
        film_least=number("film_least", SMALLEST_FILM),
        guidance=guidance if isinstance(guidance, Guidance) else Guidance.BALLS,
        land_radius=0.5 * number("land_diameter", 0.0),
        land_clearance=number("land_clearance", 0.0),
        land_width=land,
        land_offset=0.5 * (width - land),
        land_stiffness=LAND_FORCE * 0.5 * modulus * land,
        land_friction=number("land_friction", 0.0),
        assumed=tuple(f"cage.{name}" for name in estimates if name not in values),
    )


def load_type(operation: Operation, model: DynamicsModel) -> LoadType:
    """Fewest equations the loads allow, Ma et al. (2023): radial, axial, combined, general."""
    loads = np.array(model.rows(operation))[:, GIVEN_FORCE:]
    axial, radial, *others = np.any(loads, axis=0)
    if (
        any(others)
        or any(model.options.gravity)
        or model.ring.unbalance > 0.0
        or None in operation.force
        or any(value != 0.0 for value in operation.tilt)
    ):
        return LoadType.GENERAL
    if axial:
        return LoadType.COMBINED if radial else LoadType.AXIAL
    return LoadType.RADIAL


# ring x, y, z, tilt y, tilt z; cage x, y, z, rotation, tilt y, tilt z; ball x, y, z and turns
FREE_COORDINATES: dict[LoadType, tuple[tuple[int, ...], ...]] = {
    LoadType.RADIAL: ((0, 1, 0, 0, 0), (0, 0, 0, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.AXIAL: ((1, 0, 0, 0, 0), (0, 0, 0, 1, 0, 0), (1, 1, 1, 1, 1, 1)),
    LoadType.COMBINED: ((1, 1, 0, 0, 0), (0, 0, 0, 1, 0, 0), (1, 1, 1, 1, 1, 1)),
    LoadType.PLANAR: ((0, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.GENERAL: ((1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1)),
}


def free_coordinates(kind: LoadType, operation: Operation) -> tuple[tuple[int, ...], ...]:
    """1 or 0 for each coordinate of ring, cage and a ball [-]; the general ring is fixed where
    the case prescribes a displacement.
    """
    ring, cage, ball = FREE_COORDINATES[kind]
    if kind is LoadType.GENERAL:
        ring = tuple(0 if load is None else 1 for load in operation.loads)
    return ring, cage, ball


def equation_counts(kind: LoadType, balls: int, operation: Operation) -> dict[str, int]:
    """Unknowns of static, quasi-static, dynamic model [-], Ma et al. (2023), Table 1."""
    ring, cage, ball = (sum(part) for part in free_coordinates(kind, operation))
    quasi_static = {
        LoadType.RADIAL: 1 + balls,
        LoadType.AXIAL: 1 + 2,
        LoadType.COMBINED: 2 + 2 * balls,
        LoadType.PLANAR: 2 + balls,
        LoadType.GENERAL: ring + 2 * balls,
    }[kind]
    return {
        "static": ring,
        "quasi_static": quasi_static,
        "ring": ring,
        "cage": cage,
        "balls": ball * balls,
        "dynamic": ring + cage + ball * balls,
    }

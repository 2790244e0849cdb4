"""Masses and inertias of ring and cage, and the equations of motion that the loads need."""

from math import pi

import numpy as np

from ehl.closed_form.hertz import contact_stiffness

from ..geometry import Bearing
from ..material import Material, reduced_modulus
from ..operation import Operation
from .arrays import GIVEN_FORCE
from .inputs import CageBody, DynamicsModel, Guidance, LoadType, RingBody

# of an estimated cage, over the ball's diameter [-]
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

    `bearing`: with bore and width; `mass`: of ring and what turns with it [kg]; None: of the
    cylinder; `damping`: of the support [N s/m]; `unbalance` [kg m], and its phase from +y [rad].

    Raises
    ------
    ValueError
        Where bore or width are missing.
    """
    if bearing.bore is None or bearing.width is None:
        raise ValueError("bore and width are needed for the inertia of the inner ring")
    inside = 0.5 * bearing.bore
    outside = bearing.inner_centre_radius - bearing.inner_groove_radius
    assumed: tuple[str, ...] = ("ring.inertia",)
    if mass is None:
        assumed = ("ring.mass", "ring.inertia")
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

    Parameters
    ----------
    material : Material
        Of the cage.
    **given
        Any of `mass`, `polar_inertia`, `transverse_inertia` [kg, kg m^2], `thickness`, `width`,
        `pocket_clearance` (diametral) [m], `pocket_friction` [-], `film_least` [m], `guidance`,
        `land_diameter`, `land_width` (both lands together), `land_clearance` (radial) [m],
        `land_friction` [-]. What is left out is estimated, and named so.
    """
    guidance = given.pop("guidance", None) or Guidance.BALLS
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
    general = (
        any(model.options.gravity)
        or model.ring.unbalance > 0.0
        or bool(np.any(loads[:, 2:]))
        or any(value is None for value in operation.force)
        or any(value != 0.0 for value in operation.tilt)
    )
    if general:
        return LoadType.GENERAL
    axial, radial = bool(np.any(loads[:, 0])), bool(np.any(loads[:, 1]))
    if axial and radial:
        return LoadType.COMBINED
    return LoadType.AXIAL if axial else LoadType.RADIAL


# ring x, y, z, tilt y, tilt z; cage x, y, z, rotation, tilt y, tilt z; ball x, y, z and turns
FREE_COORDINATES = {
    LoadType.RADIAL: ((0, 1, 0, 0, 0), (0, 0, 0, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.AXIAL: ((1, 0, 0, 0, 0), (0, 0, 0, 1, 0, 0), (1, 1, 1, 1, 1, 1)),
    LoadType.COMBINED: ((1, 1, 0, 0, 0), (0, 0, 0, 1, 0, 0), (1, 1, 1, 1, 1, 1)),
    LoadType.PLANAR: ((0, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0), (0, 1, 1, 1, 0, 0)),
    LoadType.GENERAL: ((1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1), (1, 1, 1, 1, 1, 1)),
}


def free_coordinates(
    kind: LoadType, operation: Operation
) -> tuple[tuple[int, ...], tuple[int, ...], tuple[int, ...]]:
    """1 or 0 for each coordinate of ring, cage and a ball [-]; the general ring is fixed where
    the case prescribes a displacement.
    """
    ring, cage, ball = FREE_COORDINATES[kind]
    prescribed = tuple(0 if load is None else 1 for load in operation.loads)
    return prescribed if kind is LoadType.GENERAL else ring, cage, ball


def equation_counts(kind: LoadType, balls: int, operation: Operation) -> dict[str, int]:
    """Unknowns of static, quasi-static, dynamic model [-], Ma et al. (2023), Table 1."""
    ring, cage, ball = (sum(part) for part in free_coordinates(kind, operation))
    static = ring
    quasi = {
        LoadType.RADIAL: 1 + balls,
        LoadType.AXIAL: 1 + 2,
        LoadType.COMBINED: 2 + 2 * balls,
        LoadType.PLANAR: 2 + balls,
        LoadType.GENERAL: ring + 2 * balls,
    }[kind]
    return {
        "static": static,
        "quasi_static": quasi,
        "ring": ring,
        "cage": cage,
        "balls": ball * balls,
    } | {"dynamic": ring + cage + ball * balls}

"""Masses and inertias of ring and cage, and the equations of motion that the loads need."""

from math import pi

import numpy as np

from ehl.closed_form.hertz import contact_stiffness

from ..geometry import Bearing
from ..material import Material, reduced_modulus
from ..operation import Operation
from .inputs import CageBody, DynamicsModel, Guidance, LoadType, RingBody

# of an estimated cage, over the ball's diameter [-]
THICKNESS = 0.25
WEB = 0.35
CLEARANCE = 0.03
# F = (pi/4) E* L d of parallel cylinders, Popov (2010), Contact Mechanics and Friction
LAND_FORCE = 0.25 * pi


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
    own = bearing.inner_ring_material.density * pi * (outside**2 - inside**2) * bearing.width
    assumed = ("ring.inertia",) if mass is not None else ("ring.mass", "ring.inertia")
    mass = own if mass is None else mass
    square = inside**2 + outside**2
    return RingBody(
        mass=mass,
        polar_inertia=0.5 * mass * square,
        transverse_inertia=mass * (3.0 * square + bearing.width**2) / 12.0,
        damping=damping,
        unbalance=unbalance[0],
        unbalance_phase=unbalance[1],
        assumed=assumed,
    )


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
    values = {name: value for name, value in given.items() if value is not None}
    ball = bearing.ball_diameter
    assumed = [
        f"cage.{name}"
        for name in ("mass", "thickness", "width", "pocket_clearance")
        if name not in values
    ]
    clearance = _number(values, "pocket_clearance", CLEARANCE * ball)
    thickness = _number(values, "thickness", THICKNESS * ball)
    width = _number(values, "width", (1.0 + 2.0 * 0.5 * WEB) * ball)
    pitch = 0.5 * bearing.pitch_diameter
    inside = pitch - 0.5 * thickness
    outside = pitch + 0.5 * thickness
    volume = (
        pi * (outside**2 - inside**2) * width
        - bearing.balls * 0.25 * pi * (ball + clearance) ** 2 * thickness
    )
    mass = _number(values, "mass", material.density * volume)
    square = inside**2 + outside**2
    modulus = reduced_modulus(bearing.ball_material, material)
    pocket = 0.5 * (ball + clearance)
    across = 0.5 * ball * pocket / (pocket - 0.5 * ball)  # reduced radius around the pocket
    guidance = values.get("guidance", Guidance.BALLS)
    lands = _number(values, "land_width", 0.0)
    return CageBody(
        mass=mass,
        polar_inertia=_number(values, "polar_inertia", 0.5 * mass * square),
        transverse_inertia=_number(
            values, "transverse_inertia", mass * (3.0 * square + width**2) / 12.0
        ),
        pocket_clearance=clearance,
        pocket_stiffness=contact_stiffness(across, 0.5 * ball, modulus),
        pocket_friction=_number(values, "pocket_friction", 0.0),
        film_least=_number(values, "film_least", 1.0e-6),
        guidance=guidance if isinstance(guidance, Guidance) else Guidance.BALLS,
        land_radius=0.5 * _number(values, "land_diameter", 0.0),
        land_clearance=_number(values, "land_clearance", 0.0),
        land_width=0.5 * lands,
        land_offset=0.5 * (width - 0.5 * lands),
        land_stiffness=LAND_FORCE * 0.5 * modulus * 0.5 * lands,
        land_friction=_number(values, "land_friction", 0.0),
        assumed=tuple(assumed),
    )


def _number(values: dict[str, float | Guidance], name: str, default: float) -> float:
    value = values.get(name, default)
    return value if isinstance(value, int | float) else default


def load_type(operation: Operation, model: DynamicsModel) -> LoadType:
    """The fewest equations that the loads allow, after Ma et al. (2023): radial, axial, combined,
    or general.
    """
    rows = (
        [operation.loads] if model.schedule is None else [row[2:] for row in model.schedule.values]
    )
    loads = np.array([[0.0 if value is None else value for value in row] for row in rows])
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
    """1 or 0 for each coordinate of ring, cage and a ball [-]; the general ring is held where the
    case holds it.
    """
    ring, cage, ball = FREE_COORDINATES[kind]
    held = tuple(0 if load is None else 1 for load in operation.loads)
    return held if kind is LoadType.GENERAL else ring, cage, ball


def equation_counts(kind: LoadType, balls: int, operation: Operation) -> dict[str, int]:
    """Unknowns of the static, quasi-static and dynamic model, Ma et al. (2023), Table 1; planar,
    general: ours [-].
    """
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

"""An elastic ring on its seat: section, elastic constants, and what carries it."""

from dataclasses import dataclass
from itertools import pairwise
from math import degrees, pi, radians

from oilfilm.ehl.solid import bodies
from oilfilm.ehl.solid.bodies.ring_profile import Elasticity, RingCells, RingProfile, Seat

from ..geometry import Bearing, Race, ring_material, shoulder_diameter
from ..material import Material

# contact angle at which the axial compliance is taken: at least this, from the free angle rounded,
# so that the clearance in operation asks for no other mesh [deg]
LEAST_ANGLE_DEG = 20.0
ANGLE_STEP_DEG = 5.0
# the mesh of a solid shaft ends at this part of its radius, which softens it by the square [-]
SHAFT_CORE = 0.15
# half-width of the track that the balls heat over the ball diameter [-]: the ellipses of loaded
# contacts reach 0.05 to 0.15; the ring's conductance changes by 10 % from one to the other
TRACK = 0.1
SHOULDER = 0.2  # height over the ball diameter where no shoulder is known, assumed [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ElasticRing:
    """A ring as an elastic body, alike on both sides."""

    profile: RingProfile
    elasticity: Elasticity
    seat: Seat
    contact_angle: float  # at which axial forces act [rad]
    estimated_shoulder: bool = False  # its diameter is an estimate
    cells: RingCells | None = None  # of its mesh; None: those of `ring_mesh`
    supports: tuple[float, ...] = ()  # azimuths of the supports of `Seat.SPLIT` [rad]

    def __post_init__(self) -> None:
        if (self.seat is Seat.SPLIT) != bool(self.supports):
            raise ValueError("supports belong to a split seat")
        if not self.supports:
            return
        turns = sorted(azimuth % (2.0 * pi) for azimuth in self.supports)
        gaps = [b - a for a, b in pairwise([*turns, turns[0] + 2.0 * pi])]
        if max(gaps) > pi - self.half_support:
            raise ValueError("supports must be three or more, none of them 180 deg from the next")
        if min(gaps) < 2.0 * self.half_support:
            smallest = 2.0 * degrees(self.half_support)
            raise ValueError(
                f"supports must be {smallest:.1f} deg apart, twice the wall of the ring"
            )

    @property
    def half_support(self) -> float:
        """Half the angle of a support of a split seat, as wide as twice the wall [rad]."""
        return self.profile.wall / self.profile.seat_radius


@dataclass(frozen=True, slots=True, kw_only=True)
class ElasticRings:
    """The rings that are elastic bodies; None: one that yields at its contacts alone."""

    inner: ElasticRing | None = None
    outer: ElasticRing | None = None


def elastic_ring(
    bearing: Bearing,
    race: Race,
    seat: Seat,
    shoulder: tuple[float, bool],
    body: tuple[float, Material] | None = None,
    supports: tuple[float, ...] = (),
) -> ElasticRing:
    """The elastic ring of a bearing; its clearance plays no part.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    race : Race
        raceway of the ring
    seat : Seat
        kind of the seat
    shoulder : tuple[float, bool]
        diameter of the shoulder [m], and whether it is an estimate
    body : tuple[float, Material] | None, optional
        bore of the shaft or outside diameter of the housing [m] with its material, for
        `Seat.ELASTIC`
    supports : tuple[float, ...], default ()
        azimuths of the supports of `Seat.SPLIT` [rad]

    Returns
    -------
    ElasticRing
        section, elastic constants and seat

    Raises
    ------
    ValueError
        if bore, outside diameter or width is missing, or the section is impossible
    """
    inner = race is Race.INNER
    name = "bore" if inner else "outside_diameter"
    seat_diameter = getattr(bearing, name)
    if seat_diameter is None or bearing.width is None:
        missing = name if seat_diameter is None else "width"
        raise ValueError(f"{missing} is needed for an elastic {race.value} ring")
    ball = bearing.ball_diameter
    track_diameter = bearing.pitch_diameter + (-ball if inner else ball)
    if (track_diameter - seat_diameter) * (1 if inner else -1) <= 0.0:
        raise ValueError(f"{name} leaves no wall under the groove of the {race.value} ring")
    material = ring_material(bearing, race)
    radius, body_material = (None, None) if body is None else body
    if radius is not None:
        radius *= 0.5
        if inner:
            radius = max(radius, 0.5 * SHAFT_CORE * seat_diameter)
    profile = RingProfile(
        groove_radius=bearing.inner_groove_radius if inner else bearing.outer_groove_radius,
        track_radius=0.5 * track_diameter,
        shoulder_radius=0.5 * shoulder[0],
        seat_radius=0.5 * seat_diameter,
        width=bearing.width,
        body_radius=radius,
    )
    return ElasticRing(
        profile=profile,
        elasticity=Elasticity(
            young=material.youngs_modulus,
            poisson=material.poisson_ratio,
            body_young=0.0 if body_material is None else body_material.youngs_modulus,
            body_poisson=0.0 if body_material is None else body_material.poisson_ratio,
        ),
        seat=seat,
        contact_angle=_contact_angle(bearing, profile),
        estimated_shoulder=shoulder[1],
        supports=supports,
    )


def _contact_angle(bearing: Bearing, profile: RingProfile) -> float:
    """The free contact angle in whole steps, within the groove [rad]."""
    steps = round(degrees(bearing.free_contact_angle) / ANGLE_STEP_DEG)
    angle = max(LEAST_ANGLE_DEG, steps * ANGLE_STEP_DEG)
    return min(radians(angle), 0.8 * profile.edge_angle)


def heated_section(bearing: Bearing, race: Race) -> "bodies.HeatedRing":
    """Solved temperatures of a ring whose track is heated.

    Parameters
    ----------
    bearing : Bearing
        geometry, with bore, outside diameter and width
    race : Race
        raceway of the ring

    Returns
    -------
    bodies.HeatedRing
        temperatures and conductance
    """
    ball = bearing.ball_diameter
    outward = 1.0 if race is Race.INNER else -1.0
    groove = bearing.pitch_diameter - outward * ball
    shoulder = shoulder_diameter(bearing, race) or (groove + 2.0 * outward * SHOULDER * ball, True)
    profile = elastic_ring(bearing, race, Seat.RIGID, shoulder).profile
    return bodies.heated_ring(profile, TRACK * ball)

"""Internal geometry of a ball bearing: grooves, clearance, free contact angle, reduced radii, rows
of balls, shoulders of the rings.

The outer groove's centre of curvature stands still; the inner one is A = r_i + r_o - D away from
it when a ball just touches both races. With the grooves facing each other (axial position zero)
their centres are A - Pd/2 apart, hence cos(free angle) = 1 - Pd/(2 A) (Harris and Kotzalas,
Rolling Bearing Analysis).

All rows on one inner ring have the same bearing. The undisplaced inner ring is the reference:
there the middle of a row's inner groove lies at `axial_position`, that of its outer groove
`offset` behind. A row touches at an offset of the free axial position A sin(free angle) and is
preloaded beyond it; a positive offset loads it as a push of the inner ring to +x does. Back to
back, left row +, right row -; face to face the other way round; tandem, both alike.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import acos, asin, cos, isfinite, pi, radians, sqrt
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import to_si

from .library.bearings import load_catalogue_entry
from .material import Material, load_material, reduced_modulus

# free contact angle above which a bearing of no given type counts as one of angular contact [rad]:
# deep groove bearings with a normal clearance have up to 13.5 degrees, nominal ones begin at 15
ANGULAR_CONTACT = radians(14.25)

# shoulders of deep groove bearings where none are given: height above the raceway over the ball
# diameter [-]; the 35 bearings 60, 62, 63 of the catalogue with the diameters that SKF prints have
# 0.198 (median), 0.164 to 0.208. Angular contact bearings have two unlike shoulders: no estimate
ESTIMATED_HEIGHT = 0.2

LENGTHS = (  # of `Bearing`, keys of an entry with their unit
    *("ball_diameter_mm", "pitch_diameter_mm", "inner_groove_radius_mm"),
    *("outer_groove_radius_mm", "bore_mm", "outside_diameter_mm", "width_mm"),
    *("inner_shoulder_diameter_mm", "outer_shoulder_diameter_mm"),
)


class BearingType(Enum):
    """Types that rating and friction formulas distinguish."""

    DEEP_GROOVE = "deep groove"
    ANGULAR_CONTACT = "angular contact"


class Race(Enum):
    """One of the two raceways."""

    INNER = "inner"
    OUTER = "outer"


@dataclass(frozen=True, slots=True, kw_only=True)
class Bearing:
    """One row of balls between two grooved rings, SI.

    Raises
    ------
    ValueError
        if a dimension is impossible; the message names the field

    Examples
    --------
    >>> from dataclasses import replace
    >>> from oilfilm.bearing import Bearing, load_material
    >>> steel = load_material("bearing steel")
    >>> bearing = Bearing(
    ...     name="6208",
    ...     ball_diameter=12e-3,
    ...     pitch_diameter=60e-3,
    ...     balls=9,
    ...     inner_groove_radius=6.17e-3,
    ...     outer_groove_radius=6.29e-3,
    ...     diametral_clearance=13e-6,
    ...     ball_material=steel,
    ...     inner_ring_material=steel,
    ...     outer_ring_material=steel,
    ... )
    >>> f"{bearing.outer_conformity:.3f}"
    '0.524'
    >>> replace(bearing, balls=16)
    Traceback (most recent call last):
    ...
    ValueError: balls: 16 of the given diameter do not fit on the pitch circle
    """

    name: str
    ball_diameter: float  # D [m]
    pitch_diameter: float  # d_m [m]
    balls: int  # Z [-]
    inner_groove_radius: float  # r_i, radius of the groove's cross-section [m]
    outer_groove_radius: float  # r_o [m]
    # Pd, diametral play of the unloaded bearing; negative is interference
    diametral_clearance: float  # [m]
    ball_material: Material
    inner_ring_material: Material
    outer_ring_material: Material
    first_ball_azimuth: float = 0.0  # azimuth of ball 1 from the load line [rad]
    bore: float | None = None  # boundary dimensions [m]
    outside_diameter: float | None = None  # [m]
    width: float | None = None  # [m]
    # diameters of the lands beside the grooves, both sides alike
    inner_shoulder_diameter: float | None = None  # [m]
    outer_shoulder_diameter: float | None = None  # [m]
    type: BearingType | None = None  # None: by the free contact angle, see `angular_contact`

    def __post_init__(self) -> None:
        _check_lengths(self)
        if self.balls < 2:
            raise ValueError(f"balls must be at least 2, got {self.balls}")
        if self.balls * asin(min(1.0, self.ball_diameter / self.pitch_diameter)) > pi:
            raise ValueError(
                f"balls: {self.balls} of the given diameter do not fit on the pitch circle"
            )
        a = self.curvature_centre_distance
        clearance = self.diametral_clearance
        if not (isfinite(clearance) and -a < clearance < 2.0 * a):
            raise ValueError(
                f"diametral_clearance must lie between {-a:.6g} and {2.0 * a:.6g} m, where the "
                f"free contact angle reaches 90 degrees, got {clearance!r}"
            )
        if not isfinite(self.first_ball_azimuth):
            raise ValueError(f"first_ball_azimuth must be finite, got {self.first_ball_azimuth!r}")
        _check_shoulders(self)

    @property
    def inner_conformity(self) -> float:
        """f_i = r_i/D [-]."""
        return self.inner_groove_radius / self.ball_diameter

    @property
    def outer_conformity(self) -> float:
        """f_o = r_o/D [-]."""
        return self.outer_groove_radius / self.ball_diameter

    @property
    def curvature_centre_distance(self) -> float:
        """A = r_i + r_o - D, distance of the grooves' centres when a ball touches both [m]."""
        return self.inner_groove_radius + self.outer_groove_radius - self.ball_diameter

    @property
    def free_contact_angle(self) -> float:
        """Contact angle under a vanishing axial load [rad]; zero with interference."""
        return clearance_to_contact_angle(
            self.diametral_clearance,
            self.inner_groove_radius,
            self.outer_groove_radius,
            self.ball_diameter,
        )

    @property
    def angular_contact(self) -> bool:
        """True for a bearing of angular contact: by its type, which no clearance changes,
        or where none is given by a free contact angle above 14.25 degrees.
        """
        if self.type is None:
            return self.free_contact_angle > ANGULAR_CONTACT
        return self.type is BearingType.ANGULAR_CONTACT

    @property
    def free_axial_position(self) -> float:
        """Axial displacement from facing grooves to first touch, A sin(free angle) [m]."""
        sine = sqrt(max(0.0, 1.0 - cos(self.free_contact_angle) ** 2))
        return self.curvature_centre_distance * sine

    @property
    def free_tilt(self) -> float:
        """Tilt of a ring to either side at which balls of an unloaded row touch both races,
        A sin(free angle) over the radius of the inner groove's centres [rad].
        """
        return self.free_axial_position / self.inner_centre_radius

    @property
    def inner_centre_radius(self) -> float:
        """Radius of the circle of the inner groove's centres of curvature, [m]."""
        cosine = 1.0 - 0.5 * self.diametral_clearance / self.curvature_centre_distance
        distance = self.inner_groove_radius - 0.5 * self.ball_diameter
        return 0.5 * self.pitch_diameter + distance * cosine

    @property
    def outer_centre_radius(self) -> float:
        """Radius of the circle of the outer groove's centres of curvature, [m]."""
        cosine = 1.0 - 0.5 * self.diametral_clearance / self.curvature_centre_distance
        distance = self.outer_groove_radius - 0.5 * self.ball_diameter
        return 0.5 * self.pitch_diameter - distance * cosine

    @property
    def azimuths(self) -> Array:
        """Azimuths of the balls in [0, 2 pi) [rad], shape (Z,)."""
        steps = 2.0 * pi / self.balls * np.arange(self.balls)
        return np.mod(self.first_ball_azimuth + steps, 2.0 * pi)

    @property
    def azimuth_directions(self) -> Array:
        """Cosines and sines of the azimuths [-], shape (2, Z).

        Balls beyond half a turn are counted backwards, so that with a ball on the load line those
        at psi and -psi have the same cosine to the last bit, and equal loads.
        """
        index = np.arange(self.balls)
        index = np.where(2 * index > self.balls, index - self.balls, index)
        psi = self.first_ball_azimuth + 2.0 * pi / self.balls * index
        return np.stack([np.cos(psi), np.sin(psi)])


def _check_lengths(bearing: Bearing) -> None:
    grooves = ("inner_groove_radius", "outer_groove_radius")
    optional = ("bore", "outside_diameter", "width")
    for field in ("ball_diameter", "pitch_diameter", *grooves, *optional):
        value = getattr(bearing, field)
        if not (field in optional and value is None) and not (isfinite(value) and value > 0.0):
            raise ValueError(f"{field} must be positive and finite, got {value!r} m")
    if bearing.pitch_diameter <= bearing.ball_diameter:
        raise ValueError(
            f"pitch_diameter must exceed ball_diameter {bearing.ball_diameter} m, "
            f"got {bearing.pitch_diameter}"
        )
    ball_radius = 0.5 * bearing.ball_diameter
    for field in grooves:
        value = getattr(bearing, field)
        if value <= ball_radius:
            raise ValueError(
                f"{field} must exceed the ball radius {ball_radius:.6g} m, got {value!r} m"
            )


def _check_shoulders(bearing: Bearing) -> None:
    """Shoulders between the bottom of their groove and its centre of curvature."""
    inner, outer = 2.0 * bearing.inner_centre_radius, 2.0 * bearing.outer_centre_radius
    for field, low, high in (
        ("inner_shoulder_diameter", inner - 2.0 * bearing.inner_groove_radius, inner),
        ("outer_shoulder_diameter", outer, outer + 2.0 * bearing.outer_groove_radius),
    ):
        value = getattr(bearing, field)
        if value is not None and not low < value < high:
            raise ValueError(f"{field} must lie between {low:.6g} and {high:.6g} m, got {value!r}")


def clearance_to_contact_angle(
    clearance: float, inner_groove_radius: float, outer_groove_radius: float, ball_diameter: float
) -> float:
    """Free contact angle, cos = 1 - Pd/(2 A), Harris and Kotzalas; zero with interference.

    Parameters
    ----------
    clearance : float
        diametral clearance Pd [m]
    inner_groove_radius, outer_groove_radius : float
        radii of the cross-sections of the grooves [m]
    ball_diameter : float
        D [m]

    Returns
    -------
    float
        free contact angle [rad]

    Raises
    ------
    ValueError
        if the clearance exceeds 2 A, A = r_i + r_o - D
    """
    distance = inner_groove_radius + outer_groove_radius - ball_diameter
    if clearance > 2.0 * distance:
        raise ValueError(
            f"diametral_clearance must not exceed {2.0 * distance:.6g} m, got {clearance!r}"
        )
    return acos(min(1.0, 1.0 - 0.5 * clearance / distance))


def contact_angle_to_clearance(
    contact_angle: float,
    inner_groove_radius: float,
    outer_groove_radius: float,
    ball_diameter: float,
) -> float:
    """Diametral clearance, Pd = 2 A (1 - cos) of the free contact angle.

    The inverse of `clearance_to_contact_angle`.

    Parameters
    ----------
    contact_angle : float
        free contact angle, in [0, pi/2) [rad]
    inner_groove_radius, outer_groove_radius : float
        radii of the cross-sections of the grooves [m]
    ball_diameter : float
        D [m]

    Returns
    -------
    float
        diametral clearance [m]

    Raises
    ------
    ValueError
        if the angle lies outside its range
    """
    if not 0.0 <= contact_angle < 0.5 * pi:
        raise ValueError(f"free_contact_angle must lie in [0, pi/2), got {contact_angle!r} rad")
    distance = inner_groove_radius + outer_groove_radius - ball_diameter
    return 2.0 * distance * (1.0 - cos(contact_angle))


def reduced_radii(bearing: Bearing, race: Race, contact_angle: float) -> tuple[float, float]:
    """Reduced radii of curvature of the contact of a ball with a race.

    In the rolling direction D/2 (1 -+ D cos(angle)/d_m) (inner, outer), across it 1/(2/D - 1/r).

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    race : Race
        raceway in contact
    contact_angle : float
        contact angle [rad]

    Returns
    -------
    radius_x
        in the rolling direction [m]
    radius_y
        across it [m]
    """
    gamma = bearing.ball_diameter * cos(contact_angle) / bearing.pitch_diameter
    if race is Race.INNER:
        groove = bearing.inner_groove_radius
        factor = 1.0 - gamma
    else:
        groove = bearing.outer_groove_radius
        factor = 1.0 + gamma
    radius_y = 1.0 / (2.0 / bearing.ball_diameter - 1.0 / groove)
    return 0.5 * bearing.ball_diameter * factor, radius_y


def ring_material(bearing: Bearing, race: Race) -> Material:
    """Material of a ring.

    Parameters
    ----------
    bearing : Bearing
        materials of the rings
    race : Race
        raceway of the ring

    Returns
    -------
    Material
        its material
    """
    return bearing.inner_ring_material if race is Race.INNER else bearing.outer_ring_material


def contact_modulus(bearing: Bearing, race: Race) -> float:
    """Reduced modulus E' of a ball on a race.

    Parameters
    ----------
    bearing : Bearing
        materials of ball and rings
    race : Race
        raceway in contact

    Returns
    -------
    float
        E' [Pa]
    """
    return reduced_modulus(bearing.ball_material, ring_material(bearing, race))


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One row of balls."""

    # middle of the inner groove from the point about which moments and tilts count [m]
    axial_position: float = 0.0
    # middle of the inner groove from that of the outer one along +x, ring undisplaced [m]
    offset: float = 0.0
    # azimuth of its first ball [rad]; None takes the bearing's
    first_ball_azimuth: float | None = None

    def __post_init__(self) -> None:
        for field in ("axial_position", "offset"):
            if not isfinite(getattr(self, field)):
                raise ValueError(f"{field} must be finite, got {getattr(self, field)!r} m")

    def bearing(self, bearing: Bearing) -> Bearing:
        """The bearing with this row's first azimuth.

        Parameters
        ----------
        bearing : Bearing
            bearing of all rows

        Returns
        -------
        Bearing
            the same bearing, or one with the azimuth of this row's first ball
        """
        first = self.first_ball_azimuth
        return bearing if first is None else replace(bearing, first_ball_azimuth=first)

    @property
    def outer_plane(self) -> float:
        """Axial position of the middle of the outer groove [m]."""
        return self.axial_position - self.offset


SINGLE = (Row(),)


def row_azimuths(bearing: Bearing, rows: Sequence[Row]) -> Array:
    """Azimuths of the balls of all rows, row by row.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows
    rows : Sequence[Row]
        rows on the inner ring

    Returns
    -------
    Array
        azimuths, shape (N,) [rad]
    """
    return np.concatenate([row.bearing(bearing).azimuths for row in rows])


def row_directions(bearing: Bearing, rows: Sequence[Row]) -> Array:
    """Cosines and sines of the azimuths of all rows.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows
    rows : Sequence[Row]
        rows on the inner ring

    Returns
    -------
    Array
        cosines and sines, shape (2, N) [-]
    """
    return np.concatenate([row.bearing(bearing).azimuth_directions for row in rows], axis=1)


def per_ball(bearing: Bearing, values: Sequence[float]) -> Array:
    """One value a row as one value a ball.

    Parameters
    ----------
    bearing : Bearing
        bearing of all rows, which gives the number of balls a row
    values : Sequence[float]
        one value a row, shape (rows,) [any unit]

    Returns
    -------
    Array
        the values, each repeated for the balls of its row, shape (N,) [any unit]
    """
    return np.repeat(np.asarray(values, dtype=np.float64), bearing.balls)


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


def load_bearing(name: str) -> Bearing:
    """Bearing of the catalogue, with the materials of its entry.

    `load_catalogue_entry` has the sources and the ranges of estimated values.

    Parameters
    ----------
    name : str
        a name that `catalogue_name` knows

    Returns
    -------
    Bearing
        geometry and materials, SI

    Raises
    ------
    ValueError
        if no bearing has this name

    Examples
    --------
    >>> from oilfilm.bearing import load_bearing
    >>> bearing = load_bearing("6208")
    >>> bearing.balls, f"{1e3 * bearing.ball_diameter:.4g} mm"
    (9, '12 mm')
    """
    return bearing_of_entry(load_catalogue_entry(name))


def bearing_of_entry(entry: Mapping[str, Any]) -> Bearing:
    """Bearing of the keys of a catalogue entry.

    Parameters
    ----------
    entry : Mapping[str, Any]
        values by key, as `load_catalogue_entry` and `estimate_bearing` return them

    Returns
    -------
    Bearing
        geometry and materials, SI
    """
    lengths = {key.removesuffix("_mm"): to_si(key, entry.get(key)) for key in LENGTHS}
    clearance = to_si("diametral_clearance_um", entry.get("diametral_clearance_um"))
    if clearance is None:
        clearance = contact_angle_to_clearance(
            to_si("free_contact_angle_deg", entry["free_contact_angle_deg"]),
            lengths["inner_groove_radius"],
            lengths["outer_groove_radius"],
            lengths["ball_diameter"],
        )
    ring = load_material(entry["ring_material"])
    return Bearing(
        name=entry.get("name", "bearing"),
        balls=entry["balls"],
        diametral_clearance=clearance,
        ball_material=load_material(entry["ball_material"]),
        inner_ring_material=ring,
        outer_ring_material=ring,
        type=BearingType(entry["type"]),
        **lengths,
    )

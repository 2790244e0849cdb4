"""Internal geometry that makers do not publish, estimated from what they do: boundary dimensions
and load ratings.

The ratings of ISO 281 and ISO 76 are functions of ball diameter, number of balls, pitch diameter
and contact angle alone as long as the grooves are not wide. Balls come in standard sizes and whole
numbers. So the pair (D, Z) whose computed ratings come nearest to the catalogue's is looked for;
for makers who rate by the standards without a factor of their own it fits within a percent, and
the next best pair misses by some percent. docs/user/libraries.md has the errors.
"""

from dataclasses import dataclass
from math import asin, floor, hypot, isfinite, log, pi

from bearing.geometry import Bearing, contact_angle_to_clearance
from bearing.material import Material, load_material
from bearing.rating.load_rating import dynamic_rating, static_rating

INCH = 25.4e-3  # [m]
# between ball sizes below and above FINE_LARGEST [m]
FINE_STEP = INCH / 64.0
COARSE_STEP = INCH / 32.0
FINE_LARGEST = 18.0 * FINE_STEP  # 9/32 inch [m]
BALL_TO_SECTION = (0.20, 0.36)  # smallest and largest D over D_o - d that are tried [-]
FEWEST_BALLS = 5
INNER_CONFORMITY = 0.515  # groove radius over ball diameter
OUTER_CONFORMITY = 0.525  # assumed [-]
# of the bearings with known ones [-]
INNER_CONFORMITY_RANGE = (0.51, 0.525)
OUTER_CONFORMITY_RANGE = (0.515, 0.53)
BALL_RANGE = 0.07  # relative [-]
PITCH_RANGE = 0.015  # relative [-]
BALLS_RANGE = 1  # balls: docs/user/libraries.md
# D over D_o - d without ratings: mean of the catalogue's, docs/user/libraries.md [-]
TYPICAL_BALL = 0.30
# angle [deg], share of the pitch circle: likewise [-]
TYPICAL_FILL = ((0.0, 0.60), (15.0, 0.78), (40.0, 0.86))
# bore up to [mm], group CN of deep groove bearings from, to [um]: ISO 5753-1 as makers print it
NORMAL_CLEARANCE = (
    (10.0, 2.0, 13.0),
    (18.0, 3.0, 18.0),
    (24.0, 5.0, 20.0),
    (30.0, 5.0, 20.0),
    (40.0, 6.0, 20.0),
    (50.0, 6.0, 23.0),
    (65.0, 8.0, 28.0),
    (80.0, 10.0, 30.0),
    (100.0, 12.0, 36.0),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class CatalogueData:
    """What a maker's catalogue says of a ball bearing with one row.

    Attributes
    ----------
    bore, outside_diameter : float
        d and D_o [m].
    contact_angle : float
        Nominal contact angle; zero for deep groove bearings [rad].
    dynamic_rating, static_rating : float
        Basic radial ratings C_r and C_0r, without a factor of the maker's own [N].
    pitch_diameter : float or None
        Where it is known better than (d + D_o)/2, as from the shoulders' diameters [m].
    """

    bore: float
    outside_diameter: float
    contact_angle: float
    dynamic_rating: float
    static_rating: float
    pitch_diameter: float | None = None

    def __post_init__(self) -> None:
        for field in ("bore", "outside_diameter", "dynamic_rating", "static_rating"):
            value = getattr(self, field)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if self.outside_diameter <= self.bore:
            raise ValueError(f"outside_diameter must exceed the bore, {self.bore!r} m, got {self.outside_diameter!r}")
        if not 0.0 <= self.contact_angle < 0.5 * pi:
            raise ValueError(f"contact_angle must lie in [0, pi/2), got {self.contact_angle!r} rad")

    @property
    def pitch(self) -> float:
        """Pitch diameter, given or (d + D_o)/2 [m]."""
        return self.pitch_diameter or 0.5 * (self.bore + self.outside_diameter)


@dataclass(frozen=True, slots=True, kw_only=True)
class GeometryEstimate:
    """Estimated internal geometry.

    Attributes
    ----------
    ball_diameter, pitch_diameter : float
        [m].
    balls : int
    inner_groove_radius, outer_groove_radius : float
        From assumed conformities [m].
    dynamic_error, static_error : float
        Computed over catalogue rating, less one [-].
    misfit, next_misfit : float
        Root of the sum of the squared logarithmic errors, of this pair of diameter and number and
        of the next best [-].
    """

    ball_diameter: float
    pitch_diameter: float
    balls: int
    inner_groove_radius: float
    outer_groove_radius: float
    dynamic_error: float
    static_error: float
    misfit: float
    next_misfit: float

    def ranges(self) -> dict[str, tuple[float, float]]:
        """Interval of each estimated length [m] and of the number of balls [-].

        The grooves' radii are those of the ball diameter found; with another ball they follow it.
        """
        ball, pitch = self.ball_diameter, self.pitch_diameter
        return {
            "ball_diameter": (ball * (1.0 - BALL_RANGE), ball * (1.0 + BALL_RANGE)),
            "pitch_diameter": (pitch * (1.0 - PITCH_RANGE), pitch * (1.0 + PITCH_RANGE)),
            "balls": (self.balls - BALLS_RANGE, self.balls + BALLS_RANGE),
            "inner_groove_radius": (ball * INNER_CONFORMITY_RANGE[0], ball * INNER_CONFORMITY_RANGE[1]),
            "outer_groove_radius": (ball * OUTER_CONFORMITY_RANGE[0], ball * OUTER_CONFORMITY_RANGE[1]),
        }


def ball_sizes(smallest: float, largest: float) -> tuple[float, ...]:
    """Standard ball diameters in an interval [m]: steps of 1/64 inch up to 9/32 inch, of 1/32 inch
    beyond.

    Parameters
    ----------
    smallest, largest : float
        [m].

    Returns
    -------
    tuple of float
        [m].
    """
    fine = [i * FINE_STEP for i in range(1, round(FINE_LARGEST / FINE_STEP) + 1)]
    coarse = [i * COARSE_STEP for i in range(round(FINE_LARGEST / COARSE_STEP) + 1, floor(largest / COARSE_STEP) + 2)]
    return tuple(size for size in (*fine, *coarse) if smallest <= size <= largest)


def most_balls(ball_diameter: float, pitch_diameter: float) -> int:
    """Number of balls that fit on the pitch circle without a cage; diameters in [m]."""
    return floor(pi / asin(ball_diameter / pitch_diameter) + 1e-9)


def estimate_geometry(data: CatalogueData) -> GeometryEstimate:
    """Ball diameter and number of balls whose computed ratings come nearest to the catalogue's.

    Least (ln C/C_r)^2 + (ln C_0/C_0r)^2 over the standard ball sizes and all numbers of balls that
    fit, C and C_0 by `load_rating.dynamic_rating` and `static_rating`.

    Parameters
    ----------
    data : CatalogueData

    Returns
    -------
    GeometryEstimate

    Raises
    ------
    ValueError
        If no standard ball fits the section.
    """
    steel = load_material("bearing steel")
    section = data.outside_diameter - data.bore
    candidates = []
    for ball in ball_sizes(BALL_TO_SECTION[0] * section, BALL_TO_SECTION[1] * section):
        for balls in range(FEWEST_BALLS, most_balls(ball, data.pitch) + 1):
            bearing = _bearing(data, ball, balls, steel)
            dynamic = dynamic_rating(bearing, data.contact_angle) / data.dynamic_rating
            static = static_rating(bearing, data.contact_angle) / data.static_rating
            candidates.append((hypot(log(dynamic), log(static)), ball, balls, dynamic - 1.0, static - 1.0))
    if len(candidates) < 2:
        raise ValueError(f"outside_diameter and bore leave no room for standard balls, section {section!r} m")
    (misfit, ball, balls, dynamic, static), (next_misfit, *_), *_ = sorted(candidates)
    return GeometryEstimate(
        ball_diameter=ball,
        pitch_diameter=data.pitch,
        balls=balls,
        inner_groove_radius=INNER_CONFORMITY * ball,
        outer_groove_radius=OUTER_CONFORMITY * ball,
        dynamic_error=dynamic,
        static_error=static,
        misfit=misfit,
        next_misfit=next_misfit,
    )


def _bearing(data: CatalogueData, ball: float, balls: int, steel: Material) -> Bearing:
    """A bearing with this ball, in steel."""
    inner, outer = INNER_CONFORMITY * ball, OUTER_CONFORMITY * ball
    return Bearing(
        name="estimate",
        ball_diameter=ball,
        pitch_diameter=data.pitch,
        balls=balls,
        inner_groove_radius=inner,
        outer_groove_radius=outer,
        diametral_clearance=contact_angle_to_clearance(data.contact_angle, inner, outer, ball),
        ball_material=steel,
        inner_ring_material=steel,
        outer_ring_material=steel,
    )


def typical_geometry(bore: float, outside_diameter: float, contact_angle: float) -> tuple[float, float, int]:
    """Ball diameter [m], pitch diameter [m] and number of balls [-] from the boundary dimensions
    alone: a rough guess.

    D = 0.30 (D_o - d), the nearest standard size; Z = fill pi/asin(D/d_m), with the share of the
    pitch circle that the balls of the catalogue's bearings fill, linear in the contact angle
    between deep groove, 15 and 40 degrees.

    Parameters
    ----------
    bore, outside_diameter : float
        [m].
    contact_angle : float
        [rad].

    Returns
    -------
    tuple
        Ball diameter [m], pitch diameter [m], number of balls [-].
    """
    wanted = TYPICAL_BALL * (outside_diameter - bore)
    pitch = 0.5 * (bore + outside_diameter)
    ball = min(ball_sizes(0.9 * wanted, 1.1 * wanted), key=lambda size: abs(size - wanted))
    return (ball, pitch, max(FEWEST_BALLS, round(_fill(contact_angle * 180.0 / pi) * pi / asin(ball / pitch))))


def _fill(angle: float) -> float:
    """Share of the pitch circle that balls fill, over the contact angle [deg]."""
    (a0, f0), (a1, f1), (a2, f2) = TYPICAL_FILL
    if angle <= a1:
        return f0 + (f1 - f0) * (angle - a0) / (a1 - a0)
    return f1 + (f2 - f1) * (min(angle, a2) - a1) / (a2 - a1)


def normal_clearance(bore: float) -> tuple[float, float]:
    """Smallest and largest radial internal clearance of the group CN of deep groove bearings [m].

    ISO 5753-1; the standard was not read, the numbers are those of two makers' tables, which agree
    (docs/user/libraries.md).

    Parameters
    ----------
    bore : float
        From 2.5 to 100 mm [m].

    Returns
    -------
    tuple of float
        [m].
    """
    for largest, low, high in NORMAL_CLEARANCE:
        if 2.5e-3 <= bore <= largest * 1e-3 * (1.0 + 1e-9):
            return low * 1e-6, high * 1e-6
    raise ValueError(f"bore must lie between 2.5 and {NORMAL_CLEARANCE[-1][0]:g} mm, got {bore!r} m")

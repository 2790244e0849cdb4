"""Internal geometry that makers do not publish, estimated from their boundary dimensions and
load ratings.

The ratings of ISO 281 and ISO 76 are functions of ball diameter, number of balls, pitch diameter
and contact angle alone as long as the grooves are not wide. Balls come in standard sizes and whole
numbers. So the pair (D, Z) whose computed ratings come nearest to the catalogue's is looked for;
for makers who rate by the standards without a factor of their own it fits within a percent, and
the next best pair misses by some percent. docs/user/libraries.md has the errors.
"""

from dataclasses import dataclass, replace
from math import degrees, hypot, isfinite, log, pi
from typing import Any

from oilfilm.ehl.units import MILLIMETRE

from ..geometry import Bearing, contact_angle_to_clearance
from ..library.catalogue import (
    FEWEST_BALLS,
    INNER_CONFORMITY,
    OUTER_CONFORMITY,
    Geometry,
    ball_sizes,
    estimated_entry,
    from_dimensions,
    from_ratings,
    full_complement,
    nearest_series,
    typical_number,
)
from ..material import load_material
from .load_rating import dynamic_rating, static_rating

BALL_TO_SECTION = (0.20, 0.38)  # smallest and largest D over D_o - d that are tried [-]
# ln(1.5), of the ratings of a new bearing: makers rate up to a sixth above the standards, of the
# catalogue the worst is missed by 3 %; what is missed by more is another bearing, or in newtons
WORST_MISFIT = 0.405
RATING_TOLERANCE = 0.1  # of the logarithms of ratings, within which a pair comes into question [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class CatalogueData:
    """Data of a maker's catalogue for a ball bearing with one row, SI."""

    bore: float  # d [m]
    outside_diameter: float  # D_o [m]
    contact_angle: float = 0.0  # nominal; zero for deep groove bearings [rad]
    # basic radial ratings C_r and C_0r, without a factor of the maker's own [N]; None if unknown
    dynamic_rating: float | None = None  # [N]
    static_rating: float | None = None  # [N]
    width: float | None = None  # [m]
    # if it is more exact than (d + D_o)/2, as from the shoulders' diameters [m]
    pitch_diameter: float | None = None

    def __post_init__(self) -> None:
        for field in ("bore", "outside_diameter", "dynamic_rating", "static_rating", "width"):
            value = getattr(self, field)
            if value is None and field not in ("bore", "outside_diameter"):
                continue
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if self.outside_diameter <= self.bore:
            raise ValueError(
                f"outside_diameter must exceed the bore, {self.bore!r} m, "
                f"got {self.outside_diameter!r}"
            )
        if not 0.0 <= self.contact_angle < 0.5 * pi:
            raise ValueError(
                f"contact_angle must lie in [0, pi/2), got {self.contact_angle!r} rad"
            )

    @property
    def pitch(self) -> float:
        """Pitch diameter, given or (d + D_o)/2 [m]."""
        return self.pitch_diameter or 0.5 * (self.bore + self.outside_diameter)


@dataclass(frozen=True, slots=True, kw_only=True)
class RatedPair:
    """Ball diameter and number of balls beside the ratings of a catalogue."""

    ball_diameter: float  # [m]
    balls: int
    # computed over catalogue rating, less one; None where the catalogue gives none [-]
    dynamic_error: float | None  # [-]
    static_error: float | None  # [-]
    misfit: float  # root of the sum of the squared logarithmic errors [-]
    next_misfit: float  # likewise of the next best pair [-]


def estimate_geometry(data: CatalogueData) -> RatedPair:
    """Ball diameter and number of balls whose computed ratings come nearest to the catalogue's.

    Least (ln C/C_r)^2 + (ln C_0/C_0r)^2 over the standard ball sizes and all numbers of balls that
    fit, C and C_0 by `load_rating.dynamic_rating` and `static_rating`. With one of the ratings
    alone, over the ball sizes with the number of balls that is typical of each.

    Parameters
    ----------
    data : CatalogueData
        boundary dimensions and ratings of the catalogue [m], [N]

    Returns
    -------
    RatedPair
        best pair with its errors

    Raises
    ------
    ValueError
        if no rating is given, or no standard ball fits the section
    """
    if data.dynamic_rating is None and data.static_rating is None:
        raise ValueError("dynamic_rating and static_rating must not both be left out")
    section = data.outside_diameter - data.bore
    smallest, largest = (fraction * section for fraction in BALL_TO_SECTION)
    bearings = [
        bearing for ball in ball_sizes(smallest, largest) for bearing in _bearings(data, ball)
    ]
    close = [bearing for bearing in bearings if _is_close(data, bearing)]
    candidates = [_pair(data, bearing) for bearing in (close if len(close) > 1 else bearings)]
    if len(candidates) < 2:
        raise ValueError(
            f"outside_diameter and bore leave no room for standard balls, section {section!r} m"
        )
    best, second, *_ = sorted(candidates, key=lambda pair: pair.misfit)
    return replace(best, next_misfit=second.misfit)


def _bearings(data: CatalogueData, ball: float) -> list[Bearing]:
    """Bearings with balls of a diameter [m] in all numbers that come into question."""
    largest = full_complement(ball, data.pitch)
    numbers = range(FEWEST_BALLS, largest + 1)
    if data.dynamic_rating is None or data.static_rating is None:
        usual = typical_number(ball, data.pitch, data.contact_angle)
        numbers = range(usual, usual + 1)
    return [_bearing(data, ball, balls) for balls in numbers]


def _is_close(data: CatalogueData, bearing: Bearing) -> bool:
    """Check the dynamic rating before the more expensive static one is computed."""
    if data.dynamic_rating is None:
        return True
    return (
        abs(log(dynamic_rating(bearing, data.contact_angle) / data.dynamic_rating))
        < RATING_TOLERANCE
    )


def _pair(data: CatalogueData, bearing: Bearing) -> RatedPair:
    errors: list[float | None] = []
    for rating, published in (
        (dynamic_rating, data.dynamic_rating),
        (static_rating, data.static_rating),
    ):
        errors.append(
            None if published is None else rating(bearing, data.contact_angle) / published - 1.0
        )
    misfit = hypot(*(log(1.0 + error) for error in errors if error is not None))
    return RatedPair(
        ball_diameter=bearing.ball_diameter,
        balls=bearing.balls,
        dynamic_error=errors[0],
        static_error=errors[1],
        misfit=misfit,
        next_misfit=misfit,
    )


def _bearing(data: CatalogueData, ball: float, balls: int) -> Bearing:
    """A bearing with this ball, in steel."""
    steel = load_material("bearing steel")
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


def estimate_bearing(data: CatalogueData) -> dict[str, Any]:
    """Keys of a case's [bearing] table for a bearing whose boundary dimensions alone are known.

    The internal geometry follows from the ratings where the data have any (`estimate_geometry`),
    else it is typical of the boundary dimensions; a deep groove bearing gets the clearance of the
    class CN, grooves are assumed.

    Parameters
    ----------
    data : CatalogueData
        boundary dimensions and ratings of the catalogue [m], [N]

    Returns
    -------
    dict[str, Any]
        keys of the table, with `source` (text), `estimated` (keys) and `range` (an interval of
        each)

    Raises
    ------
    ValueError
        without a width, or if nothing fits
    """
    if data.width is None:
        raise ValueError("width must be given")
    ratings = {
        key: value / 1e3
        for key, value in (
            ("basic_dynamic_rating_kN", data.dynamic_rating),
            ("basic_static_rating_kN", data.static_rating),
        )
        if value is not None
    }
    bore, outside, width = (
        round(length / MILLIMETRE, 9) for length in (data.bore, data.outside_diameter, data.width)
    )
    angle = round(degrees(data.contact_angle), 9)
    entry = estimated_entry((bore, outside, width), angle, _geometry(data), ratings)
    series = nearest_series(bore, outside, angular=data.contact_angle > 0.0)
    return {**entry, "skf_series": series}


def _geometry(data: CatalogueData) -> Geometry:
    if data.dynamic_rating is None and data.static_rating is None:
        return from_dimensions(data.bore, data.outside_diameter, data.contact_angle, data.width)
    pair = estimate_geometry(data)
    if pair.misfit > WORST_MISFIT:
        named = {"C": pair.dynamic_error, "C_0": pair.static_error}
        ratios = [f"{key} {1.0 + e:.3g}" for key, e in named.items() if e is not None]
        raise ValueError(
            f"ratings that no balls have which fit in: the nearest have {', '.join(ratios)} times "
            "those given; allowed: 0.67 to 1.5 times. A wrong unit?"
        )
    basis = f"ball, balls: estimated from the ratings, which they miss by {pair.misfit:.1%}"
    return from_ratings(pair.ball_diameter, data.pitch, pair.balls, basis)

"""Internal geometry that makers do not publish, estimated from their boundary dimensions and
load ratings.

The ratings of ISO 281 and ISO 76 are functions of ball diameter, number of balls, pitch diameter
and contact angle alone as long as the grooves are not wide. Balls come in standard sizes and whole
numbers. So the pair (D, Z) whose computed ratings come nearest to the catalogue's is looked for;
for makers who rate by the standards without a factor of their own it fits within a percent, and
the next best pair misses by some percent. docs/user/libraries.md has the errors.

Other makers rate higher: SKF's C of Explorer bearings are 1.04 to 1.06 of NSK's of the same size,
with the same balls, their C_0 equal. `ball_sets` knows both ways to rate, and weighs how the balls
fill section and pitch circle; several sets come into question, which a measured frequency of ball
passage tells apart. A measured stiffness goes with the grooves as much as with the balls: it is
weighed by its span over the grooves' range.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import asin, cos, degrees, hypot, isfinite, log, pi
from typing import Any

from oilfilm.ehl.units import MILLIMETRE

from ..geometry import Bearing, contact_angle_to_clearance
from ..library.catalogue import (
    FEWEST_BALLS,
    INCH,
    INNER_CONFORMITY,
    OUTER_CONFORMITY,
    TYPICAL_BALL,
    Geometry,
    ball_sizes,
    clearance_class,
    estimated_entry,
    from_dimensions,
    from_ratings,
    full_complement,
    grooves_of,
    nearest_series,
    typical_fill,
    typical_number,
)
from ..material import load_material
from ..quasistatic.thrust import stiffness_at_rest
from .load_rating import dynamic_rating, static_rating

BALL_TO_SECTION = (0.20, 0.38)  # smallest and largest D over D_o - d that are tried [-]
# ln(1.5), of the ratings of a new bearing: makers rate up to a sixth above the standards, of the
# catalogue the worst is missed by 3 %; what is missed by more is another bearing, or in newtons
WORST_MISFIT = 0.405
# factors of makers on C and C_0 over those computed: NSK's (docs/user/libraries.md); SKF's of
# Explorer bearings (twelve sizes of the series 60, 62, 63, ratings from memory, unverified) [-]
RATING_STYLES = ((1.0, 0.992), (1.05, 0.988))
# scatter of their logarithms, about what those sizes have [-]
DYNAMIC_SCATTER = 0.012
STATIC_SCATTER = 0.010
# scatter of the share of the pitch circle that balls fill and of D over D_o - d, a little above
# that of the catalogue's bearings within a series [-]
FILL_SCATTER = 0.03
SECTION_SCATTER = 0.02
BPFO_SCATTER = 0.005  # of the logarithm of a measured frequency: contact angle and slip, assumed
LARGEST_SURPLUS = 12.0  # of the sum of squares over the least, of a set that is listed [-]
MOST_SETS = 4
MOST_OFF = 4.0  # scatters of a measured frequency or stiffness from the nearest set
FINEST_STEP = INCH / 64.0  # between ball sizes that makers use up to an inch, as 12.303 mm
WORST_FACTOR = 0.2  # of the logarithm of a rating, beyond which a set is not weighed [-]
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


def _bearing(
    data: CatalogueData,
    ball: float,
    balls: int,
    conformities: tuple[float, float] = (INNER_CONFORMITY, OUTER_CONFORMITY),
    clearance: float | None = None,
) -> Bearing:
    """A bearing with this ball, in steel; clearance [m], by default that of the angle."""
    steel = load_material("bearing steel")
    inner, outer = (one * ball for one in conformities)
    if clearance is None:
        clearance = contact_angle_to_clearance(data.contact_angle, inner, outer, ball)
    return Bearing(
        name="estimate",
        ball_diameter=ball,
        pitch_diameter=data.pitch,
        balls=balls,
        inner_groove_radius=inner,
        outer_groove_radius=outer,
        diametral_clearance=clearance,
        ball_material=steel,
        inner_ring_material=steel,
        outer_ring_material=steel,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class BallSet:
    """Balls that come into question for a bearing."""

    ball_diameter: float  # [m]
    balls: int
    outer_passages: float  # balls past a point of the outer ring, in a turn [-]
    misfit: float  # sum of squares over the scatter of each property [-]

    @property
    def text(self) -> str:
        """Number, diameter, and passages a turn."""
        diameter = f"{self.balls} x {self.ball_diameter / MILLIMETRE:.6g} mm"
        return f"{diameter} (BPFO {self.outer_passages:.3f} a turn)"


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredStiffness:
    """Stiffness of a bearing at rest along its load, one of both loads."""

    stiffness: float  # [N/m]
    radial_load: float = 0.0  # [N]
    axial_load: float = 0.0  # [N]

    def misfit(self, data: CatalogueData, ball: float, balls: int) -> float:
        """Square of the difference from balls with typical grooves, over half the span that the
        grooves' range gives; logarithms.

        Parameters
        ----------
        data : CatalogueData
            boundary dimensions; a deep groove bearing has the middle of the clearance class CN
        ball : float
            diameter of the balls [m]
        balls : int
            their number [-]

        Returns
        -------
        float
            misfit [-]
        """
        usual, tight, wide = (log(value) for value in self.of_balls(data, ball, balls))
        return ((log(self.stiffness) - usual) / (0.5 * abs(tight - wide))) ** 2

    def of_balls(self, data: CatalogueData, ball: float, balls: int) -> tuple[float, ...]:
        """Stiffness of a bearing with typical grooves, with tight and with wide ones.

        Parameters
        ----------
        data : CatalogueData
            boundary dimensions
        ball : float
            diameter of the balls [m]
        balls : int
            their number [-]

        Returns
        -------
        tuple[float, ...]
            the three values [N/m]
        """
        angle = degrees(data.contact_angle)
        conformities, ranges = grooves_of(angle)
        play = None if angle else 0.5e-6 * sum(clearance_class(data.bore / MILLIMETRE, "CN"))
        pairs = (conformities, *zip(*ranges, strict=True))
        bearings = (_bearing(data, ball, balls, pair, play) for pair in pairs)
        return tuple(stiffness_at_rest(one, self.radial_load, self.axial_load) for one in bearings)


def ball_sets(
    data: CatalogueData,
    outer_passages: float | None = None,
    stiffness: MeasuredStiffness | None = None,
) -> tuple[BallSet, ...]:
    """Balls that come into question, the likeliest first.

    Sum of (difference/scatter)^2 over ratings, fill and section, and a measured number of
    passages or stiffness; ratings by the way to rate of `RATING_STYLES` that fits better.

    Parameters
    ----------
    data : CatalogueData
        boundary dimensions, and ratings as far as known [m], [N]
    outer_passages : float | None, optional
        measured ball passages of the outer ring in a turn of the inner one [-]
    stiffness : MeasuredStiffness | None, optional
        measured stiffness, weighed among the sets that come into question

    Returns
    -------
    tuple[BallSet, ...]
        sets, none where no balls fit

    Raises
    ------
    ValueError
        if nothing comes near what is given
    """
    section = data.outside_diameter - data.bore
    smallest, largest = (fraction * section for fraction in BALL_TO_SECTION)
    inch = round(INCH / FINEST_STEP)
    fine = (number * FINEST_STEP for number in range(1, inch + 1))
    sizes = {*ball_sizes(smallest, largest), *(d for d in fine if smallest <= d <= largest)}
    sets = [
        _ball_set(data, _bearing(data, ball, balls), outer_passages)
        for ball in sorted(sizes)
        for balls in range(FEWEST_BALLS, full_complement(ball, data.pitch) + 1)
    ]
    ranked = sorted((one for one in sets if one is not None), key=lambda one: one.misfit)
    chosen = [one for one in ranked if one.misfit <= ranked[0].misfit + LARGEST_SURPLUS]
    if stiffness is not None and chosen:
        chosen = _weighed(chosen, data, stiffness)
    if outer_passages is not None and ranked:
        best = ranked[0].outer_passages
        if abs(log(best / outer_passages)) > MOST_OFF * BPFO_SCATTER:
            raise ValueError(
                f"{outer_passages:g} passages of balls a turn, which no balls have that fit in; "
                f"the nearest {best:.3f}"
            )
    return tuple(chosen[:MOST_SETS])


def _weighed(
    sets: Sequence[BallSet], data: CatalogueData, stiffness: MeasuredStiffness
) -> list[BallSet]:
    """Sets with a measured stiffness among their misfits, those of another one left out."""
    off = [stiffness.misfit(data, one.ball_diameter, one.balls) for one in sets]
    found = [
        replace(one, misfit=one.misfit + more)
        for one, more in zip(sets, off, strict=True)
        if more < MOST_OFF**2
    ]
    if not found:
        usual = [1e-6 * stiffness.of_balls(data, one.ball_diameter, one.balls)[0] for one in sets]
        value = 1e-6 * stiffness.stiffness
        raise ValueError(
            f"a stiffness of {value:g} N/um, which no balls have that fit in; "
            f"theirs are {min(usual):.3g} to {max(usual):.3g}"
        )
    return sorted(found, key=lambda one: one.misfit)


def _ball_set(
    data: CatalogueData, bearing: Bearing, outer_passages: float | None
) -> BallSet | None:
    """A bearing as a set with its misfit; None where a rating is out of question."""
    dynamic = _log_factor(data, bearing, data.dynamic_rating, dynamic_rating)
    if dynamic is not None and abs(dynamic) > WORST_FACTOR:
        return None
    static = _log_factor(data, bearing, data.static_rating, static_rating)
    if static is not None and abs(static) > WORST_FACTOR:
        return None
    misfit = min(
        (0.0 if dynamic is None else ((dynamic - log(c)) / DYNAMIC_SCATTER) ** 2)
        + (0.0 if static is None else ((static - log(c_0)) / STATIC_SCATTER) ** 2)
        for c, c_0 in RATING_STYLES
    )
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    fill = bearing.balls * asin(ratio) / pi - typical_fill(degrees(data.contact_angle))
    share = bearing.ball_diameter / (data.outside_diameter - data.bore) - TYPICAL_BALL
    misfit += (fill / FILL_SCATTER) ** 2 + (share / SECTION_SCATTER) ** 2
    passages = 0.5 * bearing.balls * (1.0 - ratio * cos(data.contact_angle))
    if outer_passages is not None:
        misfit += (log(passages / outer_passages) / BPFO_SCATTER) ** 2
    return BallSet(
        ball_diameter=bearing.ball_diameter,
        balls=bearing.balls,
        outer_passages=passages,
        misfit=misfit,
    )


def _log_factor(
    data: CatalogueData,
    bearing: Bearing,
    published: float | None,
    rating: Callable[[Bearing, float], float],
) -> float | None:
    """ln of a rating over that of the geometry; None where the maker gives none."""
    return None if published is None else log(published / rating(bearing, data.contact_angle))


def estimate_bearing(
    data: CatalogueData,
    outer_passages: float | None = None,
    stiffness: MeasuredStiffness | None = None,
) -> dict[str, Any]:
    """Keys of a case's [bearing] table for a bearing whose boundary dimensions alone are known.

    The internal geometry follows from the ratings where the data have any (`estimate_geometry`),
    else it is typical of the boundary dimensions; a deep groove bearing gets the clearance of the
    class CN, grooves are assumed.

    Parameters
    ----------
    data : CatalogueData
        boundary dimensions and ratings of the catalogue [m], [N]
    outer_passages : float | None, optional
        measured ball passages of the outer ring in a turn of the inner one [-]
    stiffness : MeasuredStiffness | None, optional
        measured stiffness

    Returns
    -------
    dict[str, Any]
        keys of the table, with `source` (text), `estimated` (keys), `range` (an interval of each)
        and `ball_sets` (texts, the likeliest first; none without ratings or passages)

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
    geometry, sets = _geometry(data, outer_passages, stiffness)
    entry = estimated_entry((bore, outside, width), angle, geometry, ratings)
    series = nearest_series(bore, outside, angular=data.contact_angle > 0.0)
    return {**entry, "skf_series": series, "ball_sets": [one.text for one in sets]}


def _geometry(
    data: CatalogueData, outer_passages: float | None, stiffness: MeasuredStiffness | None
) -> tuple[Geometry, tuple[BallSet, ...]]:
    """Geometry with its intervals, and the sets of balls that come into question."""
    rated = data.dynamic_rating is not None or data.static_rating is not None
    if not rated and outer_passages is None and stiffness is None:
        arguments = (data.bore, data.outside_diameter, data.contact_angle, data.width)
        return from_dimensions(*arguments), ()
    if rated:
        _check_ratings(data)
    sets = ball_sets(data, outer_passages, stiffness)
    if not sets:
        raise ValueError("no standard balls fit in that have these ratings")
    best = sets[0]
    known = {
        "the ratings": rated,
        "the measured ball passages": outer_passages is not None,
        "the measured stiffness": stiffness is not None,
    }
    what = " and ".join(name for name, given in known.items() if given)
    basis = f"ball, balls: estimated from {what}"
    geometry = from_ratings(best.ball_diameter, data.pitch, best.balls, basis)
    diameters = [one.ball_diameter for one in sets]
    numbers = [one.balls for one in sets]
    low, high = geometry.ball_range
    fewest, most = geometry.balls_range
    widest = replace(
        geometry,
        ball_range=(min(low, *diameters), max(high, *diameters)),
        balls_range=(min(fewest, *numbers), max(most, *numbers)),
    )
    return widest, sets


def _check_ratings(data: CatalogueData) -> None:
    """ValueError where no balls have ratings near those given."""
    pair = estimate_geometry(data)
    if pair.misfit > WORST_MISFIT:
        named = {"C": pair.dynamic_error, "C_0": pair.static_error}
        ratios = [f"{key} {1.0 + e:.3g}" for key, e in named.items() if e is not None]
        raise ValueError(
            f"ratings that no balls have which fit in: the nearest have {', '.join(ratios)} times "
            "those given; allowed: 0.67 to 1.5 times. A wrong unit?"
        )

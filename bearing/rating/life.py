"""Rating life of a ball bearing from its solved ball loads, after ISO 281 and ISO 16281, its
static safety, and the interval of relubrication of its grease.

The standards themselves were not read: formulas and constants come from public transcriptions that
agree with each other (docs/theory/life.md says which). They cover one row of balls between rings
of hardened bearing steel, the balls of steel or of silicon nitride (DIN ISO 281 Supplement 5 and
ISO 20056-1, after their published abstracts: the dynamic rating of a hybrid is that of the steel
bearing). For any other material no life is given.

Relubrication after t_f = 10 [14e6/(n sqrt(d)) - 4 d] hours, n in r/min, d the bore in mm: the
closed form of makers' diagrams for radial ball bearings that maintenance handbooks pass on (two
agreeing transcriptions; the maker's own diagram was not read). It holds for lithium grease, a
horizontal shaft, clean surroundings and 70 degrees Celsius at the outer ring; every 15 K more
halve it (SKF catalogue), less is not made use of.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import degrees, hypot, pi, radians, sqrt

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.units import HOUR, MILLIMETRE, MILLION, RPM, ZERO_CELSIUS

from ..geometry import Bearing, Race, contact_modulus, reduced_radii
from ..material import MaterialKind
from ..operation import RatingInput
from ..quasistatic.solution import QuasistaticSolution
from .load_rating import (
    STATIC_PRESSURE,
    ball_ratings,
    dynamic_rating,
    fatigue_load_limit,
    geometry_not_rated,
    static_equivalent_load,
    static_rating,
    wide_grooves,
)

LARGEST_CONTACT_ANGLE = radians(45.0)  # a steeper bearing is a thrust bearing in the standards
# constants of ISO 281 and ISO 16281 after public transcriptions, see docs/theory/life.md [-]
LIFE_EXPONENT = 3.0  # of point contact
ROWS_EXPONENT = 0.7  # of the number of rows in C_r
ROTATING = 3.0  # exponents of the equivalent ball load of a ring that turns relative to the load
STATIONARY = 10.0 / 3.0  # and of one that stands
LARGEST_LOAD_SHARE = 0.5  # P/C_r up to which the life formula holds
# P/C_r below which balls may slide: rule for ball bearings, SKF, "Requisite minimum load"
# (www.skf.com, bearing selection process) [-]
MINIMUM_LOAD_SHARE = 0.01
SMALLEST_KAPPA = 0.1
LARGEST_KAPPA = 4.0
LARGEST_A_ISO = 50.0
# SKF's revised diagram of nu_1 over that of ISO 281, from points printed with it: 10.4 mm^2/s at
# 72.5 mm and 1800 r/min, 11 at 380 mm and 500 r/min; within 2 % of each [-]
SKF_DIAGRAM = 0.835
RELIABILITY = (  # a_1 of ISO 281 over the reliability [%]
    (90.0, 1.0),
    (95.0, 0.64),
    (96.0, 0.55),
    (97.0, 0.47),
    (98.0, 0.37),
    (99.0, 0.25),
    (99.5, 0.175),
    (99.9, 0.093),
)
A_ISO_PIECES = (  # kappa up to, constant, exponent; continuous at 0.4 and 1
    (0.4, 2.2649, 0.054381),
    (1.0, 1.9987, 0.19087),
    (LARGEST_KAPPA, 1.9987, 0.071739),
)

BALL_BEARINGS = 10.0  # factor of radial ball bearings [-]
GRADE_TEMPERATURE = 70.0 + ZERO_CELSIUS  # up to which the interval holds [K]
HALVING = 15.0  # rise of temperature that halves it [K]
LONGEST = 30000.0  # h, beyond which a grease is taken for life; maintenance standards cap at 32000


@dataclass(frozen=True, slots=True, kw_only=True)
class LifeRating:
    """Rating life; None where it does not apply, the reason in `messages`."""

    rating: RatingInput
    dynamic_rating: float | None = None  # C_r as given or computed [N]
    equivalent_load: float | None = None  # P_ref, dynamic equivalent reference load [N]
    basic_life: float | None = None  # L_10r, at 90 % reliability [revolutions]
    modified_life: float | None = None  # L_10mr [revolutions]
    # kappa = nu/nu_1, from the viscosity at the temperature of operation alone
    viscosity_ratio: float | None = None  # [-]
    life_factor: float | None = None  # a_ISO [-]
    reliability_factor: float = 1.0  # a_1, in the modified life [-]
    fatigue_load_limit: float | None = None  # C_u [N]
    # (4200 MPa/p_max)^3 over the heaviest contact, steel on steel
    static_safety: float | None = None  # [-]
    # C_0 as given or computed, and P_0 of the external loads, of the row that carries most
    static_rating: float | None = None  # [N]
    static_load: float | None = None  # [N]
    static_safety_factor: float | None = None  # S_0 = C_0/P_0 [-]
    shaft_speed: float = 0.0  # of one ring against the other [rad/s]
    messages: tuple[str, ...] = ()

    @property
    def minimum_load(self) -> float | None:
        """Equivalent load that keeps the balls rolling, by a rule of makers [N]."""
        return None if self.dynamic_rating is None else MINIMUM_LOAD_SHARE * self.dynamic_rating

    @property
    def diagram_ratio(self) -> float | None:
        """kappa with nu_1 of SKF's revised diagram [-]."""
        return None if self.viscosity_ratio is None else self.viscosity_ratio / SKF_DIAGRAM

    @property
    def basic_life_time(self) -> float | None:
        """L_10rh, the basic life at the speed of operation [s]."""
        return time_of(self.basic_life, self.shaft_speed)

    @property
    def modified_life_time(self) -> float | None:
        """L_10mrh, the modified life at the speed of operation [s]."""
        return time_of(self.modified_life, self.shaft_speed)


def without_oil(life: LifeRating) -> LifeRating:
    """The rating where the oil does not flow: basic life and safety only.

    Parameters
    ----------
    life : LifeRating
        with an oil that flows

    Returns
    -------
    LifeRating
        without viscosity ratio and modified life
    """
    message = "life: kappa, a_iso and modified rating null, the oil does not flow"
    others = [one for one in life.messages if not one.startswith("life: kappa ")]
    return replace(
        life,
        viscosity_ratio=None,
        life_factor=None,
        modified_life=None,
        messages=(*others, message),
    )


def time_of(life: float | None, speed: float) -> float | None:
    """Time of a life at a speed.

    Parameters
    ----------
    life : float | None
        number of revolutions, None without one [revolutions]
    speed : float
        speed of one ring against the other [rad/s]

    Returns
    -------
    float | None
        time [s]; None without a life or a speed
    """
    return 2.0 * pi * life / speed if life is not None and speed else None


def bearing_life(
    solution: QuasistaticSolution, lubricant: Lubricant, rating: RatingInput
) -> LifeRating:
    """Basic and modified reference rating life, ISO 16281, from the ball loads of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        oil at the temperature of operation
    rating : RatingInput
        ratings of the catalogue and contamination

    Returns
    -------
    LifeRating
        lives [revolutions], ratings [N] and static safety, each None with a message if it does not
        apply

    Examples
    --------
    >>> from oilfilm.bearing import Operation, RatingInput, bearing_life, load_lubricant
    >>> from oilfilm.bearing import load_bearing, solve_quasistatic
    >>> operation = Operation(inner_speed=300.0, force=(0.0, 3000.0, 0.0))
    >>> solution = solve_quasistatic(load_bearing("6208"), operation)
    >>> oil = load_lubricant("iso vg 32", operation.temperature)
    >>> life = bearing_life(solution, oil, RatingInput(contamination_factor=0.5))
    >>> f"{life.basic_life / 1e6:.0f} million revolutions, a_ISO {life.life_factor:.1f}"
    '857 million revolutions, a_ISO 20.5'
    """
    bearing = solution.bearing
    dry = "it runs dry, which no standard rates" if lubricant.dry else ""
    lost = "" if solution.converged else "there is no equilibrium"
    reason = dry or _not_covered(bearing) or lost
    if reason:
        return LifeRating(rating=rating, messages=(f"life: null, {reason}",))
    angle = rating.nominal_contact_angle
    speed = solution.operation.shaft_speed
    viscosity = lubricant.viscosity / lubricant.density
    kappa = viscosity_ratio(viscosity, speed, bearing.pitch_diameter) if speed else None
    partial, messages = _static(
        LifeRating(rating=rating, viscosity_ratio=kappa, shaft_speed=speed), solution
    )
    reason_without = _no_life(solution, rating, speed)
    if kappa is None or reason_without:
        return replace(
            partial,
            messages=(*messages, f"life: basic and modified rating null, {reason_without}"),
        )
    capacity = rating.dynamic_rating or dynamic_rating(bearing, angle)
    life = reference_life(solution, capacity, angle)
    rows = len(solution.rows)
    capacity *= rows**ROWS_EXPONENT
    load = capacity / life ** (1.0 / LIFE_EXPONENT)
    limit = rows * fatigue_load_limit(bearing, angle)
    factor = None
    if rating.contamination_factor is not None and kappa >= SMALLEST_KAPPA:
        factor = life_factor(kappa, rating.contamination_factor * (limit / load))
    reliability = reliability_factor(rating.reliability)
    return replace(
        partial,
        dynamic_rating=capacity,
        equivalent_load=load,
        basic_life=MILLION * life,
        modified_life=None if factor is None else MILLION * life * factor * reliability,
        life_factor=factor,
        reliability_factor=reliability,
        fatigue_load_limit=limit,
        messages=(*messages, *_remarks(solution, rating, (viscosity, kappa), load / capacity)),
    )


def _not_covered(bearing: Bearing) -> str:
    """Reason why the standards do not cover the materials, empty if they do."""
    for ring in (bearing.inner_ring_material, bearing.outer_ring_material):
        if ring.kind is not MaterialKind.BEARING_STEEL:
            material = f"{ring.name!r} (kind {ring.kind.value!r})"
            return f"the standards rate rings of hardened bearing steel only, not of {material}"
    ball = bearing.ball_material
    if ball.kind is not MaterialKind.OTHER:
        return ""
    return (
        f"the standards rate balls of bearing steel or silicon nitride only, not of {ball.name!r}"
    )


def _static(partial: LifeRating, solution: QuasistaticSolution) -> tuple[LifeRating, list[str]]:
    """Static safety by pressure and by S_0 = C_0/P_0, and what is left out."""
    bearing = solution.bearing
    angle = partial.rating.nominal_contact_angle
    messages = []
    safety = None
    capacity = partial.rating.static_rating
    hybrid = bearing.ball_material.kind is not MaterialKind.BEARING_STEEL
    if hybrid:
        messages.append(
            "life.static_safety: null, the permissible pressure of a hybrid is not known here"
        )
    elif pressure := _largest_pressure(solution):
        safety = (STATIC_PRESSURE / pressure) ** 3
    if capacity is None and hybrid:
        messages.append(
            "life: static rating and S_0 null, give the basic_static_rating_kN of the hybrid"
        )
    elif capacity is None:
        capacity = static_rating(bearing, angle)
        messages.append(
            "life: static rating computed from the geometry, no basic_static_rating_kN was given"
        )
    loads = [
        static_equivalent_load(hypot(y, z), abs(float(x)), angle)
        for x, y, z in solution.row_load[:, :3]
    ]
    load = max((row_load for row_load in loads if row_load is not None), default=None)
    if load is None:
        messages.append(
            "life: P_0 and S_0 null, factors X_0, Y_0 are known for contact angles of 0 and 15 "
            "to 40 deg"
        )
    partial = replace(
        partial,
        static_safety=safety,
        static_rating=capacity,
        static_load=load,
        static_safety_factor=capacity / load if capacity is not None and load else None,
    )
    return partial, [*messages, *overload(partial)]


def overload(life: LifeRating) -> Iterator[str]:
    """Message of a permanent deformation of ball and race, for a static safety below 1, ISO 76.

    Parameters
    ----------
    life : LifeRating
        rated bearing

    Yields
    ------
    Iterator[str]
        one message, or none
    """
    safeties = {"S_0": life.static_safety_factor, "static safety by pressure": life.static_safety}
    low = [f"{name} = {value:.3g}" for name, value in safeties.items() if value and value < 1.0]
    if low:
        yield Caution(
            f"life: {', '.join(low)}, beyond the static rating: ball and race keep a deformation "
            "of more than 0.0001 of the ball diameter (ISO 76)"
        )


def _no_life(solution: QuasistaticSolution, rating: RatingInput, speed: float) -> str:
    """Reason why there is no basic life, empty if there is one."""
    if not speed:
        return "the rings do not turn against each other"
    if not (solution.inner_load > 0.0).any():
        return "no ball loads the inner ring"
    angle = rating.nominal_contact_angle
    if angle > LARGEST_CONTACT_ANGLE:
        return f"a nominal contact angle of {degrees(angle):.4g} deg is that of a thrust bearing"
    return "" if rating.dynamic_rating is not None else geometry_not_rated(solution.bearing, angle)


def _remarks(
    solution: QuasistaticSolution, rating: RatingInput, oil: tuple[float, float], ratio: float
) -> Iterator[str]:
    """Remarks on a life. oil: kinematic viscosity [m^2/s] and kappa [-]."""
    viscosity, kappa = oil
    rows = len(solution.rows)
    null = "life: a_iso and modified rating null,"
    computed = (
        "life: dynamic rating computed from the geometry, no basic_dynamic_rating_kN was given"
    )
    if rows > 1:
        yield (
            f"life: C_r, P and C_u are those of the {rows} rows together, C_r {rows}^0.7 times "
            "that of one"
        )
    if rating.dynamic_rating is None:
        yield computed
        if wide_grooves(solution.bearing):
            yield (
                "life: dynamic rating lowered for grooves wider than 0.52 (inner) or 0.53 "
                "(outer) ball diameters"
            )
    wanted = viscosity / MILLIMETRE**2 / kappa
    yield (
        f"life: kappa {kappa:.3g} with nu_1 {wanted:.4g} mm2/s of ISO 281; kappa_skf "
        f"{kappa / SKF_DIAGRAM:.3g} with {SKF_DIAGRAM * wanted:.3g} of SKF's revised diagram"
    )
    if rating.reliability != RELIABILITY[0][0]:
        yield (
            f"life: modified rating at {rating.reliability:g} % reliability, a_1 "
            f"{reliability_factor(rating.reliability):.3g} of ISO 281; the basic rating at 90 %"
        )
    if rating.contamination_factor is None:
        yield f"{null} the case gives no [lubricant] contamination_factor"
    elif kappa < SMALLEST_KAPPA:
        yield f"{null} ISO 281 has no factor below kappa {SMALLEST_KAPPA}"
    if ratio > LARGEST_LOAD_SHARE:
        yield Caution(
            f"life: the equivalent load is {ratio:.3g} of the dynamic rating, beyond ISO 281, "
            f"which ends at {LARGEST_LOAD_SHARE}"
        )


def reference_life(solution: QuasistaticSolution, capacity: float, contact_angle: float) -> float:
    """Basic reference rating life, ISO 16281.

    L_10r = [sum over rows of (Q_ci/Q_ei)^(-10/3) + (Q_ce/Q_ee)^(-10/3)]^(-9/10), Q_e = (sum
    Q_j^p/Z)^(1/p), p = 3 for a ring that turns relative to the load and 10/3 for one that stands.
    The load stands in space.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium with the ball loads
    capacity : float
        C_r of one row [N]
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    float
        life [10^6 revolutions of one ring against the other]
    """
    inner, outer = ball_ratings(solution.bearing, capacity, contact_angle)
    operation = solution.operation
    total = 0.0
    for row in (solution.row(k) for k in range(len(solution.rows))):
        for loads, speed, rating in (
            (row.inner_load, operation.inner_speed, inner),
            (row.outer_load, operation.outer_speed, outer),
        ):
            load = equivalent_ball_load(loads, turning=speed != 0.0)
            total += (load / rating) ** (10.0 / 3.0)
    return float(total**-0.9)


def equivalent_ball_load(loads: Array, *, turning: bool) -> float:
    """Q_e of the ball loads on a ring, (sum Q^p/Z)^(1/p), ISO 16281.

    Parameters
    ----------
    loads : Array
        ball loads, shape (Z,) [N]
    turning : bool
        whether the ring turns relative to the load

    Returns
    -------
    float
        equivalent ball load [N]
    """
    exponent = ROTATING if turning else STATIONARY
    return float(np.mean(loads**exponent) ** (1.0 / exponent))


def viscosity_ratio(kinematic_viscosity: float, speed: float, pitch_diameter: float) -> float:
    """kappa = nu/nu_1, ISO 281.

    nu_1 = 45000 n^-0.83 d_m^-0.5 below 1000 r/min, 4500 n^-0.5 d_m^-0.5 from there, in mm^2/s with
    d_m in mm.

    Parameters
    ----------
    kinematic_viscosity : float
        at the temperature of operation [m^2/s]
    speed : float
        speed of one ring against the other, positive [rad/s]
    pitch_diameter : float
        d_m [m]

    Returns
    -------
    float
        viscosity ratio [-]
    """
    n = speed / RPM
    of_speed = 45000.0 * n**-0.83 if n < 1000.0 else 4500.0 * n**-0.5
    reference = of_speed * (pitch_diameter / MILLIMETRE) ** -0.5
    return kinematic_viscosity / (reference * MILLIMETRE**2)


def reliability_factor(reliability: float) -> float:
    """a_1 of ISO 281 over the reliability, ln a_1 linear in ln ln(1/S) between its values.

    Parameters
    ----------
    reliability : float
        share of bearings that reach the life, from 90 to 99.9 [%]

    Returns
    -------
    float
        factor on the life [-]

    Examples
    --------
    >>> [round(reliability_factor(share), 3) for share in (90.0, 95.0, 98.5, 99.0)]
    [1.0, 0.64, 0.311, 0.25]
    """
    shares, factors = np.array(RELIABILITY).T
    of = np.log(-np.log(np.append(shares, reliability) / 100.0))
    return float(np.exp(np.interp(-of[-1], -of[:-1], np.log(factors))))


def life_factor(kappa: float, limit: float) -> float:
    """a_ISO of radial ball bearings, ISO 281.

    a_ISO = 0.1 [1 - (2.5671 - c/kappa^e)^0.83 (e_C C_u/P)^(1/3)]^-9.3, at most 50, with kappa at
    most 4; (c, e) = (2.2649, 0.054381) below 0.4, (1.9987, 0.19087) up to 1, (1.9987, 0.071739) up
    to 4.

    Parameters
    ----------
    kappa : float
        viscosity ratio, from 0.1 [-]
    limit : float
        e_C C_u/P [-]

    Returns
    -------
    float
        life factor [-]

    Raises
    ------
    ValueError
        if kappa lies below 0.1
    """
    if kappa < SMALLEST_KAPPA:
        raise ValueError(f"kappa must be at least {SMALLEST_KAPPA}, got {kappa!r}")
    kappa = min(kappa, LARGEST_KAPPA)
    constant, exponent = next((c, e) for largest, c, e in A_ISO_PIECES if kappa <= largest)
    base = 1.0 - (2.5671 - constant / kappa**exponent) ** 0.83 * limit ** (1.0 / 3.0)
    return min(LARGEST_A_ISO, 0.1 * base**-9.3) if base > 0.0 else LARGEST_A_ISO


def _largest_pressure(solution: QuasistaticSolution) -> float:
    """Largest Hertz pressure of all contacts [Pa], 0 if none is loaded."""
    bearing = solution.bearing
    largest = 0.0
    for race, loads, angles in (
        (Race.INNER, solution.inner_load, solution.inner_contact_angle),
        (Race.OUTER, solution.outer_load, solution.outer_contact_angle),
    ):
        modulus = contact_modulus(bearing, race)
        for load, angle in zip(loads[loads > 0.0], angles[loads > 0.0], strict=True):
            radii = reduced_radii(bearing, race, float(angle))
            largest = max(largest, hertz_contact(float(load), *radii, modulus).pressure)
    return largest


def relubrication_interval(bore: float, speed: float, temperature: float) -> float | None:
    """Time after which grease is to be renewed.

    Parameters
    ----------
    bore : float
        bore diameter [m]
    speed : float
        speed of one ring against the other [rad/s]
    temperature : float
        temperature of the bearing [K]

    Returns
    -------
    float | None
        interval [s]; None if the formula gives none, at rest or too fast for it
    """
    if not speed:
        return None
    diameter = bore / MILLIMETRE
    hours = BALL_BEARINGS * (14e6 / (abs(speed) / RPM * sqrt(diameter)) - 4.0 * diameter)
    if hours <= 0.0:
        return None
    warm = max(0.0, temperature - GRADE_TEMPERATURE)
    return HOUR * min(LONGEST, hours) * 0.5 ** (warm / HALVING)

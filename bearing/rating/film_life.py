"""Modified rating life from the solved films: kappa of every contact inside the sum over balls.

ISO 281 takes one viscosity ratio for the whole bearing. Where every contact has its film, each has
its own kappa_j and a_ISO,j, and they enter where the standard's sum has the ball loads: a point of
a ring that turns against the load meets all balls in turn, so that its damage adds up (Palmgren
and Miner); points of a ring that stands keep their ball, and survive or fail by themselves
(Weibull, slope e = 10/9). With l_j = (Q_j/Q_c)^3/a_ISO,j, the damage of a contact,

    turning: D = (mean l_j)^e,   standing: D = mean l_j^e,   L = (sum of D over rings)^(-1/e).

With one a_ISO for all this is a_ISO L_10r of ISO 16281 (p = 3 and 10/3 = 3 e there). The stress
of a_ISO stays that of the bearing, e_C C_u/P: only the film is local. The rule kappa = lambda^1.3
comes from ISO/TR 1281-2 after second-hand quotations, and is unverified.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import MILLION

from ..contacts.contacts import NEGLIGIBLE_LOAD
from ..quasistatic.solution import QuasistaticSolution
from .life import SMALLEST_KAPPA, LifeRating, life_factor, time_of
from .load_rating import ball_ratings, dynamic_rating

WEIBULL_SLOPE = 10.0 / 9.0  # e of ball bearings [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmLife:
    """Modified life by the solved films, in place of the viscosity; None where it does not apply.

    `low` and `high` have the films at the ends of their error bars.
    """

    shaft_speed: float  # of one ring against the other [rad/s]
    smallest_kappa: float | None = None  # of all contacts with a resolved film [-]
    # with the smallest kappa for all contacts
    smallest_life_factor: float | None = None  # [-]
    smallest_life: float | None = None  # [revolutions]
    # with the kappa of each contact
    life_factor: float | None = None  # the life over L_10r [-]
    life: float | None = None  # [revolutions]
    low: float | None = None  # [revolutions]
    high: float | None = None  # [revolutions]
    note: str = ""  # why the life with the kappa of each contact is None

    @property
    def life_time(self) -> float | None:
        """The life with the kappa of each contact at the speed of operation [s]."""
        return time_of(self.life, self.shaft_speed)

    @property
    def low_time(self) -> float | None:
        """Its lower end [s]."""
        return time_of(self.low, self.shaft_speed)

    @property
    def high_time(self) -> float | None:
        """Its upper end [s]."""
        return time_of(self.high, self.shaft_speed)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactKappa:
    """kappa of the inner and the outer contact of every ball, None where no film is known [-]."""

    inner: Sequence[float | None]
    outer: Sequence[float | None]

    @property
    def smallest(self) -> float | None:
        """The smallest of all [-]."""
        known = (kappa for kappa in (*self.inner, *self.outer) if kappa is not None)
        return min(known, default=None)


def film_life(
    solution: QuasistaticSolution,
    rated: LifeRating,
    kappa: ContactKappa,
    low: ContactKappa,
    high: ContactKappa,
) -> FilmLife:
    """Life by the films of an equilibrium beside that of the standard.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    rated : LifeRating
        the standard's life
    kappa : ContactKappa
        of the contacts
    low : ContactKappa
        kappa at the lower ends of the films' error bars
    high : ContactKappa
        kappa at their upper ends

    Returns
    -------
    FilmLife
        life [revolutions]
    """
    found = FilmLife(shaft_speed=rated.shaft_speed, smallest_kappa=kappa.smallest)
    basic = rated.basic_life
    a_1 = rated.reliability_factor
    limit = stress_limit(rated)
    if basic is None or limit is None:
        return replace(found, note="there is no a_ISO")
    # 1. the smallest kappa for all contacts
    if found.smallest_kappa is not None and found.smallest_kappa >= SMALLEST_KAPPA:
        factor = life_factor(found.smallest_kappa, limit)
        found = replace(found, smallest_life_factor=factor, smallest_life=factor * basic * a_1)
    # 2. each contact with its own
    if missing := missing_films(solution, kappa):
        return replace(found, note=missing)
    least, life, most = (contact_life(solution, rated, k) for k in (low, kappa, high))
    if life is None:
        return replace(found, note=f"ISO 281 has no factor below kappa {SMALLEST_KAPPA}")
    low_life = None if least is None else least * a_1
    high_life = None if most is None else most * a_1
    factor = life / basic
    return replace(found, life_factor=factor, life=life * a_1, low=low_life, high=high_life)


def stress_limit(rated: LifeRating) -> float | None:
    """e_C C_u/P of a rating.

    Parameters
    ----------
    rated : LifeRating
        the standard's life

    Returns
    -------
    float | None
        ratio [-]; None where one of them is not given
    """
    cleanliness = rated.rating.contamination_factor
    limit = rated.fatigue_load_limit
    load = rated.equivalent_load
    return None if cleanliness is None or limit is None or not load else cleanliness * limit / load


def missing_films(solution: QuasistaticSolution, kappa: ContactKappa) -> str:
    """Message on the loaded contacts without kappa; but for those whose load is negligible and
    whose film therefore may be outside the model.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    kappa : ContactKappa
        of the contacts

    Returns
    -------
    str
        sentence; empty if there are none
    """
    heaviest = max(solution.inner_load.max(), solution.outer_load.max())
    missing = []
    for race, loads, values in (
        ("inner", solution.inner_load, kappa.inner),
        ("outer", solution.outer_load, kappa.outer),
    ):
        known = zip(loads, values, strict=True)
        count = sum(q > NEGLIGIBLE_LOAD * heaviest and k is None for q, k in known)
        missing += [f"{count} at the {race} race"] if count else []
    return f"loaded contacts without a resolved film: {', '.join(missing)}" if missing else ""


def contact_life(
    solution: QuasistaticSolution, rated: LifeRating, kappa: ContactKappa
) -> float | None:
    """Life with the kappa of each contact; one without has the factor 1.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    rated : LifeRating
        the standard's life
    kappa : ContactKappa
        of the contacts

    Returns
    -------
    float | None
        life [revolutions]; None where a kappa is below the smallest, at a load that counts
    """
    limit = stress_limit(rated)
    if limit is None:
        return None
    angle = rated.rating.nominal_contact_angle
    capacity = rated.rating.dynamic_rating or dynamic_rating(solution.bearing, angle)
    ratings = ball_ratings(solution.bearing, capacity, angle)
    speeds = (solution.operation.inner_speed, solution.operation.outer_speed)
    heaviest = float(max(solution.inner_load.max(), solution.outer_load.max()))
    total = 0.0
    for loads, values, speed, rating in zip(
        (solution.inner_load, solution.outer_load),
        (kappa.inner, kappa.outer),
        speeds,
        ratings,
        strict=True,
    ):
        factors = _life_factors(loads, values, limit, heaviest)
        if factors is None:
            return None
        damage = (loads / rating) ** 3 / factors
        for row in range(len(solution.rows)):
            total += ring_damage(damage[solution.row_of_ball == row], turning=speed != 0.0)
    return MILLION * float(total ** (-1.0 / WEIBULL_SLOPE))


def ring_damage(damage: Array, *, turning: bool) -> float:
    """Damage of a ring: (mean l)^e where it turns against the load, mean l^e where it stands.

    Parameters
    ----------
    damage : Array
        l of its contacts in 10^6 revolutions, shape (balls,) [-]
    turning : bool
        whether the ring turns against the load

    Returns
    -------
    float
        damage [-]
    """
    if turning:
        return float(np.mean(damage) ** WEIBULL_SLOPE)
    return float(np.mean(damage**WEIBULL_SLOPE))


def _life_factors(
    loads: Array, kappa: Sequence[float | None], limit: float, heaviest: float
) -> Array | None:
    """a_ISO of each contact, 1 of those without kappa; None where one is below the range, unless
    its load is negligible, which has the factor of the range's end.
    """
    factors = np.ones(len(loads))
    negligible = NEGLIGIBLE_LOAD * heaviest
    for j, (load, value) in enumerate(zip(loads, kappa, strict=True)):
        if load <= 0.0 or value is None:
            continue
        if value < SMALLEST_KAPPA and load > negligible:
            return None
        factors[j] = life_factor(max(value, SMALLEST_KAPPA), limit)
    return factors

"""Dry running: friction, heat, wear, flash temperature, and how long a cage feeds its film.

Nothing separates ball and race. Friction is Coulomb's with a coefficient of the pair, or of the
film that the cage transfers, and its range; wear is Archard's, a volume k for each unit of load
and sliding distance, so that the volume worn in a unit of time is k P/mu with the friction power
P. The flash temperature is Blok's for a band with the heat of Hertz' pressure,

    T = 1.11 mu w v/[(B_1 + B_2) sqrt(u 2a)],   w = (pi/2) p_h a,

with the largest product of pressure and sliding over the ellipse for p_h v, B = sqrt(k rho c) of
both bodies, u the rolling speed and 2a the length of the contact along it (Stolarski, Tribology in
Machine Design, chapter 3).

The film's supply is an estimate: a cage may lose from its pockets what doubles their play, a
share of `cage_pocket_clearance_over_ball` of the ball's diameter over half its surface facing the
pocket, and what the tracks wear comes from there.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sqrt

from ..contacts.contact import RACES, BearingContact
from ..contacts.contacts import entrainment_speeds
from ..contacts.stress import contact_stresses
from ..friction.coulomb import balanced_friction
from ..geometry import Bearing, Race
from ..library.plugins import library_data
from ..quasistatic.solution import QuasistaticSolution
from .dry_surface import DrySurface, Range

TYPICAL = "typical.toml"
BLOK = 1.11  # of a band whose heat is that of Hertz' pressure [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class DryRunning:
    """Results of dry running, each as value, low and high end."""

    surface: DrySurface
    friction: Range  # mu [-]
    power: Range  # of the sliding between balls and races [W]
    bulk: Range | None  # rise over the surroundings [K]; None without dimensions or a transfer
    flash: Range  # largest rise in a contact [K]
    wear: Range  # volume in a unit of time, both bodies [m^3/s]
    inner_depth: Range  # of the inner race's track, if all wear is its [m/s]
    outer_depth: Range
    film_life: Range | None  # of the cage's supply, an estimate [s]; None without a film


def dry_running(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    surface: DrySurface,
    coefficient: float,
    heat_transfer: float | None = None,
) -> DryRunning:
    """Heat, wear, flash temperature and life of the transferred film of a dry bearing.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : sequence of BearingContact
        all of its contacts, inner then outer, ball by ball
    surface : DrySurface
        the pair of surfaces
    coefficient : float
        mu of the case [-]
    heat_transfer : float | None, optional
        heat to the surroundings [W/K]; None: of a common heat flow from the seats, with its range

    Returns
    -------
    DryRunning
        results in SI units; ranges of friction are those of the surface
    """
    bearing = solution.bearing
    power = balanced_friction(solution, contacts, coefficient).power
    sliding = power / coefficient  # load times sliding distance in a unit of time [W]
    # another coefficient hardly moves the balls: the power goes with it
    shares = [1.0, *(end / surface.friction.value for end in surface.friction[1:])]
    heat = Range(*(share * float(power.sum()) for share in shares))
    wear = _times(float(sliding.sum()), surface.wear)
    flash = coefficient * _flash(solution, contacts)
    inner, outer = (
        _times(float(sliding[:, n].sum()) / _track(bearing, contacts, race), surface.wear)
        for n, race in enumerate(RACES)
    )
    return DryRunning(
        surface=surface,
        friction=Range(*(share * coefficient for share in shares)),
        power=heat,
        bulk=_bulk(bearing, heat, heat_transfer),
        flash=Range(*(share * flash for share in shares)),
        wear=wear,
        inner_depth=inner,
        outer_depth=outer,
        film_life=_film_life(bearing, wear) if surface.fed and wear.value > 0.0 else None,
    )


def _times(value: float, of: Range) -> Range:
    return Range(*(value * end for end in of))


def _bulk(bearing: Bearing, heat: Range, transfer: float | None) -> Range | None:
    """Rise over the surroundings [K]: by the case's transfer [W/K], else by a common heat flow."""
    if transfer is not None:
        return _times(1.0 / transfer, heat)
    if bearing.bore is None or bearing.outside_diameter is None or bearing.width is None:
        return None
    flow = library_data(TYPICAL)["heat_flow_W_m2_K"]
    seats = pi * bearing.width * (bearing.bore + bearing.outside_diameter)
    low, high = flow["range"]
    return Range(
        heat.value / (seats * flow["value"]), heat.low / (seats * high), heat.high / (seats * low)
    )


def _flash(solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> float:
    """Largest flash temperature of the contacts over the coefficient of friction [K]."""
    stresses = contact_stresses(solution, contacts)
    speeds = entrainment_speeds(solution)
    rises = [0.0]
    for contact, stress, speed in zip(contacts, stresses, speeds, strict=True):
        if stress is None or contact.hertz is None or not speed > 0.0:
            continue
        a = contact.hertz.semi_axis_x
        line = 0.5 * pi * a * stress.pressure_sliding
        rises.append(BLOK * line / (sum(contact.effusivities) * sqrt(speed * 2.0 * a)))
    return max(rises)


def _track(bearing: Bearing, contacts: Sequence[BearingContact], race: Race) -> float:
    """Area of the track of a race [m^2]."""
    own = [c for c in contacts if c.race is race and c.hertz is not None]
    width = max((2.0 * c.hertz.semi_axis_y for c in own if c.hertz), default=1.0)
    side = -1.0 if race is Race.INNER else 1.0
    return pi * (bearing.pitch_diameter + side * bearing.ball_diameter) * width


def _film_life(bearing: Bearing, wear: Range) -> Range:
    """Time in which the tracks wear what the pockets may lose [s]."""
    play = library_data(TYPICAL)["cage_pocket_clearance_over_ball"]
    half = 0.5 * pi * bearing.ball_diameter**2
    value, low, high = (
        0.5 * share * bearing.ball_diameter * half * bearing.balls
        for share in (play["value"], *play["range"])
    )
    return Range(value / wear.value, low / wear.high, high / wear.low)

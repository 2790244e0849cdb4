"""Films and torque over the range of what a flow of oil may leave on the tracks.

The share of the oil that lands on the tracks decides the film and is not known: 0.1 to 0.5 of a
jet by an estimate. A flow therefore gives a band, not a number.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ehl import ContactSolution

from ..contacts.contact import BearingContact
from ..quasistatic.solution import QuasistaticSolution
from ..supply.starved_films import (
    StarvedFilm,
    least_lambda,
    mean_share,
    of_driven_balls,
    starved_films,
)
from ..supply.supply import InletFilm, Supply, supplied_shares

Total = Callable[[Supply | InletFilm], float | None]  # torque at a supply [N m]


@dataclass(frozen=True, slots=True, kw_only=True)
class SupplyEnd:
    """One end of the band."""

    track_share: float  # of the flow that lands on the tracks [-]
    film_share: float  # mean of the balls that both races load, of the flooded film [-]
    film_share_least: float  # smallest of them [-]
    lambda_least: float  # smallest lambda ratio of them [-]; infinite without roughness
    total: float | None  # torque of the films at this end [N m]; None where it has none


@dataclass(frozen=True, slots=True, kw_only=True)
class SupplyBand:
    """Both ends: least and most oil on the tracks."""

    low: SupplyEnd
    high: SupplyEnd


@dataclass(frozen=True, slots=True, kw_only=True)
class SupplyTorque:
    """The torque of a bearing at its supply and beside it, by the same films and model [N m]; None
    where it has none.
    """

    scarce: float | None  # at the supply
    flooded: float | None  # with ample oil at every inlet, and as much in the cavity


def supply_band(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    supply: Supply,
    total: Total,
    roughness: tuple[float, float] | None = None,
    solutions: Sequence[ContactSolution | None] | None = None,
) -> SupplyBand | None:
    """Films and torque at both ends of the captured share [-]; None where no ball that both races
    load has a film.

    `roughness`: root mean square of inner race and balls, outer race and balls [m]; `solutions`:
    flooded films, or films with the flooded ones beside; formulas where one is missing.
    """
    ends = []
    for end in supply.band:
        films = _films(contacts, end, solution.bearing.balls, roughness, solutions)
        driven = of_driven_balls(solution, contacts, films)
        if not driven:
            return None
        ends.append(
            SupplyEnd(
                track_share=end.track_share,
                film_share=mean_share(driven),
                film_share_least=min(film.share for film in driven),
                lambda_least=least_lambda(driven),
                total=total(end),
            )
        )
    return SupplyBand(low=ends[0], high=ends[1])


def _films(
    contacts: Sequence[BearingContact],
    end: Supply,
    balls: int,
    roughness: tuple[float, float] | None,
    solutions: Sequence[ContactSolution | None] | None,
) -> list[StarvedFilm | None]:
    """Films at one end by the law of starvation, also where they were solved behind the layer of
    another share.
    """
    films: list[StarvedFilm | None] = []
    known = starved_films(contacts, end, balls, roughness, solutions)
    for contact, film, solution in zip(
        contacts, known, solutions or [None] * len(contacts), strict=True
    ):
        if film is not None and solution is not None and solution.supply is not None:
            shares = supplied_shares(contact, film.flooded_central, end, balls)
            film = replace(
                film,
                share=shares.central.value,
                minimum_share=shares.minimum.value,
                rolling_share=shares.rolling_moment.value,
            )
        films.append(film)
    return films

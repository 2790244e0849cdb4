"""Films and torque over the range of what a flow of oil may leave on the tracks.

The share of the oil that lands on the tracks decides the film and is not known: 0.1 to 0.5 of a
jet by an estimate. A flow therefore gives a band, not a number.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..contacts.contact import BearingContact
from ..films.asperities import Asperities
from ..films.film import Films
from ..films.operating import (
    OilAtInlets,
    least_lambda,
    mean_fraction,
    of_driven_balls,
    supplied_films,
)
from ..quasistatic.solution import QuasistaticSolution
from ..supply.supply import InletFilm, Supply

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
    films: Films,
    asperities: Asperities | None = None,
) -> SupplyBand | None:
    """Films, by the law of starvation, and torque at both ends of the captured share of a flow.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    supply : Supply
        Flow of oil.
    total : callable
        Torque of the bearing at a supply [N m]; None where it has none.
    films : sequence of ContactFilm or None
        As computed; formulas where one is missing.
    asperities : Asperities, optional
        Give the roughness of races and balls.

    Returns
    -------
    SupplyBand or None
        None where no ball that both races load has a film.
    """
    ends = []
    for end in supply.band:
        oil = OilAtInlets(oil=end, balls=solution.bearing.balls, as_solved=False)
        supplied = supplied_films(contacts, films, oil, asperities)
        driven = of_driven_balls(solution, contacts, supplied)
        if not driven:
            return None
        ends.append(
            SupplyEnd(
                track_share=end.track_share,
                film_share=mean_fraction(driven),
                film_share_least=min(film.supply.central for film in driven),
                lambda_least=least_lambda(driven),
                total=total(end),
            )
        )
    return SupplyBand(low=ends[0], high=ends[1])

"""Friction torque over the oil supply, first order: less film and rolling resistance, more
asperities, less churning.

Every contact keeps the fractions of its flooded films and of its rolling moment that the supply
leaves it (`supply`). Its sliding friction is that of film and asperities in the proportion of the
lambda ratio (`films.asperities`), on the lines of pure rolling. The balls plough through the oil
that stands in the cavity.

The fraction of a flow that lands on the tracks decides the film and is not known: 0.1 to 0.5 of a
jet by an estimate. A flow therefore gives a band of films and torque, not a number.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from oilfilm.ehl.oil.lubricant import Lubricant

from ..contacts.contact import BearingContact
from ..films.asperities import Asperities, asperity_share
from ..films.film import Films
from ..films.operating_film import (
    OilAtInlets,
    flooded_films,
    least_lambda,
    mean_fraction,
    of_driven_balls,
    supplied_films,
)
from ..friction.resistance import contact_rolling_power
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import InletOil, PrescribedInlet, Supply, cavity_volume, oil_fraction
from .inputs import FrictionInput
from .models import cage_and_drag
from .paper_models import pure_rolling_line_torque, sliding_contacts
from .skf import NO_LOSS


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvedTorque:
    """Friction torque at one supply."""

    rolling: float  # rolling resistance [N m]
    film: float  # sliding of the films [N m]
    asperity: float  # sliding of asperities [N m]
    cage: float  # [N m]
    drag: float  # churning [N m]
    # mean of the central films of the balls loaded at both races over the flooded ones [-]
    film_share: float
    lambda_least: float  # smallest minimum film over roughness of these contacts [-]
    oil_fraction: float  # of the cavity [-]
    flooded: float  # the total with flooded films, and the same oil in the cavity [N m]

    @property
    def total(self) -> float:
        """Sum of the five [N m]."""
        return self.rolling + self.film + self.asperity + self.cage + self.drag


class _OfFilms(NamedTuple):
    """Parts of the torque by the films [N m]."""

    rolling: float
    film: float
    asperity: float


def starved_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    supply: Supply | PrescribedInlet,
    films: Films | None = None,
) -> StarvedTorque:
    """Friction torque of a bearing at a supply.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    lubricant : Lubricant
        The oil.
    friction : FrictionInput
        Its `roughness` [m] and `boundary` [-] give the asperities' part, `coefficient` or mu_EHL
        that of the films, its `oil_fraction` [-] counts with a `PrescribedInlet`.
    supply : Supply or PrescribedInlet
        Oil at the inlets.
    films : sequence of ContactFilm or None, optional
        Films as computed; those of formulas where one is missing.

    Returns
    -------
    StarvedTorque
        [N m].

    Raises
    ------
    ValueError
        Without a roughness, at rest, or where a flooded film is not known.
    """
    speed = solution.operation.shaft_speed
    if friction.roughness is None:
        raise ValueError("roughness is needed for the torque over the supply")
    if speed == 0.0:
        raise ValueError("the rings do not turn against each other")
    known = films or (None,) * len(contacts)
    given = replace(friction, supply=supply, solved_supply=None, flooded=False)
    oil = given.oil_at_inlets(NO_LOSS, solution.bearing.balls)
    supplied = supplied_films(contacts, known, oil, friction.asperities)
    if any(
        film is None and c.conditions is not None
        for film, c in zip(supplied, contacts, strict=True)
    ):
        raise ValueError("needs films: no formula has those of an oil without pressure-viscosity")
    if isinstance(supply, PrescribedInlet):
        fraction = friction.oil_fraction or 0.0
    else:
        fraction = oil_fraction(supply, cavity_volume(solution.bearing))
    parts = _of_films(solution, contacts, friction, supplied)
    flooded = supplied_films(contacts, flooded_films(known), None, friction.asperities)
    ample = _of_films(solution, contacts, friction, flooded)
    in_cavity = replace(friction, supply=None, oil_fraction=fraction)
    resisted = cage_and_drag(solution, lubricant, in_cavity)
    cage, drag = resisted["cage"], resisted["drag"]
    driven = of_driven_balls(solution, contacts, supplied)
    return StarvedTorque(
        **parts._asdict(),
        cage=cage,
        drag=drag,
        film_share=mean_fraction(driven),
        lambda_least=least_lambda(driven),
        oil_fraction=fraction,
        flooded=sum(ample) + cage + drag,
    )


def _of_films(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: FrictionInput,
    films: Films,
) -> _OfFilms:
    """Rolling resistance, and the lines of pure rolling as films and asperities share them."""
    speed = solution.operation.shaft_speed
    of_film = friction.film_friction if friction.coefficient is None else friction.coefficient
    rolling = film = asperity = 0.0
    pairs = list(zip(contacts, films, strict=True))
    for contact, one in pairs:
        share = 1.0 if one is None else one.supply.rolling_moment
        rolling += share * contact_rolling_power(contact) / speed
    loaded = [one for contact, one in pairs if contact.hertz is not None]
    for one, lines in zip(loaded, sliding_contacts(solution, contacts), strict=True):
        share = 0.0 if one is None else asperity_share(one.lambda_ratio)
        slid = pure_rolling_line_torque([lines], speed, 1.0).total
        film += (1.0 - share) * of_film * slid
        asperity += share * friction.boundary * slid
    return _OfFilms(rolling, film, asperity)


Total = Callable[[InletOil], float | None]  # torque at a supply [N m]


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

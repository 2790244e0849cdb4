"""Films of a bearing's contacts with little oil: what a supply leaves of the flooded ones."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf

import numpy as np

from ehl import ContactSolution

from ..contacts.contact import BearingContact
from ..contacts.film_heat import film_heat, solved_with_heat
from ..contacts.film_numbers import film_numbers
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .supply import InletFilm, Supply, supplied_shares


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvedFilm:
    """Film of one contact at a supply."""

    share: float  # of the flooded central film [-]
    minimum_share: float  # of the flooded minimum film [-]
    rolling_share: float  # of the flooded rolling moment [-]
    flooded_central: float  # flooded films, isothermal but where solved with heat [m]
    flooded_minimum: float  # [m]
    # root mean square of race and ball together, zero where it is not known
    roughness: float = 0.0  # [m]
    # whether the flooded films were solved; else they are those of atlas and formulas
    solved: bool = False
    inside: bool = True  # whether the law of starvation was solved for such a contact
    flooded_heat: float = 1.0  # of the flooded films that the heat of the inlet leaves [-]

    @property
    def flooded(self) -> "StarvedFilm":
        """The same contact without limit of the supply."""
        return replace(self, share=1.0, minimum_share=1.0, rolling_share=1.0)

    @property
    def heat(self) -> float:
        """Of the starved film that heat leaves [-], see `HeatShare.at`."""
        return float(self.flooded_heat**self.rolling_share)

    @property
    def central(self) -> float:
        """Central film left, with heat [m]."""
        return self.heat * self.share * self.flooded_central

    @property
    def minimum(self) -> float:
        """Minimum film left, with heat [m], never above the central one."""
        return min(self.heat * self.minimum_share * self.flooded_minimum, self.central)

    @property
    def lambda_ratio(self) -> float:
        """Minimum film left over the roughness [-]; infinite without."""
        return self.minimum / self.roughness if self.roughness > 0.0 else inf


def starved_films(
    contacts: Sequence[BearingContact],
    supply: Supply | InletFilm,
    balls: int,
    roughness: tuple[float, float] | None = None,
    solutions: Sequence[ContactSolution | None] | None = None,
) -> tuple[StarvedFilm | None, ...]:
    """What a supply leaves of the film of every contact; None where no oil is entrained or no
    flooded film is known.

    `balls`: in one row [-]; `roughness`: root mean square of inner race and balls, outer race and
    balls [m]; `solutions`: flooded films; formulas where one is missing or did not converge.
    """
    rough = dict(zip(Race, roughness or (0.0, 0.0), strict=True))
    films: list[StarvedFilm | None] = []
    for contact, solution in zip(contacts, solutions or [None] * len(contacts), strict=True):
        film = None
        if solution is not None and solution.supply is not None:
            film = _behind_layer(solution, rough[contact.race])
            if film is not None:
                film = replace(film, flooded_heat=film_heat(contact).value)
        elif flooded := _flooded(contact, solution):
            central, minimum, solved = flooded
            shares = supplied_shares(contact, central, supply, balls)
            film = StarvedFilm(
                share=shares.central.value,
                minimum_share=shares.minimum.value,
                rolling_share=shares.rolling_moment.value,
                flooded_central=central,
                flooded_minimum=minimum,
                roughness=rough[contact.race],
                solved=solved,
                inside=shares.inside,
                flooded_heat=1.0
                if solved and solved_with_heat(solution)
                else film_heat(contact).value,
            )
        films.append(film)
    return tuple(films)


def _behind_layer(solution: ContactSolution, roughness: float) -> StarvedFilm | None:
    """Of a film that stands behind a layer; None where it did not converge."""
    central, minimum = solution.flooded_central, solution.flooded_minimum
    if central is None or minimum is None:
        return None
    assert solution.film_central is not None and solution.film_minimum is not None
    supply = solution.supply
    assert supply is not None
    return StarvedFilm(
        share=solution.film_central / central,
        minimum_share=solution.film_minimum / minimum,
        rolling_share=supply.rolling_moment_ratio,
        flooded_central=central,
        flooded_minimum=minimum,
        roughness=roughness,
        solved=True,
        inside=supply.law is None or supply.law.inside,
    )


def of_driven_balls(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[StarvedFilm | None],
) -> list[StarvedFilm]:
    """Films of the balls that both races load."""
    pairs = zip(films, contacts, strict=True)
    load = solution.inner_load
    return [film for film, contact in pairs if film is not None and load[contact.ball - 1] > 0.0]


def mean_share(films: Sequence[StarvedFilm]) -> float:
    """Mean share of the flooded film [-]; 1 of none."""
    return float(np.mean([film.share for film in films])) if films else 1.0


def least_lambda(films: Sequence[StarvedFilm]) -> float:
    """Smallest lambda ratio [-]; infinite of none."""
    return min((film.lambda_ratio for film in films), default=inf)


def _flooded(
    contact: BearingContact, solution: ContactSolution | None
) -> tuple[float, float, bool] | None:
    """Central and minimum film [m], and whether solved; None where no formula applies."""
    if contact.conditions is None or contact.hertz is None:
        return None
    if solution is not None and solution.converged:
        central, minimum = solution.film_central, solution.film_minimum
        if central is not None and minimum is not None:
            return central, minimum, True
    oil = contact.conditions.lubricant
    if not oil.piezoviscous:
        return None
    hertz = contact.hertz
    known = film_numbers(contact.conditions, (hertz.semi_axis_y, hertz.semi_axis_x))
    if known.ratio is None:
        return None
    return known.central, min(known.ratio, 1.0) * known.central, False

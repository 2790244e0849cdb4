"""Heat of films of formulas with the balls in balance: what the search for temperatures takes."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology

from ..contacts.contact import BearingContact
from ..contacts.last import LastOf
from ..friction.balance import BalancedFriction
from ..friction.films import film_balance
from ..friction.formula_films import formula_film
from ..friction.running_films import RunningFilm
from ..geometry import Array
from ..quasistatic.solution import QuasistaticSolution
from ..torque.films_torque import films_as_they_run
from ..torque.inlet import InletFactors
from ..torque.inputs import FrictionInput
from ..torque.shear_torque import no_balance_message
from .contact_conductances import contact_conductances
from .friction_heat import FrictionHeat, UndrivenBallsError, loaded_half

# films as they run, and the balls in balance on them
KnownFriction = tuple[Sequence[RunningFilm | None] | None, BalancedFriction | None]
UNKNOWN: KnownFriction = (None, None)


@dataclass(slots=True, kw_only=True)
class FilmsHeat:
    """Heat of one bearing in states that follow each other, each balance begun at the last."""

    friction: FrictionInput
    ends: bool = True  # whether the ends of conductances are wanted
    last: BalancedFriction | None = field(default=None)
    # the last equilibrium, its oil and its heat
    known: tuple[QuasistaticSolution, Lubricant, FrictionHeat] | None = field(default=None)

    def heat(
        self,
        solution: QuasistaticSolution,
        contacts: Sequence[BearingContact],
        oil: Lubricant,
        rheology: Rheology,
        inlet: InletFactors,
        known: KnownFriction = UNKNOWN,
    ) -> FrictionHeat:
        """Of films of formulas as they run, without seals [N m], [W]; `known`: these films, and
        the balls in balance on them, where they are known.

        Raises
        ------
        UndrivenBallsError
            If the balls find no balance.
        """
        if self.known is not None:
            before, same, heat = self.known
            # loads of one equilibrium at several temperatures are one array
            if before.inner_load is solution.inner_load and same == oil:
                return heat
        running, balance = known
        if running is None:
            none = (None,) * len(contacts)
            running = films_as_they_run(solution, contacts, none, self.friction, inlet)
        resistance = self.friction.resistance(solution.bearing, oil)
        if balance is None:
            balance = film_balance(solution, contacts, running, rheology, resistance, self.last)
        if not balance.converged:
            raise UndrivenBallsError(f"the torque of films: {no_balance_message(balance)}")
        self.last = balance
        pumped = np.array([0.0 if film is None else film.rolling_moment for film in running])
        pumped = pumped.reshape(-1, 2) * np.abs(balance.kinematics[..., 3])
        resisted = balance.resisted
        speed = solution.operation.shaft_speed
        found = FrictionHeat(
            torque=(float(balance.power.sum()) + resisted.heat) / speed,
            speed=speed,
            contact=balance.power - pumped,
            pumped=pumped,
            drag=resisted.drag,
            cage=resisted.pocket + resisted.land,
            conductance=running_conductances(solution, contacts, running, ends=self.ends),
            loaded=loaded_half(solution),
        )
        self.known = (solution, oil, found)
        return found


def formula_conductances(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> Array:
    """Of all contacts by films of formulas, (3, balls, 2) [W/K]."""
    found = [formula_film(contact) for contact in contacts]
    films = [None if film is None else (film.film, film.error) for film in found]
    temperature = solution.operation.temperature
    return contact_conductances(solution.bearing, contacts, films, temperature)


def running_conductances(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[RunningFilm | None],
    *,
    ends: bool = True,
) -> Array:
    """Of all contacts by their films as they run, (3, balls, 2) [W/K], made once for one tuple of
    them; `ends` as in `contact_conductances`.
    """
    objects = (films, contacts, solution.bearing, solution.operation, ends)
    return _LAST.of(objects, lambda: _conductances(solution, contacts, films, ends))


_LAST: LastOf[Array] = LastOf()


def _conductances(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[RunningFilm | None],
    ends: bool,
) -> Array:
    """As `running_conductances`."""
    pairs = [None if film is None else (film.film, film.error) for film in films]
    temperature = solution.operation.temperature
    return contact_conductances(solution.bearing, contacts, pairs, temperature, ends=ends)

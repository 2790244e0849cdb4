"""Heat of films of formulas with the balls in balance: what the search for temperatures takes."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ehl.arrays import Array
from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology

from ..contacts.contact import BearingContact
from ..films.film import Films
from ..films.formula import formula_films
from ..friction.balance import BalancedFriction
from ..friction.films import film_balance
from ..quasistatic.solution import QuasistaticSolution
from ..torque.inlet import InletFactors
from ..torque.inputs import FrictionInput
from ..torque.integrated import bearing_films
from ..torque.shear_torque import no_balance_message
from .contact_conductances import contact_conductances
from .friction_heat import FrictionHeat, UndrivenBallsError, loaded_half


@dataclass(frozen=True, slots=True, kw_only=True)
class OperatingState:
    """What is computed of one state of a bearing; None where it is not."""

    films: Films | None = None  # operating films of the contacts
    balance: BalancedFriction | None = None  # of the balls on these films
    conductances: Array | None = None  # through these films, (3, balls, 2) [W/K]


NOTHING_COMPUTED = OperatingState()


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
        computed: OperatingState = NOTHING_COMPUTED,
    ) -> FrictionHeat:
        """Heat of operating films of formulas, without seals.

        Parameters
        ----------
        solution : QuasistaticSolution
            Equilibrium of the bearing.
        contacts : sequence of BearingContact
            Its contacts.
        oil : Lubricant
            The oil.
        rheology : Rheology
            Of the oil.
        inlet : InletFactors
            What the inlets leave of the rolling moments [-].
        computed : OperatingState
            Films, balance and conductances of this state, where they are computed already.

        Returns
        -------
        FrictionHeat
            [N m], [W].

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
        operating, balance = computed.films, computed.balance
        if operating is None:
            none = (None,) * len(contacts)
            operating = bearing_films(solution, contacts, none, self.friction, inlet)
        resistance = self.friction.resistance(solution.bearing, oil)
        if balance is None:
            balance = film_balance(solution, contacts, operating, rheology, resistance, self.last)
        if not balance.converged:
            raise UndrivenBallsError(f"the torque of films: {no_balance_message(balance)}")
        self.last = balance
        pumped = np.array([0.0 if film is None else film.rolling_moment for film in operating])
        pumped = pumped.reshape(-1, 2) * np.abs(balance.kinematics[..., 3])
        resisted = balance.resisted
        speed = solution.operation.shaft_speed
        conductances = computed.conductances
        if conductances is None:
            conductances = film_conductances(solution, contacts, operating, ends=self.ends)
        found = FrictionHeat(
            torque=(float(balance.power.sum()) + resisted.heat) / speed,
            speed=speed,
            contact=balance.power - pumped,
            pumped=pumped,
            drag=resisted.drag,
            cage=resisted.pocket + resisted.land,
            conductance=conductances,
            loaded=loaded_half(solution),
        )
        self.known = (solution, oil, found)
        return found


def formula_conductances(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> Array:
    """Conductances of heat through isothermal films of formulas.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.

    Returns
    -------
    ndarray, shape (3, balls, 2)
        Value, low and high end [W/K].
    """
    return film_conductances(solution, contacts, formula_films(contacts))


def film_conductances(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    *,
    ends: bool = True,
) -> Array:
    """Conductances of heat through the films of all contacts of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Operating films of the contacts.
    ends : bool
        As in `contact_conductances`.

    Returns
    -------
    ndarray, shape (3, balls, 2)
        Value, low and high end [W/K].
    """
    temperature = solution.operation.temperature
    return contact_conductances(solution.bearing, contacts, films, temperature, ends=ends)

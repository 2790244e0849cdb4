"""Sources of the friction of balls on races, and that friction in the contacts of an equilibrium.

Torque models, traction equilibrium and the equations of motion take friction in one form: the
forces and moments (F_x, F_y, M_n, M_y) on the ball at a contact's centre, as a function of the
motion k = (S_x, S_y, Omega, omega) of ball against race (`contacts.motion`). The law of one
contact is an `ehl.traction.law.TractionLaw`. A `FrictionSource` is prepared about an equilibrium
(`refresh`: only films have to be solved) and bound to its contacts (`at`), which gives their
`ContactFriction`. A coefficient by the local sliding is added in
`ehl.traction.friction_coefficients`, for the equations of motion too; any other source is one
class like those in `friction_sources`.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant

from ..contacts.contact import BearingContact
from ..quasistatic.solution import QuasistaticSolution
from .resistance import NO_RESISTANCE, Resistance

TINY = 1.0e-300  # keeps quotients finite
# traction coefficient of films and tables that residual forces are measured against [-]
REFERENCE_TRACTION = 0.05


class Dissipation(NamedTuple):
    """Power phi (N,) [W], its gradient -(F_x, F_y, M_n, M_y) (N, 4) and its curvature (N, 4, 4) by
    the motion k, SI.
    """

    power: Array
    gradient: Array
    curvature: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactFriction:
    """Friction of all contacts of an equilibrium, as the balance of the balls takes it: dissipated
    power with its derivatives by the motions. Contacts are numbered inner race then outer, ball by
    ball.
    """

    # takes the motions (N, 4) of contacts [m/s], [rad/s] and their indices (N,), gives a
    # `Dissipation`
    evaluate: Callable[[Array, NDArray[np.int64]], Dissipation]
    # (contacts,) friction of each contact that residual forces are measured against [N]
    reference_force: Array
    # it knows no sliding across the rolling direction: balls then do not turn about the orbit's
    # tangent, and no gyroscopic couple is balanced
    longitudinal_only: bool = False
    has_rolling_resistance: bool = True  # the oil's rolling resistance is in it
    # the power is the potential of the forces; if not, it is left zero
    is_potential: bool = True
    # (contacts, m) numbers that the law of each contact depends on: contacts with equal ones have
    # the same law; None: each may have its own
    kinds: Array | None = None


class FrictionSource(ABC):
    """Source of the friction of balls on races, as a case names it."""

    @property
    @abstractmethod
    def description(self) -> str:
        """Origin of the friction, for messages."""

    @abstractmethod
    def at(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> ContactFriction:
        """Bind the friction to the contacts of an equilibrium, at its loads and contact angles.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        contacts : Sequence[BearingContact]
            its contacts, inner race then outer, ball by ball

        Returns
        -------
        ContactFriction
            friction of these contacts
        """

    def refresh(self, contacts: Sequence[BearingContact]) -> "Refreshed":
        """Prepare the source for equilibria with nearly these contacts.

        Parameters
        ----------
        contacts : Sequence[BearingContact]
            contacts at whose loads films are solved, where the source needs them

        Returns
        -------
        Refreshed
            prepared source; a message where that failed
        """
        del contacts
        return Refreshed(self)

    def load_change(self, contacts: Sequence[BearingContact]) -> float:
        """Measure the largest change of a load since `refresh`, over the largest load.

        Parameters
        ----------
        contacts : Sequence[BearingContact]
            contacts of the present equilibrium

        Returns
        -------
        float
            relative change [-]
        """
        del contacts
        return 0.0


class Refreshed(NamedTuple):
    """A prepared source; a `message` explains why that failed."""

    law: FrictionSource
    message: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class BallTraction:
    """Friction of balls on races and what holds the balls back."""

    source: FrictionSource
    lubricant: Lubricant  # of the contacts
    # drag of the oil around the balls and of the cage's guidance
    resistance: Resistance = NO_RESISTANCE

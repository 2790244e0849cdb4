"""The laws of friction of balls on races that a case can name: tables, coefficients, solved
films.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ehl.conditions import ContactConditions
from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution
from ehl.traction.laws import FourConstantLaw, FrictionLaw

from ..contacts.contact import BearingContact
from ..contacts.shape import contact_shape
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .coulomb import coulomb_law
from .films import Asperities, film_law
from .law import ContactLaw, TractionLaw
from .tables import contact_law

SolveFilms = Callable[[Sequence[ContactConditions | None]], Sequence[ContactSolution | None]]


@dataclass(frozen=True, kw_only=True)
class LawTraction(TractionLaw):
    """A friction law for each race: traction tables, or any other of `ehl.traction`."""

    laws: Mapping[Race, FrictionLaw]

    @property
    def description(self) -> str:
        """Where the friction comes from, for messages."""
        return "a law of each race (traction tables)"

    def at(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """The laws at the loads of an equilibrium [N]."""
        del solution
        return contact_law(contacts, [self.laws[contact.race] for contact in contacts])


@dataclass(frozen=True, kw_only=True)
class FourConstantTraction(TractionLaw):
    """mu = (A + B s) exp(-C s) + D over the ellipse of every contact, s the local slide over the
    entrainment speed.
    """

    # A to D [-], see `ehl.traction.laws.four_constants`
    constants: tuple[float, float, float, float]

    @property
    def description(self) -> str:
        """Where the friction comes from, for messages."""
        values = ", ".join(f"{constant:.4g}" for constant in self.constants)
        return f"law of four constants, (A + B s) exp(-C s) + D with {values}"

    def at(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """The law at the loads [N] and contact angles of an equilibrium."""
        a, b, c, d = self.constants
        laws = []
        for contact in contacts:
            shape = contact_shape(solution.bearing, contact.race, contact.contact_angle)
            laws.append(FourConstantLaw(shape, a=a, b=b, c=c, d=d))
        return contact_law(contacts, laws)


@dataclass(frozen=True, kw_only=True)
class CoulombTraction(TractionLaw):
    """Coulomb's friction over the ellipse, rounded at small sliding (`contact_ellipses`)."""

    friction: float  # mu [-]

    @property
    def description(self) -> str:
        """Where the friction comes from, for messages."""
        return f"Coulomb's law, mu = {self.friction:g}"

    def at(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """Friction at the loads of an equilibrium [N]."""
        return coulomb_law(solution, contacts, self.friction)


@dataclass(frozen=True, kw_only=True)
class FilmTraction(TractionLaw):
    """Shear of films solved for the contacts of the bearing, between two solves in proportion to
    the load.
    """

    # takes the conditions of contacts, None where there is none, and gives their films [m], [Pa]
    solve: SolveFilms
    rheology: Rheology
    # what carries part of the loads [N] where the films are thin; None: full films
    asperities: Asperities | None = None
    # empty before `refresh`
    films: tuple[ContactSolution | None, ...] = ()
    loads: tuple[float, ...] = ()  # that the films were solved at [N]

    @property
    def description(self) -> str:
        """Where the friction comes from, for messages."""
        return (
            "shear of the solved films, in proportion to the load between two rounds of solving "
            "them"
        )

    def refresh(self, contacts: Sequence[BearingContact]) -> Self:
        """With films solved at the loads of contacts [N]; ValueError names the contact whose film
        did not converge.
        """
        films = self.solve([contact.conditions for contact in contacts])
        for contact, film in zip(contacts, films, strict=True):
            if film is not None and not film.converged:
                raise ValueError(
                    f"the film of ball {contact.ball} at the {contact.race.value} race did not "
                    "converge"
                )
        loads = tuple(contact.load for contact in contacts)
        return replace(self, films=tuple(films), loads=loads)

    def at(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """Friction at the loads of an equilibrium [N], with the traction coefficients of the
        films.
        """
        pairs = zip(contacts, self.loads, strict=True)
        scale = np.array([contact.load / load if load > 0.0 else 0.0 for contact, load in pairs])
        return film_law(
            solution, contacts, self.films, self.rheology, self.asperities, scale=scale
        )

    def load_change(self, contacts: Sequence[BearingContact]) -> float:
        """Largest change of a load since the films were solved, over the largest load [-]."""
        load = np.array([contact.load for contact in contacts])
        return float(np.abs(load - np.array(self.loads)).max() / max(float(load.max()), 1e-300))

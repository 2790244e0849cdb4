"""Where the friction of balls on races comes from in traction equilibrium: a law of each race,
Coulomb, solved films.

A source is asked once near an equilibrium what it needs there (`prepare`), which for films is to
solve them; what it gives then makes the friction of all contacts (`law`) for equilibria nearby,
and tells how far the loads have moved.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ehl.conditions import ContactConditions
from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution
from ehl.traction.laws import FourConstantLaw, FrictionLaw

from ..contacts.contacts import BearingContact
from ..contacts.shape import contact_shape
from ..geometry import Race
from ..quasistatic.solution import QuasistaticSolution
from .coulomb import contact_ellipses
from .ellipse import coulomb_dissipation
from .films import Asperities, film_law
from .newton import ContactLaw
from .resistance import FREE, Resistance
from .tables import contact_law

SolveFilms = Callable[[Sequence[ContactConditions | None]], Sequence[ContactSolution | None]]


class PreparedTraction(Protocol):
    """Friction of all contacts of a row of balls near one equilibrium."""

    def law(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """Friction at the loads of an equilibrium [N]."""
        ...

    def change(self, contacts: Sequence[BearingContact]) -> float:
        """Largest relative change of a load since it was prepared, over the largest load [-]."""
        ...


class TractionSource(Protocol):
    """What traction equilibrium asks of the friction."""

    @property
    def words(self) -> str:
        """Where it comes from, for messages."""
        ...

    def prepare(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> PreparedTraction:
        """What is needed near an equilibrium [N], [m/s]."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class BallTraction:
    """Friction of balls on races and what holds the balls back.

    Attributes
    ----------
    source : TractionSource
    lubricant : Lubricant
        Of the contacts.
    resistance : Resistance
        Drag of the oil around the balls and of the cage's guidance.
    """

    source: TractionSource
    lubricant: Lubricant
    resistance: Resistance = FREE


class _Everywhere:
    """A source that needs no preparing."""

    def change(self, contacts: Sequence[BearingContact]) -> float:
        """None [-]."""
        del contacts
        return 0.0


@dataclass(frozen=True, kw_only=True)
class LawTraction(_Everywhere):
    """A friction law for each race: traction tables, or any other of `ehl.traction`.

    Attributes
    ----------
    laws : mapping of Race to FrictionLaw
        Forces in [N].
    """

    laws: Mapping[Race, FrictionLaw]

    @property
    def words(self) -> str:
        """Where it comes from, for messages."""
        return "a law of each race (traction tables)"

    def prepare(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> PreparedTraction:
        """Itself, for loads [N] of any size."""
        del solution, contacts
        return self

    def law(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """The laws at the loads of an equilibrium [N]."""
        del solution
        return contact_law(contacts, [self.laws[contact.race] for contact in contacts])


@dataclass(frozen=True, kw_only=True)
class FourConstantTraction(_Everywhere):
    """mu = (A + B s) exp(-C s) + D over the ellipse of every contact, s the local slide over the
    entrainment speed.

    Attributes
    ----------
    constants : tuple of float
        A to D [-], see `ehl.traction.laws.four_constants`.
    """

    constants: tuple[float, float, float, float]

    @property
    def words(self) -> str:
        """Where it comes from, for messages."""
        return "law of four constants, (A + B s) exp(-C s) + D with " + ", ".join(
            f"{c:.4g}" for c in self.constants
        )

    def prepare(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> PreparedTraction:
        """Itself, for loads [N] of any size."""
        del solution, contacts
        return self

    def law(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """The law at the loads [N] and contact angles of an equilibrium."""
        a, b, c, d = self.constants
        laws = []
        for contact in contacts:
            shape = contact_shape(solution.bearing, contact.race, contact.contact_angle)
            laws.append(FourConstantLaw(shape, a=a, b=b, c=c, d=d))
        return contact_law(contacts, laws)


@dataclass(frozen=True, kw_only=True)
class CoulombTraction(_Everywhere):
    """Coulomb's friction over the ellipse, rounded off where nearly nothing slides
    (`contact_ellipses`).

    Attributes
    ----------
    friction : float
        mu [-].
    """

    friction: float

    @property
    def words(self) -> str:
        """Where it comes from, for messages."""
        return f"Coulomb's law, mu = {self.friction:g}"

    def prepare(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> PreparedTraction:
        """Itself, for loads [N] of any size."""
        del solution, contacts
        return self

    def law(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """Friction at the loads of an equilibrium [N]."""
        found = contact_ellipses(solution, contacts, self.friction)
        return ContactLaw(
            dissipation=lambda motion, numbers: coulomb_dissipation(motion, found.some(numbers)),
            strength=found.friction * found.load,
            pumps=False,
        )


# sources that are their own preparation
PREPARED = LawTraction | FourConstantTraction | CoulombTraction


@dataclass(frozen=True, kw_only=True)
class FilmTraction:
    """Shear of films that are solved for the contacts of the bearing.

    Attributes
    ----------
    solve : callable
        Takes the conditions of contacts, None where there is none, and gives their films [m],
        [Pa].
    rheology : Rheology
    asperities : Asperities or None
        What carries part of the loads [N] where the films are thin; None: full films.
    """

    solve: SolveFilms
    rheology: Rheology
    asperities: Asperities | None = None

    @property
    def words(self) -> str:
        """Where it comes from, for messages."""
        return "shear of the solved films, in proportion to the load between two rounds of solving them"

    def prepare(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> PreparedTraction:
        """Films at the loads of an equilibrium [N].

        Raises
        ------
        ValueError
            If a film did not converge; the message names its contact.
        """
        films = self.solve([contact.conditions for contact in contacts])
        for contact, film in zip(contacts, films, strict=True):
            if film is not None and not film.converged:
                raise ValueError(
                    f"the film of ball {contact.ball} at the {contact.race.value} race did not converge"
                )
        return SolvedTraction(
            source=self, films=tuple(films), loads=tuple(contact.load for contact in contacts)
        )


@dataclass(frozen=True, kw_only=True)
class SolvedTraction:
    """Shear of films solved at loads nearby, in proportion to the load; `loads` in [N]."""

    source: FilmTraction
    films: tuple[ContactSolution | None, ...]
    loads: tuple[float, ...]

    def law(self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]) -> ContactLaw:
        """Friction at the loads of an equilibrium [N], the traction coefficients being those of
        the films.
        """
        pairs = zip(contacts, self.loads, strict=True)
        scale = np.array([contact.load / load if load > 0.0 else 0.0 for contact, load in pairs])
        return film_law(
            solution,
            contacts,
            self.films,
            self.source.rheology,
            self.source.asperities,
            scale=scale,
        )

    def change(self, contacts: Sequence[BearingContact]) -> float:
        """Largest change of a load since the films were solved, over the largest load [-]."""
        now = np.array([contact.load for contact in contacts])
        return float(np.abs(now - np.array(self.loads)).max() / max(float(now.max()), 1e-300))

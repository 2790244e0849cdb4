"""Results of a run as handed to the output: everything in SI."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import degrees
from typing import Any

from bearing.contacts.contact import BearingContact
from bearing.contacts.traction import ContactTraction
from bearing.fits.clearance import ClearanceBudget
from bearing.heating.self_heating import SelfHeatingSolution
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rating.frequencies import Frequencies
from bearing.rating.life import LifeRating
from bearing.torque.breakdown import TorqueBreakdown
from ehl import ContactSolution, Lubricant

from .text import listed

STIFFNESS_ORDER = ("x", "y", "z", "ty", "tz")  # directions of a ring
STIFFNESS_UNITS = [  # force and moment over shift and tilt
    *[["N/m"] * 3 + ["N/rad"] * 2 for _ in range(3)],
    *[["N m/m"] * 3 + ["N m/rad"] * 2 for _ in range(2)],
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Results:
    """Common to the results of all commands."""

    version: str  # of the program
    case: dict[str, Any]  # the document as run, plain JSON types
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)  # wall time by part of the run [s]

    @property
    def title(self) -> str:
        """Of the case."""
        return str(self.case.get("title", ""))

    def head(self, converged: bool, messages: Iterable[str]) -> dict[str, Any]:
        """First keys of a summary; the messages of the run stand before those given."""
        return {
            "oilfilm": self.version,
            "case": self.case,
            "converged": converged,
            "messages": [*self.messages, *messages],
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingResults(Results):
    """One bearing case, computed."""

    quasistatic: QuasistaticSolution
    lubricant: Lubricant
    contacts: tuple[BearingContact, ...]  # ball by ball, inner race then outer
    solutions: tuple[ContactSolution | None, ...]  # of the contacts; equal ones share an object
    frequencies: Frequencies
    interrupted: bool = False  # before all films were computed
    torque: TorqueBreakdown | None = None  # None without an equilibrium
    tractions: tuple[ContactTraction | None, ...] = ()  # of the contacts; empty is None for all
    life: LifeRating | None = None
    clearance: ClearanceBudget | None = None  # None where the operating one is given
    heating: SelfHeatingSolution | None = None  # None where no heat transfer is given

    @property
    def converged(self) -> bool:
        """Whether equilibrium, films and heat balance converged, as far as asked for."""
        films = all(s.converged for s in self.solutions if s is not None)
        return (
            self.quasistatic.converged
            and films
            and (self.heating is None or self.heating.converged)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class DistinctContact:
    """Equal contacts of a bearing: their shared solution, and the contacts."""

    solution: ContactSolution
    contacts: tuple[BearingContact, ...]

    @property
    def label(self) -> str:
        """Race, balls and azimuths in words."""
        balls = listed([str(c.ball) for c in self.contacts])
        angles = listed([f"{degrees(c.azimuth) % 360.0:.4g}°" for c in self.contacts])
        plural = "s" if len(self.contacts) > 1 else ""
        return f"{self.contacts[0].race.value} race, ball{plural} {balls} (ψ = {angles})"


def distinct_contacts(results: BearingResults) -> tuple[DistinctContact, ...]:
    """The solved contacts grouped by solution, inner race first, in the order of the balls."""
    groups: dict[tuple[str, int], list[int]] = {}
    for i, (contact, solution) in enumerate(zip(results.contacts, results.solutions, strict=True)):
        if solution is not None:
            groups.setdefault((contact.race.value, id(solution)), []).append(i)
    distinct = []
    for (_, _), members in sorted(groups.items(), key=lambda item: (item[0][0], item[1][0])):
        solution = results.solutions[members[0]]
        assert solution is not None  # only solved contacts were grouped
        contacts = tuple(results.contacts[i] for i in members)
        distinct.append(DistinctContact(solution=solution, contacts=contacts))
    return tuple(distinct)

"""What a run hands to the output: everything in SI."""

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
from ehl.traction.shear import TractionResult

from .text import listed


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingResults:
    """One bearing case, computed.

    Attributes
    ----------
    version : str
        Of the program.
    case : dict
        The case document as run, plain JSON types.
    quasistatic : QuasistaticSolution
    lubricant : Lubricant
    contacts : tuple of BearingContact
        Ball by ball, inner race then outer.
    solutions : tuple of ContactSolution or None
        One per contact; equal contacts share one object; None where no film was computed.
    frequencies : Frequencies
    messages : tuple of str
    interrupted : bool
        Whether the run was stopped before all films were there.
    timing : dict of float
        Wall time by part of the run [s].
    torque : TorqueBreakdown or None
        None without an equilibrium.
    tractions : tuple of ContactTraction or None
        One per contact, None where there is no film; empty is None for all.
    life : LifeRating or None
    clearance : ClearanceBudget or None
        None where the clearance given is the operating one.
    heating : SelfHeatingSolution or None
        None where no heat transfer is given.
    """

    version: str
    case: dict[str, Any]
    quasistatic: QuasistaticSolution
    lubricant: Lubricant
    contacts: tuple[BearingContact, ...]
    solutions: tuple[ContactSolution | None, ...]
    frequencies: Frequencies
    messages: tuple[str, ...] = ()
    interrupted: bool = False
    timing: dict[str, float] = field(default_factory=dict)
    torque: TorqueBreakdown | None = None
    tractions: tuple[ContactTraction | None, ...] = ()
    life: LifeRating | None = None
    clearance: ClearanceBudget | None = None
    heating: SelfHeatingSolution | None = None

    @property
    def converged(self) -> bool:
        """Whether the equilibrium, every film and the heat balance that were asked for converged."""
        films = all(s.converged for s in self.solutions if s is not None)
        return (
            self.quasistatic.converged
            and films
            and (self.heating is None or self.heating.converged)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults:
    """One single contact, computed; attributes as in `BearingResults`."""

    version: str
    case: dict[str, Any]
    solution: ContactSolution
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)
    traction: TractionResult | None = None

    @property
    def converged(self) -> bool:
        """Whether the film converged."""
        return self.solution.converged


@dataclass(frozen=True, slots=True, kw_only=True)
class DistinctContact:
    """Equal contacts of a bearing, seen as one: the shared solution and the contacts that have it."""

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
    """Group the solved contacts that share a solution, inner race first, in the order of the
    balls.
    """
    groups: dict[tuple[str, int], list[int]] = {}
    for i, (contact, solution) in enumerate(zip(results.contacts, results.solutions, strict=True)):
        if solution is not None:
            groups.setdefault((contact.race.value, id(solution)), []).append(i)
    found = []
    for (_, _), members in sorted(groups.items(), key=lambda item: (item[0][0], item[1][0])):
        solution = results.solutions[members[0]]
        assert solution is not None  # only solved contacts were grouped
        found.append(
            DistinctContact(
                solution=solution, contacts=tuple(results.contacts[i] for i in members)
            )
        )
    return tuple(found)

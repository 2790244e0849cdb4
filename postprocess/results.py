"""Results as handed to the output, everything in SI: what is common to all kinds."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from ehl.units import notebook_html

# kinds of pictures: those that need no more than the films, and those of all results
FILMS = "films"
OTHERS = "others"
PARAVIEW = "ParaView"  # what is no picture
STIFFNESS_ORDER = ("x", "y", "z", "ty", "tz")  # directions of a ring
STIFFNESS_HEADLINES = {"axial stiffness": 0, "radial stiffness": 1}  # place on the diagonal
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
        """Title of the case."""
        return str(self.case.get("title", ""))

    @property
    def pictures(self) -> dict[str, int]:
        """The most that are drawn apart from each other [-]: of the films alone, and others."""
        return {FILMS: 0, OTHERS: 0}

    def _repr_html_(self) -> str:
        """Title, state and messages for a notebook; kinds that show more have their own."""
        return notebook_html(self.title or type(self).__name__, self._facts())

    def _facts(self) -> dict[str, Any]:
        """State of convergence, and the messages."""
        facts: dict[str, Any] = {"oilfilm": self.version}
        if hasattr(self, "converged"):
            facts["converged"] = str(self.converged)
        return facts | {f"note {k + 1}": note for k, note in enumerate(self.messages)}

    def head(self, converged: bool, messages: Iterable[str]) -> dict[str, Any]:
        """First keys of a summary; the messages of the run stand before those given.

        Parameters
        ----------
        converged : bool
            State of the results.
        messages : Iterable[str]
            Further messages.

        Returns
        -------
        dict[str, Any]
            Version, case, converged, messages.
        """
        return {
            "oilfilm": self.version,
            "case": self.case,
            "converged": converged,
            "messages": [*self.messages, *messages],
        }

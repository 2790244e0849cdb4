"""Results of one single contact."""

from dataclasses import dataclass

from bearing.supply.solved_track import SolvedPass
from ehl import ContactSolution
from ehl.traction import NormalResponse
from ehl.traction.shear import TractionResult

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults(Results):
    """One single contact, computed."""

    solution: ContactSolution
    traction: TractionResult | None = None
    response: NormalResponse | None = None
    no_response: str = ""  # why there is none
    passes: tuple[SolvedPass, ...] = ()  # of the track, the solution the first of them

    @property
    def converged(self) -> bool:
        """Whether the film converged, and those of all passes."""
        return self.solution.converged and all(one.solution.converged for one in self.passes)

    @property
    def pictures(self) -> int:
        """That are drawn [-]."""
        return 1

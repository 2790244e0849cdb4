"""Results of a contact over time."""

from dataclasses import dataclass

from ehl.transient.record import TransientSolution
from ehl.transient.waves import WaveResult

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientResults(Results):
    """A contact over time, computed."""

    solution: TransientSolution
    waves: tuple[WaveResult, ...] = ()
    resumed: int = 0  # step that the computation went on from
    wall: float = 0.0  # of the steps made by this command [s]

    @property
    def converged(self) -> bool:
        """True if all steps were computed and solved."""
        return self.solution.converged

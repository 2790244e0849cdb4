"""Results of one single contact."""

from dataclasses import dataclass

from bearing.supply.track import SolvedPass
from ehl import ContactSolution
from ehl.traction import NormalResponse
from ehl.traction.shear import TractionResult
from ehl.units import notebook_html

from ..results import FILMS, OTHERS, Results


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
        """True if the film converged, and those of all passes."""
        return self.solution.converged and all(one.solution.converged for one in self.passes)

    def _repr_html_(self) -> str:
        """The contact, its traction and stiffness, for a notebook."""
        facts = self._facts()
        if self.traction is not None:
            facts["traction coefficient"] = f"{self.traction.coefficient:.4g}"
        return notebook_html(self.title or "Contact", facts) + self.solution._repr_html_()

    @property
    def pictures(self) -> dict[str, int]:
        """Pictures that are drawn [-]."""
        return {FILMS: 0, OTHERS: 1}

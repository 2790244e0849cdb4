"""Stiffness of a bearing over speed."""

from dataclasses import dataclass

from bearing.studies.preload import StiffnessOverSpeed

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessResults(Results):
    """Stiffness of one case over speed."""

    study: StiffnessOverSpeed
    damping: float  # handed through to the rotor code [N s/m]

    @property
    def converged(self) -> bool:
        """True if there is an equilibrium at every speed."""
        return bool(self.study.converged.all())

"""Temperatures of a bearing over the speed, and over time from a start on."""

from dataclasses import dataclass

from bearing.heating.over_speed import SpeedBranch, SpeedLimit
from bearing.heating.over_time import WarmUp
from bearing.heating.self_heating import SelfHeatingSolution

from ..results import Results


@dataclass(frozen=True, slots=True, kw_only=True)
class TemperatureResults(Results):
    """Temperatures of one case over speed and time."""

    speed: float  # of the shaft in the case [rad/s]
    heating: SelfHeatingSolution  # at that speed
    branch: SpeedBranch
    warm_up: WarmUp

    @property
    def converged(self) -> bool:
        """True if the speed of the case has a balance, the branch a known end, and the course its
        full time.
        """
        known = self.branch.limited_by is not SpeedLimit.NO_STATE
        return self.heating.converged and known and self.warm_up.ended

"""A vibration and what is looked at."""

from dataclasses import dataclass

from bearing.vibration.inputs import Direction
from bearing.vibration.simulation import VibrationRun
from ehl.arrays import Array

from ..results import Results

ENERGY_LIMIT = 1.0e-3  # of stored energy and works: a larger imbalance is flagged [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class VibrationResults(Results):
    """Vibration of one case over time."""

    run: VibrationRun
    direction: Direction
    reference: float  # of levels of acceleration [m/s^2]
    envelope_band: tuple[float, float] | None  # [Hz]; None: the high band, as far as it is sampled
    response: Array | None  # frequency [Hz], amplitude ratio [-], phase [rad], shape (n, 3)

    @property
    def converged(self) -> bool:
        """True if the motion stayed finite and energies balance."""
        return self.run.energy_balance_error <= ENERGY_LIMIT  # false of what is not a number

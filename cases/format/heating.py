"""What a case file says about self-heating."""

from collections.abc import Callable
from dataclasses import dataclass

from bearing.fits.clearance import Fit
from bearing.geometry import Bearing
from bearing.heating.heat_balance import Cooling
from ehl import Lubricant


@dataclass(frozen=True, kw_only=True)
class HeatingPlan:
    """What the heat balance of a case needs beyond the case, SI.

    Attributes
    ----------
    bearing : Bearing
        With its clearance before mounting, where the case gives fits or temperatures [m].
    oil : callable
        Lubricant at a temperature [K].
    cooling : Cooling
    model : str
        Of the friction torque.
    fit : Fit or None
    reference : float or None
        Temperature at which clearance and fits were measured [K]; None: the clearance stays.
    inner_excess : float
        Of the inner ring over the mean temperature of the rings [K].
    """

    bearing: Bearing
    oil: Callable[[float], Lubricant]
    cooling: Cooling
    model: str
    fit: Fit | None = None
    reference: float | None = None
    inner_excess: float = 0.0

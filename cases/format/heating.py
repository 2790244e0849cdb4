"""[friction] heat_transfer_W_K and what belongs to it: the heat balance of a bearing."""

from collections.abc import Callable
from dataclasses import dataclass

from bearing.fits.clearance import Fit
from bearing.geometry import Bearing
from bearing.heating.heat_balance import Cooling
from ehl import Lubricant
from ehl.units import ZERO_CELSIUS

from .fits import TemperaturesTable
from .friction import FrictionTable
from .lubricant import Oil, lubricant
from .problems import UnfitKey

# where no [temperatures] gives the one of measurement [K]
REFERENCE = TemperaturesTable.model_fields["reference_C"].default + ZERO_CELSIUS


@dataclass(frozen=True, kw_only=True)
class HeatingInput:
    """What the heat balance takes beyond the bearing and its operation, SI."""

    delivered: Bearing  # with its clearance before mounting, where there are fits or temperatures
    oil: Callable[[float], Lubricant]  # at a temperature [K]
    cooling: Cooling
    model: str  # of the friction torque
    fit: Fit | None = None
    # temperature at which clearance and fits were measured [K]; None: the clearance stays
    reference: float | None = None
    inner_excess: float = 0.0  # of the inner ring over the mean temperature of the rings [K]


def heating(
    table: FrictionTable,
    temperatures: TemperaturesTable | None,
    oil: Oil,
    at_operation: Lubricant,
    delivered: Bearing,
    fit: Fit | None,
) -> HeatingInput | None:
    """Cooling [W/K], oil over temperature [K], fits; None where no heat transfer is given.

    Raises
    ------
    ValueError
        If oil removes heat and its specific heat is not known.
    """
    if table.heat_transfer_W_K is None:
        return None
    reference = None
    excess = 0.0
    if temperatures is not None:
        reference = temperatures.si()["reference"]
        excess = 0.5 * (temperatures.inner_ring_C - temperatures.outer_ring_C)
    elif fit is not None:
        reference = REFERENCE
    return HeatingInput(
        delivered=delivered,
        oil=lambda temperature: lubricant(oil, temperature),
        cooling=_cooling(table, at_operation),
        model=table.heating_torque,
        fit=fit,
        reference=reference,
        inner_excess=excess,
    )


def _cooling(table: FrictionTable, oil: Lubricant) -> Cooling:
    """Heat to the surroundings and to the oil that flows through [W/K, K]."""
    si = table.si()
    key = "supply_mL_min" if table.cooling_oil_mL_min is None else "cooling_oil_mL_min"
    flow = si["supply"] if table.cooling_oil_mL_min is None else si["cooling_oil_mL_min"]
    capacity = 0.0
    if flow:
        if oil.thermal is None:
            needs = "the heat that oil carries needs lubricant.specific_heat_J_kg_K"
            raise UnfitKey(("friction", key), needs)
        capacity = flow * oil.density * oil.thermal.specific_heat
    supplied = si["cooling_oil_C"]
    return Cooling(
        conductance=si["heat_transfer"],
        ambient=si["ambient"],
        oil_flow=capacity,
        oil_supply=si["ambient"] if supplied is None else supplied,
    )

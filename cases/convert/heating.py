"""[friction] heat_transfer_W_K and what belongs to it: the heat balance of a bearing."""

from bearing.heating.heat_balance import Cooling
from ehl import Lubricant

from ..format.heating import HeatingPlan
from ..format.problems import UnfitKey
from ..schema.files import BearingFile
from .bearing import bearing, seats
from .friction import ML_MIN
from .lubricant import lubricant
from .units import ZERO_CELSIUS


def heating(file: BearingFile, oil: Lubricant) -> HeatingPlan | None:
    """Cooling [W/K], oil over temperature [K], fits; None where no heat transfer is given.

    Raises
    ------
    ValueError
        If oil carries heat and its specific heat is not known.
    """
    table = file.friction
    if table.heat_transfer_W_K is None:
        return None
    flow = table.supply_mL_min if table.cooling_oil_mL_min is None else table.cooling_oil_mL_min
    carried = 0.0
    if flow:
        if oil.thermal is None:
            key = "supply_mL_min" if table.cooling_oil_mL_min is None else "cooling_oil_mL_min"
            raise UnfitKey(
                ("friction", key), "the heat that oil carries needs lubricant.specific_heat_J_kg_K"
            )
        carried = flow * ML_MIN * oil.density * oil.thermal.specific_heat
    ambient = table.ambient_C + ZERO_CELSIUS
    supply = ambient if table.cooling_oil_C is None else table.cooling_oil_C + ZERO_CELSIUS
    cooling = Cooling(
        conductance=table.heat_transfer_W_K, ambient=ambient, oil_flow=carried, oil_supply=supply
    )

    def at(kelvin: float) -> Lubricant:
        warm = file.operation.model_copy(update={"temperature_C": kelvin - ZERO_CELSIUS})
        return lubricant(file.model_copy(update={"operation": warm}))

    rings = file.temperatures
    reference = None
    excess = 0.0
    if rings is not None:
        reference = rings.reference_C + ZERO_CELSIUS
        excess = 0.5 * (rings.inner_ring_C - rings.outer_ring_C)
    elif file.fit is not None:
        reference = REFERENCE
    return HeatingPlan(
        bearing=bearing(file),
        oil=at,
        cooling=cooling,
        model=table.heating_torque,
        fit=seats(file),
        reference=reference,
        inner_excess=excess,
    )


# at which fits were measured where no [temperatures] tells it, as `TemperaturesTable` has it [K]
REFERENCE = 293.15

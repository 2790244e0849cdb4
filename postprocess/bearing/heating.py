"""The block `self_heating` of the summary: the temperature at which friction and cooling agree."""

from collections.abc import Iterator
from typing import Any

from ehl.units import MICROMETRE, NEWTON_MILLIMETRE, ZERO_CELSIUS

from ..results import BearingResults

KEYS = ("temperature_C", "torque_N_mm", "power_W", "oil_W", "viscosity_mPa_s", "clearance_um")


def heating_block(results: BearingResults) -> dict[str, Any]:
    """Temperature [degrees C], torque, power and what the oil carries [W], oil and clearance; None
    without balance.
    """
    found = results.heating
    known = dict.fromkeys(KEYS) | {"torque_model": None, "converged": None}
    if found is None:
        return known
    known |= {"torque_model": found.model, "converged": found.converged}
    if found.balance is None or not found.converged:
        return known
    return known | {
        "temperature_C": found.balance.temperature - ZERO_CELSIUS,
        "torque_N_mm": found.balance.torque / NEWTON_MILLIMETRE,
        "power_W": found.balance.power,
        "oil_W": found.oil_heat,
        "viscosity_mPa_s": None if found.viscosity is None else 1e3 * found.viscosity,
        "clearance_um": None if found.clearance is None else found.clearance / MICROMETRE,
    }


def heating_messages(results: BearingResults) -> Iterator[str]:
    """What the block means for the results, or why it is null."""
    found = results.heating
    if found is None:
        yield "self_heating: null, the case gives no friction.heat_transfer_W_K, or nothing turns"
    elif found.balance is None or not found.converged:
        yield f"self_heating: null, not converged: {found.note}; try another heat_transfer_W_K or heating_torque"
    else:
        warm = found.balance.temperature
        given = results.quasistatic.operation.temperature
        yield (
            f"self_heating: friction ({found.model}) and cooling agree at {warm - ZERO_CELSIUS:.1f} C; all else was "
            f"computed at operation.temperature_C = {given - ZERO_CELSIUS:g}"
        )
        if found.note:
            yield f"self_heating: {found.note}"

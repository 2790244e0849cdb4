"""The block `self_heating` of the summary: the temperature at which friction and cooling agree."""

from collections.abc import Iterator
from typing import Any

from bearing.heating.self_heating import SelfHeatingSolution
from ehl.units import from_si

from ..quantities import values_of
from .quantities import HEATING
from .results import BearingResults

AGREEMENT = 1.0  # of temperatures that count as one [K]


def heating_block(results: BearingResults) -> dict[str, Any]:
    """Temperature, torque, power, oil, clearance; None without a balance of heat."""
    heating = results.heating
    balanced = heating is not None and heating.balance is not None and heating.converged
    return {
        **values_of(heating if balanced else None, HEATING),
        "torque_model": None if heating is None else heating.model,
        "converged": None if heating is None else heating.converged,
    }


def temperature_messages(results: BearingResults) -> Iterator[str]:
    """That the results are those of another temperature than the balance of heat finds."""
    heating = results.heating
    if heating is None or heating.balance is None or not heating.converged:
        return
    balanced = heating.balance.temperature
    given = results.quasistatic.operation.temperature
    if abs(balanced - given) > AGREEMENT:
        yield (
            "two temperatures: loads, clearance, films, torque and life are those of "
            f"operation.temperature_C = {from_si('temperature_C', given):.4g}, the block "
            f"self_heating that of {from_si('temperature_C', balanced):.4g} C, where friction and "
            'cooling agree; operation.temperature = "self-heated" computes all of it there'
        )


def heating_messages(results: BearingResults) -> Iterator[str]:
    """What the block means for the results, or why it is null."""
    heating = results.heating
    if results.interrupted:
        return
    if heating is None:
        yield "self_heating: null, the case gives no friction.heat_transfer_W_K, or nothing turns"
    elif heating.balance is None or not heating.converged:
        yield f"self_heating: null, not converged: {heating.note}; {_remedy(results, heating)}"
    else:
        balanced = from_si("temperature_C", heating.balance.temperature)
        given = from_si("temperature_C", results.quasistatic.operation.temperature)
        if abs(balanced - given) > AGREEMENT:
            yield (
                f"self_heating: friction ({heating.model}) and cooling agree at {balanced:.1f} C; "
                f"all else was computed at operation.temperature_C = {given:.4g}"
            )
        else:
            yield f"self_heating: friction ({heating.model}) and cooling agree at {balanced:.1f} C"
        if heating.model == "integrated" and abs(balanced - given) > AGREEMENT:
            yield (
                "self_heating: its torque is that of films of formulas, scaled to the total at "
                'temperature_C; operation.temperature = "self-heated" solves the films there'
            )
        elif heating.model != "integrated":
            yield (
                f"self_heating: heats with the torque of {heating.model} "
                "(friction.heating_torque), which is not the total"
            )
        if heating.note:
            yield f"self_heating: {heating.note}"


def _remedy(results: BearingResults, heating: SelfHeatingSolution) -> str:
    """What to change of a bearing that is heated more than it is cooled."""
    balance = heating.balance
    oil = results.lubricant
    if balance is None or balance.power <= heating.cooling.heat(balance.temperature):
        return "try another friction.heat_transfer_W_K or heating_torque"
    cooling = heating.cooling
    taken = cooling.heat(balance.temperature)
    least = (balance.power - taken) / (balance.temperature - cooling.ambient)
    ways = [f"heat_transfer_W_K above {cooling.conductance + least:.3g}"]
    if oil.thermal is not None:
        rise = balance.temperature - cooling.oil_supply
        flow = (balance.power - taken) / (oil.density * oil.thermal.specific_heat * rise)
        added = flow + cooling.oil_flow / (oil.density * oil.thermal.specific_heat)
        ways.append(f"cooling_oil_mL_min above {from_si('flow_mL_min', added):.2g}")
    return (
        f"friction is {balance.power:.4g} W there, cooling {taken:.4g} W: try in [friction] "
        f"{' or '.join(ways)}, a thinner oil, or less speed; oilfilm init with --speed lays out "
        "oil and cooling"
    )

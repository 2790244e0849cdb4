"""The block `self_heating` of the summary: the temperature at which friction and cooling agree."""

from collections.abc import Iterator
from typing import Any

from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.heating.over_speed import required_heat_transfer, required_oil_flow
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from ..quantities import values_of
from .quantities import HEATING, PATH, STABILITY, STABILITY_KEYS
from .results import BearingResults

AGREEMENT = 1.0  # of temperatures that count as one [K]


def heating_block(results: BearingResults) -> dict[str, Any]:
    """Temperature, torque, power, oil, clearance; None without a balance of heat.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    heating = results.heating
    return {
        **values_of(_balanced(results), HEATING),
        "torque_model": None if heating is None else heating.model,
        "converged": None if heating is None else heating.converged,
    }


def _balanced(results: BearingResults) -> SelfHeatingSolution | None:
    """The balance of heat, where there is one."""
    heating = results.heating
    if heating is None or heating.balance is None or not heating.converged:
        return None
    return heating


def network_blocks(results: BearingResults) -> dict[str, Any]:
    """Temperatures by node, heat flows by path, margin against runaway; None without a heat
    balance.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        Blocks of the summary by key.
    """
    keys = ("temperatures_C", "temperatures_low_C", "temperatures_high_C", "heat_flows_W")
    heating = _balanced(results)
    if heating is None or heating.state is None or heating.stability is None:
        return dict.fromkeys((*keys, "heat_sources_W", "heat_paths", *STABILITY_KEYS))
    state, stable = heating.state, heating.stability
    network = state.network
    edges = {name: from_si("temperature_C", value) for name, value in network.boundaries.items()}
    edges |= {"film": from_si("temperature_C", state.film_temperature)}
    flows = network.flows(state.temperatures)
    named = list(zip(network.paths, flows, strict=True))
    return {
        keys[0]: _by_node(state.temperatures) | edges,
        keys[1]: _by_node(stable.coldest),
        keys[2]: _by_node(stable.hottest),
        keys[3]: {path.name: flow for path, flow in named},
        "heat_sources_W": dict(zip(NODES, state.sources.tolist(), strict=True)),
        "heat_paths": [
            {"path": path.name, "what": path.description, **values_of(path.conductance, PATH)}
            for path in network.paths
        ],
        **values_of(heating, STABILITY),
    }


def _by_node(temperatures: Array) -> dict[str, float]:
    """Temperatures of the nodes by their names [degrees Celsius]."""
    values = from_si("temperature_C", temperatures).tolist()
    return dict(zip(NODES, values, strict=True))


def temperature_messages(results: BearingResults) -> Iterator[str]:
    """Warn if the results are those of another temperature than the heat balance gives.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
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
    """Explain the block `self_heating`, or the reason why it is null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    heating = results.heating
    if results.interrupted:
        return
    if heating is None:
        yield "self_heating: null, the case gives no friction.heat_transfer_W_K, or nothing turns"
    elif heating.balance is None or not heating.converged:
        yield f"self_heating: null, not converged: {heating.note}; {_advice(results, heating)}"
    else:
        balanced = from_si("temperature_C", heating.balance.temperature)
        given = from_si("temperature_C", results.quasistatic.operation.temperature)
        if abs(balanced - given) > AGREEMENT:
            yield (
                f"self_heating: friction ({heating.model}) and cooling agree at {balanced:.1f} C; "
                f"all else was computed at operation.temperature_C = {given:.4g}"
            )
        elif results.case["operation"].get("temperature") != "self-heated":  # has its message
            yield f"self_heating: friction ({heating.model}) and cooling agree at {balanced:.1f} C"
        if heating.model == "integrated" and abs(balanced - given) > AGREEMENT:
            yield (
                "self_heating: its torque is that of films without a solve, scaled to the total "
                'at temperature_C; operation.temperature = "self-heated" solves the films there'
            )
        elif heating.model != "integrated":
            yield (
                f"self_heating: heats with the torque of {heating.model} "
                "(friction.heating_torque), which is not the total"
            )
        if heating.note and heating.note not in results.messages:
            yield f"self_heating: {heating.note}"


def _advice(results: BearingResults, heating: SelfHeatingSolution) -> str:
    """Advice for a bearing that is heated more than it is cooled."""
    state = heating.state
    oil = results.lubricant
    if state is None or state.resulting_temperature <= state.film_temperature:
        return "try another friction.heat_transfer_W_K or heating_torque"
    ways = []
    transfer = required_heat_transfer(state)
    if transfer is not None:
        ways.append(f"heat_transfer_W_K above {transfer:.3g}")
    flow = None if oil.thermal is None else required_oil_flow(state)
    if flow is not None and oil.thermal is not None:
        volume = flow / (oil.density * oil.thermal.specific_heat)
        ways.append(f"cooling_oil_mL_min above {from_si('flow_mL_min', volume):.2g}")
    ways = [f"in [friction] {' or '.join(ways)}"] if ways else []
    limit = from_si("temperature_C", state.film_temperature)
    wanted = from_si("temperature_C", state.resulting_temperature)
    return (
        f"friction is {state.friction.power:.4g} W at {limit:.0f} C, which would warm the films "
        f"to {wanted:.4g} C: try {', '.join([*ways, 'a thinner oil'])}, or less speed; oilfilm "
        "init with --speed lays out oil and cooling"
    )

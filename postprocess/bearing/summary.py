"""Summary of a bearing."""

from collections.abc import Iterator
from typing import Any

from bearing.contacts.electrical import (
    CERAMIC_PERMITTIVITY,
    INSULATOR,
    bearing_electrical,
    electrical_lack,
)
from bearing.quasistatic.solution import QuasistaticSolution

from ..contact.quantities import oil_permittivity
from ..contact.summary import solution_messages
from ..files import plain_document
from ..quantities import CAGE_SPEED, FREQUENCIES, rows_of, values_of
from ..results import STIFFNESS_ORDER, STIFFNESS_UNITS
from .contacts import contact_messages, contact_records, contact_values
from .duty_cycle import duty_cycle_block, duty_cycle_messages, load_case_blocks
from .finite_bodies import finite_body_block, finite_body_messages
from .heating import heating_block, heating_messages, network_blocks, temperature_messages
from .quantities import BALL_QUANTITIES, ELECTRICAL, RING
from .ratings import clearance_block, life_block, rating_messages
from .results import BearingResults, distinct_contacts
from .rings import ring_blocks, ring_messages
from .rows import kinematic_block, row_blocks, row_messages
from .strength import strength_block, strength_messages
from .supply import decay_block, decay_messages, supply_block, supply_messages
from .torque import rolling_messages, torque_block, torque_messages


def bearing_summary(results: BearingResults) -> dict[str, Any]:
    """The document of a bearing in named units.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    state = results.quasistatic
    torque = torque_block(results)
    document = {
        "ring": _ring(state),
        "equilibrium": {
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
            "message": state.message,
        },
        "rows": row_blocks(state),
        "rings": ring_blocks(state),
        "cage_speed_rpm": CAGE_SPEED.value(state),
        "balls": rows_of(_balls(state)),
        "contacts": [contact_values(record) for record in contact_records(results)],
        "clearance": clearance_block(results),
        "strength": strength_block(results),
        "life": life_block(results),
        "duty_cycle": duty_cycle_block(results),
        "load_cases": load_case_blocks(results),
        "frequencies_Hz": values_of(results.frequencies, FREQUENCIES),
        "kinematic_frequencies_Hz": kinematic_block(results),
        "torque_N_mm": torque,
        "power_balance": torque["power_balance"],
        "supply": supply_block(results),
        "decay": decay_block(results),
        "self_heating": heating_block(results),
        **network_blocks(results),
        "reference_speed_rpm": results.reference_speed_rpm,
        "electrical": _electrical(results),
        "finite_bodies": finite_body_block(results),
        "timing_s": dict(results.timing),
    }
    head = results.head(results.converged, _bearing_messages(results))
    head["messages"] = [*temperature_messages(results), *head["messages"]]
    return plain_document(head | document)


def _ring(state: QuasistaticSolution) -> dict[str, Any]:
    matrix = {"order": list(STIFFNESS_ORDER), "matrix": state.stiffness, "units": STIFFNESS_UNITS}
    return values_of(state, RING) | {"stiffness": matrix}


def _balls(state: QuasistaticSolution) -> dict[str, Any]:
    """Columns of the balls."""
    numbers = {"ball": range(1, len(state.azimuth) + 1), "row": state.row_of_ball + 1}
    return numbers | values_of(state, BALL_QUANTITIES)


def _electrical(results: BearingResults) -> dict[str, Any] | None:
    """Capacitance between the rings and breakdown voltage; None with the reason in a message."""
    parts = (results.quasistatic.bearing, results.contacts, results.instruments)
    if electrical_lack(*parts):
        return None
    return values_of(bearing_electrical(*parts), ELECTRICAL)


def _electrical_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason for a missing capacitance, and name assumptions."""
    bearing = results.quasistatic.bearing
    lack = electrical_lack(bearing, results.contacts, results.instruments)
    if lack:
        yield f"electrical: null, {lack}"
        return
    if not results.case.get("lubricant", {}).get("relative_permittivity"):
        yield (
            f"electrical: relative permittivity {oil_permittivity(results.case):g} of the oil is "
            "assumed (lubricant.relative_permittivity)"
        )
    starved = results.torque.films if results.torque is not None else None
    if any(film is not None and film.supply.central < 1.0 for film in starved or ()):
        yield "electrical: of the flooded films; starved ones have more capacitance, less voltage"
    if bearing.ball_material.kind is INSULATOR:
        yield (
            "electrical: breakdown_voltage_V null, balls of silicon nitride take nearly all of "
            f"the voltage; relative permittivity {CERAMIC_PERMITTIVITY:g} of theirs is assumed"
        )


def _bearing_messages(results: BearingResults) -> Iterator[str]:
    state = results.quasistatic
    if not state.converged or "arbitrary" in state.message:  # a free direction without stiffness
        yield f"equilibrium of ring and balls: {state.message}"
    for group in distinct_contacts(results):
        yield from solution_messages(group.label, group.solution)
    yield from row_messages(results)
    yield from ring_messages(state)
    yield from contact_messages(results)
    yield from finite_body_messages(results)
    yield from rating_messages(results)
    yield from duty_cycle_messages(results)
    yield from strength_messages(results)
    yield from torque_messages(results)
    yield from rolling_messages(results)
    yield from supply_messages(results)
    yield from decay_messages(results)
    yield from heating_messages(results)
    yield from _electrical_messages(results)

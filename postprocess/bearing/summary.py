"""The summary of results: the rim where the named units appear."""

from collections.abc import Iterator
from typing import Any

from bearing.quasistatic.solution import QuasistaticSolution

from ..contact.summary import contact_summary, solution_messages
from ..files import plain
from ..quantities import rows_of, values_of
from ..results import (
    STIFFNESS_ORDER,
    STIFFNESS_UNITS,
    BearingResults,
    ContactResults,
    distinct_contacts,
)
from .contacts import contact_messages, contact_records, contact_values
from .heating import heating_block, heating_messages
from .quantities import BALL_QUANTITIES, CAGE_SPEED, FREQUENCIES, RING
from .ratings import clearance_block, life_block, rating_messages
from .rows import kinematic_block, row_blocks, row_messages
from .supply import supply_block, supply_messages
from .torque import rolling_messages, torque_block, torque_messages


def summary(results: BearingResults | ContactResults) -> dict[str, Any]:
    """Results as one JSON document in named units, the keys as published.

    Returns
    -------
    dict
        Plain JSON types; lengths [um] or [mm], pressures [GPa], angles [deg] as the keys say. What
        does not apply is None with the reason under "messages"; no value is NaN or infinite.
    """
    if isinstance(results, ContactResults):
        document = contact_summary(results)
    else:
        document = bearing_summary(results)
    lost: list[str] = []
    values = {
        key: value if key == "messages" else plain(value, key, lost)
        for key, value in document.items()
    }
    values["messages"] += [f"{path}: null, the computed value is not finite" for path in lost]
    return values


def bearing_summary(results: BearingResults) -> dict[str, Any]:
    """The document of a bearing in named units."""
    state = results.quasistatic
    return results.head(results.converged, _bearing_messages(results)) | {
        "ring": _ring(state),
        "equilibrium": {
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
            "message": state.message,
        },
        "rows": row_blocks(state),
        "cage_speed_rpm": CAGE_SPEED.value(state),
        "balls": rows_of(_balls(state)),
        "contacts": [contact_values(record) for record in contact_records(results)],
        "clearance": clearance_block(results),
        "life": life_block(results),
        "frequencies_Hz": values_of(results.frequencies, FREQUENCIES),
        "kinematic_frequencies_Hz": kinematic_block(results),
        "torque_N_mm": torque_block(results),
        "supply": supply_block(results),
        "self_heating": heating_block(results),
        "timing_s": dict(results.timing),
    }


def _ring(state: QuasistaticSolution) -> dict[str, Any]:
    matrix = {"order": list(STIFFNESS_ORDER), "matrix": state.stiffness, "units": STIFFNESS_UNITS}
    return values_of(state, RING) | {"stiffness": matrix}


def _balls(state: QuasistaticSolution) -> dict[str, Any]:
    """Columns of the balls."""
    numbers = {"ball": range(1, len(state.azimuth) + 1), "row": state.row_of_ball + 1}
    return numbers | values_of(state, BALL_QUANTITIES)


def _bearing_messages(results: BearingResults) -> Iterator[str]:
    state = results.quasistatic
    if not state.converged or "arbitrary" in state.message:  # a free direction without stiffness
        yield f"equilibrium of ring and balls: {state.message}"
    for group in distinct_contacts(results):
        yield from solution_messages(group.label, group.solution)
    yield from row_messages(results)
    yield from contact_messages(results)
    yield from rating_messages(results)
    yield from torque_messages(results)
    yield from rolling_messages(results)
    yield from supply_messages(results)
    yield from heating_messages(results)

"""The summary of results: the rim where the named units appear."""

from collections.abc import Iterator
from typing import Any

from bearing.quasistatic.solution import QuasistaticSolution
from ehl.units import from_si

from ..contact.summary import contact_summary, solution_messages
from ..files import plain
from ..results import STIFFNESS_ORDER, BearingResults, ContactResults, distinct_contacts
from .contacts import contact_messages, contact_records, contact_values
from .heating import heating_block, heating_messages
from .ratings import clearance_block, life_block, rating_messages
from .rolling import rolling_messages
from .rows import frequency_block, kinematic_block, row_blocks, row_messages
from .supply import supply_block, supply_messages
from .torque import torque_block, torque_messages

BALL_QUANTITIES = {  # unit in SI, and key of the summary where it has the quantity
    "azimuth": ("rad", "azimuth_deg"),
    "inner_load": ("N", ""),
    "outer_load": ("N", ""),
    "inner_contact_angle": ("rad", ""),
    "outer_contact_angle": ("rad", ""),
    "ball_axial": ("m", ""),
    "ball_radial": ("m", ""),
    "centrifugal_force": ("N", "centrifugal_force_N"),
    "gyroscopic_moment": ("N m", "gyroscopic_moment_N_mm"),
    "orbit_speed": ("rad/s", "orbit_speed_rad_s"),
    "spin_speed": ("rad/s", "spin_speed_rad_s"),
    "attitude": ("rad", "attitude_deg"),
    "pivot_speed": ("rad/s", "pivot_speed_rad_s"),
    "inner_friction": ("N", "inner_friction_N"),
    "outer_friction": ("N", "outer_friction_N"),
}


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
        "cage_speed_rpm": from_si("cage_speed_rpm", state.cage_speed),
        "balls": [_ball(state, i) for i in range(len(state.azimuth))],
        "contacts": [contact_values(record) for record in contact_records(results)],
        "clearance": clearance_block(results),
        "life": life_block(results),
        "frequencies_Hz": frequency_block(results.frequencies),
        "kinematic_frequencies_Hz": kinematic_block(results),
        "torque_N_mm": torque_block(results),
        "supply": supply_block(results),
        "self_heating": heating_block(results),
        "timing_s": dict(results.timing),
    }


def _ring(state: QuasistaticSolution) -> dict[str, Any]:
    translation, rotation = ("N/m", "N/rad"), ("N m/m", "N m/rad")
    values = {
        "displacement_um": state.displacement,
        "tilt_mrad": state.tilt,
        "force_N": state.ring_force,
        "moment_N_mm": state.ring_moment,
    }
    stiffness = {
        "order": list(STIFFNESS_ORDER),
        "matrix": state.stiffness,
        "units": [[u[0]] * 3 + [u[1]] * 2 for u in [translation] * 3 + [rotation] * 2],
    }
    return {key: from_si(key, value) for key, value in values.items()} | {"stiffness": stiffness}


def _ball(state: QuasistaticSolution, i: int) -> dict[str, Any]:
    values = {
        key: from_si(key, getattr(state, name)[i])
        for name, (_, key) in BALL_QUANTITIES.items()
        if key
    }
    return {"ball": i + 1, "row": int(state.row_of_ball[i]) + 1, **values}


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

"""Summary of slip maps."""

from typing import Any

from bearing.studies.slip import slip_factors
from ehl.units import from_si

from ..files import plain
from .results import SlipResults

GIVEN_BY = {
    "skf_axial_N": "minimum_axial_load_factor_kN",
    "skf_radial_N": "minimum_radial_load_factor_kN",
    "as_printed_N": "as_printed",
}


def slip_summary(results: SlipResults) -> dict[str, Any]:
    """Summary as plain JSON types, units in the keys, null where a value does not exist."""
    surface, minimum = results.surface, results.minimum
    curves = [
        {
            "speed_rpm": from_si("speed_rpm", curve.speed),
            "radial_loads_N": curve.radial_loads,
            "axial_loads_N": [
                {"ball": ball + 1, "values": row} for ball, row in enumerate(curve.axial_loads.T)
            ],
        }
        for curve in results.curves
    ]
    document = {
        "limit": results.limit,
        "operation": _operation(results),
        "surface": {
            "speeds_rpm": from_si("speeds_rpm", surface.speeds),
            "axial_loads_N": surface.axial_loads,
            "slip_factor_minimum": surface.minimum,
        },
        "critical_curves": curves,
        "minimum_preload": {
            "speeds_rpm": from_si("speeds_rpm", minimum.speeds),
            **minimum.by_key(),
        },
    }
    messages = (*results.problems, *_left_out(results))
    head = results.head(not results.problems, messages)
    return head | dict(plain(document)) | {"timing_s": results.timing}


def _left_out(results: SlipResults) -> list[str]:
    loads = results.minimum.by_key()
    return [
        f"{name} is null: [slip] {key} is not given"
        for name, key in GIVEN_BY.items()
        if loads[name] is None
    ]


def _operation(results: SlipResults) -> dict[str, Any]:
    state, minimum = results.state, results.minimum
    own = {"minimum_preload_N": minimum.hirano, "minimum_preload_as_printed_N": minimum.as_printed}
    values = {
        "speed_rpm": state.operation.inner_speed,
        "ring_force_N": state.ring_force,
        "ring_moment_N_mm": state.ring_moment,
        "tilt_mrad": state.tilt,
    }
    return {
        **{key: from_si(key, value) for key, value in values.items()},
        **{
            key: loads[-1] if minimum.own and loads is not None else None
            for key, loads in own.items()
        },
        "balls": ball_values(results),
    }


def ball_values(results: SlipResults) -> list[dict[str, Any]]:
    """The balls at the operation of the case: loads [N], angles [deg], slip factors [-]."""
    state = results.state
    share = results.printed_force
    balls = []
    for index, factor in enumerate(slip_factors(state)):
        values = {
            "azimuth_deg": state.azimuth[index],
            "inner_load_N": state.inner_load[index],
            "outer_load_N": state.outer_load[index],
            "inner_contact_angle_deg": state.inner_contact_angle[index],
            "centrifugal_force_N": state.centrifugal_force[index],
            "slip_factor": factor,
            "slip_factor_as_printed": None if share is None else factor / share,
        }
        ball = {key: from_si(key, value) for key, value in values.items()}
        balls.append({"ball": index + 1, **ball, "slips": bool(factor < results.limit)})
    return balls

"""Summary of a bearing: equilibrium, balls and contacts."""

from collections.abc import Iterator
from math import degrees
from typing import Any

from bearing.contacts.contact import BearingContact
from bearing.quasistatic.solution import QuasistaticSolution
from ehl import ContactSolution
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, MILLIRADIAN, NEWTON_MILLIMETRE, RPM

from ..contact.messages import absent_films, combined_roughness, lambda_ratio, ratio_messages
from ..contact.rolling import rolling_messages, rolling_values
from ..contact.stress import stress_messages, stress_values
from ..contact.summary import film_temperature_maximum, films, formulas, solution_messages
from ..contact.supply import starved_values, supply_block, supply_messages
from ..results import BearingResults, distinct_contacts
from .heating import heating_block, heating_messages
from .ratings import clearance_block, life_block, rating_messages
from .rows import frequency_block, kinematic_block, row_blocks, row_messages
from .torque import contact_traction_values, torque_block, torque_messages

LAMBDA_FORMULA = "hamrock_dowson_minimum"
STIFFNESS_ORDER = ("x", "y", "z", "ty", "tz")


def bearing_summary(results: BearingResults) -> dict[str, Any]:
    """The document of a bearing in named units."""
    state = results.quasistatic
    rolling = rolling_values(results)
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": results.converged,
        "messages": list(_bearing_messages(results)),
        "ring": _ring(state),
        "equilibrium": {
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
            "message": state.message,
        },
        "rows": row_blocks(state),
        "cage_speed_rpm": state.cage_speed / RPM,
        "balls": [_ball(state, i) for i in range(len(state.azimuth))],
        "contacts": [
            _bearing_contact(c, s, results.case.get("surface"))
            | stress_values(state, c)
            | contact_traction_values(results, i)
            | rolling[i]
            | starved_values(results, i)
            for i, (c, s) in enumerate(zip(results.contacts, results.solutions, strict=True))
        ],
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
    return {
        "displacement_um": [v / MICROMETRE for v in state.displacement],
        "tilt_mrad": [v / MILLIRADIAN for v in state.tilt],
        "force_N": list(state.ring_force),
        "moment_N_mm": [v / NEWTON_MILLIMETRE for v in state.ring_moment],
        "stiffness": {
            "order": list(STIFFNESS_ORDER),
            "matrix": state.stiffness,
            "units": [[u[0]] * 3 + [u[1]] * 2 for u in [translation] * 3 + [rotation] * 2],
        },
    }


def _ball(state: QuasistaticSolution, i: int) -> dict[str, Any]:
    return {
        "ball": i + 1,
        "row": int(state.row_of_ball[i]) + 1,
        "azimuth_deg": degrees(state.azimuth[i]),
        "centrifugal_force_N": state.centrifugal_force[i],
        "gyroscopic_moment_N_mm": state.gyroscopic_moment[i] / NEWTON_MILLIMETRE,
        "orbit_speed_rad_s": state.orbit_speed[i],
        "spin_speed_rad_s": state.spin_speed[i],
        "attitude_deg": degrees(state.attitude[i]),
        "pivot_speed_rad_s": state.pivot_speed[i],
        "inner_friction_N": state.inner_friction[i],
        "outer_friction_N": state.outer_friction[i],
    }


def _lambda_of_formula(contact: BearingContact, surface: dict[str, float] | None) -> float | None:
    """Hamrock and Dowson's minimum film over the rms roughness of race and ball [-]; None without
    either.
    """
    if surface is None:
        return None
    film = formulas(contact.conditions)[LAMBDA_FORMULA]
    roughness = combined_roughness(contact.race.value, surface)
    return film * MICROMETRE / roughness if film is not None and roughness > 0.0 else None


def _bearing_contact(
    contact: BearingContact, solution: ContactSolution | None, surface: dict[str, float] | None
) -> dict[str, Any]:
    hertz, conditions = contact.hertz, contact.conditions
    return {
        "ball": contact.ball,
        "row": contact.row,
        "azimuth_deg": degrees(contact.azimuth),
        "race": contact.race.value,
        "loaded": contact.load > 0.0,
        "load_N": contact.load,
        "contact_angle_deg": degrees(contact.contact_angle),
        "semi_axis_rolling_mm": None if hertz is None else hertz.semi_axis_x / MILLIMETRE,
        "semi_axis_transverse_mm": None if hertz is None else hertz.semi_axis_y / MILLIMETRE,
        "hertz_pressure_GPa": None if hertz is None else hertz.pressure / GIGAPASCAL,
        "entrainment_speed_m_s": None if conditions is None else conditions.entrainment_speed,
        "slide_roll_ratio": None if conditions is None else conditions.slide_roll_ratio,
        "spin_roll_ratio": contact.spin_roll_ratio,
        "hirano_ratio": contact.hirano_ratio,
        **films(solution),
        "pressure_maximum_GPa": None
        if solution is None
        else solution.pressure_maximum / GIGAPASCAL,
        "film_temperature_maximum_C": film_temperature_maximum(solution),
        "lambda_ratio": lambda_ratio(contact, solution, surface),
        "lambda_ratio_formula": _lambda_of_formula(contact, surface),
        "converged": None if solution is None else solution.converged,
        "resolved": None if solution is None else solution.resolved,
        "film_formulas_um": formulas(conditions),
        "moes_M": None if solution is None else solution.moes_load,
        "moes_L": None if solution is None else solution.moes_lubricant,
        "domain": None if solution is None else list(solution.domain),
        "points": None if solution is None else list(solution.P.shape),
        "note": contact.note,
    }


def _bearing_messages(results: BearingResults) -> Iterator[str]:
    yield from results.messages
    state = results.quasistatic
    if not state.converged or "arbitrary" in state.message:  # a free direction without stiffness
        yield f"equilibrium of ring and balls: {state.message}"
    for group in distinct_contacts(results):
        yield from solution_messages(group.label, group.solution)
    yield from row_messages(results)
    yield from absent_films(results)
    if any(c.conditions is None for c in results.contacts):
        yield "contacts: Hertz, speed and formula values null where a contact carries no load or no oil is entrained"
    yield from stress_messages(results)
    yield from ratio_messages(results)
    yield from rating_messages(results)
    yield from torque_messages(results)
    yield from rolling_messages(results)
    yield from supply_messages(results)
    yield from heating_messages(results)

"""The summary of a bearing, block by block, and the lines of the terminal that say the same."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from oilfilm.bearing.contacts.contacts import NEGLIGIBLE_LOAD
from oilfilm.bearing.contacts.electrical import (
    CERAMIC_PERMITTIVITY,
    INSULATOR,
    bearing_electrical,
    electrical_lack,
)
from oilfilm.bearing.fits.ring_strength import LARGE_SHARE, RingStrength, StrengthMap
from oilfilm.bearing.geometry import Race
from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.heating.over_speed import required_heat_transfer, required_oil_flow
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.bearing.library.bearings import named_designation
from oilfilm.bearing.material import ROOM
from oilfilm.bearing.quasistatic.ring import ball_forces, seat_reactions
from oilfilm.bearing.quasistatic.solution import (
    QuasistaticSolution,
    bearing_frequencies,
    kinematic_frequencies,
)
from oilfilm.bearing.rating.ceramic import (
    ContactStrength,
    RingGradient,
    contact_strength,
    ring_gradient,
)
from oilfilm.bearing.rating.duty_cycle import LoadCase
from oilfilm.bearing.rating.film_life import ContactKappa, FilmLife, film_life
from oilfilm.bearing.rating.life import (
    GRADE_TEMPERATURE,
    HALVING,
    LARGEST_A_ISO,
    LARGEST_KAPPA,
    SMALLEST_KAPPA,
    relubrication_interval,
)
from oilfilm.bearing.rings.compliance import response_of
from oilfilm.bearing.rings.elastic_ring import ElasticRing
from oilfilm.bearing.studies.preload import pair_rigidity
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.solid.bodies import RingResponse, Seat
from oilfilm.ehl.units import MEGAPASCAL, MICROMETRE, from_si, to_si

from ..contact.summary import oil_permittivity, solution_messages
from ..files import plain_document
from ..quantities import (
    CAGE_SPEED,
    FREQUENCIES,
    NOTHING,
    STIFFNESS_ORDER,
    STIFFNESS_UNITS,
    in_hours,
    null,
    rows_of,
    values_of,
)
from .bearing_quantities import (
    BALL_QUANTITIES,
    CLEARANCE,
    CONTACT_STRENGTH,
    DUTY_CYCLE,
    ELASTIC_RING,
    ELECTRICAL,
    FILM_LIFE,
    HEAT_BALANCE,
    HEATING,
    LIFE_RATING,
    LOAD_CASE,
    LOAD_RATING,
    PATH,
    RING,
    RING_BODY,
    RING_GRADIENT,
    RING_LOAD,
    RING_STRENGTH,
    ROW,
    STABILITY,
    STABILITY_KEYS,
    TORQUE,
)
from .contact_quantities import (
    contact_messages,
    contact_records,
    contact_values,
    finite_body_block,
    finite_body_messages,
)
from .dry import dry_block, dry_messages
from .results import BearingResults, distinct_contacts
from .torque import (
    decay_block,
    decay_messages,
    oil_messages,
    rolling_messages,
    supply_block,
    supply_messages,
    torque_block,
    torque_messages,
)

NO_CYCLE = null("duty_cycle", "the case gives no [[load_cases]]")
CYCLE_MESSAGE = (
    "duty_cycle: each load case has its own equilibrium, clearance and oil, its torque is that "
    "of films without a solve; films, torque and pictures are those of [operation]"
)
# range of tilts that makers permit single deep groove bearings, 2 to 10 minutes of arc: SKF's
# general catalogue as quoted; RBC Bearings, "Misalignment": 0.5 to 3 [mrad]
PERMISSIBLE_TILT = (0.6, 2.9)
AGREEMENT = 1.0  # of temperatures that count as one [K]
# share of flooded films below which a life by the viscosity is warned of, chosen [-]
STARVED = 0.5
AT_ITS_LIMIT = 1.0 - 1e-9  # of a_ISO, within round-off [-]
RELUBRICATION = "relubrication_interval_h"
HOT_HALVINGS = 3.0  # of the interval of a grease from which its temperature is named
SMALL_TENSION = 1e3  # of a loose seat, not worth a message [Pa]
PROBABILITY = "failure_probability"
SHORT_GROWTH = 20_000.0 * 3600.0  # of a crack, below which it is named, 20 000 h [s]
NEXT_TO_NONE = 1e-9  # of a probability of failure, in the terminal [-]
NO_STANDARD = (
    "strength: no standard rates ceramic rings; hoop tension by Lame's cylinders, probability of "
    "failure by Weibull for flaws in the volume, its range that of the material's data "
    "(docs/theory/ceramic_strength.md)"
)
NOT_BRITTLE = (
    "strength: failure probabilities null, the rings have no bending_strength_MPa and "
    "weibull_modulus, or no width_mm"
)
MAKERS_RULE = (
    "strength: static rating of ceramic rings by the rule of makers, 65 to 75 % of that of steel; "
    "critical_flaw_um is the depth of a surface crack that the tension at the rim opens, without "
    "friction (docs/theory/ceramic_strength.md)"
)
LOOSE = (
    "strength: the case gives no [fit], rings of ceramic are taken as loose on shaft and in "
    "housing; the interference of a seat, as of a warm steel shaft, is left out of their tension"
)


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
        "ring": _ring(results),
        "equilibrium": {
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
            "message": state.message,
        },
        "rows": row_blocks(state),
        "pair": pair_block(state),
        "rings": ring_blocks(state),
        "cage_speed_rpm": CAGE_SPEED.value(state),
        "balls": rows_of(_balls(state)),
        "contacts": [contact_values(record) for record in contact_records(results)],
        "clearance": clearance_block(results),
        "strength": strength_block(results),
        "life": life_block(results),
        "dry_running": dry_block(results),
        "duty_cycle": duty_cycle_block(results),
        "load_cases": load_case_blocks(results),
        "frequencies_Hz": values_of(results.frequencies, FREQUENCIES),
        "kinematic_frequencies_Hz": kinematic_block(results),
        "torque_N_mm": torque,
        "power_balance": torque["power_balance"],
        "supply": supply_block(results),
        "decay": decay_block(results),
        "self_heating": heating_block(results),
        "heat_balances": balance_blocks(results),
        **network_blocks(results),
        "reference_speed_rpm": results.reference_speed_rpm,
        "electrical": electrical_values(results)[0],
        "finite_bodies": finite_body_block(results),
        "timing_s": dict(results.timing),
    }
    if results.measured is not None:
        document["measured"] = results.measured.document()
    head = results.head(results.converged, _bearing_messages(results))
    return plain_document(head | document)


def _ring(results: BearingResults) -> dict[str, Any]:
    state = results.quasistatic
    matrix = {"order": list(STIFFNESS_ORDER), "matrix": state.stiffness, "units": STIFFNESS_UNITS}
    without_films = values_of(results.elastic, ELASTIC_RING)
    elastic = {f"elastic_{key}": value for key, value in without_films.items()}
    return values_of(state, RING) | elastic | {"stiffness": matrix} | _tilts(state)


def _tilts(state: QuasistaticSolution) -> dict[str, Any]:
    """Tilt that the clearance leaves free, and the range that makers permit [mrad]."""
    alone = len(state.rows) == 1
    deep_groove = alone and not state.bearing.angular_contact
    return {
        "free_tilt_mrad": from_si("tilt_mrad", state.bearing.free_tilt) if alone else None,
        "permissible_tilt_mrad": list(PERMISSIBLE_TILT) if deep_groove else None,
    }


def tilt_line(state: QuasistaticSolution) -> dict[str, str]:
    """Line of the terminal's table on the tilt that a single deep groove bearing allows.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title; empty for other bearings.
    """
    tilts = _tilts(state)
    if tilts["permissible_tilt_mrad"] is None:
        return {}
    low, high = tilts["permissible_tilt_mrad"]
    free = f"{tilts['free_tilt_mrad']:.2g} mrad of tilt without load"
    return {"tilt allowed": f"{low:g} to {high:g} mrad by makers; its clearance leaves {free}"}


def _limit_messages(results: BearingResults) -> Iterator[str]:
    """Warn of a tilt beyond what makers permit and of a load below their minimum."""
    state = results.quasistatic
    tilts = _tilts(state)
    if tilts["free_tilt_mrad"] is None:
        yield "ring: free_tilt_mrad null, it is that of a single row"
    if tilts["permissible_tilt_mrad"] is None:
        yield "ring: permissible_tilt_mrad null, read for single deep groove bearings alone"
    elif (tilt := from_si("tilt_mrad", float(np.hypot(*state.tilt)))) > PERMISSIBLE_TILT[1]:
        low, high = PERMISSIBLE_TILT
        yield Caution(
            f"ring: a tilt of {tilt:.3g} mrad; makers permit deep groove bearings {low:g} to "
            f"{high:g} mrad (2 to 10 minutes of arc)"
        )
    life = results.life
    load, least = (None, None) if life is None else (life.equivalent_load, life.minimum_load)
    if load is not None and least is not None and load < least:
        yield Caution(
            f"life: an equivalent load of {load:.3g} N is below {least:.3g} N, 0.01 of the "
            "dynamic rating, from which balls roll without sliding by a rule of makers"
        )


def _balls(state: QuasistaticSolution) -> dict[str, Any]:
    """Columns of the balls."""
    numbers = {"ball": range(1, len(state.azimuth) + 1), "row": state.row_of_ball + 1}
    return numbers | values_of(state, BALL_QUANTITIES)


def electrical_values(results: BearingResults) -> tuple[dict[str, Any] | None, str]:
    """Capacitance between the rings and breakdown voltage.

    Parameters
    ----------
    results : BearingResults
        Results of a bearing.

    Returns
    -------
    tuple[dict[str, Any] | None, str]
        Values with their unit in their names, or None and the reason.
    """
    parts = (results.quasistatic.bearing, results.contacts, results.instruments)
    if lack := electrical_lack(*parts):
        return None, lack
    return values_of(bearing_electrical(*parts), ELECTRICAL), ""


def _electrical_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason for a missing capacitance, and name assumptions."""
    bearing = results.quasistatic.bearing
    if lack := electrical_values(results)[1]:
        yield null("electrical", lack)
        return
    if not results.case.get("lubricant", {}).get("relative_permittivity"):
        yield (
            f"electrical: relative permittivity {oil_permittivity(results.case):g} of the oil is "
            "assumed (lubricant.relative_permittivity)"
        )
    if bearing.ball_material.kind is INSULATOR:
        yield (
            "electrical: breakdown_voltage_V null, balls of silicon nitride take nearly all of "
            f"the voltage; relative permittivity {CERAMIC_PERMITTIVITY:g} of theirs is assumed"
        )


def _bearing_messages(results: BearingResults) -> Iterator[str]:
    yield from temperature_messages(results)
    yield from map(Caution, results.broken_laws)
    yield from oil_messages(results)
    state = results.quasistatic
    if not state.converged or ";" in state.message:  # free directions, friction beyond its limit
        yield Caution(f"equilibrium of ring and balls: {state.message}")
    for group in distinct_contacts(results):
        if group.solution is not None:
            yield from solution_messages(group.label, group.solution)
    yield from row_messages(results)
    yield from ring_messages(state)
    yield from _limit_messages(results)
    yield from contact_messages(results)
    yield from finite_body_messages(results)
    yield from rating_messages(results)
    yield from duty_cycle_messages(results)
    yield from strength_messages(results)
    yield from dry_messages(results)
    yield from torque_messages(results)
    yield from rolling_messages(results)
    yield from supply_messages(results)
    yield from decay_messages(results)
    yield from heating_messages(results)
    yield from _electrical_messages(results)


def duty_cycle_block(results: BearingResults) -> dict[str, Any]:
    """Equivalent load, lives, torque and energy of the cycle; None without load cases.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    return values_of(results.duty_cycle, DUTY_CYCLE)


def load_case_blocks(results: BearingResults) -> list[dict[str, Any]]:
    """Shares, load, life, torque of each load case; empty without them.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each load case.
    """
    cycle = results.duty_cycle
    return [
        {"load_case": number, **_values(case)}
        for number, case in enumerate(() if cycle is None else cycle.cases, 1)
    ]


def _values(case: LoadCase) -> dict[str, Any]:
    forces = case.operation.force
    moments = case.operation.moment
    loads = {
        "force_N": [from_si("force_N", force) for force in forces],
        "moment_N_mm": [from_si("moment_N_mm", moment) for moment in moments],
    }
    words = {"torque_model": case.torque_model, "converged": case.converged}
    return values_of(case, LOAD_CASE) | loads | words


def duty_cycle_messages(results: BearingResults) -> Iterator[str]:
    """Say what the cycle means for the results, and which of its values are null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    cycle = results.duty_cycle
    if cycle is None:
        yield NO_CYCLE
        return
    yield CYCLE_MESSAGE
    yield from cycle.messages


def duty_cycle_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: life and power of the cycle.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    cycle = results.duty_cycle
    if cycle is None:
        return {}
    available = duty_cycle_block(results)
    rows = {
        "duty cycle": f"{len(cycle.cases)} load cases, "
        f"mean {available['mean_speed_rpm']:.4g} r/min"
    }
    basic = available["basic_reference_rating_h"]
    if basic is not None:
        rows["duty cycle"] += f", equivalent load {available['dynamic_equivalent_load_N']:.4g} N"
        rows["life of the cycle"] = hours_text(basic, available["modified_reference_rating_h"])
    if available["static_safety_factor"] is not None:
        rows["safety of the cycle"] = f"S_0 {available['static_safety_factor']:.3g}, the smallest"
    if available["mean_power_W"] is not None:
        torque = available["mean_torque_N_mm"]
        mean = "" if torque is None else f"mean torque {torque:.4g} N mm, "
        rows["friction of the cycle"] = f"{mean}{available['mean_power_W']:.4g} W"
    return rows


def hours_text(basic: float, modified: float | None) -> str:
    """Life in words, from hours.

    Parameters
    ----------
    basic : float
        Basic rating life [h].
    modified : float | None
        Modified rating life [h], or None.

    Returns
    -------
    str
        The words.
    """
    text = f"L10h {hours(basic)}"
    return text if modified is None else f"{text}, modified L10mh {hours(modified)}"


def hours(life: float) -> str:
    """Life as `in_hours`, with its unit.

    Parameters
    ----------
    life : float
        Life [h].

    Returns
    -------
    str
        Hours with their unit.
    """
    return f"{in_hours(life)} h"


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


def balance_blocks(results: BearingResults) -> list[dict[str, Any]]:
    """All balances of friction and cooling, by their temperature.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Temperature, torque and stability of each; empty without a heat balance.
    """
    found = () if results.heating is None else results.heating.balances
    return [{**values_of(one, HEAT_BALANCE), "stable": one.stable} for one in found]


def _balances_text(heating: SelfHeatingSolution) -> str:
    """Several balances, and the start that leads to each."""
    ambient = from_si("temperature_C", heating.around.ambient)
    parts = [
        f"{from_si('temperature_C', one.temperature):.1f} C ({TORQUE.in_unit(one.torque):.3g} N mm"
        f"{'' if one.stable else ', unstable'})"
        for one in heating.balances
    ]
    return (
        f"self_heating: {len(parts)} balances of friction and cooling: {', '.join(parts)}; from "
        f"ambient, {ambient:.3g} C, the bearing warms to the one above, from beyond an unstable "
        "one it goes on to the next"
    )


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
        yield Caution(
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
        lacking = (results.case.get("friction") or {}).get("heat_transfer_W_K") is None
        turning = results.quasistatic.operation.shaft_speed
        why = "the case gives no friction.heat_transfer_W_K, or nothing turns"
        yield null("self_heating", why if lacking or not turning else "it is not asked for")
    elif heating.balance is None or not heating.converged:
        yield null("self_heating", f"not converged: {heating.note}; {_advice(results, heating)}")
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
        if len(heating.balances) > 1:
            yield Caution(_balances_text(heating))
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
    flow = required_oil_flow(state)
    if flow is not None:
        volume = flow / (oil.density * heat_of(oil).specific_heat)
        ways.append(f"cooling_oil_mL_min above {from_si('flow_mL_min', volume):.2g}")
    ways = [f"in [friction] {' or '.join(ways)}"] if ways else []
    limit = from_si("temperature_C", state.film_temperature)
    wanted = from_si("temperature_C", state.resulting_temperature)
    return (
        f"friction is {state.friction.power:.4g} W at {limit:.0f} C, which would warm the films "
        f"to {wanted:.4g} C: try {', '.join([*ways, 'a thinner oil'])}, or less speed; oilfilm "
        "init with --speed lays out oil and cooling"
    )


def life_block(results: BearingResults) -> dict[str, Any]:
    """Rating life, loads and the factors that led to it; None where it does not apply.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    life = results.life
    loads = () if life is None else LOAD_RATING
    films = values_of(life_by_films(results), FILM_LIFE)
    interval = {RELUBRICATION: from_si(RELUBRICATION, relubrication_time(results))}
    return values_of(life, (*LIFE_RATING, *loads)) | films | interval


def relubrication_time(results: BearingResults) -> float | None:
    """Time after which grease is to be renewed [s]; None without grease or bore.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    float | None
        Interval [s].
    """
    bore = results.quasistatic.bearing.bore
    grease = (results.case.get("friction") or {}).get("lubrication") == "grease"
    if not grease or bore is None:
        return None
    operation = results.quasistatic.operation
    return relubrication_interval(bore, operation.shaft_speed, operation.temperature)


def _hot_grease(results: BearingResults) -> Iterator[str]:
    """Warn of a grease so hot that its interval is less than an eighth of that at 70 C."""
    kelvin = results.quasistatic.operation.temperature
    if kelvin > GRADE_TEMPERATURE + HOT_HALVINGS * HALVING:
        yield Caution(
            f"life.{RELUBRICATION}: grease at {from_si('temperature_C', kelvin):.0f} C: by the "
            f"rule that halves its life every {HALVING:g} K above "
            f"{from_si('temperature_C', GRADE_TEMPERATURE):.0f} C little is left of it, and it "
            "may be beyond the limit of its maker"
        )


def _sealed(results: BearingResults) -> bool:
    """True if seals or shields on both sides keep the first grease in, and any other out."""
    designation = named_designation(results.quasistatic.bearing.name or "")
    seals = (results.case.get("friction") or {}).get("sealed")
    return bool(seals) or (designation is not None and designation.greased)


def life_by_films(results: BearingResults) -> FilmLife | None:
    """Life from the solved films in place of the viscosity; None without films or roughness.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    FilmLife | None
        The life.
    """
    life = results.life
    solved = any(film is not None for film in results.solutions)
    if life is None or life.viscosity_ratio is None or not (solved and "surface" in results.case):
        return None
    records = contact_records(results)
    ends = [_kappa([record.kappa_at(end) for record in records]) for end in (0.0, -1.0, 1.0)]
    result = film_life(results.quasistatic, life, *ends)
    return None if result.smallest_kappa is None else result


def _kappa(values: list[float | None]) -> ContactKappa:
    """kappa by race from that of all contacts, ball by ball and inner race first."""
    return ContactKappa(inner=values[0::2], outer=values[1::2])


def clearance_block(results: BearingResults) -> dict[str, float | None]:
    """Clearance, its changes, pressures of the seats; without a budget the operating one alone.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, float | None]
        Values by key.
    """
    values = values_of(results.clearance, CLEARANCE)
    if results.clearance is None:
        clearance = results.quasistatic.bearing.diametral_clearance
        values["operating_um"] = from_si("clearance_um", clearance)
    return values


def rating_messages(results: BearingResults) -> Iterator[str]:
    """Name the values of the blocks `life` and `clearance` that are null, with the reason.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    life = results.life
    yield from (null("life", "no rating was asked for"),) if life is None else life.messages
    if relubrication_time(results) is None:
        yield (
            f"life.{RELUBRICATION}: null without grease (friction.lubrication), bore_mm and "
            "rotation, and beyond the speeds of its formula"
        )
    else:
        yield (
            f"life.{RELUBRICATION}: rule for lithium grease, a horizontal shaft and clean "
            "surroundings, at the oil's temperature; the grease maker's data take precedence"
        )
        yield from _hot_grease(results)
    if results.clearance is None:
        yield (
            "clearance: taken as the operating one, the case gives neither [fit] nor "
            "[temperatures]; the rest null"
        )
    else:
        yield from results.clearance.messages
        yield from _cage_messages(results)
    if life is None or life.viscosity_ratio is None:
        return
    pairs = zip(results.contacts, results.operating, strict=True)
    loaded = [(c.load, film.supply.central) for c, film in pairs if film is not None]
    share = max(loaded, default=(0.0, 1.0))[1]
    kappa = life.viscosity_ratio
    left = kappa * share ** (results.case.get("surface") or {}).get("kappa_exponent", 1.0)
    if left < STARVED * min(kappa, LARGEST_KAPPA):
        yield Caution(
            f"life: kappa {kappa:.3g} and the modified life are those of flooded inlets; the oil "
            f"that comes leaves {share:.2g} of the film at the heaviest load, kappa {left:.2g}"
        )
    films = life_by_films(results)
    if films is None:
        yield (
            "life: kappa_film and what follows from it null, they need a resolved film and "
            "[surface] roughness"
        )
    else:
        if films.note:
            yield f"life: modified rating with the film of each contact null, {films.note}"
        exponent = results.case["surface"]["kappa_exponent"]
        yield (
            f"life: kappa_film is the smallest lambda_ratio to the power {exponent:g}, a rule "
            "that is unverified; kappa of each contact likewise"
        )


def _cage_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason why the change of the cage's clearances is null."""
    cage = None if results.clearance is None else results.clearance.cage
    if cage is None:
        yield (
            "clearance: cage_pocket_change_um, cage_land_change_um null, the case gives no "
            "temperatures.cage_C"
        )
    elif cage.land is None:
        yield (
            "clearance: cage_land_change_um null, no ring guides the cage, or no "
            "cage.land_diameter_mm is given"
        )
    elif cage.land < 0.0:
        given = (results.case.get("cage") or {}).get("land_clearance_um")
        if given is not None and to_si("land_clearance_um", given) + cage.land <= 0.0:
            yield Caution(
                "clearance: at its temperature the cage has no clearance left on its land, "
                f"{given:g} um less {-from_si('cage_land_change_um', cage.land):.3g} um"
            )


def rating_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table: clearance, rating life, static safety, viscosity ratio.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    budget = results.clearance
    life = results.life
    rows = {}
    if budget is not None:
        lengths = (budget.initial, budget.mounted, budget.operating)
        values = [round(from_si("clearance_um", length), 1) + 0.0 for length in lengths]  # no -0.0
        rows["clearance"] = "{:.1f} µm delivered, {:.1f} mounted, {:.1f} operating".format(*values)
    if life is None:
        return rows
    available = values_of(life, (*LIFE_RATING, *LOAD_RATING))
    kappa = available["kappa"]
    if available["basic_reference_rating_Mrev"] is None:
        rows["rating life"] = _why_none(life.messages)
    elif available["basic_reference_rating_h"] is not None:
        rows["rating life"] = _life_text(available)
    if (interval := relubrication_time(results)) is not None:
        time = hours(from_si(RELUBRICATION, interval))
        rows |= (
            {"grease for life": time} if _sealed(results) else {"relubrication": f"every {time}"}
        )
    if available["minimum_load_N"] is not None:
        rows["least load"] = f"{available['minimum_load_N']:.3g} N (0.01 C)"
    if available["static_safety_factor"] is not None:
        rows["static safety"] = f"S_0 {available['static_safety_factor']:.3g}"
        if available["static_safety"] is not None:
            rows["static safety"] += f", by pressure {available['static_safety']:.3g}"
    if kappa is not None:
        rows["viscosity ratio"] = f"κ {kappa:.3g} (SKF's diagram {available['kappa_skf']:.3g})"
        films = life_by_films(results)
        if films is not None:
            rows["viscosity ratio"] += (
                f" from the viscosity, {films.smallest_kappa:.3g} from the thinnest film"
            )
            rows |= film_row(values_of(films, FILM_LIFE))
    return rows


def _life_text(available: dict[str, Any]) -> str:
    """Basic life, and the modified one with its factor."""
    text = f"L10h {hours(available['basic_reference_rating_h'])}"
    if available["modified_reference_rating_h"] is None:
        return text
    modified = hours(available["modified_reference_rating_h"])
    limit = ", its limit" if available["a_iso"] >= AT_ITS_LIMIT * LARGEST_A_ISO else ""
    a_1 = available["a_1"]
    reliable = "" if a_1 == 1.0 else f", a_1 {a_1:.3g}"
    name = "L10mh" if a_1 == 1.0 else "Lnmh"
    return f"{text}, modified {name} {modified} (a_ISO {available['a_iso']:.3g}{limit}{reliable})"


def _why_none(messages: Iterable[str]) -> str:
    """Say "none", with the reason in the messages on the life."""
    start = "life: null, "
    reasons = [message.removeprefix(start) for message in messages if message.startswith(start)]
    return ": ".join(["none", *reasons[:1]])


def film_row(available: dict[str, Any]) -> dict[str, str]:
    """Line of the terminal's table on the life with the film of each contact.

    Parameters
    ----------
    available : dict[str, Any]
        Values of `FILM_LIFE` by key.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    thinnest = available["kappa_film"]
    if thinnest is not None and thinnest < SMALLEST_KAPPA:
        below = f"below {SMALLEST_KAPPA:g}, the least of ISO 281"
        return {"life by the films": f"none: κ of the thinnest film {thinnest:.2g} is {below}"}
    ends = [
        available[f"modified_reference_rating_contacts_{end}h"] for end in ("", "low_", "high_")
    ]
    if ends[0] is None:
        return {}
    text = f"L10mh {hours(ends[0])}"
    if ends[1] is None or ends[2] is None:
        return {"life by the films": text}
    low, high = hours(ends[1]), hours(ends[2])
    if low == high and ends[1] != ends[2]:  # to the figures that are printed
        return {"life by the films": text}
    band = f"{low} to {high}" if low != high else _no_band(available)
    return {"life by the films": f"{text} ({band})"}


def _no_band(available: dict[str, Any]) -> str:
    """Reason why the error bars of the films do not change the life."""
    if available["a_iso_contacts"] >= AT_ITS_LIMIT * LARGEST_A_ISO:
        return f"a_ISO at its limit of {LARGEST_A_ISO:g}"
    if available["kappa_film"] >= LARGEST_KAPPA:
        return f"every film counts as κ {LARGEST_KAPPA:g}, the limit of ISO 281"
    return "the error bars of the films do not move it"


@dataclass(frozen=True, slots=True)
class RingBody:
    """One elastic ring of an equilibrium."""

    race: str
    ring: ElasticRing
    response: RingResponse
    movement: tuple[np.ndarray, np.ndarray]  # axial and radial at the balls [m]

    @property
    def axial_compliance(self) -> float:
        """At a ball, of its own force, beyond Hertz' [m/N]."""
        return float(self.response.at(np.zeros(1))[0, 0])

    @property
    def radial_compliance(self) -> float:
        """Likewise [m/N]."""
        return float(self.response.at(np.zeros(1))[1, 0])

    @property
    def deflection(self) -> float:
        """Largest movement of the groove's centre at a ball [m]."""
        return float(np.hypot(*self.movement).max())

    @property
    def ovality(self) -> float:
        """Largest less smallest radial movement [m]."""
        return float(np.ptp(self.movement[1]))


def ring_bodies(state: QuasistaticSolution) -> tuple[RingBody, ...]:
    """The elastic rings of an equilibrium, inner ring first.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    tuple[RingBody, ...]
        The rings.
    """
    rings = state.model.rings
    pairs = () if rings is None else (("inner", rings.inner), ("outer", rings.outer))
    return tuple(
        RingBody(
            race,
            ring,
            response_of(ring),
            (getattr(state, f"{race}_ring_axial"), getattr(state, f"{race}_ring_radial")),
        )
        for race, ring in pairs
        if ring is not None
    )


def ring_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Seat, compliance, movements and finite elements of each elastic ring; none, if rigid.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each ring.
    """
    return [
        {
            "race": body.race,
            "seat": body.ring.seat.value,
            **values_of(body, RING_BODY),
            "shoulder_estimated": body.ring.estimated_shoulder,
            "unknowns": body.response.unknowns,
            "iterations": body.response.iterations,
            "method": body.response.method,
        }
        for body in ring_bodies(state)
    ]


def ring_messages(state: QuasistaticSolution) -> Iterator[str]:
    """Describe the seats of the elastic rings, and what was estimated.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    for body in ring_bodies(state):
        estimate = ", its shoulders estimated" if body.ring.estimated_shoulder else ""
        yield (
            f"{body.race} ring: an elastic body, {body.ring.seat.value} on its seat{estimate}; "
            f"grooves move by up to {body.deflection / MICROMETRE:.3g} um at the balls, beyond "
            "Hertz' approach; films and pressures are those of half-spaces"
        )
        for forces, _ in zip(*seat_reactions(state, Race(body.race)), strict=True):
            places = (
                f"{np.degrees(azimuth):.4g} deg: {force:.4g} N"
                for azimuth, force in zip(body.ring.supports, forces, strict=True)
            )
            yield f"{body.race} ring: pressed by its supports at {', '.join(places)}"
        tension = seat_tension(state, body)
        if tension > SMALL_TENSION:
            yield Caution(
                f"{body.race} ring: its seat does not open: opposite the load it pulls with up to "
                f"{tension / MEGAPASCAL:.3g} MPa, where a loose ring would lift off and bend more"
            )


def seat_tension(state: QuasistaticSolution, body: RingBody) -> float:
    """Largest pull of a loose seat, F/(pi R B), with the cosine from the load; zero for other
    seats.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.
    body : RingBody
        Elastic ring.

    Returns
    -------
    float
        Largest pull [Pa].
    """
    if body.ring.seat is not Seat.FREE:
        return 0.0
    radial = ball_forces(state, Race(body.race))[1].reshape(len(state.rows), -1)
    turns = state.azimuth.reshape(radial.shape)
    load = np.hypot((radial * np.cos(turns)).sum(axis=1), (radial * np.sin(turns)).sum(axis=1))
    profile = body.ring.profile
    return float(load.max() / (pi * profile.seat_radius * profile.width))


def ring_lines(state: QuasistaticSolution) -> dict[str, str]:
    """A line of the terminal's table for each elastic ring.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    lines = {}
    for block in ring_blocks(state):
        compliance = f"{block['radial_compliance_um_kN']:.3g} µm/kN beyond Hertz"
        moves = f"moves {block['deflection_um']:.3g} µm, ovality {block['ovality_um']:.3g} µm"
        lines[f"{block['race']} ring"] = f"elastic, seat {block['seat']}: {compliance}, {moves}"
    return lines


def kinematic_block(results: BearingResults) -> dict[str, float]:
    """Frequencies of rolling at the nominal contact angle, as catalogues have them [Hz].

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, float]
        Frequencies by key [Hz].
    """
    state = results.quasistatic
    life = results.life
    angle = state.bearing.free_contact_angle if life is None else life.rating.nominal_contact_angle
    return values_of(kinematic_frequencies(state.bearing, state.operation, angle), FREQUENCIES)


def frequency_lines(results: BearingResults) -> dict[str, str]:
    """A line of the terminal's table [Hz]; none where the rings turn together.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    own = results.frequencies
    texts = [f"{frequency.symbol} {frequency.value(own):.1f}" for frequency in FREQUENCIES]
    return {"frequencies": f"{', '.join(texts)} Hz"} if own.ball_spin > 0.0 else {}


def row_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Place, offset, load, cage and frequencies of each row.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each row.
    """
    blocks = []
    for index, row in enumerate(state.rows):
        alone = state.row(index)
        blocks.append(
            {
                "row": index + 1,
                **values_of(row, ROW),
                **values_of(alone, RING_LOAD),
                "balls_loaded": balls_loaded(alone),
                CAGE_SPEED.key: CAGE_SPEED.value(alone),
                "frequencies_Hz": values_of(bearing_frequencies(alone), FREQUENCIES),
            }
        )
    return blocks


def balls_loaded(state: QuasistaticSolution) -> int:
    """Number of balls that carry more at the inner race than the lightest that count.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    int
        Balls [-].
    """
    load = state.inner_load
    return int((load > NEGLIGIBLE_LOAD * load.max(initial=0.0)).sum())


def pair_block(state: QuasistaticSolution) -> dict[str, Any] | None:
    """Rigidity, off-load force and deflection at rest of two rows that press against each other.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, Any] | None
        Values by key; None of other bearings.
    """
    pair = pair_rigidity(state.bearing, [row.offset for row in state.rows])
    if pair is None:
        return None
    return {
        "preload_N": pair.preload,
        "rigidity_N_um": from_si("rigidity_N_um", pair.rigidity),
        "off_load_force_N": pair.off_load_force,
        "axial_load_N": pair.axial_load,
        "deflection_um": from_si("deflection_um", pair.deflection),
    }


def row_messages(results: BearingResults) -> Iterator[str]:
    """Explain the values of the whole bearing where there are several rows.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    rows = len(results.quasistatic.rows)
    if rows > 1:
        yield f"cage_speed_rpm, frequencies_Hz: mean over {rows} rows; each row in `rows`"
    if pair_block(results.quasistatic) is None:
        yield "pair: null, it is of two rows that are preloaded alike against each other"


def row_lines(state: QuasistaticSolution) -> dict[str, str]:
    """Lines of the terminal's table, one a row, none for a single row; loads in [N].

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    lines = {}
    for block in row_blocks(state) if len(state.rows) > 1 else ():
        x, y, z = (round(force, 1) + 0.0 for force in block["force_N"])
        cage = f"{block['balls_loaded']} balls loaded, cage {block['cage_speed_rpm']:.1f} r/min"
        lines[f"row {block['row']}"] = f"x {x:.1f}, y {y:.1f}, z {z:.1f} N, {cage}"
    if pair := pair_block(state):
        rigid = f"{pair['preload_N']:.4g} N, {pair['rigidity_N_um']:.3g} N/µm axial"
        lines["pair at rest"] = f"{rigid}, a row is free at {pair['off_load_force_N']:.4g} N"
    return lines


def strength_block(results: BearingResults) -> dict[str, Any]:
    """Tension, strength and failure probability of both rings, and the map of the inner ring.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any]
        The block.
    """
    strength = results.strength
    rings = {} if strength is None else {ring.race: ring for ring in strength.rings}
    blocks: dict[str, Any] = {
        f"{race.value}_ring": _ring_strength(results, race, rings.get(race)) for race in Race
    }
    inner_map = None if strength is None else strength.inner_map
    contacts = values_of(_contact_strength(results), CONTACT_STRENGTH)
    maps = {"inner_ring_map": None if inner_map is None else _map(inner_map)}
    return blocks | {"contacts": contacts} | maps


def _contact_strength(results: BearingResults) -> ContactStrength | None:
    """Strength of the contacts of ceramic rings; None for others."""
    if results.life is None:
        return None
    angle = results.life.rating.nominal_contact_angle
    return contact_strength(results.quasistatic, results.contacts, angle)


def _ring_strength(
    results: BearingResults, race: Race, ring: RingStrength | None
) -> dict[str, Any]:
    """One ring; the largest tension of its contacts, where films were solved."""
    pairs = zip(results.contacts, results.tensions, strict=False)
    solved = [t.ring for contact, t in pairs if t is not None and contact.race is race]
    tension = from_si("tension_GPa", max(solved, default=None))
    material = None if ring is None else ring.material.name
    gradient = None if ring is None else ring_gradient(results.quasistatic.bearing, ring)
    heated, heat_tension = _by_friction(results, gradient)
    return {
        "material": material,
        **values_of(ring, RING_STRENGTH),
        **values_of(gradient, RING_GRADIENT),
        "friction_gradient_K": from_si("gradient_K", heated),
        "friction_tension_MPa": from_si("tension_MPa", heat_tension),
        "surface_tension_maximum_GPa": tension,
    }


def _by_friction(
    results: BearingResults, gradient: RingGradient | None
) -> tuple[float | None, float | None]:
    """Track over seat if all friction heat leaves by this seat [K], and its hoop tension [Pa]."""
    if gradient is None or gradient.conductance is None:
        return None, None
    operation = results.quasistatic.operation
    power = None if results.dry is None else results.dry.power.value
    if results.torque is not None and results.torque.total is not None:
        power = results.torque.total * abs(operation.inner_speed - operation.outer_speed)
    if power is None:
        return None, None
    rise = power / gradient.conductance
    return rise, rise * gradient.tension


def _map(result: StrengthMap) -> dict[str, Any]:
    """Rows over the temperature, columns over the speed."""
    names = {"": "probability", "_low": "low", "_high": "high"}
    failures = {end: getattr(result, f"failure_{name}") for end, name in names.items()}
    return {
        "temperature_C": [
            round(from_si("temperature_C", float(t)), 9) for t in result.temperature
        ],
        "inner_speed_rpm": [round(from_si("speed_rpm", float(n)), 9) for n in result.speed],
        "hoop_tension_MPa": from_si("tension_MPa", result.hoop_tension).tolist(),
        **{
            f"{PROBABILITY}{end}": None if values is None else np.asarray(values).tolist()
            for end, values in failures.items()
        },
    }


def strength_messages(results: BearingResults) -> Iterator[str]:
    """Explain the numbers, name rings at risk, and give reasons for null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    strength = results.strength
    if strength is None:
        return
    brittle = [ring for ring in strength.rings if ring.failure_probability is not None]
    yield NO_STANDARD if brittle else NOT_BRITTLE
    if brittle and not results.case.get("fit"):
        yield LOOSE
    for ring in strength.rings:
        name = f"{ring.race.value} ring"
        share = ring.strength_share
        tension = from_si("tension_MPa", ring.hoop_tension)
        if share is not None and share > LARGE_SHARE:
            yield Caution(
                f"strength: the {name} has a hoop tension of {tension:.4g} MPa, {share:.0%} of "
                f"the bending strength of {ring.material.name}, beyond {LARGE_SHARE:.0%}"
            )
    for ring in brittle:
        if ring.growth_low is not None and ring.growth_low < SHORT_GROWTH:
            hours = from_si("time_h", ring.growth_low)
            yield Caution(
                f"strength: a crack may grow through the {ring.race.value} ring within "
                f"{hours:.3g} h at the low end of its exponent and strength "
                "(slow_crack_growth_low_h)"
            )
    temperature = results.quasistatic.operation.temperature
    for material in {ring.material.name: ring.material for ring in brittle}.values():
        shrinkage = -(material.thermal_strain(temperature - ROOM) or 0.0)
        tension = material.youngs_modulus * shrinkage / (1.0 - material.poisson_ratio)
        if tension > (material.bending_strength_range or (np.inf,))[0]:
            yield Caution(
                f"strength: {material.name} that comes from 20 C into a medium of "
                f"{from_si('temperature_C', temperature):.0f} C at once has "
                f"{from_si('tension_MPa', tension):.3g} MPa in its surface and may crack: "
                "cool it slowly"
            )
    for name in dict.fromkeys(ring.material.name for ring in brittle if _assumed(ring)):
        yield f"strength: the Weibull modulus of {name} is assumed, its range read in sources"
    contacts = _contact_strength(results)
    if contacts is not None:
        yield MAKERS_RULE
        if contacts.rim_safety is not None and contacts.rim_safety.low < 1.0:
            yield Caution(
                "strength: the least bending strength is "
                f"{contacts.rim_safety.low:.2g} of the tension at the rim of a contact "
                "(strength.contacts.rim_safety_low): ring cracks are possible, which the static "
                "rating of makers does not exclude"
            )
        if contacts.high_safety is not None and contacts.high_safety < 1.0:
            yield Caution(
                f"strength: the load is {1.0 / contacts.high_safety:.3g} times the static rating "
                "that makers give to ceramic bearings"
            )
    if not any(tension is not None for tension in results.tensions):
        yield (
            "contacts: surface_tension_ring_GPa and what belongs to it null, they need a film and "
            "a ring or ball of known bending strength; edge_tension_GPa is without friction"
        )


def _assumed(ring: RingStrength) -> bool:
    """True if no source was read for the modulus of a ring's material."""
    return "weibull_modulus" in ring.material.unverified


def strength_rows(results: BearingResults) -> dict[str, str]:
    """Lines of the terminal's table, one for each brittle ring.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    rows = {}
    for ring in () if results.strength is None else results.strength.rings:
        if ring.failure_probability is None:
            continue
        parts = [ring.hoop_tension, ring.fit_tension, ring.rotation_tension]
        tension, fit, rotation = (from_si("tension_MPa", part) for part in parts)
        odds = (ring.failure_probability, ring.failure_low, ring.failure_high)
        value, low, high = map(probability_text, odds)
        rows[f"{ring.race.value} ring"] = (
            f"hoop {tension:.3g} MPa (fit {fit:.3g}, rotation {rotation:.3g}), probability of "
            f"failure {value} ({low} to {high})"
        )
        if (gradient := ring_gradient(results.quasistatic.bearing, ring)) is not None:
            rows[f"{ring.race.value} ring"] += (
                f"; its track may be {gradient.warm.low:.0f} K warmer or "
                f"{gradient.cold.low:.0f} K colder than its seat (least strength)"
            )
    contacts = _contact_strength(results)
    if contacts is not None:
        tension = from_si("tension_GPa", contacts.edge_tension)
        flaw = from_si("flaw_um", contacts.critical_flaw)
        rows["contacts"] = f"tension {tension:.3g} GPa at the rim, opens cracks of {flaw:.3g} um"
        if contacts.rim_safety is not None:
            value, low, high = (f"{end:.3g}" for end in contacts.rim_safety)
            rows["contacts"] += f"; strength over it {value} ({low} to {high}), a lower bound"
        if contacts.low_safety is not None:
            rows["contacts"] += (
                f"; static safety {contacts.low_safety:.3g} to {contacts.high_safety:.3g} "
                "(rule of makers)"
            )
    return rows


def probability_text(value: float | None) -> str:
    """A probability of failure in words of the table.

    Parameters
    ----------
    value : float | None
        Probability of failure [-], or None.

    Returns
    -------
    str
        The words.
    """
    if value is None:
        return NOTHING
    return (
        "0" if value == 0.0 else f"< {NEXT_TO_NONE:g}" if value < NEXT_TO_NONE else f"{value:.1g}"
    )

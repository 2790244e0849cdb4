"""A time simulation: results, quantities, summary, table."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Group

from oilfilm.bearing.dynamics._integration_kernels import EVALUATIONS, REJECTED, STEPS
from oilfilm.bearing.dynamics.arrays import INNER_SPEED, OUTER_SPEED
from oilfilm.bearing.dynamics.choices import Integration
from oilfilm.bearing.dynamics.simulation import Simulation
from oilfilm.bearing.dynamics.statistics import (
    FEWEST_PLACES,
    INPUTS,
    LOSSES,
    MECHANISMS,
    RunningStatistics,
    SimulationStatistics,
    simulation_statistics,
    states,
)
from oilfilm.bearing.quasistatic.solution import ball_spin_without_slip, cage_speed_without_slip
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si

from .. import vibration as seen
from ..files import plain
from ..quantities import (
    CAGE_SPEED,
    Results,
    by_key,
    facts_table,
    number_table,
    quantities,
    rows_of,
    titled,
    values_of,
)

NO_INTERVAL = "there are fewer samples than a confidence interval needs"
NO_WHIRL = "the centre stays on the axis or is fixed"
STATES = ("free", "contact", "impact")  # of a ball at a race
RUN = quantities(
    ("simulated_s", "simulated time", "state.time"),
    ("wall_s", "wall time", "wall"),
    ("stiff", "", "state.stiff"),
    ("integration", "", "model.options.integration.value"),
    ("load_type", "", "state.kind.value"),
)
SPEEDS = (  # means over the last third, half widths of their 95 % intervals, ratios
    CAGE_SPEED,
    *quantities(("ball_orbit_speed_rpm", "", "orbit_speed")),
    *quantities(("ball_spin_speed_rpm", "", "spin_speed")),
    *quantities(("contact_angle_deg", "mean contact angle", "contact_angle")),
    *quantities(("kinematic_cage_speed_rpm", "", "kinematic_speed")),
    *quantities("cage_speed_ratio", "cage_slip_ratio", null="nothing turns"),
    *quantities(
        ("cage_speed_interval_rpm", "", "cage_interval"),
        ("ball_orbit_speed_interval_rpm", "", "orbit_interval"),
        null=NO_INTERVAL,
    ),
    *quantities(
        ("ring_whirl_speed_rpm", "", "ring_whirl"),
        ("cage_whirl_speed_rpm", "", "cage_whirl"),
        null=NO_WHIRL,
    ),
    *quantities(
        ("cage_whirl", "", "cage_whirls"),
        null="there is no cage, or samples are too few",
        words=True,
    ),
    *quantities(("cage_orbit_radius_um", "", "cage_orbit"), null=NO_WHIRL),
    *quantities(("energy_balance_error", "", "energy_error")),
    *quantities("steady", null="there are too few samples", words=True),
    *quantities(
        ("cage_speed_to_come_rpm", "", "left"),
        ("relaxation_time_s", "", "relaxation"),
        null="nothing drifts, or not as an exponential",
    ),
    *quantities(("friction_torque_N_mm", "friction torque", "friction_torque")),
    *quantities(("table_exceeded", "", "table_exceeded"), null="there is no traction table"),
    *quantities(("gyroscopic_speed_rad_s", "", "gyroscopic_speed")),
    *quantities(("gyroscopic_load_ratio", "", "gyroscopic_load"), null="there is no friction"),
)
STARTS = (  # of the end of each
    CAGE_SPEED,
    *quantities(("cage_speed_interval_rpm", "", "cage_interval"), null=NO_INTERVAL),
    *quantities(("ball_orbit_speed_rpm", "", "orbit_speed")),
)
BALLS = quantities("largest_pocket_load_N")
RACES = quantities(  # of each ball at each race; sliding and friction while it is loaded
    "mean_load_N",
    "largest_load_N",
    ("mean_sliding_m_s", "", "mean_sliding"),
    ("largest_sliding_m_s", "", "largest_sliding"),
    ("mean_friction_N", "", "mean_friction"),
)
PLOTTED = by_key(
    quantities(
        "time_ms",
        ("speed_rpm", "speed about the axis"),
        ("spin_speed_rpm", "spin of the balls"),
        ("normal_force_N", "normal force on ball 1"),
        ("friction_N", "friction along the entrainment"),
        ("sliding_speed_m_s", "sliding speed at the\ncontact's centre"),
        "traction_factor",
        ("azimuth_deg", "azimuth of ball 1"),
        ("y_um", "y, along the load line"),
        "z_um",
        "frequency_Hz",
        ("amplitude_um", "inner ring"),
        "energy_J",
    )
)
HEADERS = ("ball", *STATES, "N", *STATES, "N")
TITLE = "share of the time at the inner race, and at the outer race; largest load"
LEFT_OUT = (
    "dynamics: implicit steps: speeds and loads of the motion without contact vibration, impacts; "
    "no spectrum, no contact states over time, and largest_pocket_load_N is null",
)
SAME = 0.01  # of the cage speed of the equilibrium, beyond which a difference is told [-]
LOADS = 0.05  # uncertainty of a mean load over it, above which it is told [-]
HELD = 0.9  # gyroscopic couple over what friction holds, above which balls slip [-]
ENERGY_LIMIT = 1.0e-3  # of the work put in: a larger residual is flagged [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsResults(Results):
    """A time simulation of one case, at its end."""

    simulation: Simulation
    running: RunningStatistics  # of its records
    history: Path  # file with the records themselves
    # ends of further starts, without a history; None: one did not get there
    others: tuple[SimulationStatistics | None, ...] = ()
    vibration: "seen.VibrationResults | None" = None  # of a case with form or supports


def dynamics_summary(results: DynamicsResults) -> dict[str, Any]:
    """The simulation as plain JSON: speeds [r/min], energies [J], loads [N], times [s].

    What does not apply is None with the reason in `messages`.

    Parameters
    ----------
    results : DynamicsResults
        Results of the simulation.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    simulation = results.simulation
    numbers = simulation_statistics(simulation, results.running)
    counters = simulation.state.counters
    balanced = numbers is not None and numbers.energy_error <= ENERGY_LIMIT
    document = {
        **values_of(simulation, RUN),
        "steps": counters[STEPS],
        "rejected_steps": counters[REJECTED],
        "evaluations": counters[EVALUATIONS],
        "equations": simulation.equations["dynamic"],
        "equation_counts": simulation.equations,
        **values_of(numbers, SPEEDS),
        "energy": None if numbers is None else _energy(numbers),
        "frequencies_Hz": None if numbers is None else _frequencies(simulation, numbers),
        "balls": [] if numbers is None else _balls(simulation, numbers),
        **_starts(results, numbers),
        **({} if results.vibration is None else seen.vibration_blocks(results.vibration)),
        "timing_s": results.timing,
    }
    messages = (
        *(LEFT_OUT if left_out(simulation) else ()),
        *_messages(numbers, left_out(simulation)),
        *_other_speed(simulation, numbers),
        *_start_messages(results, document),
    )
    if results.vibration is not None:
        messages = (*messages, *seen.vibration_messages(results.vibration))
    head = results.head(simulation.converged and balanced, messages)
    return head | dict(plain(document))


def _starts(results: DynamicsResults, numbers: SimulationStatistics | None) -> dict[str, Any]:
    """Ends of all starts and the number of states among them; one start shows one."""
    ends = [end for end in (numbers, *results.others) if end is not None]
    return {"states_found": len(states(ends)), "starts": [values_of(end, STARTS) for end in ends]}


def _start_messages(results: DynamicsResults, document: dict[str, Any]) -> Iterator[str]:
    lost = sum(end is None for end in results.others)
    if lost:
        yield f"dynamics: {lost} of the further starts did not reach the end"
    if document["states_found"] > 1:
        speeds = ", ".join(f"{end['cage_speed_rpm']:.1f}" for end in document["starts"])
        yield Caution(
            f"dynamics: {document['states_found']} states found from {len(document['starts'])} "
            f"starts, by the cage speed: {speeds} r/min; which one a bearing takes depends on its "
            "history, and the intervals hold within a state"
        )


def _messages(numbers: SimulationStatistics | None, implicit: bool) -> Iterator[str]:
    if numbers is None:
        yield "dynamics: not converged: no sample was reached; all results are null"
        return
    if numbers.energy_error > ENERGY_LIMIT:
        error = f"{numbers.energy_error:.2g} of the work"
        advice = "take explicit steps" if implicit else "lower tolerance"
        yield f"dynamics: not converged: the energies are off by {error}; {advice}"
    if numbers.steady is False:
        yield Caution(_transient(numbers))
    elif (width := numbers.load_interval) is not None and width > LOADS:
        yield Caution(
            f"dynamics: the mean load of a race is known to {100.0 * width:.2g} % only (95 %): it "
            "changes widely, as of a ring that bounces; simulate longer"
        )
    if numbers.table_exceeded:
        largest = numbers.largest_load.max(axis=1)
        yield Caution(
            f"dynamics: {100.0 * numbers.table_exceeded:.3g} % of the loaded contacts over the "
            f"last third lie outside the traction table: up to {largest[0]:.3g} N and "
            f"{numbers.fastest[0]:.3g} m/s at the inner, {largest[1]:.3g} N and "
            f"{numbers.fastest[1]:.3g} m/s at the outer race, or at angles whose rolling radius "
            "is 5 % off; there speeds count as the nearest of the table, forces in proportion to "
            "the load; make one of this case (oilfilm table --loads --speeds)"
        )
    if numbers.gyroscopic_load is not None and numbers.gyroscopic_load > HELD:
        spin = abs(numbers.gyroscopic_speed / numbers.spin_speed) if numbers.spin_speed else 0.0
        yield Caution(
            f"dynamics: gyroscopic slip: the couple is {numbers.gyroscopic_load:.2f} of what "
            f"friction holds at most; balls turn about the tangent at {spin:.2f} of their spin"
        )
    if numbers.cage_interval is None:
        yield "dynamics: fewer than 60 samples: no confidence interval of the speeds"
    if numbers.cage_whirls:
        yield _whirl(numbers)
    if numbers.averaged < FEWEST_PLACES:
        yield "dynamics: too few samples to tell whether ring and cage whirl"
        return
    still = [name for name in ("ring", "cage") if getattr(numbers, f"{name}_whirl") is None]
    if still:
        bodies = " and ".join(still)
        yield f"dynamics: no whirl: the centre of {bodies} stays on the axis or is fixed"


def _other_speed(simulation: Simulation, numbers: SimulationStatistics | None) -> Iterator[str]:
    """A cage that does not turn as in the equilibrium, whose speed other commands take."""
    state = simulation.point.equilibrium
    if state is None or numbers is None or len(simulation.data.schedule) > 1:
        return
    rolling = state.cage_speed
    if rolling and abs(numbers.cage_speed - rolling) > SAME * abs(rolling):
        there = from_si("speed_rpm", rolling)
        yield Caution(
            f"dynamics: the cage turns at {numbers.cage_speed / rolling:.3f} of the "
            f"{there:.1f} r/min of rolling balls in equilibrium, which run, vibration without "
            "[dynamics] and frequencies take: their defect frequencies are off by as much"
        )


def _transient(numbers: SimulationStatistics) -> str:
    """Part of a relaxation that is still to come."""
    text = "dynamics: not steady: the speeds still drift over the last third of the time"
    if numbers.left is not None and numbers.relaxation is not None:
        left = from_si("speed_rpm", numbers.left)
        text += (
            f"; as an exponential of {numbers.relaxation:.2g} s the cage has {left:+.3g} r/min to "
            "go"
        )
    return f'{text}; lengthen end_time_s, or end_time = "steady" ends where nothing drifts'


def _whirl(numbers: SimulationStatistics) -> str:
    """Speed, size and forces of a cage that whirls."""
    assert numbers.cage_whirl is not None  # of a cage that whirls
    assert numbers.cage_orbit is not None
    assert numbers.cage_play is not None
    speed = f"{from_si('speed_rpm', numbers.cage_whirl):.0f} r/min"
    ratio = numbers.cage_whirl / numbers.cage_speed if numbers.cage_speed else 0.0
    radius, play = (from_si("orbit_um", size) for size in (numbers.cage_orbit, numbers.cage_play))
    return (
        f"dynamics: the cage whirls: its centre goes round at {speed}, {ratio:.2f} of the cage's "
        f"speed, on a radius of {radius:.0f} of {play:.0f} um of play, with up to "
        f"{numbers.largest_pocket_load.max():.2g} N in a pocket"
    )


def _energy(numbers: SimulationStatistics) -> dict[str, Any]:
    """[J]."""
    return {
        "input_J": {name: numbers.work[name] for name in MECHANISMS[:INPUTS]},
        "dissipated_J": {name: numbers.work[name] for name in MECHANISMS[LOSSES]},
        "films_J": numbers.work["films"],
        "stored_J": numbers.stored,
    }


def _frequencies(simulation: Simulation, numbers: SimulationStatistics) -> dict[str, Any]:
    """Defect frequencies, kinematic and with the cage speed of the simulation [Hz]."""
    schedule = simulation.data.schedule
    bearing = simulation.bearing
    balls = bearing.balls
    inner = schedule[-1, INNER_SPEED] / (2.0 * np.pi)
    outer = schedule[-1, OUTER_SPEED] / (2.0 * np.pi)
    angle = numbers.contact_angle
    ratio = bearing.ball_diameter / bearing.pitch_diameter
    gamma = ratio * float(np.cos(angle))
    rolling = ball_spin_without_slip(ratio, gamma, inner, outer)
    speeds = {
        "kinematic": (cage_speed_without_slip(gamma, inner, outer), rolling),
        "with_slip": (numbers.orbit_speed / (2.0 * np.pi), numbers.spin_speed / (2.0 * np.pi)),
    }
    return {
        name: {
            "cage": abs(cage),
            "ball_pass_outer": balls * abs(cage - outer),
            "ball_pass_inner": balls * abs(inner - cage),
            "ball_spin": spin,
        }
        for name, (cage, spin) in speeds.items()
    }


def _balls(simulation: Simulation, numbers: SimulationStatistics) -> list[dict[str, Any]]:
    angles = np.degrees(simulation.data.pocket_angle) % 360.0
    shares = np.moveaxis(numbers.shares, 2, 1)
    loads = values_of(numbers, RACES)
    races = {
        race: rows_of(
            dict(zip(STATES, shares[r], strict=True))
            | {key: values[r] for key, values in loads.items()}
        )
        for r, race in enumerate(("inner", "outer"))
    }
    columns = {"ball": range(1, len(angles) + 1), "start_azimuth_deg": angles}
    rows = rows_of(columns | races | values_of(numbers, BALLS))
    return (
        [{**row, "largest_pocket_load_N": None} for row in rows] if left_out(simulation) else rows
    )


def left_out(simulation: Simulation) -> bool:
    """Tell whether the steps leave out contact vibration and impacts.

    Parameters
    ----------
    simulation : Simulation
        Simulation of a bearing.

    Returns
    -------
    bool
        True of implicit steps.
    """
    return simulation.model.options.integration is Integration.IMPLICIT


def dynamics_table(document: dict[str, Any]) -> Group:
    """A summary: speeds [r/min], energies [J], contact states [-] and largest loads [N].

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    rows = []
    for ball in document["balls"]:
        cells = [str(ball["ball"])]
        for race in ("inner", "outer"):
            cells += [f"{ball[race][state]:.3f}" for state in STATES]
            cells.append(f"{ball[race]['largest_load_N']:.3g}")
        rows.append(cells)
    states = number_table(HEADERS, rows, title=TITLE, title_style="")
    return titled(str(document["case"].get("title", "")), facts_table(_facts(document)), states)


def _facts(document: dict[str, Any]) -> dict[str, str]:
    counts = document["equation_counts"]
    parts = f"{counts['ring']} ring + {counts['cage']} cage + {counts['balls']} balls"
    run = f"{document['wall_s']:.1f} s, {document['steps']} steps"
    facts = {
        "equations": f"{document['equations']} ({document['load_type']}: {parts})",
        "simulated": f"{document['simulated_s']:.6g} s in {run}",
    }
    speed = document["cage_speed_rpm"]
    ratio = document["cage_speed_ratio"]
    if speed is None:
        return facts
    width = document["cage_speed_interval_rpm"]
    facts["cage"] = f"{speed:.2f}{'' if width is None else f' ± {width:.2g}'} r/min"
    if ratio is not None:
        kinematic = document["kinematic_cage_speed_rpm"]
        facts["cage"] += f", {ratio:.4f} of the kinematic {kinematic:.2f}"
    if document["steady"] is False:
        left = document["cage_speed_to_come_rpm"]
        facts["cage"] += ", not steady" + ("" if left is None else f": {left:+.3g} r/min to come")
    friction = document["case"].get("dynamics", {}).get("friction", "table")
    partly = "" if friction == "table" else f" by {friction}, without rolling resistance"
    facts["friction torque"] = f"{document['friction_torque_N_mm']:.4g} N mm{partly}"
    facts["sliding"] = _sliding(document["balls"])
    lost = document["energy"]["dissipated_J"]
    supplied = sum(document["energy"]["input_J"].values())
    largest = sorted(lost, key=lambda name: -abs(lost[name]))[:3]
    parts = ", ".join(f"{name.replace('_', ' ')} {lost[name]:.3g}" for name in largest)
    facts["energy"] = f"{supplied:.4g} J in, {sum(lost.values()):.4g} J lost ({parts})"
    if films := document["energy"]["films_J"]:
        where = "taken up" if films > 0.0 else "given, lifting balls"
        facts["films"] = f"{abs(films):.3g} J {where}"
    facts["balance"] = f"off by {document['energy_balance_error']:.1e} of the work"
    vibration = document.get("vibration")
    return facts if vibration is None else facts | seen.envelope_fact(vibration)


def _sliding(balls: list[dict[str, Any]]) -> str:
    """Mean sliding and friction of the ball that slides most, at both races."""
    parts = []
    for race in ("inner", "outer"):
        most = max((ball[race] for ball in balls), key=lambda of: of["mean_sliding_m_s"])
        friction = f"{most['mean_friction_N']:.3g} N of friction"
        parts.append(f"{race} race {most['mean_sliding_m_s']:.3g} m/s, {friction}")
    return f"{'; '.join(parts)} (means under load, ball that slides most)"

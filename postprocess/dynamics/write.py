"""Files of a time simulation, and its table in the terminal."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich.console import Group

from ..files import SUMMARY_FILE, write_json
from ..quantities import facts_table, number_table, titled
from .history import HISTORY_FILE
from .plots import write_dynamics_plots
from .results import STATES, DynamicsResults, dynamics_summary

HEADERS = ("ball", *STATES, "N", *STATES, "N")
TITLE = "share of the time at the inner race, and at the outer race; largest load"


def write_dynamics(
    results: DynamicsResults, directory: Path, is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write summary, history and pictures.

    Parameters
    ----------
    results : DynamicsResults
        Results of the simulation.
    directory : Path
        Folder to write into.
    is_interrupted : Callable[[], bool], default lambda: False
        Asked before each picture; once it is true no further one is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    directory.mkdir(parents=True, exist_ok=True)
    document = dynamics_summary(results)
    write_json(document, directory / SUMMARY_FILE)
    shutil.move(results.history, directory / HISTORY_FILE)
    if not results.running.rows or is_interrupted():
        return ()
    return write_dynamics_plots(directory, document, is_interrupted)


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
    facts["friction torque"] = f"{document['friction_torque_N_mm']:.4g} N mm"
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
    return facts


def _sliding(balls: list[dict[str, Any]]) -> str:
    """Mean sliding and friction of the ball that slides most, at both races."""
    parts = []
    for race in ("inner", "outer"):
        most = max((ball[race] for ball in balls), key=lambda of: of["mean_sliding_m_s"])
        friction = f"{most['mean_friction_N']:.3g} N of friction"
        parts.append(f"{race} race {most['mean_sliding_m_s']:.3g} m/s, {friction}")
    return f"{'; '.join(parts)} (means under load, ball that slides most)"

"""A duty cycle: the blocks `duty_cycle` and `load_cases` of the summary, lines of the terminal."""

from collections.abc import Iterator
from typing import Any

from oilfilm.bearing.rating.duty_cycle import LoadCase
from oilfilm.ehl.units import from_si

from ..quantities import in_figures, values_of
from .quantities import DUTY_CYCLE, LOAD_CASE
from .results import BearingResults

NO_CYCLE = "duty_cycle: null, the case gives no [[load_cases]]"
CYCLE_MESSAGE = (
    "duty_cycle: each load case has its own equilibrium, clearance and oil, its torque is that "
    "of films without a solve; films, torque and pictures are those of [operation]"
)


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
    """Hours to three figures, without a power of ten.

    Parameters
    ----------
    life : float
        Life [h].

    Returns
    -------
    str
        Hours with their unit.
    """
    return f"{in_figures(life, 3)} h"

"""Temperatures of a bearing over speed, and over time from a start on: results and summary."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.heating.over_speed import SpeedBranch, SpeedLimit
from oilfilm.bearing.heating.over_time import WarmUp
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.ehl.units import from_si

from ..files import plain
from ..quantities import Quantity, Results, rows_of, values_of

SPEED = Quantity("speed_rpm", "speed of the shaft", "speed")
LIMIT = Quantity("limiting_speed_rpm", "limiting speed by heat", "branch.limit")
TIME = Quantity("time_s", "time", "time")
FILM = Quantity("film_temperature_C", "temperature of the films", "film_temperature")
CLEARANCE = Quantity("clearance_um", "diametral clearance", "clearance")
POWER = Quantity("power_W", "heat of friction", "power")
TORQUE = Quantity("torque_N_mm", "friction torque", "torque")
MARGIN = Quantity("runaway_margin", "margin against thermal runaway", "heating.stability.margin")
TIME_CONSTANT = Quantity(
    "thermal_time_constant_s", "longest time constant", "heating.stability.longest_time"
)
ENDS = {
    SpeedLimit.RUNAWAY: (
        "above it friction grows faster with the temperature than the cooling: no balance"
    ),
    SpeedLimit.TEMPERATURE: (
        "there the films reach the highest temperature of lubricants that is reckoned with"
    ),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class TemperatureResults(Results):
    """Temperatures of one case over speed and time."""

    speed: float  # of the shaft in the case [rad/s]
    heating: SelfHeatingSolution  # at that speed
    branch: SpeedBranch
    warm_up: WarmUp

    @property
    def converged(self) -> bool:
        """True if the speed of the case has a balance, the branch a known end, and the course its
        full time.
        """
        known = self.branch.limited_by is not SpeedLimit.NO_STATE
        return self.heating.converged and known and self.warm_up.ended


def temperatures_summary(results: TemperatureResults) -> dict[str, Any]:
    """The study as plain JSON: balances over the speed, course over time, the least clearance.

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    warm = results.warm_up
    course = {quantity.key: quantity.value(warm) for quantity in (TIME, FILM, CLEARANCE, POWER)}
    course |= _nodes(warm.temperatures)
    least = int(np.argmin(warm.clearance))
    document = {
        **values_of(results, (SPEED, LIMIT)),
        "limited_by": results.branch.limited_by.value,
        **values_of(results, (MARGIN, TIME_CONSTANT)),
        "balances": rows_of(balance_columns(results)),
        "warm_up": {
            "least_clearance_um": CLEARANCE.in_unit(warm.clearance[least]),
            "least_clearance_time_s": float(warm.time[least]),
            "course": rows_of(course),
        },
    }
    head = results.head(results.converged, temperature_study_messages(results))
    return head | dict(plain(document)) | {"timing_s": results.timing}


def balance_columns(results: TemperatureResults) -> dict[str, Any]:
    """Balances over the speed as columns, in the units of the keys.

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.

    Returns
    -------
    dict[str, Any]
        Values by key, shape (n,) each.
    """
    balances = results.branch.balances
    states = [balance.state for balance in balances]
    speed = np.array([balance.speed for balance in balances])
    power = np.array([state.friction.power for state in states])
    columns = {
        SPEED.key: SPEED.in_unit(speed),
        FILM.key: FILM.in_unit(np.array([state.film_temperature for state in states])),
        CLEARANCE.key: CLEARANCE.in_unit(np.array([state.clearance for state in states])),
        POWER.key: POWER.in_unit(power),
        TORQUE.key: TORQUE.in_unit(power / speed),
    }
    return columns | _nodes(np.stack([state.temperatures for state in states]))


def _nodes(temperatures: Any) -> dict[str, Any]:
    """A column for each node of temperatures (rows, nodes) [degrees Celsius]."""
    values = from_si("temperature_C", temperatures)
    return {f"{name}_temperature_C": values[:, k] for k, name in enumerate(NODES)}


def temperature_study_messages(results: TemperatureResults) -> Iterator[str]:
    """State the limit of the speed, and the end of the course.

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.

    Yields
    ------
    Iterator[str]
        A message.
    """
    branch = results.branch
    limit = LIMIT.value(results)
    if branch.limited_by in ENDS:
        film = FILM.value(branch.fastest.state)
        yield (
            f"limiting speed {limit:.0f} r/min by heat, films at {film:.0f} C: "
            f"{ENDS[branch.limited_by]}; material, cage and oil may allow less"
        )
    elif branch.limited_by is SpeedLimit.NOT_REACHED:
        fastest = SPEED.in_unit(branch.fastest.speed)
        yield f"limiting speed null: none up to {fastest:.0f} r/min, where the search ends"
    else:
        last = branch.balances[-1]
        reason = branch.message or SpeedLimit.NO_STATE.value
        yield (
            f"limiting speed null: not converged beyond {SPEED.in_unit(last.speed):.0f} r/min, "
            f"films at {FILM.value(last.state):.0f} C: {reason}"
        )
    if not results.heating.converged:
        yield (
            f"not converged: no balance at the speed of the case: {results.heating.note}; the "
            "balances are those of lower speeds"
        )
    if not results.warm_up.ended:
        yield (
            f"not converged: the course ends after {results.warm_up.time[-1]:.0f} s: "
            f"{results.warm_up.message}"
        )

"""Files of the temperatures over speed and time."""

from pathlib import Path

import numpy as np

from bearing.heating.network import NODES

from ..files import Table
from ..netcdf.groups import Variables
from ..netcdf.study import StudyFiles, write_study
from .plots import write_temperatures_plot
from .results import TemperatureResults
from .summary import temperatures_summary

KELVIN = {"units": "K"}


def write_temperatures(results: TemperatureResults, directory: Path) -> tuple[str, ...]:
    """Write balances, course, data set, summary; pictures that failed are messages.

    Parameters
    ----------
    results : TemperatureResults
        Temperatures of the case.
    directory : Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    document = temperatures_summary(results)
    files = StudyFiles(
        kind="temperatures",
        document=document,
        tables={
            "balances": _table(document["balances"]),
            "warm_up": _table(document["warm_up"]["course"]),
        },
        variables=_variables(results),
    )
    return write_study(files, directory, lambda: write_temperatures_plot(results, directory))


def _table(rows: list[dict[str, float]]) -> Table:
    return list(rows[0]), np.array([list(row.values()) for row in rows])


def _variables(results: TemperatureResults) -> Variables:
    """Temperatures of the nodes over `speed` [rad/s] and over `time` [s]."""
    balances = results.branch.balances
    warm = results.warm_up
    places = np.array([balance.speed for balance in balances])
    over_speed = np.stack([balance.state.temperatures for balance in balances])
    return {
        "node": (("node",), np.array(NODES, dtype=object), {}),
        "balance": (("balance",), np.arange(len(places)), {}),
        "speed": (("balance",), places, {"units": "rad/s"}),
        "temperature": (("balance", "node"), over_speed, KELVIN),
        "time": (("time",), warm.time, {"units": "s"}),
        "course": (("time", "node"), warm.temperatures, KELVIN),
        "clearance": (("time",), warm.clearance, {"units": "m"}),
    }

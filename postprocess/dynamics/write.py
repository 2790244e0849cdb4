"""Files of a time simulation."""

import shutil
from collections.abc import Callable
from pathlib import Path

from ..files import SUMMARY_FILE, write_json
from .history import HISTORY_FILE
from .plots import write_dynamics_plots
from .results import DynamicsResults
from .summary import dynamics_summary


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
    hurried : Callable[[], bool], default lambda: False
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

"""Files of traction tables."""

from pathlib import Path

from bearing.friction.tables import save_race_tables, save_temperature_tables

from .plots import write_traction_plots
from .results import TractionResults


def write_traction(results: TractionResults, path: Path) -> None:
    """Write the tables, and beside them `<name>_curves.png` and `<name>_map.png`.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.
    path : Path
        File of the tables.
    """
    save_tables(results, path)
    write_traction_plots(results, path)


def save_tables(results: TractionResults, path: Path) -> None:
    """Write the tables to a file; it appears under its name only when it is complete.

    Parameters
    ----------
    results : TractionResults
        Traction tables of the case.
    path : Path
        File of the tables.
    """
    if results.over_temperature is None:
        save_race_tables(results.tables, path)
    else:
        save_temperature_tables(results.over_temperature, path)

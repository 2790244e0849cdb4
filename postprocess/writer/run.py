"""All files of a run, written by one process."""

from functools import partial
from pathlib import Path

from ..bearing.results import BearingResults
from ..contact.results import ContactResults
from .extras import write_extras
from .numbers import write_numbers


def write_results(
    results: BearingResults | ContactResults, directory: str | Path
) -> tuple[str, ...]:
    """Write netCDF, CSV, VTK, pictures, last the summary; files of the same names are replaced.

    Returns what could not be drawn and why, which `summary.json` says too. OSError if the numbers
    themselves cannot be written: disk full, no permission.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    return write_numbers(results, folder, partial(write_extras, results, folder))

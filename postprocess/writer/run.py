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

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.
    directory : str | Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        What could not be drawn, and why; `summary.json` has these messages, too.

    Raises
    ------
    OSError
        If the numbers cannot be written: disk full, no permission.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    return write_numbers(results, folder, partial(write_extras, results, folder))

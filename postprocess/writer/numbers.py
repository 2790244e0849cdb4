"""Numbers of a run: netCDF and CSV, and last the summary, which says what could not be drawn."""

from collections.abc import Callable
from pathlib import Path

from ..bearing.results import BearingResults
from ..bearing.write import write_bearing_netcdf, write_contacts_csv
from ..contact.results import ContactResults
from ..contact.write import write_contact_netcdf
from ..files import CONTACTS_FILE, SUMMARY_FILE, write_json
from ..netcdf.groups import FIELDS_FILE
from .summaries import summary


def write_numbers(
    results: BearingResults | ContactResults, folder: Path, extras: Callable[[], tuple[str, ...]]
) -> tuple[str, ...]:
    """Write the numbers of a run: netCDF, CSV and summary.

    The summary comes last: where it stands, all files are complete.

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.
    folder : Path
        Folder to write into.
    extras : Callable[[], tuple[str, ...]]
        Waits for pictures and VTK files, and returns the messages on what failed.

    Returns
    -------
    tuple[str, ...]
        What `extras` returned.

    Raises
    ------
    OSError
        If the disk does not take the files.
    """
    document = summary(results)
    if isinstance(results, ContactResults):
        write_contact_netcdf(results, folder / FIELDS_FILE, document)
    else:
        write_bearing_netcdf(results, folder / FIELDS_FILE, document)
        write_contacts_csv(document, folder / CONTACTS_FILE)
    problems = extras()
    document["messages"] += problems
    write_json(document, folder / SUMMARY_FILE)
    return problems

"""Numbers of a run: the summary, and the files that have them; without what draws."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from .bearing.results import BearingResults
from .bearing.summary import bearing_summary
from .bearing.write import write_bearing_netcdf, write_contacts_csv
from .contact.summary import ContactResults, contact_summary
from .contact.write import write_contact_netcdf
from .files import CONTACTS_FILE, SUMMARY_FILE, write_json
from .netcdf_write import FIELDS_FILE

RunResults = BearingResults | ContactResults


def summary(results: RunResults) -> dict[str, Any]:
    """Results as one JSON document in named units, the keys as published.

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.

    Returns
    -------
    dict
        Plain JSON types; lengths [um] or [mm], pressures [GPa], angles [deg] as the keys say. What
        does not apply is None with the reason under "messages"; no value is NaN or infinite.

    Examples
    --------
    >>> import oilfilm
    >>> results = oilfilm.run_contact(oilfilm.load_case("moes_20_10"))
    >>> document = oilfilm.summary(results)
    >>> document["converged"], round(document["moes_M"], 1)
    (True, 20.0)
    """
    if isinstance(results, ContactResults):
        return contact_summary(results)
    return bearing_summary(results)


def write_numbers(
    results: RunResults, folder: Path, extras: Callable[[], tuple[str, ...]]
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

"""All output of a run into one directory."""

from dataclasses import replace
from pathlib import Path

from .bearing.summary import summary
from .bearing.write import write_contacts_csv, write_netcdf
from .files import CONTACTS_FILE, FIELDS_FILE, SUMMARY_FILE, attempt, write_json
from .plots import write_plots
from .results import BearingResults, ContactResults
from .scene.vtk import write_collection, write_subsurface


def write_results(
    results: BearingResults | ContactResults, directory: str | Path
) -> tuple[str, ...]:
    """Write pictures, VTK, netCDF, CSV and, last, the summary; a picture that fails is a message,
    not an error.

    Parameters
    ----------
    results : BearingResults or ContactResults
    directory : str or Path
        Made if it is missing; files of the same names are replaced.

    Returns
    -------
    tuple of str
        What could not be drawn and why; `summary.json` holds these messages too.

    Raises
    ------
    OSError
        If the numbers themselves cannot be written: disk full, no permission.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    problems = (
        *attempt("plots", lambda: write_plots(results, folder)),
        *attempt("VTK", lambda: _write_vtk(results, folder)),
    )
    document = summary(replace(results, messages=(*results.messages, *problems)))
    write_netcdf(results, folder / FIELDS_FILE, document)
    if isinstance(results, BearingResults):
        write_contacts_csv(document, folder / CONTACTS_FILE)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def _write_vtk(results: BearingResults | ContactResults, folder: Path) -> None:
    write_collection(results, folder)
    if isinstance(results, BearingResults):
        write_subsurface(results, folder)

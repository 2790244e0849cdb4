"""All output of a run into one directory."""

from pathlib import Path

from .bearing.plots import write_bearing_plots
from .bearing.results import BearingResults
from .bearing.write import write_bearing_netcdf, write_contacts_csv
from .contact.plots import write_contact_plots
from .contact.results import ContactResults
from .contact.write import write_contact_netcdf
from .files import CONTACTS_FILE, SUMMARY_FILE, attempt, write_json
from .netcdf.groups import FIELDS_FILE
from .scene.vtk import write_collection, write_subsurface
from .summaries import summary


def write_results(
    results: BearingResults | ContactResults, directory: str | Path
) -> tuple[str, ...]:
    """Write pictures, VTK, netCDF, CSV, last the summary; files of the same names are replaced.

    Returns what could not be drawn and why, which `summary.json` says too. OSError if the numbers
    themselves cannot be written: disk full, no permission.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    problems = attempt("plots", lambda: _write_plots(results, folder))
    problems += attempt("VTK", lambda: _write_vtk(results, folder))
    document = summary(results)
    document["messages"] += problems
    if isinstance(results, ContactResults):
        write_contact_netcdf(results, folder / FIELDS_FILE, document)
    else:
        write_bearing_netcdf(results, folder / FIELDS_FILE, document)
        write_contacts_csv(document, folder / CONTACTS_FILE)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def _write_plots(results: BearingResults | ContactResults, folder: Path) -> tuple[str, ...]:
    if isinstance(results, ContactResults):
        return write_contact_plots(results, folder)
    return write_bearing_plots(results, folder)


def _write_vtk(results: BearingResults | ContactResults, folder: Path) -> None:
    write_collection(results, folder)
    if isinstance(results, BearingResults):
        write_subsurface(results, folder)

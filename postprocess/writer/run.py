"""All files of a run, written by one process.

Files for ParaView and pictures of a run, in parts that several processes can make.

The summary of a run, of a bearing or of a single contact.

Numbers of a run: netCDF and CSV, and last the summary, which says what could not be drawn.
"""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from ..bearing.plots import write_bearing_plots
from ..bearing.results import BearingResults
from ..bearing.summary import bearing_summary
from ..bearing.write import write_bearing_netcdf, write_contacts_csv
from ..contact.plots import write_contact_plots
from ..contact.summary import ContactResults, contact_summary
from ..contact.write import write_contact_netcdf
from ..files import CONTACTS_FILE, SUMMARY_FILE, attempt, write_json
from ..netcdf_write import FIELDS_FILE
from ..quantities import PARAVIEW
from ..scene.vtk import write_collection, write_ring_deformed, write_ring_stress, write_subsurface


def write_extras(
    results: BearingResults | ContactResults, folder: Path, part: tuple[str, int] | None = None
) -> tuple[str, ...]:
    """Write files for ParaView and the pictures; or one part of them, by its kind and number from
    0.

    Returns what could not be written, and why.

    Parameters
    ----------
    results : BearingResults | ContactResults
        Results of a bearing or of a single contact.
    folder : Path
        Folder to write into.
    part : tuple[str, int] | None, optional
        Kind of the part and its number from 0; all if None.

    Returns
    -------
    tuple[str, ...]
        What could not be written, and why.
    """
    problems: tuple[str, ...] = ()
    if part is None or part[0] == PARAVIEW:
        problems = attempt("VTK", lambda: _write_vtk(results, folder))
    if part is None or part[0] != PARAVIEW:
        problems += attempt("plots", lambda: _write_plots(results, folder, part))
    return problems


def _write_plots(
    results: BearingResults | ContactResults, folder: Path, picture: tuple[str, int] | None
) -> tuple[str, ...]:
    if isinstance(results, BearingResults):
        return write_bearing_plots(results, folder, picture)
    return write_contact_plots(results, folder)


def _write_vtk(results: BearingResults | ContactResults, folder: Path) -> None:
    write_collection(results, folder)
    if isinstance(results, BearingResults):
        write_subsurface(results, folder)
        write_ring_stress(results, folder)
        write_ring_deformed(results, folder)


def summary(results: BearingResults | ContactResults) -> dict[str, Any]:
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

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> import oilfilm
    >>> results = oilfilm.run_contact(oilfilm.load_case("moes_20_10"))
    >>> with TemporaryDirectory() as folder:
    ...     messages = oilfilm.write_results(results, folder)
    ...     print((Path(folder) / "summary.json").is_file())
    True
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    return write_numbers(results, folder, partial(write_extras, results, folder))

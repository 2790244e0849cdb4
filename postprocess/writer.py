"""All files of a run in one folder; files for ParaView and pictures in parts for processes."""

from functools import partial
from pathlib import Path

from .bearing.plots import write_bearing_plots
from .bearing.results import BearingResults
from .contact.plots import write_contact_plots
from .files import attempt
from .quantities import PARAVIEW
from .run_numbers import RunResults, write_numbers
from .scene.vtk import write_collection, write_ring_deformed, write_ring_stress, write_subsurface


def write_extras(
    results: RunResults, folder: Path, part: tuple[str, int] | None = None
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
    results: RunResults, folder: Path, picture: tuple[str, int] | None
) -> tuple[str, ...]:
    if isinstance(results, BearingResults):
        return write_bearing_plots(results, folder, picture)
    return write_contact_plots(results, folder)


def _write_vtk(results: RunResults, folder: Path) -> None:
    write_collection(results, folder)
    if isinstance(results, BearingResults):
        write_subsurface(results, folder)
        write_ring_stress(results, folder)
        write_ring_deformed(results, folder)


def write_results(results: RunResults, directory: str | Path) -> tuple[str, ...]:
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

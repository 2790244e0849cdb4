"""Files for ParaView and pictures of a run, in parts that several processes can make."""

from pathlib import Path

from ..bearing.plots import write_bearing_plots
from ..bearing.results import BearingResults
from ..contact.plots import write_contact_plots
from ..contact.results import ContactResults
from ..files import attempt
from ..results import PARAVIEW
from ..scene.ring_deformed import write_ring_deformed
from ..scene.ring_stress import write_ring_stress
from ..scene.vtk import write_collection, write_subsurface


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

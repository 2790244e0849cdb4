"""Films of results as meshes for other programs."""

from pathlib import Path

from oilfilm.ehl import ContactConditions
from oilfilm.ehl.conditions import Coating
from oilfilm.ehl.foreign_files import parse_json
from oilfilm.postprocess.open_results import open_results
from oilfilm.postprocess.scene.export import export_results

from ..format.case import ContactCase, case_of_document
from ..format.rules import CaseError


def export_meshes(directory: Path, file: Path) -> tuple[Path, ...]:
    """Write films as a mesh, and the elements of a coating beside it.

    Parameters
    ----------
    directory : Path
        Folder of the results.
    file : Path
        File of the mesh.

    Returns
    -------
    tuple[Path, ...]
        The files written.
    """
    return export_results(directory, file, _coating(directory))


def _coating(directory: Path) -> Coating | None:
    """The coating of a single contact, from the case that its results hold."""
    with open_results(directory) as tree:
        document = parse_json(tree.attrs["case"], str(directory))
    try:
        case = case_of_document(document) if "contact" in document else None
    except CaseError:  # a case of an earlier version
        return None
    if isinstance(case, ContactCase) and isinstance(case.conditions, ContactConditions):
        return case.conditions.coating
    return None

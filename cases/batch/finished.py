"""A batch of which nothing is left to compute: its summary as it stands on disk.

Names of points are hashes of all that their results depend on. No solver is loaded, no case is
checked.
"""

from pathlib import Path
from time import perf_counter
from typing import Any

from oilfilm.ehl.foreign_files import read_json
from oilfilm.postprocess.files import read_summary

from ..format.document import read_text
from ..format.shipped import find_sweep
from ..runs.output_directory import DIGESTS, damaged_files
from .expansion import (
    Expansion,
    Source,
    assumed_keys,
    expanded,
    may_share_tables,
    point_documents,
    sweep_title,
    varied_keys,
)
from .keys import DATA, FOLDERS, PARQUET, STORES, SUMMARY, TABLE
from .plan import PointName


def finished_summary(
    name_or_path: str | Path, directory: Path, *, parquet: bool
) -> dict[str, Any] | None:
    """Summary of a batch whose points are all finished and whose files are as they were written.

    Parameters
    ----------
    name_or_path : str | Path
        The sweep file or its name.
    directory : Path
        Folder of the batch.
    parquet : bool
        True: the table is wanted as Parquet, too.

    Returns
    -------
    dict[str, Any] | None
        The summary, with all points as taken over; None where something is to be computed or
        written.

    Raises
    ------
    CaseError
        If the file is no sweep, or its case cannot be found.
    """
    start = perf_counter()
    wanted = {TABLE, DATA, SUMMARY}
    if parquet:
        wanted.add(PARQUET)
    path = find_sweep(name_or_path)
    text = read_text(path)
    try:
        found = read_summary(directory)
        written = read_json(directory / DIGESTS).keys() >= wanted
        points = found["points"] or ()
        before = [point["key"] for point in points if point["status"] == "done"]
        if not written or found["sweep"] != text or _is_changed(directory):
            return None
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return None
    sweep = expanded(Source(text, str(path), path.parent))
    keys = varied_keys(sweep.blocks)
    if may_share_tables(sweep.file, sweep.base, keys) or sweep.file.sensitivity is not None:
        return None  # names of points follow from checked cases
    title = sweep_title(sweep.file, sweep.base, keys)
    assumed = list(assumed_keys(sweep.base))
    if (title, assumed, _names(sweep)) != (found["title"], found["assumed"], before):
        return None
    resumed = [point | {"resumed": True} for point in points]
    timing = {"total": perf_counter() - start}
    return found | {"points": resumed, "resumed": len(resumed), "timing_s": timing}


def _is_changed(directory: Path) -> bool:
    """Tell whether a file of the batch is not as it was written, or younger than the summary."""
    written = (directory / SUMMARY).stat().st_mtime_ns
    own = [directory / name for name in FOLDERS if (directory / name).exists()]
    own += [file for folder in own for file in folder.iterdir()]
    stores = [*directory.glob(STORES)]
    young = any(file.stat().st_mtime_ns > written for file in (*own, *stores))
    return young or not stores or bool(damaged_files(directory))


def _names(sweep: Expansion) -> list[str]:
    """Names of all points, in their order."""
    name = PointName(sweep.file, sweep.base).name_of
    made = point_documents(sweep.file, sweep.base)
    return [name(made(variation)) for block in sweep.blocks for variation in block]

"""Folders of results that a command reads: there, and as they were written."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from bearing.files import is_disk_failure

from ..format.problems import CaseError
from ..runs.integrity import damaged_files
from ..runs.interrupt import print_message

ANEW = "compute the results again"


@contextmanager
def reading(*directories: Path) -> Iterator[None]:
    """Read folders of results inside; damaged files are reported.

    Parameters
    ----------
    *directories : Path
        The folders.

    Raises
    ------
    CaseError
        If a folder does not exist, or its content is damaged or wrong.
    """
    for directory in directories:
        if not directory.is_dir():
            raise CaseError(f"{directory}: no such directory; allowed: a directory of results")
    damaged = [path for directory in directories for path in damaged_files(directory)]
    try:
        yield
    except CaseError:
        raise
    except Exception as error:
        if is_disk_failure(error):
            raise
        if damaged:
            raise CaseError(f"{damaged[0]}: damaged, not as it was written; {ANEW}") from error
        if isinstance(error, ValueError):
            raise CaseError(str(error)) from error
        raise
    for path in damaged:
        print_message(f"oilfilm: {path}: changed since it was written; {ANEW}")

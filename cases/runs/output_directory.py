"""The folder of a result: complete or not there; files of others are never replaced."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from bearing.files import umask

from ..format.problems import CaseError
from .integrity import DIGESTS, write_digests
from .output_lock import TEMPORARY, home

# what we wrote, so that a later run replaces that and nothing else
MANIFEST = ".oilfilm-files.json"
# removed first and put in place last: where it stands, the result is complete
LAST = "summary.json"


def check_output(directory: Path) -> None:
    """Check that results can be written.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Raises
    ------
    CaseError
        If they cannot.
    """
    if directory.exists() and not directory.is_dir():
        allowed = "allowed with -o: a new directory, or one of results"
        raise CaseError(f"{directory}: is not a directory; {allowed}")
    try:
        directory.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=home(directory)):
            pass
        if directory.exists():
            with tempfile.TemporaryFile(dir=directory):
                pass
    except OSError as error:
        raise CaseError(f"{directory}: cannot be written: {error.strerror or error}") from None


def check_replaceable(directory: Path) -> None:
    """Check that a new result may replace the content of a folder.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Raises
    ------
    CaseError
        If a file of somebody else is in the way.
    """
    ours = _earlier_files(directory)
    _check_foreign(directory, [LAST, MANIFEST, DIGESTS, *ours], [*ours, MANIFEST, DIGESTS])


def check_file(file: Path) -> None:
    """Check that a file can be written.

    Parameters
    ----------
    file : Path
        The file.

    Raises
    ------
    CaseError
        If it cannot.
    """
    if file.is_dir():
        raise CaseError(f"{file}: is a directory; allowed: a file")
    try:
        file.absolute().parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=file.absolute().parent):
            pass
    except OSError as error:
        raise CaseError(f"{file}: cannot be written: {error.strerror or error}") from None


def save(write: Callable[[Path], tuple[str, ...]], directory: Path) -> tuple[str, ...]:
    """Fill a temporary folder, and move it to its name when it is complete.

    Files of an earlier result are replaced, all others stay.

    Parameters
    ----------
    write : Callable[[Path], tuple[str, ...]]
        Writes all files into a folder, and returns problems.
    directory : Path
        Folder of the results.

    Returns
    -------
    tuple[str, ...]
        Problems.

    Raises
    ------
    CaseError
        If a file of somebody else has the name of a new file.
    """
    directory = directory.absolute()
    directory.parent.mkdir(parents=True, exist_ok=True)
    temporary = Path(
        tempfile.mkdtemp(TEMPORARY, prefix=f".{directory.name}-", dir=home(directory))
    )
    try:
        problems = write(temporary)
        write_digests(temporary, _files(temporary))
        files = _files(temporary)
        _write_manifest(temporary, files)
        if directory.exists():
            _replace(temporary, directory, files)
        else:
            temporary.chmod(0o777 & ~umask())
            temporary.rename(directory)
        return problems
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


def _files(folder: Path) -> list[str]:
    """Names of all files of a folder and those below it."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return sorted(str(path.relative_to(folder)) for path in files)


def _replace(temporary: Path, directory: Path, files: list[str]) -> None:
    """Move the new files in; remove files of an earlier result that have no successor."""
    earlier = [*_earlier_files(directory), DIGESTS]
    _check_foreign(directory, [*files, LAST, MANIFEST], [*earlier, LAST, MANIFEST])
    (directory / LAST).unlink(missing_ok=True)
    for name in sorted(set(earlier) - set(files)):
        if not (directory / name).is_dir():
            (directory / name).unlink(missing_ok=True)
            _remove_empty(directory / name, directory)
    for name in [*sorted(files, key=lambda name: name == LAST), MANIFEST]:
        (directory / name).parent.mkdir(parents=True, exist_ok=True)
        os.replace(temporary / name, directory / name)


def _check_foreign(directory: Path, names: list[str], ours: list[str]) -> None:
    """`CaseError` where a file that is not `ours` stands in the place of one of the names, or a
    folder does, or a file in that of its folder.
    """
    known = set(ours)
    for name in names:
        file = directory / name
        folder = file.parent
        way = [file] if file.is_dir() or (name not in known and file.exists()) else []
        way += [folder] if folder.exists() and not folder.is_dir() else []
        if way:
            refused = "not written by oilfilm, will not be replaced; choose another -o"
            raise CaseError(f"{way[0]}: {refused}")


def add_to_manifest(directory: Path, name: str) -> None:
    """Record a file derived from results, so that a later run removes it with them.

    Parameters
    ----------
    directory : Path
        Folder of the results.
    name : str
        Name of the file in it.
    """
    earlier = _earlier_files(directory)
    if earlier and name not in earlier:
        _write_manifest(directory, [*earlier, name])


def _write_manifest(directory: Path, names: list[str]) -> None:
    (directory / MANIFEST).write_text(json.dumps(sorted(names), indent=1), encoding="utf-8")


def _earlier_files(directory: Path) -> list[str]:
    try:
        names = json.loads((directory / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return []
    root = directory.resolve()
    texts = [name for name in names if isinstance(name, str)] if isinstance(names, list) else []
    return [name for name in texts if root in (directory / name).resolve().parents]


def _remove_empty(file: Path, directory: Path) -> None:
    for folder in file.parents:
        if folder == directory or not folder.is_dir() or any(folder.iterdir()):
            return
        folder.rmdir()

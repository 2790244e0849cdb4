"""The folder of a result: complete or not there; files of others are never replaced.

A digest of each file stands beside it. A writer holds the lock of `.NAME.lock` beside the folder,
which the system takes from a process that ends, however it ends. Other temporary folders of the
name then belong to nobody.
"""

import atexit
import json
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from hashlib import sha256
from pathlib import Path
from time import time

from oilfilm.bearing.files import PARTIAL, umask, write_bytes
from oilfilm.ehl.foreign_files import DamagedFileError, open_file, read_json

from ..format.rules import CaseError

DIGESTS = ".oilfilm-digests.json"
PIECE = 2**20  # read at a time [bytes]


SCRATCH = "oilfilm-scratch-"
YOUNG = 60.0  # age up to which a folder may be between its making and its locking [s]
UNFINISHED = re.compile(rf"\..*-[a-z0-9_]{{8}}{re.escape(PARTIAL)}(\.\w+)?")
TEMPORARY = ".partial"  # end of the name of a folder that is being written
# lists the files written, so that a later run replaces that and nothing else
MANIFEST = ".oilfilm-files.json"
# removed first and put in place last: where it stands, the result is complete
LAST = "summary.json"


def write_digests(folder: Path, names: Iterable[str]) -> None:
    """Record the digests of files.

    Parameters
    ----------
    folder : Path
        Folder of the results.
    names : Iterable[str]
        Names of the files in it.
    """
    digests = {name: file_digest(folder / name) for name in sorted(names)}
    write_bytes(folder / DIGESTS, json.dumps(digests, indent=1).encode())


def file_digest(path: Path) -> str:
    """Hash of the content of a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        Hexadecimal digits.
    """
    known = sha256()
    with open_file(path) as file:
        while piece := file.read(PIECE):
            known.update(piece)
    return known.hexdigest()


def damaged_files(folder: Path) -> list[Path]:
    """Files that have changed since they were written, or are missing.

    Parameters
    ----------
    folder : Path
        Folder of the results.

    Returns
    -------
    list[Path]
        The files; none where there are no digests.
    """
    try:
        digests = read_json(folder / DIGESTS)
        recorded = [(folder / name, digests[name]) for name in _inside(folder, digests)]
    except (OSError, ValueError, TypeError):
        return []
    return [path for path, digest in recorded if not _is_as_written(path, digest)]


def _is_as_written(path: Path, digest: object) -> bool:
    try:
        return file_digest(path) == digest
    except (OSError, DamagedFileError):
        return False


if sys.platform != "win32":
    import fcntl


@contextmanager
def one_writer(target: Path, *, shared: bool = False) -> Iterator[None]:
    """Lock a folder or a file against other programs.

    Parameters
    ----------
    target : Path
        The folder or file.
    shared : bool, default False
        True: only against programs that want it for themselves.

    Raises
    ------
    CaseError
        If another program writes it already.
    """
    target = target.absolute()
    lock = home(target) / f".{target.name}.lock"
    handle = _locked(lock, target, shared=shared)
    if handle is None:  # no locks on this file system
        yield
        return
    # others may hold the file, too, whom the next one would not find without it
    release = partial(os.close, handle) if shared else partial(_release, lock, handle)
    atexit.register(release)  # also where the program ends in the middle of the work
    try:
        if not shared:
            remove_leftovers(target)
        yield
    finally:
        atexit.unregister(release)
        release()


def _release(lock: Path, handle: int) -> None:
    """Remove the lock file while it is held, so that it is nobody else's, and let it go."""
    with suppress(OSError):
        lock.unlink()
    os.close(handle)


def home(target: Path) -> Path:
    """Folder for temporary files of a target: beside it, or in it where that cannot be written.

    Parameters
    ----------
    target : Path
        The folder or file.

    Returns
    -------
    Path
        The folder.
    """
    target = target.absolute()
    inside = target.is_dir() and not os.access(target.parent, os.W_OK)
    return target if inside else target.parent


def remove_leftovers(target: Path) -> None:
    """Remove temporary folders and files of writers that were killed.

    Parameters
    ----------
    target : Path
        The folder or file.
    """
    target = target.absolute()
    for folder in home(target).glob(f".{target.name}-*{TEMPORARY}"):
        shutil.rmtree(folder, ignore_errors=True)
    if target.is_dir():
        parts = target.rglob(f".*{PARTIAL}*")
    else:
        parts = target.parent.glob(f".{target.stem}-*{PARTIAL}*")
    for file in parts:
        if UNFINISHED.fullmatch(file.name):
            file.unlink(missing_ok=True)


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """A folder in the temporary one of the system; those of killed programs are removed first.

    Each is locked as long as its program lives.
    """
    base = Path(tempfile.gettempdir())
    for left in base.glob(f"{SCRATCH}*"):
        with suppress(OSError):
            if time() - left.stat().st_mtime > YOUNG:
                _remove_unlocked(left)
    with tempfile.TemporaryDirectory(prefix=SCRATCH) as folder:
        if sys.platform == "win32":
            yield Path(folder)
            return
        handle = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
        try:
            with suppress(OSError):
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            yield Path(folder)
        finally:
            os.close(handle)


def _remove_unlocked(folder: Path) -> None:
    """Remove a folder whose program has ended; OSError if it has not."""
    if sys.platform == "win32":
        return
    handle = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        shutil.rmtree(folder, ignore_errors=True)
    finally:
        os.close(handle)


def _locked(lock: Path, target: Path, *, shared: bool) -> int | None:
    """Handle of the lock file, whose lock is held; None where there are no locks."""
    if sys.platform == "win32":
        return None
    while True:
        try:
            handle = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        except OSError as error:
            reason = error.strerror or error
            raise CaseError(f"{target}: cannot be written: {reason}") from None
        try:
            kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
            fcntl.flock(handle, kind | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(handle)
            used = "another oilfilm is writing there; wait for its end, or choose another -o"
            raise CaseError(f"{target}: {used}") from None
        except OSError:  # of network drives
            os.close(handle)
            return None
        with suppress(OSError):
            if os.path.samestat(os.fstat(handle), lock.stat()):
                return handle
        os.close(handle)  # of a writer that has just ended and removed it


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
        away = folder != directory and not _inside(directory, [os.path.dirname(name)])  # by a link
        way += [folder] if away or (folder.exists() and not folder.is_dir()) else []
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
        return _inside(directory, read_json(directory / MANIFEST))
    except (OSError, ValueError):
        return []


def _inside(directory: Path, names: object) -> list[str]:
    """The names of a list, or the keys of a table, that are those of files in a folder."""
    root = directory.resolve()
    given = names if isinstance(names, list | dict) else ()
    texts = [name for name in given if isinstance(name, str)]
    return [name for name in texts if root in (directory / name).resolve().parents]


def _remove_empty(file: Path, directory: Path) -> None:
    for folder in file.parents:
        if folder == directory or not folder.is_dir() or any(folder.iterdir()):
            return
        folder.rmdir()

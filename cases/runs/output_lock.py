"""One writer at a time in a folder of results, and an end to what killed ones have left.

A writer holds the lock of `.NAME.lock` beside the folder, which the system takes from a process
that ends, however it ends. What else is there of the name's temporary folders is then nobody's.
"""

import atexit
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from time import time

from bearing.files import PARTIAL

from ..format.problems import CaseError

if sys.platform != "win32":
    import fcntl

SCRATCH = "oilfilm-scratch-"
YOUNG = 60.0  # age up to which a folder may be between its making and its locking [s]
UNFINISHED = re.compile(rf"\..*-[a-z0-9_]{{8}}{re.escape(PARTIAL)}(\.\w+)?")
TEMPORARY = ".partial"  # end of the name of a folder that is being written


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

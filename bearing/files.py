"""Files that appear complete or not at all."""

import atexit
import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

# errors of a disk that is full, beyond the user's quota, broken or read-only
DISK_ERRORS = frozenset(
    getattr(errno, name)
    for name in ("ENOSPC", "EDQUOT", "EFBIG", "EIO", "EROFS")
    if hasattr(errno, name)
)
PROBE = 2**20  # of what is written at a time to see whether there is room [bytes]
PARTIAL = ".part"  # end of the name of a file that is not complete, before its suffix


def is_disk_failure(error: BaseException) -> bool:
    """Check whether an error means that the disk takes nothing more, so that further work is in
    vain.

    Parameters
    ----------
    error : BaseException
        error of a write

    Returns
    -------
    bool
        true for errors of a full, broken or read-only disk
    """
    return isinstance(error, OSError) and error.errno in DISK_ERRORS


@contextmanager
def atomic_path(path: Path, *, with_suffix: bool = True) -> Iterator[Path]:
    """Temporary name next to `path`, which becomes `path` on success and vanishes on failure.

    It also vanishes if the program ends during the write. Missing folders are created.

    Parameters
    ----------
    path : Path
        name of the complete file
    with_suffix : bool, default True
        keep the suffix of `path`, for writers that choose the format by it; a search for files of
        that suffix then also lists the temporary one

    Yields
    ------
    Iterator[Path]
        temporary name to write to
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    ending = f"{PARTIAL}{path.suffix}" if with_suffix else PARTIAL
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem}-", suffix=ending)
    os.close(handle)
    temporary = Path(name)
    atexit.register(temporary.unlink, missing_ok=True)
    try:
        yield temporary
        os.chmod(temporary, 0o666 & ~umask())  # mkstemp gives 0600
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
        atexit.unregister(temporary.unlink)


def write_bytes(path: Path, data: bytes, *, durable: bool = False) -> None:
    """Write a file, which appears when it is complete.

    Parameters
    ----------
    path : Path
        name of the file
    data : bytes
        its content
    durable : bool, default False
        flush to the disk, so that the file survives a power cut
    """
    with atomic_path(path, with_suffix=False) as temporary, temporary.open("wb") as file:
        file.write(data)
        file.flush()
        if durable:
            os.fsync(file.fileno())


def require_room(folder: Path, size: int) -> None:
    """Check that a file of a given size fits into a folder.

    For libraries that a full disk ends together with the program.

    Parameters
    ----------
    folder : Path
        folder of the file
    size : int
        size of the file [bytes]

    Raises
    ------
    OSError
        if the file does not fit
    """
    block = os.urandom(PROBE)  # nothing that a disk could keep in less room
    with tempfile.TemporaryFile(dir=folder) as file:
        for start in range(0, size, PROBE):
            file.write(block[: size - start])
        file.flush()


def umask() -> int:
    """Permissions that new files of this user do not get."""
    mask = os.umask(0)
    os.umask(mask)
    return mask

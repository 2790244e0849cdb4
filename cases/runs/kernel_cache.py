"""Folders for compiled kernels when installation and home cannot be written."""

import hashlib
import os
import platform
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from oilfilm.ehl.kernel_sources import kernel_digest
from oilfilm.ehl.version import version

from .processes import THREADS, own_packages

VARIABLE = "NUMBA_CACHE_DIR"
KINDS = ("bearing", "motion")  # of work that `warm_up` compiles kernels for


def ensure_kernel_cache() -> None:
    """Give numba a folder of this user's own for compiled kernels if it would find none; call
    before numba is imported.

    Without one, importing the kernels fails ("no locator available", numba issues 4908 and 5566).
    A folder that the user has set is left alone. matplotlib gets one, too, without which it
    complains.
    """
    chosen = os.environ.get("MPLCONFIGDIR")
    if chosen and not _writable(_existing(Path(chosen))):
        del os.environ["MPLCONFIGDIR"]  # matplotlib would leave a folder behind in every process
        chosen = None
    if _in_the_home_directory():
        return
    if not chosen:
        os.environ["MPLCONFIGDIR"] = str(_private_folder())
    if not _beside_the_package():
        os.environ.setdefault(VARIABLE, str(_private_folder()))


def compiled_stamp(kind: str) -> Path | None:
    """File that exists where the kernels for a kind of work are compiled.

    Its name holds a digest of the kernels' sources and of their compiler; it lies where numba
    writes its own files or, failing that, in the user's cache.

    Parameters
    ----------
    kind : str
        Kind of work.

    Returns
    -------
    Path | None
        The file; None if there is no folder for it.
    """
    package = _package()
    if package is None:
        return None
    try:
        folder = package / "__pycache__" if _beside_the_package() else _user_cache() / "oilfilm"
    except RuntimeError:  # no home directory
        return None
    folder = Path(os.environ.get(VARIABLE) or folder)
    numba = metadata.version("numba")
    whole = repr([kind, kernel_digest(), version(), sys.version, numba, platform.machine()])
    return folder / f".oilfilm-compiled-{hashlib.sha256(whole.encode()).hexdigest()[:16]}"


@contextmanager
def compiled_ahead(kind: str) -> Iterator[None]:
    """Compile the kernels for a kind of work in a process of its own, beside what is done inside.

    The process ends with what is done inside, finished or not. None is started where the kernels
    are compiled already, or where this process has but one core.

    Parameters
    ----------
    kind : str
        Kind of work, a key of `warm_up.KINDS`.
    """
    stamp = compiled_stamp(f"ahead {kind}")
    if stamp is None or stamp.exists() or (os.cpu_count() or 1) < 2:
        yield
        return
    process = _warm_up(kind)
    try:
        yield
    finally:
        process.terminate()
        process.wait()


def compile_all() -> None:
    """Compile the kernels for all kinds of work, side by side, and wait for them."""
    stamps = {kind: compiled_stamp(f"ahead {kind}") for kind in KINDS}
    missing = [kind for kind, stamp in stamps.items() if stamp is None or not stamp.exists()]
    for process in [_warm_up(kind) for kind in missing]:
        process.wait()


def _warm_up(kind: str) -> "subprocess.Popen[bytes]":
    """A process that compiles the kernels for a kind of work and prints nothing."""
    nothing = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-P", "-m", f"{__package__}.warm_up", kind],
        stdin=nothing,
        stdout=nothing,
        stderr=nothing,
        env=os.environ | own_packages() | dict.fromkeys(THREADS, "1"),
    )


def _package() -> Path | None:
    spec = find_spec("oilfilm.ehl")
    return None if spec is None or not spec.origin else Path(spec.origin).parent


def _beside_the_package() -> bool:
    folder = _package()
    if folder is None:
        return False
    cache = folder / "__pycache__"
    return _writable(cache if cache.exists() else folder)


def _in_the_home_directory() -> bool:
    try:
        folder = _user_cache()
    except RuntimeError:  # no home directory
        return False
    return _writable(_existing(folder))


def _existing(folder: Path) -> Path:
    """The folder, or the nearest above it that exists."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    return folder


def _user_cache() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


def _writable(folder: Path) -> bool:
    """Tell whether a file can be made; permission bits may mislead (read-only systems, root)."""
    try:
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _private_folder() -> Path:
    """A folder under the temporary one that nobody else can write: the cache is code."""
    user = os.getuid() if hasattr(os, "getuid") else "user"
    folder = Path(tempfile.gettempdir()) / f"oilfilm-kernels-{user}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        status = folder.lstat()
        mine = not hasattr(os, "getuid") or status.st_uid == os.getuid()
        if mine and stat.S_ISDIR(status.st_mode) and not status.st_mode & 0o022:
            return folder
    except OSError:
        pass
    return Path(tempfile.mkdtemp(prefix="oilfilm-kernels-"))

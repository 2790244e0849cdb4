"""How kernels are compiled, and when what is compiled counts as out of date."""

from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit

from .kernel_sources import kernel_digest


def compiled(function: Callable[..., Any]) -> Any:
    """A kernel: compiled for the types of its first call, run without Python's lock, division as
    in NumPy.

    numba keeps the machine code in a folder and asks only whether the file of the kernel itself
    has changed. But the code of kernels of other files that it calls is in there, too. Hence a
    change of any of `kernel_sources` makes all of that folder's kernels be compiled anew.
    """
    kernel = njit(cache=True, nogil=True, fastmath=False, error_model="numpy")(function)
    # not so where numba is told to compile nothing (NUMBA_DISABLE_JIT)
    if hasattr(kernel, "stats"):
        forget_old_kernels(Path(kernel.stats.cache_path), kernel_digest())
    return kernel


@cache
def forget_old_kernels(folder: Path, digest: str) -> None:
    """Drop the indices of compiled kernels that do not come from the sources of a digest."""
    stamp = folder / f".kernels-{digest}"
    if stamp.exists():
        return
    with suppress(OSError):  # a folder that cannot be written is numba's to complain about
        for old in [*folder.glob("*_kernels.*.nbi"), *folder.glob(".kernels-*")]:
            old.unlink(missing_ok=True)
        folder.mkdir(parents=True, exist_ok=True)
        stamp.touch()

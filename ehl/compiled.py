"""Decorators that compile kernels, and the log and the cache of compiled kernels."""

import logging
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit
from numba.core import event

from .kernel_sources import kernel_digest


def compiled(function: Callable[..., Any]) -> Any:
    """A kernel: compiled for the types of its first call, run without Python's lock, division as
    in NumPy.

    numba keeps the machine code in a folder and compares only the file of the kernel itself. But
    the code of kernels of other files that it calls is in there, too. Hence a change of any of
    `kernel_sources` makes all of that folder's kernels be compiled anew.

    Parameters
    ----------
    function : Callable[..., Any]
        function to compile

    Returns
    -------
    Any
        kernel
    """
    return _kernel(function, fastmath=False)


def summing(function: Callable[..., Any]) -> Any:
    """A kernel as `compiled` whose sums over nodes are computed as several sums side by side,
    which takes a quarter of the time; results differ in rounding, and by the machine.

    Parameters
    ----------
    function : Callable[..., Any]
        function to compile

    Returns
    -------
    Any
        kernel
    """
    return _kernel(function, fastmath={"reassoc", "nsz"})


def fused(function: Callable[..., Any]) -> Any:
    """A kernel as `compiled` whose products are added without a rounding between where the machine
    can, which takes half of the time; results differ in rounding, and by the machine.

    Parameters
    ----------
    function : Callable[..., Any]
        function to compile

    Returns
    -------
    Any
        kernel
    """
    return _kernel(function, fastmath={"contract"})


def inlined(function: Callable[..., Any]) -> Any:
    """A kernel that is part of each kernel that calls it, in place of one more to optimise.

    For kernels that call large ones and are called once: compiled on their own, they and every
    kernel above them would optimise all of these again.

    Parameters
    ----------
    function : Callable[..., Any]
        function to compile

    Returns
    -------
    Any
        kernel
    """
    return njit(inline="always", nogil=True, fastmath=False, error_model="numpy")(function)


def _kernel(function: Callable[..., Any], fastmath: bool | set[str]) -> Any:
    _log_compilations()
    kernel = njit(cache=True, nogil=True, fastmath=fastmath, error_model="numpy")(function)
    # a plain function where NUMBA_DISABLE_JIT is set
    if hasattr(kernel, "stats"):
        forget_old_kernels(Path(kernel.stats.cache_path), kernel_digest())
    return kernel


class _Compilations(event.Listener):
    """Logs that a kernel is compiled; those read from the disk are not."""

    def on_start(self, event: event.Event) -> None:
        """Before it is compiled."""
        logging.getLogger(__name__).info(
            "compiling kernels, once after an install or update: a minute or two"
        )

    def on_end(self, event: event.Event) -> None:
        """After it was compiled: nothing to do."""


@cache
def _log_compilations() -> None:
    """Log compilations, once for all kernels."""
    event.register("numba:compile", _Compilations())


@cache
def forget_old_kernels(folder: Path, digest: str) -> None:
    """Drop the indices of compiled kernels that do not come from the sources of a digest.

    Parameters
    ----------
    folder : Path
        folder with the machine code of kernels
    digest : str
        digest of the sources, see `kernel_digest`
    """
    stamp = folder / f".kernels-{digest}"
    if stamp.exists():
        return
    with suppress(OSError):  # numba itself reports a folder that cannot be written
        for old in [*folder.glob("*_kernels.*.nbi"), *folder.glob(".kernels-*")]:
            old.unlink(missing_ok=True)
        folder.mkdir(parents=True, exist_ok=True)
        stamp.touch()

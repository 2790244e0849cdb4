"""How kernels are compiled, and when what is compiled counts as out of date."""

import logging
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit
from numba.core import event, types

from .kernel_sources import kernel_digest


def compiled(function: Callable[..., Any]) -> Any:
    """A kernel: compiled for the types of its first call, run without Python's lock, division as
    in NumPy. It neither makes arrays nor returns any, see `allocating`.

    numba keeps the machine code in a folder and asks only whether the file of the kernel itself
    has changed. But the code of kernels of other files that it calls is in there, too. Hence a
    change of any of `kernel_sources` makes all of that folder's kernels be compiled anew.
    """
    return _kernel(function, fastmath=False)


def summing(function: Callable[..., Any]) -> Any:
    """A kernel as `compiled` whose sums over nodes are made of several sums side by side, which
    takes a quarter of the time; results differ in rounding, and by the machine.
    """
    return _kernel(function, fastmath={"reassoc", "nsz"})


def allocating(function: Callable[..., Any]) -> Any:
    """A kernel as `compiled` that makes arrays, by what computes with whole ones, too, or returns
    some, to kernels of its kind alone. numba counts who holds an array, each time that one is cut
    or handed on, in memory that all cores share: a third of the time of a column of film.
    """
    return _kernel(function, fastmath=False, counting=True)


def _kernel(
    function: Callable[..., Any], fastmath: bool | set[str], *, counting: bool = False
) -> Any:
    _log_compilations()
    # no wrapper for callers in C, which takes a fifth of the time of compilation and has none
    options = {"cache": True, "nogil": True, "no_cfunc_wrapper": True, "_nrt": counting}
    kernel = njit(fastmath=fastmath, error_model="numpy", **options)(function)
    # not so where numba is told to compile nothing (NUMBA_DISABLE_JIT)
    if hasattr(kernel, "stats"):
        forget_old_kernels(Path(kernel.stats.cache_path), kernel_digest())
    return kernel


def inlined(function: Callable[..., Any]) -> Any:
    """A kernel that is part of each kernel that calls it, in place of one more to optimise.

    For what calls large kernels and is called once: compiled on its own, it and every kernel above
    it would optimise all of these again.
    """
    return njit(inline="always", nogil=True, fastmath=False, error_model="numpy")(function)


class _Compilations(event.Listener):
    """Logs that a kernel is compiled, of which those found on disk are none."""

    def on_start(self, event: event.Event) -> None:
        """Before it is compiled."""
        logging.getLogger(__name__).info(
            "compiling kernels, once after an install or update: a minute or two"
        )

    def on_end(self, event: event.Event) -> None:
        """After it was compiled: TypeError where it returns an array that it has not counted,
        which would be freed too early, or never.
        """
        kernel, arguments = event.data["dispatcher"], event.data["args"]
        made = kernel.overloads.get(arguments)
        if kernel.targetoptions.get("_nrt", True) or made is None:
            return
        returned = made.signature.return_type
        if any(isinstance(part, types.Array) for part in getattr(returned, "types", (returned,))):
            for index in Path(kernel.stats.cache_path).glob(f"*.{kernel.__name__}-*.nbi"):
                index.unlink()  # what is kept on disk is not asked again
            raise TypeError(f"{kernel.py_func.__name__} returns an array: it is to be @allocating")


@cache
def _log_compilations() -> None:
    """Have compilations logged, once for all kernels."""
    event.register("numba:compile", _Compilations())


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

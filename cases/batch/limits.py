"""Limits of time and memory of one point, kept by its worker."""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from .points import Limits

GRACE = 30.0  # after which a point that does not answer its time limit ends with its worker [s]
GIGABYTE = 1e9  # [bytes]


@contextmanager
def limited(limits: Limits) -> Iterator[None]:
    """Limit time and memory of the work inside.

    Compiled code is not interrupted: a worker that has not returned from it `GRACE` seconds after
    its time ends as a whole, and its point is recorded as lost.

    Parameters
    ----------
    limits : Limits
        Time [s] and memory [GB] of one point; None: without limit.

    Raises
    ------
    TimeoutError
        If the work takes more time.
    MemoryError
        If the work takes more memory.
    """
    with _time_limit(limits.seconds), _memory_limit(limits.memory):
        yield


@contextmanager
def _time_limit(seconds: float | None) -> Iterator[None]:
    if seconds is None:
        yield
        return
    last = threading.Timer(seconds + GRACE, os._exit, (1,))
    last.daemon = True
    last.start()

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"the point takes longer than its {seconds:g} s")

    alarm = sys.platform != "win32" and threading.current_thread() is threading.main_thread()
    try:
        if sys.platform != "win32" and alarm:
            previous = signal.signal(signal.SIGALRM, stop)
            signal.setitimer(signal.ITIMER_REAL, seconds)
        yield
    finally:
        if sys.platform != "win32" and alarm:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, previous)
        last.cancel()


@contextmanager
def _memory_limit(gigabytes: float | None) -> Iterator[None]:
    """Limit the address space beyond its size at the start of the point; on Linux."""
    if gigabytes is None or not sys.platform.startswith("linux"):
        yield
        return
    import resource

    with open("/proc/self/statm", encoding="ascii") as file:
        taken = int(file.read().split()[0]) * resource.getpagesize()
    before = resource.getrlimit(resource.RLIMIT_AS)
    wanted = taken + int(gigabytes * GIGABYTE)
    most = wanted if before[1] == resource.RLIM_INFINITY else min(wanted, before[1])
    resource.setrlimit(resource.RLIMIT_AS, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)

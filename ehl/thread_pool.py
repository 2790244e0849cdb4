"""Threads that solve several films at a time: the kernels release the interpreter's lock."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager


@contextmanager
def film_threads(number: int) -> Iterator[ThreadPoolExecutor]:
    """So many threads; after an interrupt nothing is begun, and nobody waits for their films.

    A film under way cannot be stopped: a program that is to end at once ends by `os._exit`.
    """
    pool = ThreadPoolExecutor(max_workers=max(1, number))
    waits = True
    try:
        yield pool
    except KeyboardInterrupt:
        waits = False
        raise
    finally:
        pool.shutdown(wait=waits, cancel_futures=True)

"""Messages on standard error, and work that an interrupt lets finish."""

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


def say(text: str) -> None:
    """A message to the user."""
    print(text, file=sys.stderr)  # noqa: T201


@contextmanager
def finish_first(what: str, hurry: Callable[[], None] | None = None) -> Iterator[None]:
    """Obey an interrupt only when the work inside is done; a second one is obeyed at once.

    `hurry` is called at the first, to leave out what can be left out.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    waiting: list[int] = []

    def remember(number: int, _frame: object) -> None:
        if waiting:
            raise KeyboardInterrupt
        waiting.append(number)
        say(f"oilfilm: finishing first: {what}")
        if hurry is not None:
            hurry()

    previous = {
        number: signal.signal(number, remember) for number in (signal.SIGINT, signal.SIGTERM)
    }
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
    if waiting:
        raise KeyboardInterrupt

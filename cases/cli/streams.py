"""Standard streams that may be closed, full, or of an encoding without some characters."""

import os
import sys
from contextlib import suppress

from ..runs.interrupt import print_message

STREAMS = (0, 1, 2)


def prepare_streams() -> None:
    """Never fail on a character that an encoding does not have, nor on a stream that is closed.

    A closed one is opened on nothing: else the first file of results would take its place, and
    the messages of libraries.
    """
    for number in STREAMS:
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    sys.stdout = sys.stdout or open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def drop_output() -> None:
    """Lose what standard output has not taken, so that Python does not fail on it at its end."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def output_is_written() -> bool:
    """Tell whether standard output took everything; a message if its disk is full, none if its
    reader has ended.
    """
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        drop_output()
    except OSError as error:
        print_message(f"oilfilm: failed: standard output: {error.strerror or error}")
        drop_output()
        return False
    return True

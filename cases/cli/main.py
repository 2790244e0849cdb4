"""Entry point of `oilfilm`; importing it registers the commands in the order of the help."""

import gc
import os
import sys

from .app import app  # isort: skip
from . import compute  # noqa: F401  # isort: skip
from . import dynamics  # noqa: F401  # isort: skip
from . import batch  # noqa: F401  # isort: skip
from . import view  # noqa: F401  # isort: skip
from . import documents  # noqa: F401  # isort: skip
from . import files  # noqa: F401  # isort: skip
from . import verify  # noqa: F401  # isort: skip
from .terminal import INTERRUPTED, exit_code, prepare_streams

# new objects from which the collector looks for cycles: with Python's own 700 it takes a fifth of
# the time in which a bearing case is loaded, with this a tenth, with half and double of it as much
COLLECTED = 50_000


def main() -> None:
    """Entry point of the command; after an interrupt it does not wait for films under way."""
    prepare_streams()
    gc.set_threshold(COLLECTED)
    try:
        code: str | int | None = exit_code(app)
    except SystemExit as stop:
        code = stop.code
    if code == INTERRUPTED:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        os._exit(INTERRUPTED)
    sys.exit(code)

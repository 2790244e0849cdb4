"""Entry point of `oilfilm`; importing it registers the commands in the order of the help."""

import sys

from .app import app  # isort: skip
from . import compute  # noqa: F401  # isort: skip
from . import dynamics  # noqa: F401  # isort: skip
from . import batch  # noqa: F401  # isort: skip
from . import view  # noqa: F401  # isort: skip
from . import documents  # noqa: F401  # isort: skip
from . import files  # noqa: F401  # isort: skip
from . import verify  # noqa: F401  # isort: skip
from .terminal import exit_code, prepare_streams


def main() -> None:
    """Entry point of the command."""
    prepare_streams()
    sys.exit(exit_code(app))

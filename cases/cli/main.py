"""The command `oilfilm`."""

import sys

from .commands import app
from .terminal import exit_code, prepare_streams


def main() -> None:
    """Entry point of the command."""
    prepare_streams()
    sys.exit(exit_code(app))

"""The command `oilfilm`."""

from __future__ import annotations

import sys

from ..runs.terminal import exit_code, prepare_streams
from .commands import app


def main() -> None:
    """Entry point of the command."""
    prepare_streams()
    sys.exit(exit_code(app))

"""`python -m oilfilm.cases.cli` is the command `oilfilm`."""

import sys

from .start import main

if not sys.flags.safe_path:
    del sys.path[0]  # the folder in which it was started, whose files are no libraries
main()

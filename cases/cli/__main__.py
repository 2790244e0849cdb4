"""`python -m oilfilm.cases.cli` is the command `oilfilm`."""

from .start import main

main()

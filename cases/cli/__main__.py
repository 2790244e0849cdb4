"""`python -m cases.cli` is the command `oilfilm`."""

from .main import main

main()

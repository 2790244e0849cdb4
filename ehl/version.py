"""The version, written down in pyproject.toml only."""

from functools import cache
from importlib import metadata


@cache
def version() -> str:
    """Version of the installed program."""
    return metadata.version("oilfilm")

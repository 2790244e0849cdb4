"""The version, written down in pyproject.toml only."""

from importlib import metadata


def version() -> str:
    """Version of the installed program."""
    return metadata.version("oilfilm")

"""Bearings by name, as the keys of a case file's [bearing] table."""

from __future__ import annotations

import tomllib
from importlib import resources
from typing import Any


def list_bearings() -> tuple[str, ...]:
    """Names of the catalogue, in the order of the data file."""
    return tuple(_table())


def load_catalogue_entry(name: str) -> dict[str, Any]:
    """Keys of a case file's [bearing] table for a catalogue bearing; each name ends in its unit ([mm], [um], [deg]).

    Parameters
    ----------
    name : str
        One of `list_bearings()`; case does not matter.

    Returns
    -------
    dict
        Keys and values as in a case file, with `source` (text) and `estimated` (keys whose values are estimates).

    Raises
    ------
    ValueError
        If there is none of this name.
    """
    table = {key.lower(): (key, entry) for key, entry in _table().items()}
    if name.strip().lower() not in table:
        raise ValueError(f"bearing {name!r} is unknown; known: {', '.join(key for key, _ in table.values())}")
    key, entry = table[name.strip().lower()]
    return {"name": key, **entry}


def _table() -> dict[str, dict[str, Any]]:
    text = resources.files(__package__).joinpath("data/bearings.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)

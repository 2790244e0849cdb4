"""Names of libraries, matched without case, spaces and hyphens, and their data files."""

import tomllib
from collections.abc import Iterable
from functools import cache, lru_cache
from importlib import resources
from typing import Any

IGNORED = " -_\t"
SHORT = {"vg": "isovg"}  # beginnings of names that are left short: VG68 is ISO VG 68


@lru_cache(maxsize=4096)
def plain_name(name: str) -> str:
    """A name without case, spaces, hyphens and underscores.

    '7208-B' and '7208 b' are one, so are 'VG68' and 'ISO VG 68'.

    Parameters
    ----------
    name : str
        name as it was written

    Returns
    -------
    str
        name for comparisons
    """
    plain = "".join(letter for letter in name.casefold() if letter not in IGNORED)
    for short, full in SHORT.items():
        if plain.startswith(short):
            return full + plain.removeprefix(short)
    return plain


def matching_name(name: str, names: Iterable[str]) -> str | None:
    """Select the one of several names that a name means: itself, else the first of equal
    `plain_name`.

    Parameters
    ----------
    name : str
        name as it was written
    names : Iterable[str]
        names to select from

    Returns
    -------
    str | None
        the selected name; None if no name matches
    """
    names = tuple(names)
    if name in names:
        return name
    return {plain_name(candidate): candidate for candidate in reversed(names)}.get(
        plain_name(name)
    )


@cache
def library_data(file: str) -> dict[str, dict[str, Any]]:
    """Tables of a data file of the library by name.

    Parameters
    ----------
    file : str
        name of the file in `data`

    Returns
    -------
    dict[str, dict[str, Any]]
        the parsed file
    """
    text = resources.files(__package__).joinpath("data", file).read_text(encoding="utf-8")
    return tomllib.loads(text)

"""Greases by name: their base oil in the library, and the film with the grease over that of
its base oil, by age.
"""

from dataclasses import dataclass

from .names import library_data, matching_name

DATA = "greases.toml"
FACTOR = "film factor"  # table of the data file that is no grease


@dataclass(frozen=True, slots=True, kw_only=True)
class Grease:
    """A grease, by its base oil."""

    name: str
    oil: str  # of `list_lubricants()`
    thickener: str  # and what it is used for
    # film with the grease over the flooded one of its base oil, smallest and largest [-]
    fresh_film: tuple[float, float]  # [-]
    aged_film: tuple[float, float]  # [-]
    source: str  # of these


def list_greases() -> tuple[str, ...]:
    """Names of the shipped greases, in the order of the data file.

    Returns
    -------
    tuple[str, ...]
        names for `load_grease`

    Examples
    --------
    >>> from bearing import list_greases, load_grease
    >>> load_grease(list_greases()[0]).name == list_greases()[0]
    True
    """
    return tuple(name for name in library_data(DATA) if name != FACTOR)


def load_grease(name: str) -> Grease:
    """Shipped grease by its name.

    Parameters
    ----------
    name : str
        one of `list_greases()`; case, spaces and hyphens do not matter

    Returns
    -------
    Grease
        base oil and film factors

    Raises
    ------
    ValueError
        if no grease has this name
    """
    key = matching_name(name, list_greases())
    if key is None:
        raise ValueError(f"grease {name!r} is unknown; known: {', '.join(list_greases())}")
    entry = library_data(DATA)[key]
    factor = library_data(DATA)[FACTOR]
    fresh_low, fresh_high = factor["fresh"]
    aged_low, aged_high = factor["aged"]
    return Grease(
        name=key,
        oil=entry["oil"],
        thickener=entry["thickener"],
        fresh_film=(fresh_low, fresh_high),
        aged_film=(aged_low, aged_high),
        source=f"fresh: {factor['fresh_source']}; aged: {factor['aged_source']}",
    )

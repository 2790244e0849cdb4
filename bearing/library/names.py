"""Names of catalogue and libraries, matched without regard to case, spaces and hyphens."""

from collections.abc import Iterable

IGNORED = " -_\t"


def plain_name(name: str) -> str:
    """A name without case, spaces, hyphens and underscores: '7208-B' and '7208 b' are one."""
    return "".join(letter for letter in name.casefold() if letter not in IGNORED)


def matching_name(name: str, names: Iterable[str]) -> str | None:
    """The one of `names` that `name` means: itself, else the first that `plain_name` makes equal;
    None if none is.
    """
    names = tuple(names)
    if name in names:
        return name
    return {plain_name(own): own for own in reversed(names)}.get(plain_name(name))

"""Numbers and lists as text."""

from math import isfinite
from typing import Any, TypeGuard

NOTHING = "–"
MOST_LISTED = 8  # balls are listed one by one up to this number


def number(value: Any, digits: str = ".4g") -> str:
    """Text of a number by a format; a dash for null, other values as they are.

    Parameters
    ----------
    value : Any
        Number in any unit, text or None.
    digits : str, default '.4g'
        Format of a float.

    Returns
    -------
    str
        The text.
    """
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return NOTHING
    return f"{value + 0.0:{digits}}" if isinstance(value, float) else str(value)


def in_figures(value: float, figures: int) -> str:
    """A number to so many figures, without a power of ten.

    Parameters
    ----------
    value : float
        Positive number in any unit.
    figures : int
        Significant figures [-].

    Returns
    -------
    str
        The text.
    """
    text = f"{value:.{figures}g}"
    return f"{float(text):.0f}" if float(text) >= 10.0 ** (figures - 1) else text


def listed(names: list[str]) -> str:
    """Names side by side; the ends alone of a long list.

    Parameters
    ----------
    names : list[str]
        Names in their order.

    Returns
    -------
    str
        The names, separated by commas.
    """
    if len(names) <= MOST_LISTED:
        return ", ".join(names)
    return f"{', '.join(names[:2])} ... {names[-1]}"


def evenly_chosen(count: int, most: int) -> list[int]:
    """Evenly spread indices of a list, the first and the last entry among them; of one index the
    first.

    Parameters
    ----------
    count : int
        Entries of the list [-].
    most : int
        Indices at most [-].

    Returns
    -------
    list[int]
        Indices, ascending.
    """
    if count <= most:
        return list(range(count))
    return [round(k * ((count - 1) / max(most - 1, 1))) for k in range(most)]


def is_number(value: Any) -> TypeGuard[float]:
    """True of a number; a truth value is none.

    Parameters
    ----------
    value : Any
        Any value.

    Returns
    -------
    TypeGuard[float]
        True of int and float.
    """
    return isinstance(value, int | float) and not isinstance(value, bool)

"""Numbers and lists as text."""

from math import isfinite
from typing import Any, TypeGuard

from ehl.units import value_with_error as value_with_error

NOTHING = "–"
MOST_LISTED = 8  # balls are listed one by one up to this number


def number(value: Any, digits: str = ".4g") -> str:
    """Text of a number by a format; a dash for null, other values as they are."""
    if value is None or (isinstance(value, float) and not isfinite(value)):
        return NOTHING
    return f"{value + 0.0:{digits}}" if isinstance(value, float) else str(value)


def in_figures(value: float, figures: int) -> str:
    """A number to so many figures, without a power of ten."""
    text = f"{value:.{figures}g}"
    return f"{float(text):.0f}" if float(text) >= 10.0 ** (figures - 1) else text


def listed(names: list[str]) -> str:
    """Names side by side; the ends alone of a long list."""
    if len(names) <= MOST_LISTED:
        return ", ".join(names)
    return f"{', '.join(names[:2])} ... {names[-1]}"


def evenly_chosen(count: int, most: int) -> list[int]:
    """Places of at most so many of a list, spread evenly, the first and the last among them; of
    one alone the first.
    """
    if count <= most:
        return list(range(count))
    return [round(k * ((count - 1) / max(most - 1, 1))) for k in range(most)]


def is_number(value: Any) -> TypeGuard[float]:
    """Whether a value is a number; a truth value is none."""
    return isinstance(value, int | float) and not isinstance(value, bool)

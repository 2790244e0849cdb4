"""Ranges of input values; an error names the field."""

from collections.abc import Iterable
from math import inf, isfinite
from typing import Any


def _values(owner: Any, names: tuple[str, ...]) -> Iterable[tuple[str, float]]:
    """Names and values, of many objects a batch: pairs without a dictionary."""
    if isinstance(owner, dict):
        return owner.items()
    return [(name, getattr(owner, name)) for name in names]


def require_finite(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not isfinite(value):
            raise ValueError(f"{name} must be finite, got {value!r}")


def require_positive(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are positive and finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is zero, negative, infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not 0.0 < value < inf:
            raise ValueError(f"{name} must be positive and finite, got {value!r}")


def require_not_negative(owner: Any, *names: str) -> None:
    """Raise ValueError unless the values are zero or positive, and finite.

    Parameters
    ----------
    owner : Any
        an object with the attributes, or a dict whose values are all tested
    *names : str
        names of the attributes

    Raises
    ------
    ValueError
        if a value is negative, infinite or not a number; the message has its name
    """
    for name, value in _values(owner, names):
        if not (isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} must be zero or positive and finite, got {value!r}")

"""The keys that a batch varies, as its figures tell them apart."""

from dataclasses import dataclass

import numpy as np

from ehl.units import unit_of, unit_symbol, without_unit

from ..text import is_number
from .results import BatchResults

MIN_CURVE_VALUES = 3  # values that make a curve
MOST_LINES = 8  # of a family, by colour
MOST_STYLES = 4  # and by the style of line
LOADS = ("radial_load_N", "axial_load_N")  # these are the colours of lines
SPEEDS = ("inner_speed_rpm", "outer_speed_rpm")  # results are drawn over these first


@dataclass(frozen=True, slots=True, kw_only=True)
class Varied:
    """A key that varies: its label, its number at every point, and what the numbers stand for."""

    label: str
    values: tuple[float | None, ...]
    words: tuple[str, ...] = ()

    @property
    def distinct(self) -> list[float]:
        """Different values, ascending."""
        return sorted({value for value in self.values if value is not None})

    @property
    def count(self) -> int:
        """Different values [-]."""
        return len(self.distinct)

    def text(self, value: float) -> str:
        """A value in words.

        Parameters
        ----------
        value : float
            Number of the key.

        Returns
        -------
        str
            The words.
        """
        return self.words[int(value)] if self.words else f"{value:g}"


def varied_keys(results: BatchResults) -> dict[str, Varied]:
    """Keys of at least two numbers by their names: speed, load, then those of most values.

    Without a speed one of most values is first; keys of words are one, last.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    dict[str, Varied]
        Keys by their names.
    """
    numbers: dict[str, Varied] = {}
    wordy = []
    for key in results.keys:
        values = tuple(point.values.get(key) for point in results.points)
        if len({str(value) for value in values if value is not None}) < 2:
            continue
        if all(value is None or is_number(value) for value in values):
            numbers[key] = Varied(label=axis_label(key), values=values)
        else:
            wordy.append(key)
    by_count = sorted(numbers, key=lambda key: -numbers[key].count)
    order = sorted(by_count, key=lambda key: not _is_speed(key, numbers[key]))
    order[1:] = sorted(order[1:], key=lambda key: not key.endswith(LOADS))
    shown = {
        key: numbers[key]
        for key in order
        if key == order[0] or not _goes_along(numbers[order[0]], numbers[key])
    }
    return shown | ({" / ".join(wordy): _words(results, wordy)} if wordy else {})


def _is_speed(key: str, varied: Varied) -> bool:
    """True of a speed with enough values for a curve."""
    return key.endswith(SPEEDS) and varied.count >= MIN_CURVE_VALUES


def families(keys: list[Varied]) -> list[Varied]:
    """The keys of a panel: along the axis, by colour, by style of line.

    Those after the second as one, or all after the first as one, as far as so many lines can be
    distinguished; else the keys as they are. Where there are too many styles for them, those after
    the second have the colours.

    Parameters
    ----------
    keys : list[Varied]
        Varied keys, the one along the axis first.

    Returns
    -------
    list[Varied]
        One to three keys, or all.
    """
    if len(keys) < 3 or any(value is None for key in keys for value in key.values):
        return keys
    styles = _together(keys[2:])
    for colours, other in ((keys[1], styles), (styles, keys[1])):
        if colours.count <= MOST_LINES and other.count <= MOST_STYLES:
            return [keys[0], colours, other]
    lines = _together(keys[1:])
    return [keys[0], lines] if lines.count <= MOST_LINES else keys


def are_distinguishable(keys: list[Varied]) -> bool:
    """True if a line for each value of the keys after the first differs visibly from the others.

    Parameters
    ----------
    keys : list[Varied]
        Varied keys, the one along the axis first.

    Returns
    -------
    bool
        True if colours and styles suffice.
    """
    styles = keys[2].count if len(keys) > 2 else 1
    return len(keys) <= 3 and keys[1].count <= MOST_LINES and styles <= MOST_STYLES


def _together(keys: list[Varied]) -> Varied:
    """Several complete keys as one, whose values are their combinations."""
    if len(keys) == 1:
        return keys[0]
    rows = list(zip(*(key.values for key in keys), strict=True))
    available = sorted(set(rows))
    words = tuple(
        " / ".join(key.text(v) for key, v in zip(keys, row, strict=True)) for row in available
    )
    values = tuple(float(available.index(row)) for row in rows)
    return Varied(label=" / ".join(key.label for key in keys), values=values, words=words)


def _goes_along(first: Varied, other: Varied) -> bool:
    """True if another key rises or falls strictly with the first one, as sizes of a bearing do."""
    both = zip(first.values, other.values, strict=True)
    pairs = sorted({(a, b) for a, b in both if a is not None and b is not None})
    if len(pairs) < MIN_CURVE_VALUES or len({a for a, _ in pairs}) < len(pairs):
        return False
    steps = np.diff([b for _, b in pairs])
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _words(results: BatchResults, keys: list[str]) -> Varied:
    """Keys of words as one, numbered in the order in which their combinations appear."""
    texts = [" / ".join(str(point.values.get(key)) for key in keys) for point in results.points]
    words = tuple(dict.fromkeys(texts))
    values = tuple(float(words.index(text)) for text in texts)
    return Varied(label=" / ".join(map(axis_label, keys)), values=values, words=words)


def axis_label(key: str) -> str:
    """A key in words, its unit in brackets.

    Parameters
    ----------
    key : str
        Dotted key with its unit.

    Returns
    -------
    str
        Label of the axis.
    """
    last = key.rpartition(".")[2]
    return f"{without_unit(last)} [{unit_symbol(last)}]" if unit_of(last) else without_unit(last)

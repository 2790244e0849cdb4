"""Pieces of an HTML page: tables, facts, pictures; every text is escaped here and nowhere else."""

import base64
import platform
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from html import escape
from importlib import metadata
from math import isfinite
from pathlib import Path
from typing import Any

from ehl.units import unit_symbol, without_unit

from ..quantities import Quantity
from ..text import in_figures, value_with_error

NOTHING = "–"
DIGITS = 5
ROUND_OFF = 1e-9  # of the largest component
MAX_LISTED = 6  # entries of a list on one line
MAX_BESIDE_KEY = 60  # characters of a value beside its key
MAX_UNBROKEN = 28  # characters from which on a text may break
VECTOR_DECIMALS = 3
ABBREVIATIONS = {
    "ehl": "EHL",
    "skf": "SKF",
    "youngs": "Young's",
    "poisson": "Poisson's",
    "iso": "ISO",
    "hertz": "Hertz",
    "coulomb": "Coulomb",
    "hurst": "Hurst",
    "weibull": "Weibull",
    "roelands": "Roelands",
    "palmgren": "Palmgren",
    "csv": "CSV",
}
LIVES = ("_h", "_Mrev")  # ends of keys whose numbers are read without a power of ten
LIBRARIES = ("numpy", "scipy", "numba", "xarray", "vtk")


def text(value: Any) -> str:
    """A value as text of the page; numbers to five figures, a dash for null."""
    if value is None:
        return NOTHING
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return number(value)
    if isinstance(value, list | tuple):
        return ", ".join(text(item) for item in without_noise(value))
    if isinstance(value, dict):
        return "; ".join(f"{escape(str(key))}: {text(item)}" for key, item in value.items())
    return escape(str(value))


def number(value: float, digits: int = DIGITS) -> str:
    """A number to some figures [-], with a true minus and powers of ten that are read as such."""
    if not isfinite(value):
        return NOTHING
    plain = f"{value + 0.0:.{digits}g}"
    if "e" in plain:
        mantissa, _, exponent = plain.partition("e")
        plain = f"{mantissa}·10<sup>{int(exponent)}</sup>".replace("<sup>-", "<sup>−")
    return plain.replace("-", "−")


def figure(value: Any) -> str:
    """A result to four figures, a dash for null."""
    return number(float(value), 4) if isinstance(value, int | float) else text(value)


def with_error(row: dict[str, Any], key: str) -> str:
    """A film with its uncertainty, to the figures that it supports."""
    value = row.get(key)
    head, _, unit = key.rpartition("_")
    error = row.get(f"{head}_uncertainty_{unit}")
    if value is None or error is None:
        return NOTHING if value is None else number(value)
    return value_with_error(value, error)


def result(row: dict[str, Any], key: str) -> str:
    """A result of a row, a film with its uncertainty, a life without a power of ten."""
    if key.startswith("film_"):
        return with_error(row, key)
    return _shown(key, row.get(key), figure)


def _shown(key: str, value: Any, plain: Callable[[Any], str]) -> str:
    """A life without a power of ten, other values as `plain` writes them."""
    return in_figures(value, 4) if key.endswith(LIVES) and value is not None else plain(value)


def without_noise(values: Sequence[Any]) -> list[Any]:
    """Components of one vector [any unit]; round-off beside the largest of them is 0."""
    numbers = [abs(v) for v in values if isinstance(v, float) and isfinite(v)]
    level = ROUND_OFF * max(numbers, default=0.0)
    return [0.0 if isinstance(v, float) and abs(v) < level else v for v in values]


def vector(value: Any) -> Any:
    """A vector of the bearing with the names of its components; other values as they are."""
    names = {3: "xyz", 2: "yz"}.get(len(value) if isinstance(value, list) else 0)
    if names is None or not all(isinstance(part, int | float) for part in value):
        return value
    parts = zip(names, without_noise(value), strict=True)
    return ", ".join(f"{name} {round(part, VECTOR_DECIMALS) + 0.0:g}" for name, part in parts)


def name_text(key: str) -> str:
    """A key in words, abbreviations as they are written."""
    words = without_unit(key).split(" ")
    return escape(" ".join(ABBREVIATIONS.get(word, word) for word in words))


def _keys_in_words(source: Any) -> str:
    """A source whose parts begin with the key that they are of, each key in words."""
    parts = re.split(r"((?:^|; )[a-z]+(?:_[A-Za-z0-9]+)+(?=: ))", text(source))
    return "".join(
        f"{part[: -len(part.lstrip('; '))]}{name_text(part.lstrip('; '))}" if odd % 2 else part
        for odd, part in enumerate(parts)
    )


def title_text(key: str, quantities: Mapping[str, Quantity]) -> str:
    """Title and symbol of a quantity, or its key in words where none is known."""
    if key not in quantities:
        return name_text(key)
    return escape(quantities[key].name)


def key_head(keys: Iterable[str]) -> list[tuple[str, str]]:
    """Names and units of columns, by the keys of their values."""
    return [(name_text(key), unit_symbol(key)) for key in keys]


def table(
    head: Sequence[tuple[str, str]],
    rows: Iterable[tuple[str, Sequence[str]]],
    texts: Sequence[int] = (),
) -> str:
    """A table that can be scrolled sideways, all its texts HTML.

    From name and unit of each column, and class and cells of each row; `texts` are the columns
    that hold words and are set left.
    """
    heads = "".join(
        f"<th{_text_class(i in texts)}>{name}{f'<small>{unit}</small>' if unit else ''}</th>"
        for i, (name, unit) in enumerate(head)
    )
    lines = []
    for style, cells in rows:
        content = "".join(
            f"<td{_text_class(i in texts, len(cell))}>{cell}</td>" for i, cell in enumerate(cells)
        )
        lines.append(f'<tr class="{style}">{content}</tr>' if style else f"<tr>{content}</tr>")
    body = f"<thead><tr>{heads}</tr></thead><tbody>{''.join(lines)}</tbody>"
    return f'<div class="scroll"><table>{body}</table></div>'


def _text_class(is_text: bool, length: int = 0) -> str:
    if not is_text:
        return ""
    return ' class="text long"' if length > MAX_UNBROKEN else ' class="text"'


def facts(
    title: str,
    values: dict[str, Any],
    assumed: frozenset[str] = frozenset(),
    path: str = "",
    names: Mapping[str, str] | None = None,
) -> str:
    """Key or its name, value and unit, one below the other; `assumed` keys are marked, null is a
    dash.
    """
    rows = []
    for key, value in values.items():
        is_assumed = f"{path}.{key}" in assumed
        name = escape(names[key]) if names and key in names else name_text(key)
        name += ' <span class="mark">*</span>' if is_assumed else ""
        unit = unit_symbol(key) if value is not None else ""
        shown = _keys_in_words(value) if key == "source" else _shown(key, value, text)
        content = f"{shown}&nbsp;{escape(unit)}" if unit else shown
        cells = f"<td>{name}</td><td>{content}</td>"
        if len(content) > MAX_BESIDE_KEY:  # words, such as a source
            cells = f'<td colspan="2" class="small">{name}: {content}</td>'
        row = '<tr class="assumed">' if is_assumed else "<tr>"
        rows.append(f"{row}{cells}</tr>")
    heading = f"<h3>{escape(title)}</h3>" if title else ""
    return f"<div>{heading}<table><tbody>{''.join(rows)}</tbody></table></div>"


def side_by_side(*blocks: str, kind: str = "facts") -> str:
    """Blocks of facts, cards or pictures side by side; nothing without a block."""
    return f'<div class="{kind}">{"".join(blocks)}</div>' if any(blocks) else ""


def note(explanation: str) -> str:
    """A line of explanation in HTML."""
    return f'<p class="quiet small">{explanation}</p>'


def unfolding(title: str, body: str, state: str = "") -> str:
    """A part that unfolds, or is `open` and folds."""
    return f"<details{state and f' {state}'}><summary>{title}</summary>{body}</details>"


def is_large(value: Any) -> bool:
    """Whether a value is too much for one line: a table, a long list, a list of tables."""
    return isinstance(value, dict) or (
        isinstance(value, list)
        and (len(value) > MAX_LISTED or any(isinstance(item, list | dict) for item in value))
    )


def card(name: str, value: str, unit: str = "") -> str:
    """One number that is looked at first."""
    content = f"<b>{value} <small>{escape(unit)}</small></b><span>{escape(name)}</span>"
    return f'<div class="card">{content}</div>'


def picture(path: Path, caption: str, *, wide: bool = False) -> str:
    """A PNG file inside the page, nothing if there is none; a wide one is scrolled on a phone."""
    if not path.is_file():
        return ""
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    source = f"data:image/png;base64,{data}"
    image = f'<img alt="{escape(caption)}" src="{source}">'
    image = f'<div class="scroll wide">{image}</div>' if wide else image
    return f"<figure>{image}<figcaption>{escape(caption)}</figcaption></figure>"


def items(messages: Iterable[str]) -> str:
    """Messages as a list."""
    return "<ul>" + "".join(f"<li>{escape(message)}</li>" for message in messages) + "</ul>"


def notes(messages: Iterable[str]) -> str:
    """The messages that are no warnings; nothing if there are none."""
    texts = [str(message) for message in messages]
    return f'<div class="notes small">{items(texts)}</div>' if texts else ""


def section(anchor: str, title: str, body: str) -> str:
    """A part of the page; empty if it has nothing to say."""
    return f'<section id="{anchor}"><h2>{escape(title)}</h2>\n{body}\n</section>' if body else ""


def versions(summary: dict[str, Any]) -> str:
    """Program, libraries of the machine that wrote the page, wall times [s]."""
    programs = {
        "oilfilm, of the results": summary["oilfilm"],
        "python, of this page": platform.python_version(),
    }
    for name in LIBRARIES:
        try:
            programs[f"{name}, of this page"] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    times = {f"{name}_s": value for name, value in (summary.get("timing_s") or {}).items()}
    return side_by_side(facts("Versions", programs), facts("Wall time", times) if times else "")

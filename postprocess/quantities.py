"""Output quantities: each is declared once, by its key, its title and where its value comes from.

The last words of the key are the unit (`ehl.units`); summary, CSV, netCDF attributes, the tables
of terminal and report and the labels of pictures read the same declaration.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from ehl.units import from_si, unit_of


@dataclass(frozen=True, slots=True)
class Quantity:
    """One output quantity.

    Its value is the attribute `source`, a dotted path in a record, in SI; null where a part of the
    path is None, for the reason `null`. Without a `source` it is derived from a whole summary.
    """

    key: str
    title: str
    source: str = ""
    null: str = ""
    symbol: str = ""  # in tables of a terminal
    short: str = ""  # title of narrow columns, where the title is too long
    words: bool = False  # a name, a number of a part or a truth value: without unit

    @property
    def header(self) -> str:
        """Title and unit of a column."""
        return self.title if self.words else f"{self.title} [{unit_of(self.key) or '-'}]"

    def value(self, record: Any) -> Any:
        """The value of a record, in the unit of the key."""
        return value_of(record, self.key, self.source)


def quantities(
    source: str, null: str, *rows: tuple[str, ...], words: bool = False
) -> tuple[Quantity, ...]:
    """Quantities of one part of a record.

    Each row is key, title, attribute of the part and, where there are any, symbol and short title.
    """
    declared = []
    for key, title, name, *names in rows:
        symbol, short = (*names, "", "")[:2]
        declared.append(Quantity(key, title, source + name, null, symbol, short, words))
    return tuple(declared)


def value_of(record: Any, key: str, source: str) -> Any:
    """The attribute at a dotted path in the unit of the key; None where a part of it is None."""
    value = record
    for name in source.split("."):
        if value is None:
            return None
        value = getattr(value, name)
    return from_si(key, value)


def values_of(record: Any, sources: Mapping[str, str] | Iterable[Quantity]) -> dict[str, Any]:
    """Values of quantities, or of attributes by key, in the units of the keys."""
    if isinstance(sources, Mapping):
        return {key: value_of(record, key, source) for key, source in sources.items()}
    return {quantity.key: quantity.value(record) for quantity in sources}

"""Output quantities, the base of all results, tables and numbers as text.

A quantity is declared once, by its key, its title and the attribute that has its value. The last
words of the key are the unit (`ehl.units`); summary, CSV, netCDF attributes, tables and labels of
pictures read the same declaration. To add an output quantity, add a row to the `quantities(...)`
of its kind: `bearing/bearing_quantities.py`, `bearing/contact_quantities.py`,
`contact/summary.py`, and `results.py` of the other kinds.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, lru_cache
from math import isfinite
from operator import attrgetter
from typing import Any, TypeGuard

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import (
    from_si,
    is_si,
    notebook_html,
    si_unit_of,
    unit_of,
    unit_symbol,
    without_unit,
)
from oilfilm.ehl.version import version

# a part of a record by its path, what looks up several of its attributes, their keys, and which
# of these have another unit than in SI
_Part = tuple[str, Callable[[Any], tuple[Any, ...]], tuple[str, ...], tuple[str, ...]]
# kinds of pictures: those that need no more than the films, and those of all results
FILMS = "films"
OTHERS = "others"
PARAVIEW = "ParaView"  # what is no picture
STIFFNESS_ORDER = ("x", "y", "z", "ty", "tz")  # directions of a ring
STIFFNESS_HEADLINES = {"axial stiffness": 0, "radial stiffness": 1}  # place on the diagonal
STIFFNESS_UNITS = [  # force and moment over shift and tilt
    *[["N/m"] * 3 + ["N/rad"] * 2 for _ in range(3)],
    *[["N m/m"] * 3 + ["N m/rad"] * 2 for _ in range(2)],
]
NOTHING = "–"
LONG_LIFE = 1e6  # life of which no more is shown [h]
MOST_LISTED = 8  # balls are listed one by one up to this number


@dataclass(frozen=True, slots=True, eq=False)  # each is declared once
class Quantity:
    """One output quantity.

    Its value is the attribute `source`, a dotted path in a record, in SI; null where a part of the
    path is None, for the reason `null`. Without a `source` it is derived from a whole summary or,
    in a picture, from a history.
    """

    key: str
    title: str
    source: str = ""
    null: str = ""
    symbol: str = ""  # in tables of a terminal
    short: str = ""  # title of narrow columns, where the title is too long
    words: bool = False  # a name, a number of a part or a truth value: without unit

    @property
    def name(self) -> str:
        """Title and symbol."""
        return " ".join(filter(None, (self.title, self.symbol)))

    @property
    def header(self) -> str:
        """Title and unit of a column."""
        return self.title if self.words else f"{self.title} [{unit_of(self.key) or '-'}]"

    @property
    def label(self) -> str:
        """Title and unit of an axis."""
        return f"{self.title} [{unit_symbol(self.key) or '-'}]"

    @property
    def si_attributes(self) -> dict[str, str]:
        """The unit of a netCDF variable in SI."""
        return {"units": si_unit_of(self.key) or "1"}

    def in_unit(self, value: Any) -> Any:
        """A number or an array in SI, in the unit of the key; None stays None.

        Parameters
        ----------
        value : Any
            Number or array in SI, or None.

        Returns
        -------
        Any
            The value in the unit of the key.
        """
        return from_si(self.key, value)

    def value(self, record: Any) -> Any:
        """Value of a record, in the unit of the key.

        Parameters
        ----------
        record : Any
            Object that has the attributes of `source`, SI.

        Returns
        -------
        Any
            The value in the unit of the key; None where a part of its path is None.
        """
        return from_si(self.key, _attribute(record, self.source))


def _attribute(record: Any, source: str, looked_up: dict[str, Any] | None = None) -> Any:
    """Attribute of a record by its dotted path; None where a part of the path is None.

    `looked_up` takes the parts of the record by their paths.
    """
    looked_up = {} if looked_up is None else looked_up
    owner, name = _names(source)
    value = record
    if owner:
        if owner not in looked_up:
            looked_up[owner] = _attribute(record, owner, looked_up)
        value = looked_up[owner]
    return None if value is None else getattr(value, name)


@cache
def _names(source: str) -> tuple[str, str]:
    """Path of the owner of an attribute, empty for the record itself, and its name."""
    owner, _, name = source.rpartition(".")
    return owner, name


def quantities(
    *rows: str | tuple[str, ...], source: str = "", null: str = "", words: bool = False
) -> tuple[Quantity, ...]:
    """Quantities of one part of a record.

    Each row is a key or key, title, attribute of the part, symbol and short title; where title or
    attribute are left out, they are the words of the key.

    Parameters
    ----------
    *rows : str | tuple[str, ...]
        Key, or key, title, attribute, symbol and short title.
    source : str, default ""
        Path of the part in a record, with its dot at the end; empty for the record itself.
    null : str, default ""
        Reason for a value of null.
    words : bool, default False
        The values have no unit.

    Returns
    -------
    tuple[Quantity, ...]
        The quantities in the order of the rows.
    """
    declared = []
    for row in rows:
        key, *names = (row,) if isinstance(row, str) else row
        title, name, symbol, short = (*names, "", "", "", "")[:4]
        title = title or without_unit(key)
        path = source + (name or without_unit(key).replace(" ", "_"))
        declared.append(Quantity(key, title, path, null, symbol, short, words))
    return tuple(declared)


def by_key(declared: Iterable[Quantity]) -> dict[str, Quantity]:
    """Quantities by their keys.

    Parameters
    ----------
    declared : Iterable[Quantity]
        Quantities.

    Returns
    -------
    dict[str, Quantity]
        The quantities by key.
    """
    return {quantity.key: quantity for quantity in declared}


def values_of(record: Any, declared: Iterable[Quantity]) -> dict[str, Any]:
    """Values of a record by key, in the units of the keys.

    Parameters
    ----------
    record : Any
        Object that has the attributes, SI; None gives None for each key.
    declared : Iterable[Quantity]
        Quantities.

    Returns
    -------
    dict[str, Any]
        Value by key; None where a part of the record is None.
    """
    looked_up: dict[str, Any] = {}
    keys, parts = _parts(tuple(declared))
    values: dict[str, Any] = dict.fromkeys(keys)
    for owner, get, own, scaled in parts:
        if owner and owner not in looked_up:
            looked_up[owner] = _attribute(record, owner, looked_up)
        part = looked_up[owner] if owner else record
        if part is None:
            continue
        values.update(zip(own, get(part), strict=True))
        for key in scaled:
            values[key] = from_si(key, values[key])
    return values


@lru_cache(maxsize=256)
def _parts(declared: tuple[Quantity, ...]) -> tuple[tuple[str, ...], tuple[_Part, ...]]:
    """Keys, and what is looked up of each part of a record at once."""
    parts: dict[str, list[tuple[str, str]]] = {}
    for quantity in declared:
        owner, name = _names(quantity.source)
        parts.setdefault(owner, []).append((quantity.key, name))
    return tuple(quantity.key for quantity in declared), tuple(
        (
            owner,
            _getter([name for _, name in own]),
            tuple(key for key, _ in own),
            tuple(key for key, _ in own if not is_si(key)),
        )
        for owner, own in parts.items()
    )


def _getter(names: Sequence[str]) -> Callable[[Any], tuple[Any, ...]]:
    """Function that looks up attributes as a tuple, also of one attribute."""
    get = attrgetter(*names)
    return get if len(names) > 1 else lambda part: (get(part),)


def rows_of(columns: Mapping[str, Iterable[Any]]) -> list[dict[str, Any]]:
    """A dictionary for each row of columns of equal length.

    Parameters
    ----------
    columns : Mapping[str, Iterable[Any]]
        Values by key, all of one length.

    Returns
    -------
    list[dict[str, Any]]
        A dictionary a row.
    """
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


# quantities of an equilibrium and of a simulation
CAGE_SPEED = Quantity("cage_speed_rpm", "cage speed", "cage_speed", symbol="cage")


FREQUENCIES = quantities(  # in a block that has the unit
    ("cage", "", "", "cage"),
    ("ball_pass_outer", "", "", "BPFO"),
    ("ball_pass_inner", "", "", "BPFI"),
    ("ball_spin", "", "", "BSF"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Results:
    """Common to the results of all commands."""

    case: dict[str, Any]  # the document as run, plain JSON types
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)  # wall time by part of the run [s]
    version: str = field(default_factory=version)  # of the program

    @property
    def title(self) -> str:
        """Title of the case."""
        return str(self.case.get("title", ""))

    @property
    def pictures(self) -> dict[str, int]:
        """The most that are drawn apart from each other [-]: of the films alone, and others."""
        return {FILMS: 0, OTHERS: 0}

    def _repr_html_(self) -> str:
        """Title, state and messages for a notebook; kinds that show more have their own."""
        return notebook_html(self.title or type(self).__name__, self._facts())

    def _facts(self) -> dict[str, Any]:
        """State of convergence, and the messages."""
        facts: dict[str, Any] = {"oilfilm": self.version}
        if hasattr(self, "converged"):
            facts["converged"] = str(self.converged)
        return facts | {f"note {k + 1}": note for k, note in enumerate(self.messages)}

    def head(self, converged: bool, messages: Iterable[str]) -> dict[str, Any]:
        """First keys of a summary; the messages of the run stand before those given.

        Parameters
        ----------
        converged : bool
            State of the results.
        messages : Iterable[str]
            Further messages.

        Returns
        -------
        dict[str, Any]
            Version, case, converged, messages, and those of them that are warnings.
        """
        everything = [*self.messages, *messages]
        return {
            "oilfilm": self.version,
            "case": self.case,
            "converged": converged,
            "messages": everything,
            "warnings": [message for message in everything if is_warning(message)],
        }


def is_warning(message: str) -> bool:
    """Check whether a message changes a decision.

    Parameters
    ----------
    message : str
        Message of results.

    Returns
    -------
    bool
        True of a `Caution`, and of what did not converge.
    """
    return isinstance(message, Caution) or "not converged" in message


def titled(title: str, *parts: RenderableType) -> Group:
    """Tables and lines of text below a title.

    Parameters
    ----------
    title : str
        Title of the case.
    *parts : RenderableType
        Tables and lines of text.

    Returns
    -------
    Group
        All of it for a terminal.
    """
    return Group(Text(title, style="bold"), *parts)


def facts_table(rows: Mapping[str, str]) -> Table:
    """Names and values side by side, without lines.

    Parameters
    ----------
    rows : Mapping[str, str]
        Value by name.

    Returns
    -------
    Table
        The table.
    """
    table = Table(box=None, show_header=False, pad_edge=False)
    table.add_column(style="dim", no_wrap=True)
    table.add_column()
    for name, value in rows.items():
        table.add_row(name, Text(value))
    return table


def number_table(
    headers: Iterable[str], rows: Iterable[Iterable[str]], left: Iterable[str] = (), **style: Any
) -> Table:
    """Columns aligned right, those named in `left` aligned left, a line below the head.

    Parameters
    ----------
    headers : Iterable[str]
        Titles of the columns.
    rows : Iterable[Iterable[str]]
        Cells of each line.
    left : Iterable[str], default ()
        Titles of columns that hold words.
    **style : Any
        Further options of `rich.table.Table`.

    Returns
    -------
    Table
        The table.
    """
    own: dict[str, Any] = {"box": box.SIMPLE_HEAD, "pad_edge": False, "title_justify": "left"}
    table = Table(**own | style)
    for header in headers:
        table.add_column(header, justify="left" if header in left else "right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table


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


def null(values: str, why: str) -> str:
    """A message of values that a summary lacks.

    Parameters
    ----------
    values : str
        Their keys.
    why : str
        The reason.

    Returns
    -------
    str
        The message.
    """
    return f"{values}: null, {why}"


def in_hours(life: float) -> str:
    """A life to three figures, without a power of ten; beyond `LONG_LIFE` that alone.

    Parameters
    ----------
    life : float
        Life [h].

    Returns
    -------
    str
        The text, without the unit.
    """
    if life > LONG_LIFE:
        return f"> {LONG_LIFE:_.0f}".replace("_", "\N{NO-BREAK SPACE}")
    return in_figures(life, 3)


def in_ranges(numbers: list[str]) -> str:
    """Whole numbers side by side, three and more that follow each other as a range.

    Parameters
    ----------
    numbers : list[str]
        Whole numbers as text, ascending.

    Returns
    -------
    str
        For example "1, 3–8, 10".
    """
    runs: list[list[int]] = []
    for number in map(int, numbers):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    parts = [f"{run[0]}–{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs]
    return listed(parts)


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

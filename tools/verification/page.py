"""Parts of a page - checks, tables, pictures, sections - and the page in Markdown."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any, TypeVar

from oilfilm.ehl.multigrid.threads import cores, film_threads

Item = TypeVar("Item")
Result = TypeVar("Result")

Progress = Callable[[int, int, str], None]  # done, in all, what is being done

PICTURES = "images"  # folder of the pictures, beside the page


class ForeignFileError(ValueError):
    """A file that stands in the way; the message says which, and what to do."""


@dataclass(frozen=True, slots=True)
class Check:
    """A statement, its computed number and the bounds it must keep; None: not bounded."""

    name: str
    value: float
    least: float | None = None
    most: float | None = None

    @property
    def passed(self) -> bool:
        """Whether the number lies within its bounds; not a number does not."""
        above = self.least is None or self.value >= self.least
        below = self.most is None or self.value <= self.most
        return above and below and self.value == self.value

    @property
    def bounds(self) -> str:
        """The bounds in words."""
        if self.least is None:
            return f"at most {self.most:g}"
        if self.most is None:
            return f"at least {self.least:g}"
        return f"{self.least:g} to {self.most:g}"

    @property
    def cells(self) -> tuple[str, ...]:
        """Statement, found, wanted, holds: a row of a table."""
        return self.name, f"{self.value:.4g}", self.bounds, "yes" if self.passed else "no"

    @property
    def room(self) -> float:
        """Distance to the nearer bound, over the bound; negative outside."""
        ends = [(self.value - self.least, self.least)] if self.least is not None else []
        ends += [(self.most - self.value, self.most)] if self.most is not None else []
        return min(distance / (abs(bound) or 1.0) for distance, bound in ends)


@dataclass(frozen=True, slots=True)
class Table:
    """Cells as text, the head first."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    shown: slice | None = None  # rows that the page prints, None: all; its numbers hold all


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture by its stem, what stands below it, and what draws it into an empty figure."""

    stem: str
    caption: str
    draw: Callable[[Any], None]  # takes a matplotlib figure


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """A part of the page."""

    title: str
    text: str
    checks: tuple[Check, ...] = ()
    tables: tuple[Table, ...] = ()
    pictures: tuple[Picture, ...] = ()


def text(name: str) -> str:
    """Text of a section, from `texts.md`."""
    page = resources.files(__package__).joinpath("texts.md").read_text(encoding="utf-8")
    parts = page.split("<!-- ")[1:]
    return {key: part.strip() for key, _, part in (part.partition(" -->") for part in parts)}[name]


def columns(names: str) -> tuple[str, ...]:
    """Head of a table from names with bars between them."""
    return tuple(name.strip() for name in names.split("|"))


def each(function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """`function` of every item, in order, on all cores: kernels release the lock."""
    with film_threads(cores()) as pool:
        return list(pool.map(function, items))


def percent(share: float, digits: int = 1) -> str:
    """A signed share in percent [-]."""
    return f"{100.0 * share:+.{digits}f} %"


def markdown(title: str, introduction: str, sections: Sequence[Section]) -> str:
    """The page."""
    parts = [f"# {title}", introduction]
    checks = [check for section in sections for check in section.checks]
    if checks:
        caption = "Statements, of several of one kind the one nearest to its bounds; a number out of them is bold:"
        table = Table(caption, ("statement", "found", "wanted"), tuple(statements(checks)))
        parts += ["## Checks", _table(table)]
    for section in sections:
        parts += [f"## {section.title}", section.text]
        parts += [_table(table) for table in section.tables]
        parts += [f"![{picture.caption}]({PICTURES}/{picture.stem}.png)" for picture in section.pictures]
    return "\n\n".join(part.strip() for part in parts if part.strip()) + "\n"


def statements(checks: Sequence[Check]) -> Iterator[tuple[str, ...]]:
    """Rows of the statements: a kind is the text before the first comma, with its bounds; failed ones stand alone."""
    kinds: dict[tuple[str, ...], list[Check]] = {}
    for check in checks:
        kind = (check.name.partition(",")[0], check.bounds) if check.passed else (check.name,)
        kinds.setdefault(kind, []).append(check)
    for found in kinds.values():
        check = min(found, key=lambda one: one.room)
        first, _, place = check.name.partition(", ")
        name = check.name if len(found) == 1 else f"{first} ({len(found)}), {place}"
        number = f"{check.value:.4g}"
        yield name, number if check.passed else f"**{number}**", check.bounds


def _table(table: Table) -> str:
    rows = table.rows if table.shown is None else table.rows[table.shown]
    if table.rows and not rows:
        return ""
    lines = [_line(table.head), "|" + "---|" * len(table.head), *(_line(row) for row in rows)]
    return f"{table.caption}\n\n" + "\n".join(lines)


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"

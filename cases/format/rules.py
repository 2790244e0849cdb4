"""Relations between the keys of a case file, as data, and their one checker.

A rule looks only at values that are valid by themselves: all errors are reported at once, each
with line, key, finding, allowed values and nearest valid name. `tomllib` gives values, not lines:
the line of a key is read from the text here.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from itertools import permutations
from typing import Any

from oilfilm.ehl.units import UNITS

KeyPath = tuple[str | int, ...]

MISSING = "missing"
# ratio of difflib from which on a name is a slip of another: of keys with two wrong letters 99 %
# are recognised, of keys of other tables 7 % taken for one of this table (0.7: 96 and 4 %)
SIMILARITY = 0.65
# not of a single contact
OF_BEARINGS = (
    *(("operation",), ("model",), ("surface",), ("slip",)),
    *(("ehl", "film_maps"), ("ehl", "films")),
)
SHOWN_NAMES = 12  # shown of a list of allowed keys
SHOWN_CHARACTERS = 60  # characters of a found value that are shown
SIGNS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
KINDS = {
    "number": "a number",
    "integer": "a whole number",
    "string": "text in quotes",
    "boolean": "true or false",
    "object": "a table",
    "array": "a list",
}
_KEY = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(\.|=|\]|,|\})?""")
_OPAQUE = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'|\#[^\n]*',
    re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class CaseProblem:
    """One error: the key it belongs to, what was found there and what is allowed."""

    path: KeyPath
    finding: str
    allowed: str = ""
    nearest: str | None = None
    line: int | None = None  # None: the line of `path`
    asked_by: KeyPath = ()  # the key that needs this one; has the line where its table is missing

    def line_in(self, lines: Mapping[KeyPath, int]) -> int:
        """Line of the file that the problem belongs to.

        Parameters
        ----------
        lines : Mapping[Path, int]
            Line by path of the key.

        Returns
        -------
        int
            The line, from 1 [-].
        """
        if self.line is not None:
            return self.line
        known = self.path[:1] in lines or not self.asked_by
        return find_line(lines, self.path if known else self.asked_by)

    def text(self, file: str, lines: Mapping[KeyPath, int]) -> str:
        """The problem as `file:line: table.key: found; allowed; did you mean nearest?`

        Parameters
        ----------
        file : str
            Name of the file.
        lines : Mapping[Path, int]
            Line by path of the key.

        Returns
        -------
        str
            The message.
        """
        where = f"{dotted(self.path)}: " if self.path else ""
        nearest = f"did you mean {self.nearest!r}?" if self.nearest else ""
        parts = [part for part in (self.finding, self.allowed, nearest) if part]
        return f"{file}:{self.line_in(lines)}: {where}{'; '.join(parts)}"


class InvalidKeyError(ValueError):
    """A key whose value turns out unfit on conversion; its message has no line yet."""

    def __init__(self, path: KeyPath, finding: str, allowed: str = "") -> None:
        self.fault = CaseProblem(path, finding, allowed)
        super().__init__(f"{dotted(path)}: {finding}")


class CaseError(ValueError):
    """A case that cannot be run, with a line for each error and what is known of its key.

    Examples
    --------
    >>> import oilfilm
    >>> try:
    ...     oilfilm.load_case("6208_full_ceramics")
    ... except oilfilm.CaseError as error:
    ...     print(error.messages[0].partition(";")[0])
    6208_full_ceramics: no such file, and no shipped case has this name
    """

    def __init__(
        self, messages: str | Iterable[str], problems: Iterable[CaseProblem] = ()
    ) -> None:
        self.messages = (messages,) if isinstance(messages, str) else tuple(messages)
        self.problems = tuple(problems)
        super().__init__("\n".join(self.messages))


def faults_error(faults: Iterable[CaseProblem], name: str, text: str) -> CaseError:
    """The problems of a file as one error, in the order of its lines, each once.

    Parameters
    ----------
    faults : Iterable[CaseProblem]
        The problems.
    name : str
        Name of the file in messages.
    text : str
        Content of the file.

    Returns
    -------
    CaseError
        The error.
    """
    lines = key_lines(text)
    ordered = sorted(faults, key=lambda fault: fault.line_in(lines))
    return CaseError(dict.fromkeys(fault.text(name, lines) for fault in ordered))


def dotted(path: KeyPath) -> str:
    """The path as table.key; a name that is no bare key of TOML in quotes.

    Parameters
    ----------
    path : KeyPath
        Path of a key.

    Returns
    -------
    str
        The text.
    """
    return ".".join(
        str(key) if str(key).replace("_", "").replace("-", "").isalnum() else f'"{key}"'
        for key in path
    )


def shown(value: object) -> str:
    """A value as it stands in the file, shortened.

    Parameters
    ----------
    value : object
        The value.

    Returns
    -------
    str
        The text.
    """
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, bool):
        return "true" if value else "false"
    try:
        text = f'"{value}"' if isinstance(value, str) else str(value)
    except ValueError:  # an integer of more digits than Python prints
        text = "a number of thousands of digits"
    text = "".join(c if c.isprintable() else "?" for c in text)
    return text if len(text) <= SHOWN_CHARACTERS else text[: SHOWN_CHARACTERS - 3] + "..."


def nearest_name(name: str, names: Iterable[str]) -> str | None:
    """The valid name nearest to a name: unit left out, other case, or a slip of spelling.

    Parameters
    ----------
    name : str
        The name as given.
    names : Iterable[str]
        The valid names.

    Returns
    -------
    str | None
        The nearest; None if none is similar.
    """
    candidates = list(names)
    plain = {candidate.lower(): candidate for candidate in reversed(candidates)}
    if name.lower() in plain:
        return plain[name.lower()]
    for candidate in candidates:
        start = candidate[: len(name)]
        unit = candidate[len(name) + 1 :]
        if start.lower() == name.lower() and unit in UNITS:
            return candidate
    close = get_close_matches(name.lower(), plain, n=3, cutoff=SIMILARITY)
    of_its_unit = [key for key in close if name_unit(key) and name_unit(key) == name_unit(name)]
    return plain[(of_its_unit or close)[0]] if close else None


def name_unit(key: str) -> str:
    """The unit that a key ends in.

    Parameters
    ----------
    key : str
        The key.

    Returns
    -------
    str
        The unit; empty if there is none.
    """
    unit = key.rpartition("_")[2]
    return unit if unit in UNITS else ""


def schema_faults(
    errors: Iterable[Mapping[str, Any]], schema: dict[str, Any]
) -> list[CaseProblem]:
    """The errors of pydantic as problems.

    Parameters
    ----------
    errors : Iterable[Mapping[str, Any]]
        The errors.
    schema : dict[str, Any]
        JSON Schema of the file.

    Returns
    -------
    list[CaseProblem]
        The problems.
    """
    return [_fault(error, schema) for error in errors]


def _fault(error: Mapping[str, Any], schema: dict[str, Any]) -> CaseProblem:
    path: KeyPath = tuple(error["loc"])
    finding = f"found {shown(error['input'])}"
    if error["type"] == "extra_forbidden":
        return _unknown(path, schema)
    if error["type"] == "missing":
        return CaseProblem(path, MISSING, f"needed: {allowed_values(schema_node(schema, path))}")
    if error["type"] == "choice":
        words = error.get("ctx", {}).get("words", ())
        close = nearest_name(error["input"], words) if isinstance(error["input"], str) else None
        return CaseProblem(path, finding, f"allowed: {error['msg']}", nearest=close)
    node = schema_node(schema, path)
    given = error["input"]
    nearest = nearest_name(given, node.get("enum", ())) if isinstance(given, str) else None
    return CaseProblem(path, finding, f"allowed: {allowed_values(node)}", nearest=nearest)


def _unknown(path: KeyPath, schema: dict[str, Any]) -> CaseProblem:
    """A key the table does not have: its nearest name, the table it belongs to, or all names."""
    key = str(path[-1])
    parent = path[:-1]
    if "contact" in schema["properties"] and path in OF_BEARINGS:
        return CaseProblem(path, "not used by a single contact", "allowed in a bearing case")
    names = list(schema_node(schema, parent).get("properties", ()))
    for table, node in schema["properties"].items():
        if table != (parent or ("",))[0] and key in resolved(schema, node).get("properties", ()):
            return CaseProblem(path, "unknown key", f"{key} belongs in [{table}]")
    if parent and schema_node(schema, (key,)).get("type") not in (None, "object"):
        return CaseProblem(path, "unknown key", f"{key} belongs at the top of the file")
    nearest = nearest_name(key, names)
    if nearest and nearest.startswith(key + "_"):
        return CaseProblem(path, "unknown key", "keys end in their unit", nearest=nearest)
    if len(names) > SHOWN_NAMES + 2:
        names[SHOWN_NAMES:] = ["... (see docs/reference/cases.md)"]
    listed = "" if nearest else "allowed: " + ", ".join(names)
    return CaseProblem(path, "unknown key" if parent else "unknown name", listed, nearest=nearest)


def resolved(schema: dict[str, Any], node: dict[str, Any]) -> dict[str, Any]:
    """A node of a JSON Schema, its reference followed, without the null of optional keys.

    Parameters
    ----------
    schema : dict[str, Any]
        The schema.
    node : dict[str, Any]
        The node.

    Returns
    -------
    dict[str, Any]
        The resolved node.
    """
    options = [option for option in node.get("anyOf", ()) if option.get("type") != "null"]
    if len(options) == 1:
        node = {**{key: value for key, value in node.items() if key != "anyOf"}, **options[0]}
    if "$ref" in node:
        return resolved(schema, schema["$defs"][node["$ref"].rsplit("/", 1)[-1]])
    return node


def known_keys(schema: dict[str, Any]) -> set[str]:
    """Keys of a JSON Schema as table.key.

    Parameters
    ----------
    schema : dict[str, Any]
        The schema.

    Returns
    -------
    set[str]
        The keys.
    """
    tables = schema["properties"].items()
    return {
        f"{table}.{key}"
        for table, node in tables
        for key in resolved(schema, node).get("properties", ())
    }


def schema_node(schema: dict[str, Any], path: KeyPath) -> dict[str, Any]:
    """The node of a JSON Schema that describes a key.

    Parameters
    ----------
    schema : dict[str, Any]
        The schema.
    path : KeyPath
        Path of the key.

    Returns
    -------
    dict[str, Any]
        The node; empty if there is none.
    """
    node = resolved(schema, schema)
    for key in path:
        if isinstance(key, int):
            node = node.get("items", {})
        else:
            node = node.get("properties", {}).get(key) or node.get("additionalProperties") or {}
        node = resolved(schema, node if isinstance(node, dict) else {})
    return node


def allowed_values(node: dict[str, Any]) -> str:
    """The values that a node of a JSON Schema allows, in words.

    Parameters
    ----------
    node : dict[str, Any]
        The node.

    Returns
    -------
    str
        The text.
    """
    if "const" in node:
        return shown(node["const"])
    if "enum" in node:
        return ", ".join(shown(value) for value in node["enum"])
    if "minimum" in node and node["minimum"] == node.get("maximum"):
        return str(node["minimum"])
    kind = KINDS.get(str(node.get("type")), "another value")
    limits = [f"{sign} {node[key]:g}" for key, sign in SIGNS.items() if key in node]
    return f"{kind} {' and '.join(limits)}".strip()


def key_lines(text: str) -> dict[KeyPath, int]:
    """Line of every table and key of a valid TOML document.

    A path is table, ..., key, with an index for each array of tables. Keys of inline tables have
    the line of the statement that contains them.

    Parameters
    ----------
    text : str
        Content of the file.

    Returns
    -------
    dict[Path, int]
        Line by path, from 1 [-].
    """
    lines: dict[KeyPath, int] = {}
    table: KeyPath = ()
    counts: dict[KeyPath, int] = {}
    for number, statement in _statements(text):
        if statement.startswith("["):
            array = statement.startswith("[[")
            table = tuple(_dotted(statement.lstrip("[")))
            if array:
                lines.setdefault(table, number)
                counts[table] = counts.get(table, -1) + 1
                table = (*table, counts[table])
            path = table
        else:
            path = (*table, *_dotted(statement))
        for depth in range(1, len(path) + 1):
            lines.setdefault(path[:depth], number)
    return lines


def find_line(lines: Mapping[KeyPath, int], path: KeyPath) -> int:
    """Line of a key, or of the nearest table around it.

    Parameters
    ----------
    lines : Mapping[Path, int]
        Line by path of the key.
    path : KeyPath
        Path of the key.

    Returns
    -------
    int
        The line [-]; 1 where the file has neither.
    """
    for depth in range(len(path), 0, -1):
        if path[:depth] in lines:
            return lines[path[:depth]]
    return 1


def _statements(text: str) -> list[tuple[int, str]]:
    """Headers and key-value pairs, also over several lines, with the line each begins on."""
    plain = _OPAQUE.sub(lambda match: "_" * len(match[0]), text)  # nothing but structure is left
    statements = []
    start = 0
    depth = 0
    line = 1  # of `counted`: lines are counted once, not from the beginning for every statement
    counted = 0
    for position, character in enumerate(plain + "\n"):
        if character in "[{":
            depth += 1
        elif character in "]}":
            depth -= 1
        elif character == "\n" and depth <= 0:
            statement = text[start:position].lstrip()
            if statement and not statement.startswith("#"):
                begin = position - len(statement)
                line += text.count("\n", counted, begin)
                counted = begin
                statements.append((line, statement.rstrip()))
            start = position + 1
            depth = 0
    return statements


def _dotted(statement: str) -> list[str]:
    """The keys a statement opens with: `a."b c".d = 1` gives a, b c, d."""
    keys = []
    position = 0
    while match := _KEY.match(statement, position):
        quoted, literal, bare, after = match.groups()
        if quoted and "\\" in quoted:
            quoted = quoted.encode().decode("unicode_escape")
        keys.append(quoted or literal or bare or "")
        position = match.end()
        if after != ".":
            break
    return keys


@dataclass(frozen=True, slots=True)
class CaseValues:
    """The values of a document that are valid by themselves."""

    document: dict[str, Any]
    faulty: frozenset[KeyPath] = frozenset()

    def get(self, *path: str) -> Any:
        """The value of a key.

        Parameters
        ----------
        *path : str
            Path of the key.

        Returns
        -------
        Any
            The value; None if it is left out or wrong.
        """
        node: Any = self.document
        for depth, key in enumerate(path, 1):
            if path[:depth] in self.faulty or not isinstance(node, dict) or key not in node:
                return None
            node = node[key]
        return node

    def given(self, *path: str) -> bool:
        """Tell whether the document has a key, valid or not.

        Parameters
        ----------
        *path : str
            Path of the key.

        Returns
        -------
        bool
            True if it has.
        """
        node: Any = self.document
        for key in path:
            if not isinstance(node, dict) or key not in node:
                return False
            node = node[key]
        return True


@dataclass(frozen=True, slots=True)
class Where:
    """A key or table that is given, or has a value, a number with `nonzero` one other than zero;
    where all of `also` hold, too.
    """

    key: str
    value: str | None = None
    nonzero: bool = False
    also: tuple["Where", ...] = ()

    def holds(self, values: CaseValues) -> bool:
        """Tell whether a document meets the condition.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Returns
        -------
        bool
            True if it does.
        """
        path = _path(self.key)
        if not all(where.holds(values) for where in self.also):
            return False
        if len(path) == 1:
            return values.get(*path) not in (None, [], ())  # no table of several is none, too
        if self.value is not None:
            return bool(values.get(*path) == self.value)
        return bool(values.get(*path)) if self.nonzero else values.given(*path)

    def text(self, table: str = "") -> str:
        """The condition in words.

        Parameters
        ----------
        table : str, default ''
            Name of the table that it is read in, which is left out.

        Returns
        -------
        str
            The text.
        """
        key = self.key.removeprefix(f"{table}.") if "." in self.key else f"[{self.key}]"
        return key if self.value is None else f"{key} = {shown(self.value)}"


@dataclass(frozen=True, slots=True)
class Excludes:
    """Two keys of which a file gives one at most; the fault stands at the first."""

    key: str
    other: str
    allowed: str = "one of them"

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the first key, where both are given.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        if values.given(*path) and values.given(*_path(self.other)):
            finding = f"found together with {self.other.removeprefix(f'{path[0]}.')}"
            yield CaseProblem(path, finding, f"allowed: {self.allowed}")


@dataclass(frozen=True, slots=True)
class Needs:
    """A key, or a table, that must be given where another one is, `unless` one of these is."""

    key: str
    where: Where
    allowed: str = ""
    unless: tuple[str, ...] = ()

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key that is left out; at the one that needs it, where its table is left
        out.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        given = any(values.given(*_path(key)) for key in (self.key, *self.unless))
        if self.where.holds(values) and not given:
            allowed = self.allowed or f"needed with {self.where.text(path[0])}"
            yield CaseProblem(path, MISSING, allowed, asked_by=_path(self.where.key))


@dataclass(frozen=True, slots=True)
class OnlyWith:
    """A key without effect but where one of the others is given; its `default` may stay."""

    key: str
    wheres: tuple[Where, ...]
    default: Any = None

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key, where it is given without the others.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        path = _path(self.key)
        value = values.get(*path)
        if value in (None, self.default) or any(where.holds(values) for where in self.wheres):
            return
        finding = f"found without {' or '.join(where.text(path[0]) for where in self.wheres)}"
        allowed = f"allowed: with {' or '.join(where.text() for where in self.wheres)}"
        yield CaseProblem(path, finding, allowed)


@dataclass(frozen=True, slots=True)
class Below:
    """A number below another one."""

    low: str
    high: str
    low_default: float | None = None
    high_default: float | None = None

    def faults(self, values: CaseValues) -> Iterator[CaseProblem]:
        """A problem at the key without a default, where the first number is not below the second.

        Parameters
        ----------
        values : CaseValues
            The valid values of the file.

        Yields
        ------
        Iterator[CaseProblem]
            The problem.
        """
        low = _number(values, self.low, self.low_default)
        high = _number(values, self.high, self.high_default)
        if low is None or high is None or low < high:
            return
        at_high = self.low_default is not None
        path = _path(self.high if at_high else self.low)
        bound = f"above {self.low} = {low:g}" if at_high else f"below {self.high} = {high:g}"
        if values.get(*path) is not None:
            allowed = f"allowed: {bound.replace(f'{path[0]}.', '')}"
            yield CaseProblem(path, f"found {values.get(*path):g}", allowed)


Relation = Excludes | Needs | OnlyWith | Below


def together(*keys: str) -> Iterator[Needs]:
    """Relations of keys of which each needs all the others.

    Parameters
    ----------
    *keys : str
        Dotted names of the keys.

    Yields
    ------
    Iterator[Needs]
        A relation for each pair.
    """
    for key, other in permutations(keys, 2):
        yield Needs(key, Where(other))


def relation_faults(relations: Iterable[Relation], values: CaseValues) -> Iterator[CaseProblem]:
    """The problems of all relations, the first of each key.

    Parameters
    ----------
    relations : Iterable[Relation]
        The relations.
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    seen: set[KeyPath] = set()
    for relation in relations:
        for fault in relation.faults(values):
            if fault.path not in seen:
                yield fault
            seen.add(fault.path)


def bounded(
    values: CaseValues, key: str, fits: Callable[[Any], bool], allowed: str
) -> Iterator[CaseProblem]:
    """A problem where the value of a key is given and does not fit.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.
    key : str
        Dotted name of the key.
    fits : Callable[[Any], bool]
        Tells whether a value fits.
    allowed : str
        Text for the message.

    Yields
    ------
    Iterator[CaseProblem]
        The problem.
    """
    value = values.get(*_path(key))
    if value is not None and not fits(value):
        yield CaseProblem(_path(key), f"found {shown(value)}", f"allowed: {allowed}")


@cache
def _path(key: str) -> tuple[str, ...]:
    return tuple(key.split("."))


def _number(values: CaseValues, key: str, default: float | None) -> float | None:
    path = _path(key)
    return values.get(*path) if values.given(*path) else default

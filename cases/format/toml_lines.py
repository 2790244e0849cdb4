"""Where the keys of a TOML document stand: `tomllib` gives values, not lines."""

import re

Path = tuple[str | int, ...]

_KEY = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(\.|=|\]|,|\})?""")
_OPAQUE = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'|\#[^\n]*',
    re.DOTALL,
)


def key_lines(text: str) -> dict[Path, int]:
    """Line of every table and key of a valid TOML document.

    Parameters
    ----------
    text : str
        The document.

    Returns
    -------
    dict
        Path (table, ..., key; an index for each array of tables) to line number [-], counted from
        1. Keys of inline tables have the line of the statement they stand in.
    """
    lines: dict[Path, int] = {}
    table: Path = ()
    counts: dict[Path, int] = {}
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


def find_line(lines: dict[Path, int], path: Path) -> int:
    """Line [-] of `path`, or of the nearest table around it in the file; else 1."""
    for depth in range(len(path), 0, -1):
        if path[:depth] in lines:
            return lines[path[:depth]]
    return 1


def _statements(text: str) -> list[tuple[int, str]]:
    """Headers and key-value pairs, also over several lines, with the line each begins on."""
    plain = _OPAQUE.sub(lambda match: "_" * len(match[0]), text)  # nothing but structure is left
    found = []
    start = 0
    depth = 0
    for position, character in enumerate(plain + "\n"):
        if character in "[{":
            depth += 1
        elif character in "]}":
            depth -= 1
        elif character == "\n" and depth <= 0:
            statement = text[start:position]
            first = len(statement) - len(statement.lstrip())
            if plain[start + first : start + first + 1] not in (
                "",
                "\n",
            ) and not statement.lstrip().startswith("#"):
                found.append((text.count("\n", 0, start + first) + 1, statement.strip()))
            start = position + 1
            depth = 0
    return found


def _dotted(statement: str) -> list[str]:
    """The keys a statement opens with: `a."b c".d = 1` gives a, b c, d."""
    keys = []
    position = 0
    while match := _KEY.match(statement, position):
        quoted, literal, bare, after = match.groups()
        keys.append(
            quoted.encode().decode("unicode_escape")
            if quoted and "\\" in quoted
            else quoted or literal or bare or ""
        )
        position = match.end()
        if after != ".":
            break
    return keys

"""Tables of others: text with any separator, decimal comma and headers with units, JSON, npy, npz.

A text may begin with a byte-order mark and with lines of an instrument; the rows of numbers after
them are the table, the lines right before are its header. What is wrong with it is a
`DamagedFileError` with line and column.
"""

import csv
import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .arrays import Array
from .data_files import array_of, read_arrays
from .foreign_files import DamagedFileError, read_file, read_json, visible
from .units import NO_UNIT, UNITS, Unit, without_unit
from .units import unit as unit_of_key

LARGEST_TABLE = 2**26  # of a text [bytes]
SAMPLE = 2000  # lines that tell separator and decimal sign
# separator, None: spaces and tabs; decimal sign; in the order of preference
FORMATS: tuple[tuple[str | None, str], ...] = (
    ("\t", "."),
    (";", "."),
    (",", "."),
    (None, "."),
    ("|", "."),
    ("\t", ","),
    (";", ","),
    (None, ","),
    ("|", ","),
    (",", ","),  # in quotation marks
)
WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # begin .xlsx, .ods; .xls
NOTHING = (
    "",
    "-",
    "--",
    "na",
    "n/a",
    "#n/a",
    "#nv",
    "nan",
    "null",
    "none",
)  # entries that are left out
CLOCK = re.compile(r"(?:(\d{4}-\d\d-\d\d)[T ]?)?(?:(\d{1,2}):(\d\d):(\d\d(?:\.\d*)?))?")
DAY_FIRST = re.compile(r"^(\d\d)\.(\d\d)\.(\d{4})")
WORD = re.compile(r"[^\W\d_]{2}")  # of an instrument's own lines
THOUSANDS = re.compile(r"[-+]?\d{1,3}([.,' ]\d{3})+([.,]\d*)?")
TEXT_SHARE = 0.2  # of entries that are numbers, below which a column holds words [-]
COMMENT = "#%!"
BRACKETS = re.compile(r"^(.*?)\s*[\[(]\s*([^\[\]()]*?)\s*[\])]\s*$")
SPACED = re.compile(r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?")
METRE = "m"
INCH = 0.0254  # [m]
POUND = 4.4482216152605  # force [N]
GRAVITY = 9.80665  # force of a kilogram [N]
SIGNS = {"µ": "u", "μ": "u", "°": "deg", "º": "deg", "²": "2", "⁻¹": "-1"}
FOREIGN = {  # units that no key of the program ends in
    "m": Unit("m"),
    "nm": Unit("nm", 1e-9, METRE),
    "in": Unit("in", INCH, METRE),
    "uin": Unit("uin", 1e-6 * INCH, METRE),
    "rad": Unit("rad"),
    "rev": Unit("rev", 2.0 * math.pi, "rad"),
    "1/s": Unit("1/s", 2.0 * math.pi, "rad/s"),
    "Nm": Unit("N m"),
    "mNm": Unit("mN m", 1e-3, "N m"),
    "uNm": Unit("uN m", 1e-6, "N m"),
    "cNm": Unit("cN m", 1e-2, "N m"),
    "Ncm": Unit("N cm", 1e-2, "N m"),
    "kNm": Unit("kN m", 1e3, "N m"),
    "daN": Unit("daN", 10.0, "N"),
    "lbf": Unit("lbf", POUND, "N"),
    "kgf": Unit("kgf", GRAVITY, "N"),
    "lbfin": Unit("lbf in", POUND * INCH, "N m"),
    "lbfft": Unit("lbf ft", 12.0 * POUND * INCH, "N m"),
    "ozfin": Unit("ozf in", POUND / 16.0 * INCH, "N m"),
    "gfcm": Unit("gf cm", 1e-5 * GRAVITY, "N m"),
    "kgfcm": Unit("kgf cm", 1e-2 * GRAVITY, "N m"),
    "min": Unit("min", 60.0, "s"),
    "%": Unit("%", 0.01),
    "degF": Unit("degF", 5.0 / 9.0, "K", 459.67 * 5.0 / 9.0),
}
OTHER_NAMES = {  # of units, after `_plain`
    **dict.fromkeys(("r/min", "1/min", "/min", "min-1", "min^-1", "U/min", "rev/min"), "rpm"),
    **dict.fromkeys(("degree", "degrees", "Grad", "grd"), "deg"),
    **dict.fromkeys(("micron", "microns", "micrometer", "micrometre"), "um"),
    **dict.fromkeys(("inch", '"'), "in"),
    **dict.fromkeys(("lb", "lbs"), "lbf"),
    "kp": "kgf",
    **dict.fromkeys(("lbin", "inlb", "inlbf", "inlbs"), "lbfin"),
    **dict.fromkeys(("lbft", "ftlb", "ftlbf", "ftlbs"), "lbfft"),
    **dict.fromkeys(("ozin", "inoz", "inozf"), "ozfin"),
    **dict.fromkeys(("gcm", "pcm"), "gfcm"),
    **dict.fromkeys(("kgcm", "kpcm"), "kgfcm"),
    **dict.fromkeys(("degC", "Celsius", "degreesC", "degreesCelsius"), "C"),
    **dict.fromkeys(("degF", "F", "Fahrenheit"), "degF"),
    **dict.fromkeys(("sec", "seconds"), "s"),
    **dict.fromkeys(("rps", "s-1", "rev/s"), "1/s"),
    **dict.fromkeys(("turn", "turns"), "rev"),
    **dict.fromkeys(("Nmm", "N_mm"), "N_mm"),
    **dict.fromkeys(("rad/s", "rad_s"), "rad_s"),
    **dict.fromkeys(("percent", "pct"), "%"),
    **dict.fromkeys(("h", "hours", "hour"), "h"),
}


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """A column of a table, in the units of its file."""

    name: str  # of the header, without the unit; empty without
    unit: str  # as it is written; empty without
    values: Array  # nan where an entry is left out


@dataclass(frozen=True, slots=True, eq=False)
class DataTable:
    """A table of a file."""

    file: str
    columns: tuple[Column, ...]
    lines: tuple[int, ...] = ()  # of the rows of a text, from 1

    @property
    def has_header(self) -> bool:
        """A column has a name or a unit."""
        return any(column.name or column.unit for column in self.columns)

    def row(self, number: int) -> str:
        """Name the place of a row in the file.

        Parameters
        ----------
        number : int
            row, from 0

        Returns
        -------
        str
            text for messages
        """
        return f"line {self.lines[number]}" if self.lines else f"row {number + 1}"


class Quantity(NamedTuple):
    """A quantity that is looked for among the columns of a table."""

    key: str  # as one of a case file: it ends in the unit of columns without one
    words: tuple[str, ...]  # parts of headers that name it
    needed: bool = True


class _Row(NamedTuple):
    line: int  # from 1
    fields: list[str]


def read_table(path: Path) -> DataTable:
    """Read a table of numbers.

    Parameters
    ----------
    path : Path
        text, or .json, .npy, .npz

    Returns
    -------
    DataTable
        its columns, in the units of the file

    Raises
    ------
    DamagedFileError
        with line and column, if it is none; OSError where it cannot be opened
    """
    kind = path.suffix.lower()
    if kind == ".json":
        return _of_document(read_json(path), str(path))
    if kind == ".npz":
        arrays = read_arrays(path)
        return _of_mapping({name: array.ravel() for name, array in arrays.items()}, {}, str(path))
    if kind == ".npy":
        return _of_array(array_of(read_file(path), str(path)), str(path))
    content = read_file(path, LARGEST_TABLE)
    if content.startswith(WORKBOOKS):
        raise DamagedFileError(f"{path}: a workbook or archive; allowed: its sheet saved as CSV")
    return table_of_text(_decoded(content), str(path))


def _decoded(content: bytes) -> str:
    """Text of a file: UTF-8 or 16 by its mark, else UTF-8, else that of Western Windows."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", errors="replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def table_of_text(text: str, name: str) -> DataTable:
    r"""The table of numbers that a text holds.

    Parameters
    ----------
    text : str
        content of the file
    name : str
        name of the file in messages

    Returns
    -------
    DataTable
        its columns

    Raises
    ------
    DamagedFileError
        if it holds none, or an entry is no number, with line and column

    Examples
    --------
    >>> table = table_of_text("Winkel [°];Höhe [µm]\n0;0,5\n180;-0,5\n", "a.csv")
    >>> [(column.name, column.unit, column.values.tolist()) for column in table.columns]
    [('Winkel', '°', [0.0, 180.0]), ('Höhe', 'µm', [0.5, -0.5])]
    """
    lines = text.splitlines()
    separator, decimal = _format(lines)
    rows = [
        _Row(number, _fields(line, separator))
        for number, line in enumerate(lines, 1)
        if line.strip() and line.lstrip()[0] not in COMMENT
    ]
    numbers = [[_number(field, decimal) for field in row.fields] for row in rows]
    width = _width(numbers)
    if width == 0:
        raise DamagedFileError(f"{name}: no rows of numbers")
    words = _word_columns(rows, numbers, width)
    valid = [_is_data(row, width, words) for row in numbers]
    columns = [index for index in range(width) if index not in words]
    if True not in valid:  # a column of what is no number
        some = next(n for n, row in enumerate(numbers) if any(map(_known, row)))
        fault = _fault(rows[some], width, columns, decimal, [""] * width)
        raise DamagedFileError(f"{name}: {fault}")
    entries = [row.fields for row in rows]
    first = _end(valid, entries, decimal)
    last = len(rows) - _end(valid[::-1], entries[::-1], decimal)
    header = _header(lines, rows[first].line, width, separator)
    for row, good in zip(rows[first:last], valid[first:last], strict=True):
        if not good:
            raise DamagedFileError(f"{name}: {_fault(row, width, columns, decimal, header)}")
    _check_thousands(rows[first:last], columns, header, name)
    known = [[row[index] for index in columns] for row in numbers[first:last]]
    values = np.array(known, dtype=np.float64)
    kept = [k for k in range(len(columns)) if not np.isnan(values[:, k]).all()]
    found = tuple(Column(*_name_and_unit(header[columns[k]]), values[:, k]) for k in kept)
    return DataTable(name, found, tuple(row.line for row in rows[first:last]))


def _check_thousands(
    rows: Sequence[_Row], columns: Sequence[int], header: Sequence[str], name: str
) -> None:
    """Refuse 1.000 among whole numbers of three digits and more, which may mean 1000."""
    for index in columns:
        entries = [row.fields[index] for row in rows]
        pointed = [n for n, entry in enumerate(entries) if "." in entry or "," in entry]
        grouped = all(THOUSANDS.fullmatch(entries[n]) and entries[n][0] != "0" for n in pointed)
        if pointed and grouped and any(re.fullmatch(r"\d{3,}", entry) for entry in entries):
            row = rows[pointed[0]]
            fault = _number_fault(row, index, header)
            raise DamagedFileError(f"{name}: {fault}")


def _end(valid: Sequence[bool], rows: Sequence[Sequence[str]], decimal: str) -> int:
    """First row of the table; one of numbers and no words belongs to it, if only by mistake."""
    first = valid.index(True)
    while first and _means_numbers(rows[first - 1], decimal):
        first -= 1
    return first


def _means_numbers(fields: Sequence[str], decimal: str) -> bool:
    """Tell whether a row has a number and no word of an instrument."""
    some = any(_known(_number(field, decimal)) for field in fields)
    return some and not any(WORD.search(field) for field in fields if field[:1] != "#")


def _format(lines: Sequence[str]) -> tuple[str | None, str]:
    """Separator and decimal sign by which most of the entries are numbers."""
    sample = [line for line in lines if line.strip() and line.lstrip()[0] not in COMMENT]
    sample = sample[:SAMPLE]

    def score(separator: str | None, decimal: str) -> float:
        rows = [[_number(field, decimal) for field in _fields(line, separator)] for line in sample]
        width = _width(rows)
        of_width = [row for row in rows if len(row) == width]
        return sum(sum(value is not None for value in row) / width for row in of_width)

    return max(FORMATS, key=lambda form: score(*form))


def _fields(line: str, separator: str | None) -> list[str]:
    line = line.strip("\r\n")
    parts = line.split(separator)
    if separator and '"' in line:
        parts = next(csv.reader([line], delimiter=separator))
    return [field.strip().strip('"').strip() for field in parts]


def _number(field: str, decimal: str) -> float | None:
    """A number, seconds of a time of day or date; nan if left out, None of anything else, as
    1.000 among decimal commas.
    """
    text = field.replace(",", ".") if decimal == "," else field
    try:
        value = float(text)
        if "_" not in text and not math.isnan(value):
            return (
                value if math.isfinite(value) and not (decimal == "," and "." in field) else None
            )
    except ValueError:
        pass
    if field.lower() in NOTHING:
        return math.nan
    clock = CLOCK.fullmatch(DAY_FIRST.sub(r"\3-\2-\1", text))
    if clock is None:
        return None
    try:
        day = datetime.fromisoformat(clock[1]).toordinal() if clock[1] else 0
    except ValueError:  # no day of a calendar
        return None
    hours, minutes, seconds = (float(part or 0.0) for part in clock.groups()[1:])
    return 86400.0 * day + 3600.0 * hours + 60.0 * minutes + seconds


def _width(rows: Sequence[Sequence[float | None]]) -> int:
    """Number of entries of most rows that begin or end with a number; 0 without any."""
    widths = Counter(len(row) for row in rows if any(_known(value) for value in row))
    return max(widths, key=lambda width: (widths[width], width), default=0)


def _known(value: float | None) -> bool:
    return value is not None and not math.isnan(value)


def _word_columns(
    rows: Sequence[_Row], numbers: Sequence[Sequence[float | None]], width: int
) -> set[int]:
    """Columns that hold words, as a remark on each row."""
    of_width = [row for row in zip(rows, numbers, strict=True) if len(row[1]) == width]

    def is_word(row: _Row, values: Sequence[float | None], index: int) -> bool:
        return values[index] is None and bool(WORD.search(row.fields[index]))

    shares = [sum(is_word(*row, index) for row in of_width) for index in range(width)]
    least = (1.0 - TEXT_SHARE) * len(of_width)
    return {index for index, share in enumerate(shares) if share > least}


def _is_data(row: Sequence[float | None], width: int, words: set[int]) -> bool:
    """Tell whether a row holds numbers, one of them at least, but for its words."""
    if len(row) != width:
        return False
    values = [value for index, value in enumerate(row) if index not in words]
    return None not in values and any(_known(value) for value in values)


def _fault(
    row: _Row, width: int, columns: Sequence[int], decimal: str, header: Sequence[str]
) -> str:
    """Say what is wrong with a row between others."""
    if len(row.fields) != width:
        return f"line {row.line} has {len(row.fields)} entries, the others have {width}"
    wrong = [index for index in columns if _number(row.fields[index], decimal) is None]
    if not wrong:
        return f"line {row.line} has no numbers"
    return _number_fault(row, wrong[0], header)


def _number_fault(row: _Row, index: int, header: Sequence[str]) -> str:
    """Say that an entry is no number."""
    title = f" ({header[index]})" if header[index] else ""
    found = visible(row.fields[index][:40])
    allowed = "a number" + ", without a sign of thousands" * bool(THOUSANDS.fullmatch(found))
    return f"line {row.line}, column {index + 1}{title}: found {found!r}; allowed: {allowed}"


def _header(lines: Sequence[str], first: int, width: int, separator: str | None) -> list[str]:
    """Header of each column: the line before the first row, or two, the second one of units."""
    above = [line.strip() for line in lines[: first - 1] if line.strip(COMMENT + " \t")]
    fitting = [len(_fields(line, separator)) == width for line in above]
    # remarks between a header and its numbers
    while separator and above and above[-1][0] in COMMENT and not fitting.pop() and any(fitting):
        above.pop()
    before = [line.lstrip(COMMENT).strip() for line in above][-2:]
    split = [_names(line, width, separator) for line in before]
    if not split or split[-1] is None:
        return [""] * width
    last = split[-1]
    units = all(not name or _unit(name.strip("[]()")) is not None for name in last)
    if units and len(split) == 2 and split[0] is not None:
        return [f"{name} [{of.strip('[]()')}]" for name, of in zip(split[0], last, strict=True)]
    return last


def _names(line: str, width: int, separator: str | None) -> list[str] | None:
    """Names of columns in a line; None where it has another number of them."""
    ways = [_fields(line, separator), SPACED.findall(line)]
    ways += [_fields(line, other) for other in (";", "\t", ",")]
    ways.append([part.strip() for part in re.split(r"\s{2,}|\t", line)])
    return next(([visible(name) for name in way] for way in ways if len(way) == width), None)


def _name_and_unit(header: str) -> tuple[str, str]:
    """Name and unit: in brackets, after a slash or "in", or the last words as in a key."""
    found = BRACKETS.match(header)
    if found:
        return found[1].strip(), found[2]
    for sign in ("/", " in ", ","):
        name, _, text = header.rpartition(sign)
        if name and _unit(text) is not None:
            return name.strip(), text.strip()
    if unit_of_key(header) is not NO_UNIT:
        name = without_unit(header)
        return name, header[len(name) + 1 :]
    name, _, text = header.rpartition("_")
    if name and text in FOREIGN and text != "min":  # as in h_min
        return name, text
    words = header.split()
    for first in range(1, len(words)):  # the longest unit, as in "torque N mm"
        text = " ".join(words[first:])
        if _unit(text) not in (None, NO_UNIT) and text not in ("min", "in"):
            return " ".join(words[:first]), text
    return ("", header) if header and _unit(header) is not None else (header, "")


def _plain(text: str) -> str:
    """A unit without spaces and signs of multiplication, in letters of ASCII."""
    for sign, letters in SIGNS.items():
        text = text.replace(sign, letters)
    return re.sub(r"[\s*·.•⋅∙×]|-(?=[A-Za-z])", "", text)


def _unit(text: str) -> Unit | None:
    """The unit that a text names; None of any other text."""
    plain = _plain(text)
    if plain in ("-", "1", ""):
        return NO_UNIT
    spelled = {name.lower(): name for name in (*OTHER_NAMES, *FOREIGN, *UNITS)}
    for name in (plain, spelled.get(plain.lower(), "")):
        name = OTHER_NAMES.get(name, name)
        known = FOREIGN.get(name) or UNITS.get(name)
        if known is not None:
            return known
    return None


def _of_document(document: Any, name: str) -> DataTable:
    """Table of a JSON document: rows, records, or columns by name."""
    units = document.get("units", {}) if isinstance(document, dict) else {}
    if isinstance(document, dict) and "data" in document:
        names = document.get("columns") or document.get("header")
        rows = document["data"]
        if isinstance(names, list) and isinstance(rows, list):
            if not all(isinstance(row, list) for row in rows):
                raise DamagedFileError(f"{name}: data are no rows")
            rows = [dict(zip(map(str, names), row, strict=False)) for row in rows]
        document = rows
    elif isinstance(document, dict):
        document = {key: value for key, value in document.items() if isinstance(value, list)}
        return _of_mapping(document, units, name)
    if isinstance(document, list) and document and all(isinstance(row, dict) for row in document):
        names = list(document[0])
        missing = next((n for n, row in enumerate(document) if list(row) != names), None)
        if missing is not None:
            raise DamagedFileError(f"{name}: row {missing + 1} has other names than the first")
        return _of_mapping({key: [row[key] for row in document] for key in names}, units, name)
    return _of_array(_numbers(document, name), name)


def _of_mapping(columns: dict[str, Any], units: Any, name: str) -> DataTable:
    values = {key: _numbers(entries, f"{name}: {key}") for key, entries in columns.items()}
    if not values or len({entries.shape for entries in values.values()}) > 1:
        raise DamagedFileError(f"{name}: no columns of one length")
    found = []
    for key, entries in values.items():
        title, unit = _name_and_unit(key)
        given = units.get(key, unit) if isinstance(units, dict) else unit
        found.append(Column(title, str(given), entries))
    return DataTable(name, tuple(found))


def _numbers(entries: Any, name: str) -> Array:
    """Numbers of a document; nan where an entry is null."""
    try:
        values = np.array(entries, dtype=np.float64)
    except (TypeError, ValueError):
        raise DamagedFileError(
            f"{name}: not all entries are numbers in rows of one length"
        ) from None
    return values


def _of_array(values: Array, name: str) -> DataTable:
    """Table of an array: a column, rows, or, where these are fewer, columns."""
    if values.ndim not in (1, 2) or values.size == 0 or values.dtype.kind not in "fiub":
        raise DamagedFileError(f"{name}: an array of the shape {values.shape} is no table")
    rows = np.asarray(values, dtype=np.float64).reshape(values.shape[0], -1)
    rows = rows.T if rows.shape[0] < rows.shape[1] else rows
    return DataTable(name, tuple(Column("", "", rows[:, k]) for k in range(rows.shape[1])))


def columns_of(table: DataTable, wanted: Sequence[Quantity]) -> dict[str, Array]:
    """Quantities of a table in SI, by headers and units; without a header in their order.

    Parameters
    ----------
    table : DataTable
        the table
    wanted : sequence of Quantity
        quantities looked for

    Returns
    -------
    dict[str, Array]
        values in SI by key; a quantity that is not needed may be absent

    Raises
    ------
    DamagedFileError
        if one that is needed is not there, or stands in a unit that it has not
    """
    if not table.has_header:
        needed = sum(one.needed for one in wanted)
        if not needed <= len(table.columns) <= len(wanted):
            names = ", ".join(one.key for one in wanted)
            have = f"{len(table.columns)} columns without header"
            raise DamagedFileError(f"{table.file}: {have}; allowed: {names}")
        spare = [one for one in wanted if not one.needed][len(table.columns) - needed :]
        pairs = zip((one for one in wanted if one not in spare), table.columns, strict=True)
        return {one.key: _in_si(column, one, table.file) for one, column in pairs}
    found: dict[str, Column] = {}
    for choose in (_by_name, _by_word, _without_unit, _by_unit, _of_wrong_unit):
        lacking = [one for one in wanted if one.key not in found]
        found |= choose(lacking, [c for c in table.columns if c not in found.values()], table.file)
    missing = [one.key for one in wanted if one.needed and one.key not in found]
    if missing:
        have = ", ".join(_title(column) for column in table.columns)
        raise DamagedFileError(f"{table.file}: no column {missing[0]}; its columns: {have}")
    return {one.key: _in_si(found[one.key], one, table.file) for one in wanted if one.key in found}


def _title(column: Column) -> str:
    return f"{column.name} [{column.unit}]" if column.unit else column.name or "(no name)"


def _by_name(
    wanted: Sequence[Quantity], columns: Sequence[Column], file: str
) -> dict[str, Column]:
    """Columns whose name is that of the key, in a unit that fits."""

    def rank(column: Column, one: Quantity) -> int | None:
        same = column.name.lower().replace("_", " ") == without_unit(one.key)
        return 0 if same and (not column.unit or fits(column, one)) else None

    return _chosen(wanted, columns, rank, file)


def _by_word(
    wanted: Sequence[Quantity], columns: Sequence[Column], file: str
) -> dict[str, Column]:
    """Columns whose name holds a word and whose unit fits."""
    fitting = [column for column in columns if column.unit]

    def rank(column: Column, one: Quantity) -> int | None:
        return _rank(column, one) if fits(column, one) else None

    return _chosen(wanted, fitting, rank, file)


def _without_unit(
    wanted: Sequence[Quantity], columns: Sequence[Column], file: str
) -> dict[str, Column]:
    """Columns without a unit whose name holds a word."""
    return _chosen(wanted, [column for column in columns if not column.unit], _rank, file)


def _by_unit(
    wanted: Sequence[Quantity], columns: Sequence[Column], file: str
) -> dict[str, Column]:
    """Columns without the name of another quantity that alone have a unit that fits."""
    free = [c for c in columns if c.unit and all(_rank(c, one) is None for one in wanted)]
    fitting = {one.key: [c for c in free if fits(c, one)] for one in wanted}
    found: dict[str, Column] = {}
    for key, some in fitting.items():
        if len(some) == 1 and some[0] not in found.values():
            found[key] = some[0]
    return found


def _of_wrong_unit(
    wanted: Sequence[Quantity], columns: Sequence[Column], file: str
) -> dict[str, Column]:
    """Columns whose name holds a word, which are told of their unit."""
    return _chosen(wanted, columns, _rank, file)


def _rank(column: Column, one: Quantity) -> int | None:
    """Number of the first word of a quantity in the name of a column; None without one."""
    name = column.name.lower()
    return next((n for n, word in enumerate(one.words) if word in name), None)


def _chosen(
    wanted: Sequence[Quantity],
    columns: Sequence[Column],
    rank: Callable[[Column, Quantity], int | None],
    file: str,
) -> dict[str, Column]:
    """Each quantity with the column of the lowest rank, each column with one quantity."""
    ranks = {(i, k): rank(c, one) for i, one in enumerate(wanted) for k, c in enumerate(columns)}
    pairs = sorted((number, i, k) for (i, k), number in ranks.items() if number is not None)
    chosen: dict[int, int] = {}  # quantity: its column
    for _, i, k in pairs:
        if i not in chosen and k not in chosen.values():
            chosen[i] = k
    for i, k in chosen.items():
        rivals = [other for other in range(len(columns)) if other not in chosen.values()]
        rivals = [other for other in rivals if ranks[i, other] == ranks[i, k]]
        if rivals:
            names = " and ".join(_title(columns[other]) for other in (k, rivals[0]))
            key = wanted[i].key
            raise DamagedFileError(
                f"{file}: columns {names}, each of which may be {key}; allowed: one of them, or "
                f"one with the name {without_unit(key)!r}"
            )
    return {wanted[i].key: columns[k] for i, k in chosen.items()}


def fits(column: Column, one: Quantity) -> bool:
    """Tell whether the unit of a column, which has one, is of the kind of a quantity's.

    Parameters
    ----------
    column : Column
        the column
    one : Quantity
        the quantity

    Returns
    -------
    bool
        False without a unit
    """
    unit = _unit(column.unit)
    return unit is not None and _base(unit) == _base(unit_of_key(one.key))


def _base(unit: Unit) -> str:
    return unit.base or ("" if unit.text == "%" else unit.text)


def _in_si(column: Column, one: Quantity, file: str) -> Array:
    """Values in SI, by the unit of the header or that of the key."""
    unit = _unit(column.unit) if column.unit else unit_of_key(one.key)
    if unit is None or _base(unit) != _base(unit_of_key(one.key)):
        wanted = unit_of_key(one.key).text or "no unit"
        raise DamagedFileError(
            f"{file}: column {_title(column)}: the unit is none of {one.key}; allowed: {wanted}, "
            "or a multiple of it"
        )
    infinite = np.flatnonzero(np.isinf(column.values))
    if infinite.size:
        raise DamagedFileError(f"{file}, row {infinite[0] + 1}: {_title(column)} is infinite")
    return column.values * unit.si + unit.zero

"""A design is the text of a case file; its history, its address, its changes key by key."""

import base64
import json
import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, quote, unquote

from oilfilm.ehl.foreign_files import DamagedFileError, parse_json

from ..batch.keys import value_in
from ..format.changes import alternatives, case_path
from ..format.document import check_document, parse, read_text
from ..format.rules import CaseError, CaseProblem, key_lines
from ..format.shaft_case import any_case_of_document
from ..format.shipped import find_case, shipped_cases
from ..new_case import FirstOperation, case_of_designation

LONGEST_ADDRESS = 20_000  # characters
LONGEST_TEXT = 100_000  # of a case in an address
MOST_STATES = 200  # that can be undone
OWN = "z="  # an address with the whole text of a case
# keys that name files of this computer, which an address must not open
FILES = (
    *("measured", "load_spectrum", "form", "traction_table", "friction_table", "table"),
    *("frequency_response", "housing", "file"),
)
NO_FILES = "an address cannot name files; open the case file instead"
REMARK = re.compile(r"#\s*(?:given; )?(.*?),\s*([-+.\deE]+) to ([-+.\deE]+)\s*$")
VALUE = re.compile(r"""^(\s*[\w"']+\s*=\s*)("(?:[^"\\]|\\.)*"|[^#\n]*?)(\s*(?:#.*)?)$""")


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """The text of a case, and the shipped case or bearing that it began with, if any."""

    text: str
    base: str = ""  # name of a shipped case, or a designation; empty: a file of the user

    @property
    def document(self) -> dict[str, Any]:
        """Tables of the case, as in its file."""
        return parse(self.text, "case")

    @property
    def is_shaft(self) -> bool:
        """A shaft on its bearings, not one bearing."""
        return "shaft" in self.document

    def problems(self) -> list[CaseProblem]:
        """Everything that is wrong with the case, as `oilfilm validate` finds it."""
        document = self.document
        if "contact" in document:
            return [CaseProblem((), "a contact", "allowed: a case with [bearing] or [shaft]")]
        if "shaft" not in document:
            return check_document(document)[1]
        try:  # its bearings are cases of their own
            any_case_of_document(document)
        except CaseError as error:
            return list(error.problems) or [CaseProblem((), str(error))]
        return []

    def with_value(self, key: str, value: Any) -> "Design":
        """The design with another value of a key; None takes the key out.

        Parameters
        ----------
        key : str
            Dotted name, as operation.radial_load_N or load.0.force_N.1.
        value : Any
            Number, text or truth value in the unit of the key.

        Returns
        -------
        Design
            The changed design, the value no longer among the assumed ones.
        """
        text = self.text
        *_, last = case_path(key)
        if isinstance(last, int):  # an entry of a vector
            key = key.rpartition(".")[0]
            vector = list(value_in(self.document, key) or (0.0, 0.0, 0.0))
            vector[last] = 0.0 if value is None else value
            value = vector
        for table, other, _ in list(alternatives(self.document, [key])):
            text = _changed(text, f"{table}.{other}", None)
        text = _changed(text, key, value)
        lines = [line for line in text.splitlines() if line.strip().rstrip(",") != f'"{key}"']
        return replace(self, text="\n".join(lines) + "\n")

    def ranges(self) -> dict[str, tuple[float, float]]:
        """Ranges of estimates and typical values, as the comments of the file give them."""
        found = {}
        lines = self.text.splitlines()
        for path, number in key_lines(self.text).items():
            remark = REMARK.search(lines[number - 1])
            if remark and len(path) == 2:
                found[".".join(map(str, path))] = (float(remark[2]), float(remark[3]))
        return found

    def remarks(self) -> dict[str, str]:
        """Comments beside values, such as `estimated` or `typical`, by key."""
        lines = self.text.splitlines()
        found = {}
        for path, number in key_lines(self.text).items():
            comment = lines[number - 1].partition("#")[2].strip()
            if comment and len(path) == 2:
                found[".".join(map(str, path))] = comment
        return found

    def changes(self) -> tuple[dict[str, Any], list[str]]:
        """Values by key that differ from those of the base, and keys of the base that are gone."""
        before = flat(start(self.base).document)
        now = flat(self.document)
        changed = {k: v for k, v in now.items() if before.get(k) != v and k != "assumed"}
        return changed, [key for key in before if key not in now]

    def address(self) -> str:
        """The design as the part of an address behind `#`: its base and what differs from it."""
        if self.base and not self.is_shaft:
            changed, gone = self.changes()
            every = (changed | dict.fromkeys(gone)).items()
            values = "&".join(f"{k}={quote(json.dumps(v))}" for k, v in every)
            return quote(self.base) + (f"&{values}" if values else "")
        packed = zlib.compress(self.text.encode(), 9)
        return OWN + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def of_address(address: str) -> Design:
    """The design of an address.

    Parameters
    ----------
    address : str
        What stands behind `#`.

    Returns
    -------
    Design
        The design.

    Raises
    ------
    CaseError
        If the address is too long, damaged, or names files of this computer.
    """
    if len(address) > LONGEST_ADDRESS:
        raise CaseError(f"the address is longer than {LONGEST_ADDRESS} characters")
    if address.startswith(OWN):
        design = Design(text=_unpacked(address.removeprefix(OWN)))
        _refuse_files(design.document)
        return design
    base, _, values = address.partition("&")
    name = unquote(base)
    if name not in shipped_cases() and (name.endswith(".toml") or Path(name).exists()):
        raise CaseError(NO_FILES)
    design = start(name)
    for key, value in parse_qsl(values):
        try:
            design = design.with_value(key, parse_json(value, key[:60]))
        except (ValueError, DamagedFileError):
            raise CaseError(f"the address is damaged at {key[:60]}") from None
    if values:
        _refuse_files(design.document, flat(start(design.base).document))
    return design


def _unpacked(text: str) -> str:
    """The text of a case from an address, as long as a case may be."""
    unpacker = zlib.decompressobj()
    try:
        packed = base64.urlsafe_b64decode(text + "=" * (-len(text) % 4))
        content = unpacker.decompress(packed, LONGEST_TEXT).decode()
    except (ValueError, zlib.error):
        raise CaseError("the address is damaged") from None
    if unpacker.unconsumed_tail:
        raise CaseError(f"the case in the address has more than {LONGEST_TEXT} characters")
    return content


def _refuse_files(document: Mapping[str, Any], known: Mapping[str, Any] | None = None) -> None:
    """`CaseError` where a document from an address names files that its base does not."""
    for key, value in flat(document).items():
        named = set(FILES).intersection(key.split(".")) and not isinstance(value, int | float)
        if named and (known or {}).get(key) != value:
            raise CaseError(f"{key}: {NO_FILES}")


def start(name: str, operation: FirstOperation | None = None) -> Design:
    """The design of a case file, a shipped case, or a bearing by its designation.

    Parameters
    ----------
    name : str
        Name or file of a case, or a designation as 6306-2Z/C3.
    operation : FirstOperation | None, optional
        Speed and loads of a new case.

    Returns
    -------
    Design
        The design.

    Raises
    ------
    CaseError
        If the name is neither.
    """
    path = Path(name)
    if name in shipped_cases() or path.suffix == ".toml" or path.is_file():
        shipped = name in shipped_cases()
        return Design(text=read_text(find_case(name)), base=name if shipped else "")
    try:
        text = case_of_designation(name, operation or FirstOperation())
    except ValueError as error:
        raise CaseError(str(error)) from None
    return Design(text=text, base="" if operation else name)


def flat(document: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Values of a document by their dotted names.

    Parameters
    ----------
    document : Mapping[str, Any]
        Tables.
    before : str, default ""
        Name of the table with a dot.

    Returns
    -------
    dict[str, Any]
        Value by name; lists are values.
    """
    found: dict[str, Any] = {}
    for key, value in document.items():
        if isinstance(value, dict):
            found |= flat(value, f"{before}{key}.")
        else:
            found[f"{before}{key}"] = value
    return found


def _changed(text: str, key: str, value: Any) -> str:
    """The text with another value of a key, its line and comment kept where there is one."""
    path = case_path(key)
    name = path[-1]
    table = key.rpartition(".")[0]
    lines = text.splitlines()
    known = key_lines(text)
    if path in known:
        at = known[path] - 1
        while "[" in lines[at] and "]" not in lines[at]:  # a vector on several lines
            lines[at] += lines.pop(at + 1)
        if value is None:
            del lines[at]
        else:
            lines[at] = VALUE.sub(
                lambda m: f"{m[1]}{_toml(value)}{_own_remark(m[3])}".rstrip(), lines[at]
            )
        return "\n".join(lines) + "\n"
    if value is None:
        return text
    line = f"{name} = {_toml(value)}"
    if path[:-1] in known:
        at = max(number for one, number in known.items() if one[: len(path) - 1] == path[:-1])
        lines.insert(at, line)
    elif table:
        lines += ["", f"[{table}]", line]
    else:
        lines.insert(0, line)
    return "\n".join(lines) + "\n"


def _own_remark(comment: str) -> str:
    """The comment beside a value that the user has changed: of an estimate its range alone."""
    remark = REMARK.search(comment)
    if remark is not None:
        return f"  # given; {remark[1] or 'range'}, {remark[2]} to {remark[3]}"
    words = comment.strip("# ").partition(":")[0]
    return "" if words.startswith(("chosen", "assumed", "typical")) else comment


def _toml(value: Any) -> str:
    """A scalar or a list of scalars as TOML, which they have in common with JSON."""
    return json.dumps(value, ensure_ascii=False)


@dataclass(slots=True)
class History:
    """Designs one after the other; moves of one control in quick succession are one step."""

    states: list[Design]
    at: int = 0
    last: tuple[str, float] = field(default=("", -1e9))  # key and time of the last change [s]

    @property
    def now(self) -> Design:
        """The design that is shown."""
        return self.states[self.at]

    def push(self, design: Design, key: str, time: float) -> None:
        """Add a design after the one that is shown; what was undone is gone.

        Parameters
        ----------
        design : Design
            The new design.
        key : str
            Key that was changed; empty where it is another bearing.
        time : float
            Time of the change [s].
        """
        together = bool(key) and key == self.last[0] and time - self.last[1] < 1.0 and self.at > 0
        self.states = [*self.states[: self.at if together else self.at + 1], design]
        self.states = self.states[-MOST_STATES:]
        self.at = len(self.states) - 1
        self.last = (key, time)

    def step(self, by: int) -> bool:
        """Undo or redo.

        Parameters
        ----------
        by : int
            -1 or 1.

        Returns
        -------
        bool
            There was such a state.
        """
        if not 0 <= self.at + by < len(self.states):
            return False
        self.at += by
        self.last = ("", -1e9)
        return True

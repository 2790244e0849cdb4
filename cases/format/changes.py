"""A case's document with other values of some keys.

A value takes the place of its alternatives: a kinematic viscosity that of a dynamic one, a contact
angle that of a clearance.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any

from .bearing import CLEARANCE
from .lubricant import VISCOSITIES
from .rules import CaseError, CaseProblem, KeyPath

NAMED = ("materials", "lubricants")  # tables whose keys stand below a name
# keys of a table that say the same quantity
ROWS = {
    "bearing": ((*CLEARANCE, "clearance_class"),),
    "fit": (
        ("inner_ring_interference_um", "shaft_tolerance"),
        ("outer_ring_interference_um", "housing_tolerance"),
    ),
    "lubricant": (VISCOSITIES,),
}
Alternative = tuple[str, str, str]  # table and key that give way, and the key they give way to


@lru_cache(maxsize=4096)
def case_path(key: str) -> KeyPath:
    """Table and key of a dotted name; names of materials and oils may contain dots themselves.
    Numbers count the tables of a list, from 0, and the entries of one.

    Parameters
    ----------
    key : str
        Dotted name, as operation.radial_load_N or load.0.force_N.1.

    Returns
    -------
    tuple[str or int, ...]
        The path in a document.
    """
    table, dot, name_in_table = key.partition(".")
    if not dot:  # a whole table or list, or a key above the tables
        return (table,)
    if table in NAMED or (table == "bearing" and "." in name_in_table):  # one of a shaft's
        name, _, last = name_in_table.rpartition(".")
        return table, name, last
    parts = [int(part) if part.isdecimal() else part for part in name_in_table.split(".")]
    numbered = any(isinstance(part, int) for part in parts)
    return (table, *parts) if numbered else (table, name_in_table)


def alternatives(
    base: Mapping[str, Any], keys: Sequence[str], *, near: bool = False
) -> Iterator[Alternative]:
    """Keys of a case that give way to others.

    Parameters
    ----------
    base : Mapping[str, Any]
        Document of the case.
    keys : Sequence[str]
        Dotted names of the keys that take their place.
    near : bool, default False
        True: values near those of the case, which leave a temperature self-heated.

    Yields
    ------
    Iterator[Alternative]
        Table and key that give way, and the key that they give way to.
    """
    paths = [case_path(key) for key in keys]
    for table, rows in ROWS.items():
        given = base.get(table)
        given = given if isinstance(given, dict) else {}
        own = [key for path in paths if path[0] == table for key in path[1:2]]
        for row in rows:
            first = next((key for key in own if key in row), None)
            if first is not None:
                others = (key for key in row if key in given and key not in own)
                yield from ((table, key, first) for key in others)
    operation = base.get("operation")
    if not near and isinstance(operation, dict):
        own = [key for path in paths if path[0] == "operation" for key in path[1:2]]
        # self-heating finds the temperature itself
        if "temperature_C" in own and "temperature" in operation and "temperature" not in own:
            yield "operation", "temperature", "temperature_C"


def changed_document(
    base: Mapping[str, Any], values: Iterable[tuple[str, Any]], gone: Iterable[Alternative]
) -> dict[str, Any]:
    """The document with other values; tables that stay unchanged are those of the base.

    Parameters
    ----------
    base : Mapping[str, Any]
        Document of a case.
    values : Iterable[tuple[str, Any]]
        Dotted names and values; None takes the key out.
    gone : Iterable[Alternative]
        What gives way, from `alternatives`.

    Returns
    -------
    dict[str, Any]
        The changed document.

    Raises
    ------
    CaseError
        If a list has no such entry.
    """
    document = dict(base)
    for name, value in values:
        node: Any = document
        *tables, key = path = case_path(name)
        for table, following in zip(tables, path[1:], strict=True):
            entry: Any = table  # a number of a list
            inner = node[entry] if isinstance(node, list) else node.get(table)
            if isinstance(following, int):
                inner = list(inner) if isinstance(inner, list | tuple) else []
                if following >= len(inner):
                    fault = CaseProblem(path, f"the case has no entry {following} of {table}")
                    raise CaseError([fault.text(name, {})], [fault])
            else:
                inner = dict(inner) if isinstance(inner, dict) else {}
            node[table] = inner
            node = inner
        node[key] = value
        if value is None:
            del node[key]
    for table, key, _ in gone:
        value = document[table].pop(key)
        if key == CLEARANCE[1]:  # the rating life still needs it
            document[table].setdefault("nominal_contact_angle_deg", value)
    return document


def without_computed(document: dict[str, Any]) -> dict[str, Any]:
    """Tables of a case as run without the values that follow from the others.

    A run lists them under `computed`: a lubricant's at the temperature of the operation, materials
    of the library.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case, as in a file or in `Case.document`.

    Returns
    -------
    dict[str, Any]
        The tables without these values and without the list.
    """
    listed = document.get("computed", ())
    document = {key: value for key, value in document.items() if key != "computed"}
    for name in listed if isinstance(listed, list | tuple) else ():
        table, _, key = str(name).partition(".")
        document[table] = _without_key(document.get(table), key)
    return document


def _without_key(table: Any, key: str) -> Any:
    """A table without a key, which may be one of a table in it, NAME.key."""
    if not isinstance(table, dict) or key in table:
        return {k: v for k, v in table.items() if k != key} if isinstance(table, dict) else table
    name, _, last = key.rpartition(".")
    return {**table, name: _without_key(table[name], last)} if name in table else table

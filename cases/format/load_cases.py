"""[[load_cases]]: states of a duty cycle, each like [operation] but for the keys that it gives."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from pydantic import create_model
from pydantic.fields import FieldInfo

from .fields import Table, above, is_number
from .operation import RELATIONS as OF_OPERATION
from .operation import OperationTable
from .rules import CaseProblem, CaseValues, Excludes, KeyPath, dotted

NAME = "load_cases"
LEAST_SUM = 0.99  # of the shares [-]; they are then scaled to a sum of 1
LARGEST_SUM = 1.01
RELATIONS: tuple[Excludes, ...] = ()


def _as_operation(table: type[Table]) -> type[Table]:
    """A table with the keys of [operation] behind its own, left out by default."""
    fields: dict[str, Any] = {}
    for key, field in OperationTable.model_fields.items():
        optional = FieldInfo.merge_field_infos(field, default=None)
        kind: Any = field.annotation
        fields[key] = (kind if kind is Any else kind | None, optional)
    return create_model(table.__name__, __base__=table, __doc__=table.__doc__, **fields)


@_as_operation
class LoadCaseTable(Table):
    """One state of a duty cycle, for life, torque and energy over the cycle. Keys left out are
    those of [operation].
    """

    share: float = above(0, 1, "of the time; those of all load cases sum to 1", ...)


EXCLUDED = [rule for rule in OF_OPERATION if isinstance(rule, Excludes)]


def merged(operation: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    """Keys of [operation], replaced by those of a load case.

    A key that excludes another removes it, as `force_N` of a load case removes `radial_load_N`.

    Parameters
    ----------
    operation : dict[str, Any]
        Keys of [operation].
    own : dict[str, Any]
        Keys of the load case.

    Returns
    -------
    dict[str, Any]
        The keys of its operation.
    """
    # a temperature of its own is that of the load case, where [operation] warms itself, too
    gone = {"temperature"} if "temperature_C" in own else set()
    for rule in EXCLUDED:
        pair = [path.partition(".")[2] for path in (rule.key, rule.other)]
        for key, other in (pair, reversed(pair)):
            if key in own and other not in own:
                gone.add(other)
    kept = {key: value for key, value in operation.items() if key not in gone}
    return kept | {key: value for key, value in own.items() if key != "share"}


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of load cases: shares that do not sum to 1.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    tables = dict(load_case_tables(values))
    shares = [table.get("share") for table in tables.values()]
    numbers = [share for share in shares if is_number(share)]
    if tables and len(numbers) == len(shares):
        total = sum(numbers)
        if not LEAST_SUM <= total <= LARGEST_SUM:
            finding = f"found shares that sum to {total:.6g}"
            yield CaseProblem((NAME,), finding, "allowed: a sum of 1")


def load_case_tables(values: CaseValues) -> Iterator[tuple[int, dict[str, Any]]]:
    """Number from 0 and valid keys of every load case; none if the list is wrong.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[tuple[int, dict[str, Any]]]
        Pairs of number and keys.
    """
    tables = values.get(NAME)
    for index, table in enumerate(tables if isinstance(tables, list | tuple) else ()):
        if isinstance(table, dict) and (NAME, index) not in values.faulty:
            valid = (NAME, index)
            yield index, {k: v for k, v in table.items() if (*valid, k) not in values.faulty}


def with_load_case(values: CaseValues, own: dict[str, Any]) -> CaseValues:
    """The document with a load case in the place of [operation].

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.
    own : dict[str, Any]
        Keys of the load case.

    Returns
    -------
    CaseValues
        The valid values of the changed document.
    """
    document = {key: value for key, value in values.document.items() if key != NAME}
    operation = values.get("operation")
    given = operation if isinstance(operation, dict) else {}
    faulty = frozenset(path for path in values.faulty if path[-1] not in own)
    return CaseValues({**document, "operation": merged(given, own)}, faulty)


def load_case_problem(fault: CaseProblem, index: int, own: dict[str, Any]) -> CaseProblem:
    """A problem of the merged document, at the key of the load case or at its table.

    Parameters
    ----------
    fault : CaseProblem
        The problem.
    index : int
        Number of the load case, from 0 [-].
    own : dict[str, Any]
        Keys of the load case.

    Returns
    -------
    CaseProblem
        The problem with the path of the file.
    """
    here: KeyPath = (NAME, index)
    key = fault.path[-1]
    if fault.path[0] == "operation" and key in own:
        return replace(fault, path=(*here, key))
    finding = f"{dotted(fault.path)}: {fault.finding}"
    return replace(fault, path=here, finding=finding)


def load_case_files(
    operation: OperationTable, tables: tuple[Any, ...] | None
) -> tuple[tuple[float, OperationTable], ...]:
    """Share of the time and operation of every load case.

    Parameters
    ----------
    operation : OperationTable
        The checked table [operation].
    tables : tuple[Any, ...] | None
        The checked load cases.

    Returns
    -------
    tuple[tuple[float, OperationTable], ...]
        Shares [-], scaled to a sum of 1, and tables.
    """
    own = [table.model_dump(exclude_none=True) for table in tables or ()]
    base = operation.model_dump(exclude_none=True)
    total = sum(keys["share"] for keys in own)
    return tuple(
        (keys["share"] / total, OperationTable.model_validate(merged(base, keys))) for keys in own
    )

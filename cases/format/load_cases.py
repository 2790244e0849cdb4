"""[[load_cases]]: states of a duty cycle, each like [operation] but for the keys that it gives."""

import warnings
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import create_model
from pydantic.fields import FieldInfo

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.table_files import Quantity
from oilfilm.ehl.units import from_si

from .data_tables import case_columns
from .fields import Table, above, is_number, rounded, validated
from .operation import RELATIONS as OF_OPERATION
from .operation import OperationTable
from .rules import CaseProblem, CaseValues, Excludes, InvalidKeyError, KeyPath, dotted

NAME = "load_cases"
LEAST_SUM = 0.99  # of the shares [-]; they are then scaled to a sum of 1
LARGEST_SUM = 1.01
RELATIONS = (Excludes("load_spectrum", NAME),)
SPECTRUM = (  # columns of a load spectrum
    Quantity("share_share", ("share", "anteil", "fraction", "weight", "probab"), needed=False),
    Quantity("duration_s", ("duration", "dauer", "hours"), needed=False),
    Quantity("time_s", ("time", "zeit"), needed=False),
    # an angle, which a header "turns" has; their ratios alone count
    Quantity("turns_deg", ("turn", "revol", "cycle", "umdreh", "count"), needed=False),
    Quantity(
        "radial_load_N", ("radial", "f_r", "fr", "load", "last", "force", "kraft"), needed=False
    ),
    Quantity("axial_load_N", ("axial", "thrust", "f_a", "fa"), needed=False),
    Quantity("inner_speed_rpm", ("speed", "drehzahl", "rpm"), needed=False),
    Quantity("temperature_C", ("temp",), needed=False),
)
OF_STATE = SPECTRUM[4:]
MOST_STATES = 40  # of a spectrum, beyond which equal levels are counted together
LEVELS = {"radial_load_N": 12, "axial_load_N": 5, "inner_speed_rpm": 5, "temperature_C": 3}
IDLE_SHARE = 1e-3  # of the largest load, below which a state has none [-]
LIFE_POWER = 3.0  # of the load in the damage of a ball bearing, ISO 281 [-]


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


def spectrum_tables(file: str) -> tuple[Any, ...]:
    """Load cases of a file: the states it lists, or those that are counted over time.

    Each turn of a bearing is a cycle of its load, so that a course over time is counted by the
    time at each level of load and speed, not by rainflow.

    Parameters
    ----------
    file : str
        The file, a path from the working directory.

    Returns
    -------
    tuple[Any, ...]
        Checked tables of load cases.

    Raises
    ------
    InvalidKeyError
        If it is no load spectrum.
    """
    key = ("load_spectrum",)
    allowed = (
        "allowed: columns of load and speed, as 'radial load [kN]' and 'speed [rpm]', with share "
        "[%], duration [h] or time [s]"
    )
    columns = case_columns(key, file, SPECTRUM, allowed)
    states = {
        one.key: from_si(one.key, columns[one.key]) for one in OF_STATE if one.key in columns
    }
    if not {"radial_load_N", "axial_load_N"} & states.keys():
        raise InvalidKeyError(key, f"{file}: no column of a load", allowed)
    share, how = _shares(key, file, columns, allowed)
    count = share.size
    if count > MOST_STATES:
        states, share = _counted(states, share)
        how += f", counted into {share.size} levels of load and speed (each turn is a load cycle)"
    warnings.warn(f"load_spectrum: {file}: {count} rows, {how}", stacklevel=2)
    tables = []
    for number, time_share in enumerate(share):
        if time_share <= 0.0:
            continue
        row = {name: rounded(float(values[number])) for name, values in states.items()}
        table, problems = validated(LoadCaseTable, {"share": float(time_share), **row})
        if table is None:
            raise InvalidKeyError(key, f"{file}: {problems[0].finding}", problems[0].allowed)
        tables.append(table)
    return tuple(tables)


def _shares(key: KeyPath, file: str, columns: dict[str, Array], allowed: str) -> tuple[Array, str]:
    """Share of the time of each row, and how it was found."""
    if SPECTRUM[0].key in columns:
        share = columns[SPECTRUM[0].key]
        total = float(share.sum())
        scale = 0.01 if 100.0 * LEAST_SUM <= total <= 100.0 * LARGEST_SUM else 1.0
        if (share < 0.0).any() or not LEAST_SUM <= scale * total <= LARGEST_SUM:
            finding = f"{file}: shares of {share.min():.4g} and more that sum to {total:.6g}"
            raise InvalidKeyError(key, finding, "allowed: a sum of 1, or of 100 %")
        return share / total, "by their share"
    if "duration_s" in columns:
        time = columns["duration_s"]
        if (time < 0.0).any() or not time.sum() > 0.0:
            raise InvalidKeyError(key, f"{file}: a duration below 0", allowed)
        return time / time.sum(), "by their duration"
    if "turns_deg" in columns and "time_s" not in columns:
        turns = columns["turns_deg"]
        speed = abs(columns.get("inner_speed_rpm", np.ones(turns.size)))
        if (turns < 0.0).any() or not turns.sum() > 0.0 or (speed <= 0.0).any():
            raise InvalidKeyError(key, f"{file}: turns or a speed of 0 and below", allowed)
        return turns / speed / (turns / speed).sum(), "by their turns"
    if "time_s" not in columns:
        rows = next(iter(columns.values())).size
        return np.full(rows, 1.0 / rows), "each of the same duration (no column of share or time)"
    time = columns["time_s"]
    steps = np.diff(time)
    if time.size < 2 or (steps <= 0.0).any():
        place = int(np.argmax(steps <= 0.0)) + 2 if time.size > 1 else 1
        finding = f"{file}, row {place}: the time does not rise"
        raise InvalidKeyError(key, finding, "allowed: a rising time, or a column 'duration'")
    steps = np.append(steps, np.median(steps))  # the last row as long as most
    return steps / steps.sum(), f"a course over {time[-1] - time[0]:.4g} s"


def _counted(states: dict[str, Array], share: Array) -> tuple[dict[str, Array], Array]:
    """States of equal levels together: loads by the damage of their turns, the others by time."""
    turns = share * abs(states.get("inner_speed_rpm", np.ones(share.size)))
    weights = np.where(turns.sum() > 0.0, turns, share)
    levels = np.column_stack([_level(states[name], LEVELS[name]) for name in states])
    _, of_row = np.unique(levels, axis=0, return_inverse=True)
    of_row = of_row.ravel()
    shares = np.bincount(of_row, share).astype(np.float64)
    counted: dict[str, Array] = {}
    for name, values in states.items():
        power = LIFE_POWER if name.endswith("load_N") else 1.0
        weight = weights if name.endswith("load_N") else share
        total = np.bincount(of_row, weight)
        weight = np.where(total[of_row] > 0.0, weight, share)
        mean = np.bincount(of_row, weight * abs(values) ** power) / np.bincount(of_row, weight)
        sign = np.sign(np.bincount(of_row, weight * values))
        counted[name] = np.asarray(sign * mean ** (1.0 / power))
    return counted, shares


def _level(values: Array, levels: int) -> Array:
    """Number of the level of each value between the ends; 0 where it is next to nothing."""
    largest = abs(values).max()
    idle = abs(values) <= IDLE_SHARE * largest
    low, high = values.min(), values.max()
    step = (high - low) / levels or 1.0
    number = np.minimum(np.floor((values - low) / step), levels - 1) + 1
    return np.where(idle, 0.0, number)

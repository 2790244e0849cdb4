"""Solved contacts on disk, named after all they depend on: equal ones are solved once."""

import hashlib
import io
import json
from collections.abc import Callable
from dataclasses import asdict, fields, is_dataclass
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np

from ehl import (
    ContactConditions,
    ContactSolution,
    ConvergenceRecord,
    FilmValue,
    SolverOptions,
    solve_contact,
)

from ..version import version
from .store import write_file

MOST_BYTES = 4_000_000_000  # the cache of a batch grows no further


def content_key(*objects: Any) -> str:
    """Hash of dataclasses and values to the last bit."""
    return hashlib.sha256(repr([version(), *map(_plain, objects)]).encode()).hexdigest()[:32]


def _plain(value: Any) -> Any:
    """The content of a value such that equal text means equal content."""
    if is_dataclass(value):
        return [
            type(value).__name__,
            *((f.name, _plain(getattr(value, f.name))) for f in fields(value)),
        ]
    if isinstance(value, Enum):
        return [type(value).__name__, value.name]
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if hasattr(value, "tobytes"):
        return [str(value.dtype), value.shape, value.tobytes()]
    if value is None or isinstance(value, str | int | bool):
        return value
    raise TypeError(f"no key for {type(value).__name__}")


def cached_solver(folder: Path) -> Callable[[ContactConditions, SolverOptions], ContactSolution]:
    """`ehl.solve_contact` that looks into `folder` first and leaves there what it solves."""

    def solve(conditions: ContactConditions, options: SolverOptions) -> ContactSolution:
        try:
            path = folder / f"{content_key(conditions, options)}.npz"
        except TypeError:
            return solve_contact(conditions, options)
        known = load(path, conditions, options)
        if known is not None:
            return known
        solution = solve_contact(conditions, options)
        store(path, solution)
        return solution

    return solve


def store(path: Path, solution: ContactSolution) -> None:
    """Write a solution to `path`, unless the cache is full or a file cannot hold it."""
    arrays: dict[str, Any] = {}
    rest: dict[str, Any] = {}
    for item in fields(solution):
        value = getattr(solution, item.name)
        if isinstance(value, np.ndarray):
            arrays[item.name] = value
        elif item.name not in ("conditions", "options"):
            rest[item.name] = (
                asdict(value) if is_dataclass(value) and not isinstance(value, type) else value
            )
    try:
        header = json.dumps(rest, default=lambda scalar: scalar.item())  # NumPy's own
    except (TypeError, AttributeError, ValueError):  # holds what a file of this kind cannot
        return
    size = sum(file.stat().st_size for file in path.parent.glob("*.npz"))
    if size > MOST_BYTES:
        return
    data = io.BytesIO()
    np.savez(data, header=np.frombuffer(header.encode(), dtype=np.uint8), **arrays)
    write_file(path, data.getvalue())


def load(
    path: Path, conditions: ContactConditions, options: SolverOptions
) -> ContactSolution | None:
    """The solution at `path`; None if there is none or it is damaged."""
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files if name != "header"}
            rest = json.loads(file["header"].tobytes())
        for name, value in rest.items():
            if isinstance(value, dict):
                kind: Any = ConvergenceRecord if name == "record" else FilmValue
                rest[name] = kind(
                    **{k: tuple(v) if isinstance(v, list) else v for k, v in value.items()}
                )
            elif isinstance(value, list):
                rest[name] = tuple(value)
        return ContactSolution(conditions=conditions, options=options, **arrays, **rest)
    except (OSError, ValueError, KeyError, TypeError, EOFError):
        return None

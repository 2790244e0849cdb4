"""Solved contacts on disk, named after all they depend on: equal ones are solved once."""

import io
import json
from collections.abc import Callable
from dataclasses import asdict, fields
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

from ...runs.interrupt import say
from ..keys import content_key
from ..store import write_file

NESTED = (ConvergenceRecord, FilmValue)  # dataclasses of a solution
MOST_BYTES = 4_000_000_000  # the cache of a batch grows no further


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
        if path.exists():
            say(f"oilfilm: {path}: damaged; the contact is solved anew")
        solution = solve_contact(conditions, options)
        store(path, solution)
        return solution

    return solve


def store(path: Path, solution: ContactSolution) -> None:
    """Write a solution to `path`, unless the cache is full or a file cannot hold it."""
    arrays: dict[str, Any] = {}
    values: dict[str, Any] = {"name": path.stem}
    for item in fields(solution):
        value: Any = getattr(solution, item.name)
        if isinstance(value, np.ndarray):
            arrays[item.name] = value
        elif item.name not in ("conditions", "options"):
            values[item.name] = asdict(value) if isinstance(value, NESTED) else value
    try:
        header = json.dumps(values, default=lambda scalar: scalar.item())  # NumPy's own
    except (TypeError, AttributeError, ValueError):  # holds what a file of this kind cannot
        return
    if sum(file.stat().st_size for file in path.parent.glob("*.npz")) > MOST_BYTES:
        return
    data = io.BytesIO()
    np.savez(data, header=np.frombuffer(header.encode(), dtype=np.uint8), **arrays)
    write_file(path, data.getvalue())


def load(
    path: Path, conditions: ContactConditions, options: SolverOptions
) -> ContactSolution | None:
    """The solution at `path`; None if there is none or it is damaged."""
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files if name != "header"}
            values = json.loads(file["header"].tobytes(), object_hook=_tuples)
        if values.pop("name") != path.stem:
            return None
        for name, value in values.items():
            kind: Any = ConvergenceRecord if name == "record" else FilmValue
            values[name] = kind(**value) if isinstance(value, dict) else value
        return ContactSolution(conditions=conditions, options=options, **arrays, **values)
    except Exception:  # of zip files, compression, numbers, text: whatever is damaged
        return None


def _tuples(content: dict[str, Any]) -> dict[str, Any]:
    """A dictionary whose lists are tuples, as solutions have them."""
    return {k: tuple(v) if isinstance(v, list) else v for k, v in content.items()}

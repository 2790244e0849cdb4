"""Rows that do not overlap, each with one preload."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

from ..format.problems import Problem, shown
from .values import Values


def row_tables(values: Values) -> list[dict[str, Any]]:
    """The tables of [[rows]], none if there are none or the list is faulty."""
    tables = values.get("rows")
    return (
        [table for table in tables if isinstance(table, dict)] if isinstance(tables, list) else []
    )


def rows(values: Values) -> Iterator[Problem]:
    """One preload a row; rows at least a ball diameter apart; no slip maps of several rows."""
    tables = row_tables(values)
    diameter = values.get("bearing", "ball_diameter_mm")
    for index, table in enumerate(tables):
        if "preload_N" in table and "preload_um" in table:
            found = "found together with preload_N"
            yield Problem(
                path=("rows", index, "preload_um"), found=found, allowed="allowed: one of them"
            )
    for (_, one), (index, other) in combinations(enumerate(tables), 2):
        here, there = other.get("axial_position_mm"), one.get("axial_position_mm")
        if diameter is None or not (
            isinstance(here, int | float) and isinstance(there, int | float)
        ):
            continue
        if abs(here - there) < diameter:
            allowed = f"allowed: at least a ball diameter, {diameter:g} mm, from every other row"
            yield Problem(
                path=("rows", index, "axial_position_mm"),
                found=f"found {shown(here)}",
                allowed=allowed,
            )
    if tables and values.given("slip"):
        yield Problem(
            path=("slip",),
            found="found together with [[rows]]",
            allowed="allowed: slip maps of a single row",
        )

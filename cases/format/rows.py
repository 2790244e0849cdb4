"""[[rows]]: rows of balls on one inner ring, and the balls whose films are wanted."""

import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import combinations
from typing import Annotated, Any, Literal

from oilfilm.bearing.geometry import Bearing, Row
from oilfilm.bearing.library.plugins import library_data
from oilfilm.bearing.operation import QuasistaticModel
from oilfilm.bearing.studies.preload import preloaded_row

from .fields import (
    FORCE_MAXIMUM,
    LENGTH_MAXIMUM,
    OneOf,
    Table,
    between,
    described,
    is_number,
    within,
)
from .rules import CaseProblem, CaseValues, Excludes, shown

PRELOADS = ("preload_N", "preload_um", "preload_class")  # a row gives one of them
PRELOAD_CLASSES = ("light", "medium", "heavy")


class RowTable(Table):
    """One row of balls, all like [bearing]; left out there is one. Pairs: back to back, face to
    face, tandem.
    """

    axial_position_mm: float = within(
        LENGTH_MAXIMUM, "middle of the row from the point where loads act", ...
    )
    loaded_by: Literal["+x", "-x"] = described("push of the inner ring that loads the row", ...)
    preload_N: float | None = between(0, FORCE_MAXIMUM, "axial, at rest, inner ring in its place")
    preload_um: float | None = within(1e4, "or displacement beyond first touch; negative: play")
    preload_class: Annotated[str, OneOf(*PRELOAD_CLASSES)] | None = described(
        "or a share of C typical of makers' classes"
    )
    first_ball_azimuth_deg: float | None = within(
        360, "azimuth of its first ball; default: that of [bearing]"
    )


AZIMUTH_AGREEMENT_DEG = 0.05  # a ball's azimuth in film_maps may be rounded to a tenth
RELATIONS = (Excludes("slip", "rows", "slip maps of a single row"),)


def _row_tables(values: CaseValues) -> list[dict[str, Any]]:
    """The tables of [[rows]], none if there are none or the list is faulty."""
    tables = values.get("rows")
    tables = tables if isinstance(tables, list) else []
    return [table for table in tables if isinstance(table, dict)]


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [[rows]]: several preloads of a row, rows that overlap, films without a ball.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    tables = _row_tables(values)
    for index, table in enumerate(tables):
        first, *others = [key for key in PRELOADS if key in table] or [""]
        for key in others:
            finding = f"found together with {first}"
            yield CaseProblem(("rows", index, key), finding, "allowed: one of them")
    diameter = values.get("bearing", "ball_diameter_mm")
    for (_, one), (index, other) in combinations(enumerate(tables), 2):
        there, here = (table.get("axial_position_mm") for table in (one, other))
        if diameter is None or not (is_number(here) and is_number(there)):
            continue
        if abs(here - there) < diameter:
            path = ("rows", index, "axial_position_mm")
            allowed = f"allowed: at least a ball diameter, {diameter:g} mm, from every other row"
            yield CaseProblem(path, f"found {shown(here)}", allowed)
    yield from _film_map_faults(values)


def _film_map_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Azimuths at which there are balls."""
    wanted = values.get("ehl", "film_maps")
    balls = values.get("bearing", "balls")
    name = "first_ball_azimuth_deg"
    first = values.get("bearing", name) if values.given("bearing", name) else 0.0
    if wanted is None or isinstance(wanted, str) or balls is None or first is None:
        return
    starts = [table.get(name, first) for table in _row_tables(values)] or [first]
    azimuths = tuple(
        x for start in starts if is_number(start) for x in ball_azimuths(balls, start)
    )
    for azimuth in wanted:
        if ball_at(azimuth, azimuths) is None:
            nearest = min(azimuths, key=lambda other: _apart(azimuth, other))
            finding = f"found {shown(azimuth)}, where no ball is"
            allowed = f"allowed: azimuths of balls; the nearest is {nearest:.6g}"
            yield CaseProblem(("ehl", "film_maps"), finding, allowed)


def ball_azimuths(balls: int, first: float) -> tuple[float, ...]:
    """Azimuths of the balls from the load line.

    Parameters
    ----------
    balls : int
        Number of balls [-].
    first : float
        Azimuth of the first ball [deg].

    Returns
    -------
    tuple[float, ...]
        Azimuths from 0 to 360 [deg].
    """
    return tuple((first + 360.0 * k / balls) % 360.0 for k in range(balls))


def ball_at(azimuth: float, azimuths: tuple[float, ...]) -> int | None:
    """Index of the ball at an azimuth.

    Parameters
    ----------
    azimuth : float
        The azimuth [deg].
    azimuths : tuple[float, ...]
        Azimuths of the balls [deg].

    Returns
    -------
    int | None
        Index, from 0 [-]; None if there is no ball.
    """
    for index, other in enumerate(azimuths):
        if _apart(azimuth, other) <= AZIMUTH_AGREEMENT_DEG:
            return index
    return None


def _apart(first: float, second: float) -> float:
    return abs((first - second + 180.0) % 360.0 - 180.0)


def preload_of_class(name: str, capacity: float) -> tuple[float, float, float]:
    """Axial preload of a class, as a typical share of the dynamic rating.

    Parameters
    ----------
    name : str
        Light, medium or heavy.
    capacity : float
        Dynamic rating C [N].

    Returns
    -------
    tuple[float, float, float]
        Preload, and the ends of its interval [N].
    """
    data = library_data("typical.toml")[f"{name}_preload_over_C"]
    low, high = data["range"]
    return data["value"] * capacity, low * capacity, high * capacity


def _preload(table: RowTable, capacity: Callable[[], float]) -> float:
    """Preload as a force [N], with a warning where a class gives it."""
    if table.preload_class is None:
        return table.preload_N or 0.0
    force, low, high = preload_of_class(table.preload_class, capacity())
    text = (
        f"rows.preload_class: {table.preload_class} is taken as {force:.3g} N ({low:.3g} to "
        f"{high:.3g}), a typical share of C; the maker's table has the value"
    )
    warnings.warn(text, stacklevel=2)
    return force


def rows(
    tables: tuple[RowTable, ...] | None,
    delivered: Bearing,
    model: QuasistaticModel,
    capacity: Callable[[], float],
) -> tuple[Row, ...] | None:
    """Rows of balls, preloaded as delivered.

    Parameters
    ----------
    tables : tuple[RowTable, ...] | None
        The checked tables, where there are any.
    delivered : Bearing
        The bearing as delivered.
    model : QuasistaticModel
        Assumptions of the bearing model.
    capacity : Callable[[], float]
        Gives the dynamic rating C of one row [N].

    Returns
    -------
    tuple[Row, ...] | None
        Rows with positions and offsets [m]; None without [[rows]].
    """
    if tables is None:
        return None
    # at rest no kinematics counts
    at_rest = QuasistaticModel(curvature=model.curvature, rings=model.rings)
    result = []
    for table in tables:
        si = table.si()
        azimuth = si["first_ball_azimuth"]
        row = preloaded_row(
            delivered,
            si["axial_position"],
            1 if table.loaded_by == "+x" else -1,
            preload_force=_preload(table, capacity),
            preload_displacement=si["preload_um"] or 0.0,
            model=at_rest,
        )
        result.append(row if azimuth is None else replace(row, first_ball_azimuth=azimuth))
    _warn_of_tandem(tables)
    return tuple(result)


def _warn_of_tandem(tables: tuple[RowTable, ...]) -> None:
    """Say that rows loaded by one push do not press against each other."""
    if len({table.loaded_by for table in tables}) > 1:
        return
    names = {name for table in tables for name in PRELOADS if getattr(table, name)}
    if names:
        text = (
            f"rows.{', '.join(sorted(names))}: nothing presses back where all rows are loaded by "
            f"{tables[0].loaded_by!r}, as in tandem: under an axial load the preload moves the "
            "ring and changes no contact load; give it as part of operation.axial_load_N"
        )
        warnings.warn(text, stacklevel=2)

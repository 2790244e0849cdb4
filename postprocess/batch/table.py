"""A batch as a table for a terminal of 80 columns."""

from typing import Any

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from ehl.units import unit_of, without_unit

from ..main_results import main_results
from .points import BatchPoint, BatchResults
from .sensitivity import bands, sensitivities

MOST_ROWS = 40  # of the terminal's table; the files have all
WIDTH = 80
NOTHING = "–"
SHOWN = {
    "load_maximum_N": "Q max",
    "hertz_pressure_maximum_GPa": "p_h max",
    "film_central_um": "h_c",
    "film_minimum_um": "h_min",
    "film_minimum_dimensionless": "h_min",
    "torque_N_mm": "torque",
    "cage_speed_rpm": "cage",
    "cage_speed_ratio": "of kinem.",
    "slip_factor_minimum": "SF min",
    "balls_slipping": "slip",
    "minimum_preload_N": "preload",
    "inner_largest_coefficient": "µ inner",
    "outer_largest_coefficient": "µ outer",
}
CELL = 10  # characters of a column of results


def batch_table(results: BatchResults) -> Group:
    """Lay out the points of a batch, the first and the last ones of many, with the results that
    fit beside the keys.

    Parameters
    ----------
    results : BatchResults

    Returns
    -------
    rich.console.Group
        To be printed by a rich console; units [N], [GPa], [um] ... as the headers say.
    """
    rows = [main_results(point.summary) for point in results.points]
    keys = [
        key
        for key in results.keys
        if len({str(point.values.get(key)) for point in results.points}) > 1
    ]
    shown = [name for name in SHOWN if any(row.get(name) is not None for row in rows)]
    shown = shown[
        -max(1, (WIDTH - 10 - sum(max(9, len(_name(key))) + 1 for key in keys)) // CELL) :
    ]
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0), collapse_padding=True)
    table.add_column("#", justify="right")
    for key in keys:
        table.add_column(f"{_name(key)}\n{_unit(key)}", justify="right", overflow="fold")
    for name in shown:
        table.add_column(f"{SHOWN[name]}\n{_unit(name)}", justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    count = len(rows)
    half = MOST_ROWS // 2
    for i, (point, row) in enumerate(zip(results.points, rows, strict=True)):
        if count > MOST_ROWS and half <= i < count - half:
            if i == half:
                table.add_row("...")
            continue
        values = [_text(point.values.get(key)) for key in keys]
        table.add_row(
            str(point.number), *values, *(_text(row.get(name)) for name in shown), _flag(point)
        )
    flags = {_flag(point) for point in results.points}
    words = [
        word
        for flag, word in (("!", "! not converged"), ("x", "x failed, see the messages"))
        if flag in flags
    ]
    return Group(Text(results.title, style="bold"), table, *words, *_uncertainties(results))


def _uncertainties(results: BatchResults) -> list[Table]:
    """Sensitivities to each key, and bands over sampled keys, of a few main results; nothing
    without such points.
    """
    found: list[Table] = []
    style: dict[str, Any] = {"box": box.SIMPLE_HEAD, "pad_edge": False, "title_justify": "left"}
    rows = sensitivities(results)
    names = [name for name in SHOWN if any(name in row["results"] for row in rows)]
    if rows:
        table = Table(title="d ln(result)/d ln(key); ~: within the error bars", **style)
        table.add_column("key", overflow="fold")
        for name in names:
            table.add_column(SHOWN[name], justify="right")
        for row in rows:
            cells = (row["results"].get(name) for name in names)
            table.add_row(row["key"], *(_sensitivity(cell) for cell in cells))
        found.append(table)
    spread = bands(results)
    if spread:
        table = Table(title="over the sampled points", **style)
        for name in ("", "5 %", "median", "95 %"):
            table.add_column(name, justify="right" if name else "left")
        for name, band in spread.items():
            if name in SHOWN:
                table.add_row(
                    f"{SHOWN[name]} {_unit(name)}",
                    *(f"{band[q]:.4g}" for q in ("q05", "q50", "q95")),
                )
        found.append(table)
    return found


def _sensitivity(cell: dict[str, Any] | None) -> str:
    if cell is None:
        return NOTHING
    return ("~" if cell["resolved"] is False else "") + f"{cell['sensitivity']:+.3f}"


def _name(key: str) -> str:
    return without_unit(key.rpartition(".")[2])


def _unit(key: str) -> str:
    return unit_of(key.rpartition(".")[2]).replace("um", "µm")


def _flag(point: BatchPoint) -> str:
    return "x" if point.summary is None else "" if point.converged else "!"


def _text(value: Any) -> str:
    if value is None:
        return NOTHING
    return f"{value:.5g}" if isinstance(value, float) else str(value)

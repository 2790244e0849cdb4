"""Slip maps in the terminal."""

from typing import Any

from rich.console import Group
from rich.table import Table
from rich.text import Text

from ehl.units import from_si, unit_symbol

from ..bearing.quantities import BALL_QUANTITY
from ..table import number_table, titled
from ..text import evenly_chosen, number
from .quantities import SLIP_FACTOR
from .results import SlipResults
from .summary import ball_values

MOST_ROWS = 11  # speeds listed
STYLE: dict[str, Any] = {"padding": (0, 2, 0, 0), "collapse_padding": True}
COLUMNS = {  # of the balls, with the format of their numbers
    "azimuth_deg": ".1f",
    "inner_load_N": ".1f",
    "inner_contact_angle_deg": ".2f",
    "centrifugal_force_N": ".2f",
}


def slip_table(results: SlipResults) -> Group:
    """The balls at the case's operation and the minimum loads [N] over speed [r/min].

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.

    Returns
    -------
    Group
        The tables.
    """
    fx, fy, _ = results.state.ring_force
    speed = from_si("speed_rpm", results.state.operation.inner_speed)
    own = (
        f"At {speed:.0f} r/min, axial {fx:.1f} N, radial {fy:.1f} N; a ball slips below "
        f"{results.limit:g}:"
    )
    return titled(
        results.title,
        Text(own.replace("-0.0 N", "0.0 N")),
        _balls_table(results),
        Text("Minimum loads over speed (axial, but for the radial load of the last column), N:"),
        _loads_table(results),
    )


def _balls_table(results: SlipResults) -> Table:
    printed = results.printed_force is not None
    factors = ("slip_factor", *["slip_factor_as_printed"] * printed)
    rows = []
    for ball in ball_values(results):
        ball["azimuth_deg"] %= 360.0
        cells = [f"{ball[key]:{digits}}" for key, digits in COLUMNS.items()]
        cells += [number(ball[key], ".3f") for key in factors]
        rows.append([str(ball["ball"]), *cells, "slips" if ball["slips"] else ""])
    headers = ["ball", *(f"{BALL_QUANTITY[key].symbol} {unit_symbol(key)}" for key in COLUMNS)]
    headers += [SLIP_FACTOR.symbol, *["as printed"] * printed, ""]
    return number_table(headers, rows, **STYLE)


def _loads_table(results: SlipResults) -> Table:
    minimum = results.minimum
    loads = minimum.given()
    count = minimum.count
    chosen = evenly_chosen(count, MOST_ROWS)
    speeds = from_si("speeds_rpm", minimum.speeds)
    rows = [
        [
            f"{speeds[index]:.0f}" + (" *" if index == count else ""),
            *(number(float(values[index]), ".1f") for _, values in loads),
        ]
        for index in (*chosen, *([count] if minimum.own else []))
    ]
    table = number_table(["r/min", *(load.symbol for load, _ in loads)], rows, **STYLE)
    if minimum.own:
        table.caption = "* the case's own speed"
    return table

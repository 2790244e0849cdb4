"""Slip maps in the terminal."""

from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table
from rich.text import Text

from ehl.units import from_si

from ..table import number_table
from ..text import number
from .results import SlipResults
from .summary import ball_values

MOST_ROWS = 11  # speeds listed
STYLE: dict[str, Any] = {"padding": (0, 2, 0, 0), "collapse_padding": True}
LOAD_NAMES = {
    "hirano_N": "Hirano",
    "as_printed_N": "as printed",
    "skf_axial_N": "SKF axial",
    "skf_radial_N": "radial",
}


def slip_table(results: SlipResults) -> Group:
    """The balls at the case's operation and the minimum loads [N] over speed [r/min]."""
    fx, fy, _ = results.state.ring_force
    speed = from_si("speed_rpm", results.state.operation.inner_speed)
    own = (
        f"At {speed:.0f} r/min, axial {fx:.1f} N, radial {fy:.1f} N; a ball slips below "
        f"{results.limit:g}:"
    )
    return Group(
        Text(results.title, style="bold"),
        Text(own.replace("-0.0 N", "0.0 N")),
        _balls_table(results),
        Text("Minimum loads over speed (axial, but for the radial load of the last column), N:"),
        _loads_table(results),
    )


def _balls_table(results: SlipResults) -> Table:
    printed = results.printed_force is not None
    rows = [
        [
            f"{ball['ball']}",
            f"{ball['azimuth_deg'] % 360.0:.1f}",
            f"{ball['inner_load_N']:.1f}",
            f"{ball['inner_contact_angle_deg']:.2f}",
            f"{ball['centrifugal_force_N']:.2f}",
            number(ball["slip_factor"], ".3f"),
            *([number(ball["slip_factor_as_printed"], ".3f")] if printed else []),
            "slips" if ball["slips"] else "",
        ]
        for ball in ball_values(results)
    ]
    headers = ["ball", "ψ °", "Qi N", "αi °", "Fc N", "SF", *["as printed"] * printed, ""]
    return number_table(headers, rows, **STYLE)


def _loads_table(results: SlipResults) -> Table:
    minimum = results.minimum
    loads = minimum.given()
    count = minimum.count
    chosen = np.unique(np.linspace(0, count - 1, min(MOST_ROWS, count)).round()).astype(int)
    rows = [
        [
            f"{from_si('speed_rpm', minimum.speeds[index]):.0f}"
            + (" *" if index == count else ""),
            *(number(float(values[index]), ".1f") for values in loads.values()),
        ]
        for index in (*chosen, *([count] if minimum.own else []))
    ]
    table = number_table(["r/min", *(LOAD_NAMES[key] for key in loads)], rows, **STYLE)
    if minimum.own:
        table.caption = "* the case's own speed"
    return table

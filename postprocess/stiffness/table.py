"""Stiffness over speed in the terminal."""

from math import isfinite

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from ehl.units import RPM

from .results import StiffnessResults

ROUND_OFF = 1e-9  # of the largest entry: shown as zero [-]


def stiffness_table(results: StiffnessResults) -> Group:
    """Main entries over speed for a terminal: stiffness [N/um] and [N m/mrad]."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for header in ("r/min", "k_xx", "k_yy", "k_zz", "k_yz", "k_xy", "tilt y", "tilt z"):
        table.add_column(header, justify="right", no_wrap=True)
    for speed, matrix in zip(results.study.speeds, results.study.matrices, strict=True):
        entries = [matrix[i, j] * 1e-6 for i, j in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 1))]
        entries += [matrix[i, i] * 1e-3 for i in (3, 4)]
        noise = ROUND_OFF * max(abs(entry) for entry in entries)
        words = [
            "–" if not isfinite(e) else f"{e:.4g}" if abs(e) > noise else "0" for e in entries
        ]
        table.add_row(f"{speed / RPM:.0f}", *words)
    units = Text("stiffness k in N/µm, against tilting in N m/mrad", style="dim")
    return Group(Text(str(results.case.get("title", "")), style="bold"), units, table)

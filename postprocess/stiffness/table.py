"""Stiffness over speed in the terminal."""

from rich.console import Group
from rich.text import Text

from ehl.units import from_si

from ..table import number_table
from ..text import number
from .results import StiffnessResults

ROUND_OFF = 1e-9  # of the largest entry: shown as zero [-]
HEADERS = ("r/min", "k_xx", "k_yy", "k_zz", "k_yz", "k_xy", "tilt y", "tilt z")
PER_UM = 1e-6  # [N/um] of one N/m
PER_MRAD = 1e-3  # [N m/mrad] of one N m/rad


def stiffness_table(results: StiffnessResults) -> Group:
    """Main entries over speed: stiffness [N/um] and [N m/mrad]."""
    rows = []
    for speed, matrix in zip(results.study.speeds, results.study.matrices, strict=True):
        entries = [matrix[i, j] * PER_UM for i, j in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 1))]
        entries += [matrix[i, i] * PER_MRAD for i in (3, 4)]
        noise = ROUND_OFF * max(abs(entry) for entry in entries)
        cells = [number(e) if not abs(e) <= noise else "0" for e in entries]
        rows.append([f"{from_si('speed_rpm', speed):.0f}", *cells])
    units = Text("stiffness k in N/µm, against tilting in N m/mrad", style="dim")
    return Group(Text(results.title, style="bold"), units, number_table(HEADERS, rows))

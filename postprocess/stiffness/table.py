"""Stiffness over speed in the terminal."""

from rich.console import Group
from rich.text import Text

from ..table import number_table, titled
from ..text import number
from .results import StiffnessResults
from .summary import SPEED, STIFFNESS, TILTING_STIFFNESS

ROUND_OFF = 1e-9  # of the largest entry: shown as zero [-]
HEADERS = ("r/min", "k_xx", "k_yy", "k_zz", "k_yz", "k_xy", "tilt y", "tilt z")
ENTRIES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 1))  # of translation


def stiffness_table(results: StiffnessResults) -> Group:
    """Main entries over speed: stiffness [N/um] and [N m/mrad].

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.

    Returns
    -------
    Group
        The table.
    """
    study = results.study
    rows = []
    for speed, matrix in zip(SPEED.value(study), study.matrices, strict=True):
        entries = [STIFFNESS.in_unit(matrix[place]) for place in ENTRIES]
        entries += [TILTING_STIFFNESS.in_unit(matrix[i, i]) for i in (3, 4)]
        noise = ROUND_OFF * max(abs(entry) for entry in entries)
        cells = [number(e) if not abs(e) <= noise else "0" for e in entries]
        rows.append([f"{speed:.0f}", *cells])
    units = Text("stiffness k in N/µm, against tilting in N m/mrad", style="dim")
    return titled(results.title, units, number_table(HEADERS, rows))

"""Film and pressure along a line through a contact, as a table."""

import csv
from pathlib import Path

import numpy as np

from ..files import atomic_path
from .fields import open_contact

SYMBOLS = {"m": 1e-6, "Pa": 1e9}  # of film and pressure: written in [um] and [GPa]
NAMES = {"m": "um", "Pa": "GPa"}


def write_line_cut(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    axis: str = "x",
    at: float = 0.0,
) -> Path:
    """Write position, film and pressure along one axis of a contact, between nodes linear.

    Parameters
    ----------
    directory : str or Path
        Result folder.
    file : str or Path
        Table to write.
    contact : str, optional
        `ball01/inner`; the first one with a film if left out.
    axis : {"x", "y"}
        Along or across the entrainment.
    at : float
        Where the line crosses the other axis, in Hertz half extents there [-].

    Returns
    -------
    Path
        Positions [mm], film [um], pressure [GPa]; dimensionless from Moes' groups, as the header
        says.

    Raises
    ------
    ValueError
        If there is no such contact, or the line is outside the box.
    """
    if axis not in ("x", "y"):
        raise ValueError(f"axis must be x or y, got {axis!r}")
    name, data = open_contact(directory, contact)
    other = "y" if axis == "x" else "x"
    place = at * float(data.attrs[f"semi_axis_{other}"])
    across = data[other].values
    if not across[0] <= place <= across[-1]:
        ends = (across[[0, -1]] / float(data.attrs[f"semi_axis_{other}"])).round(3).tolist()
        raise ValueError(
            f"{name}: the line at {other} = {at:g} is outside the box, {ends} semi-axes"
        )
    columns = {}
    unit = data[axis].attrs["units"]
    columns[f"{axis} [{'mm' if unit == 'm' else unit}]"] = data[axis].values / (
        1e-3 if unit == "m" else 1.0
    )
    for label, field in (("film", "h"), ("pressure", "P")):
        values = data[field].values if axis == "x" else data[field].values.T
        line = np.array([np.interp(place, across, row) for row in values])
        unit = data[field].attrs["units"]
        columns[f"{label} [{NAMES.get(unit, unit)}]"] = line / SYMBOLS.get(unit, 1.0)
    path = Path(file)
    with (
        atomic_path(path) as temporary,
        temporary.open("w", newline="", encoding="utf-8") as table,
    ):
        writer = csv.writer(table)
        writer.writerow(columns)
        writer.writerows(
            [f"{value:.7g}" for value in row] for row in zip(*columns.values(), strict=True)
        )
    return path

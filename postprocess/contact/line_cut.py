"""Film and pressure along a line through a contact, as a table."""

from pathlib import Path

import numpy as np

from ehl.solution import Array
from ehl.units import from_si

from ..files import write_csv
from .fields import open_contact

# of the numbers in the file, by the unit of the field
UNITS = {"x": {"m": "mm"}, "y": {"m": "mm"}, "h": {"m": "um"}, "P": {"Pa": "GPa"}}


def write_line_cut(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    axis: str = "x",
    at: float = 0.0,
) -> Path:
    """Write position [mm], film [um] and pressure [GPa] along one axis, between nodes linear.

    Dimensionless from Moes' groups, as the header says.

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
    columns = dict([_column(axis, data[axis].values, data[axis].attrs["units"])])
    for label, field in (("film", "h"), ("pressure", "P")):
        values = data[field].values if axis == "x" else data[field].values.T
        line = np.array([np.interp(place, across, row) for row in values])
        columns |= dict([_column(field, line, data[field].attrs["units"], label)])
    path = Path(file)
    write_csv(path, columns, zip(*columns.values(), strict=True), ".7g")
    return path


def _column(field: str, values: Array, unit: str, label: str = "") -> tuple[str, Array]:
    """Header and values of a column, in the unit of the file where the field has a dimension."""
    own = UNITS[field].get(unit)
    head = f"{label or field} [{own or unit}]"
    return head, values if own is None else from_si(f"values_{own}", values)

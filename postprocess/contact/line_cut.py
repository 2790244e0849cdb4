"""Film and pressure along a line through a contact, as a table."""

from pathlib import Path

import numpy as np

from ..files import write_csv
from .fields import shown
from .stored import open_contact


def write_line_cut(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    axis: str = "x",
    at: float = 0.0,
) -> Path:
    """Write position [mm], film [um] and pressure [GPa] along one axis, linear between nodes.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        CSV file.
    contact : str | None, optional
        Name of the contact, as in `open_contact`.
    axis : str, default 'x'
        "x", along the entrainment, or "y", across it.
    at : float, default 0.0
        Position of the line on the other axis, in Hertz half extents [-].

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without such a contact, or if the line lies outside the box.
    """
    if axis not in ("x", "y"):
        raise ValueError(f"axis must be x or y, got {axis!r}")
    name, data = open_contact(directory, contact)
    other = "y" if axis == "x" else "x"
    semi_axis = float(data.attrs[f"semi_axis_{other}"])
    place = at * semi_axis
    across = data[other].values
    if not across[0] <= place <= across[-1]:
        ends = (across[[0, -1]] / semi_axis).round(3).tolist()
        raise ValueError(
            f"{name}: the line at {other} = {at:g} is outside the box, {ends} semi-axes"
        )
    values, unit = shown("x", data[axis].attrs["units"], data[axis].values)
    columns = {f"{axis} [{unit}]": values}
    for label, field in (("film", "h"), ("pressure", "P")):
        rows = data[field].values if axis == "x" else data[field].values.T
        line = np.array([np.interp(place, across, row) for row in rows])
        values, unit = shown(field, data[field].attrs["units"], line)
        columns[f"{label} [{unit}]"] = values
    path = Path(file)
    write_csv(path, columns, zip(*columns.values(), strict=True), ".7g")
    return path

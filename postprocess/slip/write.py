"""Files of slip maps."""

from pathlib import Path
from typing import Any

import numpy as np

from ehl.units import from_si

from ..files import Table
from ..netcdf.groups import Variables
from ..netcdf.study import SPEED_COLUMN, StudyFiles, write_study
from .plots import write_slip_plots
from .quantities import AXIAL_LOAD, RADIAL_LOAD, WORST_FACTOR
from .results import SlipResults
from .summary import slip_summary

DIGITS = ".9g"  # of numbers in tables
SPEED, LOAD, FACTOR = ({"units": unit} for unit in ("rad/s", "N", "1"))


def write_slip(results: SlipResults, directory: str | Path) -> tuple[str, ...]:
    """Write pictures, tables and, last, the summary; pictures that failed are messages.

    Parameters
    ----------
    results : SlipResults
        Slip maps of the case.
    directory : str | Path
        Folder to write into.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    folder = Path(directory)
    files = StudyFiles(
        kind="slip",
        document=slip_summary(results),
        tables=_tables(results),
        variables=_variables(results),
        attributes={"limit": results.limit},
        number=DIGITS,
    )
    return write_study(files, folder, lambda: write_slip_plots(results, folder))


def _tables(results: SlipResults) -> dict[str, Table]:
    surface = results.surface
    minimum = results.minimum
    balls = [f"ball {ball + 1}" for ball in range(results.state.bearing.balls)]
    factors = [f"slip factor of {ball} [-]" for ball in balls]
    header = [SPEED_COLUMN, AXIAL_LOAD.header, WORST_FACTOR.header, *factors]
    rows: list[Any] = [
        [from_si("speed_rpm", speed), load, surface.minimum[i, k], *surface.factors[i, k]]
        for i, speed in enumerate(surface.speeds)
        for k, load in enumerate(surface.axial_loads)
    ]
    tables: dict[str, Table] = {"slip_factors": (header, rows)}
    rows = [
        [from_si("speed_rpm", curve.speed), radial, *loads]
        for curve in results.curves
        for radial, loads in zip(curve.radial_loads, curve.axial_loads, strict=True)
    ]
    if rows:
        header = [SPEED_COLUMN, RADIAL_LOAD.header, *(f"axial load of {b} [N]" for b in balls)]
        tables["critical_loads"] = header, rows
    loads = minimum.given()
    header = [SPEED_COLUMN, *(f"{load.source} [N]" for load, _ in loads)]
    speeds = from_si("speeds_rpm", minimum.speeds)
    columns = np.column_stack([speeds, *(values for _, values in loads)])
    return tables | {"minimum_loads": (header, columns.tolist())}


def _variables(results: SlipResults) -> Variables:
    """Slip factors [-] over speed [rad/s], axial load [N] and ball; minimum and critical loads."""
    surface = results.surface
    state = results.state
    minimum = results.minimum
    variables: Variables = {
        "speed": (("speed",), surface.speeds, SPEED),
        "axial_load": (("axial_load",), surface.axial_loads, LOAD),
        "ball": (("ball",), np.arange(1, state.bearing.balls + 1), {}),
        "slip_factor": (("speed", "axial_load", "ball"), surface.factors, FACTOR),
        "operation_slip_factor": (("ball",), results.factors, FACTOR),
        "minimum_speed": (("minimum_speed",), minimum.speeds, SPEED),
    }
    for name in ("inner_load", "centrifugal_force"):
        values = np.asarray(getattr(state, name), dtype=float)
        variables[f"operation_{name}"] = (("ball",), values, LOAD)
    for load, values in minimum.given():
        variables[f"minimum_load_{load.source}"] = (("minimum_speed",), values, LOAD)
    if results.curves:
        over = ("critical_speed", "critical_radial_load")
        speeds = np.array([curve.speed for curve in results.curves])
        variables |= {
            over[0]: (over[:1], speeds, SPEED),
            over[1]: (over[1:], np.asarray(results.curves[0].radial_loads), LOAD),
            "critical_axial_load": (
                *((*over, "ball"), np.stack([curve.axial_loads for curve in results.curves])),
                LOAD,
            ),
        }
    return variables

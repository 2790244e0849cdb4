"""Files of slip maps."""

from pathlib import Path
from typing import Any

import numpy as np

from bearing.studies.slip import slip_factors
from ehl.units import from_si

from ..files import (
    FIELDS_FILE,
    SUMMARY_FILE,
    Variables,
    attempt,
    root_attributes,
    write_csv,
    write_dataset,
    write_json,
)
from .plots import write_slip_plots
from .results import SlipResults
from .summary import slip_summary

DIGITS = ".9g"  # of numbers in tables
SPEED = "speed [r/min]"


def write_slip(results: SlipResults, directory: str | Path) -> tuple[str, ...]:
    """Write pictures, tables and, last, the summary; pictures that failed are messages."""
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    problems = attempt("plots", lambda: write_slip_plots(results, folder))
    _write_tables(results, folder)
    document = slip_summary(results)
    document["messages"] += problems
    write_slip_netcdf(results, folder / FIELDS_FILE, document)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def _write_tables(results: SlipResults, folder: Path) -> None:
    surface = results.surface
    balls = [f"ball {ball + 1}" for ball in range(results.state.bearing.balls)]
    factors = ["slip factor of the worst ball [-]", *(f"slip factor of {b} [-]" for b in balls)]
    rows = [
        [from_si("speed_rpm", speed), load, surface.minimum[i, k], *surface.factors[i, k]]
        for i, speed in enumerate(surface.speeds)
        for k, load in enumerate(surface.axial_loads)
    ]
    header = [SPEED, "axial load [N]", *factors]
    write_csv(folder / "slip_factors.csv", header, rows, DIGITS)
    rows = [
        [from_si("speed_rpm", curve.speed), radial, *loads]
        for curve in results.curves
        for radial, loads in zip(curve.radial_loads, curve.axial_loads, strict=True)
    ]
    if rows:
        header = [SPEED, "radial load [N]", *(f"axial load of {b} [N]" for b in balls)]
        write_csv(folder / "critical_loads.csv", header, rows, DIGITS)
    loads = results.minimum.given()
    speeds = from_si("speeds_rpm", results.minimum.speeds)
    header = [SPEED, *(f"{key.removesuffix('_N')} [N]" for key in loads)]
    columns = np.column_stack([speeds, *loads.values()])
    write_csv(folder / "minimum_loads.csv", header, columns.tolist(), DIGITS)


def write_slip_netcdf(results: SlipResults, path: Path, document: dict[str, Any]) -> None:
    """Write slip factors [-] over `speed` [rad/s], `axial_load` [N] and ball, and the loads [N].

    Critical loads and minimum loads; `document` is the summary.
    """
    surface, state = results.surface, results.state
    speed, load, factor = {"units": "rad/s"}, {"units": "N"}, {"units": "1"}
    variables: Variables = {
        "speed": (("speed",), surface.speeds, speed),
        "axial_load": (("axial_load",), surface.axial_loads, load),
        "ball": (("ball",), np.arange(1, state.bearing.balls + 1), {}),
        "slip_factor": (("speed", "axial_load", "ball"), surface.factors, factor),
        "operation_slip_factor": (("ball",), slip_factors(state), factor),
        "minimum_speed": (("minimum_speed",), results.minimum.speeds, speed),
    }
    for name in ("inner_load", "centrifugal_force"):
        values = np.asarray(getattr(state, name), dtype=float)
        variables[f"operation_{name}"] = (("ball",), values, load)
    for key, values in results.minimum.given().items():
        name = f"minimum_load_{key.removesuffix('_N')}"
        variables[name] = (("minimum_speed",), values, load)
    coordinates = {"speed", "axial_load", "ball", "minimum_speed"}
    if results.curves:
        speeds = np.array([curve.speed for curve in results.curves])
        radial = np.asarray(results.curves[0].radial_loads)
        axial = np.stack([curve.axial_loads for curve in results.curves])
        over = ("critical_speed", "critical_radial_load")
        variables |= {
            over[0]: (over[:1], speeds, speed),
            over[1]: (over[1:], radial, load),
            "critical_axial_load": ((*over, "ball"), axial, load),
        }
        coordinates |= set(over)
    attributes = root_attributes(document, "slip") | {"limit": results.limit}
    write_dataset(variables, coordinates, attributes, path)

"""Files of a slip study."""

import csv
from math import isfinite
from pathlib import Path

import numpy as np

from ehl.units import RPM

from ..files import FIELDS_FILE, SUMMARY_FILE, atomic_path, write_json
from .results import SlipResults, slip_summary, write_slip_netcdf


def write_slip(results: SlipResults, directory: str | Path) -> tuple[str, ...]:
    """Write pictures, tables and, last, the summary; a picture that fails is a message, not an
    error.

    Parameters
    ----------
    results : SlipResults
    directory : str or Path

    Returns
    -------
    tuple of str
        What could not be drawn and why.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    problems: tuple[str, ...] = ()
    try:
        from .plots import write_slip_plots

        write_slip_plots(results, folder)
    # any failure in a drawing library is a lost picture, not a lost run
    except Exception as error:
        problems = (f"plots not written: {type(error).__name__}: {error}",)
    _write_tables(results, folder)
    document = slip_summary(results)
    document["messages"] = [*document["messages"], *problems]
    write_slip_netcdf(results, folder / FIELDS_FILE, document)
    write_json(document, folder / SUMMARY_FILE)
    return problems


def _write_tables(results: SlipResults, folder: Path) -> None:
    balls = [f"slip factor of ball {ball + 1} [-]" for ball in range(results.state.bearing.balls)]
    surface = results.surface
    rows = [
        [speed / RPM, load, surface.minimum[i, k], *surface.factors[i, k]]
        for i, speed in enumerate(surface.speeds)
        for k, load in enumerate(surface.axial_loads)
    ]
    head = ["speed [r/min]", "axial load [N]", "slip factor of the worst ball [-]", *balls]
    _write_csv(folder / "slip_factors.csv", head, rows)
    head = [
        "speed [r/min]",
        "radial load [N]",
        *(f"axial load of ball {b + 1} [N]" for b in range(len(balls))),
    ]
    rows = [
        [curve.speed / RPM, radial, *loads]
        for curve in results.curves
        for radial, loads in zip(curve.radial_loads, curve.axial_loads, strict=True)
    ]
    if rows:
        _write_csv(folder / "critical_loads.csv", head, rows)
    given = {
        key: values for key, values in results.minimum.columns().items() if values is not None
    }
    head = ["speed [r/min]", *(f"{key.removesuffix('_N')} [N]" for key in given)]
    _write_csv(
        folder / "minimum_loads.csv",
        head,
        np.column_stack([results.minimum.speeds / RPM, *given.values()]).tolist(),
    )


def _write_csv(path: Path, head: list[str], rows: list[list[float]]) -> None:
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(head)
        writer.writerows(
            [f"{value:.9g}" if isfinite(value) else "" for value in row] for row in rows
        )

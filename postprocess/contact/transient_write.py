"""Files of a contact over time: summary, series, fields, pictures."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ehl.transient.record import QUANTITIES, TransientSolution
from ehl.units import from_si

from ..files import SUMMARY_FILE, write_csv, write_json
from ..netcdf.groups import FIELDS_FILE, Group, Variables, root_attributes, write_groups
from .transient_plots import write_transient_plots
from .transient_results import TransientResults
from .transient_summary import transient_summary

SERIES_FILE = "steps.csv"
UNITS = {  # SI units of the series in netCDF, and their keys in CSV
    "time": ("s", "time_ms"),
    "speed": ("m/s", "speed_m_s"),
    "load": ("N", "load_N"),
    "film_force": ("N", "film_force_N"),
    "approach": ("m", "approach_um"),
    "approach_rate": ("m/s", "approach_rate_m_s"),
    "film_central": ("m", "film_central_um"),
    "film_minimum": ("m", "film_minimum_um"),
    "pressure_central": ("Pa", "pressure_central_GPa"),
    "pressure_maximum": ("Pa", "pressure_maximum_GPa"),
    "error": ("1", "step_error"),
    "oil_error": ("1", "oil_error"),
    "cycles": ("1", "cycles"),
}


def write_transient(
    results: TransientResults, directory: Path, is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write series, fields, summary and pictures.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.
    directory : Path
        Folder to write into.
    hurried : Callable[[], bool], default lambda: False
        Once it is true no picture is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    directory.mkdir(parents=True, exist_ok=True)
    document = transient_summary(results)
    solution = results.solution
    keys = [UNITS[name][1] for name in QUANTITIES]
    columns = [
        from_si(key, solution.series(name)).tolist()
        for name, key in zip(QUANTITIES, keys, strict=True)
    ]
    write_csv(directory / SERIES_FILE, keys, zip(*columns, strict=True))
    write_transient_netcdf(results, directory / FIELDS_FILE, document)
    write_json(document, directory / SUMMARY_FILE)
    return () if is_interrupted() else write_transient_plots(results, directory)


def write_transient_netcdf(
    results: TransientResults, path: Path, document: dict[str, Any]
) -> None:
    """Write all steps and the fields kept, SI; fields of y >= 0 where they are even in y.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.
    path : Path
        File to write.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    solution = results.solution
    about: dict[str, Any] = {"units": "m"}
    variables: Variables = {
        name: (("time",), solution.series(name), {"units": UNITS[name][0]}) for name in QUANTITIES
    }
    variables |= {
        "x": (("x",), solution.x, about | {"long_name": "along the entrainment"}),
        "y": (("y",), solution.y, about | {"long_name": "across the entrainment"}),
        "film_line": (("time", "x"), solution.film_lines.astype(np.float32), about),
        "pressure_line": (
            ("time", "x"),
            solution.pressure_lines.astype(np.float32),
            {"units": "Pa"},
        ),
        **_frames(solution),
    }
    attributes = root_attributes(document, "transient") | {
        "half": int(solution.symmetric),
        "semi_axis_x": solution.semi_axes[0],
        "semi_axis_y": solution.semi_axes[1],
        "hertz_pressure": solution.hertz_pressure,
    }
    write_groups({"/": Group(variables=variables, attributes=attributes)}, path)


def _frames(solution: TransientSolution) -> Variables:
    """Fields kept, over frames, y and x."""
    plane = ("frame", "y", "x")
    named = {
        "P": ("pressure", {"units": "Pa"}),
        "h": ("film", {"units": "m"}),
        "filled": ("filled", {"units": "1", "long_name": "share of the gap filled with oil"}),
    }
    fields: Variables = {
        name: (
            plane,
            np.array([getattr(frame, source) for frame in solution.frames], dtype=np.float32),
            attributes,
        )
        for name, (source, attributes) in named.items()
    }
    times = np.array([frame.time for frame in solution.frames])
    return fields | {"frame_time": (("frame",), times, {"units": "s"})}

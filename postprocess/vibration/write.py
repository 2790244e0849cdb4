"""Files of a vibration: pictures, record, spectra, sound, summary."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from bearing.vibration.assembly import INNER, OUTER, SENSOR
from bearing.vibration.simulation import OVERSAMPLED

from ..files import Table
from ..netcdf.groups import Variables
from ..netcdf.study import StudyFiles, write_study
from .audio import write_audio
from .measured import Measured, envelope_band, measured
from .plots import write_vibration_plots
from .results import VibrationResults
from .signals import by_order, envelope, sampled, spectrum
from .summary import vibration_summary

AUDIO_FILE = "vibration.wav"
LINE_KEYS = (
    "source order_number direction frequency_Hz displacement_um velocity_um_s acceleration_m_s2"
).split()


def write_vibration(
    results: VibrationResults, directory: Path, is_interrupted: Callable[[], bool] = lambda: False
) -> tuple[str, ...]:
    """Write all files of a vibration.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.
    directory : Path
        Folder to write into.
    hurried : Callable[[], bool], default lambda: False
        Once it is true no picture is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    document = vibration_summary(results)
    seen = measured(results)
    directory.mkdir(parents=True, exist_ok=True)
    full = write_audio(seen.acceleration, seen.rate, directory / AUDIO_FILE)
    files = StudyFiles(
        kind="vibration",
        document=document,
        tables=_tables(results, seen, document["vibration"]["lines"]),
        variables=_variables(results, seen),
        attributes={"audio_full_scale_m_s2": full},
    )
    problems: list[str] = []

    def draw() -> None:
        if not is_interrupted():
            problems.extend(
                write_vibration_plots(results, seen, document, directory, is_interrupted)
            )

    return (*write_study(files, directory, draw), *problems)


def _tables(
    results: VibrationResults, seen: Measured, lines: list[dict[str, object]]
) -> dict[str, Table]:
    speed = results.run.solution.operation.shaft_speed
    orders = by_order(seen.velocity, seen.turned, speed)
    result = spectrum(seen.acceleration, seen.rate)
    size = envelope(seen.acceleration, seen.rate, envelope_band(results))
    wrapped = spectrum(size, seen.rate)
    columns = (result.frequency, result.amplitude, wrapped.amplitude)
    return {
        "lines": (LINE_KEYS, [[line[key] for key in LINE_KEYS] for line in lines]),
        "spectrum": (
            ("frequency [Hz]", "acceleration [m/s2]", "envelope [m/s2]"),
            np.column_stack(columns).tolist(),
        ),
        "orders": (
            ("order [-]", "velocity [m/s]"),
            np.column_stack([orders.frequency, orders.amplitude]).tolist(),
        ),
    }


def _variables(results: VibrationResults, seen: Measured) -> Variables:
    """Record in SI: what is measured, all motion of the rings, loads of the balls."""
    run = results.run
    balls = run.assembled.arrays.balls
    motion = sampled(run.motion, OVERSAMPLED)
    loads = run.loads[::OVERSAMPLED].astype(np.float32)
    rings = {
        "inner_displacement": (INNER, OUTER, "freedom", "m, rad"),
        "outer_displacement": (OUTER, SENSOR, "axis", "m"),
    }
    variables: Variables = {
        "time": (("time",), seen.time, {"units": "s"}),
        "freedom": (("freedom",), np.array(("x", "y", "z", "ty", "tz"), dtype=object), {}),
        "axis": (("axis",), np.array(("x", "y", "z"), dtype=object), {}),
        "ball": (("ball",), np.arange(1, balls + 1), {}),
        "turned_time": (("time",), seen.turned, {"units": "s"}),
        "displacement": (("time",), seen.displacement, {"units": "m"}),
        "velocity": (("time",), seen.velocity, {"units": "m/s"}),
        "acceleration": (("time",), seen.acceleration, {"units": "m/s2"}),
        "inner_load": (("time", "ball"), loads[:, :balls], {"units": "N"}),
        "outer_load": (("time", "ball"), loads[:, balls:], {"units": "N"}),
    }
    for name, (first, last, axis, unit) in rings.items():
        variables[name] = (("time", axis), motion[:, first:last], {"units": unit})
    return variables

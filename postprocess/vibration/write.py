"""Files of a vibration, pictures, record, spectra and sound, and its table."""

import io
import wave
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from rich.console import Group

from oilfilm.bearing.files import write_bytes
from oilfilm.bearing.vibration.inputs import VibrationOptions
from oilfilm.bearing.vibration.simulation import INNER, OUTER, OVERSAMPLED, SENSOR
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from .. import plot_style
from ..files import CsvTable
from ..netcdf_write import StudyFiles, Variables, root_attributes, write_dataset, write_study
from ..quantities import facts_table, number, number_table, titled
from .results import (
    Measured,
    Spectrum,
    VibrationResults,
    by_order,
    envelope,
    envelope_band,
    measured,
    sampled,
    shaft_frequency,
    spectrum,
    waterfall,
)
from .summary import envelope_fact, vibration_summary

FULL = 0.9  # of the largest value that 16 bits hold
LIMIT = 32767
FLOOR = 1e-6  # of the largest line, below which nothing is drawn [-]
DEPTH = 60.0  # of the colours of a waterfall [dB]
SHOWN_TURNS = 4.0  # of the shaft, in the picture over time
LEAST_ORDER = 0.1  # of the shaft, lowest frequency of a spectrum [-]
SHOWN_PASSES = 8.0  # highest frequency of an envelope, over that of the inner ring's passes [-]
MARKERS = {
    "cage": plot_style.CAGE_COLOUR,
    "ball_pass_outer": plot_style.OUTER_COLOUR,
    "ball_pass_inner": plot_style.INNER_COLOUR,
    "ball_spin": plot_style.BALL_COLOUR,
}
AUDIO_FILE = "vibration.wav"
LINE_KEYS = (
    "source name order_number direction frequency_Hz displacement_um velocity_um_s "
    "acceleration_m_s2"
).split()
SHOWN = 14  # lines at most
HEADERS = ("line", "name", "Hz", "nm", "µm/s", "m/s²")


def write_audio(signal: Array, rate: float, path: Path) -> float:
    """Write a signal as sound, scaled to full size.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].
    path : Path
        WAVE file.

    Returns
    -------
    float
        Value at full size in the unit of the signal; 0 of a still one.
    """
    part = signal - signal.mean()
    largest = float(abs(part).max())
    scaled = part / largest if largest > 0.0 else part
    values = np.round(FULL * LIMIT * scaled).astype("<i2")
    content = io.BytesIO()
    with wave.open(content, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(round(rate))
        file.writeframes(values.tobytes())
    write_bytes(path, content.getvalue())
    return largest / FULL


def write_vibration_plots(
    results: VibrationResults,
    seen: Measured,
    document: dict[str, Any],
    directory: Path,
    is_interrupted: Callable[[], bool],
) -> tuple[str, ...]:
    """Write the pictures; those that failed are messages.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : dict[str, Any]
        Summary of the results in named units.
    directory : Path
        Folder to write into.
    is_interrupted : Callable[[], bool]
        Asked before each picture; once it is true no further one is drawn.

    Returns
    -------
    tuple[str, ...]
        Messages on pictures that failed.
    """
    given: dict[str, Any] = {"results": results, "seen": seen, "document": document}
    pictures = {
        "time": draw_time,
        "spectrum": draw_spectrum,
        "orders": draw_orders,
        "envelope": draw_envelope,
        "waterfall": draw_waterfall,
        "ball_loads": draw_loads,
    }
    folder = directory / "plots"
    folder.mkdir(exist_ok=True)
    drawings = [(name, partial(draw, **given)) for name, draw in pictures.items()]
    return plot_style.write_figures(folder, drawings, is_interrupted)


def draw_time(figure: Figure, results: VibrationResults, seen: Measured, document: Any) -> None:
    """Acceleration [m/s^2], velocity [um/s] and displacement [um] over the last turns [ms].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    rows = plot_style.titled_panels(
        figure, f"{results.title}: {document['vibration']['measured']}", 4.6, 3, 1, sharex=True
    )
    span = SHOWN_TURNS / shaft_frequency(results.run)
    shown = seen.time >= seen.time[-1] - span
    time = from_si("x_ms", seen.time[shown])
    for axes, values, label in (
        (rows[0], seen.acceleration, "acceleration [m/s²]"),
        (rows[1], from_si("x_um_s", seen.velocity), "velocity [µm/s]"),
        (rows[2], from_si("x_um", seen.displacement - seen.displacement.mean()), "shift [µm]"),
    ):
        axes.plot(time, values[shown], color=plot_style.INK, linewidth=0.7)
        axes.set_ylabel(label)
        axes.grid(linewidth=0.3, alpha=0.5)
    rows[2].set_xlabel("time [ms]")
    rows[2].set_xlim(time[0], time[-1])


def draw_spectrum(
    figure: Figure, results: VibrationResults, seen: Measured, document: Any
) -> None:
    """Velocity [um/s] over frequency [Hz], with bands and the lines that are expected.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    axes = plot_style.titled_panels(
        figure, f"{results.title}: {document['vibration']['measured']}", 3.4
    )
    result = spectrum(seen.velocity, seen.rate)
    top = _decades(axes, result, "x_um_s")
    axes.set_xscale("log")
    slowest = LEAST_ORDER * shaft_frequency(results.run)
    axes.set_xlim(max(result.frequency[1], slowest), 0.5 * seen.rate)
    steady = results.run.model.options.start_speed_ratio == 1.0
    lines = document["vibration"]["lines"] if steady else []
    shown = [line for line in lines if (line["velocity_um_s"] or 0.0) > 1e-4 * top]
    for line in shown:
        axes.plot(
            line["frequency_Hz"], line["velocity_um_s"], "o", color=plot_style.OUTER_COLOUR, ms=3
        )
    if steady:
        for band in document["vibration"]["bands_Hz"].values():
            for edge in band:
                axes.axvline(edge, color=plot_style.REFERENCE, linewidth=0.5, linestyle=":")
        note = "dots: lines expected from the form of the surfaces; dotted: bands of ISO 15242-2"
        axes.set_title(f"{note}, scaled with the speed", fontsize=7)
    axes.set(xlabel="frequency [Hz]", ylabel="velocity [µm/s]")


def draw_orders(figure: Figure, results: VibrationResults, seen: Measured, document: Any) -> None:
    """Velocity [um/s] over the order of the shaft, with the passing balls.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    axes = plot_style.titled_panels(figure, f"{results.title}: orders of the shaft", 3.2)
    result = by_order(seen.velocity, seen.turned, results.run.solution.operation.shaft_speed)
    _decades(axes, result, "x_um_s")
    shaft = shaft_frequency(results.run)
    passes = document["frequencies_Hz"]["with_slip"]
    axes.set_xlim(0.0, min(result.frequency[-1], 6.0 * passes["ball_pass_inner"] / shaft))
    _mark(axes, {name: f / shaft for name, f in passes.items()}, "-")
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    axes.set(xlabel="order [-]", ylabel="velocity [µm/s]")


def draw_envelope(
    figure: Figure, results: VibrationResults, seen: Measured, document: Any
) -> None:
    """Envelope of the acceleration [m/s^2] over frequency [Hz], marks kinematic and with slip.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    band = envelope_band(results)
    title = f"{results.title}: envelope of {band[0]:.0f} to {band[1]:.0f} Hz"
    axes = plot_style.titled_panels(figure, title, 3.2)
    size = envelope(seen.acceleration, seen.rate, band)
    result = spectrum(size, seen.rate)
    axes.plot(result.frequency, result.amplitude, color=plot_style.INK, linewidth=0.7)
    kinds = document["frequencies_Hz"]
    _mark(axes, kinds["with_slip"], "-")
    _mark(axes, kinds["kinematic"], ":", named=False)
    axes.set_xlim(0.0, min(SHOWN_PASSES * kinds["with_slip"]["ball_pass_inner"], 0.5 * seen.rate))
    axes.set_ylim(bottom=0.0)
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    axes.set_xlabel("frequency [Hz]; lines: with the cage speed of the run, dotted: kinematic")
    axes.set_ylabel("envelope [m/s²]")


def draw_waterfall(
    figure: Figure, results: VibrationResults, seen: Measured, document: Any
) -> None:
    """Acceleration [dB] over time [s], in a run-up over speed [r/min], and frequency [Hz].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    axes = plot_style.titled_panels(
        figure, f"{results.title}: {document['vibration']['measured']}", 3.8
    )
    time, frequency, size = waterfall(seen.acceleration, seen.rate)
    options = results.run.model.options
    levels = 20.0 * np.log10(np.maximum(size, 1e-300) / results.reference)
    label = "time [s]"
    place = time
    if options.start_speed_ratio != 1.0:
        label = "speed of the shaft [r/min]"
        place = _speed(options, place) * shaft_frequency(results.run) * 60.0
    top = float(levels.max())
    mesh = axes.pcolormesh(place, frequency, levels, vmin=top - DEPTH, vmax=top, rasterized=True)
    bar = figure.colorbar(mesh, ax=axes)
    bar.set_label(f"acceleration [dB re {results.reference:g} m/s²]")
    axes.set(xlabel=label, ylabel="frequency [Hz]")
    loud = frequency[levels.max(axis=1) > top - DEPTH]
    axes.set_ylim(0.0, min(1.1 * loud[-1], 0.5 * seen.rate))


def draw_loads(figure: Figure, results: VibrationResults, seen: Measured, document: Any) -> None:
    """Loads of all balls at the outer race [N] over the last turns [ms].

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : VibrationResults
        Vibration of the case.
    seen : Measured
        Measured motion of the body that the case names.
    document : Any
        Summary of the results in named units.
    """
    axes = plot_style.titled_panels(figure, f"{results.title}: loads of the balls", 3.2)
    run = results.run
    balls = run.solution.bearing.balls
    time = np.arange(len(run.loads)) * (run.model.options.duration / len(run.loads))
    shown = time >= time[-1] - SHOWN_TURNS / shaft_frequency(run)
    for j in range(balls):
        colour = plot_style.INK if j == 0 else plot_style.BALL_COLOUR
        values = run.loads[shown, balls + j]
        axes.plot(from_si("x_ms", time[shown]), values, color=colour, linewidth=0.6)
    axes.set(xlabel="time [ms]; ball 1 in black", ylabel="load at the outer race [N]")
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.set_ylim(bottom=0.0)


def _speed(options: VibrationOptions, time: Any) -> Any:
    """Speed over that at the end [-] at times [s]."""
    start = options.start_speed_ratio
    return start + (1.0 - start) * time / options.duration


def _decades(axes: Any, result: Spectrum, key: str) -> float:
    """Amplitudes on a logarithmic axis, down to `FLOOR` of the largest, which is returned."""
    values = from_si(key, result.amplitude)
    top = float(values[1:].max())
    axes.set_yscale("log")
    axes.plot(
        result.frequency, np.maximum(values, FLOOR * top), color=plot_style.INK, linewidth=0.6
    )
    if top > 0.0:
        axes.set_ylim(FLOOR * top, 3.0 * top)
    axes.grid(linewidth=0.3, alpha=0.5)
    return top


def _mark(axes: Any, places: dict[str, float], style: str, *, named: bool = True) -> None:
    """Vertical lines at the passing frequencies."""
    for name, place in places.items():
        label = name.replace("_", " ") if named else None
        colour = MARKERS[name]
        axes.axvline(place, color=colour, linewidth=0.8, linestyle=style, alpha=0.7, label=label)


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
    is_interrupted : Callable[[], bool], default lambda: False
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


def write_record(results: VibrationResults, path: Path, document: dict[str, Any]) -> None:
    """Write the record alone as netCDF, with its case and levels as attributes.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.
    path : Path
        File to write.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    variables = _variables(results, measured(results))
    write_dataset(variables, root_attributes(document, "vibration"), path)


def _tables(
    results: VibrationResults, seen: Measured, lines: list[dict[str, object]]
) -> dict[str, CsvTable]:
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
    balls = run.solution.bearing.balls
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


def vibration_table(document: dict[str, Any]) -> Group:
    """Levels with their reference, bands, and the largest lines.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    result = document["vibration"]
    bands = result["bands_Hz"]
    facts = {
        "measured": result["measured"],
        "acceleration": (
            f"{number(result['acceleration_m_s2'])} m/s² rms, "
            f"{number(result['acceleration_dB'])} dB re {result['reference_m_s2']:g} m/s²"
        ),
        "velocity": f"{number(result['velocity_um_s'])} µm/s rms",
        "displacement": f"{number(result['displacement_um'])} µm rms",
    }
    for name, level in result["bands_um_s"].items():
        low, high = bands[name]
        facts[f"{name} {low:.4g}-{high:.4g} Hz"] = (
            f"{number(level)} µm/s, {number(result['anderon'][name])} anderon"
        )
    cage = document["cage_speed_rpm"]
    facts["cage"] = f"{cage:.1f} r/min, {number(document['cage_speed_ratio'], '.5f')} of rolling"
    if document["friction_torque_N_mm"] is not None:
        facts["friction torque"] = f"{number(document['friction_torque_N_mm'])} N mm"
    facts |= envelope_fact(result)
    lines = sorted(result["lines"], key=lambda line: -(line["displacement_um"] or 0.0))[:SHOWN]
    rows = [
        [
            line["source"],
            line["name"],
            f"{line['frequency_Hz']:.1f}",
            number(None if line["displacement_um"] is None else 1e3 * line["displacement_um"]),
            number(line["velocity_um_s"]),
            number(line["acceleration_m_s2"]),
        ]
        for line in lines
    ]
    return titled(
        document["case"].get("title", ""),
        facts_table(facts),
        number_table(HEADERS, rows, ("line", "name")),
    )

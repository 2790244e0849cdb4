"""The motion that is looked at: of the sensor, the outer ring, or the inner one."""

from dataclasses import dataclass
from math import pi

import numpy as np

from bearing.vibration.assembly import AXES, BALLS, INNER, OUTER, SENSOR
from bearing.vibration.inputs import Direction
from bearing.vibration.simulation import OVERSAMPLED, VibrationRun
from ehl.arrays import Array

from .results import VibrationResults
from .signals import EDGE, answered, sampled, speed_bands


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """One direction of the motion of a body, evenly sampled; arrays of shape (n,)."""

    body: str
    direction: Direction
    rate: float  # [Hz]
    time: Array  # [s]
    turned: Array  # time that would have turned the rings as far at the end's speeds [s]
    displacement: Array  # [m]
    velocity: Array  # [m/s]
    acceleration: Array  # through a given frequency response [m/s^2]


def measured(results: VibrationResults) -> Measured:
    """Motion of the body and direction that a case names, SI.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.

    Returns
    -------
    Measured
        The motion.
    """
    run = results.run
    body, first = measured_body(run, results.direction)
    rate = run.model.options.sample_rate
    columns = first + BALLS * np.arange(3)
    motion = sampled(run.motion[:, columns], OVERSAMPLED)
    time = np.arange(len(motion)) / rate
    acceleration = motion[:, 2]
    if results.response is not None:
        acceleration = answered(acceleration, rate, results.response)
    return Measured(
        body=body,
        direction=results.direction,
        rate=rate,
        time=time,
        turned=turned_time(run, time),
        displacement=motion[:, 0],
        velocity=motion[:, 1],
        acceleration=acceleration,
    )


def measured_body(run: VibrationRun, direction: Direction) -> tuple[str, int]:
    """Body whose motion is measured, and its coordinate.

    Parameters
    ----------
    run : VibrationRun
        Vibration over time.
    direction : Direction
        Direction of the motion.

    Returns
    -------
    value
        Name of the body.
    value
        Its coordinate in the state [-].
    """
    support = run.model.support
    if support.sensor is not None and direction is Direction.Y:
        return "sensor", SENSOR
    if support.outer_moves:
        return "outer ring", OUTER + AXES[direction]
    return "inner ring", INNER + AXES[direction]


def turned_time(run: VibrationRun, time: Array) -> Array:
    """Time that would have turned the rings as far at the speeds of the end.

    Parameters
    ----------
    run : VibrationRun
        Vibration over time.
    time : Array
        Times of the samples, shape (n,) [s].

    Returns
    -------
    Array
        Time, shape (n,) [s].
    """
    start = run.model.options.start_speed_ratio
    return start * time + 0.5 * (1.0 - start) * time**2 / run.model.options.duration


def envelope_band(results: VibrationResults) -> tuple[float, float]:
    """Band of the envelope: given, or the high band of ISO 15242-2 as far as it is sampled.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.

    Returns
    -------
    tuple[float, float]
        Lower and upper frequency [Hz].
    """
    if results.envelope_band is not None:
        return results.envelope_band
    rate = results.run.model.options.sample_rate
    low, high = speed_bands(results.run.solution.operation.shaft_speed)["high"]
    top = min(high, EDGE * rate)
    return min(low, 0.5 * top), top


def shaft_frequency(run: VibrationRun) -> float:
    """Frequency of the inner ring against the outer one at the end.

    Parameters
    ----------
    run : VibrationRun
        Vibration over time.

    Returns
    -------
    float
        Frequency [Hz].
    """
    return run.solution.operation.shaft_speed / (2.0 * pi)

"""The motion that is looked at: of the sensor, the outer ring, or the inner one."""

from dataclasses import dataclass
from math import pi

import numpy as np

from bearing.geometry import Array
from bearing.vibration.arrays import BALLS, INNER, OUTER, SENSOR
from bearing.vibration.assembly import AXES
from bearing.vibration.inputs import Direction
from bearing.vibration.simulation import OVERSAMPLED, VibrationRun

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
    """What a case looks at, SI."""
    run = results.run
    body, first = body_of(run, results.direction)
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


def body_of(run: VibrationRun, direction: Direction) -> tuple[str, int]:
    """The body that is looked at, and its coordinate in the state [-]."""
    support = run.model.support
    if support.sensor is not None and direction is Direction.Y:
        return "sensor", SENSOR
    if support.outer_moves:
        return "outer ring", OUTER + AXES[direction]
    return "inner ring", INNER + AXES[direction]


def turned_time(run: VibrationRun, time: Array) -> Array:
    """Time that would have turned the rings as far at the end's speeds [s]."""
    start = run.model.options.start_speed_ratio
    return start * time + 0.5 * (1.0 - start) * time**2 / run.model.options.duration


def envelope_band(results: VibrationResults) -> tuple[float, float]:
    """Band of the envelope: given, or the high band of ISO 15242-2 at the end's speed, at least
    from a twentieth of the sample rate down and up to what is sampled [Hz].
    """
    if results.envelope_band is not None:
        return results.envelope_band
    rate = results.run.model.options.sample_rate
    low, high = speed_bands(results.run.solution.operation.shaft_speed)["high"]
    top = min(high, EDGE * rate)
    return min(low, 0.5 * top), top


def shaft_frequency(run: VibrationRun) -> float:
    """Of the inner ring against the outer one at the end [Hz]."""
    return run.solution.operation.shaft_speed / (2.0 * pi)

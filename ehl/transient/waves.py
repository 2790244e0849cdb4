"""Amplitude of a wave in the film, and what the film leaves of a waviness."""

from dataclasses import dataclass
from math import inf, pi

import numpy as np

from ..arrays import Array
from ..closed_form.film import waviness_amplitude_ratio
from .inputs import Waviness
from .record import TransientSolution

FIT_LUBRICANT = 10.0  # least L that the fit holds for
FIT_RANGE = (0.8, 7.0)  # of (lambda/a) sqrt(M/L)
WAVES = 1.5  # that pass before the amplitude is taken, the first of which rises
CIRCULARITY = 1e-3  # deviation of the ellipse from a circle


@dataclass(frozen=True, slots=True, kw_only=True)
class WaveResult:
    """Amplitude of one waviness in the film at the contact's centre."""

    feature: int  # number of the waviness among the features, from 0
    frequency: float | None = None  # of its passing [Hz]
    amplitude: float | None = None  # first harmonic of the film there [m]
    ratio: float | None = None  # over that of the waviness [-]
    fit: float | None = None  # Venner's for pure rolling, where it holds [-]
    reason: str = ""  # why there is none


def harmonic(times: Array, values: Array, frequency: float) -> complex:
    """Fit the first harmonic and the mean to values at uneven times by least squares.

    Parameters
    ----------
    times : Array
        times, shape (n,) [s]
    values : Array
        values, shape (n,), in any unit
    frequency : float
        frequency f of the harmonic [Hz]

    Returns
    -------
    complex
        factor of exp(2 pi i f t), in the unit of the values
    """
    angle = 2.0 * pi * frequency * times
    columns = np.stack((np.ones_like(times), np.cos(angle), np.sin(angle)), axis=1)
    _, cosine, sine = np.linalg.lstsq(columns, values, rcond=None)[0]
    return complex(cosine, -sine)


def wave_results(solution: TransientSolution) -> tuple[WaveResult, ...]:
    """Evaluate all wavinesses over the last period that passed the centre.

    Parameters
    ----------
    solution : TransientSolution
        contact over time

    Returns
    -------
    tuple[WaveResult, ...]
        one result a waviness
    """
    return tuple(
        _wave(solution, number, one)
        for number, one in enumerate(solution.conditions.features)
        if isinstance(one, Waviness)
    )


def _wave(solution: TransientSolution, number: int, wave: Waviness) -> WaveResult:
    conditions = solution.conditions
    time = solution.series("time")
    fraction = conditions.body_speed_ratio(wave.body)[0]
    for name in ("speed", "load"):
        if np.ptp(solution.series(name)) > 0.0:
            return WaveResult(feature=number, reason=f"the {name} changes")
    if conditions.impact is not None:
        return WaveResult(feature=number, reason="the bodies meet")
    speed = fraction * conditions.speed_at(0.0)
    if speed == 0.0:
        return WaveResult(feature=number, reason="its body is at rest")
    frequency = abs(speed) / wave.wavelength
    last = time > time[-1] - 1.0 / frequency * (1.0 + 1e-9)
    # the wave passes the centre in full, and so does what it made in the inlet
    slowest = min(speed, conditions.speed_at(0.0))
    arrived = (WAVES * wave.wavelength - solution.starts[number]) / slowest
    if time[last][0] < arrived:
        needed = arrived + 1.0 / frequency
        return WaveResult(
            feature=number,
            frequency=frequency,
            reason=f"the film at the centre has not passed a period; end_time of {needed:.3g} s",
        )
    values = solution.series("film_central")[last]
    amplitude = abs(harmonic(time[last], values, frequency))
    return WaveResult(
        feature=number,
        frequency=frequency,
        amplitude=amplitude,
        ratio=amplitude / abs(wave.amplitude) if wave.amplitude else None,
        fit=_fit(solution, wave),
    )


def _fit(solution: TransientSolution, wave: Waviness) -> float | None:
    """Venner's amplitude in pure rolling; None where his fit is not of the case."""
    c = solution.conditions.contact
    load, lubricant = solution.moes
    rolling = c.slide_roll_ratio == 0.0 and c.lateral_slide_ratio == 0.0
    circular = abs(c.radius_x / c.radius_y - 1.0) < CIRCULARITY
    if not rolling or not circular or lubricant < FIT_LUBRICANT * (1.0 - 1e-3):
        return None
    a = solution.semi_axes[0]
    across = inf if wave.wavelength_across is None else wave.wavelength_across / a
    lengths = (wave.wavelength / a, across)
    x = min(lengths) * (load / lubricant) ** 0.5
    return (
        waviness_amplitude_ratio(lengths, load, lubricant)
        if FIT_RANGE[0] <= x <= FIT_RANGE[1]
        else None
    )

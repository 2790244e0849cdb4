"""A vibration: results, the motion that is measured, its levels, lines and spectra."""

from dataclasses import dataclass
from math import log2, pi, sqrt

import numpy as np
import scipy

from oilfilm.bearing.vibration.inputs import Direction
from oilfilm.bearing.vibration.simulation import (
    AXES,
    BODIES,
    INNER,
    OUTER,
    OVERSAMPLED,
    SENSOR,
    VibrationRun,
)
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import RPM

from ..quantities import Results

ENERGY_LIMIT = 1.0e-3  # of stored energy and works: a larger imbalance is flagged [-]
# bands of ISO 15242-2 at 1800 r/min [Hz]; they scale with the speed
BANDS = {"low": (50.0, 300.0), "medium": (300.0, 1800.0), "high": (1800.0, 10000.0)}
BAND_SPEED = 1800.0 * RPM  # [rad/s]
ANDERON = 7.5e-6  # for each square root of an octave [m/s]
EDGE = 0.45  # of the sample rate, up to which the filter against aliasing passes [-]
PIECES = 60  # of a waterfall, one beside the other
COLUMNS = 200  # of its picture


@dataclass(frozen=True, slots=True, kw_only=True)
class VibrationResults(Results):
    """Vibration of one case over time."""

    run: VibrationRun
    direction: Direction
    reference: float  # of levels of acceleration [m/s^2]
    envelope_band: tuple[float, float] | None  # [Hz]; None: the high band, as far as it is sampled
    response: Array | None  # frequency [Hz], amplitude ratio [-], phase [rad], shape (n, 3)

    @property
    def converged(self) -> bool:
        """True if the motion stayed finite and energies balance."""
        return self.run.energy_balance_error <= ENERGY_LIMIT  # false of what is not a number


@dataclass(frozen=True, slots=True)
class Spectrum:
    """Amplitudes (half from trough to crest) over frequency."""

    frequency: Array  # [Hz], or the order [-]
    amplitude: Array  # in the unit of the signal


def sampled(fine: Array, factor: int) -> Array:
    """Fewer samples of columns, higher frequencies filtered out.

    Parameters
    ----------
    fine : Array
        Columns of values, shape (n, columns) [any unit].
    factor : int
        Samples of which one is taken [-].

    Returns
    -------
    Array
        Every factor-th value, shape (m, columns).
    """
    mean = fine.mean(axis=0)
    return np.asarray(scipy.signal.resample_poly(fine - mean, 1, factor, axis=0) + mean)


def spectrum(signal: Array, rate: float) -> Spectrum:
    """Amplitudes of a signal without its mean, Hann's window.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].

    Returns
    -------
    Spectrum
        Amplitudes over frequency.
    """
    window = scipy.signal.get_window("hann", signal.size)
    values = np.fft.rfft((signal - signal.mean()) * window)
    return Spectrum(
        np.asarray(np.fft.rfftfreq(signal.size, 1.0 / rate), dtype=np.float64),
        2.0 * abs(values) / window.sum(),
    )


def largest_lines(result: Spectrum, count: int, above: float = 0.0) -> list[tuple[float, float]]:
    """Largest peaks of a spectrum, placed between its bins by the larger neighbour (Grandke, 1983:
    (2 r - 1)/(1 + r) of a bin, r of the top, exact for one line in Hann's window).

    Parameters
    ----------
    result : Spectrum
        Spectrum with Hann's window.
    count : int
        Peaks at most [-].
    above : float, default 0.0
        Frequency below which there is none [Hz].

    Returns
    -------
    list[tuple[float, float]]
        Frequency [Hz] and amplitude of the top bin, the largest first.
    """
    size = np.where(result.frequency > above, result.amplitude, 0.0)
    inner = size[1:-1]
    tops = 1 + np.flatnonzero((inner > size[:-2]) & (inner >= size[2:]) & (inner > 0.0))
    tops = tops[np.argsort(-size[tops])][:count]
    beside = size[tops + 1] - size[tops - 1]
    ratio = np.maximum(size[tops + 1], size[tops - 1]) / size[tops]
    places = tops + np.sign(beside) * np.maximum(2.0 * ratio - 1.0, 0.0) / (1.0 + ratio)
    return list(zip((places * result.frequency[1]).tolist(), size[tops].tolist(), strict=True))


def band_rms(signal: Array, rate: float, band: tuple[float, float]) -> float:
    """Root mean square of a signal within a band, Hann's window.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].
    band : tuple[float, float]
        Lower and upper frequency [Hz].

    Returns
    -------
    float
        Root mean square in the unit of the signal.
    """
    window = scipy.signal.get_window("hann", signal.size)
    values = np.fft.rfft((signal - signal.mean()) * window)
    frequency = np.fft.rfftfreq(signal.size, 1.0 / rate)
    inside = (frequency >= band[0]) & (frequency < band[1])
    power = 2.0 * (abs(values[inside]) ** 2).sum() / (signal.size * (window**2).sum())
    return float(sqrt(power))


def speed_bands(speed: float) -> dict[str, tuple[float, float]]:
    """Bands of ISO 15242-2, in proportion to the speed.

    Parameters
    ----------
    speed : float
        Speed of the shaft [rad/s].

    Returns
    -------
    dict[str, tuple[float, float]]
        Lower and upper frequency by name [Hz].
    """
    scale = abs(speed) / BAND_SPEED
    return {name: (low * scale, high * scale) for name, (low, high) in BANDS.items()}


def anderon(velocity: float, band: tuple[float, float]) -> float:
    """Velocity within a band in anderon: 7.5 um/s for each root of an octave.

    Parameters
    ----------
    velocity : float
        Velocity within the band [m/s].
    band : tuple[float, float]
        Lower and upper frequency [Hz].

    Returns
    -------
    float
        Velocity [anderon].
    """
    return velocity / (ANDERON * sqrt(log2(band[1] / band[0])))


def amplitude_at(signal: Array, turned: Array, frequency: float) -> float:
    """Amplitude of a signal at a frequency.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    turned : Array
        Time that would have turned the rings as far at the speeds of the end, shape (n,) [s].
    frequency : float
        Frequency at the speeds of the end [Hz].

    Returns
    -------
    float
        Amplitude in the unit of the signal.
    """
    window = scipy.signal.get_window("hann", signal.size)
    wave = np.exp(-2j * pi * frequency * turned)
    size = abs(np.sum(window * (signal - signal.mean()) * wave))
    return float(2.0 * size / window.sum())


def by_order(signal: Array, turned: Array, speed: float) -> Spectrum:
    """Amplitudes of a signal over the order of the shaft, evenly sampled by its angle.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    turned : Array
        Time that would have turned the rings as far at the speeds of the end, shape (n,) [s].
    speed : float
        Speed of the shaft at the end [rad/s].

    Returns
    -------
    Spectrum
        Amplitudes over the order [-].
    """
    even = np.linspace(turned[0], turned[-1], signal.size)
    result = spectrum(np.interp(even, turned, signal), 1.0 / (even[1] - even[0]))
    orders = result.frequency * 2.0 * pi / abs(speed)
    return Spectrum(orders, result.amplitude)


def envelope(signal: Array, rate: float, band: tuple[float, float]) -> Array:
    """Envelope of a signal that is limited to a band (Hilbert).

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].
    band : tuple[float, float]
        Lower and upper frequency [Hz].

    Returns
    -------
    Array
        Envelope, shape (n,) in the unit of the signal.
    """
    values = np.fft.rfft(signal)
    frequency = np.fft.rfftfreq(signal.size, 1.0 / rate)
    values[(frequency < band[0]) | (frequency > band[1])] = 0.0
    return np.asarray(abs(scipy.signal.hilbert(np.fft.irfft(values, signal.size))))


def kurtosis(signal: Array) -> float | None:
    """Fourth moment over the square of the second, 3 of noise.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].

    Returns
    -------
    float | None
        Kurtosis [-]; None of a still signal.
    """
    part = signal - signal.mean()
    square = float((part**2).mean())
    return float((part**4).mean()) / square**2 if square > 0.0 else None


def waterfall(signal: Array, rate: float) -> tuple[Array, Array, Array]:
    """Amplitudes of short pieces of a signal.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].

    Returns
    -------
    value
        Time, shape (m,) [s].
    value
        Frequency, shape (k,) [Hz].
    value
        Amplitude, shape (k, m) in the unit of the signal.
    """
    size = max(64, signal.size // PIECES)
    window = scipy.signal.get_window("hann", size)
    hop = max(1, (signal.size - size) // COLUMNS)
    transform = scipy.signal.ShortTimeFFT(window, hop, rate, scale_to="magnitude")
    values = 2.0 * abs(transform.stft(signal - signal.mean()))
    whole = slice(
        transform.lower_border_end[1] - transform.p_min,
        transform.upper_border_begin(signal.size)[1] - transform.p_min,
    )
    time = transform.t(signal.size)[whole]
    return time, transform.f, np.asarray(values[:, whole], dtype=np.float64)


def answered(signal: Array, rate: float, response: Array) -> Array:
    """A signal through a frequency response, zero outside of its frequencies.

    Parameters
    ----------
    signal : Array
        Signal, shape (n,) [any unit].
    rate : float
        Sample rate [Hz].
    response : Array
        Frequency [Hz], amplitude ratio [-] and phase [rad], shape (m, 3).

    Returns
    -------
    Array
        Signal, shape (n,) in its unit.
    """
    values = np.fft.rfft(signal - signal.mean())
    frequency = np.fft.rfftfreq(signal.size, 1.0 / rate)
    at, size, phase = response.T
    gain = np.interp(frequency, at, size, left=0.0, right=0.0)
    turn = np.interp(frequency, at, np.unwrap(phase))
    return np.asarray(np.fft.irfft(values * gain * np.exp(1j * turn), signal.size))


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
    columns = first + BODIES * np.arange(3)
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

"""The vibration as sound: a WAVE file of 16 bits."""

import io
import wave
from pathlib import Path

import numpy as np

from bearing.files import write_bytes
from ehl.arrays import Array

FULL = 0.9  # of the largest value that 16 bits hold
LIMIT = 32767


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

"""Levels, lines and spectra of signals that are known."""

import numpy as np
from numpy.testing import assert_allclose

from oilfilm.postprocess.vibration.results import (
    BANDS,
    amplitude_at,
    anderon,
    answered,
    band_rms,
    by_order,
    envelope,
    kurtosis,
    largest_lines,
    sampled,
    spectrum,
    speed_bands,
)

RATE = 20000.0
TIME = np.arange(20000) / RATE


def test_levels_of_a_sine():
    signal = 3.0 + 0.5 * np.sin(2.0 * np.pi * 400.0 * TIME)
    assert_allclose(band_rms(signal, RATE, BANDS["medium"]), 0.5 / np.sqrt(2.0), rtol=1e-3)
    assert band_rms(signal, RATE, BANDS["low"]) < 1e-3
    assert_allclose(amplitude_at(signal, TIME, 400.0), 0.5, rtol=1e-6)
    assert amplitude_at(signal, TIME, 550.0) < 1e-6
    found = spectrum(signal, RATE)
    assert_allclose(found.amplitude.max(), 0.5, rtol=1e-6)
    assert found.frequency[found.amplitude.argmax()] == 400.0
    assert_allclose(kurtosis(signal), 1.5, rtol=1e-6)
    assert kurtosis(np.ones(50)) is None


def test_peaks_stand_between_bins():
    """Two lines off their bins of 1 Hz, to a hundredth of a bin beside each other; none below a limit."""
    signal = np.sin(2.0 * np.pi * 146.37 * TIME) + 0.3 * np.cos(2.0 * np.pi * 116.9 * TIME)
    (high, _), (low, _) = largest_lines(spectrum(signal, RATE), 2)
    assert_allclose([high, low], [146.37, 116.9], atol=0.01)
    assert all(frequency > 130.0 for frequency, _ in largest_lines(spectrum(signal, RATE), 9, 130.0))


def test_anderon_and_bands():
    """1 anderon is 12.06 um/s in the low and medium, 11.80 in the high band."""
    assert_allclose(
        [1e6 / anderon(1.0, BANDS[name]) for name in ("low", "medium", "high")], [12.06, 12.06, 11.80], atol=0.005
    )
    assert_allclose(speed_bands(-3600.0 * np.pi / 30.0)["low"], (100.0, 600.0))


def test_the_envelope_of_a_modulated_carrier():
    carrier = (1.0 + 0.4 * np.cos(2.0 * np.pi * 107.0 * TIME)) * np.sin(2.0 * np.pi * 3000.0 * TIME)
    size = envelope(carrier + np.sin(2.0 * np.pi * 50.0 * TIME), RATE, (2000.0, 4000.0))
    assert_allclose(amplitude_at(size, TIME, 107.0), 0.4, rtol=1e-3)
    assert amplitude_at(size, TIME, 50.0) < 1e-3


def test_orders_of_a_run_up():
    """Order 7 stays at 7 although its frequency rises to five times the first."""
    turned = 0.2 * TIME + 0.4 * TIME**2
    shaft = 2.0 * np.pi * 50.0
    found = by_order(np.sin(7.0 * shaft * turned), turned, shaft)
    assert abs(found.frequency[found.amplitude.argmax()] - 7.0) < 0.1
    assert_allclose(found.amplitude.max(), 1.0, rtol=0.05)
    assert_allclose(amplitude_at(np.sin(7.0 * shaft * turned), turned, 350.0), 1.0, rtol=0.02)


def test_a_given_response_scales_and_turns():
    response = np.array([[0.0, 2.0, 0.5 * np.pi], [5000.0, 2.0, 0.5 * np.pi]])
    signal = np.sin(2.0 * np.pi * 400.0 * TIME)
    assert_allclose(answered(signal, RATE, response), 2.0 * np.cos(2.0 * np.pi * 400.0 * TIME), atol=1e-9)
    assert abs(answered(np.sin(2.0 * np.pi * 7000.0 * TIME), RATE, response)).max() < 1e-9


def test_samples_without_aliases():
    fine = np.arange(80000) / (4.0 * RATE)
    both = np.stack([np.sin(2.0 * np.pi * 1000.0 * fine), np.sin(2.0 * np.pi * 13000.0 * fine)], axis=1)
    kept = sampled(both, 4)
    inner = slice(200, -200)
    assert_allclose(kept[inner, 0], np.sin(2.0 * np.pi * 1000.0 * TIME)[inner], atol=2e-3)
    assert abs(kept[inner, 1]).max() < 5e-3

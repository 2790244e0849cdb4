"""Relubrication interval: by hand, halved by heat, none where the formula ends."""

from __future__ import annotations

from math import pi

import pytest

from oilfilm.bearing.rating.life import relubrication_interval

RPM = pi / 30.0


def hours(bore, rpm, celsius):
    found = relubrication_interval(bore, rpm * RPM, celsius + 273.15)
    return None if found is None else found / 3600.0


def test_by_hand():
    """6208 at 3000 r/min: 10 (14e6/(3000 x 6.3246) - 160) = 5778.7 h; 85 degrees halve it, 50 change nothing."""
    assert hours(0.040, 3000.0, 70.0) == pytest.approx(5778.65, abs=0.1)
    assert hours(0.040, 3000.0, 50.0) == hours(0.040, -3000.0, 70.0) == hours(0.040, 3000.0, 70.0)
    assert hours(0.040, 3000.0, 85.0) == pytest.approx(0.5 * 5778.65, abs=0.1)


def test_ends():
    """Long intervals end at 30 000 h; above n = 14e6/(4 d^1.5) there is none, nor at rest."""
    assert hours(0.010, 100.0, 40.0) == 30000.0
    assert hours(0.040, 13900.0, 40.0) is None
    assert hours(0.040, 0.0, 40.0) is None

"""Units of the summary in SI."""

from __future__ import annotations

from math import pi

MICROMETRE, MILLIMETRE, GIGAPASCAL, MILLIRADIAN, NEWTON_MILLIMETRE = 1e-6, 1e-3, 1e9, 1e-3, 1e-3  # in SI
RPM = 2.0 * pi / 60.0  # [rad/s]
ZERO_CELSIUS = 273.15  # [K]

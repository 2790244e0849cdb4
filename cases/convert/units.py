"""Units of case files in SI."""

from __future__ import annotations

from math import pi

MM, UM, GPA, MPA, KN = 1e-3, 1e-6, 1e9, 1e6, 1e3  # in SI
MPA_S, MM2_S, MRAD, N_MM = 1e-3, 1e-6, 1e-3, 1e-3  # mPa s, mm^2/s, mrad, N mm in SI
RPM = 2.0 * pi / 60.0  # [rad/s]
ZERO_CELSIUS = 273.15  # [K]
DIGITS = 12  # of library values written back into the document; more is noise of the conversion


def mm(value: float | None) -> float:
    """A length that was checked to be there, from [mm] to [m]."""
    assert value is not None  # checked before
    return value * MM


def rounded(value: float) -> float:
    """`value` without the noise of a conversion of units [-]."""
    return float(f"{value:.{DIGITS}g}")

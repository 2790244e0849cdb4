"""Units of case files in SI."""

from math import pi

# in SI
MM = 1e-3
UM = 1e-6
GPA = 1e9
MPA = 1e6
KN = 1e3
MPA_S = 1e-3  # mPa s
MM2_S = 1e-6  # mm^2/s
MRAD = 1e-3  # mrad
N_MM = 1e-3  # N mm in SI
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

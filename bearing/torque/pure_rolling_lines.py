"""Sliding friction of a ball on a grooved race by its lines of pure rolling, Coulomb's friction.

Along the transverse axis y of the contact, in units of its semi-axis a, ball and race slide past
each other at

    v(y) = w_s y a - w_r (y^2 - const) a^2/(2 R),    R = 2 r D/(2 r + D),

with the spin w_s, the rolling speed w_r and the radius R of the loaded surface; the two roots are
the lines y = c_1 and y = -c_2 of pure rolling, c_1 = c_2 + E, E = 2 R w_s/(w_r a). The pressure is
Hertz's, the friction mu p against the sliding, the lines lie so that no net force along the
rolling direction is left (Jones, 1959; Harris and Kotzalas; the updated c-values of the sliding
friction paper of deep groove ball bearings, re-derived).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import asin, sin, sqrt


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingLines:
    """Where the lines lie and what they leave, all [-]."""

    first: float  # c_1, of the line on the side of the spin; beyond 1 outside the contact
    second: float  # c_2, of the other
    force: float  # F/(mu Q), along the rolling direction
    spin_moment: float  # m_s/(mu Q a)
    curvature: float  # S, m_r = mu Q a^2/(2 R) S


@lru_cache(maxsize=256)
def rolling_lines(spin_ratio: float, force: float = 0.0) -> RollingLines:
    """Lines of a contact.

    `spin_ratio`: E = 2 R w_s/(w_r a), not negative; infinite without rolling [-]; `force`:
    F/(mu Q) the friction has to carry, from -1 to 1 [-].

    Raises
    ------
    ValueError
        If the friction cannot carry the force.
    """
    if not -1.0 < force < 1.0:
        raise ValueError(f"force must lie between -1 and 1 times the friction, got {force!r}")

    second = _second_line(spin_ratio, force)
    first = second + spin_ratio
    return RollingLines(
        first=first,
        second=second,
        force=line_force(first, second),
        spin_moment=line_spin_moment(first, second),
        curvature=line_curvature(first, second),
    )


def _second_line(spin_ratio: float, force: float) -> float:
    """c_2 at which `line_force` is the force [-].

    With both lines in the contact m = (c_1 + c_2)/2 is a root of m^3 - 3 (1 - E^2/4) m + 1 - F;
    with the first one beyond it c_2 is one of c^3 - 3 c - 2 F.
    """
    half = 0.5 * spin_ratio
    room = 1.0 - half * half
    if room > 0.0:
        share = (1.0 - force) / (2.0 * room**1.5)
        if share <= 1.0:
            middle = 2.0 * sqrt(room) * sin(asin(share) / 3.0)
            if middle + half <= 1.0:
                return middle - half
    return -2.0 * sin(asin(force) / 3.0)


def _inside(first: float, second: float) -> tuple[float, float]:
    return min(max(first, -1.0), 1.0), min(max(second, -1.0), 1.0)


def line_force(first: float, second: float) -> float:
    """F/(mu Q) = 1 - 3/2 (c_1 + c_2) + 1/2 (c_1^3 + c_2^3) [-]; lines beyond the contact count at
    its end.
    """
    c, d = _inside(first, second)
    return 1.0 - 1.5 * (c + d) + 0.5 * (c**3 + d**3)


def line_spin_moment(first: float, second: float) -> float:
    """m_s/(mu Q a) = 3/8 [2 (c_1^2 - c_2^2) - (c_1^4 - c_2^4)] [-]."""
    c, d = _inside(first, second)
    return 0.375 * (2.0 * (c**2 - d**2) - (c**4 - d**4))


def line_curvature(first: float, second: float) -> float:
    """S = 1/5 - 3/2 [(c_1^3 + c_2^3)/3 - (c_1^5 + c_2^5)/5] [-]."""
    c, d = _inside(first, second)
    return 0.2 - 1.5 * ((c**3 + d**3) / 3.0 - (c**5 + d**5) / 5.0)

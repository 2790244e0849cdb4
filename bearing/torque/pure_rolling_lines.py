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

from scipy.optimize import brentq


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

    def net(second: float) -> float:
        return line_force(second + spin_ratio, second) - force

    # full sliding one way and the other: both lines outside the contact
    second = (
        brentq(net, -1.0 - min(spin_ratio, 2.0), 1.0, xtol=1e-15)
        if spin_ratio < 1e6
        else _single_line(force)
    )
    first = second + spin_ratio
    return RollingLines(
        first=first,
        second=second,
        force=line_force(first, second),
        spin_moment=line_spin_moment(first, second),
        curvature=line_curvature(first, second),
    )


def _single_line(force: float) -> float:
    """c_2 where the spin leaves the other line at infinity."""
    return float(brentq(lambda c: line_force(2.0, c) - force, -1.0, 1.0, xtol=1e-15))


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

r"""Stress below a dry elliptical contact in closed form: on its axis, and the orthogonal shear of
rolling.

The half-space z > 0 carries p = p_h sqrt(1 - x^2/a^2 - y^2/b^2) without friction. With
Boussinesq's potentials psi = int p/r, chi = int p ln(r + z) (Johnson, Contact Mechanics, 1985,
section 3.2; Thomas and Hoersch, 1930)::

    2 pi sigma_x = 2 nu psi_z - z psi_xx - (1 - 2 nu) chi_xx,   2 pi sigma_z = psi_z - z psi_zz

and for the ellipsoidal pressure, on the axis, every term is one of Carlson's integrals,
int_{z^2}^inf dw/[(a^2 + w)^(3/2) (b^2 + w)^(1/2) w^(1/2)] = 2/3 R_D(b^2 + z^2, z^2, a^2 + z^2) and
its likes. Stresses are negative in compression; depth counts into the body.
"""

from functools import lru_cache
from math import atan, atanh, sqrt
from typing import Any

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import elliprd

from ..arrays import Array

# the largest shear lies above this depth, in the smaller semi-axis: 0.48 (circle) to 0.79 (line)
DEEPEST = 1.5
SERIES = 1e-4  # e^2 of an ellipse below which its edge tension is expanded [-]


def hertz_axis_stress(
    semi_axes: tuple[float, float], pressure: float, depth: Array, poisson_ratio: float
) -> Array:
    """Principal stresses sigma_x, sigma_y, sigma_z on the axis of a Hertz contact, shape (3, ...)
    [Pa], Thomas and Hoersch (1930); semi-axes a along x and b along y [m], p_h [Pa], depth above
    zero [m].

    sigma_x = p_h a b [(1 - nu) z I_x - nu z I_z - (1 - 2 nu)/(A (A + B))], A^2 = a^2 + z^2, B^2 =
    b^2 + z^2, I_x = 2/3 R_D(B^2, z^2, A^2), I_z = 2/3 R_D(A^2, B^2, z^2), likewise sigma_y;
    sigma_z = -p_h a b/(A B).
    """
    a, b = semi_axes
    return np.asarray(pressure * a * b * np.stack(_axis_stress(a, b, depth, poisson_ratio)))


def _axis_stress(a: float, b: float, depth: Any, nu: float) -> tuple[Any, Any, Any]:
    """Stresses of `hertz_axis_stress` over p_h a b [1/m^2], at one depth or many [m]."""
    z2 = depth * depth
    a2, b2 = a * a + z2, b * b + z2
    root_a, root_b = np.sqrt(a2), np.sqrt(b2)
    along_z = 2.0 / 3.0 * elliprd(a2, b2, z2)
    surface = (1.0 - 2.0 * nu) / (root_a + root_b)

    def along(own: Any, other: Any, root: Any) -> Any:
        integral = (1.0 - nu) * 2.0 / 3.0 * elliprd(other, z2, own)
        return depth * (integral - nu * along_z) - surface / root

    stress_z = -1.0 / (root_a * root_b)
    return along(a2, b2, root_a), along(b2, a2, root_b), stress_z


def hertz_maximum_shear(
    semi_axes: tuple[float, float], pressure: float, poisson_ratio: float
) -> tuple[float, float]:
    """Largest principal shear on the axis of a Hertz contact [Pa], half the difference of the
    extreme stresses, and its depth [m]; semi-axes along x and y [m], p_h [Pa].

    0.310 p_h for the circle and 0.300 p_h for the line with nu = 0.3.
    """
    small = min(semi_axes)
    shear, depth = _unit_shear(semi_axes[0] / small, semi_axes[1] / small, poisson_ratio)
    return pressure * shear, small * depth


@lru_cache(maxsize=1024)
def _unit_shear(a: float, b: float, poisson_ratio: float) -> tuple[float, float]:
    """Largest shear and its depth of semi-axes over the smaller one, over p_h and that one [-]."""

    def negative_shear(depth: float) -> float:
        stress = _axis_stress(a, b, float(depth), poisson_ratio)
        return -0.5 * a * b * float(max(stress) - min(stress))

    peak = minimize_scalar(
        negative_shear, bounds=(1e-3, DEEPEST), method="bounded", options={"xatol": 1e-9}
    )
    return -float(peak.fun), float(peak.x)


def hertz_orthogonal_shear(
    semi_axis_rolling: float, semi_axis_transverse: float, pressure: float
) -> tuple[float, float]:
    """Amplitude tau_0 [Pa] of the shear stress tau_xz of a point that the contact rolls over, and
    its depth z_0 [m], Lundberg and Palmgren (1947); semi-axes a along the rolling direction and b
    [m], p_h [Pa].

    tau_0 = p_h sqrt(2 t - 1)/(2 t (t + 1)), z_0 = a/[(t + 1) sqrt(2 t - 1)], (t^2 - 1)(2 t - 1) =
    (a/b)^2. It swings between -tau_0 and +tau_0, whatever Poisson's ratio.
    """
    ratio = (semi_axis_rolling / semi_axis_transverse) ** 2

    def excess(t: float) -> float:
        return (t * t - 1.0) * (2.0 * t - 1.0) - ratio

    t = float(brentq(excess, 1.0, 2.0 + ratio ** (1.0 / 3.0), xtol=1e-14))
    root = sqrt(2.0 * t - 1.0)
    return pressure * root / (2.0 * t * (t + 1.0)), semi_axis_rolling / ((t + 1.0) * root)


def hertz_edge_tension(
    semi_axes: tuple[float, float], pressure: float, poisson_ratio: float
) -> tuple[float, float]:
    """Radial tension in the surface at the ends of the x and of the y semi-axis of a Hertz contact
    without friction [Pa], Johnson (1985), section 4.2; semi-axes along x and y [m], p_h [Pa].

    With a the longer and b the shorter one, e^2 = 1 - b^2/a^2: (1 - 2 nu) p_h b/(a e^2) times
    artanh(e)/e - 1 at the end of the longer, and 1 - b/(a e) arctan(e a/b) at that of the shorter
    axis; (1 - 2 nu) p_h/3 on the rim of a circle.
    """
    a, b = max(semi_axes), min(semi_axes)
    ratio = b / a
    e2 = 1.0 - ratio**2
    if e2 < SERIES:  # both to first order in e^2
        long_end = 1.0 / 3.0 + e2 / 30.0
        short_end = 1.0 / 3.0 - e2 / 30.0
    else:
        e = sqrt(e2)
        long_end = ratio / e2 * (atanh(e) / e - 1.0)
        short_end = ratio / e2 * (1.0 - ratio / e * atan(e / ratio))
    scale = (1.0 - 2.0 * poisson_ratio) * pressure
    ends = (long_end, short_end) if semi_axes[0] >= semi_axes[1] else (short_end, long_end)
    return scale * ends[0], scale * ends[1]

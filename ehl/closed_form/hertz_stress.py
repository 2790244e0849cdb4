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

from math import atan, atanh, sqrt
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike
from scipy.special import elliprd

from ..arrays import Array

# the largest shear lies above this depth, in the smaller semi-axis: 0.48 (circle) to 0.79 (line)
DEEPEST = 1.5
SEARCHED_DEPTHS = 200  # in a row, between the surface and there [-]
# Poisson's ratio from which on the stress across the shorter axis is the largest where the shear
# is; with a smaller one that along the longer axis may be [-]
ACROSS_POISSON = 0.25
# depth of the largest shear in the smaller semi-axis, about [-]; where its search begins
CIRCLE_DEPTH = 0.48
LINE_DEPTH = 0.79
SHEAR_STEPS = 30  # largest number of steps of that search; it needs 5 or 6
SHEAR_ROUNDING = 1e-12  # step of the depth at which it ends [-]
CUBIC_STEPS = 9  # to round-off, for any ellipse; 7 do
SERIES = 1e-4  # e^2 of an ellipse below which its edge tension is expanded [-]


def hertz_axis_stress(
    semi_axes: tuple[float, float], pressure: float, depth: Array, poisson_ratio: float
) -> Array:
    """Principal stresses on the axis of a Hertz contact, Thomas and Hoersch (1930).

    sigma_x = p_h a b [(1 - nu) z I_x - nu z I_z - (1 - 2 nu)/(A (A + B))], A^2 = a^2 + z^2, B^2 =
    b^2 + z^2, I_x = 2/3 R_D(B^2, z^2, A^2), I_z = 2/3 R_D(A^2, B^2, z^2), likewise sigma_y;
    sigma_z = -p_h a b/(A B).

    Parameters
    ----------
    semi_axes : tuple[float, float]
        a along x and b along y [m]
    pressure : float
        p_h [Pa]
    depth : Array
        above zero, any shape [m]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    Array
        sigma_x, sigma_y, sigma_z, shape (3, ...) [Pa]
    """
    a, b = semi_axes
    return np.asarray(pressure * a * b * np.stack(_axis_stress(a, b, depth, poisson_ratio)))


def _axis_stress(a: float, b: Any, depth: Any, nu: Any) -> tuple[Any, Any, Any]:
    """Stresses of `hertz_axis_stress` over p_h a b [1/m^2], at one depth or many [m]."""
    z2 = depth * depth
    a2, b2 = a * a + z2, b * b + z2
    root_a, root_b = np.sqrt(a2), np.sqrt(b2)
    along_z = 2.0 / 3.0 * elliprd(a2, b2, z2)
    surface = (1.0 - 2.0 * nu) / (root_a + root_b)

    def along(axis: Any, other: Any, root: Any) -> Any:
        integral = (1.0 - nu) * 2.0 / 3.0 * elliprd(other, z2, axis)
        return depth * (integral - nu * along_z) - surface / root

    stress_z = -1.0 / (root_a * root_b)
    return along(a2, b2, root_a), along(b2, a2, root_b), stress_z


def hertz_maximum_shear(
    semi_axes: tuple[ArrayLike, ArrayLike], pressure: ArrayLike, poisson_ratio: ArrayLike
) -> tuple[Array, Array]:
    """Largest principal shear on the axis of Hertz contacts, half the difference of the extreme
    stresses.

    0.310 p_h for the circle and 0.300 p_h for the line with nu = 0.3.

    Parameters
    ----------
    semi_axes : tuple[ArrayLike, ArrayLike]
        along x and along y, numbers or arrays of one shape [m]
    pressure : ArrayLike
        p_h, likewise [Pa]
    poisson_ratio : ArrayLike
        nu, likewise [-]

    Returns
    -------
    shear
        largest shear stress, the common shape [Pa]
    depth
        its depth [m]
    """
    first, second, peak = (np.asarray(one, dtype=np.float64) for one in (*semi_axes, pressure))
    small = np.minimum(first, second)
    ratio, nu = np.broadcast_arrays(np.maximum(first, second) / small, poisson_ratio)
    shear, depth = _shear_across(ratio, nu)
    for n in np.ndindex(nu.shape):
        if nu[n] < ACROSS_POISSON:
            shear[n], depth[n] = _searched_shear(float(ratio[n]), float(nu[n]))
    return np.asarray(peak * shear), np.asarray(small * depth)


def _searched_shear(ratio: float, nu: float) -> tuple[float, float]:
    """Largest shear and its depth of semi-axes 1 and `ratio` above it, over p_h [-]: of two
    maxima the larger, from depths in a row.
    """

    def shear(depth: Any) -> Any:
        stress = np.broadcast_arrays(*_axis_stress(1.0, ratio, depth, nu))
        return 0.5 * ratio * (np.max(stress, axis=0) - np.min(stress, axis=0))

    row = np.geomspace(1e-3, DEEPEST, SEARCHED_DEPTHS)
    best = int(np.argmax(shear(row)))
    ends = row[max(best - 1, 0)], row[min(best + 1, SEARCHED_DEPTHS - 1)]
    peak = scipy.optimize.minimize_scalar(
        lambda depth: -float(shear(depth)), bounds=ends, method="bounded", options={"xatol": 1e-9}
    )
    return -float(peak.fun), float(peak.x)


def _shear_across(ratio: Array, nu: Array) -> tuple[Array, Array]:
    """Largest shear and its depth, in arrays, by d(shear)/dz = 0.

    The stress across the shorter axis, here sigma_x, is the largest at that depth: d(sigma_x -
    sigma_z)/dz = 0 with dI_x/dz = -2/(A^3 B) and dI_z/dz = -2/(A B z^2), by secants.
    """
    last = CIRCLE_DEPTH + (LINE_DEPTH - CIRCLE_DEPTH) * (1.0 - 1.0 / ratio)
    depth = 1.01 * last
    old, slope = (_shear_slope(ratio, at, nu) for at in (last, depth))
    for _ in range(SHEAR_STEPS):
        way = slope - old
        step = np.where(way == 0.0, 0.0, -slope * (depth - last) / np.where(way == 0.0, 1.0, way))
        if np.all(np.abs(step) <= SHEAR_ROUNDING):
            break
        last, old = depth, slope
        depth = depth + step
        slope = _shear_slope(ratio, depth, nu)
    stress = _axis_stress(1.0, ratio, depth, nu)
    return np.asarray(0.5 * ratio * (stress[0] - stress[2])), np.asarray(depth)


def _shear_slope(ratio: Any, depth: Any, nu: Any) -> Any:
    """d(sigma_x - sigma_z)/dz of semi-axes 1 and `ratio` above it, over p_h times that [-]."""
    z2 = depth * depth
    a2 = 1.0 + z2
    b2 = ratio * ratio + z2
    root = np.sqrt(a2 * b2)
    over = np.sqrt(b2 / a2)  # B/A
    along_x = 2.0 / 3.0 * elliprd(b2, z2, a2)
    along_z = 2.0 / 3.0 * elliprd(a2, b2, z2)
    turn = over + 1.0 / over
    inner = (
        (1.0 - nu) * along_x - nu * along_z + 2.0 * (nu - (1.0 - nu) * z2 / a2) / (depth * root)
    )
    surface = (1.0 - 2.0 * nu) * depth * (2.0 + turn) / (a2 + root) ** 2
    return inner + surface - depth * turn / (a2 * b2)


def hertz_orthogonal_shear(
    semi_axis_rolling: ArrayLike, semi_axis_transverse: ArrayLike, pressure: ArrayLike
) -> tuple[Array, Array]:
    """Amplitude and depth of the orthogonal shear stress tau_xz in rolling, Lundberg and Palmgren
    (1947).

    tau_0 = p_h sqrt(2 t - 1)/(2 t (t + 1)), z_0 = a/[(t + 1) sqrt(2 t - 1)], (t^2 - 1)(2 t - 1) =
    (a/b)^2. It oscillates between -tau_0 and +tau_0, whatever Poisson's ratio.

    Parameters
    ----------
    semi_axis_rolling : ArrayLike
        a along the rolling direction, a number or an array [m]
    semi_axis_transverse : ArrayLike
        b, of the same shape [m]
    pressure : ArrayLike
        p_h, of the same shape [Pa]

    Returns
    -------
    amplitude
        tau_0 [Pa]
    depth
        z_0 [m]
    """
    inputs = (semi_axis_rolling, semi_axis_transverse, pressure)
    along, across, peak = (np.asarray(value, dtype=np.float64) for value in inputs)
    ratio = (along / across) ** 2
    t = 2.0 + np.cbrt(ratio)
    for _ in range(CUBIC_STEPS):  # Newton's, from above: the cubic is convex beyond its root
        t = t - ((t * t - 1.0) * (2.0 * t - 1.0) - ratio) / (6.0 * t * t - 2.0 * t - 2.0)
    root = np.sqrt(2.0 * t - 1.0)
    amplitude = peak * root / (2.0 * t * (t + 1.0))
    return np.asarray(amplitude), np.asarray(along / ((t + 1.0) * root))


def hertz_edge_tension(
    semi_axes: tuple[float, float], pressure: float, poisson_ratio: float
) -> tuple[float, float]:
    """Radial tension in the surface at the ends of the semi-axes, Johnson (1985), section 4.2.

    Without friction. With a the longer and b the shorter semi-axis, e^2 = 1 - b^2/a^2: (1 - 2 nu)
    p_h b/(a e^2) times artanh(e)/e - 1 at the end of the longer, and 1 - b/(a e) arctan(e a/b) at
    that of the shorter axis; (1 - 2 nu) p_h/3 on the rim of a circle.

    Parameters
    ----------
    semi_axes : tuple[float, float]
        along x and along y [m]
    pressure : float
        p_h [Pa]
    poisson_ratio : float
        nu of the body [-]

    Returns
    -------
    end_x
        tension at the end of the x semi-axis [Pa]
    end_y
        tension at the end of the y semi-axis [Pa]
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

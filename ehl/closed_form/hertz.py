"""Dry elastic contact of two quadratic surfaces, Hertz (1882), in symmetric elliptic integrals.

Pressure p = p_h sqrt(1 - x^2/a^2 - y^2/b^2) on the ellipse with semi-axes a (along x) and b (along
y) fills the gap x^2/(2 Rx) + y^2/(2 Ry) - approach when (Johnson, Contact Mechanics, 1985, section
4.2, with his integrals over the confocal parameter s written by Carlson's R_F and R_D)::

    1/(2 Rx) = p_h a b/(3 E*) R_D(0, b^2, a^2),   E* = E'/2
    1/(2 Ry) = p_h a b/(3 E*) R_D(0, a^2, b^2)
    approach = p_h a b/E* R_F(0, a^2, b^2)
    load     = 2 pi/3 p_h a b

R_D and R_F do not know which axis is the longer one: nothing is 0/0 at the circle and no branch is
taken there.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import cbrt, exp, log, pi, sqrt

import scipy

from ..options import require_positive

# Rx/Ry and its inverse, ellipticity about 1e5; beyond lies the line contact
RADIUS_RATIO_LIMIT = 1.0e8
MAX_NEWTON_STEPS = 60
LAST_STEP = 1.0e-8  # of ln k, after which a step of second order leaves round-off alone
MEAN_PRESSURE_RATIO = 2.0 / 3.0  # of a semi-ellipsoid over its largest value [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class HertzContact:
    """One dry elliptical contact, SI."""

    load: float  # F, normal [N]
    radius_x: float  # reduced radius of curvature in x [m]
    radius_y: float  # and in y [m]
    reduced_modulus: float  # E' [Pa], 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2
    semi_axis_x: float  # a, semi-axis of the contact ellipse along x [m]
    semi_axis_y: float  # b, and along y [m]
    pressure: float  # p_h, largest pressure [Pa]
    approach: float  # of distant points [m]


@lru_cache(maxsize=1024)
def ellipse_ratio(radius_ratio: float) -> float:
    """Ratio of the semi-axes of the contact ellipse, k = b/a, Hertz (1882).

    1 at Rx = Ry, above 1 where Rx < Ry. Solves Rx/Ry = R_D(0, 1, k^2)/R_D(0, k^2, 1) by Newton's
    method in ln k inside a bracket.

    Parameters
    ----------
    radius_ratio : float
        Rx/Ry, from 1e-8 to 1e8 [-]

    Returns
    -------
    float
        b/a, semi-axis along y over that along x [-]

    Raises
    ------
    ValueError
        if the ratio lies outside its range
    """
    require_positive({"radius_ratio": radius_ratio})
    if not 1.0 / RADIUS_RATIO_LIMIT <= radius_ratio <= RADIUS_RATIO_LIMIT:
        raise ValueError(f"radius_ratio must lie in [1e-8, 1e8], got {radius_ratio!r}")
    if radius_ratio == 1.0:
        return 1.0
    target = log(radius_ratio)
    low, high = sorted((-target, -0.25 * target))  # k lies between (Rx/Ry)^-1 and (Rx/Ry)^-1/4
    t = -2.0 / 3.0 * target  # exact slope at the circle
    for _ in range(MAX_NEWTON_STEPS):
        residual, slope = _log_radius_ratio(t)
        residual -= target
        low, high = (t, high) if residual > 0.0 else (low, t)
        step = -residual / slope
        if abs(step) <= LAST_STEP:
            return exp(t + step)
        t = t + step if low < t + step < high else 0.5 * (low + high)
    return exp(t)


@lru_cache(maxsize=1024)
def hertz_coefficients(radius_ratio: float) -> tuple[float, float, float]:
    """Dimensionless size f, pressure g and approach d of the contact, functions of D = Rx/Ry
    alone.

    With W = F/(E' Rx^2) [-]: a/Rx = f W^(1/3), p_h/E' = g W^(1/3), approach/Rx = d W^(2/3) [-].
    f^3 = (2/pi) R_D(0, k^2, 1), g = 3/(2 pi k f^2), d = (3/pi) R_F(0, 1, k^2)/f; 1.5, 3/(2 pi
    f^2), f^2 at D = 1.

    Parameters
    ----------
    radius_ratio : float
        Rx/Ry, from 1e-8 to 1e8 [-]

    Returns
    -------
    f
        size [-]
    g
        pressure [-]
    d
        approach [-]

    Raises
    ------
    ValueError
        if the ratio lies outside its range
    """
    k = ellipse_ratio(radius_ratio)
    r_f, r_d = complete_integrals(k)
    f = cbrt(2.0 / pi * r_d)
    g = 3.0 / (2.0 * pi * k * f**2)
    d = 3.0 / pi * r_f / f
    return f, g, d


def complete_integrals(k: float) -> tuple[float, float]:
    """R_F(0, 1, k^2) and R_D(0, k^2, 1) by the arithmetic-geometric mean of 1 and k, DLMF 19.8.

    R_F = pi/(2 M), R_D = 3 R_F [1/2 + sum 2^(n-1) c_n^2/(1 - k^2)], c_n half the difference of the
    n-th pair; c_1^2/(1 - k^2) = (1 - k)/(4 (1 + k)), nothing is 0/0 at the circle.

    Parameters
    ----------
    k : float
        ratio of the semi-axes, above zero [-]

    Returns
    -------
    r_f
        R_F(0, 1, k^2) [-]
    r_d
        R_D(0, k^2, 1) [-]
    """
    a = 1.0
    b = k
    term = 0.25 * (1.0 - k) / (1.0 + k)
    total = 0.5 + term
    c = 0.5 * (a - b)
    a, b = 0.5 * (a + b), sqrt(a * b)
    while abs(c) > 1.0e-9 * a:  # c_(n+1) = c_n^2/(4 a_(n+1))
        following = 0.5 * (a - b)
        a, b = 0.5 * (a + b), sqrt(a * b)
        term *= 2.0 * (c / (4.0 * a)) ** 2
        total += term
        c = following
    r_f = pi / (2.0 * a)
    return r_f, 3.0 * r_f * total


def hertz_deflection(x: float, y: float, ratio: float) -> float:
    """Integral of P/r over the ellipse x^2 + (y/ratio)^2 < 1 under Hertz pressure of unit load.

    3/4 integral from t of (1 - x^2/(1 + s) - y^2/(ratio^2 + s))/sqrt((1 + s)(ratio^2 + s) s) ds, t
    the confocal ellipse through (x, y), 0 inside (Hertz, 1882; Carlson's integrals).

    Parameters
    ----------
    x : float
        position inside or outside the ellipse, in semi-axes along x [-]
    y : float
        position in semi-axes along x [-]
    ratio : float
        b/a [-]

    Returns
    -------
    float
        integral [-]
    """
    b2 = ratio**2
    # x^2/(1 + t) + y^2/(b^2 + t) = 1
    half = 0.5 * (x * x + y * y - 1.0 - b2)
    rest = b2 * (x * x - 1.0) + y * y
    t = half + sqrt(max(half * half + rest, 0.0)) if rest > 0.0 else 0.0
    whole = 2.0 * float(scipy.special.elliprf(t, t + 1.0, t + b2))
    along_x = 2.0 / 3.0 * float(scipy.special.elliprd(t, t + b2, t + 1.0))
    along_y = 2.0 / 3.0 * float(scipy.special.elliprd(t, t + 1.0, t + b2))
    return 0.75 * (whole - x * x * along_x - y * y * along_y)


def contact_stiffness(radius_x: float, radius_y: float, reduced_modulus: float) -> float:
    """K = E' sqrt(Rx) d^(-3/2) in load = K approach^1.5, Hertz (1882), d from
    `hertz_coefficients`.

    Parameters
    ----------
    radius_x : float
        reduced radius of curvature in x [m]
    radius_y : float
        reduced radius of curvature in y [m]
    reduced_modulus : float
        E' [Pa]

    Returns
    -------
    float
        K [N/m^1.5]

    Raises
    ------
    ValueError
        if a value is not positive
    """
    inputs = {"radius_x": radius_x, "radius_y": radius_y, "reduced_modulus": reduced_modulus}
    require_positive(inputs)
    _, _, d = hertz_coefficients(radius_x / radius_y)
    return float(reduced_modulus * (radius_x / d**3) ** 0.5)


def hertz_contact(
    load: float, radius_x: float, radius_y: float, reduced_modulus: float
) -> HertzContact:
    """Ellipse, pressure and approach at a load, Hertz (1882).

    Parameters
    ----------
    load : float
        normal load [N]
    radius_x : float
        reduced radius of curvature in x [m]
    radius_y : float
        reduced radius of curvature in y [m]
    reduced_modulus : float
        E', 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [Pa]

    Returns
    -------
    HertzContact
        the dry contact

    Raises
    ------
    ValueError
        if a value is not positive

    Examples
    --------
    >>> contact = hertz_contact(50.0, 6e-3, 60e-3, 2.3e11)
    >>> f"{contact.pressure / 1e9:.3f} GPa, {contact.semi_axis_y * 1e6:.0f} um"
    '0.807 GPa, 365 um'
    """
    inputs = {"load": load, "radius_x": radius_x, "radius_y": radius_y}
    require_positive(inputs | {"reduced_modulus": reduced_modulus})
    f, g, d = hertz_coefficients(radius_x / radius_y)
    size = cbrt(load / (reduced_modulus * radius_x**2))
    semi_axis_x = f * size * radius_x
    return HertzContact(
        load=load,
        radius_x=radius_x,
        radius_y=radius_y,
        reduced_modulus=reduced_modulus,
        semi_axis_x=semi_axis_x,
        semi_axis_y=3.0 * semi_axis_x / (2.0 * pi * g * f**2),
        pressure=g * size * reduced_modulus,
        approach=d * size**2 * radius_x,
    )


def _log_radius_ratio(t: float) -> tuple[float, float]:
    """ln(Rx/Ry) [-] at k = exp(t) and its slope [-], by the common integral of both."""
    k2 = exp(2.0 * t)
    along_x = complete_integrals(exp(t))[1]
    along_y = complete_integrals(exp(-t))[1] * exp(-3.0 * t)  # R_D is homogeneous of degree -3/2
    mixed = 9.0 * pi / 16.0 * k2**-1.25
    if abs(k2 - 1.0) > 1.0e-4:
        mixed = (along_x - along_y) / (k2 - 1.0)
    slope = -3.0 + mixed / along_y + k2 * mixed / along_x
    return log(along_y / along_x), slope

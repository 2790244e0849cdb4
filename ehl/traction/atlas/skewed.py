"""Entrainment at an angle: the straight contact that has its curvatures along and across the
entrainment, and what the mixed curvature changes.

In the frame of the entrainment the gap is S X^2/2 + T Y^2/2 + C X Y. Without C the contact is one
of R_x/S and the ratio T/S, whose load and oil are M S^(5/4) and L S^(1/4). The functions of the
table at that place, x, are exact at C = 0, along both principal directions and in circles; else

    F(x, m) = F(x) + m sum_i w_i m_i k(|((x, m) - (x_i, m_i))/l|),   m = C^2/(S T)

with the radial functions of `table`, fitted to solutions at an angle by `tools/atlas/skewed.py`,
and terms of the oil. Films are counted in a^2/R_x of the straight contact, and the deflection less
the difference of both Hertz approaches.
"""

from functools import cache
from math import cos, log, sin, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...arrays import Array
from ...closed_form.hertz import hertz_coefficients
from .table import BASE_ALPHA, BASE_Z, radial

FILE = Path(__file__).parent / "skewed.npz"
# ranges of the contact along its principal direction of smaller radius, validated for entrainment
# at an angle
SKEW_RANGE = {
    "entrainment_angle_deg: A along the smaller radius": (10.0, 80.0),
    "entrainment_angle_deg: ratio of the smaller radius to the larger": (0.05, 1.0),
}
ACROSS_CLASSES = (1.0, 2.0)  # T/S, below, between and above which errors were judged
STRAIGHT = 1e-12  # m below which the entrainment counts as along a principal direction
MIXED = 3  # functions that the mixed curvature adds to, ln(Hc A), ln(Hmin A), Hc - H0


class Along(NamedTuple):
    """The straight contact of an entrainment at an angle [-]."""

    load: float  # A
    lubricant: float  # L
    ratio: float  # T/S
    curvature: float  # S
    mixed: float  # m
    unit: float  # its a^2/Rx over that of the contact
    approach: float  # Hertz approach of the contact less that of the straight one, in this unit
    slimmer: tuple[float, float]  # A and D along the principal direction of the smaller radius

    @property
    def place(self) -> Array:
        """(ln A, sqrt L, ln D, m), shape (4,) [-]."""
        return np.array([log(self.load), sqrt(self.lubricant), log(self.ratio), self.mixed])


class Skew(NamedTuple):
    """Contents of the file [-]."""

    places: Array  # (n, 4)
    scales: Array  # (4,)
    weights: Array  # (n, 3)
    oils: Array  # (8, 3)
    # (2, 3, 3) relative errors, of Hc - H0 absolute ones, within which nineteen of twenty fresh
    # contacts lie: of the base oil and of others, by classes of T/S
    bars: Array


def along_entrainment(load: float, lubricant: float, ratio: float, angle: float) -> Along:
    """Transform a contact with entrainment at an angle to the straight one.

    Parameters
    ----------
    load : float
        A of the contact along x [-]
    lubricant : float
        L [-]
    ratio : float
        Rx/Ry [-]
    angle : float
        angle of the entrainment from x towards y [rad]

    Returns
    -------
    Along
        straight contact, with its mixed curvature
    """
    c, s = cos(angle), sin(angle)
    first, across = c * c + ratio * s * s, s * s + ratio * c * c
    f, _, d = hertz_coefficients(ratio)
    straight_ratio = across / first
    straight_f, _, straight_d = hertz_coefficients(straight_ratio)
    unit = (straight_f / f) ** 2 * first ** (1.0 / 3.0)
    mixed = (s * c * (ratio - 1.0)) ** 2 / (first * across)
    slimmer = (load, ratio)
    if ratio > 1.0:  # A goes with f^2 S^(5/6)
        turned = hertz_coefficients(1.0 / ratio)[0] / f
        slimmer = (load * turned**2 * ratio ** (5.0 / 6.0), 1.0 / ratio)
    return Along(
        load=load * unit * sqrt(first),
        lubricant=lubricant * first**0.25,
        ratio=straight_ratio,
        curvature=first,
        mixed=mixed if mixed > STRAIGHT else 0.0,
        unit=unit,
        approach=d / f**2 / unit - straight_d / straight_f**2,
        slimmer=slimmer,
    )


@cache
def skew() -> Skew:
    """The table, read once [-]."""
    with np.load(FILE) as file:
        return Skew(**{name: file[name] for name in Skew._fields})


def mixed_oil_terms(places: Array, alpha: Array, z: Array) -> Array:
    """Evaluate m sqrt(L) {z - z_0, ln(alpha/alpha_0)} {1, ln A, ln D, m}.

    Parameters
    ----------
    places : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (n, 4) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (n,) [1/Pa]
    z : Array
        Roelands' z, shape (n,) [-]

    Returns
    -------
    Array
        terms, shape (n, 8) [-]
    """
    terms = np.stack([np.asarray(z) - BASE_Z, np.log(np.asarray(alpha) / BASE_ALPHA)], axis=1)
    terms = terms * (places[:, 3] * places[:, 1])[:, None]
    factors = np.column_stack([np.ones(len(places)), places[:, 0], places[:, 2], places[:, 3]])
    return np.asarray((terms[:, :, None] * factors[:, None, :]).reshape(len(places), -1))


def mixed_radial(x: Array, tabulated: Skew) -> Array:
    """Evaluate the radial functions times m m_i.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (m, 4) [-]
    tabulated : Skew
        table of the mixed curvature

    Returns
    -------
    Array
        products, shape (m, n) [-]
    """
    fractions = x[:, 3:] * tabulated.places[None, :, 3]
    return np.asarray(fractions * radial(x, tabulated.places, tabulated.scales))


def mixed_functions(x: Array, alpha: Array, z: Array, tabulated: Skew | None = None) -> Array:
    """Evaluate the change of the first three functions by the mixed curvature.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D, m) of contacts, shape (m, 4) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]
    tabulated : Skew | None, optional
        table of the mixed curvature; None: that of the package

    Returns
    -------
    Array
        changes, shape (m, 3) [-]
    """
    tabulated = tabulated or skew()
    return np.asarray(
        mixed_radial(x, tabulated) @ tabulated.weights
        + mixed_oil_terms(x, alpha, z) @ tabulated.oils
    )


def skew_bars(ratio: float, base: bool) -> Array:
    """Give the errors of the first three functions with entrainment at an angle.

    Parameters
    ----------
    ratio : float
        T/S of the straight contact [-]
    base : bool
        whether the oil is that of the solves

    Returns
    -------
    Array
        errors, shape (3,) [-]
    """
    return np.asarray(skew().bars[0 if base else 1, np.searchsorted(ACROSS_CLASSES, ratio)])

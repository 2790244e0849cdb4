"""Film formula of fifty coefficients, fitted to the film atlas by `tools/atlas/formula.py`.

    ln(h/(Rx sqrt(2U))) = sum c x^i y^j w^k + sqrt(L/30) sum c x^i y^j w^k z^l a^m

    x = 2 ln(A/7)/ln(160/7) - 1,  y = 2 sqrt(L/30) - 1,  w = 1 + log10(Rx/Ry),
    z = z_R - 0.68,  a = ln(alpha/22 GPa^-1),  A = a_x^2/(Rx^2 sqrt(2U)) = f(Rx/Ry)^2 M^(2/3)

with z_R Roelands' exponent, a_x Hertz' semi-axis along the entrainment, M and L after Moes (1992).
Flooded, isothermal, Newtonian, entrainment along x; oil after Roelands with the density of Dowson
and Higginson. Errors: `docs/theory/film_formula.md`.
"""

from collections.abc import Sequence
from functools import cache
from math import nan
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import Array

FILE = Path(__file__).with_suffix(".csv")
TERMS = ("i", "j", "k", "l", "m")  # exponents of x, y, w, z and a
# ranges of A, L and Rx/Ry [-], of alpha [1/Pa] and of Roelands' exponent [-]
RANGE = {
    "A": (7.0, 160.0),
    "L": (0.0, 30.0),
    "Rx/Ry": (0.01, 1.0),
    "pressure_viscosity": (10e-9, 30e-9),
    "roelands_z": (0.4, 0.8),
}
EDGE = 1e-9  # within a range [-]
BASE_ALPHA = 22e-9  # [1/Pa]
BASE_Z = 0.68


def film_formula(
    load: ArrayLike,
    lubricant_parameter: ArrayLike,
    radius_ratio: ArrayLike,
    pressure_viscosity: ArrayLike = BASE_ALPHA,
    roelands_z: ArrayLike = BASE_Z,
) -> tuple[Array, Array]:
    """Central and minimum film of flooded elliptical contacts by a formula of fifty coefficients.

    Parameters
    ----------
    load : ArrayLike
        A = a^2/(Rx^2 sqrt(2U)) = f(Rx/Ry)^2 M^(2/3) [-], a Hertz' semi-axis along the entrainment;
        M and L after Moes (1992), with 2U in both
    lubricant_parameter : ArrayLike
        L [-]
    radius_ratio : ArrayLike
        Rx/Ry [-]
    pressure_viscosity : ArrayLike, default BASE_ALPHA
        at ambient pressure [1/Pa]
    roelands_z : ArrayLike, default BASE_Z
        exponent z of Roelands (1966) [-]

    Returns
    -------
    central
        h/(Rx sqrt(2U)) in the common shape of the inputs [-]; nan outside `RANGE`
    minimum
        likewise [-]

    Examples
    --------
    >>> from oilfilm import film_formula
    >>> central, minimum = film_formula(40.0, 10.0, 0.1)
    >>> f"{float(central):.2f} {float(minimum):.2f}"
    '4.42 3.77'
    """
    inputs = (load, lubricant_parameter, radius_ratio, pressure_viscosity, roelands_z)
    values = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in inputs))
    flat = [np.ravel(v) for v in values]
    inside = np.ones(flat[0].shape, dtype=bool)
    for value, (low, high) in zip(flat, RANGE.values(), strict=True):
        inside &= (value >= low * (1.0 - EDGE)) & (value <= high * (1.0 + EDGE))
    exponents, coefficients = _coefficients()
    films = np.full((flat[0].size, 2), nan)
    terms = monomials([v[inside] for v in flat], exponents)
    films[inside] = np.exp(terms @ coefficients)
    central, minimum = (np.reshape(film, values[0].shape) for film in films.T)
    return central, minimum


def monomials(inputs: Sequence[Array], exponents: NDArray[np.int_]) -> Array:
    """Terms of the formula at n contacts.

    Parameters
    ----------
    inputs : Sequence[Array]
        the five inputs of `film_formula`, shape (n,) each
    exponents : NDArray[np.int_]
        of the terms, shape (m, 5)

    Returns
    -------
    Array
        terms, shape (n, m) [-]
    """
    load, lubricant_parameter, radius_ratio, pressure_viscosity, roelands_z = inputs
    low, high = RANGE["A"]
    thick = np.sqrt(lubricant_parameter / RANGE["L"][1])
    variables = (
        2.0 * np.log(load / low) / np.log(high / low) - 1.0,
        2.0 * thick - 1.0,
        1.0 + np.log10(radius_ratio),
        roelands_z - BASE_Z,
        np.log(pressure_viscosity / BASE_ALPHA),
    )
    of_oil = exponents[:, 3:].sum(axis=1) > 0
    terms = np.where(of_oil, thick[:, None], 1.0)
    for variable, powers in zip(variables, exponents.T, strict=True):
        terms = terms * variable[:, None] ** powers
    return np.asarray(terms)


@cache
def _coefficients() -> tuple[NDArray[np.int_], Array]:
    """Exponents of the terms, shape (50, 5), and coefficients of both films, shape (50, 2) [-]."""
    table = np.loadtxt(FILE, delimiter=",", skiprows=1)
    return table[:, : len(TERMS)].astype(int), table[:, len(TERMS) :]

"""Couette flow heated by itself (Nahme, 1940; Gruntfest, 1963), and its table for the kernels."""

import numpy as np

from ...arrays import Array

NEWTON_STEPS = 5  # from m = sqrt(X^2 + X) to round-off
LARGEST_ROOT = 8.0  # of X in the table: ln(g) reaches 120 there
ROOTS = 2048  # linear between them, ln(g) is off by 1.1e-5 at most


def nahme(loading: Array) -> tuple[Array, Array]:
    """Solve Couette flow heated by itself at X = m tanh m, Nahme (1940), Gruntfest (1963).

    Parameters
    ----------
    loading : Array
        X, any shape [-]

    Returns
    -------
    log_g
        ln g with g = sinh m cosh m/m, shape of `loading` [-]
    log_cosh
        2 ln(cosh m), of this shape [-]
    """
    x = np.maximum(np.asarray(loading, dtype=np.float64), 0.0)
    m = np.sqrt(x * x + x)
    for _ in range(NEWTON_STEPS):
        slope = np.tanh(m) + m / np.cosh(np.minimum(m, 300.0)) ** 2
        m = m - (m * np.tanh(m) - x) / np.where(slope > 0.0, slope, 1.0)
    m = np.maximum(m, 1e-12)
    log_cosh = np.logaddexp(m, -m) - np.log(2.0)
    return m + np.log(-np.expm1(-2.0 * m)) - np.log(2.0) + log_cosh - np.log(m), 2.0 * log_cosh


# ln g and 2 ln(cosh m), shape (ROOTS, 2), at sqrt(X) evenly from 0 to LARGEST_ROOT
PROFILE = np.ascontiguousarray(np.stack(nahme(np.linspace(0.0, LARGEST_ROOT, ROOTS) ** 2), axis=1))

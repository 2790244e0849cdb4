"""Drag of a sphere that moves along a wall without rotating: the exact series in bispherical coordinates.

O'Neill (1964), Mathematika 11, 67, as Goldman, Cox and Brenner (1967), Chem. Eng. Sci. 22, 637, give it. With
cosh a = 1 + h/R, k_n = (n + 1/2) coth((n + 1/2) a) - coth a, the A_n solve

    [(2n-1) k_{n-1} - (2n-3) k_n] [(n-1) A_{n-1}/(2n-1) - n A_n/(2n+1)]
    - [(2n+5) k_n - (2n+3) k_{n+1}] [(n+1) A_n/(2n+1) - (n+2) A_{n+1}/(2n+3)]
    = sqrt(2) [2 coth((n+1/2) a) - coth((n-1/2) a) - coth((n+3/2) a)],

and the drag over Stokes' is sqrt(2)/6 sinh a sum of E_n + n (n+1) C_n.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_banded

TERMS = 60.0  # over a


def coth(x):
    return 1.0 / np.tanh(x)


def drag_at_wall(gap):
    """Drag over that in free flow [-] at a gap over the radius [-]."""
    a = np.arccosh(1.0 + gap)
    count = int(TERMS / a) + 50
    n = np.arange(1.0, count + 1.0)

    def k(m):
        return (m + 0.5) * coth((m + 0.5) * a) - coth(a)

    # 1. tridiagonal system for A_1, A_2, ...
    before = (2.0 * n - 1.0) * k(n - 1.0) - (2.0 * n - 3.0) * k(n)
    after = (2.0 * n + 5.0) * k(n) - (2.0 * n + 3.0) * k(n + 1.0)
    bands = np.zeros((3, count))
    bands[0, 1:] = (after * (n + 2.0) / (2.0 * n + 3.0))[:-1]
    bands[1] = -(before * n + after * (n + 1.0)) / (2.0 * n + 1.0)
    bands[2, :-1] = (before * (n - 1.0) / (2.0 * n - 1.0))[1:]
    right = np.sqrt(2.0) * (2.0 * coth((n + 0.5) * a) - coth((n - 0.5) * a) - coth((n + 1.5) * a))
    series = np.zeros(count + 2)
    series[1 : count + 1] = solve_banded((1, 1), bands, right)
    # 2. C_n and E_n
    n = np.arange(0.0, count + 1.0)
    lower, same, upper = np.concatenate([[0.0], series[:-2]]), series[:-1], series[1:]
    c = -2.0 * k(n) * ((n - 1.0) / (2.0 * n - 1.0) * lower - same + (n + 2.0) / (2.0 * n + 3.0) * upper)
    e = 2.0 * np.sqrt(2.0) * np.exp(-(n + 0.5) * a) / np.sinh((n + 0.5) * a)
    e += k(n) * (n * (n - 1.0) / (2.0 * n - 1.0) * lower - (n + 1.0) * (n + 2.0) / (2.0 * n + 3.0) * upper)
    # 3. sum
    return np.sqrt(2.0) / 6.0 * np.sinh(a) * np.sum(e + n * (n + 1.0) * c)

"""The film atlas as tabulated: functions of x = (ln A, sqrt L, ln D).

A = a^2/(Rx^2 sqrt(2U)) = f(D)^2 M^(2/3), D = Rx/Ry, M and L after Moes (1992). Each function is a
mean, a trend of second degree and a sum of radial functions around the solved places,

    F(x) = m + trend(x) + sum_i w_i k(|(x - x_i)/l|),   k(d) = (1 + t + t^2/3) e^-t,  t = sqrt(5) d

(a Gaussian process with Matern's kernel of 5/2), fitted to solutions by `tools/atlas/fit.py`. The
six are ln(Hc A), ln(Hmin A), H0, and T/C - ln s of the rolling moment at three layers s, see
`films`. Another oil adds fitted terms in Roelands' z and ln(alpha/alpha_0).
"""

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array

FILE = Path(__file__).parent / "film_atlas.npz"
BASE_Z = 0.68  # Roelands' z of the oil of the solves [-]
BASE_ALPHA = 22e-9  # its alpha [1/Pa]
PAIRS = np.triu_indices(3)


class Table(NamedTuple):
    """What the file holds [-]."""

    places: Array  # (n, 3) x_i
    scales: Array  # (3,) l
    mean: Array  # (6,)
    trend: Array  # (10, 6)
    weights: Array  # (n, 6)
    oils: Array  # (20, 6)
    # (3, 6) relative errors, of H0 absolute ones, within which nineteen of twenty fresh contacts
    # lie: of the base oil with D up to 1, of that with D above 1, of other oils
    bars: Array


@cache
def table() -> Table:
    """The table, read once [-]."""
    with np.load(FILE) as file:
        return Table(**{name: file[name] for name in Table._fields})


def bars_of(ratio: Array, base: NDArray[np.bool_]) -> Array:
    """Errors of the six functions at Rx/Ry of shape (m,), shape (m, 6) [-]; base: whether the oil
    is that of the solves, shape (m,).
    """
    slim, wide, oils = table().bars
    own = np.where(ratio[:, None] > 1.0, wide, slim)
    return np.where(base[:, None], own, np.maximum(own, oils))


def trend_terms(x: Array) -> Array:
    """1, x_j and x_j x_k of places of shape (m, 3), shape (m, 10) [-]."""
    first, second = PAIRS
    return np.concatenate([np.ones((len(x), 1)), x, x[:, first] * x[:, second]], axis=1)


def radial(x: Array, places: Array, scales: Array) -> Array:
    """Radial functions of places (n, 3) at x of shape (m, 3), shape (m, n) [-]."""
    steps = (x[:, None, :] - places[None, :, :]) / scales
    t = np.sqrt(5.0 * np.einsum("ijk,ijk->ij", steps, steps))
    return np.asarray((1.0 + t + t**2 / 3.0) * np.exp(-t))


def oil_terms(x: Array, alpha: Array, z: Array) -> Array:
    """{z', a, z' a, a^2, z'^2} times sqrt(L) {1, x_j} at x of shape (m, 3), shape (m, 20) [-]; a =
    ln(alpha/alpha_0), z' = z - z_0: zero for the oil of the solves, and at L = 0; alpha [1/Pa].
    """
    a = np.log(np.asarray(alpha) / BASE_ALPHA)
    d = np.asarray(z) - BASE_Z
    own = np.stack([d, a, d * a, a**2, d**2], axis=1)
    with_one = np.concatenate([np.ones((len(x), 1)), x], axis=1)
    own = own * x[:, 1:2]
    return np.asarray((own[:, :, None] * with_one[:, None, :]).reshape(len(x), -1))


def functions(x: Array, alpha: Array, z: Array) -> Array:
    """The six functions at x of shape (m, 3), shape (m, 6) [-]; alpha [1/Pa]."""
    known = table()
    base = known.mean + trend_terms(x) @ known.trend
    base = base + radial(x, known.places, known.scales) @ known.weights
    return np.asarray(base + oil_terms(x, alpha, z) @ known.oils)

"""The film atlas as tabulated: functions of x = (ln A, sqrt L, ln D).

A = a^2/(Rx^2 sqrt(2U)) = f(D)^2 M^(2/3), D = Rx/Ry, M and L after Moes (1992). Each function is a
mean, a trend of second degree and a sum of radial functions around the solved places,

    F(x) = m + trend(x) + sum_i w_i k(|(x - x_i)/l|),   k(d) = (1 + t + t^2/3) e^-t,  t = sqrt(5) d

(a Gaussian process with Matern's kernel of 5/2), fitted to solutions by `tools/atlas/fit.py`. The
six are ln(Hc A), ln(Hmin A), Hc - H0, and T/C - ln s of the rolling moment at three layers s, see
`films`. Another oil adds `oil_features`, polynomials of Roelands' z and ln(alpha/alpha_0) times
sqrt L, each times a function of x of the same kind with a linear trend.

There are two patches: in light contacts, where rigid bodies become elastic ones, the central film
rises with load over a small step of ln A. It lies at smaller A the larger D is: there x_1 is ln A
and `slanted` terms of D and L, and around the step a second sum of radial functions of shorter
scales is added. Over `SEAM` one patch gives way to the other.
"""

from functools import cache
from math import log, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array, radial, trend_terms
from ..data_files import read_arrays
from ._kernels import near_functions

FILE = Path(__file__).parent / "film_atlas.npz"
BASE_Z = 0.68  # Roelands' z of the oil of the solves [-]
BASE_ALPHA = 22e-9  # its alpha [1/Pa]
OIL_UNITS = (0.2, 0.45)  # of z and ln alpha in the features of oils [-]
NO_STEP = np.array([0.0, 1.0, 0.0, 1.0, 1.0, 1.0])  # of a patch without a step [-]


# interval of A in which the patch of light contacts gives way to that of heavy ones [-]
SEAM = (7.0, 9.0)
LIGHT = 7.0  # A below which contacts are light
# A and L beyond which errors of slim ellipses were judged apart, and A where they change again
BEYOND = (160.0, 30.0)
FARTHER = (400.0, 650.0)
STEP = 0.2  # of the slanted ln A, up to which light contacts count to the step of their film [-]


class Patch(NamedTuple):
    """The functions over a part of the range [-]."""

    slant: Array  # (4,) of `slanted`
    places: Array  # (n, 3) x_i
    scales: Array  # (3,) l
    # (6,) of the radial functions around the step: its x_1, its width, their variance over that of
    # the others, their scales
    step: Array
    mean: Array  # (6,)
    trend: Array  # (10, 6)
    weights: Array  # (n, 6)
    oil_places: Array  # (k, 3) of contacts with other oils
    oil_features: Array  # (k, 5) theirs
    oil_scales: Array  # (3,)
    oil_trend: Array  # (20, 6)
    oil_weights: Array  # (k, 6)


class Table(NamedTuple):
    """Contents of the file [-]."""

    light: Patch  # patch of light contacts
    heavy: Patch  # patch of heavy contacts
    # (2, 4, 6) relative errors, of Hc - H0 absolute ones, within which nineteen of twenty fresh
    # contacts lie, below and above the beginning of the seam: of the base oil with D up to 1, of
    # that with D above 1, likewise of other oils
    bars: Array
    # (2, 2, 6) likewise of light contacts that were drawn at the step of their film, with D up to
    # 1 and above: of the base oil, of others
    step_bars: Array
    # (5, 6) likewise of slim ellipses beyond L 30, light and heavy, and beyond A 160 and 400;
    # beyond 650 what a fit to A up to 350 leaves at twice as much
    beyond_bars: Array


@cache
def table() -> Table:
    """The table, read once [-]."""
    file = read_arrays(FILE)
    light, heavy = (
        Patch(**{name: file[f"{patch}_{name}"] for name in Patch._fields})
        for patch in ("light", "heavy")
    )
    return Table(light=light, heavy=heavy, **{name: file[name] for name in Table._fields[2:]})


def error_bars(x: Array, base: NDArray[np.bool_]) -> Array:
    """Give the errors of the six functions.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]
    base : NDArray[np.bool_]
        whether the oil is that of the solves, shape (m,)

    Returns
    -------
    Array
        errors, shape (m, 6) [-]
    """
    light, _, tabulated, at_step, beyond = table()
    heavy = x[:, 0] >= log(SEAM[0])
    wide = x[:, 2] > 0.0
    away = np.abs(slanted(x, light.slant)[:, 0] - light.step[0])
    # 1. errors of all kinds: by load, ratio and oil, then of light contacts at the step
    plain = np.stack([tabulated[:, :2], np.maximum(tabulated[:, :2], tabulated[:, 2:])], axis=2)
    kinds = np.concatenate([plain, np.maximum(plain[:1], at_step)]).reshape(-1, tabulated.shape[2])
    # 2. kinds of these contacts
    first = np.where((away < STEP) & ~heavy, 2, heavy)
    bars = kinds[4 * first + 2 * wide + ~base]
    # 3. those beyond what others were judged by
    load, thick = log(BEYOND[0]), sqrt(BEYOND[1])
    far = np.where(x[:, 0] > load, 2 + np.searchsorted(np.log(FARTHER), x[:, 0]), heavy)
    outside = (x[:, 0] > load) | (x[:, 1] > thick)
    bars[outside] = beyond[far[outside]]
    return np.asarray(bars)


def heavy_weight(log_load: Array, seam: tuple[float, float] = SEAM) -> tuple[Array, Array]:
    """Weight the patch of heavy contacts by a cubic step over the seam.

    Parameters
    ----------
    log_load : Array
        ln A, any shape [-]
    seam : tuple[float, float], default SEAM
        A at both ends of the seam [-]

    Returns
    -------
    weight
        weight, shape of `log_load` [-]
    slope
        its derivative by ln A, of this shape [-]
    """
    low, high = np.log(seam)
    t = np.clip((log_load - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / (high - low)


def slanted(x: Array, slant: Array) -> Array:
    """Evaluate (ln A + c_0 ln D + c_1 (ln D)^2 + c_2 sqrt L + c_3 L, sqrt L, ln D).

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]
    slant : Array
        c_0 to c_3, shape (4,) [-]

    Returns
    -------
    Array
        slanted positions, shape (m, 3) [-]
    """
    _, root, ratio = x.T
    first = x[:, 0] + np.stack([ratio, ratio**2, root, root**2], axis=1) @ slant
    return np.column_stack([first, x[:, 1:]])


def slanted_radial(x: Array, places: Array, scales: Array, step: Array) -> Array:
    """Evaluate radial functions with those around the step of a patch.

    Parameters
    ----------
    x : Array
        slanted positions, shape (m, 3) [-]
    places : Array
        slanted centres, shape (n, 3) [-]
    scales : Array
        scales along the axes, shape (3,) [-]
    step : Array
        centre, width, variance and scales of the step, as in `Patch`, shape (6,) [-]

    Returns
    -------
    Array
        functions, shape (m, n) [-]
    """
    result = radial(x, places, scales)
    centre, width, variance = step[:3]
    if variance > 0.0:
        here, there = (np.exp(-0.5 * ((y[:, 0] - centre) / width) ** 2) for y in (x, places))
        result += variance * np.outer(here, there) * radial(x, places, step[3:])
    return result


def weighted_radial_sums(
    x: Array, places: Array, scales: Array, step: Array, weights: Array
) -> Array:
    """Sum the functions of `slanted_radial` by weights, compiled.

    Parameters
    ----------
    x : Array
        slanted positions, shape (m, 3) [-]
    places : Array
        slanted centres, shape (n, 3) [-]
    scales : Array
        scales along the axes, shape (3,) [-]
    step : Array
        centre, width, variance and scales of the step, shape (6,) [-]
    weights : Array
        weights of the functions, shape (n, k) [-]

    Returns
    -------
    Array
        sums, shape (m, k) [-]
    """
    result = np.empty((len(x), len(places)))
    near_functions(x, places, scales, step, result)
    return np.asarray(result @ weights)


def oil_features(x: Array, alpha: Array, z: Array) -> Array:
    """Evaluate sqrt L/4 times {z', a, z' a/2, a^2/2, z'^2/2}.

    a = ln(alpha/alpha_0)/0.45, z' = (z - z_0)/0.2: zero for the oil of the solves, and at L = 0.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]

    Returns
    -------
    Array
        features, shape (m, 5) [-]
    """
    a = np.log(np.asarray(alpha) / BASE_ALPHA) / OIL_UNITS[1]
    d = (np.asarray(z) - BASE_Z) / OIL_UNITS[0]
    terms = np.stack([d, a, 0.5 * d * a, 0.5 * a * a, 0.5 * d * d], axis=1)
    return np.asarray(0.25 * x[:, 1:2] * terms)


def with_linear_terms(features: Array, x: Array) -> Array:
    """Multiply features by {1, x_j}.

    Parameters
    ----------
    features : Array
        features of oils, shape (m, 5) [-]
    x : Array
        positions, shape (m, 3) [-]

    Returns
    -------
    Array
        products, shape (m, 20) [-]
    """
    line = np.concatenate([np.ones((len(x), 1)), x], axis=1)
    return np.asarray((features[:, :, None] * line[:, None, :]).reshape(len(x), -1))


def patch_base(patch: Patch, x: Array) -> Array:
    """Evaluate the six functions of a patch with the oil of the solves.

    Parameters
    ----------
    patch : Patch
        functions over a region of the atlas
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]

    Returns
    -------
    Array
        functions, shape (m, 6) [-]
    """
    slanted_x = slanted(x, patch.slant)
    base = patch.mean + trend_terms(slanted_x) @ patch.trend
    base += weighted_radial_sums(slanted_x, patch.places, patch.scales, patch.step, patch.weights)
    return np.asarray(base)


def patch_oils(patch: Patch, x: Array) -> Array:
    """Evaluate the coefficient of each feature of an oil.

    Parameters
    ----------
    patch : Patch
        functions over a region of the atlas
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]

    Returns
    -------
    Array
        coefficients, shape (m, 5, 6) [-]
    """
    line = np.concatenate([np.ones((len(x), 1)), x], axis=1)
    features, weights = patch.oil_features, patch.oil_weights
    products = (features[:, :, None] * weights[:, None, :]).reshape(len(weights), -1)
    around = weighted_radial_sums(x, patch.oil_places, patch.oil_scales, NO_STEP, products)
    trend = np.einsum("mc,fck->mfk", line, patch.oil_trend.reshape(-1, 4, weights.shape[1]))
    return np.asarray(trend + around.reshape(trend.shape))


def functions(x: Array, alpha: Array, z: Array, tabulated: Table | None = None) -> Array:
    """Evaluate the six functions of the atlas.

    Parameters
    ----------
    x : Array
        (ln A, sqrt L, ln D) of contacts, shape (m, 3) [-]
    alpha : Array
        pressure-viscosity coefficient, shape (m,) [1/Pa]
    z : Array
        Roelands' z, shape (m,) [-]
    tabulated : Table | None, optional
        table; None: that of the package

    Returns
    -------
    Array
        functions, shape (m, 6) [-]
    """
    tabulated = tabulated or table()
    fraction = heavy_weight(x[:, 0])[0]
    features = oil_features(x, alpha, z)
    result = np.zeros((len(x), tabulated.bars.shape[-1]))
    for patch, weight in ((tabulated.light, 1.0 - fraction), (tabulated.heavy, fraction)):
        inside = weight > 0.0
        if inside.any():
            values = patch_base(patch, x[inside])
            if features[inside].any():
                values += np.einsum("mf,mfk->mk", features[inside], patch_oils(patch, x[inside]))
            result[inside] += weight[inside, None] * values
    return result

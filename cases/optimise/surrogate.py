"""Gaussian process of one number over the unit cube, with a known noise for each value.

Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), algorithm 2.1; Matern
kernel of 5/2 with a length for each key, eq. 4.17; hyperparameters of the largest marginal
likelihood, eq. 5.8.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import minimize
from scipy.spatial.distance import cdist

from ehl.arrays import Array

LENGTHS = (0.05, 10.0)  # of the kernel over the unit cube [-]: shorter ones are noise, longer flat
JITTER = 1e-8  # of the variance: what rounding takes from a matrix of equal points
START = 0.5  # length that the search begins with [-]


@dataclass(frozen=True, slots=True)
class Surrogate:
    """A fitted process: `mean` and `scale` of the values, in their unit; lengths [-]."""

    positions: Array  # shape (n, keys)
    mean: float
    scale: float
    lengths: Array  # shape (keys,)
    factor: Array  # of the covariance, lower
    weights: Array  # shape (n,)

    def predict(self, positions: Array) -> tuple[Array, Array]:
        """Mean and standard deviation of the number itself, without noise.

        Parameters
        ----------
        positions : Array
            Positions in the unit cube, shape (m, keys) [-].

        Returns
        -------
        mean
            Mean, shape (m,), in the unit of the values.
        deviation
            Standard deviation, shape (m,), in the unit of the values.
        """
        across = _matern(positions, self.positions, self.lengths)
        mean = across @ self.weights
        solved = cho_solve((self.factor, True), across.T)
        variance = np.maximum(1.0 - np.einsum("ij,ji->i", across, solved), 0.0)
        return self.mean + self.scale * mean, self.scale * np.sqrt(variance)


def fitted(positions: Array, values: Array, noise: Array) -> Surrogate:
    """Fit the process through values with known standard deviations.

    Parameters
    ----------
    positions : Array
        Positions in the unit cube, shape (n, keys) [-].
    values : Array
        Values, shape (n,).
    noise : Array
        Their standard deviations in the same unit, shape (n,).

    Returns
    -------
    Surrogate
        The process.
    """
    mean = float(values.mean())
    scale = float(values.std()) or 1.0
    scaled = (values - mean) / scale
    variances = (noise / scale) ** 2 + JITTER
    low, high = np.log(LENGTHS).tolist()
    bounds = [(low, high)] * positions.shape[1]
    start = np.full(positions.shape[1], np.log(START))
    found = minimize(_minus_likelihood, start, (positions, scaled, variances), bounds=bounds)
    lengths = np.exp(found.x)
    factor, _ = cho_factor(_covariance(positions, lengths, variances), lower=True)
    weights = cho_solve((factor, True), scaled)
    return Surrogate(positions, mean, scale, lengths, np.tril(factor), weights)


def _matern(first: Array, second: Array, lengths: Array) -> Array:
    """Matern kernel of 5/2, shape (n, m)."""
    distance = np.sqrt(5.0) * cdist(first / lengths, second / lengths)
    return (1.0 + distance + distance**2 / 3.0) * np.exp(-distance)


def _covariance(positions: Array, lengths: Array, variances: Array) -> Array:
    return _matern(positions, positions, lengths) + np.diag(variances)


def _minus_likelihood(
    logarithms: Array, positions: Array, values: Array, variances: Array
) -> float:
    """Minus the logarithm of the marginal likelihood but for a constant."""
    factor, _ = cho_factor(_covariance(positions, np.exp(logarithms), variances), lower=True)
    fit = 0.5 * values @ cho_solve((factor, True), values)
    return float(fit + np.log(np.diag(factor)).sum())

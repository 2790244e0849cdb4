"""How well the mean of a history is known, by batch means; whirl of a centre."""

import numpy as np

from .arrays import Array

BATCHES = 10  # fewest of the ten to thirty of Schmeiser (1982), Operations Research 30, 556
STUDENT = 2.2622  # 97.5 % of Student's distribution with BATCHES - 1 degrees of freedom
LEAST = 2 * BATCHES  # samples, below which no interval is given
STILL = 1.0e-12  # way of a centre that counts as none [m]


def batch_interval(values: Array) -> float | None:
    """Half width of the 95 % confidence interval of the mean of evenly sampled values, by the
    means of batches.

    The history is cut into `BATCHES` equal pieces, whose means are taken for independent: they are
    where a piece is longer than the slowest motion, so what goes round with the cage needs ten
    turns of it. A trend widens the interval.

    Parameters
    ----------
    values : ndarray, shape (m,)
        [unit of the values].

    Returns
    -------
    float or None
        [unit of the values]; None below `LEAST` values.
    """
    if values.size < LEAST:
        return None
    size = values.size // BATCHES
    means = values[values.size - size * BATCHES :].reshape(BATCHES, size).mean(axis=1)
    return STUDENT * float(means.std(ddof=1)) / BATCHES**0.5


def whirl_speed(time: Array, place: Array) -> float | None:
    """Mean angular speed of a centre's path about its own mean, positive as the axis turns
    [rad/s].

    Parameters
    ----------
    time : ndarray, shape (m,)
        [s].
    place : ndarray, shape (m, 2)
        y and z of the centre [m].

    Returns
    -------
    float or None
        [rad/s]; None where the centre stays within a picometre, or there are fewer than three
        samples.
    """
    off = place - place.mean(axis=0)
    if time.size < 3 or np.abs(off).max() < STILL:
        return None
    angle = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    return float(angle[-1] - angle[0]) / float(time[-1] - time[0])

"""How well the mean of a history is known: batch means."""

from __future__ import annotations

from .problem import Array

BATCHES = 10  # fewest of the ten to thirty of Schmeiser (1982), Operations Research 30, 556
STUDENT = 2.2622  # 97.5 % of Student's distribution with BATCHES - 1 degrees of freedom
LEAST = 2 * BATCHES  # samples, below which no interval is given


def batch_interval(values: Array) -> float | None:
    """Half width of the 95 % confidence interval of the mean of evenly sampled values, by the means of batches.

    The history is cut into `BATCHES` equal pieces, whose means are taken for independent: they are where a piece is
    longer than the slowest motion, so what goes round with the cage needs ten turns of it. A trend widens the interval.

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

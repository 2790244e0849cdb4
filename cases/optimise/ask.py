"""Which designs are computed next: expected improvement where the constraints are likely met.

Jones, Schonlau and Welch (1998) for one goal; Knowles (2006) for several, as one goal by random
weights; several designs at a time by taking the surrogate's mean for those not computed yet
(Ginsbourger et al. 2010, the kriging believer).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, qmc

from ehl.arrays import Array

from .surrogate import Surrogate, fitted

CANDIDATES = 1024  # places of the unit cube at which the improvement is looked for, a power of 2
LOCAL_CANDIDATES = 512  # more of them about the best designs
LOCAL_DEVIATION = 0.05  # of those, standard deviation in the unit cube [-]
Booleans = NDArray[np.bool_]
SUM_WEIGHT = 0.05  # share of the sum of goals, Knowles (2006), eq. 2


@dataclass(frozen=True, slots=True)
class Observations:
    """Designs computed so far; all numbers such that less is better, NaN without a result.

    places: shape (n, keys) of the unit cube [-]; goals and their noise: shape (n, goals);
    constraints, met where not positive, and their noise: shape (n, constraints).
    """

    positions: Array
    goals: Array
    noise: Array
    constraints: Array
    constraint_noise: Array

    @property
    def complete(self) -> Booleans:
        """Designs that have all numbers."""
        whole = np.column_stack([self.goals, self.constraints])
        return np.asarray(np.isfinite(whole).all(axis=1))

    @property
    def feasible(self) -> Booleans:
        """Designs that have all numbers and meet all constraints."""
        return self.complete & (np.nan_to_num(self.constraints, nan=1.0) <= 0.0).all(axis=1)


def first_designs(keys: int, count: int, seed: int) -> Array:
    """Designs to begin with: a Latin hypercube.

    Parameters
    ----------
    keys : int
        Number of keys [-].
    count : int
        Number of designs [-].
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Array
        Positions in the unit cube, shape (count, keys) [-].
    """
    return qmc.LatinHypercube(keys, seed=np.random.default_rng(seed)).random(count)


def next_designs(observations: Observations, count: int, seed: int) -> Array:
    """Designs to compute next.

    Parameters
    ----------
    observations : Observations
        Designs computed so far.
    count : int
        Number of designs [-].
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Array
        Positions in the unit cube, shape (count, keys) [-].
    """
    rng = np.random.default_rng(seed)
    complete = observations.complete
    if complete.sum() < 2:
        return rng.random((count, observations.positions.shape[1]))
    limits = [
        fitted(
            observations.positions[complete],
            observations.constraints[complete, k],
            observations.constraint_noise[complete, k],
        )
        for k in range(observations.constraints.shape[1])
    ]
    designs: list[Array] = []
    for _ in range(count):
        value, noise = scalar_goal(observations.goals[complete], observations.noise[complete], rng)
        positions = observations.positions[complete]
        if designs:
            believed = fitted(positions, value, noise).predict(np.array(designs))[0]
            value = np.concatenate([value, believed])
            noise = np.concatenate([noise, np.zeros(len(designs))])
            positions = np.vstack([positions, designs])
        met = np.concatenate([observations.feasible[complete], np.ones(len(designs), dtype=bool)])
        designs.append(
            _best_candidate(fitted(positions, value, noise), limits, (positions, met), rng)
        )
    return np.array(designs)


def scalar_goal(goals: Array, noise: Array, rng: np.random.Generator) -> tuple[Array, Array]:
    """Several goals as one by random weights, the augmented Tchebycheff function.

    Parameters
    ----------
    goals : Array
        Goals, smaller is better, shape (n, goals).
    noise : Array
        Their standard deviations, shape (n, goals).
    rng : np.random.Generator
        Random numbers.

    Returns
    -------
    value
        The one goal, shape (n,).
    noise
        Its standard deviation, shape (n,).
    """
    low, high = (end(goals, axis=0) for end in (np.min, np.max))
    span = np.where(high > low, high - low, 1.0)
    scaled = (goals - low) / span
    weights = rng.dirichlet(np.ones(goals.shape[1]))
    weighted = weights * scaled
    value = weighted.max(axis=1) + SUM_WEIGHT * weighted.sum(axis=1)
    return value, np.sqrt(((weights * noise / span) ** 2).sum(axis=1))


def _best_candidate(
    model: Surrogate,
    limits: list[Surrogate],
    before: tuple[Array, Booleans],
    rng: np.random.Generator,
) -> Array:
    """Place of the largest expected improvement times the probability that constraints are met."""
    positions, met = before
    means = model.predict(positions)[0]
    order = np.argsort(np.where(met, means, np.inf))[:4]
    keys = positions.shape[1]
    spread = positions[
        rng.choice(order, LOCAL_CANDIDATES)
    ] + LOCAL_DEVIATION * rng.standard_normal((LOCAL_CANDIDATES, keys))
    candidates = np.vstack(
        [qmc.Sobol(keys, seed=rng).random(CANDIDATES), np.clip(spread, 0.0, 1.0)]
    )
    mean, deviation = model.predict(candidates)
    chance = np.ones(len(candidates))
    for limit in limits:
        middle, width = limit.predict(candidates)
        chance *= norm.cdf(-middle / np.maximum(width, 1e-12 * limit.scale))
    if not met.any():  # first of all a design that meets the constraints
        return candidates[np.argmax(chance)]
    gain = means[met].min() - mean
    width = np.maximum(deviation, 1e-12 * model.scale)
    improvement = gain * norm.cdf(gain / width) + width * norm.pdf(gain / width)
    return candidates[np.argmax(improvement * chance)]


def pareto_front(goals: Array) -> Booleans:
    """Designs that no other one betters in one goal without being worse in another.

    Parameters
    ----------
    goals : Array
        Goals, smaller is better, shape (n, goals).

    Returns
    -------
    Booleans
        True for designs of the front, shape (n,).
    """
    front = np.ones(len(goals), dtype=bool)
    for k, own in enumerate(goals):
        better = (goals <= own).all(axis=1) & (goals < own).any(axis=1)
        front[k] = not better.any()
    return front

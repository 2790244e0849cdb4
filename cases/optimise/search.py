"""Designs computed by the batch until there are enough, the best ones confirmed by full solves.

The surrogate is scikit-learn's Gaussian process of one number over the unit cube, with a known
noise for each value (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006,
algorithm 2.1): Matern kernel of 5/2 with a length for each key, eq. 4.17, and the lengths of the
largest marginal likelihood, eq. 5.8.

The next designs have the largest expected improvement where the constraints are likely met: Jones,
Schonlau and Welch (1998) for one goal; Knowles (2006) for several, as one goal by random weights;
several designs at a time by taking the surrogate's mean for those not computed yet (Ginsbourger et
al. 2010, the kriging believer).

At the end the case and the best designs are computed with solved films, see [proof]: the
improvement, and its error.
"""

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, qmc
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import Matern

from oilfilm.ehl.arrays import Array
from oilfilm.postprocess.batch.results import BatchPoint

from ..batch.engine import PointSelection, run_batch
from ..batch.plan import Setting
from ..batch.points import Sweep
from ..batch.pools import LocalPool, Pool
from ..batch.results import load_results
from ..runs.films import Progress
from .study import Design, OptimisationResult, Study, designs_of

LENGTHS = (0.05, 10.0)  # of the kernel over the unit cube [-]: shorter ones are noise, longer flat
JITTER = 1e-8  # of the variance: what rounding takes from a matrix of equal points
START = 0.5  # length that the search begins with [-]

CANDIDATES = 1024  # places of the unit cube at which the improvement is looked for, a power of 2
LOCAL_CANDIDATES = 512  # more of them about the best designs
LOCAL_DEVIATION = 0.05  # of those, standard deviation in the unit cube [-]
Booleans = NDArray[np.bool_]
SUM_WEIGHT = 0.05  # share of the sum of goals, Knowles (2006), eq. 2
MOST_CONFIRMED = 3  # designs of a front: both ends of the first goal and the middle
CASE = "case"  # the first of what is proved
NODES = "ehl.points"  # key whose half gives the error of numbers without an error bar
FEWEST = 33  # nodes that a film may have
# a number of the search that is so far from its proof misleads the search, and is told [-]
VISIBLE = 0.01
Compute = Callable[[Sweep], Sequence[BatchPoint]]
COVERAGE = 2.0  # standard deviations of an error bar, which is to hold the number in 95 of 100


@dataclass(frozen=True, slots=True)
class Surrogate:
    """A fitted process: `mean` and `scale` of the values, in their unit."""

    process: GaussianProcessRegressor  # of the values less their mean over their scale
    mean: float
    scale: float

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
        mean, deviation = self.process.predict(positions, return_std=True)
        return self.mean + self.scale * mean, self.scale * deviation


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
    kernel = Matern(np.full(positions.shape[1], START), LENGTHS, nu=2.5)
    process = GaussianProcessRegressor(kernel, alpha=(noise / scale) ** 2 + JITTER)
    with warnings.catch_warnings():  # a key without influence has the longest length
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(positions, (values - mean) / scale)
    return Surrogate(process, mean, scale)


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
            _best_candidate(fitted(positions, value, noise), limits, positions, met, rng)
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
    positions: Array,
    met: Booleans,
    rng: np.random.Generator,
) -> Array:
    """Place of the largest expected improvement times the probability that constraints are met."""
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


def confirm_designs(found: OptimisationResult, compute: Compute) -> OptimisationResult:
    """Compute the case and the best designs once more with solved films.

    Parameters
    ----------
    found : OptimisationResult
        Result of the search.
    compute : Compute
        Computes the points of a sweep.

    Returns
    -------
    OptimisationResult
        The result with the confirmed designs; unchanged without [proof], or a design within the
        limits.
    """
    study = found.study
    if not study.proof or not found.front:
        return found
    front = found.front
    chosen = dict.fromkeys((front[0], front[len(front) // 2], front[-1]))
    own = study.position_of_case()
    named = [] if own is None else [(CASE, study.values(own))]
    for number in list(chosen)[:MOST_CONFIRMED]:
        design = found.designs[number - 1]
        named.append((f"design {number}", [design.values[key] for key in study.keys]))

    def computed(proof: tuple[Setting, ...]) -> tuple[tuple[str, Design], ...]:
        points = compute(study.sweep([values for _, values in named], proof))
        designs = designs_of(study, points, 0, bars=True)
        return tuple((name, design) for (name, _), design in zip(named, designs, strict=True))

    half = _half(study.proof)
    return replace(found, confirmed=computed(study.proof), coarse=computed(half) if half else ())


def _half(proof: tuple[Setting, ...]) -> tuple[Setting, ...]:
    """The proof on half the nodes; empty where it names none, or there are no fewer."""
    nodes = {setting.key: setting.value for setting in proof}.get(NODES)
    if not isinstance(nodes, int) or (nodes - 1) // 2 + 1 < FEWEST:
        return ()
    fewer = (nodes - 1) // 2 + 1
    return tuple(
        replace(one, value=fewer) if one.key == NODES else one  # of a frozen setting
        for one in proof
    )


def improvement(found: OptimisationResult) -> dict[str, Any] | None:
    """Gain of the first goal from the case to the best confirmed design.

    The error of the difference is that of both error bars or, of a goal without one, the change
    of the difference by half the nodes; None where neither is known.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.

    Returns
    -------
    dict[str, Any] | None
        Gain and its error; None where `no_improvement_reason` gives one.
    """
    if no_improvement_reason(found) is not None:
        return None
    name, sign = found.study.goals[0]
    case, best = _case(found), _best(found)
    assert case is not None and best is not None  # or there is a reason
    before, after = case[1].numbers[name] or 0.0, best[1].numbers[name] or 0.0
    error = _error(found, (CASE, best[0]), name)
    gain = sign * (before - after)
    return {
        "goal": name,
        "design": best[0],
        "case": before,
        "best": after,
        "share": gain / abs(before) if before else None,
        "error": error,
        "proved": None if error is None else gain > error,
    }


def _case(found: OptimisationResult) -> tuple[str, Design] | None:
    """The case in the proof, if its goal is known."""
    name, _ = found.study.goals[0]
    designs = [pair for pair in found.confirmed if pair[0] == CASE]
    candidates = [pair for pair in designs if pair[1].numbers[name] is not None]
    return candidates[0] if candidates else None


def _best(found: OptimisationResult) -> tuple[str, Design] | None:
    """The best proved design that meets the limits within their error bars."""
    name, sign = found.study.goals[0]
    candidates = [pair for pair in found.confirmed if pair[0] != CASE and pair[1].feasible]
    return min(candidates, key=lambda pair: sign * (pair[1].numbers[name] or 0.0), default=None)


def _error(found: OptimisationResult, pair: tuple[str, str], name: str) -> float | None:
    """Error of the difference of two proved designs in a number."""
    fine, coarse = dict(found.confirmed), dict(found.coarse)
    first, second = (fine[one].errors.get(name, 0.0) for one in pair)
    if first or second:
        return hypot(first, second)
    if not all(one in coarse and coarse[one].numbers[name] is not None for one in pair):
        return None
    of_fine, of_coarse = (
        (proof[pair[0]].numbers[name] or 0.0) - (proof[pair[1]].numbers[name] or 0.0)
        for proof in (fine, coarse)
    )
    return abs(of_fine - of_coarse)


def no_improvement_reason(found: OptimisationResult) -> str | None:
    """Reason why there is no improvement to report.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.

    Returns
    -------
    str | None
        The reason; None where there is an improvement.
    """
    name, _ = found.study.goals[0]
    if not found.front:
        return "no design meets the constraints"
    if not found.study.proof:
        return "there is no table [proof]"
    if found.study.position_of_case() is None:
        return "the case is outside the ranges"
    if _case(found) is None:
        return f"the case has no {name} in the proof{_reason_text(found, CASE)}"
    if _best(found) is None:
        names = ", ".join(name for name, _ in found.confirmed if name != CASE)
        text = next((_reason_text(found, name) for name, _ in found.confirmed if name != CASE), "")
        return f"none of {names} converges and meets the constraints in the proof{text}"
    return None


def _reason_text(found: OptimisationResult, name: str) -> str:
    message = dict(found.confirmed)[name].message
    return f": {message}" if message else ""


def confirmation_messages(found: OptimisationResult) -> Iterator[str]:
    """Messages on the improvement, its error, and numbers of the search that the confirmation
    refutes.

    Parameters
    ----------
    found : OptimisationResult
        Result of the optimisation.

    Yields
    ------
    Iterator[str]
        The messages.
    """
    why = no_improvement_reason(found)
    gain = improvement(found)
    if why is not None:
        yield f"improvement: null, {why}"
    elif gain is not None and gain["error"] is None:
        yield (
            f"improvement.proved: null, {gain['goal']} has no error bar; {NODES} in [proof], of "
            f"{2 * (FEWEST - 1) + 1} or more, gives one by half the nodes"
        )
    for name, design in found.confirmed:
        search_designs = _searched(found, name)
        if search_designs is not None:
            yield from _differences(name, search_designs, design)


def _searched(found: OptimisationResult, name: str) -> Design | None:
    """A proved design as the search had it."""
    number = 1 if name == CASE else int(name.partition(" ")[2])
    return found.designs[number - 1]


def _differences(name: str, search_designs: Design, proof: Design) -> Iterator[str]:
    """Numbers that the proof has outside the error bars of both, and visibly so."""
    for key, value in proof.numbers.items():
        before = search_designs.numbers.get(key)
        if value is None or before is None:
            continue
        bars = search_designs.errors.get(key, 0.0) + proof.errors.get(key, 0.0)
        if abs(value - before) > max(bars, VISIBLE * abs(value)):
            share = abs(value - before) / abs(value)
            yield f"{name}: {key} {before:.4g} in the search, {value:.4g} proved ({share:.1%} off)"


class PersistentPool(LocalPool):
    """Processes that stay from one generation of designs to the next, until `end`."""

    def close(self, *, at_once: bool) -> None:
        """End the processes at once, or leave them running for the next generation.

        Parameters
        ----------
        at_once : bool
            True: the processes end.
        """
        if at_once:
            super().close(at_once=True)

    def end(self) -> None:
        """End the workers."""
        super().close(at_once=False)


def search_designs(
    study: Study, directory: Path, pool: Callable[[], Pool], resume: bool, progress: Progress
) -> OptimisationResult:
    """Choose designs and compute them until there are as many as the study asks for.

    The designs follow from the study and from the numbers of those before alone, so that an
    interrupted search continues where it was.

    Parameters
    ----------
    study : Study
        The optimisation.
    directory : Path
        Folder of the batch.
    pool : Callable[[], Pool]
        Starts the workers.
    resume : bool
        True: finished points of the folder are taken over.
    progress : Progress
        Called with points done, points in all, and a text.

    Returns
    -------
    OptimisationResult
        The result.
    """
    search = study.search
    own = study.position_of_case()
    count = search.first - (own is not None)
    positions = first_designs(len(study.keys), count, search.seed)
    positions = positions if own is None else np.vstack([own, positions])
    designs: list[Design] = []
    again = resume
    each = len(study.deviations)

    def of_all(done: int, _total: int, _state: str) -> None:
        progress(done, search.designs * each, "points of the search")

    while len(designs) < search.designs:
        new = positions[len(designs) : search.designs]
        sweep = study.sweep([study.values(position) for position in positions[: search.designs]])
        batch = run_batch(sweep, directory, pool, PointSelection(resume=again), progress=of_all)
        again = True
        wanted = range(len(designs) * each, (len(designs) + len(new)) * each)
        points = load_results(batch, wanted).points
        designs += designs_of(study, points, len(designs))
        observations = _observations(study, positions[: len(designs)], designs)
        together = min(search.together, search.designs - len(designs))
        if together > 0:
            seed = search.seed + len(designs)
            positions = np.vstack([positions, next_designs(observations, together, seed)])
    front = _front(study, designs)
    found = OptimisationResult(study=study, designs=tuple(designs), front=front)

    def computed(sweep: Sweep) -> Sequence[BatchPoint]:
        batch = run_batch(sweep, directory, pool, PointSelection(resume=True), progress=progress)
        return load_results(batch).points

    return confirm_designs(found, computed)


def _observations(study: Study, positions: Array, designs: Sequence[Design]) -> Observations:
    """Designs as arrays in which less is better."""

    def column(name: str, sign: float, bound: float = 0.0) -> list[float]:
        values = [design.numbers[name] for design in designs]
        return [np.nan if value is None else sign * (value - bound) for value in values]

    def noise(name: str) -> list[float]:
        return [design.errors.get(name, 0.0) / COVERAGE for design in designs]

    shape = (len(designs), -1)
    limits = study.limits
    return Observations(
        positions=positions,
        goals=np.array([column(*goal) for goal in study.goals]).T.reshape(shape),
        noise=np.array([noise(name) for name, _ in study.goals]).T.reshape(shape),
        constraints=_table([column(one.name, one.sign, one.bound) for one in limits], designs),
        constraint_noise=_table([noise(one.name) for one in limits], designs),
    )


def _table(columns: list[list[float]], designs: Sequence[Design]) -> Array:
    return np.array(columns).T if columns else np.zeros((len(designs), 0))


def _front(study: Study, designs: Sequence[Design]) -> tuple[int, ...]:
    """Numbers of the feasible designs that no other one betters, by the first goal."""
    feasible = [design for design in designs if design.feasible]
    if not feasible:
        return ()
    rows = [[sign * (d.numbers[name] or 0.0) for name, sign in study.goals] for d in feasible]
    goals = np.array(rows)
    front = np.flatnonzero(pareto_front(goals))
    order = front[np.argsort(goals[front, 0], kind="stable")]
    return tuple(feasible[k].number for k in order)

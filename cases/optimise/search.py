"""Designs computed by the batch until there are enough, the best ones proved by full solves."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ehl.arrays import Array
from postprocess.batch.results import BatchPoint

from ..batch.engine import PointSelection, run_batch
from ..batch.points import Sweep
from ..batch.pools import LocalPool, Pool
from ..batch.results import load_results
from ..runs.films import Progress
from .ask import Observations, first_designs, next_designs, pareto_front
from .designs import Design, OptimisationResult, designs_of
from .proof import confirm_designs
from .study import Study

COVERAGE = 2.0  # standard deviations of an error bar, which is to hold the number in 95 of 100


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

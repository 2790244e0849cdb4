"""Designs computed by the batch until there are enough, the best ones proved by full solves."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ehl.arrays import Array
from postprocess.batch.results import BatchPoint

from ..batch.engine import Choice, run_batch
from ..batch.points import Sweep
from ..batch.pools import LocalPool, Pool
from ..batch.results import gathered
from ..runs.films import Progress
from .ask import Told, first_designs, next_designs, pareto_front
from .designs import Design, Found, designs_of
from .proof import proved
from .study import Study

COVERAGE = 2.0  # standard deviations of an error bar, which is to hold the number in 95 of 100


class KeptPool(LocalPool):
    """Processes that stay from one generation of designs to the next, until `end`."""

    def close(self, *, at_once: bool) -> None:
        """End the workers at once, or let them be."""
        if at_once:
            super().close(at_once=True)

    def end(self) -> None:
        """End the workers."""
        super().close(at_once=False)


def searched(
    study: Study, directory: Path, pool: Callable[[], Pool], resume: bool, progress: Progress
) -> Found:
    """Ask for designs and compute them until there are as many as the study wants.

    The designs follow from the study and from the numbers of those before alone, so that an
    interrupted search goes on where it was.
    """
    search = study.search
    own = study.place_of_case()
    count = search.first - (own is not None)
    places = first_designs(len(study.keys), count, search.seed)
    places = places if own is None else np.vstack([own, places])
    designs: list[Design] = []
    again = resume
    each = len(study.deviations)

    def of_all(done: int, _total: int, _state: str) -> None:
        progress(done, search.designs * each, "points of the search")

    while len(designs) < search.designs:
        new = places[len(designs) : search.designs]
        sweep = study.sweep([study.values(place) for place in places[: search.designs]])
        batch = run_batch(sweep, directory, pool, Choice(resume=again), progress=of_all)
        again = True
        wanted = range(len(designs) * each, (len(designs) + len(new)) * each)
        points = gathered(batch, wanted).points
        designs += designs_of(study, points, len(designs))
        told = _told(study, places[: len(designs)], designs)
        together = min(search.together, search.designs - len(designs))
        if together > 0:
            seed = search.seed + len(designs)
            places = np.vstack([places, next_designs(told, together, seed)])
    front = _front(study, designs)
    found = Found(study=study, designs=tuple(designs), front=front)

    def computed(sweep: Sweep) -> Sequence[BatchPoint]:
        batch = run_batch(sweep, directory, pool, Choice(resume=True), progress=progress)
        return gathered(batch).points

    return proved(found, computed)


def _told(study: Study, places: Array, designs: Sequence[Design]) -> Told:
    """Designs as arrays in which less is better."""

    def column(name: str, sign: float, bound: float = 0.0) -> list[float]:
        values = [design.numbers[name] for design in designs]
        return [np.nan if value is None else sign * (value - bound) for value in values]

    def noise(name: str) -> list[float]:
        return [design.errors.get(name, 0.0) / COVERAGE for design in designs]

    shape = (len(designs), -1)
    limits = study.limits
    return Told(
        places=places,
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

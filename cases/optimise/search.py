"""Designs computed by the batch until there are enough, the best ones proved by full solves."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ehl.arrays import Array
from postprocess.batch.results import BatchPoint
from postprocess.batch.summary import point_numbers

from ..batch.engine import Choice, run_batch
from ..batch.pools import LocalPool, Pool
from ..batch.results import gathered
from ..runs.films import Progress
from .ask import Told, first_designs, next_designs, pareto_front
from .study import Study

COVERAGE = 2.0  # standard deviations of an error bar, which is to hold the number in 95 of 100
MOST_PROVED = 3  # designs of a front: both ends of the first goal and the middle


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """A design and its numbers: goals and constraints as they are named, with error bars."""

    number: int
    values: dict[str, float]
    numbers: dict[str, float | None]
    errors: dict[str, float]
    feasible: bool
    message: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """What an optimisation found; `front`: numbers of the designs that no other betters."""

    study: Study
    designs: tuple[Design, ...]
    front: tuple[int, ...]
    proved: tuple[tuple[str, Design], ...]


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
    while len(designs) < search.designs:
        new = places[len(designs) : search.designs]
        sweep = study.sweep([study.values(place) for place in places[: search.designs]])
        batch = run_batch(sweep, directory, pool, Choice(resume=again), progress=progress)
        again = True
        each = len(study.deviations)
        wanted = range(len(designs) * each, (len(designs) + len(new)) * each)
        points = gathered(batch, wanted).points
        designs += _designs(study, points, len(designs))
        told = _told(study, places[: len(designs)], designs)
        together = min(search.together, search.designs - len(designs))
        if together > 0:
            seed = search.seed + len(designs)
            places = np.vstack([places, next_designs(told, together, seed)])
    front = _front(study, designs)
    proved = _proved(study, designs, front, directory, pool, progress)
    return Found(study=study, designs=tuple(designs), front=front, proved=proved)


def _designs(
    study: Study, points: Sequence[BatchPoint], start: int, *, bars: bool = False
) -> list[Design]:
    """Designs from the points of each, numbered from 1 on after `start`; `bars`: a limit counts as
    met within the error bar.
    """
    each = len(study.deviations)
    return [
        _design(study, points[k * each : (k + 1) * each], start + k + 1, bars=bars)
        for k in range(len(points) // each)
    ]


def _design(study: Study, points: Sequence[BatchPoint], number: int, *, bars: bool) -> Design:
    """The numbers of a design: of its one point, or quantiles on their bad sides."""
    sides = dict(study.goals) | {limit.name: limit.sign for limit in study.limits}
    rows = [point_numbers(point) if point.converged else {} for point in points]
    numbers: dict[str, float | None] = {}
    errors: dict[str, float] = {}
    for name, sign in sides.items():
        values = [row.get(name) for row in rows]
        head, _, unit = name.rpartition("_")
        spread = [row.get(f"{head}_uncertainty_{unit}") or 0.0 for row in rows]
        if any(value is None for value in values):
            numbers[name] = None
            continue
        signed = sign * np.array(values, dtype=float)
        share = study.quantile if len(values) > 1 else 1.0
        numbers[name] = sign * float(np.quantile(signed, share))
        errors[name] = float(np.mean(spread))
    met = all(
        numbers[limit.name] is not None
        and limit.sign * ((numbers[limit.name] or 0.0) - limit.bound)
        <= (errors[limit.name] if bars else 0.0)
        for limit in study.limits
    )
    known = all(numbers[name] is not None for name, _ in study.goals)
    return Design(
        number=number,
        values={key: points[0].values[key] for key in study.keys},
        numbers=numbers,
        errors=errors,
        feasible=met and known,
        message=next((point.message for point in points if point.message), ""),
    )


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


def _proved(
    study: Study,
    designs: Sequence[Design],
    front: tuple[int, ...],
    directory: Path,
    pool: Callable[[], Pool],
    progress: Progress,
) -> tuple[tuple[str, Design], ...]:
    """The case and the best designs with the values of [proof]; nothing without that."""
    if not study.proof or not front:
        return ()
    chosen = dict.fromkeys((front[0], front[len(front) // 2], front[-1]))
    own = study.place_of_case()
    named = [] if own is None else [("case", study.values(own))]
    for number in list(chosen)[:MOST_PROVED]:
        design = designs[number - 1]
        named.append((f"design {number}", [design.values[key] for key in study.keys]))
    sweep = study.sweep([values for _, values in named], study.proof)
    batch = run_batch(sweep, directory, pool, Choice(resume=True), progress=progress)
    points = gathered(batch).points
    found = _designs(study, points, 0, bars=True)
    return tuple((name, design) for (name, _), design in zip(named, found, strict=True))


def improvement(found: Found) -> dict[str, Any] | None:
    """How far the first goal of the best proved design is from that of the case, with the error
    bar of the difference; None where either is not known.
    """
    proved = dict(found.proved)
    case = proved.pop("case", None)
    name, sign = found.study.goals[0]
    known = [design for design in proved.values() if design.feasible]
    if case is None or case.numbers[name] is None or not known:
        return None
    best = min(known, key=lambda design: sign * (design.numbers[name] or 0.0))
    before = case.numbers[name] or 0.0
    after = best.numbers[name] or 0.0
    error = float(np.hypot(case.errors.get(name, 0.0), best.errors.get(name, 0.0)))
    return {
        "goal": name,
        "case": before,
        "best": after,
        "error": error,
        "proved": sign * (before - after) > error,
    }

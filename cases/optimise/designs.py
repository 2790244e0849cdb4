"""Designs and their numbers, from the points of the batch."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehl.units import notebook_html
from postprocess.batch.results import BatchPoint, point_error
from postprocess.batch.summary import point_numbers

from .study import Study


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
class OptimisationResult:
    """Result of an optimisation; `front`: numbers of the designs that no other betters."""

    study: Study
    designs: tuple[Design, ...]
    front: tuple[int, ...]
    confirmed: tuple[tuple[str, Design], ...] = ()
    # the same on half the nodes, where the proof names how many it takes
    coarse: tuple[tuple[str, Design], ...] = ()

    def _repr_html_(self) -> str:
        """The front, or the best design, and its proof, for a notebook."""
        shown = [(f"design {number}", self.designs[number - 1]) for number in self.front]
        shown += [(f"{name}, proved", design) for name, design in self.confirmed]
        columns: dict[str, list[str]] = {"": [name for name, _ in shown]}
        for key in self.study.keys:
            columns[key] = [f"{design.values[key]:.5g}" for _, design in shown]
        for name in shown[0][1].numbers if shown else ():
            columns[name] = [_text(design.numbers[name]) for _, design in shown]
        facts = {"designs": str(len(self.designs)), "front": str(len(self.front))}
        return notebook_html(self.study.title, facts, columns)


def _text(value: float | None) -> str:
    return "–" if value is None else f"{value:.5g}"


def designs_of(
    study: Study, points: Sequence[BatchPoint], start: int, *, bars: bool = False
) -> list[Design]:
    """Designs from their points.

    Parameters
    ----------
    study : Study
        The optimisation.
    points : Sequence[BatchPoint]
        Points of all designs, in their order.
    start : int
        Number of designs before these [-].
    bars : bool, default False
        True: a limit counts as met within the error bar.

    Returns
    -------
    list[Design]
        The designs.
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
        spread = [point_error(row, head, unit) or 0.0 for row in rows]
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

"""An optimisation: its file, and its designs with their numbers from the points of the batch."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import notebook_html
from oilfilm.postprocess.batch.results import BatchPoint, point_error, point_kind, result_names
from oilfilm.postprocess.batch.summary import point_numbers

from ..batch import plan
from ..batch.keys import value_in
from ..batch.points import Plan, Sweep
from ..batch.samples import RANGE, Distribution, distribution, unit_sample, with_law
from ..batch.sweep_file import OptimisationFile, SearchTable, SweepFile
from ..format.document import parse, read_text
from ..format.fields import is_number, validated
from ..format.rules import CaseProblem, KeyPath, faults_error, nearest_name, shown
from ..format.shaft_case import any_case_of_document
from ..format.shipped import find_case


@dataclass(frozen=True, slots=True)
class Limit:
    """A constraint: sign * number <= sign * bound."""

    name: str
    sign: float
    bound: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Study:
    """An optimisation ready to run."""

    text: str
    title: str
    case: str
    base: plan.Document  # with the fixed values
    keys: tuple[str, ...]
    ranges: tuple[tuple[float, float], ...]  # in the units of the keys
    whole: tuple[bool, ...]  # keys of whole numbers
    goals: tuple[tuple[str, float], ...]  # name, sign: 1 small, -1 large
    limits: tuple[Limit, ...]
    quantile: float
    scatter: tuple[str, ...]  # keys that scatter
    deviations: Array  # of them, shape (points of a design, keys that scatter)
    search: SearchTable
    proof: tuple[plan.Setting, ...]

    def values(self, position: Array) -> list[float]:
        """Values of the keys at a position of the unit cube.

        Parameters
        ----------
        position : Array
            The position, shape (keys,) [-].

        Returns
        -------
        list[float]
            Values in the units of the keys.
        """
        found = []
        for u, (low, high), whole in zip(position, self.ranges, self.whole, strict=True):
            value = low + float(u) * (high - low)
            found.append(float(round(value)) if whole else value)
        return found

    def position_of_case(self) -> Array | None:
        """Place of the case itself; None where it is outside the ranges."""
        given = [value_in(any_case_of_document(self.base).document, key) for key in self.keys]
        if not all(map(is_number, given)):
            return None
        low, high = np.array(self.ranges).T
        position = (np.array(given, dtype=float) - low) / (high - low)
        return position if (position >= 0.0).all() and (position <= 1.0).all() else None

    def sweep(self, designs: list[list[float]], extra: tuple[plan.Setting, ...] = ()) -> Sweep:
        """The points of designs: one each, or one for each row of `deviations`.

        Parameters
        ----------
        designs : list[list[float]]
            Values of the keys of each design.
        extra : tuple[Setting, ...], default ()
            Values by key, for all points.

        Returns
        -------
        Sweep
            The points.
        """
        base = plan.with_values(self.base, plan.Variation("fixed", extra))
        resolved = any_case_of_document(base).document
        keys = (*self.keys, *(key for key in self.scatter if key not in self.keys))
        rows = []
        for values in designs:
            for deviation in self.deviations:
                row = dict(zip(self.keys, values, strict=True))
                for key, own in zip(self.scatter, deviation, strict=True):
                    row[key] = row.get(key, value_in(resolved, key)) + float(own)
                rows.append(tuple(_plain(row[key], self._is_whole(key)) for key in keys))
        block = plan.Sampled("designs", [(key, ("vary", key)) for key in keys], rows)
        file = SweepFile(case=self.case)
        documents = plan.PointDocuments(base)
        return Sweep(
            text=self.text,
            title=self.title,
            case=self.case,
            compute="run",
            fields=False,
            keys=keys,
            points=Plan([block], documents.document, plan.PointName(file, base).name_of, keys),
        )

    def _is_whole(self, key: str) -> bool:
        return key in self.keys and self.whole[self.keys.index(key)]


def _plain(value: float, whole: bool) -> float:
    return int(value) if whole else value


def read_study(path: str | Path) -> Study:
    """Read an optimisation file.

    Parameters
    ----------
    path : str | Path
        The file.

    Returns
    -------
    Study
        The optimisation, ready to run.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    file_path = Path(path)
    name = str(path)
    text = read_text(file_path)
    file, wrong = validated(OptimisationFile, parse(text, name))
    if file is None:
        raise faults_error(wrong, name, text)
    case_file = find_case(file.case, file_path.parent)
    fixed = plan.Variation("fixed", tuple(plan.block_settings(file.fixed, ("fixed",))))
    base = plan.with_values(parse(read_text(case_file), str(case_file)), fixed)
    any_case_of_document(base)
    vary = plan.block_settings(file.vary, ("vary",))
    scatter, laws, faults = _scatter(file, base)
    faults += [
        CaseProblem(s.where, f"found {shown(s.value)}", RANGE) for s in vary if _is_no_range(s)
    ]
    faults += _name_faults(file, point_kind(base, "run"))
    if faults:
        raise faults_error(faults, name, text)
    return Study(
        text=text,
        title=file.title or str(base.get("title") or file.case),
        case=file.case,
        base=base,
        keys=tuple(setting.key for setting in vary),
        ranges=tuple((float(s.value[0]), float(s.value[1])) for s in vary),
        whole=tuple(all(isinstance(end, int) for end in s.value) for s in vary),
        goals=_goals(file),
        limits=_limits(file),
        quantile=file.goal.quantile,
        scatter=scatter,
        deviations=_deviations(file, laws),
        search=file.search,
        proof=tuple(plan.block_settings(file.proof, ("proof",))),
    )


def _is_no_range(setting: plan.Setting) -> bool:
    value = setting.value
    two = isinstance(value, list) and len(value) == 2 and all(map(is_number, value))
    return not two or not value[0] < value[1]


def _goals(file: OptimisationFile) -> tuple[tuple[str, float], ...]:
    small = [(name, 1.0) for name in file.goal.minimise]
    return tuple(small + [(name, -1.0) for name in file.goal.maximise])


def _limits(file: OptimisationFile) -> tuple[Limit, ...]:
    limits = []
    for name, table in file.constraints.items():
        limits += [] if table.least is None else [Limit(name, -1.0, table.least)]
        limits += [] if table.most is None else [Limit(name, 1.0, table.most)]
    return tuple(limits)


def _name_faults(file: OptimisationFile, kind: str) -> list[CaseProblem]:
    """Goals and constraints that are no numbers of a point, and what is missing."""
    known = result_names(kind)
    given: list[tuple[KeyPath, str]] = [(("constraints", name), name) for name in file.constraints]
    for side in ("minimise", "maximise"):
        given += [(("goal", side), name) for name in getattr(file.goal, side)]
    faults = [
        CaseProblem(
            where,
            f"found {shown(name)}",
            "allowed: main results, torque_N_mm, supply and self_heating of batch.csv",
            nearest=nearest_name(name, known),
        )
        for where, name in given
        if name not in known
    ]
    if not _goals(file):
        faults.append(CaseProblem(("goal",), "no goal", "needed: minimise or maximise"))
    if not file.vary:
        faults.append(
            CaseProblem(("vary",), "no keys", f"needed: keys with their ranges; {RANGE}")
        )
    return faults


def _scatter(
    file: OptimisationFile, base: plan.Document
) -> tuple[tuple[str, ...], list[Distribution], list[CaseProblem]]:
    """Keys that scatter, the laws of their deviations, and faults."""
    settings = [with_law(s) for s in plan.block_settings(file.scatter, ("scatter",))]
    laws = [distribution(setting) for setting in settings]
    faults = [law for law in laws if isinstance(law, CaseProblem)]
    resolved = any_case_of_document(base).document
    for setting in settings:
        value: Any = value_in(resolved, setting.key)
        if not is_number(value):
            finding = f"the case has {shown(value)}"
            faults.append(CaseProblem(setting.where, finding, "allowed: keys with a number"))
    keys = tuple(setting.key for setting in settings)
    return keys, [law for law in laws if isinstance(law, Distribution)], faults


def _deviations(file: OptimisationFile, laws: list[Distribution]) -> Array:
    """The same deviations for every design, shape (points of a design, keys that scatter)."""
    if not laws:
        return np.zeros((1, 0))
    draw = partial(unit_sample, "latin hypercube", seed=file.search.seed)
    probabilities = draw(keys=len(laws), samples=file.goal.scatter_samples)
    return np.column_stack([law.values(u) for law, u in zip(laws, probabilities.T, strict=True)])


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

"""Two results side by side: what differs in the input and in the numbers, and by how much."""

from collections.abc import Iterator
from math import hypot
from pathlib import Path
from typing import Any

from ehl.units import unit_of

from ..files import read_summary
from ..main_results import main_results
from ..text import is_number
from .results import Comparison, Difference

NOT_COMPARED = frozenset(
    "oilfilm case messages timing_s sweep file resumed key keys point".split()
)
OF_THE_SOLUTION = frozenset(  # how a result was computed
    "domain points iterations residual mass_imbalance message cycles fft_equivalents "
    "wall_s".split()
)
ROUND_OFF = 1e-9  # of the largest component of a vector: what lies below is no difference


def compare(first: str | Path, second: str | Path) -> Comparison:
    """Compare two result folders of the same kind; differences [-] relative to the larger value.

    Raises ValueError if one holds no readable results, or they are of different kinds.
    """
    documents = [read_summary(Path(folder)) for folder in (first, second)]
    kinds = [_kind(document) for document in documents]
    if kinds[0] != kinds[1]:
        raise ValueError(
            f"{first} holds results of a {kinds[0]}, {second} of a {kinds[1]}; allowed: two of "
            "one kind"
        )
    results = _differences(*map(_results, documents))
    return Comparison(
        names=(str(first), str(second)),
        versions=(str(documents[0]["oilfilm"]), str(documents[1]["oilfilm"])),
        converged=(bool(documents[0]["converged"]), bool(documents[1]["converged"])),
        inputs=tuple(d for d in _differences(*map(_input, documents)) if d.differs),
        main=tuple(_differences(*map(_main, documents))),
        results=tuple(d for d in results if d.differs and not _of_the_solution(d.path)),
    )


def _of_the_solution(path: str) -> bool:
    """Whether a value describes how the result was computed, not what it is."""
    name = path.rpartition(".")[2].partition("[")[0]
    return "_uncertainty_" in name or name in OF_THE_SOLUTION


def _kind(summary: dict[str, Any]) -> str:
    if summary.get("kind"):
        return str(summary["kind"])
    if "contacts" in summary:
        return "bearing"
    return "slip map" if "critical_curves" in summary else "contact"


def _input(summary: dict[str, Any]) -> Any:
    """The case as run; of a batch the name of its case and its sweep file."""
    if summary.get("kind") == "batch":
        return {"case": summary["case"], "sweep": summary.get("sweep")}
    return summary["case"]


def _main(summary: dict[str, Any]) -> dict[str, Any]:
    return {} if summary.get("kind") == "batch" else main_results(summary)


def _results(summary: dict[str, Any]) -> dict[str, Any]:
    """What is compared, balls, contacts and points by their names."""
    values = {key: value for key, value in summary.items() if key not in NOT_COMPARED}
    if "contacts" in values:
        values["contacts"] = {f"ball {c['ball']} {c['race']}": c for c in values["contacts"]}
    if isinstance(values.get("balls"), list):
        values["balls"] = {f"ball {ball['ball']}": ball for ball in values["balls"]}
    if values.get("kind") == "batch":
        values = {"points": {_point_name(point["keys"]): point for point in values["points"]}}
    return values


def _point_name(keys: dict[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" for key, value in keys.items()) or "case"


def flat(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every single value of a document by its dotted path."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in NOT_COMPARED or not path:
                yield from flat(item, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from flat(item, f"{path}[{index}]")
    else:
        yield path, value


def _differences(one: Any, two: Any) -> Iterator[Difference]:
    """Every value that stands in one of two documents or in both."""
    first, second = dict(flat(one)), dict(flat(two))
    scales = _scales(first), _scales(second)
    for path in dict.fromkeys((*first, *second)):
        a, b = first.get(path), second.get(path)
        noise = ROUND_OFF * max(scale.get(_group(path), 0.0) for scale in scales)
        if is_number(a) and is_number(b) and max(abs(a), abs(b)) <= noise:
            continue
        covered = _covered(path, a, b, first, second)
        yield Difference(path=path, first=a, second=b, relative=relative(a, b), covered=covered)


def _scales(values: dict[str, Any]) -> dict[str, float]:
    """Largest magnitude among the numbers of one unit that belong together."""
    scales: dict[str, float] = {}
    for path, value in values.items():
        if is_number(value):
            group = _group(path)
            scales[group] = max(scales.get(group, 0.0), abs(value))
    return scales


def _group(path: str) -> str:
    """What a number is a part of: its vector, or the block that has the unit, as of a torque."""
    name, bracket, _ = path.partition("[")
    block, _, last = name.rpartition(".")
    return name if bracket or unit_of(last) or not unit_of(name) else block


def relative(a: Any, b: Any) -> float | None:
    """Difference over the larger magnitude [-]; None where they are not two numbers."""
    if a == b:
        return 0.0
    if not (is_number(a) and is_number(b)):
        return None
    return abs(a - b) / max(abs(a), abs(b))


def _covered(
    path: str, a: Any, b: Any, first: dict[str, Any], second: dict[str, Any]
) -> bool | None:
    """Whether both error bars together enclose the difference of two films."""
    head, _, unit = path.rpartition("_")
    error = f"{head}_uncertainty_{unit}"
    bars = [bar for bar in (first.get(error), second.get(error)) if bar is not None]
    if "uncertainty" in path or relative(a, b) is None or len(bars) < 2:
        return None
    return abs(a - b) <= hypot(*bars)

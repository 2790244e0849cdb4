"""Two results side by side: differences of input and numbers, and their tables."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import hypot, inf
from pathlib import Path
from typing import Any

from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from oilfilm.ehl.units import unit_of

from .batch.results import main_results
from .files import read_summary
from .quantities import is_number, number

NOT_COMPARED = frozenset(
    "oilfilm case messages timing_s sweep file resumed key keys point".split()
)
SOLUTION_KEYS = frozenset(  # how a result was computed
    "domain points iterations residual mass_imbalance message cycles fft_equivalents "
    "flooded_fft_equivalents wall_s imbalance relative_error energy_error "
    "energy_balance_error".split()
)
REPEATED_BLOCK = "power_balance"  # block of a bearing that stands under its torque, too
# share of the magnitude of a quantity [-]: a smaller difference is round-off of the solvers
ROUND_OFF = 1e-9
ZERO_ROUND_OFF = 1e-12  # of any unit of a summary: less is round-off of zero
# share of the magnitude of a quantity [-]: a component that is smaller is compared to this
MIN_MAGNITUDE = 0.01
ASSUMED = "assumed"  # list of keys of the input, in any order
MOST_ROWS = 25  # of the differences of all results, the largest first


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One value in both results."""

    path: str
    first: Any
    second: Any
    relative: float | None  # second less first over the first [-]
    over_bars: float | None = None  # second less first over both error bars [-]; None without

    @property
    def covered(self) -> bool | None:
        """True if the error bars of both enclose the difference; None without them."""
        return None if self.over_bars is None else abs(self.over_bars) <= 1.0

    @property
    def differs(self) -> bool:
        """True if the two are not the same."""
        return self.first != self.second

    def document(self) -> dict[str, Any]:
        """The difference as plain JSON types."""
        values = {"path": self.path, "first": self.first, "second": self.second}
        values |= {"relative": self.relative, "within_error_bars": self.covered}
        return values | {"over_error_bars": self.over_bars}


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Differences of two result folders; `main` are the main results, equal ones included.

    Nodes, boxes, iterations and error bars are not compared; whether a result converged is.
    """

    names: tuple[str, str]
    versions: tuple[str, str]
    converged: tuple[bool, bool]
    inputs: tuple[Difference, ...]
    main: tuple[Difference, ...]
    results: tuple[Difference, ...]

    @property
    def largest(self) -> float:
        """Largest relative difference of a result [-]; infinite if one of them has it alone."""
        sizes = (inf if d.relative is None else abs(d.relative) for d in self.results)
        return max(sizes, default=0.0)

    def document(self) -> dict[str, Any]:
        """The comparison as plain JSON types."""
        return {
            "names": list(self.names),
            "oilfilm": list(self.versions),
            "converged": list(self.converged),
            "largest_relative_difference": None if self.largest == inf else self.largest,
            "inputs": [difference.document() for difference in self.inputs],
            "main": [difference.document() for difference in self.main],
            "results": [difference.document() for difference in self.results],
        }


def compare(first: str | Path, second: str | Path) -> Comparison:
    """Compare two result folders: signed differences, second less first.

    Parameters
    ----------
    first : str | Path
        Folder of results.
    second : str | Path
        Folder of results of the same kind.

    Returns
    -------
    Comparison
        Differences of inputs, main results and all results.

    Raises
    ------
    ValueError
        If one holds no readable results, or they are of different kinds.
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
        results=tuple(d for d in results if d.differs and not _describes_solution(d.path)),
    )


def _describes_solution(path: str) -> bool:
    """True of a value that describes how the result was computed."""
    name = path.rpartition(".")[2].partition("[")[0]
    return "_uncertainty" in name or name in SOLUTION_KEYS


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
    """Values that are compared; balls, contacts and points by their names."""
    values = {
        key: value for key, value in summary.items() if key not in (*NOT_COMPARED, REPEATED_BLOCK)
    }
    if "contacts" in values:
        values["contacts"] = {f"ball {c['ball']} {c['race']}": c for c in values["contacts"]}
    if isinstance(values.get("balls"), list):
        values["balls"] = {f"ball {ball['ball']}": ball for ball in values["balls"]}
    if values.get("kind") == "batch":
        values = {
            "points": {_point_name(point["keys"]): point for point in values["points"] or ()}
        }
    return values


def _point_name(keys: dict[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" for key, value in keys.items()) or "case"


def flat(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every single value of a document by its dotted path.

    Parameters
    ----------
    value : Any
        Part of a document.
    path : str, default ''
        Dotted path of that part.

    Yields
    ------
    Iterator[tuple[str, Any]]
        Path and value.
    """
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in NOT_COMPARED or not path:
                yield from flat(item, f"{path}.{key}" if path else str(key))
    elif path == ASSUMED and isinstance(value, list):  # names, in any order
        yield from ((f"{path}[{name}]", "listed") for name in value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from flat(item, f"{path}[{index}]")
    else:
        yield path, value


def _differences(one: Any, two: Any) -> Iterator[Difference]:
    """Every value that stands in one of two documents or in both, but for round-off."""
    first, second = dict(flat(one)), dict(flat(two))
    scales = _scales(first, second)
    for path in dict.fromkeys((*first, *second)):
        a, b = first.get(path), second.get(path)
        scale = scales.get(_group(path), 0.0)
        if is_number(a) and is_number(b) and a != b and _is_round_off(path, a, b, scale):
            continue
        yield Difference(
            path=path,
            first=a,
            second=b,
            relative=relative(a, b, scale),
            over_bars=_over_bars(path, a, b, first, second),
        )


def _is_round_off(path: str, a: float, b: float, scale: float) -> bool:
    """True if two numbers differ by less than the round-off of a quantity of this magnitude."""
    noise = ROUND_OFF * scale
    if unit_of(path.partition("[")[0]):
        noise = max(noise, ZERO_ROUND_OFF)
    return abs(b - a) <= noise


def _scales(*documents: dict[str, Any]) -> dict[tuple[str, str], float]:
    """Largest magnitude of each quantity, in all contacts, balls or points that have it."""
    scales: dict[tuple[str, str], float] = {}
    for path, value in (item for values in documents for item in values.items()):
        if is_number(value):
            group = _group(path)
            scales[group] = max(scales.get(group, 0.0), abs(value))
    return scales


def _group(path: str) -> tuple[str, str]:
    """The quantity that a number belongs to: a key anywhere in the same part of a summary, its
    vector, or the block that has the unit, as of a torque.
    """
    name, bracket, _ = path.partition("[")
    block, _, last = name.rpartition(".")
    part = name.partition(".")[0]
    return (part, last) if bracket or unit_of(last) or not unit_of(name) else (part, block)


def relative(a: Any, b: Any, scale: float = 0.0) -> float | None:
    """Second less first over the first; None where they are not two numbers.

    Parameters
    ----------
    a : Any
        Value of the first result.
    b : Any
        Value of the second result.
    scale : float, default 0.0
        Largest magnitude of the quantity, in its unit; a first value below a hundredth of it
        counts as that hundredth.

    Returns
    -------
    float | None
        Relative difference [-].
    """
    if a == b:
        return 0.0
    if not (is_number(a) and is_number(b)):
        return None
    return (b - a) / (max(abs(a), MIN_MAGNITUDE * scale) or abs(b))


def _over_bars(
    path: str, a: Any, b: Any, first: dict[str, Any], second: dict[str, Any]
) -> float | None:
    """Second less first over both error bars together [-]; None without these."""
    if not (is_number(a) and is_number(b)) or "uncertainty" in path:
        return None
    for error in _error_names(path):
        bars = [bar for bar in (first.get(error), second.get(error)) if is_number(bar)]
        if len(bars) == 2:
            together = hypot(*map(float, bars))
            return (b - a) / together if together > 0.0 else None
    return None


def _error_names(path: str) -> Iterator[str]:
    """Names that the error bar of a quantity may have: before its unit, or after its name."""
    block, dot, last = path.rpartition(".")
    words = last.split("_")
    for k in range(1, len(words) + 1):
        yield block + dot + "_".join([*words[:k], "uncertainty", *words[k:]])


def comparison_table(comparison: Comparison) -> Group:
    """Differences of input, main results and parts of the torque, and the largest of all results,
    second less first, in per cent of the first.

    Parameters
    ----------
    comparison : Comparison
        Differences of two result folders.

    Returns
    -------
    Group
        The tables.
    """
    ordered = sorted(comparison.results, key=lambda d: -abs(d.relative or 0.0))  # one-sided last
    torque = [d for d in ordered if d.path.startswith("torque_N_mm.parts.")]
    shown = ordered[:MOST_ROWS]
    parts: list[Any] = [
        Text(f"{which}: {name} (oilfilm {version})")
        for which, name, version in zip(
            ("first", "second"), comparison.names, comparison.versions, strict=True
        )
    ]
    inputs = comparison.inputs
    main = comparison.main
    parts.append(_table("input", inputs) if inputs else Text("the inputs are equal"))
    if any(d.first is not None for d in main):
        parts.append(_table("main results", main))
    if torque:
        parts.append(_table("friction torque by its parts", torque))
    title = "all results, largest differences first"
    parts.append(_table(title, shown) if shown else Text("the results are equal"))
    if len(ordered) > len(shown):
        parts.append(Text(f"... and {len(ordered) - len(shown)} more differences; --json has all"))
    if any(d.covered for d in (*main, *shown)):
        parts.append(Text("±: the difference is within the error bars of the two"))
    return Group(*parts)


def _table(title: str, differences: Iterable[Difference]) -> Table:
    table = Table(
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        padding=(0, 1, 0, 0),
        title=title,
        title_justify="left",
    )
    table.add_column("", overflow="fold", max_width=38)
    for name in ("first", "second", "%"):
        table.add_column(name, justify="right", overflow="fold", max_width=16)
    for d in differences:
        if d.first is None and d.second is None:
            continue
        from_zero = d.first == 0.0 and d.differs
        share = None if d.relative is None or from_zero else 100.0 * d.relative
        percent = number(share, "+.3g" if share and abs(share) < 999.5 else "+.0f")
        percent = "0" if share == 0.0 else percent
        percent += " ±" if d.relative is not None and d.covered and d.differs else ""
        cells = (d.path, _text(d.first), _text(d.second), percent)
        table.add_row(*(Text(cell) for cell in cells))
    return table


def _text(value: Any) -> str:
    text = number(value, ".6g")
    return text if len(text) <= 60 else text[:57] + "..."

"""The case and the best designs once more as [proof] says, with solved films: what is gained, and
how far it is known.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import hypot
from typing import Any

from postprocess.batch.results import BatchPoint

from ..batch.planning.blocks import Setting
from ..batch.points import Sweep
from .designs import Design, OptimisationResult, designs_of

MOST_CONFIRMED = 3  # designs of a front: both ends of the first goal and the middle
CASE = "case"  # the first of what is proved
NODES = "ehl.points"  # key whose half gives the error of numbers without an error bar
FEWEST = 33  # nodes that a film may have
# a number of the search that is so far from its proof misleads the search, and is told [-]
VISIBLE = 0.01

Compute = Callable[[Sweep], Sequence[BatchPoint]]


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

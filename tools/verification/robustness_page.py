"""Table and map of the sweep over random contacts."""

import re
from collections import Counter
from collections.abc import Sequence
from functools import partial

import numpy as np
from scipy.stats import binomtest

from .page import Check, Picture, Section, Table, columns, percent, text
from .plots import MapPoint, draw_robustness
from .robustness import DAMPED, RESOLVABLE, Finished

WRONG = 0.05  # relative error of a film beyond its bar that counts as silently wrong
COVERED = 0.95  # least share of the films within their bars
LONGEST = 15.0  # time of a solve [s]
OUTCOMES = ("converged and resolved", "converged, unresolved", "failed")


def robustness_section(finished: Sequence[Finished], seed: int) -> Section:
    """The sweep as a section of a page."""
    resolvable = [f for f in finished if f.resolvable]
    share = sum(f.converged for f in resolvable) / max(len(resolvable), 1)
    of_share = interval([f.converged for f in resolvable])
    silent = [f for f in finished if f.outcome != OUTCOMES[0] and f.message == "converged"]
    errors = [pair for f in finished for pair in f.errors]
    wrong = [error for error, bar in errors if error > max(bar, WRONG)]
    covered = sum(error <= bar for error, bar in errors) / max(len(errors), 1)
    of_covered = interval([error <= bar for error, bar in errors])
    approach = [pair for f in finished for pair in f.approach_errors]
    held = sum(error <= bar for error, bar in approach) / max(len(approach), 1)
    tables = [_outcomes(finished), _bars(finished), _measures(finished), _kinds(finished)]
    if any(f.outcome != OUTCOMES[0] for f in finished):
        tables.append(_unsolved(finished))
    seconds = [f.seconds for f in finished]
    caption = "What each draw needed, over M and L, by R_x/R_y"
    return Section(
        title=f"{len(finished)} contacts, seed {seed}",
        text=text("robustness").format(fineness=RESOLVABLE),
        checks=(
            Check(f"converged, of {len(resolvable)} resolvable ({of_share})", share, least=0.995),
            Check("neither converged nor resolved without saying so", len(silent), most=0.0),
            Check(f"largest time of a solve, s (median {np.median(seconds):.2f})", max(seconds), most=LONGEST),
            Check(f"of {len(errors)} films within their error bars ({of_covered})", covered, least=COVERED),
            *([Check(f"of {len(approach)} H₀ within their error bars", held, least=COVERED)] if approach else []),
            Check(f"films wrong by {WRONG:.0%} and more than their bar", len(wrong), most=0.0),
        ),
        tables=tuple(tables),
        pictures=(Picture("robustness", caption, partial(draw_robustness, points=[_map_point(f) for f in finished])),),
    )


def interval(holds: Sequence[bool]) -> str:
    """Wilson's interval of 95 % of the share that holds, in words."""
    if not holds:
        return "none"
    low, high = binomtest(sum(holds), len(holds)).proportion_ci(method="wilson")
    return f"95 % interval {low:.4f} to {high:.4f}"


def _outcomes(finished: Sequence[Finished]) -> Table:
    points = sorted({f.points for f in finished})
    rows = []
    for outcome in OUTCOMES:
        for name, resolvable in (("resolvable", True), ("too thin to resolve, or outside the model", False)):
            group = [f for f in finished if f.outcome == outcome and f.resolvable == resolvable]
            cells = [str(sum(f.points == n for f in group)) for n in points]
            if group or resolvable:
                rows.append((f"{outcome}, {name}", *cells, str(len(group))))
    head = ("outcome", *(f"at {n} points" for n in points), "in all")
    return Table("Outcomes:", head, tuple(rows))


def _bars(finished: Sequence[Finished]) -> Table:
    """How the films with twice the points lie in the error bars, by film and kind."""
    rows = []
    for kind in ("straight", "at an angle", "rotating"):
        for place, film in enumerate(("central", "minimum")):
            pairs = [f.errors[place] for f in finished if f.kind == kind and f.errors]
            if not pairs:
                continue
            errors, bars = np.array(pairs).T
            within = f"{np.sum(errors <= bars)} of {len(errors)}"
            numbers = (np.median(errors), np.median(bars), np.quantile(bars, 0.9))
            largest = f"{np.max(errors / bars):.2f}"
            rows.append((f"{kind}, {film}", within, *(percent(x, 2) for x in numbers), largest))
    if approach := [pair for f in finished for pair in f.approach_errors]:
        errors, bars = np.array(approach).T
        within = f"{np.sum(errors <= bars)} of {len(errors)}"
        numbers = (np.median(errors), np.median(bars), np.quantile(bars, 0.9))
        row = (f"{x:.4f} a²/R_x" for x in numbers)
        rows.append(("all, H₀", within, *row, f"{np.max(errors / bars):.2f}"))
    head = columns(
        "entrainment, film | within the bar | error, median | bar, median | bar, 9 of 10 below | largest error over bar"
    )
    return Table("Error bars, judged by a solve with twice the points:", head, tuple(rows))


def _measures(finished: Sequence[Finished]) -> Table:
    taken = Counter(f.strongest for f in finished)
    solved = Counter(f.strongest for f in finished if f.converged and f.resolved)
    rows = [(name, str(count), str(solved[name])) for name, count in taken.most_common()]
    head = columns("strongest measure taken | draws | of these converged and resolved")
    return Table("Measures:", head, tuple(rows))


def _kinds(finished: Sequence[Finished]) -> Table:
    rows = []
    for kind in ("straight", "at an angle", "rotating"):
        group = [f for f in finished if f.kind == kind]
        good = [f for f in group if f.resolvable]
        plain = sum(f.strongest == "none" for f in group)
        seconds = sum(f.seconds for f in group) / max(len(group), 1)
        counts = (len(group), len(good), sum(f.converged for f in good), plain)
        rows.append((kind, *map(str, counts), f"{seconds:.1f}"))
    head = columns("entrainment | draws | resolvable | of these converged | without any measure | mean time, s")
    caption = "By the entrainment, with the time of a solve:"
    return Table(caption, head, tuple(rows))


def _unsolved(finished: Sequence[Finished]) -> Table:
    """Failures by message, their numbers left out; the file of the draws has each."""
    kinds: dict[str, list[Finished]] = {}
    for f in finished:
        if f.outcome != OUTCOMES[0]:
            kinds.setdefault(re.sub(r"-?\d[\d.]*(e[-+]\d+)?", "…", f.message), []).append(f)
    rows = []
    for message, group in sorted(kinds.items(), key=lambda item: -len(item[1])):
        loads = [f.moes_load for f in group]
        numbers = ", ".join(str(f.number) for f in group)
        rows.append((message, str(len(group)), f"{min(loads):.0f} to {max(loads):.0f}", numbers))
    head = columns("message | contacts | M | numbers of the draws")
    return Table("Contacts that are not converged and resolved, by message:", head, tuple(rows))


def _map_point(f: Finished) -> MapPoint:
    needed = f.strongest if f.converged and f.resolved else f.outcome
    names = {"none": "no measure"} | {name: name for name in (DAMPED, *OUTCOMES)}
    group = names.get(needed, "another attempt")
    return MapPoint(f.moes_load, f.moes_lubricant, f.radius_ratio, f.kind, group)

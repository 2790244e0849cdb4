"""Table and map of the sweep over random contacts."""

from collections import Counter
from collections.abc import Sequence
from functools import partial

from .page import Check, Picture, Section, Table, columns, text
from .plots import MapPoint, draw_robustness
from .robustness import DAMPED, POINTS, RESOLVABLE, Finished, strongest

OUTCOMES = ("converged and resolved", "converged, unresolved", "failed")


def robustness_section(
    finished: Sequence[Finished], seed: int, points: tuple[int, ...] = POINTS
) -> Section:
    """The sweep as a section of a page."""
    resolvable = [f for f in finished if f.resolvable]
    share = sum(f.converged for f in resolvable) / max(len(resolvable), 1)
    silent = [f for f in finished if f.outcome != OUTCOMES[0] and f.message == "converged"]
    first = points[0]
    more = " and ".join(str(n) for n in points[1:]) or "no more"
    tables = [_outcomes(finished, points), _measures(finished), _kinds(finished)]
    if any(f.outcome != OUTCOMES[0] for f in finished):
        tables.append(_unsolved(finished))
    caption = "What each draw needed, over M and L, by R_x/R_y"
    return Section(
        title=f"{len(finished)} contacts, seed {seed}",
        text=text("robustness").format(first=first, more=more, fineness=RESOLVABLE),
        checks=(
            Check(f"converged, of {len(resolvable)} resolvable", share, least=0.99),
            Check("neither converged nor resolved without saying so", len(silent), most=0.0),
        ),
        tables=tuple(tables),
        pictures=(
            Picture(
                "robustness",
                caption,
                partial(draw_robustness, points=[_map_point(f) for f in finished]),
            ),
        ),
    )


def _outcomes(finished: Sequence[Finished], points: tuple[int, ...]) -> Table:
    rows = []
    for outcome in OUTCOMES:
        counts = [sum(f.outcome == outcome and f.points == n for f in finished) for n in points]
        if outcome == OUTCOMES[0]:
            rows.append((outcome, *(str(count) for count in counts), str(sum(counts))))
            continue
        for name, resolvable in (("resolvable", True), ("too thin to resolve", False)):
            group = [f for f in finished if f.outcome == outcome and f.resolvable == resolvable]
            cells = [str(sum(f.points == n for f in group)) for n in points]
            rows.append((f"{outcome}, {name}", *cells, str(len(group))))
    head = ("outcome", *(f"at {n} points" for n in points), "in all")
    return Table("Outcomes:", head, tuple(rows))


def _measures(finished: Sequence[Finished]) -> Table:
    last = Counter(f.strongest for f in finished)
    first = Counter(strongest(f.first_measures) for f in finished)
    solved = Counter(f.strongest for f in finished if f.converged and f.resolved)
    rows = [
        (name, str(first.get(name, 0)), str(count), str(solved.get(name, 0)))
        for name, count in (last | Counter(dict.fromkeys(first, 0))).most_common()
    ]
    head = columns(
        "strongest measure taken | in the first solve | in the last solve"
        " | of these converged and resolved"
    )
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
    head = columns(
        "entrainment | draws | resolvable | of these converged | without any measure"
        " | mean time, s"
    )
    caption = "By the entrainment; time of all solves of a draw, on a machine that was shared:"
    return Table(caption, head, tuple(rows))


def _unsolved(finished: Sequence[Finished]) -> Table:
    rows = [
        (str(f.number), f.text, f"{f.hertz_pressure / 1e9:.2f}", _fineness(f.fineness), f.message)
        for f in finished
        if f.outcome != OUTCOMES[0]
    ]
    head = columns("number | contact | p_h, GPa | H_min/(S h_x²) | message")
    return Table("All that did not end converged and resolved:", head, tuple(rows))


def _fineness(value: float | None) -> str:
    return "no film" if value is None else f"{value:.2g}"


def _map_point(f: Finished) -> MapPoint:
    needed = f.strongest if f.converged and f.resolved else f.outcome
    names = {"none": "no measure"} | {name: name for name in (DAMPED, *OUTCOMES)}
    group = names.get(needed, "another attempt")
    return MapPoint(f.moes_load, f.moes_lubricant, f.radius_ratio, f.kind, group)

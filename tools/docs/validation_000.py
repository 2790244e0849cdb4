"""Write docs/validation/validation_000.md: sliding in the 7008 beside Ma et al. (2023).

Run it with `python tools/docs/validation_000.py`; it simulates for two to three
minutes of one core. Pictures are drawn by `validation_000_pictures.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from dynamics_runs import RPM, Run, changed, run
from printed import printed
from validation_000_pictures import draw_axial, draw_azimuth, draw_skid

from oilfilm.bearing.operation import BallKinematics, QuasistaticModel
from oilfilm.bearing.studies.slip import SlipStudy, minimum_axial_load_skf, minimum_preload
from oilfilm.cases import Case, load_case

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_000.md"
TEMPLATE = PAGE.with_suffix(".md.in")
AXIAL = (20.0, 40.0, 50.0, 60.0, 70.0, 80.0, 100.0, 200.0)
RADIAL = (50.0, 100.0, 150.0, 200.0, 300.0)
MIXED = (0.0, 100.0, 200.0, 300.0)
SPEEDS = (3000.0, 4000.0, 5000.0, 7000.0)  # [r/min], within the table
TIME = {"end_time_s": 0.12, "output_interval_us": 200.0, "integration": "implicit"}
Runs = dict[float, Run]
FEW = 3  # balls that stand for all under an axial load
SKIDS = 0.9  # of the kinematic speed: below, balls count as skidding
CASE = "7008_oil"  # friction of its solved films; balls in oil, pockets with 0.2 mm of play
LIGHTEST, HEAVIEST = 1.0, 420.0  # loads that the ends of gross skid are looked for between [N]
FASTEST = float(printed("ma_2023_section_4_1")[0]["inner_sliding_speed_m_s"])
SKID_BELOW, NO_SKID_FROM = (float(value) for value in printed("ma_2023_section_4_2")[0].values())  # [N]
CATALOGUE = 5.0  # A of the catalogue's minimum axial load, assumed [N]


@dataclass(frozen=True)
class Variant:
    """Inputs that the paper does not give: those of the shipped cases with its law, or on solved films."""

    on_films: bool = True
    cage: dict[str, float] = field(default_factory=dict)  # keys of [cage]
    dynamics: dict[str, float] = field(default_factory=dict)  # keys of [dynamics]

    def case(self, shipped: str, load: tuple[float, float]) -> Case:
        """A case under an axial and a radial load [N]."""
        case = changed(load_case(CASE if self.on_films else shipped), load, **(TIME | self.dynamics))
        assert case.file.cage is not None
        return replace(case, file=case.file.model_copy(update={"cage": case.file.cage.model_copy(update=self.cage)}))


VARIANTS = {
    "0.60 N a ball": Variant(dynamics={"drag_coefficient": 0.94}),
    "play of 0.1 mm": Variant(cage={"pocket_clearance_mm": 0.1}),
    "play of 0.4 mm": Variant(cage={"pocket_clearance_mm": 0.4}),
    "the paper's law of traction, 1.4 N": Variant(on_films=False),
}


@dataclass(frozen=True)
class Onset:
    """End of gross skid at a speed [r/min]: loads [N]."""

    speed: float
    load: float
    hirano: float


def cage(result: Run) -> float:
    """Mean speed of the cage over the kinematic one [-]."""
    return result.statistics.cage_speed / result.statistics.kinematic_speed


def spread(result: Run) -> float:
    """Half width of the interval of `cage` [-]."""
    return (result.statistics.cage_interval or 0.0) / result.statistics.kinematic_speed


def mean(values: Any, mask: Any) -> float:
    """Mean of the values a mask picks [unit of the values]; NaN of none."""
    return float(values[mask].mean()) if mask.any() else float("nan")


def number(value: float, digits: int = 3) -> str:
    """Text of a number; a dash where there is none."""
    return f"{value:.{digits}f}" if np.isfinite(value) else "–"


def series(of: Variant) -> tuple[Runs, Runs, Runs]:
    """The three series of loads."""
    axial = {load: run(of.case("7008_axial", (load, 0.0))) for load in AXIAL}
    radial = {load: run(of.case("7008_radial", (0.0, load))) for load in RADIAL}
    mixed = {load: run(of.case("7008_combined", (100.0, load))) for load in MIXED}
    return axial, radial, mixed


def statements(axial: Runs, radial: Runs, mixed: Runs) -> list[Statement]:
    """Statements of the paper's section 4."""
    return of_radial(radial) + of_axial(axial) + of_mixed(mixed)


def tried() -> dict[str, list[Statement]]:
    """Statements with other inputs that the paper does not give."""
    return {name: statements(*series(variant)) for name, variant in VARIANTS.items()}


def averages(result: Run) -> tuple[Any, Any]:
    """Mean sliding speed [m/s] and traction factor [-] of both races where loaded."""
    return np.nanmean(result.slides, axis=(0, 2)), np.nanmean(result.factors, axis=(0, 2))


def axial_rows(runs: Runs) -> str:
    """Table of the axial loads."""
    lines = []
    for load, result in runs.items():
        s, f = averages(result)
        inner = result.record.races[:, 0, :, 0].mean()
        numbers = f"{s[0]:.3f} | {s[1]:.3f} | {f[0]:.4f} | {f[1]:.4f}"
        lines.append(f"| {load:.0f} | {inner:.2f} | {cage(result):.4f} ± {spread(result):.0e} | {numbers} |")
    return "\n".join(lines)


def zones(result: Run) -> tuple[float, float, float, float]:
    """Sliding: inner loaded, inner at a gap, outer where inner is loaded, elsewhere [m/s]."""
    slides, inside = result.surface_slides, result.record.races[:, 0, :, 0] > 0.0
    touching = result.record.races[:, 1, :, 0] > 0.0
    inner, outer = slides[:, 0], slides[:, 1]
    return mean(inner, inside), mean(inner, ~inside), mean(outer, inside & touching), mean(outer, ~inside & touching)


def radial_rows(runs: Runs) -> str:
    """Table of the radial loads."""
    lines = []
    for load, result in runs.items():
        words = " | ".join(number(part) for part in zones(result))
        largest = result.statistics.largest_load[0].max()
        speed = f"{cage(result):.4f} ± {spread(result):.0e}"
        lines.append(f"| {load:.0f} | {speed} | {words} | {largest:.1f} |")
    return "\n".join(lines)


def mixed_rows(runs: Runs) -> str:
    """Table of the combined loads."""
    lines = []
    for load, result in runs.items():
        s, free = result.slides[:, 0], result.statistics.shares[:, :, 0].mean(axis=1)
        ends = f"{np.nanpercentile(s, 2):.3f} | {np.nanpercentile(s, 98):.3f} | {np.nanstd(s):.4f}"
        numbers = f"{ends} | {free[0]:.3f} | {free[1]:.3f}"
        lines.append(f"| {load:.0f} | {cage(result):.4f} ± {spread(result):.0e} | {numbers} |")
    return "\n".join(lines)


def few(load: float, speed: float, start: str = "quasi-static") -> Run:
    """Some balls under their share of an axial load [N] at a speed [r/min], 17 turns of the ring or more."""
    case = load_case(CASE)
    three = replace(case, bearing=replace(case.bearing, balls=FEW))
    end = (1500.0 if start == "rest" else 1000.0) / speed
    keys = {"end_time_s": end, "output_interval_us": end / 200.0 * 1e6, "start": start, "integration": "implicit"}
    return run(changed(three, (load * FEW / 18.0, 0.0), speed, **keys))


def rolls(result: Run) -> bool:
    """Whether the balls keep up."""
    return bool(result.statistics.orbit_speed > SKIDS * result.statistics.kinematic_speed)


def onset(speed: float) -> Onset:
    """End of gross skid under axial load at a speed [r/min], by bisection to 2 %."""
    case = load_case(CASE)
    load = between(LIGHTEST, HEAVIEST, 1.02, lambda middle: rolls(few(middle, speed)))
    study = SlipStudy(
        bearing=case.bearing,
        operation=case.operation,
        model=QuasistaticModel(ball_kinematics=BallKinematics.OUTER_RACE_CONTROL),
        limit=10.0,
    )
    return Onset(speed=speed, load=load, hirano=minimum_preload(study, speed * RPM))


def between(low: float, high: float, ratio: float, holds: Callable[[float], bool]) -> float:
    """Load [N] from which a state holds, by bisection to a ratio."""
    while high > ratio * low:
        middle = (low * high) ** 0.5
        low, high = (low, middle) if holds(middle) else (middle, high)
    return float((low * high) ** 0.5)


def critical(axial: bool, start: str) -> float:
    """Load [N] at which the bearing leaves gross skid at 5000 r/min, by bisection to 5 %."""
    case, time = load_case(CASE), TIME | {"end_time_s": 0.3 if start == "rest" else 0.12, "start": start}

    def holds(load: float) -> bool:
        return rolls(few(load, 5000.0, start) if axial else run(changed(case, (0.0, load), **time)))

    return between(LIGHTEST, HEAVIEST, 1.05, holds)


def without_pocket_friction() -> Run:
    """200 N radial load."""
    return run(Variant(cage={"pocket_friction": 0.0}).case(CASE, (0.0, 200.0)))


def skid_rows(points: list[Onset]) -> str:
    """Table of the skid map."""
    lines = []
    for p in points:
        line = minimum_axial_load_skf(CATALOGUE, p.speed * RPM)
        lines.append(f"| {p.speed:.0f} | {p.load:.1f} | {p.hirano:.0f} | {line:.0f} |")
    return "\n".join(lines)


class Statement(NamedTuple):
    """A statement of the paper, and what was computed."""

    section: str
    text: str
    holds: bool
    ours: str


def listed(values: Any, digits: int = 3) -> str:
    """Numbers with commas."""
    return ", ".join(number(float(value), digits) for value in values)


def rises(values: Any, slack: float = 0.0) -> bool:
    """Whether values never fall by more than a slack."""
    return bool(np.all(np.diff(values) >= -slack))


def of_radial(runs: Runs) -> list[Statement]:
    """Section 4.1."""
    result = {load: zones(one) for load, one in runs.items()}
    inner, gap, outer, bare = np.array(list(result.values())).T
    factors = [float(np.nanmean(one.factors[:, 0])) for one in runs.values()]
    top = int(np.argmax(outer))
    loads = ", ".join(f"{load:.0f}" for load in runs)
    fastest = max(float(np.nanmax(one.slides[:, 0])) for one in runs.values())
    free = [float((one.record.races[:, 0, :, 0] > 0.0).mean()) for one in runs.values()]
    jumps = gap - inner
    return [
        Statement(
            "4.1",
            "inner sliding is less in the loaded zone than outside",
            bool(np.all(inner < gap)),
            f"loaded {listed(inner)}; outside {listed(gap)} m/s at {loads} N",
        ),
        Statement(
            "4.1",
            "at the outer race the opposite",
            bool(np.all(outer > bare)),
            f"loaded {listed(outer)}; outside {listed(bare)} m/s",
        ),
        Statement(
            "4.1",
            f"{FASTEST:.0f} m/s and more at the inner race, loaded, under 50 N",
            fastest >= FASTEST,
            f"{fastest:.1f} m/s at most",
        ),
        Statement("4.1", "inner sliding falls as the load grows", rises(-inner, 0.01), f"{listed(inner)} m/s"),
        Statement(
            "4.1",
            "its step at the edge of the loaded zone grows with the load",
            rises(jumps, 0.01),
            f"outside less inside {listed(jumps)} m/s",
        ),
        Statement(
            "4.1",
            "the load changes little at the outer race outside the loaded zone",
            float(np.ptp(bare)) < 0.5 * float(np.ptp(inner)),
            f"{listed(bare)} m/s, a range of {np.ptp(bare):.2f} against {np.ptp(inner):.2f} m/s at the inner race",
        ),
        Statement(
            "4.1",
            "inside it, outer sliding rises with the load, then falls",
            0 < top < len(outer) - 1,
            f"{listed(outer)} m/s",
        ),
        Statement(
            "4.1",
            "the inner race pulls in the loaded zone alone",
            max(free) < 1.0,
            f"loaded for {listed(free, 2)} of the time",
        ),
        Statement(
            "4.1",
            "the inner traction factor is constant first, then falls with the load",
            abs(factors[1] / factors[0] - 1.0) < 0.1 and factors[-1] < 0.9 * factors[0],
            listed(factors, 4),
        ),
    ]


def of_axial(runs: Runs) -> list[Statement]:
    """Section 4.2."""
    slides, factors = (np.array(part) for part in zip(*(averages(one) for one in runs.values()), strict=True))
    inner, outer = slides.T
    loads = list(runs)
    top, speeds = int(np.argmax(outer)), np.array([cage(one) for one in runs.values()])
    without = speeds[loads.index(NO_SKID_FROM)]
    light = runs[50.0]
    waver = float(np.nanstd(light.slides[:, 0]) / np.nanmean(light.slides[:, 0]))
    heavy = [k for k, load in enumerate(loads) if load >= NO_SKID_FROM]
    skidding = factors[[k for k, load in enumerate(loads) if load < SKID_BELOW]]
    between = factors[loads.index(SKID_BELOW), 0] > factors[loads.index(NO_SKID_FROM), 0]
    return [
        Statement(
            "4.2", "sliding is the same all round (50 N)", waver < 0.05, f"deviation {100.0 * waver:.1f} % of the mean"
        ),
        Statement(
            "4.2",
            "inner sliding is always more than outer",
            bool(np.all(inner > outer)),
            f"inner {listed(inner)}; outer {listed(outer)} m/s",
        ),
        Statement(
            "4.2",
            "outer sliding rises, then falls",
            0 < top < len(loads) - 1,
            f"largest, {outer[top]:.3f} m/s, at {loads[top]:.0f} N",
        ),
        Statement(
            "4.2",
            f"it turns before {NO_SKID_FROM:.0f} N, where skid has not ended",
            loads[top] < NO_SKID_FROM,
            f"largest at {loads[top]:.0f} N",
        ),
        Statement(
            "4.2",
            f"inner sliding changes little beyond {NO_SKID_FROM:.0f} N",
            float(np.ptp(inner[heavy])) < 0.1 * float(inner.max()),
            f"{listed(inner[heavy])} m/s",
        ),
        Statement(
            "4.2",
            "inner and outer sliding become equal",
            abs(inner[-1] / outer[-1] - 1.0) < 0.2,
            f"{inner[-1]:.3f} and {outer[-1]:.3f} m/s at 200 N",
        ),
        Statement(
            "4.2",
            f"below {SKID_BELOW:.0f} N the inner factor stays as it is",
            float(np.ptp(skidding[:, 0])) < 0.05 * skidding[0, 0],
            f"{listed(skidding[:, 0], 4)}",
        ),
        Statement(
            "4.2",
            "and the inner factor is above the outer",
            bool(np.all(skidding[:, 0] >= skidding[:, 1])),
            f"inner {listed(skidding[:, 0], 4)}; outer {listed(skidding[:, 1], 4)}",
        ),
        Statement(
            "4.2",
            f"between {SKID_BELOW:.0f} and {NO_SKID_FROM:.0f} N the factor falls while sliding is still strong",
            bool(between),
            f"inner factor {listed(factors[:, 0], 4)}",
        ),
        Statement(
            "4.2",
            f"{NO_SKID_FROM:.0f} N or more is a load without gross sliding",
            bool(without > SKIDS),
            f"{without:.3f} of the kinematic speed at {NO_SKID_FROM:.0f} N",
        ),
        Statement("3.2", "cage speed rises with the load and levels off", rises(speeds, 2e-3), listed(speeds, 4)),
        Statement(
            "–",
            "more than 0.98 of the kinematic speed at 200 N (from the equations)",
            bool(speeds[-1] > 0.98),
            f"{speeds[-1]:.4f}",
        ),
    ]


def of_mixed(runs: Runs) -> list[Statement]:
    """Section 4.3."""
    inner = [one.slides[:, 0] for one in runs.values()]
    deviation, top = [float(np.nanstd(s)) for s in inner], [float(np.nanpercentile(s, 98)) for s in inner]
    free = np.array([one.statistics.shares[:, :, 0].mean(axis=1) for one in runs.values()])
    speeds = [cage(one) for one in runs.values()]
    return [
        Statement(
            "4.3",
            "more radial load: sliding more uneven",
            rises(deviation),
            f"deviation at the inner race {listed(deviation, 4)} m/s at 0, 100, 200, 300 N",
        ),
        Statement(
            "4.3", "its largest value falls", rises([-value for value in top]), f"98th percentile {listed(top)} m/s"
        ),
        Statement(
            "4.3",
            "without radial load sliding is severe",
            speeds[0] < SKIDS,
            f"{speeds[0]:.3f} of the kinematic speed; section 4.2 of the paper says itself that 100 N is enough",
        ),
        Statement(
            "4.3",
            "the inner factor becomes 0 in places above 200 N",
            bool(free[-1, 0] > 0.0 and free[1, 0] == 0.0),
            f"inner race free for {listed(free[:, 0])} of the time",
        ),
        Statement(
            "4.3",
            "the outer factor never does",
            bool(np.all(free[:, 1] < 1e-3)),
            f"outer race free for {listed(free[:, 1], 4)}",
        ),
    ]


def told(found: list[Statement], others: list[list[Statement]]) -> list[str]:
    """Rows of the statements: whether they hold, and with the other inputs; numbers of those that hold stand in the
    tables.
    """
    rows = []
    for k, one in enumerate(found):
        marks = "".join("✓" if same.holds else "✗" for same in (one, *(other[k] for other in others)))
        rows.append(f"| {one.section} | {one.text} | {marks} | {'' if one.holds else one.ours} |")
    return rows


def main() -> None:
    """Run everything and write the page."""
    axial, radial, mixed = series(Variant())
    points = [onset(speed) for speed in SPEEDS]
    at_5000 = next(p for p in points if p.speed == 5000.0)
    ended = critical(False, "quasi-static")
    from_rest = critical(True, "rest"), critical(False, "rest")
    smooth = zones(without_pocket_friction())
    counts = {
        result[100.0].simulation.point.kind.value: result[100.0].simulation.equations
        for result in (axial, radial, mixed)
    }
    words = [
        f"{kind}: static {c['static']}, quasi-static {c['quasi_static']}, "
        f"dynamic {c['ring']} + {c['cage']} + {c['balls']}"
        for kind, c in counts.items()
    ]
    ratio, ratio_rest = at_5000.load / ended, from_rest[0] / from_rest[1]
    found = statements(axial, radial, mixed)
    others = tried()
    ratios = [
        Statement(
            "–",
            "axial critical load 0.25 to 0.40 of the radial one, balls at rest at first (from the equations)",
            0.25 <= ratio_rest <= 0.40,
            f"{ratio_rest:.2f}",
        ),
        Statement("–", "the same, balls that roll at first", 0.25 <= ratio <= 0.40, f"{ratio:.2f}"),
    ]
    every = [one for runs in (axial, radial, mixed) for one in runs.values()]
    draw_axial({load: (*averages(one), cage(one)) for load, one in axial.items()})
    draw_azimuth("validation_000_radial", "radial load", radial, gaps=True)
    draw_azimuth("validation_000_combined", "radial load beside 100 N axial", mixed, gaps=False)
    lines = np.array([minimum_axial_load_skf(CATALOGUE, p.speed * RPM) for p in points])
    draw_skid(np.array([(p.speed, p.load, p.hirano) for p in points]), lines, CATALOGUE)
    PAGE.write_text(
        TEMPLATE.read_text(encoding="utf-8").format(
            skid_below=SKID_BELOW,
            no_skid_from=NO_SKID_FROM,
            equations="; ".join(words),
            axial=axial_rows(axial),
            radial=radial_rows(radial),
            mixed=mixed_rows(mixed),
            axial_onset=at_5000.load,
            radial_onset=ended,
            ratio=ratio,
            axial_rest=from_rest[0],
            radial_rest=from_rest[1],
            ratio_rest=ratio_rest,
            smooth=smooth[3],
            smooth_loaded=smooth[2],
            skids=SKIDS,
            skid=skid_rows(points),
            energies=max(one.statistics.energy_error for one in every),
            count=f"{sum(one.holds for one in found + ratios)} of {len(found) + len(ratios)} statements hold",
            factor=CATALOGUE,
            variants="; ".join(others),
            statements="\n".join([*told(found, list(others.values())), *told(ratios, [])]),
            beyond=100.0
            * max(one.statistics.table_exceeded or 0.0 for runs in (axial, radial, mixed) for one in runs.values()),
        ),
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()

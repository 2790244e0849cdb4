"""Write docs/validation/validation_001.md: the planar 6304 beside Shan et al. (2023).

Run it with `python tools/docs/validation_001.py`; it simulates for some minutes. Pictures are
drawn by `validation_001_pictures.py`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from dynamics_runs import RPM, Run, changed, run
from printed import printed
from validation_001_pictures import draw_forces, draw_loads, draw_orbits, draw_run_ups, draw_sliding

from oilfilm.cases import load_case
from oilfilm.postprocess.dynamics.results import ENERGY_LIMIT

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_001.md"
TEMPLATE = PAGE.with_suffix(".md.in")
RADII = {key: float(value) for key, value in printed("shan_2023_table_1")[0].items()}  # [mm]
NO_SLIP = RADII["inner_race_radius_mm"] / sum(RADII.values())  # cage over inner ring, Ri/(Ri + Ro) [-]
PLATEAU = {key: float(value) for key, value in printed("shan_2023_cage_speed")[0].items()}
LOADS = (0.5, 2.0, 10.0, 50.0, 100.0, 500.0, 1500.0)
AIR, OIL = 1.2, 870.0  # densities of what balls move in [kg/m^3]
CEASES = 0.01  # rise of the cage's speed that counts as none [-]
KNEE = 70.0  # load from which the cage of the paper gains no speed [N]
DEVIATION = 0.0424  # largest of the paper's own simulation from its test [-]
ABOUT = 2940.0  # speed of the cage of both beyond `KNEE` [r/min]
SPEEDS = (2000.0, 4000.0, 8000.0, 15000.0)
HEAVY = (30.0, 50.0, 100.0, 1000.0)  # loads of the orbits [N]
GAPS = (5.0, 10.0, 50.0, 100.0)  # [um]
BALLS = (7, 9, 11)
RUN_UP = 0.15  # time of the run-ups, the ring at its speed at once [s]
PARTS = 300  # of a run-up
AGAIN = ("100 N", "gap 5 µm", "7 balls")  # the same as 8000 r/min
LEVEL = 2.0  # change of a cage's speed from load to load that counts as none [r/min]
GRIP = 0.02  # slip of the cage below which a run-up has come to grip [-]
TIME = {"end_time_s": 0.3, "output_interval_us": 100.0, "start": "rolling", "speed_table_rpm": None}


@dataclass(frozen=True)
class Variant:
    """Inputs that the paper does not give."""

    play: float = 0.2  # of the pockets [mm]
    density: float = AIR  # of what balls move in [kg/m^3]


class Statement(NamedTuple):
    """A statement of the paper, and what was computed."""

    section: str
    text: str
    holds: bool
    ours: str


@dataclass(frozen=True)
class Series:
    """Runs over the load, over speed, load, clearance and number of balls, and from rest."""

    loads: dict[float, Run]
    steady: dict[str, Run]
    ups: dict[str, Run]

    @property
    def statements(self) -> list[Statement]:
        """Those of the paper."""
        return of_loads(self.loads) + of_speeds(self.steady, self.ups) + of_shapes(self.steady, self.ups)

    @property
    def runs(self) -> list[Run]:
        """All of them."""
        return [*self.loads.values(), *self.steady.values(), *self.ups.values()]


def start(of: Variant, gap: float = 5.0, balls: int = 7, **changes: Any) -> Run:
    """The shipped case with another gap [um] and number of balls, rolling from the start."""
    case = load_case("6304_planar")
    assert case.file.cage is not None
    pockets = case.file.cage.model_copy(update={"pocket_clearance_mm": of.play})
    bearing = replace(case.bearing, diametral_clearance=4.0e-6 * gap, balls=balls)
    keys = {"ball_drag_N": None, "mixture_density_kg_m3": of.density}
    case = replace(case, bearing=bearing, file=case.file.model_copy(update={"cage": pockets}))
    return run(changed(case, **(TIME | keys | changes)))


def variants() -> dict[str, Variant]:
    """The paper's dry friction first, other pockets, then a sphere in pure oil."""
    return {
        "dry, 0.2 mm": Variant(),
        "0.05 mm": Variant(play=0.05),
        "0.4 mm": Variant(play=0.4),
        "balls in oil": Variant(density=OIL),
    }


def cage(result: Run) -> float:
    """Mean speed of the cage [r/min]."""
    return result.statistics.cage_speed / RPM


def on_plateau(speed: float) -> bool:
    """Whether a speed of the cage [r/min] is the one the paper states."""
    return abs(speed - PLATEAU["cage_speed_rpm"]) <= PLATEAU["cage_speed_tolerance_rpm"]


def plateau_words() -> str:
    """Speed of the cage that the paper states, r/min."""
    return f"{PLATEAU['cage_speed_rpm']:.0f} ± {PLATEAU['cage_speed_tolerance_rpm']:.0f}"


def series(of: Variant) -> Series:
    """All runs with some inputs."""
    w = (0.0, 100.0)
    kinds = {f"{n:.0f} r/min": {"load": w, "speed": n} for n in SPEEDS}
    kinds |= {f"{load:.0f} N": {"load": (0.0, load)} for load in HEAVY}
    kinds |= {f"gap {gap:.0f} µm": {"load": w, "gap": gap} for gap in GAPS}
    kinds |= {f"{n} balls": {"load": w, "balls": n} for n in BALLS}
    rest = {"start": "rest", "end_time_s": RUN_UP}
    found = {name: (start(of, **keys), start(of, **keys, **rest)) for name, keys in kinds.items() if name not in AGAIN}
    every = {name: found["8000 r/min" if name in AGAIN else name] for name in kinds}
    return Series(
        loads={load: start(of, load=(0.0, load)) for load in LOADS},
        steady={name: one for name, (one, _) in every.items()},
        ups={name: one for name, (_, one) in every.items()},
    )


def knee(speeds: list[float]) -> float:
    """Load [N] from which the speed of the cage [r/min] rises by less than `CEASES`."""
    highest = np.maximum.accumulate(speeds[::-1])[::-1]
    return LOADS[int(np.argmax(highest <= np.array(speeds) * (1.0 + CEASES)))]


def load_rows(runs: dict[str, Series]) -> str:
    """Cage speeds by load and inputs."""
    lines = [f"| W, N | {' | '.join(runs)} |", "|---|" + "---|" * len(runs)]
    for w in LOADS:
        found = [of.loads[w] for of in runs.values()]
        cells = [f"{cage(one):.1f} ± {(one.statistics.cage_interval or 0.0) / RPM:.1f}" for one in found]
        lines.append(f"| {w:g} | {' | '.join(cells)} |")
    knees = [f"{knee([cage(one) for one in of.loads.values()]):g}" for of in runs.values()]
    return "\n".join([*lines, f"| ceases to rise, N | {' | '.join(knees)} |"])


def slip_in_time(result: Run) -> tuple[Any, Any]:
    """Times [s] and slip of the cage [-], means of a hundredth of the time each."""
    time, turned = np.concatenate(result.running.time), np.concatenate(result.running.cage_rotation)
    data = result.simulation.data
    between = 0.5 * (time[1:] + time[:-1])
    ring = np.concatenate([[0.0], np.cumsum(np.diff(time) * np.interp(between, data.times, data.schedule[:, 0]))])
    step = max(1, time.size // PARTS)
    place = np.arange(0, time.size, step)
    slips = 1.0 - np.diff(turned[place]) / (NO_SLIP * np.diff(ring[place]))
    return 0.5 * (time[place][1:] + time[place][:-1]), slips


def grips(result: Run) -> float:
    """Time from rest until the slip of the cage first falls below `GRIP` [s]; NaN if never."""
    time, slips = slip_in_time(result)
    return float(time[np.argmax(slips < GRIP)]) if (slips < GRIP).any() else float("nan")


def repeats(result: Run) -> float:
    """Share of the variance of the ring's path that is the same at every passage of a ball [-]."""
    layout, balls = result.simulation.layout, result.simulation.bearing.balls
    place = result.record.state[:, layout.ring][:, 1:3]
    phase = (balls * result.record.state[:, layout.cage][:, 3]) % (2.0 * np.pi)
    parts = np.minimum((phase * 40 / (2.0 * np.pi)).astype(int), 39)
    means = np.array([place[parts == k].mean(axis=0) if (parts == k).any() else place.mean(axis=0) for k in range(40)])
    rest = place - means[parts]
    return 1.0 - float(rest.var(axis=0).sum() / place.var(axis=0).sum())


def moves(result: Run) -> float:
    """Range of the ring's centre along the load [um]."""
    return float(np.ptp(result.record.state[:, 1])) * 1e6


def largest(result: Run, race: int) -> float:
    """Largest force on any ball at a race over the last third [N]."""
    return float(result.record.races[:, race, :, 0].max())


def mean_slide(result: Run, race: int) -> float:
    """Mean sliding speed where there is contact [m/s]."""
    return float(np.nanmean(result.slides[:, race]))


def other_rows(runs: dict[str, Run], ups: dict[str, Run]) -> str:
    """Table of the other series."""
    lines = [
        "| | cage, r/min | slip, % | largest Qi, Qo, N | free, inner | sliding, m/s | ring moves, µm | "
        "repeats | grips, s |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for name, result in runs.items():
        if name in AGAIN:
            continue
        o = result.statistics
        slip = 100.0 * (1.0 - cage(result) / (NO_SLIP * result.simulation.data.schedule[-1, 0] / RPM))
        cells = [
            f"{cage(result):.1f}",
            f"{slip:.2f}",
            f"{largest(result, 0):.1f}, {largest(result, 1):.1f}",
            f"{o.shares[0, :, 0].mean():.3f}",
            f"{mean_slide(result, 0):.3f}, {mean_slide(result, 1):.3f}",
            f"{moves(result):.2f}",
            f"{repeats(result):.2f}",
            f"{grips(ups[name]):.3f}",
        ]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def listed(values: Any, digits: int = 2) -> str:
    """Numbers with commas."""
    return ", ".join(f"{float(value):.{digits}f}" for value in values)


def of_loads(loads: dict[float, Run]) -> list[Statement]:
    """Section 3."""
    speeds = [cage(result) for result in loads.values()]
    heavy = [speed for w, speed in zip(LOADS, speeds, strict=True) if w >= PLATEAU["radial_load_N"]]
    off = max(abs(speed / ABOUT - 1.0) for w, speed in zip(LOADS, speeds, strict=True) if w > KNEE)
    fall = -min(0.0, float(np.diff(speeds).min()))
    return [
        Statement(
            "3",
            f"plateau (about {ABOUT:.0f}; {plateau_words()} r/min) for 100 N and more",
            all(on_plateau(speed) for speed in heavy),
            f"{listed(heavy, 1)} r/min",
        ),
        Statement(
            "3",
            f"test and simulation differ by {100.0 * DEVIATION:.2f} % at most, judged by the plateau of both",
            off <= DEVIATION,
            f"{100.0 * off:.2f} %",
        ),
        Statement("3", "the cage's speed rises with the load", fall <= LEVEL, f"falls by up to {fall:.1f} r/min"),
        Statement(
            "3",
            f"it ceases to rise above {KNEE:.0f} N (within a factor of 2)",
            0.5 <= knee(speeds) / KNEE <= 2.0,
            f"by less than {100.0 * CEASES:.0f} % from {knee(speeds):g} N on",
        ),
    ]


def of_speeds(runs: dict[str, Run], ups: dict[str, Run]) -> list[Statement]:
    """Section 4.1."""
    speeds, heavy = [f"{n:.0f} r/min" for n in SPEEDS], [f"{load:.0f} N" for load in HEAVY]
    inner, outer = (np.array([largest(runs[n], race) for n in speeds]) for race in (0, 1))
    free = [runs[n].statistics.shares[1, :, 0].mean() for n in speeds]
    slides = np.array([[mean_slide(runs[n], race) for race in (0, 1)] for n in speeds]).T
    slips = [1.0 - cage(runs[n]) / (NO_SLIP * speed) for n, speed in zip(speeds, SPEEDS, strict=True)]
    of_load = [1.0 - cage(runs[n]) / (NO_SLIP * 8000.0) for n in heavy]
    times, path = [grips(ups[n]) for n in speeds], [repeats(runs[n]) for n in speeds]
    regular, settled = [repeats(runs[n]) for n in heavy], [grips(ups[n]) for n in heavy]
    return [
        Statement(
            "4.1",
            "more speed: the largest force at the inner race stays alike",
            inner.max() < 1.25 * inner.min(),
            f"{listed(inner, 1)} N at 2000, 4000, 8000, 15000 r/min",
        ),
        Statement("4.1", "and grows at the outer race", bool(np.all(np.diff(outer) > 0.0)), f"{listed(outer, 1)} N"),
        Statement(
            "4.1",
            "the outer force does not come to 0 once it runs",
            free[-1] < 1e-3,
            f"outer race free for {listed(free, 3)} of the time",
        ),
        Statement(
            "4.1",
            "more speed: more sliding at the inner race",
            bool(np.all(np.diff(slides[0]) > 0.0)),
            f"{listed(slides[0], 3)} m/s",
        ),
        Statement(
            "4.1", "and slightly less at the outer", bool(slides[1, -1] < slides[1, 0]), f"{listed(slides[1], 3)} m/s"
        ),
        Statement(
            "4.1",
            "more load: less slip",
            of_load[-1] < of_load[0],
            f"{listed(100.0 * np.array(of_load))} % at 30, 50, 100, 1000 N",
        ),
        Statement(
            "4.1", "more speed: more slip of the cage", slips[-1] > slips[0], f"{listed(100.0 * np.array(slips))} %"
        ),
        Statement(
            "4.1",
            "more speed: longer until the cage is steady",
            bool(np.all(np.diff(times) > 0.0)),
            f"{listed(times, 3)} s",
        ),
        Statement("4.1", "more load: sooner steady", settled[-1] < settled[0], f"{listed(settled, 3)} s"),
        Statement(
            "4.1",
            "the ring's path repeats at low speed, less at high speed",
            path[-1] < path[0] - 0.05,
            f"{listed(path)} of its variance",
        ),
        Statement("4.1", "more load makes it regular", regular[-1] > regular[0], listed(regular)),
    ]


def of_shapes(runs: dict[str, Run], ups: dict[str, Run]) -> list[Statement]:
    """Section 4.2."""
    gaps, numbers = [f"gap {gap:.0f} µm" for gap in GAPS], [f"{n} balls" for n in BALLS]
    force = [largest(runs[n], 0) for n in gaps]
    slides, path = [mean_slide(runs[n], 0) for n in gaps], [moves(runs[n]) for n in gaps]
    times = [grips(ups[n]) for n in gaps]
    balls = [largest(runs[n], 0) for n in numbers]
    return [
        Statement(
            "4.2",
            "more clearance: larger forces",
            force[-1] > force[0],
            f"{listed(force, 1)} N at the inner race, gaps of 5, 10, 50, 100 µm",
        ),
        Statement("4.2", "more clearance: the ring moves more", path[-1] > path[0], f"{listed(path, 1)} µm"),
        Statement(
            "4.2",
            "more clearance: more sliding",
            slides[-1] > 1.05 * slides[0],
            f"{listed(slides, 3)} m/s at the inner race",
        ),
        Statement("4.2", "less clearance: sooner steady", times[0] < times[-1], f"{listed(times, 3)} s"),
        Statement(
            "4.2",
            "more balls: less force on each",
            bool(np.all(np.diff(balls) < 0.0)),
            f"{listed(balls, 1)} N with 7, 9, 11 balls",
        ),
        Statement(
            "4.2",
            "beyond 12 balls no further fall",
            False,
            f"12 and 15 do not fit; from 9 to 11 it still falls, by {100.0 * (1.0 - balls[2] / balls[1]):.0f} %",
        ),
    ]


def stiffnesses() -> dict[str, float]:
    """K of both races as printed, corrected, and of Hertz [N/m^1.5]."""
    result = {}
    for key, name in (("printed", "planar as printed"), ("planar", "planar"), ("hertz", "hertz")):
        laws = start(Variant(), race_stiffness=name, end_time_s=1e-3).simulation.data.normal
        result[f"{key}_inner"], result[f"{key}_outer"] = float(laws[0, 0]), float(laws[1, 0])
    for race in ("inner", "outer"):
        result[f"ratio_{race}"] = result[f"hertz_{race}"] / result[f"planar_{race}"]
    return result


def told(found: list[list[Statement]]) -> str:
    """Rows of the statements: whether they hold with each of the inputs, numbers of the first where not."""
    rows = []
    for same in zip(*found, strict=True):
        marks = "".join("✓" if one.holds else "✗" for one in same)
        rows.append(f"| {same[0].section} | {same[0].text} | {marks} | {'' if same[0].holds else same[0].ours} |")
    return "\n".join(rows)


def main() -> None:
    """Run everything and write the page."""
    every = {name: series(of) for name, of in variants().items()}
    first = next(iter(every.values()))
    speeds = {name: {w: cage(one) for w, one in of.loads.items()} for name, of in every.items()}
    draw_loads(speeds, NO_SLIP, PLATEAU)
    draw_forces({f"{n:.0f} r/min": first.steady[f"{n:.0f} r/min"] for n in SPEEDS})
    draw_sliding({f"{n:.0f} r/min": first.steady[f"{n:.0f} r/min"] for n in SPEEDS})
    draw_run_ups({name: slip_in_time(result) for name, result in first.ups.items()})
    draw_orbits(first.steady)
    shipped = first.loads[100.0]
    PAGE.write_text(
        TEMPLATE.read_text(encoding="utf-8").format(
            equations=shipped.simulation.equations["dynamic"],
            unloaded=round(7.0 * float((shipped.record.races[:, 0, :, 0] <= 0.0).mean())),
            no_slip=8000.0 * NO_SLIP,
            ceases=100.0 * CEASES,
            loads=load_rows(every),
            others=other_rows(first.steady, first.ups),
            counts=counts({name: of.statements for name, of in every.items()}),
            variants="; ".join(every),
            statements=told([of.statements for of in every.values()]),
            runs=sum(len(of.runs) for of in every.values()),
            limit=ENERGY_LIMIT,
            loose=loose(every) or "none",
            **stiffnesses(),
        ),
        encoding="utf-8",
    )


def loose(every: dict[str, Series]) -> str:
    """Runs whose energies do not close, with what is left over the work."""
    named = [
        (f"{key}{more}, {name}", one.statistics.energy_error)
        for name, of in every.items()
        for runs, more in ((of.loads, " N"), (of.steady, ""), (of.ups, " from rest"))
        for key, one in runs.items()
    ]
    return "; ".join(f"{name} ({error:.1g})" for name, error in named if error > ENERGY_LIMIT)


def counts(found: dict[str, list[Statement]]) -> str:
    """How many statements hold with each of the inputs."""
    total = len(next(iter(found.values())))
    words = [f"{sum(one.holds for one in same)} ({name})" for name, same in found.items()]
    return f"Of {total} statements hold {', '.join(words)}"


if __name__ == "__main__":
    main()

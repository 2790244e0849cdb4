"""Write docs/validation/validation_002_vibration.md: vibration over the oil supply, Yao et al. (2022), Fig. 4, a trend.

Run it with `OMP_NUM_THREADS=1 python tools/docs/validation_002_vibration.py`; it takes a quarter of an hour.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from oilfilm.cases.format.case import case_of_document, load_case
from oilfilm.cases.runs.vibration import NotSolvedError, run_vibration
from oilfilm.postprocess.plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, RC, save
from oilfilm.postprocess.vibration.summary import vibration_summary

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_002_vibration.md"
TEMPLATE = PAGE.with_suffix(".md.in")
IMAGE = DOCS / "images" / "validation_002_vibration.png"
FLOWS = (0.2, 0.6, 1.2, 2.0)  # [mL/min]; the paper: 0.2 to 2
SPEEDS = (5000.0, 10000.0)  # [r/min]
LOADS = (400.0, 3000.0)  # [N]
SEED = 7717  # of the phases of the waves
ORDERS = 40  # with amplitudes of 0.2 um over the order
FORM_UM = 0.2
SUPPORT = {"shaft_mass_kg": 1.0, "seat_stiffness_N_um": 100.0, "seat_damping_N_s_m": 300.0, "housing_mass_kg": 1.0}
TIME = {"duration_s": 0.15, "settling_time_s": 0.06, "wave_filter": "dry"}


class Point(NamedTuple):
    """What follows at one speed, load and supply."""

    level: float  # acceleration of the outer ring [m/s^2]
    stiffness: tuple[float, float]  # of the heaviest contacts over Hertz', inner and outer race [-]
    damping: tuple[float, float]  # of their films [N s/m]
    bars: tuple[float, float]  # of these [N s/m]
    share: tuple[float, float]  # of the load on asperities [-]


def waves(random: np.random.Generator) -> list[dict[str, float]]:
    """Waviness whose amplitude falls as 1/n, with random phases."""
    phases = random.uniform(0.0, 360.0, ORDERS)
    return [
        {"order": n, "amplitude_um": FORM_UM / n, "phase_deg": float(phase)} for n, phase in enumerate(phases, start=1)
    ]


def document(speed: float, load: float, flow: float | None) -> dict[str, Any]:
    """The case at a speed [r/min], a load [N] and a flow [mL/min]; None: flooded."""
    base = load_case("6208_oil_supply").document
    random = np.random.default_rng(SEED)
    form = {"inner_waviness": waves(random), "outer_waviness": waves(random)}
    friction = dict(base["friction"])
    films = {**base["ehl"], "starvation": "solved" if flow else "none"}
    friction["supply_mL_min"] = flow or 2.0
    operation = {**base["operation"], "inner_speed_rpm": speed, "radial_load_N": load}
    own = {"form": form, "support": SUPPORT, "vibration": TIME}
    return {**base, **own, "friction": friction, "ehl": films, "operation": operation}


def point(speed: float, load: float, flow: float | None) -> Point | None:
    """Vibration of one point; None where a film is not solved."""
    try:
        found = vibration_summary(run_vibration(case_of_document(document(speed, load, flow)), "point"))
    except NotSolvedError as problem:
        print(f"{speed:.0f} r/min, {load:.0f} N, {flow}: {problem}")
        return None
    assert found["converged"]
    heaviest = {row["race"]: row for row in sorted(found["films"], key=lambda row: row["load_N"])}
    heavy = [heaviest["inner"], heaviest["outer"]]

    def column(key: str) -> tuple[float, float]:
        return tuple(row[key] for row in heavy)  # type: ignore[return-value]

    shares = column("film_load_share")
    result = Point(
        level=found["vibration"]["acceleration_m_s2"],
        stiffness=column("stiffness_over_hertz_ratio"),
        damping=column("damping_N_s_m"),
        bars=column("damping_uncertainty_N_s_m"),
        share=(1.0 - shares[0], 1.0 - shares[1]),
    )
    print(speed, load, flow, result, flush=True)
    return result


def text(flow: float | None) -> str:
    """Of a supply."""
    return "flooded" if flow is None else f"{flow:g}"


def rows(points: dict[tuple[float, float, float | None], Point | None]) -> str:
    """Lines of the table."""
    lines = []
    for (speed, load, flow), one in points.items():
        head = f"| {speed:.0f} | {load:.0f} | {text(flow)} |"
        if one is None:
            lines.append(f"{head} film not solved | – | – | – |")
            continue
        damping = ", ".join(f"{c:.0f} ± {bar:.0f}" for c, bar in zip(one.damping, one.bars, strict=True))
        stiffness = ", ".join(f"{k:.3f}" for k in one.stiffness)
        share = ", ".join(f"{part:.2f}" for part in one.share)
        lines.append(f"{head} {one.level:.2f} | {stiffness} | {damping} | {share} |")
    return "\n".join(lines)


def draw(points: dict[tuple[float, float, float | None], Point | None]) -> None:
    """Level and damping over the supply."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.8))
        level, damping = figure.subplots(1, 2)
        for speed, colour in zip(SPEEDS, (INNER_COLOUR, OUTER_COLOUR), strict=True):
            for load, style in zip(LOADS, ("-", "--"), strict=True):
                known = [(flow, points[speed, load, flow]) for flow in FLOWS]
                shown = [(flow, one) for flow, one in known if one is not None]
                label = f"{speed:.0f} r/min, {load:.0f} N"
                given = {"color": colour, "linestyle": style, "marker": "o", "markersize": 3}
                flows = [flow for flow, _ in shown]
                level.plot(flows, [one.level for _, one in shown], label=label, **given)
                bars = [one.bars[0] for _, one in shown]
                damping.errorbar(flows, [one.damping[0] for _, one in shown], yerr=bars, capsize=2, **given)
                full = points[speed, load, None]
                if full is not None:
                    square = {"color": colour, "markersize": 3, "fillstyle": "none" if load > 1000.0 else "full"}
                    level.plot(2.3, full.level, "s", **square)
                    damping.plot(2.3, full.damping[0], "s", **square)
        level.set_ylabel("acceleration of the outer ring [m/s²]")
        damping.set_ylabel("damping, heaviest inner contact [N s/m]")
        for axes in (level, damping):
            axes.set_xlabel("oil supply [mL/min]; squares at 2.3: flooded")
            axes.grid(linewidth=0.3, alpha=0.5)
        level.set_yscale("log")
        figure.legend(*level.get_legend_handles_labels(), loc="outside upper center", ncols=4, fontsize=6)
        save(figure, IMAGE)


if __name__ == "__main__":
    grid = [(speed, load, flow) for speed in SPEEDS for load in LOADS for flow in (*FLOWS, None)]
    found = {key: point(*key) for key in grid}
    page = TEMPLATE.read_text(encoding="utf-8")
    PAGE.write_text(page.format(rows=rows(found)), encoding="utf-8")
    draw(found)

"""Write docs/validation/validation_003.md: slip of the 7000C beside Wang et al. (2024).

Run it with `python tools/docs/validation_003.py`.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
from printed import printed

from oilfilm.bearing import QuasistaticSolution, solve_quasistatic
from oilfilm.bearing.studies.slip import SlipStudy, critical_loads, minimum_preload, slip_factors, slip_surface
from oilfilm.cases import load_case

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_003.md"
TEMPLATE = PAGE.with_suffix(".md.in")
PICTURE = DOCS / "images" / "validation_003_tilt.png"
CASE = load_case("hirano_7000C")
RPM = pi / 30.0  # [rad/s]
AT_REST = 1e3  # speed without a centrifugal force to speak of [r/min]
FIGURE_7 = [
    (float(row["radial_load_N"]), 1e-3 * float(row["moment_N_mm"])) for row in printed("wang_2024_figure_7")
]  # radial load [N], moment [N m]
FIGURE_9 = (1.3e-3, 1.6e-3, 1.9e-3, 2.2e-3, 2.5e-3, 2.8e-3)  # tilts [rad]
SPEEDS = (20e3, 30e3, 40e3, 50e3, 60e3, 70e3)


LOW, HIGH = (float(row["minimum_preload_N"]) for row in printed("wang_2024_minimum_preload"))
FIGURE_12 = [
    (float(row["axial_load_N"]), float(row["radial_load_N"]), 1e-3 * float(row["tilt_mrad"]))
    for row in printed("wang_2024_figure_12")
]  # axial and radial load [N], tilt [rad]


def solved(speed: float, axial: float, radial: float, tilt: float = 0.0) -> QuasistaticSolution:
    """Equilibrium at a speed [r/min], axial and radial load [N], tilt about z [rad]."""
    operation = replace(CASE.operation, inner_speed=speed * RPM, force=(axial, radial, 0.0), tilt=(0.0, tilt))
    solution = solve_quasistatic(CASE.bearing, operation, CASE.model)
    assert solution.converged
    return solution


def held(speed: float, radial_load: float, tilt: float = 0.0) -> QuasistaticSolution:
    """As `solved` under a radial load [N], the ring held axially where its play ends: where the balls touch at the
    free contact angle.
    """
    bearing = CASE.bearing
    reach = bearing.inner_groove_radius + bearing.outer_groove_radius - bearing.ball_diameter
    place = reach * float(np.sin(bearing.free_contact_angle))
    operation = replace(
        CASE.operation,
        inner_speed=speed * RPM,
        force=(None, radial_load, 0.0),
        displacement=(place, None, None),
        tilt=(0.0, tilt),
    )
    solution = solve_quasistatic(CASE.bearing, operation, CASE.model)
    assert solution.converged
    return solution


def study(radial: float = 0.0, limit: float = 10.0) -> SlipStudy:
    """The bearing under a radial load [N]."""
    operation = replace(CASE.operation, force=(0.0, radial, 0.0))
    return SlipStudy(bearing=CASE.bearing, operation=operation, model=CASE.model, limit=limit)


def preloads() -> str:
    """Lines of the first table."""
    lines = []
    for speed in SPEEDS:
        needed, half = (minimum_preload(study(limit=limit), speed * RPM) for limit in (10.0, 5.0))
        light, heavy = (slip_factors(solved(speed, load, 0.0))[0] for load in (50.0, 600.0))
        lines.append(f"| {speed:.0f} | {needed:.1f} | {half:.1f} | {light:.3f} | {heavy:.3f} |")
    return "\n".join(lines)


def maps() -> list[tuple[str, str, str]]:
    """Figures 5 and 6: statement, verdict, numbers."""
    speeds = [n * RPM for n in SPEEDS]
    light = slip_surface(study(), speeds, [25.0, 50.0, 100.0]).minimum
    heavy = slip_surface(study(2000.0), speeds, [100.0, 350.0, 600.0]).factors
    unloaded = (heavy < 1e-9).sum(axis=2)
    needed = minimum_preload(study(2000.0), 20e3 * RPM)
    slow, fast = solved(20e3, 500.0, 0.0), solved(70e3, 500.0, 0.0)
    return [
        (
            f"Fig. 5a: without radial load and below {LOW:.0f} N axial, slip from 20000 to 70000 r/min",
            "yes, but it holds up to 214.5 N",
            f"SF at 100 N {light[0, 2]:.2f} to {light[-1, 2]:.2f}; 20000 r/min needs "
            f"{minimum_preload(study(), speeds[0]):.1f} N, with half of F_c "
            f"{minimum_preload(study(limit=5.0), speeds[0]):.1f} N",
        ),
        (
            "Fig. 5b: under 2000 N radial the bearing does not slip at all",
            "no",
            f"{unloaded.min()} to {unloaded.max()} of 10 balls are unloaded between 100 and 600 N axial; at 20000 "
            f"r/min all hold from {needed:.0f} N on",
        ),
        (
            "Fig. 6: at 500 N axial the inner load falls with speed and the outer load grows",
            "yes",
            f"20000 to 70000 r/min: inner {slow.inner_load[0]:.1f} to {fast.inner_load[0]:.1f} N, "
            f"outer {slow.outer_load[0]:.1f} to {fast.outer_load[0]:.1f} N",
        ),
        (
            "Fig. 17: at constant preload the inner load grows with speed",
            "no",
            "it falls, as in Fig. 6: its axial part stays F_a/Z, and the inner contact angle grows",
        ),
    ]


def radial() -> list[tuple[str, str, str]]:
    """Figures 7 and 8."""
    few, more = solved(20e3, 0.0, 50.0), solved(20e3, 0.0, 100.0)
    free, loaded = (critical_loads(study(), 24e3 * RPM, load) for load in (0.0, 100.0))
    change = ", ".join(f"{d:+.0f}" for d in (loaded - free)[:6])
    slow, fast = ([abs(float(held(n, load).ring_moment[1])) for load, _ in FIGURE_7] for n in (AT_REST, 20e3))
    off = [
        [f"{100.0 * (m / p - 1.0):+.1f}" for m, (_, p) in zip(found, FIGURE_7, strict=True)] for found in (slow, fast)
    ]
    return [
        (
            "Fig. 7: moments of 118, 140, 162, 182, 202, 220 N mm at 50 to 100 N radial (printed with other units)",
            "nearly, with the ring held axially",
            f"{', '.join(off[0])} % without centrifugal force, {', '.join(off[1])} % at 20000 r/min",
        ),
        (
            "Fig. 7: without axial load the contact loads grow with the radial load, most at the load line",
            "yes",
            f"50 to 100 N at 20000 r/min: ball 1 {few.inner_load[0]:.1f} to "
            f"{more.inner_load[0]:.1f} N, ball 2 "
            f"{few.inner_load[1]:.1f} to {more.inner_load[1]:.1f} N; the others carry none",
        ),
        (
            "Fig. 8: without radial load the critical curves of all balls meet",
            "yes",
            f"at 24000 r/min in {free[0]:.1f} N, at 40000 r/min in {critical_loads(study(), 40e3 * RPM, 0.0)[0]:.1f} N",
        ),
        (
            "Fig. 8: one ball of a half needs less preload under radial load, the four others more",
            "no",
            f"at 24000 r/min 100 N radial change the critical axial load at 0°, 36°, … 180° by {change} N",
        ),
        (
            "Conclusions: more radial load improves the slip factors",
            "no",
            "only of balls within 72° of the load line; the others decide",
        ),
    ]


def moments() -> list[float]:
    """Moments that hold the tilts of Fig. 12, either way [N m]."""
    return [
        abs(float(solved(20e3, axial, radial_load, sign * tilt).ring_moment[1]))
        for axial, radial_load, tilt in FIGURE_12
        for sign in (-1, 1)
    ]


def tilted() -> list[tuple[str, str, str]]:
    """Figures 9 and 12."""
    result = []
    for axial, radial_load, tilt in FIGURE_12:
        both = [slip_factors(solved(20e3, axial, radial_load, sign * tilt)) for sign in (-1.0, 1.0)]
        result.append(f"{axial:.0f} N " + " or ".join(f"{f.min():.1f}–{f.max():.1f}" for f in both))
    level, down, up = (slip_factors(solved(20e3, 300.0, 100.0, tilt)) for tilt in (0.0, -0.3e-3, 0.3e-3))
    free = [solved(20e3, 0.0, 200.0, tilt).inner_load[0] for tilt in FIGURE_9]
    fixed = [[held(20e3, 200.0, sign * tilt).inner_load.max() for tilt in FIGURE_9] for sign in (1.0, -1.0)]
    ends = " or ".join(f"{loads[0]:.1f} to {loads[-1]:.1f} N" for loads in fixed)
    return [
        (
            "Fig. 12a: 300 N axial, 100 N radial, 0.3 mrad: every ball slips",
            "not at 20000 r/min",
            "SF with the tilt one way or the other: " + "; ".join(result) + "; the speed is not printed",
        ),
        (
            "Fig. 12: the factors grow from 300 to 500 N axial, with tilt and moment",
            "yes, by the axial load",
            "see above",
        ),
        (
            "Fig. 12 and conclusions: tilt makes slip less likely",
            "depends on its sign",
            f"worst ball at 300 N: {level.min():.1f} without tilt, "
            f"{down.min():.1f} and {up.min():.1f} with 0.3 mrad either way",
        ),
        (
            "Fig. 9: without axial load, 200 N radial, the contact load grows with the tilt (1.3 to 2.8 mrad)",
            "yes, with the ring held axially" if all(np.all(np.diff(loads) > 0.0) for loads in fixed) else "no",
            f"held where its play ends: {ends} at the heaviest ball; free along the axis: {free[0]:.1f} to "
            f"{free[-1]:.1f} N",
        ),
    ]


def deflection(axial: float, moment: float) -> float:
    """Free tilt about z [rad] at 20000 r/min, 100 N radial; axial load [N], moment [N m]."""
    free = replace(CASE.operation, moment=(None, moment), tilt=(0.0, None))
    operation = replace(free, inner_speed=20e3 * RPM, force=(axial, 100.0, 0.0))
    solution = solve_quasistatic(CASE.bearing, operation, CASE.model)
    assert solution.converged
    return float(solution.tilt[1])


def deflections() -> list[tuple[str, str, str]]:
    """Figures 10 and 11."""
    falling = [_ends((200.0, moment), (600.0, moment), f"{1e3 * moment:.0f} N mm") for moment in (0.0, 0.2, 0.4)]
    growing = [_ends((axial, 0.0), (axial, 0.4), f"{axial:.0f} N") for axial in (200.0, 400.0, 600.0)]
    return [
        (
            "Fig. 10: the deflection grows with the axial preload (200 to 600 N, 100 N radial, 20000 r/min)",
            "no",
            "it falls, as a preload stiffens: " + ", ".join(falling),
        ),
        ("Fig. 11: the deflection grows with the moment", "yes", "0 to 400 N mm: " + ", ".join(growing)),
    ]


def _ends(first: tuple[float, float], last: tuple[float, float], fixed: str) -> str:
    return f"{1e3 * deflection(*first):.2f} to {1e3 * deflection(*last):.2f} mrad at {fixed}"


def draw() -> None:
    """Picture of Figs. 10 and 11: deflection over axial preload and over the moment."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

    loads, moments_ = np.linspace(200.0, 600.0, 17), np.linspace(0.0, 0.4, 17)
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 3.0))
        figure.suptitle("7000C, 20000 r/min, 100 N radial, free to tilt", fontsize=8.5)
        left, right = figure.subplots(1, 2, sharey=True)
        for moment in (0.0, 0.1, 0.2, 0.3, 0.4):
            left.plot(loads, [1e3 * deflection(load, moment) for load in loads], label=f"{1e3 * moment:.0f} N mm")
        for load in (200.0, 300.0, 400.0, 500.0, 600.0):
            right.plot(1e3 * moments_, [1e3 * deflection(load, m) for m in moments_], label=f"{load:.0f} N")
        left.set_xlabel("axial load [N]")
        left.set_ylabel("tilt about z [mrad]")
        right.set_xlabel("moment about z [N mm]")
        left.legend(title="moment", title_fontsize=7)
        right.legend(title="axial load", title_fontsize=7)
        for axes in (left, right):
            axes.grid(linewidth=0.3, alpha=0.5)
            axes.set_ylim(bottom=0.0)
        save(figure, PICTURE)


def preload() -> list[tuple[str, str, str]]:
    """Figures 14 to 16."""
    speed = 63e3 * RPM
    pair = [slip_factors(solved(63e3, load, 150.0)) for load in (0.5 * HIGH, HIGH)]
    return [
        (
            f"Figs. 14, 15: at 63000 r/min, 150 N radial, {HIGH:.0f} N axial no ball slips",
            "no",
            f"SF {pair[1].max():.3f} to {pair[1].min():.3f}: all slip; "
            f"{minimum_preload(study(150.0), speed):.1f} N needed",
        ),
        (
            "Fig. 14: the factor is proportional to the axial load",
            "nearly, on average",
            f"{0.5 * HIGH:.0f} to {HIGH:.0f} N: mean {pair[0].mean():.3f} to "
            f"{pair[1].mean():.3f}, "
            f"worst ball {pair[0].min():.3f} to {pair[1].min():.3f}",
        ),
        ("Fig. 16: the minimum preload grows with speed, ever steeper", "yes", "first table"),
    ]


def page() -> str:
    """The page, computed anew."""
    turbine = solved(63e3, HIGH, 150.0)
    factors = slip_factors(turbine)[:6]
    speed = 63e3 * RPM
    rows = [*maps(), *radial(), *tilted(), *deflections(), *preload()]
    return TEMPLATE.read_text(encoding="utf-8").format(
        preloads=preloads(),
        low=LOW,
        high=HIGH,
        own=minimum_preload(study(150.0), speed),
        half=minimum_preload(study(150.0, 5.0), speed),
        half_low=minimum_preload(study(limit=5.0), 20e3 * RPM),
        balls=" | ".join(f"{ball + 1}, {36 * ball}°" for ball in range(6)),
        dashes="|".join(["---"] * 6),
        factors=" | ".join(f"{factor:.3f}" for factor in factors),
        doubled=" | ".join(f"{2.0 * factor:.2f}" for factor in factors),
        statements="\n".join("| " + " | ".join(row) + " |" for row in rows),
        least_moment=min(moments()),
        most_moment=max(moments()),
        force=float(np.mean(turbine.centrifugal_force)),
        mean=float(slip_factors(turbine).mean()),
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()

"""Write docs/validation/validation_002_supply.md: friction over the oil supply, Yao et al. (2022), Fig. 3.

Run it with `python tools/docs/validation_002_supply.py`.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import log
from pathlib import Path

import matplotlib as mpl
import numpy as np
import scipy
from matplotlib.figure import Figure
from validation_002_torque import (
    FRICTION,
    LOADS,
    ML_MIN,
    PARTS,
    SPEEDS,
    SUPPLIED,
    SUPPLY,
    UM,
    SupplyPoint,
    optimum,
    solved,
    supplied,
    supplied_case,
)

from oilfilm.bearing import Race
from oilfilm.bearing.films.decay import film_decay
from oilfilm.bearing.films.operating_film import supplied_films
from oilfilm.bearing.supply.inlet_oil import AMPLE, OilAtInlets, PrescribedInlet
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.runs.bearing import run_case
from oilfilm.postprocess.plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, RC, REFERENCE, save

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_002_supply.md"
TEMPLATE = PAGE.with_suffix(".md.in")
IMAGE = DOCS / "images" / "validation_002_supply.png"
DECAY = DOCS / "images" / "film_after_supply.png"
FLOWS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 2.0)  # [mL/min]
LAYERS = (0.05, 0.1, 0.2, 0.5, 1.0, 50.0)  # [um]
SCAN = tuple(np.geomspace(0.05, 20.0, 16).tolist())  # of the minimum [mL/min]
GRID = [(speed, load) for speed in SPEEDS for load in LOADS]
HEAVY = [(speed, LOADS[-1]) for speed in SPEEDS]
MASS, LAND = 12.0, 0.2  # of a cage [g], Coulomb's mu of its dry land [-]; assumed
LEAST, MOST = 0.2, 2.0  # range of the paper [mL/min]
ROUGHNESS = FRICTION.roughness[0]  # [m]
CHANGES = {  # what is changed of the supply, of the friction
    "as the case has it": ({}, {}),
    "φ, `supply_track_share`, 0.1 (low end of the band)": ({"track_share": 0.1}, {}),
    "φ 0.25": ({"track_share": 0.25}, {}),
    "φ 1": ({"track_share": 1.0}, {}),
    "ℓ, `supply_loss`, 0.02": ({"loss": 0.02}, {}),
    "ℓ 0.04": ({"loss": 0.04}, {}),
    "σ, `[surface]`, 0.1 µm": ({}, {"roughness": (0.1e-6, 0.1e-6)}),
    "σ 0.4 µm": ({}, {"roughness": (0.4e-6, 0.4e-6)}),
    'µ_b, `boundary_coefficient`, 0.05 (low end of `dry_surface = "ptfe film"`)': ({}, {"boundary": 0.05}),
    "µ_b 0.2 (its high end)": ({}, {"boundary": 0.2}),
    "`supply_residence_s` 200, ten times the churning": ({"residence_time": 200.0}, {}),
}


@cache
def at_flow(speed: float, load: float, flow: float, what: str = "as the case has it") -> SupplyPoint:
    """Torque at a flow [mL/min] of oil."""
    of_supply, of_friction = CHANGES[what]
    return supplied(speed, load, replace(SUPPLY, flow=flow * ML_MIN, **of_supply), **of_friction)


def least(torque) -> float | None:
    """Supply of least friction [mL/min], to two per cent; None where it falls to the end of the scan."""
    totals = [torque(flow).total for flow in SCAN]
    index = int(np.argmin(totals))
    if index in (0, len(SCAN) - 1):
        return None
    bounds = (log(SCAN[index - 1]), log(SCAN[index + 1]))
    found = scipy.optimize.minimize_scalar(
        lambda x: torque(float(np.exp(x))).total, bounds=bounds, method="bounded", options={"xatol": 0.02}
    )
    return float(np.exp(found.x))


@cache
def minimum(speed: float, load: float, what: str = "as the case has it") -> float | None:
    """Of the chain from ball to ball, with a change."""
    return least(lambda flow: at_flow(speed, load, flow, what))


def cell(value: float | None) -> str:
    """A supply [mL/min] in a table."""
    return "none" if value is None else f"{value:.2f}"


def steepness(speed: float, load: float) -> tuple[float | None, float | None]:
    """Mean slopes from the ends of the paper's range to the minimum [N mm min/mL], positive where friction grows."""
    best = minimum(speed, load)
    if best is None:
        return None, None
    low, middle, high = (1e3 * at_flow(speed, load, flow).total for flow in (LEAST, best, MOST))
    below = (low - middle) / (best - LEAST) if best > LEAST else None
    return below, (high - middle) / (MOST - best) if best < MOST else None


def slopes() -> str:
    """Lines of the table of steepness."""
    lines = []
    for speed, load in GRID:
        below, above = steepness(speed, load)
        best = minimum(speed, load)
        numbers = [at_flow(speed, load, flow).total for flow in (LEAST, best or SCAN[0], MOST)]
        torques = " | ".join(f"{1e3 * number:.1f}" for number in numbers)
        words = ["none" if slope is None else f"{slope:.1f}" for slope in (below, above)]
        lines.append(
            f"| {speed:.0f} | {load:.0f} | {cell(best)} | {optimum()[speed]} | {torques} | {words[0]} | {words[1]} |"
        )
    return "\n".join(lines)


def parts() -> str:
    """Lines of the table of parts under the largest load."""
    lines = []
    for speed in SPEEDS:
        for flow in (LEAST, minimum(speed, LOADS[-1]) or LEAST, MOST):
            torque = at_flow(speed, LOADS[-1], flow)
            numbers = " | ".join(f"{1e3 * torque.parts[name]:.1f}" for name in PARTS)
            lines.append(
                f"| {speed:.0f} | {flow:.2f} | {torque.film_share:.2f} | {torque.lambda_least:.2f} | {numbers} |"
            )
    return "\n".join(lines)


def verdicts() -> str:
    """Statements of the paper on Fig. 3, verdicts, numbers."""
    minima = {point: minimum(*point) for point in GRID}
    heavy = {speed: minima[speed, LOADS[-1]] for speed in SPEEDS}
    light = [f"{load:.0f} N at {speed:.0f} r/min" for (speed, load), best in minima.items() if best is None]
    numbers = ", ".join(f"{cell(heavy[speed])} ({speed:.0f} r/min)" for speed in SPEEDS)
    steep = {speed: steepness(speed, LOADS[-1]) for speed in SPEEDS}
    sides = "; ".join(
        f"{speed:.0f} r/min: {below or 0.0:.1f} below, {above or 0.0:.1f} N mm min/mL above"
        for speed, (below, above) in steep.items()
    )
    holds = all(below is not None and above is not None and below > above for below, above in steep.values())
    grows = (heavy[SPEEDS[1]] or 0.0) > (heavy[SPEEDS[0]] or 0.0)
    none = f"none under {', '.join(light)}" if light else "at all loads"
    all_slow = ", ".join(cell(minima[SPEEDS[0], load]) for load in LOADS)
    rows = [
        (
            "friction over the supply has a minimum",
            f"in {len(minima) - len(light)} of {len(minima)} points" if light else "yes",
            f"3000 N: {numbers} mL/min; {none}",
        ),
        (
            "below it friction is steep, above it moderate",
            "steeper below, 3000 N" if holds else "no",
            f"3000 N, {sides}",
        ),
        ("its place grows with the speed", "yes, 3000 N" if grows else "no", f"3000 N: {numbers} mL/min"),
        (
            "the load has no obvious effect on it",
            "no",
            f"{all_slow} mL/min under {', '.join(f'{load:.0f}' for load in LOADS)} N at {SPEEDS[0]:.0f} r/min",
        ),
    ]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


@cache
def cage_torque(load: float, oil: float) -> tuple[float, float]:
    """The cage's part and the total [N mm] at 5000 r/min and the least supply, oil on a share of its land [-]."""
    document = SUPPLIED.document
    changed = {
        "operation": {**document["operation"], "radial_load_N": load},
        "friction": {**document["friction"], "supply_mL_min": LEAST},
        "cage": {**document["cage"], "land_oil_share": oil, "land_friction": LAND, "mass_g": MASS},
    }
    torque = run_case(case_of_document({**document, **changed})).torque
    assert torque is not None
    assert torque.shear is not None
    return 1e3 * torque.shear.torque.parts["cage"], 1e3 * (torque.total or 0.0)


def lands() -> str:
    """Lines of the table of the cage's land."""
    rows = []
    for words, oil in (("full of oil", 1.0), ("half full", 0.5), ("dry", 0.0)):
        cells = [cage_torque(load, oil) for load in LOADS]
        rows.append(f"| {words} | " + " | ".join(f"{cage:.1f} of {total:.1f}" for cage, total in cells) + " |")
    return "\n".join(rows)


def press() -> float:
    """Force on a dry land that brakes as much as oil in all of it does [N]."""
    cage = SUPPLIED.friction.cage
    assert cage is not None
    assert cage.land_diameter is not None
    return cage_torque(LOADS[1], 1.0)[0] / (LAND * 0.5e3 * cage.land_diameter)


def ellipses() -> str:
    """Widths of the ellipse of ball 1 at the inner race [mm], of which the layer does not depend."""
    contacts = [supplied_case(SPEEDS[0], load)[2] for load in LOADS]
    widths = [max(2e3 * c.hertz.semi_axis_y for c in row if c.hertz and c.race is Race.INNER) for row in contacts]
    return ", ".join(f"{width:.1f}" for width in widths)


def page() -> str:
    """The page, computed anew."""
    flooded = [supplied(SPEEDS[0], load, AMPLE) for load in LOADS]
    dry = [at_flow(SPEEDS[0], load, SCAN[0]) for load in LOADS]
    layers = [supplied(SPEEDS[0], LOADS[-1], PrescribedInlet(layer=layer * UM)) for layer in LAYERS]
    low, high = SUPPLY.captured
    return TEMPLATE.read_text(encoding="utf-8").format(
        heads=" | ".join(f"{speed:.0f} r/min, {load:.0f} N" for speed, load in GRID),
        dashes="|".join(["---"] * len(GRID)),
        flows="\n".join(
            f"| {flow:g} | " + " | ".join(f"{1e3 * at_flow(*point, flow).total:.1f}" for point in GRID) + " |"
            for flow in FLOWS
        ),
        slopes=slopes(),
        parts=parts(),
        verdicts=verdicts(),
        changes="\n".join(
            f"| {what} | " + " | ".join(cell(minimum(*point, what)) for point in HEAVY) + " |" for what in CHANGES
        ),
        heavy_heads=" | ".join(f"{speed:.0f} r/min" for speed, _ in HEAVY),
        heavy_dashes="|".join(["---"] * len(HEAVY)),
        lands=lands(),
        press=press(),
        width=1e3 * SUPPLY.groove_width,
        ellipses=ellipses(),
        low=low,
        high=high,
        load_heads=" | ".join(f"{load:.0f} N" for load in LOADS),
        load_dashes="|".join(["---"] * len(LOADS)),
        flooded_rolling=" | ".join(f"{1e3 * torque.parts['rolling']:.1f}" for torque in flooded),
        dry_asperity=" | ".join(f"{1e3 * torque.parts['asperity']:.1f}" for torque in dry),
        churned=" | ".join(f"{1e3 * at_flow(SPEEDS[0], load, MOST).parts['drag']:.1f}" for load in LOADS),
        layers=" | ".join(f"{layer:g}" for layer in LAYERS),
        layer_dashes="|".join(["---"] * len(LAYERS)),
        layer_shares=" | ".join(f"{torque.film_share:.3f}" for torque in layers),
        layer_lambdas=" | ".join(f"{torque.lambda_least:.2f}" for torque in layers),
        layer_torques=" | ".join(f"{1e3 * torque.total:.1f}" for torque in layers),
    )


def draw() -> None:
    """Film share, lambda and torque over the supply with their bands, totals by speed and load."""
    flows = np.linspace(0.05, 2.5, 40)
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 4.6))
        film, rough, torque, totals = figure.subplots(2, 2).ravel()
        names = (("film_share", film), ("lambda_least", rough), ("total", torque))
        for speed, colour in zip(SPEEDS, (INNER_COLOUR, OUTER_COLOUR), strict=True):
            for name, axes in names:
                scale = 1e3 if name == "total" else 1.0
                band = [
                    [scale * getattr(at_flow(speed, LOADS[-1], flow, what), name) for flow in flows.tolist()]
                    for what in ("φ, `supply_track_share`, 0.1 (low end of the band)", "as the case has it")
                ]
                edges = np.array(band)
                axes.fill_between(flows, edges.min(axis=0), edges.max(axis=0), color=colour, alpha=0.2, linewidth=0)
                axes.plot(flows, edges[1], color=colour, label=f"{speed:.0f} r/min, φ 0.5; band: 0.1 to 0.5")
        rough.axhline(1.0, color=REFERENCE, linewidth=0.7, linestyle=":")
        shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.85, len(LOADS)))
        for load, shade in zip(LOADS, shades, strict=True):
            for speed, style in zip(SPEEDS, ("-", "--"), strict=True):
                line = [1e3 * at_flow(speed, load, flow).total for flow in flows.tolist()]
                totals.plot(flows, line, style, color=shade, label=f"{load:.0f} N" if style == "-" else None)
                best = minimum(speed, load)
                if best is not None and best < flows[-1]:
                    totals.plot(best, 1e3 * at_flow(speed, load, best).total, "o", color=shade, markersize=3.5)
        for speed, place in optimum().items():
            totals.axvline(float(place), color=REFERENCE, linewidth=0.7, linestyle="-" if speed < 7500.0 else "--")
        words = ("film over the flooded one [-]", "smallest λ [-]", "torque [N mm]", "torque [N mm]")
        titles = ("3000 N", "3000 N", "3000 N", "φ 0.5; grey: least friction as measured")
        for axes, label, title in zip((film, rough, torque, totals), words, titles, strict=True):
            axes.set_title(title)
            axes.set_ylabel(label)
            axes.set_xlim(0.0, flows[-1])
            axes.set_ylim(bottom=0.0)
            axes.set_xlabel("oil supply [mL/min]")
            axes.spines[["top", "right"]].set_visible(False)
        film.legend(loc="upper left", fontsize=6)
        totals.legend(loc="upper left", fontsize=6, ncols=2)
        save(figure, IMAGE)


def draw_decay() -> None:
    """Film after the supply stops at three losses between the balls."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(0.75 * PAGE_WIDTH, 2.8))
        axes = figure.subplots()
        state, contacts = solved(SPEEDS[0], LOADS[-1])
        oil = OilAtInlets(oil=AMPLE, balls=SUPPLIED.bearing.balls)
        films = supplied_films(contacts, [None] * len(contacts), oil, FRICTION.asperities)
        for loss, colour in ((0.0, INNER_COLOUR), (0.001, "#5a8f5a"), (0.05, OUTER_COLOUR)):
            supply = replace(SUPPLY, flow=1.0, residence_time=0.0, loss=loss)
            decay = film_decay(state, contacts, films, 36000.0, supply)
            assert decay is not None
            shown = (decay.time > 0.0) & (decay.film > 0.0)
            axes.loglog(decay.time[shown], 1e6 * decay.film[shown], color=colour, label=f"ℓ = {loss:g}")
            if not loss:
                later = decay.time > 0.0
                style = {"color": REFERENCE, "linestyle": "--", "linewidth": 0.9}
                axes.loglog(decay.time[later], 1e6 * decay.joined[later], label="closed forms, joined", **style)
        axes.axhline(1e6 * ROUGHNESS, color=REFERENCE, linewidth=0.7, linestyle=":", label="roughness")
        axes.set(xlabel="time since the supply stopped [s]", ylabel="central film [µm]", xlim=(1e-3, 36000.0))
        axes.set_title("6208, 3000 N, 5000 r/min, from flooded")
        axes.grid(linewidth=0.3, alpha=0.5)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        save(figure, DECAY)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()
    draw_decay()

"""Write docs/validation/validation_002_torque.md: friction of the 6208, Yao et al. (2022).

Run it with `python tools/docs/validation_002_torque.py`.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import pi
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from printed import printed

from oilfilm.bearing import contact_conditions, load_material, solve_quasistatic
from oilfilm.bearing.films.operating_film import (
    OilAtInlets,
    least_lambda,
    mean_fraction,
    of_driven_balls,
    supplied_films,
)
from oilfilm.bearing.films.unsolved_films import formula_films
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.bearing.supply.inlet_oil import PrescribedInlet, Supply
from oilfilm.bearing.torque.breakdown import friction_torque
from oilfilm.bearing.torque.integrated import bearing_films, solved_shear
from oilfilm.cases import load_case
from oilfilm.cases.batch.sweep import read_sweep
from oilfilm.cases.format.case import Case, case_of_document
from oilfilm.cases.runs.equilibrium import case_equilibrium
from oilfilm.cases.runs.heating import self_heated
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_002_torque.md"
TEMPLATE = PAGE.with_suffix(".md.in")
IMAGE = DOCS / "images" / "friction_over_supply.png"
CASE, SUPPLIED = load_case("6208_five_terms"), load_case("6208_oil_supply")
SUPPLY, FRICTION = SUPPLIED.friction.supply, SUPPLIED.friction
RPM, ML_MIN, UM, ZERO = pi / 30.0, 1e-6 / 60.0, 1e-6, 273.15
FLOW, SPEED, LOAD = "friction.supply_mL_min", "operation.inner_speed_rpm", "operation.radial_load_N"
POINTS = [point.values for point in read_sweep("6208_over_oil_supply").points]
FLOWS, SPEEDS, LOADS = (tuple(sorted({values[key] for values in POINTS})) for key in (FLOW, SPEED, LOAD))
COOLED = "6208_self_heating_with_cooling_oil"


@cache
def solved(speed: float, load: float, **materials: str):
    """Equilibrium and contacts at a speed [r/min] and radial load [N]."""
    changes = {key: load_material(name) if isinstance(name, str) else name for key, name in materials.items()}
    operation = replace(CASE.operation, inner_speed=speed * RPM, force=(0.0, load, 0.0))
    state = solve_quasistatic(replace(CASE.bearing, **changes), operation, CASE.model)
    assert state.converged
    return state, contact_conditions(state, CASE.lubricant)


def terms(speed: float, load: float) -> dict[str, float]:
    """The five terms [N mm]."""
    yao = friction_torque(*solved(speed, load), CASE.lubricant, CASE.friction).models["yao"]
    return {name: 1e3 * value for name, value in yao.components.items()}


class SupplyPoint(NamedTuple):
    """The torque of a bearing at a supply [N m], what is left of its films and of lambda [-]."""

    total: float
    parts: dict[str, float]
    film_share: float
    lambda_least: float


@cache
def supplied_case(speed: float, load: float) -> tuple[Case, QuasistaticSolution, tuple, list]:
    """The case with a supply at a speed [r/min] and a load [N], its equilibrium, contacts and films of formulas."""
    operation = {"inner_speed_rpm": speed, "radial_load_N": load}
    document = SUPPLIED.document
    case = case_of_document({**document, "operation": {**document["operation"], **operation}})
    state = case_equilibrium(case)
    contacts = contact_conditions(state, case.lubricant)
    return case, state, contacts, formula_films(contacts)


def supplied(speed: float, load: float, supply: Supply | PrescribedInlet, **changes: object) -> SupplyPoint:
    """The recommended torque at a supply, with changes of the case's friction."""
    case, state, contacts, films = supplied_case(speed, load)
    friction = replace(case.friction, supply=supply, **changes)
    running = bearing_films(state, contacts, films, friction, case.inlet)
    resistance = friction.resistance(case.bearing, case.lubricant, case.operation.shaft_speed)
    torque = solved_shear(state, contacts, running, case.rheology, resistance).torque
    oil = OilAtInlets(oil=supply, balls=case.bearing.balls)
    left = of_driven_balls(state, contacts, supplied_films(contacts, films, oil, friction.asperities))
    parts = {name: torque.parts[name] for name in ("cage", "rolling", "hysteresis", "asperity", "drag")}
    parts["film"] = torque.total - sum(parts.values())
    return SupplyPoint(torque.total, parts, mean_fraction(left), least_lambda(left))


@cache
def heat_balances(sweep: str) -> dict[tuple[float, float, float], SelfHeatingSolution]:
    """Heat balances of a sweep, by speed [r/min], load [N] and supply [mL/min]."""
    states = {}
    for point in read_sweep(sweep).points:
        case = case_of_document(point.document)
        key = (case.operation.inner_speed / RPM, case.operation.force[1], point.values[FLOW])
        state = self_heated(case)
        assert state is not None
        assert state.converged
        states[tuple(round(value, 6) for value in key)] = state
    return states


def celsius(state: SelfHeatingSolution) -> float:
    """Temperature that the bearing warms itself to [degrees Celsius]."""
    assert state.balance is not None
    return state.balance.temperature - ZERO


def temperature_rows(states: dict[tuple[float, float, float], SelfHeatingSolution]) -> str:
    """Lines of the table of temperatures."""
    rows = []
    for speed, load in sorted({key[:2] for key in states}):
        cells = [
            f"{celsius(state):.1f} ({1e3 * state.balance.torque:.1f})"
            for key, state in states.items()
            if key[:2] == (speed, load)
        ]
        rows.append(f"| {speed:.0f} | {load:.0f} | {' | '.join(cells)} |")
    return "\n".join(rows)


def material_rows() -> str:
    """Lines of the table of materials."""
    rows = []
    for words, ring, ball in (
        ("steel, steel", "bearing steel", "bearing steel"),
        ("steel, silicon nitride", "bearing steel", "silicon nitride"),
        ("silicon nitride, silicon nitride", "silicon nitride", "silicon nitride"),
    ):
        state, contacts = solved(
            10000.0, 3000.0, inner_ring_material=ring, outer_ring_material=ring, ball_material=ball
        )
        models = friction_torque(state, contacts, CASE.lubricant, CASE.friction).models
        five = {name: 1e3 * value for name, value in models["yao"].components.items()}
        lines = 1e3 * (models["pure_rolling_lines"].total or 0.0)
        oil = 1e3 * models["houpert"].components["hydrodynamic"]
        pressure = max(c.hertz.pressure for c in contacts if c.hertz is not None and c.race.value == "inner")
        rows.append(
            f"| {words} | {1e-9 * pressure:.3f} | {five['ME']:.2f} | {lines:.2f} | {oil:.1f} | "
            f"{five['ME'] + lines + oil:.1f} |"
        )
    return "\n".join(rows)


def statement_rows() -> str:
    """Statements of the paper, verdicts, numbers."""
    heat = {key: celsius(state) for key, state in heat_balances("6208_self_heating_over_supply").items()}
    cooled = {key[2]: celsius(state) for key, state in heat_balances(COOLED).items()}
    coolest = min(cooled, key=cooled.__getitem__)
    first, last = min(cooled), max(cooled)
    points = sorted({key[:2] for key in heat})
    lines = {point: [heat[key] for key in heat if key[:2] == point] for point in points}
    flows = sorted({key[2] for key in heat})
    coldest = {point: flows[line.index(min(line))] for point, line in lines.items()}
    ends = "; ".join(
        f"{n:.0f} r/min, {f:.0f} N: {line[0]:.1f} to {min(line):.1f} °C at {coldest[n, f]:g} mL/min, "
        f"{line[-1]:.1f} at {flows[-1]:g}"
        for (n, f), line in lines.items()
    )
    below = all(line[0] > line[1] > line[2] for line in lines.values())
    above = [point for point, line in lines.items() if line[-1] == min(line)]
    with_air = ", ".join(f"{cooled[flow]:.1f}" for flow in (first, coolest, last))
    rows = [
        ("Fig. 5: below the optimum the temperature falls with the supply", "yes" if below else "no", ends),
        (
            "Fig. 5: above the optimum it goes on falling",
            f"in {len(above)} of {len(lines)} rows; with a hundred times the supply as cooling oil "
            + ("yes" if coolest == last else "no"),
            f"see above; {with_air} °C at {first:g}, {coolest:g} and {last:g} mL/min with the cooling oil "
            "(900 N, 5000 r/min)",
        ),
        (
            "Fig. 5: it grows with speed and load",
            "yes",
            f"1.2 mL/min: {heat[5000.0, 900.0, 1.2]:.1f} °C at 5000 r/min, 900 N; "
            f"{heat[10000.0, 900.0, 1.2]:.1f} at "
            f"10000 r/min; {heat[10000.0, 3000.0, 1.2]:.1f} with 3000 N",
        ),
    ]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def of_heat() -> dict[str, object]:
    """What the section on the temperature has."""
    states, cooled = heat_balances("6208_self_heating_over_supply"), heat_balances(COOLED)
    flows = sorted({key[2] for key in states})
    ample = states[5000.0, 900.0, 2.0]
    assert ample.balance is not None
    return {
        "conductance": ample.around.conductance,
        "ambient": ample.around.ambient - ZERO,
        "heat_heads": " | ".join(f"{flow:g} mL/min" for flow in flows),
        "heat_dashes": "|".join(["---"] * len(flows)),
        "temperatures": temperature_rows(states),
        "heat_flow": ample.around.oil_flow,
        "heat_of_oil": ample.oil_heat,
        "power": ample.balance.power,
        "cooled_sweep": COOLED,
        "cooled": ", ".join(f"{celsius(state):.1f}" for state in cooled.values()),
        "coolest_flow": f"{min(cooled, key=lambda key: celsius(cooled[key]))[2]:g}",
        "cooled_flows": ", ".join(f"{key[2]:g}" for key in cooled),
    }


def optimum() -> dict[float, str]:
    """Supply of least friction as printed [mL/min], by speed [r/min]."""
    rows = printed("yao_2022_optimum_supply")
    return {float(row["inner_speed_rpm"]): row["optimum_supply_mL_min"] for row in rows}


def page() -> str:
    """The page, computed anew."""
    grid = [(speed, load) for speed in SPEEDS for load in LOADS]
    five = {point: terms(*point) for point in grid}
    return TEMPLATE.read_text(encoding="utf-8").format(
        terms="\n".join(
            f"| {n:.0f} | {f:.0f} | " + " | ".join(f"{v:.2f}" for v in (*t.values(), sum(t.values()))) + " |"
            for (n, f), t in five.items()
        ),
        **of_heat(),
        materials=material_rows(),
        statements=statement_rows(),
    )


def _values(values: list[float], between: str = ", ") -> str:
    return between.join(f"{1e3 * value:.1f}" for value in values)


PARTS = {  # of the model, words, colour
    "cage": ("cage", "#5a8f5a"),
    "rolling": ("rolling resistance", "#4c78a8"),
    "hysteresis": ("hysteresis", "#9c755f"),
    "film": ("films", "#d67b1f"),
    "asperity": ("asperities", "#4d3b2f"),
    "drag": ("churning", "#79b7c9"),
}


def draw() -> None:
    """Temperatures over the supply."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(0.6 * PAGE_WIDTH, 2.9))
        heat = figure.subplots()
        shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.85, len(LOADS)))
        states = heat_balances("6208_self_heating_over_supply")
        for speed, load in ((5000.0, 900.0), (5000.0, 3000.0), (10000.0, 900.0), (10000.0, 3000.0)):
            line = [(key[2], celsius(state)) for key, state in states.items() if key[:2] == (speed, load)]
            style = "-" if speed < 7500.0 else "--"
            shade = shades[LOADS.index(load)]
            label = f"{speed:.0f} r/min, {load:.0f} N"
            heat.plot(*zip(*line, strict=True), style, color=shade, marker="o", markersize=2.5, label=label)
        line = [(key[2], celsius(state)) for key, state in heat_balances(COOLED).items()]
        heat.plot(*zip(*line, strict=True), ":", color=shades[LOADS.index(900.0)], label="with cooling oil")
        heat.set(xlabel="oil supply, mL/min", ylabel="temperature, °C", xlim=(0.0, 2.1))
        heat.set_ylim(bottom=20.0)
        heat.spines[["top", "right"]].set_visible(False)
        heat.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        save(figure, IMAGE)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()

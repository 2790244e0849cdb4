"""Write tables and picture of docs/theory/traction_equilibrium.md."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import degrees, pi
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from oilfilm.bearing import (
    BallKinematics,
    QuasistaticModel,
    contact_conditions,
    solve_quasistatic,
    solve_traction_equilibrium,
)
from oilfilm.bearing.friction.contact_friction import BallTraction, FrictionSource
from oilfilm.bearing.friction.friction_sources import CoefficientTraction, CoulombTraction, FilmTraction
from oilfilm.cases import load_case
from oilfilm.cases.format.case import Case
from oilfilm.cases.format.film_model import NEWTONIAN, CaseFilms
from oilfilm.cases.runs.equilibrium import PooledFilms
from oilfilm.ehl import SolverOptions
from oilfilm.ehl.traction.friction_coefficients import FourConstants
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "theory" / "traction_equilibrium.md"
IMAGE = DOCS / "images" / "traction_equilibrium_218.png"
START, END = "<!-- tables: written by tools/docs/traction_equilibrium.py -->", "<!-- end of tables -->"
RPM = pi / 30.0  # [rad/s]
SPEEDS = (1000.0, 2000.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0, 8000.0, 9000.0, 10000.0)  # [r/min]
SHOWN = (10000.0,)
POINTS = 129
HYPOTHESES = {
    "outer race control": BallKinematics.OUTER_RACE_CONTROL,
    "inner race control": BallKinematics.INNER_RACE_CONTROL,
    "half and half": BallKinematics.HALF_AND_HALF,
}
FILMS, FOUR, COULOMB = "solved films", "four constants, 0.05", "Coulomb, 0.07"
COLOURS = {
    "outer race control": "#c1440e", "inner race control": "#0b5394", "half and half": "#666666",
    FILMS: "#1b1f24", FOUR: "#5a8f5a", COULOMB: "#8a5a9f",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Row:
    """What one way of computing gives for ball 1: angles [deg], ratios [-]."""

    attitude: float
    inner_angle: float
    outer_angle: float
    inner_spin: float
    outer_spin: float
    inner_share: float
    cage: float


def sources(case: Case) -> dict[str, FrictionSource]:
    """Ways to the friction of the balls."""
    assert case.rheology is not None
    solver = PooledFilms(case=CaseFilms(options=SolverOptions(points=POINTS), films=NEWTONIAN))
    return {
        FILMS: FilmTraction(solve=solver, rheology=case.rheology),
        FOUR: CoefficientTraction(FourConstants.of_curve(0.05, 0.03, 0.03)),
        COULOMB: CoulombTraction(friction=0.07),
    }


def row(case: Case, model: QuasistaticModel, source: FrictionSource | None) -> Row:
    """Ball 1 of the case under a model; in traction equilibrium where there is a source of friction."""
    if source is None:
        state = solve_quasistatic(case.bearing, case.operation, model)
    else:
        traction = BallTraction(source=source, lubricant=case.lubricant)
        state = solve_traction_equilibrium(case.bearing, case.operation, model, traction)
    if not state.converged:
        raise SystemExit(state.message)
    inner, outer = contact_conditions(state, case.lubricant)[:2]
    assert inner.spin_roll_ratio is not None and outer.spin_roll_ratio is not None
    both = state.inner_friction[0] + state.outer_friction[0]
    return Row(
        attitude=degrees(state.attitude[0]),
        inner_angle=degrees(state.inner_contact_angle[0]),
        outer_angle=degrees(state.outer_contact_angle[0]),
        inner_spin=inner.spin_roll_ratio,
        outer_spin=outer.spin_roll_ratio,
        inner_share=float(state.inner_friction[0] / both),
        cage=state.cage_speed / case.operation.inner_speed,
    )


def ways(case: Case) -> Iterator[tuple[str, Row]]:
    """All ways at the case's operation."""
    for name, kinematics in HYPOTHESES.items():
        yield name, row(case, QuasistaticModel(ball_kinematics=kinematics), None)
    for name, source in sources(case).items():
        yield name, row(case, QuasistaticModel(), source)


def at(case: Case, rpm: float, axial: float) -> Case:
    """The case at a speed [r/min] under thrust alone [N]."""
    operation = replace(case.operation, inner_speed=rpm * RPM, force=(axial, 0.0, 0.0))
    return replace(case, operation=operation)


def table(rows: dict[str, Row]) -> list[str]:
    """Lines of one operation's table."""
    lines = [
        "| | β | α_i, α_o | spin over roll, inner, outer | inner share of 2 M_g/D | cage over shaft |",
        "|---|---|---|---|---|---|",
    ]
    for name, r in rows.items():
        lines.append(
            f"| {name} | {r.attitude:.2f}° | {r.inner_angle:.2f}°, {r.outer_angle:.2f}° | "
            f"{r.inner_spin:.4f}, "
            f"{r.outer_spin:.4f} | {r.inner_share:.3f} | {r.cage:.5f} |"
        )
    return lines


def draw(by_speed: dict[float, dict[str, Row]]) -> None:
    """Attitude, share of the inner race and cage speed over speed."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.9))
        panels = figure.subplots(1, 3)
        wanted = (
            ("attitude", "attitude of the ball's axis, deg"),
            ("inner_share", "inner race's share of the couple"),
            ("cage", "cage over shaft speed"),
        )
        for axes, (key, label) in zip(panels, wanted, strict=True):
            for name, colour in COLOURS.items():
                values = [getattr(rows[name], key) for rows in by_speed.values()]
                style = "--" if name in HYPOTHESES else "-"
                axes.plot([rpm / 1000.0 for rpm in by_speed], values, style, color=colour, label=name)
            axes.set_xlabel("shaft speed, 1000 r/min")
            axes.set_ylabel(label)
            axes.spines[["top", "right"]].set_visible(False)
        figure.legend(*panels[0].get_legend_handles_labels(), ncols=3, loc="outside upper center")
        save(figure, IMAGE)


def main() -> None:
    """Solve, draw, and write the tables."""
    big = load_case("218_axial_22250N")
    by_speed = {rpm: dict(ways(at(big, rpm, 22250.0))) for rpm in SPEEDS}
    draw(by_speed)
    lines = []
    for rpm in SHOWN:
        lines += ["", f"218, 22250 N axial, {rpm:g} r/min:", "", *table(by_speed[rpm])]
    text = PAGE.read_text(encoding="utf-8")
    head, rest = text.split(START)
    PAGE.write_text(f"{head}{START}\n" + "\n".join(lines[1:]) + f"\n{END}" + rest.split(END)[1], encoding="utf-8")


if __name__ == "__main__":
    main()

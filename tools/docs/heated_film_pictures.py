"""Traction of films with heat beside full solves: picture and table of docs/theory/traction.md.

Inner race of the shipped case `6208_with_heat` at 15 m/s, Eyring's oil without a limiting stress, so that what heat and
thinning do is not cut; no spin, no curvature slip.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.friction.tables import table_contacts
from oilfilm.bearing.geometry import Race
from oilfilm.cases import load_case
from oilfilm.ehl import SolverOptions
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.traction_table.film import table_film
from oilfilm.ehl.traction_table.table import TableContact
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

DOCS = Path(__file__).parents[2] / "docs"
IMAGE = DOCS / "images" / "6208_with_heat.png"
PAGE = DOCS / "theory" / "traction.md"
START, END = "<!-- written by tools/docs/heated_film_pictures.py -->", "<!-- end of films with heat -->"
LOADS, SPEED = (50.0, 500.0, 1600.0), 15.0
RATIOS = np.geomspace(1e-3, 2.0, 41)
SAMPLES = (0.002, 0.02, 0.1, 0.5, 1.5)
COLOURS = ("#4c78a8", "#d67b1f", "#b23a3a")
POINTS = 129
Array = NDArray[np.float64]


def contact() -> TableContact:
    """What the table of the inner race is made for, without a limiting stress."""
    case = load_case("6208_with_heat")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    result = table_contacts(state, case.lubricant, case.rheology, solids=case.films.solids)[Race.INNER]
    return replace(result, rheology=result.rheology.unlimited)


def by_films(wanted: TableContact, load: float, ratios: Array) -> Array:
    """Coefficients of the film that a table of this contact shears [-]."""
    film = table_film(wanted, load, SPEED, SolverOptions(points=POINTS))
    none = np.zeros(ratios.size)
    forces = film.sliding_forces((SPEED * ratios, none, none), np.full(ratios.size, SPEED / wanted.radius_x), 0.0)
    return np.asarray(-forces[:, 0] / load)


def in_full(wanted: TableContact, load: float, ratio: float) -> tuple[float, bool]:
    """Coefficient of a full solve [-], and whether it converged."""
    conditions = replace(wanted.conditions(load, SPEED), slide_roll_ratio=ratio)
    result = solve_generalized(conditions, wanted.rheology, solids=wanted.solids, options=SolverOptions(points=POINTS))
    x, y = result.contact.x, result.contact.y
    assert result.mid_stress is not None and x is not None and y is not None
    return -float(np.trapezoid(np.trapezoid(result.mid_stress[0], y, axis=1), x)) / load, result.contact.converged


def draw(axes: Axes, wanted: TableContact, load: float, colour: str) -> str:
    """Curves and points of one load; the row of the table."""
    axes.plot(RATIOS, by_films(replace(wanted, solids=None), load, RATIOS), color=colour, linestyle=":", linewidth=1.2)
    axes.plot(RATIOS, by_films(wanted, load, RATIOS), color=colour, linewidth=1.6, label=f"{load:.0f} N")
    row = f"| {load:.0f} N |"
    for ratio, heated in zip(SAMPLES, by_films(wanted, load, np.array(SAMPLES)), strict=True):
        full, converged = in_full(wanted, load, ratio)
        axes.plot(ratio, full, "o", color=colour, markersize=5, fillstyle="full" if converged else "none")
        row += f" {heated / full - 1.0:+.1%}{'' if converged else ', not converged'} |"
    return row


def main() -> None:
    """Picture and table."""
    wanted, rows = contact(), []
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 0.62 * PAGE_WIDTH))
        axes = figure.subplots()
        for load, colour in zip(LOADS, COLOURS, strict=True):
            rows.append(draw(axes, wanted, load, colour))
        axes.plot([], [], ":", color="0.3", label="films without heat")
        axes.plot([], [], "-", color="0.3", label="films with heat")
        axes.plot([], [], "o", color="0.3", label="full solves, each slides")
        axes.set_xscale("log")
        axes.set_ylim(0.0, None)
        axes.set_xlabel("slide–roll ratio [–]")
        axes.set_ylabel("traction coefficient [–]")
        axes.legend(frameon=False, ncols=2, loc="upper left")
        save(figure, IMAGE)
    ratios = " | ".join(f"{ratio:g}" for ratio in SAMPLES)
    head = f"| load, slide–roll ratio | {ratios} |\n|{'---|' * (len(SAMPLES) + 1)}\n"
    table = head + "\n".join(rows)
    text = PAGE.read_text(encoding="utf-8")
    before, _, rest = text.partition(START)
    _, _, after = rest.partition(END)
    PAGE.write_text(f"{before}{START}\n{table}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()

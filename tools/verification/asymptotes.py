"""Moes' diagram: solved films beside the four asymptotes of Nijenbanning, Venner and Moes."""

from collections.abc import Sequence
from functools import partial
from math import log, nan

import numpy as np

from oilfilm.ehl import ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import moes_film_nijenbanning
from oilfilm.ehl.closed_form.hertz import hertz_coefficients

from .contacts import OIL, WATER_LIKE, MoesConditions, moes
from .page import Check, Picture, Section, Table, columns, each, percent, text
from .plots import Curve, draw_moes

LUBRICANT = (0.0, 2.5, 5.0, 10.0, 20.0)  # L of the diagram
# of the films of the regimes and of the diagram
TOLERANCE = 0.01
ROUGH = 0.03
LOADS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)  # M of the diagram
REGIMES = {  # M, L, Rx/Ry and the factor on M or L over which the power is taken
    "RI": ((0.25, 0.0, 1.0), "M", 2.0),
    "EI": ((150.0, 0.0, 1.0), "M", 2.0),
    "RP": ((15.0, 30.0, 1.0), "L", 1.5),
    "EP": ((500.0, 5.0, 1.0), "M", 2.0),
}
POWERS = {"RI": -2.0, "EI": -2.0 / 15.0, "RP": 2.0 / 3.0, "EP": -1.0 / 12.0}
NAMES = {"RI": "rigid isoviscous", "EI": "elastic isoviscous", "RP": "rigid piezoviscous", "EP": "elastic piezoviscous"}
POWER_TOLERANCE = {"RI": 0.1, "EI": 0.05, "RP": 0.1, "EP": 0.05}


def asymptotes(m: float, l: float, ratio: float) -> dict[str, float]:
    """Four asymptotes (h/Rx)(2U)^(-1/2) [-], Nijenbanning, Venner and Moes (1994)."""
    d = ratio
    q = 1.0 + 0.006 * log(d) + 0.63 * d ** (4 / 7)
    return {
        "RI": 145.0 * (1.0 + 0.796 * d ** (14 / 15)) ** (-15 / 7) / d / m**2,
        "EI": 3.18 * q ** (-14 / 25) * d ** (-1 / 15) * m ** (-2 / 15),
        "RP": 1.29 * (1.0 + 0.691 * d) ** (-2 / 3) * l ** (2 / 3),
        "EP": 1.48 * q ** (-7 / 20) * d ** (-1 / 24) * m ** (-1 / 12) * l**0.75,
    }


def film_unit(m: float, ratio: float) -> float:
    """(h/Rx)(2U)^(-1/2) of a film of one a^2/Rx [-]."""
    return hertz_coefficients(ratio)[0] ** 2 * m ** (2 / 3)


def moes_film(solution: ContactSolution) -> float:
    """Extrapolated central film (h/Rx)(2U)^(-1/2) [-]; without error bar."""
    conditions = solution.conditions
    assert isinstance(conditions, MoesConditions)
    unit = film_unit(conditions.load_parameter, conditions.radius_ratio)
    return unit * solution.film_central_dimensionless.value


def _solve(job: tuple[float, float, float, int], tolerance: float = TOLERANCE) -> ContactSolution:
    m, l, ratio, points = job
    oil = OIL if l > 0.0 else WATER_LIKE
    return solve_contact(moes(m, l, ratio, oil=oil), SolverOptions(points=points, tolerance=tolerance))


def moes_diagram(quick: bool = False) -> Section:
    """Film over load, and the powers and factors deep in each regime."""
    points = 129 if quick else 1025
    loads, lubricant = (LOADS[2:7:2], LUBRICANT[::2]) if quick else (LOADS, LUBRICANT)
    jobs = [(m, l, 1.0, points) for l in lubricant for m in loads]
    solutions = each(partial(_solve, tolerance=ROUGH), jobs)
    curves = []
    fits = []
    for l in lubricant:
        films = [
            (job[0], moes_film(s))
            for job, s in zip(jobs, solutions, strict=True)
            if job[1] == l and s.converged and s.resolved
        ]
        dense = tuple(float(m) for m in np.geomspace(loads[0], loads[-1], 200))
        curves.append(Curve(label=f"{l:g}", x=tuple(m for m, _ in films), y=tuple(h for _, h in films)))
        fits.append(Curve(label="fit", x=dense, y=tuple(moes_film_nijenbanning(m, l, 1.0) for m in dense)))
    # the rigid films are not resolved on the 129 points of the quick diagram
    table, checks = _regimes(257, ("RI", "RP")) if quick else _regimes(points, tuple(REGIMES))
    caption = "Central film over load for five L: solved (dots), fit of Nijenbanning, Venner and Moes (lines)"
    return Section(
        title="Moes' asymptotes",
        text=text("asymptotes"),
        checks=checks,
        tables=(table,),
        pictures=(Picture("verification_moes", caption, partial(draw_moes, curves=curves, fits=fits)),),
    )


def _regimes(points: int, names: Sequence[str]) -> tuple[Table, tuple[Check, ...]]:
    jobs = []
    for (m, l, ratio), varied, factor in (REGIMES[name] for name in names):
        other = (factor * m, l, ratio) if varied == "M" else (m, factor * l, ratio)
        jobs += [(m, l, ratio, points), (*other, points)]
    solutions = each(_solve, jobs)
    rows = []
    checks = []
    for i, name in enumerate(names):
        (m, l, ratio), varied, factor = REGIMES[name]
        pair = solutions[2 * i : 2 * i + 2]
        first, second = (moes_film(s) for s in pair)
        power = log(second / first) / log(factor)
        theory = POWERS[name]
        asymptote = asymptotes(m, l, ratio)[name]
        fit = moes_film_nijenbanning(m, l, ratio)
        bar = pair[0].film_central_dimensionless.uncertainty * film_unit(m, ratio)
        films = (f"{first:.4g} ± {bar:.1g}", f"{asymptote:.4g}", percent(asymptote / first - 1.0))
        powers = (f"{fit:.4g}", f"{power:.3f}", f"{theory:.3f} ({varied})")
        rows.append((NAMES[name], f"{m:g}", f"{l:g}", *films, *powers))
        within = POWER_TOLERANCE[name]
        known = all(s.converged and s.resolved for s in pair)
        checks.append(
            Check(
                f"power of {varied}, {NAMES[name]}",
                power if known else nan,
                least=round(theory - within, 3),
                most=round(theory + within, 3),
            )
        )
    head = columns("regime | M | L | film, solved | asymptote |  | whole formula | power | of the asymptote")
    caption = "(h/R_x)(2U)^(−1/2), circular contact:"
    return Table(caption, head, tuple(rows)), tuple(checks)

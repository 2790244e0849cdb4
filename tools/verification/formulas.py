"""Film formulas beside solved films: where they hold and where they fail."""

from collections.abc import Callable, Mapping
from functools import partial
from itertools import product

import numpy as np

from oilfilm.ehl import ContactConditions, ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import (
    film_chittenden_central,
    film_hamrock_dowson_central,
    film_hamrock_dowson_minimum,
    film_nijenbanning_central,
)

from .contacts import NAMED, from_groups, moes
from .page import Check, Picture, Section, Table, each, percent, text
from .plots import FormulaMap, draw_formulas

LOADS = (5.0, 15.0, 50.0, 150.0, 500.0, 1500.0)  # M
LUBRICANT = (2.0, 5.0, 10.0, 20.0)  # L
RATIOS = (1.0, 0.2, 0.04)  # Rx/Ry
TOLERANCE = 0.02  # of the solved films, beyond which a point is left out
Formula = Callable[[ContactConditions], float]
FORMULAS: dict[str, tuple[str, Formula]] = {
    "Hamrock–Dowson, central": ("central", film_hamrock_dowson_central),
    "Chittenden, central": ("central", film_chittenden_central),
    "Nijenbanning, central": ("central", film_nijenbanning_central),
    "Hamrock–Dowson, minimum": ("minimum", film_hamrock_dowson_minimum),
}


def formulas(quick: bool = False) -> Section:
    """Deviation of the formulas over M, L and Rx/Ry."""
    loads, lubricant, ratios = ((15.0, 150.0), (5.0, 10.0), (1.0,)) if quick else (LOADS, LUBRICANT, RATIOS)
    options = SolverOptions(points=257 if quick else 1025, tolerance=2.5 * TOLERANCE if quick else TOLERANCE)
    jobs = [(ratio, l, m) for ratio in ratios for l in lubricant for m in loads]
    contacts = [from_groups(moes(m, l, ratio)) for ratio, l, m in jobs]
    solutions = dict(zip(jobs, each(lambda c: solve_contact(c, options), contacts), strict=True))
    maps = _maps(solutions, loads, lubricant, ratios)
    rows = []
    for k, name in enumerate(FORMULAS):
        own = maps[k * len(ratios) : (k + 1) * len(ratios)]
        rows.append((name, *(_range(one.share) for one in own)))
    head = ("formula", *(f"R_x/R_y {ratio:g}" for ratio in ratios))
    tables = [Table("Smallest and largest deviation, and the median of its size:", head, tuple(rows))]
    if not quick:
        tables.append(_named(options))
    used = sum(s.converged and s.resolved for s in solutions.values()) / len(solutions)
    return Section(
        title="Film formulas",
        text=text("formulas"),
        checks=(Check("formulas: share of the contacts solved to the wanted error bar", used, least=0.9),),
        tables=tuple(tables),
        pictures=(
            Picture(
                "verification_formulas",
                "Deviation of film formulas from solved films; crossed: not solved to the wanted bar",
                partial(draw_formulas, maps=maps, columns=len(ratios)),
            ),
        ),
    )


def _maps(
    solutions: Mapping[tuple[float, float, float], ContactSolution],
    loads: tuple[float, ...],
    lubricant: tuple[float, ...],
    ratios: tuple[float, ...],
) -> list[FormulaMap]:
    """A map of each formula at each Rx/Ry."""
    maps = []
    for (name, (which, formula)), ratio in product(FORMULAS.items(), ratios):
        share = [[_deviation(formula, which, solutions[(ratio, l, m)]) for m in loads] for l in lubricant]
        title = f"{name}, $R_x/R_y$ {ratio:g}"
        maps.append(FormulaMap(title=title, loads=loads, lubricant=lubricant, share=np.array(share)))
    return maps


def _deviation(formula: Formula, which: str, solution: ContactSolution) -> float:
    """Formula over solved film less one [-]; NaN where the film is not known well enough."""
    assert isinstance(solution.conditions, ContactConditions)
    film = solution.film_central if which == "central" else solution.film_minimum
    if film is None or not (solution.converged and solution.resolved):
        return float("nan")
    return formula(solution.conditions) / film - 1.0


def _range(share: np.ndarray) -> str:
    if np.isnan(share).all():
        return "not solved"
    low = np.nanmin(share)
    high = np.nanmax(share)
    middle = np.nanmedian(abs(share))
    return f"{percent(low, 0)} to {percent(high, 0)}, {100.0 * middle:.0f} %"


def _named(options: SolverOptions) -> Table:
    """The same for the named contacts of a bearing."""
    named = [c for c in NAMED if c.name.startswith("6208") and c.box is None]
    solutions = each(lambda c: solve_contact(c.conditions, options), named)
    rows = []
    for contact, s in zip(named, solutions, strict=True):
        deviations = [percent(_deviation(formula, which, s), 1) for which, formula in FORMULAS.values()]
        rows.append((contact.name, f"{s.moes_load:.1f}", f"{s.moes_lubricant:.1f}", *deviations))
    return Table("Contacts of the 6208:", ("contact", "M", "L", *FORMULAS), tuple(rows))

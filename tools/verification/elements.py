"""Finite elements against multigrid."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from math import isfinite

import numpy as np

from oilfilm.ehl import ContactSolution, FilmValue, SolverOptions, solve_contact
from oilfilm.ehl.finite_element.solver import solve_contact_finite_element
from oilfilm.ehl.units import value_with_error

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, CIRCULAR_BOX, OIL, Named, from_groups, moes, race_6208
from .draws import Draw, draws
from .page import Check, Section, Table, columns, each, percent, text

# random contacts of the day: so many of those within what the elements are made for
DRAWS = 24
LARGEST_LOAD = 2000.0  # M
LARGEST_LUBRICANT = 28.0  # L
RATIO = (0.02, 4.0)  # R_x/R_y
COMPARED = 35  # contacts that both resolve, at least
LEFT_OPEN = 1e-3  # of the film, beside the bars of both
LARGEST = "largest difference of the named contacts"
CONTACTS = (
    CIRCULAR_20_10,
    Named("M 20, L 2", moes(20.0, 2.0, oil=OIL), box=CIRCULAR_BOX),
    Named("M 100, L 10, R_x/R_y 0.1", moes(100.0, 10.0, 0.1, oil=OIL)),
    CIRCULAR_200_10,
    Named("M 5, L 10", moes(5.0, 10.0, oil=OIL)),
    Named("M 5, L 0", moes(5.0, 0.0, oil=OIL)),
    Named("M 500, L 5, R_x/R_y 0.1", moes(500.0, 5.0, 0.1, oil=OIL)),
    Named("M 2000, L 10, R_x/R_y 0.03", moes(2000.0, 10.0, 0.03, oil=OIL)),
    Named("M 100, L 5, R_x/R_y 3", moes(100.0, 5.0, 3.0, oil=OIL)),
    Named("M 20, L 5, R_x/R_y 0.4, entrainment at 0.6 rad", moes(20.0, 5.0, 0.4, 0.6, oil=OIL)),
    Named("M 100, L 10, R_x/R_y 0.2, turning", from_groups(moes(100.0, 10.0, 0.2, oil=OIL), rotation=0.3)),
)

RACES = tuple(
    Named(f"6208 {'outer' if outer else 'inner'} race, {load:.0f} N", race_6208(load, outer))
    for load, outer in ((1596.3, False), (916.2, False), (300.0, False), (1611.8, True), (931.7, True), (15.48, True))
)


@dataclass(frozen=True, slots=True)
class Pair:
    """A contact solved by both discretisations."""

    contact: Named
    grid: ContactSolution
    mesh: ContactSolution

    @property
    def compared(self) -> bool:
        """Whether both resolve it."""
        return all(s.converged and s.resolved for s in (self.grid, self.mesh))

    def difference(self, kind: str) -> float:
        """Film of the elements over that of the multigrid, less 1 [-]."""
        ours, theirs = self._films(kind)
        return theirs.value / ours.value - 1.0

    def over_bars(self, kind: str) -> float:
        """Difference over the error bars of both and 0.1 % of the film [-]."""
        ours, theirs = self._films(kind)
        allowed = ours.uncertainty + theirs.uncertainty + LEFT_OPEN * ours.value
        return abs(theirs.value - ours.value) / allowed

    @property
    def cells(self) -> tuple[str, ...]:
        """A row of the table."""
        box = self.contact.box
        cells = [self.contact.name, "open" if box is None else ", ".join(f"{end:g}" for end in box)]
        for kind in ("central", "minimum"):
            films = self._films(kind)
            cells += [value_with_error(f.value, f.uncertainty) if isfinite(f.value) else "none" for f in films]
            known = all(isfinite(f.value) for f in films)
            cells.append(percent(self.difference(kind), 2) if known else "")
        return tuple(cells)

    def _films(self, kind: str) -> tuple[FilmValue, FilmValue]:
        ours, theirs = (getattr(s, f"film_{kind}_dimensionless") for s in (self.grid, self.mesh))
        return ours, theirs


def elements(quick: bool = False) -> Section:
    """Films of both discretisations: named contacts, races of a 6208, random ones of the day."""
    seed = seed_of_today()
    points = (129, 129) if quick else (513, 257)
    named = CONTACTS[:1] if quick else CONTACTS
    others = () if quick else (*RACES, *random_contacts(seed))
    pairs = each(lambda c: _both(c, points), (*named, *others))
    checks = [
        Check(f"finite elements, {kind} film, {LARGEST}", _largest(pairs[: len(named)], kind), most=most)
        for kind, most in (("central", 0.01), ("minimum", 0.02))
    ]
    if not quick:
        compared = [pair for pair in pairs if pair.compared]
        largest = max(p.over_bars(kind) for p in compared for kind in ("central", "minimum"))
        checks += [
            Check("finite elements: contacts that both resolve", len(compared), least=COMPARED),
            Check("finite elements: difference over both bars and 0.1 %", largest, most=1.0),
        ]
    head = columns("contact | box | H_c, multigrid | H_c, elements |  | H_min, multigrid | H_min, elements | ")
    lines = (points[1] + 1) // 2
    meshes = f"multigrid {points[0]} points, elements about {lines} lines of nodes"
    chosen = "" if quick else f"; the last {DRAWS} drawn by seed {seed}"
    caption = f"Films in units of a²/R_x; {meshes}{chosen}:"
    return Section(
        title="Finite elements",
        text=text("elements"),
        checks=tuple(checks),
        tables=(Table(caption, head, tuple(pair.cells for pair in pairs), slice(8, 17, 3)),),
    )


def _largest(pairs: Sequence[Pair], kind: str) -> float:
    """Largest difference of the films; not a number if one of them has none."""
    return float(np.max([abs(pair.difference(kind)) for pair in pairs]))


def seed_of_today() -> int:
    """Year, month and day in one number."""
    return int(date.today().strftime("%Y%m%d"))


def random_contacts(seed: int) -> tuple[Named, ...]:
    """The first draws within what the elements are made for."""
    suitable = [draw for draw in draws(20 * DRAWS, seed) if _suits(draw)]
    return tuple(Named(draw.text, draw.conditions) for draw in suitable[:DRAWS])


def _suits(draw: Draw) -> bool:
    g = draw.groups
    heavy = g.load_parameter > LARGEST_LOAD or g.lubricant_parameter > LARGEST_LUBRICANT
    return not heavy and RATIO[0] <= g.radius_ratio <= RATIO[1]


def _both(contact: Named, points: tuple[int, int]) -> Pair:
    options = [SolverOptions(points=n, domain=contact.box) for n in points]
    grid = solve_contact(contact.conditions, options[0])
    return Pair(contact, grid, solve_contact_finite_element(contact.conditions, options[1], grid))

"""Multigrid and Newton's method over the thickness of the layer."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from oilfilm.ehl import ContactSolution, MoesConditions, SolverOptions, solve_contact
from oilfilm.ehl.multigrid.supply.oil_supply import starved_film_guess
from oilfilm.ehl.oil.lubricant import InletLayer
from oilfilm.ehl.scaling import ScaledContact, scale_contact

from ..contacts import OIL, Box, moes
from ..page import Check, Section, Table, columns, each, percent, text
from .cells import Cells, cells_of
from .newton import Solved, hertz_start, solve

RATIOS = (5.0, 2.0, 1.0, 0.6, 0.4, 0.2)  # r, the layer over the oil of the flooded film
POINTS = 257  # of the multigrid along x
LEAST_RATIO = 0.6  # from which on the minimum film is compared
MOST_CENTRAL = 0.01
MOST_MINIMUM = 0.025
MOST_OUTLET = 0.02  # of the layer that leaves, root of the mean square over the flooded film's


@dataclass(frozen=True, slots=True, kw_only=True)
class Compared:
    """A contact, its box in Hertz half-extents, and the cells of its upper half."""

    name: str
    conditions: MoesConditions
    box: Box
    cells: tuple[int, int]


CONTACTS = (
    Compared(name="M 20, L 10", conditions=moes(20.0, 10.0, oil=OIL), box=(-6.0, 1.6, 3.5), cells=(122, 56)),
    Compared(name="M 200, L 10", conditions=moes(200.0, 10.0, oil=OIL), box=(-4.0, 1.5, 2.5), cells=(154, 70)),
    Compared(
        name="M 100, L 10, R_x/R_y 0.3",
        conditions=moes(100.0, 10.0, 0.3, oil=OIL),
        box=(-4.0, 1.5, 2.0),
        cells=(132, 60),
    ),
    Compared(
        name="M 200, L 10, R_x/R_y 0.095",
        conditions=moes(200.0, 10.0, 0.095, oil=OIL),
        box=(-4.0, 1.5, 1.22),
        cells=(132, 56),
    ),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shares:
    """What a layer leaves of the flooded films [-]."""

    central: float
    minimum: float
    meniscus: float | None  # in semi-axes a
    outlet: float  # that leaves on the centre line over the flooded film's oil


def starvation(quick: bool = False) -> Section:
    """Both solutions side by side."""
    contacts = CONTACTS[:1] if quick else CONTACTS
    ratios = (1.0, 0.4) if quick else RATIOS
    checks = []
    tables = []
    for contact in contacts:
        by_newton = shares_by_newton(contact, ratios, coarse=quick)
        points = 129 if quick else POINTS
        by_multigrid = each(partial(shares_by_multigrid, contact, points), ratios)
        rows = []
        for r, ours, theirs in zip(ratios, by_multigrid, by_newton, strict=True):
            rows.append(_row(r, ours, theirs))
            checks += _checks(f"{contact.name}, r {r:g}", r, ours, theirs)
        head = columns(
            "r | R, multigrid | R, Newton |  | R_min, multigrid | R_min, Newton |  | "
            "meniscus, multigrid | Newton | layer behind, multigrid | Newton"
        )
        nx, ny = contact.cells
        caption = f"{contact.name}, multigrid {points} points, {nx} × {ny} cells:"
        tables.append(Table(caption, head, tuple(rows), slice(1, None, 2)))
    return Section(
        title="Contacts behind a layer of oil", text=text("starvation"), checks=tuple(checks), tables=tuple(tables)
    )


def _row(r: float, ours: Shares, theirs: Shares) -> tuple[str, ...]:
    cells = [f"{r:g}"]
    for name in ("central", "minimum"):
        values = [getattr(side, name) for side in (ours, theirs)]
        cells += [f"{value:.4f}" for value in values]
        cells.append(percent(values[1] / values[0] - 1.0, 2))
    cells += ["box" if s.meniscus is None else f"{s.meniscus:.2f}" for s in (ours, theirs)]
    return (*cells, f"{ours.outlet:.4f}", f"{theirs.outlet:.4f}")


def _checks(name: str, r: float, ours: Shares, theirs: Shares) -> list[Check]:
    central = abs(theirs.central / ours.central - 1.0)
    checks = [Check(f"share of the central film, {name}", central, most=MOST_CENTRAL)]
    if r >= LEAST_RATIO:
        minimum = abs(theirs.minimum / ours.minimum - 1.0)
        checks.append(Check(f"share of the minimum film, {name}", minimum, most=MOST_MINIMUM))
    outlet = abs(theirs.outlet - ours.outlet) / min(r, 1.0)
    checks.append(Check(f"layer left behind, {name}", outlet, most=MOST_OUTLET))
    return checks


def shares_by_newton(contact: Compared, ratios: tuple[float, ...], *, coarse: bool = False) -> list[Shares]:
    """By Newton's method: the flooded film from Hertz' pressure, each layer from the solution
    before or, where that fails, from Hertz' pressure.
    """
    scaled = scale_contact(contact.conditions)
    x_in, x_out, y_half = contact.box
    nx, ny = (count // 2 if coarse else count for count in contact.cells)
    half = scaled.half_extent_y
    cells = cells_of((x_in, x_out, y_half * half), nx, ny)
    flooded = _from_hertz(scaled, cells, np.inf, scaled.film_guess)
    oil = flooded.central_film * _density(flooded.central_pressure, scaled)
    shares = []
    thin = flooded
    for r in ratios:
        try:
            thin = solve(scaled, cells, r * oil, thin.fields)
        except ArithmeticError:
            guess = starved_film_guess(flooded.central_film, r)
            thin = _from_hertz(scaled, cells, r * oil, guess)
        shares.append(
            Shares(
                central=thin.central_film / flooded.central_film,
                minimum=thin.minimum_film / flooded.minimum_film,
                meniscus=thin.meniscus,
                outlet=float(1.125 * thin.outlet[0] - 0.125 * thin.outlet[1]) / oil,
            )
        )
    return shares


def _from_hertz(scaled: ScaledContact, cells: Cells, layer: float, guess: float) -> Solved:
    guessed = replace(scaled, film_guess=guess)
    return solve(guessed, cells, layer, hertz_start(guessed, cells, layer))


def _density(P: float, scaled: ScaledContact) -> float:
    return 1.0 + scaled.density_numerator * P / (1.0 + scaled.density_denominator * P)


def shares_by_multigrid(contact: Compared, points: int, r: float) -> Shares:
    """By the solver of the program, as a user calls it."""
    options = SolverOptions(points=points, domain=contact.box)
    unit = solve_with_layer(contact, 1.0, SolverOptions(points=65, domain=contact.box))
    oil = 1.0 / _ratio(unit)
    # the flooded film of these points, not of the coarse ones, makes r
    found = solve_with_layer(contact, r * oil, options)
    found = solve_with_layer(contact, r * r * oil / _ratio(found), options)
    supply = found.supply
    assert supply is not None and supply.outlet_layer is not None
    layer = found.conditions.inlet_layer
    assert layer is not None
    return Shares(
        central=found.film_central_dimensionless.value / supply.flooded_central.value,
        minimum=found.film_minimum_dimensionless.value / supply.flooded_minimum.value,
        meniscus=supply.meniscus,
        outlet=float(supply.outlet_layer[found.Y.size // 2]) * supply.inlet_ratio / layer.central,
    )


def solve_with_layer(contact: Compared, layer: float, options: SolverOptions) -> ContactSolution:
    """Behind a layer in units of a^2/Rx [-]."""
    conditions = replace(contact.conditions, inlet_layer=InletLayer(thickness=(layer,)))
    return solve_contact(conditions, options)


def _ratio(solution: ContactSolution) -> float:
    assert solution.supply is not None
    return solution.supply.inlet_ratio

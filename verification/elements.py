"""Finite elements against multigrid."""

from ehl import ContactSolution, SolverOptions, solve_contact
from ehl.finite_element.solver import solve_contact_finite_element
from postprocess.text import value_with_error

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, CIRCULAR_BOX, OIL, Named, moes
from .page import Check, Section, Table, columns, each, percent, text

CONTACTS = (
    CIRCULAR_20_10,
    Named("M 20, L 2", moes(20.0, 2.0, oil=OIL), box=CIRCULAR_BOX),
    Named("M 100, L 10, R_x/R_y 0.1", moes(100.0, 10.0, 0.1, oil=OIL)),
    CIRCULAR_200_10,
    Named("M 5, L 10", moes(5.0, 10.0, oil=OIL)),
)


def elements(quick: bool = False) -> Section:
    """Films of both discretisations."""
    contacts = CONTACTS[:1] if quick else CONTACTS
    points = (129, 129) if quick else (513, 257)
    rows = []
    checks = []
    solutions = each(lambda c: _both(c, points), contacts)
    for contact, (grid, mesh) in zip(contacts, solutions, strict=True):
        box = "open" if contact.box is None else ", ".join(f"{end:g}" for end in contact.box)
        cells = [contact.name, box]
        for kind, most in (("central", 0.01), ("minimum", 0.02)):
            ours, theirs = (getattr(s, f"film_{kind}_dimensionless") for s in (grid, mesh))
            difference = theirs.value / ours.value - 1.0
            cells += [value_with_error(s.value, s.uncertainty) for s in (ours, theirs)]
            cells.append(percent(difference, 2))
            name = f"finite elements, {kind} film, {contact.name}"
            checks.append(Check(name, abs(difference), most=most))
        rows.append(tuple(cells))
    head = columns(
        "contact | box | H_c, multigrid | H_c, elements |  | H_min, multigrid | H_min, elements | "
    )
    lines = (points[1] + 1) // 2
    caption = (
        f"Films in units of a²/R_x; multigrid {points[0]} points, elements {lines} lines of nodes:"
    )
    return Section(
        title="Finite elements",
        text=text("elements"),
        checks=tuple(checks),
        tables=(Table(caption, head, tuple(rows)),),
    )


def _both(contact: Named, points: tuple[int, int]) -> tuple[ContactSolution, ContactSolution]:
    grid, mesh = (SolverOptions(points=n, domain=contact.box) for n in points)
    return solve_contact(contact.conditions, grid), solve_contact_finite_element(
        contact.conditions, mesh
    )

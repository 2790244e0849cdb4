"""Finite elements against multigrid."""

from ehl import ContactSolution, SolverOptions, solve_contact
from ehl.finite_element.solver import solve_contact_finite_element
from postprocess.text import value_with_error

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, CIRCULAR_BOX, OIL, Named, from_groups, moes
from .page import Check, Section, Table, columns, each, percent, text

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
    Named(
        "M 100, L 10, R_x/R_y 0.2, turning",
        from_groups(moes(100.0, 10.0, 0.2, oil=OIL), rotation=0.3),
    ),
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
    meshes = f"multigrid {points[0]} points, elements about {lines} lines of nodes"
    caption = f"Films in units of a²/R_x; {meshes}:"
    return Section(
        title="Finite elements",
        text=text("elements"),
        checks=tuple(checks),
        tables=(Table(caption, head, tuple(rows)),),
    )


def _both(contact: Named, points: tuple[int, int]) -> tuple[ContactSolution, ContactSolution]:
    options = [SolverOptions(points=n, domain=contact.box) for n in points]
    grid = solve_contact(contact.conditions, options[0])
    return grid, solve_contact_finite_element(contact.conditions, options[1], grid)

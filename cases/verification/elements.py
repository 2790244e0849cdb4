"""Finite elements against multigrid."""

from ehl import ContactSolution, SolverOptions, solve_contact
from ehl.finite_element.solver import solve_contact_finite_element

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, CIRCULAR_BOX, OIL, Named, moes
from .page import Check, Section, Table, each, percent, with_bar

CONTACTS = (
    CIRCULAR_20_10,
    Named(name="M 20, L 2", conditions=moes(20.0, 2.0, oil=OIL), box=CIRCULAR_BOX),
    Named(name="M 100, L 10, R_x/R_y 0.1", conditions=moes(100.0, 10.0, 0.1, oil=OIL)),
    CIRCULAR_200_10,
    Named(name="M 5, L 10", conditions=moes(5.0, 10.0, oil=OIL)),
)
TEXT = """\
The solution by finite elements shares with the multigrid the dimensionless problem and the box, and neither mesh,
discrete equations, deflection, treatment of cavitation nor iteration ([finite_element.md](../theory/finite_element.md)
has the whole comparison)."""


def elements(quick: bool = False) -> Section:
    """Films of both discretisations."""
    contacts = CONTACTS[:1] if quick else CONTACTS
    points = (129, 129) if quick else (513, 257)
    rows, checks = [], []
    for contact, (grid, mesh) in zip(
        contacts, each(lambda c: _both(c, points), contacts), strict=True
    ):
        cells = [
            contact.name,
            "open" if contact.box is None else ", ".join(f"{end:g}" for end in contact.box),
        ]
        for kind, most in (("central", 0.01), ("minimum", 0.02)):
            ours, theirs = (getattr(s, f"film_{kind}_dimensionless") for s in (grid, mesh))
            difference = theirs.value / ours.value - 1.0
            cells += [with_bar(s.value, s.uncertainty) for s in (ours, theirs)] + [
                percent(difference, 2)
            ]
            checks.append(
                Check(
                    name=f"finite elements, {kind} film, {contact.name}",
                    value=abs(difference),
                    most=most,
                )
            )
        rows.append(tuple(cells))
    head = (
        "contact",
        "box",
        "H_c, multigrid",
        "H_c, elements",
        "",
        "H_min, multigrid",
        "H_min, elements",
        "",
    )
    caption = f"Films in units of a²/R_x; multigrid {points[0]} points, elements {(points[1] + 1) // 2} lines of nodes:"
    return Section(
        title="Finite elements",
        text=TEXT,
        checks=tuple(checks),
        tables=(Table(caption=caption, head=head, rows=tuple(rows)),),
    )


def _both(contact: Named, points: tuple[int, int]) -> tuple[ContactSolution, ContactSolution]:
    grid, mesh = (SolverOptions(points=n, domain=contact.box) for n in points)
    return solve_contact(contact.conditions, grid), solve_contact_finite_element(
        contact.conditions, mesh
    )

"""Films of catalogue bearings under rising load: within their bars, and falling with the load."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ehl import ContactConditions, ContactSolution, SolverOptions, solve_contact
from postprocess.text import value_with_error

from .page import Check, Section, Table, columns, each, text

POINTS = 1025  # of the films that those of the program untold are judged by
COVERED = 0.95  # least share of the films within the bars of both


@dataclass(frozen=True, slots=True, kw_only=True)
class CatalogueContact:
    """The heaviest contact of a bearing at one race under one of several loads."""

    bearing: str
    race: str
    conditions: ContactConditions


Contacts = Callable[[bool], Sequence[Sequence[CatalogueContact]]]


def bearings(quick: bool, contacts: Contacts) -> Section:
    """Films of the contacts as solved untold and on 1025 points; `contacts` of few bearings or of
    all: for each bearing and race those of rising load.
    """
    groups = contacts(quick)
    options = [SolverOptions(), *([] if quick else [SolverOptions(points=POINTS)])]
    jobs = [(contact, option) for group in groups for contact in group for option in options]
    solutions = iter(each(lambda job: solve_contact(job[0].conditions, job[1]), jobs))
    rows = []
    rising = 0
    flagged = 0
    within: list[bool] = []
    for group in groups:
        solved = [[next(solutions) for _ in options] for _ in group]
        untold = [pair[0] for pair in solved]
        flagged += sum(s.message != "converged" for s in untold)
        for name in ("film_central", "film_minimum"):
            rising += not _falls(untold, name)
            within += [_agree(pair, name) for pair in solved]
        cells = [
            cell
            for contact, s in zip(group, untold, strict=True)
            for cell in (f"{contact.conditions.load:.0f}", *_films(s))
        ]
        rows.append((group[0].bearing, group[0].race, *cells))
    head = columns("bearing | race" + " | Q, N | h_c, µm | h_min, µm" * len(groups[0]))
    checks = (
        Check("films that do not fall with the load, of catalogue bearings", rising, most=0.0),
        Check(
            f"of {len(within)} films of catalogue bearings within the bars of {POINTS} points",
            sum(within) / max(len(within), 1),
            least=COVERED,
        ),
        Check("contacts of catalogue bearings that are flagged", flagged, most=0.0),
    )
    caption = "Heaviest contact at each race, films as solved untold:"
    return Section(
        title="Catalogue bearings",
        text=text("bearings"),
        checks=checks,
        tables=(Table(caption, head, tuple(rows)),),
    )


def _films(solution: ContactSolution) -> tuple[str, str]:
    micrometres = 1e6 * (solution.film_scale or 0.0)
    films = (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    central, minimum = (
        value_with_error(micrometres * f.value, micrometres * f.uncertainty) for f in films
    )
    return central, minimum


def _falls(solutions: Sequence[ContactSolution], name: str) -> bool:
    """Whether a film falls from load to load, its bars left out."""
    films = [getattr(s, name) for s in solutions]
    return all(
        light is not None and heavy is not None and heavy < light
        for light, heavy in zip(films[:-1], films[1:], strict=True)
    )


def _agree(pair: Sequence[ContactSolution], name: str) -> bool:
    """Whether two solutions of a contact agree within their bars."""
    one, other = (getattr(s, f"{name}_dimensionless") for s in (pair[0], pair[-1]))
    return bool(abs(one.value - other.value) <= one.uncertainty + other.uncertainty)

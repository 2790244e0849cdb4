"""Grid-converged films of named contacts, each with its box, its mesh and its error bar."""

from math import degrees

from oilfilm.ehl import ContactSolution, SolverOptions, solve_contact
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.units import value_with_error

from .contacts import NAMED, Named
from .page import Check, Section, Table, each, text

FILMS = ("film_central_dimensionless", "film_minimum_dimensionless")
REFERENCE = (0.430856, 0.29259)  # both films of M 20, L 10 in the box -4.5, 1.5, 3
HEAD = (
    *("contact", "box", "grid", "H_c, a²/R_x", "H_min, a²/R_x", "h_c, µm", "h_min, µm"),
    *("H_min/(S h_x²)", "off/bar"),
)
POINTS = (257, 1025)
FEW_POINTS = (129, 257)


def named_films(quick: bool = False) -> Section:
    """Films of the named contacts on fine grids."""
    coarse, fine = FEW_POINTS if quick else POINTS
    named = NAMED[:2] if quick else NAMED
    jobs = [(contact, points) for points in (fine, coarse) for contact in named]
    solutions = each(_solve, jobs)
    rows = []
    covered = []
    for contact, best, rough in zip(named, solutions[: len(named)], solutions[len(named) :], strict=True):
        ratios = [_error_over_bar(rough, best, film) for film in FILMS]
        if rough.resolved and rough.converged:
            covered += ratios
        rows.append(_row(contact, best, ratios))
    known = sum(s.converged and s.resolved for s in solutions[: len(named)]) / len(named)
    checks = (
        Check(f"named contacts: largest error of {coarse} points over its bar", max(covered), most=1.0),
        Check("named contacts converged and resolved, share", known, least=1.0),
        *_reference_checks(solutions[0], 2e-3 if quick else 2e-4),
    )
    caption = f"{fine} points along x, judged by it {coarse}:"
    return Section(
        title="Grid-converged films",
        text=text("films"),
        checks=checks,
        tables=(Table(caption, HEAD, tuple(rows), slice(1, None, 4)),),
    )


def _reference_checks(circle: ContactSolution, within: float) -> list[Check]:
    """M 20, L 10 in its box against the team's earlier study by the same family of methods."""
    checks = []
    for film, reference in zip(FILMS, REFERENCE, strict=True):
        difference = abs(getattr(circle, film).value / reference - 1.0)
        kind = film.split("_")[1]
        name = f"{kind} film of M 20, L 10 against the earlier study, relative difference"
        checks.append(Check(name, difference, most=within))
    return checks


def _solve(job: tuple[Named, int]) -> ContactSolution:
    contact, points = job
    return solve_contact(contact.conditions, SolverOptions(points=points, domain=contact.box))


def _error_over_bar(rough: ContactSolution, best: ContactSolution, film: str) -> float:
    """Distance of the coarser value from the finer one over both bars [-]."""
    first, second = getattr(rough, film), getattr(best, film)
    return float(abs(first.value - second.value) / (first.uncertainty + second.uncertainty))


def _row(contact: Named, s: ContactSolution, ratios: list[float]) -> tuple[str, ...]:
    central, minimum = (getattr(s, film) for film in FILMS)
    scale = scale_contact(s.conditions)
    fineness = minimum.finest / (scale.curvature_x * float(s.X[1] - s.X[0]) ** 2)
    box = ", ".join(f"{end:.4g}" for end in s.domain)
    unit = None if s.film_scale is None else 1e6 * s.film_scale
    films = ((film.value, film.uncertainty) for film in (central, minimum))
    lengths = ["" if unit is None else value_with_error(unit * value, unit * bar) for value, bar in films]
    turned = f", grid at {degrees(s.frame_angle):.0f}°" if s.frame_angle else ""
    return (
        contact.name,
        box if contact.box is not None else f"open: {box}",
        f"{s.X.size} × {s.Y.size}{turned}",
        value_with_error(central.value, central.uncertainty),
        value_with_error(minimum.value, minimum.uncertainty),
        *lengths,
        f"{fineness:.0f}" if s.resolved else f"{fineness:.1f}, unresolved",
        ", ".join(f"{ratio:.2f}" for ratio in ratios),
    )

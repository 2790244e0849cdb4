"""Observed orders of films on a sequence of grids and of parts of the discretisation."""

from functools import partial
from math import log2, pi

import numpy as np

from oilfilm.ehl.closed_form.hertz import ellipse_ratio, hertz_coefficients
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid import _reynolds_kernels
from oilfilm.ehl.multigrid.far_field import far_field
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solid.deformation import deflect, deflection_kernel

from .contacts import CIRCULAR_20_10, CIRCULAR_200_10, INNER_500N, SPINNING, WATER_LIKE, Named, from_groups, moes
from .converged_films import ConvergedFilms, fully_converged_films
from .page import Check, Picture, Section, Table, columns, each, text
from .plots import Curve, draw_orders

POINTS = (65, 129, 257, 513, 1025)
FEW_POINTS = (65, 129, 257)
CONTACTS = (
    CIRCULAR_20_10,
    CIRCULAR_200_10,
    INNER_500N,
    Named("M 100, L 8, R_x/R_y 0.3, at 30°", moes(100.0, 8.0, 0.3, pi / 6.0), box=(-5.0, 2.0, 3.0)),
    Named("M 100, L 8, R_x/R_y 0.1, rotating", SPINNING.conditions, box=(-5.0, 1.5, 2.5)),
)
CELLS = (32, 64, 128, 256)
FILMS = ("central", "minimum")


def orders(quick: bool = False) -> Section:
    """Observed orders of films and of the parts of the discretisation."""
    points = FEW_POINTS if quick else POINTS
    contacts = CONTACTS[:1] if quick else CONTACTS
    jobs = [(contact, n) for n in reversed(points) for contact in contacts]
    films = each(lambda job: fully_converged_films(job[0].conditions, job[0].box, job[1]), jobs)
    sequences = {
        contact.name: sorted((f for (c, _), f in zip(jobs, films, strict=True) if c is contact), key=lambda f: f.points)
        for contact in contacts
    }
    rows = tuple(row for name, films in sequences.items() for row in _rows(name, films))
    part_table, part_checks = _part_table()
    checks = [
        Check(f"order of the central film, {name}, finest three grids", _last_order(films), least=1.7, most=2.3)
        for name, films in sequences.items()
    ]
    head = columns("contact | points along x | h_x | H_c | p | H_min | p | H_c, H_min extrapolated")
    curves = [
        Curve(label=f"{name}, {which}", x=tuple(f.hx for f in films[:-1]), y=_errors(films, which))
        for name, films in sequences.items()
        for which in FILMS
    ]
    caption = "Relative error of the films against the value extrapolated from the two finest grids"
    return Section(
        title="Orders",
        text=text("orders"),
        checks=(*checks, *part_checks),
        tables=(Table("Films in units of a²/R_x:", head, rows, slice(4, None, 5)), part_table),
        pictures=(Picture("verification_orders", caption, partial(draw_orders, curves=curves)),),
    )


def _part_table() -> tuple[Table, list[Check]]:
    """Errors of the parts of the discretisation."""
    rows = []
    checks = []
    for name, least, errors in _parts():
        order = log2(errors[-2] / errors[-1])
        rows.append((name, *(f"{error:.2e}" for error in errors), f"{order:.2f}"))
        checks.append(Check(f"order of the {name}", order, least=least, most=2.3))
    head = ("part", *(f"{cells} cells" for cells in CELLS), "p, last two")
    caption = "Parts by themselves, largest or root-mean-square error:"
    return Table(caption, head, tuple(rows), slice(0)), checks


def _rows(name: str, films: list[ConvergedFilms]) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for i, f in enumerate(films):
        p = ["", ""]
        if i > 1:
            p = [_order([getattr(g, which) for g in films[i - 2 : i + 1]]) for which in FILMS]
        last = ""
        if i == len(films) - 1:
            last = ", ".join(f"{_extrapolated(films, which):.5f}" for which in FILMS)
        grid = (name, str(f.points), f"{f.hx:.5f}")
        rows.append((*grid, f"{f.central:.5f}", p[0], f"{f.minimum:.5f}", p[1], last))
    return rows


def _order(values: list[float]) -> str:
    ratio = (values[1] - values[0]) / (values[2] - values[1])
    return f"{log2(ratio):.2f}" if ratio > 0.0 else "sign changes"


def _last_order(films: list[ConvergedFilms]) -> float:
    first, second, third = (f.central for f in films[-3:])
    ratio = (second - first) / (third - second)
    return log2(ratio) if ratio > 0.0 else float("nan")


def _extrapolated(films: list[ConvergedFilms], which: str) -> float:
    coarse, fine = (getattr(f, which) for f in films[-2:])
    return float(fine + (fine - coarse) / 3.0)


def _errors(films: list[ConvergedFilms], which: str) -> tuple[float, ...]:
    truth = _extrapolated(films, which)
    return tuple(abs(getattr(f, which) / truth - 1.0) for f in films[:-1])


def _parts() -> list[tuple[str, float, list[float]]]:
    """Name, required order, errors on grids of `CELLS` cells [-]."""
    parts = []
    for ratio in (1.0, 0.05):
        name = f"deflection under Hertz' pressure, R_x/R_y {ratio:g}"
        parts.append((name, 1.4, [_hertz_error(ratio, cells) for cells in CELLS]))
    for name, rotation in (
        ("Poiseuille term of Kapitza's pressure", 0.0),
        ("Poiseuille term of the far field with a rotation", 0.7),
    ):
        parts.append((name, 1.8, [_kapitza_error(rotation, cells) for cells in CELLS]))
    return parts


def _hertz_error(ratio: float, cells: int) -> float:
    """Root-mean-square departure of the deflected gap from a constant inside the ellipse [-]."""
    k, (f, g, d) = ellipse_ratio(ratio), hertz_coefficients(ratio)
    grid = Grid(x_in=-2.0, hx=4.0 / cells, hy=4.0 * k / cells, nx=cells + 1, ny=cells // 2 + 1, symmetric=True)
    X = grid.X[None, :]
    Y = grid.Y[:, None]
    inside = X**2 + (Y / k) ** 2 < 1.0
    P = np.sqrt(np.maximum(1.0 - X**2 - (Y / k) ** 2, 0.0))
    gap = deflect(deflection_kernel(grid, 2.0 * g / (pi * f)), P) + 0.5 * X**2 + 0.5 * ratio * Y**2
    return float(np.sqrt(np.mean((gap[inside] - d / f**2) ** 2)))


def _kapitza_error(rotation: float, cells: int) -> float:
    """Largest difference of the discrete Poiseuille term and the Couette term it balances [-]."""
    contact = scale_contact(from_groups(moes(2.0, 1.0, 0.3, 0.4, oil=WATER_LIKE), rotation=rotation))
    grid = Grid(x_in=-4.0, hx=8.0 / cells, hy=8.0 / cells, nx=cells + 1, ny=cells + 1, symmetric=False)
    X = grid.X[None, :]
    Y = grid.Y[:, None]
    H = 1.5 + 0.5 * contact.curvature_x * X**2 + 0.5 * contact.curvature_y * Y**2
    k = far_field(contact)
    P = -(k.pressure_x * X + k.pressure_y * Y + k.pressure_xy * X * Y) / H**2
    u = contact.velocity_x - contact.rotation * Y
    v = contact.velocity_y + contact.rotation * X
    couette = u * contact.curvature_x * X + v * contact.curvature_y * Y
    eps = H**3 / contact.speed
    no_flow = np.zeros_like(P)
    left = np.empty_like(P)
    _reynolds_kernels.reynolds_operator(P, H, eps, no_flow, None, grid.hx, grid.hy, False, left)
    return float(np.abs(left - couette)[1:-1, 1:-1].max())

"""Rigid surfaces, isoviscous oil: films beside Kapitza's form and a direct solution."""

from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve

from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.scaling import scale_contact

from .asymptotes import asymptotes, film_unit
from .contacts import WATER_LIKE, Conditions, moes
from .page import Check, Section, Table, columns, each, text

Array = NDArray[np.float64]

LOADS = (4.0, 2.0, 1.0, 0.5, 0.25)  # M
RATIOS = (1.0, 0.1, 5.0)  # Rx/Ry
REACH = 300.0  # of the direct solution
STEPS = 300  # of the active set, which moves by a layer of nodes at a time


def rigid_limit(quick: bool = False) -> Section:
    """M to zero at L = 0: rigid surfaces, isoviscous oil."""
    points = 257 if quick else 1025
    ratios = RATIOS[:1] if quick else RATIOS
    jobs = [(m, ratio) for ratio in ratios for m in LOADS]
    solutions = each(
        lambda job: solve_contact(moes(job[0], 0.0, job[1], oil=WATER_LIKE), SolverOptions(points=points)), jobs
    )
    direct = each(lambda ratio: reynolds_over_sommerfeld(ratio, 48 if quick else 128), ratios)
    far = dict(zip(ratios, direct, strict=True))
    rows = []
    checks = []
    for (m, ratio), s in zip(jobs, solutions, strict=True):
        film = s.film_central_dimensionless
        half = half_kapitza(s.conditions)
        share = film.value / half
        fit = asymptotes(m, 0.0, ratio)["RI"] / film_unit(m, ratio) / half
        bar = film.uncertainty / half
        solved = f"{share:.4f} ± {bar:.4f}"
        rows.append((f"{ratio:g}", f"{m:g}", solved, f"{far[ratio]:.4f}", f"{fit:.3f}"))
        if m == LOADS[-1]:
            name = f"rigid film over the direct solution, R_x/R_y {ratio:g}, M {m:g}"
            within = 0.02 if quick else 0.005
            checks.append(Check(name, share / far[ratio], least=1.0 - within, most=1.0 + within))
    head = columns("R_x/R_y | M | solved | direct | fit RI")
    caption = f"Central film over that of half of Kapitza's pressure; {points} points, open box:"
    return Section(
        title="Rigid surfaces, isoviscous oil",
        text=text("rigid"),
        checks=tuple(checks),
        tables=(Table(caption, head, tuple(rows), slice(4, None, 5)),),
    )


def half_kapitza(conditions: Conditions) -> float:
    """Central film of the half-Sommerfeld solution on a rigid paraboloid [-], Kapitza (1955).

    The load is the integral over X < 0 of lambda |X|/((3 + 2 D) H^2), H = H_c + X^2/2 + D Y^2/2;
    with sqrt(D) Y for Y it is lambda/((3 + 2 D) sqrt(D)) times twice the integral of r^2/(H_c +
    r^2/2)^2 over r, pi/sqrt(2 H_c).
    """
    contact = scale_contact(conditions)
    d = contact.radius_ratio
    return (contact.speed * pi * sqrt(2.0 / d) / ((3.0 + 2.0 * d) * contact.load)) ** 2


def reynolds_over_sommerfeld(ratio: float, cells: int = 128, reach: float = REACH) -> float:
    """Central film with Reynolds' condition over that of half of Kapitza's pressure, at one load
    [-].

    Solves d_x(h^3 q_x) + D d_y(h^3 q_y) = 2 x, h = 1 + x^2 + y^2, x in sqrt(2 Hc), y in sqrt(2
    Hc/D), where Kapitza's solution is q = -x/((3 + 2 D) h^2); `cells` along y > 0, twice as many
    along x, out to `reach`, where half of it is the edge pressure. The film goes with the load
    squared.
    """
    x = _stretched(-1.0, 2 * cells, reach)
    y = _stretched(0.0, cells, reach)
    matrix, wedge, area = _finite_volumes(x, y, ratio)
    inner = np.zeros((x.size, y.size), dtype=bool)
    inner[1:-1, :-1] = True
    free = inner.ravel()
    kapitza = np.maximum(-x[:, None], 0.0) / (3.0 + 2.0 * ratio) / (1.0 + x[:, None] ** 2 + y**2) ** 2
    edge = np.where(inner, 0.0, kapitza).ravel()
    wet = free.copy()
    q = edge
    for _ in range(STEPS):
        rows = matrix[wet]
        q = edge.copy()
        q[wet] = spsolve(sparse.csc_matrix(rows[:, wet]), wedge[wet] - rows @ edge)
        after = free & np.where(wet, q > 0.0, matrix @ q - wedge > 0.0)
        if np.array_equal(after, wet):
            break
        wet = after
    half = 0.25 * pi / (3.0 + 2.0 * ratio)  # of Kapitza's pressure over x < 0 and y > 0
    return float((np.sum(q * area) + _beyond(x[-1], ratio)) / half) ** 2


def _stretched(first: float, cells: int, reach: float) -> Array:
    """Nodes from `first` (0 or -1) times `reach` to `reach`, growing as sinh [-]."""
    end = float(np.arcsinh(reach))
    return np.asarray(np.sinh(np.linspace(first * end, end, cells + 1)))


def _beyond(reach: float, ratio: float) -> float:
    """Integral of half of Kapitza's pressure outside the box, y > 0 [-]."""
    angle = (np.arange(400) + 0.5) * 0.5 * pi / 400
    radius = reach / np.maximum(np.cos(angle), np.sin(angle))
    return float(np.sum(np.cos(angle) / radius) * 0.5 * pi / 400 / (3.0 + 2.0 * ratio))


def _finite_volumes(x: Array, y: Array, ratio: float) -> tuple[Any, Array, Array]:
    """Matrix of the left side, right side and areas of the cells around the nodes [-]."""
    xm, ym = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
    west = np.concatenate((x[:1], xm))
    east = np.concatenate((xm, x[-1:]))
    width = east - west
    height = np.diff(np.concatenate((y[:1], ym, y[-1:])))
    number = np.arange(x.size * y.size).reshape(x.size, y.size)
    along = (1.0 + xm[:, None] ** 2 + y**2) ** 3 / np.diff(x)[:, None] * height
    across = ratio * (1.0 + x[:, None] ** 2 + ym**2) ** 3 / np.diff(y) * width[:, None]
    first = np.concatenate((number[:-1].ravel(), number[:, :-1].ravel()))
    second = np.concatenate((number[1:].ravel(), number[:, 1:].ravel()))
    flow = np.concatenate((along.ravel(), across.ravel()))
    rows = np.concatenate((first, second, first, second))
    columns = np.concatenate((second, first, first, second))
    matrix = sparse.csr_matrix((np.concatenate((flow, flow, -flow, -flow)), (rows, columns)))
    wedge = (east**2 - west**2)[:, None] * height
    return matrix, wedge.ravel(), (width[:, None] * height).ravel()

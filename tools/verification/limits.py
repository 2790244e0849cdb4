"""Known limits: Hertz' pressure, one contact posed in several ways, the size of the box."""

from dataclasses import replace
from functools import partial
from math import pi, sqrt

import numpy as np

from oilfilm.ehl import ContactConditions, ContactSolution, MoesConditions, SolverOptions, solve_contact
from oilfilm.ehl.conditions import moes_groups
from oilfilm.ehl.multigrid.history import CENTRAL
from oilfilm.ehl.units import MICROMETRE

from .contacts import CIRCULAR_20_10, CIRCULAR_BOX, MINERAL_OIL, OIL, Box, Conditions, from_groups, moes, race_6208
from .converged_films import solve_in_box
from .page import Check, Picture, Section, Table, columns, each, percent, text
from .plots import Curve, draw_hertz

SLOWER = (1.0, 4.0, 16.0, 64.0, 256.0)  # speed of M 20, L 10 divided by this
BOX_CAPTION = """\
Central film in units of a²/R_x at one mesh size; boxes of 3, 5 and 18 semi-axes upstream,
and their multiples:"""


def hertz_limit(quick: bool = False) -> Section:
    """Speed to zero at constant load: the pressure tends to Hertz', the approach to his."""
    slower = SLOWER[:3] if quick else SLOWER
    points = 129 if quick else 1025
    contacts = [moes(20.0 * s**0.75, 10.0 * s**-0.25, oil=OIL) for s in slower]
    solutions = each(lambda c: solve_contact(c, SolverOptions(points=points, domain=CIRCULAR_BOX)), contacts)
    head = columns("M | L | H_c | rms of P − P_Hertz | P(0, 0) | approach | approach, formula | resolved")
    curves = [
        Curve(label=f"M {s.moes_load:.0f}, L {s.moes_lubricant:.1f}", x=tuple(s.X), y=tuple(s.P[:, s.Y.size // 2]))
        for s in solutions
        if s.resolved
    ]
    caption = f"Constant load, falling speed, {points} points:"
    return Section(
        title="Hertz as the speed goes to zero",
        text=text("hertz"),
        checks=_hertz_checks([s for s in solutions if s.resolved], 0.5 if quick else 0.2),
        tables=(Table(caption, head, tuple(_hertz_row(s) for s in solutions), slice(0, None, 2)),),
        pictures=(
            Picture(
                "verification_hertz",
                "Pressure along the centre line at one load and falling speed, Hertz' dashed",
                partial(draw_hertz, curves=curves),
            ),
        ),
    )


def _hertz_row(s: ContactSolution) -> tuple[str, ...]:
    m, l = s.moes_load, s.moes_lubricant
    film = s.film_central_dimensionless.value
    others = (_distance(s), _centre(s), -s.approach_dimensionless.value, approach_formula(m, l))
    known = "yes" if s.resolved else "no"
    return (f"{m:.1f}", f"{l:.3f}", f"{film:.5f}", *(f"{number:.4f}" for number in others), known)


def _hertz_checks(resolved: list[ContactSolution], share: float) -> tuple[Check, ...]:
    """Checks on the resolved solutions, fastest first."""
    fitted = [s for s in resolved if s.moes_load <= 1000.0]
    misses = [-s.approach_dimensionless.value / approach_formula(s.moes_load, s.moes_lubricant) - 1.0 for s in fitted]
    first = resolved[0]
    last = resolved[-1]
    return (
        Check(
            "distance to Hertz' pressure, last resolved over first, as the speed goes to zero",
            _distance(last) / _distance(first),
            most=share,
        ),
        Check("pressure at the centre over Hertz', slowest resolved", _centre(last), least=0.99, most=1.01),
        Check(
            "approach against the formula for M 20 to 1000, largest difference",
            max(abs(miss) for miss in misses),
            most=0.01,
        ),
    )


def approach_formula(m: float, l: float) -> float:
    """Approach over Hertz' of a circular contact [-], 1 - p M^q, Venner and Lubrecht (2000)."""
    p = ((4.0 - 0.2 * l) ** 7 + (3.5 + 0.1 * l) ** 7) ** (1 / 7)
    return float(1.0 - p * m ** (-(0.6 + 0.6 / sqrt(l + 3.0))))


def _distance(s: ContactSolution) -> float:
    hertz = np.sqrt(np.maximum(1.0 - s.X[:, None] ** 2 - s.Y[None, :] ** 2, 0.0))
    inside = s.X[:, None] ** 2 + s.Y[None, :] ** 2 < 4.0
    return float(np.sqrt(np.mean((s.P - hertz)[inside] ** 2)))


def _centre(s: ContactSolution) -> float:
    return float(s.P[int(abs(s.X).argmin()), int(abs(s.Y).argmin())])


def same_contact(quick: bool = False) -> Section:
    """One contact posed in different ways, and in boxes of different size."""
    points = 129 if quick else 257
    rows = []
    checks = []
    for name, one, other, limit in _pairs():
        first, second = (_films(conditions, box, points) for conditions, box in (one, other))
        difference = max(abs(b / a - 1.0) for a, b in zip(first, second, strict=True))
        cells = (f"{central:.6g}, {minimum:.6g}" for central, minimum in (first, second))
        rows.append((name, *cells, f"{difference:.1e}"))
        checks.append(Check(f"films of {name}", difference, most=limit))
    head = columns("the same contact | central, minimum | central, minimum | difference")
    tables = [
        Table(
            f"Films of the finest grid, {points} points, in µm (first row) or in units of a²/R_x:",
            head,
            tuple(rows),
            slice(0),
        )
    ]
    if not quick:
        table, change = _boxes()
        tables.append(table)
        checks.append(Check("open box: largest change of the film when the box doubles", change, most=0.001))
    return Section(
        title="One contact, posed in different ways", text=text("same"), checks=tuple(checks), tables=tuple(tables)
    )


WIDE = (-8.0, 1.5, 2.25)  # box of the contact in SI and in Moes' groups
Posed = tuple[Conditions, "Box | None"]


def _pairs() -> list[tuple[str, Posed, Posed, float]]:
    si = ContactConditions(
        load=15.0,
        radius_x=0.0125,
        radius_y=0.05,
        reduced_modulus=110e9,
        entrainment_speed=0.09,
        lubricant=MINERAL_OIL,
        entrainment_angle=pi / 2,
    )
    exchanged = replace(si, radius_x=0.05, radius_y=0.0125, entrainment_angle=0.0)
    inner = race_6208(500.0)
    m, l = moes_groups(inner)
    groups = moes(m, l, inner.radius_x / inner.radius_y, oil=inner.lubricant)
    oblique = moes(100.0, 8.0, 0.3, 0.5)
    circle = CIRCULAR_20_10.conditions
    mirrored = replace(oblique, entrainment_angle=-0.5)
    spin, back = (from_groups(moes(100.0, 8.0, 0.1), rotation=r) for r in (0.3, -0.3))
    assert isinstance(circle, MoesConditions)
    box = (-4.5, 1.5, 3.0)
    turned = "entrainment at 90° and the principal directions exchanged"
    return [
        (turned, (si, box), (exchanged, box), 2e-3),
        ("6208 in SI and in Moes' groups", (inner, WIDE), (groups, WIDE), 1e-8),
        ("an entrainment and its mirror image", (oblique, None), (mirrored, None), 2e-3),
        ("a rotation and its mirror image", (spin, None), (back, None), 2e-3),
        ("a circle, entrainment at 0° and at 40°", (circle, box), (replace(circle, entrainment_angle=0.7), box), 2e-3),
    ]


def _films(conditions: Conditions, box: Box | None, points: int) -> tuple[float, float]:
    s = solve_contact(conditions, SolverOptions(points=points, domain=box))
    scale = s.film_scale
    unit = 1.0 if scale is None or box == WIDE else scale / MICROMETRE
    return unit * s.film_central_dimensionless.finest, unit * s.film_minimum_dimensionless.finest


BOX_CONTACTS = {  # M, L, Rx/Ry, smallest box
    "M 20, L 10": (20.0, 10.0, 1.0, (-3.0, 1.5, 2.0)),
    "M 5, L 0.5": (5.0, 0.5, 1.0, (-5.0, 2.5, 3.5)),
    "M 12, L 25, R_x/R_y 0.055 (thick film)": (12.0, 25.0, 0.055, (-18.0, 9.0, 7.0)),
}
# size of the box and the points that keep the mesh
BOX_SCALES = ((1.0, 65), (2.0, 129), (4.0, 257))


def _boxes() -> tuple[Table, float]:
    """Central film over the size of the box at one mesh size, and its last change."""
    jobs = [(name, is_open, *scale) for name in BOX_CONTACTS for is_open in (False, True) for scale in BOX_SCALES]
    films = each(lambda job: box_film(*job), jobs)
    rows = []
    changes = []
    for i in range(0, len(jobs), 3):
        name, is_open = jobs[i][:2]
        middle, large = films[i + 1 : i + 3]
        cells = (f"{f:.5f}" for f in films[i : i + 3])
        edge = "open" if is_open else "zero"
        rows.append((name, edge, *cells, percent(large / middle - 1.0, 2)))
        if is_open:
            changes.append(abs(large / middle - 1.0))
    head = columns("contact | edge pressure | box | box × 2 | box × 4 | last change")
    return Table(BOX_CAPTION, head, tuple(rows), slice(4, None)), max(changes)


def box_film(name: str, is_open: bool, scale: float, points: int) -> float:
    """Central film on the finest grid of a box [-]."""
    m, l, ratio, box = BOX_CONTACTS[name]
    conditions = moes(m, l, ratio, oil=OIL if ratio == 1.0 else race_6208(1.0).lubricant)
    domain = (scale * box[0], scale * box[1], scale * box[2])
    options = SolverOptions(points=points, domain=None if is_open else domain)
    return solve_in_box(conditions, options, domain).levels[-1].film[-1][CENTRAL]

"""Fields of the film atlas by one command: `python tools/atlas/fields.py [fit]`, solves, fits, errors.

Every contact is solved on 257 points, as traction tables solve their films, and kept in `build/atlas_fields`; a run
that was stopped goes on. After the word `fit` none is solved. Prints the errors of traction of the contacts that
judge, whose friction is that of steel (E' 226 GPa) with the shear law that cases take for granted.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import product
from math import log, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
from contacts import LIGHT_FIELDS, places

from oilfilm.ehl import SolverOptions
from oilfilm.ehl.arrays import trend_terms
from oilfilm.ehl.atlas.fields import (
    CELL_ROWS,
    CELLS,
    FILE,
    HALF,
    LIGHT_FILE,
    RANGE,
    RINGS,
    SECTORS,
    TREND,
    FieldTable,
    carried_load_fraction,
    field_vectors,
    fields_of_vector,
    kernel,
    layout,
    sheared_area,
)
from oilfilm.ehl.atlas.table import oil_features
from oilfilm.ehl.closed_form.hertz import MEAN_PRESSURE_RATIO, hertz_coefficients
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, contact_rheology
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solver import solve_attempts
from oilfilm.ehl.traction.film_quadrature import (
    LINES,
    FilmQuadrature,
    hertz_zone,
    line_quadrature,
    low_pressure_blocks,
    node_rows,
    sliding_forces,
)
from oilfilm.ehl.traction.linear_response import normal_response
from oilfilm.ehl.traction.shear import bounded_viscosity, with_outlet

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import OIL, from_groups, moes

KEPT = Path(__file__).parents[2] / "build" / "atlas_fields"
COUNTS = {"fields": 480, "fields oil": 240, "fields held": 120, "fields judge": 120}
LIGHT_COUNTS = {"light fields": 320, "light fields oil": 260, "light fields judge": 80}
# "fields held" was in view when scales and modes were chosen, "fields judge" not
LIGHTEST, THINNEST = 10.0, 0.5  # A and L of those that are fitted
JUDGED = 2.0  # L from which on contacts are judged
POINTS, RESPONSE_POINTS = 257, 129  # as traction tables have
MODES = 120
SCALES = np.array((1.75, 4.0, 6.0))  # of ln A, sqrt L, ln D
NOISE = 1e-5  # variance of amplitudes over theirs
# of the parts of a vector in the choice of its modes, over that of pressures and ln films
EDGES, LOAD, CELL, DAMPING, CONDUCTANCE = 20.0, 50.0, 4.0, 1.0, 20.0
SHEAR = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=0.047, limiting_coefficient=0.047, limiting_minimum=5e6)
RATIOS = (1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.5, 2.0)  # slide-roll ratios that judge
# of sliding along and across over the ratio, and spin R_x/u_m
DIRECTIONS = ((1.0, 0.0, 0.0), (0.0, 0.5, 0.0), (1.0, 0.0, 0.1), (1.0, 0.5, 0.3))


class Solved(NamedTuple):
    """A contact and its vector."""

    A: float
    L: float
    D: float
    alpha: float
    z: float
    vector: np.ndarray


def solve(place):
    """What is kept of a contact: zone and blocks over its scales, response; None where it has no film."""
    conditions = place.conditions()
    solution, _ = solve_attempts(conditions, SolverOptions(points=POINTS))
    response = normal_response(conditions, SolverOptions(points=RESPONSE_POINTS))
    if not (solution.converged and solution.resolved and response.converged):
        return None
    a, b = solution.semi_axis_x, solution.semi_axis_x * solution.semi_axis_ratio
    unit = solution.hertz_pressure * a * conditions.radius_x / conditions.entrainment_speed
    scales = np.array([a, b, a * b, solution.film_scale / place.A, solution.hertz_pressure])
    zone, blocks = hertz_zone(solution).fields, low_pressure_blocks(with_outlet(solution))
    return vector(zone, blocks, scales, log(response.damping.value / unit))


def vector(zone, blocks, scales, damping):
    """Of `layout`, from rows of `HertzZone.fields` [m], [Pa] and their scales."""
    parts, (shares, weights) = layout(), line_quadrature()
    found = np.empty(parts.shear.stop)
    above, below = zone[:, HALF:], zone[:, :HALF][:, ::-1]
    half = 0.5 * (above + below)
    half[1] = 0.5 * (above[1] - below[1])
    span = half[5, :, 0] / weights[0] / scales[0]
    first = half[0, :, 0] / scales[0] - span * shares[0]
    found[parts.half_width] = half[1, -1, 0] / scales[1] * LINES / (LINES - 1.0)
    found[parts.first], found[parts.last] = first, first + span
    found[parts.pressure] = (half[4] / scales[4]).ravel()
    found[parts.film] = np.log(half[3] / scales[3]).ravel()
    found[parts.cells] = cells(blocks, scales).ravel()
    found[parts.load] = carried_load_fraction(found)
    found[parts.damping] = damping
    found[parts.shear] = log(sheared_area(found))
    return found


def cells(blocks, scales):
    """Rows of the cells from those of blocks."""
    x, y, area, film, p, width, breadth = blocks
    x, y = x / scales[0], np.abs(y) / scales[1]
    spread_x, spread_y = (width / scales[0]) ** 2 / 12.0, (breadth / scales[1]) ** 2 / 12.0
    area, film, p = area / scales[2], film / scales[3], p / scales[4]
    ring = np.searchsorted(RINGS, np.hypot(x, y), side="right") - 1
    sector = np.minimum((np.arctan2(y, x) / pi * SECTORS).astype(int), SECTORS - 1)
    own = ring * SECTORS + sector

    def total(values):
        return np.bincount(own, values, minlength=CELLS)

    by_film = total(area / film)
    safe = np.where(by_film > 0.0, by_film, 1.0)
    mean_p, mean_x, mean_y, square_x, square_y = (
        total(area / film * v) / safe for v in (p, x, y, x**2 + spread_x, y**2 + spread_y)
    )
    rows = (total(area), by_film, mean_p, mean_x, mean_y, square_x - mean_x**2, square_y - mean_y**2)
    return np.stack(rows)


def kept(kind, solving):
    """Contacts of a part; solved where they are not there yet."""
    KEPT.mkdir(parents=True, exist_ok=True)
    found = []
    for place in places(kind, {**COUNTS, **LIGHT_COUNTS}[kind]):
        path = KEPT / f"{kind.replace(' ', '_')}_{place.number}.npy"
        if solving and not path.exists():
            own = solve(place)
            np.save(path, np.zeros(0) if own is None else own)
            print(f"{kind} {place.number} A {place.A:.3g} L {place.L:.3g} D {place.D:.3g}", flush=True)
        if path.exists() and (own := np.load(path)).size:
            oil = place.oil
            found.append(Solved(place.A, max(place.L, 1e-3), place.D, oil.pressure_viscosity, oil.exponent, own))
    return found


def inputs(rows):
    """Places (ln A, sqrt L, ln D), alpha and z."""
    x = np.array([(log(row.A), sqrt(row.L), log(row.D)) for row in rows])
    return x, np.array([row.alpha for row in rows]), np.array([row.z for row in rows])


def fitted(rows):
    """The table of solved contacts."""
    x, alpha, z = inputs(rows)
    parts, y = layout(), np.array([row.vector for row in rows])
    unit = np.ones(y.shape[1])
    for part, factor in (
        (slice(0, parts.last.stop), EDGES),
        (parts.cells, CELL),
        (parts.load, LOAD),
        (parts.damping, DAMPING),
        (parts.shear, CONDUCTANCE),
    ):
        unit[part] = factor
    unit[parts.cells] /= np.repeat(y[:, parts.cells].reshape(len(y), CELL_ROWS, CELLS).std((0, 2)) * 10.0, CELLS)
    mean = y.mean(0)
    modes = np.linalg.svd((y - mean) * unit, full_matrices=False)[2][:MODES]
    amplitudes = ((y - mean) * unit) @ modes.T
    size = amplitudes.std(0)
    oils, basis = oil_features(x, alpha, z), trend_terms(x)
    prior = kernel(x, oils, x, oils, SCALES) + TREND**2 * basis @ basis.T + NOISE * np.eye(len(x))
    weights = np.linalg.solve(prior, amplitudes / size) * size
    return FieldTable(x, oils, SCALES, mean, modes / unit, TREND**2 * basis.T @ weights, weights)


def steel(row):
    """Conditions of a contact with E' 226 GPa."""
    oil = replace(OIL, roelands_z=row.z, pressure_viscosity=row.alpha)
    f = hertz_coefficients(row.D)[0]
    return from_groups(moes((row.A / f**2) ** 1.5, row.L, row.D, oil=oil))


def quadrature(own, conditions):
    """Nodes of a vector, ready to shear."""
    fields, scaled = fields_of_vector(own, conditions), scale_contact(conditions)
    rows = np.concatenate([fields.zone.reshape(7, -1), fields.cells], axis=1)
    oil = conditions.lubricant
    rheology = contact_rheology(SHEAR, oil, MEAN_PRESSURE_RATIO * scaled.hertz_pressure)
    width = scaled.semi_axis_x * scaled.semi_axis_ratio
    eta = bounded_viscosity(rows[4], oil)
    return FilmQuadrature(nodes=node_rows(rows, eta, rheology, None), half_width=width, rheology=rheology)


def forces(own, conditions):
    """Along, across [N] and about the normal [N m] at the motions that judge, shape (directions, ratios, 4)."""
    u = conditions.entrainment_speed
    motions = [(r * a * u, r * b * u, r * c * u / conditions.radius_x) for (a, b, c), r in product(DIRECTIONS, RATIOS)]
    slide = tuple(np.ascontiguousarray(part) for part in np.array(motions).T)
    rolling = np.full(len(motions), u / conditions.radius_x)
    found = sliding_forces(quadrature(own, conditions), slide, rolling, 0.0)
    return found.reshape(len(DIRECTIONS), len(RATIOS), 4)


def error(row, own):
    """Largest over the directions of the error of the force over kappa_max Q at each ratio, shape (ratios,)."""
    conditions = steel(row)
    solved, by_table = (forces(v, conditions)[..., :2] for v in (row.vector, own))
    most = np.hypot(solved[..., 0], solved[..., 1]).max()
    off = by_table - solved
    return np.hypot(off[..., 0], off[..., 1]).max(axis=0) / most


def judged(text, rows, known):
    """Print errors: largest, 95 %, median over contacts of the largest over ratios, and the largest at each ratio."""
    x, alpha, z = inputs(rows)
    found = field_vectors(x, alpha, z, known)
    errors = 100.0 * np.array([error(row, own) for row, own in zip(rows, found, strict=True)])
    worst = errors.max(axis=1)
    by_ratio = " ".join(f"{value:.2f}" for value in np.quantile(errors, 0.95, axis=0))
    part = layout().damping
    off = [float(own[part][0] - row.vector[part][0]) for row, own in zip(rows, found, strict=True)]
    damping = 100.0 * np.abs(np.expm1(off))
    k = int(worst.argmax())
    print(
        f"{text:20s} {len(rows):4d}  {worst.max():.2f} / {np.quantile(worst, 0.95):.2f} / {np.median(worst):.2f}"
        f"   95 % by ratio {by_ratio}   damping {damping.max():.1f} / {np.quantile(damping, 0.95):.1f}"
        f"   worst at A {rows[k].A:.3g} L {rows[k].L:.3g} D {rows[k].D:.3g}"
    )


def write(rows, path, lightest):
    """Fit and write a table of contacts of A above; as it is read again."""
    fits = [kind for kind in rows if kind.endswith(("fields", "oil"))]
    own = [row for kind in fits for row in rows[kind] if row.A > lightest and row.L > THINNEST]
    single = FieldTable(*(np.asarray(part, dtype=np.float32) for part in fitted(own)))
    np.savez_compressed(path, **single._asdict())
    print(f"{len(own)} contacts in {path.name}; error of the force [% of kappa_max Q] at slide-roll ratios", *RATIOS)
    return FieldTable(*(part.astype(float) for part in single))


def main(solving):
    """Both tables, of heavy and of light contacts."""
    heavy, light = ({kind: kept(kind, solving) for kind in counts} for counts in (COUNTS, LIGHT_COUNTS))
    tables = (
        (write(heavy, FILE, LIGHTEST), heavy, RANGE["A = a^2/(Rx^2 sqrt(2U))"], JUDGED),
        (write(light, LIGHT_FILE, 0.0), light, LIGHT_FIELDS, 1.0),
    )
    for known, rows, (low, high), least in tables:
        for kind, own in rows.items():
            judged(kind, [row for row in own if low <= row.A <= high and row.L >= least], known)


if __name__ == "__main__":
    main(sys.argv[1:] != ["fit"])

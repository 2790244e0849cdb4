"""A second solution of a contact behind a layer of oil: finite volumes and Newton's method.

Nothing of the multigrid is in it but the dimensionless numbers of the contact. Pressure P and
filled share theta of cells, the contact's upper half, entrainment along X, P = 0 on the edges:

    div(eps grad P) - d_X(theta rho H) = 0,   P >= 0, theta <= 1, P (1 - theta) = 0
    H = H0 + S X^2/2 + T Y^2/2 + K * P,   integral of P = load

Through a face flows eps, the mean of both cells, times the gradient, and rho H by a parabola
through two cells upstream and one downstream, times the share of the cell upstream. A cell has one
unknown, P where it is full and theta where it is not, and changes sides where these pass zero and
one. Each step is solved by GMRES (Saad and Schultz, 1986) with the whole deflection,
preconditioned by a factorisation with that of the nearest cells, bordered by the load.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, gmres, splu

from oilfilm.ehl.scaling import ScaledContact

from .cells import Array, Cells, Deflection, Faces

STEPS = 60
TOLERANCE = 1e-9  # of the last change of P and theta, and of the load [-]
LINEAR_TOLERANCE = 1e-3
RESTART = 60  # of GMRES, three times at most
LARGEST_CHANGE = 0.2  # of a pressure in one step [-]
LARGEST_EXPONENT = 300.0  # of the viscosity


@dataclass(frozen=True, slots=True, kw_only=True)
class Fields:
    """State of the cells, shape (ny, nx) [-]."""

    P: Array
    theta: Array
    approach: float  # H0


@dataclass(frozen=True, slots=True, kw_only=True)
class Solved:
    """A solution [-]."""

    cells: Cells
    fields: Fields
    H: Array  # (ny, nx)
    steps: int
    residual: float  # largest of a cell over the largest difference of fluxes
    balance: float  # sum of the residuals over the oil that enters
    outlet: Array  # (ny,) layer that leaves

    @property
    def central_film(self) -> float:
        """H at the origin: even in Y, linear in X [-]."""
        return float(np.interp(0.0, self.cells.X, 1.125 * self.H[0] - 0.125 * self.H[1]))

    @property
    def minimum_film(self) -> float:
        """Smallest H where there is pressure [-]."""
        return float(self.H[self.fields.P > 0.0].min())

    @property
    def central_pressure(self) -> float:
        """P at the origin [-]."""
        P = self.fields.P
        return float(np.interp(0.0, self.cells.X, 1.125 * P[0] - 0.125 * P[1]))

    @property
    def meniscus(self) -> float | None:
        """X at which the gap fills on the line Y = 0; None: the box begins full [-]."""
        ahead = np.flatnonzero((self.fields.theta[0] < 1.0) & (self.cells.X < 0.0))
        return float(self.cells.X[ahead[-1]] + 0.5 * self.cells.hx) if ahead.size else None


class _Slopes(NamedTuple):
    """Of the residual (cells, cells), by P at given H, by H and by theta [-]."""

    by_P: sp.csr_matrix
    by_H: sp.csr_matrix
    by_theta: sp.csr_matrix


class _Problem:
    """Residual of one contact on one set of cells, behind a layer of shape (ny,) [-]."""

    def __init__(self, contact: ScaledContact, cells: Cells, layer: Array) -> None:
        self.contact = contact
        self.cells = cells
        self.layer = layer
        self.deflect = Deflection(cells, contact.deformation)
        self.near = self.deflect.near()
        self.faces = Faces(cells)
        self.rigid = contact.gap(cells.X[None, :], cells.Y[:, None])

    def gap(self, fields: Fields) -> Array:
        """H [-]."""
        return np.asarray(fields.approach + self.rigid + self.deflect(fields.P))

    def density(self, P: Array) -> tuple[Array, Array]:
        """rho and its slope [-]."""
        c = self.contact
        below = 1.0 + c.density_denominator * P
        return 1.0 + c.density_numerator * P / below, c.density_numerator / below**2

    def conductance(self, P: Array, H: Array) -> tuple[Array, Array, Array]:
        """eps and its slopes by P and H [-]."""
        c = self.contact
        rise = 1.0 + c.viscosity_pressure * P
        thicker = c.viscosity_slope * (rise**c.viscosity_exponent - 1.0)
        rho, by_P = self.density(P)
        mobility = np.exp(-np.minimum(thicker, LARGEST_EXPONENT)) / c.speed
        constant = c.viscosity_slope * c.viscosity_exponent * c.viscosity_pressure
        steeper = constant * rise ** (c.viscosity_exponent - 1.0)
        eps = rho * H**3 * mobility
        return eps, (by_P / rho - steeper) * eps, 3.0 * rho * H**2 * mobility

    def residual(self, fields: Fields, H: Array) -> tuple[Array, _Slopes, Array]:
        """Of the cells, its slopes, and the oil through the faces along X, (ny, nx + 1) [-]."""
        p = fields.P.ravel()
        h = H.ravel()
        # 1. what the pressure drives
        eps, eps_P, eps_H = self.conductance(p, h)
        residual: Array = np.zeros(p.size)
        by_P = by_H = sp.csr_matrix((p.size, p.size))
        for grade, mean, leave in zip(self.faces.grade, self.faces.mean, self.faces.leave, strict=True):
            slope = np.asarray(grade @ p)
            driven: Array = leave @ ((mean @ eps) * slope)
            residual += driven
            by_eps = leave @ sp.diags(slope) @ mean
            by_P = by_P + leave @ sp.diags(mean @ eps) @ grade + by_eps @ sp.diags(eps_P)
            by_H = by_H + by_eps @ sp.diags(eps_H)
        # 2. what the surfaces carry; the layer, no more than the gap takes, on the first faces
        rho, rho_P = self.density(p)
        full = np.asarray(self.faces.carry @ (rho * h))
        share = np.asarray(self.faces.upstream @ fields.theta.ravel())
        flux: Array = (share * full).reshape(self.cells.Y.size, -1)
        flux[:, 0] = np.minimum(self.layer, 1.5 * H[:, 0] - 0.5 * H[:, 1])
        leave = self.faces.leave[0]
        carried = leave @ sp.diags(share) @ self.faces.carry
        slopes = _Slopes(
            by_P=(by_P - carried @ sp.diags(h * rho_P)).tocsr(),
            by_H=(by_H - carried @ sp.diags(rho)).tocsr(),
            by_theta=-(leave @ sp.diags(full) @ self.faces.upstream).tocsr(),
        )
        return residual - leave @ flux.ravel(), slopes, flux


def hertz_start(contact: ScaledContact, cells: Cells, layer: float) -> Fields:
    """Hertz' pressure, the film guessed, and the layer where there is none [-]."""
    P = contact.dry_pressure(cells.X[None, :], cells.Y[:, None])
    rigid = contact.gap(cells.X[None, :], cells.Y[:, None])
    H = rigid + Deflection(cells, contact.deformation)(P)
    approach = contact.film_guess - float(H[0, np.abs(cells.X).argmin()])
    theta = np.where(P > 0.0, 1.0, np.clip(layer / np.maximum(H + approach, 1e-12), 0.0, 1.0))
    return Fields(P=P, theta=theta, approach=approach)


def solve(contact: ScaledContact, cells: Cells, layer: float, start: Fields) -> Solved:
    """Pressure and filled share of a contact behind a layer in units of a^2/Rx [-], an endless one
    for a flooded contact; ArithmeticError where Newton's method does not converge.
    """
    problem = _Problem(contact, cells, np.full(cells.Y.size, layer))
    fields = start
    full = (fields.P > 0.0).ravel()
    for step in range(1, STEPS + 1):
        residual, slopes, _ = problem.residual(fields, problem.gap(fields))
        load = contact.load - 2.0 * cells.hx * cells.hy * float(fields.P.sum())
        change, rise = _newton_step(problem, full, residual, slopes, load)
        # 1. no pressure changes by more than a share of Hertz', but where it vanishes
        stays = full & (fields.P.ravel() + change > 0.0)
        largest = float(np.abs(np.where(stays, change, 0.0)).max())
        damping = min(1.0, LARGEST_CHANGE / max(largest, LARGEST_CHANGE))
        P = np.where(full, fields.P.ravel() + damping * change, 0.0)
        theta = np.where(full, 1.0, fields.theta.ravel() + damping * change)
        # 2. cells change sides where they would pass zero pressure, or full
        now_full = np.where(full, P > 0.0, theta > 1.0)
        new = Fields(
            P=np.where(now_full, np.maximum(P, 0.0), 0.0).reshape(cells.shape),
            theta=np.where(now_full, 1.0, np.clip(theta, 0.0, 1.0)).reshape(cells.shape),
            approach=fields.approach + damping * rise,
        )
        moved = np.abs(new.P - fields.P) + np.abs(new.theta - fields.theta)
        settled = bool((now_full == full).all()) and abs(load) < TOLERANCE
        fields = new
        full = now_full
        if settled and float(moved.max()) < TOLERANCE:
            return _solved(problem, fields, step)
        if not np.isfinite(moved).all():
            break
    raise ArithmeticError(f"Newton's method of a starved contact: no convergence in {step} steps")


def _solved(problem: _Problem, fields: Fields, steps: int) -> Solved:
    H = problem.gap(fields)
    residual, _, flux = problem.residual(fields, H)
    return Solved(
        cells=problem.cells,
        fields=fields,
        H=H,
        steps=steps,
        residual=float(np.abs(residual).max() / np.abs(np.diff(flux)).max()) * problem.cells.hx,
        balance=float(residual.sum()) * problem.cells.hx / float(flux[:, 0].sum()),
        outlet=flux[:, -1],
    )


def _newton_step(
    problem: _Problem, full: NDArray[np.bool_], residual: Array, slopes: _Slopes, load: float
) -> tuple[Array, float]:
    """Change of each cell's unknown and of H0 [-]."""
    cells = problem.cells
    weights = 2.0 * cells.hx * cells.hy * full
    pressed = sp.diags(full.astype(np.float64))
    emptied = sp.diags((~full).astype(np.float64))
    local = (slopes.by_P + slopes.by_H @ problem.near) @ pressed + slopes.by_theta @ emptied
    factor = splu(local.tocsc())
    of_rise = factor.solve(np.asarray(slopes.by_H.sum(axis=1)).ravel())

    def nearly(r: Array) -> Array:
        """Unknowns by the factorisation, bordered by the load."""
        alone = factor.solve(r[:-1])
        rise = (weights @ alone - r[-1]) / (weights @ of_rise)
        return np.append(alone - rise * of_rise, rise)

    def change_of_residual(v: Array) -> Array:
        unknowns = nearly(v)
        P = np.where(full, unknowns[:-1], 0.0)
        H = problem.deflect(P.reshape(cells.shape)).ravel() + unknowns[-1]
        theta = np.where(full, 0.0, unknowns[:-1])
        changed = slopes.by_P @ P + slopes.by_H @ H + slopes.by_theta @ theta
        return np.append(changed, weights @ P)

    size = residual.size + 1
    matrix = LinearOperator((size, size), matvec=change_of_residual, dtype=np.float64)
    wanted = np.append(-residual, load)
    v, _ = gmres(matrix, wanted, rtol=LINEAR_TOLERANCE, restart=RESTART, maxiter=3)
    unknowns = nearly(v)
    return unknowns[:-1], float(unknowns[-1])

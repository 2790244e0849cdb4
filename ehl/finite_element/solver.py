"""One lubricated contact by finite elements and Newton's method: a check of the multigrid.

Unknowns are the nodal pressures on a graded rectangle mesh and the constant H0; equations are the
weak Reynolds equation with the cavitation condition (`reynolds.py`), the film H = H0 + gap +
compliance P (`solid/compliance.py`) and the load balance. Cavitation is the semi-smooth equation
min(P, -R/d) = 0, d the diagonal (Hintermueller, Ito and Kunisch, 2002). Three meshes, each twice
as fine as the one before; the coarsest starts from Hertz.
"""

import time
from dataclasses import dataclass, field, replace
from math import ceil, nan

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..arrays import Array
from ..conditions import ContactConditions, MoesConditions
from ..grid import Grid, unfolded
from ..multigrid.bordered import Border, LinearSolverError, factor_bordered, solve_bordered
from ..multigrid.extrapolation import extrapolate
from ..multigrid.far_field import FarField, exterior_load, far_field
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solid.compliance import add_coating, compliance_matrix, graded_nodes, near_field
from ..solution import ContactSolution, ConvergenceRecord
from ..solver import RESOLVED, choose_domain
from .reynolds import (
    FilmSpace,
    coefficients,
    film_derivative,
    film_space,
    integral_weights,
    pressure_derivative,
    reynolds_residual,
)

# Beside each number what it changes if halved or doubled, measured with 65 nodes along x at M 20,
# L 10; at M 100, L 10, Rx/Ry 0.1; and at M 20, L 2 in an open box.
LEVELS = 3  # with 4 one of the three contacts does not converge on its coarsest mesh
# along x; the dense compliance matrix has 0.43 GB with 129 x 57 nodes and grows with the 4th power
MAX_POINTS = 129
MAX_POINTS_SKEWED = 65  # of both halves
# cells across half the contact per cell along it: half moves the smallest film by 1.8 %, double
# by 0.4 %
CELLS_Y = 7 / 16
STEPS = 60  # of Newton on each mesh; 30 in all were needed at most
PRESSURE_STEP = 0.5  # largest change of pressure in a step [-]; 1 to 7 steps more
LARGEST_FILM_LOSS = 0.7  # of the film in a step; 0.35 one step less, 0.9 the same
SMALLEST_FILM = 1e-3  # of the film guess, where the bodies overlap at the start; nothing
TOLERANCE = 1e-6  # of the last change of pressure [-]; a step or two, films to 1e-5
LINEAR_TOLERANCE = 1e-5  # of each Newton step; 8 % of the GMRES iterations
REACH = 2  # lines of nodes whose compliance enters the preconditioner; up to 16 % of them


@dataclass(slots=True)
class Level:
    """One mesh and the state on it; nodes numbered i ny + j, lengths in units of a [-]."""

    contact: ScaledContact
    X: Array
    Y: Array
    space: FilmSpace
    compliance: Array
    near: sparse.csr_matrix
    gap: Array
    weights: Array  # integral of P = weights @ P, both halves
    edge: NDArray[np.bool_]
    far: FarField | None  # edge pressure of an open box
    P: Array
    approach: float = 0.0

    @property
    def film(self) -> Array:
        """H0 + gap + deflection, shape (nodes,) [-]."""
        return self.approach + self.gap + self.compliance @ self.P

    @property
    def shape(self) -> tuple[int, int]:
        """Nodes along x and y."""
        return len(self.X), len(self.Y)

    @property
    def origin(self) -> int:
        """Number of the node at (0, 0)."""
        return int(abs(self.X).argmin()) * len(self.Y) + int(abs(self.Y).argmin())


@dataclass(slots=True)
class Progress:
    """What each Newton step did [-]."""

    residual: list[float] = field(default_factory=list)
    load: list[float] = field(default_factory=list)
    change: list[float] = field(default_factory=list)


def solve_contact_finite_element(
    conditions: ContactConditions | MoesConditions, options: SolverOptions | None = None
) -> ContactSolution:
    """Pressure and film of a steady, isothermal, flooded elliptical point contact by finite
    elements, on the nodes of the finest mesh, which are not equidistant; cycles are Newton steps
    on all meshes. A rotation of the entrainment is left out.

    `points` of the options asks for (points + 1)/2 nodes along x, at most 129 (65 for a skewed
    entrainment): the mesh is graded. Without `domain` the open box is that of `choose_domain`;
    `tolerance` and `max_cycles` are not used.
    """
    options = options or SolverOptions()
    if scale_contact(conditions).oil is not None:
        oil = conditions.lubricant
        laws = f"{oil.viscosity_law.value} and {oil.density_law.value}"
        known = "Roelands, Barus, constant viscosity"
        raise ValueError(f"finite elements know {known}, not the laws {laws}")
    start = time.perf_counter()
    progress = Progress()
    contact = replace(scale_contact(conditions, along_entrainment=True), rotation=0.0)
    domain = options.domain or choose_domain(contact)
    most = MAX_POINTS if contact.symmetric else MAX_POINTS_SKEWED
    cells = min(options.points - 1, 2 * (most - 1)) // 2
    level = None
    films = []
    for index in reversed(range(LEVELS)):
        level = _level(contact, domain, cells // 2**index, options.domain is None, level)
        converged, message = newton(level, progress)
        if not converged:
            break
        films.append((float(level.film[level.origin]), _minimum(level)))
    assert level is not None
    record = ConvergenceRecord(
        residual=tuple(progress.residual),
        force_error=tuple(progress.load),
        film_change=tuple(progress.change),
        cycles=len(progress.residual),
        fft_equivalents=0.0,
        fallbacks=(),
        wall_time=time.perf_counter() - start,
    )
    outcome = (record, converged, message, domain)
    return _solution(conditions, options, level, films or [(nan, nan)], outcome)


def newton(level: Level, progress: Progress) -> tuple[bool, str]:
    """Newton's method on one mesh, in place; whether it converged, and a message."""
    for _ in range(STEPS):
        H = np.maximum(level.film, SMALLEST_FILM * level.contact.film_guess)
        try:
            change, rise = _step(level, H, progress)
        except LinearSolverError as error:
            advice = "try more points or a smaller load"
            return False, f"the linear system was not solved: {error}; {advice}"
        growth = rise + level.compliance @ change
        size = float(np.abs(change).max())
        thinner = growth < 0.0
        losses = LARGEST_FILM_LOSS * H[thinner] / -growth[thinner]
        share = min(1.0, PRESSURE_STEP / max(size, 1e-30), *losses)
        level.P += share * change
        level.approach += share * rise
        origin = level.origin
        progress.change.append(share * float(np.abs(growth[origin])) / float(H[origin]))
        if size < TOLERANCE and share == 1.0:
            return True, "converged"
    last = f"in the last of {STEPS} Newton steps"
    return False, f"not converged: pressure changed by {size:.1e} {last}; try more points"


def _step(level: Level, H: Array, progress: Progress) -> tuple[Array, float]:
    """Newton change of pressure and of H0 [-]."""
    k = coefficients(level.space, level.contact, level.P, H)
    residual = reynolds_residual(level.space, k)
    by_pressure = pressure_derivative(level.space, k)
    by_film = film_derivative(level.space, k)
    column = np.asarray(by_film.sum(axis=1)).ravel()
    by_deflection = by_film.diagonal() * level.compliance.diagonal()
    scale = np.abs(by_pressure.diagonal()) + np.abs(by_deflection)
    fixed = level.edge | (level.P + residual / scale <= 0.0)
    target, exterior = _edge_pressure(level, H)
    load = level.contact.load - exterior
    error = load - float(level.weights @ level.P)
    progress.residual.append(float(np.abs(np.where(fixed, 0.0, residual / scale)).max()))
    progress.load.append(abs(error) / load)
    free = sparse.diags(np.where(fixed, 0.0, 1.0))
    near = free @ (by_pressure + by_film @ level.near) + sparse.diags(np.where(fixed, 1.0, 0.0))

    def operator(p: Array) -> Array:
        return np.where(fixed, p, by_pressure @ p + by_film @ (level.compliance @ p))

    right = np.where(fixed, target - level.P, -residual)
    border = Border(column=np.where(fixed, 0.0, column), row=level.weights)
    factors = factor_bordered(near, border)
    return solve_bordered(operator, border, factors, (right, error), LINEAR_TOLERANCE)


def _edge_pressure(level: Level, H: Array) -> tuple[Array, float]:
    """Kapitza's (1955) pressure -(k X)/H^2 on the edge of an open box, and its load [-]."""
    target = np.zeros_like(H)
    if level.far is None:
        return target, 0.0
    x, y = (values.ravel() for values in np.meshgrid(level.X, level.Y, indexing="ij"))
    target[level.edge] = (level.far.strength(x, y) / H**2)[level.edge]
    x_in = float(level.X[0])
    width = float(level.X[-1]) - x_in
    corners = Grid(x_in=x_in, hx=width, hy=float(level.Y[-1]), nx=2, ny=2, symmetric=True)
    inlet = np.full((2, 2), H[level.origin % len(level.Y)])
    return target, exterior_load(level.far, corners, inlet)


def _level(
    contact: ScaledContact,
    domain: tuple[float, float, float],
    cells: int,
    is_open: bool,
    coarse: Level | None,
) -> Level:
    """Mesh with `cells` along x, started from Hertz or from the coarser mesh."""
    X, Y = _lines(contact, domain, cells)
    c = contact
    space = film_space(X, Y)
    weights = integral_weights(space)
    compliance = compliance_matrix(X, Y, c.symmetric)
    if c.coating is not None:
        add_coating(compliance, c.coating, (X, Y), weights, c.symmetric)
    compliance *= c.deformation
    x, y = (values.ravel() for values in np.meshgrid(X, Y, indexing="ij"))
    P = c.dry_pressure(x, y)
    if coarse is not None:
        columns = coarse.P.reshape(coarse.shape).T
        lines = np.array([np.interp(X, coarse.X, column) for column in columns])
        P = np.array([np.interp(Y, coarse.Y, row) for row in lines.T]).ravel()
    edge = (x == X[0]) | (x == X[-1]) | (y == Y[-1]) | ((y == Y[0]) & (not c.symmetric))
    level = Level(
        contact=contact,
        X=X,
        Y=Y,
        space=space,
        compliance=compliance,
        near=near_field(compliance, (len(X), len(Y)), REACH),
        gap=contact.gap(x, y),
        weights=(2.0 if c.symmetric else 1.0) * weights,
        edge=edge,
        far=far_field(contact) if is_open else None,
        P=P,
    )
    origin = level.origin
    level.approach = coarse.approach if coarse else c.film_guess - float(level.film[origin])
    return level


def _lines(
    contact: ScaledContact, domain: tuple[float, float, float], cells: int
) -> tuple[Array, Array]:
    """Lines of the mesh: dense at outlet and sides of the Hertz ellipse, one through 0."""
    x_in, x_out, y_half = domain

    def along(s: Array) -> Array:
        outside = np.maximum(0.0, -s - 1.0) + np.maximum(0.0, s - 1.5)
        return 1.0 / (0.25 + 0.6 * outside) + 6.0 * np.exp(-(((s - 0.75) / 0.45) ** 2))

    def across(s: Array) -> Array:
        outside = np.maximum(0.0, abs(s) - 1.1)
        return 1.0 / (0.4 + outside) + 1.5 * np.exp(-(((abs(s) - 0.85) / 0.35) ** 2))

    coarse = 2 ** (LEVELS - 1) if cells % 4 == 0 else 1
    # share of the nodes that lies upstream of 0
    ends = ((x_in, 0.0), (0.0, x_out))
    counts = [float(along(np.linspace(a, b, 2001)).mean()) * (b - a) for a, b in ends]
    west = max(1, round(counts[0] / sum(counts) * cells / coarse)) * coarse
    upstream_lines = graded_nodes((x_in, 0.0), west, along)[:-1]
    X = np.concatenate((upstream_lines, graded_nodes((0.0, x_out), cells - west, along)))
    Y = graded_nodes((0.0, y_half), ceil(CELLS_Y * cells), across)
    if not contact.symmetric:
        Y = unfolded(Y, sign=-1.0)
    return X * contact.half_extent_x, Y * contact.half_extent_y


def _minimum(level: Level) -> float:
    """Smallest film [-]: minimum of a quadratic through the smallest node and its neighbours."""
    X, Y, H = _whole_box(level, level.film)
    i, j = np.unravel_index(H.argmin(), H.shape)
    least = float(H[i, j])
    if not (0 < i < len(X) - 1 and 0 < j < len(Y) - 1):
        return least
    rows, columns = slice(i - 1, i + 2), slice(j - 1, j + 2)
    along = (X[rows] - X[i]) / (X[i + 1] - X[i - 1])
    across = (Y[columns] - Y[j]) / (Y[j + 1] - Y[j - 1])
    u, v = (part.ravel() for part in np.meshgrid(along, across, indexing="ij"))
    terms = np.stack((u**2, v**2, u * v, u, v), axis=1)
    fit = np.linalg.lstsq(terms, H[rows, columns].ravel() - least, rcond=None)[0]
    hessian = np.array([[2 * fit[0], fit[2]], [fit[2], 2 * fit[1]]])
    slope = fit[3:]
    if fit[0] <= 0.0 or np.linalg.det(hessian) <= 0.0:
        return least
    place = -np.linalg.solve(hessian, slope)
    return least + 0.5 * float(slope @ place) if np.abs(place).max() <= 0.5 else least


def _whole_box(level: Level, values: Array) -> tuple[Array, Array, Array]:
    """X, Y and a nodal field over the whole box, shape (nx, ny)."""
    values = values.reshape(level.shape)
    if not level.contact.symmetric:
        return level.X, level.Y, values
    return level.X, unfolded(level.Y, sign=-1.0), unfolded(values, axis=1)


def _solution(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    level: Level,
    films: list[tuple[float, float]],
    outcome: tuple[ConvergenceRecord, bool, str, tuple[float, float, float]],
) -> ContactSolution:
    record, converged, message, domain = outcome
    contact = level.contact
    X, Y, H = _whole_box(level, level.film)
    noise = record.film_change[-1]
    central, minimum = zip(*films[-2:], strict=True)
    at_minimum = min(int(np.unravel_index(H.argmin(), H.shape)[0]), len(X) - 2)
    ratio = minimum[-1] / float(X[at_minimum + 1] - X[at_minimum]) ** 2
    resolved = converged and ratio >= RESOLVED
    if converged and not resolved:
        fineness = f"minimum film/(mesh size)^2 is {ratio:.2f}, below {RESOLVED:g}"
        message = f"converged but unresolved: {fineness}"
    return ContactSolution(
        conditions=conditions,
        options=options,
        X=X,
        Y=Y,
        P=_whole_box(level, level.P)[2],
        H=H,
        film_central_dimensionless=extrapolate(central, noise),
        film_minimum_dimensionless=extrapolate(minimum, noise),
        approach_dimensionless=level.approach,
        moes_load=contact.moes_load,
        moes_lubricant=contact.moes_lubricant,
        semi_axis_ratio=contact.semi_axis_ratio,
        frame_angle=contact.frame_angle,
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
        film_scale=contact.film_scale,
        domain=domain,
        resolved=resolved,
        converged=converged,
        message=message,
        record=record,
    )

"""One lubricated contact by finite elements and Newton's method: a check of the multigrid.

Unknowns are the nodal pressures on a graded rectangle mesh and the constant H0; equations are the
weak Reynolds equation with the cavitation condition (`reynolds.py`), the film H = H0 + gap +
compliance P (`solid/compliance.py`) and the load balance (`newton.py`). The solution does not
depend on the start, which may be the multigrid's pressure.
"""

import time
from dataclasses import dataclass
from math import nan

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions, MoesConditions
from ..grid import unfolded
from ..multigrid.extrapolation import second_order
from ..multigrid.history import RESOLVED
from ..multigrid.open_box import choose_domain
from ..options import SolverOptions
from ..scaling import ScaledContact, scale_contact
from ..solution import ContactSolution, ConvergenceRecord
from ..solver import at_load, with_status
from .levels import lattices, level_on
from .newton import Level, Progress, balance, newton
from .start import Start, hertz_start, start_from_level, start_from_solution

Conditions = ContactConditions | MoesConditions

LEVELS = 3
POINTS = 257  # where the options leave them open
MAX_CELLS = 512  # along x
MAX_CELLS_SKEWED = 256  # of both halves
# loads through which a contact is reached without another solution to start from: M of the
# first, and the ratio of each to the one before
FIRST_LOAD = 50.0
LOAD_RATIO = 3.0
COARSEST = 32  # cells along x on which lighter loads are solved


@dataclass(slots=True)
class Attempt:
    """The meshes solved so far: the last one, films of those that converged, and the outcome."""

    level: Level
    films: list[tuple[float, float, float]]  # central and minimum, and H0 [-]
    converged: bool
    message: str


def solve_contact_finite_element(
    conditions: Conditions,
    options: SolverOptions | None = None,
    start: ContactSolution | None = None,
) -> ContactSolution:
    """Pressure and film of a steady, isothermal, flooded elliptical point contact by finite
    elements.

    The nodes of the finest mesh are not equidistant; cycles are Newton steps on all meshes.
    Newton's method starts from the pressure and film of `start`, else from Hertz, through lighter
    loads where the contact is heavy; neither enters the discrete equations. `points` asks for
    about (points + 1)/2 nodes along x, at most 513 (257 over both halves): the mesh is graded.
    Without `domain` the open box is that of `choose_domain`; `tolerance` and `max_cycles`
    are not used.

    Parameters
    ----------
    conditions : Conditions
        the contact, in SI or by Moes' groups
    options : SolverOptions | None, optional
        mesh; None: the defaults
    start : ContactSolution | None, optional
        another solution of the same contact; None: from Hertz

    Returns
    -------
    ContactSolution
        pressure and film with error bars; see `converged` and `message`

    Raises
    ------
    ValueError
        if conditions contain an inlet layer: mass is not conserved behind one here
    """
    options = options or SolverOptions()
    if conditions.inlet_layer is not None:
        raise ValueError("inlet_layer: the finite elements solve flooded films only")
    start_time = time.perf_counter()
    contact = scale_contact(conditions, along_entrainment=True)
    domain = options.domain or choose_domain(contact)
    is_open = options.domain is None
    most = MAX_CELLS if contact.symmetric else MAX_CELLS_SKEWED
    cells = min(((options.points or POINTS) - 1) // 2, most)
    progress = Progress()
    if start is not None and np.isfinite(start.P).all():
        initial = start_from_solution(contact, start)
    else:
        initial = _through_loads(conditions, domain, is_open, progress)
    attempt = _refine(contact, domain, cells, is_open, initial, progress)
    wall_time = time.perf_counter() - start_time
    return _solution(conditions, options, attempt, domain, _record(attempt, progress, wall_time))


def _through_loads(
    conditions: Conditions, domain: tuple[float, float, float], is_open: bool, progress: Progress
) -> Start:
    """Start from the next lighter load on a coarse mesh, itself reached in steps from Hertz."""
    heavy = scale_contact(conditions, along_entrainment=True)
    fractions = []
    load = FIRST_LOAD
    while load < heavy.moes_load:
        fractions.append(load / heavy.moes_load)
        load *= LOAD_RATIO
    initial = None
    for fraction in fractions:
        lighter = scale_contact(at_load(conditions, fraction), along_entrainment=True)
        initial = initial or hertz_start(lighter)
        attempt = _refine(lighter, domain, COARSEST, is_open, initial, progress, levels=1)
        if attempt.converged:
            initial = start_from_level(attempt.level)
    return initial or hertz_start(heavy)


def _refine(
    contact: ScaledContact,
    domain: tuple[float, float, float],
    cells: int,
    is_open: bool,
    initial: Start,
    progress: Progress,
    levels: int = LEVELS,
) -> Attempt:
    """Solve on each mesh.

    After a mesh that does not converge the next one starts from the same state.
    """
    films: list[tuple[float, float, float]] = []
    for mesh in lattices(contact, domain, cells, levels):
        level = level_on(contact, mesh, is_open, initial)
        converged, message = newton(level, progress)
        if converged:
            films.append((_central(level), _minimum(level), level.approach))
            initial = start_from_level(level)
        else:
            films = []
    return Attempt(level, films, converged, message)


def _record(attempt: Attempt, progress: Progress, wall_time: float) -> ConvergenceRecord:
    equation_error, imbalance = balance(attempt.level)
    return ConvergenceRecord(
        residual=(equation_error,),
        force_error=tuple(progress.load),
        film_change=tuple(progress.change),
        cycles=len(progress.residual),
        fft_equivalents=progress.deflected_nodes / len(attempt.level.P),
        fallbacks=(),
        wall_time=wall_time,
        mass_imbalance=imbalance,
    )


def _central(level: Level) -> float:
    """Film at (0, 0), cubic between the four nearest lines [-]."""
    H = level.H.reshape(level.shape)[:, int(abs(level.Y).argmin())]
    nearest = np.argsort(abs(level.X))[:4]
    return float(np.polynomial.Polynomial.fit(level.X[nearest], H[nearest], 3)(0.0))


def _minimum(level: Level) -> float:
    """Smallest film [-]: minimum of a quadratic through the smallest node and its neighbours."""
    X, Y, H = _whole_box(level, level.H)
    i, j = np.unravel_index(H.argmin(), H.shape)
    least = float(H[i, j])
    if not (0 < i < len(X) - 1 and 0 < j < len(Y) - 1):
        return least
    rows, columns = slice(i - 1, i + 2), slice(j - 1, j + 2)
    along = (X[rows] - X[i]) / (X[i + 1] - X[i - 1])
    across = (Y[columns] - Y[j]) / (Y[j + 1] - Y[j - 1])
    u, v = (offset.ravel() for offset in np.meshgrid(along, across, indexing="ij"))
    terms = np.stack((u**2, v**2, u * v, u, v), axis=1)
    fit = np.linalg.lstsq(terms, H[rows, columns].ravel() - least, rcond=None)[0]
    hessian = np.array([[2 * fit[0], fit[2]], [fit[2], 2 * fit[1]]])
    slope = fit[3:]
    if fit[0] <= 0.0 or np.linalg.det(hessian) <= 0.0:
        return least
    offset = -np.linalg.solve(hessian, slope)
    return least + 0.5 * float(slope @ offset) if np.abs(offset).max() <= 0.5 else least


def _whole_box(level: Level, values: Array) -> tuple[Array, Array, Array]:
    """X, Y and a nodal field over the whole box, shape (nx, ny)."""
    values = values.reshape(level.shape)
    if not level.contact.symmetric:
        return level.X, level.Y, values
    return level.X, unfolded(level.Y, sign=-1.0), unfolded(values, axis=1)


def _solution(
    conditions: Conditions,
    options: SolverOptions,
    attempt: Attempt,
    domain: tuple[float, float, float],
    record: ConvergenceRecord,
) -> ContactSolution:
    level = attempt.level
    contact = level.contact
    X, Y, H = _whole_box(level, level.H)
    films = attempt.films or [(nan, nan, nan)]
    central, minimum, approach = zip(*films, strict=True)
    noise = record.film_change[-1]
    fineness = _fineness(X, H, minimum[-1], contact)
    resolved = attempt.converged and fineness >= RESOLVED
    message = attempt.message
    if attempt.converged and not resolved:
        ratio = f"minimum film/(mesh size)^2 is {fineness:.2f}, below {RESOLVED:g}"
        message = f"converged but unresolved: {ratio}"
    solution = ContactSolution(
        conditions=conditions,
        options=options,
        X=X,
        Y=Y,
        P=_whole_box(level, level.P)[2],
        H=H,
        film_central_dimensionless=second_order(central[-2:], noise),
        film_minimum_dimensionless=second_order(minimum[-2:], noise),
        approach_dimensionless=second_order(approach[-2:], noise),
        moes_load=contact.moes_load,
        moes_lubricant=contact.moes_lubricant,
        semi_axis_ratio=contact.semi_axis_ratio,
        frame_angle=contact.frame_angle,
        semi_axis_x=contact.semi_axis_x,
        hertz_pressure=contact.hertz_pressure,
        film_scale=contact.film_scale,
        domain=domain,
        resolved=resolved,
        converged=attempt.converged,
        message=message,
        record=record,
    )
    return with_status(solution)


def _fineness(X: Array, H: Array, minimum: float, contact: ScaledContact) -> float:
    """Hmin/(S hx^2) with the mesh size hx at the minimum [-]."""
    at = min(int(np.unravel_index(H.argmin(), H.shape)[0]), len(X) - 2)
    return minimum / (contact.curvature_x * float(X[at + 1] - X[at]) ** 2)

"""History of the cycles on one level: films, equations and load after each of them, and the error
of the film that they leave.
"""

from dataclasses import dataclass, field
from itertools import pairwise
from math import inf, isfinite

import numpy as np

from ..arrays import Array
from ..grid import Grid
from .cycle import load_error, relative_residual
from .levels import Multigrid

CENTRAL = 0  # places of the central and of the minimum film
MINIMUM = 1
FILMS = (CENTRAL, MINIMUM)
# Hmin/(S hx^2) below this is unresolved, S the gap's curvature along the entrainment
RESOLVED = 5.0
CONTRACTION = (0.4, 0.9)  # bounds of the contraction of a cycle in the estimate of what it leaves
# sum |R| / sum |div(rho u H)| of the fluid nodes, and relative error of the load balance: at
# which the cycles may stop, and above which a film at rest is no solution
FINISHED = (2e-4, 1e-4)
CONVERGED = (5e-3, 1e-3)
# times that residual they may stop, too, where a cycle leaves more than the second of it: nodes at
# the edge of a cavity change to and fro while the films rest (M 180, L 10, Rx/Ry 0.88, 41 degrees)
HOVERING = (5.0, 0.7)
# oil made or lost over the oil supplied, of a contact behind a layer: likewise; 1e-4 as the first
# would save 5 % of the work (89 random contacts)
OIL_IMBALANCE = (1e-5, 1e-2)
# cycles with no smaller residual, all above CONVERGED, after which the finest level is given up
STALLED_CYCLES = 6
OSCILLATION_LIMIT = (
    0.5  # of the load error that a cycle leaves on the other side, above which cycles swing
)
LARGEST_REMAINING = 0.03  # relative film change still to come, above which nothing has converged
# the film is at rest where the cycles leave this share of the step between the levels, and no
# less than the first nor more than the second of the film
REST_FRACTION = 0.1
FILM_TOLERANCE = (1e-4, 2e-3)
# relative error of a film over the residual, sum |R| / sum |div(rho u H)|: median 0.3 to 0.8, 9 of
# 10 below 1 to 7 on 88 random contacts at 257 points
RESIDUAL_TO_FILM = 2.5
# behind a layer most of the residual sits at the meniscus, which moves by parts of a mesh, far
# from the film: it counts this share. 35 random contacts on 129 points: films off by 0.08 (median)
# to 1.9 times the residual
MENISCUS_FRACTION = 0.2
# relative error of a film over the change of its flow factors: 0.1 to 10 on 20 contacts with heat
FLOW_TO_FILM = 10.0
SMALLEST_FILM = 1e-12  # keeps a relative change finite


@dataclass(slots=True, kw_only=True)
class LevelHistory:
    """Central and minimum film before the first and after each cycle, and how well the equations
    and the load balance hold after each; all [-].
    """

    film: list[tuple[float, float]]  # central and minimum, before the first cycle and after each
    approach: list[float]  # H0, likewise
    mesh: float  # S hx^2, twice the gap's rise in a mesh along the entrainment
    strictness: float = 1.0  # factor on what the cycles may leave, see `SolverOptions`
    starved: bool = False  # behind a layer: the oil lost counts, too
    residual: list[float] = field(default_factory=list)  # relative, after each cycle
    imbalance: list[float] = field(default_factory=list)  # oil lost or gained
    load: list[float] = field(default_factory=list)  # error of the load balance
    # change of the factors of a flow model before the last cycle; 0: without one, as in all that
    # Newton's method solves
    flow: float = 0.0
    certified: bool = False  # solved by Newton's method after the last cycle

    def certify(self, state: Multigrid, index: int) -> None:
        """Record the solution of Newton's method on a level.

        Parameters
        ----------
        state : Multigrid
            levels of the contact
        index : int
            number of the level, 0 the coarsest [-]
        """
        self.record(state, index, relative_residual(state, index))
        self.certified = True

    def record(self, state: Multigrid, index: int, equations: tuple[float, float]) -> None:
        """Record films, equations and load after a cycle on a level.

        Parameters
        ----------
        state : Multigrid
            levels of the contact
        index : int
            number of the level, 0 the coarsest [-]
        equations : tuple[float, float]
            residual and imbalance of `relative_residual` [-]
        """
        level = state.levels[index]
        residual, imbalance = equations
        self.film.append(film_values(level.grid, level.H))
        self.approach.append(state.approach)
        self.residual.append(residual)
        self.imbalance.append(imbalance)
        self.load.append(load_error(state, index))
        if state.flow_model is not None:
            self.flow = state.flow_model.change(level.flow_state)

    @property
    def stalled(self) -> bool:
        """True if the equations were far from holding and the residual did not fall in the last
        cycles.
        """
        residual = self.residual
        if len(residual) <= STALLED_CYCLES or min(residual) < CONVERGED[0]:
            return False
        return min(residual[-STALLED_CYCLES:]) >= min(residual[:-STALLED_CYCLES])

    @property
    def residual_grew(self) -> bool:
        """True if the residual is larger than before the last cycle."""
        return len(self.residual) > 1 and self.residual[-1] > self.residual[-2]

    @property
    def hovers(self) -> bool:
        """True if the residual nearly lets the cycles stop and hardly fell in the last one."""
        if self.starved or len(self.residual) < 2:
            return False
        near = self.strictness * HOVERING[0] * FINISHED[0]
        return near > self.residual[-1] > HOVERING[1] * self.residual[-2]

    @property
    def oscillates(self) -> bool:
        """True if the last cycle took the load from one side to the other and hardly reduced its
        error. The mesh must resolve the film: on coarser ones the load does so in heavy contacts,
        too.
        """
        if len(self.load) < 2 or not self.resolved:
            return False
        before, last = self.load[-2:]
        return before * last < 0.0 and abs(last) > max(
            OSCILLATION_LIMIT * abs(before), CONVERGED[1]
        )

    @property
    def approaching_solution(self) -> bool:
        """True if more cycles pay: the equations hold while the films still move, or the residual
        halved in the last cycles.
        """
        if self.converged() or len(self.residual) < STALLED_CYCLES:
            return False
        near = self.residual[-STALLED_CYCLES:]
        return self._holds(CONVERGED) or near[-1] < 0.5 * near[0]

    @property
    def changes(self) -> list[float]:
        """Relative change of the films in each cycle, the larger of both [-]."""
        return [max(abs(_change(a, b, kind)) for kind in FILMS) for a, b in pairwise(self.film)]

    @property
    def fineness(self) -> float:
        """Hmin/(S hx^2) after the last cycle [-]."""
        return self.film[-1][MINIMUM] / self.mesh

    @property
    def resolved(self) -> bool:
        """True if the mesh is fine enough for the film."""
        return self.fineness >= RESOLVED

    def remaining(self, kind: int) -> float:
        """Estimate the relative film error that the cycles leave.

        change * q/(1 - q) with q the contraction of the last cycle; after one cycle its whole
        change, nothing after Newton's method. No less than a flow that still changes leaves.

        Parameters
        ----------
        kind : int
            `CENTRAL` or `MINIMUM`

        Returns
        -------
        float
            relative error [-]
        """
        return max(self._cycle_error(kind), FLOW_TO_FILM * self.flow)

    def _cycle_error(self, kind: int) -> float:
        """Estimate the error that the cycles leave of a film by its own changes [-]."""
        return (
            0.0
            if self.certified
            else _remaining_change(
                [_change(a, b, kind) for a, b in pairwise(self.film)], self.hovers
            )
        )

    def noise(self, kind: int) -> float:
        """Estimate the relative error of a film by cycles and equations that are not exact.

        Parameters
        ----------
        kind : int
            `CENTRAL` or `MINIMUM`

        Returns
        -------
        float
            relative error [-]
        """
        return max(self.remaining(kind), self._residual_error)

    @property
    def approach_noise(self) -> float:
        """Error of H0 from cycles, equations and a load balance that are not exact [-]."""
        left = (
            0.0
            if self.certified
            else _remaining_change([b - a for a, b in pairwise(self.approach)])
        )
        balance = abs(self.load[-1]) if self.load else inf
        return max(left, self._residual_error * self.film[-1][CENTRAL]) + balance

    @property
    def _residual_error(self) -> float:
        """Relative error of the films by the residual [-]."""
        fraction = MENISCUS_FRACTION if self.starved else 1.0
        return fraction * RESIDUAL_TO_FILM * self.residual[-1] if self.residual else inf

    def finished(self, below: "LevelHistory | None") -> bool:
        """Tell whether the cycles may stop.

        Equations and load hold, the films are at rest, in proportion to their step from the level
        below, and so is the flow of a model.

        Parameters
        ----------
        below : LevelHistory | None
            history of the next coarser level; None: there is none

        Returns
        -------
        bool
            True if the cycles may stop
        """
        residual, load = FINISHED
        if self.hovers:
            residual *= HOVERING[0]
        if self.starved:
            residual /= MENISCUS_FRACTION
            if not (
                self.imbalance and abs(self.imbalance[-1]) < self.strictness * OIL_IMBALANCE[0]
            ):
                return False
        if not FLOW_TO_FILM * self.flow < self.strictness * FILM_TOLERANCE[1]:
            return False
        return self._holds((self.strictness * residual, load)) and all(
            self._cycle_error(kind) < self._tolerance(below, kind) for kind in FILMS
        )

    def converged(self) -> bool:
        """Tell whether films and load are at rest and the equations hold."""
        if self.starved and not (self.imbalance and abs(self.imbalance[-1]) < OIL_IMBALANCE[1]):
            return False
        return self._holds(CONVERGED) and all(
            self.remaining(kind) < LARGEST_REMAINING for kind in FILMS
        )

    def _holds(self, limits: tuple[float, float]) -> bool:
        """Tell whether equations and load are within limits, after two cycles at least."""
        enough = self.certified or len(self.residual) >= 2
        if not enough or not self.film[-1][MINIMUM] > 0.0:
            return False
        return self.residual[-1] < limits[0] and abs(self.load[-1]) < limits[1]

    def _tolerance(self, below: "LevelHistory | None", kind: int) -> float:
        """Relative film error at which the film counts as at rest [-]."""
        if below is None:
            return self.strictness * FILM_TOLERANCE[0]
        step = abs(_change(below.film[-1], self.film[-1], kind)) / 3.0
        least, most = (self.strictness * limit for limit in FILM_TOLERANCE)
        return min(max(REST_FRACTION * step, least), most)


def start_history(state: Multigrid, index: int, strictness: float = 1.0) -> LevelHistory:
    """Start the history of a level before its first cycle.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    index : int
        number of the level, 0 the coarsest [-]
    strictness : float, default 1.0
        factor on the limits that end the cycles, see `SolverOptions` [-]

    Returns
    -------
    LevelHistory
        history with the film before the first cycle
    """
    grid = state.levels[index].grid
    mesh = state.contact.curvature_x * grid.hx**2
    film = [film_values(grid, state.levels[index].H)]
    starved = state.levels[index].film_content is not None
    return LevelHistory(
        film=film, approach=[state.approach], mesh=mesh, strictness=strictness, starved=starved
    )


def _remaining_change(changes: list[float], hovers: bool = False) -> float:
    """Estimate the change that cycles leave, change * q/(1 - q) with q the contraction of the last
    one; where equations that hover took the last one back, the limit lies between: its change.
    """
    if len(changes) < 2:
        return abs(changes[0]) if changes else inf
    before, last = changes[-2:]
    if hovers and before * last < 0.0:
        return abs(last)
    q = min(max(abs(last / before) if before else 0.0, CONTRACTION[0]), CONTRACTION[1])
    return abs(last) * q / (1.0 - q)


def _change(before: tuple[float, float], after: tuple[float, float], kind: int) -> float:
    """Relative change of a film, signed [-]."""
    change = (after[kind] - before[kind]) / max(abs(after[kind]), SMALLEST_FILM)
    return change if isfinite(change) else inf


def central_film(grid: Grid, H: Array) -> float:
    """Interpolate the film at the origin, by a cubic along x where the origin is no node.

    Parameters
    ----------
    grid : Grid
        grid of the film
    H : Array
        film, shape (ny, nx) [-]

    Returns
    -------
    float
        central film [-]
    """
    line = H[0] if grid.symmetric else H[grid.ny // 2]
    X = grid.X
    i = int(np.argmin(np.abs(X)))
    if abs(X[i]) < 1e-9 * grid.hx:
        return float(line[i])
    first = min(max(int(np.searchsorted(X, 0.0)) - 2, 0), grid.nx - 4)
    nodes = X[first : first + 4]
    values = line[first : first + 4]
    weights = [
        np.prod([-other / (node - other) for other in nodes if other != node]) for node in nodes
    ]
    return float(np.dot(weights, values))


def film_values(grid: Grid, H: Array) -> tuple[float, float]:
    """Evaluate central film, and minimum film by a parabola in each direction.

    Parameters
    ----------
    grid : Grid
        grid of the film
    H : Array
        film, shape (ny, nx) [-]

    Returns
    -------
    central
        central film [-]
    minimum
        minimum film [-]
    """
    j, i = np.unravel_index(int(np.argmin(H)), H.shape)
    minimum = float(H[j, i])
    if 0 < i < grid.nx - 1:
        minimum -= _dip(H[j, i - 1], H[j, i], H[j, i + 1])
    if 0 < j < grid.ny - 1:
        minimum -= _dip(H[j - 1, i], H[j, i], H[j + 1, i])
    return central_film(grid, H), float(minimum)


def _dip(before: float, middle: float, after: float) -> float:
    """How far the parabola through three equidistant values dips below the middle one."""
    curvature = before - 2.0 * middle + after
    return (after - before) ** 2 / (8.0 * curvature) if curvature > 0.0 else 0.0

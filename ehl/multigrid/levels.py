"""Levels of one contact: their grids, fields and workspace, and the flow model that they share.

The flow of any oil is that of a Newtonian oil of uniform temperature with factors on the terms of
Reynolds' equation. With the factors f on the Poiseuille term and the velocities (u, v) of the
Couette terms the solver's equation is

    d_X(f eps d_X P) + d_Y(f eps d_Y P) - d_X(rho u H) - d_Y(rho v H) = 0,

eps and rho those of the Newtonian oil at pressure P. The velocity field of the entrainment enters
here, and so do the frozen coefficients of a generalized Reynolds equation (Yang and Wen, 1990): a
`FlowModel` computes them before each multigrid cycle on the grid being solved, and the coarser
grids take them by injection.

The viscosity of a thinned oil follows the pressure less than the Newtonian one does: with the
share k of the change that it leaves out, a factor f evaluated at P_0 counts as f
[eta(P)/eta(P_0)]^k while P changes within the cycle. Without that a frozen factor of 1e6 in a
sliding contact turns a small error of the pressure into a large one of the flow.
"""

from dataclasses import dataclass, field, fields, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..grid import Grid, inject
from ..scaling import ScaledContact
from ..solid.deformation import DeflectionKernel, deflection_kernel
from .far_field import EdgeField, FarField, edge_field
from .starved import FilmContent, make_film_content
from .threads import Threads

NOTHING: Array = np.empty((0, 0))  # in place of a field, for kernels


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowFactors:
    """Factors on the flow of a Newtonian oil, shape (ny, nx) [-]; None is 1, or 0 for v."""

    poiseuille: Array | None = None  # f, on eps
    # k, share of ln(eta) that the factor takes back as P changes
    thinning: Array | None = None
    # ln(eta/eta_0) at P_0, at which the factors hold; needed with `thinning`
    log_viscosity: Array | None = None
    couette_x: Array | None = None  # u over u_m, the flow being rho u H
    couette_y: Array | None = None  # v over u_m; a grid of the upper half has none

    @property
    def follows(self) -> tuple[Array, Array]:
        """`thinning` and `log_viscosity`, both empty where the factors stay as they are."""
        if self.thinning is None or self.log_viscosity is None:
            return NOTHING, NOTHING
        return self.thinning, self.log_viscosity

    def coarsened(self) -> "FlowFactors":
        """Inject the factors into the next coarser grid [-]."""
        parts = {field.name: getattr(self, field.name) for field in fields(self)}
        return FlowFactors(
            **{name: None if part is None else inject(part) for name, part in parts.items()}
        )


class FlowModel(Protocol):
    """Source of the factors; it has no state of its own."""

    @property
    def symmetric(self) -> bool:
        """True if the factors keep a contact even in Y that is so without them."""

    @property
    def accelerated(self) -> bool:
        """True if cycles with its factors may be accelerated, False if some swing for ever."""

    def factors(
        self, contact: ScaledContact, grid: Grid, P: Array, H: Array, last: Any
    ) -> tuple[FlowFactors, Any]:
        """Evaluate the factors on a grid, the entrainment's velocity field included.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact
        grid : Grid
            grid of the level
        P : Array
            pressure, shape (ny, nx) [-]
        H : Array
            film, shape (ny, nx) [-]
        last : Any
            state of the last cycle on the grid; on its first cycle `refined` of the grid below,
            None where that has none

        Returns
        -------
        factors
            factors on the flow [-]
        state
            state that the next cycle on the grid takes as `last`
        """

    def refined(self, state: Any) -> Any:
        """Interpolate the state of a grid to the next finer one, for its first cycle.

        Parameters
        ----------
        state : Any
            state of the coarser grid

        Returns
        -------
        Any
            state of the finer grid
        """

    def change(self, state: Any) -> float:
        """Measure by how much the factors changed before the last cycle.

        Parameters
        ----------
        state : Any
            state after that cycle

        Returns
        -------
        float
            change relative to the flow [-]
        """


def entrainment_factors(contact: ScaledContact, grid: Grid) -> FlowFactors:
    """Evaluate the velocity field u = u_0 - Omega Y, v = v_0 + Omega X over u_m on a grid.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact
    grid : Grid
        grid of the level

    Returns
    -------
    FlowFactors
        factors on the Couette terms [-]
    """
    if contact.symmetric:
        return FlowFactors()
    ones = np.ones((grid.ny, grid.nx))
    return FlowFactors(
        couette_x=(contact.velocity_x - contact.rotation * grid.Y[:, None]) * ones,
        couette_y=(contact.velocity_y + contact.rotation * grid.X[None, :]) * ones,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Damping:
    """Under-relaxation of one solve, all [-]."""

    jacobi: float = 0.35  # of the distributive Jacobi changes
    gauss_seidel: float = 1.0  # factor on 0.4 + 0.6 eps/(eps + 1)
    correction: float = 1.0  # of the coarse-grid correction
    approach: float = 0.1  # of the change of H0 by the load balance, on the coarsest grid
    # Gauss-Seidel where Poiseuille exceeds this share of K00/hx, times (hy/hx)^1.5 if stretched
    switch: float = 0.3

    def halved(self) -> "Damping":
        """Half the changes, three quarters of the coarse-grid correction."""
        return replace(
            self,
            jacobi=0.5 * self.jacobi,
            gauss_seidel=0.5 * self.gauss_seidel,
            correction=0.75 * self.correction,
            approach=0.5 * self.approach,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeStep:
    """Terms that one step in time adds to the equations, the same on every level; all [-]."""

    rate: float  # sigma: sigma rho H leaves Reynolds' equation
    couette: float  # factor on the Couette terms: speed over u_m, none along the characteristic
    load: float  # g, integral of P that the contact carries at the time
    # resistance of the bodies' mass to a change of H0: the load carried is g + inertia (H0 - free)
    inertia: float = 0.0
    free: float = 0.0  # H0 of bodies that the film does not slow down


@dataclass(slots=True, kw_only=True)
class Level:
    """Workspace of one grid; all arrays of shape (ny, nx), all quantities [-]."""

    grid: Grid  # nodes of the level
    kernel: DeflectionKernel  # of the deflection
    gap: Array  # S X^2/2 + T Y^2/2 + C X Y
    P: Array  # pressure
    H: Array  # film
    f: Array  # right side of Reynolds' equation
    s: Array  # film without deflection and H0
    eps: Array  # flow coefficient
    flow_x: Array  # rho u
    slope_x: Array  # u d(rho)/dP
    flow_y: Array  # rho v; empty if nothing flows along Y
    slope_y: Array  # v d(rho)/dP
    scratch: Array  # always zero on the edge
    node_types: NDArray[np.int8]  # of the nodes in the last sweep
    factors: FlowFactors  # of the flow model and the entrainment
    # density and its derivative by P over a time step, shape (2, ny, nx); empty in steady contacts
    storage: Array = field(default_factory=lambda: np.zeros((0, 0, 0)))
    film_content: FilmContent | None = None  # where the inlet carries a layer; None: flooded
    # pressure that s already holds the deflection of; below the level being solved
    start: Array | None = None
    load: float = 0.0  # that the box carries
    flow_state: Any = None  # of the flow model after the last cycle on this level
    edge: EdgeField | None = None  # on the edge of the grid, of the last far field there


@dataclass(slots=True, kw_only=True)
class Multigrid:
    """All levels of one contact, the approach they share and the work done; all quantities [-]."""

    contact: ScaledContact  # scaled contact
    far_field: FarField | None  # edge pressure of an open box; None: zero pressure on the edge
    levels: tuple[Level, ...]  # coarsest first
    damping: Damping  # of the cycles, halved where one diverged
    flow_model: FlowModel | None = None  # None: Newtonian, of uniform temperature
    threads: Threads = field(default_factory=Threads)  # that share the lines
    approach: float = 0.0  # H0
    exterior: float = 0.0  # load outside the box
    time_step: TimeStep | None = None  # None: a steady contact
    oscillates: bool = (
        False  # whether cycles took the load from one side to the other, see `iterate_level`
    )
    deflections: dict[int, int] = field(default_factory=dict)  # level -> number of deflection FFTs

    def edge_field(self, level: Level) -> EdgeField | None:
        """Give the far field on the edge of a level, evaluated on demand.

        Parameters
        ----------
        level : Level
            level of the contact

        Returns
        -------
        EdgeField | None
            far field on its edge; None for a closed box
        """
        if self.far_field is not None and (
            level.edge is None or level.edge.field is not self.far_field
        ):
            level.edge = edge_field(self.far_field, level.grid)
        return None if self.far_field is None else level.edge

    def deflected_nodes(self) -> int:
        """Nodes times deflection FFTs so far, the measure of the work."""
        return sum(count * self.levels[index].P.size for index, count in self.deflections.items())


def make_multigrid(
    contact: ScaledContact, grids: tuple[Grid, ...], far_field: FarField | None, damping: Damping
) -> Multigrid:
    """Allocate the levels of a contact.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact
    grids : tuple[Grid, ...]
        grids, coarsest first
    far_field : FarField | None
        pressure on an open edge; None: zero pressure on the edge
    damping : Damping
        under-relaxation of the solve

    Returns
    -------
    Multigrid
        levels, coarsest first
    """
    levels = []
    for grid in grids:
        gap = contact.gap(grid.X[None, :], grid.Y[:, None])
        shape = (grid.ny, grid.nx)
        levels.append(
            Level(
                grid=grid,
                kernel=deflection_kernel(grid, contact.deformation, contact.coating),
                gap=gap,
                s=gap,
                P=np.zeros(shape),
                H=np.zeros(shape),
                f=np.zeros(shape),
                eps=np.zeros(shape),
                flow_x=np.zeros(shape),
                slope_x=np.zeros(shape),
                flow_y=np.zeros((0, 0) if grid.symmetric else shape),
                slope_y=np.zeros((0, 0) if grid.symmetric else shape),
                scratch=np.zeros(shape),
                node_types=np.zeros(shape, dtype=np.int8),
                factors=entrainment_factors(contact, grid),
                film_content=None
                if contact.inlet_layer is None
                else make_film_content(contact.inlet_layer, grid, contact.lateral),
            )
        )
    return Multigrid(contact=contact, far_field=far_field, levels=tuple(levels), damping=damping)

"""Flow of an oil as factors on the terms of Reynolds' equation for a Newtonian oil of uniform
temperature.

With the factors f on the Poiseuille term and the velocities (u, v) of the Couette terms the
solver's equation is

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

from dataclasses import dataclass, fields
from typing import Any, Protocol

import numpy as np

from ..arrays import Array
from ..grid import Grid
from ..scaling import ScaledContact
from .transfer import inject

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

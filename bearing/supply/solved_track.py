"""One track over many passes, each solved behind the layer that the last one left, with its
profile across the track.

The layer that leaves a contact has a plateau in the track and ridges beside it. What is left of it
after the loss l between two balls, with what the supply adds, is the layer of the next contact:

    H_oil,n+1(Y) = (1 - l) H_left,n(Y) + D.

The balance along Y is the solver's: what leaves one box enters the next, but for oil that crosses
the sides of the box. What a mesh does not see is the side flow inside a severely starved contact
(`side_flow`): below about a third of the flooded film the solved passes lose too little.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ehl import ContactConditions, ContactSolution, InletLayer, MoesConditions, SolverOptions
from ehl.arrays import Array

Solve = Callable[[ContactConditions | MoesConditions, SolverOptions], ContactSolution]

DRY = 1.0e-4  # of the mean layer: a place with less counts as having so much [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackPasses:
    """Contacts behind one another on one track."""

    number: int  # [-]
    loss: float = 0.0  # share of a layer that is lost between two of them [-]
    added: float = 0.0  # layer added there, in units of the conditions' [m], [a^2/Rx]


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedPass:
    """One pass of a track."""

    solution: ContactSolution
    inlet: Array  # shape (ny,): layer at the inlet over Y [a^2/Rx]
    outlet: Array  # shape (ny,): layer that leaves [a^2/Rx]

    @property
    def ratio(self) -> float:
        """Layer on the centre line over the oil of the flooded film [-]."""
        assert self.solution.supply is not None
        return self.solution.supply.inlet_ratio

    @property
    def share(self) -> float:
        """Central film over the flooded one of the same box [-]."""
        supply = self.solution.supply
        assert supply is not None
        return self.solution.film_central_dimensionless.value / supply.flooded_central.value

    @property
    def ridge_ratio(self) -> float:
        """Thickest part of the layer that leaves over that on the centre line [-]."""
        return float(self.outlet.max() / self.outlet[abs(self.solution.Y).argmin()])

    @property
    def kept(self) -> float:
        """Oil that leaves over oil that enters, over the whole width of the box [-]."""
        return float(np.trapezoid(self.outlet) / np.trapezoid(self.inlet))


def solved_passes(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    track: TrackPasses,
    solve: Solve,
    first: ContactSolution | None = None,
) -> tuple[SolvedPass, ...]:
    """The passes of a track; fewer where one does not converge, which is the last one then.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        with the layer of the first pass [m] or [a^2/Rx]
    options : SolverOptions
        of the solver
    track : TrackPasses
        number of passes, loss and added oil
    solve : Solve
        solves one contact
    first : ContactSolution | None, optional
        solution of the first pass, if it is computed already

    Returns
    -------
    tuple[SolvedPass, ...]
        in their order

    Raises
    ------
    ValueError
        without a layer
    """
    if conditions.inlet_layer is None:
        raise ValueError("inlet_layer is needed for the first pass of a track")
    passes: list[SolvedPass] = []
    solution = first or solve(conditions, options)
    while True:
        if solution.supply is None or solution.supply.outlet_layer is None:
            break
        layer = conditions.inlet_layer
        assert layer is not None
        length = solution.semi_axis_x or 1.0
        height = solution.film_scale or 1.0
        outlet = solution.supply.outlet_layer
        places = solution.Y * length
        passes.append(
            SolvedPass(solution=solution, inlet=layer.at(places) / height, outlet=outlet)
        )
        if not solution.converged or len(passes) == track.number:
            break
        following = (1.0 - track.loss) * outlet * height + track.added
        floor = DRY * float(following.mean())
        profile = InletLayer(
            thickness=tuple(np.maximum(following, floor).tolist()), y=tuple(places.tolist())
        )
        conditions = replace(conditions, inlet_layer=profile)
        solution = solve(conditions, options)
    return tuple(passes)

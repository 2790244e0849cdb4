"""What a layer of oil at the inlet leaves of a flooded film, from two solutions in one box."""

import numpy as np
from numpy.typing import NDArray

from ..grid import unfolded
from ..oil.lubricant import density
from ..scaling import ScaledContact
from ..solution import ContactSolution, OilSupply
from .levels import Multigrid

Array = NDArray[np.float64]


def starved_film_guess(flooded: float, ratio: float) -> float:
    """Central film to start from behind a layer, H r/(1 + r^3)^(1/3) [-]: between all of the layer
    and the flooded film; a guess too thick diverges, one too thin costs nothing.
    """
    return flooded * ratio / (1.0 + ratio**3) ** (1.0 / 3.0)


def inlet_ratio(layer: float, flooded: ContactSolution, contact: ScaledContact) -> float:
    """Layer over the oil that the flooded film takes along, rho(P(0, 0)) H_c [-]."""
    P = flooded.P[int(np.abs(flooded.X).argmin()), int(np.abs(flooded.Y).argmin())]
    return layer / (_density(float(P), contact) * flooded.film_central_dimensionless.value)


def _density(P: float, contact: ScaledContact) -> float:
    """Over that at ambient pressure [-]."""
    if contact.oil is not None:
        at = density(np.array([0.0, P * contact.hertz_pressure]), contact.oil)
        return float(at[1] / at[0])
    return 1.0 + contact.density_numerator * P / (1.0 + contact.density_denominator * P)


def turned_round(levels: Multigrid) -> str:
    """Why a contact is not solved behind a layer: oil that runs against the entrainment somewhere
    in its box; empty where none does.
    """
    along = levels.levels[-1].factors.couette_x
    if along is None or float(along.min()) > 0.0:
        return ""
    return (
        "not converged: the spin turns the entrainment round inside the box of the contact; films "
        "behind a layer are solved where all oil runs one way"
    )


def oil_supply(
    flooded: ContactSolution, starved: ContactSolution, levels: Multigrid, ratio: float
) -> OilSupply:
    """What the layer does, from the finest of the levels of the starved solution [-]."""
    level = levels.levels[-1]
    fill = level.fill
    assert fill is not None
    grid = level.grid
    # 1. share of the gap that is filled, at the outgoing faces; the edges as beside them
    own = level.flow_x * level.H
    full = 1.5 * own
    full[:, 1:] -= 0.5 * own[:, :-1]
    filled = np.ones_like(own)
    np.divide(fill.along, full, out=filled, where=(fill.empty > 0) & (full > 0.0))
    filled = np.clip(filled, 0.0, 1.0)
    filled[:, [0, -1]] = filled[:, [1, -2]]
    # 2. layer that leaves the box
    factor = level.factors.couette_x
    outlet = fill.along[:, -2] / (1.0 if factor is None else factor[:, -2])
    for values in (filled, outlet):
        values[-1] = values[-2]
        if not grid.symmetric:
            values[0] = values[1]
    if grid.symmetric:
        outlet, filled = unfolded(outlet), unfolded(filled)
    return OilSupply(
        flooded_central=flooded.film_central_dimensionless,
        flooded_minimum=flooded.film_minimum_dimensionless,
        inlet_ratio=ratio,
        meniscus=_meniscus(starved, fill.empty[0 if grid.symmetric else grid.ny // 2]),
        rolling_moment_ratio=_moment(starved) / _moment(flooded),
        outlet_layer=outlet,
        filled=filled.T,
    )


def _meniscus(solution: ContactSolution, empty: NDArray[np.int8]) -> float | None:
    """Where the gap fills ahead of the centre on the line Y = 0, half a mesh before the first full
    node behind the last empty one [-]; None where the box begins full.
    """
    ahead = np.flatnonzero((empty > 0) & (solution.X < 0.0))
    if not ahead.size:
        return None
    return float(solution.X[ahead[-1]] + 0.5 * (solution.X[1] - solution.X[0]))


def _moment(solution: ContactSolution) -> float:
    """Of the pressure in the box about the centre [-]."""
    cell = (solution.X[1] - solution.X[0]) * (solution.Y[1] - solution.Y[0])
    return float(-(solution.X[:, None] * solution.P).sum() * cell)

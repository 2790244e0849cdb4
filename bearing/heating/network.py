"""Network of heat: temperatures of nodes between which conductances lie.

    steady:     Q_n + sum_m G_nm (T_m - T_n) = 0
    transient:  C_n dT_n/dt = the same left side

Temperatures of boundaries are given. A fluid that comes at the temperature of a boundary and
leaves at that of a node is a conductance rho c V between them.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ehl.arrays import Array

from .conductances import Conductance

NODES = (
    "shaft",
    "inner_ring",
    "balls",
    "outer_ring_loaded",
    "outer_ring_unloaded",
    "cage",
    "oil",
    "housing",
)
AMBIENT = "ambient"
OIL_SUPPLY = "oil_supply"
BOUNDARIES = (AMBIENT, OIL_SUPPLY)


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatPath:
    """Conductance between two nodes, or a node and a boundary."""

    first: str
    second: str
    conductance: Conductance  # [W/K]
    description: str  # with the source

    @property
    def name(self) -> str:
        """Both ends, as in results."""
        return f"{self.first}-{self.second}"


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatNetwork:
    """Paths between `NODES` and to boundaries of given temperatures."""

    paths: tuple[HeatPath, ...]
    boundaries: Mapping[str, float]  # [K]

    def matrix(self, end: int = 0) -> tuple[Array, Array]:
        """L and b of the heat that leaves the nodes, L T - b.

        Parameters
        ----------
        end : int, default 0
            end of the ranges: -1 low, 1 high, 0 the value [-]

        Returns
        -------
        leaving
            L, shape (nodes, nodes) [W/K]
        prescribed
            b, shape (nodes,) [W]
        """
        leaving = np.zeros((len(NODES), len(NODES)))
        prescribed = np.zeros(len(NODES))
        for path in self.paths:
            g = path.conductance.end(end)
            ends = (path.first, path.second), (path.second, path.first)
            for node, neighbour in ends:
                if node not in NODES:
                    continue
                row = NODES.index(node)
                leaving[row, row] += g
                if neighbour in NODES:
                    leaving[row, NODES.index(neighbour)] -= g
                else:
                    prescribed[row] += g * self.boundaries[neighbour]
        return leaving, prescribed

    def temperatures(self, sources: Array, end: int = 0) -> Array:
        """Temperatures of the nodes under heat sources.

        Parameters
        ----------
        sources : Array
            heat into the nodes, shape (nodes,) [W]
        end : int, default 0
            end of the ranges: -1 low, 1 high, 0 the value [-]

        Returns
        -------
        Array
            temperatures, shape (nodes,) [K]

        Raises
        ------
        ValueError
            if heat cannot leave a node
        """
        leaving, prescribed = self.matrix(end)
        scale = np.sqrt(np.diag(leaving))
        if not (scale > 0.0).all():
            isolated = [name for name, entry in zip(NODES, scale, strict=True) if not entry > 0.0]
            raise ValueError(f"no heat leaves {', '.join(isolated)}")
        even = leaving / np.outer(scale, scale)
        if np.linalg.eigvalsh(even)[0] < 1e-12:
            raise ValueError("no heat leaves the bearing: all paths to the surroundings are zero")
        return np.asarray(np.linalg.solve(even, (sources + prescribed) / scale) / scale)

    def flows(self, temperatures: Array) -> tuple[float, ...]:
        """Heat along each path, from its first to its second end.

        Parameters
        ----------
        temperatures : Array
            temperatures of the nodes, shape (nodes,) [K]

        Returns
        -------
        tuple[float, ...]
            heat of each path [W]
        """
        by_name = dict(zip(NODES, temperatures, strict=True)) | dict(self.boundaries)
        return tuple(
            float(path.conductance.value * (by_name[path.first] - by_name[path.second]))
            for path in self.paths
        )

    def removed(self, temperatures: Array) -> float:
        """Heat that leaves by all boundaries.

        Parameters
        ----------
        temperatures : Array
            temperatures of the nodes, shape (nodes,) [K]

        Returns
        -------
        float
            heat [W]
        """
        pairs = zip(self.paths, self.flows(temperatures), strict=True)
        return sum(flow for path, flow in pairs if path.second in BOUNDARIES)

    def imbalance(self, temperatures: Array, sources: Array) -> float:
        """Energy error: heat of the sources less what leaves, in all and on the worst node.

        Parameters
        ----------
        temperatures : Array
            temperatures of the nodes, shape (nodes,) [K]
        sources : Array
            heat into the nodes, shape (nodes,) [W]

        Returns
        -------
        float
            error over the heat [-]
        """
        heat = float(np.abs(sources).sum())
        if heat == 0.0:
            return 0.0
        leaving, prescribed = self.matrix()
        nodes = np.abs(sources + prescribed - leaving @ temperatures).max()
        total = abs(float(sources.sum()) - self.removed(temperatures))
        return max(float(nodes), total) / heat


def node_values(values: Mapping[str, float]) -> Array:
    """Values by the names of nodes in the order of `NODES`.

    Parameters
    ----------
    values : Mapping[str, float]
        values by name; a node without one is zero

    Returns
    -------
    Array
        values, shape (nodes,) [any unit], [-]
    """
    return np.array([values.get(name, 0.0) for name in NODES])

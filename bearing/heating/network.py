"""Network of heat: temperatures of nodes between which conductances lie, and the conductances of
the parts around a contact.

    steady:     Q_n + sum_m G_nm (T_m - T_n) = 0
    transient:  C_n dT_n/dt = the same left side

Temperatures of boundaries are prescribed. A fluid that comes at the temperature of a boundary and
leaves at that of a node is a conductance rho c V between them. Conductances of cylinder, fin and
ring are Fourier's equation in one dimension; coefficients of surfaces to air and oil are
correlations, whose ranges are wide. Each is in closed form, with its range.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import log, pi, sqrt, tanh

import numpy as np

from oilfilm.ehl.arrays import Array

STEFAN_BOLTZMANN = 5.670374e-8  # [W/(m^2 K^4)]
# coefficient of a flat plate in laminar flow, Nu = C Pr^(1/3) Re^(1/2) [-]: theory (Pohlhausen,
# 1921), and as Harris prints it (from memory, unverified), a tenth; which of them holds in a
# bearing's cavity is open; the rings of NASA's bearing are those of the upper half
PLATE = 0.332
PLATE_HARRIS = 0.0332
# Nu = 0.133 Re^(2/3) Pr^(1/3) of a shaft that turns in air, Re = omega d^2/nu < 4e5 (from memory,
# unverified; known to a factor of two) [-]
ROTATING = 0.133
# air at 50 C and 1 bar: k, nu, Pr, rho c (handbook values; `fluids` agrees within 2 %)
AIR_CONDUCTIVITY = 0.0279  # [W/(m K)]
AIR_VISCOSITY = 1.80e-5  # [m^2/s]
AIR_PRANDTL = 0.71
AIR_CAPACITY = 1100.0  # [J/(m^3 K)]

NODES = tuple(
    "shaft inner_ring balls outer_ring_loaded outer_ring_unloaded cage oil housing".split()
)
AMBIENT = "ambient"
OIL_SUPPLY = "oil_supply"


@dataclass(frozen=True, slots=True)
class Conductance:
    """Conductance of a path of heat, with the ends of its range [W/K]."""

    value: float
    low: float
    high: float

    @classmethod
    def exactly(cls, value: float) -> "Conductance":
        """A conductance without a range.

        Parameters
        ----------
        value : float
            conductance [W/K]

        Returns
        -------
        Conductance
            conductance with equal ends
        """
        return cls(value, value, value)

    def times(self, factor: float) -> "Conductance":
        """A multiple of the conductance and its range.

        Parameters
        ----------
        factor : float
            factor [-]

        Returns
        -------
        Conductance
            the multiple
        """
        return Conductance(factor * self.value, factor * self.low, factor * self.high)

    def exchanged(self) -> "Conductance":
        """The conductance with the ends of its range in exchange."""
        return Conductance(self.value, self.high, self.low)

    def end(self, which: int) -> float:
        """An end of the range.

        Parameters
        ----------
        which : int
            -1 the low end, 0 the value, 1 the high end [-]

        Returns
        -------
        float
            conductance [W/K]
        """
        return (self.low, self.value, self.high)[which + 1]


def in_series(*parts: Conductance) -> Conductance:
    """Conductances one after the other; zero if one is.

    Parameters
    ----------
    *parts : Conductance
        conductances

    Returns
    -------
    Conductance
        their series connection [W/K]
    """
    return Conductance(*(_series([part.end(k) for part in parts]) for k in (0, -1, 1)))


def _series(parts: list[float]) -> float:
    return 0.0 if min(parts) <= 0.0 else 1.0 / sum(1.0 / part for part in parts)


def side_by_side(*parts: Conductance) -> Conductance:
    """Conductances between the same two nodes.

    Parameters
    ----------
    *parts : Conductance
        conductances

    Returns
    -------
    Conductance
        their parallel connection [W/K]
    """
    return Conductance(*(sum(part.end(k) for part in parts) for k in (0, -1, 1)))


def cylinder_conductance(conductivity: float, width: float, inner: float, outer: float) -> float:
    """Conductance through a cylindrical wall, 2 pi k B/ln(d_2/d_1).

    Parameters
    ----------
    conductivity : float
        k [W/(m K)]
    width : float
        B [m]
    inner, outer : float
        diameters d_1 and d_2 [m]

    Returns
    -------
    float
        conductance [W/K]
    """
    return 2.0 * pi * conductivity * width / log(outer / inner)


def fin_conductance(
    coefficient: float, perimeter: float, conductivity: float, area: float, length: float
) -> float:
    """Conductance of a rod whose end gives off no heat, sqrt(h P k A) tanh(m L), m = sqrt(h P/(k
    A)).

    Parameters
    ----------
    coefficient : float
        h [W/(m^2 K)]
    perimeter : float
        P [m]
    conductivity : float
        k [W/(m K)]
    area : float
        A [m^2]
    length : float
        L [m]

    Returns
    -------
    float
        conductance [W/K]
    """
    root = sqrt(coefficient * perimeter * conductivity * area)
    return root * tanh(root / (conductivity * area) * length)


def ring_halves_conductance(conductivity: float, section: float, radius: float) -> float:
    """Conductance between the mean temperatures of the halves of a ring, 6 k A/(pi r).

    One half is heated evenly and the other cooled evenly. From the middle of a half to the cut, l
    = pi r/2, flows half of the heat over both cuts: the mean lies Q l/(6 k A) above the cut, twice
    that between the halves.

    Parameters
    ----------
    conductivity : float
        k [W/(m K)]
    section : float
        A [m^2]
    radius : float
        mean radius r [m]

    Returns
    -------
    float
        conductance [W/K]
    """
    return 6.0 * conductivity * section / (pi * radius)


def plate_coefficients(
    speed: float, length: float, conductivity: float, viscosity: float, prandtl: float
) -> Conductance:
    """Coefficient of a wall to a fluid that passes it, C k Pr^(1/3) sqrt(u/(nu x)).

    C between Harris' and that of theory, their mean as the value (assumed).

    Parameters
    ----------
    speed : float
        u [m/s]
    length : float
        x [m]
    conductivity : float
        k of the fluid [W/(m K)]
    viscosity : float
        kinematic viscosity nu [m^2/s]
    prandtl : float
        Pr [-]

    Returns
    -------
    Conductance
        coefficient per area with its range [W/(m^2 K)]
    """
    unit = conductivity * prandtl ** (1.0 / 3.0) * sqrt(speed / (viscosity * length))
    return Conductance(0.5 * (PLATE + PLATE_HARRIS) * unit, PLATE_HARRIS * unit, PLATE * unit)


def rotating_coefficient(speed: float, diameter: float) -> float:
    """Heat transfer coefficient of a shaft that turns in air.

    Parameters
    ----------
    speed : float
        speed of the shaft [rad/s]
    diameter : float
        diameter of the shaft [m]

    Returns
    -------
    float
        coefficient [W/(m^2 K)]
    """
    reynolds = abs(speed) * diameter**2 / AIR_VISCOSITY
    nusselt = ROTATING * reynolds ** (2.0 / 3.0) * AIR_PRANDTL ** (1.0 / 3.0)
    return nusselt * AIR_CONDUCTIVITY / diameter


def radiation_coefficient(emissivity: float, temperature: float) -> float:
    """Coefficient 4 eps sigma T^3 of a surface near a temperature.

    Parameters
    ----------
    emissivity : float
        eps [-]
    temperature : float
        T [K]

    Returns
    -------
    float
        coefficient [W/(m^2 K)]
    """
    return 4.0 * emissivity * STEFAN_BOLTZMANN * temperature**3


@dataclass(frozen=True, slots=True)
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
    """Paths between nodes, of a bearing `NODES`, and to boundaries of given temperatures."""

    paths: tuple[HeatPath, ...]
    boundaries: Mapping[str, float]  # [K]
    nodes: tuple[str, ...] = NODES

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
        leaving = np.zeros((len(self.nodes), len(self.nodes)))
        prescribed = np.zeros(len(self.nodes))
        for path in self.paths:
            g = path.conductance.end(end)
            ends = (path.first, path.second), (path.second, path.first)
            for node, neighbour in ends:
                if node not in self.nodes:
                    continue
                row = self.nodes.index(node)
                leaving[row, row] += g
                if neighbour in self.nodes:
                    leaving[row, self.nodes.index(neighbour)] -= g
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
            isolated = [
                name for name, entry in zip(self.nodes, scale, strict=True) if not entry > 0.0
            ]
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
        by_name = dict(zip(self.nodes, temperatures, strict=True)) | dict(self.boundaries)
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
        return sum(flow for path, flow in pairs if path.second not in self.nodes)

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

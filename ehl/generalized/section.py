"""Nodes across the film, Gauss-Lobatto, with weights, integrals and differences."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from ..arrays import Array

# across the film: integrals exact for polynomials of degree 21. A multiple of four, as many
# numbers as a register holds: with 11, three of them alone, a film with heat takes a tenth longer
NODES = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Nodes z/h across the film, walls included, with integration."""

    nodes: Array  # z/h, shape (n,) [-]
    weights: Array  # of the integral over the film, shape (n,) [-]
    cumulative: Array  # C @ f: integral of f from 0 to each node, shape (n, n) [-]

    @property
    def integration(self) -> tuple[Array, Array, Array]:
        """Nodes, weights and cumulative matrix, as kernels take them [-]."""
        return self.nodes, self.weights, self.cumulative


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmFields:
    """Pressure, film and surface velocities of a grid, SI; (ny, nx) or (2, ny, nx)."""

    p: Array  # [Pa]
    h: Array  # [m]; not positive: no film
    gradient: Array  # [Pa/m]
    speed_1: Array  # velocity of body 1, at z = 0 [m/s]
    speed_2: Array  # velocity of body 2, at z = h [m/s]


def film_section(count: int = NODES) -> Section:
    """Build the Legendre-Gauss-Lobatto nodes on [0, 1] across the film, and their matrices.

    Parameters
    ----------
    count : int, default NODES
        number of nodes, at least 3 [-]

    Returns
    -------
    Section
        nodes, weights and matrices [-]
    """
    if count < 3:
        raise ValueError(f"count must be at least 3, got {count}")
    highest = np.zeros(count)
    highest[-1] = 1.0  # P_(count - 1)
    x = np.concatenate(([-1.0], np.real(legendre.legroots(legendre.legder(highest))), [1.0]))
    weights = 2.0 / (count * (count - 1) * legendre.legval(x, highest) ** 2)
    inverse = np.linalg.inv(legendre.legvander(x, count - 1))
    unit = np.eye(count)
    columns = [legendre.legval(x, legendre.legint(row, lbnd=-1.0)) for row in unit]
    integrals = np.stack(columns, axis=1)
    return Section(
        nodes=0.5 * (x + 1.0),
        weights=np.asarray(0.5 * weights, dtype=np.float64),
        cumulative=0.5 * integrals @ inverse,
    )


def wall_slopes(section: Section) -> tuple[Array, Array]:
    """Give the weights of dT/d(z/h) at both walls on the three nodes next to each.

    Parameters
    ----------
    section : Section
        nodes across the film

    Returns
    -------
    first
        weights at the wall of body 1, shape (n,) [-]
    second
        weights at the wall of body 2, shape (n,) [-]
    """
    z = section.nodes
    below, above = np.zeros((2, z.size))
    a, b = z[1], z[2]
    below[:3] = -(a + b) / (a * b), b / (a * (b - a)), -a / (b * (b - a))
    above[-3:] = -below[2::-1]
    return below, above

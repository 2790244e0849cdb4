"""Temperature of one column of film in NumPy. The reference for
`ehl.generalized._heat_kernels.column_temperature`, where the equations stand.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehl.generalized.section import Section, curvature, wall_slopes

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatColumn:
    """Coefficients of one column, SI; arrays of shape (n,) unless said otherwise."""

    film: float  # h [m]
    conductivity: float  # k [W/(m K)]
    inflow: Array  # rho c (|u|/dx + |v|/dy) at the nodes [W/(m^3 K)]
    carried: Array  # the same parts times the temperatures they come from, summed [W/m^3]
    crossing: Array  # rho c W/h [W/(m^3 K)]
    source: Array  # tau . rate at the last temperature [W/m^3]
    slope: Array  # its derivative by the temperatures, shape (n, n) [W/(m^3 K)]
    compression: Array  # eps (u p_x + v p_y) [W/(m^3 K)]
    last: Array  # last temperature [K]
    history: tuple[float, float]  # of body 1 and body 2 by the heat taken up before [K]
    response: tuple[float, float]  # R of body 1 and body 2 [K m^2/W]


def upwind(crossing: Array, section: Section) -> Array:
    """Matrix of W dT/d(zeta) at the nodes inside, the slope taken where W comes from, shape (n, n)
    [unit of W].
    """
    z = section.nodes
    matrix = np.zeros((z.size, z.size))
    for k in range(1, z.size - 1):
        m = k - 1 if crossing[k] >= 0.0 else k
        matrix[k, m : m + 2] = np.array([-1.0, 1.0]) * crossing[k] / (z[m + 1] - z[m])
    return matrix


def column_temperature(column: HeatColumn, section: Section) -> Array:
    """Temperature at the nodes of a column, its source linearised at the last one, shape (n,) [K]."""
    c = column
    matrix = np.diag(c.inflow - c.compression) + upwind(c.crossing, section) - c.slope
    matrix -= c.conductivity / c.film**2 * curvature(section)
    right = c.carried + c.source - c.slope @ c.last
    below, above = wall_slopes(section)
    for wall, slope, body in ((0, -below, 0), (-1, above, 1)):
        matrix[wall] = c.response[body] * c.conductivity / c.film * slope
        matrix[wall, wall] += 1.0
        right[wall] = c.history[body]
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)

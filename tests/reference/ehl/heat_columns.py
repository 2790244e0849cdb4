"""Temperature of one column of film in NumPy. The reference for
`oilfilm.ehl.generalized._heat_kernels.column_temperature`, where the equations stand.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.generalized.film_heat import Section, wall_slopes

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


def conduction(spread: Array, section: Section) -> Array:
    """Matrix of spread d2T/d(zeta)2 at the nodes inside, three-point differences, shape (n, n)."""
    z = section.nodes
    matrix = np.zeros((z.size, z.size))
    for k in range(1, z.size - 1):
        down, up = z[k] - z[k - 1], z[k + 1] - z[k]
        weights = np.array([1.0 / down, -1.0 / down - 1.0 / up, 1.0 / up])
        matrix[k, k - 1 : k + 2] = spread[k] * weights * 2.0 / (down + up)
    return matrix


def conduction_left(spread: float, crossing: Array, section: Section) -> Array:
    """What remains of k/h^2 beside the conduction of upwind differences, shape (n,)."""
    steps = np.diff(section.nodes, prepend=np.nan, append=np.nan)
    own = 0.5 * np.abs(crossing) * np.where(crossing >= 0.0, steps[:-1], steps[1:])
    return np.asarray(spread**2 / (own + np.hypot(spread, own)), dtype=np.float64)


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


def column_temperature(column: HeatColumn, section: Section, *, second_order: bool = False) -> Array:
    """Temperature at the nodes of a column, its source linearised at the last one, shape (n,) [K]."""
    c = column
    matrix = np.diag(c.inflow - c.compression) + upwind(c.crossing, section) - c.slope
    spread = np.full(section.nodes.size, c.conductivity / c.film**2)
    matrix -= conduction(conduction_left(spread[0], c.crossing, section) if second_order else spread, section)
    right = c.carried + c.source - c.slope @ c.last
    below, above = wall_slopes(section)
    for wall, slope, body in ((0, -below, 0), (-1, above, 1)):
        matrix[wall] = c.response[body] * c.conductivity / c.film * slope
        matrix[wall, wall] += 1.0
        right[wall] = c.history[body]
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)

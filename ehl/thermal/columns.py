r"""Temperature of one column of film in NumPy: the readable twin of `_kernels.column_temperature`.

Heat equation across the film at zeta = z/h, convection by upwind differences along x and y:

.. math::
    \rho c\,(u\,T_x + v\,T_y) + \frac{\rho c\,W}{h}\,T_\zeta = \frac{k}{h^2}\,T_{\zeta\zeta} + \tau\cdot\dot\gamma
    + \epsilon\,T\,(u\,p_x + v\,p_y),

W the velocity through the lines of constant zeta, which continuity gives. At the nodes inside by collocation; at the
walls the bodies' temperatures answer the flux they take up,

.. math:: T = T_{hist} + R\,q, \qquad q = \pm\frac{k}{h}\,T_\zeta .

Conduction along the film is left out: it is thin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..generalized_reynolds.section import Section

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


def column_temperature(column: HeatColumn, section: Section) -> Array:
    """Temperature at the nodes of a column, its source linearised at the last one, shape (n,) [K]."""
    c, d = column, section.derivative
    matrix = np.diag(c.inflow - c.compression) + c.crossing[:, None] * d - c.slope
    matrix -= c.conductivity / c.film**2 * (d @ d)
    right = c.carried + c.source - c.slope @ c.last
    for wall, sign, body in ((0, -1.0, 0), (-1, 1.0, 1)):
        matrix[wall] = sign * c.response[body] * c.conductivity / c.film * d[wall]
        matrix[wall, wall] += 1.0
        right[wall] = c.history[body]
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
